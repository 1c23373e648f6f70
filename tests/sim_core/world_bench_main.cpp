// SPDX-License-Identifier: MIT
// Microseconds per robot and tick of the world alone, driven by fake minds, on bench/worlds. Not a test.
// usage: world_bench [WORLD.toml...]
#include <cstdio>
#include <ctime>

#include "tests/sim_core/fixture.h"
#include "twinpuck_paths.h"

using namespace sim_test;

int main(int argc, char** argv) {
  std::vector<std::string> files(argv + 1, argv + argc);
  if (files.empty()) {
    for (const char* n : {"1", "5", "10", "100", "1000"}) {
      files.push_back(std::string(TWINPUCK_SOURCE_DIR "/bench/worlds/brait_") + n + ".toml");
    }
  }
  for (const std::string& file : files) {
    const sim::LoadedWorld loaded = sim::load_world(file, {puck()});
    if (!loaded.world) {
      std::printf("%s\n", loaded.report(file).c_str());
      return 2;
    }
    const int robots = static_cast<int>(loaded.world->robots.size());
    double best_us = 1e9;
    std::uint64_t digest = 0;
    for (int round = 0; round < 5; ++round) {
      double cpu_s = 0;
      long ticks = 0;
      while (cpu_s < 0.25) {
        auto simulation =
            simulation_of(*loaded.world, [](int r) { return std::make_unique<Braitenberg>(r); });
        run_for(*simulation, 1);
        const std::clock_t begin = std::clock();
        run_for(*simulation, robots >= 1000 ? 5 : 20);
        cpu_s += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        ticks += (robots >= 1000 ? 5 : 20) * loaded.world->physics_hz;
        digest = simulation->digest();
      }
      best_us = std::min(best_us, 1e6 * cpu_s / static_cast<double>(ticks) / robots);
    }
    std::printf("%-50s %5d robots  %7.4f us per robot and tick  %9.0f robot-s/s  digest %016llx\n",
                file.c_str(), robots, best_us, 1e6 / best_us / loaded.world->physics_hz,
                static_cast<unsigned long long>(digest));
  }
  return 0;
}
