// SPDX-License-Identifier: MIT
// make bench: robot-seconds per wall second in the common workload (docs/performance.md), ours with compiled
// firmware inside, libenki beside it, turn and turn about in one run. Ratios are what counts; a loaded
// machine moves both.
//
//   bench [--rounds 5] [--worlds DIR] [N ...]
//   bench --engines [--rounds 5] [--worlds DIR]      the three motion engines instead (engines.cpp)
//   bench --register [--rounds 5]                     one robot of the register way alone (register_load.cpp)
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "bench/engines.h"
#include "bench/enki_swarm.h"
#include "bench/median.h"
#include "bench/playback.h"
#include "bench/register_load.h"
#include "hal_sim/board/epuck_model.h"
#include "hal_sim/board/part.h"
#include "hal_sim/twin/twin.h"
#include "sim_core/load/world_loader.h"

namespace {

using Wall = std::chrono::steady_clock;

double seconds_since(Wall::time_point start) {
  return std::chrono::duration<double>(Wall::now() - start).count();
}

// simulated seconds: warm-up and measured; the big scene takes shorter so that a round stays below a minute
struct Span {
  double warm_s, measured_s;
};
Span our_span(int robots) { return robots >= 1000 ? Span{1, 5} : Span{1, 20}; }
Span peer_span(int robots) { return robots >= 1000 ? Span{0.192, 0.768} : Span{1, 20}; }

double run_ours(const sim::WorldDesc& world) {
  const int n = static_cast<int>(world.robots.size());
  const Span span = our_span(n);
  auto twin = bench::open_twin(world);
  return n * bench::timed_speed(twin->simulation(), span.warm_s, span.measured_s).wall;
}

// the same motion once more with the minds' work taken out
double world_only_rate(const sim::WorldDesc& world) {
  const int n = static_cast<int>(world.robots.size());
  const Span span = our_span(n);
  const bench::WheelTrack track = bench::track_wheels(world, span.warm_s + span.measured_s);
  auto played = bench::play_back(world, track);
  return n * bench::timed_speed(*played, span.warm_s, span.measured_s).wall;
}

double run_peer(const sim::WorldDesc& world) {
  constexpr double kStepS = 0.064;
  const Span span = peer_span(static_cast<int>(world.robots.size()));
  bench::EnkiSwarm swarm(world);
  const int warm = static_cast<int>(span.warm_s / kStepS + 0.5),
            measured = static_cast<int>(span.measured_s / kStepS + 0.5);
  for (int i = 0; i < warm; ++i) swarm.control_step();
  const auto start = Wall::now();
  for (int i = 0; i < measured; ++i) swarm.control_step();
  return static_cast<double>(world.robots.size()) * measured * kStepS / seconds_since(start);
}

// what the issue of the native twin promises against Enki
double promised(int robots) { return robots >= 1000 ? 25 : robots >= 100 ? 5 : robots >= 5 ? 1 : 0; }

}  // namespace

int main(int argc, char** argv) {
  int rounds = 5;
  std::string worlds = twin::project_root() + "/bench/worlds";
  std::vector<int> sizes;
  bool engines = false, registers = false;
  for (int i = 1; i < argc; ++i) {
    if (!std::strcmp(argv[i], "--rounds") && i + 1 < argc)
      rounds = std::max(1, std::atoi(argv[++i]));
    else if (!std::strcmp(argv[i], "--worlds") && i + 1 < argc)
      worlds = argv[++i];
    else if (!std::strcmp(argv[i], "--engines"))
      engines = true;
    else if (!std::strcmp(argv[i], "--register"))
      registers = true;
    else
      sizes.push_back(std::atoi(argv[i]));
  }
  if (registers) return bench::measure_register_way(rounds) >= bench::kPromisedRegisterWay ? 0 : 1;
  if (engines) return bench::compare_engines(worlds, rounds);
  const bool all = sizes.empty();
  if (all) sizes = {1, 5, 10, 100, 1000};
  std::printf("robot-seconds per wall second, medians of %d rounds, ours and Enki in turn\n", rounds);
  std::printf("%7s %12s %12s %8s %9s %16s %12s\n", "robots", "ours", "Enki", "ratio", "promised",
              "us/robot-second", "world only");
  double per_robot_100 = 0, per_robot_1000 = 0;
  bool kept = true;
  for (int n : sizes) {
    const auto loaded = sim::load_world(worlds + "/brait_" + std::to_string(n) + ".toml",
                                        {board::epuck_model()}, board::part_kinds());
    if (!loaded.world) {
      std::fprintf(stderr, "%s\n", loaded.report("bench world").c_str());
      return 2;
    }
    std::vector<double> ours, peer, ratios;
    for (int round = 0; round < rounds; ++round) {
      ours.push_back(run_ours(*loaded.world));
      peer.push_back(run_peer(*loaded.world));
      ratios.push_back(ours.back() / peer.back());
    }
    const double rate = bench::median(ours), ratio = bench::median(ratios),
                 world_rate = world_only_rate(*loaded.world);
    std::printf("%7d %12.0f %12.0f %8.2f %9.0f %16.2f %11.0f%%\n", n, rate, bench::median(peer), ratio,
                promised(n), 1e6 / rate, 100 * rate / world_rate);
    std::fflush(stdout);
    kept = kept && ratio >= promised(n);
    if (n == 100) per_robot_100 = 1 / rate;
    if (n == 1000) per_robot_1000 = 1 / rate;
  }
  if (per_robot_100 > 0 && per_robot_1000 > 0) {
    const double growth = per_robot_1000 / per_robot_100;
    std::printf("cost per robot from 100 to 1000 robots grows %.2f times (promised: below 1.5)\n", growth);
    kept = kept && growth < 1.5;
  }
  if (all) kept = bench::measure_register_way(rounds) >= bench::kPromisedRegisterWay && kept;
  std::printf("%s\n", kept ? "every promise kept" : "a promise was missed in this run");
  return kept ? 0 : 1;
}
