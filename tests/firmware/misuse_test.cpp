// SPDX-License-Identifier: MIT
// What the library does something else with than its name says is told, once (docs/controllers.md).
#include <map>

#include "tests/support/firmware_test.h"
#include "tests/support/wording.h"

namespace {

using firmware_test::FirmwareTest;
using firmware_test::Robot;

class Misuse : public FirmwareTest {};

const char* kHead = R"(
#include <p30F6014A.h>
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
volatile int calls;
void work(void) { calls++; }
)";

TEST_F(Misuse, an_led_that_is_none_is_told_once) {
  Robot& r = add_robot_with_source(std::string(kHead) + R"(
int main(void) { int i; e_init_port(); e_set_led(8, 0);
  for (i = 0; i < 5; i++) e_set_led(12, 1);
  while (1); })");
  run_for(0.1);
  ASSERT_EQ(r.diagnoses().size(), 1u) << r.diagnoses_text();
  EXPECT_EQ(r.diagnoses()[0].count, 5);
  EXPECT_EQ(
      r.diagnoses_text(),
      "e_set_led(): LED out of range: got LED 12, expected 0 to 7, or 8 for all; the library sets all "
      "eight; called at main() (main.c:11); count from 0; body and front have functions of their own\n");
  EXPECT_EQ(r.leds() & 0xFF, 0xFFu);
}

TEST_F(Misuse, a_speed_beyond_the_motors_is_told_for_each_wheel) {
  Robot& r = add_robot_with_source(std::string(kHead) + R"(
int main(void) { e_init_port(); e_init_motors(); e_start_agendas_processing();
  e_set_speed_left(1000); e_set_speed_right(-1000); e_set_speed_left(1200);
  e_set_speed_right(-1001); e_set_speed_right(-2000); while (1); })");
  run_for(0.1);
  ASSERT_EQ(r.diagnoses().size(), 2u) << r.diagnoses_text();
  EXPECT_TRUE(wording::reads(
      r.diagnoses_text(),
      "e_set_speed_left(): speed out of range left: got 1200 steps/s, expected -1000 to 1000; the library "
      "takes the nearest of these; called at main() (main.c:11); the motors are not "
      "faster\ne_set_speed_right(): speed out of range right: got -1001 steps/s, expected -1000 to 1000; the "
      "library takes the nearest of these; called at main() (main.c:12); the motors are not faster"));
  EXPECT_EQ(r.diagnoses()[1].count, 2);
}

// the original's, too: each call begins the half step anew
TEST_F(Misuse, a_speed_that_is_set_all_the_time_is_told) {
  Robot& busy = add_robot_with_source(std::string(kHead) + R"(
int main(void) { e_init_port(); e_init_motors(); e_start_agendas_processing();
  while (1) { e_set_speed_left(500); e_set_speed_right(500); } })");
  Robot& once = add_robot_with_source(std::string(kHead) + R"(
int main(void) { e_init_port(); e_init_motors(); e_start_agendas_processing();
  e_set_speed_left(500); e_set_speed_right(500); while (1); })")
                    .at(0.5, 0);
  Robot& turns = add_robot_with_source(std::string(kHead) + R"(
int main(void) { int i; e_init_port(); e_init_motors(); e_start_agendas_processing();
  for (i = 0;; i = (i + 1) % 1000) { e_set_speed_left(500 - i); e_set_speed_right(i - 500); } })")
                     .at(-0.5, 0);
  run_for(2.5);
  ASSERT_EQ(busy.diagnoses().size(), 2u) << busy.diagnoses_text();
  EXPECT_EQ(busy.diagnoses()[0].cause, "wheel slow");
  EXPECT_TRUE(
      wording::reads(busy.diagnoses()[0].message,
                     "got 500 steps/s, … times a second, and the wheel makes 249: each call stretches "
                     "the step that is under way; set at main() (main.c:11)"))
      << busy.diagnoses()[0].message;
  EXPECT_EQ(once.diagnoses_text() + turns.diagnoses_text(), "");
}

// under either HAL, whether the library's code calls the functions of both wheels or not
TEST_F(Misuse, what_e_set_speed_sets_is_told_of_both_wheels) {
  Robot& busy = add_robot_with_source(std::string(kHead) + R"(
int main(void) { e_init_port(); e_init_motors(); e_start_agendas_processing();
  while (1) e_set_speed(400, 100); })");
  Robot& held = add_robot_with_source(std::string(kHead) + R"(
int main(void) { e_init_port(); e_init_motors(); e_start_agendas_processing();
  e_set_speed(300, 0); IEC0bits.T2IE = 0; while (1); })")
                    .at(0.5, 0);
  Robot& refused = add_robot_with_source(std::string(kHead) + R"(
int main(void) { e_init_port(); e_init_motors(); e_start_agendas_processing();
  e_set_speed(900, 200); while (1); })")
                       .at(-0.5, 0);
  run_for(12);
  const auto is_of_both = [](const Robot& r, const std::string& cause) {
    const auto told = r.diagnoses();
    return told.size() == 2 && told[0].cause == cause && told[1].cause == cause &&
           told[0].place == "e_set_speed_left()" && told[1].place == "e_set_speed_right()";
  };
  EXPECT_TRUE(is_of_both(busy, "wheel slow")) << busy.diagnoses_text();
  EXPECT_TRUE(is_of_both(held, "wheel stands")) << held.diagnoses_text();
  ASSERT_EQ(refused.diagnoses().size(), 1u) << refused.diagnoses_text();
  EXPECT_EQ(refused.diagnoses()[0].cause, "speed out of range");
}

// what the robot does not do is no success here: neither ever switches its LED on
TEST_F(Misuse, a_scan_that_is_held_off_and_agendas_beyond_the_heap_come_to_nothing) {
  Robot& held = add_robot_with_source(std::string(kHead) + R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
int main(void) { e_init_port(); SRbits.IPL = 5; e_init_ad_scan(ALL_ADC); e_set_led(0, 1); while (1); })");
  Robot& let_in = add_robot_with_source(std::string(kHead) + R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
int main(void) { e_init_port(); __asm__ volatile("disi #0x3FFF"); e_init_ad_scan(ALL_ADC); e_set_led(0, 1);
  while (1); })")
                      .at(0.5, 0);
  std::string functions, activates;
  for (int i = 0; i < 40; ++i) {
    functions += "void f" + std::to_string(i) + "(void) {}\n";
    activates += " e_activate_agenda(f" + std::to_string(i) + ", 1000);";
  }
  Robot& many = add_robot_with_source(kHead + functions + "int main(void) { e_init_port();" + activates +
                                      " e_set_led(0, 1); while (1); }")
                    .at(-0.5, 0);
  run_for(0.3);
  EXPECT_EQ(held.leds() & 1, 0u);
  EXPECT_EQ(let_in.leds() & 1, 1u);
  EXPECT_EQ(many.leds() & 1, 0u);
  ASSERT_FALSE(many.traps().empty());
  EXPECT_EQ(many.traps()[0].kind, host::kTrapAbort);
}

// a function that is asked waits for what it looks at, not for its line's other names
TEST_F(Misuse, a_picture_that_is_waited_for_is_no_endless_wait) {
  Robot& r = add_robot_with_source(R"(
#include <p30F6014A.h>
#include <motor_led/e_init_port.h>
#include <camera/fast_2_timer/e_poxxxx.h>
char img[2 * 40 * 40];
int main(void) { e_init_port(); e_poxxxx_init_cam();
  e_poxxxx_config_cam((ARRAY_WIDTH - 160) / 2, (ARRAY_HEIGHT - 160) / 2, 160, 160, 4, 4, RGB_565_MODE);
  e_poxxxx_write_cam_registers();
  while (1) { e_poxxxx_launch_capture(img); while (!e_poxxxx_is_img_ready()); } })");
  for (int i = 0; i < 20; ++i) {
    run_for(0.05);
    EXPECT_EQ(r.diagnoses_text().find("endless"), std::string::npos) << r.diagnoses_text();
  }
}

TEST_F(Misuse, a_program_that_resets_itself_is_told) {
  Robot& always = add_robot_with_source("#include <p30F6014A.h>\nint main(void) {\n  Reset();\n}\n");
  Robot& now_and_then = add_robot_with_source(R"(
#include <p30F6014A.h>
int main(void) { volatile long i; for (i = 0; i < 200000; i++) ; __asm__ volatile("reset"); return 0; })")
                            .at(0.5, 0);
  run_for(0.5);
  ASSERT_EQ(always.diagnoses().size(), 1u) << always.diagnoses_text();
  EXPECT_EQ(always.diagnoses()[0].cause, "resets itself");
  EXPECT_EQ(always.diagnoses()[0].place, "main() (main.c:3)");
  EXPECT_GT(always.diagnoses()[0].count, 1000);
  EXPECT_EQ(now_and_then.diagnoses_text(), "");
}

TEST_F(Misuse, a_speed_without_motors_is_told) {
  Robot& never = add_robot_with_source(std::string(kHead) + R"(
int main(void) { e_init_port(); e_start_agendas_processing(); while (1) e_set_speed_left(300); })");
  Robot& asleep = add_robot_with_source(std::string(kHead) + R"(
int main(void) { e_init_port(); e_init_motors(); while (1) e_set_speed_left(300); })")
                      .at(0.5, 0);
  Robot& fine = add_robot_with_source(std::string(kHead) + R"(
int main(void) { e_init_port(); e_init_motors(); e_set_speed_left(300); e_start_agendas_processing();
  while (1); })")
                    .at(-0.5, 0);
  run_for(0.09);
  EXPECT_EQ(never.diagnoses_text() + asleep.diagnoses_text(), "");  // it may still come
  run_for(0.1);
  EXPECT_EQ(never.diagnoses_text(),
            "e_init_motors(): motors stand: speed set, but e_init_motors() was never called: no motor turns; "
            "set at main() (main.c:10); call e_init_motors() before the loop\n");
  EXPECT_TRUE(wording::reads(asleep.diagnoses_text(),
                             "e_start_agendas_processing(): motors stand: speed set, but "
                             "e_start_agendas_processing() was never called: no motor turns; set at main() "
                             "(main.c:10); call e_start_agendas_processing() before the loop"));
  EXPECT_EQ(fine.diagnoses_text(), "");
}

TEST_F(Misuse, an_endless_wait_names_what_it_waits_for) {
  Robot& r = add_robot_with_source(std::string(kHead) + R"(
volatile int due, other;
void tick(void) { due = 1; }
int main(void) { e_init_port(); e_activate_agenda(tick, 320);
  while (due == 0 && calls < 3) ;
  other = 1; while (1); })");
  run_for(0.1);
  EXPECT_TRUE(wording::reads(
      r.diagnoses_text(),
      "main (…/main.c:13): endless wait: the program waits here for `due` and `calls`; nothing will ever set "
      "it: only tick() (main.c:11) and work() (main.c:8) could, and no interrupt is enabled that calls them; "
      "start the agendas or the timer, or enable the interrupt whose handler ends the wait"));
}

// what looks for writers in the sources must not overflow the stack
TEST_F(Misuse, an_endless_wait_beside_a_line_without_end_is_told) {
  Robot& r = add_robot_with_source(std::string(kHead) + "volatile int due[2]; void set(void) { due[0" +
                                   std::string(300000, ' ') + R"(] = 1; }
int main(void) { e_init_port();
  while (due[0] == 0) ;
  set(); while (1); })");
  run_for(0.1);
  EXPECT_TRUE(
      wording::reads(r.diagnoses_text(),
                     "main (…/main.c:11): endless wait: the program waits here for `due`; nothing will ever "
                     "set it: only set() (main.c:9) could, and no interrupt is enabled that calls it; start "
                     "the agendas or the timer, or enable the interrupt whose handler ends the wait"));
}

TEST_F(Misuse, an_agenda_without_a_period_is_told_unless_it_gets_one) {
  Robot& r = add_robot_with_source(std::string(kHead) + R"(
void other(void) { calls++; }
int main(void) { e_init_port(); e_init_motors(); e_start_agendas_processing();
  e_activate_agenda(work, 0); e_activate_agenda(other, 0); e_set_agenda_cycle(other, 100); while (1); })");
  run_for(0.1);
  ASSERT_EQ(r.diagnoses().size(), 1u) << r.diagnoses_text();
  EXPECT_TRUE(wording::reads(r.diagnoses_text(),
                             "e_activate_agenda(): agenda without a period: got cycle 0, expected 1 to 65535 "
                             "(0.1 ms each): the agenda's function is never called; called at main() "
                             "(main.c:12); give it a cycle, now or with e_set_agenda_cycle()"));
  EXPECT_GT(r.variable("calls"), 5);
}

// what main() has called lies deeper on the stack than the handler's frame
TEST_F(Misuse, who_held_an_interrupt_off_in_an_agenda_of_the_library_is_not_main) {
  Robot& r = add_robot_with_source(std::string(kHead) + R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_acc.h>
#include <utility/utility.h>
int main(void) { e_init_port(); e_start_agendas_processing(); e_init_ad_scan(ALL_ADC);
  e_activate_agenda(e_display_angle, 500);
  while (1) wait(150000); })");
  run_for(0.5);
  EXPECT_NE(r.diagnoses_text().find("called by the handler of T2"), std::string::npos) << r.diagnoses_text();
  EXPECT_EQ(r.diagnoses_text().find("main()"), std::string::npos) << r.diagnoses_text();
}

// the scan known by heart flashed its emitters through pins that are inputs
TEST_F(Misuse, sensors_stay_dark_until_the_ports_are_set_up) {
  wall(0.06, -0.5, 0.06, 0.5);
  Robot& r = add_robot_with_source(std::string(kHead) + R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
volatile int before, behind;
int main(void) { long i; e_init_ad_scan(ALL_ADC);
  for (i = 0; i < 300000; i++);
  before = e_get_prox(0); e_init_port();
  for (i = 0; i < 300000; i++);
  behind = e_get_prox(0); while (1); })");
  run_for(2);
  EXPECT_EQ(r.variable("before"), 0);
  EXPECT_GT(r.variable("behind"), 100);
  ASSERT_EQ(r.diagnoses().size(), 4u) << r.diagnoses_text();
  std::string places;
  for (const board::Diagnosis& d : r.diagnoses()) {
    EXPECT_EQ(d.cause, "input driven");
    places += d.place + ' ';
  }
  for (const char* tris : {"TRISF7 ", "TRISF8 ", "TRISG0 ", "TRISG1 "})
    EXPECT_NE(places.find(tris), std::string::npos) << places;
}

TEST_F(Misuse, a_wait_for_the_band_gap_ends) {
  Robot& r = add_robot_with_source(std::string(kHead) + R"(
int main(void) { RCONbits.LVDEN = 1; RCONbits.BGST = 0; while (!RCONbits.BGST); calls = 7; while (1); })");
  run_for(0.01);
  EXPECT_EQ(r.variable("calls"), 7);
  expect_no_traps();
}

// four words wait and the fifth stays in the shift register: each UART tells how many of its own were lost
TEST_F(FirmwareTest, words_that_nobody_reads_are_counted_by_their_uart) {
  Robot& r = add_robot_with_source(R"(
#include <p30F6014A.h>
int main(void) {
  U1BRG = U2BRG = 7;
  U1MODEbits.UARTEN = U2MODEbits.UARTEN = 1;
  while (1);
}
)");
  run_for(0.01);
  r.uart(1).send("12345678");
  r.uart(2).send("123456789AB");
  run_for(0.1);
  std::map<std::string, std::int64_t> lost;
  for (const board::Diagnosis& d : r.diagnoses())
    if (d.place.find("OERR") != std::string::npos) lost[d.place] = d.count;
  EXPECT_EQ(lost, (std::map<std::string, std::int64_t>{{"U1STA.OERR", 4}, {"U2STA.OERR", 7}}));
}

}  // namespace
