// SPDX-License-Identifier: MIT
// Sends packets; see webots/emitter.h.
#ifndef WB_EMITTER_HPP
#define WB_EMITTER_HPP

#include "Device.hpp"
#include "emitter.h"

namespace webots {

class Emitter : public Device {
 public:
  static constexpr int CHANNEL_BROADCAST = -1;
  explicit Emitter(WbDeviceTag tag) : Device(tag) {}
  int send(const void* data, int size) { return wb_emitter_send(tag(), data, size); }
  void setChannel(int channel) { wb_emitter_set_channel(tag(), channel); }
  int getChannel() const { return wb_emitter_get_channel(tag()); }
  void setRange(double range) { wb_emitter_set_range(tag(), range); }
  double getRange() const { return wb_emitter_get_range(tag()); }
  int getBufferSize() const { return wb_emitter_get_buffer_size(tag()); }
};

}  // namespace webots

#endif
