// SPDX-License-Identifier: MIT
// What is common to the devices of a robot; see webots/device.h.
#ifndef WB_DEVICE_HPP
#define WB_DEVICE_HPP

#include <iostream>  // programs rely on it
#include <string>
#include "device.h"

namespace webots {

class Device {
 public:
  explicit Device(WbDeviceTag tag) : tag_(tag) {}
  virtual ~Device() {}
  std::string getName() const { return wb_device_get_name(tag_); }
  std::string getModel() const { return wb_device_get_model(tag_); }
  int getNodeType() const { return wb_device_get_node_type(tag_); }
  int getType() const { return getNodeType(); }
  int getTag() const { return tag_; }

 protected:
  WbDeviceTag tag() const { return tag_; }

 private:
  WbDeviceTag tag_;
};

}  // namespace webots

#endif
