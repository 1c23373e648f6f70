// SPDX-License-Identifier: MIT
// What a picture of 40 by 40 pixels costs: the maze with ten robots in it, each looks in turn, on one core.
// Usage: camera_bench [PICTURES]
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "sim_core/camera/camera.h"
#include "sim_core/load/world_loader.h"
#include "tests/sim_core/fixture.h"
#include "twinpuck_paths.h"

int main(int argc, char** argv) {
  const int pictures = argc > 1 ? std::atoi(argv[1]) : 20000;
  sim::LoadedWorld loaded = sim::load_world(TWINPUCK_SOURCE_DIR "/worlds/maze.toml", {sim_test::puck()});
  if (!loaded.world) return std::puts(loaded.report("maze.toml").c_str()), 2;
  sim::WorldDesc world = *loaded.world;
  world.robots.resize(1);
  const double places[10][3] = {{-0.7, 0.5, -80}, {-0.7, 0.0, 0},   {-0.35, 0.45, -90}, {0.0, 0.0, 90},
                                {0.25, 0.4, 20},  {0.6, 0.45, 200}, {0.65, -0.3, 90},   {0.2, -0.4, 180},
                                {-0.3, -0.5, 0},  {-0.7, -0.45, 45}};
  const sim::RobotDesc pattern = world.robots[0];
  world.robots.clear();
  for (const auto& p : places) {
    sim::RobotDesc robot = pattern;
    robot.name = "r" + std::to_string(world.robots.size());
    robot.pose = {p[0], p[1], sim::radians(p[2])};
    world.robots.push_back(robot);
  }
  auto simulation = sim_test::cruising(world, 0, 0);
  std::vector<double> right, up;
  for (int i = 0; i < 40; ++i) right.push_back((i - 19.5) * 8 / 716.5), up.push_back((19.5 - i) * 8 / 716.5);
  for (int band : {40, 4, 1}) {
    std::vector<sim::Light> out;
    float sum = 0;
    const std::clock_t start = std::clock();
    for (int i = 0; i < pictures; ++i)
      for (int row = 0; row < 40; row += band) {
        sim::render_camera(simulation->scene(), i % 10, {0.030, 0, 0.028}, simulation->now(), right,
                           {up.begin() + row, up.begin() + row + band}, out);
        sum += out[0].r;
      }
    const double s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf("%2d rows at a time: %.1f us of processor time a picture of 40 x 40 (checksum %g)\n", band,
                1e6 * s / pictures, sum);
  }
}
