// SPDX-License-Identifier: MIT
// Kinds of devices that no robot here carries, and what needs a window, a mouse or a joystick: each function is there,
// says once which tag it got, and gives nothing. Lidars, range finders and servos as well, each function of theirs.
#include <gtest/gtest.h>
#include <webots/brake.h>
#include <webots/connector.h>
#include <webots/display.h>
#include <webots/joystick.h>
#include <webots/lidar.h>
#include <webots/mouse.h>
#include <webots/pen.h>
#include <webots/radar.h>
#include <webots/radio.h>
#include <webots/range_finder.h>
#include <webots/remote_control.h>
#include <webots/robot.h>
#include <webots/robot_window.h>
#include <webots/robot_wwi.h>
#include <webots/servo.h>
#include <webots/skin.h>
#include <webots/utils/default_robot_window.h>
#include <webots/utils/system.h>
#include <webots/vacuum_gripper.h>

#include <unistd.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/controller/fake_simulator.h"
#include "tests/controller/picture.h"
#include "tests/support/wording.h"

using fake::Packet;
using fake::Simulator;
using fake::World;

namespace {

constexpr std::int64_t kStep = 32000000;  // ns
constexpr int kMotor = 2, kSensor = 3, kLidar = 4, kFinder = 5, kDisplay = 6, kCamera = 7;

World puck() {
  World world;
  world.devices = {{kMotor, WB_NODE_ROTATIONAL_MOTOR, "left wheel motor", {6.28, kSensor}},
                   {kSensor, WB_NODE_POSITION_SENSOR, "left wheel sensor", {kMotor}},
                   {kLidar, WB_NODE_LIDAR, "lidar", {3, 2, 1.5, 0.1, 3.5, 0.2}},
                   {kFinder, WB_NODE_RANGE_FINDER, "range-finder", {3, 2, 1.25, 0.01, 1, 0}},
                   {kDisplay, WB_NODE_DISPLAY, "display", {12, 9}},
                   {kCamera, WB_NODE_CAMERA, "camera", {2, 3, 0.84, 0.01, 1}}};
  return world;
}

// Of a tag 0; what gives a number or text gives none.
#define EACH_SILENT(X)                              \
  X(brake_set_damping_constant, 0, 1)               \
  X(connector_enable_presence, 0, 32)               \
  X(connector_disable_presence, 0)                  \
  X(connector_lock, 0)                              \
  X(connector_unlock, 0)                            \
  X(radar_enable, 0, 32)                            \
  X(radar_disable, 0)                               \
  X(pen_write, 0, true)                             \
  X(pen_set_ink_color, 0, 0xFF, 1)                  \
  X(vacuum_gripper_enable_presence, 0, 32)          \
  X(vacuum_gripper_disable_presence, 0)             \
  X(vacuum_gripper_turn_on, 0)                      \
  X(vacuum_gripper_turn_off, 0)                     \
  X(skin_set_bone_orientation, 0, 1, nullptr, true) \
  X(skin_set_bone_position, 0, 1, nullptr, true)
#define EACH_SILENT_OF_RADIO(X)     \
  X(radio_enable, 0, 32)            \
  X(radio_disable, 0)               \
  X(radio_set_address, 0, "x")      \
  X(radio_set_frequency, 0, 1)      \
  X(radio_set_channel, 0, 1)        \
  X(radio_set_bitrate, 0, 1)        \
  X(radio_set_rx_sensitivity, 0, 1) \
  X(radio_set_tx_power, 0, 1)       \
  X(radio_set_callback, 0, nullptr)
#define EACH_ZERO(X)                           \
  X(brake_get_motor, 0)                        \
  X(brake_get_position_sensor, 0)              \
  X(connector_get_presence_sampling_period, 0) \
  X(connector_get_presence, 0)                 \
  X(connector_is_locked, 0)                    \
  X(radar_get_sampling_period, 0)              \
  X(radar_get_number_of_targets, 0)            \
  X(radar_get_min_range, 0)                    \
  X(radar_get_max_range, 0)                    \
  X(radar_get_horizontal_fov, 0)               \
  X(radar_get_vertical_fov, 0)
#define EACH_ZERO_MORE(X)                           \
  X(vacuum_gripper_get_presence_sampling_period, 0) \
  X(vacuum_gripper_get_presence, 0)                 \
  X(vacuum_gripper_is_on, 0)                        \
  X(skin_get_bone_count, 0)                         \
  X(radio_get_frequency, 0)                         \
  X(radio_get_channel, 0)                           \
  X(radio_get_bitrate, 0)                           \
  X(radio_get_rx_sensitivity, 0)                    \
  X(radio_get_tx_power, 0)
#define EACH_EMPTY(X)         \
  X(skin_get_bone_name, 0, 1) \
  X(radio_get_address, 0)
#define EACH_NULL(X)                       \
  X(radar_get_targets, 0)                  \
  X(skin_get_bone_orientation, 0, 1, true) \
  X(skin_get_bone_position, 0, 1, true)

#define NAME(function, ...) #function,
#define CALL(function, ...) wb_##function(__VA_ARGS__);
#define SAY_UNLESS(is_so, function) \
  if (!(is_so)) printf("%s ", #function);
#define IS_ZERO(function, ...) SAY_UNLESS(wb_##function(__VA_ARGS__) == 0, function)
#define IS_EMPTY(function, ...) SAY_UNLESS(!wb_##function(__VA_ARGS__)[0], function)
#define IS_NULL(function, ...) SAY_UNLESS(!wb_##function(__VA_ARGS__), function)
struct Absent {
  std::vector<const char*> functions;
  void (*call)();
};
// a program shows 20 warnings of a kind
const Absent kAbsent[] = {{{EACH_SILENT(NAME)}, [] { EACH_SILENT(CALL) }},
                          {{EACH_SILENT_OF_RADIO(NAME)}, [] { EACH_SILENT_OF_RADIO(CALL) }},
                          {{EACH_ZERO(NAME)}, [] { EACH_ZERO(IS_ZERO) }},
                          {{EACH_ZERO_MORE(NAME)}, [] { EACH_ZERO_MORE(IS_ZERO) }},
                          {{EACH_EMPTY(NAME)}, [] { EACH_EMPTY(IS_EMPTY) }},
                          {{EACH_NULL(NAME)}, [] { EACH_NULL(IS_NULL) }}};

}  // namespace

TEST(AbsentFunctions, kinds_that_no_robot_carries_say_which_function_got_which_tag) {
  for (const Absent& absent : kAbsent) {
    Simulator sim([&] {
      wb_robot_init();
      absent.call();
      wb_robot_step(32);
    });
    sim.welcome(puck());
    EXPECT_TRUE(sim.until_step().empty()) << "the simulator hears nothing of it";
    sim.done(kStep);
    EXPECT_EQ(sim.wait(), 0);
    EXPECT_EQ(sim.output(), "") << "what is not zero, empty or null";
    std::string wanted;
    for (const char* function : absent.functions)
      wanted +=
          "Warning: wb_" + std::string(function) + "(): got tag 0, expected one of wb_robot_get_device()\n";
    EXPECT_EQ(sim.errors(), wanted);
  }
}

TEST(AbsentFunctions, messages_of_a_radio_keep_what_they_are_made_of) {
  Simulator sim([] {
    WbRadioMessage message = wb_radio_message_new(3, "abcdef", "there"),
                   none = wb_radio_message_new(-1, nullptr, nullptr);
    printf("%d %s %d [%s] ", wb_radio_message_get_length(message), wb_radio_message_get_body(message),
           wb_radio_message_get_length(none), wb_radio_message_get_destination(none));
    printf("%d [%s] [%s] ", wb_radio_message_get_length(nullptr), wb_radio_message_get_body(nullptr),
           wb_radio_message_get_destination(nullptr));
    wb_radio_message_delete(message);
    wb_radio_message_delete(none);
    wb_radio_message_delete(nullptr);
    const WbRadioEvent event = nullptr;
    printf("%d %d %d %d %g", wb_radio_event_get_radio(event), wb_radio_event_get_data(event) == nullptr,
           wb_radio_event_get_data_size(event), wb_radio_event_get_emitter(event) == nullptr,
           wb_radio_event_get_rssi(event));
  });
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "3 abc 0 [] 0 [] [] 0 1 0 1 0");
}

TEST(AbsentFunctions, nobody_has_a_mouse_or_a_joystick) {
  Simulator sim([] {
    wb_mouse_enable(32);
    wb_mouse_enable_3d_position();
    wb_joystick_enable(16);
    printf("%d %d %d ", wb_mouse_get_sampling_period(), wb_mouse_is_3d_position_enabled(),
           wb_joystick_get_sampling_period());
    wb_mouse_disable();
    wb_mouse_disable_3d_position();
    wb_joystick_disable();
    printf("%d %d %d ", wb_mouse_get_sampling_period(), wb_mouse_is_3d_position_enabled(),
           wb_joystick_get_sampling_period());
    wb_mouse_enable(-1);
    wb_joystick_enable(-1);
    const WbMouseState mouse = wb_mouse_get_state();
    printf("%d %d %d%d%d%d ", wb_mouse_get_sampling_period(), wb_joystick_get_sampling_period(), mouse.left,
           mouse.right, std::isnan(mouse.u), std::isnan(mouse.z));
    printf("%d%d%d%d%d%d %d", wb_joystick_is_connected(), wb_joystick_get_model() == nullptr,
           wb_joystick_get_number_of_axes(), wb_joystick_get_axis_value(0), wb_joystick_get_number_of_povs(),
           wb_joystick_get_pov_value(0), wb_joystick_get_pressed_button());
    wb_joystick_set_constant_force(1);
    wb_joystick_set_constant_force_duration(1);
    wb_joystick_set_auto_centering_gain(1);
    wb_joystick_set_resistance_gain(1);
    wb_joystick_set_force_axis(1);
  });
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "32 1 16 0 0 0 0 0 0011 010000 -1");
  EXPECT_EQ(sim.errors(), "");
}

TEST(AbsentFunctions, windows_are_not_and_the_system_is_the_pcs) {
  Simulator sim([] {
    setenv("TMPDIR", "/somewhere", 1);
    setenv("CONTROLLER_TEST", "set", 1);
    wb_robot_wwi_send("abc", 3);
    wb_robot_wwi_send_text("abc");
    wbu_default_robot_window_configure();
    wbu_default_robot_window_update();
    wbu_default_robot_window_set_images_max_size(1, 2);
    printf("%d%d%d ", wb_robot_wwi_receive_text() == nullptr,
           wb_remote_control_custom_function(nullptr) == nullptr,
           wb_robot_window_custom_function(nullptr) == nullptr);
    printf("%s %s %s %s ", wbu_system_getenv("CONTROLLER_TEST"), wbu_system_short_path("/a b"),
           wbu_system_tmpdir(), wbu_system_webots_instance_path(true));
    unsetenv("TMPDIR");
    printf("%s", wbu_system_tmpdir());
  });
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "111 set /a b /somewhere /somewhere /tmp");
}

TEST(AbsentFunctions, lidars_and_range_finders_tell_their_size_and_ranges) {
  char file[] = "/tmp/range_imageXXXXXX.png";
  close(mkstemps(file, 4));
  Simulator sim([&] {
    wb_robot_init();
    wb_lidar_enable(kLidar, 64);
    wb_range_finder_enable(kFinder, 96);
    printf("%d %d ", wb_lidar_get_sampling_period(kLidar), wb_range_finder_get_sampling_period(kFinder));
    printf("%d %g %g %g %g\n", wb_lidar_get_number_of_layers(kLidar), wb_lidar_get_fov(kLidar),
           wb_lidar_get_vertical_fov(kLidar), wb_lidar_get_min_range(kLidar), wb_lidar_get_max_range(kLidar));
    printf("%d %d %g %g %g\n", wb_range_finder_get_width(kFinder), wb_range_finder_get_height(kFinder),
           wb_range_finder_get_fov(kFinder), wb_range_finder_get_min_range(kFinder),
           wb_range_finder_get_max_range(kFinder));
    wb_lidar_set_frequency(kLidar, 5);
    printf("%g %g %g %d ", wb_lidar_get_min_frequency(kLidar), wb_lidar_get_frequency(kLidar),
           wb_lidar_get_max_frequency(kLidar), wb_lidar_is_point_cloud_enabled(kLidar));
    wb_lidar_enable_point_cloud(kLidar);
    printf("%d ", wb_lidar_is_point_cloud_enabled(kLidar));
    wb_robot_step(32);
    const WbLidarPoint* const lower = wb_lidar_get_layer_point_cloud(kLidar, 1);
    printf("%.3f %.3f %d %d%d\n", static_cast<double>(lower[1].x), static_cast<double>(lower[1].z),
           lower[1].layer_id, wb_lidar_get_layer_point_cloud(kLidar, 2) == nullptr,
           wb_lidar_get_layer_point_cloud(kLidar, -1) == nullptr);
    wb_lidar_disable_point_cloud(kLidar);
    printf("%d%d ", wb_lidar_is_point_cloud_enabled(kLidar), wb_lidar_get_point_cloud(kLidar) == nullptr);
    printf("%d ", wb_range_finder_save_image(kFinder, file, 100));
    wb_lidar_disable(kLidar);
    wb_range_finder_disable(kFinder);
    printf("%d %d", wb_lidar_get_sampling_period(kLidar), wb_range_finder_get_sampling_period(kFinder));
    wb_robot_step(32);
  });
  sim.welcome(puck());
  sim.until_step();
  Packet samples;
  samples.add(LINK_NUMBERS, kLidar, std::vector<double>{1, 1, 1, 1, 2, 1});
  samples.add(LINK_NUMBERS, kFinder, std::vector<double>{0, 0.25, 0.5, 0.75, 1, INFINITY});
  sim.done(kStep, samples);
  const auto said = sim.until_step();
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[0].ints, (std::vector<std::int64_t>{kLidar, 0}));
  EXPECT_EQ(said[1].ints, (std::vector<std::int64_t>{kFinder, 0}));
  sim.done(2 * kStep);
  EXPECT_EQ(sim.wait(), 0);
  // the lower layer is 0.1 rad down: 2 m cos and sin of it
  EXPECT_EQ(sim.output(),
            "64 96 2 1.5 0.2 0.1 3.5\n3 2 1.25 0.01 1\n10 10 10 0 1 1.990 -0.200 1 11\n01 0 0 0");
  const fake::Picture grey = fake::read_picture(file);
  EXPECT_EQ(grey.width, 3);
  EXPECT_EQ(grey.argb, (std::vector<std::uint32_t>{0xFF000000u, 0xFF3F3F3Fu, 0xFF7F7F7Fu, 0xFFBFBFBFu,
                                                   0xFFFFFFFFu, 0xFFFFFFFFu}));
  std::remove(file);
}

TEST(AbsentFunctions, each_function_of_a_servo_is_one_of_its_motor) {
  Simulator sim([] {
    wb_robot_init();
    wb_servo_enable_position(kMotor, 48);
    printf("%d ", wb_servo_get_position_sampling_period(kMotor));
    wb_servo_set_position(kMotor, 1.5);
    wb_servo_set_velocity(kMotor, 2);
    wb_servo_set_acceleration(kMotor, 3);
    wb_servo_set_control_p(kMotor, 10);
    wb_servo_disable_motor_force_feedback(kMotor);
    printf("%g %g %g %d %g ", wb_servo_get_target_position(kMotor), wb_servo_get_min_position(kMotor),
           wb_servo_get_max_position(kMotor), wb_servo_get_type(kMotor),
           wb_servo_get_motor_force_feedback(kMotor));
    wb_servo_disable_position(kMotor);
    printf("%d", wb_servo_get_position_sampling_period(kMotor));
    wb_servo_set_motor_force(kMotor, 1);
    wb_servo_set_force(kMotor, 1);
    wb_servo_enable_motor_force_feedback(kMotor, 32);
    wb_robot_step(32);
  });
  sim.welcome(puck());
  const auto said = sim.until_step();
  ASSERT_EQ(said.size(), 4u);
  EXPECT_EQ(said[0].ints, (std::vector<std::int64_t>{kSensor, 48}));
  EXPECT_EQ(said[1].reals, (std::vector<double>{1.5}));
  EXPECT_EQ(said[2].reals, (std::vector<double>{2}));
  EXPECT_EQ(said[3].ints, (std::vector<std::int64_t>{kSensor, 0}));
  sim.done(kStep);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "48 1.5 0 0 0 0 0");
  EXPECT_TRUE(
      wording::reads(sim.errors(),
                     "Warning: wb_motor_set_force(): the e-puck's wheels are stepper motors, which have no "
                     "force or torque to set\n"
                     "Warning: wb_motor_enable_force_feedback(): the e-puck's wheels are stepper motors, "
                     "which have no force or torque to set"));
}

TEST(AbsentFunctions, cameras_do_not_appear_on_displays) {
  Simulator sim([] {
    wb_robot_init();
    wb_display_set_antialiasing(kDisplay, true);
    wb_display_set_antialiasing(kCamera, true);
    wb_display_attach_camera(kDisplay, kCamera);
    wb_display_detach_camera(kDisplay);
    wb_display_detach_camera(kCamera);
  });
  sim.welcome(puck());
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_TRUE(wording::reads(
      sim.errors(),
      "Warning: wb_display_set_antialiasing(): got the tag of \"camera\", expected a device of this "
      "function's kind\n"
      "Warning: wb_display_attach_camera(): cameras do not appear on displays; paste wb_camera_get_image()\n"
      "Warning: wb_display_detach_camera(): got the tag of \"camera\", expected a device of this function's "
      "kind"));
}
