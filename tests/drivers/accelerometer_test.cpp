// SPDX-License-Identifier: MIT
// The analogue accelerometer and its part of the ADC scan: counts, signs, limits and instants by hand.
#include "hal_sim/board/accelerometer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hal_sim/board/board.h"
#include "tests/board/flat_scene.h"
#include "tests/drivers/driven_board.h"
#include "tests/drivers/scan_times.h"

namespace {

using board::Board;
using board::Cycle;

board::Setup quiet() {
  board::Setup setup;
  setup.motion_noise_scale = 0;
  return setup;
}

TEST(Accelerometer, at_rest_on_the_level_zero_zero_and_one_g) {
  DrivenBoard robot(quiet());
  sim::Scene scene;
  robot.look_at(&scene);
  EXPECT_EQ(robot.convert(5, 1'000'000), 2048);
  EXPECT_EQ(robot.convert(6, 1'000'000), 2048);
  EXPECT_EQ(robot.convert(7, 1'000'000), 2048 + 768);
}

TEST(Accelerometer, the_lower_side_pulls_its_axis) {
  DrivenBoard robot(quiet());
  sim::Scene scene;
  robot.look_at(&scene);
  // 20 degrees nose down: the specific force leans backwards; 768 sin 20 = 262.67, 768 cos 20 = 721.68
  const double s = std::sin(sim::radians(20)), c = std::cos(sim::radians(20));
  scene.force_m_s2 = [=](sim::Clicks) { return sim::Vec3{-9.81 * s, 0, 9.81 * c}; };
  EXPECT_EQ(robot.convert(5, 1'000'000), 2048);
  EXPECT_EQ(robot.convert(6, 1'000'000), 2048 - 263);
  EXPECT_EQ(robot.convert(7, 1'000'000), 2048 + 722);
  // left side down
  scene.force_m_s2 = [=](sim::Clicks) { return sim::Vec3{0, -9.81 * s, 9.81 * c}; };
  EXPECT_EQ(robot.convert(5, 1'000'000), 2048 - 263);
  EXPECT_EQ(robot.convert(6, 1'000'000), 2048);
}

TEST(Accelerometer, output_ends_a_quarter_volt_from_the_supplies) {
  DrivenBoard robot(quiet());
  sim::Scene scene;
  robot.look_at(&scene);
  scene.force_m_s2 = [](sim::Clicks) { return sim::Vec3{-100, 100, 0}; };
  // 0.25 V of 3.3 V are 310.3 of 4096 counts
  EXPECT_EQ(robot.convert(6, 1'000'000), 310);
  EXPECT_EQ(robot.convert(5, 1'000'000), 3786);
}

TEST(Accelerometer, offset_of_the_robot_and_noise) {
  board::Setup setup = quiet();
  setup.acc_offset_m_s2 = {0.981, 0, -0.981};
  Board offset(setup);
  EXPECT_EQ(offset.convert(6, 1000), 2048 + 77);        // forward, 0.1 g = 76.8 counts
  EXPECT_EQ(offset.convert(5, 1000), 2048);             // left
  EXPECT_EQ(offset.convert(7, 1000), 2048 + 768 - 77);  // up
  Board noisy{board::Setup{}};
  double sum = 0, squares = 0;
  const int n = 4000;
  for (int i = 0; i < n; ++i) {
    const double d = noisy.convert(6, board::kSlowNoiseQuantum * i) - 2048.0;
    sum += d;
    squares += d * d;
  }
  // 350 ug/rtHz over pi/2 * 350 Hz: 8.21 mg, 6.30 counts, and rounding
  EXPECT_NEAR(sum / n, 0, 0.4);
  EXPECT_NEAR(std::sqrt(squares / n), std::sqrt(6.30 * 6.30 + 1.0 / 12), 0.3);
}

TEST(Accelerometer, one_pole_filter_delays_a_growing_force_by_its_time_constant) {
  DrivenBoard robot(quiet());
  sim::Scene scene;
  robot.look_at(&scene);
  // 10 m/s2 per second; felt one tick of 28800 clicks and one time constant late
  scene.force_m_s2 = [](sim::Clicks at) { return sim::Vec3{10 * sim::to_seconds(at), 0, 0}; };
  const Cycle at = board::kFcyHz;
  const double tau_s = 1 / (2 * sim::kPi * 350);
  EXPECT_NEAR(board::felt_force_m_s2(robot, at, 350).x, 10 * (1 - 28800.0 / board::kFcyHz - tau_s), 1e-6);
}

TEST(Accelerometer, revision_1_3_has_the_battery_on_the_z_channel) {
  board::Setup setup = quiet();
  setup.revision = board::Revision::Rev13;
  setup.battery_v = 3.4;
  DrivenBoard robot(setup);
  EXPECT_EQ(robot.convert(5, 1000), 0);
  EXPECT_EQ(robot.convert(7, 1000), 2070);
}

TEST(AccScan, samples_are_taken_every_65_interrupts_in_a_six_channel_frame) {
  DrivenBoard robot(quiet());
  sim::Scene scene;
  robot.look_at(&scene);
  // the force tells the instant: 1 count per 1000 cycles, on all axes (lag and filter shift it evenly)
  constexpr double kPerClick = 9.81 / 768 / 1000;
  scene.force_m_s2 = [](sim::Clicks at) {
    const double f = kPerClick * static_cast<double>(at);
    return sim::Vec3{f, f, f};
  };
  robot.scan().start(false, false, 0);
  const auto expected = [](int sample, int channel, double pole_hz) {
    // interrupt 65 k + 62 (from 0) ends a frame of six channels of 15 TAD of 10, held after the first
    const double end = static_cast<double>(scan_times::calls(0, 63)[62]) + 65.0 * scan_times::kFrame * sample;
    const double hold = end - ((6 - channel) * 15 - 1) * 10 - 1;
    const double tau = board::kFcyHz / (2 * sim::kPi * pole_hz);
    return 2048 + (hold - 28800 - tau) / 1000;
  };
  const Cycle first = scan_times::calls(0, 63)[62] + scan_times::kFiled;
  EXPECT_EQ(robot.scan().acc_until(0), first);
  const Cycle after = first + 3 * 65 * scan_times::kFrame + 5;
  const drivers::AdcScan::AccRing ring = robot.scan().acc_scan(after);
  EXPECT_EQ(robot.scan().clock().acc_samples(after), 4);
  for (int k = 0; k < 4; ++k) {
    const std::size_t slot = static_cast<std::size_t>(k + 1);
    EXPECT_NEAR(ring[0][slot], expected(k, 3, 350), 0.51) << k;
    EXPECT_NEAR(ring[1][slot], expected(k, 4, 350), 0.51) << k;
    EXPECT_NEAR(ring[2][slot], expected(k, 5, 150), 0.51) << k;
  }
  EXPECT_EQ(ring[0][0], 0);
  EXPECT_EQ(ring[0][5], 0);
  EXPECT_EQ(robot.scan().acc_until(after), first + 4 * 65 * scan_times::kFrame);
}

TEST(AccScan, a_sample_has_one_value_however_often_it_is_read) {
  board::Setup setup;  // with noise
  DrivenBoard looked(setup), late(setup);
  sim::Scene scene;
  looked.look_at(&scene);
  late.look_at(&scene);
  looked.scan().start(false, false, 0);
  late.scan().start(false, false, 0);
  const Cycle end = scan_times::kFrame * 65 * 60;  // 60 samples: the ring has been round
  for (Cycle at = 0; at < end; at += 12345) looked.scan().acc_scan(at);
  EXPECT_EQ(looked.scan().acc_scan(end), late.scan().acc_scan(end));
  // switching the converter off and on loses the frame under way and no sample
  looked.scan().switch_converter(false, end);
  EXPECT_EQ(looked.scan().acc_until(end), board::kNever);
  EXPECT_EQ(looked.scan().acc_scan(2 * end), late.scan().acc_scan(end));
}

}  // namespace
