// SPDX-License-Identifier: MIT
// What the tables of schema_*.cpp are written with: limits, and wrappers that turn a typed
// assignment into a Setter.
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

/// The keys of one list, then those of the other.
inline std::vector<KeySpec> joined(std::vector<KeySpec> keys, const std::vector<KeySpec>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

/// The material named, or what to say when there is none.
std::string find_material(const WorldDesc& draft, const std::string& name, Material& out);

/// What a surface is made of.
template <typename T>
std::vector<KeySpec> material_keys() {
  return {
      {"material", ValueType::Text, "", 0, 0, "", "",
       "name of a `[[material]]`; without it a white one is used",
       checked<T>(
           [](T& t, const Value& v, const WorldDesc& d) { return find_material(d, v.text, t.material); })},
      {"colour", ValueType::Colour, "", 0, 1, "", "", "red, green, blue; overrides the material's colour",
       into<T>([](T& t, const Value& v) { t.material.colour = colour_of(v); })},
  };
}

/// What robots have for themselves or from the world.
template <typename T>
std::vector<KeySpec> wheel_keys(const char* none, const char* usual_law) {
  return {
      {"wheel_noise", ValueType::Number, "", 0, 0.5, "", none,
       "random part of each wheel's travel, drawn anew every 1/32 s; a robot without one has the "
       "world's",
       into<T>([](T& t, const Value& v) { t.wheels.noise = v.number; })},
      {"wheel_noise_law", ValueType::Choice, "", 0, 0, "uniform|gaussian", usual_law,
       "what `wheel_noise` is: half width (factors of 1 - n to 1 + n) or standard deviation",
       into<T>([](T& t, const Value& v) {
         t.wheels.noise_law = v.text == "uniform" ? NoiseLaw::Uniform : NoiseLaw::Gaussian;
       })},
      {"slip", ValueType::Number, "", 0, 1, "", none,
       "part of the wheels' travel that is lost on the floor; a robot without one has the world's",
       into<T>([](T& t, const Value& v) { t.wheels.slip = v.number; })},
  };
}

}  // namespace sim
