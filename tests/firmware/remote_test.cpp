// SPDX-License-Identifier: MIT
// The remote control from the key to the program: the library's receiver decodes what the pin carries.
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

const char* const kListener = R"(
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_remote_control.h>
#include <motor_led/e_init_port.h>
int heard_check, heard_address, heard_data, changes;
int main(void) {
  e_init_port();
  e_init_remote_control();
  e_start_agendas_processing();
  while (1) {
    /* each read once: the interrupt may fall between */
    int check = e_get_check(), data = e_get_data();
    if (heard_check != check || heard_data != data) changes++;
    heard_check = check;
    heard_address = e_get_address();
    heard_data = data;
  }
}
)";

TEST_F(FirmwareTest, remote_control_reads_two_nought_nought_before_the_first_key) {
  Robot& robot = add_robot_with_source(kListener);
  run_for(0.3);
  EXPECT_EQ(robot.variable("heard_check"), 2);
  EXPECT_EQ(robot.variable("heard_address"), 0);
  EXPECT_EQ(robot.variable("heard_data"), 0);
}

// 24.6 ms from the first edge, which is half a bit (0.9 ms) after the press; ticks may be 0.1 ms early
TEST_F(FirmwareTest, remote_control_takes_24_6_ms_with_led_1_lit) {
  Robot& robot = add_robot_with_source(kListener);
  run_for(0.3);
  robot.press_key(12, 0, 3);
  run_for(0.010);
  EXPECT_TRUE(robot.led(1));
  EXPECT_EQ(robot.variable("heard_check"), 2);
  run_for(0.0135);
  EXPECT_TRUE(robot.led(1));
  EXPECT_EQ(robot.variable("heard_check"), 2);
  run_for(0.004);
  EXPECT_FALSE(robot.led(1));
  EXPECT_EQ(robot.variable("heard_check"), 0);
  EXPECT_EQ(robot.variable("heard_address"), 3);
  EXPECT_EQ(robot.variable("heard_data"), 12);
}

// known before the robot even starts, as from a world file
TEST_F(FirmwareTest, remote_control_decodes_a_press_announced_at_the_beginning) {
  Robot& robot = add_robot_with_source(kListener);
  robot.settings().keys = {{33, 0.6, 0, 8}, {5, 0.4, 0, 0}};
  run_for(0.5);
  EXPECT_EQ(robot.variable("heard_data"), 5);
  EXPECT_EQ(robot.variable("heard_address"), 0);
  EXPECT_EQ(robot.variable("heard_check"), 0);
  run_for(0.2);
  EXPECT_EQ(robot.variable("heard_data"), 33);
  EXPECT_EQ(robot.variable("heard_address"), 8);
  EXPECT_EQ(robot.variable("heard_check"), 1);
}

TEST_F(FirmwareTest, remote_control_decodes_every_key_and_address) {
  Robot& robot = add_robot_with_source(kListener);
  run_for(0.3);
  for (int key = 0; key < 64; ++key) {
    const int address = (key * 7 + 3) % 32;
    robot.press_key(key, 0, address);
    run_for(0.05);
    EXPECT_EQ(robot.variable("heard_data"), key);
    EXPECT_EQ(robot.variable("heard_address"), address);
    EXPECT_EQ(robot.variable("heard_check"), key % 2);  // the toggle bit changes with each press
  }
}

// a key held for a second: nine frames with the same toggle bit are one change
TEST_F(FirmwareTest, remote_control_sees_a_held_key_as_one) {
  Robot& robot = add_robot_with_source(kListener);
  run_for(0.3);
  robot.press_key(5, 1);
  run_for(1.5);
  EXPECT_EQ(robot.variable("changes"), 1 + 1);  // 2, 0, 0 at the start is the first
  EXPECT_EQ(robot.variable("heard_data"), 5);
  robot.press_key(5, 1);
  run_for(1.5);
  EXPECT_EQ(robot.variable("changes"), 3);
}

TEST_F(FirmwareTest, remote_control_hears_nothing_without_agendas) {
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/advance_one_timer/e_remote_control.h>
#include <motor_led/e_init_port.h>
int main(void) { e_init_port(); e_init_remote_control(); while (1); }
)");
  run_for(0.3);
  robot.press_key(5, 1);
  run_for(1);
  EXPECT_FALSE(robot.led(1));
  expect_no_traps();
}

// seven falling edges of the key 0: one in the middle of each start bit, the others where bits of 0 follow
TEST_F(FirmwareTest, a_program_may_have_its_own_handler_of_int0) {
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
int edges, low;
void __attribute__((interrupt, no_auto_psv)) _INT0Interrupt(void) {
  IFS0bits.INT0IF = 0;
  edges++;
  if (!REMOTE) low++;
}
int main(void) {
  e_init_port();
  INTCON2bits.INT0EP = 1;
  IFS0bits.INT0IF = 0;
  IEC0bits.INT0IE = 1;
  while (1);
}
)");
  run_for(0.3);
  robot.press_key(0, 0);
  run_for(0.1);
  // 1 1 and twelve bits of 0: start bits fall in their middle; the first 0 goes on low from there and rises,
  // and each of the eleven others falls at its beginning
  EXPECT_EQ(robot.variable("edges"), 2 + 11);
  EXPECT_EQ(robot.variable("low"), 2 + 11);
  expect_no_traps();
}

}  // namespace
