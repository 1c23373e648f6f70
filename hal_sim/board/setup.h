// SPDX-License-Identifier: MIT
// What distinguishes one e-puck from another; fixed while it is powered.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hal_sim/board/battery_params.h"
#include "hal_sim/board/camera.h"
#include "hal_sim/board/sound_params.h"
#include "sim_core/world/device_desc.h"

namespace board {

/// Hardware revisions that firmware can tell apart.
enum class Revision {
  Analogue,  ///< rev 1.0 to 1.2: MMA7260 accelerometer on AN5 to AN7
  Rev13,     ///< rev 1.3: LSM330 on I2C, battery voltage on AN7
};

inline constexpr int kRingSensors = 8;

/// Camera of a robot that does not say which one it carries.
constexpr CameraKind usual_camera(Revision revision) {
  return revision == Revision::Rev13 ? CameraKind::Po8030d : CameraKind::Po3030k;
}

struct Setup {
  int robot = 0;                   ///< index in the Scene
  std::uint64_t seed = 1;          ///< of all noise of this robot
  int selector = 0;                ///< position 0 to 15
  double battery_v = 4.0;          ///< V at power-up with nothing but the electronics on, 3.0 to 4.2
  double battery_wh = kBatteryWh;  ///< Wh, energy of a full battery
  Revision revision = Revision::Analogue;
  std::array<double, 2> wheel_ratio{1.0, 1.0};  ///< true over nominal wheel size, left and right
  std::array<double, kRingSensors> ir_gain{1, 1, 1, 1, 1, 1, 1, 1};  ///< factor on the reflected response
  std::array<double, kRingSensors> ir_offset_counts{};  ///< added to dark - lit where nothing reflects
  double ir_noise_scale = 1.0;                          ///< factor on the profile's relative noise; 0 = none
  double ambient_noise_counts = 0;  ///< standard deviation of every conversion of an IR channel, counts
  double ambient_counts_per_w_m2 = kAmbientCountsPerWm2;  ///< fall of the dark sample with light
  CameraKind camera = CameraKind::Po3030k;
  CameraMount camera_mount = CameraMount::Upright;
  double camera_noise = 1;                    ///< factor on the camera's noise; 0 none
  double mic_noise_counts = kMicNoiseCounts;  ///< standard deviation of every conversion of a microphone
  std::array<double, 3> acc_offset_m_s2{};    ///< added to the specific force: forward, left, up
  std::array<double, 3> gyro_offset_rad_s{};  ///< added to the angular rates about these axes
  double motion_noise_scale = 1;              ///< factor on the noise of accelerometer and gyroscope
  double clock_ppm = 0;                       ///< crystal error, parts per million, positive = fast
  double boot_delay_s = 0;                    ///< s from the world's beginning to the first instruction
  std::string name;                           ///< in the world
  sim::WebotsDesc webots;                     ///< of the world
  std::vector<sim::DeviceDesc> devices;       ///< that only programs for Webots' interfaces know
};

}  // namespace board
