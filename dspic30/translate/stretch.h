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
  bool is_last = false;                   ///< it runs by the interpreter's function, and the stretch ends
  bool is_host = false;                   ///< it calls a function of the host's: call_host()
  bool is_told = false;                   ///< the onlooker hears that it begins: tell()
  const KnownRoutine* routine = nullptr;  ///< that it calls
  std::ptrdiff_t routine_place = 0;       ///< words from the head
  int way = 0;                            ///< cycles from the call to there: a GOTO's
  bool returns = false;                   ///< RETURN or RETLW
  std::ptrdiff_t target = 0;              ///< of a GOTO or a call: words from the head
  int frame = 0;    ///< 0: the stretch itself; else the call that it belongs to (Item::callee)
  int callee = 0;   ///< frame of the function that it calls, whose instructions come next; 0: none
  int caller = -1;  ///< in a function that was called: which item called it
};

/// The instructions from `head` on, as far as they were met and jumps lead, with those of short functions
/// that they call, in the order of their course; empty: not worth translating.
std::vector<Item> stretch(const Cpu& cpu, const Decoded* head);
/// Names a stretch: equal ones are translated alike.
std::string key_of(const Cpu& cpu, const std::vector<Item>& items);

}  // namespace dspic::translate
