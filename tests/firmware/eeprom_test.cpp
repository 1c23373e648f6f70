// SPDX-License-Identifier: MIT
// The data EEPROM through the library's three functions.
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

TEST_F(FirmwareTest, eeprom_is_blank_keeps_what_is_written_and_survives_a_reset) {
  Robot& robot = add_robot_with_source(R"(
#include <DataEEPROM.h>
#include <motor_led/e_epuck_ports.h>
int blank, word, anded, erased, starts, results;
int row[16], back[16];
int main(void) {
  int i, value = 0x1234;
  ReadEE(0x7F, 0xFFFC, &blank, WORD);
  ReadEE(0x7F, 0xF000, &starts, WORD);
  if (starts == -1) { /* blank: the first life */
    value = 7;
    WriteEE(&value, 0x7F, 0xF000, WORD);
    RESET();
  }
  value = 0x1234;
  WriteEE(&value, 0x7F, 0xF010, WORD);
  ReadEE(0x7F, 0xF010, &word, WORD);
  value = 0x00FF;
  WriteEE(&value, 0x7F, 0xF010, WORD); /* not erased: bits can only be cleared */
  ReadEE(0x7F, 0xF010, &anded, WORD);
  EraseEE(0x7F, 0xF010, WORD);
  ReadEE(0x7F, 0xF010, &erased, WORD);
  for (i = 0; i < 16; i++) row[i] = i * 1000;
  results = WriteEE(row, 0x7F, 0xF020, ROW);
  ReadEE(0x7F, 0xF020, back, ROW);
  while (1);
}
)");
  run_for(0.5);
  EXPECT_EQ(robot.variable("blank"), -1);
  EXPECT_EQ(robot.variable("starts"), 7);
  EXPECT_EQ(robot.variable("word"), 0x1234);
  EXPECT_EQ(robot.variable("anded"), 0x0034);
  EXPECT_EQ(robot.variable("erased"), -1);
  EXPECT_EQ(robot.variable("results"), 0);
  EXPECT_EQ(robot.variables("back", 16), robot.variables("row", 16));
}

TEST_F(FirmwareTest, eeprom_refuses_arguments_that_make_no_sense_and_takes_2_ms) {
  Robot& robot = add_robot_with_source(R"(
#include <DataEEPROM.h>
#include <motor_led/e_led.h>
#include <motor_led/e_init_port.h>
int results[5];
int main(void) {
  int data[16], i;
  e_init_port();
  results[0] = ReadEE(0x7E, 0xF000, data, WORD);
  results[1] = ReadEE(0x7F, 0x1000, data, WORD);
  results[2] = ReadEE(0x7F, 0xF002, data, ROW);
  results[3] = WriteEE(data, 0x7F, 0xF001, WORD);
  results[4] = ReadEE(0x7F, 0xF000, data, 2);
  e_set_led(0, 1);
  for (i = 0; i < 10; i++) EraseEE(0x7F, 0xF000, ROW);
  e_set_led(0, 0);
  while (1);
}
)");
  ASSERT_TRUE(run_until([&] { return robot.led(0); }, 1));
  const double from_s = now_s();
  ASSERT_TRUE(run_until([&] { return !robot.led(0); }, 1));
  EXPECT_NEAR(now_s() - from_s, 0.020, 0.003);
  EXPECT_EQ(robot.variables("results", 5), std::vector<std::int16_t>(5, -1));
}

}  // namespace
