// SPDX-License-Identifier: MIT
// Numbers of faults; tags as in epuck_params.h.
#pragma once
#include <cstdint>

#include "sim_core/random/counter_random.h"

namespace board {

// named streams of random numbers, behind those of the board's own noise (noise.h, lsm330.cpp)
inline constexpr std::uint32_t kStreamStepLossLeft = 1000;   // [assumed: any that nobody else draws from]
inline constexpr std::uint32_t kStreamStepLossRight = 1001;  // [assumed: as above]
inline constexpr std::uint32_t kStreamLineIn = 1010;         // and the UART's number [assumed: as above]
inline constexpr std::uint32_t kStreamLineOut = 1020;        // and the UART's number [assumed: as above]

// a rotor of two coils stands at four places of an electrical turn: one that falls behind is caught by the
// same pattern a turn later
inline constexpr int kStepsOfAFall = 4;  // [lib: motor_led/e_motors.c]

}  // namespace board
