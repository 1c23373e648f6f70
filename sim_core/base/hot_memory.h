// SPDX-License-Identifier: MIT
// What one turn of a robot looks at, wherever it lies. In a large swarm a robot's turn comes when the PC's
// caches have long forgotten it, and line after line is waited for; told one turn ahead, they come together.
#pragma once
#include <array>
#include <cstddef>

#include "sim_core/base/check.h"

namespace sim {

class HotMemory {
 public:
  /// `bytes` from `at` on, which stay there; kMost parts at most.
  void add(const void* at, std::size_t bytes) {
    CHECK(count_ < kMost, "a turn has few parts");
    parts_[count_++] = {static_cast<const char*>(at), bytes};
  }
  void clear() { count_ = 0; }
  /// Asks the caches for all of it, and waits for none.
  void fetch() const {
    for (std::size_t i = 0; i < count_; ++i) ask(parts_[i]);
  }
  /// Asks for what fetch() looks at itself.
  void fetch_names() const { ask({reinterpret_cast<const char*>(this), sizeof *this}); }

  static constexpr std::size_t kLine = 64, kMost = 14;  // kLine: bytes of a cache line

 private:
  struct Part {
    const char* at = nullptr;
    std::size_t bytes = 0;
  };
  static void ask(const Part& part) {
    for (std::size_t b = 0; b < part.bytes + kLine - 1; b += kLine) __builtin_prefetch(part.at + b, 1);
  }
  std::size_t count_ = 0;
  std::array<Part, kMost> parts_;
};

}  // namespace sim
