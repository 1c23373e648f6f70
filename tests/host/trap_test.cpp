// SPDX-License-Identifier: MIT
#include "tests/host/bench.h"

using namespace host_test;

namespace {

struct Expected {
  int choice;
  int kind;
  const char* says;
};

class Trap : public ::testing::TestWithParam<Expected> {};

TEST_P(Trap, stops_that_robot_and_no_other) {
  const Expected& e = GetParam();
  BenchRobot bad(open_image("hand_trap_" + std::to_string(e.choice)), "bad");
  BenchRobot good(open_image("hand_busy"), "good");
  for (int i = 0; i < 3 * 512; ++i) {
    bad.run(28'800);
    good.run(28'800);
  }
  ASSERT_EQ(bad.robot.traps().size(), 1u);
  const auto& t = bad.robot.traps().front();
  EXPECT_TRUE(bad.robot.has_stopped());
  EXPECT_EQ(t.kind, e.kind) << t.message;
  EXPECT_NE(t.message.find(e.says), std::string::npos) << t.message;
  EXPECT_EQ(t.robot, "bad");
  ASSERT_FALSE(t.backtrace.empty());
  EXPECT_NE(t.backtrace.back().function.find("firmware_main"), std::string::npos)
      << to_string(t.backtrace.back());
  EXPECT_NE(t.place.file.find("traps.c"), std::string::npos) << to_string(t.place);
  EXPECT_GT(t.place.line, 0);
  EXPECT_GE(t.cycle, 2000);
  EXPECT_TRUE(good.robot.traps().empty());
  EXPECT_GT(good.variable("rounds"), 4'000'000);
}

INSTANTIATE_TEST_SUITE_P(
    EveryKind, Trap,
    ::testing::Values(Expected{1, TP_TRAP_ADDRESS, "read through a null pointer"},
                      Expected{2, TP_TRAP_ADDRESS, "wild pointer"},
                      Expected{3, TP_TRAP_ADDRESS, "write through a wild pointer (address 4660)"},
                      Expected{4, TP_TRAP_MATH, "division by zero"}, Expected{6, TP_TRAP_ABORT, "abort"},
                      Expected{7, TP_TRAP_INTERRUPT, "endless loop with interrupts off"},
                      Expected{8, TP_TRAP_ADDRESS, "null pointer"},
                      Expected{9, TP_TRAP_ILLEGAL, "illegal instruction"},
                      Expected{10, TP_TRAP_ADDRESS, "write through a null pointer"},
                      Expected{11, TP_TRAP_UNSIMULATED, "ADCON1"}),
    [](const auto& info) { return "choice_" + std::to_string(info.param.choice); });

TEST(TrapOf, endless_recursion_is_a_stack_error) {
  BenchRobot bad(open_image("hand_trap_5"), "bad");
  bad.run(kSecond);
  ASSERT_EQ(bad.robot.traps().size(), 1u);
  const auto& t = bad.robot.traps().front();
  EXPECT_EQ(t.kind, TP_TRAP_STACK) << t.message;
  EXPECT_NE(t.place.function.find("recurse"), std::string::npos) << to_string(t.place);
  EXPECT_EQ(t.backtrace.size(), 16u);
}

TEST(TrapOf, returning_from_main_resets_and_is_counted) {
  BenchRobot r(open_image("hand_trap_12"), "r");
  r.run(28'800);
  ASSERT_EQ(r.robot.traps().size(), 1u);
  EXPECT_EQ(r.robot.traps().front().kind, 0);
  EXPECT_FALSE(r.robot.has_stopped());
  EXPECT_GE(r.robot.traps().front().count, 10);  // 1000 cycles of start-up and 1100 of program each time
}

TEST(TrapOf, a_thousand_trapping_robots_are_all_reported) {
  auto image = open_image("hand_trap_1");
  std::vector<std::unique_ptr<BenchRobot>> robots;
  for (int i = 0; i < 1000; ++i)
    robots.push_back(std::make_unique<BenchRobot>(image, "r" + std::to_string(i)));
  for (auto& r : robots) r->run(28'800);
  for (auto& r : robots) EXPECT_EQ(r->robot.traps().size(), 1u);
}

}  // namespace
