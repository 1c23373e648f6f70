// SPDX-License-Identifier: MIT
// A fault or stimulus as somebody asks for it, and the file that holds many:
//
//   [[fault]]                             [[stimulus]]
//   kind = "sensor_blocked"               send = "hello\r"      # or press, turn, move, pin, set, reset
//   robot = "e-puck"  # all without it    uart = 1
//   sensor = 0                            when = "x_m > 0.2"
//   at_s = 2.0
//   for_s = 1.5
//
// In: text. Out: faults whose values are in their ranges. What only a running world can tell (names of robots
// and variables, conditions) is told by the Injector.
#pragma once
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim_core/load/schema.h"
#include "sim_core/load/world_loader.h"

namespace faults {

inline constexpr double kForEver = std::numeric_limits<double>::infinity();

struct Fault {
  std::string kind;         ///< of kinds.h
  std::string robot = "*";  ///< "*": each of them
  std::map<std::string, sim::Value>
      values;               ///< by the kind's parameters; those left out have their usual one
  double at_s = 0;          ///< s, world time; with `when`: from which on it is looked for
  std::string when;         ///< a condition (hal_sim/signals); empty: at `at_s`
  double for_s = kForEver;  ///< s from its beginning on; kForEver: it stays
  std::string where;        ///< "faults.toml:3:1" for messages; may be empty

  /// Sets a number, or a word.
  Fault& set(const std::string& parameter, double value);
  Fault& set(const std::string& parameter, const std::string& value);
};

struct LoadedFaults {
  std::vector<Fault> faults;
  std::vector<sim::WorldProblem> problems;  ///< in the order of their places; then `faults` is not whole
  /// A line each, "file:line:column: ...".
  std::string report(std::string_view file) const;
};

/// Reads a file.
LoadedFaults load_faults(const std::string& path);
/// The same of text; `path` for messages.
LoadedFaults parse_faults(std::string_view text, const std::string& path);
/// "sensor_blocked sensor=0 at=2s for=1500ms", "bytes_sent bytes=\"go\" when='x_m > 0.2'": one fault in a
/// line, as the command line has it. False: `error` says why, "got ..., expected ...".
bool parse_fault_line(const std::string& line, Fault& fault, std::string& error);

}  // namespace faults
