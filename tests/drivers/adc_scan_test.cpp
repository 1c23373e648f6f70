// SPDX-License-Identifier: MIT
// The ADC scan and the basic proximity driver: instants by hand, and equality with plain
// ticked state machines.
#include "hal_sim/drivers/adc_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hal_sim/board/board.h"
#include "tests/board/flat_scene.h"
#include "tests/drivers/driven_board.h"
#include "tests/drivers/scan_times.h"

namespace {

using board::Board;
using board::Cycle;

using scan_times::kFiled;
using scan_times::kFrame;
using scan_times::kLight;
constexpr Cycle kSettled = kLight;  // after an interrupt: its samples can be seen, and its LED

/// A scene whose reflection tells sensor and time, so that a value reveals when it was taken.
void make_telling(sim::Scene& scene) {
  scene.reflection = [](int sensor, sim::Clicks at) {
    return 100.0 * (sensor + 1) + static_cast<double>(at / 7 % 997);
  };
  scene.irradiance_w_m2 = 0.25;  // dark = 4095 - 100
}

/// The library's interrupt, one at a time.
class TickedScan {
 public:
  TickedScan(const Board& robot, bool five_pairs) : robot_(robot), five_pairs_(five_pairs) {}

  int dark[10] = {}, lit[10] = {};
  unsigned pulses = 0;
  int mic_index = 0, acc_index = 0;
  bool filled = false;

  /// The interrupt at cycle `at`.
  void interrupt(Cycle at) {
    filled = false;
    if (++mic_index >= 100) {
      mic_index = 0;
      filled = true;
    }
    if (counter_ == 62) acc_index = acc_index == 49 ? 0 : acc_index + 1;
    if (counter_ == 63) {
      sample(dark, at, -1);
      pulses = 1u << pair_;
      lit_at_ = at + kLight;
    }
    if (counter_ == 3) {
      sample(lit, at, pulses ? lit_at_ : -1);
      pulses = 0;
      pair_ = pair_ == 3 ? (five_pairs_ ? 4 : 0) : pair_ == 4 ? 0 : pair_ + 1;
    }
    counter_ = counter_ == 64 ? 0 : counter_ + 1;
  }

 private:
  void sample(int* into, Cycle at, Cycle lit_at) {
    if (pair_ == 4) return;
    for (int half = 0; half < 2; ++half) {
      const Cycle when = at - (half ? scan_times::kFifth : scan_times::kFourth);
      const int sensor = pair_ + 4 * half;
      into[sensor] = robot_.ir().counts(sensor, when, lit_at < 0 ? -1 : when - lit_at);
    }
  }
  const Board& robot_;
  bool five_pairs_;
  int counter_ = 0;
  int pair_ = 0;
  Cycle lit_at_ = 0;
};

void expect_equal(DrivenBoard& robot, const TickedScan& want, Cycle at) {
  for (int sensor = 0; sensor < 8; ++sensor) {
    ASSERT_EQ(robot.scan().peek_dark(sensor, at), want.dark[sensor]) << sensor << " at " << at;
    ASSERT_EQ(robot.scan().peek_lit(sensor, at), want.lit[sensor]) << sensor << " at " << at;
  }
  ASSERT_EQ(robot.scan().pulses(at), want.pulses) << at;
  ASSERT_EQ(robot.scan().clock().interrupts(at) % 100, want.mic_index);
  ASSERT_EQ(robot.scan().clock().acc_samples(at) % 50, want.acc_index);
}

class Scan : public ::testing::TestWithParam<bool> {};

TEST_P(Scan, closed_form_equals_the_ticked_interrupt) {
  const bool five = GetParam();
  sim::Scene scene;
  make_telling(scene);
  board::Setup setup;
  setup.ir_noise_scale = 0;
  DrivenBoard robot(setup), reader(setup), program(setup);
  robot.look_at(&scene);
  reader.look_at(&scene);
  program.look_at(&scene);
  TickedScan want(robot, five);
  const Cycle start = 12345;
  robot.scan().start(false, five, start);
  reader.scan().start(false, five, start);
  program.scan().start(false, five, start);
  std::mt19937 random(7);
  for (const Cycle at : scan_times::calls(start, 3000)) {
    // just before the interrupt nothing has changed yet
    expect_equal(robot, want, at - 1);
    if (HasFatalFailure()) return;
    ASSERT_EQ(robot.scan().clock().next_interrupt(at - 1), at);
    want.interrupt(at);
    const Cycle seen = at + kSettled;
    expect_equal(robot, want, seen);
    if (HasFatalFailure()) return;
    // somebody who reads now and then gets the same values
    if (random() % 5 == 0) {
      const int sensor = static_cast<int>(random() % 8);
      ASSERT_EQ(reader.scan().dark(sensor, seen), want.dark[sensor]);
      ASSERT_EQ(reader.scan().lit(sensor, seen), want.lit[sensor]);
      ASSERT_EQ(program.scan().dark_less_lit(sensor, seen, seen + 5), want.dark[sensor] - want.lit[sensor]);
      // and the horizon never lies beyond the next change
      const Cycle horizon = reader.scan().pair(sensor, seen).until;
      ASSERT_GT(horizon, seen);
      ASSERT_EQ(reader.scan().peek_dark(sensor, horizon - 1), want.dark[sensor]);
      ASSERT_EQ(reader.scan().peek_lit(sensor, horizon - 1), want.lit[sensor]);
      ASSERT_TRUE(reader.scan().dark_number(sensor, horizon) != reader.scan().dark_number(sensor, seen) ||
                  reader.scan().lit_number(sensor, horizon) != reader.scan().lit_number(sensor, seen));
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Pairs, Scan, ::testing::Values(false, true));

TEST(AdcScan, survives_stops_and_starts_in_the_middle_of_anything) {
  sim::Scene scene;
  make_telling(scene);
  board::Setup setup;
  DrivenBoard robot(setup);
  robot.look_at(&scene);
  TickedScan want(robot, false);
  std::mt19937 random(11);
  Cycle now = 100;
  robot.scan().start(false, false, now);
  for (int round = 0; round < 300; ++round) {
    // some frames, and a part of one that is lost
    now += 15;
    const auto frames = static_cast<Cycle>(random() % 90);
    for (Cycle i = 0; i < frames; ++i) {
      now += i == 0 ? scan_times::kSequence : kFrame;
      want.interrupt(now);
    }
    const auto part = static_cast<Cycle>(random() % 870);
    now += part;
    // what is under way when the converter is stopped is filed all the same
    if (part >= kSettled) expect_equal(robot, want, now);
    if (HasFatalFailure()) return;
    if (random() % 2) {
      robot.scan().switch_converter(false, now);
      expect_equal(robot, want, now + 5'000'000);
      if (HasFatalFailure()) return;
      now += static_cast<Cycle>(random() % 100000);
      robot.scan().switch_converter(true, now);
    } else {
      robot.scan().start(false, false, now);
    }
  }
}

// a handler that is held off files the newest frame when it comes, and the frames before are lost
TEST(AdcScan, frames_that_come_while_the_handler_is_masked_are_lost_but_the_newest) {
  sim::Scene scene;
  make_telling(scene);
  DrivenBoard robot{board::Setup{}};
  robot.look_at(&scene);
  TickedScan want(robot, false);
  std::mt19937 random(5);
  robot.scan().start(false, false, 0);
  // the next call, and when the last one came
  Cycle next = 15 + scan_times::kSequence, call = 15, now = 0;
  for (int round = 0; round < 400; ++round) {
    for (auto frames = random() % 70; frames > 0; --frames) {
      want.interrupt(call = next);
      next = call + kFrame;
    }
    now = call + kSettled + static_cast<Cycle>(random() % (kFrame - kSettled));
    expect_equal(robot, want, now);
    if (HasFatalFailure()) return;
    const Cycle held = now;
    robot.scan().hold(held);
    robot.scan().hold(held + 10);  // masked twice: still since then
    now += static_cast<Cycle>(random() % 4000);
    expect_equal(robot, want, now);
    robot.scan().release(now);
    // the converter went on without a stop; one call comes now, however many sequences ended, and lists the
    // channels of the next one
    if (constexpr Cycle kInTime = 150; next + kInTime <= now) {
      want.interrupt(call = now);
      next = call + kFrame;
    } else if (next <= now) {
      want.interrupt(call = next);
      next = call + kFrame;
    }
    now = std::max(now, call + kSettled);
    expect_equal(robot, want, now);
    if (HasFatalFailure()) return;
  }
}

// 14,745,600 / 965 / 65 / 4: every sensor 59 times a second
TEST(AdcScan, refreshes_each_sensor_59_times_a_second) {
  DrivenBoard robot{board::Setup{}};
  robot.scan().start(false, false, 0);
  const Cycle second = 14'745'600;
  for (int sensor = 0; sensor < 8; ++sensor) {
    int changes = 0;
    for (Cycle at = robot.scan().pair(sensor, 2 * second).until; at <= 3 * second;
         at = robot.scan().pair(sensor, at).until)
      changes += robot.scan().lit_number(sensor, at) != robot.scan().lit_number(sensor, at - 1);
    EXPECT_NEAR(changes, 59, 1);
  }
}

// a flash lasts 5 interrupts, 4825 cycles; its samples are taken 349 and 169 cycles before the end of the
// last. They are filed 113 cycles after it.
TEST(AdcScan, flash_and_sample_instants) {
  sim::Scene scene;
  DrivenBoard robot{board::Setup{}};
  robot.look_at(&scene);
  robot.scan().start(false, false, 0);
  const auto calls = scan_times::calls(0, 70);
  const Cycle on = calls[63] + kLight, end = calls[68], off = end + kLight;  // the second pair's LED
  EXPECT_EQ(off - on, 4825);
  EXPECT_EQ(robot.scan().pulses(on - 1), 0u);
  EXPECT_EQ(robot.scan().pulses(on), 2u);
  EXPECT_EQ(robot.scan().pulses(off - 1), 2u);
  EXPECT_EQ(robot.scan().pulses(off), 0u);
  EXPECT_EQ(robot.scan().pulses_horizon(on), off);
  scene.asked.clear();
  robot.scan().lit(1, end + kFiled - 1);
  ASSERT_EQ(scene.asked.size(), 0u);
  robot.scan().lit(1, end + kFiled);
  robot.scan().lit(5, end + kFiled);
  ASSERT_EQ(scene.asked.size(), 2u);
  EXPECT_EQ(scene.asked[0].at, end - 349);
  EXPECT_EQ(scene.asked[1].at, end - 169);
}

TEST(AdcScan, initialisation_takes_209_ms) {
  DrivenBoard robot{board::Setup{}};
  robot.scan().start(false, false, 0);
  const Cycle filled = robot.scan().first_fill(0);
  EXPECT_NEAR(static_cast<double>(filled) / 14745.6, 208.3, 0.1);
  // at the end of the handler, which takes 161 cycles
  EXPECT_EQ(robot.scan().clock().acc_samples(filled - 161 + kFiled - 1), 48);
  EXPECT_EQ(robot.scan().clock().acc_samples(filled - 161 + kFiled), 49);
  EXPECT_EQ(robot.scan().first_fill(filled), filled);
}

TEST(AdcScan, microphones_alone_run_twice_as_fast) {
  sim::Scene scene;
  make_telling(scene);
  DrivenBoard robot{board::Setup{}};
  robot.look_at(&scene);
  robot.scan().start(true, false, 0);
  EXPECT_EQ(robot.scan().clock().interrupts(14'745'600 + 14), 32767);
  EXPECT_EQ(robot.scan().clock().interrupts(14'745'600 + 15), 32768);
  EXPECT_EQ(robot.scan().dark(0, 14'745'600), 0);
  EXPECT_EQ(robot.scan().clock().acc_samples(14'745'600), 0);
  EXPECT_EQ(robot.scan().first_fill(500), 500);  // returns at once
}

TEST(AdcScan, a_sample_never_changes_once_read) {
  sim::Scene scene;
  double value = 500;
  scene.reflection = [&](int, sim::Clicks) { return value; };
  DrivenBoard robot{board::Setup{}};
  robot.look_at(&scene);
  robot.scan().start(false, false, 0);
  const Cycle at = 300 * kFrame;
  const int first = robot.scan().lit(0, at);
  value = 900;
  EXPECT_EQ(robot.scan().lit(0, at + 10), first);
  EXPECT_NE(robot.scan().lit(0, at + 400 * kFrame), first);
}

TEST(IrCircuit, noise_depends_on_the_sample_and_on_nothing_else) {
  sim::Scene scene;
  scene.reflection = [](int, sim::Clicks) { return 1000.0; };
  scene.relative_noise = 0.05;
  board::Setup setup;
  setup.seed = 42;
  DrivenBoard a(setup), b(setup);
  a.look_at(&scene);
  b.look_at(&scene);
  a.scan().start(false, false, 0);
  b.scan().start(false, false, 0);
  double sum = 0, squares = 0;
  int count = 0;
  for (Cycle at = 600 * kFrame; at < 60000 * kFrame; at += 260 * kFrame) {
    // b skips most readings and asks for other sensors in between
    const int reading = a.scan().dark(0, at) - a.scan().lit(0, at);
    b.scan().lit(static_cast<int>(at % 7), at);
    if (count % 3 == 0) {
      EXPECT_EQ(b.scan().dark(0, at) - b.scan().lit(0, at), reading);
    }
    EXPECT_EQ(a.proximity_counts(0, at), reading);
    sum += reading;
    squares += 1.0 * reading * reading;
    ++count;
  }
  const double mean = sum / count;
  EXPECT_NEAR(mean, 1000, 12);
  EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 50, 8);
}

TEST(IrCircuit, more_light_gives_lower_counts_and_the_ends_clamp) {
  sim::Scene scene;
  board::Setup setup;
  setup.ir_gain[2] = 1.5;
  setup.ir_offset_counts[2] = 7;
  DrivenBoard robot(setup);
  EXPECT_EQ(robot.ir().counts(0, 0, -1), 4095);  // darkness without a world
  scene.irradiance_w_m2 = 1.0;
  robot.look_at(&scene);
  EXPECT_EQ(robot.ir().counts(0, 0, -1), 4095 - 400);
  scene.irradiance_w_m2 = 100;
  EXPECT_EQ(robot.ir().counts(0, 0, -1), 0);
  scene.irradiance_w_m2 = 0;
  scene.reflection = [](int, sim::Clicks) { return 1000.0; };
  EXPECT_EQ(robot.ir().counts(2, 0, 1'000'000), 4095 - 1507);
  // a flash of 1 us has hardly begun to act
  EXPECT_GT(robot.ir().counts(2, 0, 15), 4095 - 100);
  scene.reflection = [](int, sim::Clicks) { return 5000.0; };
  EXPECT_EQ(robot.ir().counts(2, 0, 1'000'000), 0);
}

TEST(IrCircuit, uniform_noise_fills_its_half_width_and_no_more) {
  sim::Scene scene;
  scene.reflection = [](int, sim::Clicks) { return 1000.0; };
  scene.relative_noise = 0.2;
  scene.uniform_noise = true;
  board::Setup setup;
  DrivenBoard robot(setup);
  robot.look_at(&scene);
  double sum = 0, squares = 0, least = 4095, most = 0;
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount; ++i) {
    const double reading = 4095 - robot.ir().counts(0, i * board::kSlowNoiseQuantum, 1'000'000);
    sum += reading, squares += reading * reading;
    least = std::min(least, reading), most = std::max(most, reading);
  }
  const double mean = sum / kCount;
  EXPECT_GE(least, 800);
  EXPECT_LE(most, 1200);
  EXPECT_LT(least, 805);
  EXPECT_GT(most, 1195);
  EXPECT_NEAR(mean, 1000, 6);
  EXPECT_NEAR(std::sqrt(squares / kCount - mean * mean), 200 / std::sqrt(3.0), 4);
}

TEST(IrCircuit, a_conversion_taken_apart_adds_up_to_its_counts) {
  sim::Scene scene;
  scene.irradiance_w_m2 = 0.5;
  scene.reflection = [](int, sim::Clicks) { return 1000.0; };
  scene.relative_noise = 0.1;
  board::Setup setup;
  setup.ir_gain[3] = 1.2;
  setup.ir_offset_counts[3] = 10;
  DrivenBoard robot(setup);
  robot.look_at(&scene);
  const board::IrConversion dark = robot.ir().conversion(3, 0, -1);
  EXPECT_EQ(dark.light_counts, 200);  // 0.5 W/m2 x 400
  EXPECT_EQ(dark.reflection_counts, 0);
  EXPECT_EQ(dark.counts(), 4095 - 200);
  // from the LED's switching to the hold of the fourth channel: 286 us
  const board::Cycle flash = drivers::scan_flash_cycles(3);
  EXPECT_EQ(flash, 4841 - kLight - 349);
  EXPECT_EQ(drivers::scan_flash_cycles(4), 4841 - kLight - 169);
  const board::IrConversion lit = robot.ir().conversion(3, 0, flash);
  EXPECT_EQ(lit.reflection_counts, 1200);
  EXPECT_EQ(lit.relative_noise, 0.1);  // told, and not drawn
  EXPECT_NEAR(lit.settled, 1, 2e-5);   // exp(-286 / 25)
  EXPECT_NEAR(lit.counts(), 4095 - 200 - 1210, 0.02);
  // one time constant: 63.2 % of it
  EXPECT_NEAR(robot.ir().conversion(3, 0, board::kIrSettleCycles).counts(), 4095 - 200 - 0.6321 * 1210, 0.5);
  scene.relative_noise = 0;
  EXPECT_EQ(robot.ir().counts(3, 0, flash), board::adc_counts(lit.counts()));
}

}  // namespace
