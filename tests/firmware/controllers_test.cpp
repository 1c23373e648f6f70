// SPDX-License-Identifier: MIT
// Each example controller does what its page promises.
#include <array>
#include <cmath>

#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

constexpr double kTickS = 1475 / 14745600.0;  // one agenda tick

/// How often the LED changed in a stretch of time, seen at every tick of the world.
struct LedChanges {
  const Robot& robot;
  int led;
  bool last = robot.led(led);
  int count = 0;
  bool look() {
    if (robot.led(led) != last) last = !last, ++count;
    return false;
  }
};

// its last line speaks of a variable, and the loop on it asks for none
TEST_F(FirmwareTest, end_of_a_program_is_no_endless_wait) {
  Robot& r = add_robot_with_source("volatile int done;\nint main(void) {\n  done = 1; for (;;);\n}\n");
  run_for(0.1);
  EXPECT_EQ(r.diagnoses_text(), "");
}

TEST_F(FirmwareTest, blink_toggles_every_thousand_agenda_ticks) {
  Robot& robot = add_robot("blink");
  run_for(0.05);
  LedChanges changes{robot, 0};
  run_until([&] { return changes.look(); }, 10);
  EXPECT_NEAR(changes.count, 10 / (1000 * kTickS), 1);
  EXPECT_EQ(robot.distance_m(), 0);
  expect_no_traps();
}

TEST_F(FirmwareTest, square_comes_back_to_its_start) {
  Robot& robot = add_robot("square");
  ASSERT_TRUE(run_until([&] { return robot.led(8); }, 30)) << "never finished";
  EXPECT_NEAR(robot.right_steps(), 4 * 1553 + 4 * 323, 8);
  EXPECT_NEAR(robot.left_steps(), 4 * 1553 - 4 * 323, 8);
  // four sides of 1553 steps of 0.1288 mm
  EXPECT_NEAR(robot.distance_m(), 0.8, 0.01);
  // a quarter turn differs from 90 degrees by what the axle differs from 53 mm: 2 % are 7 degrees and 25 mm
  EXPECT_NEAR(robot.x_m(), 0, 0.03);
  EXPECT_NEAR(robot.y_m(), 0, 0.03);
  EXPECT_NEAR(std::cos(sim::radians(robot.heading_deg())), 1, 0.01);
  expect_no_traps();
}

TEST_F(FirmwareTest, obstacle_wanders_through_the_maze_without_touching_it) {
  load_world("worlds/maze.toml");
  Robot& puck = robot(0);
  puck.settings().firmware = "lab/obstacle";
  run_for(60);
  EXPECT_GE(puck.distance_m(), 2);
  EXPECT_LE(puck.longest_wall_touch_s(), 0.2);
  expect_no_traps();
}

TEST_F(FirmwareTest, obstacle_sees_a_wall_end_dead_ahead) {
  // the end of a wall 1 cm thick stands between the two front sensors
  arena(1, 1);
  wall(0.2, 0, 0.45, 0);
  Robot& robot = add_robot("lab/obstacle").at(0, 0, 0);
  run_for(20);
  EXPECT_EQ(robot.longest_wall_touch_s(), 0);
  EXPECT_GE(robot.distance_m(), 0.7);
}

TEST_F(FirmwareTest, braitenberg_avoids_a_box_in_an_open_arena) {
  arena(1, 1);
  box(0, 0.05, 0.15, 20);
  Robot& robot = add_robot("braitenberg").at(-0.3, -0.3, 40);
  run_for(30);
  EXPECT_GE(robot.distance_m(), 1);
  EXPECT_LE(robot.longest_wall_touch_s(), 0.2);
  expect_no_traps();
}

TEST_F(FirmwareTest, follow_wall_stays_at_the_wall_around_inner_corners) {
  arena(0.8, 0.8);
  Robot& robot = add_robot("follow_wall").at(0, 0, 30);
  run_for(15);  // finds the wall
  for (int i = 0; i < 60; ++i) {
    run_for(0.5);
    const double gap_m = 0.4 - std::fmax(std::fabs(robot.x_m()), std::fabs(robot.y_m())) - 0.037;
    EXPECT_LT(gap_m, 0.06) << "at " << now_s() << " s";
  }
  EXPECT_GT(robot.distance_m(), 1.2);
  EXPECT_LE(robot.longest_wall_touch_s(), 0.2);
  expect_no_traps();
}

TEST_F(FirmwareTest, selector_demo_drives_straight_in_position_2) {
  Robot& robot = add_robot("selector_demo").selector(2);
  run_for(2);
  EXPECT_EQ(robot.uart(1).text(),
            "selector 2\r\n");  // once, although the program starts twice after power-up
  EXPECT_GT(robot.x_m(), 0.05);
  EXPECT_NEAR(robot.y_m(), 0, 0.002);
}

TEST_F(FirmwareTest, selector_demo_turns_left_in_position_3) {
  Robot& robot = add_robot("selector_demo").selector(3);
  run_for(1);
  EXPECT_GT(robot.heading_deg(), 20);
  EXPECT_NEAR(std::hypot(robot.x_m(), robot.y_m()), 0, 0.002);
}

TEST_F(FirmwareTest, selector_demo_shows_other_positions_on_the_ring) {
  Robot& robot = add_robot("selector_demo").selector(13);
  run_for(0.5);
  EXPECT_EQ(robot.leds(), 1u << 5 | 1u << 8);  // 13 = 8 + 5: the body LED and LED 5
}

TEST_F(FirmwareTest, serial_echo_obeys_commands_and_returns_the_rest) {
  Robot& robot = add_robot("serial_echo").selector(7);
  run_for(0.2);
  EXPECT_EQ(robot.uart(1).text(), "serial_echo ready\r\n");
  robot.uart(1).send("hello\r\nC\rL,3,1\n");
  run_for(0.1);
  EXPECT_EQ(robot.uart(1).text(), "serial_echo ready\r\nhello\r\nc,7\r\nl\r\n");
  EXPECT_TRUE(robot.led(3));
  robot.uart(1).send("D,500,-500\r");
  run_for(1);
  robot.uart(1).send("D,0,0\rQ\r");
  run_for(0.2);
  EXPECT_NEAR(robot.left_steps(), 500, 5);
  EXPECT_NEAR(robot.right_steps(), -500, 5);
  const std::string expected =
      "q," + std::to_string(robot.left_steps()) + "," + std::to_string(robot.right_steps()) + "\r\n";
  EXPECT_NE(robot.uart(1).text().find(expected), std::string::npos) << robot.uart(1).text();
  expect_no_traps();
}

TEST_F(FirmwareTest, bench_braitenberg_cruises_at_8_cm_per_second) {
  Robot& robot = add_robot("bench_braitenberg");
  run_for(1);
  const double start_m = robot.x_m();
  run_for(10);
  // 621 steps/s become one step in 10000 / 621 = 16 ticks; 1000 steps are one turn of a 41 mm wheel
  const double speed_m_s = 1 / (16 * kTickS) / 1000 * 0.041 * 3.14159265;
  EXPECT_NEAR(robot.x_m() - start_m, 10 * speed_m_s, 0.02);
}

// --- the contract as controllers meet it

TEST_F(FirmwareTest, the_header_decides_the_variant_of_a_function) {
  // all LEDs with value 2: the basic variant toggles each, the advanced one switches all off
  const std::string body = "int main(void) { e_init_port(); e_set_led(3, 1); e_set_led(8, 2); while (1); }\n";
  Robot& basic =
      add_robot_with_source("#include <motor_led/e_init_port.h>\n#include <motor_led/e_led.h>\n" + body);
  Robot& advanced = add_robot_with_source(
      "#include <motor_led/e_init_port.h>\n#include <motor_led/advance_one_timer/e_led.h>\n" + body);
  advanced.at(0.5, 0);
  run_for(0.5);
  EXPECT_EQ(basic.leds() & 0xFF, 0xF7u);
  EXPECT_EQ(advanced.leds() & 0xFF, 0x00u);
}

TEST_F(FirmwareTest, headers_are_found_in_every_usual_spelling) {
  Robot& robot = add_robot_with_source(
      "#include \"p30f6014a.h\"\n"
      "#include <e_epuck_ports.h>\n"
      "#include \"../../library/motor_LED/e_init_port.h\"\n"
      "#include <motor_led\\advance_one_timer\\e_led.h>\n"
      "_FOSC(CSW_FSCM_OFF & XT_PLL8);\n"
      "int main(void) { e_init_port(); LED5 = 1; BODY_LED = 1; NOP(); while (1); }\n");
  run_for(0.5);
  EXPECT_EQ(robot.leds(), 1u << 5 | 1u << 8);
}

TEST_F(FirmwareTest, calls_without_argument_mean_what_they_meant_in_older_libraries) {
  Robot& robot = add_robot_with_source(
      "#include <a_d/advance_ad_scan/e_ad_conv.h>\n#include <motor_led/e_init_port.h>\n"
      "#include <uart/e_uart_char.h>\n"
      "int main(void) {\n"
      "  e_init_port(); e_init_uart2(); e_init_ad_scan();\n"
      "  e_send_uart2_char(\"U\", 1);\n"
      "  while (1);\n"
      "}\n");
  run_for(0.5);
  EXPECT_EQ(robot.uart(2).text(), "U");
  expect_no_traps();
}

// each round of wait() takes as long as the one before: none for 0, and as many as it is told
TEST_F(FirmwareTest, wait_goes_round_as_often_as_it_is_told) {
  Robot& robot = add_robot_with_source(
      "#include <p30F6014A.h>\n#include <utility/utility.h>\n"
      "unsigned int ticks[5];\n"
      "static const long rounds[5] = {0, 1, 2, 3, 1000};\n"
      "int main(void) {\n"
      "  int i;\n"
      "  PR1 = 0xFFFF; T1CON = 0x8000;\n"
      "  for (i = 0; i < 5; i++) { TMR1 = 0; wait(rounds[i]); ticks[i] = TMR1; }\n"
      "  while (1);\n"
      "}\n");
  run_for(0.1);
  const auto ticks = robot.variables<std::uint16_t>("ticks", 5);
  const int round = ticks[3] - ticks[2];
  EXPECT_EQ(round, 6);  // XC16's at -O1
  EXPECT_EQ(ticks[2] - ticks[1], round);
  EXPECT_EQ(ticks[4] - ticks[3], 997 * round);
  EXPECT_GT(ticks[1] - ticks[0], 0);
}

TEST_F(FirmwareTest, a_transform_helper_rounds_the_mean_down) {
  Robot& robot = add_robot_with_source(
      "#include <fft/e_fft_utilities.h>\n"
      "int in[4] = {-1, -2, 30000, 30001};\n"
      "int main(void) { e_subtract_mean(in, 4, 2); while (1); }\n");
  run_for(0.1);
  // the sum is 59998, a quarter of it 14999.5, the mean 14999
  using Words = std::array<std::int16_t, 4>;
  EXPECT_EQ(robot.variable<Words>("in"), (Words{-15000, -15001, 15001, 15002}));
}

TEST_F(FirmwareTest, a_fast_copy_makes_complex_numbers) {
  Robot& robot = add_robot_with_source(
      "#include <fft/e_fft_utilities.h>\n"
      "int in[3] = {5, -6, 7};\n"
      "int out[8] = {1, 1, 1, 1, 1, 1, 1, 1};\n"
      "int main(void) { e_fast_copy(in, out, 3); while (1); }\n");
  run_for(0.1);
  EXPECT_EQ(robot.variables("out", 8), (std::vector<std::int16_t>{5, 0, -6, 0, 7, 0, 1, 1}));
}

TEST_F(FirmwareTest, matlab_messages_have_the_documented_bytes) {
  const auto program = [](const std::string& receives) {
    return "#include <motor_led/e_init_port.h>\n#include <uart/e_uart_char.h>\n#include <matlab/matlab.h>\n"
           "int data[2] = {1, -2}, got[4], counts[3], received; char text[5];\n"
           "int main(void) {\n  e_init_port(); e_init_uart1();\n" +
           receives + "  while (1);\n}\n";
  };
  Robot& ints =
      add_robot_with_source(program("  e_send_int_to_matlab(data, 2);\n"
                                    "  for (; received < 3; received++)\n"
                                    "    counts[received] = e_receive_int_from_matlab(got, 4);\n"));
  Robot& chars =
      add_robot_with_source(program("  e_send_char_to_matlab(\"hey\", 3);\n"
                                    "  for (; received < 2; received++)\n"
                                    "    counts[received] = e_receive_char_from_matlab(text, 3);\n"))
          .at(0.5, 0);
  const auto receive = [&](Robot& robot, const std::string& bytes) {
    robot.uart(1).send(bytes);
    run_for(0.1);
  };
  run_for(0.2);
  EXPECT_EQ(ints.uart(1).text(), std::string("I\4\0\1\0\xFE\xFF"
                                             "EOF\0",
                                             11));
  EXPECT_EQ(chars.uart(1).text(), std::string("C\3\0heyEOF\0", 10));
  receive(ints, std::string("\4\0\x10\x27\xFF\x00", 6));
  EXPECT_EQ(ints.variable<std::int32_t>("got"), 0x00FF2710);
  // what fills the array is not too long
  receive(ints, std::string("\x8\0\1\0\2\0\3\0\4\0", 10));
  EXPECT_EQ(ints.variables("got", 4), (std::vector<std::int16_t>{1, 2, 3, 4}));
  EXPECT_FALSE(ints.led(4));
  receive(ints, std::string("\xA\0\5\0\6\0\7\0\x8\0\x9\0", 12));
  EXPECT_EQ(ints.variables("got", 4), (std::vector<std::int16_t>{5, 6, 7, 8}));
  EXPECT_TRUE(ints.led(4)) << "a word too long";
  EXPECT_EQ(ints.variables("counts", 3), (std::vector<std::int16_t>{2, 4, 4}));
  receive(chars, std::string("\3\0abc", 5));
  receive(chars, std::string("\4\0wxyz", 6));
  EXPECT_EQ(chars.variables<char>("text", 4), (std::vector<char>{'w', 'x', 'y', 0}));
  EXPECT_EQ(chars.variables("counts", 2), (std::vector<std::int16_t>{3, 3}));
  EXPECT_FALSE(chars.led(4));
}

// position 10 is the turret's: it has the debugger's pins AN0 and AN1, too, and a higher priority
TEST_F(FirmwareTest, the_scan_of_the_turrets_position_has_its_inputs_and_its_priority) {
  const char* const program =
      "#include <p30F6014A.h>\n#include <motor_led/e_init_port.h>\n#include "
      "<a_d/advance_ad_scan/e_ad_conv.h>\n"
      "unsigned inputs, priority;\n"
      "int main(void) {\n  e_init_port();\n  e_init_ad_scan(MICRO_ONLY);\n  inputs = ADPCFG;\n  priority = "
      "IPC2 >> 12 & 7;\n"
      "  while (1);\n}\n";
  add_robot_with_source(program).selector(10);
  add_robot_with_source(program).at(0.5, 0).selector(9);
  run_for(0.1);
  EXPECT_EQ(robot(0).variable("inputs"), 0);
  EXPECT_EQ(robot(0).variable("priority"), 6);
  EXPECT_EQ(robot(1).variable("inputs"), 3);
  EXPECT_EQ(robot(1).variable("priority"), 4);
}

}  // namespace
