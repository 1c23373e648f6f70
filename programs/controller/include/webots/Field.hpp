// SPDX-License-Identifier: MIT
// A field of a node; see webots/supervisor.h.
#ifndef WB_FIELD_HPP
#define WB_FIELD_HPP

#include <webots/supervisor.h>

#include <map>
#include <string>

namespace webots {

class Node;

class Field {
 public:
  typedef enum {
    NO_FIELD = WB_NO_FIELD,
    SF_BOOL = WB_SF_BOOL,
    SF_INT32,
    SF_FLOAT,
    SF_VEC2F,
    SF_VEC3F,
    SF_ROTATION,
    SF_COLOR,
    SF_STRING,
    SF_NODE,
    MF = WB_MF,
    MF_BOOL,
    MF_INT32,
    MF_FLOAT,
    MF_VEC2F,
    MF_VEC3F,
    MF_ROTATION,
    MF_COLOR,
    MF_STRING,
    MF_NODE
  } Type;

  std::string getName() const { return wb_supervisor_field_get_name(field_); }
  Type getType() const { return static_cast<Type>(wb_supervisor_field_get_type(field_)); }
  std::string getTypeName() const { return wb_supervisor_field_get_type_name(field_); }
  int getCount() const { return wb_supervisor_field_get_count(field_); }
  Field* getActualField() const { return findField(wb_supervisor_field_get_actual_field(field_)); }
  void enableSFTracking(int samplingPeriod) {
    wb_supervisor_field_enable_sf_tracking(field_, samplingPeriod);
  }
  void disableSFTracking() { wb_supervisor_field_disable_sf_tracking(field_); }

  bool getSFBool() const { return wb_supervisor_field_get_sf_bool(field_); }
  int getSFInt32() const { return wb_supervisor_field_get_sf_int32(field_); }
  double getSFFloat() const { return wb_supervisor_field_get_sf_float(field_); }
  const double* getSFVec2f() const { return wb_supervisor_field_get_sf_vec2f(field_); }
  const double* getSFVec3f() const { return wb_supervisor_field_get_sf_vec3f(field_); }
  const double* getSFRotation() const { return wb_supervisor_field_get_sf_rotation(field_); }
  const double* getSFColor() const { return wb_supervisor_field_get_sf_color(field_); }
  std::string getSFString() const { return wb_supervisor_field_get_sf_string(field_); }
  Node* getSFNode() const;
  bool getMFBool(int index) const { return wb_supervisor_field_get_mf_bool(field_, index); }
  int getMFInt32(int index) const { return wb_supervisor_field_get_mf_int32(field_, index); }
  double getMFFloat(int index) const { return wb_supervisor_field_get_mf_float(field_, index); }
  const double* getMFVec2f(int index) const { return wb_supervisor_field_get_mf_vec2f(field_, index); }
  const double* getMFVec3f(int index) const { return wb_supervisor_field_get_mf_vec3f(field_, index); }
  const double* getMFRotation(int index) const { return wb_supervisor_field_get_mf_rotation(field_, index); }
  const double* getMFColor(int index) const { return wb_supervisor_field_get_mf_color(field_, index); }
  std::string getMFString(int index) const { return wb_supervisor_field_get_mf_string(field_, index); }
  Node* getMFNode(int index) const;

  void setSFBool(bool value) { wb_supervisor_field_set_sf_bool(field_, value); }
  void setSFInt32(int value) { wb_supervisor_field_set_sf_int32(field_, value); }
  void setSFFloat(double value) { wb_supervisor_field_set_sf_float(field_, value); }
  void setSFVec2f(const double values[2]) { wb_supervisor_field_set_sf_vec2f(field_, values); }
  void setSFVec3f(const double values[3]) { wb_supervisor_field_set_sf_vec3f(field_, values); }
  void setSFRotation(const double values[4]) { wb_supervisor_field_set_sf_rotation(field_, values); }
  void setSFColor(const double values[3]) { wb_supervisor_field_set_sf_color(field_, values); }
  void setSFString(const std::string& value) { wb_supervisor_field_set_sf_string(field_, value.c_str()); }
  void setMFBool(int index, bool value) { wb_supervisor_field_set_mf_bool(field_, index, value); }
  void setMFInt32(int index, int value) { wb_supervisor_field_set_mf_int32(field_, index, value); }
  void setMFFloat(int index, double value) { wb_supervisor_field_set_mf_float(field_, index, value); }
  void setMFVec2f(int index, const double values[2]) {
    wb_supervisor_field_set_mf_vec2f(field_, index, values);
  }
  void setMFVec3f(int index, const double values[3]) {
    wb_supervisor_field_set_mf_vec3f(field_, index, values);
  }
  void setMFRotation(int index, const double values[4]) {
    wb_supervisor_field_set_mf_rotation(field_, index, values);
  }
  void setMFColor(int index, const double values[3]) {
    wb_supervisor_field_set_mf_color(field_, index, values);
  }
  void setMFString(int index, const std::string& value) {
    wb_supervisor_field_set_mf_string(field_, index, value.c_str());
  }
  void insertMFBool(int index, bool value) { wb_supervisor_field_insert_mf_bool(field_, index, value); }
  void insertMFInt32(int index, int value) { wb_supervisor_field_insert_mf_int32(field_, index, value); }
  void insertMFFloat(int index, double value) { wb_supervisor_field_insert_mf_float(field_, index, value); }
  void insertMFVec2f(int index, const double values[2]) {
    wb_supervisor_field_insert_mf_vec2f(field_, index, values);
  }
  void insertMFVec3f(int index, const double values[3]) {
    wb_supervisor_field_insert_mf_vec3f(field_, index, values);
  }
  void insertMFRotation(int index, const double values[4]) {
    wb_supervisor_field_insert_mf_rotation(field_, index, values);
  }
  void insertMFColor(int index, const double values[3]) {
    wb_supervisor_field_insert_mf_color(field_, index, values);
  }
  void insertMFString(int index, const std::string& value) {
    wb_supervisor_field_insert_mf_string(field_, index, value.c_str());
  }
  void removeMF(int index) { wb_supervisor_field_remove_mf(field_, index); }
  void removeMFNode(int position) { removeMF(position); }
  void removeSF() { wb_supervisor_field_remove_sf(field_); }
  void importMFNode(int position, const std::string& file) {
    wb_supervisor_field_import_mf_node(field_, position, file.c_str());
  }
  void importMFNodeFromString(int position, const std::string& text) {
    wb_supervisor_field_import_mf_node_from_string(field_, position, text.c_str());
  }
  void importSFNode(const std::string& file) { wb_supervisor_field_import_sf_node(field_, file.c_str()); }
  void importSFNodeFromString(const std::string& text) {
    wb_supervisor_field_import_sf_node_from_string(field_, text.c_str());
  }

  // of this library: the object of a reference; null for null
  static Field* findField(WbFieldRef field) {
    static std::map<WbFieldRef, Field*>* known = new std::map<WbFieldRef, Field*>();
    if (!field) return 0;
    Field*& object = (*known)[field];
    if (!object) object = new Field(field);
    return object;
  }

 private:
  explicit Field(WbFieldRef field) : field_(field) {}
  WbFieldRef field_;
};

}  // namespace webots

#include "Node.hpp"

#endif
