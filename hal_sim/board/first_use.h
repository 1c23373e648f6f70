// SPDX-License-Identifier: MIT
// Most programs use few of a robot's devices, and looking at the others would take much of a swarm's time:
// their memory has to be fetched. So a device says when it does something for the first time; before that it
// is as it was delivered, and nobody need look.
#pragma once

namespace board {

class FirstUse {
 public:
  /// Whoever looks; it outlives the device.
  void tell(bool& used) { used_ = &used; }
  void note() {
    if (used_) *used_ = true;
  }

 private:
  bool* used_ = nullptr;
};

}  // namespace board
