// SPDX-License-Identifier: MIT
#include "bench/latency.h"
#include "install/places.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/median.h"
#include "compiler/build/build.h"
#include "compiler/cache/object_cache.h"
#include "hal_sim/twin/twin.h"

namespace bench {
namespace {

namespace fs = std::filesystem;

double used_s(int who) {
  rusage u;
  getrusage(who, &u);
  return double(u.ru_utime.tv_sec + u.ru_stime.tv_sec) +
         1e-6 * double(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
}

/// Processor time of this process and of the children that ended meanwhile.
double cost_s(const std::function<void()>& work) {
  const double from = used_s(RUSAGE_SELF) + used_s(RUSAGE_CHILDREN);
  work();
  return used_s(RUSAGE_SELF) + used_s(RUSAGE_CHILDREN) - from;
}

void run_command(const std::vector<std::string>& argv) {
  const cc::ProcessResult ran = cc::run_process(argv);
  if (ran.status == 0) return;
  std::fprintf(stderr, "%s: ended with %d\n%s\n", argv[0].c_str(), ran.status, ran.output.c_str());
  std::exit(2);
}

/// Time of `work`, each time after `prepare`, which is not counted.
double median_s(int rounds, const std::function<void()>& prepare, const std::function<void()>& work) {
  std::vector<double> all;
  for (int i = 0; i < rounds; ++i) {
    prepare();
    all.push_back(cost_s(work));
  }
  return median(all);
}

bool row(const char* what, double ms, double promised_ms) {
  std::printf("%-64s %9.1f %9.0f\n", what, ms, promised_ms);
  std::fflush(stdout);
  return ms <= promised_ms;
}

}  // namespace

bool measure_waits(int rounds) {
  const std::string build = places::tools_folder().string(), command = build + "/twinpuck",
                    maze = places::share_root().string() + "/worlds/maze.toml";
  const fs::path scratch = fs::temp_directory_path() / ("twinpuck-bench-" + std::to_string(getpid()));
  const auto nothing = [] {};
  std::printf("\n%-64s %9s %9s\n", "what a user waits for, processor time", "ms", "promised");
  const auto run_maze = [&](const char* seconds) { run_command({command, "run", maze, "--for", seconds}); };
  // the first ones make the image, and let its files grow old enough to be told by their times
  run_maze("0.01");
  usleep(100'000);
  run_maze("0.01");
  constexpr double kMazeSeconds = 600, kMazeSpeed = 8000;
  const double maze_s = median_s(rounds, nothing, [&] { run_maze("600"); });
  bool kept = row("twinpuck run worlds/maze.toml --for 600", 1e3 * maze_s, 1e3 * kMazeSeconds / kMazeSpeed);
  std::printf("  %.0f times real time\n", kMazeSeconds / maze_s);
  // with the robot's own drivers
  const auto run_chip = [&] {
    run_command({command, "run", maze, "--fw", "*=obstacle", "--hal", "dspic", "--for", "60", "-q"});
  };
  run_chip();
  constexpr double kChipSeconds = 60, kChipSpeed = 100;
  const double chip_s = median_s(rounds, nothing, run_chip);
  kept &= row("twinpuck run maze --fw obstacle --hal dspic --for 60", 1e3 * chip_s,
              1e3 * kChipSeconds / kChipSpeed);
  std::printf("  %.0f times real time\n", kChipSeconds / chip_s);
  kept &= row("twinpuck run worlds/maze.toml --for 0.01, built before",
              1e3 * median_s(4 * rounds + 1, nothing, [&] { run_maze("0.01"); }), 5);
  kept &= row("a first build of firmware/blink",
              1e3 * median_s(
                        rounds, [&] { fs::remove_all(scratch); },
                        [&] {
                          cc::BuildOptions o;
                          o.source_dir = places::share_root().string() + "/firmware/blink";
                          o.output = scratch / "blink.elf";
                          o.cache_dir = scratch / "cache";
                          if (!cc::build_image(o).ok) std::exit(2);
                        }),
              300);
  fs::remove_all(scratch);
  // a module that is not there is compiled as an edited one is
  const fs::path module = build + "/tests/firmware/modules/firmware_tilt_test_cpp.so";
  if (!fs::exists(module)) {
    std::printf("%-64s  not built: ninja -C %s firmware_test\n", "a firmware test, edit to result",
                build.c_str());
    return kept;
  }
  return row("a firmware test, edit to result",
             1e3 * median_s(
                       rounds, [&] { fs::remove(module); },
                       [&] {
                         run_command({"ninja", "-C", build, "firmware_test"});
                         run_command({build + "/tests/firmware_test", "--gtest_filter=Tilt.climbs*"});
                       }),
             500) &&
         kept;
}

}  // namespace bench
