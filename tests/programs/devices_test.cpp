// SPDX-License-Identifier: MIT
// Programs of Webots' interfaces and their robot: the list of devices, time, when samples are taken, what is
// neither sense nor wheel, the interface of 2005, other languages.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "tests/programs/program_fixture.h"

namespace {

using programs_test::ProgramTest;
using programs_test::Robot;

class Devices : public ProgramTest {};

// --- the list

// kinds as webots/nodes.h numbers them: the program compares, so that no number stands here
TEST_F(Devices, all_devices_of_the_page_are_there_with_their_kinds) {
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"ps0", "DISTANCE_SENSOR"},
      {"ps7", "DISTANCE_SENSOR"},
      {"ls0", "LIGHT_SENSOR"},
      {"ls7", "LIGHT_SENSOR"},
      {"gs0", "DISTANCE_SENSOR"},
      {"gs2", "DISTANCE_SENSOR"},
      {"fs0", "DISTANCE_SENSOR"},
      {"fs2", "DISTANCE_SENSOR"},
      {"left wheel motor", "ROTATIONAL_MOTOR"},
      {"right wheel motor", "ROTATIONAL_MOTOR"},
      {"left wheel sensor", "POSITION_SENSOR"},
      {"right wheel sensor", "POSITION_SENSOR"},
      {"led0", "LED"},
      {"led9", "LED"},
      {"accelerometer", "ACCELEROMETER"},
      {"gyro", "GYRO"},
      {"camera", "CAMERA"},
      {"mic0", "MICROPHONE"},
      {"mic2", "MICROPHONE"},
      {"speaker", "SPEAKER"},
      {"emitter", "EMITTER"},
      {"receiver", "RECEIVER"},
      {"gps", "GPS"},
      {"north", "COMPASS"},
      {"imu", "INERTIAL_UNIT"},
      {"screen", "DISPLAY"},
      {"tof", "DISTANCE_SENSOR"},
      {"beacon", "DISTANCE_SENSOR"}};
  std::string before = "printf(\"count %d\\n\", wb_robot_get_number_of_devices());\n";
  for (const auto& [name, kind] : expected)
    before += "{ WbDeviceTag t = wb_robot_get_device(\"" + name + "\"); printf(\"%s %d\\n\", \"" + name +
              "\", t && wb_device_get_node_type(t) == WB_NODE_" + kind +
              " && !strcmp(wb_device_get_name(t), \"" + name + "\")); }\n";
  before += "WbDeviceTag none = wb_robot_get_device(\"ps8\"); printf(\"none %d\\n\", none);\n";
  Robot& r = add_c("", before, "");
  r.settings().own["revision"] = "1.3";
  add_part(r, "ground-sensors");
  r.settings().devices = {device("gps", sim::DeviceKind::Gps), device("north", sim::DeviceKind::Compass),
                          device("imu", sim::DeviceKind::Inertial),
                          device("screen", sim::DeviceKind::Display),
                          device("beacon", sim::DeviceKind::Distance)};
  run_for(0.1);
  for (const auto& [name, kind] : expected) EXPECT_EQ(value(r, name), 1) << name << " is a " << kind;
  // 8 + 8 + 6 of the ground, tof, 10 LEDs, 4 of wheels, 2 of motion, camera, 3 + 1 of sound, 2 of radio, 5 of
  // the world, selector: 52
  EXPECT_EQ(value(r, "count"), 52);
  EXPECT_EQ(value(r, "none"), 0);
  const auto& lines = r.console();
  EXPECT_EQ(
      std::count(
          lines.begin(), lines.end(),
          "Warning: wb_robot_get_device(\"ps8\"): got device \"ps8\", expected one that this robot has"),
      1);
}

TEST_F(Devices, each_device_of_the_world_is_of_its_kind_and_size) {
  Robot& r = add_c("", R"(
#define KIND(name) wb_device_get_node_type(wb_robot_get_device(name))
    WbDeviceTag to = wb_robot_get_device("to"), from = wb_robot_get_device("from");
    WbDeviceTag screen = wb_robot_get_device("screen"), eye = wb_robot_get_device("eye");
    WbDeviceTag arm = wb_robot_get_device("arm");
    printf("kinds %d\n", KIND("to") == WB_NODE_EMITTER && KIND("from") == WB_NODE_RECEIVER &&
           KIND("screen") == WB_NODE_DISPLAY && KIND("eye") == WB_NODE_CAMERA && KIND("arm") == WB_NODE_ROTATIONAL_MOTOR &&
           KIND("bumper") == WB_NODE_TOUCH_SENSOR && KIND("photo") == WB_NODE_LIGHT_SENSOR && KIND("lamp") == WB_NODE_LED &&
           KIND("voice") == WB_NODE_SPEAKER && KIND("ink") == WB_NODE_PEN && KIND("angle") == WB_NODE_POSITION_SENSOR &&
           KIND("spin") == WB_NODE_GYRO && KIND("scan") == WB_NODE_LIDAR && KIND("depth") == WB_NODE_RANGE_FINDER);
    printf("radio %d %g %d %d\n", wb_emitter_get_channel(to), wb_emitter_get_range(to), wb_emitter_get_buffer_size(to),
           wb_receiver_get_channel(from));
    printf("size %d %d %d %d %g\n", wb_display_get_width(screen), wb_display_get_height(screen), wb_camera_get_width(eye),
           wb_camera_get_height(eye), wb_camera_get_fov(eye));
    printf("arm %g\n", wb_motor_get_max_velocity(arm));
    printf("device %d\n", KIND("eye") == KIND("camera") && eye != wb_robot_get_device("camera"));)",
                   "");
  auto& devices = r.settings().devices;
  const auto add = [&](const char* name, sim::DeviceKind kind) -> sim::DeviceDesc& {
    devices.push_back(device(name, kind));
    return devices.back();
  };
  using Kind = sim::DeviceKind;
  for (const auto& [name, kind] : std::vector<std::pair<const char*, Kind>>{{"arm", Kind::Motor},
                                                                            {"bumper", Kind::Touch},
                                                                            {"photo", Kind::Light},
                                                                            {"lamp", Kind::Led},
                                                                            {"voice", Kind::Speaker},
                                                                            {"ink", Kind::Pen},
                                                                            {"angle", Kind::Position},
                                                                            {"spin", Kind::Gyro},
                                                                            {"scan", Kind::Lidar},
                                                                            {"depth", Kind::RangeFinder}})
    add(name, kind);
  sim::DeviceDesc& to = add("to", Kind::Emitter);
  to.channel = 3;
  to.range_m = 0.75;
  add("from", Kind::Receiver).channel = 4;
  sim::DeviceDesc& screen = add("screen", Kind::Display);
  screen.width = 80;
  screen.height = 60;
  sim::DeviceDesc& eye = add("eye", Kind::Camera);
  eye.width = 12;
  eye.height = 8;
  eye.fov_rad = 0.5;
  run_for(0.1);
  using Numbers = std::vector<double>;
  EXPECT_EQ(value(r, "kinds"), 1);
  EXPECT_EQ(told(r, "radio"), (Numbers{3, 0.75, 4096, 4}));
  EXPECT_EQ(told(r, "size"), (Numbers{80, 60, 12, 8, 0.84})) << "the lens is that of the own camera";
  EXPECT_NEAR(value(r, "arm"), 6.28319, 1e-5) << "as a wheel";
  EXPECT_EQ(value(r, "device"), 1);
}

TEST_F(Devices, what_a_robot_does_not_carry_has_no_tag) {
  Robot& r = add_c("", R"(
    const char *const names[] = {"gs0", "fs1", "gps", "display", "camera"};
    for (int i = 0; i < 5; i++) printf("%s %d\n", names[i], wb_robot_get_device(names[i]));
    printf("end 0\n");)",
                   "");
  r.settings().own["camera"] = "none";
  run_for(0.1);
  for (const char* name : {"gs0", "fs1", "gps", "display", "camera"}) EXPECT_EQ(value(r, name), 0) << name;
}

// --- time

// 10 ms are 5.12 ticks of 1/512 s
TEST_F(Devices, time_is_an_exact_multiple_of_the_step) {
  Robot& r = add_c("int wrong;", "",
                   "if (wb_robot_get_time() != steps * 10 / 1000.0) wrong++;\n"
                   "printf(\"at %.17g %d %d\\n\", wb_robot_get_time(), steps, wrong);",
                   10);
  run_for(20);
  const auto at = told(r, "at");
  ASSERT_EQ(at.size(), 3u);
  EXPECT_NEAR(at[1], 2000, 1) << "none is lost in the long run";
  EXPECT_EQ(at[2], 0);
}

struct Step {
  int ms, tick_hz;
  double seconds;
};
class Steps : public Devices, public ::testing::WithParamInterface<Step> {};

TEST_P(Steps, take_as_long_as_they_say) {
  world.physics_hz = GetParam().tick_hz;
  Robot& r = add_c("", "", "printf(\"at %.17g %d\\n\", wb_robot_get_time(), steps);", GetParam().ms);
  run_for(GetParam().seconds);
  const double expected = GetParam().seconds * 1000 / GetParam().ms;
  // what ends in the last tick may be told with the next one
  EXPECT_NEAR(told(r, "at").at(1), expected, 1 + 1000.0 / GetParam().ms / GetParam().tick_hz) << "steps";
  EXPECT_EQ(told(r, "at").at(0), told(r, "at").at(1) * GetParam().ms / 1000.0);
}

INSTANTIATE_TEST_SUITE_P(Long, Steps,
                         ::testing::Values(Step{1, 512, 0.5},     // shorter than a tick
                                           Step{2, 512, 0.5},     // hardly longer
                                           Step{3, 128, 0.6},     // three in one of 7.8 ms
                                           Step{64, 512, 6.4},    // the usual one
                                           Step{500, 512, 5},     //
                                           Step{4000, 512, 9}));  // two and a bit

TEST_F(Devices, a_step_of_nothing_takes_no_time_and_samples_nothing) {
  Robot& r = add_c("WbDeviceTag ps;",
                   "ps = wb_robot_get_device(\"ps0\"); wb_distance_sensor_enable(ps, 1);\n"
                   "int i, bad = 0; for (i = 0; i < 100; i++) if (wb_robot_step(0) != 0) bad++;\n"
                   "printf(\"bad %d\\nnan %d\\nat %g\\n\", bad, isnan(wb_distance_sensor_get_value(ps)), "
                   "wb_robot_get_time());",
                   "");
  run_for(0.1);
  EXPECT_EQ(value(r, "bad"), 0);
  EXPECT_EQ(value(r, "nan"), 1);
  EXPECT_EQ(value(r, "at"), 0);
}

TEST_F(Devices, the_basic_time_step_is_the_worlds) {
  world.webots.time_step_s = 0.016;
  Robot& r = add_c("", "printf(\"basic %g\\n\", wb_robot_get_basic_time_step());", "");
  run_for(0.1);
  EXPECT_EQ(value(r, "basic"), 16);
}

// the calendar is simulated: robots differ, and a run repeats
TEST_F(Devices, time_of_day_is_each_robots_own_and_goes_with_the_world) {
  const char* const loop = "printf(\"now %ld %ld\\n\", (long)begun, (long)time(NULL));";
  Robot& a = add_c("time_t begun;", "begun = time(NULL);", loop, 64, "a");
  Robot& b = add_c("time_t begun;", "begun = time(NULL);", loop, 64, "b").at(0.3, 0);
  run_for(3.5);
  EXPECT_NE(told(a, "now").at(0), told(b, "now").at(0));
  EXPECT_EQ(told(a, "now").at(1) - told(a, "now").at(0), 3);
}

// --- when samples are taken

TEST_F(Devices, values_are_nan_until_the_first_period_is_over) {
  Robot& r = add_c(
      "WbDeviceTag ps, ls, enc, acc;",
      "ps = wb_robot_get_device(\"ps0\"); ls = wb_robot_get_device(\"ls0\");\n"
      "enc = wb_robot_get_device(\"left wheel sensor\"); acc = wb_robot_get_device(\"accelerometer\");\n"
      "wb_distance_sensor_enable(ps, 128); wb_light_sensor_enable(ls, 64); wb_position_sensor_enable(enc, "
      "200);\n"
      "wb_accelerometer_enable(acc, 64);\n",
      "if (steps <= 5) printf(\"step%d %d %d %d %d\\n\", steps, isnan(wb_distance_sensor_get_value(ps)),\n"
      "isnan(wb_light_sensor_get_value(ls)), isnan(wb_position_sensor_get_value(enc)),\n"
      "isnan(wb_accelerometer_get_values(acc)[2]));");
  run_for(0.5);
  using V = std::vector<double>;
  EXPECT_EQ(told(r, "step1"), (V{1, 0, 1, 0}));
  EXPECT_EQ(told(r, "step2"), (V{0, 0, 1, 0}));
  EXPECT_EQ(told(r, "step3"), (V{0, 0, 1, 0}));
  EXPECT_EQ(told(r, "step4"), (V{0, 0, 0, 0}));  // 256 ms are the first multiple of 64 after 200
}

TEST_F(Devices, values_stay_until_the_next_period_and_end_with_disable) {
  Robot& r = add_c(
      "WbDeviceTag left, enc; double last; int changes;",
      "left = wb_robot_get_device(\"left wheel motor\"); wb_motor_set_position(left, INFINITY);\n"
      "wb_motor_set_velocity(left, 3); enc = wb_robot_get_device(\"left wheel sensor\");\n"
      "wb_position_sensor_enable(enc, 96);",
      "double now = wb_position_sensor_get_value(enc); if (!(now == last)) changes++; last = now;\n"
      "if (steps == 30) { printf(\"period %d\\n\", wb_position_sensor_get_sampling_period(enc));\n"
      "wb_position_sensor_disable(enc); printf(\"changes %d\\n\", changes); }\n"
      "if (steps == 36) printf(\"after %d %d\\n\", changes, wb_position_sensor_get_sampling_period(enc));",
      32);
  run_for(1.2);
  EXPECT_EQ(value(r, "period"), 96);
  // NaN differs from everything at steps 1 and 2; from the third on each third step brings
  // another value: 2 + 10
  EXPECT_EQ(value(r, "changes"), 12);
  EXPECT_EQ(told(r, "after"), (std::vector<double>{12, 0}));
}

// a wheel at 1000 steps a second is sampled at ends of steps of 10 ms, which lie in the midst of
// ticks: 10 steps each
TEST_F(Devices, samples_are_those_of_the_exact_instant) {
  Robot& r =
      add_c("WbDeviceTag left, enc; double last; int least = 1000, most;",
            "left = wb_robot_get_device(\"left wheel motor\"); wb_motor_set_position(left, INFINITY);\n"
            "wb_motor_set_velocity(left, 6.2831853); enc = wb_robot_get_device(\"left wheel sensor\");\n"
            "wb_position_sensor_enable(enc, 10);",
            "double now = wb_position_sensor_get_value(enc) * 1000 / 6.283185307179586; int d = "
            "(int)floor(now - last + 0.5);\n"
            "last = now; if (steps > 20) { if (d < least) least = d; if (d > most) most = d; }\n"
            "printf(\"ends %d %d\\n\", least, most);",
            10);
  run_for(2);
  const auto ends = told(r, "ends");
  // by ticks of 1.95 ms they would differ by 2; the motor's own clock is 0.03 % off
  EXPECT_GE(ends.at(0), 9);
  EXPECT_LE(ends.at(1), 10);
}

// --- the rest

TEST_F(Devices, selector_battery_and_names) {
  world.title = "devices";
  Robot& r =
      add_c(
          "WbDeviceTag s;",
          "s = wb_robot_get_device(\"selector\"); wb_distance_sensor_enable(s, 64); "
          "wb_robot_battery_sensor_enable(64);\n"
          "printf(\"nan %d\\n\", isnan(wb_robot_battery_sensor_get_value()));\n"
          "printf(\"named_%s 1\\n\", wb_robot_get_name()); printf(\"sup %d\\n\", wb_robot_get_supervisor());",
          "printf(\"s %g\\nbattery %.9g\\n\", wb_distance_sensor_get_value(s), "
          "wb_robot_battery_sensor_get_value());",
          64, "puck")
          .selector(7);
  run_for(0.5);
  EXPECT_EQ(value(r, "s"), 7);
  EXPECT_EQ(value(r, "nan"), 1);
  EXPECT_EQ(value(r, "named_puck"), 1);
  EXPECT_EQ(value(r, "sup"), 0);
  const double joules = value(r, "battery");
  EXPECT_GT(joules, 1000);  // 5 Wh are 18000 J
  EXPECT_LE(joules, 18000 * 1.2);
  r.turn_selector(12);
  run_for(5);
  EXPECT_EQ(value(r, "s"), 12);
  EXPECT_LT(value(r, "battery"), joules);
}

TEST_F(Devices, keys_are_there_while_they_are_down) {
  Robot& r = add_c("int ups, both, other;", "wb_keyboard_enable(64);",
                   "int first = wb_keyboard_get_key(), second = first < 0 ? -1 : wb_keyboard_get_key();\n"
                   "if (first == WB_KEYBOARD_UP && second == -1) ups++; else if (first == WB_KEYBOARD_UP && "
                   "second == 'W') both++;\n"
                   "else if (first != -1) other++; printf(\"keys %d %d %d\\n\", ups, both, other);");
  sim::KeyDesc up, w;
  up.typed = 315, up.at_s = 1, up.hold_s = 1;
  w.typed = 'W', w.at_s = 1.5, w.hold_s = 0.5;
  r.settings().keys = {up, w};
  run_for(3);
  EXPECT_NEAR(told(r, "keys").at(0), 8, 1);  // 0.5 s of 64 ms
  EXPECT_NEAR(told(r, "keys").at(1), 8, 1);
  EXPECT_EQ(told(r, "keys").at(2), 0);
}

TEST_F(Devices, a_supervisors_sensor_is_a_distance_sensor_of_its_name) {
  Robot& r = add_c("WbDeviceTag s; int missed;",
                   "while (wb_robot_step(64) != -1 && !(s = wb_robot_get_device(\"beacon\"))) missed++;\n"
                   "wb_distance_sensor_enable(s, 64); printf(\"missed %d\\n\", missed);",
                   "printf(\"beacon %g\\n\", wb_distance_sensor_get_value(s));");
  run_for(0.5);
  EXPECT_TRUE(told(r, "missed").empty());
  r.define_sensor("beacon", 2.5);
  run_for(0.4);
  EXPECT_EQ(value(r, "beacon"), 2.5);
  r.define_sensor("beacon", -1);
  run_for(0.2);
  EXPECT_EQ(value(r, "beacon"), -1);
}

TEST_F(Devices, a_program_keeps_a_text_with_its_robot) {
  Robot& r =
      add_c("", "printf(\"first_%s 1\\n\", wb_robot_get_custom_data()); wb_robot_set_custom_data(\"mine\");",
            "printf(\"then_%s 1\\n\", wb_robot_get_custom_data());");
  r.settings().custom_data = "given";
  run_for(0.2);
  EXPECT_EQ(value(r, "first_given"), 1);
  EXPECT_EQ(value(r, "then_mine"), 1);
}

TEST_F(Devices, a_display_is_drawn_on_and_saved_as_a_picture) {
  Robot& r = add_c("", R"(
    WbDeviceTag d = wb_robot_get_device("screen"); WbImageRef part;
    printf("size %d %d\n", wb_display_get_width(d), wb_display_get_height(d));
    wb_display_set_color(d, 0xFF8000); wb_display_fill_rectangle(d, 2, 1, 3, 2);
    part = wb_display_image_copy(d, 0, 0, 6, 4); wb_display_image_save(d, part, "part.png"); wb_display_image_delete(d, part);
    FILE *in = fopen("part.png", "rb"); char head[4] = ""; if (in) { if (fread(head, 1, 4, in) != 4) head[0] = 0; fclose(in); }
    printf("png %d\n", !memcmp(head, "\211PNG", 4)); remove("part.png");)",
                   "");
  r.settings().devices.push_back(device("screen", sim::DeviceKind::Display));
  r.settings().devices.back().width = 200;
  run_for(0.1);
  EXPECT_EQ(told(r, "size"), (std::vector<double>{200, 64}));
  EXPECT_EQ(value(r, "png"), 1);
}

// --- the interface of 2005

const char* const kOldHeaders =
    "#include <stdio.h>\n#include <string.h>\n#include <device/robot.h>\n#include "
    "<device/differential_wheels.h>\n"
    "#include <device/distance_sensor.h>\n#include <device/light_sensor.h>\n#include "
    "<device/led.h>\n#include <device/camera.h>\n"
    "#include <device/accelerometer.h>\n#include <device/gps.h>\n#include <device/compass.h>\n#include "
    "<device/emitter.h>\n"
    "#include <device/receiver.h>\n#include <device/microphone.h>\n";

TEST_F(Devices, robot_run_waits_for_as_long_as_it_was_told_and_says_how_long_that_was) {
  Robot& r = add_source(
      std::string(kOldHeaders) +
      "int calls; DeviceTag ps;\n"
      "static void reset(void) { ps = robot_get_device(\"ps0\"); distance_sensor_enable(ps, 64); }\n"
      "static int run(int ms) {\n"
      "  printf(\"call%d %d %d %g\\n\", calls, ms, distance_sensor_get_value(ps), robot_get_time());\n"
      "  calls++;\n  return calls == 1 ? 64 : calls == 2 ? 640 : 6400;\n}\n"
      "int main() { robot_live(reset); robot_run(run); return 0; }\n");
  wall(0.05, -0.2, 0.05, 0.2);
  run_for(7.2);
  using V = std::vector<double>;
  EXPECT_EQ(told(r, "call0"), (V{0, 0, 0})) << "0 before the first period is over";
  EXPECT_EQ(told(r, "call1").at(0), 64);
  EXPECT_GT(told(r, "call1").at(1), 1000);
  EXPECT_EQ(told(r, "call2").at(0), 640);
  EXPECT_EQ(told(r, "call3").at(0), 6400);
  EXPECT_NEAR(told(r, "call3").at(2), 7.104, 1e-9);
}

// the same robot in the same world, once with each interface: what both say must be the same
TEST_F(Devices, both_interfaces_say_the_same) {
  const auto go = [](const std::string& source) {
    struct Run : ProgramTest {
      void TestBody() override {}
      std::map<std::string, std::vector<double>> go(const std::string& its_source) {
        wall(0.07, -0.3, 0.07, 0.3, {1, 0, 0});
        sim::SoundDesc tone;
        tone.kind = sim::SoundKind::Tone;
        tone.frequency_hz = 500;
        tone.level_db = 80;
        tone.position_m = {0.3, 0, 0.035};
        world.sounds.push_back(tone);
        world.webots.axes = sim::Axes::Nue;
        Robot& r = add_source(its_source).at(0, 0.01, 10);
        sim::DeviceDesc gps, north;
        gps.name = "gps";
        north.name = "north";
        north.kind = sim::DeviceKind::Compass;
        r.settings().devices = {gps, north};
        run_for(1.6);
        std::map<std::string, std::vector<double>> all;
        for (const char* key : {"ps", "ls", "acc", "gps", "north", "cam", "mic", "enc"})
          all[key] = told(r, key);
        all["leds"] = {static_cast<double>(r.leds())};
        all["steps"] = {static_cast<double>(r.left_steps()), static_cast<double>(r.right_steps())};
        return all;
      }
    } run;
    return run.go(source);
  };
  const std::string sum =
      "static long sum(const unsigned char *p, int n) { long s = 0; int i; for (i = 0; i < n; i++) s = (s * "
      "31 + p[i]) % 1000003; return s; }\n";
  const auto today = go(programs_test::kHeaders + sum + R"(
    int main() { int n = 0; const double *v;
      wb_robot_init();
      WbDeviceTag ps = wb_robot_get_device("ps0"), ls = wb_robot_get_device("ls3"), acc = wb_robot_get_device("accelerometer"),
        gps = wb_robot_get_device("gps"), north = wb_robot_get_device("north"), cam = wb_robot_get_device("camera"), mic = wb_robot_get_device("mic1");
      wb_distance_sensor_enable(ps, 64); wb_light_sensor_enable(ls, 64); wb_accelerometer_enable(acc, 64); wb_gps_enable(gps, 64);
      wb_compass_enable(north, 64); wb_camera_enable(cam, 64); wb_microphone_enable(mic, 64); wb_differential_wheels_enable_encoders(64);
      wb_led_set(wb_robot_get_device("led2"), 1); wb_differential_wheels_set_speed(100, -50);
      while (wb_robot_step(64) != -1) {
        if (++n != 20) continue;
        printf("ps %d\n", (int)wb_distance_sensor_get_value(ps)); printf("ls %d\n", (int)wb_light_sensor_get_value(ls));
        v = wb_accelerometer_get_values(acc); printf("acc %g %g %g\n", (float)v[0], (float)v[1], (float)v[2]);
        v = wb_gps_get_values(gps); printf("gps %g %g %g\n", (float)v[0], (float)v[1], (float)v[2]);
        v = wb_compass_get_values(north); printf("north %g %g %g\n", (float)v[0], (float)v[1], (float)v[2]);
        printf("cam %d %ld\n", wb_camera_get_width(cam), sum(wb_camera_get_image(cam), 52 * 39 * 4) != 0);
        printf("mic %d %ld\n", wb_microphone_get_sample_size(mic), sum(wb_microphone_get_sample_data(mic), 200));
        printf("enc %d %d\n", (int)wb_differential_wheels_get_left_encoder(), (int)wb_differential_wheels_get_right_encoder());
      }
      return 0; })");
  const auto old = go(kOldHeaders + sum + R"(
    static DeviceTag ps, ls, acc, gps, north, cam, mic; static int n;
    static void reset(void) {
      ps = robot_get_device("ps0"); ls = robot_get_device("ls3"); acc = robot_get_device("accelerometer"); gps = robot_get_device("gps");
      north = robot_get_device("north"); cam = robot_get_device("camera"); mic = robot_get_device("mic1");
      distance_sensor_enable(ps, 64); light_sensor_enable(ls, 64); accelerometer_enable(acc, 64); gps_enable(gps, 64);
      compass_enable(north, 64); camera_enable(cam, 64); microphone_enable(mic, 64); differential_wheels_enable_encoders(64);
      led_set(robot_get_device("led2"), 1); differential_wheels_set_speed(100, -50);
    }
    static int run(int ms) {
      const float *v;
      if (n++ != 20) return 64; /* the first call is before the first step */
      printf("ps %d\n", distance_sensor_get_value(ps)); printf("ls %d\n", light_sensor_get_value(ls));
      v = accelerometer_get_values(acc); printf("acc %g %g %g\n", v[0], v[1], v[2]);
      v = gps_get_values(gps); printf("gps %g %g %g\n", v[0], v[1], v[2]);
      v = compass_get_values(north); printf("north %g %g %g\n", v[0], v[1], v[2]);
      printf("cam %d %d\n", camera_get_width(cam), sum(camera_get_image(cam), 52 * 39 * 3) != 0);
      printf("mic %d %ld\n", microphone_get_sample_size(mic), sum(microphone_get_sample_data(mic), 200));
      printf("enc %d %d\n", differential_wheels_get_left_encoder(), differential_wheels_get_right_encoder());
      return 64;
    }
    int main() { robot_live(reset); robot_run(run); return 0; })");
  for (const auto& [key, values] : today) {
    EXPECT_FALSE(values.empty()) << key;
    EXPECT_EQ(values, old.at(key)) << key;
  }
  EXPECT_GT(today.at("ps").at(0), 100);
}

TEST_F(Devices, programs_of_2005_send_and_receive) {
  add_source(std::string(kOldHeaders) +
             "static int n; static int run(int ms) { (void)ms; if (n++ == 4) "
             "emitter_send_packet(robot_get_device(\"emitter\"), \"hello\", 6); return 64; }\n"
             "int main() { robot_live(0); robot_run(run); return 0; }\n");
  Robot& b = add_source(std::string(kOldHeaders) +
                        "static DeviceTag r; static void reset(void) { r = robot_get_device(\"receiver\"); "
                        "receiver_enable(r, 64); }\n"
                        "static int run(int ms) { (void)ms; while (receiver_get_queue_length(r) > 0) {\n"
                        "printf(\"text_%s %d %g\\n\", (const char *)receiver_get_data(r), "
                        "receiver_get_data_size(r), receiver_get_signal_strength(r));\n"
                        "receiver_next_packet(r); } return 64; }\n"
                        "int main() { robot_live(reset); robot_run(run); return 0; }\n")
                 .at(0.5, 0);
  run_for(1);
  ASSERT_EQ(told(b, "text_hello").size(), 2u);
  EXPECT_EQ(told(b, "text_hello")[0], 6);
  EXPECT_NEAR(told(b, "text_hello")[1], 4, 0.01);
}

// --- other languages

TEST_F(Devices, python_says_what_c_says) {
  wall(0.07, -0.3, 0.07, 0.3);
  Robot& r = add_source(R"(
from controller import Robot

robot = Robot()
ps = robot.getDevice("ps0")
ps.enable(64)
left = robot.getDevice("left wheel motor")
left.setPosition(float("inf"))
left.setVelocity(3.14159265)
wheel = robot.getDevice("left wheel sensor")
wheel.enable(64)
robot.getDevice("led4").set(1)
while robot.step(64) != -1:
    print("at", robot.getTime(), ps.getValue(), wheel.getValue(), flush=True)
)",
                        "py");
  run_for(1);
  const auto at = told(r, "at");
  ASSERT_EQ(at.size(), 3u);
  EXPECT_NEAR(at[0], 0.96, 1e-12);
  EXPECT_GE(at[1], 0);
  EXPECT_LE(at[1], 4095);
  EXPECT_NEAR(at[2], 0.96 * M_PI, 0.02);
  EXPECT_EQ(r.leds(), 1u << 4);
}

TEST_F(Devices, classes_of_cpp_drive_and_see) {
  wall(0.09, -0.2, 0.09, 0.2);
  Robot& r = add_source(R"(
    #include <cmath>
    #include <iostream>
    #include <string>
    #include <webots/DistanceSensor.hpp>
    #include <webots/Motor.hpp>
    #include <webots/Robot.hpp>
    using namespace webots;
    class Driver : public Robot {
     public:
      Driver() {
        left = getMotor("left wheel motor");
        right = dynamic_cast<Motor*>(getDevice("right wheel motor"));
        ps = getDistanceSensor(std::string("ps") + "0");
        ps->enable(64);
        for (Motor* m : {left, right}) m->setPosition(INFINITY), m->setVelocity(3.14159265);
      }
      void run() {
        while (step(64) != -1)
          if (++steps == 15) std::cout << ps->getName() << (ps->getValue() > 100 ? " sees" : " is blind") << std::endl;
      }
     private:
      Motor *left, *right;
      DistanceSensor* ps;
      int steps = 0;
    };
    Driver* driver = new Driver();
    int main(int, char**) { driver->run(); delete driver; return 0; })",
                        "cpp");
  run_for(1);
  EXPECT_NEAR(r.left_steps(), 500, 3);
  EXPECT_NEAR(r.right_steps(), 500, 3);
  EXPECT_EQ(r.console(), (std::vector<std::string>{"ps0 sees"}));
  expect_no_traps();
}

// the PC's own library: containers, streams, exceptions, files in the program's folder, 8 bytes in a double
TEST_F(Devices, programs_in_cpp_have_all_of_the_pc) {
  Robot& r = add_source(R"(
    #include <algorithm>
    #include <fstream>
    #include <iostream>
    #include <map>
    #include <memory>
    #include <regex>
    #include <sstream>
    #include <thread>
    #include <vector>
    #include <webots/Robot.hpp>
    int main() {
      std::unique_ptr<webots::Robot> robot(new webots::Robot());
      std::map<int, std::string> m;
      for (int i = 0; i < 100000; i++) m[(i * 17) % 100000] = std::to_string(i);
      try { std::vector<int>(3).at(5); } catch (const std::out_of_range&) { std::cout << "caught " << m.size() << std::endl; }
      { std::ofstream out("a.txt"); out << "one two" << std::endl << 3.5 << " 4"; }
      std::ifstream in("a.txt"); std::string line; std::getline(in, line); double x, y; in >> x >> y;
      std::cout << line << '|' << x + y << '|' << sizeof(double) << sizeof(int) << std::regex_match(line, std::regex("one .*")) << std::endl;
      std::thread([] { std::cout << "thread" << std::endl; }).join();
      std::remove("a.txt");
      return 0;
    })",
                        "cpp");
  run_for(0.1);
  EXPECT_EQ(r.console(), (std::vector<std::string>{"caught 100000", "one two|7.5|841", "thread"}));
  expect_no_traps();
}

}  // namespace
