// SPDX-License-Identifier: MIT
// Walls become one box per segment, lengthened by half a thickness at each end so that corners are closed.
#include "sim_core/world/layout.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim_core/base/check.h"

namespace sim {
namespace {

constexpr double kKerbM = 0.004;           // height of a ramp's kerb: above any robot's underside
constexpr double kKerbThicknessM = 0.002;  // thin: it stands on the ramp's own rectangle
constexpr double kKerbPieceM = 0.02;       // a kerb rises in steps of this length
constexpr double kBesideM = 0.001;         // where the ground beside an edge is felt
constexpr double kOpenEdgeM = 0.0015;      // lower steps than this are driven over

/// Shifts a polygon so that its centroid is its origin; returns where the centroid was.
Vec2 centre_outline(std::vector<Vec2>& corners) {
  double twice = 0;
  Vec2 sum;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    const double c = cross(a, b);
    twice += c;
    sum = sum + c * (a + b);
  }
  const Vec2 centre = (1 / (3 * twice)) * sum;
  for (Vec2& corner : corners) corner = corner - centre;
  return centre;
}

class Builder {
 public:
  explicit Builder(Layout& out) : out_(out) {}

  void fixed(Solid solid, const Pose2& pose, double z_m, const Surface& surface, std::string name, int line) {
    out_.fixed.push_back({&keep(std::move(solid)), Frame2(pose), z_m});
    out_.fixed_surface.push_back(surface);
    out_.fixed_name.push_back(std::move(name));
    out_.fixed_line.push_back(line);
  }

  const Solid& keep(Solid solid) {
    out_.solids.push_back(std::move(solid));
    return out_.solids.back();
  }

  void moving(const Solid& kept, const Pose2& pose, double z_m, const Surface& surface, std::string name) {
    out_.moving.push_back({&kept, Frame2(pose), z_m});
    out_.moving_pose.push_back(pose);
    out_.moving_surface.push_back(surface);
    out_.moving_name.push_back(std::move(name));
  }

 private:
  Layout& out_;
};

void add_arena(const ArenaDesc& arena, Builder& build) {
  const double t = arena.wall_thickness_m, h = arena.wall_height_m;
  if (h <= 0) return;
  const Surface surface = surface_of(arena.material);
  const Vec2 c = arena.centre_m, s = arena.size_m;
  const double x = 0.5 * (s.x + t), y = 0.5 * (s.y + t);
  build.fixed(Solid::box(s.x + 2 * t, t, 0, h), {c.x, c.y + y, 0}, 0, surface, "north arena wall", 0);
  build.fixed(Solid::box(s.x + 2 * t, t, 0, h), {c.x, c.y - y, 0}, 0, surface, "south arena wall", 0);
  build.fixed(Solid::box(t, s.y, 0, h), {c.x + x, c.y, 0}, 0, surface, "east arena wall", 0);
  build.fixed(Solid::box(t, s.y, 0, h), {c.x - x, c.y, 0}, 0, surface, "west arena wall", 0);
}

void add_wall(const WallDesc& wall, int number, Builder& build) {
  const std::size_t n = wall.points_m.size();
  const std::size_t segments = wall.closed ? n : n - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const Vec2 a = wall.points_m[i], b = wall.points_m[(i + 1) % n];
    const Vec2 along = b - a;
    const double len = length(along);
    // ends are lengthened only where another segment joins: a free end stands where it was written
    const bool joined_a = wall.closed || i > 0;
    const bool joined_b = wall.closed || i + 1 < segments;
    const double extra_a = joined_a ? 0.5 * wall.thickness_m : 0;
    const double extra_b = joined_b ? 0.5 * wall.thickness_m : 0;
    const Vec2 dir = (1 / len) * along;
    const Vec2 middle = a + 0.5 * (len + extra_b - extra_a) * dir;
    const Pose2 pose{middle.x, middle.y, std::atan2(dir.y, dir.x)};
    build.fixed(Solid::box(len + extra_a + extra_b, wall.thickness_m, 0, wall.height_m), pose, wall.z_m,
                surface_of(wall.material), "wall " + std::to_string(number) + " segment " + std::to_string(i),
                wall.line);
  }
}

Solid solid_of(const ObjectDesc& o, Pose2& pose) {
  switch (o.kind) {
    case ObjectKind::Box:
      return Solid::box(o.size_m.x, o.size_m.y, 0, o.size_m.z);
    case ObjectKind::Cylinder:
      return Solid::cylinder(o.radius_m, 0, o.size_m.z);
    case ObjectKind::Ball:
      return Solid::ball(o.radius_m);
    case ObjectKind::Polygon:
      break;
  }
  std::vector<Vec2> corners = counter_clockwise(o.corners_m);
  const Vec2 centre = Frame2(pose).to_world(centre_outline(corners));
  pose.x_m = centre.x;
  pose.y_m = centre.y;
  return Solid::prism(std::move(corners), 0, o.size_m.z);
}

/// The sides of a ramp: low walls that rise with it, wherever the ground beside it is lower. Robots below are
/// stopped by them; for robots on the ramp they end in a kerb, so nobody drives off an edge.
void add_kerbs(const RampDesc& ramp, std::size_t number, const Ground& ground, Builder& build) {
  const Frame2 frame(ramp.pose);
  const double half_x = 0.5 * ramp.size_m.x, half_y = 0.5 * ramp.size_m.y;
  const Vec2 corners[5] = {
      {-half_x, -half_y}, {half_x, -half_y}, {half_x, half_y}, {-half_x, half_y}, {-half_x, -half_y}};
  Surface surface = surface_of(ramp.material);
  for (int side = 0; side < 4; ++side) {
    const Vec2 a = corners[side], b = corners[side + 1];
    const double size = length(b - a);
    const Vec2 dir = (1 / size) * (b - a);
    const Vec2 out{dir.y, -dir.x};
    const int pieces = std::max(1, static_cast<int>(std::ceil(size / kKerbPieceM)));
    for (int k = 0; k < pieces; ++k) {
      const Vec2 from = a + (size * k / pieces) * dir, to = a + (size * (k + 1) / pieces) * dir;
      const Vec2 middle = 0.5 * (from + to);
      const auto height = [&](Vec2 at) { return ground.height_m(frame.to_world(at)); };
      const double inside = std::max({height(from - kBesideM * out), height(to - kBesideM * out)});
      const double outside = height(middle + kBesideM * out);
      // a ramp over or beside this one that is as high leaves the edge open
      if (inside - outside < kOpenEdgeM || height(middle - kBesideM * out) - outside < kOpenEdgeM) continue;
      const Vec2 centre = frame.to_world(middle - 0.5 * kKerbThicknessM * out);
      const Pose2 pose{centre.x, centre.y, ramp.pose.heading_rad + std::atan2(dir.y, dir.x)};
      const std::string name = ramp.name.empty() ? std::to_string(number) : "'" + ramp.name + "'";
      build.fixed(Solid::box(length(to - from), kKerbThicknessM, 0, inside - outside + kKerbM), pose, outside,
                  surface, "edge of ramp " + name, ramp.line);
    }
  }
}

const char* kind_name(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::Box:
      return "box";
    case ObjectKind::Cylinder:
      return "cylinder";
    case ObjectKind::Ball:
      return "ball";
    case ObjectKind::Polygon:
      return "polygon";
  }
  return "object";
}

}  // namespace

Surface surface_of(const Material& m) {
  return {m.colour, m.ir_reflectance < 0 ? m.colour.r : m.ir_reflectance, m.roughness, m.friction,
          m.restitution};
}

Footing robot_footing(const Ground& ground, const RobotModel& model, const Pose2& pose) {
  if (!ground.has_ramps()) return {};
  return ground.footing(pose, kFootingShare * model.body_radius_m, 0.5 * model.axle_m);
}

Layout build_layout(const WorldDesc& world) {
  Layout out;
  Builder build(out);
  // What stands fast: arena, walls, and the sides of ramps.
  if (world.arena) add_arena(*world.arena, build);
  for (std::size_t i = 0; i < world.walls.size(); ++i) add_wall(world.walls[i], static_cast<int>(i), build);

  std::vector<Ramp> ramps;
  for (const RampDesc& r : world.ramps) ramps.push_back({r.pose, r.size_m.x, r.size_m.y, r.low_m, r.high_m});
  out.ground = Ground(ramps, world.floor.tilt_x_rad, world.floor.tilt_y_rad);
  for (std::size_t i = 0; i < ramps.size(); ++i) add_kerbs(world.ramps[i], i, out.ground, build);

  // What moves: robots first, then loose objects among the fixed ones.
  std::map<const RobotModel*, const Solid*> bodies;  // robots of one model share theirs
  for (const RobotDesc& r : world.robots) {
    const RobotModel* model = world.model_of(r);
    CHECK(model, "every robot has a model");
    const Solid*& body = bodies[model];
    if (!body)
      body = &build.keep(Solid::cylinder(model->body_radius_m, model->body_z0_m, model->body_height_m));
    Surface surface;
    surface.colour = r.colour ? *r.colour : model->colour;
    surface.ir_reflectance = model->ir_reflectance < 0 ? surface.colour.r : model->ir_reflectance;
    surface.roughness = model->roughness;
    surface.friction = model->side_friction;
    build.moving(*body, r.pose, robot_footing(out.ground, *model, r.pose).height_m, surface,
                 "robot '" + r.name + "'");
  }
  for (std::size_t i = 0; i < world.objects.size(); ++i) {
    const ObjectDesc& o = world.objects[i];
    Pose2 pose = o.pose;
    Solid solid = solid_of(o, pose);
    std::string name =
        std::string(kind_name(o.kind)) + (o.name.empty() ? " " + std::to_string(i) : " '" + o.name + "'");
    if (o.movable) {
      // what stands on a ramp starts there; what was written higher falls, or lies down where nothing is high
      const double ground_m = out.ground.height_m({pose.x_m, pose.y_m});
      const double z = world.engine == Engine::Planar ? ground_m : std::max(o.z_m, ground_m);
      build.moving(build.keep(std::move(solid)), pose, z, surface_of(o.material), std::move(name));
      out.loose_object.push_back(static_cast<int>(i));
    } else {
      build.fixed(std::move(solid), pose, o.z_m, surface_of(o.material), std::move(name), o.line);
    }
  }

  // How far all of it reaches.
  Vec2 low{1e300, 1e300}, high{-1e300, -1e300};
  const auto include = [&](const Placed& p) {
    const auto point = [&](Vec2 w, double r) {
      low = {std::min(low.x, w.x - r), std::min(low.y, w.y - r)};
      high = {std::max(high.x, w.x + r), std::max(high.y, w.y + r)};
    };
    if (p.solid->kind != SolidKind::Prism) return point(p.frame.at, p.solid->radius_m);
    for (const Vec2& corner : p.solid->outline) point(p.frame.to_world(corner), 0);
  };
  for (const Ramp& r : ramps) {
    const double reach = 0.5 * length({r.length_m, r.width_m});
    low = {std::min(low.x, r.pose.x_m - reach), std::min(low.y, r.pose.y_m - reach)};
    high = {std::max(high.x, r.pose.x_m + reach), std::max(high.y, r.pose.y_m + reach)};
  }
  for (const Placed& p : out.fixed) include(p);
  for (const Placed& p : out.moving) include(p);
  if (low.x > high.x) low = {-0.5, -0.5}, high = {0.5, 0.5};
  if (out.fixed.empty()) low = low - Vec2{0.25, 0.25}, high = high + Vec2{0.25, 0.25};
  out.low_m = low;
  out.high_m = high;
  return out;
}

Surface floor_at(const WorldDesc& world, Vec2 point_m) {
  const FloorDesc& f = world.floor;
  Surface out;
  out.colour = f.colour;
  out.ir_reflectance = f.ir_reflectance < 0 ? f.colour.r : f.ir_reflectance;
  if (f.image_rgb.empty() || !world.arena) return out;
  const ArenaDesc& arena = *world.arena;
  const double u = (point_m.x - arena.centre_m.x) / arena.size_m.x + 0.5;
  const double v = 0.5 - (point_m.y - arena.centre_m.y) / arena.size_m.y;
  if (!(u >= 0 && u < 1 && v >= 0 && v < 1)) return out;
  const int column = std::min(f.image_width - 1, static_cast<int>(u * f.image_width));
  const int row = std::min(f.image_height - 1, static_cast<int>(v * f.image_height));
  const std::uint8_t* pixel =
      f.image_rgb.data() + 3 * (static_cast<std::size_t>(row) * f.image_width + column);
  out.colour = {pixel[0] / 255.0, pixel[1] / 255.0, pixel[2] / 255.0};
  if (f.ir_reflectance < 0) out.ir_reflectance = out.colour.r;
  return out;
}

}  // namespace sim
