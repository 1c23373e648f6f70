// SPDX-License-Identifier: MIT
// The file itself, [world], [[material]], [arena], [floor] and [[wall]].
#include <fmt/format.h>

#include "sim_core/base/clock.h"
#include "sim_core/load/schema_keys.h"
#include "sim_core/load/schema_sections.h"

namespace sim {

std::string find_material(const WorldDesc& draft, const std::string& name, Material& out) {
  std::string known;
  for (const Material& m : draft.materials) {
    if (m.name == name) {
      out = m;
      return {};
    }
    known += (known.empty() ? "" : ", ") + m.name;
  }
  return fmt::format("got \"{}\", expected the name of a [[material]]{}", name,
                     known.empty() ? " (there are none)" : " (" + known + ")");
}

SectionSpec file_section() {
  using W = WorldDesc;
  return {"",
          false,
          "The file itself.",
          {
              {"twinpuck", ValueType::Integer, "", kWorldFormatVersion, kWorldFormatVersion, "", "required",
               "version of this format", into<W>([](W&, const Value&) {})},
              {"title", ValueType::Text, "", 0, 0, "", "\"\"", "shown in pictures and lists",
               into<W>([](W& w, const Value& v) { w.title = v.text; })},
          }};
}

SectionSpec world_section() {
  using W = WorldDesc;
  return {
      "world", false, "Physics and chance.",
      joined(
          {
              {"physics_hz", ValueType::Integer, "Hz", 32, 4096, "", "512",
               "ticks per second; must divide 14,745,600: 96, 128, 256, 512, 1024 and others",
               checked<W>([](W& w, const Value& v, const WorldDesc&) {
                 if (kClicksPerSecond % v.integer != 0) {
                   return fmt::format("got {} Hz, expected a divisor of {} such as 96, 128, 256, 512, 1024",
                                      v.integer, kClicksPerSecond);
                 }
                 w.physics_hz = static_cast<int>(v.integer);
                 return std::string();
               })},
              {"engine", ValueType::Choice, "", 0, 0, "dynamic|kinematic|planar", "\"dynamic\"",
               "dynamic: traction, slip, pushing, falling; kinematic: no forces, robots stop at contacts; "
               "planar: two dimensions, wheels never slip, movable objects are pushed, no heights "
               "(worlds.md)",
               into<W>([](W& w, const Value& v) {
                 w.engine = v.text == "dynamic"     ? Engine::Dynamic
                            : v.text == "kinematic" ? Engine::Kinematic
                                                    : Engine::Planar;
               })},
              {"gravity", ValueType::Number, "m/s2", 0.01, 100, "", "9.81", "downwards",
               into<W>([](W& w, const Value& v) { w.gravity_m_s2 = v.number; })},
              {"seed", ValueType::Integer, "", 0, 9e18, "", "1", "of all that is left to chance",
               into<W>([](W& w, const Value& v) { w.seed = static_cast<std::uint64_t>(v.integer); })},
              {"ambient", ValueType::Number, "W/m2", 0, 10000, "", "0",
               "light that reaches every sensor from everywhere",
               into<W>([](W& w, const Value& v) { w.ambient_w_m2 = v.number; })},
          },
          wheel_keys<W>("0", "\"uniform\""))};
}

SectionSpec material_section() {
  using M = Material;
  return {"material",
          true,
          "How a surface looks and feels. Walls and objects refer to it by name.",
          {
              {"name", ValueType::Text, "", 0, 0, "", "required", "what others write in `material`",
               into<M>([](M& m, const Value& v) { m.name = v.text; })},
              {"colour", ValueType::Colour, "", 0, 1, "", "[1, 1, 1]", "red, green, blue",
               into<M>([](M& m, const Value& v) { m.colour = colour_of(v); })},
              {"ir_reflectance", ValueType::Number, "", 0, 1, "", "",
               "what proximity sensors take for red; without it the red part of the colour",
               into<M>([](M& m, const Value& v) { m.ir_reflectance = v.number; })},
              {"roughness", ValueType::Number, "", 0, 1, "", "0",
               "0 mirror to 1 matt; only the new colour rule asks for it",
               into<M>([](M& m, const Value& v) { m.roughness = v.number; })},
              {"friction", ValueType::Number, "", 0, 10, "", "0.3", "Coulomb coefficient of the sides",
               into<M>([](M& m, const Value& v) { m.friction = v.number; })},
              {"restitution", ValueType::Number, "", 0, 1, "", "0", "bounce",
               into<M>([](M& m, const Value& v) { m.restitution = v.number; })},
          }};
}

SectionSpec arena_section() {
  using A = ArenaDesc;
  return {
      "arena", false, "A rectangle with four walls. Without it the floor is endless.",
      joined(
          {
              {"size", ValueType::Pair, "m", 0.01, kFar, "", "required", "inside measures along x and y",
               into<A>([](A& a, const Value& v) {
                 a.size_m = {v.numbers[0], v.numbers[1]};
               })},
              {"centre", ValueType::Pair, "m", -kFar, kFar, "", "[0, 0]", "where its middle lies",
               into<A>([](A& a, const Value& v) {
                 a.centre_m = {v.numbers[0], v.numbers[1]};
               })},
              {"wall_height", ValueType::Number, "m", 0, kFar, "", "0.1", "0 leaves the arena without walls",
               into<A>([](A& a, const Value& v) { a.wall_height_m = v.number; })},
              {"wall_thickness", ValueType::Number, "m", kThin, 10, "", "0.01", "",
               into<A>([](A& a, const Value& v) { a.wall_thickness_m = v.number; })},
          },
          material_keys<A>())};
}

SectionSpec floor_section() {
  using F = FloorDesc;
  return {"floor",
          false,
          "What robots drive on.",
          {
              {"colour", ValueType::Colour, "", 0, 1, "", "[0.93, 0.93, 0.9]", "red, green, blue",
               into<F>([](F& f, const Value& v) { f.colour = colour_of(v); })},
              {"ir_reflectance", ValueType::Number, "", 0, 1, "", "", "without it the red part of the colour",
               into<F>([](F& f, const Value& v) { f.ir_reflectance = v.number; })},
              {"image", ValueType::Text, "", 0, 0, "", "",
               "PNG file stretched over the arena, north up; relative to this file",
               into<F>([](F& f, const Value& v) { f.image = v.text; })},
              {"friction", ValueType::Number, "", 0, 10, "", "1", "factor on the traction of wheels",
               into<F>([](F& f, const Value& v) { f.friction = v.number; })},
              {"tilt", ValueType::Pair, "deg", -40, 40, "", "[0, 0]",
               "the whole floor, with all that stands on it, rises by these angles along +x and along +y",
               into<F>([](F& f, const Value& v) {
                 f.tilt_x_rad = radians(v.numbers[0]), f.tilt_y_rad = radians(v.numbers[1]);
               })},
          }};
}

SectionSpec wall_section() {
  using L = WallDesc;
  return {
      "wall", true, "A line of walls with square corners.",
      joined(
          {
              {"points", ValueType::Points, "m", -kFar, kFar, "", "required",
               "corners of the middle line, two or more",
               checked<L>([](L& w, const Value& v, const WorldDesc&) {
                 w.points_m = points_of(v);
                 if (w.points_m.size() < 2)
                   return fmt::format("got {} point(s), expected at least 2", w.points_m.size());
                 for (std::size_t i = 1; i < w.points_m.size(); ++i) {
                   if (length(w.points_m[i] - w.points_m[i - 1]) < kThin) {
                     return fmt::format(
                         "got points {} and {} at the same place, expected at least {} m between them", i - 1,
                         i, kThin);
                   }
                 }
                 return std::string();
               })},
              {"closed", ValueType::Flag, "", 0, 0, "", "false", "true: the last point joins the first",
               checked<L>([](L& w, const Value& v, const WorldDesc&) {
                 w.closed = v.flag;
                 if (v.flag &&
                     (w.points_m.size() < 3 || length(w.points_m.back() - w.points_m.front()) < kThin)) {
                   return std::string("got true, expected three or more points, the last not on the first");
                 }
                 return std::string();
               })},
              {"thickness", ValueType::Number, "m", kThin, 10, "", "0.01", "",
               into<L>([](L& w, const Value& v) { w.thickness_m = v.number; })},
              {"height", ValueType::Number, "m", kThin, kFar, "", "0.1", "",
               into<L>([](L& w, const Value& v) { w.height_m = v.number; })},
              {"z", ValueType::Number, "m", 0, kFar, "", "0",
               "height of its underside: a gate robots pass under",
               into<L>([](L& w, const Value& v) { w.z_m = v.number; })},
          },
          material_keys<L>())};
}

}  // namespace sim
