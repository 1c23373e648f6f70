// SPDX-License-Identifier: MIT
// A touch sensor; see webots/touch_sensor.h.
#ifndef WB_TOUCHSENSOR_HPP
#define WB_TOUCHSENSOR_HPP

#include "Device.hpp"
#include "touch_sensor.h"

namespace webots {

class TouchSensor : public Device {
 public:
  explicit TouchSensor(WbDeviceTag tag) : Device(tag) {}
  virtual void enable(int period) { wb_touch_sensor_enable(tag(), period); }
  virtual void disable() { wb_touch_sensor_disable(tag()); }
  int getSamplingPeriod() const { return wb_touch_sensor_get_sampling_period(tag()); }
  double getValue() const { return wb_touch_sensor_get_value(tag()); }
};

}  // namespace webots

#endif
