// SPDX-License-Identifier: MIT
// See webots/receiver.h.
#ifndef WB_RECEIVER_HPP
#define WB_RECEIVER_HPP

#include <webots/receiver.h>
#include "Device.hpp"

namespace webots {

class Receiver : public Device {
 public:
  explicit Receiver(WbDeviceTag tag) : Device(tag) {}
  explicit Receiver(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_RECEIVER; }
  virtual void enable(int samplingPeriod) { wb_receiver_enable(tag(), samplingPeriod); }
  virtual void disable() { wb_receiver_disable(tag()); }
  int getSamplingPeriod() const { return wb_receiver_get_sampling_period(tag()); }
  enum { CHANNEL_BROADCAST = -1 };
  int getQueueLength() const { return wb_receiver_get_queue_length(tag()); }
  void nextPacket() { wb_receiver_next_packet(tag()); }
  const void* getData() const { return wb_receiver_get_data(tag()); }
  int getDataSize() const { return wb_receiver_get_data_size(tag()); }
  double getSignalStrength() const { return wb_receiver_get_signal_strength(tag()); }
  const double* getEmitterDirection() const { return wb_receiver_get_emitter_direction(tag()); }
  virtual void setChannel(int channel) { wb_receiver_set_channel(tag(), channel); }
  int getChannel() const { return wb_receiver_get_channel(tag()); }
};

}  // namespace webots

#endif
