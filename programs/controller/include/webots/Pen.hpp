// SPDX-License-Identifier: MIT
// See webots/pen.h.
#ifndef WB_PEN_HPP
#define WB_PEN_HPP

#include <webots/pen.h>
#include "Device.hpp"

namespace webots {

class Pen : public Device {
 public:
  explicit Pen(WbDeviceTag tag) : Device(tag) {}
  explicit Pen(const std::string& name) : Device(name) {}
  static bool is_kind(int kind) { return kind == WB_NODE_PEN; }
  void write(bool on) { wb_pen_write(tag(), on); }
  void setInkColor(int color, double density) { wb_pen_set_ink_color(tag(), color, density); }
};

}  // namespace webots

#endif
