// SPDX-License-Identifier: MIT
// What the library's handlers take of a program's time, in both ways: rounds of a loop in half a million
// cycles beside those of the same loop alone.
#include "hal_sim/api/timings.h"
#include "tests/register/register_fixture.h"

namespace register_test {
namespace {

constexpr double kInterval = 2000 * 256, kUartBurst = 4 * 1280, kCodecGroup = 8192;  // cycles

class HandlersTake : public firmware_test::FirmwareTest, public ::testing::WithParamInterface<const char*> {
 protected:
  HandlersTake() { options.way = GetParam(); }
  /// Cycles that are missing in the loop after `begin` has run.
  double missing_after(const std::string& begin) {
    Robot& robot = add_robot_with_source(R"(
#include <p30F6014A.h>
#include <camera/fast_2_timer/e_poxxxx.h>
#include <codec/e_sound.h>
#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>
extern volatile int _poxxxx_current_row;
volatile int done;
unsigned long rounds[2];
char text[3200];
static void __attribute__((noinline)) count(int which) {
  unsigned long n = 0;
  TMR3 = 0;
  while (TMR3 < 2000) n++;
  rounds[which] = n;
}
int main(void) {
  e_init_port();
  T3CON = 0; PR3 = 0xFFFF; T3CONbits.TCKPS = 3; T3CONbits.TON = 1;
  count(0);
  )" + begin + R"(
  count(1);
  done = 1;
  for (;;);
})");
    EXPECT_TRUE(run_until([&] { return robot.variable("done") == 1; }, 4));
    const auto rounds = robot.variables<std::uint32_t>("rounds", 2);
    return kInterval * (1 - static_cast<double>(rounds[1]) / rounds[0]);
  }
};
INSTANTIATE_TEST_SUITE_P(Both, HandlersTake, ::testing::Values("native", "register"),
                         [](const auto& p) { return std::string(p.param); });

TEST_P(HandlersTake, of_text_that_is_sent) {
  const double expected = kInterval / kUartBurst * T_UART_BURST;  // 8500
  EXPECT_NEAR(missing_after("e_init_uart1(); e_send_uart1_char(text, 1000);"), expected, 0.03 * expected);
}

TEST_P(HandlersTake, of_a_codec_that_is_silent) {
  const double expected = kInterval / kCodecGroup * T_DCI_IDLE;  // 2437
  EXPECT_NEAR(missing_after("e_init_sound();"), expected, 0.05 * expected);
}

TEST_P(HandlersTake, of_a_sound) {
  const double expected = kInterval / kCodecGroup * T_DCI_BUSY;  // 9750
  EXPECT_NEAR(missing_after("e_init_sound(); e_play_sound(0, 2112);"), expected, 0.03 * expected);
}

// 40 lines of 40 pixels of two bytes each; all but five are taken in the interval
TEST_P(HandlersTake, of_a_picture) {
  const double lines = missing_after(
                           "e_poxxxx_init_cam(); e_poxxxx_config_cam(240, 160, 160, 160, 4, 4, RGB_565_MODE);"
                           "e_poxxxx_write_cam_registers(); e_poxxxx_launch_capture(text);"
                           "while (_poxxxx_current_row < 5);") /
                       (T_CAMERA_LINE + 8 * 80);
  EXPECT_NEAR(lines, 35, 0.1);
}

}  // namespace
}  // namespace register_test
