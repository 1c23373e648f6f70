// SPDX-License-Identifier: MIT
// Each function of each kind of device, in both interfaces, held by tables: who samples, what is read, what is told.
#include <device/accelerometer.h>
#include <device/camera.h>
#include <device/compass.h>
#include <device/differential_wheels.h>
#include <device/distance_sensor.h>
#include <device/emitter.h>
#include <device/gps.h>
#include <device/gyro.h>
#include <device/light_sensor.h>
#include <device/microphone.h>
#include <device/receiver.h>
#include <device/robot.h>
#include <device/speaker.h>
#include <device/touch_sensor.h>
#include <gtest/gtest.h>
#include <webots/accelerometer.h>
#include <webots/altimeter.h>
#include <webots/camera.h>
#include <webots/compass.h>
#include <webots/console.h>
#include <webots/differential_wheels.h>
#include <webots/distance_sensor.h>
#include <webots/emitter.h>
#include <webots/gps.h>
#include <webots/gyro.h>
#include <webots/inertial_unit.h>
#include <webots/keyboard.h>
#include <webots/light_sensor.h>
#include <webots/microphone.h>
#include <webots/motor.h>
#include <webots/position_sensor.h>
#include <webots/receiver.h>
#include <webots/robot.h>
#include <webots/speaker.h>
#include <webots/touch_sensor.h>

#include <cmath>
#include <cstdio>

#include "tests/controller/fake_simulator.h"
#include "tests/support/wording.h"

using fake::Packet;
using fake::Record;
using fake::Simulator;
using fake::World;

namespace {

constexpr std::int64_t kStep = 32000000;  // ns

// tags, as the world below has them
enum {
  kDistance = 1,
  kLight,
  kTouch,
  kPosition,
  kMotor,
  kAccelerometer,
  kGyro,
  kCompass,
  kAltimeter,
  kGps,
  kUnit,
  kCamera,
  kReceiver,
  kMicrophone,
  kEmitter,
  kSpeaker,
  kLinear,
  kKeyboard,
  kBattery,
  kRight,
  kRightPosition
};

World all_kinds(bool nue = false) {
  World world;
  world.nue = nue;
  world.devices = {
      {kDistance, WB_NODE_DISTANCE_SENSOR, "ps0", {10, 4095, 0.3, 1, 0, 4095, 0.01, 0.07, 0, 0.5}},
      {kLight, WB_NODE_LIGHT_SENSOR, "ls0", {0, 10, 0.25, 1, 20, 0.5}},
      {kTouch, WB_NODE_TOUCH_SENSOR, "bumper", {2, 0, 0, 0, 5, 50, 0.1, 9, 90, 0.2}},
      {kPosition, WB_NODE_POSITION_SENSOR, "left wheel sensor", {kMotor}},
      {kMotor, WB_NODE_ROTATIONAL_MOTOR, "left wheel motor", {6.28, kPosition}},
      {kAccelerometer, WB_NODE_ACCELEROMETER, "accelerometer", {-1, -10, 0, 1, 10, 0.75}},
      {kGyro, WB_NODE_GYRO, "gyro", {-2, -20, 0.125}},
      {kCompass, WB_NODE_COMPASS, "compass", {}},
      {kAltimeter, WB_NODE_ALTIMETER, "altimeter", {}},
      {kGps, WB_NODE_GPS, "gps", {}},
      {kUnit, WB_NODE_INERTIAL_UNIT, "inertial unit", {}},
      {kCamera, WB_NODE_CAMERA, "camera", {2, 3, 0.84, 0.01, 1}},
      {kReceiver, WB_NODE_RECEIVER, "receiver", {3, 64}},
      {kMicrophone, WB_NODE_MICROPHONE, "mic0", {}},
      {kEmitter, WB_NODE_EMITTER, "emitter", {2, 0.25, 128}},
      {kSpeaker, WB_NODE_SPEAKER, "speaker", {}},
      {kLinear, WB_NODE_LINEAR_MOTOR, "slide", {0.5}},
      {kKeyboard, WB_NODE_NO_NODE, "keyboard", {}},
      {kBattery, WB_NODE_NO_NODE, "battery", {}},
      {kRight, WB_NODE_ROTATIONAL_MOTOR, "right wheel motor", {5, kRightPosition}},
      {kRightPosition, WB_NODE_POSITION_SENSOR, "right wheel sensor", {kRight}}};
  return world;
}

#define EACH_SENSOR(X)             \
  X(kDistance, distance_sensor)    \
  X(kLight, light_sensor)          \
  X(kTouch, touch_sensor)          \
  X(kPosition, position_sensor)    \
  X(kAccelerometer, accelerometer) \
  X(kGyro, gyro)                   \
  X(kCompass, compass)             \
  X(kAltimeter, altimeter)         \
  X(kGps, gps)                     \
  X(kUnit, inertial_unit)          \
  X(kCamera, camera)               \
  X(kReceiver, receiver)           \
  X(kMicrophone, microphone)
#define TAG(tag, name) tag,
constexpr int kSensors[] = {EACH_SENSOR(TAG)};

#define EACH_OLD_SENSOR(X)         \
  X(kDistance, distance_sensor)    \
  X(kLight, light_sensor)          \
  X(kTouch, touch_sensor)          \
  X(kAccelerometer, accelerometer) \
  X(kGyro, gyro)                   \
  X(kCompass, compass)             \
  X(kGps, gps)                     \
  X(kCamera, camera)               \
  X(kReceiver, receiver)           \
  X(kMicrophone, microphone)
constexpr int kOldSensors[] = {EACH_OLD_SENSOR(TAG)};

/// Tags and periods of what was switched, in order.
std::vector<std::pair<int, int>> switched(const std::vector<Record>& said) {
  std::vector<std::pair<int, int>> found;
  for (const Record& r : fake::of(said, LINK_ENABLE))
    found.emplace_back(static_cast<int>(r.ints[0]), static_cast<int>(r.ints[1]));
  return found;
}

/// As switched() has it, of all these tags.
template <std::size_t N>
std::vector<std::pair<int, int>> each(const int (&tags)[N], int base, int times) {
  std::vector<std::pair<int, int>> wanted;
  for (const int tag : tags) wanted.emplace_back(tag, base + times * tag);
  return wanted;
}

}  // namespace

TEST(DeviceFunctions, each_sensor_is_switched_on_tells_its_period_and_is_switched_off) {
  Simulator sim([] {
    wb_robot_init();
#define ON(tag, name)                \
  wb_##name##_enable(tag, 10 * tag); \
  printf("%d ", wb_##name##_get_sampling_period(tag));
    EACH_SENSOR(ON)
    wb_robot_step(32);
#define OFF(tag, name)      \
  wb_##name##_disable(tag); \
  printf("%d", wb_##name##_get_sampling_period(tag));
    EACH_SENSOR(OFF)
    wb_robot_step(32);
#define WRONG(tag, name)        \
  wb_##name##_enable(tag, -10); \
  printf("%d", wb_##name##_get_sampling_period(tag));
    EACH_SENSOR(WRONG)
    wb_robot_step(32);
  });
  sim.welcome(all_kinds());
  EXPECT_EQ(switched(sim.until_step()), each(kSensors, 0, 10));
  sim.done(kStep);
  EXPECT_EQ(switched(sim.until_step()), each(kSensors, 0, 0));
  sim.done(2 * kStep);
  EXPECT_EQ(switched(sim.until_step()), each(kSensors, 0, 0)) << "a period below 0 is none";
  sim.done(3 * kStep);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "10 20 30 40 60 70 80 90 100 110 120 130 140 00000000000000000000000000");
  EXPECT_EQ(sim.errors(), "");
}

TEST(DeviceFunctions, sensors_of_2005_are_switched_as_well) {
  Simulator sim([] {
    wb_robot_init();
#define OLD_ON(tag, name) name##_enable(tag, 5 + tag);
    EACH_OLD_SENSOR(OLD_ON)
    wb_robot_step(32);
#define OLD_OFF(tag, name) name##_disable(tag);
    EACH_OLD_SENSOR(OLD_OFF)
    wb_robot_step(32);
  });
  sim.welcome(all_kinds());
  EXPECT_EQ(switched(sim.until_step()), each(kOldSensors, 5, 1));
  sim.done(kStep);
  EXPECT_EQ(switched(sim.until_step()), each(kOldSensors, 0, 0));
  sim.done(2 * kStep);
  EXPECT_EQ(sim.wait(), 0);
}

TEST(DeviceFunctions, what_belongs_to_no_tag_is_switched_as_well) {
  Simulator sim([] {
    wb_robot_init();
    wb_keyboard_enable(16);
    wb_robot_battery_sensor_enable(24);
    wb_differential_wheels_enable_encoders(40);
    printf("%d %d %d ", wb_keyboard_get_sampling_period(), wb_robot_battery_sensor_get_sampling_period(),
           wb_differential_wheels_get_encoders_sampling_period());
    wb_robot_step(32);
    wb_keyboard_disable();
    wb_robot_battery_sensor_disable();
    wb_differential_wheels_disable_encoders();
    printf("%d %d %d ", wb_keyboard_get_sampling_period(), wb_robot_battery_sensor_get_sampling_period(),
           wb_differential_wheels_get_encoders_sampling_period());
    wb_robot_step(32);
    wb_robot_keyboard_enable(1);
    wb_robot_keyboard_disable();
    robot_keyboard_enable(2);
    robot_keyboard_disable();
    robot_battery_sensor_enable(3);
    robot_battery_sensor_disable();
    differential_wheels_enable_encoders(4);
    differential_wheels_disable_encoders();
    wb_robot_step(32);
  });
  using Switched = std::vector<std::pair<int, int>>;
  sim.welcome(all_kinds());
  EXPECT_EQ(switched(sim.until_step()),
            (Switched{{kKeyboard, 16}, {kBattery, 24}, {kPosition, 40}, {kRightPosition, 40}}));
  sim.done(kStep);
  EXPECT_EQ(switched(sim.until_step()),
            (Switched{{kKeyboard, 0}, {kBattery, 0}, {kPosition, 0}, {kRightPosition, 0}}));
  sim.done(2 * kStep);
  EXPECT_EQ(switched(sim.until_step()), (Switched{{kKeyboard, 1},
                                                  {kKeyboard, 0},
                                                  {kKeyboard, 2},
                                                  {kKeyboard, 0},
                                                  {kBattery, 3},
                                                  {kBattery, 0},
                                                  {kPosition, 4},
                                                  {kRightPosition, 4},
                                                  {kPosition, 0},
                                                  {kRightPosition, 0}}));
  sim.done(3 * kStep);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "16 24 40 0 0 0 ");
}

TEST(DeviceFunctions, samples_are_read_in_both_interfaces) {
  Simulator sim([] {
    wb_robot_init();
    EACH_SENSOR(ON)
    robot_battery_sensor_enable(32);
    printf("\n%d %d %g %g %g\n", distance_sensor_get_value(kDistance), touch_sensor_get_value(kTouch),
           static_cast<double>(gyro_get_values(kGyro)[1]), static_cast<double>(gps_get_matrix(kGps)[15]),
           static_cast<double>(robot_battery_sensor_get_value()));  // before the first sample
    wb_robot_step(32);
    printf("%g %g %g %g %g %g\n", wb_distance_sensor_get_value(kDistance), wb_light_sensor_get_value(kLight),
           wb_touch_sensor_get_value(kTouch), wb_touch_sensor_get_values(kTouch)[2],
           wb_position_sensor_get_value(kPosition), wb_altimeter_get_value(kAltimeter));
    printf("%d %d %d %g\n", distance_sensor_get_value(kDistance), light_sensor_get_value(kLight),
           touch_sensor_get_value(kTouch), static_cast<double>(robot_battery_sensor_get_value()));
    printf("%g %g %g\n", wb_accelerometer_get_values(kAccelerometer)[0], wb_gyro_get_values(kGyro)[1],
           wb_compass_get_values(kCompass)[2]);
    printf("%g %g %g\n", static_cast<double>(accelerometer_get_values(kAccelerometer)[0]),
           static_cast<double>(gyro_get_values(kGyro)[1]),
           static_cast<double>(compass_get_values(kCompass)[2]));
    printf("%g %g %g %g", wb_gps_get_values(kGps)[2], wb_gps_get_speed_vector(kGps)[2],
           wb_gps_get_speed(kGps), wb_inertial_unit_get_roll_pitch_yaw(kUnit)[1]);
  });
  sim.welcome(all_kinds());
  sim.until_step();
  using Numbers = std::vector<double>;
  Packet samples;
  samples.add(LINK_NUMBERS, kDistance, Numbers{70000.5}).add(LINK_NUMBERS, kLight, Numbers{-3});
  samples.add(LINK_NUMBERS, kTouch, Numbers{1.75, 2, 3.5}).add(LINK_NUMBERS, kPosition, Numbers{-0.5});
  samples.add(LINK_NUMBERS, kAltimeter, Numbers{0.02}).add(LINK_NUMBERS, kBattery, Numbers{17000});
  samples.add(LINK_NUMBERS, kAccelerometer, Numbers{1, 2, 3}).add(LINK_NUMBERS, kGyro, Numbers{4, 5, 6});
  samples.add(LINK_NUMBERS, kCompass, Numbers{7, 8, 9}).add(LINK_NUMBERS, kUnit, Numbers{0.1, 0.2, 0.3});
  samples.add(LINK_NUMBERS, kGps, Numbers{1, 2, 3, 2, 3, 6, 0});
  sim.done(kStep, samples);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(),
            "10 20 30 40 60 70 80 90 100 110 120 130 140 \n"
            "0 0 0 0 0\n"
            "70000.5 -3 1.75 3.5 -0.5 0.02\n"
            "65535 0 1 17000\n"  // whole numbers of 16 bits
            "1 5 9\n"
            "1 5 9\n"
            "3 6 7 0.2");  // sqrt(4 + 9 + 36)
}

TEST(DeviceFunctions, tables_and_ranges_are_the_worlds) {
  Simulator sim([] {
    wb_robot_init();
#define TABLE(tag, name)                                                                         \
  {                                                                                              \
    const double* const table = wb_##name##_get_lookup_table(tag);                               \
    const int rows = wb_##name##_get_lookup_table_size(tag);                                     \
    printf("%d:%g:%g ", rows, table ? table[0] : NAN, table&& rows ? table[3 * rows - 1] : NAN); \
  }
    TABLE(kDistance, distance_sensor)
    TABLE(kLight, light_sensor)
    TABLE(kTouch, touch_sensor)
    TABLE(kAccelerometer, accelerometer)
    TABLE(kGyro, gyro)
    TABLE(kCompass, compass)
    printf("\n%g %g %g %d %d %d\n", wb_distance_sensor_get_min_value(kDistance),
           wb_distance_sensor_get_max_value(kDistance), wb_distance_sensor_get_aperture(kDistance),
           wb_distance_sensor_get_type(kDistance), wb_touch_sensor_get_type(kTouch),
           wb_position_sensor_get_type(kPosition) == WB_ROTATIONAL);
    printf("%d %d %g %d\n", wb_position_sensor_get_motor(kPosition), wb_position_sensor_get_brake(kPosition),
           wb_inertial_unit_get_noise(kUnit), wb_gps_get_coordinate_system(kGps) == WB_GPS_LOCAL_COORDINATE);
    for (const double degrees : {46.5 + 30.0 / 3600, -6.25, 0.0, 1 - 1e-9})
      printf("%s; ", wb_gps_convert_to_degrees_minutes_seconds(degrees));
  });
  sim.welcome(all_kinds());
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(),
            "2:0:0.5 2:0:0.5 3:0:0.2 2:-1:0.75 1:-2:0.125 0:nan:nan \n"
            "10 4095 0.3 1 2 1\n"
            "5 0 0 1\n"
            "46° 30' 30''; -6° 15' 0''; 0° 0' 0''; 1° 0' 0''; ");
}

namespace {
/// The matrix and angle of a robot at (1, 2, 3) that has turned by 30 degrees.
std::string turned(bool nue) {
  Simulator sim([] {
    wb_robot_init();
    gps_enable(kGps, 32);
    wb_robot_step(32);
    const float* const m = gps_get_matrix(kGps);
    float angles[3];
    for (int i = 0; i < 16; ++i) printf("%.2f ", static_cast<double>(m[i]) + 0.0);
    gps_euler(m, angles);
    for (const float angle : angles) printf("%.4f ", static_cast<double>(angle));
  });
  sim.welcome(all_kinds(nue));
  sim.until_step();
  Packet samples;
  samples.add(LINK_NUMBERS, kGps, std::vector<double>{1, 2, 3, 0, 0, 0, M_PI / 6});
  sim.done(kStep, samples);
  EXPECT_EQ(sim.wait(), 0);
  return sim.output();
}
}  // namespace

TEST(DeviceFunctions, the_matrix_of_2005_turns_about_the_axis_that_is_up) {
  EXPECT_EQ(turned(false),
            "0.87 0.50 0.00 0.00 -0.50 0.87 0.00 0.00 0.00 0.00 1.00 0.00 1.00 2.00 3.00 1.00 "
            "0.0000 0.0000 0.5236 ");
  EXPECT_EQ(turned(true),
            "0.87 0.00 -0.50 0.00 0.00 1.00 0.00 0.00 0.50 0.00 0.87 0.00 1.00 2.00 3.00 1.00 "
            "0.0000 0.5236 0.0000 ");
}

TEST(DeviceFunctions, motors_have_no_force_no_ends_and_no_feedback) {
  Simulator sim([] {
    wb_robot_init();
    printf("%g ", wb_motor_get_acceleration(kMotor));
    wb_motor_set_acceleration(kMotor, 2.5);
    wb_motor_set_control_pid(kMotor, 1, 2, 3);
    wb_motor_set_available_force(kMotor, 1);
    wb_motor_set_available_torque(kMotor, 1);
    wb_motor_disable_force_feedback(kMotor);
    wb_motor_disable_torque_feedback(kMotor);
    printf("%g %g %g %g\n", wb_motor_get_acceleration(kMotor), wb_motor_get_multiplier(kMotor),
           wb_motor_get_min_position(kMotor), wb_motor_get_max_position(kMotor));
    printf("%g %g %g %g %g %g\n", wb_motor_get_force_feedback(kMotor), wb_motor_get_torque_feedback(kMotor),
           wb_motor_get_available_force(kMotor), wb_motor_get_max_force(kMotor),
           wb_motor_get_available_torque(kMotor), wb_motor_get_max_torque(kMotor));
    printf("%d %d %d %d %d\n", wb_motor_get_force_feedback_sampling_period(kMotor),
           wb_motor_get_torque_feedback_sampling_period(kMotor), wb_motor_get_type(kMotor) == WB_ROTATIONAL,
           wb_motor_get_type(kLinear) == WB_LINEAR, wb_motor_get_brake(kMotor));
    wb_motor_set_position(kLinear, 0.125);
    printf("%g %g %g %g\n", wb_motor_get_target_position(kLinear), wb_motor_get_max_velocity(kLinear),
           wb_differential_wheels_get_max_speed(), wb_motor_get_multiplier(kGps));
    wb_motor_set_force(kMotor, 1);
    wb_motor_set_torque(kMotor, 1);
    wb_motor_enable_force_feedback(kMotor, 32);
    wb_motor_enable_torque_feedback(kMotor, 32);
    wb_robot_step(32);
  });
  sim.welcome(all_kinds());
  const auto said = sim.until_step();
  ASSERT_EQ(said.size(), 1u) << "what steppers have not is not said";
  EXPECT_EQ(said[0].ints[0], kLinear);
  sim.done(kStep);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "-1 2.5 1 0 0\n0 0 0 0 0 0\n0 0 1 1 0\n0.125 0.5 6.28 nan\n");
  const std::string steppers =
      "(): the e-puck's wheels are stepper motors, which have no force or torque to set";
  EXPECT_TRUE(
      wording::reads(sim.errors(),
                     "Warning: wb_motor_get_multiplier(): got the tag of \"gps\", expected a device of this "
                     "function's kind\n"
                     "Warning: wb_motor_set_force" +
                         steppers + "\nWarning: wb_motor_set_torque" + steppers +
                         "\nWarning: wb_motor_enable_force_feedback" + steppers +
                         "\nWarning: wb_motor_enable_torque_feedback" + steppers));
}

TEST(DeviceFunctions, a_cameras_lens_is_fixed_and_its_picture_has_no_segments) {
  Simulator sim([] {
    wb_robot_init();
    printf("%g %g %g %g %d %d\n", wb_camera_get_near(kCamera), wb_camera_get_min_fov(kCamera),
           wb_camera_get_max_fov(kCamera), static_cast<double>(camera_get_fov(kCamera)),
           camera_get_width(kCamera), camera_get_height(kCamera));
    printf("%g %g %g %g %g\n", wb_camera_get_exposure(kCamera), wb_camera_get_focal_length(kCamera),
           wb_camera_get_focal_distance(kCamera), wb_camera_get_min_focal_distance(kCamera),
           wb_camera_get_max_focal_distance(kCamera));
    wb_camera_move_window(kCamera, 1, 2);
    camera_move_window(kCamera, 1, 2);
    wb_camera_recognition_disable_segmentation(kCamera);
    printf("%d %d %d %d\n", wb_camera_recognition_has_segmentation(kCamera),
           wb_camera_recognition_is_segmentation_enabled(kCamera),
           wb_camera_recognition_get_segmentation_image(kCamera) == nullptr,
           wb_camera_recognition_save_segmentation_image(kCamera, "x.png", 100));
    wb_camera_set_fov(kCamera, 1);
    wb_camera_set_exposure(kCamera, 1);
    wb_camera_set_focal_distance(kCamera, 1);
    wb_camera_recognition_enable_segmentation(kCamera);
    wb_camera_recognition_enable(kCamera, 48);
    printf("%d %d ", wb_camera_recognition_get_sampling_period(kCamera),
           wb_camera_recognition_get_object(kCamera, 0) == nullptr);
    wb_robot_step(32);
    printf("%d %d %d ", wb_camera_recognition_get_object(kCamera, 0)->id,
           wb_camera_recognition_get_object(kCamera, 1) == nullptr,
           wb_camera_recognition_get_object(kCamera, -1) == nullptr);
    wb_camera_recognition_disable(kCamera);
    printf("%d %d", wb_camera_recognition_get_sampling_period(kCamera),
           wb_camera_recognition_get_number_of_objects(kCamera));
    wb_robot_step(32);
  });
  sim.welcome(all_kinds());
  EXPECT_EQ(fake::of(sim.until_step(), LINK_RECOGNISE).at(0).ints, (std::vector<std::int64_t>{kCamera, 48}));
  Packet samples;
  samples.add(LINK_RECOGNITION, kCamera, 1);
  samples.add(LINK_RECOGNISED, kCamera, 41, "ball", std::vector<double>(13), std::vector<double>{});
  sim.done(kStep, samples);
  EXPECT_EQ(fake::of(sim.until_step(), LINK_RECOGNISE).at(0).ints, (std::vector<std::int64_t>{kCamera, 0}));
  sim.done(2 * kStep);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "0.01 0.84 0.84 0.84 2 3\n1 0 0 0 0\n0 0 1 -1\n48 1 41 1 1 0 0");
  const std::string lens = "(): the lens of \"camera\" is fixed, and its exposure its own\n";
  EXPECT_TRUE(wording::reads(
      sim.errors(), "Warning: wb_camera_set_fov" + lens + "Warning: wb_camera_set_exposure" + lens +
                        "Warning: wb_camera_set_focal_distance" + lens +
                        "Warning: wb_camera_recognition_enable_segmentation(): there is no segmentation; "
                        "use the objects"));
}

TEST(DeviceFunctions, channels_ranges_and_queues_are_the_worlds_until_they_are_set) {
  Simulator sim([] {
    wb_robot_init();
    printf("%d %g %d %d\n", wb_emitter_get_channel(kEmitter), wb_emitter_get_range(kEmitter),
           wb_emitter_get_buffer_size(kEmitter), wb_receiver_get_channel(kReceiver));
    wb_receiver_set_channel(kReceiver, -1);
    wb_receiver_set_channel(kReceiver, -2);
    wb_emitter_set_channel(kEmitter, 7);
    wb_emitter_set_channel(kEmitter, -2);
    printf("%d %d ", wb_emitter_get_channel(kEmitter), wb_receiver_get_channel(kReceiver));
    emitter_set_channel(kEmitter, 5);
    emitter_set_range(kEmitter, 0.5F);
    receiver_set_channel(kReceiver, 6);
    printf("%d %g %d\n", emitter_get_channel(kEmitter), static_cast<double>(emitter_get_range(kEmitter)),
           receiver_get_channel(kReceiver));
    printf("%d%d%d\n", emitter_send_packet(kEmitter, "abc", 3),
           wb_emitter_send(kEmitter, std::string(126, 'x').c_str(), 126),
           wb_emitter_send(kEmitter, std::string(125, 'x').c_str(), 125));  // of 128 bytes
    receiver_enable(kReceiver, 32);
    wb_robot_step(32);
    printf("%d %d %g %g", receiver_get_queue_length(kReceiver), receiver_get_data_size(kReceiver),
           static_cast<double>(receiver_get_signal_strength(kReceiver)),
           static_cast<double>(receiver_get_emitter_direction(kReceiver)[1]));
    receiver_next_packet(kReceiver);
    printf(" %d", receiver_get_queue_length(kReceiver));
  });
  sim.welcome(all_kinds());
  const auto said = sim.until_step();
  std::vector<std::vector<std::int64_t>> channels;
  for (const Record& r : fake::of(said, LINK_CHANNEL)) channels.push_back(r.ints);
  EXPECT_EQ(channels, (std::vector<std::vector<std::int64_t>>{
                          {kReceiver, -1}, {kEmitter, 7}, {kEmitter, 5}, {kReceiver, 6}}));
  ASSERT_EQ(fake::of(said, LINK_RANGE).size(), 1u);
  EXPECT_EQ(fake::of(said, LINK_RANGE)[0].reals[0], 0.5);
  Packet samples;
  samples.add(LINK_PACKET, kReceiver, 5, "hello", 4.0, 0.6, 0.8, 0.0);
  sim.done(kStep, samples);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "2 0.25 128 3\n7 -1 5 0.5 6\n101\n1 5 4 0.8 0");
  EXPECT_TRUE(wording::reads(sim.errors(),
                             "Warning: wb_receiver_set_channel(): got -2, expected 0 or more, or -1 for all\n"
                             "Warning: wb_emitter_set_channel(): got -2, expected 0 or more, or -1 for all"));
}

TEST(DeviceFunctions, a_speaker_cannot_speak) {
  Simulator sim([] {
    wb_robot_init();
    printf("%s %s ", wb_speaker_get_language(kSpeaker), wb_speaker_get_engine(kSpeaker));
    printf("%d%d%d ", wb_speaker_set_language(kSpeaker, "de-DE"),
           wb_speaker_set_engine(kSpeaker, "microsoft"), wb_speaker_set_engine(kSpeaker, nullptr));
    printf("%s %s ", wb_speaker_get_language(kSpeaker), wb_speaker_get_engine(kSpeaker));
    wb_speaker_speak(kSpeaker, "hello", 1);
    speaker_emit_sample(kSpeaker, "ab", 2);
    printf("%d", wb_speaker_is_speaking(kSpeaker));
  });
  sim.welcome(all_kinds());
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "en-US pico 110 de-DE microsoft 0");
  EXPECT_TRUE(wording::reads(
      sim.errors(),
      "Warning: wb_speaker_speak(): text is not spoken; play a sound\n"
      "Warning: speaker_emit_sample(): the e-puck plays sounds of files and its own, not samples"));
}

namespace {
WbMutexRef both;
int done_by_task;
void task(void* with) {
  wb_robot_mutex_lock(both);
  done_by_task += *static_cast<int*>(with);
  wb_robot_mutex_unlock(both);
}
void say_begun() { printf("begun "); }
}  // namespace

TEST(DeviceFunctions, the_robot_names_itself_and_keeps_a_text) {
  Simulator sim([] {
    wb_robot_init();
    wb_robot_live(say_begun);
    printf("%s %s %g %d %d %d\n", wb_robot_get_name(), robot_get_name(), robot_get_basic_time_step(),
           wb_robot_get_mode() == robot_get_mode(), wb_robot_get_synchronization(),
           robot_get_synchronization());
    printf("%d %d\n", std::string(wb_robot_get_controller_name()).empty(),
           std::string(wb_robot_get_project_path()) == robot_get_project_path());
    wb_robot_set_data("kept");
    wb_robot_pin_to_static_environment(true);
    wb_robot_set_mode(WB_MODE_SIMULATION, "");
    printf("%s [%s] ", wb_robot_get_data(), wb_robot_get_urdf("x"));
    wb_robot_set_mode(WB_MODE_REMOTE_CONTROL, "");
    wb_robot_console_printf("%d of %s ", 3, "four");
    robot_console_printf("%s\n", "five");
    wb_console_print("out", WB_STDOUT);
    wb_console_print(nullptr, WB_STDOUT);
    wb_console_print("err\n", WB_STDERR);
    wb_robot_step(32);
  });
  sim.welcome(all_kinds());
  const auto said = sim.until_step();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].number, LINK_SET_CUSTOM);
  EXPECT_EQ(said[0].texts[0], "kept");
  sim.done(kStep);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "begun puck puck 32 1 1 1\n0 1\nkept [] 3 of four five\nout");
  EXPECT_TRUE(wording::reads(sim.errors(),
                             "Warning: wb_robot_get_urdf(): there is no URDF of this robot\n"
                             "Warning: wb_robot_set_mode(): got mode 2, expected 0, the simulation\nerr"));
}

TEST(DeviceFunctions, a_task_runs_beside_the_program) {
  Simulator sim([] {
    wb_robot_init();
    static int with = 42;
    both = wb_robot_mutex_new();
    wb_robot_mutex_lock(both);
    wb_robot_task_new(task, &with);
    printf("%d ", done_by_task);  // it waits for the mutex
    wb_robot_mutex_unlock(both);
    for (int done = 0; !done;) {
      wb_robot_mutex_lock(both);
      done = done_by_task;
      wb_robot_mutex_unlock(both);
    }
    printf("%d", done_by_task);
    wb_robot_mutex_delete(both);
  });
  sim.welcome(all_kinds());
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "0 42");
}
