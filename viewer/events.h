// SPDX-License-Identifier: MIT
// What a page is told of a run, as JSON (docs/connecting.md, "events"); a report has the same.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "hal_sim/twin/twin.h"

namespace viewer {

/// Text that a robot sent; `port` 0: of a console, which is UTF-8 already.
nlohmann::json serial_event(const twin::Twin& twin, int robot, int port, const std::string& bytes);
nlohmann::json trap_event(const host::TrapReport& trap);
/// What board and chip say about the programs, robot by robot.
nlohmann::json diagnoses_json(const twin::Twin& twin);

}  // namespace viewer
