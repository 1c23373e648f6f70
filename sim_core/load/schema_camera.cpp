// SPDX-License-Identifier: MIT
// [sky]: keys of the world file that only cameras care for.
#include "sim_core/load/schema_keys.h"
#include "sim_core/load/schema_sections.h"

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

}  // namespace sim
