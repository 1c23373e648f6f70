// SPDX-License-Identifier: MIT
// A world whose robots run the register way.
#pragma once
#include "hal_sim/host/compiled_runner.h"
#include "tests/support/firmware_test.h"

namespace register_test {

using firmware_test::Robot;

class RegisterTest : public firmware_test::FirmwareTest {
 protected:
  RegisterTest() { options.way = "register"; }
  host::CompiledRunner& runner(int robot = 0) {
    return dynamic_cast<host::CompiledRunner&>(*twin().mind(robot).runner());
  }
};

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

}  // namespace register_test
