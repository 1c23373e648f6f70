// SPDX-License-Identifier: MIT
// Every timing of the chip that the notes on the chip give as a number, and how the models are asked for
// theirs. One list for the test and for build/chip-timing.md.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "dspic30/memory/cycle.h"

namespace timing {

struct Case {
  std::string part;       ///< "Timers", "Converter" ...: heading of the document
  std::string what;       ///< what is measured, with its settings
  dspic::Cycle document;  ///< cycles by the formula of the notes, worked out here
  std::string formula;    ///< of the notes
  std::string doubt;      ///< empty: exact. Else why the number is not certain
  std::function<dspic::Cycle()> measure;
};

const std::vector<Case>& cases();
/// The file build/chip-timing.md, with what the models measure now.
std::string document();

}  // namespace timing
