// SPDX-License-Identifier: MIT
// How far a wheel has turned; see webots/position_sensor.h.
#ifndef WB_POSITIONSENSOR_HPP
#define WB_POSITIONSENSOR_HPP

#include "Device.hpp"
#include "position_sensor.h"

namespace webots {

class PositionSensor : public Device {
 public:
  explicit PositionSensor(WbDeviceTag tag) : Device(tag) {}
  virtual void enable(int period) { wb_position_sensor_enable(tag(), period); }
  virtual void disable() { wb_position_sensor_disable(tag()); }
  int getSamplingPeriod() const { return wb_position_sensor_get_sampling_period(tag()); }
  double getValue() const { return wb_position_sensor_get_value(tag()); }
};

}  // namespace webots

#endif
