// SPDX-License-Identifier: MIT
// All sections in the order of docs/worlds.md. Each is a table in a file of its own, schema_<room>.cpp.
#include "sim_core/load/schema.h"

#include "sim_core/base/check.h"
#include "sim_core/load/schema_sections.h"

namespace sim {

namespace {

std::vector<SectionSpec> make_schema() {
  std::vector<SectionSpec> all{file_section(), world_section(), material_section(), arena_section(),
                               floor_section()};
  const auto add = [&all](const std::vector<SectionSpec>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  add(camera_sections());
  add({ramp_section(), wall_section(), box_section(), cylinder_section(), ball_section(), polygon_section(),
       lamp_section()});
  add(sound_sections());
  add({proximity_section(), radio_section(), bluetooth_section(), webots_section()});
  add({robot_section(), robot_variation_section(), robot_proximity_section(), robot_sensor_section(),
       robot_bluetooth_section(), robot_part_section(), remote_key_section(), robot_device_section()});
  add({supervisor_section(), supervisor_device_section()});
  return all;
}

}  // namespace

const std::vector<SectionSpec>& world_schema() {
  static const std::vector<SectionSpec> schema = make_schema();
  return schema;
}

const SectionSpec& section(const std::string& path) {
  for (const SectionSpec& s : world_schema()) {
    if (path == s.path) return s;
  }
  CHECK(false, "no such section in the schema");
  return world_schema().front();
}

}  // namespace sim
