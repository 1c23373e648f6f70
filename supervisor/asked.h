// SPDX-License-Identifier: MIT
// What the functions of supervisor.h share: who asks, and whether what is asked for exists.
#pragma once
#include <fmt/format.h>

#include "sim_core/base/check.h"
#include "supervisor/team.h"

namespace supervisor {

/// The supervisor whose program is running.
inline Member& asking() {
  void* member = Program::current();
  CHECK(member, "a function of supervisor.h was called by something else than a supervisor's main()");
  return *static_cast<Member*>(member);
}

inline std::string count_text(const char* what, int count) {
  return count == 0 ? fmt::format("a world that has {}", what) : fmt::format("0 to {}", count - 1);
}

/// True when the thing exists; otherwise says what is wrong.
inline bool is_thing(Member& me, const char* function, int thing) {
  if (me.team.things().is_known(thing)) return true;
  me.refuse(fmt::format("{}: got thing {}, expected {}", function, thing,
                        count_text("robots or objects", me.team.things().count())));
  return false;
}

inline bool is_movable(Member& me, const char* function, int thing) {
  if (!is_thing(me, function, thing)) return false;
  if (me.team.things().body(thing) >= 0) return true;
  me.refuse(fmt::format("{}: got '{}', which stands fast, expected a robot or an object with movable = true",
                        function, me.team.things().name(thing)));
  return false;
}

inline bool is_robot(Member& me, const char* function, int robot) {
  if (me.team.things().is_robot(robot)) return true;
  me.refuse(fmt::format("{}: got robot {}, expected {}", function, robot,
                        count_text("robots", me.team.things().robots())));
  return false;
}

/// The same, where SV_ALL stands for all: calls `act` for each.
template <typename Act>
int for_robots(Member& me, const char* function, int robot, Act act) {
  constexpr int kAll = -2;  // SV_ALL
  if (robot != kAll && !is_robot(me, function, robot)) return -1;
  for (int r = robot == kAll ? 0 : robot; r < (robot == kAll ? me.team.things().robots() : robot + 1); ++r)
    if (act(r) < 0) return -1;
  return 0;
}

/// False, with a message, for what is no number or lies outside.
inline bool in_range(Member& me, const char* function, const char* what, double value, double least,
                     double most, const char* unit) {
  if (value >= least && value <= most) return true;
  me.refuse(fmt::format("{}: got {} {}{}{}, expected {:g} to {:g}", function, what, value, *unit ? " " : "",
                        unit, least, most));
  return false;
}

/// Bytes as a number for the world's digest.
inline std::uint64_t digest_of(const void* bytes, std::size_t size, std::uint64_t h = 1) {
  for (std::size_t i = 0; i < size; ++i)
    h = sim::fold(h, std::uint64_t{static_cast<const unsigned char*>(bytes)[i]});
  return sim::fold(h, std::uint64_t{size});
}

}  // namespace supervisor
