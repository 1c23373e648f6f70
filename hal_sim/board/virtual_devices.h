// SPDX-License-Identifier: MIT
// Sensors that no robot has and that a supervisor defines: a number by name, which firmware reads through
// hal_sim/host/pins_virtual.h, and the numbers and lines that firmware tells in return. Set between ticks, so
// firmware sees a new value from the next tick on.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace board {

class VirtualDevices {
 public:
  /// Defines or changes a sensor. Call between ticks only.
  void set(const std::string& name, double value) { sensors_[name] = value; }
  /// No value: nobody defined it.
  std::optional<double> get(const std::string& name) const {
    const auto found = sensors_.find(name);
    return found == sensors_.end() ? std::nullopt : std::optional<double>(found->second);
  }
  const std::map<std::string, double>& sensors() const { return sensors_; }

  /// Called with every line that firmware writes to the simulator's console, without its newline; may be
  /// empty.
  std::function<void(const std::string&)> on_console;

 private:
  std::map<std::string, double> sensors_;
};

}  // namespace board
