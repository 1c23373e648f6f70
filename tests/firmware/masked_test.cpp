// SPDX-License-Identifier: MIT
// A program that masks the library's handlers: motors stand, samples are lost; agendas that take too long are
// told. The same with both HALs.
#include "tests/support/firmware_test.h"
#include "tests/support/wording.h"

namespace {

using firmware_test::FirmwareTest;
using firmware_test::Robot;

class Masked : public FirmwareTest {};

const char* kHead = R"(
#include <p30F6014A.h>
extern unsigned int tickAdcIsr;
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
volatile int phase;
void wait_ms(int ms) { volatile int i; for (; ms > 0; ms--) for (i = 0; i < 1000; i++); }
void drive(void) {
  e_init_port(); e_init_motors(); e_init_ad_scan(ALL_ADC); e_start_agendas_processing();
  e_set_speed_left(1000); e_set_speed_right(-700);
}
)";

TEST_F(Masked, motors_and_scan_stand_while_the_processors_priority_is_7) {
  Robot& r = add_robot_with_source(std::string(kHead) + R"(
unsigned int frames[2];
int main(void) {
  drive();
  wait_ms(100); SRbits.IPL = 7; phase = 1; frames[0] = tickAdcIsr;
  wait_ms(200); frames[1] = tickAdcIsr; phase = 2; SRbits.IPL = 0;
  while (1); })");
  while (r.variable("phase") == 0 && now_s() < 2) run_for(0.005);
  const auto left = r.left_steps(), right = r.right_steps();
  EXPECT_GT(left, 50);
  EXPECT_LT(right, -30);
  while (r.variable("phase") == 1 && now_s() < 4) {
    EXPECT_NEAR(static_cast<double>(r.left_steps()), static_cast<double>(left), 1) << now_s();
    EXPECT_NEAR(static_cast<double>(r.right_steps()), static_cast<double>(right), 1) << now_s();
    run_for(0.005);
  }
  const auto frames = r.variables<std::uint16_t>("frames", 2);
  EXPECT_EQ(frames[0], frames[1]);
  run_for(0.5);
  EXPECT_NEAR(static_cast<double>(r.left_steps() - left), 500, 8);
  EXPECT_NEAR(static_cast<double>(r.right_steps() - right), -357, 8);
}

TEST_F(Masked, motors_stand_while_disi_holds) {
  Robot& r = add_robot_with_source(std::string(kHead) + R"(
int main(void) {
  int i;
  drive();
  wait_ms(100); phase = 1;
  for (i = 0; i < 400; i++) { __asm__ volatile("disi #0x3FFF"); wait_ms(1); if (i == 200) phase = 2; }
  while (1); })");
  while (r.variable("phase") == 0 && now_s() < 2) run_for(0.005);
  const auto left = r.left_steps();
  while (r.variable("phase") == 1 && now_s() < 4) run_for(0.005);
  EXPECT_NEAR(static_cast<double>(r.left_steps()), static_cast<double>(left), 8);
  run_for(2);
  EXPECT_GT(r.left_steps(), left + 800);
}

TEST_F(Masked, an_agenda_that_takes_longer_than_its_timer_is_told) {
  Robot& r = add_robot_with_source(std::string(kHead) + R"(
void slow(void) { wait_ms(2); phase++; }
int main(void) { drive(); e_activate_agenda(slow, 100); while (1); })");
  run_for(1);
  EXPECT_GT(r.variable("phase"), 20);
  ASSERT_EQ(r.diagnoses().size(), 2u) << r.diagnoses_text();
  for (const auto& d : r.diagnoses()) EXPECT_EQ(d.cause, "missed interrupt") << d.message;
  EXPECT_TRUE(wording::reads(
      r.diagnoses_text(),
      "ADC: missed interrupt: ADC: an event came while its flag was still set and enabled; the handler runs "
      "once for several (too slow, or held off too long); meanwhile wait_ms() (main.c:9) ran, called by the "
      "handler of T2; make the handler shorter, raise its priority, or allow nesting (INTCON1.NSTDIS = "
      "0)\nT2: missed interrupt: T2: an event came while its flag was still set and enabled; the handler "
      "runs once for several (too slow, or held off too long); meanwhile wait_ms() (main.c:9) ran, called by "
      "the handler of T2; make the handler shorter, raise its priority, or allow nesting (INTCON1.NSTDIS = "
      "0)"));
  EXPECT_GT(r.diagnoses()[0].count, 100);
}

TEST_F(Masked, short_agendas_lose_nothing) {
  Robot& r = add_robot_with_source(std::string(kHead) + R"(
void quick(void) { phase++; }
int main(void) { drive(); e_activate_agenda(quick, 10); while (1); })");
  run_for(1);
  EXPECT_EQ(r.diagnoses_text(), "");
}

}  // namespace
