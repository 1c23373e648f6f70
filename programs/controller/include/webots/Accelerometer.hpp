// SPDX-License-Identifier: MIT
// See webots/accelerometer.h.
#ifndef WB_ACCELEROMETER_HPP
#define WB_ACCELEROMETER_HPP

#include <webots/accelerometer.h>
#include "Device.hpp"

namespace webots {

class Accelerometer : public Device {
 public:
  explicit Accelerometer(WbDeviceTag tag) : Device(tag) {}
  explicit Accelerometer(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_ACCELEROMETER; }
  virtual void enable(int samplingPeriod) { wb_accelerometer_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_accelerometer_disable(tag()); }
  int getSamplingPeriod() const { return wb_accelerometer_get_sampling_period(tag()); }
  const double* getValues() const { return wb_accelerometer_get_values(tag()); }
  int getLookupTableSize() const { return wb_accelerometer_get_lookup_table_size(tag()); }
  const double* getLookupTable() const { return wb_accelerometer_get_lookup_table(tag()); }
};

}  // namespace webots

#endif
