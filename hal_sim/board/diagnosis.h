// SPDX-License-Identifier: MIT
// What board and chip have to say about the program that uses them: one entry per cause and place.
// docs/controllers.md is the list. A diagnosis never changes what the robot does.
#pragma once
#include <cstdint>
#include <string>

#include "hal_sim/board/cycle.h"

namespace board {

struct Diagnosis {
  std::string cause;       ///< "lost steps", "UART overrun", ...: the first column of docs/controllers.md
  std::string place;       ///< pins, register, bit or vector: "LATD0-3", "U1STA.OERR", "T2"
  std::string message;     ///< one sentence without a full stop
  std::string hint;        ///< what to do; empty when the sentence says it
  Cycle first = 0;         ///< cycle of the robot's clock at which it happened first
  double first_s = 0;      ///< the same as world time, s; set by host::Runner::diagnoses()
  std::int64_t count = 1;  ///< occurrences since power-up
};

}  // namespace board
