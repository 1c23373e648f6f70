// SPDX-License-Identifier: MIT
// Pose history is a ring per body; candidate lists are gathered anew when movement has used up their skin.
#include "sim_core/world/scene.h"

#include <algorithm>
#include <cmath>

#include "sim_core/base/check.h"

namespace sim {
namespace {

std::vector<double> bounds_of(const Layout& layout) {
  std::vector<double> bounds;
  for (const Placed& p : layout.moving) bounds.push_back(p.solid->bound_m);
  return bounds;
}

}  // namespace

Scene::Scene(const WorldDesc& world, std::vector<double> reach_m)
    : world_(world),
      layout_(build_layout(world_)),
      robots_(static_cast<int>(world_.robots.size())),
      tick_clicks_(kClicksPerSecond / world_.physics_hz),
      tick_s_(to_seconds(tick_clicks_)),
      slots_(static_cast<int>(std::ceil(kHistoryS * world_.physics_hz)) + 2),
      per_tick_(1.0 / static_cast<double>(tick_clicks_)),
      moving_(layout_.moving),
      neighbours_(layout_.fixed, bounds_of(layout_), robots_, std::move(reach_m)) {
  CHECK(tick_clicks_ * world_.physics_hz == kClicksPerSecond, "the tick rate divides the click rate");
  states_.resize(layout_.moving.size());
  history_.resize(states_.size() * static_cast<std::size_t>(slots_));
  moved_.assign(static_cast<std::size_t>(slots_), 0.0);
  for (std::size_t i = 0; i < states_.size(); ++i) {
    states_[i].pose = layout_.moving_pose[i];
    states_[i].z_m = layout_.moving[i].z_m;
    std::fill_n(history_.begin() + static_cast<std::ptrdiff_t>(i) * slots_, slots_, past(states_[i]));
  }
  regather();
}

int Scene::slot_before(Clicks at, Clicks* start) const {
  // count back: usually one or two; slots from before the world began hold its start
  int slot = last_slot_;
  Clicks tick = now();
  for (int back = 1; back < slots_ && tick > at; ++back) {
    slot = slot == 0 ? slots_ - 1 : slot - 1;
    tick -= tick_clicks_;
  }
  *start = tick;
  return slot;
}

Pose2 Scene::pose(int body, Clicks at) const {
  Clicks start;
  const int slot = slot_before(at, &start);
  const Past& b = history_[static_cast<std::size_t>(body) * static_cast<std::size_t>(slots_) +
                           static_cast<std::size_t>(slot)];
  if (at <= start) return b.pose;
  const double ahead_s = to_seconds(at - start);
  return {b.pose.x_m + b.velocity_m_s.x * ahead_s, b.pose.y_m + b.velocity_m_s.y * ahead_s,
          b.pose.heading_rad + b.spin_rad_s * ahead_s};
}

Pose2 Scene::pose_on_way(int body, Clicks at) const {
  Clicks start;
  const int slot = slot_before(at, &start);
  const Past* ring = history_.data() + static_cast<std::size_t>(body) * static_cast<std::size_t>(slots_);
  const Pose2& a = ring[slot].pose;
  if (at <= start || start == now()) return a;
  const Pose2& b = ring[slot + 1 == slots_ ? 0 : slot + 1].pose;
  const double f = static_cast<double>(at - start) * per_tick_;
  return {a.x_m + f * (b.x_m - a.x_m), a.y_m + f * (b.y_m - a.y_m),
          a.heading_rad + f * (b.heading_rad - a.heading_rad)};
}

Placed Scene::placed(int body, Clicks at) const {
  const std::size_t i = static_cast<std::size_t>(body);
  const Pose2 p = pose(body, at);
  Placed out{layout_.moving[i].solid, Frame2(), states_[i].z_m};
  if (out.solid->kind == SolidKind::Prism) {
    out.frame = Frame2(p);
  } else {
    out.frame.at = {p.x_m, p.y_m};
  }
  return out;
}

Surface Scene::floor(Vec2 point_m) const {
  const FloorDesc& f = world_.floor;
  Surface out;
  out.colour = f.colour;
  out.ir_reflectance = f.ir_reflectance < 0 ? f.colour.r : f.ir_reflectance;
  if (f.image_rgb.empty() || !world_.arena) return out;
  const ArenaDesc& arena = *world_.arena;
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

bool Scene::cast(const Ray& ray, double limit_m, int skip_robot, Clicks at, SceneHit* hit) const {
  Vec3 best;
  double nearest = limit_m;
  Candidate what{-1, false};
  const auto try_one = [&](const Candidate& c, const Placed& placed) {
    if (cast_ray(ray, placed, nearest, &best)) what = c;
  };
  // walk the ray in pieces of a few cells; what a piece meets nearer than its end is final
  const double plan = std::sqrt(ray.dir.x * ray.dir.x + ray.dir.y * ray.dir.y);
  const double piece_m = 2 * kCellM;
  thread_local std::vector<Candidate> around;
  for (double from = 0; from < nearest;) {
    const double to = plan > 1e-9 ? std::min(from + piece_m / plan, limit_m) : limit_m;
    const double middle = 0.5 * (from + to);
    around.clear();
    // bodies are binned where they were gathered: allow for what they moved since
    neighbours_.gather({ray.from.x + middle * ray.dir.x, ray.from.y + middle * ray.dir.y},
                       0.5 * piece_m + 2 * kSkinM, around);
    for (const Candidate& c : around) {
      if (c.moving && c.index == skip_robot && c.index < robots_) continue;
      try_one(c, c.moving ? placed(c.index, at) : layout_.fixed[static_cast<std::size_t>(c.index)]);
    }
    if (nearest <= to || to >= limit_m) break;
    const Vec2 end{ray.from.x + to * ray.dir.x, ray.from.y + to * ray.dir.y};
    const double far = 1.0;  // nothing stands further than this outside what a picture shows
    if (end.x < layout_.low_m.x - far || end.x > layout_.high_m.x + far || end.y < layout_.low_m.y - far ||
        end.y > layout_.high_m.y + far) {
      // outside and leaving: only bodies could be there, and those that left the layout are few
      for (int b = 0; b < bodies(); ++b) {
        if (b != skip_robot) try_one({b, true}, placed(b, at));
      }
      break;
    }
    from = to;
  }
  double floor_m = ray.dir.z < -1e-9 ? -ray.from.z / ray.dir.z : 1e300;
  if (floor_m < 0) floor_m = 1e300;
  Vec3 floor_normal{0, 0, 1};
  int ramp = -1;
  if (layout_.ground.has_ramps()) {
    double ramp_m = std::min(floor_m, nearest);
    ramp = layout_.ground.cast(ray, ramp_m, &floor_normal);
    if (ramp >= 0) floor_m = ramp_m;
  }
  const bool on_floor = floor_m >= 0 && floor_m < nearest;
  if (what.index < 0 && !on_floor) return false;
  if (!hit) return true;
  hit->distance_m = on_floor ? floor_m : nearest;
  hit->point_m = {ray.from.x + hit->distance_m * ray.dir.x, ray.from.y + hit->distance_m * ray.dir.y,
                  ray.from.z + hit->distance_m * ray.dir.z};
  hit->floor = on_floor;
  hit->normal = on_floor ? floor_normal : best;
  hit->surface = !on_floor   ? surface(what)
                 : ramp >= 0 ? surface_of(world_.ramps[static_cast<std::size_t>(ramp)].material)
                             : floor({hit->point_m.x, hit->point_m.y});
  hit->robot = !on_floor && what.moving && what.index < robots_ ? what.index : -1;
  return true;
}

void Scene::publish(const std::vector<BodyState>& states, double moved_m) {
  states_ = states;
  ++tick_;
  ++version_;
  last_slot_ = last_slot_ + 1 == slots_ ? 0 : last_slot_ + 1;
  for (std::size_t i = 0; i < states_.size(); ++i) note_state(i);
  moved_[static_cast<std::size_t>(last_slot_)] = moved_m;
  if (neighbours_.note_motion(moved_m)) regather();
}

void Scene::relocate(int body, const BodyState& state) {
  const std::size_t i = static_cast<std::size_t>(body);
  states_[i] = state;
  ++version_;
  std::fill_n(history_.begin() + static_cast<std::ptrdiff_t>(i) * slots_, slots_, Past{state.pose, {}, 0});
  note_state(i);
  regather();
}

void Scene::set_state(int body, const BodyState& state) {
  states_[static_cast<std::size_t>(body)] = state;
  note_state(static_cast<std::size_t>(body));
  ++version_;
}

void Scene::set_colour(const Candidate& what, const Colour& colour) {
  Surface& surface =
      (what.moving ? layout_.moving_surface : layout_.fixed_surface)[static_cast<std::size_t>(what.index)];
  surface.colour = colour;
  surface.ir_reflectance = colour.r;
  ++version_;
}

void Scene::set_lamp(int lamp, bool on, double intensity_w_m2, Vec3 position_m) {
  LampDesc& l = world_.lamps[static_cast<std::size_t>(lamp)];
  l.on = on;
  l.intensity_w_m2 = intensity_w_m2;
  l.position_m = position_m;
  ++version_;
}

void Scene::set_proximity_noise(int robot, double scale) {
  RobotDesc& r = world_.robots[static_cast<std::size_t>(robot)];
  r.proximity.noise_scale = scale;
  for (SensorDesc& sensor : r.sensors) sensor.proximity.noise_scale = scale;
  ++version_;
}

void Scene::regather() {
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    moving_[i].z_m = states_[i].z_m;
    if (moving_[i].solid->kind == SolidKind::Prism) {
      moving_[i].frame = Frame2(states_[i].pose);
    } else {
      moving_[i].frame.at = {states_[i].pose.x_m, states_[i].pose.y_m};
    }
  }
  double history_m = 0;
  for (double m : moved_) history_m += m;
  neighbours_.rebuild(moving_, history_m);
}

}  // namespace sim
