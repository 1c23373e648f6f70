// SPDX-License-Identifier: MIT
// What beginners get wrong, as the summary tells it, and what is no mistake. (What is said of each is in messages.txt.)
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

namespace {

using cli_test::CommandTest;
using cli_test::twinpuck;

class TypicalErrors : public CommandTest {
 protected:
  std::string program(const std::string& text) const {
    write("p/main.c", "#include \"" TWINPUCK_SOURCE_DIR "/tests/cli/typical.h\"\n" + text + "\n");
    return path("p");
  }
};

// the summary has what CI wants to know
TEST_F(TypicalErrors, a_trap_s_line_is_the_program_s_own) {
  struct Ending {
    const char *name, *program, *kind, *vector, *function;
    int line;  // of main.c, behind the head's 1
  };
  const Ending endings[] = {
      {"a wild pointer handed to memcpy()",
       "volatile unsigned at = 0x3000;\nvoid fill(void) {\n  memcpy((void*)at, \"abc\", 3);\n}\nint "
       "main(void) {\n  "
       "fill();\n  while (1);\n}",
       "address error", "AddressError", "fill", 4},
      {"a division in a function",
       "volatile int zero, c;\nvoid half(int x) {\n  c = x / zero;\n}\nint main(void) {\n  "
       "half(4);\n  while (1);\n}",
       "math error", "MathError", nullptr, 4},
      {"a float divided through the library's routine",
       "volatile int zero;\nvolatile long c, n = 70000;\nint main(void) {\n  c = n / zero;\n  while (1);\n}",
       "math error", "MathError", "main", 5},
      {"an agenda that fails",
       "volatile int zero, c;\nvoid tick(void) {\n  c = 1 / zero;\n}\nint main(void) {\n  "
       "e_init_port();\n  e_activate_agenda(tick, 10);\n  e_start_agendas_processing();\n  "
       "while (1);\n}",
       "math error", "MathError", "tick", 4},
      {"main() that returns", "int main(void) {\n  e_init_port();\n  return 0;\n}", "unexpected reset",
       "Reset", "main", 0},
      {"an interrupt without a handler", "int main(void) {\n  TIMER_1;\n  while (1);\n}", "interrupt trouble",
       "T1", "main", 4},
      {"a null pointer",
       "void (*volatile f)(void);\nint main(void) {\n  e_init_port();\n  f();\n  while (1);\n}",
       "unexpected reset", "Reset", "main", 5},
  };
  for (const Ending& e : endings) {
    SCOPED_TRACE(e.name);
    const auto run = twinpuck("run empty -q --hal dspic --for 0.5 --fw '*=" + program(e.program) +
                              "' --summary " + path("s.json"));
    EXPECT_EQ(run.exit_code, 3) << run.text;
    const auto summary = nlohmann::json::parse(read(path("s.json")));
    const auto& traps = summary["robots"][0]["traps"];
    ASSERT_EQ(traps.size(), 1u) << traps.dump(1);
    EXPECT_EQ(traps[0]["kind"], e.kind);
    EXPECT_EQ(traps[0]["vector"], e.vector);
    if (e.function) {  // else it may be inlined
      EXPECT_EQ(traps[0]["function"].get<std::string>(), e.function) << traps[0].dump(1);
    }
    EXPECT_NE(traps[0]["file"].get<std::string>().find("main.c"), std::string::npos);
    if (e.line) {
      EXPECT_EQ(traps[0]["line"], e.line) << traps[0].dump(1);
    }
    EXPECT_GT(traps[0]["cycle"].get<long>(), 0);
    EXPECT_GT(traps[0]["count"].get<int>(), 1);
  }
}

// LLVM would make anything of it
TEST_F(TypicalErrors, a_division_by_0_traps_at_every_level) {
  const std::pair<const char*, int> programs[] = {
      {"volatile int c; int main(void) { int x = 5, y = 0; c = x / y; while (1); }", 3},
      {"volatile int c, a = 5; int main(void) { c = a / 0; while (1); }", 3},
      {"volatile int c, z; int main(void) { c = 1 / z; while (1); }", 3},
      {"volatile long c; int main(void) { long x = 5, y = 0; c = x % y; while (1); }", 3},
      {"int d(int a, int b) { return a / b; }\nvolatile int c; int main(void) { c = d(7, 0); while (1); }",
       3},
      {"volatile unsigned c, z; int main(void) { c = 65535u % z; while (1); }", 3},
      {"volatile int c; int main(void) { int x = 50, y = 10; c = x / y; while (1); }", 0},
  };
  for (const auto& [text, code] : programs)
    for (const char* level : {"-O0", "-O1", "-O2", "-Os"}) {
      const auto run = twinpuck("run empty -q --hal dspic --for 0.1 --opt " + std::string(level) +
                                " --fw '*=" + program(text) + "'");
      EXPECT_EQ(run.exit_code, code) << text << " " << level << "\n" << run.text;
    }
}

TEST_F(TypicalErrors, a_reset_that_the_program_asks_for_is_none) {
  for (const char* text : {
           "int main(void) { if (!RCONbits.SWR) __asm__ volatile(\"reset\"); while (1); }",
           "int main(void) { e_init_port(); if (!RCONbits.SWR) { e_set_led(0, 1); __asm__ "
           "volatile(\"reset\"); } while "
           "(1); }",
           "HANDLER _T1Interrupt(void) { __asm__ volatile(\"reset\"); }\nint main(void) { if (!RCONbits.SWR) "
           "TIMER_1; "
           "while (1); }",
           "int main(void) { if (!RCONbits.SWR) exit(0); while (1); }",
       }) {
    const auto run = twinpuck("run empty --strict --hal dspic --for 0.5 --fw '*=" + program(text) + "'");
    EXPECT_EQ(run.exit_code, 0) << text << "\n" << run.text;
  }
}

TEST_F(TypicalErrors, an_empty_loop_is_the_end_of_a_program_and_no_wait) {
  const char* loops[] = {"while (1);",          "for (;;);",
                         "while (1) {}",        "do {} while (1);",
                         "here: goto here;",    "while (1) Nop(); /* until flag */",
                         "while (1) ClrWdt();", "while (1) { Nop(); Nop(); }"};
  for (const char* loop : loops)
    for (const char* level : {"-O0", "-O1"}) {
      const std::string text =
          std::string(
              "volatile int flag;\nvoid tick(void) { flag++; e_set_led(0, 2); }\nint main(void) {\n") +
          "  e_init_port();\n  e_init_motors();\n  e_activate_agenda(tick, 1000);\n"
          "  e_start_agendas_processing();\n  e_set_speed_left(300);\n  e_set_speed_right(300);\n  " +
          loop + "\n}";
      const auto run = twinpuck("run empty --strict --hal dspic --for 12 --opt " + std::string(level) +
                                " --fw '*=" + program(text) + "'");
      EXPECT_EQ(run.exit_code, 0) << loop << " " << level << "\n" << run.text;
      const auto alone = twinpuck(
          "run empty --strict --hal dspic --for 1 --opt " + std::string(level) + " --fw '*=" +
          program(std::string("volatile int flag;\nint main(void) {\n  e_init_port();\n  ") + loop + "\n}") +
          "'");
      EXPECT_EQ(alone.exit_code, 0) << loop << " " << level << "\n" << alone.text;
    }
}

// what the library behind Webots' interfaces does is no mistake of the program
TEST_F(TypicalErrors, a_finite_position_of_a_motor_costs_no_interrupts) {
  write("w/main.c", R"(#include <webots/robot.h>
#include <webots/motor.h>
int main(void) {
  WbDeviceTag l, r;
  wb_robot_init();
  l = wb_robot_get_device("left wheel motor");
  r = wb_robot_get_device("right wheel motor");
  wb_motor_set_position(l, 9.42478);
  wb_motor_set_position(r, 6.0);
  while (wb_robot_step(64) != -1) {}
  return 0;
}
)");
  const auto run = twinpuck("run empty --strict --for 8 --hal dspic --fw '*=" + path("w") + "'");
  EXPECT_EQ(run.exit_code, 0) << run.text;
}

// 17: as on the chip
TEST_F(TypicalErrors, an_eeprom_operation_goes_on_by_itself_for_2_ms) {
  const auto run =
      twinpuck("run empty --strict --hal dspic --for 0.5 --fw '*=" +
               program("#include <libpic30.h>\n"
                       "int row[16] = {7, 8};\n"
                       "unsigned took(void) { unsigned t = TMR3; TMR3 = 0; return t; }\n"
                       "int main(void) {\n"
                       "  unsigned began, waited; int busy, back[2];\n"
                       "  e_init_uart1();\n"
                       "  PR3 = 0xFFFF; T3CON = 0x8000;\n"
                       "  took(); _erase_eedata(0x7FF020, _EE_ROW); began = took();\n"
                       "  busy = NVMCONbits.WR; _wait_eedata(); waited = took();\n"
                       "  printf(\"%d %d %d\\r\\n\", began < 200, busy, waited > 29000 && waited < 30000);\n"
                       "  _write_eedata_row(0x7FF020, row); busy = NVMCONbits.WR; _wait_eedata();\n"
                       "  _erase_eedata(0x7FF022, _EE_WORD); _wait_eedata();\n"
                       "  _write_eedata_word(0x7FF022, -5); _wait_eedata();\n"
                       "  { _prog_addressT p = 0x7FF020; _memcpy_p2d16(back, p, sizeof back); }\n"
                       "  printf(\"%d %d %d\\r\\n\", busy, back[0], back[1]);\n"
                       "  while (1);\n}") +
               "'");
  EXPECT_EQ(run.exit_code, 0) << run.text;
  EXPECT_NE(run.text.find("puck: 1 1 1\n"), std::string::npos) << run.text;
  EXPECT_NE(run.text.find("puck: 1 7 -5\n"), std::string::npos) << run.text;
}

}  // namespace
