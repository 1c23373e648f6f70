// SPDX-License-Identifier: MIT
#include "programs/team/names.h"

#include <cstring>

#include "sim_core/base/hash.h"
#include "sim_core/world/variation.h"

namespace programs {

namespace {

std::string stem_of(const std::string& program) {
  std::size_t end = program.size();
  while (end > 1 && program[end - 1] == '/') --end;
  const std::string file = program.substr(0, end).substr(program.substr(0, end).find_last_of('/') + 1);
  return file.substr(0, file.find_last_of('.') == 0 ? std::string::npos : file.find_last_of('.'));
}

}  // namespace

std::vector<NamedSupervisor> supervisors_of(const sim::WorldDesc& world, const std::string& world_folder,
                                            const std::vector<std::string>& of_command_line,
                                            std::vector<std::string>& problems) {
  std::vector<NamedSupervisor> all;
  for (const sim::SupervisorDesc& desc : world.supervisors) {
    all.push_back({desc, world_folder, static_cast<int>(all.size())});
    if (desc.name.empty()) all.back().desc.name = stem_of(desc.program);
  }
  const std::size_t of_world = all.size();
  for (const std::string& given : of_command_line) {
    const std::size_t equals = given.find('=');
    const std::string name = equals == std::string::npos ? "" : given.substr(0, equals);
    const std::string program = equals == std::string::npos ? given : given.substr(equals + 1);
    NamedSupervisor* place = nullptr;
    for (std::size_t i = 0; i < of_world; ++i)
      if (name.empty() ? of_world == 1 || all[i].desc.name == stem_of(program) : all[i].desc.name == name)
        place = &all[i];
    if (!place && name.empty() && of_world > 1) {
      std::string names;
      for (std::size_t i = 0; i < of_world; ++i) names += (i ? ", " : "") + all[i].desc.name;
      problems.push_back("command line: --supervisor: got '" + given + "' for a world with several (" +
                         names + "), expected NAME=PROGRAM: whose place it takes, or another name to add it");
      continue;
    }
    if (!place) {
      all.push_back({});
      place = &all.back();
      place->desc.name = name.empty() ? stem_of(program) : name;
    }
    place->desc.program = program;
    place->folder.clear();
  }
  return all;
}

std::uint64_t seed_of(const sim::WorldDesc& world, int robot, const std::string& name) {
  if (robot >= 0) return sim::resolve_variation(world, robot).seed;
  std::uint64_t h = world.seed;
  for (const char c : name) h = sim::mix64(h ^ static_cast<unsigned char>(c));
  return h;
}

Partner::Sent send_in_pieces(Partner& partner, const link_packet& packet) {
  std::size_t from = 0;
  do {
    // whole records, as many as fit
    std::size_t to = from;
    while (to < packet.size) {
      std::uint32_t bytes;
      std::memcpy(&bytes, packet.bytes + to + 4, 4);
      if (to > from && to + 8 + bytes - from > LINK_MOST_BYTES) break;
      to += 8 + bytes;
    }
    link_packet piece{packet.bytes + from, to - from, 0, 0};
    if (const Partner::Sent sent = partner.send(piece); sent != Partner::Sent::Yes) return sent;
    from = to;
  } while (from < packet.size);
  return Partner::Sent::Yes;
}

}  // namespace programs
