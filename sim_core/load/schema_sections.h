// SPDX-License-Identifier: MIT
// The sections of a world file, each a table of its own: schema_<room>.cpp.
#pragma once
#include <vector>

#include "sim_core/load/schema.h"

namespace sim {

// schema_world.cpp
SectionSpec file_section();
SectionSpec world_section();
SectionSpec material_section();
SectionSpec arena_section();
SectionSpec floor_section();
SectionSpec wall_section();

std::vector<SectionSpec> camera_sections();  ///< schema_camera.cpp
SectionSpec ramp_section();                  ///< schema_ground.cpp

// schema_objects.cpp
SectionSpec box_section();
SectionSpec cylinder_section();
SectionSpec ball_section();
SectionSpec polygon_section();

std::vector<SectionSpec> sound_sections();  ///< schema_sound.cpp

// schema_light.cpp
SectionSpec lamp_section();
SectionSpec proximity_section();
SectionSpec robot_proximity_section();
SectionSpec robot_sensor_section();

// schema_radio.cpp
SectionSpec radio_section();
SectionSpec bluetooth_section();
SectionSpec robot_bluetooth_section();

// schema_robot.cpp
SectionSpec robot_section();
SectionSpec robot_variation_section();
SectionSpec robot_part_section();
SectionSpec remote_key_section();  ///< schema_remote.cpp

// schema_webots.cpp
SectionSpec webots_section();
SectionSpec robot_device_section();
SectionSpec supervisor_device_section();
SectionSpec supervisor_section();  ///< schema_supervisor.cpp

}  // namespace sim
