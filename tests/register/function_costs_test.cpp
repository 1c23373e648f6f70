// SPDX-License-Identifier: MIT
// What `twinpuck cycles` and cost_of() tell of a library function is what a call costs in a run. (That both
// ways take the same is held by `twinpuck timings --check`.)
#include "hal_sim/api/timings.h"

#include "tests/register/register_fixture.h"

namespace register_test {
namespace {

// nothing that a program can read tells a share of the handlers, so none runs
class CostsInAProgram : public firmware_test::FirmwareTest {
 protected:
  CostsInAProgram() { options.way = "native"; }
  /// Cycles that a run charges for the call; the estimate for the same function in `told`.
  int charged(const std::string& function, const std::string& call, double& told) {
    Robot& robot = add_robot_with_source(
        "#include <p30F6014A.h>\n#include <motor_led/advance_one_timer/e_agenda.h>\n"
        "#include <motor_led/advance_one_timer/e_led.h>\n#include <motor_led/advance_one_timer/e_motors.h>\n"
        "volatile int done; int took[2];\n"
        "void __attribute__((noinline)) measure(int which) { TMR4 = 0; T4CONbits.TON = 1; if (which) " +
        call +
        " T4CONbits.TON = 0; took[which] = TMR4; }\n"
        "int main(void) { e_init_motors(); T4CON = 0; PR4 = 0xFFFF; measure(0); measure(1); done = 1; for "
        "(;;); }");
    EXPECT_TRUE(run_until([&] { return robot.variable("done") == 1; }, 1));
    told = robot.cost_of(function).mean;
    const auto took = robot.variables<std::uint16_t>("took", 2);
    return took[1] - took[0];
  }
};

// beside the table's cycles: the argument, CALL, and a branch that is not taken
TEST_F(CostsInAProgram, cycles_tells_what_a_speed_takes) {
  double told = 0;
  const int cycles = charged("e_set_speed_left", "e_set_speed_left(500);", told);
  EXPECT_GE(told, T_SPEED + T_SPEED_DIVISION + T_AGENDA_PASSED);
  EXPECT_NEAR(told, cycles, 4);
}

TEST_F(CostsInAProgram, cycles_tells_what_a_led_takes) {
  double told = 0;
  const int cycles = charged("e_set_front_led", "e_set_front_led(1);", told);
  EXPECT_NEAR(told, cycles, 6);
}

}  // namespace
}  // namespace register_test
