// SPDX-License-Identifier: MIT
// Everything of a robot and of the world that has a name and a number: one table, for conditions, pages,
// tests and lists. Looking changes nothing that a robot could notice.
//
//   x_m  heading_deg  left_steps_s  led0  proximity3  battery_v  load  traps     by the table
//   pin(D3)  reg(T2CON.TCKPS)  var(speed[1])  $state  $(motors[n].speed + 1)    of chip and program
//
// In: a twin between two ticks. Out: a number in the unit that the table names.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"

namespace signals {

/// Distances are told up to here; nothing is nearer then. m
inline constexpr double kNothingNearM = 1000;

struct Signal {
  const char* name;    ///< of several: without its number
  int count;           ///< 0: one, without a number; else NAME0 to NAME(count - 1)
  const char* unit;    ///< "" for none
  double least, most;  ///< what it can be, in its unit
  const char* what;    ///< a phrase for lists
  bool is_of_world;    ///< no robot's
  double (*look)(const twin::Twin& twin, int robot, int index);
  /// How pages call it, in which unit, and by what factor that is larger; null: they do not show it.
  const char* shown = nullptr;
  const char* shown_unit = "";
  double factor = 1;
};

/// The table, in the order of lists.
const std::vector<Signal>& all();
/// The names of it, each with its number: led0, led1 ... `of_world`: the world's, too.
std::vector<std::string> names(bool of_world);
/// docs: a table in Markdown, and one for the terminal.
std::string page_table();
std::string text_table();

/// A signal that is bound to a robot.
struct Named {
  std::string unit;  ///< "" for none
  /// Between two ticks. A program that has been flashed anew is asked anew.
  std::function<double(twin::Twin&)> value;
};

/// A signal of the table, or pin(...), reg(...), var(...), $...: of robot `robot`; the world's need none: -1.
/// Throws std::runtime_error, "got ..., expected ...; did you mean ...?", for what nothing has.
Named find(twin::Twin& twin, int robot, const std::string& name);
/// "D3": a level of a pin, 0 or 1, as find().
Named find_pin(twin::Twin& twin, int robot, const std::string& pin);
/// "T2CON" "T2CON.TCKPS": a register or one of its fields.
Named find_register(twin::Twin& twin, int robot, const std::string& name);
/// A number of the program by an expression in C: "state", "speed[1]", "main.c:count", "m->speed + 1".
/// Variables are those that are known everywhere: globals and statics.
Named find_variable(twin::Twin& twin, int robot, const std::string& expression);

/// "the robots are puck, e-puck and 3 more", for messages.
std::string robots_text(const twin::Twin& twin);
/// The robot that a text begins with, "e-puck.x_m"; -1: none. `rest`: what follows its dot. The longest name
/// that fits: names may hold dots.
int robot_before_dot(const twin::Twin& twin, const std::string& text, std::string& rest);

}  // namespace signals
