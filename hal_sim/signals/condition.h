// SPDX-License-Identifier: MIT
// A condition over named signals: "abs(x_m) < 0.3 && led0", "robot2.x_m - robot1.x_m > 0.1", "$state == 3".
//
//   text -> names of signals.h are looked up and bound -> muParser -> a number; not 0: it holds
//
//   + - * / ^  < <= > >= == !=  && || !  and or not  ?:  ( )    abs min max sqrt exp ln log10 sin cos tan
//   asin acos atan atan2 hypot floor ceil round sign mod (angles in rad), pi, true, false
//
// Looked at between ticks. All names are read at each look, whatever is decided before. A number that is none
// (0 / 0) holds nothing. Equal runs give equal answers, whoever looks.
#pragma once
#include <memory>
#include <string>

#include "hal_sim/twin/twin.h"

namespace signals {

class Condition {
 public:
  /// `robot`: whose a name is that stands without a robot's; -1: only the world's, and in a world of one
  /// robot that one's. Throws std::runtime_error, "got ..., expected ...", for what is no condition.
  Condition(const std::string& text, twin::Twin& twin, int robot = -1);
  ~Condition();
  Condition(Condition&&) noexcept;
  Condition& operator=(Condition&&) noexcept;

  const std::string& text() const { return text_; }
  /// As it stands now.
  double value(twin::Twin& twin) const;
  bool holds(twin::Twin& twin) const;

 private:
  struct Formula;
  std::string text_;
  std::unique_ptr<Formula> formula_;
};

}  // namespace signals
