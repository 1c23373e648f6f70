// SPDX-License-Identifier: MIT
// One proximity or light sensor of a robot explained from the world to the library's number:
// what `twinpuck inspect` prints. Rays and lamps come from sim_core/light/explain.h, volts and
// counts from the board.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "hal_sim/board/board.h"
#include "hal_sim/twin/twin.h"
#include "sim_core/light/explain.h"

namespace outputs {

/// A sample as the converter sees it.
struct Sample {
  double volts = 0;  ///< V at the input, without noise, 0 to 3.3
  int counts = 0;    ///< what a conversion without noise gives, 0 to 4095
};

struct SensorReport {
  std::string world, robot;
  int robot_index = 0;
  int sensor = 0;
  double at_s = 0;
  double heading_rad = 0;
  sim::ProximityExplanation proximity;
  sim::LightExplanation light;
  double gain = 1, offset_counts = 0;  ///< of this robot's sensor
  double flash_us = 0;                 ///< from the emitter's start to the lit sample
  board::IrConversion dark_made_of, lit_made_of;
  Sample dark, lit;
  int prox_counts = 0;      ///< e_get_prox without noise
  double noise_counts = 0;  ///< half width (uniform) or standard deviation of the lit sample, counts
  int band_low = 0;         ///< e_get_prox lies between these, always (uniform) or in 95 of 100 samples
  int band_high = 0;
  bool firmware_scans = false;  ///< the program has started the ADC scan and both samples have arrived
  int held_dark = 0, held_lit = 0;
};

/// Explains the sensor at the world's present instant.
SensorReport report_sensor(twin::Twin& twin, const std::string& world_file, int robot, int sensor);

std::string to_text(const SensorReport& report);
nlohmann::ordered_json to_json(const SensorReport& report);
/// One line of an overview of all sensors; `overview_head()` is the line above.
std::string overview_line(const SensorReport& report);
std::string overview_head();

}  // namespace outputs
