// SPDX-License-Identifier: MIT
// A depth buffer over the grid. For each solid in view: which columns it covers; per column where the upright
// plane enters and leaves its footprint; per pixel whether side, top or underside is met, and how deep.
#include "sim_core/camera/camera.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim_core/world/scene.h"

namespace sim {
namespace {

constexpr double kNearM = 1e-4;  // nothing nearer to the lens is seen
constexpr double kFarM = 1e30;

constexpr std::int32_t kNothing = -1;
constexpr std::int32_t kFloor = -2;

// which part of a solid a pixel shows: a side's number, or
constexpr std::int16_t kTop = -1;
constexpr std::int16_t kUnderside = -2;
constexpr std::int16_t kCurved = -3;

/// A solid that may be in view.
struct Item {
  Placed placed;
  const Surface* surface = nullptr;
  int robot = -1;
};

struct Pixel {
  double depth_m = kFarM;
  std::int32_t item = kNothing;
  std::int16_t face = 0;
};

/// Where an upright plane meets a footprint: depths of entry and exit, and the side it enters by.
struct Crossing {
  double in_m = -kFarM;
  double out_m = kFarM;
  std::int16_t side = kCurved;
};

class Renderer {
 public:
  Renderer(const Scene& scene, int robot, const Vec3& eye_m, Clicks at, const std::vector<double>& right,
           const std::vector<double>& up)
      : scene_(scene), robot_(robot), at_(at), right_(right), up_(up) {
    const Frame2 body(scene.pose(robot, at));
    eye_ = body.to_world({eye_m.x, eye_m.y});
    eye_z_ = eye_m.z + scene.state(robot).z_m;
    ahead_ = {body.c, body.s};
    rightward_ = {body.s, -body.c};
    const auto [least, most] = std::minmax_element(right.begin(), right.end());
    least_right_ = *least;
    most_right_ = *most;
    pixels_.assign(right.size() * up.size(), Pixel{});
    items_.clear();
  }

  void run(std::vector<Light>& out) {
    lay_floor();
    const Layout& layout = scene_.layout();
    for (std::size_t i = 0; i < layout.fixed.size(); ++i)
      draw({layout.fixed[i], &layout.fixed_surface[i], -1});
    for (int b = 0; b < scene_.bodies(); ++b) {
      if (b == robot_ || !may_see(b)) continue;
      draw({scene_.placed(b, at_), &layout.moving_surface[static_cast<std::size_t>(b)],
            b < scene_.robots() ? b : -1});
    }
    shade(out);
    draw_lamps(out);
  }

 private:
  std::size_t columns() const { return right_.size(); }

  void lay_floor() {
    for (std::size_t row = 0; row < up_.size(); ++row) {
      if (up_[row] >= 0) continue;
      const double depth = eye_z_ / -up_[row];
      for (std::size_t c = 0; c < columns(); ++c) pixels_[row * columns() + c] = {depth, kFloor, kTop};
    }
  }

  /// False when a moving body is surely behind the lens or beside the picture; a cheap test on its state.
  bool may_see(int body) const {
    const Pose2& p = scene_.state(body).pose;
    // poses are asked for within a few ticks of the last one: 5 cm cover what moves meanwhile
    const double r = scene_.layout().moving[static_cast<std::size_t>(body)].solid->bound_m + 0.05;
    const Vec2 rel{p.x_m - eye_.x, p.y_m - eye_.y};
    const double ahead = dot(rel, ahead_), side = dot(rel, rightward_);
    if (ahead < -r) return false;
    if (ahead <= r) return true;
    return !(side - r > 0 && side - r > most_right_ * (ahead + r)) &&
           !(side + r < 0 && side + r < least_right_ * (ahead + r));
  }

  /// Range of columns' tangents that a solid can cover; false when it is out of the picture.
  bool extent(const Placed& what, double& low, double& high) const {
    low = kFarM;
    high = -kFarM;
    const Solid& s = *what.solid;
    // A prism lies between its corners; with one behind the camera it may reach anywhere.
    if (s.kind == SolidKind::Prism) {
      bool behind = false, before = false;
      double corner_low = kFarM, corner_high = -kFarM;
      for (const Vec2& corner : s.outline) {
        const Vec2 rel = what.frame.to_world(corner) - eye_;
        const double ahead = dot(rel, ahead_);
        if (ahead <= kNearM) {
          behind = true;
          continue;
        }
        before = true;
        const double tangent = dot(rel, rightward_) / ahead;
        corner_low = std::min(corner_low, tangent);
        corner_high = std::max(corner_high, tangent);
      }
      if (!before) return false;
      low = behind ? -kFarM : corner_low;
      high = behind ? kFarM : corner_high;
    } else {
      // Round solids: between both tangents, or anywhere when the camera is as near.
      const Vec2 rel = what.frame.at - eye_;
      const double ahead = dot(rel, ahead_), side = dot(rel, rightward_), r = s.radius_m;
      if (ahead + r <= kNearM) return false;
      if (ahead - r <= kNearM) {
        low = -kFarM, high = kFarM;
      } else {
        low = (side - r) / (side > r ? ahead + r : ahead - r);
        high = (side + r) / (side < -r ? ahead + r : ahead - r);
      }
    }
    // rounding may not cost a pixel
    low -= 1e-9 * (1 + std::fabs(low));
    high += 1e-9 * (1 + std::fabs(high));
    return low <= most_right_ && high >= least_right_;
  }

  void draw(const Item& item) {
    double low, high;
    if (!extent(item.placed, low, high)) return;
    const std::int32_t number = static_cast<std::int32_t>(items_.size());
    items_.push_back(item);
    const Solid& s = *item.placed.solid;
    const Vec2 from = item.placed.frame.to_local(eye_);
    const Vec2 ahead = item.placed.frame.turn_back(ahead_);
    const Vec2 rightward = item.placed.frame.turn_back(rightward_);
    for (std::size_t c = 0; c < columns(); ++c) {
      if (right_[c] < low || right_[c] > high) continue;
      const Vec2 dir = ahead + right_[c] * rightward;
      if (s.kind == SolidKind::Ball) {
        draw_ball(number, c, from, dir);
        continue;
      }
      Crossing x;
      if (!(s.kind == SolidKind::Prism ? cross_prism(s, from, dir, x) : cross_circle(s, from, dir, x)))
        continue;
      draw_column(number, c, x, item.placed.z_m + s.z0_m - eye_z_, item.placed.z_m + s.z1_m - eye_z_);
    }
  }

  static bool cross_prism(const Solid& s, Vec2 from, Vec2 dir, Crossing& x) {
    for (std::size_t i = 0; i < s.sides.size(); ++i) {
      const double room = s.sides[i].offset_m - dot(s.sides[i].normal, from);
      const double rate = dot(s.sides[i].normal, dir);
      if (rate == 0) {
        if (room < 0) return false;
        continue;
      }
      const double t = room / rate;
      if (rate > 0) {
        x.out_m = std::min(x.out_m, t);
      } else if (t > x.in_m) {
        x.in_m = t;
        x.side = static_cast<std::int16_t>(i);
      }
      if (x.in_m > x.out_m) return false;
    }
    return x.out_m > kNearM;
  }

  static bool cross_circle(const Solid& s, Vec2 from, Vec2 dir, Crossing& x) {
    const double a = dot(dir, dir), b = dot(from, dir), c = dot(from, from) - s.radius_m * s.radius_m;
    const double under = b * b - a * c;
    if (under < 0) return false;
    const double root = std::sqrt(under);
    x.in_m = (-b - root) / a;
    x.out_m = (-b + root) / a;
    return x.out_m > kNearM;
  }

  /// One column of an upright solid between two heights over the eye.
  void draw_column(std::int32_t item, std::size_t column, const Crossing& x, double bottom_m, double top_m) {
    const double first_m = std::max(x.in_m, kNearM);
    for (std::size_t row = 0; row < up_.size(); ++row) {
      Pixel& pixel = pixels_[row * columns() + column];
      if (pixel.depth_m <= first_m) continue;
      const double v = up_[row];
      const double rise = v * first_m;
      if (rise >= bottom_m && rise <= top_m) {
        // from inside nothing is seen of a solid
        if (x.in_m >= kNearM) pixel = {x.in_m, item, x.side};
        continue;
      }
      const bool over = rise > top_m;
      if (over ? v >= 0 : v <= 0) continue;
      const double depth = (over ? top_m : bottom_m) / v;
      if (depth < x.out_m && depth < pixel.depth_m) pixel = {depth, item, over ? kTop : kUnderside};
    }
  }

  void draw_ball(std::int32_t item, std::size_t column, Vec2 from, Vec2 dir) {
    const Placed& what = items_[static_cast<std::size_t>(item)].placed;
    const double r = what.solid->radius_m;
    const double below = eye_z_ - (what.z_m + what.solid->z0_m + r);
    const double plan = dot(dir, dir), b0 = dot(from, dir);
    const double c = dot(from, from) + below * below - r * r;
    if (c < 0) return;
    for (std::size_t row = 0; row < up_.size(); ++row) {
      const double v = up_[row];
      const double a = plan + v * v, b = b0 + below * v;
      const double under = b * b - a * c;
      if (under < 0 || b > 0) continue;
      const double depth = (-b - std::sqrt(under)) / a;
      Pixel& pixel = pixels_[row * columns() + column];
      if (depth >= kNearM && depth < pixel.depth_m) pixel = {depth, item, kCurved};
    }
  }

  // --- light

  Vec3 point_of(const Pixel& pixel, std::size_t row, std::size_t column) const {
    const Vec2 p = eye_ + pixel.depth_m * (ahead_ + right_[column] * rightward_);
    return {p.x, p.y, eye_z_ + pixel.depth_m * up_[row]};
  }

  Vec3 normal_of(const Pixel& pixel, const Vec3& point) const {
    if (pixel.face == kTop) return {0, 0, 1};
    if (pixel.face == kUnderside) return {0, 0, -1};
    const Placed& what = items_[static_cast<std::size_t>(pixel.item)].placed;
    if (pixel.face != kCurved) {
      const Vec2 n = what.frame.turn(what.solid->sides[static_cast<std::size_t>(pixel.face)].normal);
      return {n.x, n.y, 0};
    }
    const double k = 1 / what.solid->radius_m;
    const Vec2 n = k * (Vec2{point.x, point.y} - what.frame.at);
    if (what.solid->kind == SolidKind::Cylinder) return {n.x, n.y, 0};
    return {n.x, n.y, k * (point.z - what.z_m - what.solid->z0_m) - 1};
  }

  Colour light_on(const Vec3& point, const Vec3& normal) const {
    const WorldDesc& world = scene_.world();
    const double even = world.sky.light_w_m2 * (kSkyShare + (1 - kSkyShare) * normal.z);
    Colour e{even, even, even};
    for (const LampDesc& lamp : world.lamps) {
      if (!lamp.on) continue;
      const Vec3 to{lamp.position_m.x - point.x, lamp.position_m.y - point.y, lamp.position_m.z - point.z};
      const double facing = to.x * normal.x + to.y * normal.y + to.z * normal.z;
      if (facing <= 0) continue;
      const double d = std::sqrt(to.x * to.x + to.y * to.y + to.z * to.z);
      const std::array<double, 3>& a = lamp.attenuation;
      const double k = lamp.intensity_w_m2 * facing / (d * (a[0] + a[1] * d + a[2] * d * d));
      e.r += k * lamp.colour.r;
      e.g += k * lamp.colour.g;
      e.b += k * lamp.colour.b;
    }
    return e;
  }

  /// What lit LEDs add where they are seen on a robot's body.
  void add_leds(const Item& item, const Vec3& point, Light& light) const {
    const std::uint32_t lit = scene_.leds.of(item.robot);
    if (lit == 0) return;
    const RobotModel& model =
        *scene_.world().model_of(scene_.world().robots[static_cast<std::size_t>(item.robot)]);
    const Frame2 body(scene_.pose(item.robot, at_));
    const Vec2 local = body.to_local({point.x, point.y});
    const auto add = [&](const Colour& colour, double glow) {
      light.r += static_cast<float>(glow * colour.r);
      light.g += static_cast<float>(glow * colour.g);
      light.b += static_cast<float>(glow * colour.b);
    };
    for (std::size_t i = 0; i < model.leds.size() && i < 32; ++i) {
      if (!(lit >> i & 1u)) continue;
      const LedMount& led = model.leds[i];
      const double out = length(led.at_m);
      if (out < led.spot_m) {  // in the middle: it lights the body from inside
        const double half = item.placed.z_m + 0.5 * (model.body_z0_m + model.body_height_m);
        if (point.z < half) add(led.colour, kBodyLedGlow);
        continue;
      }
      // its window is where the line from the robot's middle through it leaves the body
      const Vec2 window = (model.body_radius_m / out) * led.at_m;
      const Vec2 off = local - window;
      const double over = point.z - item.placed.z_m - led.z_m;
      if (dot(off, off) + over * over < led.spot_m * led.spot_m) add(led.colour, kLedGlow);
    }
  }

  static Light times(const Colour& colour, const Colour& e) {
    return {static_cast<float>(colour.r * e.r), static_cast<float>(colour.g * e.g),
            static_cast<float>(colour.b * e.b)};
  }

  void shade(std::vector<Light>& out) const {
    const WorldDesc& world = scene_.world();
    const double k = world.sky.light_w_m2;
    const Light sky = times(world.sky.colour, {k, k, k});
    bool lamps = false;
    for (const LampDesc& lamp : world.lamps) lamps = lamps || lamp.on;
    const bool picture = !world.floor.image_rgb.empty();
    const Light plain_floor = times(world.floor.colour, {k, k, k});
    // under the sky alone a face's light depends on its slope only
    std::vector<Light>& upright = upright_;
    upright.clear();
    if (!lamps) {
      const double even = k * kSkyShare;
      for (const Item& item : items_) upright.push_back(times(item.surface->colour, {even, even, even}));
    }
    out.resize(pixels_.size());
    for (std::size_t row = 0, i = 0; row < up_.size(); ++row) {
      for (std::size_t column = 0; column < columns(); ++column, ++i) {
        const Pixel& pixel = pixels_[i];
        // What takes no computing: sky, floor and upright faces without lamps.
        if (pixel.item == kNothing) {
          out[i] = sky;
          continue;
        }
        if (pixel.item == kFloor) {
          if (!lamps && !picture) {
            out[i] = plain_floor;
            continue;
          }
          const Vec3 point = point_of(pixel, row, column);
          const Colour colour = picture ? floor_at(world, {point.x, point.y}).colour : world.floor.colour;
          out[i] = times(colour, lamps ? light_on(point, {0, 0, 1}) : Colour{k, k, k});
          continue;
        }
        const Item& item = items_[static_cast<std::size_t>(pixel.item)];
        const bool glows = item.robot >= 0 && scene_.leds.of(item.robot) != 0;
        const bool is_upright =
            pixel.face >= 0 || (pixel.face == kCurved && item.placed.solid->kind == SolidKind::Cylinder);
        if (!lamps && is_upright && !glows) {
          out[i] = upright[static_cast<std::size_t>(pixel.item)];
          continue;
        }
        // All else by the light on that very point.
        const Vec3 point = point_of(pixel, row, column);
        out[i] = times(item.surface->colour, light_on(point, normal_of(pixel, point)));
        if (glows) add_leds(item, point, out[i]);
      }
    }
  }

  /// Discs parallel to the picture, so they are discs in it too.
  void draw_lamps(std::vector<Light>& out) const {
    for (const LampDesc& lamp : scene_.world().lamps) {
      if (!lamp.on) continue;
      const Vec2 rel{lamp.position_m.x - eye_.x, lamp.position_m.y - eye_.y};
      const double depth = dot(rel, ahead_);
      if (depth <= kNearM) continue;
      const double u = dot(rel, rightward_) / depth, v = (lamp.position_m.z - eye_z_) / depth;
      const double r = kLampRadiusM / depth;
      const double glow = kLampGlow * lamp.intensity_w_m2;
      const Light light = times(lamp.colour, {glow, glow, glow});
      for (std::size_t row = 0; row < up_.size(); ++row) {
        const double dv = up_[row] - v;
        if (dv * dv >= r * r) continue;
        for (std::size_t column = 0; column < columns(); ++column) {
          const double du = right_[column] - u;
          const std::size_t i = row * columns() + column;
          if (du * du + dv * dv < r * r && depth < pixels_[i].depth_m) out[i] = light;
        }
      }
    }
  }

  const Scene& scene_;
  int robot_;
  Clicks at_;
  const std::vector<double>& right_;
  const std::vector<double>& up_;
  Vec2 eye_, ahead_, rightward_;
  double eye_z_ = 0;
  double least_right_ = 0, most_right_ = 0;
  // scratch memory of this thread, so that a picture allocates nothing
  static thread_local std::vector<Pixel> pixels_;
  static thread_local std::vector<Item> items_;
  static thread_local std::vector<Light> upright_;
};

thread_local std::vector<Pixel> Renderer::pixels_;
thread_local std::vector<Item> Renderer::items_;
thread_local std::vector<Light> Renderer::upright_;

}  // namespace

void render_camera(const Scene& scene, int robot, const Vec3& eye_m, Clicks at,
                   const std::vector<double>& right, const std::vector<double>& up, std::vector<Light>& out) {
  out.clear();
  if (right.empty() || up.empty()) return;
  Renderer(scene, robot, eye_m, at, right, up).run(out);
}

void watch_leds(const Scene& scene) { scene.leds.watch(); }

}  // namespace sim
