// SPDX-License-Identifier: MIT
// Keys of the world file that only cameras care for.
#include "sim_core/load/schema_keys.h"

namespace sim {

std::vector<SectionSpec> camera_sections() {
  using S = SkyDesc;
  return {{"sky",
           false,
           "What cameras see where nothing stands, and the even light in the room.",
           {
               {"colour", ValueType::Colour, "", 0, 1, "", "[0.72, 0.8, 0.9]", "red, green, blue",
                into<S>([](S& s, const Value& v) { s.colour = colour_of(v); })},
               {"light", ValueType::Number, "W/m2", 0, 10000, "", "1",
                "light on the floor from everywhere, for cameras only; upright faces get 0.8 of it",
                into<S>([](S& s, const Value& v) { s.light_w_m2 = v.number; })},
           }}};
}

std::vector<KeySpec> robot_camera_keys() {
  using R = RobotDesc;
  return {
      {"camera", ValueType::Choice, "", 0, 0, "po3030k|po6030k|po8030d|none", "",
       "image sensor; without it the usual one of the robot's revision",
       into<R>([](R& r, const Value& v) { r.camera = v.text; })},
      {"camera_mount", ValueType::Choice, "", 0, 0, "upright|sideways|inverted", "\"upright\"",
       "how the sensor sits: upright pictures with the library's own settings, turned by a quarter as on "
       "many robots "
       "of the first series, or by a half",
       into<R>([](R& r, const Value& v) { r.camera_mount = v.text; })},
      {"camera_noise", ValueType::Number, "", 0, 100, "", "1",
       "factor on the camera's noise; 0 switches it off",
       into<R>([](R& r, const Value& v) { r.camera_noise = v.number; })},
  };
}

}  // namespace sim
