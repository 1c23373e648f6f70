// SPDX-License-Identifier: MIT
// Numbers of the I2C bus, each with one source (the tags are those of epuck_params.h).
#pragma once
#include "hal_sim/board/epuck_params.h"

namespace board {

inline constexpr int kI2cLibraryBrg = 150;   // I2CBRG [lib: I2C/e_I2C_master_module.c]
inline constexpr Cycle kI2cEdgeCycles = 13;  // FCY / 1,111,111 Hz, the edges' share of a bit [DS70143 17.12]
inline constexpr int kI2cByteBits = 8;       // a byte received, acknowledge apart [DS70143 17.12]
inline constexpr int kI2cAcknowledgedBits = 9;  // a byte sent, acknowledge included [DS70143 17.12]
// start, repeated start, stop and acknowledge are counted as a bit each
inline constexpr int kI2cConditionBits = 1;  // [estimated: two to three half bits each]

}  // namespace board
