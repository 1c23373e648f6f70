// SPDX-License-Identifier: MIT
#include "hal_sim/board/line_damage.h"

#include "hal_sim/board/damage_params.h"
#include "sim_core/random/counter_random.h"

namespace board {

namespace {
std::uint64_t key_of(std::uint64_t seed, int robot, std::uint32_t stream) {
  return sim::random_bits({seed, static_cast<std::uint32_t>(robot), stream}, 0);
}
}  // namespace

LineDamage::LineDamage(std::uint64_t seed, int robot, int uart)
    : to_robot(key_of(seed, robot, kStreamLineIn + static_cast<std::uint32_t>(uart))),
      from_robot(key_of(seed, robot, kStreamLineOut + static_cast<std::uint32_t>(uart))) {}

bool WireDamage::carry(std::uint8_t& byte, Cycle end) {
  // three draws a byte, whatever is wrong: one fault does not change what another does
  const std::uint64_t number = 3 * bytes_++;
  const auto chance = [&](std::uint64_t draw) {
    return static_cast<double>(sim::mix64(key_ ^ (number + draw)) >> 11) * 0x1p-53;
  };
  if (cut.at(end) != 0) {
    cut_one.note(end);
    return false;
  }
  if (chance(0) < lost.at(end)) {
    lost_one.note(end);
    return false;
  }
  if (chance(1) < garbled.at(end)) {
    garbled_one.note(end);
    byte = static_cast<std::uint8_t>(byte ^ 1u << static_cast<int>(8 * chance(2)));
  }
  return true;
}

}  // namespace board
