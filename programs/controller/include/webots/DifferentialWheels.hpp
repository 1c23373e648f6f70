// SPDX-License-Identifier: MIT
// A robot with two wheels, of versions up to R2018; see webots/differential_wheels.h.
#ifndef WB_DIFFERENTIALWHEELS_HPP
#define WB_DIFFERENTIALWHEELS_HPP

#include <webots/differential_wheels.h>

#include "Robot.hpp"

namespace webots {

class DifferentialWheels : public Robot {
 public:
  virtual void setSpeed(double left, double right) { wb_differential_wheels_set_speed(left, right); }
  double getLeftSpeed() const { return wb_differential_wheels_get_left_speed(); }
  double getRightSpeed() const { return wb_differential_wheels_get_right_speed(); }
  virtual void enableEncoders(int period) { wb_differential_wheels_enable_encoders(period); }
  virtual void disableEncoders() { wb_differential_wheels_disable_encoders(); }
  int getEncodersSamplingPeriod() const { return wb_differential_wheels_get_encoders_sampling_period(); }
  double getLeftEncoder() const { return wb_differential_wheels_get_left_encoder(); }
  double getRightEncoder() const { return wb_differential_wheels_get_right_encoder(); }
  virtual void setEncoders(double left, double right) { wb_differential_wheels_set_encoders(left, right); }
  double getMaxSpeed() const { return wb_differential_wheels_get_max_speed(); }
  double getSpeedUnit() const { return wb_differential_wheels_get_speed_unit(); }
};

}  // namespace webots

#endif
