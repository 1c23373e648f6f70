// SPDX-License-Identifier: MIT
#include "bench/enki_swarm.h"

#include <enki/PhysicalEngine.h>
#include <enki/robots/e-puck/EPuck.h>

#include <algorithm>
#include <vector>

namespace bench {

namespace {

constexpr double kCentimetres = 100;
constexpr double kControlPeriodS = 0.064;
constexpr unsigned kSubsteps = 6;

// the common workload's law: 8 cm/s, plus 8 cm/s times the weighted sum, within the motors' 12.8 cm/s
class BraitenbergPuck : public Enki::EPuck {
 public:
  void control() {
    static constexpr double kLeft[8] = {-1.3, -1, -.5, 0, 0, .5, 1, 1.1};
    static constexpr double kRight[8] = {1.1, 1, .5, 0, 0, -.5, -1, -1.3};
    const Enki::IRSensor* ring[8] = {&infraredSensor0, &infraredSensor1, &infraredSensor2, &infraredSensor3,
                                     &infraredSensor4, &infraredSensor5, &infraredSensor6, &infraredSensor7};
    double left = 0, right = 0;
    for (int i = 0; i < 8; ++i) {
      const double p = std::clamp(ring[i]->getValue() / 1000.0, 0.0, 1.0);
      left += kLeft[i] * p;
      right += kRight[i] * p;
    }
    leftSpeed = std::clamp(8 + 8 * left, -12.8, 12.8);
    rightSpeed = std::clamp(8 + 8 * right, -12.8, 12.8);
  }
};

}  // namespace

struct EnkiSwarm::Inside {
  explicit Inside(double side_cm) : world(side_cm, side_cm) {}
  Enki::World world;  // owns the objects
  std::vector<BraitenbergPuck*> robots;
};

EnkiSwarm::EnkiSwarm(const sim::WorldDesc& desc)
    : inside_(std::make_unique<Inside>(desc.arena->size_m.x * kCentimetres)) {
  inside_->world.setRandomSeed(1);
  const double shift_x = (desc.arena->size_m.x / 2 - desc.arena->centre_m.x) * kCentimetres;
  const double shift_y = (desc.arena->size_m.y / 2 - desc.arena->centre_m.y) * kCentimetres;
  const auto place = [&](Enki::PhysicalObject* object, const sim::Pose2& pose) {
    object->pos = Enki::Point(pose.x_m * kCentimetres + shift_x, pose.y_m * kCentimetres + shift_y);
    object->angle = pose.heading_rad;
    inside_->world.addObject(object);
  };
  for (const auto& box : desc.objects) {
    auto* object = new Enki::PhysicalObject();
    object->setRectangular(box.size_m.x * kCentimetres, box.size_m.y * kCentimetres,
                           box.size_m.z * kCentimetres, -1);
    place(object, box.pose);
  }
  for (const auto& robot : desc.robots) {
    inside_->robots.push_back(new BraitenbergPuck);
    place(inside_->robots.back(), robot.pose);
  }
}

EnkiSwarm::~EnkiSwarm() = default;

void EnkiSwarm::control_step() {
  for (auto* robot : inside_->robots) robot->control();
  inside_->world.step(kControlPeriodS, kSubsteps);
}

}  // namespace bench
