// SPDX-License-Identifier: MIT
// The world as robots see it while they run: frozen at the last tick, with the poses of the last 40 ms behind
// it. In: legs of the bodies' ways, each when it begins. Out: poses at any instant, rays, surfaces, who is
// near whom. All const methods are safe from any thread while nobody publishes. Heights of falling bodies are
// those of the last tick.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "sim_core/base/clock.h"
#include "sim_core/geometry/neighbours.h"
#include "sim_core/physics/leg.h"
#include "sim_core/world/layout.h"
#include "sim_core/world/lit_leds.h"
#include "sim_core/world/world_desc.h"

namespace sim {

struct ProximityOptics;  // light/proximity.h: rays and tables of every sensor, resolved once
class SoundField;        // sound/sound_field.h: what sounds, and where

/// How far back poses are kept, s. [assumed: an ADC scan looks at most 40 ms back]
inline constexpr double kHistoryS = 0.040;

/// What a ray met.
struct SceneHit {
  double distance_m = 0;
  Vec3 point_m;
  Vec3 normal;  ///< unit, out of the surface
  Surface surface;
  int robot = -1;  ///< index when a robot was hit
  bool floor = false;
};

/// Look of a fixed solid or of a moving body.
inline const Surface& surface_of(const Layout& layout, const Candidate& c) {
  return (c.moving ? layout.moving_surface : layout.fixed_surface)[static_cast<std::size_t>(c.index)];
}

class Scene {
 public:
  /// The robots' LEDs as cameras see them.
  LitLeds leds;

  /// `reach_m[r]`: how far from its centre robot r's proximity rays can end.
  Scene(WorldDesc world, std::vector<double> reach_m);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  const WorldDesc& world() const { return world_; }
  const Layout& layout() const { return layout_; }
  int robots() const { return robots_; }
  /// Robots and movable objects; robots come first.
  int bodies() const { return static_cast<int>(heights_.size()); }

  /// Instant of the last tick.
  Clicks now() const { return now_; }
  Clicks tick_clicks() const { return tick_clicks_; }
  double tick_s() const { return tick_s_; }

  /// Grows with every tick and every relocation: what a cache must have been made with.
  std::uint64_t version() const { return version_; }

  /// State at the last tick.
  BodyState state(int body) const;
  /// Height of a body's origin, m.
  double z_m(int body) const { return heights_[static_cast<std::size_t>(body)].z_m; }
  /// Pose at an instant, on the leg that had begun then; before the oldest kept one where that began. The
  /// same whenever it is asked for, at that instant or later.
  Pose2 pose(int body, Clicks at) const;
  /// Pose on the way between two ticks, known once the later one has come; after the last tick its pose.
  Pose2 pose_on_way(int body, Clicks at) const;
  /// Same with the solid, ready for rays. Headings of round bodies are left out.
  Placed placed(int body, Clicks at) const;

  const Neighbours& neighbours() const { return *neighbours_; }

  /// First thing a ray of any length meets at an instant: solids and the floor. skip_robot -1: none.
  bool cast(const Ray& ray, double limit_m, int skip_robot, Clicks at, SceneHit* hit) const;

  /// Resolved optics of the robots' sensors; set once by whoever builds the simulation.
  const ProximityOptics* optics() const { return optics_.get(); }
  void attach_optics(std::shared_ptr<const ProximityOptics> optics) { optics_ = std::move(optics); }

  /// The air between sources of sound and ears; null: silence. Set once, as the optics; outlives the scene.
  const SoundField* sound() const { return sound_; }
  void attach_sound(const SoundField* sound) { sound_ = sound; }

  /// The last tick is now that one.
  void advance_to(Clicks tick);
  /// A body begins a leg at the last tick, at that height and climbing so fast.
  void begin_leg(int body, const Leg& leg, double z_m, double climb_m_s);
  /// Gathers lists of neighbours anew; bodies are, and were in the poses kept, no faster than that.
  void regather(double pace_m_s);

  // Changes by hand, between ticks only; Simulation's methods of these names book them.
  /// A body was put somewhere else: its history is forgotten.
  void relocate(int body, const Leg& leg, double z_m);
  /// Where and how fast bodies are stays; where they were, and what LEDs showed, is forgotten.
  void forget_history();
  /// Everything but the robots is as `world` says. `before`: for each body the one it was, whose course it
  /// goes on with; -1: a new one. The optics must be made anew.
  void refurnish(const WorldDesc& world, const std::vector<int>& before, std::vector<double> reach_m);
  /// Another colour; proximity sensors see its red part.
  void set_colour(const Candidate& what, const Colour& colour);
  void set_lamp(int lamp, bool on, double intensity_w_m2, Vec3 position_m);
  /// Factor on the noise of a robot's proximity sensors, whatever single sensors said. The
  /// optics must be made anew.
  void set_proximity_noise(int robot, double scale);
  /// Half width of the factor on a robot's wheel travel.
  void set_wheel_noise(int robot, double half_width) {
    world_.robots[static_cast<std::size_t>(robot)].wheels.noise = half_width;
  }

 private:
  /// Newest leg of a body that had begun at an instant, or its oldest kept one; `next`, if given, gets the
  /// one after it, or null.
  const Leg& leg_at(int body, Clicks at, const Leg** next = nullptr) const;
  __attribute__((noinline)) const Leg& older_leg(int body, Clicks at, const Leg** next) const;

  WorldDesc world_;
  Layout layout_;
  int robots_;
  Clicks tick_clicks_;
  double tick_s_;
  Clicks now_ = 0;
  std::uint64_t version_ = 1;
  int slots_;                // legs kept per body
  std::vector<Leg> legs_;    // [body * slots_ + n % slots_], n counting the body's legs
  std::vector<int> newest_;  // per body: its slot
  struct Height {
    double z_m = 0, climb_m_s = 0;
  };
  std::vector<Height> heights_;
  std::vector<Placed> moving_;
  std::optional<Neighbours> neighbours_;
  std::shared_ptr<const ProximityOptics> optics_;
  const SoundField* sound_ = nullptr;
};

}  // namespace sim
