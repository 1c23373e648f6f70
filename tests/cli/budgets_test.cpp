// SPDX-License-Identifier: MIT
// Every key of budgets against a profile that was written down: what is held against what, and in which unit.
#include "outputs/budgets.h"

#include "tests/cli/command.h"

namespace cli_test {
namespace {

chip::ProfileReport report() {
  chip::ProfileReport r;
  r.to = 1000;
  r.slept = 300;
  r.waited = 200;
  r.turn = {10, 10000, 500, 2000, 0};  // count, sum, least, most, when
  r.stack_bytes = 300;
  chip::ProfileReport::Function control, endless;
  control.name = "control";
  control.cycles = {4, 400, 50, 200, 0};
  endless.name = "endless";
  r.functions = {control, endless};
  chip::ProfileReport::Interrupt t2;
  t2.name = "T2";
  t2.cycles = {2, 220, 100, 120, 0};
  t2.latency = {2, 18, 4, 14, 0};
  t2.merged = 3;
  t2.missed = 5;
  r.interrupts = {t2};
  r.by_heart = {"ADC"};
  return r;
}

class BudgetKeys : public CommandTest {};

// 14.7456 cycles a microsecond
TEST_F(BudgetKeys, are_each_held_against_what_they_name) {
  outputs::Budgets budgets;
  std::vector<std::string> problems;
  ASSERT_TRUE(budgets.read(write("b.toml", R"([function.by_code]
max_cycles = 77
[function.control]
max_cycles = 200
max_us = 13
mean_cycles = 99
mean_us = 7
[function.endless]
max_cycles = 1
[function.never]
max_cycles = 1
[interrupt.ADC]
max_cycles = 1000
[interrupt.T1]
max_cycles = 1
[interrupt.T2]
max_cycles = 120
max_jitter_cycles = 10
max_jitter_us = 0.6
max_latency_cycles = 13
max_latency_us = 1
max_us = 8
mean_cycles = 110
mean_us = 7.5
merged = 3
missed = 4
[program]
max_load = 0.5
max_stack = 299
max_turn_cycles = 2000
max_turn_us = 100
mean_turn_cycles = 999
mean_turn_us = 68
)"),
                           problems));
  ASSERT_TRUE(budgets.add("control=199", problems));
  std::string told;
  for (const auto& verdict : budgets.judge(report(), {}, {{"by_code", 77}})) {
    EXPECT_EQ(verdict.passes, verdict.text.rfind("pass", 0) == 0);
    told += verdict.text + "\n";
  }
  EXPECT_EQ(told,
            "pass  by_code: max 77 of 77 cycles, by its code\n"
            "pass  control: max 200 of 200 cycles\n"
            "FAIL  control: max 200 of 192 cycles\n"
            "FAIL  control: mean 100 of 99 cycles\n"
            "pass  control: mean 100 of 103 cycles\n"
            "FAIL  endless: max: it never returned\n"
            "FAIL  never: max: it was never called\n"
            "FAIL  ADC: max: it is known by heart and not measured; use --hal dspic\n"
            "FAIL  T1: max: it was never served\n"
            "pass  T2: max 120 of 120 cycles\n"
            "pass  T2: max_jitter 10 of 10 cycles\n"
            "FAIL  T2: max_jitter 10 of 9 cycles\n"
            "FAIL  T2: max_latency 14 of 13 cycles\n"
            "pass  T2: max_latency 14 of 15 cycles\n"
            "FAIL  T2: max 120 of 118 cycles\n"
            "pass  T2: mean 110 of 110 cycles\n"
            "pass  T2: mean 110 of 111 cycles\n"
            "pass  T2: merged 3 of 3 times\n"
            "FAIL  T2: missed 5 of 4 times\n"
            "pass  program: max_load 0.500 of 0.500\n"
            "FAIL  program: max_stack 300 of 299 bytes\n"
            "pass  program: max_turn 2000 of 2000 cycles\n"
            "FAIL  program: max_turn 2000 of 1475 cycles\n"
            "FAIL  program: mean_turn 1000 of 999 cycles\n"
            "pass  program: mean_turn 1000 of 1003 cycles\n"
            "FAIL  control: max 200 of 199 cycles\n");
  // a program without a main loop, and one that was not run
  outputs::Budgets turn;
  ASSERT_TRUE(turn.read(write("c.toml", "[program]\nmax_load = 0\nmax_turn_us = 1\n"), problems));
  const auto nothing = turn.judge({}, {});
  EXPECT_EQ(nothing[0].text, "pass  program: max_load 0.000 of 0.000");
  EXPECT_EQ(nothing[1].text, "FAIL  program: max_turn: it has no main loop");
}

}  // namespace
}  // namespace cli_test
