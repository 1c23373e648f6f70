// SPDX-License-Identifier: MIT
// Ramps and platforms in world files.
#include <fmt/format.h>

#include <cmath>

#include "sim_core/load/schema_keys.h"
#include "sim_core/load/schema_sections.h"

namespace sim {
namespace {

constexpr double kSteepest = 40;  // deg: no wheel holds on more, and bodies would tip

std::string set_heights(RampDesc& r, double low, double high) {
  const double most = r.size_m.x * std::tan(radians(kSteepest));
  if (high < low)
    return fmt::format("got {} m before {} m, expected the low end first; turn it by `heading`", low, high);
  if (high - low > most) {
    return fmt::format("got a rise of {} m over {} m, expected at most {:.4g} m ({} deg)", high - low,
                       r.size_m.x, most, kSteepest);
  }
  r.low_m = low;
  r.high_m = high;
  return {};
}

}  // namespace

SectionSpec ramp_section() {
  using R = RampDesc;
  return {
      "ramp",
      true,
      "A slope on the floor, or a platform. Robots drive onto it where it meets the floor, or another ramp, "
      "at "
      "the same height; its other edges are kerbs that nobody drives over. Leave 0.08 m of width for a "
      "robot.",
      {
          {"name", ValueType::Text, "", 0, 0, "", "", "shown in messages",
           into<R>([](R& r, const Value& v) { r.name = v.text; })},
          {"position", ValueType::Pair, "m", -kFar, kFar, "", "required", "x and y of its middle",
           into<R>([](R& r, const Value& v) { r.pose.x_m = v.numbers[0], r.pose.y_m = v.numbers[1]; })},
          {"size", ValueType::Pair, "m", 0.01, kFar, "", "[0.2, 0.2]",
           "seen from above: along the slope and across", into<R>([](R& r, const Value& v) {
             r.size_m = {v.numbers[0], v.numbers[1]};
           })},
          {"heading", ValueType::Number, "deg", -kMany, kMany, "", "0", "uphill, counter-clockwise from +x",
           into<R>([](R& r, const Value& v) { r.pose.heading_rad = radians(v.number); })},
          {"angle", ValueType::Number, "deg", 0, kSteepest, "", "",
           "slope; it begins on the floor. Either this or `heights`",
           into<R>([](R& r, const Value& v) { r.high_m = r.size_m.x * std::tan(radians(v.number)); })},
          {"heights", ValueType::Pair, "m", 0, 10, "", "",
           "of the low and the high end above the floor; equal ones make a platform",
           checked<R>([](R& r, const Value& v, const WorldDesc&) {
             return set_heights(r, v.numbers[0], v.numbers[1]);
           })},
          {"material", ValueType::Text, "", 0, 0, "", "",
           "name of a `[[material]]`; without it a white one is used",
           checked<R>([](R& r, const Value& v, const WorldDesc& d) {
             return find_material(d, v.text, r.material);
           })},
          {"colour", ValueType::Colour, "", 0, 1, "", "", "red, green, blue; overrides the material's colour",
           into<R>([](R& r, const Value& v) { r.material.colour = colour_of(v); })},
      }};
}

}  // namespace sim
