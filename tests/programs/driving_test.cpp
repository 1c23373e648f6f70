// SPDX-License-Identifier: MIT
// Wheels and LEDs of the e-puck as programs of Webots' interfaces command them; and that a robot does the
// same with an equal program on its own library.
#include <set>

#include "tests/programs/program_fixture.h"

namespace {

using programs_test::ProgramTest;
using programs_test::Robot;

class Driving : public ProgramTest {};

// --- wheels

struct Velocity {
  double rad_s;
  int steps_s;
};
class Velocities : public Driving, public ::testing::WithParamInterface<Velocity> {};

// a turn is 1000 steps
TEST_P(Velocities, are_steps_a_second) {
  char text[200];
  std::snprintf(text, sizeof text, "wb_motor_set_velocity(left, %.9g); wb_motor_set_velocity(right, %.9g);",
                GetParam().rad_s, -GetParam().rad_s);
  Robot& r = add_c(
      "WbDeviceTag left, right;",
      "left = wb_robot_get_device(\"left wheel motor\"); right = wb_robot_get_device(\"right wheel "
      "motor\");\n"
      "wb_motor_set_position(left, INFINITY); wb_motor_set_position(right, INFINITY);\n" +
          std::string(text) +
          "printf(\"velocity %.9g %.9g\\n\", wb_motor_get_velocity(left), wb_motor_get_max_velocity(left));",
      "");
  run_for(0.5);
  const auto left = r.left_steps(), right = r.right_steps();
  run_for(2);
  EXPECT_NEAR(r.left_steps() - left, 2 * GetParam().steps_s, 2);
  EXPECT_NEAR(r.right_steps() - right, -2 * GetParam().steps_s, 2);
  EXPECT_NEAR(told(r, "velocity").at(1), 6.28, 0.01);
}

INSTANTIATE_TEST_SUITE_P(RadS, Velocities,
                         ::testing::Values(Velocity{6.28, 999},         // 999.49
                                           Velocity{6.2831853, 1000},   //
                                           Velocity{-3.1415927, -500},  //
                                           Velocity{0.5, 80},           // 79.58
                                           Velocity{0, 0},              //
                                           Velocity{100, 1000}));       // more than it can

TEST_F(Driving, a_velocity_without_an_infinite_position_moves_nothing) {
  Robot& r = add_c("", "wb_motor_set_velocity(wb_robot_get_device(\"left wheel motor\"), 6);", "");
  run_for(1);
  EXPECT_EQ(r.left_steps(), 0);
}

// a turn is 1000 steps, half a turn back -500
TEST_F(Driving, a_position_is_reached_to_the_step_and_held) {
  Robot& r =
      add_c("WbDeviceTag left, enc;",
            "left = wb_robot_get_device(\"left wheel motor\"); wb_motor_set_velocity(left, 6.28);\n"
            "wb_motor_set_position(left, 6.283185307); enc = wb_robot_get_device(\"left wheel sensor\");\n"
            "wb_position_sensor_enable(enc, 64);\n"
            "printf(\"target %.9g\\n\", wb_motor_get_target_position(left));",
            "printf(\"at %.9g\\n\", wb_position_sensor_get_value(enc));\n"
            "if (steps == 60) wb_motor_set_position(left, -3.141592654);");
  run_for(3.8);
  EXPECT_EQ(r.left_steps(), 1000);
  EXPECT_NEAR(value(r, "at"), 6.283185307, 1e-6);
  run_for(4);
  EXPECT_EQ(r.left_steps(), -500);
  EXPECT_EQ(r.right_steps(), 0);
  EXPECT_NEAR(value(r, "target"), 6.283185307, 1e-6);
}

// 0.00628 rad/s a unit: 500 units are half a turn a second; encoders count from where they were set
TEST_F(Driving, differential_wheels_take_units_and_count_steps) {
  Robot& r =
      add_c("",
            "wb_differential_wheels_enable_encoders(64); wb_differential_wheels_set_encoders(100, -100);\n"
            "wb_differential_wheels_set_speed(500, -500);",
            "printf(\"at %g %g\\n\", wb_differential_wheels_get_left_encoder(), "
            "wb_differential_wheels_get_right_encoder());");
  run_for(2);
  EXPECT_NEAR(r.left_steps(), 1000, 5);
  EXPECT_NEAR(told(r, "at").at(0), r.left_steps() + 100, 35);  // up to 64 ms old
  EXPECT_NEAR(told(r, "at").at(1), r.right_steps() - 100, 35);
}

TEST_F(Driving, the_world_sets_the_speed_unit) {
  world.webots.speed_unit_rad_s = 0.1;
  Robot& r = add_c("",
                   "wb_differential_wheels_set_speed(31.416, 0); printf(\"unit %g\\n\", "
                   "wb_differential_wheels_get_speed_unit());",
                   "");
  run_for(0.5);
  const auto left = r.left_steps();
  run_for(2);
  EXPECT_NEAR(r.left_steps() - left, 1000, 3);  // 3.1416 rad/s
  EXPECT_EQ(value(r, "unit"), 0.1);
}

TEST_F(Driving, leds_are_bits_and_every_colour_is_on) {
  Robot& r = add_c("",
                   "for (int i = 0; i < 10; i++) { char name[5]; sprintf(name, \"led%d\", i);\n"
                   "wb_led_set(wb_robot_get_device(name), i % 3 == 0 ? 0xFF0000 : 0); }",
                   "if (steps == 5) { wb_led_set(wb_robot_get_device(\"led3\"), 0); "
                   "wb_led_set(wb_robot_get_device(\"led8\"), 1);\n"
                   "printf(\"get %d %d\\n\", wb_led_get(wb_robot_get_device(\"led8\")), "
                   "wb_led_get(wb_robot_get_device(\"led3\"))); }");
  run_for(0.2);
  EXPECT_EQ(r.leds(), 1u << 0 | 1u << 3 | 1u << 6 | 1u << 9);
  run_for(0.3);
  EXPECT_EQ(r.leds(), 1u << 0 | 1u << 6 | 1u << 8 | 1u << 9);
  EXPECT_EQ(told(r, "get"), (std::vector<double>{1, 0}));
}

// --- the same robot

/// Straight, a turn on the spot, a curve, each for a second, from 1 s on.
const char* const kTour[] = {"500, 500", "-300, 300", "800, 200", "-400, -100"};

TEST_F(Driving, an_epuck_drives_as_with_an_equal_program_on_its_own_library) {
  std::string webots = "wb_robot_step(1000);\n", own;
  for (const char* speeds : kTour)
    webots += std::string("wb_differential_wheels_set_speed(") + speeds + "); wb_robot_step(1000);\n";
  webots += "wb_differential_wheels_set_speed(0, 0);";
  const std::string left_right[][2] = {{"500", "500"}, {"-300", "300"}, {"800", "200"}, {"-400", "-100"}};
  for (const auto& pair : left_right)
    own += "e_set_speed_left(" + pair[0] + "); e_set_speed_right(" + pair[1] + "); second();\n";
  Robot& program = add_c("", webots, "", 64, "program");
  Robot& firmware = add_robot_with_source(
      "#include <libpic30.h>\n#include <motor_led/e_init_port.h>\n#include "
      "<motor_led/advance_one_timer/e_agenda.h>\n"
      "#include <motor_led/advance_one_timer/e_motors.h>\n"
      "volatile int ms; static void tick(void) { ms++; }\n"
      "static void second(void) { int until = ms + 1000; while (ms < until) ; }\n"
      "int main(void) { e_init_port(); e_init_motors(); e_start_agendas_processing(); "
      "e_activate_agenda(tick, 10); second();\n" +
          own + "e_set_speed_left(0); e_set_speed_right(0); while (1) ; }\n",
      "firmware");
  firmware.at(0, 2);
  run_for(5.5);
  // the driver's steps are whole tenths of a ms: 300 steps/s are 1 / 3.3 ms, 303; 800 are 833. 500 - 303 +
  // 833 - 400, and 500 + 303 + 200 - 100; the library's clock is 0.03 % off
  EXPECT_NEAR(program.left_steps(), 630, 4);
  EXPECT_NEAR(program.right_steps(), 903, 4);
  EXPECT_NEAR(program.left_steps(), firmware.left_steps(), 4);
  EXPECT_NEAR(program.right_steps(), firmware.right_steps(), 4);
  // within 2 mm and 1 degree after 0.2 m of way
  EXPECT_NEAR(program.x_m(), firmware.x_m(), 0.002);
  EXPECT_NEAR(program.y_m(), firmware.y_m() - 2, 0.002);
  EXPECT_NEAR(program.heading_deg(), firmware.heading_deg(), 1);
}

// a robot that keeps its distance: with what it sees in the loop. 32 ms steps
TEST_F(Driving, an_epuck_stops_before_a_wall_as_with_its_own_library) {
  wall(0.3, -0.2, 0.3, 0.2);
  wall(0.3, 1.8, 0.3, 2.2);
  Robot& program = add_c("WbDeviceTag ps0, ps7;",
                         "ps0 = wb_robot_get_device(\"ps0\"); ps7 = wb_robot_get_device(\"ps7\"); "
                         "wb_distance_sensor_enable(ps0, 32);\n"
                         "wb_distance_sensor_enable(ps7, 32);",
                         "int seen = (int)(wb_distance_sensor_get_value(ps0) + "
                         "wb_distance_sensor_get_value(ps7)), speed = 600 - seen;\n"
                         "wb_differential_wheels_set_speed(speed, speed);",
                         32, "program");
  Robot& firmware = add_robot_with_source(
      "#include <motor_led/e_init_port.h>\n#include <motor_led/advance_one_timer/e_agenda.h>\n"
      "#include <motor_led/advance_one_timer/e_motors.h>\n#include <a_d/advance_ad_scan/e_ad_conv.h>\n"
      "#include <a_d/advance_ad_scan/e_prox.h>\n"
      "volatile int due; static void tick(void) { due = 1; }\n"
      "int main(void) { e_init_port(); e_init_motors(); e_init_ad_scan(ALL_ADC); "
      "e_start_agendas_processing(); e_activate_agenda(tick, 320);\n"
      "while (1) { int speed; while (!due) ; due = 0; speed = 600 - e_get_prox(0) - e_get_prox(7);\n"
      "if (speed > 1000) speed = 1000; if (speed < -1000) speed = -1000; e_set_speed_left(speed); "
      "e_set_speed_right(speed); } }\n",
      "firmware");
  firmware.at(0, 2);
  run_for(8);
  EXPECT_GT(program.x_m(), 0.2) << "it came to the wall";
  EXPECT_NEAR(program.x_m(), firmware.x_m(), 0.002);
  EXPECT_EQ(program.collisions(), 0);
}

// --- camera registers

class Registers : public Driving, public ::testing::WithParamInterface<std::pair<const char*, int>> {
 protected:
  /// All registers of the camera's sensor, bank by bank.
  std::vector<int> registers(Robot& robot, int index) {
    board::Board& board = twin().mind(index).board();
    const board::Cycle at = twin().mind(index).now();
    board::I2cBus& bus = board.i2c();
    std::vector<int> all;
    (void)robot;
    for (int bank = 0; bank < GetParam().second; ++bank) {
      if (GetParam().second > 1) {
        bus.start(at);
        for (const int byte : {0xDC, 3, bank}) bus.write(static_cast<std::uint8_t>(byte), at);
        bus.stop(at);
      }
      for (int number = 0; number < 256; ++number) {
        bus.start(at);
        bus.write(0xDC, at);
        bus.write(static_cast<std::uint8_t>(number), at);
        bus.stop(at);
        bus.start(at);
        bus.write(0xDD, at);
        all.push_back(bus.read(at));
        bus.stop(at);
      }
    }
    return all;
  }
};

TEST_P(Registers, of_the_camera_are_those_that_the_library_leaves) {
  Robot& program = add_c("", "wb_camera_enable(wb_robot_get_device(\"camera\"), 64);", "", 64, "program");
  Robot& firmware = add_robot_with_source(
      "#include <p30F6014A.h>\n#include <motor_led/e_init_port.h>\n#include "
      "<camera/fast_2_timer/e_poxxxx.h>\nint wrong;\n"
      "int main(void) { e_init_port(); e_poxxxx_init_cam(); wrong = e_poxxxx_config_cam((ARRAY_WIDTH - 52 * "
      "8) / 2, (ARRAY_HEIGHT - 39 * 8) / 2,\n"
      "52 * 8, 39 * 8, 8, 8, RGB_565_MODE); e_poxxxx_write_cam_registers(); while (1) ; }\n",
      "firmware");
  firmware.at(1, 0);
  for (Robot* r : {&program, &firmware}) r->settings().own["camera"] = GetParam().first;
  run_for(1);
  EXPECT_EQ(firmware.variable("wrong"), 0);
  const auto ours = registers(program, 0), theirs = registers(firmware, 1);
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i)
    EXPECT_EQ(ours[i], theirs[i]) << "bank " << i / 256 << ", register " << i % 256;
  EXPECT_GT(std::set<int>(theirs.begin(), theirs.end()).size(), 5u) << "nothing was written";
}
INSTANTIATE_TEST_SUITE_P(Sensors, Registers,
                         ::testing::Values(std::pair{"po3030k", 1}, std::pair{"po6030k", 2},
                                           std::pair{"po8030d", 2}),
                         [](const auto& info) { return std::string(info.param.first); });

}  // namespace
