// SPDX-License-Identifier: MIT
// What is common to the devices of a robot; see webots/device.h. Classes are thin: each function is the
// one of C with the same name. Each device has one object, made when somebody asks for it and kept
// until the program ends.
#ifndef WB_DEVICE_HPP
#define WB_DEVICE_HPP

#include <webots/device.h>
#include <webots/robot.h>

// other libraries' headers bring these along, and programs rely on it
#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace webots {

class Device {
 public:
  explicit Device(WbDeviceTag tag) : tag_(tag) {}
  explicit Device(const std::string& name) : tag_(wb_robot_get_device(name.c_str())) {}
  virtual ~Device() {}
  std::string getName() const { return wb_device_get_name(tag_); }
  std::string getModel() const { return wb_device_get_model(tag_); }
  int getNodeType() const { return wb_device_get_node_type(tag_); }
  int getType() const { return getNodeType(); }
  WbDeviceTag getTag() const { return tag_; }

  // of this library: the device of a tag; null for 0 and for one of another kind
  template <class T>
  static T* of_tag(WbDeviceTag tag) {
    if (tag == 0 || !T::is_kind(wb_device_get_node_type(tag))) return 0;
    Device*& device = known()[tag];
    if (!device) device = new T(tag);
    return dynamic_cast<T*>(device);
  }
  static bool is_kind(int) { return true; }

 protected:
  WbDeviceTag tag() const { return tag_; }

 private:
  static std::map<int, Device*>& known() {
    static std::map<int, Device*>* devices = new std::map<int, Device*>();  // outlives every destructor
    return *devices;
  }
  WbDeviceTag tag_;
};

}  // namespace webots

#endif
