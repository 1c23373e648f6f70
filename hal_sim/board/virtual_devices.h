// SPDX-License-Identifier: MIT
// Sensors that no robot has and that a supervisor defines: a number by name, which firmware reads with
// twinpuck_virtual_sensor() (firmware/include/twinpuck/virtual.h), and the numbers and lines that firmware
// tells in return. Set between ticks, so firmware sees a new value from the next tick on.
#pragma once
#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

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

  /// Called with every line that firmware writes to the simulator's console, without its
  /// newline; may be empty.
  std::function<void(const std::string&)> on_console;

  /// Keys of a keyboard by Webots' numbers, and when each is down (s, world time). Set before the run.
  struct TypedKey {
    int key;
    double from_s, to_s;
  };
  std::vector<TypedKey> typed;

  // --- the console
  /// From the robot's own thread: text of firmware, on its way to on_console.
  void write(const char* text, std::size_t length) {
    if (text_.size() < kMostText) text_.append(text, length);
    if (somebody_writes_) somebody_writes_->store(true, std::memory_order_relaxed);
  }
  /// Between ticks: hands over what is complete; a long line in pieces.
  void deliver() { deliver_lines(kLongestLine); }
  /// At the end of a run: the rest as well.
  void deliver_rest() { deliver_lines(0); }
  /// Raised by write(): so that nobody need ask every robot at every tick.
  void tell(std::atomic<bool>* somebody_writes) { somebody_writes_ = somebody_writes; }

 private:
  static constexpr std::size_t kLongestLine = 1000;   // characters
  static constexpr std::size_t kMostText = 1u << 20;  // of one tick; more is lost

  void deliver_lines(std::size_t longest) {
    std::size_t begin = 0;
    while (begin < text_.size()) {
      const std::size_t end = text_.find('\n', begin);
      if (end == std::string::npos && text_.size() - begin <= longest) break;
      std::string line = text_.substr(begin, end == std::string::npos ? end : end - begin);
      line.erase(std::remove(line.begin(), line.end(), '\r'), line.end());
      if (on_console) on_console(line);
      begin = end == std::string::npos ? text_.size() : end + 1;
    }
    text_.erase(0, begin);
  }

  std::map<std::string, double> sensors_;
  std::string text_;
  std::atomic<bool>* somebody_writes_ = nullptr;
};

}  // namespace board
