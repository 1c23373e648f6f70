// SPDX-License-Identifier: MIT
// The true position; see webots/gps.h.
#ifndef WB_GPS_HPP
#define WB_GPS_HPP

#include "Device.hpp"
#include "gps.h"

namespace webots {

class GPS : public Device {
 public:
  explicit GPS(WbDeviceTag tag) : Device(tag) {}
  virtual void enable(int period) { wb_gps_enable(tag(), period); }
  virtual void disable() { wb_gps_disable(tag()); }
  int getSamplingPeriod() const { return wb_gps_get_sampling_period(tag()); }
  const double* getValues() const { return wb_gps_get_values(tag()); }
  double getSpeed() const { return wb_gps_get_speed(tag()); }
  const double* getSpeedVector() const { return wb_gps_get_speed_vector(tag()); }
};

}  // namespace webots

#endif
