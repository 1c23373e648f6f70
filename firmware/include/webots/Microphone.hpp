// SPDX-License-Identifier: MIT
// A microphone; see webots/microphone.h.
#ifndef WB_MICROPHONE_HPP
#define WB_MICROPHONE_HPP

#include "Device.hpp"
#include "microphone.h"

namespace webots {

class Microphone : public Device {
 public:
  explicit Microphone(WbDeviceTag tag) : Device(tag) {}
  virtual void enable(int period) { wb_microphone_enable(tag(), period); }
  virtual void disable() { wb_microphone_disable(tag()); }
  int getSamplingPeriod() const { return wb_microphone_get_sampling_period(tag()); }
  const void* getSampleData() const { return wb_microphone_get_sample_data(tag()); }
  int getSampleSize() const { return wb_microphone_get_sample_size(tag()); }
};

}  // namespace webots

#endif
