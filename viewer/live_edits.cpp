// SPDX-License-Identifier: MIT
#include "viewer/live_edits.h"

#include <fmt/format.h>

#include <set>

#include "hal_sim/inputs/inputs.h"

namespace viewer {

namespace {

using Json = nlohmann::json;
using Text = sim::WorldText;

std::set<std::string> differing_keys(const Text& from, const Text& to, int id) {
  std::set<std::string> keys;
  for (const auto& [key, value] : to.values(id))
    if (from.value(id, key) != value) keys.insert(key);
  for (const auto& [key, value] : from.values(id))
    if (to.value(id, key).empty()) keys.insert(key);
  return keys;
}

/// What a running robot can take, and what not.
void robot_edit(const Text& from, const Text& to, int id, int index, const sim::RobotDesc& robot,
                LiveEdit& edit) {
  if (from.inner_text(id) != to.inner_text(id)) {
    edit.why_not = "what is plugged into " + robot.name + " is there from its power-up on";
    return;
  }
  std::set<std::string> keys = differing_keys(from, to, id);
  if (keys.erase("position") + keys.erase("heading") > 0)
    edit.inputs.push_back({{"do", "move"},
                           {"robot", robot.name},
                           {"x", robot.pose.x_m},
                           {"y", robot.pose.y_m},
                           {"heading", robot.pose.heading_rad}});
  if (const auto selector = robot.own.find("selector"); keys.erase("selector"))
    edit.inputs.push_back({{"do", "selector"},
                           {"robot", robot.name},
                           {"position", selector == robot.own.end() ? 0.0 : selector->second.numbers.at(0)}});
  if (robot.battery_v >= inputs::kLeastBatteryV && robot.battery_v <= inputs::kMostBatteryV &&
      keys.erase("battery"))
    edit.inputs.push_back({{"do", "battery"}, {"robot", robot.name}, {"volts", robot.battery_v}});
  if (!robot.firmware.empty() && !from.value(id, "firmware").empty() && keys.erase("firmware"))
    edit.firmware.emplace_back(index, robot.firmware);
  keys.erase("colour");  // comes with the furniture
  if (!keys.empty())
    edit.why_not = fmt::format("`{}` of {} is set when it is switched on", *keys.begin(), robot.name);
}

}  // namespace

LiveEdit live_edit(const Text& from, const Text& to, const sim::WorldDesc& world) {
  LiveEdit edit;
  const std::vector<int> robots = to.ids_of("robot");
  if (robots != from.ids_of("robot")) {
    edit.why_not = "robots come and go only when a run begins";
    return edit;
  }
  for (std::size_t i = 0; i < robots.size() && edit.why_not.empty(); ++i)
    if (from.text_of(robots[i]) != to.text_of(robots[i]))
      robot_edit(from, to, robots[i], static_cast<int>(i), world.robots[i], edit);
  for (const char* path : {"world", "supervisor", "radio", "link", "webots"}) {
    const std::vector<int> before = from.ids_of(path), after = to.ids_of(path);
    bool is_other = before != after;
    for (std::size_t i = 0; i < after.size() && !is_other; ++i) {
      std::set<std::string> keys = differing_keys(from, to, after[i]);
      keys.erase("title");
      is_other = !keys.empty() || from.inner_text(after[i]) != to.inner_text(after[i]);
    }
    if (is_other && edit.why_not.empty()) edit.why_not = fmt::format("[{}] counts for a whole run", path);
  }
  return edit;
}

}  // namespace viewer
