/* SPDX-License-Identifier: MIT
 * What a robot's controller may ask of the world through webots/supervisor.h: where robots and objects are.
 * Everything that changes the world is left to supervisor programs, and does not link here. Empty on the robot.
 */
#ifdef __TWINPUCK_PC__
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core.h"
#include "webots/robot.h"
#include "webots/supervisor.h"

#define MOST_NODES 16

struct WbFieldStructPrivate {
  struct WbNodeStructPrivate* node;
  unsigned char is_rotation;
};

struct WbNodeStructPrivate {
  int body; /* number that the simulator gave; 0 free */
  struct WbFieldStructPrivate translation, rotation;
  float position[3], turn[4], orientation[9];
};

static struct WbNodeStructPrivate nodes[MOST_NODES];

static WbNodeRef node_of(int body) {
  int i;
  if (body == 0) return 0;
  for (i = 0; i < MOST_NODES; i++) {
    if (nodes[i].body == body) return &nodes[i];
    if (nodes[i].body) continue;
    nodes[i].body = body;
    nodes[i].translation.node = nodes[i].rotation.node = &nodes[i];
    nodes[i].rotation.is_rotation = 1;
    return &nodes[i];
  }
  webots_warn("wb_supervisor_node_get_from_def", "got a 17th node, expected at most 16");
  return 0;
}

/* the angle turns about the upward axis: z, or y in a nue world */
static void refresh(WbNodeRef node) {
  float angle, c, s;
  int up = twin_nue() ? 1 : 2;
  twin_pose_of(node->body, node->position, &angle);
  memset(node->turn, 0, sizeof node->turn);
  node->turn[up] = 1;
  node->turn[3] = angle;
  c = cosf(angle), s = sinf(angle);
  memset(node->orientation, 0, sizeof node->orientation);
  node->orientation[4 * up] = 1;
  if (twin_nue()) {
    node->orientation[0] = node->orientation[8] = c;
    node->orientation[2] = s;
    node->orientation[6] = -s;
  } else {
    node->orientation[0] = node->orientation[4] = c;
    node->orientation[1] = -s;
    node->orientation[3] = s;
  }
}

WbNodeRef wb_supervisor_node_get_self(void) {
  webots_init();
  return node_of(twin_find(wb_robot_get_name()));
}

WbNodeRef wb_supervisor_node_get_from_def(const char* def) {
  webots_init();
  return node_of(twin_find(def));
}

const double* wb_supervisor_node_get_position(WbNodeRef node) {
  if (!node) return 0;
  refresh(node);
  return (const double*)node->position;
}

const double* wb_supervisor_node_get_orientation(WbNodeRef node) {
  if (!node) return 0;
  refresh(node);
  return (const double*)node->orientation;
}

WbFieldRef wb_supervisor_node_get_field(WbNodeRef node, const char* field_name) {
  if (node && strcmp(field_name, "translation") == 0) return &node->translation;
  if (node && strcmp(field_name, "rotation") == 0) return &node->rotation;
  if (node) printf("Warning: wb_supervisor_node_get_field(): got \"%s\", expected translation or rotation\n", field_name);
  return 0;
}

const double* wb_supervisor_field_get_sf_vec3f(WbFieldRef field) {
  return field && !field->is_rotation ? wb_supervisor_node_get_position(field->node) : 0;
}

const double* wb_supervisor_field_get_sf_rotation(WbFieldRef field) {
  if (!field || !field->is_rotation) return 0;
  refresh(field->node);
  return (const double*)field->node->turn;
}
#endif
