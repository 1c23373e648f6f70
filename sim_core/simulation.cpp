// SPDX-License-Identifier: MIT
// One tick, in order: minds run against the frozen scene, wheels turn into travel, bodies move, poses are
// published, messages pass, the digest grows.
#include "sim_core/simulation.h"

#include <algorithm>
#include <cmath>

#include "sim_core/base/check.h"
#include "sim_core/base/worker_pool.h"
#include "sim_core/light/proximity.h"
#include "sim_core/physics/physics_params.h"
#include "sim_core/random/counter_random.h"
#include "sim_core/sound/sound_field.h"
#include "sim_core/world/variation.h"

namespace sim {
namespace {

/// The motion engine of a world, its numbers gathered from models, variations and materials.
std::unique_ptr<Motion> make_motion(const WorldDesc& world, const Layout& layout) {
  MotionDesc desc;
  desc.tick_s = 1.0 / world.physics_hz;
  desc.gravity_m_s2 = world.gravity_m_s2;
  desc.fixed = &layout.fixed;
  desc.ground = &layout.ground;
  for (const Surface& s : layout.fixed_surface) desc.surfaces.push_back({s.friction, s.restitution});
  for (std::size_t i = 0; i < layout.moving.size(); ++i) {
    desc.solids.push_back(layout.moving[i].solid);
    desc.start.push_back({layout.moving_pose[i], layout.moving[i].z_m, {}, 0, 0});
  }
  for (std::size_t r = 0; r < world.robots.size(); ++r) {
    const RobotModel& m = *world.model_of(world.robots[r]);
    RobotBody body;
    body.mass_kg = m.mass_kg;
    body.inertia_kg_m2 = m.inertia_kg_m2;
    body.axle_m = m.axle_m * resolve_variation(world, static_cast<int>(r)).axle_ratio;
    body.hold_n = m.wheel_friction * world.floor.friction * m.mass_kg * world.gravity_m_s2;
    body.traction_n = std::min(body.hold_n, m.max_push_n);
    body.side_friction = m.side_friction;
    body.half_base_m = kFootingShare * m.body_radius_m;
    desc.robots.push_back(body);
  }
  for (int object : layout.loose_object) {
    const ObjectDesc& o = world.objects[static_cast<std::size_t>(object)];
    const bool rolls = o.kind == ObjectKind::Ball;
    desc.loose.push_back({o.mass_kg, rolls ? o.rolling_friction : o.floor_friction, o.material.friction,
                          o.material.restitution, rolls});
  }
  for (const RampDesc& ramp : world.ramps) desc.ramp_restitution.push_back(ramp.material.restitution);
  switch (world.engine) {
    case Engine::Kinematic:
      return make_kinematic_motion(std::move(desc));
    case Engine::Planar:
      return make_planar_motion(std::move(desc));
    case Engine::Dynamic:
      break;
  }
  return make_dynamic_motion(std::move(desc));
}

}  // namespace

Simulation::Simulation(const WorldDesc& world, Minds minds, int threads)
    : optics_(make_optics(world)),
      scene_(std::make_unique<Scene>(world, optics_reach_m(*optics_))),
      sound_(std::make_unique<SoundField>(scene_->world(), scene_->tick_clicks())),
      motion_(make_motion(scene_->world(), scene_->layout())),
      minds_(std::move(minds)) {
  CHECK(minds_.size() == world.robots.size(), "one mind per robot");
  scene_->attach_optics(optics_);
  scene_->attach_sound(sound_.get());
  const std::size_t n = minds_.size();
  idle_until_.resize(n);
  for (std::size_t r = 0; r < n; ++r) minds_[r]->keep_idle_in(&idle_until_[r]);
  wheels_.resize(n);
  angles_.resize(n);
  travel_.resize(n);
  distance_m_.assign(n, 0.0);
  last_place_.resize(n);
  for (std::size_t r = 0; r < n; ++r) {
    const RobotDesc& robot = scene_->world().robots[r];
    Wheels& w = wheels_[r];
    // a wheel's own size is the board's business: it tells angles of nominal wheels
    w.left_radius_m = w.right_radius_m = scene_->world().model_of(robot)->wheel_radius_m;
    const WheelSettings &own = robot.wheels, &common = scene_->world().wheels;
    w.noise = own.noise.value_or(common.noise.value_or(0));
    w.grip = 1 - own.slip.value_or(common.slip.value_or(0));
    w.gaussian = own.noise_law.value_or(common.noise_law.value_or(NoiseLaw::Uniform)) == NoiseLaw::Gaussian;
    w.seed = robot_seed(scene_->world(), static_cast<int>(r));
    last_place_[r] = {robot.pose.x_m, robot.pose.y_m};
  }
  digest_ = mix64(world.seed);
  if (threads > 1 && n > 1) workers_ = std::make_unique<WorkerPool>(std::min(threads, static_cast<int>(n)));
}

Simulation::~Simulation() = default;

void Simulation::step() {
  if (attendant_ && !attended_) {
    attended_ = true;
    attendant_->before_first_tick();
  }
  const Clicks end = scene_->now() + scene_->tick_clicks();
  run_minds(end);
  turn_wheels(end);
  const double moved_m = motion_->step(travel_.data(), scene_->neighbours());
  scene_->publish(motion_->bodies(), moved_m);
  if (scene_->leds_watched()) publish_leds();
  publish_sound();
  for (const auto& medium : media_) medium->exchange(*scene_, end);
  fold_digest();
  if (attendant_) attendant_->after_tick();
}

void Simulation::run_until(Clicks at) {
  while (now() < at) step();
}

/// Minds see only the frozen scene, so they may run side by side; each worker has a fixed share of the
/// robots.
void Simulation::run_minds(Clicks end) {
  const auto run = [&](std::size_t first, std::size_t last) {
    for (std::size_t r = first; r < last; ++r) {
      minds_[r]->run_until(*scene_, end);
      angles_[r] = minds_[r]->wheel_course(end).at(end);
      wheels_[r].mind_hash = minds_[r]->state_hash();
      if (minds_[r]->has_sound_news()) sound_news_.store(true, std::memory_order_relaxed);
    }
  };
  if (!workers_) return run(0, minds_.size());
  const std::size_t shares = static_cast<std::size_t>(workers_->size());
  workers_->run(
      [&](std::size_t share) { run(minds_.size() * share / shares, minds_.size() * (share + 1) / shares); });
}

/// Only once a camera watches: most worlds have none.
void Simulation::publish_leds() {
  leds_.resize(minds_.size());
  for (std::size_t r = 0; r < minds_.size(); ++r) leds_[r] = minds_[r]->report().leds;
  scene_->publish_leds(leds_);
}

/// Wheel angles become ways of the rims over the floor, noise and slip included.
void Simulation::turn_wheels(Clicks end) {
  const std::int64_t noise_index = end / from_seconds(kWheelNoisePeriodS);
  for (std::size_t r = 0; r < minds_.size(); ++r) {
    Wheels& w = wheels_[r];
    const WheelAngles now = angles_[r];
    double left = (now.left_rad - w.last.left_rad) * w.left_radius_m;
    double right = (now.right_rad - w.last.right_rad) * w.right_radius_m;
    if (w.noise > 0) {
      if (noise_index != w.noise_index) {
        const auto counter = static_cast<std::uint64_t>(noise_index);
        const auto draw = [&](std::uint32_t stream) {
          const RandomKey key{w.seed, 0, stream};
          // a wheel never turns against its motor
          return w.gaussian ? std::max(0.0, 1 + w.noise * random_gaussian(key, counter))
                            : 1 + w.noise * random_signed(key, counter);
        };
        w.noise_index = noise_index;
        w.left_factor = draw(kStreamWheelLeft);
        w.right_factor = draw(kStreamWheelRight);
      }
      left *= w.left_factor;
      right *= w.right_factor;
    }
    travel_[r] = {left * w.grip, right * w.grip};
    w.last = now;
  }
}

/// What loudspeakers began or ended in this tick is heard from now on; nothing to do in a silent world.
void Simulation::publish_sound() {
  if (sound_news_.exchange(false, std::memory_order_relaxed)) {
    for (std::size_t r = 0; r < minds_.size(); ++r)
      if (minds_[r]->has_sound_news()) minds_[r]->publish_sound(*sound_, static_cast<int>(r), scene_->now());
  }
  if (sound_->has_voices()) sound_->advance(*scene_);
}

void Simulation::fold_digest() {
  const std::vector<BodyState>& bodies = motion_->bodies();
  std::uint64_t h = digest_;
  for (std::size_t r = 0; r < minds_.size(); ++r) {
    const BodyState& b = bodies[r];
    const Vec2 place{b.pose.x_m, b.pose.y_m};
    distance_m_[r] += length(place - last_place_[r]);
    last_place_[r] = place;
    h = fold(fold(fold(h, b.pose.x_m), b.pose.y_m), b.pose.heading_rad);
    h = fold(fold(fold(h, angles_[r].left_rad), angles_[r].right_rad), wheels_[r].mind_hash);
  }
  for (std::size_t i = minds_.size(); i < bodies.size(); ++i) {
    const BodyState& b = bodies[i];
    h = fold(fold(fold(fold(h, b.pose.x_m), b.pose.y_m), b.pose.heading_rad), b.z_m);
  }
  digest_ = h;
}

void Simulation::move(int body, const Pose2& pose, double z_m) {
  motion_->move(body, pose, z_m);
  if (body < robots()) last_place_[static_cast<std::size_t>(body)] = {pose.x_m, pose.y_m};
  scene_->relocate(body, motion_->bodies()[static_cast<std::size_t>(body)]);
}

void Simulation::set_velocity(int body, Vec2 velocity_m_s, double spin_rad_s, double climb_m_s) {
  motion_->set_velocity(body, velocity_m_s, spin_rad_s, climb_m_s);
  scene_->set_state(body, motion_->bodies()[static_cast<std::size_t>(body)]);
}

void Simulation::set_colour(const Candidate& what, const Colour& colour) {
  scene_->set_colour(what, colour);
  note_intervention(static_cast<std::uint64_t>(what.index) * 2 + what.moving);
  digest_ = fold(fold(fold(digest_, colour.r), colour.g), colour.b);
}

void Simulation::set_lamp(int lamp, bool on, double intensity_w_m2, Vec3 position_m) {
  scene_->set_lamp(lamp, on, intensity_w_m2, position_m);
  note_intervention(static_cast<std::uint64_t>(lamp) * 2 + on);
  digest_ = fold(fold(digest_, intensity_w_m2), position_m.x);
  digest_ = fold(fold(digest_, position_m.y), position_m.z);
}

void Simulation::set_proximity_noise(int robot, double scale) {
  scene_->set_proximity_noise(robot, scale);
  optics_ = make_optics(scene_->world());
  scene_->attach_optics(optics_);
  note_intervention(static_cast<std::uint64_t>(robot));
  digest_ = fold(digest_, scale);
}

void Simulation::set_wheel_noise(int robot, double half_width) {
  Wheels& w = wheels_[static_cast<std::size_t>(robot)];
  w.noise = half_width;
  w.noise_index = -1;
  note_intervention(static_cast<std::uint64_t>(robot));
  digest_ = fold(digest_, half_width);
}

}  // namespace sim
