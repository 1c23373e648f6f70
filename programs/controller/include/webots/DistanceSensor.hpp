// SPDX-License-Identifier: MIT
// See webots/distance_sensor.h.
#ifndef WB_DISTANCESENSOR_HPP
#define WB_DISTANCESENSOR_HPP

#include <webots/distance_sensor.h>
#include "Device.hpp"

namespace webots {

class DistanceSensor : public Device {
 public:
  explicit DistanceSensor(WbDeviceTag tag) : Device(tag) {}
  explicit DistanceSensor(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_DISTANCE_SENSOR; }
  virtual void enable(int samplingPeriod) { wb_distance_sensor_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_distance_sensor_disable(tag()); }
  int getSamplingPeriod() const { return wb_distance_sensor_get_sampling_period(tag()); }
  typedef enum { GENERIC = 0, INFRA_RED, SONAR, LASER } Type;
  double getValue() const { return wb_distance_sensor_get_value(tag()); }
  double getMaxValue() const { return wb_distance_sensor_get_max_value(tag()); }
  double getMinValue() const { return wb_distance_sensor_get_min_value(tag()); }
  double getAperture() const { return wb_distance_sensor_get_aperture(tag()); }
  int getLookupTableSize() const { return wb_distance_sensor_get_lookup_table_size(tag()); }
  const double* getLookupTable() const { return wb_distance_sensor_get_lookup_table(tag()); }
  Type getType() const { return static_cast<Type>(wb_distance_sensor_get_type(tag())); }
};

}  // namespace webots

#endif
