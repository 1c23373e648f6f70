// SPDX-License-Identifier: MIT
// Words made from the schema: what a message says was expected, and the tables of keys in docs/worlds.md.
#include <fmt/format.h>

#include "sim_core/light/profiles.h"
#include "sim_core/load/schema.h"

namespace sim {
namespace {

const char* type_name(ValueType type) {
  switch (type) {
    case ValueType::Integer:
      return "whole number";
    case ValueType::Number:
      return "number";
    case ValueType::Bytes:
    case ValueType::Text:
      return "text in quotes";
    case ValueType::Flag:
      return "true or false";
    case ValueType::Choice:
      return "one of";
    case ValueType::Pair:
      return "two numbers [x, y]";
    case ValueType::Triple:
      return "three numbers [x, y, z]";
    case ValueType::Colour:
      return "three numbers [red, green, blue]";
    case ValueType::Numbers:
      return "list of numbers";
    case ValueType::Points:
      return "list of points [[x, y], ...]";
    case ValueType::Colours:
      return "list of colours [[red, green, blue], ...]";
    case ValueType::Rows:
      return "list of rows [[distance, value, noise], ...]";
  }
  return "";
}

bool has_range(const KeySpec& k) {
  return k.type != ValueType::Text && k.type != ValueType::Flag && k.type != ValueType::Choice;
}

std::string range_text(const KeySpec& k) {
  if (k.least == k.most) return fmt::format("{}", k.least);
  if (k.least <= -1e8 && k.most >= 1e8) return "any";
  if (k.type == ValueType::Integer)
    return fmt::format("{} to {}", static_cast<std::int64_t>(k.least), static_cast<std::int64_t>(k.most));
  return fmt::format("{} to {}", k.least, k.most);
}

std::string choices_text(const KeySpec& k) {
  std::string out;
  for (const char* c = k.choices; *c; ++c) out += *c == '|' ? std::string(", ") : std::string(1, *c);
  return out;
}

std::string key_row(const KeySpec& k) {
  const std::string fallback = k.fallback;
  const std::string range = k.type == ValueType::Choice ? choices_text(k) : has_range(k) ? range_text(k) : "";
  return fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", k.key,
                     k.type == ValueType::Choice ? "text" : type_name(k.type), k.unit, range,
                     fallback == "required" ? "**required**"
                     : fallback.empty()     ? ""
                                            : "`" + fallback + "`",
                     k.doc);
}

constexpr const char* kKeyTable =
    "| key | value | unit | range | default | meaning |\n|---|---|---|---|---|---|\n";

/// A table for each kind of part.
std::string part_pages(const std::vector<PartKind>& kinds) {
  std::string out;
  for (const PartKind& kind : kinds) {
    const SectionSpec spec = part_section(kind);
    out += fmt::format("\n#### `kind = \"{}\"`\n\n{}\n", kind.name, kind.doc);
    if (spec.keys.size() > 1) out += std::string("\n") + kKeyTable;
    for (std::size_t i = 1; i < spec.keys.size(); ++i) out += key_row(spec.keys[i]);
  }
  return out;
}

/// A table for each kind of robot that has keys of its own.
std::string robot_pages(const std::vector<RobotModel>& models) {
  std::string out;
  for (const RobotModel& model : models) {
    const std::vector<KeySpec> keys = robot_section(model).keys;
    if (model.keys.empty()) continue;
    out += fmt::format("\nOnly robots of `model = \"{}\"` have these, too:\n\n{}", model.name, kKeyTable);
    for (std::size_t i = keys.size() - model.keys.size(); i < keys.size(); ++i) out += key_row(keys[i]);
  }
  return out;
}

}  // namespace

std::string expected_text(const KeySpec& k) {
  std::string out = type_name(k.type);
  if (k.type == ValueType::Choice) return out + " " + choices_text(k);
  if (!has_range(k)) return out;
  const std::string range = range_text(k);
  if (range != "any") out += (k.least == k.most ? ": " : " from ") + range;
  if (*k.unit) out += std::string(" ") + k.unit;
  return out;
}

std::string world_format_page(const std::vector<RobotModel>& models,
                              const std::vector<PartKind>& part_kinds) {
  std::string out;
  for (const SectionSpec& s : world_schema()) {
    const std::string path = s.path;
    out += "\n### " +
           (path.empty() ? std::string("Top of the file")
                         : (s.many ? "`[[" : "`[") + path + (s.many ? "]]`" : "]`")) +
           "\n\n" + s.doc + "\n\n";
    if (path == "robot.proximity") continue;
    const std::size_t shown = path == "robot.sensor" ? 1 : s.keys.size();
    out += kKeyTable;
    for (std::size_t i = 0; i < shown; ++i) out += key_row(s.keys[i]);
    if (path == "robot") out += robot_pages(models);
    if (path == "robot.part") out += part_pages(part_kinds);
  }
  out +=
      "\n### Proximity profiles\n\n| name | rows | range (m) | rays | aperture (deg) | layout | colour rule "
      "| "
      "noise |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const ProximityProfile& p : proximity_profiles()) {
    out += fmt::format("| `{}` | {} | {:.3g} | {} | {:.3g} | {} | {} | {} |\n", p.name, p.table.size(),
                       p.table.back().distance_m, p.rays, degrees(p.aperture_rad),
                       p.layout == RayLayout::Fan ? "fan" : "cone",
                       p.colour_rule == ColourRule::Old   ? "old"
                       : p.colour_rule == ColourRule::New ? "new"
                                                          : "none",
                       p.noise_law == NoiseLaw::Uniform ? "uniform" : "gaussian");
  }
  out +=
      "\nReadings in counts of a white wall that a single ray meets at right angles, noise in brackets:\n\n| "
      "distance |";
  for (const ProximityProfile& p : proximity_profiles()) out += fmt::format(" `{}` |", p.name);
  out += "\n|---|";
  for (std::size_t i = 0; i < proximity_profiles().size(); ++i) out += "---|";
  out += "\n";
  for (double mm : {0., 5., 10., 20., 30., 40., 50., 60., 70., 100.}) {
    out += fmt::format("| {} mm |", mm);
    for (const ProximityProfile& p : proximity_profiles()) {
      const ResponseRow row = look_up(p.table, mm / 1000);
      out += fmt::format(" {:.0f} ({:.3f}) |", row.value, row.relative_noise);
    }
    out += "\n";
  }
  return out;
}

}  // namespace sim
