/* SPDX-License-Identifier: MIT
 * Nodes and fields of the world, as the simulator numbers them. A supervisor's references are these structs;
 * each number has one, for as long as the program lives. What was asked is kept until the world may have
 * changed.
 */
#ifndef PROGRAMS_CONTROLLER_C_WORLD_H
#define PROGRAMS_CONTROLLER_C_WORLD_H

#include "programs/controller/c/library.h"

#define NODE_NUMBERS 16

/** What is asked for in one step and in the next is followed: it comes with the steps, until nobody asks. */
struct followed {
  struct followed* next; /* of all that are followed now */
  int node, field, what; /* as FOLLOW has them */
  unsigned used;         /* steps when it was asked for last */
  bool is_used, is_on;
};
/** It is asked for; `is_fresh`: no question was needed. */
void follow(struct followed* one, int node, int field, int what, bool is_fresh);

/** An answer of ASK_NODE. */
struct asked {
  struct followed followed;
  unsigned stamp; /* of the session when it was asked; 0: never */
  int count;
  double numbers[NODE_NUMBERS];
};

/* what of a node, as ASK_NODE and DO_NODE number it */
enum {
  ASK_POSITION,
  ASK_ORIENTATION,
  ASK_VELOCITY,
  ASK_MASS_CENTRE,
  ASK_CONTACTS,
  ASK_POSE,
  ASK_BALANCE,
  ASK_FIELDS,
  ASKED
};
enum { DO_VELOCITY, DO_REST, DO_RESTART, DO_REMOVE, DO_FORCE, DO_TORQUE, DO_KEEP, DO_TAKE };
enum { FIND_ROOT, FIND_SELF, FIND_DEF, FIND_NUMBER, FIND_DEVICE, FIND_SELECTED };

struct WbNodeStructPrivate {
  struct WbNodeStructPrivate* next; /* of those with the same place in the table */
  int number, parent;
  WbNodeType kind;
  bool is_known; /* what follows has been told */
  char *def, *type, *base;
  struct asked asked[ASKED];
  double relative_pose[16]; /* of the last from_node */
  WbContactPoint* contacts;
  int contact_count;
  struct WbFieldStructPrivate* fields; /* that were asked for */
};

struct WbFieldStructPrivate {
  struct WbFieldStructPrivate* next; /* of the same node */
  struct WbNodeStructPrivate* node;
  int number, count;
  WbFieldType type;
  char* name;
  unsigned count_stamp;
  struct followed followed;
  /* the last value that was asked for */
  unsigned stamp;
  int index;
  double numbers[4];
  char* text;
  int value_node;
};

/** FOLLOWED's numbers, up to 4, become the field's value. */
void take_followed_field(WbFieldRef field, const double* values, size_t count);

/** Whether the program may ask of the world; else a warning. */
bool may_ask_world(const char* function);

/** The node of a number; null for 0. */
WbNodeRef node_of(int number);
/** Asks for a node; null: there is none, and no warning. */
WbNodeRef find_node(int by, int number, const char* def);
/** The node, with what NODE tells; null, after a warning, for null. */
WbNodeRef node_known(WbNodeRef node, const char* function);

/** Asks; the answer's number. NOTHING becomes a warning where it says why. */
int ask_world(struct link_record* answer, const char* function);
/** A command that may change the world: what is kept is old. */
struct link_packet* world_command(int record);

#endif
