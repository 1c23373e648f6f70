// SPDX-License-Identifier: MIT
// See webots/brake.h.
#ifndef WB_BRAKE_HPP
#define WB_BRAKE_HPP

#include <webots/brake.h>
#include "Device.hpp"

namespace webots {

class Brake : public Device {
 public:
  explicit Brake(WbDeviceTag tag) : Device(tag) {}
  explicit Brake(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_BRAKE; }
  typedef enum { ROTATIONAL = 0, LINEAR } Type;
  void setDampingConstant(double constant) const { wb_brake_set_damping_constant(tag(), constant); }
  Type getType() const { return static_cast<Type>(wb_brake_get_type(tag())); }
};

}  // namespace webots

#endif
