/* SPDX-License-Identifier: MIT
 * A supervisor's fields: which there are, their values, and members of lists.
 */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "programs/controller/c/world.h"

/* --- which */

static void take_count(WbFieldRef field, int count) {
  field->count = count;
  field->count_stamp = session.stamp;
}

static bool is_named(const WbFieldRef field, const char* bytes, size_t size) {
  return strlen(field->name) == size && memcmp(field->name, bytes, size) == 0;
}

static WbFieldRef take_field(WbNodeRef node, const struct link_record* r) {
  WbFieldRef field;
  if (r->ints[0] <= 0) return 0;
  for (field = node->fields; field; field = field->next)
    if (is_named(field, r->texts[0].bytes, r->texts[0].size)) break;
  if (!field) {
    field = memset(grow(0, sizeof *field), 0, sizeof *field);
    field->node = node;
    field->name = copy_text(r->texts[0].bytes, r->texts[0].size);
    field->text = copy_text("", 0);
    field->next = node->fields;
    node->fields = field;
  }
  field->number = (int)r->ints[0];
  field->type = (WbFieldType)r->ints[1];
  take_count(field, (int)r->ints[2]);
  return field;
}

static WbFieldRef find_field(WbNodeRef node, int index, const char* name, const char* function) {
  struct link_record answer;
  struct link_packet* out = command(LINK_FIND_FIELD);
  int number;
  link_int(out, node->number);
  link_int(out, index);
  link_text(out, name);
  number = ask_world(&answer, function);
  if (number == LINK_FIELD) return take_field(node, &answer);
  if (number == LINK_NOTHING && !answer.texts[0].size && name)
    WARN("%s(): got \"%s\", expected a field that the node has", function, name);
  return 0;
}

WbFieldRef wb_supervisor_node_get_field(WbNodeRef node, const char* field_name) {
  WbFieldRef field;
  if (!may_ask_world("wb_supervisor_node_get_field")) return 0;
  if (!node || !field_name) {
    WARN("wb_supervisor_node_get_field(): got NULL, expected %s", node ? "a field's name" : "a node");
    return 0;
  }
  for (field = node->fields; field; field = field->next)
    if (strcmp(field->name, field_name) == 0) return field;
  return find_field(node, -1, field_name, "wb_supervisor_node_get_field");
}

WbFieldRef wb_supervisor_node_get_field_by_index(WbNodeRef node, int index) {
  if (!may_ask_world("wb_supervisor_node_get_field_by_index") || !node || index < 0) return 0;
  return find_field(node, index, "", "wb_supervisor_node_get_field_by_index");
}

int wb_supervisor_node_get_number_of_fields(WbNodeRef node) {
  struct link_record answer;
  struct link_packet* out;
  if (!may_ask_world("wb_supervisor_node_get_number_of_fields") || !node) return -1;
  out = command(LINK_ASK_NODE);
  link_int(out, node->number);
  link_int(out, ASK_FIELDS);
  if (ask_world(&answer, "wb_supervisor_node_get_number_of_fields") != LINK_VALUE || !answer.lists[0].count) return -1;
  return (int)answer.lists[0].values[0];
}

WbFieldRef wb_supervisor_node_get_proto_field(WbNodeRef node, const char* name) {
  return wb_supervisor_node_get_field(node, name);
}
WbFieldRef wb_supervisor_node_get_proto_field_by_index(WbNodeRef node, int index) {
  return wb_supervisor_node_get_field_by_index(node, index);
}
int wb_supervisor_node_get_proto_number_of_fields(WbNodeRef node) { return wb_supervisor_node_get_number_of_fields(node); }
WbFieldRef wb_supervisor_node_get_base_node_field(WbNodeRef node, const char* name) {
  return wb_supervisor_node_get_field(node, name);
}
WbFieldRef wb_supervisor_node_get_base_node_field_by_index(WbNodeRef node, int index) {
  return wb_supervisor_node_get_field_by_index(node, index);
}
int wb_supervisor_node_get_number_of_base_node_fields(WbNodeRef node) {
  return wb_supervisor_node_get_number_of_fields(node);
}
WbFieldRef wb_supervisor_field_get_actual_field(WbFieldRef field) { return field; }

const char* wb_supervisor_field_get_name(WbFieldRef field) { return field ? field->name : 0; }
WbFieldType wb_supervisor_field_get_type(WbFieldRef field) { return field ? field->type : WB_NO_FIELD; }

static const char* type_name(WbFieldType type) {
  static const char* const kSingle[] = {"",          "SFBool",     "SFInt32", "SFFloat",  "SFVec2f",
                                        "SFVec3f",   "SFRotation", "SFColor", "SFString", "SFNode"};
  static const char* const kMany[] = {"",          "MFBool",     "MFInt32", "MFFloat",  "MFVec2f",
                                      "MFVec3f",   "MFRotation", "MFColor", "MFString", "MFNode"};
  int kind = type & 0xF;
  if (kind < 1 || kind > 9) return "";
  return type & WB_MF ? kMany[kind] : kSingle[kind];
}
const char* wb_supervisor_field_get_type_name(WbFieldRef field) { return field ? type_name(field->type) : ""; }

int wb_supervisor_field_get_count(WbFieldRef field) {
  struct link_record answer;
  struct link_packet* out;
  if (!field) {
    WARN("wb_supervisor_field_get_count(): got NULL, expected a field");
    return -1;
  }
  if (!(field->type & WB_MF)) return -1;
  if (field->count_stamp == session.stamp) return field->count;
  /* programs, this one too, may have changed the list */
  out = command(LINK_FIND_FIELD);
  link_int(out, field->node->number);
  link_int(out, -1);
  link_text(out, field->name);
  if (ask_world(&answer, "wb_supervisor_field_get_count") == LINK_FIELD) take_count(field, (int)answer.ints[2]);
  return field->count;
}

void wb_supervisor_field_enable_sf_tracking(WbFieldRef field, int sampling_period) { (void)field, (void)sampling_period; }
void wb_supervisor_field_disable_sf_tracking(WbFieldRef field) { (void)field; }

/* --- values */

/* the field, of the wanted type; null, after a warning, else */
static WbFieldRef checked(WbFieldRef field, WbFieldType type, const char* function) {
  if (!may_ask_world(function)) return 0;
  if (!field)
    WARN("%s(): got NULL, expected a field", function);
  else if (field->type != type)
    WARN("%s(): got \"%s\", a %s, expected a %s", function, field->name, type_name(field->type), type_name(type));
  else
    return field;
  return 0;
}

/* an index from the beginning; `most` may be reached. -1: it is outside, which a warning says */
static int member(WbFieldRef field, int index, int beyond, const char* function) {
  int count = wb_supervisor_field_get_count(field);
  int from_start = index < 0 ? count + beyond + index : index;
  if (from_start >= 0 && from_start < count + beyond) return from_start;
  WARN("%s(): got %d for \"%s\", expected 0 to %d", function, index, field->name, count + beyond - 1);
  return -1;
}

/* of a robot's firmware, or a sensor that the world has given it: setting it changes no place in the world */
static bool is_of_firmware(WbFieldRef field) { return strchr(field->name, ':') != 0; }

static unsigned stamp_of(WbFieldRef field) { return session.stamp + (is_of_firmware(field) ? session.firmware : 0); }

/* at the end of a step, before its stamp is that of the next */
void take_followed_field(WbFieldRef field, const double* values, size_t count) {
  memcpy(field->numbers, values, count * sizeof(double));
  field->index = 0;
  field->stamp = stamp_of(field) + 1;
}

static bool has_numbers(WbFieldRef field) {
  return !(field->type & WB_MF) && field->type != WB_SF_STRING && field->type != WB_SF_NODE;
}

/* the value becomes the field's last one; false: it has none */
static bool fetch(WbFieldRef field, WbFieldType type, int index, const char* function) {
  struct link_record answer;
  struct link_packet* out;
  bool is_fresh;
  size_t i;
  if (!checked(field, type, function)) return false;
  if (field->type & WB_MF && (index = member(field, index, 0, function)) < 0) return false;
  is_fresh = field->stamp == stamp_of(field) && field->index == index;
  if (has_numbers(field)) follow(&field->followed, field->node->number, field->number, 0, is_fresh);
  if (is_fresh) return true;
  out = command(LINK_GET);
  link_int(out, field->number);
  link_int(out, index);
  if (ask_world(&answer, function) != LINK_VALUE) return false;
  for (i = 0; i < 4; i++) field->numbers[i] = i < answer.lists[0].count ? answer.lists[0].values[i] : 0;
  if ((type & 0xF) == WB_SF_STRING) {
    free(field->text);
    field->text = copy_text(answer.texts[0].bytes, answer.texts[0].size);
  }
  field->value_node = (int)answer.ints[1];
  if (field->type & WB_MF) take_count(field, (int)answer.ints[0]);
  field->index = index;
  field->stamp = stamp_of(field);
  return true;
}

#define GETTER(type, name, KIND, value, otherwise)                                        \
  type wb_supervisor_field_get_sf_##name(WbFieldRef f) {                                  \
    return fetch(f, WB_SF_##KIND, 0, "wb_supervisor_field_get_sf_" #name) ? value : otherwise; \
  }                                                                                       \
  type wb_supervisor_field_get_mf_##name(WbFieldRef f, int index) {                       \
    return fetch(f, WB_MF_##KIND, index, "wb_supervisor_field_get_mf_" #name) ? value : otherwise; \
  }
GETTER(bool, bool, BOOL, f->numbers[0] != 0, false)
GETTER(int, int32, INT32, (int)f->numbers[0], 0)
GETTER(double, float, FLOAT, f->numbers[0], 0)
GETTER(const double*, vec2f, VEC2F, f->numbers, no_numbers())
GETTER(const double*, vec3f, VEC3F, f->numbers, no_numbers())
GETTER(const double*, rotation, ROTATION, f->numbers, no_numbers())
GETTER(const double*, color, COLOR, f->numbers, no_numbers())
GETTER(const char*, string, STRING, f->text, "")
GETTER(WbNodeRef, node, NODE, node_of(f->value_node), 0)

static bool are_finite(const double* values, size_t count, const char* function) {
  size_t i;
  if (!values) {
    WARN("%s(): got NULL, expected %zu numbers", function, count);
    return false;
  }
  for (i = 0; i < count; i++)
    if (!isfinite(values[i])) {
      WARN("%s(): got %g, expected a finite number", function, values[i]);
      return false;
    }
  return true;
}

static void say(int record, WbFieldRef field, int index, const double* values, size_t count, const char* text) {
  struct link_packet* out = is_of_firmware(field) ? command(record) : world_command(record);
  session.firmware++;
  link_int(out, field->number);
  link_int(out, index);
  if (record == LINK_SET) link_int(out, 0);
  link_numbers(out, values, count);
  link_text(out, text);
  command_end();
}

static void set(WbFieldRef field, WbFieldType type, int index, const double* values, size_t count, const char* text,
                const char* function) {
  if (!checked(field, type, function) || (count && !are_finite(values, count, function))) return;
  if (field->type & WB_MF && (index = member(field, index, 0, function)) < 0) return;
  say(LINK_SET, field, index, values, count, text);
}

static void insert(WbFieldRef field, WbFieldType type, int index, const double* values, size_t count, const char* text,
                   const char* function) {
  if (!checked(field, type, function) || (count && !are_finite(values, count, function))) return;
  if ((index = member(field, index, 1, function)) < 0) return;
  say(LINK_INSERT, field, index, values, count, text);
}

#define SETTERS(argument, name, KIND, values, count, text)                                                     \
  void wb_supervisor_field_set_sf_##name(WbFieldRef f, argument) {                                             \
    set(f, WB_SF_##KIND, 0, values, count, text, "wb_supervisor_field_set_sf_" #name);                         \
  }                                                                                                            \
  void wb_supervisor_field_set_mf_##name(WbFieldRef f, int index, argument) {                                  \
    set(f, WB_MF_##KIND, index, values, count, text, "wb_supervisor_field_set_mf_" #name);                     \
  }                                                                                                            \
  void wb_supervisor_field_insert_mf_##name(WbFieldRef f, int index, argument) {                               \
    insert(f, WB_MF_##KIND, index, values, count, text, "wb_supervisor_field_insert_mf_" #name);               \
  }
#define ONE (const double[]){(double)value}
SETTERS(bool value, bool, BOOL, ONE, 1, 0)
SETTERS(int value, int32, INT32, ONE, 1, 0)
SETTERS(double value, float, FLOAT, ONE, 1, 0)
SETTERS(const double values[2], vec2f, VEC2F, values, 2, 0)
SETTERS(const double values[3], vec3f, VEC3F, values, 3, 0)
SETTERS(const double values[4], rotation, ROTATION, values, 4, 0)
SETTERS(const double values[3], color, COLOR, values, 3, 0)
SETTERS(const char* value, string, STRING, 0, 0, value)

/* --- members */

static void remove_member(WbFieldRef field, int index) {
  struct link_packet* out = world_command(LINK_REMOVE);
  link_int(out, field->number);
  link_int(out, index);
  command_end();
}

void wb_supervisor_field_remove_mf(WbFieldRef field, int index) {
  const char* function = "wb_supervisor_field_remove_mf";
  if (!may_ask_world(function)) return;
  if (!field || !(field->type & WB_MF)) {
    WARN("%s(): got %s, expected a list", function, field ? type_name(field->type) : "NULL");
    return;
  }
  if ((index = member(field, index, 0, function)) >= 0) remove_member(field, index);
}
void wb_supervisor_field_remove_mf_node(WbFieldRef field, int position) { wb_supervisor_field_remove_mf(field, position); }
void wb_supervisor_field_remove_sf(WbFieldRef field) {
  if (checked(field, WB_SF_NODE, "wb_supervisor_field_remove_sf")) remove_member(field, 0);
}

static void import(WbFieldRef field, WbFieldType type, int position, const char* text, const char* function) {
  struct link_record answer;
  struct link_packet* out;
  int number;
  if (!checked(field, type, function)) return;
  if (!text) {
    WARN("%s(): got NULL, expected a node's text", function);
    return;
  }
  if (strlen(text) > LINK_FLUSH_BYTES) {
    WARN("%s(): got a text of %zu bytes, expected at most %d", function, strlen(text), LINK_FLUSH_BYTES);
    return;
  }
  if (type & WB_MF) {
    /* -1 is the end */
    if ((position = member(field, position, 1, function)) < 0) return;
    if (position == field->count) position = -1;
  }
  out = world_command(LINK_IMPORT);
  link_int(out, field->number);
  link_int(out, position);
  link_text(out, text);
  number = ask_world(&answer, function);
  if (number == LINK_FIELD) take_count(field, (int)answer.ints[2]);
  if (number == LINK_NOTHING && !answer.texts[0].size) WARN("%s(): got a text that makes no node", function);
}

/* a file of the program's folder, to be freed; null, after a warning: it cannot be read */
static char* file_text(const char* name, const char* function) {
  FILE* file = name ? fopen(name, "rb") : 0;
  char* text = grow(0, LINK_FLUSH_BYTES + 2);
  size_t size = file ? fread(text, 1, LINK_FLUSH_BYTES + 1, file) : 0;
  if (file) fclose(file);
  text[size] = 0;
  if (file) return text;
  WARN("%s(): cannot read '%s': %s", function, name ? name : "", strerror(errno));
  free(text);
  return 0;
}

static void import_file(WbFieldRef field, WbFieldType type, int position, const char* name, const char* function) {
  char* text = file_text(name, function);
  if (text) import(field, type, position, text, function);
  free(text);
}

void wb_supervisor_field_import_mf_node_from_string(WbFieldRef field, int position, const char* node_string) {
  import(field, WB_MF_NODE, position, node_string, "wb_supervisor_field_import_mf_node_from_string");
}
void wb_supervisor_field_import_sf_node_from_string(WbFieldRef field, const char* node_string) {
  import(field, WB_SF_NODE, 0, node_string, "wb_supervisor_field_import_sf_node_from_string");
}
void wb_supervisor_field_import_mf_node(WbFieldRef field, int position, const char* filename) {
  import_file(field, WB_MF_NODE, position, filename, "wb_supervisor_field_import_mf_node");
}
void wb_supervisor_field_import_sf_node(WbFieldRef field, const char* filename) {
  import_file(field, WB_SF_NODE, 0, filename, "wb_supervisor_field_import_sf_node");
}
