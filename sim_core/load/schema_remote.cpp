// SPDX-License-Identifier: MIT
// [[robot.key]]: presses of a remote control that this robot receives.
#include "sim_core/load/schema_keys.h"
#include "sim_core/load/schema_sections.h"

namespace sim {

SectionSpec remote_key_section() {
  using K = KeyDesc;
  return {"robot.key",
          true,
          "Somebody presses a key of an infrared remote control (RC5) within this robot's sight.",
          {
              {"code", ValueType::Integer, "", 0, 63, "", "required",
               "which key: 0 to 9 the digits, 12 standby, 13 mute, 16 and 17 volume, 32 and 33 channel",
               into<K>([](K& k, const Value& v) { k.code = static_cast<int>(v.integer); })},
              {"time", ValueType::Number, "s", 0, 1e7, "", "required", "when it is pressed",
               into<K>([](K& k, const Value& v) { k.at_s = v.number; })},
              {"hold", ValueType::Number, "s", 0, 1e6, "", "0.1",
               "for how long; the code is sent every 0.114 s meanwhile",
               into<K>([](K& k, const Value& v) { k.hold_s = v.number; })},
              {"address", ValueType::Integer, "", 0, 31, "", "0",
               "kind of device that the remote control is for; 0 is a television",
               into<K>([](K& k, const Value& v) { k.address = static_cast<int>(v.integer); })},
          }};
}

}  // namespace sim
