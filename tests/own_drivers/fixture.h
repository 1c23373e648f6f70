// SPDX-License-Identifier: MIT
// A world whose robots run programs that reach the registers themselves. Each test runs with both HALs:
// hal_sim, and hal_dspic by TWINPUCK_HAL=dspic (own_drivers_dspic_test).
#pragma once
#include "tests/support/firmware_test.h"

namespace own_drivers {

using firmware_test::Robot;
using OwnDrivers = firmware_test::FirmwareTest;

/// What every program below begins with.
inline const char* const kHead = R"(
#include "p30f6014A.h"
#include "epuck_ports.h"
_FOSC(CSW_FSCM_OFF & XT_PLL8);
_FWDT(WDT_OFF);
_FBORPOR(PBOR_OFF & BORV_20 & PWRT_16 & MCLR_EN);
_FGS(CODE_PROT_OFF);
)";

inline std::string program(const std::string& rest) { return kHead + rest; }

}  // namespace own_drivers
