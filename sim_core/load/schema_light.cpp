// SPDX-License-Identifier: MIT
// [[lamp]] and the proximity sensors: [proximity], [robot.proximity], [[robot.sensor]].
#include <fmt/format.h>

#include "sim_core/light/profiles.h"
#include "sim_core/load/schema_keys.h"
#include "sim_core/load/schema_sections.h"

namespace sim {

namespace {

/// Proximity keys, for whatever struct holds the settings.
template <typename T, typename Get>
std::vector<KeySpec> proximity_keys(Get get) {
  const auto to = [get](auto assign) {
    return into<T>([get, assign](T& t, const Value& v) { assign(get(t), v); });
  };
  static const std::string names = [] {
    std::string all;
    for (const ProximityProfile& p : proximity_profiles())
      all += (all.empty() ? "" : "|") + std::string(p.name);
    return all;
  }();
  using P = ProximitySettings;
  return {
      {"profile", ValueType::Choice, "", 0, 0, names.c_str(), "\"inverse-square\"",
       "lookup table, rays, colour rule and noise law by name",
       to([](P& p, const Value& v) { p.profile = v.text; })},
      {"table", ValueType::Rows, "m, counts, fraction", 0, 1e6, "", "",
       "own lookup table instead of the profile's: rows of distance, value and relative noise, distances "
       "growing; "
       "linear in between, clamped beyond the ends",
       checked<T>([get](T& t, const Value& v, const WorldDesc&) {
         std::vector<ResponseRow> rows;
         for (const std::vector<double>& row : v.rows) {
           if (!rows.empty() && row[0] <= rows.back().distance_m) {
             return fmt::format("got distance {} after {}, expected growing distances in m", row[0],
                                rows.back().distance_m);
           }
           if (row[0] > 10) return fmt::format("got a distance of {} m, expected at most 10 m", row[0]);
           rows.push_back({row[0], row[1], row[2]});
         }
         if (rows.size() < 2) return fmt::format("got {} row(s), expected at least 2", rows.size());
         get(t).table = rows;
         return std::string();
       })},
      {"type", ValueType::Choice, "", 0, 0, "infra-red|generic", "\"infra-red\"",
       "generic sensors do not see colour", to([](P& p, const Value& v) {
         p.type = v.text == "generic" ? SensorType::Generic : SensorType::InfraRed;
       })},
      {"rays", ValueType::Integer, "", 1, 100, "", "", "how many; the profile's otherwise",
       to([](P& p, const Value& v) { p.rays = static_cast<int>(v.integer); })},
      {"aperture", ValueType::Number, "deg", 0, 180, "", "",
       "full angle that the rays cover; 0 leaves one ray",
       to([](P& p, const Value& v) { p.aperture_rad = radians(v.number); })},
      {"aperture_rad", ValueType::Number, "rad", 0, kPi, "", "",
       "the same in radians, as Webots worlds write it",
       to([](P& p, const Value& v) { p.aperture_rad = v.number; })},
      {"gaussian_width", ValueType::Number, "", 0, 1000, "", "1",
       "a ray at angle t weighs exp(-(t / (aperture * width))^2); 0 leaves only the ray on the axis (the "
       "innermost where none lies there), and is told",
       to([](P& p, const Value& v) { p.gaussian_width = v.number; })},
      {"layout", ValueType::Choice, "", 0, 0, "cone|fan", "", "rays on cones (Webots) or side by side (Enki)",
       to([](P& p, const Value& v) { p.layout = v.text == "fan" ? RayLayout::Fan : RayLayout::Cone; })},
      {"colour_rule", ValueType::Choice, "", 0, 0, "old|new|none", "",
       "old: distances are divided by 0.2 + 0.8 red; new: the red part also shrinks with roughness",
       to([](P& p, const Value& v) {
         p.colour_rule = v.text == "old"   ? ColourRule::Old
                         : v.text == "new" ? ColourRule::New
                                           : ColourRule::None;
       })},
      {"noise_law", ValueType::Choice, "", 0, 0, "uniform|gaussian", "",
       "what the table's third column means: half width or standard deviation", to([](P& p, const Value& v) {
         p.noise_law = v.text == "uniform" ? NoiseLaw::Uniform : NoiseLaw::Gaussian;
       })},
      {"noise_scale", ValueType::Number, "", 0, 1000, "", "1",
       "factor on the table's noise; 0 switches it off",
       to([](P& p, const Value& v) { p.noise_scale = v.number; })},
  };
}

std::vector<KeySpec> own_proximity_keys() {
  return proximity_keys<ProximitySettings>([](ProximitySettings& p) -> ProximitySettings& { return p; });
}

}  // namespace

SectionSpec lamp_section() {
  using P = LampDesc;
  return {
      "lamp",
      true,
      "A point light. Bodies cast shadows.",
      {
          {"name", ValueType::Text, "", 0, 0, "", "", "",
           into<P>([](P& p, const Value& v) { p.name = v.text; })},
          {"position", ValueType::Triple, "m", -kFar, kFar, "", "required", "x, y and z",
           into<P>([](P& p, const Value& v) {
             p.position_m = {v.numbers[0], v.numbers[1], v.numbers[2]};
           })},
          {"intensity", ValueType::Number, "W/m2", 0, 10000, "", "1",
           "on a surface that faces it, before attenuation",
           into<P>([](P& p, const Value& v) { p.intensity_w_m2 = v.number; })},
          {"attenuation", ValueType::Triple, "1, 1/m, 1/m2", 0, 1e6, "", "[1, 0, 0]",
           "a, b, c: light at d metres is divided by a + b d + c d2",
           checked<P>([](P& p, const Value& v, const WorldDesc&) {
             if (v.numbers[0] + v.numbers[1] + v.numbers[2] <= 0) {
               return std::string("got [0, 0, 0], expected at least one number above 0");
             }
             p.attenuation = {v.numbers[0], v.numbers[1], v.numbers[2]};
             return std::string();
           })},
          {"colour", ValueType::Colour, "", 0, 1, "", "[1, 1, 1]", "red, green, blue; sensors see the mean",
           into<P>([](P& p, const Value& v) { p.colour = colour_of(v); })},
          {"on", ValueType::Flag, "", 0, 0, "", "true", "",
           into<P>([](P& p, const Value& v) { p.on = v.flag; })},
          node_key<P>(),
      }};
}

SectionSpec proximity_section() {
  return {"proximity", false,
          "Proximity sensors of all robots. `[robot.proximity]` and `[[robot.sensor]]` take the same keys "
          "for one robot "
          "and one sensor; the nearest setting counts.",
          own_proximity_keys()};
}

SectionSpec robot_proximity_section() {
  return {"robot.proximity", false, "Proximity sensors of this robot; keys as in `[proximity]`.",
          own_proximity_keys()};
}

SectionSpec robot_sensor_section() {
  using S = SensorDesc;
  return {"robot.sensor", true, "One proximity sensor of this robot; keys as in `[proximity]`.",
          joined({{"index", ValueType::Integer, "", 0, 63, "", "required", "which sensor",
                   into<S>([](S& t, const Value& v) { t.index = static_cast<int>(v.integer); })}},
                 proximity_keys<S>([](S& s) -> ProximitySettings& { return s.proximity; }))};
}

}  // namespace sim
