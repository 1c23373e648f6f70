// SPDX-License-Identifier: MIT
// What the configuration word FOSC makes of the robot's crystal of 7.3728 MHz: the rate of instructions,
// which for nearly all programs is 14.7456 million a second. A program that chooses another one runs on a
// robot whose clock is faster or slower by that factor. Not modelled: the board's own times (rotor, camera,
// Bluetooth module, battery) are counted in cycles of that clock and change with it; clock switching. Source:
// [DS70143 20], tables of the oscillator; the crystal [lib: motor_led/e_epuck_ports.h].
#pragma once
#include <cstdint>
#include <string>

namespace chip {

/// Instructions a second; 0: this source of clock does not exist on the robot.
double instruction_rate_hz(std::uint16_t fosc);

/// That rate over the usual one; 1 for a source that the robot has not.
double clock_factor(std::uint16_t fosc);

/// Error of a robot's clock whose crystal is off by `crystal_ppm`, against the usual rate.
double clock_ppm(double crystal_ppm, std::uint16_t fosc);

/// Why a program with this word cannot run here; empty: it can.
std::string clock_problem(std::uint16_t fosc);

}  // namespace chip
