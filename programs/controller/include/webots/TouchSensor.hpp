// SPDX-License-Identifier: MIT
// See webots/touch_sensor.h.
#ifndef WB_TOUCHSENSOR_HPP
#define WB_TOUCHSENSOR_HPP

#include <webots/touch_sensor.h>
#include "Device.hpp"

namespace webots {

class TouchSensor : public Device {
 public:
  explicit TouchSensor(WbDeviceTag tag) : Device(tag) {}
  explicit TouchSensor(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_TOUCH_SENSOR; }
  virtual void enable(int samplingPeriod) { wb_touch_sensor_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_touch_sensor_disable(tag()); }
  int getSamplingPeriod() const { return wb_touch_sensor_get_sampling_period(tag()); }
  typedef enum { BUMPER = 0, FORCE, FORCE3D } Type;
  double getValue() const { return wb_touch_sensor_get_value(tag()); }
  const double* getValues() const { return wb_touch_sensor_get_values(tag()); }
  int getLookupTableSize() const { return wb_touch_sensor_get_lookup_table_size(tag()); }
  const double* getLookupTable() const { return wb_touch_sensor_get_lookup_table(tag()); }
  Type getType() const { return static_cast<Type>(wb_touch_sensor_get_type(tag())); }
};

}  // namespace webots

#endif
