// SPDX-License-Identifier: MIT
// Which instructions are translated together.
#pragma once
#include <string>
#include <vector>

#include "dspic30/core/cpu.h"

namespace dspic::translate {

/// One instruction of a stretch.
struct Item {
  std::ptrdiff_t place = 0;  ///< words from the head
  Decoded decoded{};
  Run plain = nullptr;
  std::uint32_t word = 0;
  int words = 1;
  int most_cycles = 0;
  bool is_last = false;  ///< it runs by the interpreter's function, and the stretch ends
};

/// The instructions from `head` on, as far as they were met and jumps lead; empty: not worth translating.
std::vector<Item> stretch(const Cpu& cpu, const Decoded* head);
/// Names a stretch: equal ones are translated alike.
std::string key_of(const Cpu& cpu, const std::vector<Item>& items);

}  // namespace dspic::translate
