// SPDX-License-Identifier: MIT
// What Webots' interfaces share inside one program: the schedule of its steps, messages on their way to
// receivers, nodes. Everything here lies in the program's own shared object, so each program has its own.
#pragma once
#include <supervisor.h>

#include <string>

namespace webots {

struct Pose {
  double position[3];
  double rotation[4];  // axis and angle, rad
};

/// Lets the world go on up to the program's next step, `ms` after the one before; 0 or less: the world's own
/// time step. False: the run is over.
bool step(int ms);
/// Sum of all steps, s.
double time_s();
/// Called after every step.
void refresh_buffers();
void fill_receivers();

void warn(const char* format, ...) SV_PRINTF(1, 2);

/// Pose of a thing as Webots has it: the middle of an object, the floor under a robot.
Pose pose_of(int thing, bool nue);
/// Moves it there; a rotation about another axis than up leaves what it does to the heading.
void put(int thing, const Pose& pose, bool nue);
void rest_all();
void reset_all();
/// Picture file of a name that may end otherwise.
std::string picture_name(const char* file);

}  // namespace webots
