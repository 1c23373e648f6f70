// SPDX-License-Identifier: MIT
// Runs a controller in a world, looks at it while it runs, and says how it went: a place to start from.
#include <cmath>
#include <cstdio>

#include <twinpuck/twinpuck.h>

int main() {
  try {
    twinpuck::Settings settings;
    settings.firmware["*"] =
        "obstacle";  // a controller that comes with Twinpuck; a folder of C files does, too
    settings.seed = 3;
    twinpuck::World world("maze", settings);
    twinpuck::Robot puck = world.robot(world.robots().front());

    // until one of its eight sensors sees something near, ten simulated seconds at most
    const auto sees_something = [&] {
      for (int sensor = 0; sensor < 8; ++sensor)
        if (puck.proximity(sensor) > 200) return true;
      return false;
    };
    const bool is_near = world.run_until(sees_something, 10);
    std::printf("%s after %.2f s\n", is_near ? "near a wall" : "nothing near", world.time_s());

    world.run(20);
    const twinpuck::Pose pose = puck.pose();
    std::printf("at %.3f m, %.3f m, heading %.0f degrees; %.2f m driven, %d collisions\n", pose.x_m, pose.y_m,
                pose.heading_rad * 180 / std::acos(-1.0), puck.distance_m(), puck.collisions());
    std::printf("control_due is %.0f\n", puck.variable("control_due"));

    // the same again is the same to the last bit
    const auto digest = world.digest();
    const double time_s = world.time_s();
    world.reset();
    world.run(time_s);
    std::printf("%s\n", world.digest() == digest ? "the same again" : "another run");
    for (const std::string& trap : puck.traps()) std::printf("%s\n", trap.c_str());
  } catch (const twinpuck::Error& wrong) {
    std::fprintf(stderr, "%s\n", wrong.what());
    return 2;
  }
}
