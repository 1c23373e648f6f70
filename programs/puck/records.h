// SPDX-License-Identifier: MIT
// Records that both kinds of bodies write, robots and supervisors without one, and when a
// step of either ends.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "programs/link/packet.h"
#include "sim_core/base/clock.h"
#include "sim_core/radio/packet_medium.h"

namespace programs {

/// World time of so many ms since a program began. Rounded from the whole time, for a ms is no
/// whole number of clicks.
inline sim::Clicks clicks_of_ms(std::int64_t ms) { return (ms * (sim::kClicksPerSecond / 200) + 2) / 5; }
/// The last ms that has begun.
inline std::int64_t ms_of_clicks(sim::Clicks at) { return (5 * at + 2) / (sim::kClicksPerSecond / 200); }

/// DEVICE: `number` counts from 0, its tag from 1.
inline void put_device(link_packet& to, std::size_t number, int node, const std::string& name,
                       const std::vector<double>& needs) {
  link_begin(&to, LINK_DEVICE);
  link_int(&to, static_cast<std::int64_t>(number) + 1);
  link_int(&to, node);
  link_text(&to, name.c_str());
  link_text(&to, "");
  link_numbers(&to, needs.data(), needs.size());
  link_end(&to);
}

inline void put_nothing(link_packet& to, const std::string& why) {
  link_begin(&to, LINK_NOTHING);
  link_text(&to, why.c_str());
  link_end(&to);
}

/// PACKET; `way`: to its sender, in the axes that the program is told.
inline void put_packet(link_packet& to, std::int64_t tag, const sim::ReceivedPacket& packet,
                       const sim::Vec3& way) {
  link_begin(&to, LINK_PACKET);
  link_int(&to, tag);
  link_int(&to, packet.channel);
  link_bytes(&to, packet.bytes.data(), packet.bytes.size());
  for (const double number : {packet.strength, way.x, way.y, way.z}) link_number(&to, number);
  link_end(&to);
}

}  // namespace programs
