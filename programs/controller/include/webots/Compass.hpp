// SPDX-License-Identifier: MIT
// See webots/compass.h.
#ifndef WB_COMPASS_HPP
#define WB_COMPASS_HPP

#include <webots/compass.h>
#include "Device.hpp"

namespace webots {

class Compass : public Device {
 public:
  explicit Compass(WbDeviceTag tag) : Device(tag) {}
  explicit Compass(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_COMPASS; }
  virtual void enable(int samplingPeriod) { wb_compass_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_compass_disable(tag()); }
  int getSamplingPeriod() const { return wb_compass_get_sampling_period(tag()); }
  const double* getValues() const { return wb_compass_get_values(tag()); }
  int getLookupTableSize() const { return wb_compass_get_lookup_table_size(tag()); }
  const double* getLookupTable() const { return wb_compass_get_lookup_table(tag()); }
};

}  // namespace webots

#endif
