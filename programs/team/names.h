// SPDX-License-Identifier: MIT
// What the team's files share: names and words of programs, and packets in pieces.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "hal_sim/host/place.h"
#include "programs/link/packet.h"
#include "programs/process/partner.h"
#include "sim_core/world/world_desc.h"

namespace programs {

inline constexpr std::int64_t kMostStepMs = 2147483647;  // an int of the PC

/// A supervisor, and where its program is looked for.
struct NamedSupervisor {
  sim::SupervisorDesc desc;
  std::string folder;
  int of_world = -1;  ///< its number there; -1: added by the command line
};
/// The world's, and those of the command line in their places; each with a name.
std::vector<NamedSupervisor> supervisors_of(const sim::WorldDesc& world, const std::string& world_folder,
                                            const std::vector<std::string>& of_command_line,
                                            std::vector<std::string>& problems);

/// Chance for a program: made of the world's seed, and the robot's or the supervisor's name.
std::uint64_t seed_of(const sim::WorldDesc& world, int robot, const std::string& name);

/// Where a program crashed, or what is known of it, from a CRASH record.
host::Place place_of_crash(const link_record& record);

/// As many packets as it takes: a longer one is divided between records.
Partner::Sent send_in_pieces(Partner& partner, const link_packet& packet);

}  // namespace programs
