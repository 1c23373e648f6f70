// SPDX-License-Identifier: MIT
// One robot's time line and pins for the page: what its processor did, and when chosen signals changed, as
// "trace" events (docs/connecting.md). Looking changes no course. It must go before the robot's program does.
#pragma once
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hal_sim/trace/robot_trace.h"
#include "hal_sim/twin/twin.h"

namespace viewer {

class TraceFeed {
 public:
  /// `signals`: names of docs/looking.md; empty: the usual ones. Throws std::runtime_error for a
  /// name that nothing has.
  TraceFeed(twin::Twin& twin, int robot, const std::vector<std::string>& signals);

  /// What happened since the last call, times in s; of many spans, or changes, only the last `most`.
  nlohmann::json take(std::size_t most);
  /// Forgets what is older than the last `most` spans, and changes: whoever takes late keeps no more than twice
  /// as many.
  void keep_last(std::size_t most);
  /// Spans and changes that take() would find.
  std::size_t kept() const;
  /// Robot and signals, for whoever must make another of it.
  int robot() const { return robot_; }
  const std::vector<std::string>& asked() const { return asked_; }

 private:
  twin::Twin& twin_;
  int robot_;
  std::vector<std::string> asked_;
  std::unique_ptr<trace::RobotTrace> trace_;
  std::map<std::uintptr_t, std::string> functions_;
  std::size_t forgotten_ = 0;  // spans and changes since the last take()
};

}  // namespace viewer
