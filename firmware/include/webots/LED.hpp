// SPDX-License-Identifier: MIT
// A light of the robot; see webots/led.h.
#ifndef WB_LED_HPP
#define WB_LED_HPP

#include "Device.hpp"
#include "led.h"

namespace webots {

class LED : public Device {
 public:
  explicit LED(WbDeviceTag tag) : Device(tag) {}
  virtual void set(int value) { wb_led_set(tag(), value); }
  int get() const { return wb_led_get(tag()); }
};

}  // namespace webots

#endif
