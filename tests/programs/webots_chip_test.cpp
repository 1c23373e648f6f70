// SPDX-License-Identifier: MIT
// Programs for Webots' interfaces on the chip: the same C file that is a program of the PC, flashed. They do
// what they do there with what the robot has, and what it has not is named where the program asks for it.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "compiler/build/build.h"
#include "tests/support/firmware_test.h"
#include "tests/support/wording.h"
#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;
using firmware_test::Robot;

class WebotsOnChip : public firmware_test::FirmwareTest {
 protected:
  WebotsOnChip() { options.hal = "dspic"; }
};

const char* const kAvoid = R"(
#include <webots/robot.h>
#include <webots/motor.h>
#include <webots/distance_sensor.h>
#define TIME_STEP 64
int main(int argc, char **argv) {
  int i;
  WbDeviceTag ps[8], left, right;
  char name[] = "ps0";
  wb_robot_init();
  for (i = 0; i < 8; i++) {
    name[2] = '0' + i;
    ps[i] = wb_robot_get_device(name);
    wb_distance_sensor_enable(ps[i], TIME_STEP);
  }
  left = wb_robot_get_device("left wheel motor");
  right = wb_robot_get_device("right wheel motor");
  wb_motor_set_position(left, INFINITY);
  wb_motor_set_position(right, INFINITY);
  while (wb_robot_step(TIME_STEP) != -1) {
    double v[8], l = 3, r = 3;
    for (i = 0; i < 8; i++) v[i] = wb_distance_sensor_get_value(ps[i]);
    if (v[5] > 80 || v[6] > 80 || v[7] > 80) {
      l += 3; r -= 3;
    } else if (v[0] > 80 || v[1] > 80 || v[2] > 80) {
      l -= 3; r += 3;
    }
    wb_motor_set_velocity(left, l);
    wb_motor_set_velocity(right, r);
  }
  wb_robot_cleanup();
  return 0;
}
)";

TEST_F(WebotsOnChip, avoids_the_walls_of_a_maze) {
  load_world("worlds/maze.toml");
  robot(0).settings().firmware = "";
  const fs::path folder = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "chip_avoid";
  fs::create_directories(folder);
  std::ofstream(folder / "chip_avoid.c") << kAvoid;
  robot(0).settings().firmware = folder.string();
  run_for(20);
  EXPECT_EQ(robot(0).collisions(), 0);
  EXPECT_GT(robot(0).distance_m(), 1.2);  // 20 s at 3 rad/s are 1.23 m, turns on the spot aside
  expect_no_traps();
  expect_no_diagnoses();
}

// 3 rad/s are 477.5 steps/s; the driver's period is 10000 / 477 = 20 ticks of 0.1 ms, 500 steps/s
TEST_F(WebotsOnChip, wheels_turn_to_a_speed_and_to_a_position) {
  Robot& r = add_robot_with_source(R"(
#include <webots/robot.h>
#include <webots/motor.h>
#include <webots/position_sensor.h>
#include <webots/led.h>
double angle;
int main(void) {
  WbDeviceTag left, right, sensor;
  int i;
  wb_robot_init();
  left = wb_robot_get_device("left wheel motor"), right = wb_robot_get_device("right wheel motor");
  sensor = wb_motor_get_position_sensor(right);
  wb_position_sensor_enable(sensor, 32);
  wb_motor_set_position(left, INFINITY);
  wb_motor_set_velocity(left, 3.0);
  wb_motor_set_velocity(right, 3.0);
  wb_motor_set_position(right, 2.0);
  wb_led_set(wb_robot_get_device("led8"), 1);
  for (i = 0; wb_robot_step(32) != -1; i++) angle = wb_position_sensor_get_value(sensor);
})");
  run_for(1);
  const auto left = r.left_steps();
  run_for(2);
  EXPECT_NEAR(r.left_steps() - left, 2 * 500, 15);
  EXPECT_NEAR(r.right_steps(), 318, 3);  // 2 rad / 2 pi * 1000
  EXPECT_NEAR(r.variable<float>("angle"), 2.0, 0.02);
  EXPECT_TRUE(r.led(8));
  expect_no_traps();
}

/// What `make dspic` flashes: no world has been asked.
std::string image_of(const std::string& controller) {
  cc::BuildOptions o;
  o.source_dir = fs::path(TWINPUCK_SOURCE_DIR) / "firmware" / controller;
  o.output = fs::path(TWINPUCK_BUILD_DIR) / "tests" / ("flashed_" + controller + ".elf");
  o.optimisation = "-O1";
  const auto result = cc::build_image(o);
  EXPECT_TRUE(result.ok);
  return o.output.string();
}

// the interface of 2005 has the lab's units and numbers on the robot: 20 and 16 are 2 and 1.6 rad/s (see
// firmware/e-puck/test.cpp), ps2 is one of the two in front
TEST_F(WebotsOnChip, the_lab_s_example_drives_as_in_its_worlds) {
  Robot& r = add_robot(image_of("e-puck"));
  run_for(0.3);
  const auto left = r.left_steps(), right = r.right_steps();
  run_for(4.0);
  EXPECT_NEAR(r.left_steps() - left, 4.0 * 322.6, 15);
  EXPECT_NEAR(r.right_steps() - right, 4.0 * 256.4, 12);
  EXPECT_EQ(r.uart(1).text().substr(0, 2), "v=");  // its text goes to UART 1
  expect_no_traps();
}

TEST_F(WebotsOnChip, the_lab_s_example_sees_a_wall_ahead_with_its_one_sensor) {
  wall(0.055, -0.2, 0.055, 0.2);
  Robot& r = add_robot(image_of("e-puck"));
  const double start = r.heading_deg();
  run_for(1.5);
  EXPECT_LT(r.heading_deg(), start - 60);  // it spins clockwise
}

// in a world that says nothing 20 units are 20 * 0.00628 = 0.126 rad/s, 20 steps/s, as for
// the program of the PC
TEST_F(WebotsOnChip, a_world_s_settings_go_before_those_of_the_interface) {
  Robot& r = add_robot("e-puck");
  run_for(4.3);
  EXPECT_NEAR(r.left_steps(), 4 * 20, 4);
}

TEST_F(WebotsOnChip, the_same_controller_has_the_settings_of_another_world) {
  world.webots.speed_unit_rad_s = 0.05;
  world.webots.sensor_order = "product";
  wall(-0.2, -0.055, 0.2, -0.055);  // to its right, where ps2 of the product looks
  Robot& r = add_robot("e-puck");
  run_for(1);
  const std::string text = r.uart(1).text();
  const std::size_t last = text.rfind("v=", text.rfind('\n'));
  ASSERT_NE(last, std::string::npos) << text;
  EXPECT_GT(std::atoi(text.c_str() + last + 2), 512) << text;
}

// obstacle avoidance as the lab has it: numbers of the lab, speeds of up to 20 units, no main loop
TEST_F(WebotsOnChip, a_program_of_2005_avoids_the_walls_of_a_maze) {
  load_world("worlds/maze.toml");
  world.webots.speed_unit_rad_s = 0.1;
  world.webots.sensor_order = "lab";
  const fs::path folder = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "chip_avoid_2005";
  fs::create_directories(folder);
  std::ofstream(folder / "chip_avoid_2005.c") << R"(
#include <device/robot.h>
#include <device/differential_wheels.h>
#include <device/distance_sensor.h>
static DeviceTag ps[8];
static const char *names[8] = {"ps0", "ps1", "ps2", "ps3", "ps4", "ps5", "ps6", "ps7"};
static void reset(void) {
  int i;
  for (i = 0; i < 8; i++) {
    ps[i] = robot_get_device(names[i]);
    distance_sensor_enable(ps[i], 64);
  }
}
static int run(int ms) {
  /* in front 2 to the left and 3, 4 to the right of the middle; beside 1 and 5 */
  int left = distance_sensor_get_value(ps[2]) / 4 + distance_sensor_get_value(ps[1]) / 8;
  int right = distance_sensor_get_value(ps[3]) / 4 + distance_sensor_get_value(ps[4]) / 8;
  if (left > 30 || right > 30)
    differential_wheels_set_speed(left > right ? 20 : -20, left > right ? -20 : 20);
  else
    differential_wheels_set_speed(20, 20);
  return 64;
}
int main(void) {
  robot_live(reset);
  robot_run(run);
  return 0;
}
)";
  robot(0).settings().firmware = folder.string();
  run_for(20);
  EXPECT_LE(robot(0).longest_wall_touch_s(), 0.5);
  // 20 units of 0.1 rad/s are 0.041 m/s
  EXPECT_GT(robot(0).distance_m(), 0.4);
  EXPECT_LT(robot(0).distance_m(), 0.85);
  expect_no_traps();
}

// one picture of 4056 bytes, read by the interface's macros
TEST_F(WebotsOnChip, camera_tells_colours_of_a_picture) {
  wall(0.2, 0.0, 0.2, 1.0, {0.9, 0.1, 0.1});   // red to the left
  wall(0.2, -1.0, 0.2, 0.0, {0.1, 0.1, 0.9});  // blue to the right
  Robot& r = add_robot_with_source(R"(
#include <webots/robot.h>
#include <webots/camera.h>
int red_left, blue_left, red_right, blue_right, grey, pictures;
int main(void) {
  WbDeviceTag camera;
  int w;
  wb_robot_init();
  camera = wb_robot_get_device("camera");
  wb_camera_enable(camera, 128);
  w = wb_camera_get_width(camera);
  while (wb_robot_step(128) != -1) {
    const unsigned char *image = wb_camera_get_image(camera);
    red_left = wb_camera_image_get_red(image, w, 10, 19);
    blue_left = wb_camera_image_get_blue(image, w, 10, 19);
    red_right = wb_camera_image_get_red(image, w, 41, 19);
    blue_right = wb_camera_image_get_blue(image, w, 41, 19);
    grey = wb_camera_image_get_gray(image, w, 10, 19);
    pictures++;
  }
})");
  run_for(3);
  EXPECT_GT(r.variable("red_left"), 2 * r.variable("blue_left"));
  EXPECT_GT(r.variable("blue_right"), 2 * r.variable("red_right"));
  EXPECT_GT(r.variable("grey"), 10);
  EXPECT_LT(r.variable("grey"), r.variable("red_left"));
  EXPECT_GT(r.variable("pictures"), 15);
  // and the newest: from behind the robot nothing of both is seen
  r.push_to(0, 0, 180);
  run_for(1.5);
  EXPECT_LT(std::abs(r.variable("red_left") - r.variable("blue_left")), 60);
  expect_no_traps();
}

const char* const kTalk = R"(
#include <stdio.h>
#include <string.h>
#include <webots/robot.h>
#include <webots/emitter.h>
#include <webots/receiver.h>
int heard, size;
char text[20];
int main(void) {
  WbDeviceTag emitter, receiver;
  int n;
  wb_robot_init();
  emitter = wb_robot_get_device("emitter"), receiver = wb_robot_get_device("receiver");
  wb_receiver_enable(receiver, 64);
  if (CHANNEL) wb_emitter_set_channel(emitter, CHANNEL);
  for (n = 0; wb_robot_step(64) != -1; n++) {
    if (SPEAKS && n % 5 == 0) wb_emitter_send(emitter, "hello robot", 12);
    while (wb_receiver_get_queue_length(receiver) > 0) {
      size = wb_receiver_get_data_size(receiver);
      memcpy(text, wb_receiver_get_data(receiver), 12);
      heard++;
      wb_receiver_next_packet(receiver);
    }
  }
})";

std::string talk(const char* speaks, const char* channel) {
  return "#define SPEAKS " + std::string(speaks) + "\n#define CHANNEL " + channel + "\n" + kTalk;
}

TEST_F(WebotsOnChip, packets_go_over_the_radio_turret) {
  Robot& speaker = add_robot_with_source(talk("1", "0"), "speaker").at(-0.2, 0);
  Robot& listener = add_robot_with_source(talk("0", "0"), "listener").at(0.2, 0);
  for (Robot* r : {&speaker, &listener}) r->settings().parts.push_back({"radio", {}});
  run_for(3);
  EXPECT_GE(listener.variable("heard"), 6);  // every 320 ms, 42 steps of 64 ms after the start
  EXPECT_EQ(listener.variable("size"), 12);
  const auto text = listener.variables<char>("text", 12);
  EXPECT_STREQ(text.data(), "hello robot");
  EXPECT_EQ(speaker.variable("heard"), 0);  // nobody hears himself
  expect_no_traps();
}

TEST_F(WebotsOnChip, another_channel_is_not_heard) {
  Robot& speaker = add_robot_with_source(talk("1", "3"), "speaker").at(-0.2, 0);
  Robot& listener = add_robot_with_source(talk("0", "0"), "listener").at(0.2, 0);
  for (Robot* r : {&speaker, &listener}) r->settings().parts.push_back({"radio", {}});
  run_for(2);
  EXPECT_EQ(listener.variable("heard"), 0);
}

TEST_F(WebotsOnChip, without_a_turret_it_says_so_and_goes_on) {
  Robot& r = add_robot_with_source(talk("1", "0"));
  run_for(1);
  EXPECT_TRUE(wording::reads(
      r.uart(1).text(),
      "Warning: wb_receiver_enable(): this robot carries no radio turret, nothing is sent or heard"));
  expect_no_traps();
}

TEST_F(WebotsOnChip, every_device_of_the_robot_answers) {
  Robot& r = add_robot_with_source(R"(
#include <stdio.h>
#include <webots/robot.h>
#include <webots/device.h>
#include <webots/accelerometer.h>
#include <webots/distance_sensor.h>
#include <webots/light_sensor.h>
#include <webots/microphone.h>
#include <webots/speaker.h>
int main(void) {
  WbDeviceTag a, l, m, s, none;
  int step;
  wb_robot_init();
  printf("%d devices, mode %d\n", wb_robot_get_number_of_devices(), (int)wb_robot_get_mode());
  a = wb_robot_get_device("accelerometer"), l = wb_robot_get_device("ls3");
  m = wb_robot_get_device("mic0"), s = wb_robot_get_device("speaker");
  none = wb_robot_get_device("gps");
  wb_accelerometer_enable(a, 64), wb_light_sensor_enable(l, 64), wb_microphone_enable(m, 64);
  wb_robot_battery_sensor_enable(64);
  printf("none %u\n", none);
  wb_speaker_play_sound(s, s, "haa.wav", 1, 1, 0, 0);
  for (step = 0; wb_robot_step(64) != -1; step++)
    if (step == 3)
      printf("up %d light %d sound %d\n", (int)(wb_accelerometer_get_values(a)[2] + 0.5),
             wb_light_sensor_get_value(l) > 1000, wb_microphone_get_sample_size(m));
})");
  run_for(1.5);
  const std::string text = r.uart(1).text();
  // cross-compiled
  EXPECT_TRUE(wording::reads(text,
                             "38 devices, mode 1\nWarning: wb_robot_get_device(): got device \"gps\", "
                             "expected one that this robot has\nnone 0\nup 10 light 1 sound 200"));
  expect_no_traps();
}

// Asks each function of today's interface; numbers in thousandths.
const char* const kEachFunction = R"(
#include <math.h>
#include <stdio.h>
#include <webots/accelerometer.h>
#include <webots/console.h>
#include <webots/device.h>
#include <webots/differential_wheels.h>
#include <webots/distance_sensor.h>
#include <webots/emitter.h>
#include <webots/gyro.h>
#include <webots/led.h>
#include <webots/light_sensor.h>
#include <webots/microphone.h>
#include <webots/motor.h>
#include <webots/position_sensor.h>
#include <webots/receiver.h>
#include <webots/robot.h>
#include <webots/speaker.h>
#define K(x) ((int)(1000 * (x) + ((x) < 0 ? -0.5 : 0.5)))
int left, right, turns, charge, angle, ahead, aside, upwards;
int main(void) {
  WbDeviceTag m, s, p, l, a, g, mic, sp, led, e, r;
  wb_robot_init();
  m = wb_robot_get_device("left wheel motor"), s = wb_robot_get_device("left wheel sensor");
  p = wb_robot_get_device("ps0"), l = wb_robot_get_device("ls0"), a = wb_robot_get_device("accelerometer");
  g = wb_robot_get_device("gyro"), mic = wb_robot_get_device("mic1");
  sp = wb_robot_get_device("speaker"), led = wb_robot_get_device("led3");
  e = wb_robot_get_device("emitter"), r = wb_robot_get_device("receiver");
  printf("robot [%s] [%s] [%s] [%s] [%s] [%s]\n", wb_robot_get_name(), wb_robot_get_model(), wb_robot_get_project_path(),
         wb_robot_get_world_path(), wb_robot_get_controller_name(), wb_robot_get_custom_data());
  wb_robot_set_custom_data("some");
  printf("%s ", wb_robot_get_data());
  wb_robot_set_data("kept");
  wb_robot_set_mode(0, "");
  printf("%s %d %d %d %d\n", wb_robot_get_custom_data(), wb_robot_get_synchronization(), wb_robot_get_supervisor(),
         wb_robot_get_type() == WB_NODE_ROBOT, K(wb_robot_get_basic_time_step()));
  printf("%s %s %d %d [%s] %u\n", wb_device_get_name(m), wb_device_get_model(led), wb_device_get_node_type(g) == WB_NODE_GYRO,
         wb_device_get_type(999) == WB_NODE_NO_NODE, wb_device_get_name(0), wb_robot_get_device_by_index(99));
  printf("%d\n", wb_robot_get_device_by_index(0) == p);

  wb_motor_set_acceleration(m, 1), wb_motor_set_available_force(m, 1);
  wb_motor_set_available_torque(m, 1), wb_motor_set_control_pid(m, 1, 2, 3);
  printf("motor %d %d %d %d %d %d ", K(wb_motor_get_max_velocity(m)), K(wb_motor_get_velocity(m)),
         K(wb_motor_get_target_position(m)), K(wb_motor_get_min_position(m)), K(wb_motor_get_max_position(m)),
         K(wb_motor_get_acceleration(m)));
  wb_motor_set_position(m, 0.5), wb_motor_set_velocity(m, 2);
  printf("%d %d\n", K(wb_motor_get_target_position(m)), K(wb_motor_get_velocity(m)));
  printf("%d%d%d%d %d%d\n", wb_motor_get_type(m) == WB_ROTATIONAL, wb_motor_get_brake(m), wb_motor_get_position_sensor(m) == s,
         wb_position_sensor_get_motor(s) == m, wb_position_sensor_get_type(s) == WB_ROTATIONAL, wb_position_sensor_get_brake(s));

  wb_position_sensor_enable(s, 64), wb_distance_sensor_enable(p, 65), wb_light_sensor_enable(l, 66);
  wb_accelerometer_enable(a, 67), wb_gyro_enable(g, 68), wb_microphone_enable(mic, 70);
  wb_receiver_enable(r, 71), wb_differential_wheels_enable_encoders(72), wb_robot_battery_sensor_enable(73);
  printf("on %d %d %d %d %d %d %d %d %d\n", wb_position_sensor_get_sampling_period(s),
         wb_distance_sensor_get_sampling_period(p), wb_light_sensor_get_sampling_period(l),
         wb_accelerometer_get_sampling_period(a), wb_gyro_get_sampling_period(g),
         wb_microphone_get_sampling_period(mic), wb_receiver_get_sampling_period(r),
         wb_differential_wheels_get_encoders_sampling_period(), wb_robot_battery_sensor_get_sampling_period());
  printf("none yet %d%d%d%d%d%d%d %d\n", isnan(wb_position_sensor_get_value(s)) != 0, isnan(wb_distance_sensor_get_value(p)) != 0,
         isnan(wb_light_sensor_get_value(l)) != 0, isnan(wb_accelerometer_get_values(a)[0]) != 0,
         isnan(wb_gyro_get_values(g)[0]) != 0, isnan(wb_robot_battery_sensor_get_value()) != 0,
         wb_microphone_get_sample_data(mic) == 0, (int)wb_differential_wheels_get_left_encoder());
  printf("distance %d %d %d %d %d%d\n", (int)wb_distance_sensor_get_max_value(p), (int)wb_distance_sensor_get_min_value(p),
         K(wb_distance_sensor_get_aperture(p)), wb_distance_sensor_get_type(p) == WB_DISTANCE_SENSOR_INFRA_RED,
         wb_distance_sensor_get_lookup_table_size(p), wb_distance_sensor_get_lookup_table(p) == 0);
  printf("tables %d%d %d%d %d%d\n", wb_light_sensor_get_lookup_table_size(l), wb_light_sensor_get_lookup_table(l) == 0,
         wb_accelerometer_get_lookup_table_size(a), wb_accelerometer_get_lookup_table(a) == 0,
         wb_gyro_get_lookup_table_size(g), wb_gyro_get_lookup_table(g) == 0);
  wb_led_set(led, 5);
  printf("led %d %d\n", wb_led_get(led), wb_led_get(wb_robot_get_device("led4")));
  printf("packets %d %d %d ", wb_emitter_get_channel(e), wb_receiver_get_channel(r), wb_emitter_get_buffer_size(e));
  wb_emitter_set_channel(e, 4), wb_receiver_set_channel(r, -1);
  printf("%d %d\n", wb_emitter_get_channel(e), wb_receiver_get_channel(r));

  wb_differential_wheels_set_speed(500, -250);
  printf("wheels %d %d %d %d %d\n", (int)(wb_differential_wheels_get_left_speed() + 0.5),
         (int)(wb_differential_wheels_get_right_speed() - 0.5), K(100 * wb_differential_wheels_get_speed_unit()),
         K(wb_differential_wheels_get_max_speed()), isinf(wb_motor_get_target_position(m)) != 0);
  wb_robot_step_begin(640);
  wb_robot_step_end();
  left = (int)wb_differential_wheels_get_left_encoder(), right = (int)wb_differential_wheels_get_right_encoder();
  angle = K(wb_position_sensor_get_value(s));
  turns = (int)wb_gyro_get_values(g)[2];
  charge = (int)wb_robot_battery_sensor_get_value();
  ahead = K(wb_accelerometer_get_values(a)[0]), aside = K(wb_accelerometer_get_values(a)[1]);
  upwards = K(wb_accelerometer_get_values(a)[2]);
  wb_differential_wheels_set_speed(0, 0);
  wb_differential_wheels_set_encoders(10, -20);
  printf("set %d %d\n", (int)wb_differential_wheels_get_left_encoder(), (int)wb_differential_wheels_get_right_encoder());
  printf("time %d\n", K(wb_robot_get_time()));

  wb_speaker_play_sound(sp, sp, "haa.wav", 1, 1, 0, 1);
  printf("sound %d ", wb_speaker_is_sound_playing(sp, ""));
  wb_robot_step(500);
  printf("%d ", wb_speaker_is_sound_playing(sp, ""));  /* it lasts 0.29 s, and begins again */
  wb_speaker_stop(sp, "");
  wb_robot_step(200);
  printf("%d\n", wb_speaker_is_sound_playing(sp, ""));

  wb_position_sensor_disable(s), wb_distance_sensor_disable(p), wb_light_sensor_disable(l), wb_accelerometer_disable(a);
  wb_gyro_disable(g), wb_microphone_disable(mic), wb_receiver_disable(r);
  wb_differential_wheels_disable_encoders(), wb_robot_battery_sensor_disable();
  printf("off %d%d%d%d%d%d%d%d%d\n", wb_position_sensor_get_sampling_period(s), wb_distance_sensor_get_sampling_period(p),
         wb_light_sensor_get_sampling_period(l), wb_accelerometer_get_sampling_period(a), wb_gyro_get_sampling_period(g),
         wb_microphone_get_sampling_period(mic), wb_receiver_get_sampling_period(r),
         wb_differential_wheels_get_encoders_sampling_period(), wb_robot_battery_sensor_get_sampling_period());
  wb_robot_console_printf("%d of %s ", 3, "four");
  wb_console_print("end", WB_STDOUT);
  while (1) wb_robot_step(64);
})";

TEST_F(WebotsOnChip, each_function_answers) {
  Robot& r = add_robot_with_source(kEachFunction);
  r.settings().own["revision"] = "1.3";
  r.settings().variation.acc_offset_m_s2 = {0.5, -1, 0};
  r.battery(3.8);
  run_for(4);
  EXPECT_TRUE(wording::reads(
      r.uart(1).text(),
      "robot [e-puck] [GCtronic e-puck] [] [] [] []\n"
      "some kept 1 0 1 32000\n"
      "left wheel motor led3 1 1 [] 0\n"
      "1\n"
      "motor 6283 6283 0 0 0 -1000 500 2000\n"
      "1011 10\n"
      "Warning: wb_receiver_enable(): this robot carries no radio turret, nothing is sent or heard\n"
      "on 64 65 66 67 68 70 71 72 73\n"
      "none yet 1111111 0\n"
      "distance 4095 0 300 1 01\n"
      "tables 01 01 01\n"
      "led 5 0\n"
      "packets 1 1 108 4 -1\n"
      "wheels 500 -250 628 6283 1\n"
      "set 10 -20\n"
      "time 640\n"
      "sound 1 1 0\n"
      "off 000000000\n"
      "3 of four end"));
  // 3.14 rad/s are 500 steps/s for 0.64 s, less what the step before took; the last sample is of 576 ms or later
  EXPECT_NEAR(r.variable("left"), 0.576 * 500, 35);
  EXPECT_NEAR(r.variable("right"), -0.576 * 250, 18);
  EXPECT_NEAR(r.variable("angle"), 1000 * 320 / 159.155, 220);
  // (-250 - 500) steps/s of 0.1288 mm on 53 mm are -1.823 rad/s, times 7509.9
  EXPECT_NEAR(r.variable("turns"), -13688, 150);
  EXPECT_NEAR(r.variable("ahead"), 500, 100);
  EXPECT_NEAR(r.variable("aside"), -1000, 100);
  EXPECT_NEAR(r.variable("upwards"), 9810, 150);
  EXPECT_NEAR(r.variable("charge"), 18000 * 0.43, 400)
      << "0.3 A through 0.2 ohm take 0.06 of 3.8 V while it drives";
  expect_no_traps();
}

TEST_F(WebotsOnChip, the_camera_tells_its_size) {
  Robot& r = add_robot_with_source(R"(
#include <stdio.h>
#include <device/camera.h>
#include <webots/camera.h>
#include <webots/robot.h>
int main(void) {
  WbDeviceTag c;
  wb_robot_init();
  c = wb_robot_get_device("camera");
  printf("%d %d ", wb_camera_get_image(c) == 0, camera_get_image(c) == 0);
  wb_camera_enable(c, 69);
  printf("%d %d %d %d %d\n", wb_camera_get_sampling_period(c), wb_camera_get_width(c), wb_camera_get_height(c),
         (int)(1000 * wb_camera_get_fov(c)), (int)wb_camera_get_near(c));
  wb_camera_disable(c);
  printf("%d ", wb_camera_get_sampling_period(c));
  camera_enable(c, 70);
  camera_move_window(c, 1, 1);
  printf("%d %d %d %d ", wb_camera_get_sampling_period(c), camera_get_width(c), camera_get_height(c),
         (int)(1000 * camera_get_fov(c)));
  camera_disable(c);
  printf("%d %d\n", wb_camera_get_sampling_period(c), camera_get_image(c) == (unsigned char *)wb_camera_get_image(c));
  while (1) wb_robot_step(64);
})");
  run_for(1);
  EXPECT_TRUE(wording::reads(r.uart(1).text(), "1 1 69 52 39 840 0\n0 70 52 39 840 0 1"));
  expect_no_traps();
}

// --- building

class WebotsForChip : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/webots-chip-XXXXXX";
    folder_ = mkdtemp(name);
  }
  void TearDown() override { fs::remove_all(folder_); }
  cc::BuildResult build(const std::string& source, const char* file = "main.c") {
    std::ofstream(folder_ / file) << source;
    cc::BuildOptions o;
    o.source_dir = folder_;
    o.output = folder_ / "out.elf";
    o.optimisation = "-O1";
    return cc::build_image(o);
  }
  static std::string all(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
  }
  fs::path folder_;
};

TEST_F(WebotsForChip, what_the_robot_lacks_is_named_by_function_and_line) {
  const std::string program =
      "#include <stdio.h>\n#include <webots/robot.h>\n#include <webots/gps.h>\n#include "
      "<webots/supervisor.h>\n"
      "#include <webots/keyboard.h>\n#include <webots/display.h>\n#include <webots/receiver.h>\n"
      "int main(void) {\n"                                                      // 8
      "  wb_robot_init();\n"                                                    // 9
      "  wb_gps_enable(wb_robot_get_device(\"gps\"), 64);\n"                    // 10
      "  wb_keyboard_enable(64);\n"                                             // 11
      "  while (wb_robot_step(64) != -1) {\n"                                   // 12
      "    if (wb_supervisor_node_get_from_def(\"BALL\"))\n"                    // 13
      "      wb_display_draw_pixel(1, 2, 3);\n"                                 // 14
      "    if (wb_receiver_get_signal_strength(1) > 1) fopen(\"a\", \"w\");\n"  // 15
      "  }\n}\n";
  const auto result = build(program);
  EXPECT_FALSE(result.ok);
  EXPECT_TRUE(wording::reads(
      all(result.errors),
      "…/main.c:10: error: main() calls wb_gps_enable(): an e-puck has no GPS; count the steps of its wheels "
      "with a position sensor\n…/main.c:11: error: main() calls wb_keyboard_enable(): an e-puck has no "
      "keyboard; use its selector, getselector() of utility/utility.h\n…/main.c:13: error: main() calls "
      "wb_supervisor_node_get_from_def(): an e-puck cannot ask or change the world; leave that to a "
      "supervisor, a program of the PC, and run this one there, too\n…/main.c:14: error: main() calls "
      "wb_display_draw_pixel(): an e-puck has no display; use its LEDs, or printf(), which writes to UART "
      "1\n…/main.c:15: error: main() calls wb_receiver_get_signal_strength(): the radio turret does not tell "
      "from where and how strongly it hears; send a robot's place in the packet\n…/main.c:15: error: main() "
      "calls fopen(): an e-puck has no files; printf() writes to UART 1"));
}

TEST_F(WebotsForChip, functions_of_2005_are_named_as_well) {
  const auto result = build(
      "#include <device/robot.h>\n#include <device/gps.h>\nstatic void reset(void) {}\n"
      "int main(void) {\n  robot_live(reset);\n  gps_enable(robot_get_device(\"gps\"), 64);\n  return "
      "0;\n}\n");
  EXPECT_TRUE(wording::reads(all(result.errors),
                             "…/main.c:6: error: main() calls gps_enable(): an e-puck has no GPS; count the "
                             "steps of its wheels with a position sensor"));
}

TEST_F(WebotsForChip, a_program_in_cxx_is_named) {
  const auto result =
      build("#include <webots/Robot.hpp>\nint main() { webots::Robot r; return r.step(64); }\n", "main.cpp");
  EXPECT_TRUE(wording::reads(
      all(result.errors),
      "…/main.cpp: program: got C++, expected C; programs of the robot are in C, as XC16 has it"));
}

// "RAM   2359 of 8192 bytes (28 %)"
int ram_of(const cc::BuildResult& result) {
  const std::size_t at = result.size_report.find("RAM");
  return at == std::string::npos ? -1 : std::atoi(result.size_report.c_str() + at + 3);
}

TEST_F(WebotsForChip, a_program_takes_memory_for_what_it_uses) {
  const auto avoid = build(kAvoid);
  ASSERT_TRUE(avoid.ok) << all(avoid.errors);
  EXPECT_LT(ram_of(avoid), 2600) << avoid.size_report;  // measured: 2359
  const auto camera = build(
      "#include <webots/robot.h>\n#include <webots/camera.h>\nint main(void) { WbDeviceTag c; "
      "wb_robot_init(); "
      "c = wb_robot_get_device(\"camera\"); wb_camera_enable(c, 64); while (wb_robot_step(64) != -1) { } "
      "return 0; }\n");
  ASSERT_TRUE(camera.ok) << all(camera.errors);
  EXPECT_GT(ram_of(camera), 4056);
  EXPECT_LT(ram_of(camera), 7100) << camera.size_report;
}

}  // namespace
