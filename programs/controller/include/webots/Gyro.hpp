// SPDX-License-Identifier: MIT
// See webots/gyro.h.
#ifndef WB_GYRO_HPP
#define WB_GYRO_HPP

#include <webots/gyro.h>
#include "Device.hpp"

namespace webots {

class Gyro : public Device {
 public:
  explicit Gyro(WbDeviceTag tag) : Device(tag) {}
  explicit Gyro(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_GYRO; }
  virtual void enable(int samplingPeriod) { wb_gyro_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_gyro_disable(tag()); }
  int getSamplingPeriod() const { return wb_gyro_get_sampling_period(tag()); }
  const double* getValues() const { return wb_gyro_get_values(tag()); }
  int getLookupTableSize() const { return wb_gyro_get_lookup_table_size(tag()); }
  const double* getLookupTable() const { return wb_gyro_get_lookup_table(tag()); }
};

}  // namespace webots

#endif
