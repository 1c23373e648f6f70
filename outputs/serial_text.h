// SPDX-License-Identifier: MIT
// What robots say on serial lines that nobody else takes, on the terminal: "puck: hello", a line at a time.
// Bytes that are no text are counted and not shown: pictures and binary protocols would bury the rest.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"

namespace outputs {

class SerialText {
 public:
  /// `say` gets a line without its end; called between ticks only.
  explicit SerialText(std::function<void(const std::string&)> say) : say_(std::move(say)) {}

  /// Listens to UART `port`, 1 or 2, of a robot, for as long as both live.
  void listen(twin::Twin& twin, int robot, int port);
  /// Between ticks: whole lines that have come.
  void show();
  /// What has come and is not shown yet never will be.
  void forget();
  /// At the end of a run: the rest, and how much was no text.
  void finish();

 private:
  struct Line {
    std::string prefix, name;  // "puck", or "puck uart2"; name as --uart wants it: "--uart2 puck"
    std::string text;          // come, not yet shown
    std::size_t binary = 0;    // bytes that were no text
  };
  void show(Line& line, bool all);

  std::function<void(const std::string&)> say_;
  std::vector<std::unique_ptr<Line>> lines_;  // UARTs keep pointers to the texts
};

}  // namespace outputs
