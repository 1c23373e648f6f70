// SPDX-License-Identifier: MIT
// The gyroscope; see webots/gyro.h.
#ifndef WB_GYRO_HPP
#define WB_GYRO_HPP

#include "Device.hpp"
#include "gyro.h"

namespace webots {

class Gyro : public Device {
 public:
  explicit Gyro(WbDeviceTag tag) : Device(tag) {}
  virtual void enable(int period) { wb_gyro_enable(tag(), period); }
  virtual void disable() { wb_gyro_disable(tag()); }
  int getSamplingPeriod() const { return wb_gyro_get_sampling_period(tag()); }
  const double* getValues() const { return wb_gyro_get_values(tag()); }
};

}  // namespace webots

#endif
