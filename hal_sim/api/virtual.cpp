// SPDX-License-Identifier: MIT
// twinpuck/virtual.h: sensors that a supervisor defines, and the simulator's console.
#include <cstring>
#include <string>

#include "hal_sim/api/host_library.h"
#include "hal_sim/board/board.h"

namespace api {

namespace {

constexpr Cycle kCycles = 20;  // [assumed: on a robot both do nothing; a call and a return]
constexpr std::size_t kLongestName = 100, kLongestText = 1 << 12;
constexpr unsigned kPsvStart = Cpu::kPsvStart, kPsvOn = dspic::sfr_bits("CORCON", "PSV");

/// A string of the program's, in RAM or among its constants; what lies beyond them is not read.
std::string text_at(Cpu& cpu, unsigned address, std::size_t longest) {
  std::string text;
  for (; text.size() < longest; ++address) {
    const unsigned ea = address & 0xFFFF;
    char c = 0;
    if (ea >= Cpu::kRamStart && ea < Cpu::kRamEnd)
      c = static_cast<char>(cpu.ram[ea - Cpu::kRamStart]);
    else if (ea >= kPsvStart && (cpu.corcon & kPsvOn))
      c = static_cast<char>(cpu.program.read(cpu.psvpag << 15 | (ea & 0x7FFE)) >> 8 * (ea & 1));
    if (c == 0) break;
    text += c;
  }
  return text;
}

}  // namespace

HostResult HostLibrary::twinpuck_virtual_sensor(const Call& call) {
  Cpu& cpu = call.cpu;
  cpu.note_effect();  // a supervisor may set it at any tick
  const auto found = board_.virtual_devices().get(text_at(cpu, call.word(0), kLongestName));
  if (found) {
    const auto value = static_cast<float>(*found);
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    cpu.write16(call.word(1), bits & 0xFFFF);
    cpu.write16((call.word(1) + 2u) & 0xFFFF, bits >> 16);
  }
  call.give(found ? 1 : 0);
  return HostResult::done(kCycles);
}

HostResult HostLibrary::twinpuck_tell(const Call& call) {
  effect(call);
  const std::string line = text_at(call.cpu, call.word(0), kLongestText) + "\n";
  board_.virtual_devices().write(line.data(), line.size());
  return HostResult::done(kCycles);
}

}  // namespace api
