// SPDX-License-Identifier: MIT
// The two wheels as motors of Webots on the library's motor driver: a speed, or a position that is approached
// with a speed in proportion to what is missing (10 a second for each radian [Webots: Motor.controlPID]),
// looked at every 20 ms, one wheel 10 ms after the other.
#pragma once
#include <array>
#include <cstdint>

#include "hal_sim/board/board.h"
#include "hal_sim/drivers/drivers.h"

namespace programs {

using board::Cycle;

inline constexpr int kWheelSteps = 1000;             ///< a turn [lib: motor_led/advance_one_timer/e_motors.h]
inline constexpr double kMostWheelRadS = 6.2831853;  ///< 1000 steps/s

class Wheels {
 public:
  Wheels(board::Board& board, drivers::AgendaTimer& agendas) : board_(board), agendas_(agendas) {}

  /// e_init_motors() and e_start_agendas_processing().
  void start(Cycle at);
  /// rad/s, any number; NaN is left out.
  void set_velocity(int wheel, double rad_s, Cycle at);
  /// rad since the start; infinite: turns on with its speed.
  void set_position(int wheel, double rad, Cycle at);
  /// What the motor was told to turn, rad since the start, in whole steps.
  double angle_rad(int wheel, Cycle at) const;
  void stop(Cycle at);

  /// When a position is looked at next; kNever: there is none.
  Cycle next_event() const { return next_; }
  void run(Cycle at);

 private:
  struct Wheel {
    double velocity_rad_s =
        kMostWheelRadS;    // of a position the most [Webots: Motor.velocity begins with the most]
    int command = 0;       // steps/s, what the motor was told
    bool is_free = false;  // there is no position
    std::int64_t target_steps = 0;
  };
  void command(int wheel, int steps_s, Cycle at);
  void approach(int wheel, Cycle at);

  board::Board& board_;
  drivers::AgendaTimer& agendas_;
  std::array<Wheel, 2> wheels_;
  Cycle next_ = board::kNever;
  int turn_ = 0;  // the wheel that is looked at next
};

}  // namespace programs
