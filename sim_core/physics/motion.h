// SPDX-License-Identifier: MIT
// Motion engines: how every robot's rims move in, a leg of every moving body's way out. Units: m, rad, s, kg,
// N. Bodies are numbered robots first, then loose objects.
// A robot whose wheels turn evenly, that grips and has room drives an arc, and nothing is worked out before
// something of that ends: its horizon. A robot near something, one that slips, and everything on slopes have
// a leg of one tick.
// On slopes bodies stand on the plane through the ground under them: gravity pulls them along it as far as
// grip allows (dynamic), way along it is shortened in plan, heights follow. Not modelled: tipping, wheels
// that leave the floor, suspension; a rolling ball's spin is there only as inertia.
#pragma once
#include <memory>
#include <vector>

#include "sim_core/geometry/ground.h"
#include "sim_core/geometry/neighbours.h"
#include "sim_core/geometry/solid.h"
#include "sim_core/physics/fixed_push.h"
#include "sim_core/physics/leg.h"
#include "sim_core/physics/physics_params.h"

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

/// What a robot has bumped into since the world began.
struct TouchReport {
  int collisions = 0;               ///< touches begun, whatever was touched
  double touch_s = 0;               ///< time in touch with anything, all together, s
  double wall_touch_s = 0;          ///< length of the touch of a fixed solid that lasts now, s
  double longest_wall_touch_s = 0;  ///< longest such touch so far, s
  double longest_touch_s = 0;       ///< longest touch of anything, s
};

/// Speed of each rim over the floor, m/s, forward positive.
struct RimSpeed {
  double left_m_s = 0;
  double right_m_s = 0;
  bool operator==(const RimSpeed& o) const { return left_m_s == o.left_m_s && right_m_s == o.right_m_s; }
};

/// How a robot's rims move: on average during the tick that ends, and evenly from its end on.
struct RimCourse {
  RimSpeed tick, next;
  bool is_news = false;  ///< the tick's speed is not what was told for it, or the next one is another
};

struct MotionDesc {
  Clicks tick = kClicksPerSecond / 512;
  double gravity_m_s2 = 9.81;
  const std::vector<Placed>* fixed = nullptr;  ///< must outlive the engine
  const Ground* ground = nullptr;              ///< must outlive the engine; null: level
  std::vector<FixedSurface> surfaces;          ///< one per fixed solid
  std::vector<double> ramp_restitution;        ///< one per ramp of the ground; missing ones 0
  std::vector<const Solid*> solids;            ///< one per moving body; must outlive the engine
  std::vector<RobotBody> robots;
  std::vector<LooseBody> loose;
  std::vector<BodyState> start;  ///< one per moving body
  Clicks begin = 0;              ///< when they stand there
};

class Motion {
 public:
  virtual ~Motion() = default;

  /// Moves on to the end of a tick; nothing was due between the last step and its beginning. `active`: the
  /// robots that have a horizon before `end` or news of their rims, in order; `rims`: one entry per robot.
  void step(Clicks end, const std::vector<int>& active, const RimCourse* rims, const Neighbours& neighbours);
  /// New lists of neighbours, as things stand at `at`; no body is faster than `pace_m_s` until the next ones.
  void look_around(const Neighbours& neighbours, double pace_m_s, Clicks at);

  /// Horizons: a robot's leg holds up to the first, and it meets nothing up to the second.
  const std::vector<Clicks>& leg_until() const { return leg_until_; }
  const std::vector<Clicks>& free_until() const { return free_until_; }
  /// True when loose objects must be looked at in every tick.
  bool is_loose_busy() const;

  const Leg& leg(int body) const { return legs_[static_cast<std::size_t>(body)]; }
  /// Height and climb as at the end of the last step; the rest as it was when the leg began.
  const BodyState& body(int body) const { return bodies_[static_cast<std::size_t>(body)]; }
  /// Bodies whose leg began, or whose height changed, with the last step.
  const std::vector<int>& changed() const { return changed_; }
  TouchReport touches(int robot) const;
  /// Way of a robot's centre over the floor since the world began, m. Moves by hand do not count.
  double distance_m(int robot) const;
  /// What the robots have done so far is carried on from another engine with the same robots.
  void carry_on(const Motion& before);
  /// Touches that last are over; they stay counted.
  void forget_touches();
  /// Puts a body somewhere else, at rest.
  virtual void move(int body, const Pose2& pose, double z_m);
  /// Gives a body another speed, m/s and rad/s; robots and objects on the floor keep it as long as grip
  /// allows. A loose object with an upward speed leaves what it stands on. Engines without forces
  /// ignore the plane part.
  virtual void set_velocity(int body, Vec2 velocity_m_s, double spin_rad_s, double climb_m_s);

 protected:
  /// has_heights: false where everything stands on a level floor and is endlessly high. loose_moves: whether
  /// loose objects move in the plane. follows_wheels: robots never slip.
  Motion(MotionDesc desc, bool has_heights, bool loose_moves, bool follows_wheels);

  /// Moves the robots of near_ and the loose objects; what they may meet stands where it
  /// is at the tick's end.
  virtual void step_plane(const Neighbours& neighbours) = 0;
  /// True when a loose object moves in the plane.
  virtual bool is_loose_moving() const { return false; }
  /// Called when a body's height range changed.
  virtual void heights_changed(int /*body*/) {}
  /// Called when a blow from below changed a loose object's velocity in the plane.
  virtual void velocity_changed(int /*body*/) {}
  /// True where bodies may stand on slopes.
  bool is_sloping() const { return sloping_; }
  /// What the ground under a robot does to it now; only when is_sloping().
  const SlopeEffect& slope_of(int robot) const { return slopes_[static_cast<std::size_t>(robot)]; }
  /// The same for a loose object, worked out anew.
  SlopeEffect loose_slope(int body) const;
  bool heights_meet(double z0_a, double z1_a, double z0_b, double z1_b) const;
  /// A body at its place, for rays and overlaps.
  Placed placed(int body) const;
  /// Books a tick's touch of a robot.
  void note_touch(int robot, bool wall);
  int robots() const { return static_cast<int>(desc_.robots.size()); }
  const LooseBody& loose(int body) const { return desc_.loose[static_cast<std::size_t>(body - robots())]; }

  /// What a robot's wheels ask for.
  struct Wanted {
    Vec2 velocity_m_s;  ///< world frame, at the middle of the tick's turn
    double spin_rad_s = 0;
    double speed_m_s = 0;  ///< forward
  };
  Wanted wanted(int robot, const RimSpeed& rims) const;
  /// What the wheels ask for in the tick that is being worked out.
  Wanted wanted(int robot) const { return wanted(robot, rims_[robot].tick); }
  /// Leg of a robot that meets nothing, from where it is: as near to what is wanted as grip allows. An arc
  /// once that is reached on a level floor; otherwise good for a tick.
  Leg free_leg(int robot, Clicks from, const Wanted& want) const;
  void drive_freely(int robot, const Wanted& want) { follow(robot, free_leg(robot, begin_, want)); }
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
  /// The tick of a robot that may meet fixed solids, and nothing else, on a level floor (fixed_contacts.cpp).
  void meet_fixed(int robot, const Neighbours& neighbours);
  /// Moves a robot out of whatever it is inside of: all the way out of fixed solids, half
  /// the way out of robots.
  void push_out(int robot, const Neighbours& neighbours);
  /// What a robot may meet in the tick.
  enum class Near : char { Nothing, Fixed, Bodies, Meets };  // Meets: touches one that moves
  Near near(int robot) const { return nearness_[static_cast<std::size_t>(robot)]; }

  MotionDesc desc_;
  double tick_s_;
  Clicks touch_gap_;  // a touch that ends and begins again sooner is one touch
  /// As at the tick's beginning, then at its end; velocities are those of the middle of the tick before. Of a
  /// robot that is not active: some time on its leg.
  std::vector<BodyState> bodies_;
  std::vector<Vec2> before_;  // places at the beginning of the tick
  std::vector<int> near_;     // active robots that may meet something, in order
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
  void follow_bends(const std::vector<int>& active, bool loose_too);
  void follow_bend(int body, double half_length_m, double half_width_m);
  double floor_m(int body) const;
  Vec2 slope_under(int body) const;
  bool blocked_at(int body, double z_m, Below& by) const;

  /// What grip allows in one tick, worked out once.
  struct Limits {
    double speed_m_s = 0;   // change of speed
    double spin_rad_s = 0;  // change of spin
  };
  std::vector<FixedPush> fixed_pushes_;  // per robot
  struct Drive {
    double spin_per_m_s = 0;  // spin for a difference of the rims' speeds
    Limits driving, standing;
  };
  void feel_ground();
  void bring(int body, Clicks at);
  void follow(int robot, const Leg& leg);
  void look_around(int robot, const Neighbours& neighbours);
  void begin_leg(int body, const Leg& leg);
  void begin_loose_legs();

  std::vector<Leg> legs_;
  std::vector<Clicks> at_;                      // of which instant an entry of bodies_ is
  std::vector<Clicks> leg_until_, free_until_;  // per robot
  std::vector<char> guessed_;  // the leg only carries on what was: the tick is worked out at its end
  std::vector<Near> nearness_;
  std::vector<int> changed_;
  std::vector<double> way_m_;  // before the leg that lasts
  const RimCourse* rims_ = nullptr;
  Clicks begin_ = 0, end_ = 0;  // of the last tick
  double pace_m_s_ = 0;
  std::vector<Drive> drives_;
  double fall_m_s2_ = 0;  // gravity across the floor
  bool has_heights_;
  bool loose_moves_;
  bool follows_wheels_;
  bool sloping_ = false;
  std::vector<SlopeEffect> slopes_;  // per robot
  std::vector<double> told_z_m_;     // per robot: height of the last heights_changed()

  /// Touches of a kind that follow one another closely are one.
  struct Touch {
    Clicks first = 0, last = -kEver;
    double lasts_s() const { return to_seconds(last - first); }
  };
  bool lasts(const Touch& touch) const { return end_ - touch.last < touch_gap_; }
  struct Touching {
    TouchReport report;
    Touch wall, any;
  };
  std::vector<Touching> touches_;
};

/// Box2D underneath: limited traction, slip, pushing.
std::unique_ptr<Motion> make_dynamic_motion(MotionDesc desc);
/// No forces: exact arcs; a robot stops where it would enter something, and pushes nothing. Loose objects
/// fall and bounce straight up and down.
std::unique_ptr<Motion> make_kinematic_motion(MotionDesc desc);
/// Two dimensions: wheels are followed exactly, nothing overlaps, loose objects are pushed;
/// no heights, no slip.
std::unique_ptr<Motion> make_planar_motion(MotionDesc desc);

}  // namespace sim
