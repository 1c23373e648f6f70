// SPDX-License-Identifier: MIT
// Webots lets bodies begin inside each other and pushes them apart; our loader refuses such worlds.
// Asks its check which bodies are meant and gives way: movable objects are fixed, robots step aside,
// what has no room goes.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "import/carried.h"
#include "sim_core/load/world_loader.h"

namespace wbt {
namespace {

constexpr int kObjectLine = 1'000'000;  // lines tell bodies apart while they are checked

sim::WorldDesc numbered(const Carried& c) {
  sim::WorldDesc w = c.world;
  for (std::size_t i = 0; i < w.robots.size(); ++i) w.robots[i].line = static_cast<int>(i) + 1;
  for (std::size_t i = 0; i < w.objects.size(); ++i) w.objects[i].line = kObjectLine + static_cast<int>(i);
  return w;
}

std::set<int> in_the_way(const sim::WorldDesc& w) {
  std::set<int> out;
  for (const sim::WorldProblem& p : sim::check_world(w)) out.insert(p.line);
  return out;
}

// the world around one robot, that one first
sim::WorldDesc neighbourhood(const sim::WorldDesc& all, std::size_t robot) {
  sim::WorldDesc w = all;
  const sim::Pose2 at = all.robots[robot].pose;
  const auto far = [&](double x, double y, double reach) {
    return std::max(std::abs(x - at.x_m), std::abs(y - at.y_m)) > 0.6 + reach;
  };
  w.robots = {all.robots[robot]};
  for (std::size_t i = 0; i < all.robots.size(); ++i) {
    if (i != robot && !far(all.robots[i].pose.x_m, all.robots[i].pose.y_m, 0))
      w.robots.push_back(all.robots[i]);
  }
  w.objects.clear();
  for (const sim::ObjectDesc& o : all.objects) {
    double reach = std::max({o.size_m.x, o.size_m.y, o.radius_m});
    for (const Vec2 c : o.corners_m) reach = std::max(reach, sim::length(c));
    if (!far(o.pose.x_m, o.pose.y_m, reach)) w.objects.push_back(o);
  }
  return w;
}

bool step_aside(sim::WorldDesc& all, std::size_t robot) {
  sim::WorldDesc w = neighbourhood(all, robot);
  if (static_cast<int>(w.objects.size() + w.robots.size()) > kMostNeighbours) return false;
  const sim::Pose2 begin = w.robots[0].pose;
  for (const double r : {0.01, 0.02, 0.04, 0.06, 0.08, 0.12, 0.16, 0.2, 0.3, 0.4}) {
    for (int i = 0; i < 12; ++i) {
      const double t = 2 * sim::kPi * i / 12;
      w.robots[0].pose = {as_written(begin.x_m + r * std::cos(t)), as_written(begin.y_m + r * std::sin(t)),
                          begin.heading_rad};
      if (std::max(std::abs(w.robots[0].pose.x_m), std::abs(w.robots[0].pose.y_m)) > kFarthestM) continue;
      if (!sim::has_room(w, 0)) continue;
      all.robots[robot].pose = w.robots[0].pose;
      return true;
    }
  }
  return false;
}

}  // namespace

void make_room(Carried& c, const Options& options, Report& report) {
  if (options.model.name.empty()) return;
  round_as_written(c.world);
  int moved = 0;
  // A few rounds, as whoever steps aside may be in another's way then.
  for (int round = 0; round < 6; ++round) {
    sim::WorldDesc w = numbered(c);
    const std::set<int> lines = in_the_way(w);
    if (lines.empty()) return;
    std::set<std::size_t> gone;
    for (const int line : lines) {
      if (line >= kObjectLine) {
        const std::size_t i = static_cast<std::size_t>(line - kObjectLine);
        c.world.objects[i].movable = false;
        report.add(0, c.object_from[i], "that it can be moved: it begins inside something", "it is fixed");
        continue;
      }
      const std::size_t i = static_cast<std::size_t>(line) - 1;
      if (line < 1 || i >= w.robots.size()) continue;
      const sim::Pose2 was = w.robots[i].pose;
      if (++moved <= kMostRepairs && round < 5 && step_aside(w, i)) {
        const sim::Pose2 now = w.robots[i].pose;
        c.world.robots[i].pose = now;
        report.add(0, c.robot_from[i],
                   fmt::format("its place [{:.3f}, {:.3f}] inside something", was.x_m, was.y_m),
                   fmt::format("{:.0f} cm aside", 100 * std::hypot(now.x_m - was.x_m, now.y_m - was.y_m)));
      } else {
        gone.insert(i);
        report.add(
            0, c.robot_from[i],
            fmt::format("\"{}\" has no room at [{:.3f}, {:.3f}]", c.world.robots[i].name, was.x_m, was.y_m));
      }
    }
    // Robots without room go, from the last one on.
    for (auto i = gone.rbegin(); i != gone.rend(); ++i) {
      const auto at = static_cast<std::ptrdiff_t>(*i);
      c.world.robots.erase(c.world.robots.begin() + at);
      c.robot_from.erase(c.robot_from.begin() + at);
      c.robot_parts.erase(c.robot_parts.begin() + at);
      c.robot_devices.erase(c.robot_devices.begin() + at);
    }
  }
}

}  // namespace wbt
