// SPDX-License-Identifier: MIT
// What beginners get wrong, and who tells them: build, lint, and a plain run of the image for the robot. A
// silence has its reason beside it.
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/command.h"

namespace {

using cli_test::CommandTest;
using cli_test::twinpuck;

const std::string kHead = R"(#include <p30F6014A.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <uart/e_uart_char.h>
#define HANDLER void __attribute__((interrupt, auto_psv))
#define TIMER_1 (T1CON = 0x8000, PR1 = 10000, IEC0bits.T1IE = 1)
)";

// why somebody says nothing
constexpr const char* kCourse = "build and lint do not know what runs when";
constexpr const char* kAsTold = "a run tells what its build told; the program does what C says of it";
constexpr const char* kOfBuild = "";

struct Case {
  const char* name;
  const char* program;
  int exit_code;  // of a plain run
  // parts of what is said; null: nothing
  const char *build, *lint, *run;
  const char* silence;  // why one of them says nothing; "" where all speak
  double seconds = 1;
};

const Case kCases[] = {
    {"e_init_port() forgotten",
     "int main(void) { int i; while (1) { e_set_led(0, 2); for (i = 0; i < 3000; i++); } }", 0, nullptr,
     nullptr, "TRISA6: input driven", kCourse},
    {"e_init_motors() forgotten",
     "int main(void) { e_init_port(); e_start_agendas_processing(); e_set_speed_left(500); while (1); }", 0,
     nullptr, nullptr,
     "motors stand: speed set, but e_init_motors() was never called: no motor turns; set at main() "
     "(main.c:15)",
     kCourse},
    {"e_start_agendas_processing() forgotten",
     "int main(void) { e_init_port(); e_init_motors(); e_set_speed_left(500); while (1); }", 0, nullptr,
     nullptr, "motors stand: speed set, but e_start_agendas_processing() was never called", kCourse},
    {"e_init_ad_scan() forgotten",
     "volatile int p; int main(void) { e_init_port(); while (1) p = e_get_prox(0); }", 0, nullptr, nullptr,
     "sensors not started: e_get_prox() reads what no scan has written", kCourse},
    {"e_init_uart1() forgotten",
     "int main(void) { e_init_port(); e_send_uart1_char(\"hello\", 5); while (e_uart1_sending()); while (1); "
     "}",
     0, nullptr, nullptr,
     "UART off: U1TXREG is written while U1MODE.UARTEN is 0: nothing is sent, and what is written is "
     "lost; at main() (main.c:15)",
     kCourse},
    {"printf() before the UART is set up", "int main(void) { e_init_port(); printf(\"hello\"); while (1); }",
     0, nullptr, nullptr, "UART off: U1TXREG", kCourse},
    {"a wait for what the library's interrupt writes, at the end of the run",
     "#include <codec/e_sound.h>\nextern volatile int e_dci_unavailable; int main(void) { e_init_port(); "
     "e_init_sound(); e_play_sound(0, 16000);\nwhile (e_dci_unavailable);\nwhile (1); }",
     0, nullptr, nullptr, nullptr, "nothing is wrong: the sound ends after 2.2 s"},
    {"e_calibrate_ir() forgotten",
     "volatile int p; int main(void) { e_init_port(); e_init_ad_scan(ALL_ADC); while (1) p = "
     "e_get_calibrated_prox(0); }",
     0, nullptr, nullptr, nullptr,
     "offsets are 0 until they are measured, so the function is e_get_prox(); SerCom and many others mean "
     "that"},
    {"a flag without volatile",
     "int flag; void tick(void) { flag = 1; }\nint main(void) { e_init_port(); e_activate_agenda(tick, 10); "
     "e_start_agendas_processing(); while (!flag); e_set_led(0, 1); while (1); }",
     0, "'flag' is written by tick() and is not volatile", "expected volatile", "'flag' is written by tick()",
     "what our compiler does of it runs"},
    {"an agenda's period in the wrong unit",
     "void tick(void) { e_set_led(0, 2); }\nint main(void) { e_init_port(); e_activate_agenda(tick, 500); "
     "e_start_agendas_processing(); while (1); }",
     0, nullptr, nullptr, nullptr, "50 ms is as good a period as 500 ms: nobody can know which is meant"},
    {"an agenda's period that no int holds",
     "void tick(void) { e_set_led(0, 2); }\nint main(void) { e_init_port(); e_activate_agenda(tick, 100000); "
     "e_start_agendas_processing(); while (1); }",
     0, "changes value from 100000", "changes value from 100000", "changes value from 100000", kOfBuild},
    {"an agenda without a period",
     "void tick(void) { e_set_led(0, 2); }\nint main(void) { e_init_port(); e_activate_agenda(tick, 0); "
     "e_start_agendas_processing(); while (1); }",
     0, nullptr, nullptr, "agenda without a period", kCourse},
    {"an endless loop in an agenda",
     "volatile int n; void tick(void) { while (1) n++; }\nint main(void) { e_init_port(); "
     "e_activate_agenda(tick, "
     "10); e_start_agendas_processing(); while (1); }",
     0, nullptr, nullptr, "T2: missed interrupt", kCourse},
    {"who it is that takes too long",
     "volatile int n; void tick(void) { while (1) n++; }\nint main(void) { e_init_port(); "
     "e_activate_agenda(tick, "
     "10); e_start_agendas_processing(); while (1); }",
     0, nullptr, nullptr, "meanwhile tick() (main.c:15) ran, called by the handler of T2", kCourse},
    {"an endless loop in a handler",
     "volatile int n; HANDLER _T1Interrupt(void) { IFS0bits.T1IF = 0; while (1) n++; }\nint main(void) { "
     "TIMER_1; "
     "while (1); }",
     0, nullptr, nullptr, "meanwhile _T1Interrupt() (main.c:15) ran", kCourse},
    {"interrupts masked for too long",
     "int main(void) { int i; e_init_port(); e_start_agendas_processing(); while (1) { SRbits.IPL = 7; for "
     "(i = 0; i "
     "< 9000; i++); SRbits.IPL = 0; } }",
     0, nullptr, nullptr, "meanwhile main() (main.c:15) ran with the interrupt masked", kCourse},
    {"a handler that keeps its flag",
     "volatile int n; HANDLER _T1Interrupt(void) { n++; }\nint main(void) { TIMER_1; while (1); }", 0,
     nullptr, nullptr, "flag never cleared: _T1Interrupt returns without clearing IFS0.T1IF", kCourse},
    {"printf() in an interrupt",
     "volatile int n; HANDLER _T1Interrupt(void) { IFS0bits.T1IF = 0; printf(\"tick %d\", n++); }\nint "
     "main(void) { "
     "e_init_port(); e_init_uart1(); TIMER_1; while (1); }",
     0, nullptr, "printf() is called in the handler _T1Interrupt()",
     "meanwhile _T1Interrupt() (main.c:15) ran", kCourse},
    {"a blocking agenda",
     "void tick(void) { long i; for (i = 0; i < 100000; i++) Nop(); }\nint main(void) { e_init_port(); "
     "e_activate_agenda(tick, 1000); e_start_agendas_processing(); while (1); }",
     0, nullptr, nullptr, "meanwhile tick() (main.c:15) ran, called by the handler of T2", kCourse},
    {"speed 1500",
     "int main(void) { e_init_port(); e_init_motors(); e_start_agendas_processing(); e_set_speed_left(1500); "
     "while "
     "(1); }",
     0, "e_set_speed_left(): got speed 1500, expected -1000 to 1000", "got speed 1500",
     "speed out of range left", kOfBuild},
    {"a speed of 1500 that is computed",
     "volatile int v = 500; int main(void) { e_init_port(); e_init_motors(); e_start_agendas_processing(); "
     "e_set_speed_right(3 * v); while (1); }",
     0, nullptr, nullptr, "speed out of range right: got 1500 steps/s", kCourse},
    {"speeds that together are too much",
     "int main(void) { e_init_port(); e_init_motors(); e_start_agendas_processing(); e_set_speed(700, 500); "
     "while "
     "(1); }",
     0, nullptr, nullptr, "speed out of range: got 700 and 500 steps/s", kCourse},
    {"sensor 8",
     "volatile int p; int main(void) { e_init_port(); e_init_ad_scan(ALL_ADC); while (1) p = e_get_prox(8); "
     "}",
     0, "e_get_prox(): got sensor 8, expected 0 to 7", "got sensor 8", "sensor out of range", kOfBuild},
    {"LED 12", "int main(void) { e_init_port(); e_set_led(12, 1); while (1); }", 0,
     "e_set_led(): got LED 12, expected 0 to 8", "got LED 12", "LED out of range", kOfBuild},
    {"a global array overrun by one",
     "int a[10]; int b = 7; int main(void) { int i; for (i = 0; i <= 10; i++) a[i] = 0; while (1); }", 0,
     "i: got an index that reaches 10, expected at most 9", "got an index that reaches 10",
     "got an index that reaches", kAsTold},
    {"a local array overrun by one",
     "int f(void) { int a[10]; int i; for (i = 0; i < 11; i++) a[i] = i; return a[3]; }\nint main(void) { "
     "f(); while "
     "(1); }",
     0, "i: got an index that reaches 10, expected at most 9", "got an index that reaches 10",
     "got an index that reaches", kAsTold},
    {"a return address overwritten with 0",
     "void f(int n) { int a[2]; volatile int* p = a; while (n--) p[-n] = 0; }\nvoid (*volatile g)(int) = f; "
     "int main(void) "
     "{ g(6); while (1); }",
     3, nullptr, nullptr, "a return to address 0: something has overwritten the stack", kCourse},
    {"7 KB of locals",
     "void f(volatile char* to) { volatile char b[7000]; int i; for (i = 0; i < 7000; i++) b[i] = *to; }\n"
     "volatile char c; int main(void) { f(&c); while (1); }",
     0, nullptr, nullptr, nullptr, "it fits: variables leave more than that"},
    {"8 KB of locals",
     "void f(volatile char* to) { volatile char b[8192]; int i; for (i = 0; i < 8192; i++) b[i] = *to; }\n"
     "volatile char c; int main(void) { f(&c); while (1); }",
     3, "stack: got", nullptr, "stack overflow in ", "lint links nothing"},
    {"9 KB of locals",
     "void f(volatile char* to) { volatile char b[9000]; int i; for (i = 0; i < 9000; i++) b[i] = *to; }\n"
     "volatile char c; int main(void) { f(&c); while (1); }",
     3, "stack: got", nullptr, "stack overflow in ", "lint links nothing"},
    {"recursion without end",
     "int f(int n) { volatile char b[100]; b[0] = n; return f(n + 1) + b[0]; }\n"
     "int main(void) { return f(1); }",
     3, "[-Winfinite-recursion]", "[-Winfinite-recursion]", "stack overflow in f()", kOfBuild},
    {"recursion that goes too deep",
     "volatile int k = 5; int f(int n) { volatile char b[1000]; b[k] = n; return n ? f(n - 1) + b[k] : 0; }\n"
     "volatile int deep = 9; int main(void) { f(deep); while (1); }",
     3, "f() calls itself", nullptr, "stack overflow in f()", "lint does not know how deep"},
    {"division by zero", "volatile int a = 5, b, c; int main(void) {\n  c = a / b;\n  while (1); }", 3,
     nullptr, nullptr, "math error: division by zero", kCourse},
    {"division by the constant 0", "volatile int a = 5, c; int main(void) { c = a / 0; while (1); }", 3,
     "division by zero is undefined", "division by zero is undefined", "math error: division by zero",
     kOfBuild},
    {"main() returns", "int main(void) {\n  e_init_port();\n  return 0;\n}", 3, nullptr, nullptr,
     "main() returned: there is nothing to return to, so the processor resets", kCourse},
    {"a null pointer that is called", "void (*volatile f)(void); int main(void) {\n  f();\n  while (1); }", 3,
     nullptr, nullptr, "a call through a null pointer leads to address 0", kCourse},
    {"an agenda that is a null pointer",
     "int main(void) { e_init_port(); e_activate_agenda(0, 10); e_start_agendas_processing(); while (1); }",
     3, nullptr, nullptr, "agenda without a function", kCourse},
    {"a pointer to nowhere",
     "volatile unsigned at = 0x3000; int main(void) {\n  *(volatile int*)at = 1;\n  while (1); }", 3, nullptr,
     nullptr, "address error: an access to an address that is not there", kCourse},
    {"a word at an odd address",
     "char b[8]; volatile unsigned n = 1; int main(void) {\n  *(volatile int*)(b + n) = 1;\n  while (1); }",
     3, nullptr, nullptr, "to a word at an odd one", kCourse},
    {"an interrupt without a handler", "int main(void) { TIMER_1; while (1); }", 3, nullptr, nullptr,
     "the interrupt of T1 is enabled, but the program has no _T1Interrupt()", kCourse},
    {"a misspelt handler",
     "HANDLER _T1Interupt(void) { IFS0bits.T1IF = 0; }\nint main(void) { TIMER_1; while (1); }", 3,
     "_T1Interupt(): got a handler whose name is no interrupt's", "did you mean _T1Interrupt?",
     "the program has no _T1Interrupt()", kOfBuild},
    {"a misspelt handler of the second table",
     "HANDLER _AltT2Interupt(void) { IFS0bits.T2IF = 0; }\nint main(void) { while (1); }", 0,
     "_AltT2Interupt(): got a handler", "did you mean _AltT2Interrupt?", "did you mean _AltT2Interrupt?",
     kOfBuild},
    {"an interrupt that this chip has not", "HANDLER _T9Interrupt(void) { }\nint main(void) { while (1); }",
     0, "_T9Interrupt(): got a handler", "_T9Interrupt(): got a handler", "_T9Interrupt(): got a handler",
     kOfBuild},
    {"a watchdog that nobody clears", "int main(void) { RCONbits.SWDTEN = 1; while (1); }", 3, nullptr,
     nullptr, "the watchdog was not cleared in time", kCourse, 18},
    {"abort()", "int main(void) {\n  abort();\n}", 3, nullptr, nullptr, "abort()", kCourse},
    {"a string without its end",
     "char s[3] = \"abc\"; int main(void) { e_init_port(); e_init_uart1(); printf(\"%s\", "
     "s); while (1); }",
     0, "s: got room for 3 characters, expected 4", "expected 4", "expected 4", kAsTold},
    {"a sum that does not begin at 0",
     "int main(void) { int sum, i; e_init_port(); e_init_uart1(); for (i = 0; i < 10; i++) sum += i; "
     "printf(\"%d\", "
     "sum); while (1); }",
     0, "'sum' is uninitialized", "'sum' is uninitialized", "'sum' is uninitialized", kAsTold},
    {"float == 1.0",
     "float x; int main(void) { e_init_port(); while (1) { x += 0.1; if (x == 1.0) e_set_led(0, 1); } }", 0,
     "comparison of floating-point numbers for equality", "for equality", "for equality", kAsTold},
    {"an overflow of 16 bits in constants", "int t; int main(void) { t = 300 * 200; while (1); }", 0,
     "overflow in expression; result is -5536", "overflow in expression", "overflow in expression", kAsTold},
    {"an overflow of 16 bits in variables",
     "volatile int s = 30000, k = 2; volatile long t; int main(void) { t = s * k; while (1); }", 0, nullptr,
     nullptr, nullptr,
     "the chip wraps without a word and so do programs that mean it (timers, sums); --sanitize tells"},
    {"constants in a handler without auto_psv",
     "const int table[4] = {1, 2, 3, 4}; volatile int n, o; void __attribute__((interrupt, no_auto_psv)) "
     "_T1Interrupt(void) { IFS0bits.T1IF = 0; o = table[n++ & 3]; }\nint main(void) { TIMER_1; while (1); }",
     0, nullptr, "table: read in the handler _T1Interrupt(), which has no_auto_psv", nullptr,
     "right as long as nobody else writes PSVPAG, as in many programs: lint's"},
    {"32 bits shared with a handler",
     "volatile long ticks; HANDLER _T1Interrupt(void) { IFS0bits.T1IF = 0; ticks++; }\nint main(void) { "
     "TIMER_1; "
     "while (1) if (ticks > 1000) ticks = 0; }",
     0, nullptr, "ticks: got a variable of 32 bits that _T1Interrupt() writes", nullptr,
     "wrong once in thousands of rounds: lint's"},
    {"a wheel that stands",
     "int main(void) { e_init_port(); e_init_motors(); e_start_agendas_processing(); "
     "e_set_speed_left(500);\n  "
     "IEC0bits.T2IE = 0; while (1); }",
     0, nullptr, nullptr, "wheel stands: the left wheel was given 500 steps/s, and has not turned for 10 s",
     kCourse, 12},
    {"EEPROM that is not waited for",
     "#include <libpic30.h>\nint main(void) { _erase_eedata(0x7FF000, _EE_WORD); "
     "_write_eedata_word(0x7FF000, 5); while "
     "(1); }",
     0, nullptr, nullptr, "EEPROM busy: NVMCON is written while an operation runs", kCourse},
};

class TypicalErrors : public CommandTest {
 protected:
  std::string program(const std::string& text) const {
    write("p/main.c", kHead + text + "\n");
    return path("p");
  }
};

TEST_F(TypicalErrors, build_lint_and_a_plain_run_say_what_is_wrong_or_there_is_a_reason) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    const std::string folder = program(c.program);
    const auto build = twinpuck("build " + folder + " --hal dspic -o " + path("p.elf"));
    const auto lint = twinpuck("lint " + folder);
    const auto run = twinpuck("run empty --hal dspic --uart none --for " + std::to_string(c.seconds) +
                              " --fw '*=" + folder + "'");
    const auto expect = [&](const char* who, const char* wanted, const std::string& got, bool is_quiet) {
      if (wanted) {
        EXPECT_NE(got.find(wanted), std::string::npos) << who << ":\n" << got;
      } else {
        EXPECT_TRUE(is_quiet) << who << " says something, so the table should:\n" << got;
        EXPECT_STRNE(c.silence, "") << who << " is silent without a reason";
      }
    };
    const auto warns = [](const std::string& text) { return text.find("warning: ") != std::string::npos; };
    EXPECT_EQ(build.exit_code, 0) << build.text;
    EXPECT_EQ(lint.exit_code, c.lint ? 1 : 0) << lint.text;
    EXPECT_EQ(run.exit_code, c.exit_code) << run.text;
    expect("build", c.build, build.text, !warns(build.text));
    expect("lint", c.lint, lint.text, !warns(lint.text));
    expect("run", c.run, run.text,
           !warns(run.text) && run.text.find("robot 'puck'") == std::string::npos && run.exit_code == 0);
  }
}

// the summary has what CI wants to know
TEST_F(TypicalErrors, a_trap_s_line_is_the_program_s_own) {
  struct Ending {
    const char *name, *program, *kind, *vector, *function;
    int line;  // of main.c, behind the head's 14
  };
  const Ending endings[] = {
      {"a wild pointer handed to memcpy()",
       "volatile unsigned at = 0x3000;\nvoid fill(void) {\n  memcpy((void*)at, \"abc\", 3);\n}\nint "
       "main(void) {\n  "
       "fill();\n  while (1);\n}",
       "address error", "AddressError", "fill", 17},
      {"a division in a function",
       "volatile int zero, c;\nvoid half(int x) {\n  c = x / zero;\n}\nint main(void) {\n  "
       "half(4);\n  while (1);\n}",
       "math error", "MathError", nullptr, 17},
      {"a float divided through the library's routine",
       "volatile int zero;\nvolatile long c, n = 70000;\nint main(void) {\n  c = n / zero;\n  while (1);\n}",
       "math error", "MathError", "main", 18},
      {"an agenda that fails",
       "volatile int zero, c;\nvoid tick(void) {\n  c = 1 / zero;\n}\nint main(void) {\n  "
       "e_init_port();\n  e_activate_agenda(tick, 10);\n  e_start_agendas_processing();\n  "
       "while (1);\n}",
       "math error", "MathError", "tick", 17},
      {"main() that returns", "int main(void) {\n  e_init_port();\n  return 0;\n}", "unexpected reset",
       "Reset", "main", 0},
      {"an interrupt without a handler", "int main(void) {\n  TIMER_1;\n  while (1);\n}", "interrupt trouble",
       "T1", "main", 17},
      {"a null pointer",
       "void (*volatile f)(void);\nint main(void) {\n  e_init_port();\n  f();\n  while (1);\n}",
       "unexpected reset", "Reset", "main", 18},
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
