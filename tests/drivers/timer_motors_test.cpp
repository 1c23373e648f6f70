// SPDX-License-Identifier: MIT
// The drivers on Timers 4 and 5 and on Timer 3: rates by hand, and equality with ticked interrupts.
#include "hal_sim/drivers/timer_motors.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

namespace {

using board::Cycle;
using board::Stepper;
using board::Wheel;
using drivers::TimerMotors;
using Driver = drivers::TimerMotors::Driver;

constexpr Cycle kSecond = 14'745'600;

Stepper connected(Wheel wheel) {
  Stepper s(wheel == Wheel::Left ? -1 : 1);
  s.connect(true);
  return s;
}

// period (57600/|v| + 1) x 256 cycles: 1000 gives 58 units of 17.36 us, 993 steps/s
TEST(BasicMotors, rates_follow_the_timer) {
  struct Row {
    int speed;
    double steps_per_second;
  };
  for (const Row& row : {Row{1000, 993.1}, Row{500, 496.6}, Row{100, 99.83}, Row{10, 10.0},
                         Row{-1000, -993.1}, Row{2000, 1986.2}, Row{30000, 28800}}) {
    TimerMotors motors;
    Stepper motor = connected(Wheel::Left);
    motors.set_speed(Driver::Basic, Wheel::Left, row.speed, 0, motor);
    EXPECT_NEAR(static_cast<double>(motors.commanded_steps(Driver::Basic, Wheel::Left, kSecond, motor)),
                row.steps_per_second, 1.0)
        << row.speed;
  }
}

TEST(BasicMotors, each_command_restarts_the_period) {
  TimerMotors motors;
  Stepper motor = connected(Wheel::Right);
  for (Cycle at = 0; at < kSecond; at += 14'000)
    motors.set_speed(Driver::Basic, Wheel::Right, 1000, at, motor);
  EXPECT_EQ(motor.steps(), 0);  // a period is 14848 cycles
}

TEST(BasicMotors, coils_stay_on_while_running_and_go_off_at_zero) {
  TimerMotors motors;
  Stepper motor = connected(Wheel::Right);
  motors.set_speed(Driver::Basic, Wheel::Right, 100, 0, motor);
  motors.move(Wheel::Right, kSecond, motor);
  EXPECT_NE(motor.coils(), 0u);
  motors.set_speed(Driver::Basic, Wheel::Right, 0, kSecond, motor);
  EXPECT_EQ(motor.coils(), 0u);
  EXPECT_EQ(motors.steps_horizon(Wheel::Right, kSecond), board::kNever);
}

// ticks of 1536 cycles: 9600 / (10000 / 999) = 960 steps/s at most
TEST(Timer3Motors, rates_follow_the_tick) {
  for (const auto& [speed, rate] : {std::pair{999, 960}, std::pair{5000, 960}, std::pair{500, 480},
                                    std::pair{100, 96}, std::pair{-300, -290}}) {
    TimerMotors motors;
    Stepper motor = connected(Wheel::Left);
    motors.start_timer3(0);
    motors.set_speed(Driver::Timer3, Wheel::Left, speed, 0, motor);
    EXPECT_NEAR(static_cast<double>(motors.commanded_steps(Driver::Timer3, Wheel::Left, kSecond, motor)),
                rate, 1.0);
  }
}

/// Both drivers' interrupts written out, for one wheel.
struct Ticked {
  Stepper motor;
  explicit Ticked(Wheel wheel) : motor(connected(wheel)), is_left(wheel == Wheel::Left) {}
  bool is_left;
  int speed = 0, phase = 0;
  std::int64_t steps = 0;
  // basic
  bool on = false;
  Cycle next = 0, period = 0;
  // timer 3
  bool timer3 = false;
  int counter = 9999, reload = 9999;

  void step(Cycle at) {
    const int turn = is_left ? (speed > 0 ? -1 : 1) : (speed < 0 ? -1 : 1);
    steps += is_left ? -turn : turn;
    phase = (phase + turn + 4) % 4;
    motor.energise(board::kPhaseCoils[phase], at);
  }
  void run(Cycle until) {
    while (on && next <= until) {
      const Cycle at = next;
      next += period;
      if (!timer3) {
        step(at);
        continue;
      }
      if (speed != 0)
        --counter;
      else
        motor.set_coils_only(0);
      if (counter <= 0) {
        counter = reload;
        step(at);
      }
    }
  }
  void set_basic(int v, Cycle at) {
    run(at);
    if (v == 0) {
      on = false;
      motor.set_coils_only(0);
      return;
    }
    speed = v;
    period = (57600 / std::abs(v) + 1) * 256;
    next = at + period;
    on = true;
  }
  void set_timer3(int v, Cycle at) {
    run(at);
    if (v > 999) v = 999;
    if (v < -999) v = -999;
    reload = counter = v == 0 ? 9999 : 10000 / std::abs(v);
    speed = v;
  }
};

TEST(TimerMotors, closed_form_equals_the_ticked_interrupts) {
  std::mt19937 random(5);
  for (int run = 0; run < 2000; ++run) {
    const Wheel wheel = run % 2 ? Wheel::Left : Wheel::Right;
    const bool timer3 = run % 4 < 2;
    TimerMotors motors;
    Stepper motor = connected(wheel);
    Ticked want(wheel);
    if (timer3) {
      motors.start_timer3(0);
      want.timer3 = want.on = true;
      want.period = want.next = 1536;
    }
    Cycle now = 0;
    for (int i = 0; i < 40; ++i) {
      now += static_cast<Cycle>(random() % 5 * (random() % 100000));
      const int kind = static_cast<int>(random() % 6);
      if (kind == 0) {
        // the pins are written by hand meanwhile
        const unsigned coils = random() % 16;
        motors.move(wheel, now, motor);
        want.run(now);
        motor.energise(coils, now);
        want.motor.energise(coils, now);
      } else if (kind < 4) {
        const int v = kind == 1 ? 0 : static_cast<int>(random() % 2400) - 1200;
        motors.set_speed(timer3 ? Driver::Timer3 : Driver::Basic, wheel, v, now, motor);
        if (timer3)
          want.set_timer3(v, now);
        else
          want.set_basic(v, now);
      }
      now += static_cast<Cycle>(random() % 40000);
      want.run(now);
      Stepper seen = motor;
      motors.peek(wheel, now, seen);
      ASSERT_EQ(seen.steps(), want.motor.steps()) << run;
      ASSERT_EQ(seen.coils(), want.motor.coils()) << run;
      ASSERT_EQ(seen.position(now), want.motor.position(now)) << run;
      ASSERT_EQ(motors.commanded_steps(timer3 ? Driver::Timer3 : Driver::Basic, wheel, now, motor),
                want.steps);
    }
  }
}

}  // namespace
