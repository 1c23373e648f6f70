// SPDX-License-Identifier: MIT
// twinpuck debug in the native and register ways, where a program is code of the PC: traps, resets, robots
// with the same code, library controllers, and gdb.
#include "tests/cli/debug_fixture.h"

namespace {

using cli_test::twinpuck;

class PcDebug : public cli_test::Debug {};
INSTANTIATE_TEST_SUITE_P(, PcDebug, ::testing::Values("native"), cli_test::way_name);

constexpr const char* kWorld = R"(twinpuck = 1
[[robot]]
name = "first"
position = [-0.2, 0]
[[robot]]
name = "second"
position = [0.2, 0]
)";

constexpr const char* kTicking = R"(#include <p30F6014A.h>
volatile int ticks, total;
void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) {
  ticks++;
  IFS0bits.T1IF = 0;
}
int weigh(int n, int times) {
  if (times == 0) return 0;
  return n + weigh(n, times - 1);
}
int main(void) {
  PR1 = 14745;
  IEC0bits.T1IE = 1;
  T1CON = 0x8000;
  while (1) {
    int now = ticks;
    while (ticks == now)
      ;
    total += weigh(ticks, 3);
    LATAbits.LATA6 = !LATAbits.LATA6;
  }
}
)";

TEST_P(PcDebug, traps_stop_where_they_happen) {
  build(R"(volatile int zero, n;
__attribute__((noinline)) int divide(int a) { return a / zero; }
int main(void) {
  for (n = 0; n < 100; n++)
    ;
  n = divide(5);
  while (1)
    ;
}
)");
  const std::string without = digest("--for 0.02");
  expect_in_order(
      debug("c\nbt\nprint n\nc\ninfo world\nback\nwatch n\nrc\nprint n\ndelete\nc\nc\ninfo world\n",
            "--for 0.02"),
      {"> c\nmath error: division by zero, at divide", "main.c:2), cycle ", "> bt\n#0", "divide() (main.c:2)",
       "main() (main.c:6)", "n = 100", "> c\nthe end of the world's time", without, "> back",
       "main() (main.c:6)", "> rc\nbreakpoint 1", "n = 100", "> c\nmath error: division by zero",
       "> c\nthe end", without});
}

// a program's stray write to its own code is caught though a debugger writes there
TEST_P(PcDebug, the_programs_code_stays_closed_to_it) {
  build(R"(volatile int n;
int main(void) {
  for (n = 0; n < 100; n++)
    ;
  *(volatile int *)main = 7;
  while (1)
    ;
}
)");
  const std::string without = digest("--for 0.02");
  for (const char* first : {"", "watch n if 0\n", "break main.c:5\nc\nstepi 3\n"})
    expect_in_order(debug(std::string(first) + "c\nbt\nc\ninfo world\n", "--for 0.02"),
                    {"address error: write to a constant or to the program itself, at main", "> bt\n#0",
                     "main() (main.c:5)", "> c\nthe end", without});
}

TEST_P(PcDebug, a_stack_that_overflows_is_told) {
  build(R"(volatile int n;
int deep(int k) {
  volatile int here[40];
  here[0] = n = k;
  return deep(k + 1) + here[0];
}
int main(void) {
  return deep(0);
}
)");
  expect_in_order(debug("break deep if k == 20\nc\nfinish\nc\nprint n > 100\nc\n", "--for 0.1"),
                  {"> c\nbreakpoint 1", "deep()", "> finish\nstack error: stack overflow", "n > 100 = 1"});
}

TEST_P(PcDebug, a_wild_pointer_does_not_stop_the_debugger) {
  build(R"(struct node { int value; struct node *next; };
struct node *volatile nothing;
struct node *volatile wild = (struct node *)0x123456789abcULL;
volatile int n;
int main(void) {
  while (1) {
    n++;
    if (n == 500) n = nothing->value;
  }
}
)");
  expect_in_order(debug("break main.c:7 if wild->next->value == 3\nprint nothing->value\nprint *wild\nprint "
                        "wild->next->value\n"
                        "x wild 1\nset wild->value = 1\nset *nothing = 1\ndelete\nc\nbt\n",
                        "--for 0.1"),
                  {"breakpoint 1", "(not kept here)", "got 'wild->next->value'", "????", "got 'wild->value'",
                   "> c\naddress error: read through a null pointer", "main() (main.c:8)"});
}

constexpr const char* kResetting = R"(#include <p30F6014A.h>
volatile int n;
int main(void) {
  for (n = 0; n < 100; n++)
    ;
  asm("reset");
}
)";

TEST_P(PcDebug, a_reset_stops_in_main_again) {
  build(kResetting);
  const std::string without = digest("--for 0.01");
  expect_in_order(
      debug("break main.c:6\nc\nprint cycle\ndelete\nc\nback\nstep\nprint n\nc 9\ninfo world\n",
            "--for 0.01"),
      {"> c\nbreakpoint 1", "> c\nthe processor was reset", "main() (main.c:4)", "> back",
       "main() (main.c:6)", "> step\nthe processor was reset", "n = 0", "> c 9\nthe processor was reset"});
  build("int main(void) {\n  return 0;\n}\n");
  expect_in_order(debug("c\nc\n", "--for 0.01"), {"> c\nthe processor was reset: main() returned",
                                                  "main() (main.c:2)", "> c\nthe processor was reset"});
  build(kResetting);
  expect_in_order(debug("break main if 0\nc\nc\nc\ngoto 1s\ninfo world\n", "--for 0.01"),
                  {"the end of the world's time", without});
}

// both robots run the same code and take turns in its data
TEST_P(PcDebug, another_robot_with_the_same_code_is_not_stopped) {
  build(kTicking);
  const std::string world = write("world.toml", kWorld), without = digest("--for 0.03", world);
  for (const char* robot : {"first", "second"})
    expect_in_order(
        debug("break weigh if times == 0\nbreak main.c:20\nset ticks = 50\nc\nbt\nprint ticks\nfinish\nc\n"
              "step 3\nprint ticks\ngoto 0.01s\nprint ticks > 57\nback\n",
              std::string("--for 0.03 --robot ") + robot, world),
        {std::string(robot) + ": ", "main() (main.c:12)", "> c\nbreakpoint 1", "> bt\n#0", "weigh()",
         "weigh()", "weigh()", "weigh()", "main() (main.c:19)", "> print ticks\nticks = 51", "> finish",
         "weigh()", "> c\nbreakpoint 2", "> print ticks\nticks = ", "ticks > 57 = 1"});
  // the one that is looked at has its own variables while the other's are in their place
  expect_in_order(debug("set ticks = 50\ngoto 30000\nprint ticks\nset ticks = 70\ngoto 50000\nprint ticks\n",
                        "--for 0.03 --robot first", world),
                  {"> print ticks\nticks = 5", "> set ticks = 70\nticks = 70", "> print ticks\nticks = 7"});
  expect_in_order(
      debug("break weigh if 0\nwatch total if 0\nc\ninfo world\n", "--for 0.03 --robot first", world),
      {"the end", without});
}

TEST_P(PcDebug, calls_of_itself_are_stepped_over) {
  build(kTicking);
  expect_in_order(
      debug("break weigh if times == 2\nc\nnext\nnext\nbt\nprint times\nfinish\nfinish\nprint total\n"),
      {"> c\nbreakpoint 1", "> bt\n#0", "weigh()", "main()", "times = 2", "> finish", "> finish",
       "main() (main.c:19)", "total = 0"});
}

TEST_P(PcDebug, why_names_the_wait_and_who_could_end_it) {
  build(kTicking);
  expect_in_order(
      debug("goto 110000\nwhy\ninfo interrupts\n"),
      {"it stands in main", "main.c:17), which reads\n  ticks = ",
       "the handler _T1Interrupt (main.c:4) writes it; T1: enabled, priority 4 above the processor's 0",
       "the processor is at level 0", "T1: enabled"});
  if (!has_registers()) return;
  expect_in_order(debug("goto 110000\nset IEC0.T1IE = 0\ngoto 140000\nwhy\n"),
                  {"T1: not enabled, flag set", "pending, but not served:\n  T1: not enabled"});
  expect_in_order(debug("goto 110000\nset T1CON = 0\ngoto 200000\nwhy\nprint ticks\nbacki\nprint T1CON\n"),
                  {"timer 1 is off (T1CON.TON = 0)", "ticks = 7"});
}

TEST_P(PcDebug, registers_are_written_where_a_line_begins) {
  build(kTicking);
  const std::string text =
      debug("break main.c:20\nc\nset PR1 = 2000\nprint PR1\nstepi\nset PR1 = 3000\nset NVMCON = 1\n");
  if (has_registers())
    expect_in_order(text, {"> set PR1 = 2000\nPR1 = 2000", "PR1 = 2000", "got 'PR1'",
                           "where a line of the program begins", "got 'NVMCON'"});
  else
    expect_in_order(text, {"got 'PR1'", "unknown symbol 'PR1'"});
}

TEST_P(PcDebug, a_program_that_waits_for_ever_is_paused) {
  build("int main(void) {\n  while (1)\n    ;\n}\n");
  const std::string said = path("said");
  twinpuck("debug maze --fw '*=" + program() + "' -x '" +
               write("commands", "where\nc\nwhere\ngoto 0.01s\nbacki\n") + "' >'" + said + "'",
           cli_test::signal_once("INT", said, 60));
  expect_in_order(read(said), {"> c\npaused", "main() (main.c:", "> goto 0.01s\n0.01",
                               "main() (main.c:", "> backi\n0.000", "main() (main.c:"});
}

TEST_P(PcDebug, library_controllers_and_their_agendas_are_seen) {
  if (has_registers()) GTEST_SKIP() << "of the native way";
  const auto said =
      twinpuck("debug maze --fw obstacle --way native --for 1 -x '" +
               write("commands",
                     "break drive if left != last_left\nbreak control_tick\nc\nbt\nfinish\nc\nnext\n"
                     "next\nprint last_left\nlocals\ndelete\nc\ninfo world\n") +
               "'");
  EXPECT_EQ(said.exit_code, 0) << said.text;
  const auto run = twinpuck("run maze --fw obstacle --way native --opt -O0 --for 1");
  expect_in_order(said.text, {"> c\nbreakpoint 2", "control_tick() (main.c:", "<-- interrupt", "main()",
                              "> finish", "> c\nbreakpoint 1", "drive() (main.c:44)", "> next", "main.c:45",
                              "> next", "main.c:46", "last_left = 730", "  right = 230",
                              "the end of the world", run.text.substr(run.text.find("digest "), 23)});
}

// a program of the usual optimisation, as runs build it
TEST_P(PcDebug, optimised_images_are_debugged_as_they_are) {
  build(kTicking);
  const auto built = twinpuck("build '" + path("mine") + "' --way " + way() + " -o '" + program() + "'");
  ASSERT_EQ(built.exit_code, 0) << built.text;
  const std::string without = digest("--for 0.02");
  expect_in_order(
      debug("break main.c:20\nc 2\nprint ticks\nback\nback\ndelete\nwatch total\nc\ndelete\nc\ninfo world\n",
            "--for 0.02"),
      {"> c 2\nbreakpoint 1", "ticks = 2", "> back", "> c\ntotal: ", "the end", without});
}

// gdb's own commands; the program stands in main() first
TEST_P(PcDebug, gdb_debugs_it_too) {
  if (!has_registers()) GTEST_SKIP() << "both ways at once";
  if (std::system("command -v gdb >/dev/null") != 0) GTEST_SKIP() << "no gdb: scripts/setup.sh debug";
  write("mine/main.c", cli_test::kProgram);
  const auto gdb = [this](const std::string& rest, const std::string& commands) {
    const auto said = twinpuck("debug maze --gdb " + rest + " -x '" + write("commands", commands) + "'");
    EXPECT_EQ(said.exit_code, 0) << said.text;
    return said.text;
  };
  expect_in_order(gdb("--fw '" + path("mine") + "' --way native",
                      "break weigh\nignore 3 2\ncontinue\nbt\nfinish\nprint ticks\nwatch sum\ncontinue\n"),
                  {"main () at", "weigh (n=3) at", "#1", "work (n=3) at", "#2", "main () at",
                   "Value returned is $1 = 30", "$2 = 3", "Old value = 30", "New value = 60"});
  expect_in_order(
      gdb("--fw obstacle --way native --for 1", "break drive\ncontinue\nnext\nnext\nprint last_left\n"),
      {"main () at", "drive (left=", "last_left = left;", "$1 = "});
  for (const char* words : {"--way native --robot puck", "--way native --dap", "--way chip", ""})
    EXPECT_EQ(twinpuck(std::string("debug maze --gdb ") + words).exit_code, 2) << words;
}

}  // namespace
