// SPDX-License-Identifier: MIT
// See webots/led.h.
#ifndef WB_LED_HPP
#define WB_LED_HPP

#include <webots/led.h>
#include "Device.hpp"

namespace webots {

class LED : public Device {
 public:
  explicit LED(WbDeviceTag tag) : Device(tag) {}
  explicit LED(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_LED; }
  virtual void set(int value) { wb_led_set(tag(), value); }
  int get() const { return wb_led_get(tag()); }
};

}  // namespace webots

#endif
