// SPDX-License-Identifier: MIT
// A stand-in for sim_core's Scene: a test sets what every sensor sees, and may look at who
// asked for what and when.
#pragma once
#include <functional>
#include <vector>

#include "sim_core/camera/camera.h"
#include "sim_core/light/proximity.h"
#include "sim_core/physics/leg.h"
#include "sim_core/sound/sound_field.h"
#include "sim_core/world/true_motion.h"

namespace sim {

class Scene {
 public:
  struct Question {
    int sensor;
    Clicks at;
  };
  std::function<double(int sensor, Clicks at)> reflection = [](int, Clicks) { return 0.0; };
  /// What a camera sees in the direction (1 forward, u right, v up).
  std::function<Light(double u, double v, Clicks at)> light = [](double, double, Clicks) { return Light{}; };
  double irradiance_w_m2 = 0;
  std::function<double(const Vec3& point_m, Clicks at)> sound_pa;  // what is heard at a point of the robot
  double relative_noise = 0;
  bool uniform_noise = false;
  Pose2 pose(int body, Clicks at) const;  ///< always the origin: true positions are tested in whole worlds
  BodyState state(int body) const;
  std::function<Vec3(Clicks at)> force_m_s2 = [](Clicks) { return Vec3{0, 0, 9.81}; };
  std::function<Vec3(Clicks at)> turn_rad_s = [](Clicks) { return Vec3{}; };
  mutable std::vector<Question> asked;
};

/// What loudspeakers told the air (flat_sound.cpp).
struct Published {
  bool plays;
  Clicks now;
  SpeakerTrack track;
};
std::vector<Published>& flat_sound();

}  // namespace sim
