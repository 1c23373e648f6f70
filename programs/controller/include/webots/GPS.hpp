// SPDX-License-Identifier: MIT
// See webots/gps.h.
#ifndef WB_GPS_HPP
#define WB_GPS_HPP

#include <webots/gps.h>
#include "Device.hpp"

namespace webots {

class GPS : public Device {
 public:
  explicit GPS(WbDeviceTag tag) : Device(tag) {}
  explicit GPS(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_GPS; }
  virtual void enable(int samplingPeriod) { wb_gps_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_gps_disable(tag()); }
  int getSamplingPeriod() const { return wb_gps_get_sampling_period(tag()); }
  typedef enum { LOCAL = 0, WGS84 } CoordinateSystem;
  const double* getValues() const { return wb_gps_get_values(tag()); }
  double getSpeed() const { return wb_gps_get_speed(tag()); }
  const double* getSpeedVector() const { return wb_gps_get_speed_vector(tag()); }
  CoordinateSystem getCoordinateSystem() const {
    return static_cast<CoordinateSystem>(wb_gps_get_coordinate_system(tag()));
  }
  static std::string convertToDegreesMinutesSeconds(double decimalDegrees) {
    return wb_gps_convert_to_degrees_minutes_seconds(decimalDegrees);
  }
};

}  // namespace webots

#endif
