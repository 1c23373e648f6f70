// SPDX-License-Identifier: MIT
#include <chrono>
#include <thread>
#include <vector>

#include "tests/host/bench.h"

using namespace host_test;

TEST(CompiledRunner, globals_of_a_thousand_robots_of_one_image_stay_private) {
  auto image = open_image("hand_busy");
  std::vector<std::unique_ptr<BenchRobot>> robots;
  for (int i = 0; i < 1000; ++i)
    robots.push_back(std::make_unique<BenchRobot>(image, "r" + std::to_string(i)));
  for (int i = 0; i < 1000; ++i) robots[static_cast<std::size_t>(i)]->robot.run_until(28'800 + 100 * i);
  // a round costs 10 cycles: each robot counts its own, start-up code included
  for (int i = 0; i < 1000; ++i)
    EXPECT_NEAR(static_cast<double>(robots[static_cast<std::size_t>(i)]->variable("rounds")),
                (27'800 + 100 * i) / 10, 2)
        << i;
}

TEST(CompiledRunner, a_waiting_robot_costs_no_time) {
  BenchRobot r(open_image("hand_idle"));
  const auto before = std::chrono::steady_clock::now();
  r.run(1000 * kSecond);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - before;
  EXPECT_LT(wall.count(), 10);  // 512,000 windows; spinning would take an hour
  EXPECT_EQ(r.robot.cycles(), 1000 * kSecond);
  EXPECT_EQ(r.variable("started"), 42);
}

TEST(CompiledRunner, a_timer_comes_on_time_without_drift) {
  BenchRobot r(open_image("hand_ticker"));
  r.run(100 * kSecond + 100);
  EXPECT_EQ(r.variable("ticks"), 10'000);
  EXPECT_LE(r.variable("worst_late"), 40);  // entry 20, the block of 5, and at most one round of the wait
}

TEST(CompiledRunner, results_do_not_depend_on_the_window) {
  auto image = open_image("hand_ticker");
  BenchRobot a(image, "a"), b(image, "b", 1);
  a.run(kSecond);
  b.robot.run_until(kSecond);
  EXPECT_EQ(a.variable("ticks"), b.variable("ticks"));
  EXPECT_EQ(a.variable("worst_late"), b.variable("worst_late"));
  EXPECT_EQ(a.robot.hash(), b.robot.hash());
}

TEST(CompiledRunner, interrupts_nest_by_priority_and_equals_wait) {
  BenchRobot r(open_image("hand_nested"));
  r.run(50'000);
  const auto text = r.robot.read_variable("log_text", 32);
  EXPECT_STREQ(text.data(), "ahAe");
}

TEST(CompiledRunner, a_program_s_own_timer_interrupt_runs_through_registers) {
  BenchRobot r(open_image("hand_registers"));
  r.run(kSecond + 5000);
  EXPECT_EQ(r.variable("fired"), 100);
  EXPECT_EQ(r.board.leds(r.robot.cycles()) & 1, 0u);  // toggled an even number of times
  r.run(147'456);
  EXPECT_EQ(r.board.leds(r.robot.cycles()) & 1, 1u);
}

TEST(CompiledRunner, background_work_slows_the_main_program_by_its_share) {
  auto image = open_image("hand_busy");
  BenchRobot plain(image, "plain"), loaded(image, "loaded");
  plain.run(28'800);
  loaded.run(28'800);
  // a quarter of the processor is stolen from now on; called as firmware would, between two windows
  loaded.robot.set_background(3, 1000, 250);
  const auto before_plain = plain.variable("rounds"), before_loaded = loaded.variable("rounds");
  plain.run(kSecond);
  loaded.run(kSecond);
  const double ratio = static_cast<double>(loaded.variable("rounds") - before_loaded) /
                       static_cast<double>(plain.variable("rounds") - before_plain);
  EXPECT_NEAR(ratio, 0.75, 0.0005);
}

TEST(CompiledRunner, robots_of_two_copies_run_at_the_same_time_and_agree) {
  auto image = open_image("hand_ticker");
  BenchRobot a(image, "a", 0), b(image, "b", 1);
  std::thread one([&] { a.run(10 * kSecond + 100); });
  std::thread two([&] { b.run(10 * kSecond + 100); });
  one.join();
  two.join();
  EXPECT_EQ(a.robot.hash(), b.robot.hash());
  EXPECT_EQ(a.variable("ticks"), 1000);
}

TEST(CompiledRunner, every_copy_of_an_image_has_data_of_its_own) {
  // symptom: digests changed with three threads. Cause: copies 1 and 2 were loaded from the same
  // /proc/self/fd name, so the dynamic linker handed out one object twice.
  auto image = open_image("hand_busy");
  std::vector<const char*> data;
  for (std::size_t i = 0; i < 5; ++i) data.push_back(image->copy(i).description().data_begin);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(data[i], data[k]);
}
