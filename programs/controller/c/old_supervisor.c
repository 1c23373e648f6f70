/* SPDX-License-Identifier: MIT
 * The supervisor's functions of 2005 to 2007, over the present ones: fields by mask, in buffers that fill themselves.
 * Positions are always with x to the right, y up and z towards the reader.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "programs/controller/c/library.h"

struct NodeStruct {
  struct NodeStruct* next;
  char* def;
  WbNodeRef node;
  WbFieldRef translation, rotation;
};

/* supervisor_field_get() with a period */
struct subscription {
  struct subscription* next;
  NodeRef node;
  int mask, period_ms;
  float* buffer;
  int64_t next_ns;
};

static NodeRef found_nodes;
static struct subscription* subscriptions;

/* a node that was found, with its fields; false, and a warning, else */
static bool is_found(NodeRef node, const char* function) {
  if (node && node->node) return true;
  WARN("%s(): got %s, expected a node that supervisor_node_was_found()", function, node ? node->def : "NULL");
  return false;
}

static void find(NodeRef node) {
  if (node->node) return;
  node->node = wb_supervisor_node_get_from_def(node->def);
  if (!node->node) return;
  node->translation = wb_supervisor_node_get_field(node->node, "translation");
  node->rotation = wb_supervisor_node_get_field(node->node, "rotation");
}

/* x, y, z of the translation, then axis and angle */
static void get_pose(NodeRef node, double pose[7]) {
  const double* t = wb_supervisor_field_get_sf_vec3f(node->translation);
  const double* r = wb_supervisor_field_get_sf_rotation(node->rotation);
  int i;
  memcpy(pose, t, 3 * sizeof *t);
  memcpy(pose + 3, r, 4 * sizeof *r);
  for (i = 0; i < 7; i++)
    if (isnan(pose[i])) pose[i] = 0;
  if (session.nue) return;
  /* in a world with z up the same axes are x, z, -y; at angle 0 robots look along x there and along -z here */
  for (i = 0; i < 4; i += 3) {
    double y = pose[i + 1];
    pose[i + 1] = pose[i + 2];
    pose[i + 2] = -y;
  }
  if (fabs(pose[4]) > 0.999999 && wb_supervisor_node_get_type(node->node) == WB_NODE_ROBOT)
    pose[6] -= pose[4] * 1.5707963267948966;
}

static void set_pose(NodeRef node, const double pose[7], int mask) {
  double t[3], r[4];
  memcpy(t, pose, sizeof t);
  memcpy(r, pose + 3, sizeof r);
  if (!session.nue) {
    t[1] = -pose[2], t[2] = pose[1];
    r[1] = -pose[5], r[2] = pose[4];
    if (fabs(pose[4]) > 0.999999 && wb_supervisor_node_get_type(node->node) == WB_NODE_ROBOT)
      r[3] += pose[4] * 1.5707963267948966;
  }
  if (mask & SUPERVISOR_FIELD_TRANSLATION) wb_supervisor_field_set_sf_vec3f(node->translation, t);
  if (mask & SUPERVISOR_FIELD_ROTATION) wb_supervisor_field_set_sf_rotation(node->rotation, r);
}

static void fill(NodeRef node, int mask, float* buffer) {
  double pose[7];
  int bit;
  get_pose(node, pose);
  for (bit = 0; bit < 7; bit++)
    if (mask >> bit & 1) *buffer++ = (float)pose[bit];
}

void old_supervisor_step(void) {
  struct subscription* s;
  for (s = subscriptions; s; s = s->next) {
    if (session.time_ns < s->next_ns) continue;
    while (s->next_ns <= session.time_ns) s->next_ns += (int64_t)s->period_ms * 1000000;
    fill(s->node, s->mask, s->buffer);
  }
}

NodeRef supervisor_node_get_from_def(const char* def) {
  NodeRef node;
  session_ready();
  if (!def) def = "";
  for (node = found_nodes; node; node = node->next)
    if (strcmp(node->def, def) == 0) return node;
  node = memset(grow(0, sizeof *node), 0, sizeof *node);
  node->def = copy_text(def, strlen(def));
  node->next = found_nodes;
  found_nodes = node;
  find(node);
  return node;
}

int supervisor_node_was_found(NodeRef node) {
  if (node) find(node);
  return node && node->node;
}

void supervisor_field_get(NodeRef node, int mask, float* buffer, int period_ms) {
  struct subscription** at = &subscriptions;
  if (node) find(node);
  if (!is_found(node, "supervisor_field_get")) return;
  /* the same buffer again replaces what filled it */
  while (*at) {
    struct subscription* s = *at;
    if (s->node == node && s->buffer == buffer) {
      *at = s->next;
      free(s);
    } else {
      at = &s->next;
    }
  }
  if (!buffer) return;
  fill(node, mask, buffer);
  if (period_ms <= 0) return;
  *at = grow(0, sizeof **at);
  (*at)->next = 0;
  (*at)->node = node;
  (*at)->mask = mask;
  (*at)->buffer = buffer;
  (*at)->period_ms = period_ms;
  (*at)->next_ns = session.time_ns + (int64_t)period_ms * 1000000;
}

void supervisor_field_set(NodeRef node, int mask, const float* values) {
  double pose[7];
  int bit;
  if (node) find(node);
  if (!is_found(node, "supervisor_field_set") || !values) return;
  get_pose(node, pose);
  for (bit = 0; bit < 7; bit++)
    if (mask >> bit & 1) pose[bit] = (double)*values++;
  set_pose(node, pose, mask);
}

void supervisor_set_label(int id, const char* text, float x, float y, float size, unsigned int colour) {
  (wb_supervisor_set_label)(id, text, (double)x, (double)y, (double)size, (int)colour, 0, "Arial");
}
void supervisor_export_image(const char* filename, int quality) { wb_supervisor_export_image(filename, quality); }
void supervisor_simulation_quit(void) { wb_supervisor_simulation_quit(0); }
void supervisor_simulation_revert(void) { wb_supervisor_simulation_reset(); }
void supervisor_simulation_physics_reset(void) { wb_supervisor_simulation_reset_physics(); }

void supervisor_robot_set_controller(NodeRef robot, const char* controller) {
  WbFieldRef field;
  if (robot) find(robot);
  if (!is_found(robot, "supervisor_robot_set_controller")) return;
  field = wb_supervisor_node_get_field(robot->node, "controller");
  if (field && controller && strcmp(wb_supervisor_field_get_sf_string(field), controller) != 0)
    wb_supervisor_field_set_sf_string(field, controller);
  wb_supervisor_node_restart_controller(robot->node);
}
