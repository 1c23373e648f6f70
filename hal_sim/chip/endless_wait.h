// SPDX-License-Identifier: MIT
// What is told of a program that waits for ever: what it waits for, and who writes that, by the text of its
// sources. Names are looked for as words; what happens by pointers is not seen.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hal_sim/host/runner.h"

namespace chip {

/// Global and static variables of the program in a line of its source.
std::vector<std::string> variables_in(const host::Runner& program, const host::Place& place);
/// Of an interrupt by its name in the library, "T1": is it enabled?
using IsEnabled = std::function<bool(const std::string& name)>;
/// A function in whose text a variable is written, or its address taken.
struct Writer {
  std::string function;
  std::string place;  ///< "main.c:8"
  std::string
      vector;  ///< of the interrupt that comes to it, "T1": its own, or timer 2's for an agenda; empty
  bool is_handler() const;
};
/// All of the sources beside `place`.
std::vector<Writer> writers_of(const std::string& variable, const host::Place& place);
/// Can nobody write what the line looks at, though some interrupts are enabled? True when all who do are
/// handlers, or functions of agendas, whose interrupts are not. What other functions write may be called.
bool is_written_by_none(const host::Runner& program, const host::Place& place, const IsEnabled& is_enabled);
/// Nothing that the loop at `place` looks at can change, since `since`, for no interrupt
/// that could is enabled.
board::Diagnosis endless_wait(const host::Runner& program, const host::Place& place, board::Cycle since);
/// It sleeps at `place` since `since`, and of the interrupts that are enabled, a bit each, none comes in Sleep.
board::Diagnosis endless_sleep(const std::string& place, std::uint64_t enabled, board::Cycle since);

}  // namespace chip
