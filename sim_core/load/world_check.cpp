// SPDX-License-Identifier: MIT
// What no single key shows: double names, robots without a model, bodies inside each other
// (by libccd, in 3-D).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sim_core/geometry/neighbours.h"
#include "sim_core/geometry/overlap.h"
#include "sim_core/load/schema.h"
#include "sim_core/load/world_loader.h"
#include "sim_core/world/layout.h"

namespace sim {
namespace {

constexpr double kOverlapM = 0.0002;  // deeper than this counts: bodies may be placed so that they just touch

void check_names(const WorldDesc& world, std::vector<WorldProblem>& out) {
  std::map<std::string, int> lines;
  for (const RobotDesc& r : world.robots) {
    const auto [it, fresh] = lines.emplace(r.name, r.line);
    if (!fresh) {
      out.push_back(
          {r.line, 1,
           fmt::format("robot.name: got \"{}\" a second time (first on line {}), expected a name of its own",
                       r.name, it->second)});
    }
    if (r.name == "*")
      out.push_back({r.line, 1, "robot.name: got \"*\", which means every robot, expected another name"});
  }
}

/// Second names; those of a world of Webots may be given several times, as there.
void check_defs(const WorldDesc& world, std::vector<WorldProblem>& out) {
  std::map<std::string, int> lines;
  const auto look = [&](const char* path, const auto& all) {
    for (const auto& thing : all) {
      if (thing.def.empty() || thing.node > 0) continue;
      const auto [it, fresh] = lines.emplace(thing.def, thing.line);
      if (!fresh)
        out.push_back(
            {thing.line, 1,
             fmt::format("{}.def: got \"{}\" a second time (first on line {}), expected a name of its own",
                         path, thing.def, it->second)});
    }
  };
  look("robot", world.robots);
  look("supervisor", world.supervisors);
  look("object", world.objects);
}

void check_link_numbers(const WorldDesc& world, std::vector<WorldProblem>& out) {
  std::map<int, int> lines;
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    const RobotDesc& r = world.robots[i];
    const int number = r.link.number >= 0 ? r.link.number : static_cast<int>(i) + 1;
    const auto [it, fresh] = lines.emplace(number, r.line);
    if (!fresh) {
      out.push_back(
          {r.line, 1,
           fmt::format("robot.bluetooth.number: got {} a second time (first on line {}; robots without one "
                       "have their place in the file), expected a number of its own",
                       number, it->second)});
    }
  }
}

void check_models(const WorldDesc& world, const std::vector<std::size_t>& unplaced,
                  std::vector<WorldProblem>& out) {
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    const RobotDesc& r = world.robots[i];
    const RobotModel* model = world.model_of(r);
    // whoever read the file has told a model that is none
    if (!model && std::find(unplaced.begin(), unplaced.end(), i) != unplaced.end()) continue;
    if (!model) {
      out.push_back(
          {r.line, 1,
           fmt::format("robot.model: got \"{}\", expected a model that the program knows", r.model)});
    }
  }
}

/// The planar engine knows one level floor. Bodies above each other are found by check_overlaps().
void check_planar(const WorldDesc& world, std::vector<WorldProblem>& out) {
  if (world.engine != Engine::Planar) return;
  if (!world.ramps.empty()) {
    out.push_back({world.ramps.front().line, 1,
                   "ramp: got a ramp with the planar engine, expected none; engines dynamic and kinematic "
                   "know heights"});
  }
  if (world.floor.tilt_x_rad != 0 || world.floor.tilt_y_rad != 0) {
    out.push_back(
        {0, 0,
         fmt::format("floor.tilt: got [{:.4g}, {:.4g}] deg with the planar engine, expected [0, 0]; "
                     "engines dynamic and kinematic know heights",
                     degrees(world.floor.tilt_x_rad), degrees(world.floor.tilt_y_rad))});
  }
}

/// Robots and movable objects must not begin inside anything. Fixed solids may cross each other: that is how
/// walls are built. A body is reported with the first other that it meets. `only`: one body is looked at, and
/// all others count for it; negative: all, each pair once.
void check_overlaps(const WorldDesc& world, int only, std::vector<WorldProblem>& out) {
  const bool flat = world.engine == Engine::Planar;
  Layout layout = build_layout(world);
  if (flat) {
    // in two dimensions everything stands on the floor and is as high as anything else
    for (Solid& s : layout.solids) {
      if (s.kind == SolidKind::Ball) s.kind = SolidKind::Cylinder;
      s.z0_m = 0, s.z1_m = 1;
    }
    for (std::vector<Placed>* all : {&layout.moving, &layout.fixed}) {
      for (Placed& p : *all) p.z_m = 0;
    }
  }
  // Only bodies near each other are looked at.
  std::vector<double> bounds;
  for (const Placed& p : layout.moving) bounds.push_back(p.solid->bound_m);
  Neighbours near(layout.fixed, bounds, 0, {});
  near.rebuild(layout.moving, 0, 0, 0);
  const auto line_of = [&](std::size_t body) {
    const std::size_t robots = world.robots.size();
    return body < robots ? world.robots[body].line
                         : world.objects[static_cast<std::size_t>(layout.loose_object[body - robots])].line;
  };
  std::vector<Candidate> around;
  for (std::size_t i = 0; i < layout.moving.size(); ++i) {
    if (only >= 0 && i != static_cast<std::size_t>(only)) continue;
    const Placed& me = layout.moving[i];
    around.clear();
    near.gather(me.frame.at, me.solid->bound_m, around);
    for (const Candidate& c : around) {
      const std::size_t other = static_cast<std::size_t>(c.index);
      if (c.moving && (only < 0 ? other <= i : other == i)) continue;
      if (!overlaps(me, c.moving ? layout.moving[other] : layout.fixed[other], kOverlapM)) continue;
      const std::string& name = c.moving ? layout.moving_name[other] : layout.fixed_name[other];
      const int their_line = c.moving ? line_of(other) : layout.fixed_line[other];
      out.push_back({line_of(i), 1,
                     fmt::format("{}: got position [{:.4g}, {:.4g}] m inside {}{}, expected free room{}",
                                 layout.moving_name[i], me.frame.at.x, me.frame.at.y, name,
                                 their_line > 0 ? fmt::format(" (line {})", their_line) : std::string(),
                                 flat ? " (the planar engine knows no heights)" : "")});
      break;
    }
  }
}

/// Of a world with mistakes: what is known to stand where it stands.
WorldDesc placed_world(const WorldDesc& world, const std::vector<std::size_t>& unplaced) {
  WorldDesc placed = world;
  placed.robots.clear();
  for (std::size_t i = 0; i < world.robots.size(); ++i)
    if (world.model_of(world.robots[i]) && std::find(unplaced.begin(), unplaced.end(), i) == unplaced.end())
      placed.robots.push_back(world.robots[i]);
  if (world.engine == Engine::Planar) {
    placed.ramps.clear();
    placed.floor.tilt_x_rad = placed.floor.tilt_y_rad = 0;
  }
  return placed;
}

}  // namespace

std::vector<WorldProblem> check_world(const WorldDesc& world, const std::vector<std::size_t>& unplaced) {
  std::vector<WorldProblem> out;
  if (world.robots.size() > kMostRobots) {
    out.push_back(
        {0, 0, fmt::format("robot: got {} robots, expected at most {}", world.robots.size(), kMostRobots)});
    return out;
  }
  check_link_numbers(world, out);
  check_defs(world, out);
  check_names(world, out);
  check_models(world, unplaced, out);
  check_planar(world, out);
  if (out.empty() && unplaced.empty())
    check_overlaps(world, -1, out);
  else
    check_overlaps(placed_world(world, unplaced), -1, out);
  return out;
}

std::vector<WorldProblem> place_notices(const WorldDesc& world) {
  std::vector<WorldProblem> out;
  if (!world.arena) return out;
  const Vec2 size = world.arena->size_m, centre = world.arena->centre_m;
  for (const RobotDesc& r : world.robots) {
    const double dx = r.pose.x_m - centre.x, dy = r.pose.y_m - centre.y;
    if (std::abs(dx) <= size.x / 2 && std::abs(dy) <= size.y / 2) continue;
    out.push_back(
        {r.line, 1,
         fmt::format("note: {}: position [{:.4g}, {:.4g}] m is outside the arena, which is x {:.4g} "
                     "to {:.4g} m, y {:.4g} to {:.4g} m",
                     r.name, r.pose.x_m, r.pose.y_m, centre.x - size.x / 2, centre.x + size.x / 2,
                     centre.y - size.y / 2, centre.y + size.y / 2)});
  }
  return out;
}

bool has_room(const WorldDesc& world, int robot) {
  std::vector<WorldProblem> out;
  check_overlaps(world, robot, out);
  return out.empty();
}

}  // namespace sim
