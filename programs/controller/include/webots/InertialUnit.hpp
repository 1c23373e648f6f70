// SPDX-License-Identifier: MIT
// See webots/inertial_unit.h.
#ifndef WB_INERTIALUNIT_HPP
#define WB_INERTIALUNIT_HPP

#include <webots/inertial_unit.h>
#include "Device.hpp"

namespace webots {

class InertialUnit : public Device {
 public:
  explicit InertialUnit(WbDeviceTag tag) : Device(tag) {}
  explicit InertialUnit(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_INERTIAL_UNIT; }
  virtual void enable(int samplingPeriod) { wb_inertial_unit_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_inertial_unit_disable(tag()); }
  int getSamplingPeriod() const { return wb_inertial_unit_get_sampling_period(tag()); }
  const double* getRollPitchYaw() const { return wb_inertial_unit_get_roll_pitch_yaw(tag()); }
  const double* getQuaternion() const { return wb_inertial_unit_get_quaternion(tag()); }
  double getNoise() const { return wb_inertial_unit_get_noise(tag()); }
};

}  // namespace webots

#endif
