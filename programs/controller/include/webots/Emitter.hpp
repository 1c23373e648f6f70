// SPDX-License-Identifier: MIT
// See webots/emitter.h.
#ifndef WB_EMITTER_HPP
#define WB_EMITTER_HPP

#include <webots/emitter.h>
#include "Device.hpp"

namespace webots {

class Emitter : public Device {
 public:
  explicit Emitter(WbDeviceTag tag) : Device(tag) {}
  explicit Emitter(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_EMITTER; }
  enum { CHANNEL_BROADCAST = -1 };
  virtual int send(const void* data, int size) { return wb_emitter_send(tag(), data, size); }
  int getChannel() const { return wb_emitter_get_channel(tag()); }
  virtual void setChannel(int channel) { wb_emitter_set_channel(tag(), channel); }
  double getRange() const { return wb_emitter_get_range(tag()); }
  virtual void setRange(double range) { wb_emitter_set_range(tag(), range); }
  int getBufferSize() const { return wb_emitter_get_buffer_size(tag()); }
};

}  // namespace webots

#endif
