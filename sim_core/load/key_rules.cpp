// SPDX-License-Identifier: MIT
#include "sim_core/load/key_rules.h"

#include <fmt/format.h>

#include <algorithm>

namespace sim {
namespace {

/// What a table of `sections` may not have together: `key` counts where `other`, of the same table, has one of
/// `values`; without values: where it is not written.
struct KeyRule {
  const char* sections;  // between '|'
  const char* key;
  const char* other;
  const char* values;  // between '|'
};

constexpr KeyRule kRules[] = {
    // two that mean the same
    {"sound", "pressure", "level", ""},
    {"sound", "every", "times", ""},
    {"sound", "jitter", "times", ""},
    {"ramp", "heights", "angle", ""},
    {"proximity|robot.proximity|robot.sensor", "aperture_rad", "aperture", ""},
    // of one kind alone
    {"sound", "frequency", "kind", "tone"},
    {"sound", "band", "kind", "noise"},
    {"sound", "file", "kind", "wav"},
    {"sound", "loop", "kind", "wav"},
    {"sound", "times", "kind", "clap"},
    {"sound", "every", "kind", "clap"},
    {"sound", "jitter", "kind", "clap"},
    {"radio", "fading", "model", "log-distance"},
    {"robot.device|supervisor.device", "channel", "kind", "emitter|receiver"},
    {"robot.device|supervisor.device", "range", "kind", "emitter"},
    {"robot.device|supervisor.device", "baud_rate", "kind", "emitter"},
    {"robot.device|supervisor.device", "infra_red", "kind", "emitter"},
    {"robot.device|supervisor.device", "width", "kind", "display|camera|lidar|range-finder"},
    {"robot.device|supervisor.device", "height", "kind", "display|camera|lidar|range-finder"},
    {"robot.device|supervisor.device", "at", "kind", "distance|lidar|range-finder"},
    {"robot.device|supervisor.device", "heading", "kind", "distance|lidar|range-finder"},
    {"robot.device|supervisor.device", "fov", "kind", "camera|lidar|range-finder"},
    {"robot.device|supervisor.device", "vertical_fov", "kind", "lidar"},
    {"robot.device|supervisor.device", "near", "kind", "lidar|range-finder"},
    {"robot.device|supervisor.device", "far", "kind", "lidar|range-finder"},
    {"robot.device|supervisor.device", "table", "kind", "distance"},
    {"robot.device|supervisor.device", "rays", "kind", "distance"},
    {"robot.device|supervisor.device", "aperture", "kind", "distance"},
    {"box|cylinder|ball|polygon", "mass", "movable", "true"},
    {"box|cylinder|polygon", "friction", "movable", "true"},
    {"ball", "rolling_friction", "movable", "true"},
};

bool has_word(const std::string& words, const std::string& word) {
  return ("|" + words + "|").find("|" + word + "|") != std::string::npos;
}

std::string fallback_of(const SectionSpec& spec, const std::string& key) {
  for (const KeySpec& k : spec.keys) {
    if (key != k.key) continue;
    std::string text = k.fallback;
    text.erase(std::remove(text.begin(), text.end(), '"'), text.end());
    return text == "required" ? "" : text;
  }
  return {};
}

}  // namespace

std::vector<IdleKey> idle_keys(const SectionSpec& spec, const WrittenValue& value_of) {
  std::vector<IdleKey> out;
  std::string told;
  for (const KeyRule& rule : kRules) {
    if (!has_word(rule.sections, spec.path) || !value_of(rule.key) || has_word(told, rule.key)) continue;
    const std::optional<std::string> other = value_of(rule.other);
    const bool is_same = !*rule.values;
    std::string why;
    if (is_same) {
      if (!other) continue;
      why = fmt::format("got '{}' besides, expected one of them", rule.other);
    } else {
      // a value that is missing or wrong is told by itself
      const std::string value = other ? *other : fallback_of(spec, rule.other);
      if (value.empty() || has_word(rule.values, value)) continue;
      std::string values = rule.values;
      for (std::size_t at; (at = values.rfind('|')) != std::string::npos;)
        values.replace(at, 1, values.find(" or ") == std::string::npos ? " or " : ", ");
      why = fmt::format("got one where '{}' is {}, expected one only where it is {}", rule.other, value,
                        values);
    }
    out.push_back({rule.key, rule.other, is_same, std::move(why)});
    told += std::string("|") + rule.key;
  }
  return out;
}

bool says_place(const std::string& key) {
  return has_word(
      "model|position|heading|z|size|centre|radius|height|points|thickness|closed|movable|angle|heights|"
      "wall_height|wall_thickness",
      key);
}

}  // namespace sim
