// SPDX-License-Identifier: MIT
// What the kinds of fault do, and by what one sees that they did: the hands of the Injector.
#pragma once
#include <string>
#include <vector>

#include "hal_sim/faults/fault.h"
#include "hal_sim/faults/kinds.h"
#include "hal_sim/twin/twin.h"

namespace faults {

using board::Cycle;
using sim::Clicks;

/// One fault on one robot.
struct Case {
  const Fault* fault = nullptr;
  const Kind* kind = nullptr;
  int robot = 0;
  Clicks begun = -1, ended = -1;  ///< -1: not
  Cycle begun_cycle = 0, ended_cycle = board::kNever;
  Clicks took_effect = -1;      ///< -1: not that anybody has seen
  std::int64_t first_byte = 0;  ///< of bytes_sent: how many were to be sent before
  double way = 0;               ///< of what the kind needs to remember from its beginning

  bool is_active() const { return begun >= 0 && ended < 0; }
};

/// A parameter's value: as it was given, else the usual one.
double number(const Case& c, const char* parameter);
std::string word(const Case& c, const char* parameter);
bool has(const Case& c, const char* parameter);

/// What is wrong with the values for this robot, or nothing: "pin: got 'Q3', expected ...".
std::string check(const Case& c, twin::Twin& twin);
/// All that acts on a robot of the case's kind, `cases` of all robots, is now as those that are active say.
/// Of a kind that does not last: it is done. Between ticks.
void apply(Case& c, std::vector<Case*>& cases, twin::Twin& twin);
/// The first time since `c` began at which it changed something; -1: it did not. Does not change anything.
Clicks noticed(const Case& c, twin::Twin& twin);
/// Before others of its kind begin on that robot: what was noticed so far is to be taken,
/// then it is forgotten.
void forget(const Case& c, twin::Twin& twin);
/// Is noticed() to be asked every tick, because it tells of that instant only?
bool is_looked_for(const Case& c);

}  // namespace faults
