// SPDX-License-Identifier: MIT
// [[box]], [[cylinder]], [[ball]] and [[polygon]].
#include <fmt/format.h>

#include "sim_core/geometry/solid.h"
#include "sim_core/load/schema_keys.h"
#include "sim_core/load/schema_sections.h"

namespace sim {

namespace {

using O = ObjectDesc;

std::vector<KeySpec> object_keys(ObjectKind kind, const std::vector<KeySpec>& shape) {
  std::vector<KeySpec> keys{
      {"name", ValueType::Text, "", 0, 0, "", "", "shown in messages and pictures",
       into<O>([](O& o, const Value& v) { o.name = v.text; })},
      def_key<O>(),
      {"position", ValueType::Pair, "m", -kFar, kFar, "", kind == ObjectKind::Polygon ? "[0, 0]" : "required",
       kind == ObjectKind::Polygon ? "x and y of the origin of its points" : "x and y of its middle",
       into<O>([](O& o, const Value& v) { o.pose.x_m = v.numbers[0], o.pose.y_m = v.numbers[1]; })},
      {"z", ValueType::Number, "m", 0, kFar, "", "0",
       "height of its underside; a movable one falls from there",
       into<O>([](O& o, const Value& v) { o.z_m = v.number; })},
      {"heading", ValueType::Number, "deg", -kMany, kMany, "", "0", "counter-clockwise from +x",
       into<O>([](O& o, const Value& v) { o.pose.heading_rad = radians(v.number); })},
      {"movable", ValueType::Flag, "", 0, 0, "", "false", "true: it can be pushed and it falls",
       into<O>([](O& o, const Value& v) { o.movable = v.flag; })},
      {"mass", ValueType::Number, "kg", 1e-4, 1000, "", "0.1", "of a movable one",
       into<O>([](O& o, const Value& v) { o.mass_kg = v.number; })},
      {"friction", ValueType::Number, "", 0, 10, "", "0.5",
       "Coulomb coefficient of a movable one against whatever it stands on",
       into<O>([](O& o, const Value& v) { o.floor_friction = v.number; })},
  };
  for (KeySpec& k : material_keys<O>()) keys.push_back(std::move(k));
  keys.push_back({"restitution", ValueType::Number, "", 0, 1, "", "", "bounce; overrides the material's",
                  into<O>([](O& o, const Value& v) { o.material.restitution = v.number; })});
  keys.push_back({"model", ValueType::Text, "", 0, 0, "", "", "what cameras that recognise objects call it",
                  into<O>([](O& o, const Value& v) { o.model = v.text; })});
  keys.push_back(recognition_key<O>());
  keys.push_back(node_key<O>());
  return joined(shape, keys);
}

KeySpec height_key() {
  return {"height", ValueType::Number, "m", kThin, kFar, "", "0.1", "", into<O>([](O& o, const Value& v) {
            o.size_m.z = v.number;
          })};
}

KeySpec radius_key() {
  return {
      "radius", ValueType::Number, "m", kThin, kFar, "", "required", "", into<O>([](O& o, const Value& v) {
        o.radius_m = v.number;
      })};
}

}  // namespace

SectionSpec box_section() {
  return {"box", true, "A block.",
          object_keys(ObjectKind::Box, {{"size", ValueType::Triple, "m", kThin, kFar, "", "[0.1, 0.1, 0.1]",
                                         "along x, y and z", into<O>([](O& o, const Value& v) {
                                           o.size_m = {v.numbers[0], v.numbers[1], v.numbers[2]};
                                         })}})};
}

SectionSpec cylinder_section() {
  return {"cylinder", true, "An upright cylinder.",
          object_keys(ObjectKind::Cylinder, {radius_key(), height_key()})};
}

SectionSpec ball_section() {
  return {
      "ball", true, "A ball.",
      object_keys(ObjectKind::Ball,
                  {radius_key(),
                   {"rolling_friction", ValueType::Number, "", 0, 10, "", "0.02",
                    "of a movable one: what slows it as it rolls, as a part of its weight; counts instead of "
                    "`friction`",
                    into<O>([](O& o, const Value& v) { o.rolling_friction = v.number; })}})};
}

SectionSpec polygon_section() {
  return {"polygon", true, "An upright prism over a convex outline.",
          object_keys(
              ObjectKind::Polygon,
              {{"points", ValueType::Points, "m", -kFar, kFar, "", "required",
                "corners of a convex outline, 3 to 64, around `position` before it is turned by `heading`",
                checked<O>([](O& o, const Value& v, const WorldDesc&) {
                  o.corners_m = points_of(v);
                  if (o.corners_m.size() < 3 || o.corners_m.size() > 64) {
                    return fmt::format("got {} points, expected 3 to 64", o.corners_m.size());
                  }
                  if (!is_convex(o.corners_m)) {
                    return std::string(
                        "got a shape that is not convex, expected corners that all turn the same way; "
                        "build other shapes of several polygons");
                  }
                  return std::string();
                })},
               height_key()})};
}

}  // namespace sim
