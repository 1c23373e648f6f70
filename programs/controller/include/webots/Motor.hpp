// SPDX-License-Identifier: MIT
// See webots/motor.h.
#ifndef WB_MOTOR_HPP
#define WB_MOTOR_HPP

#include <webots/motor.h>
#include "Device.hpp"
#include "PositionSensor.hpp"

namespace webots {

class Motor : public Device {
 public:
  explicit Motor(WbDeviceTag tag) : Device(tag) {}
  explicit Motor(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_ROTATIONAL_MOTOR || kind == WB_NODE_LINEAR_MOTOR; }
  typedef enum { ROTATIONAL = 0, LINEAR } Type;
  virtual void setPosition(double position) { wb_motor_set_position(tag(), position); }
  virtual void setVelocity(double velocity) { wb_motor_set_velocity(tag(), velocity); }
  virtual void setAcceleration(double acceleration) { wb_motor_set_acceleration(tag(), acceleration); }
  virtual void setForce(double force) { wb_motor_set_force(tag(), force); }
  virtual void setTorque(double torque) { wb_motor_set_torque(tag(), torque); }
  virtual void setAvailableForce(double force) { wb_motor_set_available_force(tag(), force); }
  virtual void setAvailableTorque(double torque) { wb_motor_set_available_torque(tag(), torque); }
  virtual void setControlPID(double p) { setControlPID(p, 0, 0); }
  virtual void setControlPID(double p, double i, double d) { wb_motor_set_control_pid(tag(), p, i, d); }
  double getTargetPosition() const { return wb_motor_get_target_position(tag()); }
  double getMinPosition() const { return wb_motor_get_min_position(tag()); }
  double getMaxPosition() const { return wb_motor_get_max_position(tag()); }
  double getVelocity() const { return wb_motor_get_velocity(tag()); }
  double getMaxVelocity() const { return wb_motor_get_max_velocity(tag()); }
  double getAcceleration() const { return wb_motor_get_acceleration(tag()); }
  double getAvailableForce() const { return wb_motor_get_available_force(tag()); }
  double getMaxForce() const { return wb_motor_get_max_force(tag()); }
  double getAvailableTorque() const { return wb_motor_get_available_torque(tag()); }
  double getMaxTorque() const { return wb_motor_get_max_torque(tag()); }
  double getMultiplier() const { return wb_motor_get_multiplier(tag()); }
  void enableForceFeedback(int period) { wb_motor_enable_force_feedback(tag(), period); }
  void disableForceFeedback() { wb_motor_disable_force_feedback(tag()); }
  int getForceFeedbackSamplingPeriod() const { return wb_motor_get_force_feedback_sampling_period(tag()); }
  double getForceFeedback() const { return wb_motor_get_force_feedback(tag()); }
  void enableTorqueFeedback(int period) { wb_motor_enable_torque_feedback(tag(), period); }
  void disableTorqueFeedback() { wb_motor_disable_torque_feedback(tag()); }
  int getTorqueFeedbackSamplingPeriod() const { return wb_motor_get_torque_feedback_sampling_period(tag()); }
  double getTorqueFeedback() const { return wb_motor_get_torque_feedback(tag()); }
  Type getType() const { return static_cast<Type>(wb_motor_get_type(tag())); }
  PositionSensor* getPositionSensor() { return of_tag<PositionSensor>(wb_motor_get_position_sensor(tag())); }
  Brake* getBrake() { return of_tag<Brake>(wb_motor_get_brake(tag())); }
};

inline Motor* PositionSensor::getMotor() { return of_tag<Motor>(wb_position_sensor_get_motor(tag())); }
inline Brake* PositionSensor::getBrake() { return of_tag<Brake>(wb_position_sensor_get_brake(tag())); }

}  // namespace webots

#endif
