// SPDX-License-Identifier: MIT
// webots/supervisor.h over supervisor.h. Nodes are the root, the things of the world and its lamps; ids count
// from 1 in that order. Fields are made when they are asked for.
#include <webots/supervisor.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "supervisor/webots/shared.h"

enum class NodeKind { Root, Thing, Lamp };

struct WbNodeStructPrivate {
  NodeKind kind;
  int number;
  int id;
  std::string def;
  std::string custom_data;
  double position[3], orientation[9], velocity[6];
  std::vector<std::unique_ptr<WbFieldStructPrivate>> fields;
};

struct WbFieldStructPrivate {
  WbNodeRef node;
  std::string name;
  WbFieldType type;
  double values[4];
};

namespace {

using webots::warn;

bool is_nue() { return sv_webots_axes() == 1; }

/// All nodes, once the first is asked for.
std::vector<std::unique_ptr<WbNodeStructPrivate>>& nodes() {
  static std::vector<std::unique_ptr<WbNodeStructPrivate>> all;
  if (!all.empty()) return all;
  const auto add = [&](NodeKind kind, int number) {
    all.push_back(std::make_unique<WbNodeStructPrivate>());
    all.back()->kind = kind;
    all.back()->number = number;
    all.back()->id = static_cast<int>(all.size());
  };
  add(NodeKind::Root, 0);
  for (int thing = 0; thing < sv_things(); ++thing) add(NodeKind::Thing, thing);
  for (int lamp = 0; lamp < sv_lamps(); ++lamp) add(NodeKind::Lamp, lamp);
  return all;
}

WbNodeRef node_of(NodeKind kind, int number) {
  for (const auto& node : nodes())
    if (node->kind == kind && node->number == number) return node.get();
  return nullptr;
}

/// What a thing's or lamp's fields are called, and their types.
WbFieldType type_of(const WbNodeStructPrivate& node, const std::string& name) {
  switch (node.kind) {
    case NodeKind::Root:
      return name == "children" ? WB_MF_NODE : WB_NO_FIELD;
    case NodeKind::Thing:
      if (name == "translation") return WB_SF_VEC3F;
      if (name == "rotation") return WB_SF_ROTATION;
      if (name == "name" || name == "customData" || name == "data") return WB_SF_STRING;
      if (name == "controller") return node.number < sv_robots() ? WB_SF_STRING : WB_NO_FIELD;
      if (name == "baseColor" || name == "diffuseColor") return WB_SF_COLOR;
      if (name == "recognitionColors") return WB_MF_COLOR;
      return WB_NO_FIELD;
    case NodeKind::Lamp:
      if (name == "location") return WB_SF_VEC3F;
      if (name == "intensity") return WB_SF_FLOAT;
      if (name == "on") return WB_SF_BOOL;
      return WB_NO_FIELD;
  }
  return WB_NO_FIELD;
}

const char* type_words(WbFieldType type) {
  switch (type) {
    case WB_SF_BOOL:
      return "SFBool";
    case WB_SF_INT32:
      return "SFInt32";
    case WB_SF_FLOAT:
      return "SFFloat";
    case WB_SF_VEC2F:
      return "SFVec2f";
    case WB_SF_VEC3F:
      return "SFVec3f";
    case WB_SF_ROTATION:
      return "SFRotation";
    case WB_SF_COLOR:
      return "SFColor";
    case WB_SF_STRING:
      return "SFString";
    case WB_SF_NODE:
      return "SFNode";
    case WB_MF_COLOR:
      return "MFColor";
    case WB_MF_NODE:
      return "MFNode";
    default:
      return "";
  }
}

/// False, with a warning, for NULL and for a field of another type.
bool is(WbFieldRef field, WbFieldType type, const char* function) {
  if (field && field->type == type) return true;
  warn("%s: got %s, expected a field of type %s", function, field ? field->name.c_str() : "NULL",
       type_words(type));
  return false;
}

bool is_thing(WbNodeRef node, const char* function) {
  if (node && node->kind == NodeKind::Thing) return true;
  warn("%s: got %s, expected the node of a robot or an object", function, node ? "another node" : "NULL");
  return false;
}

sv_lamp lamp_of(WbFieldRef field) {
  sv_lamp lamp{};
  sv_get_lamp(field->node->number, &lamp);
  return lamp;
}

void to_axes(double x, double y, double z, double out[3]) {
  out[0] = x;
  out[1] = is_nue() ? z : y;
  out[2] = is_nue() ? -y : z;
}

const double nothing[9] = {};

}  // namespace

extern "C" {

// --- the simulation

void wb_supervisor_simulation_quit(int status) { sv_end(status, "simulation_quit(%d)", status); }
void wb_supervisor_simulation_reset(void) { webots::reset_all(); }
void wb_supervisor_simulation_revert(void) { webots::reset_all(); }
void wb_supervisor_world_reload(void) { webots::reset_all(); }
void wb_supervisor_simulation_reset_physics(void) { webots::rest_all(); }
void wb_supervisor_simulation_physics_reset(void) { webots::rest_all(); }
WbSimulationMode wb_supervisor_simulation_get_mode(void) { return WB_SUPERVISOR_SIMULATION_MODE_FAST; }
void wb_supervisor_simulation_set_mode(WbSimulationMode) {}

void wb_supervisor_set_label(int id, const char* text, double x, double y, double size, int color,
                             double transparency, const char*) {
  sv_label(id, text, x, y, size, static_cast<uint32_t>(color), transparency);
}
void wb_supervisor_export_image(const char* filename, int) {
  sv_picture(webots::picture_name(filename).c_str());
}

// --- nodes

WbNodeRef wb_supervisor_node_get_root(void) { return nodes().front().get(); }
WbNodeRef wb_supervisor_node_get_self(void) {
  warn("wb_supervisor_node_get_self: a supervisor has no body; NULL");
  return nullptr;
}
WbNodeRef wb_supervisor_node_get_from_def(const char* def) {
  WbNodeRef node = nullptr;
  if (const int thing = sv_find(def); thing >= 0) {
    node = node_of(NodeKind::Thing, thing);
  } else if (const int lamp = sv_find_lamp(def); lamp >= 0) {
    node = node_of(NodeKind::Lamp, lamp);
  } else {
    warn(
        "wb_supervisor_node_get_from_def: got '%s', expected the def or name of a robot, object or lamp; "
        "NULL",
        def ? def : "");
  }
  if (node) node->def = def;
  return node;
}
WbNodeRef wb_supervisor_node_get_from_id(int id) {
  return id >= 1 && id <= static_cast<int>(nodes().size()) ? nodes()[static_cast<std::size_t>(id - 1)].get()
                                                           : nullptr;
}
int wb_supervisor_node_get_id(WbNodeRef node) { return node ? node->id : -1; }
const char* wb_supervisor_node_get_def(WbNodeRef node) { return node ? node->def.c_str() : ""; }
const char* wb_supervisor_node_get_type_name(WbNodeRef node) {
  if (!node) return "";
  if (node->kind == NodeKind::Root) return "Group";
  if (node->kind == NodeKind::Lamp) return "PointLight";
  return node->number < sv_robots() ? "Robot" : "Solid";
}
const char* wb_supervisor_node_get_base_type_name(WbNodeRef node) {
  return wb_supervisor_node_get_type_name(node);
}

const double* wb_supervisor_node_get_position(WbNodeRef node) {
  if (!is_thing(node, "wb_supervisor_node_get_position")) return nothing;
  std::memcpy(node->position, webots::pose_of(node->number, is_nue()).position, sizeof node->position);
  return node->position;
}
const double* wb_supervisor_node_get_orientation(WbNodeRef node) {
  if (!is_thing(node, "wb_supervisor_node_get_orientation")) return nothing;
  const double angle = webots::pose_of(node->number, is_nue()).rotation[3];
  const double c = std::cos(angle), s = std::sin(angle);
  const double about_z[9] = {c, -s, 0, s, c, 0, 0, 0, 1}, about_y[9] = {c, 0, s, 0, 1, 0, -s, 0, c};
  std::memcpy(node->orientation, is_nue() ? about_y : about_z, sizeof node->orientation);
  return node->orientation;
}
const double* wb_supervisor_node_get_velocity(WbNodeRef node) {
  if (!is_thing(node, "wb_supervisor_node_get_velocity")) return nothing;
  sv_velocity v{};
  sv_get_velocity(node->number, &v);
  to_axes(v.x, v.y, v.z, node->velocity);
  to_axes(0, 0, v.spin, node->velocity + 3);
  return node->velocity;
}
const double* wb_supervisor_node_get_center_of_mass(WbNodeRef node) {
  return wb_supervisor_node_get_position(node);
}
void wb_supervisor_node_set_velocity(WbNodeRef node, const double v[6]) {
  if (!is_thing(node, "wb_supervisor_node_set_velocity")) return;
  const bool nue = is_nue();
  const sv_velocity velocity{v[0], nue ? -v[2] : v[1], nue ? v[1] : v[2], nue ? v[4] : v[5]};
  sv_set_velocity(node->number, &velocity);
}
void wb_supervisor_node_reset_physics(WbNodeRef node) {
  if (!is_thing(node, "wb_supervisor_node_reset_physics")) return;
  const sv_velocity none{};
  if (sv_is_movable(node->number)) sv_set_velocity(node->number, &none);
}
void wb_supervisor_node_restart_controller(WbNodeRef node) {
  if (is_thing(node, "wb_supervisor_node_restart_controller")) sv_restart(node->number);
}

// --- fields

WbFieldRef wb_supervisor_node_get_field(WbNodeRef node, const char* field_name) {
  const std::string name = field_name ? field_name : "";
  if (!node) {
    warn("wb_supervisor_node_get_field: got NULL for '%s', expected a node", name.c_str());
    return nullptr;
  }
  for (const auto& field : node->fields)
    if (field->name == name) return field.get();
  const WbFieldType type = type_of(*node, name);
  if (type == WB_NO_FIELD) {
    warn("wb_supervisor_node_get_field: a %s has no field '%s' here; NULL",
         wb_supervisor_node_get_type_name(node), name.c_str());
    return nullptr;
  }
  node->fields.push_back(std::make_unique<WbFieldStructPrivate>());
  *node->fields.back() = {node, name, type, {}};
  return node->fields.back().get();
}
const char* wb_supervisor_field_get_name(WbFieldRef field) { return field ? field->name.c_str() : ""; }
WbFieldType wb_supervisor_field_get_type(WbFieldRef field) { return field ? field->type : WB_NO_FIELD; }
const char* wb_supervisor_field_get_type_name(WbFieldRef field) {
  return field ? type_words(field->type) : "";
}
int wb_supervisor_field_get_count(WbFieldRef field) {
  if (field && field->type == WB_MF_NODE) return static_cast<int>(nodes().size()) - 1;
  return field && field->type == WB_MF_COLOR ? 1 : -1;
}

bool wb_supervisor_field_get_sf_bool(WbFieldRef field) {
  return is(field, WB_SF_BOOL, "wb_supervisor_field_get_sf_bool") && lamp_of(field).on;
}
int wb_supervisor_field_get_sf_int32(WbFieldRef field) {
  is(field, WB_SF_INT32, "wb_supervisor_field_get_sf_int32");
  return 0;
}
double wb_supervisor_field_get_sf_float(WbFieldRef field) {
  return is(field, WB_SF_FLOAT, "wb_supervisor_field_get_sf_float") ? lamp_of(field).intensity : 0;
}
const double* wb_supervisor_field_get_sf_vec2f(WbFieldRef field) {
  is(field, WB_SF_VEC2F, "wb_supervisor_field_get_sf_vec2f");
  return nothing;
}
const double* wb_supervisor_field_get_sf_vec3f(WbFieldRef field) {
  if (!is(field, WB_SF_VEC3F, "wb_supervisor_field_get_sf_vec3f")) return nothing;
  if (field->node->kind == NodeKind::Lamp) {
    const sv_lamp lamp = lamp_of(field);
    to_axes(lamp.x, lamp.y, lamp.z, field->values);
  } else {
    std::memcpy(field->values, webots::pose_of(field->node->number, is_nue()).position, 3 * sizeof(double));
  }
  return field->values;
}
const double* wb_supervisor_field_get_sf_rotation(WbFieldRef field) {
  if (!is(field, WB_SF_ROTATION, "wb_supervisor_field_get_sf_rotation")) return nothing;
  std::memcpy(field->values, webots::pose_of(field->node->number, is_nue()).rotation, 4 * sizeof(double));
  return field->values;
}
const double* wb_supervisor_field_get_sf_color(WbFieldRef field) {
  if (!is(field, WB_SF_COLOR, "wb_supervisor_field_get_sf_color")) return nothing;
  sv_get_colour(field->node->number, field->values);
  return field->values;
}
const char* wb_supervisor_field_get_sf_string(WbFieldRef field) {
  if (!is(field, WB_SF_STRING, "wb_supervisor_field_get_sf_string")) return "";
  if (field->name == "name") return sv_thing_name(field->node->number);
  if (field->name == "controller") return sv_firmware(field->node->number);
  return field->node->custom_data.c_str();
}
WbNodeRef wb_supervisor_field_get_sf_node(WbFieldRef field) {
  is(field, WB_SF_NODE, "wb_supervisor_field_get_sf_node");
  return nullptr;
}
const double* wb_supervisor_field_get_mf_color(WbFieldRef field, int index) {
  if (!is(field, WB_MF_COLOR, "wb_supervisor_field_get_mf_color") || index != 0) return nothing;
  sv_get_colour(field->node->number, field->values);
  return field->values;
}
WbNodeRef wb_supervisor_field_get_mf_node(WbFieldRef field, int index) {
  if (!is(field, WB_MF_NODE, "wb_supervisor_field_get_mf_node")) return nullptr;
  const int count = wb_supervisor_field_get_count(field);
  if (index < 0) index += count;  // from the end
  return index >= 0 && index < count ? nodes()[static_cast<std::size_t>(index + 1)].get() : nullptr;
}

void wb_supervisor_field_set_sf_bool(WbFieldRef field, bool value) {
  if (!is(field, WB_SF_BOOL, "wb_supervisor_field_set_sf_bool")) return;
  sv_lamp lamp = lamp_of(field);
  lamp.on = value;
  sv_set_lamp(field->node->number, &lamp);
}
void wb_supervisor_field_set_sf_int32(WbFieldRef field, int) {
  is(field, WB_SF_INT32, "wb_supervisor_field_set_sf_int32");
}
void wb_supervisor_field_set_sf_float(WbFieldRef field, double value) {
  if (!is(field, WB_SF_FLOAT, "wb_supervisor_field_set_sf_float")) return;
  sv_lamp lamp = lamp_of(field);
  lamp.intensity = value;
  sv_set_lamp(field->node->number, &lamp);
}
void wb_supervisor_field_set_sf_vec2f(WbFieldRef field, const double*) {
  is(field, WB_SF_VEC2F, "wb_supervisor_field_set_sf_vec2f");
}
void wb_supervisor_field_set_sf_vec3f(WbFieldRef field, const double v[3]) {
  if (!is(field, WB_SF_VEC3F, "wb_supervisor_field_set_sf_vec3f")) return;
  if (field->node->kind == NodeKind::Lamp) {
    sv_lamp lamp = lamp_of(field);
    lamp.x = v[0];
    lamp.y = is_nue() ? -v[2] : v[1];
    lamp.z = is_nue() ? v[1] : v[2];
    sv_set_lamp(field->node->number, &lamp);
    return;
  }
  webots::Pose pose = webots::pose_of(field->node->number, is_nue());
  std::memcpy(pose.position, v, sizeof pose.position);
  webots::put(field->node->number, pose, is_nue());
}
void wb_supervisor_field_set_sf_rotation(WbFieldRef field, const double v[4]) {
  if (!is(field, WB_SF_ROTATION, "wb_supervisor_field_set_sf_rotation")) return;
  webots::Pose pose = webots::pose_of(field->node->number, is_nue());
  std::memcpy(pose.rotation, v, sizeof pose.rotation);
  webots::put(field->node->number, pose, is_nue());
}
void wb_supervisor_field_set_sf_color(WbFieldRef field, const double v[3]) {
  if (is(field, WB_SF_COLOR, "wb_supervisor_field_set_sf_color"))
    sv_set_colour(field->node->number, v[0], v[1], v[2]);
}
void wb_supervisor_field_set_sf_string(WbFieldRef field, const char* value) {
  if (!is(field, WB_SF_STRING, "wb_supervisor_field_set_sf_string")) return;
  if (field->name == "name" || field->name == "controller") {
    warn("field '%s' of '%s' stays as it is", field->name.c_str(), sv_thing_name(field->node->number));
    return;
  }
  field->node->custom_data = value ? value : "";
}
void wb_supervisor_field_set_mf_color(WbFieldRef field, int index, const double v[3]) {
  if (is(field, WB_MF_COLOR, "wb_supervisor_field_set_mf_color") && index == 0)
    sv_set_colour(field->node->number, v[0], v[1], v[2]);
}
}
