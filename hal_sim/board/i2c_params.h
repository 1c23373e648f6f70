// SPDX-License-Identifier: MIT
// Numbers of the I2C bus, each with one source (the tags are those of epuck_params.h).
#pragma once
#include "hal_sim/board/epuck_params.h"

namespace board {

inline constexpr int kI2cLibraryBrg = 150;   // I2CBRG [lib: I2C/e_I2C_master_module.c]
inline constexpr Cycle kI2cEdgeCycles = 13;  // FCY / 1,111,111 Hz, the edges' share of a bit [DS70143 17.12]
// half bits of each operation
inline constexpr int kI2cByteHalves = 16;          // a byte received, acknowledge apart [DS70143 17.12]
inline constexpr int kI2cAcknowledgedHalves = 18;  // a byte sent, acknowledge included [DS70143 17.12]
inline constexpr int kI2cAcknowledgeHalves = 2;    // [DS70143 17.12]
inline constexpr int kI2cStartHalves = 2;          // [estimated: as dspic30/periph/i2c.cpp]
inline constexpr int kI2cRestartHalves = 4;        // [estimated: as dspic30/periph/i2c.cpp]
inline constexpr int kI2cStopHalves = 3;           // [estimated: as dspic30/periph/i2c.cpp]

}  // namespace board
