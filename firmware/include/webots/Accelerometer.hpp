// SPDX-License-Identifier: MIT
// The accelerometer; see webots/accelerometer.h.
#ifndef WB_ACCELEROMETER_HPP
#define WB_ACCELEROMETER_HPP

#include "Device.hpp"
#include "accelerometer.h"

namespace webots {

class Accelerometer : public Device {
 public:
  explicit Accelerometer(WbDeviceTag tag) : Device(tag) {}
  virtual void enable(int period) { wb_accelerometer_enable(tag(), period); }
  virtual void disable() { wb_accelerometer_disable(tag()); }
  int getSamplingPeriod() const { return wb_accelerometer_get_sampling_period(tag()); }
  const double* getValues() const { return wb_accelerometer_get_values(tag()); }
};

}  // namespace webots

#endif
