// SPDX-License-Identifier: MIT
// What a step costs: a program with eight sensors and two motors, and a simulator's end that only packs and
// sends. Prints us of processor time a step, both sides together, and us of wall time.
#include <webots/distance_sensor.h>
#include <webots/motor.h>
#include <webots/robot.h>

#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "tests/controller/fake_simulator.h"

namespace {
double seconds(int who) {
  rusage used{};
  getrusage(who, &used);
  return double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}
}  // namespace

int main(int argc, char** argv) {
  const int steps = argc > 1 ? std::atoi(argv[1]) : 100000;
  fake::Simulator sim([] {
    wb_robot_init();
    WbDeviceTag ps[8], wheels[2] = {wb_robot_get_device("left"), wb_robot_get_device("right")};
    for (int i = 0; i < 8; ++i) wb_distance_sensor_enable(ps[i] = wb_robot_get_device_by_index(i), 32);
    while (wb_robot_step(32) != -1) {
      double sum = 0;
      for (const WbDeviceTag tag : ps) sum += wb_distance_sensor_get_value(tag);
      for (const WbDeviceTag tag : wheels) wb_motor_set_velocity(tag, sum / 10000);
    }
  });
  fake::World world;
  for (int i = 1; i <= 8; ++i)
    world.devices.push_back({i, WB_NODE_DISTANCE_SENSOR, "ps" + std::to_string(i), {0, 4095, 0.3, 1}});
  world.devices.push_back({9, WB_NODE_ROTATIONAL_MOTOR, "left", {6.28, 0}});
  world.devices.push_back({10, WB_NODE_ROTATIONAL_MOTOR, "right", {6.28, 0}});
  sim.welcome(world);
  fake::Packet samples;
  for (int i = 1; i <= 8; ++i) samples.add(LINK_NUMBERS, i, std::vector<double>{100.0 * i});
  samples.add(LINK_DONE, std::int64_t{1}, 32);
  sim.next_raw();
  const double before = seconds(RUSAGE_SELF);
  const auto from = std::chrono::steady_clock::now();
  for (int i = 0; i < steps; ++i) {
    sim.send(samples);
    sim.next_raw();
  }
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
  const double here = seconds(RUSAGE_SELF) - before;
  sim.send(fake::Packet().add(LINK_END));
  sim.wait();
  const double there = seconds(RUSAGE_CHILDREN);
  std::printf("a step: %.1f us of processor (simulator's end %.1f, program %.1f), %.1f us of wall time\n",
              1e6 * (here + there) / steps, 1e6 * here / steps, 1e6 * there / steps, 1e6 * wall / steps);
}
