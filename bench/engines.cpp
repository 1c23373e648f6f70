// SPDX-License-Identifier: MIT
// Speed and statistics of the obstacle controller: the same world, the same robots, one engine after the
// other in each round. The world's share is timed by playing back each engine's own wheel angles without
// minds, as bench.cpp does. Behaviour: small scenes in which wheels turn at constant speeds.
#include "bench/engines.h"
#include "hal_sim/twin/world_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "bench/median.h"
#include "bench/playback.h"
#include "sim_core/load/world_loader.h"
#include "tests/support/cruise.h"

namespace bench {
namespace {

struct NamedEngine {
  const char* name;
  sim::Engine engine;
};
constexpr NamedEngine kEngines[] = {{"dynamic", sim::Engine::Dynamic},
                                    {"kinematic", sim::Engine::Kinematic},
                                    {"planar", sim::Engine::Planar}};
constexpr double kMeasuredS = 20, kObservedS = 120;

/// What robots did, per robot and minute.
struct Conduct {
  double way_m = 0, collisions = 0, touch_s = 0, longest_wall_s = 0, pushed_m = 0;
};

sim::WorldDesc first_robots(sim::WorldDesc world, int robots, sim::Engine engine) {
  world.engine = engine;
  world.robots.resize(static_cast<std::size_t>(robots));
  return world;
}

Conduct observe(const sim::WorldDesc& world) {
  auto twin = open_twin(world);
  const sim::Simulation& s = twin->simulation();
  const int n = s.robots();
  std::vector<sim::Pose2> before;
  for (int b = n; b < n + 2; ++b) before.push_back(s.pose(b));
  twin->simulation().run_until(sim::from_seconds(kObservedS));
  Conduct c;
  const double share = 60 / (kObservedS * n);
  for (int r = 0; r < n; ++r) {
    c.way_m += share * s.distance_m(r);
    c.collisions += share * s.touches(r).collisions;
    c.touch_s += share * s.touches(r).touch_s;
    c.longest_wall_s = std::max(c.longest_wall_s, s.touches(r).longest_wall_touch_s);
  }
  for (int b = n; b < n + 2; ++b) {
    const sim::Pose2 &p = s.pose(b), &q = before[static_cast<std::size_t>(b - n)];
    c.pushed_m += sim::length({p.x_m - q.x_m, p.y_m - q.y_m});
  }
  return c;
}

/// A scene of a few lines with one engine; robot 0 drives at `rad_s` on both wheels, others stand.
std::unique_ptr<sim::Simulation> scene(const NamedEngine& engine, const std::string& text, double rad_s) {
  const auto loaded =
      sim::parse_world("twinpuck = 1\n[world]\nengine = \"" + std::string(engine.name) + "\"\n" + text,
                       "scene", twin::robot_models());
  if (!loaded.world) {
    std::fprintf(stderr, "%s\n", loaded.report("scene").c_str());
    std::exit(2);
  }
  std::vector<std::unique_ptr<sim::RobotMind>> minds;
  for (std::size_t r = 0; r < loaded.world->robots.size(); ++r) {
    minds.push_back(std::make_unique<sim_test::Cruise>(r ? 0 : rad_s, r ? 0 : rad_s));
  }
  return std::make_unique<sim::Simulation>(*loaded.world, std::move(minds));
}

/// Ways in mm of a body after some seconds.
double moved_mm(const NamedEngine& e, const std::string& text, int body, double seconds,
                bool along_y = false) {
  auto s = scene(e, text, sim::kPi);  // 500 steps/s, 64.4 mm/s
  const sim::Pose2 from = s->pose(body);
  s->run_until(sim::from_seconds(seconds));
  return 1000 * (along_y ? s->pose(body).y_m - from.y_m : s->pose(body).x_m - from.x_m);
}

double highest_after_mm(const NamedEngine& e, double from_s, double to_s) {
  auto s =
      scene(e, "[[ball]]\nposition = [0, 0]\nradius = 0.02\nz = 0.1\nmovable = true\nrestitution = 0.5\n", 0);
  double top = 0;
  while (s->now() < sim::from_seconds(to_s)) {
    s->step();
    if (s->now() > sim::from_seconds(from_s)) top = std::max(top, s->state(0).z_m);
  }
  return 1000 * top;
}

void print_row(const char* what, double (*measure)(const NamedEngine&)) {
  std::printf("%-58s", what);
  for (const NamedEngine& e : kEngines) std::printf(" %10.1f", measure(e));
  std::printf("\n");
}

constexpr const char* kBox =
    "position = [0.1, 0]\nsize = [0.06, 0.06, 0.05]\nmovable = true\nfriction = 0.5\n";
constexpr const char* kRobot = "[[robot]]\n";

void print_behaviour() {
  std::printf("\nbehaviour, mm; a robot at 64.4 mm/s for 5 s (322 mm) unless something else is said\n%-58s",
              "");
  for (const NamedEngine& e : kEngines) std::printf(" %10s", e.name);
  std::printf("\n");
  print_row("way of the robot, nothing near", [](const NamedEngine& e) { return moved_mm(e, kRobot, 0, 5); });
  print_row("way of a box of 30 g pushed, 33 mm ahead", [](const NamedEngine& e) {
    return moved_mm(e, std::string("[[box]]\nmass = 0.03\n") + kBox + kRobot, 1, 5);
  });
  print_row("way of a box of 1 kg pushed, 33 mm ahead", [](const NamedEngine& e) {
    return moved_mm(e, std::string("[[box]]\nmass = 1\n") + kBox + kRobot, 1, 5);
  });
  print_row("way of a ball hit 43 mm ahead, restitution 0.5", [](const NamedEngine& e) {
    return moved_mm(e,
                    std::string("[[ball]]\nposition = [0.1, 0]\nradius = 0.02\nmovable = true\nmass = 0.02\n"
                                "restitution = 0.5\n") +
                        kRobot,
                    1, 5);
  });
  print_row("way of a standing robot that is pushed, 26 mm ahead", [](const NamedEngine& e) {
    return moved_mm(e, "[[robot]]\n[[robot]]\nposition = [0.1, 0]\n", 1, 5);
  });
  print_row("way along a wall met at 60 degrees after 126 mm", [](const NamedEngine& e) {
    return moved_mm(e, "[[wall]]\npoints = [[0.105, -1], [0.105, 1]]\n[[robot]]\nheading = 60\n", 0, 5, true);
  });
  print_row("way under a bar 60 mm high, 138 mm ahead", [](const NamedEngine& e) {
    return moved_mm(e, "[[wall]]\npoints = [[0.18, -1], [0.18, 1]]\nz = 0.06\nheight = 0.05\n[[robot]]\n", 0,
                    5);
  });
  print_row("top of the first bounce from 100 mm, restitution 0.5",
            [](const NamedEngine& e) { return highest_after_mm(e, 0.15, 0.3); });
  print_row("top of the second bounce", [](const NamedEngine& e) { return highest_after_mm(e, 0.29, 0.35); });
}

}  // namespace

int compare_engines(const std::string& worlds, int rounds) {
  const auto loaded = twin::load_world(worlds + "/engines.toml");
  if (!loaded.world) {
    std::fprintf(stderr, "%s\n", loaded.report("engines world").c_str());
    return 2;
  }
  std::printf(
      "simulated seconds per second, controller obstacle, medians of %d rounds, engines in turn\n"
      "wall: by the clock; processor: per second of processor time, the clock of an idle machine; world "
      "only: the\n"
      "same motion without firmware and boards, processor time; the rest in %.0f s, per robot and minute; "
      "pushed:\n"
      "both discs, all together\n",
      rounds, kObservedS);
  std::printf("%6s %-9s %7s %9s %10s %7s %10s %8s %12s %8s\n", "robots", "engine", "wall", "processor",
              "world only", "way m", "collisions", "touch s", "longest wall", "pushed m");
  bool faster = true;
  for (const int n : {1, 5, 10}) {
    std::vector<double> wall[3], speed[3], world_speed[3];
    std::vector<WheelTrack> tracks;
    for (const NamedEngine& e : kEngines) {
      tracks.push_back(track_wheels(first_robots(*loaded.world, n, e.engine), kMeasuredS + 1));
    }
    for (int round = 0; round < rounds; ++round) {
      for (int k = 0; k < 3; ++k) {
        const sim::WorldDesc world = first_robots(*loaded.world, n, kEngines[k].engine);
        auto twin = open_twin(world);
        const Speed whole = timed_speed(twin->simulation(), 1, kMeasuredS);
        wall[k].push_back(whole.wall);
        speed[k].push_back(whole.processor);
        auto played = play_back(world, tracks[static_cast<std::size_t>(k)]);
        world_speed[k].push_back(timed_speed(*played, 1, kMeasuredS).processor);
      }
    }
    for (int k = 0; k < 3; ++k) {
      const Conduct c = observe(first_robots(*loaded.world, n, kEngines[k].engine));
      std::printf("%6d %-9s %7.0f %9.0f %10.0f %7.2f %10.1f %8.2f %12.2f %8.3f\n", n, kEngines[k].name,
                  median(wall[k]), median(speed[k]), median(world_speed[k]), c.way_m, c.collisions, c.touch_s,
                  c.longest_wall_s, c.pushed_m);
      std::fflush(stdout);
    }
    faster = faster && median(world_speed[2]) > median(world_speed[0]);
  }
  print_behaviour();
  std::printf("%s\n", faster ? "planar is faster than dynamic in every line (world only)"
                             : "planar was not faster than dynamic in this run (world only)");
  return faster ? 0 : 1;
}

}  // namespace bench
