// SPDX-License-Identifier: MIT
// What the tables of schema_*.cpp are written with: limits, and wrappers that turn a typed assignment into a
// Setter.
#pragma once
#include <string>
#include <vector>

#include "sim_core/load/schema.h"

namespace sim {

inline constexpr double kFar = 1000;     // m: no coordinate or size beyond
inline constexpr double kThin = 0.0005;  // m: nothing thinner
inline constexpr double kMany = 1e9;

/// Wraps a typed assignment.
template <typename T, typename F>
Setter into(F assign) {
  return [assign](void* target, const Value& v, const WorldDesc&) {
    assign(*static_cast<T*>(target), v);
    return std::string();
  };
}

/// Same, where the assignment may find something wrong.
template <typename T, typename F>
Setter checked(F assign) {
  return [assign](void* target, const Value& v, const WorldDesc& draft) {
    return std::string(assign(*static_cast<T*>(target), v, draft));
  };
}

/// Sections of other files, in the order of the document.
std::vector<SectionSpec> sound_sections();

/// The second name of robots and objects.
template <typename T>
KeySpec def_key() {
  return {"def",
          ValueType::Text,
          "",
          0,
          0,
          "",
          "",
          "second name, by which supervisors may look it up",
          into<T>([](T& t, const Value& v) { t.def = v.text; })};
}

/// The line of the node that something was made of.
template <typename T>
KeySpec node_key() {
  return {"node",
          ValueType::Integer,
          "",
          0,
          kMany,
          "",
          "0",
          "line of its node in the file that `[webots] world` names; 0 is none",
          into<T>([](T& t, const Value& v) { t.node = static_cast<int>(v.integer); })};
}

/// What cameras that recognise tell of robots and objects.
template <typename T>
KeySpec recognition_key() {
  return {"recognition_colours",
          ValueType::Colours,
          "",
          0,
          1,
          "",
          "[]",
          "what cameras that recognise objects tell of it, red, green, blue each; without one they do not "
          "notice it",
          into<T>([](T& t, const Value& v) {
            t.recognition_colours.clear();
            for (const std::vector<double>& c : v.rows) t.recognition_colours.push_back({c[0], c[1], c[2]});
          })};
}

/// A text that programs may read and change.
template <typename T>
KeySpec custom_data_key() {
  return {"custom_data",
          ValueType::Text,
          "",
          0,
          0,
          "",
          "\"\"",
          "a text that it and supervisors may read and change (Webots' `customData`)",
          into<T>([](T& t, const Value& v) { t.custom_data = v.text; })};
}

inline Colour colour_of(const Value& v) { return {v.numbers[0], v.numbers[1], v.numbers[2]}; }

inline std::vector<Vec2> points_of(const Value& v) {
  std::vector<Vec2> points;
  for (const std::vector<double>& row : v.rows) points.push_back({row[0], row[1]});
  return points;
}

/// schema_camera.cpp: [sky]
std::vector<SectionSpec> camera_sections();
/// Sections with a file of their own.
SectionSpec remote_key_section();
/// schema_webots.cpp
SectionSpec webots_section();
SectionSpec robot_device_section();
SectionSpec supervisor_device_section();
SectionSpec supervisor_section();  ///< schema_supervisor.cpp

}  // namespace sim
