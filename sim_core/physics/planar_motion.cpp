// SPDX-License-Identifier: MIT
// The two-dimensional engine, without heights and without slip; our own code, no solver underneath.
// A tick: robots follow their wheels (half the turn, the way, half the turn), loose objects slide or roll on
// and are slowed by the floor; then overlaps are taken away and objects that met exchange momentum.
//   - Who gives way. Fixed solids never. Robots only as far as they themselves drove into something: wheels
//     do not slip, so nobody pushes a robot aside; two that drive at each other share the overlap as their
//     speeds. Loose objects give way to robots and, by their masses, to each other.
//   - What a robot cannot push. The pushes of the robots that drive against an object are added as vectors;
//     an object whose friction on the floor is more than the sum stands as if it were fixed.
//   - Momentum: frictionless blows along the normal with the larger restitution of the two, as impulses;
//     robots and fixed solids count as endlessly heavy.
// Not modelled: heights (everything stands on the floor, endlessly high), traction, friction of sides, the
// load of what stands behind a pushed object, pushes of more than one tick.
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim_core/physics/motion.h"
#include "sim_core/physics/physics_params.h"
#include "sim_core/physics/plan_contact.h"

namespace sim {
namespace {

class PlanarMotion final : public Motion {
 public:
  explicit PlanarMotion(MotionDesc desc) : Motion(std::move(desc), false, true, true) {
    const std::size_t n = bodies_.size();
    way_.resize(desc_.robots.size());
    pushed_.resize(n);
    held_.resize(n);
    rank_.assign(n, kIdle);
    for (std::size_t i = 0; i < n; ++i) gyration_m2_.push_back(desc_.solids[i]->gyration_m2());
  }

 protected:
  bool is_loose_moving() const override {
    return std::any_of(bodies_.begin() + robots(), bodies_.end(), [](const BodyState& b) {
      return b.spin_rad_s != 0 || b.velocity_m_s.x != 0 || b.velocity_m_s.y != 0;
    });
  }

  void step_plane(const Neighbours& neighbours) override {
    pairs_.clear();
    awake_.clear();
    slide();
    for (int robot : near_) drive(robot);
    for (int robot : near_) pair_robot(robot, neighbours);
    // the list grows as awake objects reach others
    for (std::size_t k = 0; k < awake_.size(); ++k) pair_loose(awake_[k], neighbours);
    find_pushes();
    // to and fro, so that neither end of a chain is favoured and walls come last
    for (int round = 0; round < kRounds; round += 2) {
      const bool last = round >= kRounds - kLastRounds;
      for (auto p = pairs_.begin(); p != pairs_.end(); ++p) separate(*p, last);
      for (auto p = pairs_.rbegin(); p != pairs_.rend(); ++p) separate(*p, last);
    }
    note_robots();
    strike();
    for (int object : awake_) {
      rank_[static_cast<std::size_t>(object)] = kIdle;
      held_[static_cast<std::size_t>(object)] = false;
    }
  }

 private:
  static constexpr int kIdle = -1;
  static constexpr char kUntouched = 0, kTouchesBody = 1, kTouchesWall = 2;
  static constexpr int kRounds = 10;     // of taking overlaps away
  static constexpr int kLastRounds = 4;  // of them: robots back out of what could not give way
  static constexpr int kBlows = 4;       // rounds of exchanging momentum

  /// Two bodies that may meet in this tick. The first moves; the second moves or is fixed.
  struct Pair {
    Pair(int first, int second, bool second_fixed) : a(first), b(second), fixed(second_fixed) {}
    int a, b;
    bool fixed;              // b counts fixed solids
    bool touched = false;    // they met in this tick
    PlanContact contact;     // when they last did
    double rebound_m_s = 0;  // wanted speed of parting
    double impulse = 0;      // N s so far
  };

  bool is_robot(int body) const { return body < robots(); }
  Placed second(const Pair& p) const {
    return p.fixed ? (*desc_.fixed)[static_cast<std::size_t>(p.b)] : placed(p.b);
  }
  double weight_n(int object) const { return loose(object).mass_kg * desc_.gravity_m_s2; }

  /// Loose objects on their own: what is in motion slides on, slowed evenly.
  void slide() {
    const double tick_s = tick_s_;
    for (int i = robots(); i < static_cast<int>(bodies_.size()); ++i) {
      BodyState& b = bodies_[static_cast<std::size_t>(i)];
      const double speed = length(b.velocity_m_s);
      if (speed == 0 && b.spin_rad_s == 0) continue;
      wake(i);
      const double brake = loose(i).floor_friction * desc_.gravity_m_s2;
      const auto slowed = [&](double value, double brake_s) {
        const double end = std::max(0.0, value - brake_s * tick_s);
        const double way = end > 0 ? 0.5 * (value + end) * tick_s : 0.5 * value * value / brake_s;
        return std::pair<double, double>{end, way};
      };
      if (speed > 0) {
        const auto [end, way] = slowed(speed, brake);
        const Vec2 dir = (1 / speed) * b.velocity_m_s;
        b.pose.x_m += way * dir.x;
        b.pose.y_m += way * dir.y;
        b.velocity_m_s = end * dir;
      }
      if (b.spin_rad_s != 0) {
        const auto [end, turn] =
            slowed(std::fabs(b.spin_rad_s), brake / std::sqrt(gyration_m2_[static_cast<std::size_t>(i)]));
        b.pose.heading_rad += std::copysign(turn, b.spin_rad_s);
        b.spin_rad_s = std::copysign(end, b.spin_rad_s);
      }
    }
  }

  /// A robot along its wheels' way, wherever that leads.
  void drive(int robot) {
    drive_freely(robot, wanted(robot));
    const std::size_t i = static_cast<std::size_t>(robot);
    way_[i] = {bodies_[i].pose.x_m - before_[i].x, bodies_[i].pose.y_m - before_[i].y};
  }

  void wake(int object) {
    int& rank = rank_[static_cast<std::size_t>(object)];
    if (rank != kIdle) return;
    rank = static_cast<int>(awake_.size());
    awake_.push_back(object);
  }

  void pair_robot(int robot, const Neighbours& neighbours) {
    const Placed me = placed(robot);
    for (const Candidate* c = neighbours.begin(robot); c != neighbours.end(robot); ++c) {
      if (c->moving && c->index < robot) continue;  // robots: each pair once
      const Placed other = c->moving ? placed(c->index) : (*desc_.fixed)[static_cast<std::size_t>(c->index)];
      if (plan_distance_m(me.frame.at, other) - me.solid->bound_m > kSolverMarginM) continue;
      if (c->moving && !is_robot(c->index)) wake(c->index);
      pairs_.emplace_back(robot, c->index, !c->moving);
    }
  }

  void pair_loose(int object, const Neighbours& neighbours) {
    const Placed me = placed(object);
    around_.clear();
    // bodies are binned where they were gathered: allow for what they moved since
    neighbours.gather(me.frame.at, me.solid->bound_m + kSkinM, around_);
    for (const Candidate& c : around_) {
      if (c.moving) {
        if (is_robot(c.index)) continue;  // near robots have listed it
        const int rank = rank_[static_cast<std::size_t>(c.index)];
        if (rank != kIdle && rank <= rank_[static_cast<std::size_t>(object)]) continue;  // each pair once
      }
      const Placed other = c.moving ? placed(c.index) : (*desc_.fixed)[static_cast<std::size_t>(c.index)];
      if (c.moving &&
          length(other.frame.at - me.frame.at) > me.solid->bound_m + other.solid->bound_m + kSolverMarginM) {
        continue;
      }
      if (plan_contact(me, other).depth_m < -kSolverMarginM) continue;
      if (c.moving) wake(c.index);
      pairs_.emplace_back(object, c.index, !c.moving);
    }
  }

  /// Adds up who pushes what, and marks what is pushed in vain.
  void find_pushes() {
    for (int object : awake_) pushed_[static_cast<std::size_t>(object)] = {};
    for (const Pair& p : pairs_) {
      if (!is_robot(p.a) || p.fixed || is_robot(p.b)) continue;
      const PlanContact c = plan_contact(placed(p.a), placed(p.b));
      if (c.depth_m < -kTouchM || dot(way_[static_cast<std::size_t>(p.a)], c.normal) >= 0) continue;
      Vec2& sum = pushed_[static_cast<std::size_t>(p.b)];
      sum = sum - desc_.robots[static_cast<std::size_t>(p.a)].traction_n * c.normal;
      held_[static_cast<std::size_t>(p.b)] = true;
    }
    for (int object : awake_) {
      if (!held_[static_cast<std::size_t>(object)]) continue;
      held_[static_cast<std::size_t>(object)] =
          length(pushed_[static_cast<std::size_t>(object)]) < loose(object).floor_friction * weight_n(object);
    }
  }

  /// How far a body yields per newton-second along the normal at a point.
  double yielding(int object, const PlanContact& c) const {
    const std::size_t i = static_cast<std::size_t>(object);
    const double arm = cross(c.point - Vec2{bodies_[i].pose.x_m, bodies_[i].pose.y_m}, c.normal);
    return (1 + arm * arm / gyration_m2_[i]) / loose(object).mass_kg;
  }

  void shift(int object, const PlanContact& c, double impulse) {
    BodyState& b = bodies_[static_cast<std::size_t>(object)];
    const double by = impulse / loose(object).mass_kg;
    const double arm = cross(c.point - Vec2{b.pose.x_m, b.pose.y_m}, c.normal);
    b.pose.x_m += by * c.normal.x;
    b.pose.y_m += by * c.normal.y;
    b.pose.heading_rad += by * arm / gyration_m2_[static_cast<std::size_t>(object)];
  }

  void shift_robot(int robot, const PlanContact& c, double by) {
    BodyState& b = bodies_[static_cast<std::size_t>(robot)];
    b.pose.x_m += by * c.normal.x;
    b.pose.y_m += by * c.normal.y;
  }

  /// Takes an overlap away but for the skin that keeps a contact alive.
  void separate(Pair& p, bool last) {
    const PlanContact c = plan_contact(placed(p.a), second(p));
    if (c.depth_m < -kTouchM) return;
    p.touched = true;
    p.contact = c;
    const double deep = c.depth_m - kContactDepthM;
    if (deep <= 0) return;
    if (!is_robot(p.a)) {
      const double yield_a = yielding(p.a, c), yield_b = p.fixed ? 0 : yielding(p.b, c);
      const double impulse = deep / (yield_a + yield_b);
      shift(p.a, c, impulse);
      if (!p.fixed) shift(p.b, c, -impulse);
      return;
    }
    if (p.fixed) return shift_robot(p.a, c, deep);
    const double driven_a = std::max(0.0, -dot(way_[static_cast<std::size_t>(p.a)], c.normal));
    if (is_robot(p.b)) {
      const double driven_b = std::max(0.0, dot(way_[static_cast<std::size_t>(p.b)], c.normal));
      const double part = driven_a + driven_b > 0 ? driven_a / (driven_a + driven_b) : 0.5;
      shift_robot(p.a, c, part * deep);
      shift_robot(p.b, c, (part - 1) * deep);
      return;
    }
    if (held_[static_cast<std::size_t>(p.b)] || (last && driven_a > 0)) return shift_robot(p.a, c, deep);
    shift(p.b, c, -deep / yielding(p.b, c));
  }

  /// Robots' speeds are what was left of their ways; books their touches.
  void note_robots() {
    touch_.assign(desc_.robots.size(), kUntouched);
    const auto mark = [&](int body, char what) {
      char& now = touch_[static_cast<std::size_t>(body)];
      now = std::max(now, what);
    };
    for (const Pair& p : pairs_) {
      if (!p.touched || !is_robot(p.a)) continue;
      mark(p.a, p.fixed ? kTouchesWall : kTouchesBody);
      if (!p.fixed && is_robot(p.b)) mark(p.b, kTouchesBody);
    }
    for (int robot : near_) {
      const std::size_t i = static_cast<std::size_t>(robot);
      BodyState& b = bodies_[i];
      b.velocity_m_s = {(b.pose.x_m - before_[i].x) / tick_s_, (b.pose.y_m - before_[i].y) / tick_s_};
      if (touch_[i] != kUntouched) note_touch(robot, touch_[i] == kTouchesWall);
    }
  }

  Vec2 velocity_at(int body, Vec2 point) const {
    const BodyState& b = bodies_[static_cast<std::size_t>(body)];
    if (is_robot(body)) return b.velocity_m_s;  // round and smooth: its spin does not count
    const Vec2 arm = point - Vec2{b.pose.x_m, b.pose.y_m};
    return b.velocity_m_s + b.spin_rad_s * Vec2{-arm.y, arm.x};
  }

  double parting_m_s(const Pair& p) const {
    const Vec2 b = p.fixed ? Vec2{} : velocity_at(p.b, p.contact.point);
    return dot(velocity_at(p.a, p.contact.point) - b, p.contact.normal);
  }

  /// True for what a blow does not move: fixed solids, robots, objects that are pushed in vain.
  bool stands(const Pair& p, int body, bool fixed) const {
    if (fixed || is_robot(body)) return true;
    return is_robot(p.a) && held_[static_cast<std::size_t>(body)];
  }

  void kick(int object, const PlanContact& c, double impulse) {
    BodyState& b = bodies_[static_cast<std::size_t>(object)];
    const double by = impulse / loose(object).mass_kg;
    const double arm = cross(c.point - Vec2{b.pose.x_m, b.pose.y_m}, c.normal);
    b.velocity_m_s = b.velocity_m_s + by * c.normal;
    b.spin_rad_s += by * arm / gyration_m2_[static_cast<std::size_t>(object)];
  }

  /// Objects that met and still approach each other part again.
  void strike() {
    for (Pair& p : pairs_) {
      if (!p.touched || (stands(p, p.a, false) && stands(p, p.b, p.fixed))) continue;
      const double speed = parting_m_s(p);
      const double bounce = std::max(is_robot(p.a) ? 0 : loose(p.a).restitution,
                                     p.fixed ? desc_.surfaces[static_cast<std::size_t>(p.b)].restitution
                                             : (is_robot(p.b) ? 0 : loose(p.b).restitution));
      p.rebound_m_s = speed < -kLeastBounceMS ? -bounce * speed : 0;
    }
    for (int round = 0; round < kBlows; ++round) {
      for (Pair& p : pairs_) {
        const bool still_a = stands(p, p.a, false), still_b = stands(p, p.b, p.fixed);
        if (!p.touched || (still_a && still_b)) continue;
        const double yield =
            (still_a ? 0 : yielding(p.a, p.contact)) + (still_b ? 0 : yielding(p.b, p.contact));
        const double wanted = std::max(0.0, p.impulse + (p.rebound_m_s - parting_m_s(p)) / yield);
        const double change = wanted - p.impulse;
        p.impulse = wanted;
        if (!still_a) kick(p.a, p.contact, change);
        if (!still_b) kick(p.b, p.contact, -change);
      }
    }
  }

  std::vector<char> touch_;          // per robot: of this tick
  std::vector<Vec2> way_;            // per robot: where its wheels wanted to go in this tick
  std::vector<Vec2> pushed_;         // per body: sum of the robots' pushes on it, N
  std::vector<char> held_;           // per body: pushed in vain
  std::vector<int> rank_;            // per body: place in awake_
  std::vector<double> gyration_m2_;  // per body
  std::vector<int> awake_;           // objects that move or may be touched
  std::vector<Pair> pairs_;
  std::vector<Candidate> around_;
};

}  // namespace

std::unique_ptr<Motion> make_planar_motion(MotionDesc desc) {
  return std::make_unique<PlanarMotion>(std::move(desc));
}

}  // namespace sim
