// SPDX-License-Identifier: MIT
// A compass; see webots/compass.h.
#ifndef WB_COMPASS_HPP
#define WB_COMPASS_HPP

#include "Device.hpp"
#include "compass.h"

namespace webots {

class Compass : public Device {
 public:
  explicit Compass(WbDeviceTag tag) : Device(tag) {}
  virtual void enable(int period) { wb_compass_enable(tag(), period); }
  virtual void disable() { wb_compass_disable(tag()); }
  int getSamplingPeriod() const { return wb_compass_get_sampling_period(tag()); }
  const double* getValues() const { return wb_compass_get_values(tag()); }
};

}  // namespace webots

#endif
