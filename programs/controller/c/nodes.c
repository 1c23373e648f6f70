/* SPDX-License-Identifier: MIT
 * A supervisor's nodes.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "programs/controller/c/world.h"

#define PLACES 256 /* of the table of nodes */

static WbNodeRef table[PLACES];

bool may_ask_world(const char* function) {
  session_ready();
  if (session.supervisor) return true;
  WARN("%s(): this robot is no supervisor; in the world it needs supervisor TRUE", function);
  return false;
}

int ask_world(struct link_record* answer, const char* function) {
  int number = ask(answer);
  if (number == LINK_NOTHING && answer->texts[0].size)
    WARN("%s(): %.*s", function, (int)answer->texts[0].size, answer->texts[0].bytes);
  return number;
}

struct link_packet* world_command(int record) {
  struct link_packet* out = command(record);
  session.stamp++;
  return out;
}

WbNodeRef node_of(int number) {
  WbNodeRef node;
  if (number <= 0) return 0;
  for (node = table[number % PLACES]; node; node = node->next)
    if (node->number == number) return node;
  node = memset(grow(0, sizeof *node), 0, sizeof *node);
  node->number = number;
  node->next = table[number % PLACES];
  return table[number % PLACES] = node;
}

static void tell(char** text, const struct link_record* r, int index) {
  free(*text);
  *text = copy_text(r->texts[index].bytes, r->texts[index].size);
}

static WbNodeRef take_node(const struct link_record* r) {
  WbNodeRef node = node_of((int)r->ints[0]);
  if (!node) return 0;
  node->parent = (int)r->ints[1];
  node->kind = (WbNodeType)r->ints[2];
  if (!node->is_known) {
    tell(&node->def, r, 0);
    tell(&node->type, r, 1);
    tell(&node->base, r, 2);
    node->is_known = true;
  }
  return node;
}

static WbNodeRef find_said(int by, int number, const char* def, const char* function) {
  struct link_record answer;
  struct link_packet* out = command(LINK_FIND_NODE);
  int got;
  link_int(out, by);
  link_int(out, number);
  link_text(out, def);
  got = function ? ask_world(&answer, function) : ask(&answer);
  return got == LINK_NODE ? take_node(&answer) : 0;
}
WbNodeRef find_node(int by, int number, const char* def) { return find_said(by, number, def, 0); }

WbNodeRef node_known(WbNodeRef node, const char* function) {
  if (!node) {
    WARN("%s(): got NULL, expected a node", function);
    return 0;
  }
  if (!node->is_known) (void)find_node(FIND_NUMBER, node->number, "");
  if (!node->is_known) {
    node->def = copy_text("", 0);
    node->type = copy_text("", 0);
    node->base = copy_text("", 0);
    node->is_known = true;
  }
  return node;
}

/* --- which */

WbNodeRef wb_supervisor_node_get_root(void) {
  if (!may_ask_world("wb_supervisor_node_get_root")) return 0;
  return find_node(FIND_ROOT, 0, "");
}
WbNodeRef wb_supervisor_node_get_self(void) {
  if (!may_ask_world("wb_supervisor_node_get_self")) return 0;
  return find_said(FIND_SELF, 0, "", "wb_supervisor_node_get_self");
}
WbNodeRef wb_supervisor_node_get_selected(void) {
  if (!may_ask_world("wb_supervisor_node_get_selected")) return 0;
  return find_node(FIND_SELECTED, 0, "");
}
WbNodeRef wb_supervisor_node_get_from_def(const char* def) {
  if (!may_ask_world("wb_supervisor_node_get_from_def")) return 0;
  if (!def || !*def) {
    WARN("wb_supervisor_node_get_from_def(): got no name, expected a DEF");
    return 0;
  }
  return find_node(FIND_DEF, 0, def); /* whether there is one is a question, not a mistake */
}
WbNodeRef wb_supervisor_node_get_from_proto_def(WbNodeRef node, const char* def) {
  if (!may_ask_world("wb_supervisor_node_get_from_proto_def") || !node || !def) return 0;
  return find_node(FIND_DEF, node->number, def);
}
WbNodeRef wb_supervisor_node_get_from_id(int id) {
  if (!may_ask_world("wb_supervisor_node_get_from_id")) return 0;
  return id > 0 ? find_node(FIND_NUMBER, id, "") : 0;
}
WbNodeRef wb_supervisor_node_get_from_device(WbDeviceTag tag) {
  if (!may_ask_world("wb_supervisor_node_get_from_device")) return 0;
  return find_said(FIND_DEVICE, tag, "", "wb_supervisor_node_get_from_device");
}
WbNodeRef wb_supervisor_node_get_parent_node(WbNodeRef node) {
  node = node_known(node, "wb_supervisor_node_get_parent_node");
  return node ? node_of(node->parent) : 0;
}

int wb_supervisor_node_get_id(WbNodeRef node) { return node ? node->number : -1; }
WbNodeType wb_supervisor_node_get_type(WbNodeRef node) {
  node = node_known(node, "wb_supervisor_node_get_type");
  return node ? node->kind : WB_NODE_NO_NODE;
}
const char* wb_supervisor_node_get_def(WbNodeRef node) {
  node = node_known(node, "wb_supervisor_node_get_def");
  return node ? node->def : "";
}
const char* wb_supervisor_node_get_type_name(WbNodeRef node) {
  node = node_known(node, "wb_supervisor_node_get_type_name");
  return node ? node->type : "";
}
const char* wb_supervisor_node_get_base_type_name(WbNodeRef node) {
  node = node_known(node, "wb_supervisor_node_get_base_type_name");
  return node ? node->base : "";
}
/* what is made of a PROTO has a type of its own */
bool wb_supervisor_node_is_proto(WbNodeRef node) {
  node = node_known(node, "wb_supervisor_node_is_proto");
  return node && strcmp(node->type, node->base) != 0;
}

/* --- what is followed */

#define FOLLOWED_MOST 1000 /* at a time */
#define FOLLOWED_UNUSED 3  /* steps without a question, after which it is no more */

static struct followed* all_followed;
static int followed_count;

static void say_follow(const struct followed* one, bool on) {
  struct link_packet* out = command(LINK_FOLLOW);
  link_int(out, one->node);
  link_int(out, one->field);
  link_int(out, one->what);
  link_int(out, on);
  command_end();
}

void follow(struct followed* one, int node, int field, int what, bool is_fresh) {
  if (!is_fresh && !one->is_on && one->is_used && session.steps - one->used == 1 && followed_count < FOLLOWED_MOST) {
    one->node = node, one->field = field, one->what = what;
    one->is_on = true;
    one->next = all_followed;
    all_followed = one;
    followed_count++;
    say_follow(one, true);
  }
  one->is_used = true;
  one->used = session.steps;
}

void followed_step(void) {
  struct followed** at = &all_followed;
  while (*at) {
    struct followed* one = *at;
    if (session.steps - one->used < FOLLOWED_UNUSED) {
      at = &one->next;
      continue;
    }
    say_follow(one, false);
    one->is_on = one->is_used = false;
    *at = one->next;
    followed_count--;
  }
}

/* it is of the step's end, which has another stamp */
void take_followed(const struct link_record* r) {
  WbNodeRef node = node_of((int)r->ints[0]);
  WbFieldRef field;
  struct asked* asked;
  size_t count = r->lists[0].count;
  if (!node || count > NODE_NUMBERS || r->ints[2] < 0 || r->ints[2] >= ASKED) return;
  for (field = node->fields; field && r->ints[1]; field = field->next)
    if (field->number == r->ints[1] && count <= 4) take_followed_field(field, r->lists[0].values, count);
  if (r->ints[1]) return;
  asked = &node->asked[r->ints[2]];
  memcpy(asked->numbers, r->lists[0].values, count * sizeof(double));
  asked->count = (int)count;
  asked->stamp = session.stamp + 1;
}

/* --- where */

static bool ask_node(WbNodeRef node, int what, struct link_record* answer, const char* function) {
  struct link_packet* out;
  if (!may_ask_world(function)) return false;
  if (!node) {
    WARN("%s(): got NULL, expected a node", function);
    return false;
  }
  out = command(LINK_ASK_NODE);
  link_int(out, node->number);
  link_int(out, what);
  return ask_world(answer, function) == LINK_VALUE;
}

/* numbers of a node, as kept or as asked; NaN: it has none */
static const double* numbers(WbNodeRef node, int what, int count, const char* function) {
  struct asked* a = node ? &node->asked[what] : 0;
  struct link_record answer;
  const bool is_fresh = a && a->stamp == session.stamp && a->count == count;
  if (a && session.supervisor && what <= ASK_POSE && what != ASK_CONTACTS)
    follow(&a->followed, node->number, 0, what, is_fresh);
  if (is_fresh) return a->numbers;
  if (!ask_node(node, what, &answer, function) || answer.lists[0].count != (size_t)count) return no_numbers();
  memcpy(a->numbers, answer.lists[0].values, (size_t)count * sizeof(double));
  a->count = count;
  a->stamp = session.stamp;
  return a->numbers;
}

const double* wb_supervisor_node_get_position(WbNodeRef node) {
  return numbers(node, ASK_POSITION, 3, "wb_supervisor_node_get_position");
}
const double* wb_supervisor_node_get_orientation(WbNodeRef node) {
  return numbers(node, ASK_ORIENTATION, 9, "wb_supervisor_node_get_orientation");
}
const double* wb_supervisor_node_get_velocity(WbNodeRef node) {
  return numbers(node, ASK_VELOCITY, 6, "wb_supervisor_node_get_velocity");
}
const double* wb_supervisor_node_get_center_of_mass(WbNodeRef node) {
  return numbers(node, ASK_MASS_CENTRE, 3, "wb_supervisor_node_get_center_of_mass");
}
bool wb_supervisor_node_get_static_balance(WbNodeRef node) {
  const double* answer = numbers(node, ASK_BALANCE, 1, "wb_supervisor_node_get_static_balance");
  return answer[0] == 1;
}

/* the inverse of a pose's turn, applied to what lies between them */
const double* wb_supervisor_node_get_pose(WbNodeRef node, WbNodeRef from_node) {
  const double* m = numbers(node, ASK_POSE, 16, "wb_supervisor_node_get_pose");
  const double* f = from_node ? numbers(from_node, ASK_POSE, 16, "wb_supervisor_node_get_pose") : 0;
  int row, column, k;
  if (!node || !from_node) return m;
  for (row = 0; row < 3; row++)
    for (column = 0; column < 4; column++) {
      double sum = 0;
      for (k = 0; k < 3; k++) sum += f[4 * k + row] * (m[4 * k + column] - (column == 3 ? f[4 * k + 3] : 0));
      node->relative_pose[4 * row + column] = sum;
    }
  for (column = 0; column < 4; column++) node->relative_pose[12 + column] = column == 3;
  return node->relative_pose;
}

static int contacts(WbNodeRef node, const char* function) {
  struct link_record answer;
  size_t i;
  if (node && node->asked[ASK_CONTACTS].stamp == session.stamp) return node->contact_count;
  if (!ask_node(node, ASK_CONTACTS, &answer, function)) return 0;
  node->contact_count = (int)(answer.lists[0].count / 3);
  node->contacts = grow(node->contacts, (size_t)node->contact_count * sizeof *node->contacts);
  for (i = 0; i < (size_t)node->contact_count; i++) {
    memcpy(node->contacts[i].point, answer.lists[0].values + 3 * i, 3 * sizeof(double));
    node->contacts[i].node_id = node->number;
  }
  node->asked[ASK_CONTACTS].stamp = session.stamp;
  return node->contact_count;
}
int wb_supervisor_node_get_number_of_contact_points(WbNodeRef node) {
  return node ? contacts(node, "wb_supervisor_node_get_number_of_contact_points") : -1;
}
const double* wb_supervisor_node_get_contact_point(WbNodeRef node, int index) {
  int count = contacts(node, "wb_supervisor_node_get_contact_point");
  return index >= 0 && index < count ? node->contacts[index].point : 0;
}
WbNodeRef wb_supervisor_node_get_contact_point_node(WbNodeRef node, int index) {
  return wb_supervisor_node_get_contact_point(node, index) ? node : 0;
}
WbContactPoint* wb_supervisor_node_get_contact_points(WbNodeRef node, bool include_descendants, int* size) {
  int count = contacts(node, "wb_supervisor_node_get_contact_points");
  (void)include_descendants;
  if (size) *size = count;
  return count ? node->contacts : 0;
}

/* --- changes */

static void change(WbNodeRef node, int what, const double* values, size_t count, const char* text, const char* function) {
  struct link_packet* out;
  if (!may_ask_world(function)) return;
  if (!node) {
    WARN("%s(): got NULL, expected a node", function);
    return;
  }
  out = world_command(LINK_DO_NODE);
  link_int(out, node->number);
  link_int(out, what);
  link_numbers(out, values, count);
  link_text(out, text);
  command_end();
}

/* numbers that would spoil the world */
static bool are_finite(const double* values, int count, const char* function) {
  int i;
  for (i = 0; values && i < count; i++)
    if (!isfinite(values[i])) break;
  if (values && i == count) return true;
  WARN("%s(): got %s, expected %d numbers", function, values ? "NaN or an infinite number" : "NULL", count);
  return false;
}

void wb_supervisor_node_set_velocity(WbNodeRef node, const double velocity[6]) {
  if (are_finite(velocity, 6, "wb_supervisor_node_set_velocity"))
    change(node, DO_VELOCITY, velocity, 6, 0, "wb_supervisor_node_set_velocity");
}
void wb_supervisor_node_reset_physics(WbNodeRef node) { change(node, DO_REST, 0, 0, 0, "wb_supervisor_node_reset_physics"); }
void wb_supervisor_node_restart_controller(WbNodeRef node) {
  change(node, DO_RESTART, 0, 0, 0, "wb_supervisor_node_restart_controller");
}
void wb_supervisor_node_remove(WbNodeRef node) { change(node, DO_REMOVE, 0, 0, 0, "wb_supervisor_node_remove"); }
void wb_supervisor_node_save_state(WbNodeRef node, const char* state_name) {
  change(node, DO_KEEP, 0, 0, state_name, "wb_supervisor_node_save_state");
}
void wb_supervisor_node_load_state(WbNodeRef node, const char* state_name) {
  change(node, DO_TAKE, 0, 0, state_name, "wb_supervisor_node_load_state");
}

/* in the world's axes, of a vector in the node's where it is relative */
static bool in_world(WbNodeRef node, const double given[3], bool relative, double out[3], const char* function) {
  const double* o;
  int i;
  if (!are_finite(given, 3, function)) return false;
  memcpy(out, given, 3 * sizeof *out);
  if (!relative || !node) return true;
  o = wb_supervisor_node_get_orientation(node);
  for (i = 0; i < 3; i++) out[i] = o[3 * i] * given[0] + o[3 * i + 1] * given[1] + o[3 * i + 2] * given[2];
  return are_finite(out, 3, function);
}

void wb_supervisor_node_add_force(WbNodeRef node, const double force[3], bool relative) {
  double f[3];
  if (in_world(node, force, relative, f, "wb_supervisor_node_add_force"))
    change(node, DO_FORCE, f, 3, 0, "wb_supervisor_node_add_force");
}
void wb_supervisor_node_add_torque(WbNodeRef node, const double torque[3], bool relative) {
  double t[3];
  if (in_world(node, torque, relative, t, "wb_supervisor_node_add_torque"))
    change(node, DO_TORQUE, t, 3, 0, "wb_supervisor_node_add_torque");
}
/* a force beside the middle is the force and its torque; the offset is in the node's axes */
void wb_supervisor_node_add_force_with_offset(WbNodeRef node, const double force[3], const double offset[3],
                                              bool relative) {
  const char* function = "wb_supervisor_node_add_force_with_offset";
  double f[3], r[3], torque[3];
  if (!in_world(node, force, relative, f, function) || !in_world(node, offset, true, r, function)) return;
  torque[0] = r[1] * f[2] - r[2] * f[1];
  torque[1] = r[2] * f[0] - r[0] * f[2];
  torque[2] = r[0] * f[1] - r[1] * f[0];
  change(node, DO_FORCE, f, 3, 0, function);
  change(node, DO_TORQUE, torque, 3, 0, function);
}

void wb_supervisor_node_set_joint_position(WbNodeRef node, double position, int index) {
  (void)node, (void)position, (void)index;
  WARN("wb_supervisor_node_set_joint_position(): joints cannot be set; use the wheels' motors");
}
const char* wb_supervisor_node_export_string(WbNodeRef node) {
  (void)node;
  WARN("wb_supervisor_node_export_string(): nodes are not written as text");
  return "";
}

/* --- what needs a window, and what needs no telling */

void wb_supervisor_node_move_viewpoint(WbNodeRef node) { (void)node; }
void wb_supervisor_node_set_visibility(WbNodeRef node, WbNodeRef from, bool visible) {
  (void)node, (void)from, (void)visible;
}
void wb_supervisor_node_enable_pose_tracking(WbNodeRef node, int sampling_period, WbNodeRef from_node) {
  (void)node, (void)sampling_period, (void)from_node;
}
void wb_supervisor_node_disable_pose_tracking(WbNodeRef node, WbNodeRef from_node) { (void)node, (void)from_node; }
void wb_supervisor_node_enable_contact_points_tracking(WbNodeRef node, int sampling_period, bool include_descendants) {
  (void)node, (void)sampling_period, (void)include_descendants;
}
void wb_supervisor_node_disable_contact_points_tracking(WbNodeRef node) { (void)node; }
void wb_supervisor_node_enable_contact_point_tracking(WbNodeRef node, int sampling_period, bool include_descendants) {
  (void)node, (void)sampling_period, (void)include_descendants;
}
void wb_supervisor_node_disable_contact_point_tracking(WbNodeRef node, bool include_descendants) {
  (void)node, (void)include_descendants;
}

WbProtoRef wb_supervisor_node_get_proto(WbNodeRef node) { return (void)node, (WbProtoRef)0; }
const char* wb_supervisor_proto_get_type_name(WbProtoRef proto) { return (void)proto, ""; }
bool wb_supervisor_proto_is_derived(WbProtoRef proto) { return (void)proto, false; }
WbProtoRef wb_supervisor_proto_get_parent(WbProtoRef proto) { return (void)proto, (WbProtoRef)0; }
WbFieldRef wb_supervisor_proto_get_field(WbProtoRef proto, const char* field_name) {
  return (void)proto, (void)field_name, (WbFieldRef)0;
}
WbFieldRef wb_supervisor_proto_get_field_by_index(WbProtoRef proto, int index) {
  return (void)proto, (void)index, (WbFieldRef)0;
}
int wb_supervisor_proto_get_number_of_fields(WbProtoRef proto) { return (void)proto, -1; }
