// SPDX-License-Identifier: MIT
// bench --register: how fast the register way runs one robot (firmware/register_load beside this file).
#include "bench/register_load.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "bench/processor_time.h"
#include "dspic30/device/dspic30f6014a.h"
#include "hal_sim/board/part.h"
#include "hal_sim/twin/twin.h"
#include "hal_sim/twin/world_file.h"

namespace bench {

namespace {

constexpr double kSeconds = 10;

}  // namespace

double measure_register_way(int rounds) {
  sim::WorldDesc world;
  world.models = twin::robot_models();
  world.part_kinds = board::part_kinds();
  world.title = "register way";
  world.arena = sim::ArenaDesc{};
  world.arena->size_m = {3, 3};
  sim::RobotDesc robot;
  robot.name = "robot";
  robot.firmware = twin::project_root() + "/bench/firmware/register_load";
  robot.own["way"] = "register";
  robot.pose = {-1.2, 0, 0};
  world.robots.push_back(robot);
  std::vector<double> factors, ns;
  for (int round = 0; round < std::max(1, rounds); ++round) {
    std::vector<std::string> problems;
    auto twin = twin::Twin::open(world, {}, problems);
    if (!twin) {
      for (const auto& line : problems) std::fprintf(stderr, "%s\n", line.c_str());
      return -1;
    }
    auto& simulation = twin->simulation();
    const double from = processor_s();
    while (simulation.now() < sim::from_seconds(kSeconds)) simulation.step();
    const double took = processor_s() - from;
    const host::Runner* runner = twin->mind(0).runner();
    const double served =
        static_cast<double>(runner->served(dspic::irq::Adc) + runner->served(dspic::irq::T2));
    factors.push_back(kSeconds / took);
    ns.push_back(1e9 * took / served);
    if (round == 0)
      std::printf("register way: one robot, %.0f interrupts a simulated second\n", served / kSeconds);
  }
  std::sort(factors.begin(), factors.end());
  std::sort(ns.begin(), ns.end());
  const double factor = factors[factors.size() / 2];
  std::printf(
      "median of %d rounds of %.0f s: %.0f times real time, %.0f ns an interrupt (best %.0f times; promised: "
      "%.0f)\n",
      rounds, kSeconds, factor, ns[ns.size() / 2], factors.back(), kPromisedRegisterWay);
  return factor;
}

}  // namespace bench
