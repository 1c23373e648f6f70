// SPDX-License-Identifier: MIT
// See webots/microphone.h.
#ifndef WB_MICROPHONE_HPP
#define WB_MICROPHONE_HPP

#include <webots/microphone.h>
#include "Device.hpp"

namespace webots {

class Microphone : public Device {
 public:
  explicit Microphone(WbDeviceTag tag) : Device(tag) {}
  explicit Microphone(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_MICROPHONE; }
  virtual void enable(int samplingPeriod) { wb_microphone_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_microphone_disable(tag()); }
  int getSamplingPeriod() const { return wb_microphone_get_sampling_period(tag()); }
  const void* getSampleData() const { return wb_microphone_get_sample_data(tag()); }
  int getSampleSize() const { return wb_microphone_get_sample_size(tag()); }
};

}  // namespace webots

#endif
