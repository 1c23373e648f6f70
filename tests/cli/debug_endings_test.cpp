// SPDX-License-Identifier: MIT
// twinpuck debug where a program ends, begins anew or is not alone: traps, resets, robots of one image, the
// library's own handlers.
#include "tests/cli/debug_fixture.h"
#include "tests/cli/pty.h"

namespace {

using cli_test::twinpuck;

class DebugEndings : public cli_test::Debug {};
INSTANTIATE_TEST_SUITE_P(, DebugEndings, ::testing::Values("sim", "dspic"), cli_test::hal_name);

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
__attribute__((noinline)) int weigh(int n, int times) {
  if (times == 0) return 0;
  return n + weigh(n, times - 1) + total;
}
int main(void) {
  PR1 = 14745;
  IEC0bits.T1IE = 1;
  T1CON = 0x8000;
  while (1) {
    int now = ticks;
    while (ticks == now)
      ;
    total = weigh(ticks, 3);
    LATAbits.LATA6 = !LATAbits.LATA6;
  }
}
)";

TEST_P(DebugEndings, traps_stop_where_they_happen) {
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
  const std::string without = digest("--for 0.002");
  expect_in_order(
      debug("c\nbt\nprint n\nc\nback\nwatch n\nrc\nprint n\ndelete\nc\ngoto 1s\ninfo world\n", "--for 0.002"),
      {"> c\nMathError trap at divide() (main.c:2)", "> bt\n#0", "divide() (main.c:2)", "main() (main.c:6)",
       "n = 100", "> c\nthe processor was reset", "> rc\nbreakpoint 1", "n = 100", "> c\nMathError trap",
       "the end", without});
}

TEST_P(DebugEndings, a_stack_that_overflows_is_told) {
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
  expect_in_order(debug("break deep if k == 20\nc\nfinish\nprint n > 60\nc\n", "--for 0.1"),
                  {"> c\nbreakpoint 1", "deep()", "> finish\nStackError trap at deep()", "n > 60 = 1",
                   "> c\nthe processor was reset: stack overflow in deep()"});
}

TEST_P(DebugEndings, a_reset_is_told_and_the_program_begins_anew) {
  const std::string resetting =
      "#include <p30F6014A.h>\nvolatile int n;\nint main(void) {\n  for (n = 0; n < 100; n++)\n    ;\n"
      "  asm(\"reset\");\n}\n";
  build(resetting);
  const std::string without = digest("--for 0.002");
  expect_in_order(debug("break main.c:6\nc\ndelete\nc\nback\nprint n\ngoto 1s\ninfo world\n", "--for 0.002"),
                  {"> c\nbreakpoint 1", "> c\nthe processor was reset", "> back", "main() (main.c:6)",
                   "n = 100", "the end of the world's time", without});
  build("int main(void) {\n  return 0;\n}\n");
  expect_in_order(debug("c\n", "--for 0.01"), {"> c\nthe processor was reset: "});
}

// both robots run the same code, and share what was decoded of it
TEST_P(DebugEndings, another_robot_with_the_same_code_is_not_stopped) {
  build(kTicking);
  const std::string world = write("world.toml", kWorld), without = digest("--for 0.03", world);
  for (const char* robot : {"first", "second"})
    expect_in_order(
        debug("break main.c:20\nbreak weigh if times == 0\nset ticks = 50\nc\nprint ticks\nbt\nc\n"
              "print ticks\nback\n",
              std::string("--for 0.03 --robot ") + robot, world),
        {std::string(robot) + ": ", "> c\nbreakpoint 2", "> print ticks\nticks = ", "#0", "weigh()",
         "weigh()", "main() (main.c:19)", "> c\nbreakpoint 1", "ticks = 1"});
  expect_in_order(
      debug("break weigh if 0\nwatch total if 0\nc\ninfo world\n", "--for 0.03 --robot first", world),
      {"the end", without});
}

TEST_P(DebugEndings, calls_of_itself_are_stepped_over) {
  build(kTicking);
  expect_in_order(debug("break weigh if times == 2\nc\ndelete\nfinish\nfinish\nbt\n"),
                  {"> c\nbreakpoint 1", "> finish", "weigh()", "> finish", "main() (main.c:19)"});
}

TEST_P(DebugEndings, a_program_that_waits_for_ever_is_paused) {
  build("int main(void) {\n  while (1)\n    ;\n}\n");
  cli_test::Pty pty("debug maze --fw '*=" + program() + "'");
  ASSERT_TRUE(pty.until("(twinpuck) ")) << pty.said;
  pty.type("c\n");
  pty.listen(500);
  pty.type("\x03");
  EXPECT_TRUE(pty.until("paused")) << pty.said;
  EXPECT_TRUE(pty.until("main() (main.c:")) << pty.said;
  pty.type("goto 0.01s\n");
  EXPECT_TRUE(pty.until("0.0100")) << pty.said;
  pty.type("backi\n");
  EXPECT_TRUE(pty.until("0.00")) << pty.said;
  EXPECT_TRUE(pty.until("main() (main.c:")) << pty.said;
  // the pause was long ago: this is another one
  pty.listen(1000);
  pty.type("c\n");
  pty.listen(500);
  pty.type("\x03");
  EXPECT_TRUE(pty.until("paused")) << pty.said;
  pty.type("q\n");
  EXPECT_EQ(pty.end(), 0) << pty.said;
}

TEST_P(DebugEndings, a_second_interrupt_ends_it) {
  build("int main(void) {\n  while (1)\n    ;\n}\n");
  // at once behind the first; and where the first has nothing to pause
  for (const bool runs : {true, false}) {
    cli_test::Pty pty("debug maze --fw '*=" + program() + "'");
    ASSERT_TRUE(pty.until("(twinpuck) ")) << pty.said;
    if (runs) pty.type("c\n");
    pty.listen(500);
    pty.type("\x03");
    pty.listen(runs ? 50 : 1200);
    pty.type("\x03");
    EXPECT_EQ(pty.end(), 130) << runs << pty.said;
  }
}

// a thousand times "continue" went on behind each interrupt
TEST_P(DebugEndings, commands_of_a_file_or_a_pipe_end_at_a_signal) {
  build("int main(void) {\n  while (1)\n    ;\n}\n");
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "continue\n";
  const std::string file = write("many", many), said = path("said");
  for (const std::string& from : {"-x '" + file + "'", "<'" + file + "'"}) {
    std::filesystem::remove(said);
    const auto ended = twinpuck("debug maze --fw '*=" + program() + "' " + from + " >'" + said + "' #",
                                "timeout --preserve-status -k 10 -s INT 2");
    EXPECT_EQ(ended.exit_code, 130) << ended.text;
    expect_in_order(read(said), {"> continue\npaused"});
    EXPECT_EQ(read(said).find("paused"), read(said).rfind("paused"));
  }
}

// with either HAL an agenda's function is called from timer 2's interrupt
TEST_P(DebugEndings, the_librarys_functions_and_agendas_are_frames) {
  const std::string commands =
      write("commands",
            "break control_tick\nc\nbt\ninfo interrupts\ndelete\nbreak e_set_speed_left\nc\nbt\ndelete\n"
            "c\ninfo world\n");
  const auto said = twinpuck("debug maze --fw obstacle --hal " + hal() + " --for 1 -x '" + commands + "'");
  EXPECT_EQ(said.exit_code, 0) << said.text;
  const auto run = twinpuck("run maze --fw obstacle --hal " + hal() + " --for 1");
  expect_in_order(said.text, {"> c\nbreakpoint 1", "control_tick() (main.c:", "_T2Interrupt", "<-- interrupt",
                              "main()", "> c\nbreakpoint 2", "e_set_speed_left()", "> bt\n#0", "main()",
                              "the end of the world", run.text.substr(run.text.find("digest "), 23)});
  // what plays the handler has no timer that runs, and no count
  EXPECT_EQ(said.text.find("timer 2 is off"), std::string::npos);
  EXPECT_NE(said.text.find(hal() == "sim" ? "flag clear, served by hal_sim's driver" : "flag clear, served "),
            std::string::npos)
      << said.text;
}

}  // namespace
