// SPDX-License-Identifier: MIT
// The interfaces of Webots on the e-puck: time, sensors, wheels, packets, truth, console, and what is
// refused.
#include <cmath>
#include <filesystem>
#include <fstream>

#include "hal_sim/cc/build.h"
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

class Webots : public FirmwareTest {
 protected:
  /// A program of today's interface: declarations, then what runs before the loop, then the loop's body.
  Robot& add(const std::string& globals, const std::string& before, const std::string& loop, int step_ms = 64,
             const std::string& name = "") {
    return add_robot_with_source(
        "#include <math.h>\n#include <stdio.h>\n#include <string.h>\n#include <stdlib.h>\n#include <time.h>\n"
        "#include <webots/robot.h>\n#include <webots/distance_sensor.h>\n#include <webots/light_sensor.h>\n"
        "#include <webots/motor.h>\n#include <webots/position_sensor.h>\n#include "
        "<webots/differential_wheels.h>\n"
        "#include <webots/led.h>\n#include <webots/emitter.h>\n#include <webots/receiver.h>\n#include "
        "<webots/gps.h>\n"
        "#include <webots/compass.h>\n#include <webots/accelerometer.h>\n#include <webots/gyro.h>\n"
        "#include <webots/camera.h>\n#include <webots/supervisor.h>\n"
        "int steps;\n" +
            globals + "\nint main(void) {\nwb_robot_init();\n" + before + "\nwhile (wb_robot_step(" +
            std::to_string(step_ms) + ") != -1) {\nsteps++;\n" + loop +
            "\n}\nwb_robot_cleanup();\nreturn 0;\n}\n",
        name);
  }
};

// --- time -------------------------------------------------------------------------------------------------

// an agenda counts ticks of 1475 cycles, 0.100030 ms; steps of 10 ms are 99.97 of them. After 20 s no tick is
// lost.
TEST_F(Webots, steps_are_exact_in_the_long_run) {
  Robot& r = add("double t;", "", "t = wb_robot_get_time();", 10);
  run_for(1.0);
  const int before = r.variable("steps");
  run_for(20.0);
  EXPECT_NEAR(r.variable("steps") - before, 2000, 1);
  EXPECT_FLOAT_EQ(r.variable<float>("t"), static_cast<float>(r.variable("steps")) * 0.01f);
}

// a step that takes 1.5 times as long as it should is followed by one that ends at the next multiple
TEST_F(Webots, a_late_step_ends_at_a_multiple_of_the_step) {
  Robot& r = add(
      "double first, second;", "",
      "if (steps == 1) { long i; first = wb_robot_get_time(); for (i = 0; i < 96; i++) __delay32(14746); }\n"
      "if (steps == 2) second = wb_robot_get_time();");
  run_for(1.0);
  EXPECT_FLOAT_EQ(r.variable<float>("first"), 0.064f);
  EXPECT_FLOAT_EQ(r.variable<float>("second"), 0.192f);
}

TEST_F(Webots, robot_run_waits_for_as_long_as_it_was_told_and_says_how_long_that_was) {
  Robot& r = add_robot_with_source(
      "#include <device/robot.h>\n#include <device/distance_sensor.h>\n"
      "int told[4], calls, value[4]; DeviceTag ps;\n"
      "static void reset(void) { ps = robot_get_device(\"ps0\"); distance_sensor_enable(ps, 64); }\n"
      "static int run(int ms) {\n"
      "  if (calls < 4) { told[calls] = ms; value[calls] = distance_sensor_get_value(ps); }\n"
      "  calls++;\n  return calls == 1 ? 64 : calls == 2 ? 640 : 6400;\n}\n"
      "int main() { robot_live(reset); robot_run(run); return 0; }\n");
  wall(0.05, -0.2, 0.05, 0.2);
  run_for(0.9);
  EXPECT_EQ(r.variable("calls"), 2);
  run_for(0.2);
  EXPECT_EQ(r.variable("calls"), 3);
  run_for(6.0);
  EXPECT_EQ(r.variable("calls"), 3);
  run_for(0.5);
  EXPECT_EQ(r.variables("told", 4), (std::vector<std::int16_t>{0, 64, 640, 6400}));
  EXPECT_EQ(r.variables("value", 4)[0], 0) << "a value before the first period was over";
  EXPECT_GT(r.variables("value", 4)[1], 1000);
}

// --- sensors ----------------------------------------------------------------------------------------------

// a wall 1 cm from the right side: ps2 of the product, ps7 of the lab; the others look elsewhere
TEST_F(Webots, both_numberings_of_the_sensors) {
  const std::string globals = "WbDeviceTag ps[8]; int value[8];";
  const std::string before =
      "int i; for (i = 0; i < 8; i++) { char name[4]; sprintf(name, \"ps%d\", i); ps[i] = "
      "wb_robot_get_device(name);\n"
      "wb_distance_sensor_enable(ps[i], 64); }";
  const std::string loop = "int i; for (i = 0; i < 8; i++) value[i] = wb_distance_sensor_get_value(ps[i]);";
  wall(-0.3, -0.047, 0.3, -0.047);
  Robot& r = add(globals, before, loop);
  run_for(1.0);
  const auto product = r.variables("value", 8);
  EXPECT_GT(product[2], 1000);
  for (int i : {0, 4, 5, 6, 7}) EXPECT_LT(product[static_cast<std::size_t>(i)], 200) << i;
}

TEST_F(Webots, lab_numbering_counts_from_the_left) {
  world.webots.sensor_order = "lab";
  wall(-0.3, 0.047, 0.3, 0.047);  // to the left
  Robot& r = add("WbDeviceTag ps; int value;",
                 "ps = wb_robot_get_device(\"ps0\"); wb_distance_sensor_enable(ps, 64);",
                 "value = wb_distance_sensor_get_value(ps);");
  run_for(1.0);
  EXPECT_GT(r.variable("value"), 1000);
}

TEST_F(Webots, a_value_is_there_one_period_after_enable_and_not_before) {
  Robot& r = add("WbDeviceTag ps, ls; int first, nan_before, unset_at[3]; double dark;",
                 "ps = wb_robot_get_device(\"ps0\"); ls = wb_robot_get_device(\"ls0\");\n"
                 "wb_distance_sensor_enable(ps, 128); wb_light_sensor_enable(ls, 64);\n"
                 "nan_before = isnan(wb_distance_sensor_get_value(ps));",
                 "if (steps <= 3) unset_at[steps - 1] = isnan(wb_distance_sensor_get_value(ps));\n"
                 "dark = wb_light_sensor_get_value(ls);");
  run_for(1.0);
  EXPECT_EQ(r.variable("nan_before"), 1);
  EXPECT_EQ(r.variables("unset_at", 3), (std::vector<std::int16_t>{1, 0, 0}));
  EXPECT_GT(r.variable<float>("dark"), 3900) << "dark is nearly 4095";
}

TEST_F(Webots, ground_sensors_are_there_when_the_robot_carries_them) {
  const std::string globals = "WbDeviceTag gs; int value, tag;";
  const std::string before =
      "gs = wb_robot_get_device(\"gs1\"); tag = gs; if (gs) wb_distance_sensor_enable(gs, 64);";
  const std::string loop = "if (gs) value = wb_distance_sensor_get_value(gs);";
  world.floor.colour = {1, 1, 1};
  Robot& without = add(globals, before, loop, 64, "without");
  Robot& with = add(globals, before, loop, 64, "with").at(0.3, 0);
  with.settings().parts.push_back({});
  with.settings().parts.back().kind = "ground-sensors";
  run_for(0.8);
  EXPECT_EQ(without.variable("tag"), 0);
  ASSERT_EQ(without.console().size(), 1u);
  EXPECT_NE(without.console()[0].find("got device \"gs1\""), std::string::npos);
  EXPECT_NEAR(with.variable("value"), 856, 100);  // white [docs/parts.md]
}

TEST_F(Webots, at_rest_the_accelerometer_shows_gravity_upwards_in_either_convention) {
  const std::string globals = "WbDeviceTag acc; double x, y, z;";
  const std::string before =
      "acc = wb_robot_get_device(\"accelerometer\"); wb_accelerometer_enable(acc, 64);";
  const std::string loop =
      "const double *v = wb_accelerometer_get_values(acc); x = v[0]; y = v[1]; z = v[2];";
  Robot& r = add(globals, before, loop);
  r.settings().variation.motion_noise_scale = 0;
  run_for(1.0);
  EXPECT_NEAR(r.variable<float>("z"), 9.81, 0.05);
  EXPECT_NEAR(r.variable<float>("x"), 0, 0.05);
}

// --- wheels -----------------------------------------------------------------------------------------------

// 3.14 rad/s: 500 steps/s [e_motors.h: 500 gives 500]
TEST_F(Webots, a_velocity_is_reached_once_the_position_is_infinite) {
  Robot& r =
      add("WbDeviceTag left, right, sensor; double position, speed;",
          "left = wb_robot_get_device(\"left wheel motor\"); right = wb_robot_get_device(\"right wheel "
          "motor\");\n"
          "wb_motor_set_position(left, INFINITY); wb_motor_set_position(right, INFINITY);\n"
          "wb_motor_set_velocity(left, 3.1416); wb_motor_set_velocity(right, -3.1416);\n"
          "sensor = wb_robot_get_device(\"left wheel sensor\"); wb_position_sensor_enable(sensor, 64);",
          "position = wb_position_sensor_get_value(sensor); speed = wb_motor_get_velocity(right);");
  run_for(0.5);
  const auto left = r.left_steps(), right = r.right_steps();
  run_for(2.0);
  EXPECT_NEAR(r.left_steps() - left, 1000, 5);
  EXPECT_NEAR(r.right_steps() - right, -1000, 5);
  EXPECT_NEAR(r.variable<float>("position"), r.left_steps() * 2 * M_PI / 1000, 0.064 * 3.1416 + 0.05);
  EXPECT_FLOAT_EQ(r.variable<float>("speed"), -3.1416f);
}

TEST_F(Webots, a_velocity_without_an_infinite_position_moves_nothing) {
  Robot& r = add("", "wb_motor_set_velocity(wb_robot_get_device(\"left wheel motor\"), 6);", "");
  run_for(1.0);
  EXPECT_EQ(r.left_steps(), 0);
}

// a turn and a half is 1500 steps, there and back, to the step
TEST_F(Webots, a_position_is_reached_to_the_step_and_held) {
  Robot& r = add("WbDeviceTag left;",
                 "left = wb_robot_get_device(\"left wheel motor\"); wb_motor_set_velocity(left, 6.28);\n"
                 "wb_motor_set_position(left, 9.42478);",
                 "if (steps == 100) wb_motor_set_position(left, -3.14159);");
  run_for(6.0);
  EXPECT_EQ(r.left_steps(), 1500);
  run_for(8.0);
  EXPECT_EQ(r.left_steps(), -500);
  EXPECT_EQ(r.right_steps(), 0);
}

// 0.00628 rad/s a unit: 500 units are half a turn a second; encoders count from where they were set
TEST_F(Webots, differential_wheels_take_units_and_count_steps) {
  Robot& r =
      add("double left, right;",
          "wb_differential_wheels_enable_encoders(64); wb_differential_wheels_set_encoders(100, -100);\n"
          "wb_differential_wheels_set_speed(500, -500);",
          "left = wb_differential_wheels_get_left_encoder(); right = "
          "wb_differential_wheels_get_right_encoder();");
  run_for(2.0);
  EXPECT_NEAR(r.left_steps(), 500 * (2.0 - 0.24), 15);
  EXPECT_NEAR(r.variable<float>("left"), r.left_steps() + 100, 40);
  EXPECT_NEAR(r.variable<float>("right"), r.right_steps() - 100, 40);
}

TEST_F(Webots, the_world_sets_the_speed_unit) {
  world.webots.speed_unit_rad_s = 0.1;
  Robot& r =
      add("double unit;",
          "wb_differential_wheels_set_speed(31.416, 0); unit = wb_differential_wheels_get_speed_unit();", "");
  run_for(0.5);
  const auto left = r.left_steps();
  run_for(2.0);
  EXPECT_NEAR(r.left_steps() - left, 1000, 5);  // 3.1416 rad/s
  EXPECT_FLOAT_EQ(r.variable<float>("unit"), 0.1f);
}

TEST_F(Webots, leds_shine_and_colours_above_16_bits_count_as_on) {
  Robot& r = add(
      "",
      "wb_led_set(wb_robot_get_device(\"led3\"), 0xFF0000); wb_led_set(wb_robot_get_device(\"led8\"), 1);",
      "");
  run_for(0.5);
  EXPECT_EQ(r.leds(), 1u << 3 | 1u << 8);
}

// --- packets ----------------------------------------------------------------------------------------------

TEST_F(Webots, robots_send_packets_and_hear_where_they_come_from) {
  add("char text[8];", "", "if (steps == 5) wb_emitter_send(wb_robot_get_device(\"emitter\"), \"hello\", 6);",
      64, "a");
  Robot& b = add("WbDeviceTag r; char text[8]; int got, size; double strength, dx, dy;",
                 "r = wb_robot_get_device(\"receiver\"); wb_receiver_enable(r, 64);",
                 "if (wb_receiver_get_queue_length(r) > 0) {\n"
                 "const double *d = wb_receiver_get_emitter_direction(r); dx = d[0]; dy = d[1];\n"
                 "strcpy(text, (const char *)wb_receiver_get_data(r)); size = wb_receiver_get_data_size(r);\n"
                 "strength = wb_receiver_get_signal_strength(r); got++; wb_receiver_next_packet(r); }",
                 64, "b")
                 .at(0.5, 0, 90);
  Robot& deaf =
      add("WbDeviceTag r; int got;",
          "r = wb_robot_get_device(\"receiver\"); wb_receiver_enable(r, 64); wb_receiver_set_channel(r, 7);",
          "got += wb_receiver_get_queue_length(r);", 64, "c")
          .at(-0.5, 0);
  run_for(1.5);
  EXPECT_EQ(b.variable("got"), 1);
  EXPECT_EQ(b.variable("size"), 6);
  const auto text = b.variables<char>("text", 8);
  EXPECT_STREQ(text.data(), "hello");
  EXPECT_NEAR(b.variable<float>("strength"), 4, 0.01);  // 1 / 0.5^2
  EXPECT_NEAR(b.variable<float>("dy"), 1, 1e-4);        // to its left
  EXPECT_EQ(deaf.variable("got"), 0);
}

// 4096 bytes hold 39 packets of 96 + 8 bytes; a thousand of them cannot all leave in the few ticks that the
// loop takes, and some steps later there is room again
TEST_F(Webots, an_emitters_queue_is_finite_and_empties) {
  Robot& a = add("WbDeviceTag e; char data[96]; int sent, later;", "e = wb_robot_get_device(\"emitter\");",
                 "int i; if (steps == 1) for (i = 0; i < 1000; i++) sent += wb_emitter_send(e, data, 96);\n"
                 "if (steps == 5) later = wb_emitter_send(e, data, 96);");
  run_for(1.5);
  EXPECT_GE(a.variable("sent"), 4096 / 104);
  EXPECT_LT(a.variable("sent"), 1000);
  EXPECT_EQ(a.variable("later"), 1);
}

// --- what only the simulator has --------------------------------------------------------------------------

class Truth : public Webots {
 protected:
  Robot& add_with_devices() {
    Robot& r = add("WbDeviceTag gps, compass; double x, y, z, north[3];",
                   "gps = wb_robot_get_device(\"gps\"); wb_gps_enable(gps, 64);\n"
                   "compass = wb_robot_get_device(\"north\"); wb_compass_enable(compass, 64);",
                   "const double *p = wb_gps_get_values(gps); x = p[0]; y = p[1]; z = p[2];\n"
                   "memcpy(north, wb_compass_get_values(compass), sizeof north);");
    sim::DeviceDesc gps, compass;
    gps.name = "gps";
    compass.name = "north";
    compass.kind = sim::DeviceKind::Compass;
    r.settings().devices = {gps, compass};
    return r.at(0.2, 0.1, 30);
  }
};

TEST_F(Truth, gps_and_compass_in_todays_axes) {
  Robot& r = add_with_devices();
  run_for(0.6);
  EXPECT_NEAR(r.variable<float>("x"), 0.2, 1e-5);
  EXPECT_NEAR(r.variable<float>("y"), 0.1, 1e-5);
  const auto north = r.variables<float>("north", 3);  // 60 degrees to its left
  EXPECT_NEAR(north[0], 0.5, 1e-5);
  EXPECT_NEAR(north[1], std::sqrt(0.75), 1e-5);
}

// x right, y up, z towards the reader; north is the world's x axis, in the robot's right, up, backward: the
// robot looks 30 degrees to the left of it
TEST_F(Truth, gps_and_compass_in_older_axes) {
  world.webots.axes = sim::Axes::Nue;
  Robot& r = add_with_devices();
  run_for(0.6);
  EXPECT_NEAR(r.variable<float>("x"), 0.2, 1e-5);
  EXPECT_NEAR(r.variable<float>("y"), 0, 1e-5);
  EXPECT_NEAR(r.variable<float>("z"), -0.1, 1e-5);
  const auto north = r.variables<float>("north", 3);
  EXPECT_NEAR(north[0], 0.5, 1e-5);
  EXPECT_NEAR(north[2], -std::sqrt(0.75), 1e-5);
}

TEST_F(Webots, a_supervisors_sensor_is_a_distance_sensor_of_its_name) {
  Robot& r = add("WbDeviceTag s; double value;",
                 "while (wb_robot_step(64) != -1 && !(s = wb_robot_get_device(\"beacon\"))) ;\n"
                 "wb_distance_sensor_enable(s, 64);",
                 "value = wb_distance_sensor_get_value(s);");
  run_for(0.5);
  EXPECT_EQ(r.variable("steps"), 0);
  r.define_sensor("beacon", 2.5);
  run_for(0.4);
  EXPECT_FLOAT_EQ(r.variable<float>("value"), 2.5f);
  r.define_sensor("beacon", -1);
  run_for(0.2);
  EXPECT_FLOAT_EQ(r.variable<float>("value"), -1);
}

TEST_F(Webots, printf_goes_to_the_console_line_by_line) {
  Robot& r = add("", "printf(\"half \"); printf(\"a line %d %.2f\\n\\fnext\\n\", 7, 0.25);", "");
  run_for(0.5);
  EXPECT_EQ(r.console(), (std::vector<std::string>{"half a line 7 0.25", "next"}));
  EXPECT_EQ(r.uart1_text(), "");
}

TEST_F(Webots, main_that_returns_has_ended_and_is_no_fault) {
  Robot& r = add_robot_with_source(
      "#include <webots/robot.h>\n#include <webots/led.h>\nint runs;\n"
      "int main(void) { wb_robot_init(); runs++; wb_led_set(wb_robot_get_device(\"led0\"), 1); "
      "wb_robot_cleanup(); "
      "return 0; }\n");
  run_for(2.0);
  EXPECT_EQ(r.variable("runs"), 1);
  EXPECT_TRUE(r.led(0));
  expect_no_traps();
}

// srand(time(NULL)): robots differ, and a run repeats
TEST_F(Webots, the_calendar_is_simulated_and_each_robots_own) {
  const std::string globals = "long begun, now;";
  Robot& a = add(globals, "begun = time(NULL);", "now = time(NULL);", 64, "a");
  Robot& b = add(globals, "begun = time(NULL);", "now = time(NULL);", 64, "b").at(0.3, 0);
  run_for(3.5);
  EXPECT_NE(a.variable<std::int32_t>("begun"), b.variable<std::int32_t>("begun"));
  EXPECT_EQ(a.variable<std::int32_t>("now") - a.variable<std::int32_t>("begun"), 3);
}

TEST_F(Webots, a_controller_finds_itself_and_others_in_the_world) {
  Robot& r =
      add("double x, y, angle;",
          "WbNodeRef me = wb_supervisor_node_get_self(); WbNodeRef ball = "
          "wb_supervisor_node_get_from_def(\"BALL\");",
          "angle = wb_supervisor_field_get_sf_rotation(wb_supervisor_node_get_field(me, \"rotation\"))[3];\n"
          "x = wb_supervisor_node_get_position(me)[0];\n"
          "y = wb_supervisor_field_get_sf_vec3f(wb_supervisor_node_get_field(ball, \"translation\"))[1];");
  r.at(0.2, 0, 40);
  sim::ObjectDesc ball;
  ball.kind = sim::ObjectKind::Ball;
  ball.def = "BALL";
  ball.radius_m = 0.02;
  ball.movable = true;
  ball.pose = {-0.2, 0.3, 0};
  world.objects.push_back(ball);
  run_for(0.5);
  EXPECT_NEAR(r.variable<float>("x"), 0.2, 1e-5);
  EXPECT_NEAR(r.variable<float>("y"), 0.3, 1e-5);
  EXPECT_NEAR(r.variable<float>("angle"), sim::radians(40), 1e-4);
}

// Webots places solids by their middle: a box of 10 cm that stands on a table of 20 cm
TEST_F(Webots, a_controller_finds_fixed_objects_and_how_high_they_are) {
  Robot& r =
      add("double x, z, angle, loose;",
          "WbNodeRef box = wb_supervisor_node_get_from_def(\"BOX\");\n"
          "WbNodeRef crate = wb_supervisor_node_get_from_def(\"crate\");\n"
          "x = wb_supervisor_node_get_position(box)[0]; z = wb_supervisor_node_get_position(box)[2];\n"
          "angle = wb_supervisor_field_get_sf_rotation(wb_supervisor_node_get_field(box, \"rotation\"))[3];\n"
          "loose = wb_supervisor_node_get_position(crate)[2];",
          "");
  sim::ObjectDesc box;
  box.def = "BOX";
  box.pose = {0.4, 0.3, sim::radians(30)};
  box.z_m = 0.2;
  world.objects.push_back(box);
  sim::ObjectDesc crate;
  crate.name = "crate";
  crate.movable = true;
  crate.size_m = {0.05, 0.05, 0.06};
  crate.pose = {-0.4, 0.3, 0};
  world.objects.push_back(crate);
  run_for(0.5);
  EXPECT_NEAR(r.variable<float>("x"), 0.4, 1e-5);
  EXPECT_NEAR(r.variable<float>("z"), 0.25, 1e-5);
  EXPECT_NEAR(r.variable<float>("angle"), sim::radians(30), 1e-4);
  EXPECT_NEAR(r.variable<float>("loose"), 0.03, 1e-3);
}

// red is bright where a red wall stands, and BGRA has it in the third byte
TEST_F(Webots, the_camera_shows_a_red_wall_in_red) {
  wall(0.2, -0.5, 0.2, 0.5, {1, 0, 0});
  Robot& r = add(
      "WbDeviceTag camera; int width, red, blue, pictures;",
      "camera = wb_robot_get_device(\"camera\"); wb_camera_enable(camera, 128); width = "
      "wb_camera_get_width(camera);",
      "const unsigned char *p = wb_camera_get_image(camera); if (p) { pictures++;\n"
      "red = wb_camera_image_get_red(p, width, 26, 18); blue = wb_camera_image_get_blue(p, width, 26, 18); }",
      128);
  run_for(2.0);
  EXPECT_GT(r.variable("pictures"), 0);
  EXPECT_GT(r.variable("red"), 2 * r.variable("blue") + 20);
  expect_no_traps();
}

// --- what is refused --------------------------------------------------------------------------------------

std::string errors_of(const std::string& source) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "twinpuck-webots-refused";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "main.c") << source;
  cc::BuildOptions options;
  options.source_dir = folder;
  options.output = folder / "refused.so";
  const cc::BuildResult result = cc::build_image(options);
  EXPECT_FALSE(result.ok);
  std::string all;
  for (const std::string& e : result.errors) all += e + "\n";
  return all;
}

// the file that is named as the folder is the program; one that it includes as text is part of it, another
// program beside it is not
TEST(WebotsSources, the_file_named_as_the_folder_is_the_program) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "twinpuck_webots_sources";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "twinpuck_webots_sources.c")
      << "#include <webots/robot.h>\n#include \"part.c\"\nint main() { for (int i = 0; i < part(); i++) ; "
         "for (int "
         "i = 0; i < 2; i++) ; return 0; }\n";
  std::ofstream(folder / "part.c") << "int part() { return 3; }\n";
  std::ofstream(folder / "older.c")
      << "#include <webots/robot.h>\nint part() { return 4; }\nint main() { return 0; }\n";
  std::ofstream(folder / "helper.c") << "int helper() { return 5; }\n";
  cc::BuildOptions options;
  options.source_dir = folder;
  options.output = folder / "out.so";
  const cc::BuildResult result = cc::build_image(options);
  EXPECT_TRUE(result.ok) << (result.errors.empty() ? "" : result.errors[0]);
}

TEST(WebotsRefused, functions_of_supervisors_are_refused_by_name_with_a_hint) {
  const std::string errors = errors_of(
      "#include <webots/robot.h>\n#include <webots/supervisor.h>\n"
      "int main(void) { wb_robot_init(); wb_supervisor_simulation_quit(0); return 0; }\n");
  EXPECT_NE(errors.find("wb_supervisor_simulation_quit()"), std::string::npos) << errors;
  EXPECT_NE(errors.find("docs/webots.md"), std::string::npos) << errors;
}

// as XC16's time(), which programs seed their random numbers with
TEST_F(Webots, firmware_of_the_robot_counts_cycles_instead_of_a_calendar) {
  Robot& r = add_robot_with_source(
      "#include <time.h>\n#include <libpic30.h>\nlong first, later, ticks;\nint main(void) { time_t t; first "
      "= time(0); "
      "__delay32(1000000); later = time(&t); ticks = clock() - t; while (1); }\n");
  run_for(0.2);
  EXPECT_LT(r.variable<std::int32_t>("first"), 20);
  EXPECT_NEAR(r.variable<std::int32_t>("later"), 1000000, 200);
  EXPECT_LT(r.variable<std::int32_t>("ticks"), 200);
  expect_no_traps();
}

}  // namespace
