// SPDX-License-Identifier: MIT
// A robot as a world file says it.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim_core/geometry/pose.h"
#include "sim_core/world/device_desc.h"
#include "sim_core/world/file_place.h"
#include "sim_core/world/own_keys.h"
#include "sim_core/world/part_desc.h"
#include "sim_core/world/proximity_desc.h"
#include "sim_core/world/radio_desc.h"
#include "sim_core/world/robot_model.h"

namespace sim {

/// Departures of one robot from its model. Fixed parts as written; the random spread is drawn from the
/// robot's seed by resolve_variation() (world/variation.h).
struct Variation {
  std::vector<double> sensor_gain;           ///< factor per proximity sensor; empty = 1
  std::vector<double> sensor_offset_counts;  ///< added per proximity sensor; empty = 0
  double left_wheel_ratio = 1;               ///< true over nominal wheel radius
  double right_wheel_ratio = 1;
  double axle_ratio = 1;  ///< effective over nominal axle
  double clock_ppm = 0;   ///< positive: the robot's clock is fast
  double boot_delay_s = 0;
  double gain_spread = 0;                     ///< standard deviation of a further factor per sensor
  double offset_spread_counts = 0;            ///< standard deviation, counts
  double wheel_spread = 0;                    ///< standard deviation of a further wheel factor, each side
  double axle_spread = 0;                     ///< standard deviation of a further axle factor
  double clock_spread_ppm = 0;                ///< standard deviation, ppm
  double boot_spread_s = 0;                   ///< the delay grows by a uniform draw from 0 to this
  std::array<double, 3> acc_offset_m_s2{};    ///< added to the accelerometer, robot frame: forward, left, up
  std::array<double, 3> gyro_offset_rad_s{};  ///< added to the gyroscope, same frame
  double acc_offset_spread_m_s2 = 0;          ///< standard deviation of a further offset per axis
  double gyro_offset_spread_rad_s = 0;        ///< standard deviation of a further offset per axis
  double motion_noise_scale = 1;  ///< factor on the noise of accelerometer and gyroscope; 0 = none
};

/// A key of a remote control that somebody presses for a robot.
struct KeyDesc {
  int code = 0;         ///< 0 to 63
  double at_s = 0;      ///< s, world time
  double hold_s = 0.1;  ///< s
  int address = 0;      ///< 0 to 31
  int typed = 0;        ///< instead of a remote control's: a keyboard's key, by Webots' number
};

/// What happens between the motors and the floor, as written: what is not set is inherited (robot from
/// world).
struct WheelSettings {
  std::optional<double> noise;  ///< random part of each wheel's travel, drawn anew every 1/32 s; 0: none
  std::optional<NoiseLaw> noise_law;  ///< noise is a half width (uniform, usual) or a standard deviation
  std::optional<double> slip;         ///< fraction of the wheels' travel that is lost on the floor; 0: none
};

struct RobotDesc {
  std::string name;
  std::string def;          ///< second name, by which supervisors may look it up; may be empty
  std::string model;        ///< empty: the only or first model the caller knows
  std::string firmware;     ///< name or path as written; may be empty
  FilePlace firmware_at;    ///< where that is written
  std::string args;         ///< what a program of the PC gets, words as argument_words() has them
  bool supervisor = false;  ///< its program may do what supervisors may
  std::string custom_data;  ///< a text of the robot that programs may read and change
  std::vector<Colour> recognition_colours;  ///< what cameras that recognise tell of it; empty: nothing
  int node = 0;                             ///< line of its node in WebotsDesc::world; 0: none
  OwnValues own;                            ///< of the keys that its model lists
  Pose2 pose;
  std::optional<std::uint64_t> seed;  ///< unset: made of the world's seed and the robot's index
  double battery_v = -1;              ///< V; negative: the model's
  double battery_wh = -1;             ///< Wh when full; negative: the model's
  std::optional<Colour> colour;
  WheelSettings wheels;  ///< what is not set is the world's
  std::string uart1 = "-";
  std::string uart2 = "none";
  LinkEndDesc link;
  Variation variation;
  ProximitySettings proximity;
  std::vector<SensorDesc> sensors;
  std::vector<PartDesc> parts;
  std::vector<KeyDesc> keys;  ///< presses of remote controls, in any order
  std::vector<DeviceDesc> devices;
  int line = 0;  ///< line in the world file; 0 when built in C++
};

}  // namespace sim
