// SPDX-License-Identifier: MIT
// Takes packets; see webots/receiver.h.
#ifndef WB_RECEIVER_HPP
#define WB_RECEIVER_HPP

#include "Device.hpp"
#include "receiver.h"

namespace webots {

class Receiver : public Device {
 public:
  static constexpr int CHANNEL_BROADCAST = -1;
  explicit Receiver(WbDeviceTag tag) : Device(tag) {}
  virtual void enable(int period) { wb_receiver_enable(tag(), period); }
  virtual void disable() { wb_receiver_disable(tag()); }
  int getSamplingPeriod() const { return wb_receiver_get_sampling_period(tag()); }
  int getQueueLength() const { return wb_receiver_get_queue_length(tag()); }
  void nextPacket() { wb_receiver_next_packet(tag()); }
  int getDataSize() const { return wb_receiver_get_data_size(tag()); }
  const void* getData() const { return wb_receiver_get_data(tag()); }
  double getSignalStrength() const { return wb_receiver_get_signal_strength(tag()); }
  const double* getEmitterDirection() const { return wb_receiver_get_emitter_direction(tag()); }
  void setChannel(int channel) { wb_receiver_set_channel(tag(), channel); }
  int getChannel() const { return wb_receiver_get_channel(tag()); }
};

}  // namespace webots

#endif
