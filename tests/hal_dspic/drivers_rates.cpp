// SPDX-License-Identifier: MIT
// How long the library's drivers take on the chip, at both levels, beside the original's text compiled by
// XC16 1.22 (cc1 of its public sources) and run on the same core: what a robot does.
#include "tests/support/firmware_test.h"

namespace {

using firmware_test::FirmwareTest;
using firmware_test::Robot;

constexpr double kFcy = 14745600;

struct Rates : FirmwareTest, ::testing::WithParamInterface<const char*> {
  Rates() {
    options.hal = "dspic";
    options.optimisation = GetParam();
  }
  static double by_level(double o0, double o1) { return std::string(GetParam()) == "-O0" ? o0 : o1; }
};

// 900 cycles of conversions, and the converter stands until the next list is written
TEST_P(Rates, the_scan_runs_at_the_originals_rate) {
  Robot& robot = add_robot_with_source(R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/e_init_port.h>
extern unsigned int tickAdcIsr;
int main(void) {
  e_init_port();
  e_init_ad_scan(ALL_ADC);
  while (1);
}
)");
  run_for(0.5);
  const int before = robot.variable("tickAdcIsr");
  run_for(1);
  const double frames = kFcy / by_level(979.75, 967.19);
  EXPECT_NEAR(static_cast<std::uint16_t>(robot.variable("tickAdcIsr") - before), frames, 0.015 * frames);
  expect_no_traps();
}

struct Call {
  const char* text;
  double o0, o1;  // cycles of the original
  double within;  // of that
};

// waiting loops, and what an operator of floats makes of a period
constexpr Call kCalls[] = {
    // four pauses of 10,000 rounds and a transaction; at -O1 a round of XC16's is 4 cycles, but its program
    // does not come back: the flag of the transaction is not volatile
    {"e_init_port()", 447267, 4 * 40030 + 7001, 0.1},
    {"wait(1000)", 13019, 6006, 0.1},
    {"e_set_speed_left(500)", 547, 532, 0.1},
};

TEST_P(Rates, calls_take_what_the_originals_take) {
  std::string source = R"(
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <motor_led/e_motors.h>
#include <utility/utility.h>
long took[3];
int done;
int main(void) {
  unsigned int low;
  T2CON = 0; PR2 = 0xFFFF; PR3 = 0xFFFF; T2CONbits.T32 = 1;
)";
  int row = 0;
  for (const Call& call : kCalls)
    source += "  TMR3HLD = 0; TMR2 = 0; T2CONbits.TON = 1; " + std::string(call.text) +
              "; T2CONbits.TON = 0; low = TMR2; took[" + std::to_string(row++) +
              "] = (long)((unsigned long)TMR3HLD << 16 | low);\n";
  Robot& robot = add_robot_with_source(source + "  done = 1;\n  while (1);\n}\n");
  ASSERT_TRUE(run_until([&] { return robot.variable("done"); }, 1));
  const auto took = robot.variables<std::int32_t>("took", std::size(kCalls));
  for (std::size_t i = 0; i < std::size(kCalls); ++i) {
    const double want = by_level(kCalls[i].o0, kCalls[i].o1);
    EXPECT_NEAR(took[i], want, kCalls[i].within * want) << kCalls[i].text;
  }
  expect_no_traps();
}

INSTANTIATE_TEST_SUITE_P(Levels, Rates, ::testing::Values("-O0", "-O1"),
                         [](const auto& info) { return std::string(info.param + 1); });

}  // namespace
