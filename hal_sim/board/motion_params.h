// SPDX-License-Identifier: MIT
// Every number of the accelerometers and the gyroscope, each with one source (tags as in epuck_params.h).
//
// How the analogue part's scale was chosen. The library's comments say "about 800" per g; its constant
// GRAVITY, which e_acc_calibr() takes for 1 g, is 768; and on revision 1.3 it scales 16384 per g down by 1/16
// - 1/64, to exactly 768. The MMA7260QT at +-2 g gives 600 mV/g nominal, 744 counts, up to 645 mV/g. 768
// counts (619 mV/g) is within the part's tolerance and the only value with which calibrated readings obey
// trigonometry; before calibration the library's centre of 2000 then shows 816 at rest, its "about 800".
#pragma once
#include "hal_sim/board/cycle.h"

namespace board {

inline constexpr double kStandardGravityMS2 =
    9.81;  // what 1 g means here [assumed: the worlds' default gravity]

// --- MMA7260QT on AN5 to AN7, before revision 1.3
inline constexpr double kAccCountsPerG = 768;   // GRAVITY [lib: a_d/advance_ad_scan/e_acc.h]
inline constexpr double kAccZeroCounts = 2048;  // 0 g is half the supply [lib: a_d/advance_ad_scan/e_acc.c]
inline constexpr double kAccRailV = 0.25;  // the output ends this far from both supplies [MMA7260QT table 2]
inline constexpr double kAccPoleXyHz = 350;          // [MMA7260QT table 2]
inline constexpr double kAccPoleZHz = 150;           // [MMA7260QT table 2]
inline constexpr double kAccNoiseGPerRtHz = 350e-6;  // [MMA7260QT table 2]

// --- LSM330 on the I2C bus, revision 1.3
inline constexpr unsigned char kLsmAccAddress = 0x3C;    // [lib: acc_gyro/e_lsm330.c]
inline constexpr unsigned char kLsmGyroAddress = 0xD4;   // [lib: acc_gyro/e_lsm330.c]
inline constexpr unsigned char kLsmWhoAmI = 0x0F;        // register [lib: motor_led/e_init_port.c]
inline constexpr unsigned char kLsmAccWho = 0x40;        // what it says [lib: motor_led/e_init_port.c]
inline constexpr double kLsmAccPerG = 16384;             // counts at +-2 g [lib: a_d/advance_ad_scan/e_acc.h]
inline constexpr double kLsmGyroPerDps = 1 / 0.00875;    // counts at +-250 deg/s [lib: acc_gyro/e_lsm330.c]
inline constexpr double kLsmAccNoiseGPerRtHz = 150e-6;   // [LSM330 table 3]
inline constexpr double kLsmGyroNoiseDpsPerRtHz = 0.03;  // [LSM330 table 4]
inline constexpr int kLsmTemperature = 25;               // degrees [assumed: room temperature]

}  // namespace board
