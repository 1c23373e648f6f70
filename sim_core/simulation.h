// SPDX-License-Identifier: MIT
// The front door of sim_core: a world, one mind per robot, and time that moves one tick per step().
// In: a WorldDesc (already checked by load/, or built in C++). Out: poses, touches, distances, a digest of
// the whole state history that does not depend on the number of threads. Nothing throws once it is built.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim_core/base/clock.h"
#include "sim_core/base/hash.h"
#include "sim_core/physics/motion.h"
#include "sim_core/world/attendant.h"
#include "sim_core/world/medium.h"
#include "sim_core/world/robot_mind.h"
#include "sim_core/world/scene.h"
#include "sim_core/world/world_desc.h"

namespace sim {

class SoundField;
class WorkerPool;

class Simulation {
 public:
  /// One mind per robot of the world, in its order. threads: how many run the minds, 1 or more.
  Simulation(WorldDesc world, Minds minds, int threads = 1);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Something that carries messages between the robots from the next tick on; several work in this order.
  void add(std::unique_ptr<Medium> medium) { media_.push_back(std::move(medium)); }

  /// Advances by one tick.
  void step() { advance(now()); }
  /// Advances by one tick, and by all that follow in which nothing is due, but not further than to the first
  /// tick at or after `at`. Where it ends changes nothing in what happens.
  void advance(Clicks at);
  /// Advances until now() >= at.
  void run_until(Clicks at);

  Clicks now() const { return scene_->now(); }
  const Scene& scene() const { return *scene_; }
  const SoundField& sound() const { return *sound_; }
  int robots() const { return scene_->robots(); }
  const Minds& minds() const { return minds_; }

  /// Where a robot or a movable object is (robots come first).
  Pose2 pose(int body) const { return scene_->pose(body, now()); }
  BodyState state(int body) const { return scene_->state(body); }
  /// Way the robot's centre has travelled over the floor, m. Moves by hand do not count.
  double distance_m(int robot) const { return motion_->distance_m(robot); }
  /// Collisions and how long they lasted.
  TouchReport touches(int robot) const { return motion_->touches(robot); }

  /// Hash of every change of a way, a wheel's course and a mind since the world began, or began again, and of
  /// the time since then.
  std::uint64_t digest() const { return fold(digest_, static_cast<std::uint64_t>(now() - begun_)); }

  /// Who is called between ticks; null: nobody. Outlives the simulation or takes itself away.
  void attend(Attendant* attendant) { attendant_ = attendant; }

  // Changes by hand, between ticks only; each becomes part of the history that the digest sees.
  /// Everything but the robots becomes as `world` says, which has the same robots; their programs, places
  /// and speeds stay. `before`: for each movable object of it the body it was; -1: a new one. Not
  /// changed: tick, engine.
  void refurnish(const WorldDesc& world, const std::vector<int>& before);
  /// Puts a body somewhere else, at rest.
  void move(int body, const Pose2& pose, double z_m = 0);
  /// Gives a body another speed (physics/motion.h).
  void set_velocity(int body, Vec2 velocity_m_s, double spin_rad_s, double climb_m_s);
  /// Colour of a body or a fixed solid (world/layout.h); proximity sensors see its red part.
  void set_colour(const Candidate& what, const Colour& colour);
  void set_lamp(int lamp, bool on, double intensity_w_m2, Vec3 position_m);
  /// Factor on the noise of a robot's proximity sensors; 0 none.
  void set_proximity_noise(int robot, double scale);
  /// Half width of the factor on a robot's wheel travel; 0 none.
  void set_wheel_noise(int robot, double half_width);
  /// Shares of the ways of a robot's rims that its wheels hold on to, beside what the world says: 1 all of
  /// it, 0 they turn in the air or on ice.
  void set_wheel_grip(int robot, double left, double right);
  /// When a wheel first turned that did not hold on to all of it, since the last set_wheel_grip(); kEver: not
  /// yet. The end of that tick.
  Clicks slipped_at(int robot) const { return wheels_[static_cast<std::size_t>(robot)].slipped_at; }
  /// A robot that was put back stands as when the world began: its wheels at rest, their noise
  /// from its first draw on.
  void begin_again(int robot);
  /// All robots did: with the next tick the world begins again, from where bodies are then. Nothing
  /// is in the air, nobody remembers where bodies were or what they touched; the digest begins anew;
  /// time and counts go on.
  void begin_again() { begins_ = true; }
  /// When the world began, or began again, last; now() when it is about to.
  Clicks begun() const { return begins_ ? now() : begun_; }
  /// Anything else that somebody from outside changed, as a number that differs when the change does.
  void note_intervention(std::uint64_t what) { digest_ = fold(digest_, what); }

 private:
  void begin_world();
  void read_wheels();
  Clicks find_horizons();
  Clicks next_tick(Clicks at);
  void gather_due(Clicks end);
  void run_minds(Clicks end);
  void turn_wheels(int robot, Clicks end);
  double fastest_rim_m_s() const;
  void gather_neighbours(double fastest_m_s);
  void publish_leds();
  void publish_sound();
  void publish_motion();

  std::shared_ptr<const ProximityOptics> optics_;
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<SoundField> sound_;
  std::atomic<bool> sound_news_{false};
  std::unique_ptr<Motion> motion_;
  std::vector<Clicks> idle_until_;  // per robot; the minds write here
  Minds minds_;
  std::vector<std::unique_ptr<Medium>> media_;
  Attendant* attendant_ = nullptr;
  bool attended_ = false;  // the attendant has been told that the world begins
  bool begins_ = false;    // again, with the next tick
  Clicks begun_ = 0;       // when it last did
  std::unique_ptr<WorkerPool> workers_;

  struct Wheels {
    double left_radius_m = 0;
    double right_radius_m = 0;
    double noise = 0;                      // half width or standard deviation of the factor on the travel
    bool gaussian = false;                 // which of them
    double grip = 1;                       // 1 - slip
    double left_hold = 1, right_hold = 1;  // of that, by set_wheel_grip()
    Clicks slipped_at = kEver;
    std::uint64_t seed = 0;
    Clicks noise_from = 0;  // when its first draw was
  };
  RimSpeed rim_speed(const Wheels& wheels, double left_rad_s, double right_rad_s, Clicks tick_end) const;
  std::vector<Wheels> wheels_;
  std::vector<WheelCourse> courses_;
  std::vector<RimCourse> rims_;
  std::vector<Clicks> rims_until_;  // per robot: the last tick for which the rims' speeds hold
  std::vector<std::uint64_t> mind_hash_, told_;
  std::vector<Clicks> horizons_;
  std::vector<int> due_;  // robots of the tick, in order
  std::vector<std::uint32_t> leds_;
  double pace_m_s_ = 0;  // nothing moves faster until the lists of neighbours are gathered anew
  Clicks lists_until_ = 0, quick_at_ = 0;
  std::uint64_t digest_ = 0;
};

}  // namespace sim
