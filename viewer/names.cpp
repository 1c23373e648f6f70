// SPDX-License-Identifier: MIT
#include "viewer/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "sim_core/base/did_you_mean.h"

namespace viewer {

namespace {

/// "ir3" is the signal that pages call "ir" with 3; true when it is this one.
bool is_called(const signals::Signal& signal, const std::string& name, int& index) {
  index = 0;
  if (!signal.shown) return false;
  const std::string plain(signal.shown);
  if (signal.count == 0) return name == plain;
  if (name.size() != plain.size() + 1 || name.rfind(plain, 0) != 0) return false;
  index = name.back() - '0';
  return index >= 0 && index < signal.count;
}

}  // namespace

Named find_named(twin::Twin& twin, const std::string& name) {
  std::string what;
  const int robot = signals::robot_before_dot(twin, name, what);
  if (robot < 0)
    throw std::runtime_error("got '" + name + "', expected ROBOT.NAME with a robot of the world");
  if (what.rfind("pin:", 0) == 0) return signals::find_pin(twin, robot, what.substr(4));
  if (what.rfind("reg:", 0) == 0) return signals::find_register(twin, robot, what.substr(4));
  if (what.rfind("var:", 0) == 0) return signals::find_variable(twin, robot, what.substr(4));
  for (const signals::Signal& signal : signals::all()) {
    int index = 0;
    if (is_called(signal, what, index))
      return {signal.shown_unit, [robot, index, look = signal.look, factor = signal.factor](twin::Twin& t) {
                return factor * look(t, robot, index);
              }};
  }
  throw std::runtime_error(
      fmt::format("got '{}', expected a name such as ir0, speed, pin:D3 or var:counter{}", what,
                  sim::did_you_mean_tail(what, names_of_robots())));
}

std::vector<std::string> names_of_robots() {
  std::vector<std::string> names;
  for (const signals::Signal& signal : signals::all())
    for (int i = 0; signal.shown && i < std::max(1, signal.count); ++i)
      names.push_back(signal.count == 0 ? signal.shown : signal.shown + std::to_string(i));
  return names;
}

}  // namespace viewer
