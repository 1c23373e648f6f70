// SPDX-License-Identifier: MIT
#include "hal_sim/chip/oscillator.h"

#include <cmath>
#include <cstdio>

#include "hal_sim/board/epuck_params.h"

namespace chip {

namespace {
constexpr double kCrystalHz = 7372800;     // [lib: motor_led/e_epuck_ports.h]
constexpr double kFrcHz = 7370000;         // fast internal oscillator [DS70143 20.2]
constexpr double kLprcHz = 512000;         // slow internal oscillator [DS70143 20.2]
constexpr double kClockTolerance = 0.001;  // [assumed: FRC times 8 is 0.04 % off and does as well]
constexpr int kClocksPerInstruction = 4;
enum Source : int { kLp = 0, kFrc = 1, kLprc = 2, kPrimary = 3, kPll = 7 };
}  // namespace

double instruction_rate_hz(std::uint16_t fosc) {
  const int source = fosc >> 8 & 7, primary = fosc & 31;
  switch (source) {
    case kFrc:
      return kFrcHz / kClocksPerInstruction;
    case kLprc:
      return kLprcHz / kClocksPerInstruction;
    case kPrimary:
      // XTL, HS and XT are crystals; the others want a clock or an RC network
      return primary <= 7 ? kCrystalHz / kClocksPerInstruction : 0;
    case kPll:
      break;
    default:
      return 0;
  }
  // the PLL on the fast internal oscillator [DS70143 20.2]
  switch (primary) {
    case 0x01:
      return kFrcHz * 4 / kClocksPerInstruction;
    case 0x0A:
      return kFrcHz * 8 / kClocksPerInstruction;
    case 0x03:
      return kFrcHz * 16 / kClocksPerInstruction;
    default:
      break;
  }
  // the PLL on the crystal
  const int times = 4 << ((primary & 3) - 1);  // 01, 10, 11: 4, 8, 16
  if ((primary & 3) == 0) return 0;
  switch (primary >> 2) {
    case 1:  // XT
      return kCrystalHz * times / kClocksPerInstruction;
    case 4:  // HS / 2
      return kCrystalHz / 2 * times / kClocksPerInstruction;
    case 5:  // HS / 3
      return kCrystalHz / 3 * times / kClocksPerInstruction;
    default:  // an external clock
      return 0;
  }
}

double clock_factor(std::uint16_t fosc) {
  const double factor = instruction_rate_hz(fosc) / static_cast<double>(board::kFcyHz);
  return factor == 0 || std::abs(factor - 1) <= kClockTolerance ? 1 : factor;
}

double clock_ppm(double crystal_ppm, std::uint16_t fosc) {
  const double factor = clock_factor(fosc);
  return factor == 1 ? crystal_ppm : ((1 + crystal_ppm * 1e-6) * factor - 1) * 1e6;
}

std::string clock_problem(std::uint16_t fosc) {
  if (instruction_rate_hz(fosc) > 0) return "";
  char text[200];
  std::snprintf(text, sizeof text,
                "configuration word FOSC: got 0x%04X, a source of clock that the robot has not, expected its "
                "crystal of 7.3728 MHz, as with XT_PLL8",
                static_cast<unsigned>(fosc));
  return text;
}

}  // namespace chip
