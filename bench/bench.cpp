// SPDX-License-Identifier: MIT
// make bench: processor time per robot-second in the common workload (docs/dev/performance.md), ours with
// compiled firmware inside, libenki beside it, and the floor under both (floor.h), turn and turn about. Then
// the chip's core beside simavr, and what a user waits for. Exit code 1 when a promise was missed.
//
//   bench [--rounds 5] [--worlds DIR] [N ...]         only these sizes, and nothing but the workload
//   bench --engines [--rounds 5] [--worlds DIR]      the three motion engines instead (engines.cpp)
//   bench --core [--rounds 5]                         the chip's core beside simavr (core_speed.cpp)
//   bench --waits [--rounds 5]                        what a user waits for alone (latency.cpp)
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "bench/core_speed.h"
#include "bench/engines.h"
#include "bench/enki_swarm.h"
#include "bench/floor.h"
#include "bench/latency.h"
#include "bench/median.h"
#include "bench/playback.h"
#include "bench/processor_time.h"
#include "hal_sim/twin/twin.h"
#include "hal_sim/twin/world_file.h"
#include "install/places.h"

namespace {

// simulated seconds: warm-up and measured, and how many fresh scenes make a measurement of some 0.1 s
struct Span {
  double warm_s, measured_s;
  int scenes;
};
Span our_span(int robots) {
  if (robots >= 1000) return {1, 5, 1};
  return {1, 20, std::max(1, 20 / robots)};
}
Span peer_span(int robots) {
  if (robots >= 1000) return {0.192, 0.768, 1};
  return our_span(robots);
}

/// Processor time per robot-second, us. `make()` gives a fresh scene, `run(scene, s)` runs it on to s.
template <typename Make, typename Run>
double cost_us(int robots, const Span& span, Make make, Run run) {
  double used_s = 0;
  for (int i = 0; i < span.scenes; ++i) {
    auto scene = make();
    run(*scene, span.warm_s);
    const double from = bench::processor_s();
    run(*scene, span.warm_s + span.measured_s);
    used_s += bench::processor_s() - from;
  }
  return 1e6 * used_s / (span.scenes * span.measured_s * robots);
}

double our_cost_us(const sim::WorldDesc& world) {
  const int n = static_cast<int>(world.robots.size());
  return cost_us(
      n, our_span(n), [&] { return bench::open_twin(world); },
      [](twin::Twin& twin, double s) { twin.simulation().run_until(sim::from_seconds(s)); });
}

double floor_cost_us(const sim::WorldDesc& world) {
  const int n = static_cast<int>(world.robots.size());
  return cost_us(
      n, our_span(n), [&] { return std::make_unique<bench::Floor>(world); },
      [](bench::Floor& floor, double s) { floor.run_until(s); });
}

double peer_cost_us(const sim::WorldDesc& world) {
  constexpr double kStepS = 0.064;
  const int n = static_cast<int>(world.robots.size());
  double now_s = 0;
  return cost_us(
      n, peer_span(n),
      [&] {
        now_s = 0;
        return std::make_unique<bench::EnkiSwarm>(world);
      },
      [&](bench::EnkiSwarm& swarm, double s) {
        for (; now_s < s - kStepS / 2; now_s += kStepS) swarm.control_step();
      });
}

/// What a world's programs run again and again is translated once and kept for later runs. Such a run is
/// measured, whatever ran here before, so one that is not measured goes before it.
void make_translations(const sim::WorldDesc& world) {
  constexpr double kRobotSeconds = 4000;
  const double s = std::max(1.0, kRobotSeconds / static_cast<double>(world.robots.size()));
  bench::open_twin(world)->simulation().run_until(sim::from_seconds(s));
}

/// At least so many times as fast as Enki.
double promised(int robots) {
  return robots >= 1000 ? 125 : robots >= 100 ? 14 : robots >= 10 ? 3.2 : robots >= 5 ? 2.5 : 1.8;
}

}  // namespace

int main(int argc, char** argv) {
  int rounds = 5;
  std::string worlds = places::share_root().string() + "/bench/worlds";
  std::vector<int> sizes;
  bool engines = false, core = false, waits = false;
  for (int i = 1; i < argc; ++i) {
    if (!std::strcmp(argv[i], "--rounds") && i + 1 < argc)
      rounds = std::max(1, std::atoi(argv[++i]));
    else if (!std::strcmp(argv[i], "--worlds") && i + 1 < argc)
      worlds = argv[++i];
    else if (!std::strcmp(argv[i], "--engines"))
      engines = true;
    else if (!std::strcmp(argv[i], "--core"))
      core = true;
    else if (!std::strcmp(argv[i], "--waits"))
      waits = true;
    else
      sizes.push_back(std::atoi(argv[i]));
  }
  if (core) return bench::measure_core(rounds) ? 0 : 1;
  if (waits) return bench::measure_waits(rounds) ? 0 : 1;
  if (engines) return bench::compare_engines(worlds, rounds);
  const bool all = sizes.empty();
  if (all) sizes = {1, 5, 10, 100, 1000};
  std::printf("processor time per robot-second, medians of %d rounds, in turn\n", rounds);
  std::printf("%7s %10s %10s %10s %13s %9s %13s\n", "robots", "ours us", "Enki us", "floor us", "times Enki",
              "promised", "floor's share");
  double per_robot_100 = 0, per_robot_1000 = 0;
  bool kept = true;
  for (int n : sizes) {
    const auto loaded = twin::load_world(worlds + "/brait_" + std::to_string(n) + ".toml");
    if (!loaded.world) {
      std::fprintf(stderr, "%s\n", loaded.report("bench world").c_str());
      return 2;
    }
    make_translations(*loaded.world);
    std::vector<double> ours, peer, floor, ratios;
    for (int round = 0; round < rounds; ++round) {
      ours.push_back(our_cost_us(*loaded.world));
      peer.push_back(peer_cost_us(*loaded.world));
      floor.push_back(floor_cost_us(*loaded.world));
      ratios.push_back(peer.back() / ours.back());
    }
    const double us = bench::median(ours), ratio = bench::median(ratios), floor_us = bench::median(floor);
    std::printf("%7d %10.1f %10.1f %10.1f %13.2f %9.1f %12.0f%%\n", n, us, bench::median(peer), floor_us,
                ratio, promised(n), 100 * floor_us / us);
    std::fflush(stdout);
    kept = kept && ratio >= promised(n);
    if (n == 100) per_robot_100 = us;
    if (n == 1000) per_robot_1000 = us;
  }
  if (per_robot_100 > 0 && per_robot_1000 > 0) {
    const double growth = per_robot_1000 / per_robot_100;
    std::printf("cost per robot from 100 to 1000 robots grows %.2f times (promised: below 1.3)\n", growth);
    kept = kept && growth < 1.3;
  }
  if (all) {
    std::printf("\n");
    kept = bench::measure_core(rounds) && kept;
    kept = bench::measure_waits(rounds) && kept;
  }
  std::printf("%s\n", kept ? "every promise kept" : "a promise was missed in this run");
  return kept ? 0 : 1;
}
