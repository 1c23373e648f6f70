// SPDX-License-Identifier: MIT
// See webots/connector.h.
#ifndef WB_CONNECTOR_HPP
#define WB_CONNECTOR_HPP

#include <webots/connector.h>
#include "Device.hpp"

namespace webots {

class Connector : public Device {
 public:
  explicit Connector(WbDeviceTag tag) : Device(tag) {}
  explicit Connector(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_CONNECTOR; }
  virtual void enablePresence(int period) { wb_connector_enable_presence(tag(), period); }
  virtual void disablePresence() { wb_connector_disable_presence(tag()); }
  int getPresenceSamplingPeriod() const { return wb_connector_get_presence_sampling_period(tag()); }
  int getPresence() const { return wb_connector_get_presence(tag()); }
  bool isLocked() const { return wb_connector_is_locked(tag()); }
  virtual void lock() { wb_connector_lock(tag()); }
  virtual void unlock() { wb_connector_unlock(tag()); }
};

}  // namespace webots

#endif
