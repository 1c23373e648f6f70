// SPDX-License-Identifier: MIT
// A serial line that ends in the program that runs the simulator: what the robot has sent, and bytes for it
// at chosen cycles.
#pragma once
#include <deque>
#include <string>
#include <vector>

#include "hal_sim/board/uart_end.h"

namespace board {

class MemoryEnd : public UartEnd {
 public:
  MemoryEnd() { set_idle(true); }
  void deliver(const std::uint8_t* bytes, const Cycle* ends, std::size_t count) override {
    text_.append(reinterpret_cast<const char*>(bytes), count);
    ends_.insert(ends_.end(), ends, ends + count);
  }
  std::size_t collect(std::uint8_t* bytes, std::size_t room, Cycle at) override {
    std::size_t count = 0;
    while (count < room && !waiting_.empty() && waiting_.front().at <= at) {
      bytes[count++] = waiting_.front().byte;
      waiting_.pop_front();
    }
    set_idle(waiting_.empty());
    return count;
  }
  std::string name() const override { return "memory"; }

  /// These bytes come from outside at cycle `at` (not before the last ones).
  void inject(const std::string& bytes, Cycle at) {
    for (char c : bytes) waiting_.push_back({static_cast<std::uint8_t>(c), at});
    set_idle(waiting_.empty());
    if (!is_idle() && wake) wake();
  }
  /// Everything the robot has sent so far.
  const std::string& text() const { return text_; }
  /// Cycle at which the i-th byte of text() ended.
  Cycle ended_at(std::size_t i) const { return ends_.at(i); }

 private:
  struct Waiting {
    std::uint8_t byte;
    Cycle at;
  };
  std::string text_;
  std::vector<Cycle> ends_;
  std::deque<Waiting> waiting_;
};

}  // namespace board
