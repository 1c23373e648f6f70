// SPDX-License-Identifier: MIT
#include "viewer/events.h"

#include "viewer/text_file.h"

namespace viewer {

namespace {

using Json = nlohmann::json;
constexpr std::size_t kMostDiagnoses = 200;

}  // namespace

Json serial_event(const twin::Twin& twin, int robot, int port, const std::string& bytes) {
  return {{"event", "serial"},
          {"robot", twin.world().robots[static_cast<std::size_t>(robot)].name},
          {"port", port},
          {"time_s", sim::to_seconds(twin.simulation().now())},
          {"text", latin_to_utf8(bytes)}};
}

Json trap_event(const host::TrapReport& trap) {
  return {{"event", "trap"},
          {"robot", trap.robot},
          {"kind", host::trap_name(trap.kind)},
          {"text", trap.message},
          {"place", to_string(trap.place)},
          {"file", trap.place.file},
          {"line", trap.place.line},
          {"time_s", trap.time_s}};
}

Json diagnoses_json(const twin::Twin& twin) {
  Json out = Json::array();
  for (int r = 0; r < twin.robots() && out.size() < kMostDiagnoses; ++r) {
    const host::Runner* program = twin.mind(r).runner();
    if (!program) continue;
    for (const board::Diagnosis& d : program->diagnoses()) {
      if (out.size() >= kMostDiagnoses) break;
      out.push_back({{"robot", program->name()},
                     {"time_s", d.first_s},
                     {"cause", d.cause},
                     {"place", d.place},
                     {"text", d.message},
                     {"hint", d.hint}});
    }
  }
  return out;
}

}  // namespace viewer
