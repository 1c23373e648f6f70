// SPDX-License-Identifier: MIT
// A node of the world; see webots/supervisor.h.
#ifndef WB_NODE_HPP
#define WB_NODE_HPP

#include <webots/nodes.h>
#include <webots/supervisor.h>

#include <map>
#include <string>

#include "Field.hpp"

namespace webots {

class Node {
 public:
  typedef enum {
    NO_NODE = WB_NODE_NO_NODE,
    APPEARANCE,
    BACKGROUND,
    BILLBOARD,
    BOX,
    CAD_SHAPE,
    CAPSULE,
    COLOR,
    CONE,
    COORDINATE,
    CYLINDER,
    DIRECTIONAL_LIGHT,
    ELEVATION_GRID,
    FOG,
    GROUP,
    IMAGE_TEXTURE,
    INDEXED_FACE_SET,
    INDEXED_LINE_SET,
    MATERIAL,
    MESH,
    MUSCLE,
    NORMAL,
    PBR_APPEARANCE,
    PLANE,
    POINT_LIGHT,
    POINT_SET,
    POSE,
    SHAPE,
    SPHERE,
    SPOT_LIGHT,
    TEXTURE_COORDINATE,
    TEXTURE_TRANSFORM,
    TRANSFORM,
    VIEWPOINT,
    ROBOT,
    ACCELEROMETER,
    ALTIMETER,
    BRAKE,
    CAMERA,
    COMPASS,
    CONNECTOR,
    DISPLAY,
    DISTANCE_SENSOR,
    EMITTER,
    GPS,
    GYRO,
    INERTIAL_UNIT,
    LED,
    LIDAR,
    LIGHT_SENSOR,
    LINEAR_MOTOR,
    PEN,
    POSITION_SENSOR,
    PROPELLER,
    RADAR,
    RANGE_FINDER,
    RECEIVER,
    ROTATIONAL_MOTOR,
    SKIN,
    SPEAKER,
    TOUCH_SENSOR,
    VACUUM_GRIPPER,
    BALL_JOINT,
    BALL_JOINT_PARAMETERS,
    CHARGER,
    CONTACT_PROPERTIES,
    DAMPING,
    FLUID,
    FOCUS,
    HINGE_JOINT,
    HINGE_JOINT_PARAMETERS,
    HINGE_2_JOINT,
    IMMERSION_PROPERTIES,
    JOINT_PARAMETERS,
    LENS,
    LENS_FLARE,
    PHYSICS,
    RECOGNITION,
    SLIDER_JOINT,
    SLOT,
    SOLID,
    SOLID_REFERENCE,
    TRACK,
    TRACK_WHEEL,
    WORLD_INFO,
    ZOOM,
    MICROPHONE,
    RADIO
  } Type;

  int getId() const { return wb_supervisor_node_get_id(node_); }
  Type getType() const { return static_cast<Type>(wb_supervisor_node_get_type(node_)); }
  std::string getDef() const { return wb_supervisor_node_get_def(node_); }
  std::string getTypeName() const { return wb_supervisor_node_get_type_name(node_); }
  std::string getBaseTypeName() const { return wb_supervisor_node_get_base_type_name(node_); }
  bool isProto() const { return wb_supervisor_node_is_proto(node_); }
  Node* getParentNode() const { return findNode(wb_supervisor_node_get_parent_node(node_)); }
  Node* getFromProtoDef(const std::string& def) const {
    return findNode(wb_supervisor_node_get_from_proto_def(node_, def.c_str()));
  }
  int getNumberOfFields() const { return wb_supervisor_node_get_number_of_fields(node_); }
  int getProtoNumberOfFields() const { return getNumberOfFields(); }
  int getNumberOfBaseNodeFields() const { return getNumberOfFields(); }
  Field* getField(const std::string& name) const {
    return Field::findField(wb_supervisor_node_get_field(node_, name.c_str()));
  }
  Field* getProtoField(const std::string& name) const { return getField(name); }
  Field* getBaseNodeField(const std::string& name) const { return getField(name); }
  Field* getFieldByIndex(int index) const {
    return Field::findField(wb_supervisor_node_get_field_by_index(node_, index));
  }
  Field* getProtoFieldByIndex(int index) const { return getFieldByIndex(index); }
  Field* getBaseNodeFieldByIndex(int index) const { return getFieldByIndex(index); }

  const double* getPosition() const { return wb_supervisor_node_get_position(node_); }
  const double* getOrientation() const { return wb_supervisor_node_get_orientation(node_); }
  const double* getPose() const { return wb_supervisor_node_get_pose(node_, 0); }
  const double* getPose(const Node* from) const {
    return wb_supervisor_node_get_pose(node_, from ? from->node_ : 0);
  }
  const double* getCenterOfMass() const { return wb_supervisor_node_get_center_of_mass(node_); }
  const double* getContactPoint(int index) const {
    return wb_supervisor_node_get_contact_point(node_, index);
  }
  Node* getContactPointNode(int index) const {
    return findNode(wb_supervisor_node_get_contact_point_node(node_, index));
  }
  int getNumberOfContactPoints(bool includeDescendants = false) const {
    return wb_supervisor_node_get_number_of_contact_points(node_, includeDescendants);
  }
  WbContactPoint* getContactPoints(bool includeDescendants, int* size) const {
    return wb_supervisor_node_get_contact_points(node_, includeDescendants, size);
  }
  bool getStaticBalance() const { return wb_supervisor_node_get_static_balance(node_); }
  const double* getVelocity() const { return wb_supervisor_node_get_velocity(node_); }
  std::string exportString() const { return wb_supervisor_node_export_string(node_); }

  void setVelocity(const double velocity[6]) { wb_supervisor_node_set_velocity(node_, velocity); }
  void addForce(const double force[3], bool relative) {
    wb_supervisor_node_add_force(node_, force, relative);
  }
  void addForceWithOffset(const double force[3], const double offset[3], bool relative) {
    wb_supervisor_node_add_force_with_offset(node_, force, offset, relative);
  }
  void addTorque(const double torque[3], bool relative) {
    wb_supervisor_node_add_torque(node_, torque, relative);
  }
  void resetPhysics() { wb_supervisor_node_reset_physics(node_); }
  void restartController() { wb_supervisor_node_restart_controller(node_); }
  virtual void remove() { wb_supervisor_node_remove(node_); }
  void saveState(const std::string& name) { wb_supervisor_node_save_state(node_, name.c_str()); }
  void loadState(const std::string& name) { wb_supervisor_node_load_state(node_, name.c_str()); }
  void setJointPosition(double position, int index = 1) {
    wb_supervisor_node_set_joint_position(node_, position, index);
  }
  void moveViewpoint() const { wb_supervisor_node_move_viewpoint(node_); }
  void setVisibility(Node* from, bool visible) {
    wb_supervisor_node_set_visibility(node_, from ? from->node_ : 0, visible);
  }
  void enablePoseTracking(int period) { wb_supervisor_node_enable_pose_tracking(node_, period, 0); }
  void enablePoseTracking(int period, const Node* from) {
    wb_supervisor_node_enable_pose_tracking(node_, period, from ? from->node_ : 0);
  }
  void disablePoseTracking() { wb_supervisor_node_disable_pose_tracking(node_, 0); }
  void disablePoseTracking(const Node* from) {
    wb_supervisor_node_disable_pose_tracking(node_, from ? from->node_ : 0);
  }
  void enableContactPointsTracking(int period, bool includeDescendants = false) {
    wb_supervisor_node_enable_contact_points_tracking(node_, period, includeDescendants);
  }
  void disableContactPointsTracking() { wb_supervisor_node_disable_contact_points_tracking(node_); }

  // of this library: the object of a reference; null for null
  static Node* findNode(WbNodeRef node) {
    static std::map<WbNodeRef, Node*>* known = new std::map<WbNodeRef, Node*>();
    if (!node) return 0;
    Node*& object = (*known)[node];
    if (!object) object = new Node(node);
    return object;
  }

 private:
  explicit Node(WbNodeRef node) : node_(node) {}
  virtual ~Node() {}
  WbNodeRef node_;
};

inline Node* Field::getSFNode() const { return Node::findNode(wb_supervisor_field_get_sf_node(field_)); }
inline Node* Field::getMFNode(int index) const {
  return Node::findNode(wb_supervisor_field_get_mf_node(field_, index));
}

}  // namespace webots

#endif
