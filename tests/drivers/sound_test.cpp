// SPDX-License-Identifier: MIT
// Microphones and codec, electrically: counts, instants of samples, the driver's buffers, groups of four,
// what the air is told. Expectations by hand beside each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hal_sim/board/sound_bank.h"
#include "hal_sim/drivers/sound_driver.h"
#include "sim_core/world/world_desc.h"
#include "tests/board/flat_scene.h"
#include "tests/drivers/driven_board.h"
#include "tests/drivers/scan_times.h"

namespace {

using board::Board;
using board::Cycle;

board::Setup quiet() {
  board::Setup setup;
  setup.mic_noise_counts = 0;
  return setup;
}

struct Microphones : ::testing::Test {
  DrivenBoard robot{quiet()};
  sim::Scene scene;
  Cycle now = 0;
  Microphones() { robot.look_at(&scene); }
  /// Samples of all three from number `from` on, those that a buffer still holds; how many there are so far.
  std::int64_t hear(std::int64_t from) {
    const std::int64_t count = robot.scan().clock().interrupts(now);
    for (std::int64_t n = std::max<std::int64_t>(from, count - 100); n < count; ++n)
      for (int m = 0; m < 3; ++m) robot.scan().mic_sample(m, n);
    return count;
  }
};

// 79.4 mV/Pa, 3.3 V for 4096 counts: 98.55 counts per Pa around 2048
TEST_F(Microphones, counts_follow_the_pressure_and_clip) {
  double pa = 0;
  scene.sound_pa = [&](const sim::Vec3&, sim::Clicks) { return pa; };
  robot.look_at(&scene);
  EXPECT_EQ(robot.ears().counts(0, 0), 2048);
  pa = 1;
  EXPECT_EQ(robot.ears().counts(0, 0), 2147);  // 2048 + 98.6
  pa = -10;
  EXPECT_EQ(robot.ears().counts(2, 0), 1062);  // 2048 - 985.5, to the nearest
  pa = 21;
  EXPECT_EQ(robot.ears().counts(1, 0), 4095);
  pa = -21;
  EXPECT_EQ(robot.ears().counts(1, 0), 0);
}

TEST_F(Microphones, sit_right_left_and_behind) {
  std::vector<sim::Vec3> asked;
  scene.sound_pa = [&](const sim::Vec3& at, sim::Clicks) { return asked.push_back(at), 0.0; };
  robot.look_at(&scene);
  for (int m = 0; m < 3; ++m) robot.ears().counts(m, 0);
  EXPECT_LT(asked[0].y, -0.03);
  EXPECT_GT(asked[1].y, 0.03);
  EXPECT_EQ(asked[0].y, -asked[1].y);
  EXPECT_LT(asked[2].x, -0.02);
  EXPECT_EQ(asked[2].y, 0);
}

TEST_F(Microphones, noise_has_its_size_and_is_the_robots_own) {
  board::Setup setup = quiet();
  setup.mic_noise_counts = 20;
  Board one(setup);
  setup.robot = 1;
  Board other(setup);
  double sum = 0, squares = 0, product = 0;
  for (Cycle n = 0; n < 10000; ++n) {
    const Cycle at = n * 450;  // as fast as the library samples
    const double a = one.ears().counts(0, at) - 2048, b = other.ears().counts(0, at) - 2048;
    sum += a, squares += a * a, product += a * b;
  }
  EXPECT_NEAR(sum / 10000, 0, 0.8);
  EXPECT_NEAR(std::sqrt(squares / 10000), 20, 0.5);
  EXPECT_NEAR(product / 10000, 0, 15);
}

// frames of three channels: a TAD of 20 cycles, a channel every 15 TAD, held after 1: cycles 20, 320, 620
TEST_F(Microphones, samples_are_held_at_the_converters_instants) {
  std::vector<sim::Clicks> held;
  scene.sound_pa = [&](const sim::Vec3&, sim::Clicks at) { return held.push_back(at), 0.0; };
  robot.look_at(&scene);
  now = 5000;
  robot.scan().start(false, false, now);
  const auto calls = scan_times::calls(5000, 65);
  now = calls[2];
  EXPECT_EQ(hear(0), 3);
  EXPECT_EQ(robot.scan().clock().next_interrupt(now), calls[3]);
  // three channels of 15 TAD of 20, held after the first; the flag a cycle after the end
  EXPECT_EQ(held, (std::vector<sim::Clicks>{5034, 5334, 5634, 5999, 6299, 6599, 6964, 7264, 7564}));
  // interrupt 3 delivers five channels (TAD 12), 62 six (TAD 10), 63 five again; 10 three
  EXPECT_EQ(robot.scan().mic_hold(1, 3), calls[3] - (4 * 15 - 1) * 12 - 1);
  EXPECT_EQ(robot.scan().mic_hold(0, 10), calls[10] - 44 * 20 - 1);
  EXPECT_EQ(robot.scan().mic_hold(1, 62), calls[62] - (5 * 15 - 1) * 10 - 1);
  EXPECT_EQ(robot.scan().mic_hold(2, 63), calls[63] - (3 * 15 - 1) * 12 - 1);
  EXPECT_EQ(robot.scan().mic_hold(2, 64), calls[64] - (15 - 1) * 20 - 1);
}

TEST_F(Microphones, alone_they_are_sampled_twice_as_often) {
  robot.scan().start(true, false, now);
  now = 15 + 1000 * 450;
  EXPECT_EQ(hear(1000), 1000);
  for (int n : {0, 3, 62, 63, 999}) EXPECT_EQ(robot.scan().mic_hold(1, n), 15 + (n + 1) * 450 - 29 * 10 - 1);
}

// stopped after 250 frames, started again 12345 cycles later in the fast mode: the last 100 samples keep
// their instants on both sides of the gap
TEST_F(Microphones, samples_before_a_stop_keep_their_instants) {
  robot.scan().start(false, false, now);
  now = scan_times::calls(0, 250).back() + 321;
  robot.scan().switch_converter(false, now);
  EXPECT_EQ(hear(250), 250);
  now += 12345;
  robot.scan().start(true, false, now);
  const Cycle again = now;
  now += 15 + 40 * 450;
  EXPECT_EQ(hear(290), 290);
  const auto calls = scan_times::calls(0, 250);
  EXPECT_EQ(robot.scan().mic_hold(0, 190), calls[190] - 44 * 20 - 1);  // 190 % 65 = 60: three channels
  EXPECT_EQ(robot.scan().mic_hold(0, 249), calls[249] - 44 * 20 - 1);  // 54
  EXPECT_EQ(robot.scan().mic_hold(0, 250), again + 15 + 450 - 44 * 10 - 1);
  EXPECT_EQ(robot.scan().mic_hold(0, 289), again + 15 + 40 * 450 - 44 * 10 - 1);
}

TEST_F(Microphones, single_conversions_hear_now) {
  scene.sound_pa = [&](const sim::Vec3& at, sim::Clicks when) { return when == 777 && at.y > 0 ? 2.0 : 0.0; };
  robot.look_at(&scene);
  now = 777;
  EXPECT_EQ(robot.convert(2, now), 2048);
  EXPECT_EQ(robot.convert(3, now), 2245);  // left: 2048 + 197.1
  EXPECT_EQ(robot.convert(4, now), 2048);
}

// --- codec

struct Speaker : Microphones {
  board::Codec& codec = robot.codec();
  drivers::SoundDriver driver{codec};
  const std::vector<std::int16_t>& bank = *board::sound_bank();
  void switch_on() {
    robot.pins().init(now);
    robot.pins().write_bit('F', 0, true, now);
    driver.start(now);
    codec.configure();
  }
};

TEST_F(Speaker, the_bank_has_five_sounds_and_silence_between) {
  ASSERT_EQ(bank.size(), 19044u);
  const int offset[] = {0, 2116, 3878, 7294, 11028}, length[] = {2112, 1760, 3412, 3732, 8016};
  std::vector<bool> sound(bank.size());
  for (int s = 0; s < 5; ++s) {
    int peak = 0;
    for (int i = offset[s]; i < offset[s] + length[s]; ++i) {
      peak = std::max(peak, std::abs(static_cast<int>(bank[static_cast<std::size_t>(i)])));
      sound[static_cast<std::size_t>(i)] = true;
    }
    EXPECT_NEAR(peak, 24000, 2);
  }
  for (std::size_t i = 0; i < bank.size(); ++i) {
    EXPECT_EQ(bank[i] & 1, 0);
    if (!sound[i]) {
      EXPECT_EQ(bank[i], 0) << i;
    }
  }
}

// frames begin at 100: groups at 100 + 8192 k. Played at 20000: the next group is k = 3, at 24676
TEST_F(Speaker, samples_go_out_in_groups_of_four) {
  now = 100;
  switch_on();
  now = 20000;
  EXPECT_EQ(driver.next_group(now), 100 + 3 * 8192);
  driver.play(2116, 1760, now);
  const Cycle begin = 24676;
  EXPECT_EQ(codec.output(begin - 1), 0);
  // the pointer moves before it is read: the first sample is number 2117
  EXPECT_EQ(codec.output(begin), bank[2117]);
  EXPECT_EQ(codec.output(begin + 2047), bank[2117]);
  EXPECT_EQ(codec.output(begin + 2048), bank[2118]);
  EXPECT_EQ(codec.output(begin + 1000 * 2048), bank[3117]);
  EXPECT_EQ(codec.output(begin + 1759 * 2048), bank[3876]);
  EXPECT_EQ(codec.output(begin + 1760 * 2048), 0);
}

TEST_F(Speaker, without_power_or_registers_it_is_silent) {
  driver.start(now);
  codec.configure();  // AUDIO_ON is low
  driver.play(0, 2112, now);
  for (Cycle c = 0; c < 100000; c += 1000) EXPECT_EQ(codec.output(c), 0);
  EXPECT_FALSE(codec.has_news());
  robot.pins().write_bit('F', 0, true,
                         now);  // an input after reset: nothing happens before the direction is set
  codec.configure();
  driver.play(0, 2112, now);
  EXPECT_FALSE(codec.has_news());
  switch_on();
  driver.play(0, 2112, now);
  EXPECT_TRUE(codec.has_news());
}

TEST_F(Speaker, closing_is_heard_at_once_and_starting_again_replaces) {
  switch_on();
  driver.play(7294, 3732, now);
  now = 100000;
  driver.play(11028, 8016, now);  // from the group at 106496 on
  EXPECT_EQ(codec.output(106495), bank[7295 + (106495 - 8192) / 2048]);
  EXPECT_EQ(codec.output(106496), bank[11029]);
  now = 300000;
  robot.pins().write_bit('F', 0, false, now);
  EXPECT_EQ(codec.output(299999), bank[11029 + (299999 - 106496) / 2048]);
  EXPECT_EQ(codec.output(300000), 0);
  codec.forget(299000);
  EXPECT_EQ(codec.output(299999), bank[11029 + (299999 - 106496) / 2048]);
  EXPECT_EQ(codec.output(300000), 0);
}

TEST_F(Speaker, a_stop_lets_the_group_under_way_end) {
  switch_on();
  driver.play(11028, 8016, now);
  now = 8192 * 5 + 3000;
  driver.stop(now);
  EXPECT_EQ(codec.output(8192 * 6 - 1), bank[11029 + 19]);  // five groups of four went out
  EXPECT_EQ(codec.output(8192 * 6), 0);
}

// the countdown is 16 bits wide and looks for zero: 2110 never meets it, 0 meets it after 65536 samples
TEST_F(Speaker, lengths_that_are_no_multiple_of_four_never_end) {
  switch_on();
  driver.play(0, 2110, now);
  EXPECT_EQ(codec.take_news().count, std::int64_t{1} << 40);
  EXPECT_EQ(codec.output(8192 + 3000 * 2048), bank[3001]);  // on into the next sound
  EXPECT_EQ(codec.output(8192 + 19043 * Cycle{2048}), 0);   // and past the bank
  driver.play(0, 0, now);
  EXPECT_EQ(codec.take_news().count, 65536);
  driver.play(0, -4, now);
  EXPECT_EQ(codec.take_news().count, 65532);
}

TEST_F(Speaker, tells_the_air_what_it_plays_in_world_time) {
  board::Setup setup = quiet();
  setup.robot = 3;
  setup.clock_ppm = 100;
  setup.boot_delay_s = 1;
  DrivenBoard late(setup);
  late.codec().power(true, 0);
  drivers::SoundDriver speaker(late.codec());
  speaker.start(0);
  late.codec().configure();
  speaker.play(3878, 3412, 14745600);
  sim::WorldDesc world;
  sim::SoundField field(world, 28800);
  sim::flat_sound().clear();
  ASSERT_TRUE(late.codec().has_news());
  late.publish_sound(field, 12345);
  EXPECT_FALSE(late.codec().has_news());
  ASSERT_EQ(sim::flat_sound().size(), 1u);
  const sim::Published& told = sim::flat_sound()[0];
  EXPECT_TRUE(told.plays);
  EXPECT_EQ(told.now, 12345);
  EXPECT_EQ(told.track.first, 3879);
  EXPECT_EQ(told.track.count, 3412);
  // 1801 groups of 8192 cycles at 14,747,074.56 Hz, one second after the world began
  EXPECT_NEAR(told.track.start_s, 1 + 1801 * 8192 / 14747074.56, 2e-7);
  EXPECT_NEAR(told.track.sample_s, 1 / 7200.72, 1e-12);
  EXPECT_NEAR(told.track.pa_per_unit * 32768 / std::sqrt(2.0), 0.0632, 1e-4);  // 70 dB at 1 m
  late.codec().reset(20000000);
  late.publish_sound(field, 20000);
  EXPECT_FALSE(sim::flat_sound().back().plays);
}

TEST_F(Speaker, state_changes_only_when_it_is_used) {
  const std::uint64_t before = robot.state_hash(0);
  codec.power(true, 0);
  codec.power(false, 0);
  EXPECT_EQ(robot.state_hash(0), before);
  driver.start(now);
  EXPECT_NE(robot.state_hash(0), before);
}

}  // namespace
