// SPDX-License-Identifier: MIT
// The engine with forces. Robots that meet fixed solids only follow the law of fixed_contacts.cpp; Box2D
// solves where bodies push each other. There a robot obeys the law of traction as a friction joint to a ghost
// that moves as the wheels ask, so contacts and traction are solved together; loose objects have one to a
// ghost that moves like whatever they stand on. Lengths are converted to Box2D's units here and nowhere else.
#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>

#include "sim_core/physics/motion.h"
#include "sim_core/physics/physics_params.h"

// Box2D reads the host's clock for every island, a third of a swarm's step; these definitions take its place
// and make sure that nothing in the simulator depends on the host's time.
b2Timer::b2Timer() : m_start_sec(0), m_start_usec(0) {}
void b2Timer::Reset() {}
float b2Timer::GetMilliseconds() const { return 0; }

namespace sim {
namespace {

constexpr double kUnits = kBox2dUnitsPerMetre;
constexpr double kLongestPieceM =
    0.5;  // long walls are cut: one fixture across the arena spoils Box2D's tree
constexpr std::uintptr_t kFixedId = 1u << 30;

float units(double metres) { return static_cast<float>(metres * kUnits); }
b2Vec2 units(Vec2 v) { return {units(v.x), units(v.y)}; }

class DynamicMotion final : public Motion, b2ContactFilter {
 public:
  explicit DynamicMotion(MotionDesc desc) : Motion(std::move(desc), true, true, false), world_(b2Vec2(0, 0)) {
    world_.SetContinuousPhysics(false);  // at a few mm per tick nothing tunnels
    world_.SetContactFilter(this);
    b2BodyDef def;
    b2Body* ground = world_.CreateBody(&def);
    for (std::size_t i = 0; i < desc_.fixed->size(); ++i) add_fixed(ground, static_cast<int>(i));
    parts_.resize(bodies_.size());
    for (int i = robots(); i < static_cast<int>(bodies_.size()); ++i) build(i);
  }

  void move(int body, const Pose2& pose, double z_m) override {
    Motion::move(body, pose, z_m);
    Part& part = parts_[static_cast<std::size_t>(body)];
    if (!part.body) return;
    place(body);
    part.body->SetLinearVelocity({0, 0});
    part.body->SetAngularVelocity(0);
    part.body->SetAwake(true);
  }

  void set_velocity(int body, Vec2 velocity_m_s, double spin_rad_s, double climb_m_s) override {
    Motion::set_velocity(body, velocity_m_s, spin_rad_s, climb_m_s);
    Part& part = parts_[static_cast<std::size_t>(body)];
    if (!part.body) return;
    part.body->SetLinearVelocity(units(velocity_m_s));
    part.body->SetAngularVelocity(static_cast<float>(spin_rad_s));
    part.body->SetAwake(true);
  }

 protected:
  bool is_loose_moving() const override {
    return std::any_of(parts_.begin() + robots(), parts_.end(),
                       [](const Part& p) { return p.body->IsAwake(); });
  }

  void step_plane(const Neighbours& neighbours) override {
    for (int i = robots(); i < static_cast<int>(bodies_.size()); ++i) follow_support(i);
    leaving_.swap(solved_);
    solved_.clear();
    for (int robot : near_) {
      if (near(robot) == Near::Meets || is_sloping()) {
        solved_.push_back(robot);
      } else {
        meet_fixed(robot, neighbours);
      }
    }
    for (int robot : leaving_) {
      if (!std::binary_search(solved_.begin(), solved_.end(), robot)) leave_solver(robot);
    }
    for (int robot : solved_) enter_solver(robot);
    if (!solved_.empty() || is_loose_moving()) {
      world_.Step(static_cast<float>(tick_s_), kVelocityIterations, kPositionIterations);
      for (int robot : solved_) read_robot(robot);
      for (int i = robots(); i < static_cast<int>(bodies_.size()); ++i) read_loose(i);
    }
    // Box2D notices a meeting only once bodies overlap, by up to a tick's way, and separates them softly;
    // twice round settles a robot in a corner, and walls have the last word
    for (int round = 0; round < 2; ++round) {
      for (int robot : near_)
        if (near(robot) >= Near::Bodies || is_sloping()) push_out(robot, neighbours);
    }
  }

  void heights_changed(int body) override {
    Part& part = parts_[static_cast<std::size_t>(body)];
    if (!part.body) return;
    for (b2Fixture* f = part.body->GetFixtureList(); f; f = f->GetNext()) f->Refilter();
    part.body->SetAwake(true);
  }

  void velocity_changed(int body) override {
    parts_[static_cast<std::size_t>(body)].body->SetLinearVelocity(
        units(bodies_[static_cast<std::size_t>(body)].velocity_m_s));
  }

 private:
  struct Part {
    b2Body* body = nullptr;
    b2Body* ghost = nullptr;
    b2FrictionJoint* joint = nullptr;
    b2Vec2 placed{0, 0};  // where the body was put before the step
    float placed_angle = 0;
    double angle_base_rad = 0;  // headings are not wrapped; Box2D gets the rest after whole turns
  };

  bool ShouldCollide(b2Fixture* a, b2Fixture* b) override {
    double za0, za1, zb0, zb1;
    heights(a, za0, za1);
    heights(b, zb0, zb1);
    return heights_meet(za0, za1, zb0, zb1);
  }

  void heights(b2Fixture* f, double& z0, double& z1) const {
    const std::uintptr_t id = f->GetUserData().pointer;
    if (id >= kFixedId) {
      const Placed& p = (*desc_.fixed)[id - kFixedId];
      z0 = p.z_m + p.solid->z0_m;
      z1 = p.z_m + p.solid->z1_m;
    } else {
      z0 = bodies_[id].z_m + desc_.solids[id]->z0_m;
      z1 = bodies_[id].z_m + desc_.solids[id]->z1_m;
    }
  }

  /// One fixture, or several pieces of a long thin box.
  void add_fixed(b2Body* ground, int index) {
    const Placed& p = (*desc_.fixed)[static_cast<std::size_t>(index)];
    const FixedSurface& surface = desc_.surfaces[static_cast<std::size_t>(index)];
    b2FixtureDef def;
    def.friction = static_cast<float>(surface.friction);
    def.restitution = static_cast<float>(surface.restitution);
    def.userData.pointer = kFixedId + static_cast<std::uintptr_t>(index);
    if (p.solid->kind != SolidKind::Prism) {
      b2CircleShape circle;
      circle.m_radius = units(p.solid->radius_m);
      circle.m_p = units(p.frame.at);
      def.shape = &circle;
      ground->CreateFixture(&def);
      return;
    }
    // A shape of four corners is cut across its longer side into pieces of kLongestPieceM at most.
    std::vector<std::vector<Vec2>> pieces{p.solid->outline};
    if (p.solid->outline.size() == 4) {
      const std::vector<Vec2>& o = p.solid->outline;
      const bool first_long = length(o[1] - o[0]) > length(o[2] - o[1]);
      const Vec2 a = first_long ? o[0] : o[1], b = first_long ? o[1] : o[2];
      const Vec2 c = first_long ? o[2] : o[3], d = first_long ? o[3] : o[0];
      const int count = std::max(1, static_cast<int>(std::ceil(length(b - a) / kLongestPieceM)));
      pieces.clear();
      for (int k = 0; k < count; ++k) {
        const double f0 = static_cast<double>(k) / count, f1 = static_cast<double>(k + 1) / count;
        pieces.push_back({a + f0 * (b - a), a + f1 * (b - a), d + f1 * (c - d), d + f0 * (c - d)});
      }
    }
    for (const std::vector<Vec2>& piece : pieces) {
      for (const b2PolygonShape& shape : polygons(piece, p.frame)) {
        def.shape = &shape;
        ground->CreateFixture(&def);
      }
    }
  }

  /// Box2D polygons have at most eight corners: a richer outline becomes a fan of them.
  static std::vector<b2PolygonShape> polygons(const std::vector<Vec2>& outline, const Frame2& frame) {
    std::vector<b2PolygonShape> shapes;
    for (std::size_t next = 1; next + 1 < outline.size();) {
      std::vector<b2Vec2> points{units(frame.to_world(outline[0]))};
      while (next < outline.size() && points.size() < b2_maxPolygonVertices) {
        points.push_back(units(frame.to_world(outline[next++])));
      }
      shapes.emplace_back();
      shapes.back().Set(points.data(), static_cast<int>(points.size()));
      if (next < outline.size()) --next;  // the next piece begins with this one's last corner
    }
    return shapes;
  }

  /// Makes the Box2D side of a moving body: its shape, its ghost and the friction between them.
  void build(int index) {
    const std::size_t i = static_cast<std::size_t>(index);
    Part& part = parts_[i];
    const bool robot = index < robots();
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.allowSleep = !robot;
    part.body = world_.CreateBody(&def);
    b2FixtureDef fixture;
    fixture.userData.pointer = static_cast<std::uintptr_t>(index);
    double mass, inertia, force, torque;
    // A robot is held by its wheels' traction, an object by its friction on the floor.
    if (robot) {
      const RobotBody& r = desc_.robots[i];
      mass = r.mass_kg;
      inertia = r.inertia_kg_m2;
      force = r.traction_n;
      torque = r.traction_n * 0.5 * r.axle_m;
      fixture.friction = static_cast<float>(r.side_friction);
    } else {
      const LooseBody& l = desc_.loose[i - desc_.robots.size()];
      mass = l.mass_kg;
      inertia = l.mass_kg * desc_.solids[i]->gyration_m2();
      force = l.floor_friction * mass * desc_.gravity_m_s2;
      torque = force * std::sqrt(desc_.solids[i]->gyration_m2());
      fixture.friction = static_cast<float>(l.side_friction);
      fixture.restitution = static_cast<float>(l.restitution);
    }
    // Its shape. Box2D would work out the mass from it; ours is set instead.
    if (desc_.solids[i]->kind == SolidKind::Prism) {
      for (const b2PolygonShape& shape : polygons(desc_.solids[i]->outline, Frame2())) {
        fixture.shape = &shape;
        fixture.density = 1;
        part.body->CreateFixture(&fixture);
      }
    } else {
      b2CircleShape circle;
      circle.m_radius = units(desc_.solids[i]->radius_m);
      fixture.shape = &circle;
      fixture.density = 1;
      part.body->CreateFixture(&fixture);
    }
    b2MassData data;
    data.mass = static_cast<float>(mass);
    data.center.SetZero();
    data.I = static_cast<float>(inertia * kUnits * kUnits);
    part.body->SetMassData(&data);
    part.body->SetLinearVelocity(units(bodies_[i].velocity_m_s));
    place(index);

    // The ghost goes where the floor, or what carries it, wants it; a friction joint pulls the body along.
    def.type = b2_kinematicBody;
    part.ghost = world_.CreateBody(&def);
    b2FrictionJointDef joint;
    joint.bodyA = part.ghost;
    joint.bodyB = part.body;
    joint.maxForce = static_cast<float>(force * kUnits);
    joint.maxTorque = static_cast<float>(torque * kUnits * kUnits);
    part.joint = static_cast<b2FrictionJoint*>(world_.CreateJoint(&joint));
  }

  /// Puts the Box2D body where our own (double precision) pose says.
  void place(int index) {
    const BodyState& b = bodies_[static_cast<std::size_t>(index)];
    Part& part = parts_[static_cast<std::size_t>(index)];
    part.angle_base_rad = 2 * kPi * std::round(b.pose.heading_rad / (2 * kPi));
    part.placed = units(Vec2{b.pose.x_m, b.pose.y_m});
    part.placed_angle = static_cast<float>(b.pose.heading_rad - part.angle_base_rad);
    part.body->SetTransform(part.placed, part.placed_angle);
  }

  void enter_solver(int robot) {
    const std::size_t r = static_cast<std::size_t>(robot);
    if (!parts_[r].body) build(robot);
    Part& part = parts_[r];
    place(robot);
    part.body->SetLinearVelocity(units(bodies_[r].velocity_m_s));
    part.body->SetAngularVelocity(static_cast<float>(bodies_[r].spin_rad_s));
    const Wanted want = wanted(robot);
    part.ghost->SetLinearVelocity(units(want.velocity_m_s));
    part.ghost->SetAngularVelocity(static_cast<float>(want.spin_rad_s));
    double grip = grip_n(robot, want);
    if (is_sloping()) {
      const SlopeEffect& slope = slope_of(robot);
      const double weight_n = desc_.robots[r].mass_kg * desc_.gravity_m_s2;
      part.body->ApplyForceToCenter(units(weight_n * slope.pull), true);
      grip *= slope.steep;  // the pull is in plan, so grip must be
    }
    part.joint->SetMaxForce(static_cast<float>(grip * kUnits));
    part.joint->SetMaxTorque(static_cast<float>(grip * 0.5 * desc_.robots[r].axle_m * kUnits * kUnits));
  }

  /// Box2D passes through all its bodies at each step, whatever they do: who is free has none.
  void leave_solver(int robot) {
    Part& part = parts_[static_cast<std::size_t>(robot)];
    world_.DestroyBody(part.body);
    world_.DestroyBody(part.ghost);
    part = Part{};
  }

  /// Moves our pose as far as Box2D moved its body: what float rounding swallowed stays in the double.
  void read_pose(int index) {
    BodyState& b = bodies_[static_cast<std::size_t>(index)];
    const Part& part = parts_[static_cast<std::size_t>(index)];
    const b2Vec2 at = part.body->GetPosition();
    b.pose.x_m += (static_cast<double>(at.x) - static_cast<double>(part.placed.x)) / kUnits;
    b.pose.y_m += (static_cast<double>(at.y) - static_cast<double>(part.placed.y)) / kUnits;
    b.pose.heading_rad += static_cast<double>(part.body->GetAngle()) - static_cast<double>(part.placed_angle);
    const b2Vec2 v = part.body->GetLinearVelocity();
    b.velocity_m_s = {static_cast<double>(v.x) / kUnits, static_cast<double>(v.y) / kUnits};
    b.spin_rad_s = static_cast<double>(part.body->GetAngularVelocity());
  }

  void read_robot(int robot) {
    const std::size_t r = static_cast<std::size_t>(robot);
    bool wall = false, anything = false;
    for (b2ContactEdge* e = parts_[r].body->GetContactList(); e; e = e->next) {
      if (!e->contact->IsTouching()) continue;
      anything = true;
      wall = wall || e->other->GetType() == b2_staticBody;
    }
    if (anything) note_touch(robot, wall);
    // without a touch the closed form holds exactly, so the solver's rounding need not enter
    if (anything) {
      read_pose(robot);
    } else {
      drive_freely(robot, wanted(robot));
    }
  }

  void read_loose(int index) {
    Part& part = parts_[static_cast<std::size_t>(index)];
    if (!part.body->IsAwake() && !part.ghost->IsAwake()) {
      bodies_[static_cast<std::size_t>(index)].velocity_m_s = {};
      bodies_[static_cast<std::size_t>(index)].spin_rad_s = 0;
      return;
    }
    read_pose(index);
    part.placed = part.body->GetPosition();
    part.placed_angle = part.body->GetAngle();
  }

  /// In the air nothing slows an object; on another body it goes along with that body.
  void follow_support(int index) {
    const std::size_t i = static_cast<std::size_t>(index);
    Part& part = parts_[i];
    const int support = support_[i];
    // A slope pulls it down.
    SlopeEffect slope;
    if (is_sloping()) {
      slope = loose_slope(index);
      if (loose(index).rolls && support == kOnFloor) slope.pull = kRollingShare * slope.pull;
      const double grip = loose(index).floor_friction * slope.press * slope.steep;
      // what lies still on a slope that is too steep begins to slide
      if (support == kInAir || length(slope.pull) > grip) part.body->SetAwake(true);
    }
    // What sleeps is woken when what it lies on moves.
    if (!part.body->IsAwake()) {
      if (support < 0) return;
      const BodyState& under = bodies_[static_cast<std::size_t>(support)];
      if (dot(under.velocity_m_s, under.velocity_m_s) == 0 && under.spin_rad_s == 0) return;
      part.body->SetAwake(true);
    }
    const LooseBody& l = desc_.loose[i - desc_.robots.size()];
    const double radius_m = std::sqrt(desc_.solids[i]->gyration_m2());
    // How firmly what it lies on holds it.
    double force = support == kInAir ? 0 : l.floor_friction * l.mass_kg * desc_.gravity_m_s2;
    if (is_sloping()) {
      force *= slope.press * slope.steep;
      part.body->ApplyForceToCenter(units((l.mass_kg * desc_.gravity_m_s2) * slope.pull), false);
    }
    // The ghost stands still, or moves as the body below does at this place.
    if (support < 0) {
      if (part.ghost->GetLinearVelocity().LengthSquared() > 0) part.ghost->SetLinearVelocity({0, 0});
      if (part.ghost->GetAngularVelocity() != 0) part.ghost->SetAngularVelocity(0);
      return hold(part, force, radius_m);
    }
    const BodyState& under = bodies_[static_cast<std::size_t>(support)];
    const Vec2 arm{bodies_[i].pose.x_m - under.pose.x_m, bodies_[i].pose.y_m - under.pose.y_m};
    const Vec2 v = under.velocity_m_s + under.spin_rad_s * Vec2{-arm.y, arm.x};
    part.ghost->SetLinearVelocity(units(v));
    part.ghost->SetAngularVelocity(static_cast<float>(under.spin_rad_s));
    hold(part, force, radius_m);
  }

  /// What lies somewhere has one friction, for sliding and turning together: a body that slides is turned by the
  /// least moment, as its friction acts against its way. Force and moment lie on an ellipse (the limit surface), where
  /// the motion of the tick before has put them; of one that lies still, both are whole.
  static void hold(Part& part, double force_n, double radius_m) {
    constexpr double kStillM = 1e-4;  // m/s, below what a push gives in a tick [assumed]
    const double slides = static_cast<double>(
                              (part.body->GetLinearVelocity() - part.ghost->GetLinearVelocity()).Length()) /
                          kUnits,
                 turns = radius_m * std::abs(static_cast<double>(part.body->GetAngularVelocity() -
                                                                 part.ghost->GetAngularVelocity()));
    const double speed = std::hypot(slides, turns);
    const bool is_still = speed < kStillM;
    part.joint->SetMaxForce(static_cast<float>((is_still ? 1 : slides / speed) * force_n * kUnits));
    part.joint->SetMaxTorque(
        static_cast<float>((is_still ? 1 : turns / speed) * force_n * radius_m * kUnits * kUnits));
  }

  b2World world_;
  std::vector<Part> parts_;
  std::vector<int> solved_, leaving_;  // robots in Box2D in this tick and in the last, in order
};

}  // namespace

std::unique_ptr<Motion> make_dynamic_motion(MotionDesc desc) {
  return std::make_unique<DynamicMotion>(std::move(desc));
}

}  // namespace sim
