// SPDX-License-Identifier: MIT
#include "outputs/summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace outputs {

namespace {

constexpr std::size_t kRobotsInText = 12;  // more would scroll the summary away

/// A number with so many decimals, and no "-0" for what is a little less than nothing.
std::string plain(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find_first_not_of("-0.") == std::string::npos && text[0] == '-') text.erase(0, 1);
  return text;
}

/// Above -180 and up to 180, as headings are said; whole turns are left out.
double heading_deg(double heading_rad) {
  const double degrees = std::remainder(heading_rad * 180 / 3.14159265358979323846, 360.0);
  return degrees <= -179.5 ? 180 : degrees;
}

std::string hex(std::uint64_t digest) { return fmt::format("{:016x}", digest); }

nlohmann::ordered_json json_of(const host::TrapReport& t) {
  nlohmann::ordered_json j;
  j["kind"] = host::trap_name(t.kind);
  if (!t.vector.empty()) j["vector"] = t.vector;
  j["message"] = t.message;
  j["function"] = t.place.function;
  j["file"] = t.place.file;
  j["line"] = t.place.line;
  j["cycle"] = t.cycle;
  j["time_s"] = t.time_s;
  j["count"] = t.count;
  for (const auto& p : t.backtrace) j["backtrace"].push_back(to_string(p));
  return j;
}

nlohmann::ordered_json json_of(const board::Diagnosis& d) {
  nlohmann::ordered_json j;
  j["cause"] = d.cause;
  j["place"] = d.place;
  j["message"] = d.message;
  j["hint"] = d.hint;
  j["first_s"] = d.first_s;
  j["count"] = d.count;
  return j;
}

}  // namespace

Summary summarise(const twin::Twin& twin, double wall_s) {
  Summary s;
  const auto& simulation = twin.simulation();
  s.world = twin.world().file.empty() ? twin.world().title : twin.world().file;
  s.seed = twin.world().seed;
  s.digest = simulation.digest();
  s.simulated_s = sim::to_seconds(simulation.now());
  s.wall_s = wall_s;
  if (twin.radio()) s.radio = twin.radio()->counters();
  s.robots.reserve(static_cast<std::size_t>(twin.robots()));
  for (int i = 0; i < twin.robots(); ++i) {
    const auto& mind = twin.mind(i);
    RobotSummary r;
    r.name = twin.world().robots[static_cast<std::size_t>(i)].name;
    r.firmware = twin.image_path(i);
    r.program = twin.program(i);
    r.hal = twin.hal(i);
    const auto& pose = simulation.pose(i);
    r.x_m = pose.x_m;
    r.y_m = pose.y_m;
    r.heading_rad = pose.heading_rad;
    r.distance_m = simulation.distance_m(i);
    r.collisions = simulation.touches(i).collisions;
    r.longest_wall_touch_s = simulation.touches(i).longest_wall_touch_s;
    const auto report = mind.report();
    r.left_steps = report.left_steps;
    r.right_steps = report.right_steps;
    r.cycles = mind.now();
    const auto& battery = mind.board().power().battery();
    r.battery_v = battery.voltage(mind.now());
    r.battery_used_wh = battery.used_wh(mind.now());
    r.battery_minutes = battery.minutes_left(mind.now());
    if (mind.runner()) {
      r.cpu_load = mind.runner()->cpu_load();
      r.traps = mind.runner()->traps();
      r.diagnoses = mind.runner()->diagnoses();
      s.traps.insert(s.traps.end(), r.traps.begin(), r.traps.end());
    }
    s.robots.push_back(std::move(r));
  }
  return s;
}

std::string to_text(const Summary& s) {
  std::string text = fmt::format(
      "{}: {:.1f} s simulated in {:.2f} s ({:.0f} times real time), seed {}, digest {}\n", s.world,
      s.simulated_s, s.wall_s, s.wall_s > 0 ? s.simulated_s / s.wall_s : 0, s.seed, hex(s.digest));
  if (!s.robots.empty())
    text += fmt::format("{:<12} {:>8} {:>8} {:>9} {:>9} {:>11} {:>9} {:>6} {:>8} {:>9}\n", "robot", "x (m)",
                        "y (m)", "heading", "path (m)", "collisions", "wall (s)", "load", "used", "left");
  for (std::size_t i = 0; i < s.robots.size() && i < kRobotsInText; ++i) {
    const auto& r = s.robots[i];
    text += fmt::format(
        "{:<12} {:>8} {:>8} {:>5} deg {:>9.3f} {:>11} {:>9.2f} {:>5.0f}% {:>4.0f} mWh {:>9}\n", r.name,
        plain(r.x_m, 3), plain(r.y_m, 3), plain(heading_deg(r.heading_rad), 0), r.distance_m, r.collisions,
        r.longest_wall_touch_s, 100 * r.cpu_load, 1000 * r.battery_used_wh,
        r.battery_minutes < 0 ? "-" : fmt::format("{:.0f} min", r.battery_minutes));
  }
  constexpr std::size_t kFaultsInText = 20;
  for (std::size_t i = 0; i < s.faults.size() && i < kFaultsInText; ++i) {
    const faults::Status& f = s.faults[i];
    if (f.took_effect_s < 0) continue;  // told as problems
    text += fmt::format("{}: from {:.3f} s, took effect at {:.3f} s", faults::said(f.fault), f.begun_s,
                        f.took_effect_s);
    text += f.ended_s > f.begun_s ? fmt::format(", until {:.3f} s\n", f.ended_s) : "\n";
  }
  if (s.robots.size() > kRobotsInText)
    text += fmt::format("... and {} more\n", s.robots.size() - kRobotsInText);
  return text;
}

std::string programs_text(const twin::Twin& twin) {
  std::vector<std::pair<std::string, std::vector<std::string>>> runs;  // what, and who
  for (int i = 0; i < twin.robots(); ++i) {
    if (twin.program(i).path.empty()) continue;
    const std::string what = said(twin.program(i));
    auto known = std::find_if(runs.begin(), runs.end(), [&](const auto& run) { return run.first == what; });
    if (known == runs.end()) known = runs.insert(known, {what, {}});
    known->second.push_back(twin.world().robots[static_cast<std::size_t>(i)].name);
  }
  std::string text;
  for (std::size_t i = 0; i < runs.size() && i < kRobotsInText; ++i) {
    const auto& [what, who] = runs[i];
    constexpr std::size_t kMostNames = 4;
    if (who.size() <= kMostNames)
      text += fmt::format("{}: {}\n", fmt::join(who, ", "), what);
    else
      text += fmt::format("{} to {}, {} robots: {}\n", who.front(), who.back(), who.size(), what);
  }
  if (runs.size() > kRobotsInText)
    text += fmt::format("... and {} programs more\n", runs.size() - kRobotsInText);
  return text;
}

std::string to_json(const Summary& s) {
  nlohmann::ordered_json j;
  j["version"] = TWINPUCK_VERSION;
  j["world"] = s.world;
  j["seed"] = s.seed;
  j["simulated_s"] = s.simulated_s;
  j["wall_s"] = s.wall_s;
  j["speed"] = s.wall_s > 0 ? s.simulated_s / s.wall_s : 0.0;
  j["digest"] = hex(s.digest);
  if (s.radio) {
    nlohmann::ordered_json radio;
    radio["sent"] = s.radio->sent;
    radio["given_up"] = s.radio->given_up;
    radio["delivered"] = s.radio->delivered;
    radio["out_of_range"] = s.radio->out_of_range;
    radio["by_chance"] = s.radio->by_chance;
    radio["by_collision"] = s.radio->by_collision;
    radio["while_sending"] = s.radio->while_sending;
    radio["switched_off"] = s.radio->switched_off;
    j["radio"] = radio;
  }
  if (!s.faults.empty()) {
    j["faults"] = nlohmann::ordered_json::array();
    const auto time = [](double at_s) {
      return at_s >= 0 ? nlohmann::ordered_json(at_s) : nlohmann::ordered_json();
    };
    for (const faults::Status& f : s.faults) {
      nlohmann::ordered_json fault;
      fault["fault"] = faults::said(f.fault);
      fault["kind"] = f.fault.kind;
      fault["robot"] = f.fault.robot;
      fault["begun_s"] = time(f.begun_s);
      fault["took_effect_s"] = time(f.took_effect_s);
      fault["ended_s"] = time(f.ended_s);
      fault["where"] = f.fault.where;
      j["faults"].push_back(std::move(fault));
    }
  }
  j["robots"] = nlohmann::ordered_json::array();
  for (const auto& r : s.robots) {
    nlohmann::ordered_json robot;
    robot["name"] = r.name;
    robot["firmware"] = r.firmware;
    robot["program"] =
        r.program.path.empty() ? "" : std::filesystem::absolute(r.program.path).lexically_normal().string();
    robot["files"] = r.program.files;
    robot["hal"] = r.hal.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(r.hal);
    robot["x_m"] = r.x_m;
    robot["y_m"] = r.y_m;
    robot["heading_rad"] = r.heading_rad;
    robot["distance_m"] = r.distance_m;
    robot["collisions"] = r.collisions;
    robot["longest_wall_touch_s"] = r.longest_wall_touch_s;
    robot["left_steps"] = r.left_steps;
    robot["right_steps"] = r.right_steps;
    robot["cycles"] = r.cycles;
    robot["cpu_load"] = r.cpu_load;
    robot["battery_v"] = r.battery_v;
    robot["battery_used_wh"] = r.battery_used_wh;
    robot["battery_minutes_left"] =
        r.battery_minutes >= 0 ? nlohmann::ordered_json(r.battery_minutes) : nullptr;
    robot["traps"] = nlohmann::ordered_json::array();
    for (const auto& t : r.traps) robot["traps"].push_back(json_of(t));
    robot["diagnoses"] = nlohmann::ordered_json::array();
    for (const auto& d : r.diagnoses) robot["diagnoses"].push_back(json_of(d));
    j["robots"].push_back(std::move(robot));
  }
  return j.dump(2) + "\n";
}

std::string to_text(const std::string& robot, const board::Diagnosis& d) {
  return fmt::format("robot '{}' {:.6f} s: {}: {}: {}{}{}{}", robot, d.first_s, d.place, d.cause, d.message,
                     d.count > 1 ? fmt::format(" ({} times)", d.count) : "", d.hint.empty() ? "" : "; ",
                     d.hint);
}

std::string to_text(const host::TrapReport& t) {
  std::string text = fmt::format("{}: {}: {}", t.robot, host::trap_name(t.kind), t.message);
  if (t.count > 1) text += fmt::format(" ({} times)", t.count);
  const std::string place = !t.place.function.empty()       ? to_string(t.place) + ", "
                            : t.kind == host::kProgramEnded ? ""
                                                            : "an unknown place, ";
  text += fmt::format("\n  at {}cycle {}, {:.6f} s\n", place, t.cycle, t.time_s);
  for (std::size_t i = 1; i < t.backtrace.size(); ++i)
    text += fmt::format("  called from {}\n", to_string(t.backtrace[i]));
  return text;
}

}  // namespace outputs
