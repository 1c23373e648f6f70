// SPDX-License-Identifier: MIT
// A distance sensor; see webots/distance_sensor.h.
#ifndef WB_DISTANCESENSOR_HPP
#define WB_DISTANCESENSOR_HPP

#include "Device.hpp"
#include "distance_sensor.h"

namespace webots {

class DistanceSensor : public Device {
 public:
  explicit DistanceSensor(WbDeviceTag tag) : Device(tag) {}
  virtual void enable(int period) { wb_distance_sensor_enable(tag(), period); }
  virtual void disable() { wb_distance_sensor_disable(tag()); }
  int getSamplingPeriod() const { return wb_distance_sensor_get_sampling_period(tag()); }
  double getValue() const { return wb_distance_sensor_get_value(tag()); }
  double getMaxValue() const { return wb_distance_sensor_get_max_value(tag()); }
  double getMinValue() const { return wb_distance_sensor_get_min_value(tag()); }
  double getAperture() const { return wb_distance_sensor_get_aperture(tag()); }
};

}  // namespace webots

#endif
