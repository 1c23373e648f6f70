// SPDX-License-Identifier: MIT
// A light sensor; see webots/light_sensor.h.
#ifndef WB_LIGHTSENSOR_HPP
#define WB_LIGHTSENSOR_HPP

#include "Device.hpp"
#include "light_sensor.h"

namespace webots {

class LightSensor : public Device {
 public:
  explicit LightSensor(WbDeviceTag tag) : Device(tag) {}
  virtual void enable(int period) { wb_light_sensor_enable(tag(), period); }
  virtual void disable() { wb_light_sensor_disable(tag()); }
  int getSamplingPeriod() const { return wb_light_sensor_get_sampling_period(tag()); }
  double getValue() const { return wb_light_sensor_get_value(tag()); }
};

}  // namespace webots

#endif
