// SPDX-License-Identifier: MIT
// The world in C++; see webots/supervisor.h. A robot's program may look; what changes the world links in
// supervisors (docs/supervisor.md).
#ifndef WB_SUPERVISOR_HPP
#define WB_SUPERVISOR_HPP

#include <map>

#include "Robot.hpp"
#include "supervisor.h"

namespace webots {

class Field {
 public:
  explicit Field(WbFieldRef field) : field_(field) {}
  const double* getSFVec3f() const { return wb_supervisor_field_get_sf_vec3f(field_); }
  const double* getSFRotation() const { return wb_supervisor_field_get_sf_rotation(field_); }
  double getSFFloat() const { return wb_supervisor_field_get_sf_float(field_); }
  bool getSFBool() const { return wb_supervisor_field_get_sf_bool(field_); }
  std::string getSFString() const { return wb_supervisor_field_get_sf_string(field_); }
  const double* getSFColor() const { return wb_supervisor_field_get_sf_color(field_); }
  int getCount() const { return wb_supervisor_field_get_count(field_); }
  void setSFVec3f(const double values[3]) { wb_supervisor_field_set_sf_vec3f(field_, values); }
  void setSFRotation(const double values[4]) { wb_supervisor_field_set_sf_rotation(field_, values); }
  void setSFFloat(double value) { wb_supervisor_field_set_sf_float(field_, value); }
  void setSFBool(bool value) { wb_supervisor_field_set_sf_bool(field_, value); }
  void setSFString(const std::string& value) { wb_supervisor_field_set_sf_string(field_, value.c_str()); }
  void setSFColor(const double values[3]) { wb_supervisor_field_set_sf_color(field_, values); }

 private:
  WbFieldRef field_;
};

class Node {
 public:
  explicit Node(WbNodeRef node) : node_(node) {}
  ~Node() {
    for (auto& field : fields_) delete field.second;
  }
  const double* getPosition() const { return wb_supervisor_node_get_position(node_); }
  const double* getOrientation() const { return wb_supervisor_node_get_orientation(node_); }
  const double* getVelocity() const { return wb_supervisor_node_get_velocity(node_); }
  void setVelocity(const double velocity[6]) { wb_supervisor_node_set_velocity(node_, velocity); }
  void resetPhysics() { wb_supervisor_node_reset_physics(node_); }
  void restartController() { wb_supervisor_node_restart_controller(node_); }
  std::string getDef() const { return wb_supervisor_node_get_def(node_); }
  Field* getField(const std::string& name) {
    const auto known = fields_.find(name);
    if (known != fields_.end()) return known->second;
    const WbFieldRef field = wb_supervisor_node_get_field(node_, name.c_str());
    return field ? fields_[name] = new Field(field) : nullptr;
  }

 private:
  WbNodeRef node_;
  std::map<std::string, Field*> fields_;
};

class Supervisor : public Robot {
 public:
  ~Supervisor() override {
    for (auto& node : nodes_) delete node.second;
  }
  Node* getFromDef(const std::string& def) { return of_ref(wb_supervisor_node_get_from_def(def.c_str())); }
  Node* getSelf() { return of_ref(wb_supervisor_node_get_self()); }
  Node* getRoot() { return of_ref(wb_supervisor_node_get_root()); }
  void simulationQuit(int status) { wb_supervisor_simulation_quit(status); }
  void simulationReset() { wb_supervisor_simulation_reset(); }
  void simulationResetPhysics() { wb_supervisor_simulation_reset_physics(); }
  void simulationRevert() { wb_supervisor_simulation_revert(); }
  void worldReload() { wb_supervisor_world_reload(); }
  void setLabel(int id, const std::string& label, double x, double y, double size, int colour,
                double transparency, const std::string& font = "Arial") {
    wb_supervisor_set_label(id, label.c_str(), x, y, size, colour, transparency, font.c_str());
  }
  void exportImage(const std::string& file, int quality) const {
    wb_supervisor_export_image(file.c_str(), quality);
  }

 private:
  Node* of_ref(WbNodeRef ref) {
    if (!ref) return nullptr;
    Node*& node = nodes_[ref];
    if (!node) node = new Node(ref);
    return node;
  }
  std::map<WbNodeRef, Node*> nodes_;
};

}  // namespace webots

#endif
