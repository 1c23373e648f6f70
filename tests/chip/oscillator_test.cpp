// SPDX-License-Identifier: MIT
// How fast the robot's clock is with each setting of its oscillator, by the data sheet's table [DS70143 20-1].
#include "hal_sim/chip/oscillator.h"

#include <gtest/gtest.h>

namespace {

struct Setting {
  const char* name;
  std::uint16_t fosc;  // bits 10 to 8 the source, 4 to 0 the primary oscillator's mode
  double hz;           // of instructions; 0: the robot has no such clock
};

// a crystal of 7.3728 MHz, 7.37 and 0.512 MHz inside; four clocks an instruction
constexpr Setting kSettings[] = {
    {"XT_PLL4", 0x0705, 7372800},
    {"XT_PLL8", 0x0706, 14745600},
    {"XT_PLL16", 0x0707, 29491200},
    {"HS2_PLL4", 0x0711, 3686400},
    {"HS2_PLL8", 0x0712, 7372800},
    {"HS2_PLL16", 0x0713, 14745600},
    {"HS3_PLL4", 0x0715, 2457600},
    {"HS3_PLL8", 0x0716, 4915200},
    {"HS3_PLL16", 0x0717, 9830400},
    {"FRC_PLL4", 0x0701, 7370000},
    {"FRC_PLL8", 0x070A, 14740000},
    {"FRC_PLL16", 0x0703, 29480000},
    {"ECIO_PLL4", 0x070D, 0},
    {"ECIO_PLL8", 0x070E, 0},
    {"ECIO_PLL16", 0x070F, 0},
    {"FRC", 0x0100, 1842500},
    {"LPRC", 0x0200, 128000},
    {"LP", 0x0000, 0},
    {"XTL", 0x0300, 1843200},
    {"HS", 0x0302, 1843200},
    {"XT", 0x0304, 1843200},
    {"ERC", 0x0309, 0},
    {"ECIO", 0x030C, 0},
    {"EC", 0x030B, 0},
    {"XT_PLL8, switches", 0xC706, 14745600},
};

TEST(Oscillator, each_setting_has_the_data_sheets_rate) {
  for (const Setting& s : kSettings) {
    EXPECT_DOUBLE_EQ(chip::instruction_rate_hz(s.fosc), s.hz) << s.name;
    EXPECT_EQ(chip::clock_problem(s.fosc).empty(), s.hz > 0) << s.name;
  }
  EXPECT_EQ(chip::clock_problem(0x030B),
            "configuration word FOSC: got 0x030B, a source of clock that the robot has not, expected its "
            "crystal of "
            "7.3728 MHz, as with XT_PLL8");
}

TEST(Oscillator, a_rate_within_a_thousandth_is_the_usual_one) {
  EXPECT_EQ(chip::clock_factor(0x0706), 1);
  EXPECT_EQ(chip::clock_factor(0x070A), 1) << "0.04 % off";
  EXPECT_EQ(chip::clock_factor(0x0707), 2);
  EXPECT_EQ(chip::clock_factor(0x030B), 1) << "of none";
  EXPECT_EQ(chip::clock_ppm(20, 0x0706), 20);
  EXPECT_NEAR(chip::clock_ppm(20, 0x0707), 1000040, 1e-6);  // twice as fast, and 20 millionths of that
  EXPECT_NEAR(chip::clock_ppm(-100, 0x0705), -500050, 1e-6);
}

}  // namespace
