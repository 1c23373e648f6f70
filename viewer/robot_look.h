// SPDX-License-Identifier: MIT
// What a page shows of a robot beside numbers: where its program stands, what its parts show, what the
// program got from its camera last. Looking changes nothing in the run.
#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "hal_sim/board/camera.h"
#include "hal_sim/twin/twin.h"

namespace viewer {

class RobotLook {
 public:
  /// `twin` outlives it.
  RobotLook(twin::Twin& twin, int robot);
  ~RobotLook();
  RobotLook(const RobotLook&) = delete;
  RobotLook& operator=(const RobotLook&) = delete;

  int robot() const { return robot_; }
  /// A `look` event; null when it would be the last one again.
  nlohmann::json take();
  /// The last one told; null: none yet.
  const nlohmann::json& last() const { return told_; }

 private:
  twin::Twin& twin_;
  int robot_;
  std::function<void(const board::CameraPicture&)> before_;  // who listened already
  board::CameraPicture picture_{};                           // columns 0: none yet
  std::int64_t packed_ = 0;                                  // its number, when pixels_ was made
  std::string pixels_;
  nlohmann::json told_;
};

}  // namespace viewer
