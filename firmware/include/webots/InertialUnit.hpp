// SPDX-License-Identifier: MIT
// Roll, pitch and yaw; see webots/inertial_unit.h.
#ifndef WB_INERTIALUNIT_HPP
#define WB_INERTIALUNIT_HPP

#include "Device.hpp"
#include "inertial_unit.h"

namespace webots {

class InertialUnit : public Device {
 public:
  explicit InertialUnit(WbDeviceTag tag) : Device(tag) {}
  virtual void enable(int period) { wb_inertial_unit_enable(tag(), period); }
  virtual void disable() { wb_inertial_unit_disable(tag()); }
  int getSamplingPeriod() const { return wb_inertial_unit_get_sampling_period(tag()); }
  const double* getRollPitchYaw() const { return wb_inertial_unit_get_roll_pitch_yaw(tag()); }
};

}  // namespace webots

#endif
