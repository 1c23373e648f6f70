// SPDX-License-Identifier: MIT
// Twinpuck in a program of one's own: a world with the robots' own firmware in it, in virtual time.
//
//   find_package(twinpuck REQUIRED)
//   target_link_libraries(mine PRIVATE twinpuck::twinpuck)
//
//   twinpuck::World world("maze");
//   world.run(60);
//   twinpuck::Pose pose = world.robot("puck").pose();
//
// What goes wrong is a twinpuck::Error. The same world, programs and seed give the same run to the last bit.
// A world and its robots are used by one thread at a time; several worlds may run in several threads.
#pragma once
#include <string>

#include "twinpuck/robot.h"
#include "twinpuck/world.h"

namespace twinpuck {

/// "0.1.0"
TWINPUCK_PUBLIC std::string version();

}  // namespace twinpuck
