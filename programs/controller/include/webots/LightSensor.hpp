// SPDX-License-Identifier: MIT
// See webots/light_sensor.h.
#ifndef WB_LIGHTSENSOR_HPP
#define WB_LIGHTSENSOR_HPP

#include <webots/light_sensor.h>
#include "Device.hpp"

namespace webots {

class LightSensor : public Device {
 public:
  explicit LightSensor(WbDeviceTag tag) : Device(tag) {}
  explicit LightSensor(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_LIGHT_SENSOR; }
  virtual void enable(int samplingPeriod) { wb_light_sensor_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_light_sensor_disable(tag()); }
  int getSamplingPeriod() const { return wb_light_sensor_get_sampling_period(tag()); }
  double getValue() const { return wb_light_sensor_get_value(tag()); }
  int getLookupTableSize() const { return wb_light_sensor_get_lookup_table_size(tag()); }
  const double* getLookupTable() const { return wb_light_sensor_get_lookup_table(tag()); }
};

}  // namespace webots

#endif
