// SPDX-License-Identifier: MIT
// A wheel's motor; see webots/motor.h.
#ifndef WB_MOTOR_HPP
#define WB_MOTOR_HPP

#include "Device.hpp"
#include "motor.h"

namespace webots {

class Motor : public Device {
 public:
  explicit Motor(WbDeviceTag tag) : Device(tag) {}
  virtual void setPosition(double position) { wb_motor_set_position(tag(), position); }
  virtual void setVelocity(double velocity) { wb_motor_set_velocity(tag(), velocity); }
  virtual void setAcceleration(double acceleration) { wb_motor_set_acceleration(tag(), acceleration); }
  virtual void setAvailableTorque(double torque) { wb_motor_set_available_torque(tag(), torque); }
  virtual void setAvailableForce(double force) { wb_motor_set_available_force(tag(), force); }
  virtual void setControlPID(double p, double i, double d) { wb_motor_set_control_pid(tag(), p, i, d); }
  double getTargetPosition() const { return wb_motor_get_target_position(tag()); }
  double getVelocity() const { return wb_motor_get_velocity(tag()); }
  double getMaxVelocity() const { return wb_motor_get_max_velocity(tag()); }
  double getMinPosition() const { return wb_motor_get_min_position(tag()); }
  double getMaxPosition() const { return wb_motor_get_max_position(tag()); }
  double getAcceleration() const { return wb_motor_get_acceleration(tag()); }
};

}  // namespace webots

#endif
