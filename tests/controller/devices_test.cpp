// SPDX-License-Identifier: MIT
// Devices: what programs read and command, in both interfaces.
#include <device/differential_wheels.h>
#include <device/distance_sensor.h>
#include <device/emitter.h>
#include <device/gps.h>
#include <device/led.h>
#include <device/receiver.h>
#include <device/robot.h>
#include <gtest/gtest.h>
#include <webots/camera.h>
#include <webots/compass.h>
#include <webots/device.h>
#include <webots/differential_wheels.h>
#include <webots/distance_sensor.h>
#include <webots/emitter.h>
#include <webots/gps.h>
#include <webots/inertial_unit.h>
#include <webots/keyboard.h>
#include <webots/led.h>
#include <webots/lidar.h>
#include <webots/microphone.h>
#include <webots/motor.h>
#include <webots/position_sensor.h>
#include <webots/radio.h>
#include <webots/range_finder.h>
#include <webots/receiver.h>
#include <webots/robot.h>
#include <webots/robot_wwi.h>
#include <webots/servo.h>
#include <webots/speaker.h>

#include <cmath>
#include <cstdio>
#include <cstring>

#include "tests/controller/fake_simulator.h"
#include "tests/support/wording.h"

using fake::Packet;
using fake::Simulator;
using fake::World;

namespace {
constexpr std::int64_t kStep = 32000000;  // ns

World puck() {
  World world;
  world.devices = {{1, WB_NODE_DISTANCE_SENSOR, "ps0", {0, 4095, 0.3, 1, 0, 4095, 0.01, 0.07, 0, 0}},
                   {2, WB_NODE_ROTATIONAL_MOTOR, "left wheel motor", {6.28, 4}},
                   {3, WB_NODE_ROTATIONAL_MOTOR, "right wheel motor", {6.28, 5}},
                   {4, WB_NODE_POSITION_SENSOR, "left wheel sensor", {2}},
                   {5, WB_NODE_POSITION_SENSOR, "right wheel sensor", {3}},
                   {6, WB_NODE_LED, "led0", {}},
                   {7, WB_NODE_CAMERA, "camera", {2, 3, 0.84, 0.01, 1}},
                   {8, WB_NODE_EMITTER, "emitter", {1, -1, 100}},
                   {9, WB_NODE_RECEIVER, "receiver", {1}},
                   {10, WB_NODE_GPS, "gps", {}},
                   {11, WB_NODE_INERTIAL_UNIT, "inertial unit", {}},
                   {12, WB_NODE_MICROPHONE, "mic0", {}},
                   {13, WB_NODE_SPEAKER, "speaker", {}},
                   {14, WB_NODE_NO_NODE, "keyboard", {}},
                   {15, WB_NODE_NO_NODE, "battery", {}}};
  return world;
}

/// A step that samples nothing.
std::vector<fake::Record> pass(Simulator& sim, std::int64_t time_ns = kStep) {
  auto said = sim.until_step();
  sim.done(time_ns);
  return said;
}
}  // namespace

TEST(ControllerDevices, are_listed_without_the_hidden_ones) {
  Simulator sim([] {
    printf("%d %s %s %d %d", wb_robot_get_number_of_devices(),
           wb_device_get_name(wb_robot_get_device_by_index(0)), wb_device_get_model(1),
           wb_device_get_node_type(6) == WB_NODE_LED, wb_robot_get_device("led0"));
  });
  sim.welcome(puck());
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "13 ps0 ps0 model 1 6");
}

TEST(ControllerDevices, a_sensor_is_nan_before_its_first_sample) {
  Simulator sim([] {
    const WbDeviceTag ps = wb_robot_get_device("ps0");
    wb_distance_sensor_enable(ps, 64);
    printf("%d %d %d %d ", std::isnan(wb_distance_sensor_get_value(ps)), distance_sensor_get_value(ps),
           wb_distance_sensor_get_sampling_period(ps), wb_distance_sensor_get_lookup_table_size(ps));
    printf("%g ", wb_distance_sensor_get_lookup_table(ps)[1]);
    wb_robot_step(32);
    printf("%d ", std::isnan(wb_distance_sensor_get_value(ps)));
    wb_robot_step(32);
    printf("%g %d %g %g", wb_distance_sensor_get_value(ps), distance_sensor_get_value(ps),
           wb_distance_sensor_get_max_value(ps), wb_distance_sensor_get_aperture(ps));
  });
  sim.welcome(puck());
  const auto said = pass(sim);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].number, LINK_ENABLE);
  EXPECT_EQ(said[0].ints, (std::vector<std::int64_t>{1, 64}));
  EXPECT_TRUE(sim.until_step().empty());
  Packet samples;
  samples.add(LINK_NUMBERS, 1, std::vector<double>{123.75});
  sim.done(2 * kStep, samples);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "1 0 64 2 4095 1 123.75 123 4095 0.3");
}

TEST(ControllerDevices, wrong_tags_are_told_and_harmless) {
  Simulator sim([] {
    wb_robot_init();
    for (int i = 0; i < 30; ++i) wb_distance_sensor_enable(6, 64);
    printf("%d %d ", std::isnan(wb_distance_sensor_get_value(200)), std::isnan(wb_gps_get_values(0)[2]));
    wb_motor_set_velocity(0, 1);
    wb_led_set(65535, 1);
    printf("%d %d %d", wb_lidar_get_number_of_points(1), wb_receiver_get_queue_length(1),
           wb_distance_sensor_get_value(1) == 0);
  });
  sim.welcome(puck());
  EXPECT_TRUE(sim.next().empty()) << "nothing was commanded";
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "1 1 0 0 0");
  int lines = 0;
  for (const char c : sim.errors()) lines += c == '\n';
  EXPECT_LT(lines, 40) << sim.errors();
  std::string told;
  for (int i = 0; i < 20; ++i)
    told +=
        "Warning: wb_distance_sensor_enable(): got the tag of \"led0\", expected a device of this function's "
        "kind\n";
  EXPECT_TRUE(wording::reads(
      sim.errors(),
      told +
          "Warning: there are more warnings of this kind, which are not shown\nWarning: wb_gps_get_values(): "
          "got tag 0, expected one of wb_robot_get_device()\nWarning: wb_distance_sensor_get_value(): got "
          "tag 200, expected one of wb_robot_get_device()\nWarning: wb_motor_set_velocity(): got tag 0, "
          "expected one of wb_robot_get_device()\nWarning: wb_led_set(): got tag 65535, expected one of "
          "wb_robot_get_device()\nWarning: wb_distance_sensor_get_value(): got \"ps0\", which is not "
          "enabled, expected one with a sampling period"));
}

TEST(ControllerDevices, an_unknown_name_is_asked_for_and_told) {
  Simulator sim([] {
    printf("%d ", wb_robot_get_device("laser cannon"));
    printf("%d ", wb_robot_get_device("virtual"));
    printf("%d ", wb_robot_get_device("virtual"));
    printf("%d", wb_robot_get_device("gs0"));
  });
  sim.welcome(puck());
  const auto asked = sim.next();
  ASSERT_EQ(asked.size(), 1u);
  EXPECT_EQ(asked[0].texts[0], "laser cannon");
  sim.send(Packet().add(LINK_NOTHING, ""));
  EXPECT_EQ(sim.next()[0].texts[0], "virtual");
  sim.send(Packet().add(LINK_DEVICE, 30, int{WB_NODE_DISTANCE_SENSOR}, "virtual", "",
                        std::vector<double>{0, 1, 0, 0}));
  EXPECT_EQ(sim.next()[0].texts[0], "gs0") << "the device told is not asked for again";
  sim.send(Packet().add(LINK_NOTHING, "the robot does not carry ground sensors"));
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "0 30 30 0");
  EXPECT_EQ(sim.errors(),
            "Warning: wb_robot_get_device(): got device \"laser cannon\", expected one that this robot has\n"
            "Warning: wb_robot_get_device(\"gs0\"): the robot does not carry ground sensors\n");
}

TEST(ControllerDevices, motors_are_commanded_and_limited) {
  Simulator sim([] {
    wb_robot_init();
    printf("%g %g ", wb_motor_get_velocity(2), wb_motor_get_max_velocity(2));
    wb_motor_set_position(2, INFINITY);
    wb_motor_set_velocity(2, 3.5);
    wb_motor_set_velocity(3, -100);
    wb_motor_set_velocity(3, NAN);
    printf("%g %g %d %d", wb_motor_get_velocity(2), wb_motor_get_velocity(3), wb_motor_get_position_sensor(3),
           wb_position_sensor_get_motor(4));
    wb_robot_step(32);
  });
  sim.welcome(puck());
  const auto said = pass(sim);
  ASSERT_EQ(said.size(), 3u);
  EXPECT_EQ(said[0].number, LINK_POSITION);
  EXPECT_TRUE(std::isinf(said[0].reals[0]));
  EXPECT_EQ(said[1].number, LINK_VELOCITY);
  EXPECT_EQ(said[1].ints[0], 2);
  EXPECT_EQ(said[1].reals[0], 3.5);
  EXPECT_EQ(said[2].reals[0], -6.28);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "6.28 6.28 3.5 -6.28 5 2");
}

TEST(ControllerDevices, servos_of_old_are_motors) {
  Simulator sim([] {
    wb_robot_init();
    wb_servo_enable_position(2, 32);
    wb_servo_set_position(2, WB_SERVO_INFINITY);
    wb_servo_set_velocity(2, 1);
    wb_robot_step(32);
    printf("%g", wb_servo_get_position(2));
  });
  sim.welcome(puck());
  const auto said = sim.until_step();
  ASSERT_EQ(said.size(), 3u);
  EXPECT_EQ(said[0].ints, (std::vector<std::int64_t>{4, 32}));
  EXPECT_EQ(said[2].reals[0], 1);
  Packet samples;
  samples.add(LINK_NUMBERS, 4, std::vector<double>{0.5});
  sim.done(kStep, samples);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "0.5");
}

TEST(ControllerDevices, differential_wheels_are_the_motors) {
  Simulator sim([] {
    wb_robot_init();
    wb_differential_wheels_enable_encoders(32);
    wb_differential_wheels_set_speed(500, -10000);
    printf("%g %g %g ", wb_differential_wheels_get_left_speed(), wb_differential_wheels_get_right_speed(),
           wb_differential_wheels_get_left_encoder());
    wb_robot_step(32);
    printf("%g %d ", wb_differential_wheels_get_left_encoder(), differential_wheels_get_right_encoder());
    wb_differential_wheels_set_encoders(10, 0);
    printf("%g %g", wb_differential_wheels_get_left_encoder(), wb_differential_wheels_get_right_encoder());
  });
  sim.welcome(puck());
  const auto said = sim.until_step();
  EXPECT_EQ(of(said, LINK_ENABLE).size(), 2u);
  const auto speeds = of(said, LINK_VELOCITY);
  ASSERT_EQ(speeds.size(), 2u);
  EXPECT_DOUBLE_EQ(speeds[0].reals[0], 500 * 0.00628);
  EXPECT_DOUBLE_EQ(speeds[1].reals[0], -6.28);  // 10000 units would be 62.8 rad/s
  EXPECT_EQ(of(said, LINK_POSITION).size(), 2u) << "they leave position control";
  Packet samples;
  samples.add(LINK_NUMBERS, 4, std::vector<double>{2 * M_PI * 50 / 1000});
  samples.add(LINK_NUMBERS, 5, std::vector<double>{-2 * M_PI * 7 / 1000});
  sim.done(kStep, samples);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "500 -1000 0 50 -7 10 0");
}

TEST(ControllerDevices, leds_are_set) {
  Simulator sim([] {
    wb_led_set(wb_robot_get_device("led0"), 1);
    led_set(6, 0);
    wb_led_set(6, 0xFF0000);
    printf("%d", wb_led_get(6));
    wb_robot_step(0);
  });
  sim.welcome(puck());
  const auto said = of(pass(sim), LINK_LED);
  ASSERT_EQ(said.size(), 3u);
  EXPECT_EQ(said[2].ints, (std::vector<std::int64_t>{6, 0xFF0000}));
  EXPECT_EQ(sim.asked_ms(), 0);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "16711680");
}

TEST(ControllerDevices, a_picture_may_come_in_pieces) {
  Simulator sim([] {
    const WbDeviceTag c = wb_robot_get_device("camera");
    printf("%d ", wb_camera_get_image(c) == nullptr);
    wb_camera_enable(c, 32);
    printf("%d ", wb_camera_get_image(c)[3]);
    wb_robot_step(32);
    const unsigned char* image = wb_camera_get_image(c);
    printf("%d %d %d %d %d %g", wb_camera_get_width(c), wb_camera_get_height(c),
           wb_camera_image_get_blue(image, 2, 0, 0), wb_camera_image_get_red(image, 2, 1, 2),
           wb_camera_image_get_gray(image, 2, 1, 2), wb_camera_get_fov(c));
  });
  sim.welcome(puck());
  sim.until_step();
  std::string top(16, '\x05'), rest(8, '\x01');
  rest[6] = '\x0A';  // red of the last pixel: blue, green, red are 1, 1, 10
  Packet samples;
  samples.add(LINK_PICTURE, 7, 2, 3, 0, top).add(LINK_PICTURE, 7, 2, 3, 2, rest);
  samples.add(LINK_PICTURE, 7, 2, 3, 2, top);        // beyond the last row: refused
  samples.add(LINK_PICTURE, 7, 5, 3, 0, top + top);  // of another size: refused
  sim.done(kStep, samples);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "1 0 2 3 5 10 4 0.84");
}

TEST(ControllerDevices, recognised_objects_are_told) {
  Simulator sim([] {
    const WbDeviceTag c = wb_robot_get_device("camera");
    wb_camera_recognition_enable(c, 32);
    printf("%d %d ", wb_camera_has_recognition(c), wb_camera_recognition_get_number_of_objects(c));
    wb_robot_step(32);
    const WbCameraRecognitionObject* o = wb_camera_recognition_get_objects(c);
    printf("%d: %d %s %g %g %g %d %d %d %g ", wb_camera_recognition_get_number_of_objects(c), o[1].id,
           o[1].model, o[1].position[2], o[1].orientation[3], o[1].size[1], o[1].position_on_image[0],
           o[1].size_on_image[1], o[1].number_of_colors, o[1].colors[4]);
    wb_robot_step(32);
    printf("%d", wb_camera_recognition_get_number_of_objects(c));
  });
  sim.welcome(puck());
  const auto said = sim.until_step();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].number, LINK_RECOGNISE);
  const std::vector<double> numbers{1, 2, 3, 0, 0, 1, 0.5, 0.1, 0.2, 20, 21, 8, 9};
  Packet samples;
  samples.add(LINK_RECOGNITION, 7, 2);
  samples.add(LINK_RECOGNISED, 7, 41, "ball", numbers, std::vector<double>{});
  samples.add(LINK_RECOGNISED, 7, 42, "box", numbers, std::vector<double>{1, 0, 0, 0, 0.5, 0});
  sim.done(kStep, samples);
  sim.until_step();
  Packet none;
  none.add(LINK_RECOGNITION, 7, 0);
  sim.done(2 * kStep, none);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "1 0 2: 42 box 3 0.5 0.2 20 9 2 0.5 0");
}

TEST(ControllerDevices, packets_wait_in_the_receiver) {
  Simulator sim([] {
    const WbDeviceTag r = wb_robot_get_device("receiver");
    wb_receiver_enable(r, 32);
    wb_robot_step(32);
    wb_robot_step(32);
    printf("%d ", wb_receiver_get_queue_length(r));
    const char* first = static_cast<const char*>(wb_receiver_get_data(r));
    printf("%s %d %g ", first, wb_receiver_get_data_size(r), wb_receiver_get_signal_strength(r));
    wb_receiver_next_packet(r);
    printf("%s %g %d ", static_cast<const char*>(receiver_get_data(r)),
           wb_receiver_get_emitter_direction(r)[1], receiver_get_queue_length(r));
    wb_receiver_next_packet(r);
    printf("%d %d", wb_receiver_get_queue_length(r), wb_receiver_get_data(r) == nullptr);
  });
  sim.welcome(puck());
  sim.until_step();
  Packet samples;
  samples.add(LINK_PACKET, 9, 1, "hello", 4.0, 1.0, 0.0, 0.0);
  sim.done(kStep, samples);
  sim.until_step();
  Packet more;
  more.add(LINK_PACKET, 9, 1, std::string(4090, 'x'), 1.0, 0.0, 0.0, 0.0);  // 4095 of 4096 bytes
  more.add(LINK_PACKET, 9, 1, "lost", 1.0, 0.0, 0.0, 0.0);
  sim.done(2 * kStep, more);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "2 hello 5 4 " + std::string(4090, 'x') + " 0 1 0 1");
}

TEST(ControllerDevices, the_emitters_queue_is_full_until_the_next_step) {
  Simulator sim([] {
    const WbDeviceTag e = wb_robot_get_device("emitter");
    const char data[100] = "abc";
    for (const int size : {60, 41, 40, 0}) printf("%d", wb_emitter_send(e, data, size));
    printf(" ");
    memcpy(emitter_get_buffer(e), "old", 4);
    wb_robot_step(32);
    printf("%d %d ", emitter_send(e, 4), wb_emitter_get_channel(e));
    wb_emitter_set_channel(e, WB_CHANNEL_BROADCAST);
    wb_emitter_set_range(e, 0.5);
    printf("%d %g", wb_emitter_get_channel(e), wb_emitter_get_range(e));
    wb_robot_step(32);
  });
  sim.welcome(puck());
  const auto said = pass(sim);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[0].texts[0].size(), 60u);
  const auto later = pass(sim);
  ASSERT_EQ(later.size(), 3u);
  EXPECT_EQ(later[0].texts[0], std::string("old\0", 4));
  EXPECT_EQ(later[1].ints, (std::vector<std::int64_t>{8, -1}));
  EXPECT_EQ(later[2].reals[0], 0.5);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "1010 1 1 -1 0.5");
}

TEST(ControllerDevices, values_of_three_and_more) {
  Simulator sim([] {
    wb_robot_init();
    wb_gps_enable(10, 32);
    wb_inertial_unit_enable(11, 32);
    const double* position = wb_gps_get_values(10);
    printf("%d ", std::isnan(position[2]));
    wb_robot_step(32);
    printf("%g %g %g %g ", position[0], wb_gps_get_speed(10), wb_gps_get_speed_vector(10)[1],
           gps_get_values(10)[2]);
    const double* q = wb_inertial_unit_get_quaternion(11);
    printf("%g %.4f %.4f %.4f %.4f", wb_inertial_unit_get_roll_pitch_yaw(11)[2], q[0], q[1], q[2], q[3]);
  });
  sim.welcome(puck());
  sim.until_step();
  Packet samples;
  samples.add(LINK_NUMBERS, 10, std::vector<double>{0.5, 1, 0.25, 0.3, 0.4, 0});
  samples.add(LINK_NUMBERS, 11, std::vector<double>{0, 0, 1});
  sim.done(kStep, samples);
  EXPECT_EQ(sim.wait(), 0);
  // half an angle of 1 rad: sin 0.4794, cos 0.8776
  EXPECT_EQ(sim.output(), "1 0.5 0.5 0.4 0.25 1 0.0000 0.0000 0.4794 0.8776");
}

TEST(ControllerDevices, keys_are_told_once_a_step) {
  Simulator sim([] {
    wb_robot_init();
    wb_keyboard_enable(32);
    wb_robot_step(32);
    const long first = wb_keyboard_get_key(), second = wb_keyboard_get_key();
    printf("%ld %ld %ld %ld ", first, second, wb_keyboard_get_key(), wb_robot_keyboard_get_key());
    wb_robot_step(32);
    printf("%ld", wb_keyboard_get_key());
  });
  sim.welcome(puck());
  EXPECT_EQ(of(sim.until_step(), LINK_ENABLE)[0].ints, (std::vector<std::int64_t>{14, 32}));
  Packet samples;
  samples.add(LINK_KEYS, std::vector<double>{WB_KEYBOARD_UP, 'A'});
  sim.done(kStep, samples);
  pass(sim);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "315 65 -1 0 -1");
}

TEST(ControllerDevices, sounds_are_recorded_and_played) {
  Simulator sim([] {
    wb_robot_init();
    wb_microphone_enable(12, 32);
    printf("%d ", wb_microphone_get_sample_data(12) == nullptr);
    wb_speaker_play_sound(13, 13, "sounds/haa.wav", 0.5, 1, 0, false);
    printf("%d%d ", wb_speaker_is_sound_playing(13, "sounds/haa.wav"),
           wb_speaker_is_sound_playing(13, "ouah"));
    wb_robot_step(32);
    const short* samples = static_cast<const short*>(wb_microphone_get_sample_data(12));
    printf("%d %d %d%d ", wb_microphone_get_sample_size(12), samples[1], wb_speaker_is_sound_playing(13, ""),
           wb_speaker_is_sound_playing(13, "sounds/haa.wav"));
    wb_speaker_stop(13, nullptr);
    wb_speaker_play_sound(13, 13, "refused.wav", 1, 1, 0, false);
    printf("%d", wb_speaker_is_sound_playing(13, "refused.wav"));
    wb_robot_step(32);
    printf("%d", wb_speaker_is_sound_playing(13, nullptr));
  });
  sim.welcome(puck());
  const auto said = of(sim.until_step(), LINK_PLAY);
  ASSERT_EQ(said.size(), 1u) << "left and right are one";
  EXPECT_EQ(said[0].texts[0], "sounds/haa.wav");
  EXPECT_EQ(said[0].reals, (std::vector<double>{0.5, 1, 0}));
  Packet samples;
  samples.add(LINK_SOUND, 12, std::string("\0\0\x10\0", 4)).add(LINK_PLAYING, 13, "haa");
  sim.done(kStep, samples);
  EXPECT_EQ(of(sim.until_step(), LINK_SILENCE).size(), 1u);
  sim.done(2 * kStep);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "1 10 4 16 11 10");
}

TEST(ControllerDevices, lidars_and_range_finders_give_rows_of_distances) {
  Simulator sim([] {
    wb_robot_init();
    wb_lidar_enable(20, 32);
    wb_lidar_enable_point_cloud(20);
    wb_range_finder_enable(21, 32);
    printf("%d ", std::isinf(wb_lidar_get_range_image(20)[3]));
    wb_robot_step(32);
    const float* seen = wb_lidar_get_layer_range_image(20, 1);
    const WbLidarPoint* points = wb_lidar_get_point_cloud(20);
    printf("%d %d %g %g %g ", wb_lidar_get_number_of_points(20), wb_lidar_get_horizontal_resolution(20),
           seen[0], seen[1], wb_lidar_get_max_range(20));
    // the left half's middle is a quarter of 2 rad to the left, the upper layer 0.1 rad up
    printf("%.4f %.4f %.4f %d %d ", points[0].x, points[0].y, points[0].z, std::isinf(points[1].x),
           points[3].layer_id);
    const float* depth = wb_range_finder_get_range_image(21);
    printf("%d %g %d", wb_range_finder_get_width(21), wb_range_finder_image_get_depth(depth, 3, 2, 0),
           wb_lidar_get_layer_range_image(20, 2) == nullptr);
  });
  World world = puck();
  world.devices.push_back({20, WB_NODE_LIDAR, "lidar", {2, 2, 2, 0.1, 3.5, 0.2}});
  world.devices.push_back({21, WB_NODE_RANGE_FINDER, "range-finder", {3, 1, 1, 0.01, 1, 0}});
  sim.welcome(world);
  sim.until_step();
  Packet samples;
  samples.add(LINK_NUMBERS, 20, std::vector<double>{2, INFINITY, 0.5, 0.75});
  samples.add(LINK_NUMBERS, 21, std::vector<double>{0.1, 0.2, 0.3});
  samples.add(LINK_DONE, kStep, 32);
  sim.send(samples);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "1 4 2 0.5 0.75 3.5 1.7464 0.9541 0.1997 1 1 3 0.3 1");
  EXPECT_EQ(sim.errors(), "");
}

TEST(ControllerDevices, kinds_that_no_robot_has_are_harmless) {
  Simulator sim([] {
    const WbDeviceTag lidar = 0;
    wb_lidar_enable(lidar, 32);
    wb_radio_send(0, nullptr, 0);
    WbRadioMessage message = wb_radio_message_new(3, "abc", "there");
    printf("%d %s %s %d", wb_lidar_get_range_image(lidar) == nullptr, wb_radio_message_get_body(message),
           wb_radio_message_get_destination(message), wb_camera_get_type(7));
    wb_radio_message_delete(message);
  });
  sim.welcome(puck());
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "1 abc there " + std::to_string(int{WB_CAMERA_COLOR}));
  EXPECT_TRUE(
      wording::reads(sim.errors(),
                     "Warning: wb_lidar_enable(): got tag 0, expected one of wb_robot_get_device()\nWarning: "
                     "wb_radio_send(): got tag 0, expected one of wb_robot_get_device()\nWarning: "
                     "wb_lidar_get_range_image(): got tag 0, expected one of wb_robot_get_device()"));
}

TEST(ControllerDevices, battery_and_window_answer_as_without_one) {
  Simulator sim([] {
    wb_robot_battery_sensor_enable(32);
    int size = 5;
    const char* message = wb_robot_wwi_receive(&size);
    printf("%d %d %d %d ", std::isnan(wb_robot_battery_sensor_get_value()), message == nullptr, size,
           wb_robot_wait_for_user_input_event(WB_EVENT_KEYBOARD, 1000));
    wb_robot_step(32);
    printf("%g", wb_robot_battery_sensor_get_value());
  });
  sim.welcome(puck());
  EXPECT_EQ(sim.until_step()[0].ints[0], 15);
  Packet samples;
  samples.add(LINK_NUMBERS, 15, std::vector<double>{17000});
  sim.done(kStep, samples);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "1 1 0 0 17000");
}

namespace {
void begin() { printf("begin "); }
int run(int passed) {
  printf("%d ", passed);
  return 64;
}
void finish() { printf("die"); }
}  // namespace

TEST(ControllerDevices, the_interface_of_2005_runs_by_calling_back) {
  Simulator sim([] {
    robot_live(begin);
    robot_die(finish);
    robot_run(run);
    printf("never");
  });
  sim.welcome(puck());
  pass(sim);
  EXPECT_EQ(sim.asked_ms(), 64);
  sim.until_step();
  sim.send(Packet().add(LINK_END));
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "begin 0 32 die");
}
