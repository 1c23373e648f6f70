// SPDX-License-Identifier: MIT
// The legs of each body are a ring.
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

Scene::Scene(WorldDesc world, std::vector<double> reach_m)
    : world_(std::move(world)),
      layout_(build_layout(world_)),
      robots_(static_cast<int>(world_.robots.size())),
      tick_clicks_(kClicksPerSecond / world_.physics_hz),
      tick_s_(to_seconds(tick_clicks_)),
      slots_(static_cast<int>(std::ceil(kHistoryS * world_.physics_hz)) + 2),
      moving_(layout_.moving),
      neighbours_(std::in_place, layout_.fixed, bounds_of(layout_), robots_, std::move(reach_m)) {
  CHECK(tick_clicks_ * world_.physics_hz == kClicksPerSecond, "the tick rate divides the click rate");
  const std::size_t bodies = layout_.moving.size();
  legs_.resize(bodies * static_cast<std::size_t>(slots_));
  newest_.resize(bodies);
  heights_.resize(bodies);
  for (int i = 0; i < static_cast<int>(bodies); ++i) {
    const std::size_t b = static_cast<std::size_t>(i);
    relocate(i, {0, layout_.moving_pose[b], {}, 0, false}, layout_.moving[b].z_m);
  }
  regather(0);
}

inline const Leg& Scene::leg_at(int body, Clicks at, const Leg** next) const {
  const Leg* ring = legs_.data() + static_cast<std::size_t>(body) * static_cast<std::size_t>(slots_);
  const Leg& newest = ring[newest_[static_cast<std::size_t>(body)]];
  if (newest.from > at) return older_leg(body, at, next);
  if (next) *next = nullptr;
  return newest;
}

// usually the one before; otherwise no more than ticks ago, for legs do not begin more often
const Leg& Scene::older_leg(int body, Clicks at, const Leg** next) const {
  const Leg* ring = legs_.data() + static_cast<std::size_t>(body) * static_cast<std::size_t>(slots_);
  const int newest = newest_[static_cast<std::size_t>(body)];
  const auto slot_of = [&](int back) { return newest >= back ? newest - back : newest - back + slots_; };
  int back = 1;
  if (ring[slot_of(1)].from > at) {
    const Clicks ticks = (ring[slot_of(1)].from - at + tick_clicks_ - 1) / tick_clicks_;
    back = static_cast<int>(std::min<Clicks>(slots_ - 1, 1 + ticks));
    while (ring[slot_of(back - 1)].from <= at) --back;
  }
  if (next) *next = ring + slot_of(back - 1);
  return ring[slot_of(back)];
}

Pose2 Scene::pose(int body, Clicks at) const {
  const Leg& leg = leg_at(body, at);
  return leg.pose_at(std::max(at, leg.from));
}

Pose2 Scene::pose_on_way(int body, Clicks at) const {
  if (at >= now_) return pose(body, now_);
  const Leg* next;
  const Leg& leg = leg_at(body, at, &next);
  Pose2 p = leg.pose_at(std::max(at, leg.from));
  // what the next leg corrected came about in the tick before it
  const double part = next ? 1 - static_cast<double>(next->from - at) / static_cast<double>(tick_clicks_) : 0;
  if (part <= 0 || at <= leg.from) return p;
  const Pose2 end = leg.pose_at(next->from);
  return {p.x_m + part * (next->pose.x_m - end.x_m), p.y_m + part * (next->pose.y_m - end.y_m),
          p.heading_rad + part * (next->pose.heading_rad - end.heading_rad)};
}

BodyState Scene::state(int body) const {
  const Leg& leg = leg_at(body, now_);
  const Height& height = heights_[static_cast<std::size_t>(body)];
  return {leg.pose_at(std::max(now_, leg.from)), height.z_m, leg.velocity_at(now_), leg.spin_rad_s,
          height.climb_m_s};
}

Placed Scene::placed(int body, Clicks at) const {
  const std::size_t i = static_cast<std::size_t>(body);
  return placed_at(*layout_.moving[i].solid, pose(body, at), heights_[i].z_m);
}

bool Scene::cast(const Ray& ray, double limit_m, int skip_robot, Clicks at, SceneHit* hit) const {
  // The nearest body, with the unit vector out of its surface.
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
    neighbours_->gather({ray.from.x + middle * ray.dir.x, ray.from.y + middle * ray.dir.y},
                        0.5 * piece_m + kSkinM, around);
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
  // The floor, and ramps on it, may be nearer.
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
  // What was met there.
  if (!hit) return true;
  hit->distance_m = on_floor ? floor_m : nearest;
  hit->point_m = {ray.from.x + hit->distance_m * ray.dir.x, ray.from.y + hit->distance_m * ray.dir.y,
                  ray.from.z + hit->distance_m * ray.dir.z};
  hit->floor = on_floor;
  hit->normal = on_floor ? floor_normal : best;
  hit->surface = !on_floor   ? surface_of(layout_, what)
                 : ramp >= 0 ? surface_of(world_.ramps[static_cast<std::size_t>(ramp)].material)
                             : floor_at(world_, {hit->point_m.x, hit->point_m.y});
  hit->robot = !on_floor && what.moving && what.index < robots_ ? what.index : -1;
  return true;
}

void Scene::advance_to(Clicks tick) {
  now_ = tick;
  ++version_;
}

void Scene::begin_leg(int body, const Leg& leg, double z_m, double climb_m_s) {
  const std::size_t i = static_cast<std::size_t>(body);
  Leg* ring = legs_.data() + i * static_cast<std::size_t>(slots_);
  int& slot = newest_[i];
  if (ring[slot].from < leg.from) slot = slot + 1 == slots_ ? 0 : slot + 1;
  ring[slot] = leg;
  heights_[i] = {z_m, climb_m_s};
  ++version_;
}

void Scene::relocate(int body, const Leg& leg, double z_m) {
  const std::size_t i = static_cast<std::size_t>(body);
  std::fill_n(legs_.begin() + static_cast<std::ptrdiff_t>(i) * slots_, slots_, leg);
  begin_leg(body, leg, z_m, 0);
}

void Scene::forget_history() {
  for (int i = 0; i < bodies(); ++i) {
    const BodyState s = state(i);
    const Leg leg{now_, s.pose, s.velocity_m_s, s.spin_rad_s, false};
    relocate(i, leg, s.z_m);
    begin_leg(i, leg, s.z_m, s.climb_m_s);
  }
  leds.forget();
}

void Scene::refurnish(const WorldDesc& world, const std::vector<int>& before, std::vector<double> reach_m) {
  const std::vector<Leg> legs = std::move(legs_);
  const std::vector<int> newest = std::move(newest_);
  const std::vector<Height> heights = std::move(heights_);
  world_ = world;
  layout_ = build_layout(world_);
  moving_ = layout_.moving;
  const std::size_t bodies = moving_.size();
  CHECK(before.size() == bodies, "one body of before, or none, for each");
  legs_.assign(bodies * static_cast<std::size_t>(slots_), {});
  newest_.assign(bodies, 0);
  heights_.assign(bodies, {});
  for (std::size_t b = 0; b < bodies; ++b) {
    if (before[b] < 0) {
      relocate(static_cast<int>(b), {now_, layout_.moving_pose[b], {}, 0, false}, moving_[b].z_m);
      continue;
    }
    const auto was = static_cast<std::size_t>(before[b]);
    std::copy_n(legs.begin() + static_cast<std::ptrdiff_t>(was) * slots_, slots_,
                legs_.begin() + static_cast<std::ptrdiff_t>(b) * slots_);
    newest_[b] = newest[was];
    heights_[b] = heights[was];
  }
  neighbours_.emplace(layout_.fixed, bounds_of(layout_), robots_, std::move(reach_m));
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

void Scene::regather(double pace_m_s) {
  for (int i = 0; i < bodies(); ++i) moving_[static_cast<std::size_t>(i)] = placed(i, now_);
  // readers may ask for poses of the past, and of the tick to come
  neighbours_->rebuild(moving_, (kHistoryS + 2 * tick_s_) * pace_m_s, pace_m_s, now_);
}

}  // namespace sim
