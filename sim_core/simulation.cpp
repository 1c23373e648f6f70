// SPDX-License-Identifier: MIT
// One tick, in order: minds run against the frozen scene, wheels turn into ways of the rims, bodies move,
// what began is published and hashed, messages pass. Ticks in which nothing is due are passed over.
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
std::unique_ptr<Motion> make_motion(const WorldDesc& world, const Layout& layout,
                                    const std::vector<BodyState>& start, Clicks begin) {
  MotionDesc desc;
  desc.tick = kClicksPerSecond / world.physics_hz;
  desc.gravity_m_s2 = world.gravity_m_s2;
  desc.fixed = &layout.fixed;
  desc.ground = &layout.ground;
  for (const Surface& s : layout.fixed_surface) desc.surfaces.push_back({s.friction, s.restitution});
  for (const Placed& body : layout.moving) desc.solids.push_back(body.solid);
  desc.start = start;
  desc.begin = begin;
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

std::vector<BodyState> states_of(const Scene& scene) {
  std::vector<BodyState> states;
  for (int i = 0; i < scene.bodies(); ++i) states.push_back(scene.state(i));
  return states;
}

}  // namespace

Simulation::Simulation(WorldDesc world, Minds minds, int threads)
    : optics_(make_optics(world)),
      scene_(std::make_unique<Scene>(std::move(world), optics_reach_m(*optics_))),
      sound_(std::make_unique<SoundField>(scene_->world(), scene_->tick_clicks())),
      motion_(make_motion(scene_->world(), scene_->layout(), states_of(*scene_), 0)),
      minds_(std::move(minds)) {
  CHECK(minds_.size() == scene_->world().robots.size(), "one mind per robot");
  scene_->attach_optics(optics_);
  scene_->attach_sound(sound_.get());
  const std::size_t n = minds_.size();
  idle_until_.resize(n);
  for (std::size_t r = 0; r < n; ++r) minds_[r]->keep_idle_in(&idle_until_[r]);
  courses_.resize(n);
  rims_.resize(n);
  rims_until_.resize(n);
  horizons_.resize(n);
  mind_hash_.resize(n);
  told_.resize(n);
  read_wheels();
  digest_ = mix64(scene_->world().seed);
  if (threads > 1 && n > 1) workers_ = std::make_unique<WorkerPool>(std::min(threads, static_cast<int>(n)));
}

Simulation::~Simulation() = default;

/// What the world says about every robot's wheels.
void Simulation::read_wheels() {
  wheels_.resize(minds_.size());  // when their noise began stays
  for (std::size_t r = 0; r < minds_.size(); ++r) {
    const RobotDesc& robot = scene_->world().robots[r];
    Wheels& w = wheels_[r];
    // a wheel's own size is the board's business: it tells angles of nominal wheels
    w.left_radius_m = w.right_radius_m = scene_->world().model_of(robot)->wheel_radius_m;
    const WheelSettings &own = robot.wheels, &common = scene_->world().wheels;
    w.noise = own.noise.value_or(common.noise.value_or(0));
    w.grip = 1 - own.slip.value_or(common.slip.value_or(0));
    w.gaussian = own.noise_law.value_or(common.noise_law.value_or(NoiseLaw::Uniform)) == NoiseLaw::Gaussian;
    w.seed = robot_seed(scene_->world(), static_cast<int>(r));
  }
}

void Simulation::advance(Clicks at) {
  if (attendant_ && !attended_) {
    attended_ = true;
    attendant_->before_first_tick();
  }
  if (begins_) begin_world();
  const Clicks tick = scene_->tick_clicks(), end = next_tick(at);
  if (end - tick > now()) scene_->advance_to(end - tick);
  due_.clear();
  gather_due(end);
  run_minds(end);
  if (fastest_rim_m_s() > pace_m_s_) {
    gather_neighbours(fastest_rim_m_s());
    find_horizons();
    gather_due(end);
  }
  motion_->step(end, due_, rims_.data(), scene_->neighbours());
  scene_->advance_to(end);
  publish_motion();
  if (scene_->leds.is_watched()) publish_leds();
  publish_sound();
  for (const auto& medium : media_) medium->exchange(*scene_, end);
  if (attendant_) attendant_->after_tick();
}

void Simulation::run_until(Clicks at) {
  while (now() < at) advance(at);
}

/// Works out up to when nothing is due for each robot; returns the first of these instants.
Clicks Simulation::find_horizons() {
  const Clicks* const leg_until = motion_->leg_until().data();
  const Clicks* const free_until = motion_->free_until().data();
  Clicks first = kEver;
  for (std::size_t r = 0; r < horizons_.size(); ++r) {
    const Clicks of_mind = std::min(idle_until_[r] - 1, rims_until_[r]);
    horizons_[r] = std::min(of_mind, std::min(leg_until[r], free_until[r]));
    first = std::min(first, horizons_[r]);
  }
  return first;
}

/// End of the first tick in which something is due, or that of `at`; nobody who sees every tick misses one.
Clicks Simulation::next_tick(Clicks at) {
  const Clicks tick = scene_->tick_clicks();
  const bool busy = attendant_ || motion_->is_loose_busy() || sound_->has_voices() ||
                    std::any_of(media_.begin(), media_.end(), [](const auto& m) { return m->is_busy(); });
  const Clicks horizon = std::min({at - 1, lists_until_ - tick, find_horizons()});
  return busy || horizon <= now() ? now() + tick : (horizon / tick + 1) * tick;
}

/// Adds to the list of a tick, which is in order, who is due; of their rims nothing new is known yet.
void Simulation::gather_due(Clicks end) {
  const auto known = static_cast<std::ptrdiff_t>(due_.size());
  for (int r = 0; r < robots(); ++r) {
    if (horizons_[static_cast<std::size_t>(r)] >= end ||
        std::binary_search(due_.begin(), due_.begin() + known, r))
      continue;
    due_.push_back(r);
    RimCourse& rims = rims_[static_cast<std::size_t>(r)];
    rims.tick = rims.next;
    rims.is_news = false;
  }
  std::inplace_merge(due_.begin(), due_.begin() + known, due_.end());
}

/// Minds see only the frozen scene, so they may run side by side; each worker has a fixed
/// share of the robots.
void Simulation::run_minds(Clicks end) {
  // The next one's memory is on its way while this one runs, and what names that memory a turn before.
  const auto look_ahead = [this](auto at) {
    if (due_.end() - at > 1) minds_[static_cast<std::size_t>(at[1])]->hot_memory().fetch();
    if (due_.end() - at > 2) minds_[static_cast<std::size_t>(at[2])]->hot_memory().fetch_names();
  };
  const auto run = [&](std::size_t first, std::size_t last) {
    const auto begin = std::lower_bound(due_.begin(), due_.end(), static_cast<int>(first));
    for (auto at = begin; at != due_.end() && *at < static_cast<int>(last); ++at) {
      const std::size_t r = static_cast<std::size_t>(*at);
      const bool runs = idle_until_[static_cast<std::size_t>(*at)] <= end;
      if (!runs && rims_until_[static_cast<std::size_t>(*at)] >= end) continue;
      look_ahead(at);
      if (runs) {
        minds_[r]->run_until(*scene_, end);
        mind_hash_[r] = minds_[r]->state_hash();
        if (minds_[r]->has_sound_news()) sound_news_.store(true, std::memory_order_relaxed);
      }
      turn_wheels(*at, end);
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
  scene_->leds.publish(leds_);
}

/// Speed of the rims over the floor in a tick, noise and slip included.
RimSpeed Simulation::rim_speed(const Wheels& w, double left_rad_s, double right_rad_s,
                               Clicks tick_end) const {
  RimSpeed rims{left_rad_s * w.left_radius_m * w.grip * w.left_hold,
                right_rad_s * w.right_radius_m * w.grip * w.right_hold};
  if (w.noise == 0) return rims;
  const auto counter =
      static_cast<std::uint64_t>((tick_end - w.noise_from) / from_seconds(kWheelNoisePeriodS));
  const auto draw = [&](std::uint32_t stream) {
    const RandomKey key{w.seed, 0, stream};
    // a wheel never turns against its motor
    return w.gaussian ? std::max(0.0, 1 + w.noise * random_gaussian(key, counter))
                      : 1 + w.noise * random_signed(key, counter);
  };
  return {rims.left_m_s * draw(kStreamWheelLeft), rims.right_m_s * draw(kStreamWheelRight)};
}

/// What the rims of a robot did in the tick and do next; its mind ran, or its course or noise ends.
void Simulation::turn_wheels(int robot, Clicks end) {
  const std::size_t r = static_cast<std::size_t>(robot);
  Wheels& w = wheels_[r];
  WheelCourse& course = courses_[r];
  RimCourse& rims = rims_[r];
  const Clicks tick = scene_->tick_clicks();
  // The course so far, and the one that the robot says it takes from here.
  const WheelCourse last = course;
  course = minds_[r]->wheel_course(end);
  const WheelAngles before = last.at(end - tick), foreseen = last.at(end), after = course.at(end);
  const auto same = [](double a, double b) { return std::fabs(a - b) < kSameAngleRad; };
  // angles of a course that goes on would bring nothing but rounding
  const bool goes_on = last.until >= end && same(after.left_rad, foreseen.left_rad) &&
                       same(after.right_rad, foreseen.right_rad);
  // How fast the wheels turned in this tick.
  const double per_s = static_cast<double>(kClicksPerSecond);
  const double left_rad_s =
      goes_on ? last.left_rate * per_s : (after.left_rad - before.left_rad) / scene_->tick_s();
  const double right_rad_s =
      goes_on ? last.right_rate * per_s : (after.right_rad - before.right_rad) / scene_->tick_s();
  if (w.slipped_at == kEver &&
      ((w.left_hold != 1 && left_rad_s != 0) || (w.right_hold != 1 && right_rad_s != 0)))
    w.slipped_at = end;
  // What the rims did, and what they will do next if the course holds. It is news when it is
  // other than expected.
  const bool is_known = course.until > end;
  const RimSpeed expected = rims.next;
  rims.tick = rim_speed(w, left_rad_s, right_rad_s, end);
  rims.next = rim_speed(w, is_known ? course.left_rate * per_s : left_rad_s,
                        is_known ? course.right_rate * per_s : right_rad_s, end + tick);
  rims.is_news = !(rims.tick == expected) || !(rims.next == expected);
  rims_until_[static_cast<std::size_t>(robot)] = course.until;
  if (w.noise > 0) {  // the next tick's is the last with its noise
    const Clicks period = from_seconds(kWheelNoisePeriodS);
    const Clicks next_draw = ((end + tick - w.noise_from) / period + 1) * period + w.noise_from;
    rims_until_[static_cast<std::size_t>(robot)] = std::min(course.until, (next_draw - 1) / tick * tick - 1);
  }
}

/// The fastest rim of the robots that are due: nobody drives faster.
double Simulation::fastest_rim_m_s() const {
  double most = 0;
  for (int r : due_) {
    const RimCourse& rims = rims_[static_cast<std::size_t>(r)];
    most = std::max({most, std::fabs(rims.tick.left_m_s), std::fabs(rims.tick.right_m_s),
                     std::fabs(rims.next.left_m_s), std::fabs(rims.next.right_m_s)});
  }
  return most;
}

/// New lists of neighbours, of the scene's last tick. They count on a pace that hardly anybody exceeds soon.
void Simulation::gather_neighbours(double fastest_m_s) {
  const Clicks now = scene_->now();
  double fastest2 = fastest_m_s * fastest_m_s;
  for (int i = 0; i < scene_->bodies(); ++i) {
    const Vec2 v = motion_->leg(i).velocity_m_s;
    fastest2 = std::max(fastest2, dot(v, v));
  }
  fastest_m_s = std::sqrt(fastest2);
  const double wanted = std::max(kLeastPaceMS, kPaceReserve * fastest_m_s), old = pace_m_s_;
  if (wanted > 0.5 * old) quick_at_ = now;
  // a lower pace only when the poses kept are of slow times too
  if (wanted > old || now - quick_at_ > from_seconds(kHistoryS)) pace_m_s_ = wanted;
  scene_->regather(std::max(old, pace_m_s_));
  lists_until_ = now + from_seconds(0.5 * kSkinM / pace_m_s_);
  motion_->look_around(scene_->neighbours(), pace_m_s_, now);
}

/// Legs that began become poses and part of the digest.
void Simulation::publish_motion() {
  double fastest2 = 0;
  for (int i : motion_->changed()) {
    const Leg& leg = motion_->leg(i);
    const BodyState& b = motion_->body(i);
    scene_->begin_leg(i, leg, b.z_m, b.climb_m_s);
    fastest2 = std::max(fastest2, dot(leg.velocity_m_s, leg.velocity_m_s));
    digest_ = fold(fold(fold(fold(digest_, leg.pose.x_m), leg.pose.y_m), leg.pose.heading_rad), b.z_m);
  }
  for (int r : due_) {
    const WheelAngles& angle = courses_[static_cast<std::size_t>(r)].angle;
    std::uint64_t& told = told_[static_cast<std::size_t>(r)];
    const std::uint64_t now_told =
        fold(fold(mind_hash_[static_cast<std::size_t>(r)], angle.left_rad), angle.right_rad);
    if (now_told == told) continue;  // it was due because somebody looked at it
    told = now_told;
    digest_ = fold(digest_, told);
  }
  if (fastest2 > pace_m_s_ * pace_m_s_ || lists_until_ - scene_->tick_clicks() < now()) gather_neighbours(0);
}

/// What loudspeakers began or ended in this tick is heard from now on; nothing to do in a silent world.
void Simulation::publish_sound() {
  if (sound_news_.exchange(false, std::memory_order_relaxed)) {
    for (std::size_t r = 0; r < minds_.size(); ++r)
      if (minds_[r]->has_sound_news()) minds_[r]->publish_sound(*sound_, static_cast<int>(r), scene_->now());
  }
  if (sound_->has_voices()) sound_->advance(*scene_);
}

void Simulation::refurnish(const WorldDesc& world, const std::vector<int>& before) {
  const std::size_t n = minds_.size();
  CHECK(world.robots.size() == n && world.physics_hz == scene_->world().physics_hz,
        "the same robots and tick");
  std::vector<int> bodies;
  for (std::size_t r = 0; r < n; ++r) bodies.push_back(static_cast<int>(r));
  bodies.insert(bodies.end(), before.begin(), before.end());
  const auto old_optics = optics_;  // until nobody can look through it any more
  optics_ = make_optics(world);
  scene_->refurnish(world, bodies, optics_reach_m(*optics_));
  scene_->attach_optics(optics_);
  auto motion = make_motion(scene_->world(), scene_->layout(), states_of(*scene_), now());
  motion->carry_on(*motion_);
  motion_ = std::move(motion);
  sound_->refurnish(world);
  read_wheels();
  std::fill(rims_until_.begin(), rims_until_.end(), now());
  gather_neighbours(0);
  note_intervention(static_cast<std::uint64_t>(scene_->bodies()));
  for (const SoundDesc& s : world.sounds) digest_ = fold(fold(digest_, s.position_m.x), s.position_m.y);
  for (const Placed& p : scene_->layout().fixed)
    digest_ = fold(fold(fold(fold(digest_, p.frame.at.x), p.frame.at.y), p.frame.s), p.solid->bound_m);
}

void Simulation::move(int body, const Pose2& pose, double z_m) {
  motion_->move(body, pose, z_m);
  scene_->relocate(body, motion_->leg(body), motion_->body(body).z_m);
  gather_neighbours(0);
}

void Simulation::set_velocity(int body, Vec2 velocity_m_s, double spin_rad_s, double climb_m_s) {
  motion_->set_velocity(body, velocity_m_s, spin_rad_s, climb_m_s);
  const BodyState& b = motion_->body(body);
  scene_->begin_leg(body, motion_->leg(body), b.z_m, b.climb_m_s);
  gather_neighbours(0);
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

void Simulation::set_wheel_grip(int robot, double left, double right) {
  Wheels& w = wheels_[static_cast<std::size_t>(robot)];
  w.left_hold = left;
  w.right_hold = right;
  w.slipped_at = kEver;
  rims_until_[static_cast<std::size_t>(robot)] = now();
  note_intervention(static_cast<std::uint64_t>(robot));
  digest_ = fold(fold(digest_, left), right);
}

void Simulation::begin_again(int robot) {
  const std::size_t r = static_cast<std::size_t>(robot);
  wheels_[r].noise_from = now();
  courses_[r] = WheelCourse{};
  courses_[r].angle = minds_[r]->wheel_course(now()).angle;
  rims_[r] = {};
  rims_until_[r] = now();
  note_intervention(r);
}

void Simulation::begin_world() {
  begins_ = false;
  begun_ = now();
  digest_ = mix64(scene_->world().seed);
  std::fill(told_.begin(), told_.end(), 0);
  scene_->forget_history();
  std::vector<BodyState> start = states_of(*scene_);
  const auto same_place = [](const Pose2& a, const Pose2& b) {
    return a.x_m == b.x_m && a.y_m == b.y_m && a.heading_rad == b.heading_rad;
  };
  // on slopes an engine knows better how high a robot stands than where it was told to begin
  for (std::size_t r = 0; r < minds_.size(); ++r)
    if (same_place(scene_->layout().moving_pose[r], start[r].pose))
      start[r].z_m = scene_->layout().moving[r].z_m;
  auto motion = make_motion(scene_->world(), scene_->layout(), start, now());
  motion->carry_on(*motion_);
  motion->forget_touches();
  motion_ = std::move(motion);
  // as in the constructor nothing is fast, and lists are made by whoever is first
  pace_m_s_ = 0;
  quick_at_ = lists_until_ = now();
  scene_->regather(0);
  const auto moves = [](const BodyState& b) {
    return b.velocity_m_s.x != 0 || b.velocity_m_s.y != 0 || b.spin_rad_s != 0;
  };
  if (std::any_of(start.begin(), start.end(), moves)) gather_neighbours(0);
  sound_->begin_again(now());
  for (const auto& medium : media_) medium->begin_again(now());
}

void Simulation::set_wheel_noise(int robot, double half_width) {
  Wheels& w = wheels_[static_cast<std::size_t>(robot)];
  w.noise = half_width;
  scene_->set_wheel_noise(robot, half_width);
  rims_until_[static_cast<std::size_t>(robot)] = now();
  note_intervention(static_cast<std::uint64_t>(robot));
  digest_ = fold(digest_, half_width);
}

}  // namespace sim
