// SPDX-License-Identifier: MIT
// See webots/altimeter.h.
#ifndef WB_ALTIMETER_HPP
#define WB_ALTIMETER_HPP

#include <webots/altimeter.h>
#include "Device.hpp"

namespace webots {

class Altimeter : public Device {
 public:
  explicit Altimeter(WbDeviceTag tag) : Device(tag) {}
  explicit Altimeter(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_ALTIMETER; }
  virtual void enable(int samplingPeriod) { wb_altimeter_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_altimeter_disable(tag()); }
  int getSamplingPeriod() const { return wb_altimeter_get_sampling_period(tag()); }
  double getValue() const { return wb_altimeter_get_value(tag()); }
};

}  // namespace webots

#endif
