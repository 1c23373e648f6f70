// SPDX-License-Identifier: MIT
// The fixture itself: what a failing test of a user's is told.
#include <gtest/gtest-spi.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <regex>

#include "hal_sim/runs/run.h"
#include "tests/support/firmware_test.h"

namespace firmware_test {
namespace {

class Fixture : public FirmwareTest {
 protected:
  /// The one failure that `act` is to report.
  static ::testing::TestPartResult only_failure(const std::function<void()>& act) {
    ::testing::TestPartResultArray told;
    {
      using Fake = ::testing::ScopedFakeTestPartResultReporter;
      Fake fake(Fake::INTERCEPT_ONLY_CURRENT_THREAD, &told);
      act();
    }
    EXPECT_EQ(told.size(), 1);
    return told.size() > 0 ? told.GetTestPartResult(0)
                           : ::testing::TestPartResult(::testing::TestPartResult::kSuccess, "", 0, "");
  }
  /// Files of a program written here by their names alone.
  static std::string short_of(const std::string& text) {
    return std::regex_replace(text, std::regex("/[^ (]*/tests/inline/t[0-9a-f]{16}/"), "");
  }
  static void expect_here(const std::function<void()>& act, int line, const std::string& says) {
    const auto failure = only_failure(act);
    EXPECT_STREQ(failure.file_name(), __FILE__);
    EXPECT_EQ(failure.line_number(), line);
    EXPECT_EQ(short_of(failure.message()), "Failed\n" + says);
  }
};

TEST_F(Fixture, a_trap_is_told_once_at_the_line_that_expects_none) {
  add_robot_with_source("volatile int zero;\nint main(void) { return 1 / zero; }", "bad");
  run_for(0.1);
  expect_here([&] { expect_no_traps(); }, __LINE__,
              "bad: math error: division by zero, or an overflow of an accumulator; the program has no "
              "_MathError(), so the processor resets at main (main.c:2)");
}

TEST_F(Fixture, a_variable_or_function_that_is_not_there_is_told_at_the_line_that_asks) {
  Robot& robot = add_robot_with_source("volatile int there;\nint main(void) { while (1) there++; }");
  run_for(0.1);
  expect_here([&] { robot.variable("absent"); }, __LINE__, "no variable 'absent' of 2 bytes in the firmware");
  expect_here([&] { robot.variables("there", 5); }, __LINE__,
              "no variable 'there' of 10 bytes in the firmware");
  expect_here([&] { robot.cost_of("absent"); }, __LINE__,
              "no function 'absent' in the firmware: it is not in the program");
  EXPECT_NE(robot.variable("there"), 0);
}

TEST_F(Fixture, a_function_that_became_part_of_others_is_told_with_what_to_do) {
  Robot& robot = add_robot_with_source(
      "volatile int n;\nstatic int weight(int x) { return 3 * x; }\nint main(void) { while (1) n = "
      "weight(n); }");
  run_for(0.01);
  expect_here([&] { robot.cost_of("weight"); }, __LINE__,
              "no function 'weight' in the firmware: it is part of main(); to measure it alone, declare it "
              "__attribute__((noinline)), or build with --opt -O0, which takes longer");
  expect_here([&] { robot.cost_of("wieght"); }, __LINE__,
              "no function 'wieght' in the firmware: it is not in the program; did you mean 'weight'?");
}

// -O1: what is called with a constant stands in its caller
TEST_F(Fixture, cost_is_that_of_the_chip) {
  const std::string program =
      "volatile int n, there;\n__attribute__((noinline)) void once(void) { n = 1; }\n"
      "__attribute__((noinline)) void either(void) { if (n) { there++; there++; } }\n"
      "__attribute__((noinline)) void loop(int k) { while (k--) there++; }\n"
      "int main(void) { once(); either(); loop(n + 2); while (1); }\n";
  Robot& robot = add_robot_with_source(program, "one").measured();
  Robot& other = add_robot_with_source(program, "other").at(0.3, 0);
  run_for(0.01);
  // mov #1, w0; mov w0, n; return
  EXPECT_EQ(robot.cost_of("once").calls, 1);
  EXPECT_EQ(robot.cost_of("once").max, 5);
  EXPECT_EQ(other.cost_of("once").calls, 0);
  EXPECT_EQ(other.cost_of("once").mean, 5);
  EXPECT_GE(robot.cost_of("either").min, other.cost_of("either").min);
  EXPECT_LE(robot.cost_of("either").max, other.cost_of("either").max);
  EXPECT_LT(other.cost_of("either").min, other.cost_of("either").max);
  EXPECT_EQ(other.cost_of("either").mean, -1);
  EXPECT_EQ(robot.cost_of("loop").calls, 1);
  EXPECT_GT(robot.cost_of("loop").mean, 10);
  expect_here([&] { other.cost_of("loop"); }, __LINE__,
              "loop(): only a run tells what it takes: it loops (main.c:4); have the robot measured, from "
              "before the first run");
}

TEST_F(Fixture, coverage_of_several_tests_is_added_up) {
  const std::string file = ::testing::TempDir() + "fixture-" + std::to_string(getpid()) + ".info";
  std::remove(file.c_str());
  struct Another : FirmwareTest {
    void TestBody() override {}
    void test(const std::string& info) {
      options.coverage = info;
      add_robot_with_source(
          "volatile int n;\nint main(void) {\n  int i;\n  for (i = 0; i < 10; i++)\n    n++;\n  while "
          "(1);\n}\n");
      run_for(0.01);
    }
  };
  for (int i = 0; i < 2; ++i) Another().test(file);
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(text.find("\nDA:5,20\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\nFNDA:2,main\n"), std::string::npos) << text;
  std::remove(file.c_str());
}

TEST_F(Fixture, a_program_that_does_not_compile_is_told_with_the_line_that_runs_it) {
  add_robot_with_source("int main(void) { return nothing; }");
  std::string said;
  int line = 0;
  try {
    line = __LINE__ + 1;
    run_for(0.1);
  } catch (const std::exception& wrong) {
    said = wrong.what();
  }
  EXPECT_EQ(
      short_of(said),
      __FILE__ ":" + std::to_string(line) +
          ": the test's world cannot start:\nmain.c:1:25: error: use of undeclared identifier 'nothing'\n");
}

}  // namespace
TEST(Run, is_refused_with_what_is_wrong_with_its_coverage_or_its_supervisors) {
  twin::Options options;
  std::vector<std::string> problems;
  EXPECT_NE(runs::Run::open({}, options, {}, problems), nullptr);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(runs::Run::open({}, options, {"nobodys"}, problems), nullptr);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0],
            "supervisor 'nobodys': nobodys: supervisor: got a name that is neither a file nor a program, "
            "expected a program of the PC or one that `twinpuck list supervisors` shows");
  problems.clear();
  options.coverage = testing::TempDir() + "nothing.info";
  EXPECT_EQ(runs::Run::open({}, options, {}, problems), nullptr);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0],
            "command line: --coverage: got no robot that runs code of the chip, expected one; programs for "
            "Webots do with --hal sim");
}

}  // namespace firmware_test
