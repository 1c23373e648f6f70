// SPDX-License-Identifier: MIT
// Motion engines: wheel travel of every robot in, poses of every moving body out, one tick at a time.
// Units: m, rad, s, kg, N. Bodies are numbered robots first, then loose objects.
// On slopes bodies stand on the plane through the ground under them: gravity pulls them along it as far as
// grip allows (dynamic), way along it is shortened in plan, heights follow. Not modelled: tipping, wheels
// that leave the floor, suspension; a rolling ball's spin is there only as inertia.
#pragma once
#include <memory>
#include <vector>

#include "sim_core/geometry/ground.h"
#include "sim_core/geometry/neighbours.h"
#include "sim_core/geometry/solid.h"

namespace sim {

/// What a robot is to the floor and to whatever it bumps into.
struct RobotBody {
  double mass_kg = 1;
  double inertia_kg_m2 = 1e-4;  ///< about the vertical axis
  double axle_m = 0.05;         ///< effective distance between the wheels
  double traction_n = 1;        ///< most the turning wheels together can push, N
  double hold_n = 1;            ///< most the standing wheels can hold against a push, N
  double side_friction = 0.3;   ///< Coulomb coefficient of the body's side
  double half_base_m = 0.03;    ///< it touches sloping ground this far before and behind its origin
};

/// What a loose object is.
struct LooseBody {
  double mass_kg = 0.1;
  double floor_friction =
      0.5;  ///< Coulomb coefficient against whatever it stands on; rolling: resistance/weight
  double side_friction = 0.3;
  double restitution = 0;  ///< 0 to 1
  bool rolls = false;      ///< a ball
};

/// Friction and bounce of a fixed solid.
struct FixedSurface {
  double friction = 0.3;
  double restitution = 0;
};

/// State of a moving body, at a tick.
struct BodyState {
  Pose2 pose;
  double z_m = 0;     ///< height of its origin (its underside) above the floor
  Vec2 velocity_m_s;  ///< world frame
  double spin_rad_s = 0;
  double climb_m_s = 0;  ///< vertical speed; negative while falling
};

/// What a robot has bumped into since the world began.
struct TouchReport {
  int collisions = 0;               ///< touches begun, whatever was touched
  double touch_s = 0;               ///< time in touch with anything, all together, s
  double wall_touch_s = 0;          ///< length of the touch of a fixed solid that lasts now, s
  double longest_wall_touch_s = 0;  ///< longest such touch so far, s
  double longest_touch_s = 0;       ///< longest touch of anything, s
};

/// Way of each rim over the floor during one tick, m, forward positive.
struct RimTravel {
  double left_m = 0;
  double right_m = 0;
};

struct MotionDesc {
  double tick_s = 1.0 / 512;
  double gravity_m_s2 = 9.81;
  const std::vector<Placed>* fixed = nullptr;  ///< must outlive the engine
  const Ground* ground = nullptr;              ///< must outlive the engine; null: level
  std::vector<FixedSurface> surfaces;          ///< one per fixed solid
  std::vector<double> ramp_restitution;        ///< one per ramp of the ground; missing ones 0
  std::vector<const Solid*> solids;            ///< one per moving body; must outlive the engine
  std::vector<RobotBody> robots;
  std::vector<LooseBody> loose;
  std::vector<BodyState> start;  ///< one per moving body
};

class Motion {
 public:
  virtual ~Motion() = default;

  /// Moves everything by one tick; `travel` holds one entry per robot. Returns the largest distance any body
  /// moved, m.
  double step(const RimTravel* travel, const Neighbours& neighbours);

  const std::vector<BodyState>& bodies() const { return bodies_; }
  const TouchReport& touches(int robot) const { return touches_[static_cast<std::size_t>(robot)]; }
  /// A body at its place, for rays and overlaps.
  Placed placed(int body) const;
  /// Puts a body somewhere else, at rest.
  virtual void move(int body, const Pose2& pose, double z_m);
  /// Gives a body another speed, m/s and rad/s; robots and objects on the floor keep it as long as grip
  /// allows. A loose object with an upward speed leaves what it stands on. Engines without forces ignore the
  /// plane part.
  virtual void set_velocity(int body, Vec2 velocity_m_s, double spin_rad_s, double climb_m_s);

 protected:
  /// has_heights: false where everything stands on a level floor and is endlessly high. loose_moves: whether
  /// loose objects move in the plane.
  Motion(MotionDesc desc, bool has_heights, bool loose_moves);

  virtual void step_plane(const RimTravel* travel, const Neighbours& neighbours) = 0;
  /// Called when a body's height range changed.
  virtual void heights_changed(int body) {}
  /// Called when a blow from below changed a loose object's velocity in the plane.
  virtual void velocity_changed(int body) {}
  /// True where bodies may stand on slopes.
  bool is_sloping() const { return sloping_; }
  /// What the ground under a robot does to it now; only when is_sloping().
  const SlopeEffect& slope_of(int robot) const { return slopes_[static_cast<std::size_t>(robot)]; }
  /// The same for a loose object, worked out anew.
  SlopeEffect loose_slope(int body) const;
  /// Looks at the ground under every robot; before a tick's plane motion, when is_sloping().
  void feel_ground();
  bool heights_meet(double z0_a, double z1_a, double z0_b, double z1_b) const;
  /// Books this tick's touches of a robot.
  void note_touch(int robot, bool wall, bool anything);
  int robots() const { return static_cast<int>(desc_.robots.size()); }
  const LooseBody& loose(int body) const { return desc_.loose[static_cast<std::size_t>(body - robots())]; }

  /// Traction-limited change of a robot's speeds towards what its wheels ask for; then the pose follows.
  struct Wanted {
    Vec2 velocity_m_s;  ///< world frame, at the middle of the tick's turn
    double spin_rad_s = 0;
  };
  Wanted wanted(int robot, const RimTravel& travel) const;
  void drive_freely(int robot, const Wanted& wanted);
  /// True when the wheels are told to stand, and hold rather than drive.
  static bool is_standing(const Wanted& want) {
    return want.velocity_m_s.x == 0 && want.velocity_m_s.y == 0 && want.spin_rad_s == 0;
  }
  /// Most force between wheels and floor now, N.
  double grip_n(int robot, const Wanted& want) const {
    const RobotBody& r = desc_.robots[static_cast<std::size_t>(robot)];
    const double level_n = is_standing(want) ? r.hold_n : r.traction_n;
    return sloping_ ? level_n * slope_of(robot).press : level_n;
  }
  /// Moves a robot out of whatever it is inside of: all the way out of fixed solids, half the way out of
  /// robots.
  void push_out(int robot, const Neighbours& neighbours);

  MotionDesc desc_;
  std::vector<BodyState> bodies_;
  std::vector<Vec2> before_;  // places at the beginning of the tick
  static constexpr int kOnFloor = -1, kInAir = -2, kOnFixed = -3;
  std::vector<int> support_;  // per body: one of these, otherwise the moving body it stands on

 private:
  /// What a body would be inside of.
  struct Below {
    int body = kOnFloor;  // as in support_
    double restitution = 0;
  };
  /// What a falling body may meet in this tick.
  struct Landing {
    int body = kOnFloor;
    double restitution = 0;  // of the pair
    double height_m = 0;     // under the body at the beginning of the tick
    double climb_m_s = 0;    // rise of what is under it as it flies on
    double end_m = 0;        // height at the end of the tick
    Vec2 slope;
  };
  void step_heights();
  void fly(int body);
  Landing landing_of(int body);
  void follow_ground();
  double floor_m(int body) const;
  Vec2 slope_under(int body) const;
  bool blocked_at(int body, double z_m, Below& by) const;

  /// What grip allows in one tick, worked out once.
  struct Limits {
    double speed_m_s = 0;   // change of speed
    double spin_rad_s = 0;  // change of spin
  };
  struct Drive {
    double spin_per_m = 0;  // spin for a difference of the rims' ways in a tick
    Limits driving, standing;
  };
  std::vector<Drive> drives_;
  double ticks_per_s_ = 0;
  double fall_m_s2_ = 0;  // gravity across the floor
  bool has_heights_;
  bool loose_moves_;
  bool sloping_ = false;
  std::vector<SlopeEffect> slopes_;  // per robot
  std::vector<double> told_z_m_;     // per robot: height of the last heights_changed()

  struct Touching {
    double wall_gap_s = 1;  // since the last touch
    double any_gap_s = 1;
    double any_s = 0;
  };
  std::vector<TouchReport> touches_;
  std::vector<Touching> touch_times_;
};

/// Box2D underneath: limited traction, slip, pushing.
std::unique_ptr<Motion> make_dynamic_motion(MotionDesc desc);
/// No forces: exact arcs; a robot stops where it would enter something, and pushes nothing. Loose objects
/// fall and bounce straight up and down.
std::unique_ptr<Motion> make_kinematic_motion(MotionDesc desc);
/// Two dimensions: wheels are followed exactly, nothing overlaps, loose objects are pushed; no heights, no
/// slip.
std::unique_ptr<Motion> make_planar_motion(MotionDesc desc);

}  // namespace sim
