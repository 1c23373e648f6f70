// SPDX-License-Identifier: MIT
// twinpuck debug: scripts of commands, as a person would type them, on a controller's own program.
#include "tests/cli/command.h"

namespace {

using cli_test::CommandTest;
using cli_test::twinpuck;

constexpr const char* kProgram = R"(#include <p30F6014A.h>
volatile int ticks;
static int table[4] = {1, 2, 3, 4};
int sum;

void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) {
  ticks++;
  IFS0bits.T1IF = 0;
}

__attribute__((noinline)) int weigh(int n) {
  int s = 0;
  for (int i = 0; i < 4; i++)
    s += table[i] * n;
  return s;
}

__attribute__((noinline)) void work(int n) {
  sum += weigh(n);
  LATAbits.LATA6 = !LATAbits.LATA6;  // toggle
}

int main(void) {
  TRISAbits.TRISA6 = 0;
  PR1 = 14745;
  IEC0bits.T1IE = 1;
  T1CON = 0x8000;
  while (1) {
    int now = ticks;
    while (ticks == now)
      ;
    work(ticks);
  }
}
)";

constexpr const char* kTypes = R"(#include <p30F6014A.h>
struct motor { int speed; unsigned char on; unsigned mode : 3; unsigned rest : 5; };
volatile struct motor motors[2] = {{-300, 1, 5, 9}, {300, 0, 2, 1}};
volatile int table[2][3] = {{1, 2, 3}, {4, 5, -6}};
volatile float gain = 1.5f;

__attribute__((noinline)) int weigh(int n, volatile struct motor *m) {
  int s = n * m->speed;
  LATA = s + (int)gain;
  return s + LATB;
}

int main(void) {
  static int rounds;
  while (1) {
    rounds++;
    table[0][0] = weigh(rounds, &motors[1]);
  }
}
)";

class Debug : public CommandTest {
 protected:
  Debug() {
    write("mine/main.c", kProgram);
    built_ = twinpuck("build '" + path("mine") + "' --way chip -o '" + elf() + "'");
  }
  void SetUp() override { ASSERT_EQ(built_.exit_code, 0) << built_.text; }
  std::string elf() const { return path("mine.elf"); }
  /// What the commands answer.
  std::string debug(const std::string& commands, const std::string& options = "") {
    write("commands", commands);
    const auto said = twinpuck("debug maze --fw '*=" + elf() + "' -x '" + path("commands") + "' " + options);
    EXPECT_EQ(said.exit_code, 0) << said.text;
    return said.text;
  }
  static void expect_in_order(const std::string& text, std::initializer_list<const char*> parts) {
    std::size_t at = 0;
    for (const char* part : parts) {
      const std::size_t found = text.find(part, at);
      ASSERT_NE(found, std::string::npos)
          << "'" << part << "' behind " << text.substr(0, at) << "\n--- in ---\n"
          << text.substr(at);
      at = found + std::string(part).size();
    }
  }

 private:
  cli_test::Said built_;
};

TEST_F(Debug, breakpoints_stop_and_calls_are_traced_back) {
  const std::string text =
      debug("break weigh\nbreak main.c:20\nc\nbt\nfinish\nc\nbt\nprint ticks\ndelete 1\ninfo break\n");
  expect_in_order(text, {"breakpoint 1 at", "weigh() (main.c:14)", "breakpoint 2 at", "work() (main.c:20)",
                         "> c", "breakpoint", "> bt\n#0", "#1", "main()", "_reset()", "> finish",
                         "> print ticks\nticks = 1 (0x1)", "2 break main.c:20, 1 times"});
}

TEST_F(Debug, conditions_hold_before_it_stops) {
  expect_in_order(debug("break work if ticks == 5\nc\nprint ticks\nprint sum\nc\n", "--for 0.02"),
                  {"> c\nbreakpoint 1", "ticks = 5", "sum = 100", "> c\nthe end of the world's time"});
}

TEST_F(Debug, watchpoints_say_who_changed_what) {
  expect_in_order(
      debug("watch ticks\nc\nbt\ndelete\nwatch LATA.LATA6\nc\ndelete\nwatch sum if sum > 30\nc\n"),
      {"> c\nticks: 0 -> 1, by _T1Interrupt() (main.c:7)", "#0", "_T1Interrupt()", "<-- interrupt", "main()",
       "> c\n", "LATA.LATA6: 0 -> 1", ", by work() (main.c:20)",
       "> c\nsum: 30 -> 60, by work() (main.c:19)"});
}

TEST_F(Debug, steps_go_by_lines_and_over_calls_and_interrupts) {
  const std::string text = debug("break work\nc\ndelete\nstep\nstep\n");
  expect_in_order(text, {"> c\nbreakpoint 1", "> step", "main.c:", "> step"});
  // over the call: the sum has its value, the program still stands in work()
  expect_in_order(debug("break work\nc\nnext\nnext\nbt\nprint sum\n"), {"> bt\n#0", "work()", "sum = 10"});
  // in the wait an interrupt comes: the step does not stop in the handler
  expect_in_order(debug("goto 100000\nnexti 20000\nprint ticks > 6\nprint nesting\n"),
                  {"ticks > 6 = 1", "nesting = 0"});
}

TEST_F(Debug, time_goes_back_and_comes_again) {
  const std::string text = debug(
      "break work\nc 3\nprint ticks\nprint cycle\nrc\nprint ticks\nc\nprint ticks\nprint cycle\n"
      "stepi 3\nbacki 3\nprint cycle\ngoto 20000\nprint ticks\ndelete\nrc\nwhere\n");
  expect_in_order(text, {"> print ticks\nticks = 3", "> rc\nbreakpoint 1", "> print ticks\nticks = 2",
                         "> print ticks\nticks = 3", "> goto 20000", "> print ticks\nticks = 1",
                         "the beginning of the run"});
  std::vector<std::string> cycles;
  for (std::size_t at = 0; (at = text.find("\ncycle = ", at)) != std::string::npos; ++at)
    cycles.push_back(text.substr(at, text.find('(', at) - at));
  ASSERT_EQ(cycles.size(), 3u);
  EXPECT_EQ(cycles[0], cycles[1]);
  EXPECT_EQ(cycles[0], cycles[2]);
}

TEST_F(Debug, what_was_changed_by_hand_is_changed_again_on_the_way_back) {
  expect_in_order(
      debug("goto 50000\nset ticks = 100\nset LATA.LATA6 = 1\ngoto 80000\nprint ticks\nbacki\nprint ticks\n"
            "goto 49000\nprint ticks\ngoto 80000\nprint ticks\n"),
      {"> set ticks = 100\nticks = 100", "LATA.LATA6 = 1", "> print ticks\nticks = 102", "> backi",
       "> print ticks\nticks = 102", "> goto 49000", "> print ticks\nticks = 3", "> goto 80000",
       "> print ticks\nticks = "});
}

TEST_F(Debug, why_names_the_wait_and_who_could_end_it) {
  expect_in_order(debug("goto 100000\nwhy\n"), {"it goes round in main() (main.c:30)", "ticks = 0x6",
                                                "the handler _T1Interrupt writes it; T1: enabled, "
                                                "priority 4 above the processor's 0"});
  expect_in_order(
      debug("goto 100000\nset sr = 0xE0\ngoto 130000\nwhy\ninfo interrupts\n"),
      {"T1: held off: priority 4, the processor is at 7, flag set",
       "pending, but not served:\n  T1: held off", "the processor is at level 7", "T1: held off"});
  expect_in_order(debug("goto 100000\nset T1CON = 0\ngoto 130000\nwhy\n"),
                  {"timer 1 is off (T1CON.TON = 0)"});
}

TEST_F(Debug, a_debugger_changes_nothing) {
  const auto run = twinpuck("run maze --fw '*=" + elf() + "' --for 0.05");
  const std::string digest = run.text.substr(run.text.find("digest "), 23);
  const std::string text =
      debug("break work if 0\nwatch sum if 0\nc\ninfo world\nbacki 3\nc\ninfo world\n", "--for 0.05");
  expect_in_order(text, {"> info world\n", digest.c_str(), "> c\nthe end", "> info world\n", digest.c_str()});
}

TEST_F(Debug, a_trace_has_an_instruction_a_line) {
  debug("goto 50000\ntrace " + path("trace.txt") + " 50\n");
  std::ifstream in(path("trace.txt"));
  std::string line, last;
  int lines = 0;
  while (std::getline(in, line)) {
    EXPECT_NE(line.find(" ; "), std::string::npos) << line;
    ++lines;
  }
  EXPECT_EQ(lines, 50);
}

TEST_F(Debug, editors_speak_with_it) {
  const std::string line = "python3 '" TWINPUCK_SOURCE_DIR "/tests/cli/dap_client.py' '" +
                           cli_test::executable() + "' '" + elf() + "' '" + path("mine/main.c") + "' 2>&1";
  FILE* pipe = popen(line.c_str(), "r");
  std::string text;
  for (char bytes[4096]; const std::size_t n = fread(bytes, 1, sizeof bytes, pipe);) text.append(bytes, n);
  EXPECT_EQ(pclose(pipe), 0) << text;
  EXPECT_EQ(text, "all as expected\n");
}

// gdb's own commands; the program stands in main() first
TEST_F(Debug, native_and_register_ways_are_gdbs) {
  if (std::system("command -v gdb >/dev/null") != 0) GTEST_SKIP() << "no gdb: scripts/setup.sh debug";
  const auto gdb = [this](const std::string& rest, const std::string& commands) {
    const auto said = twinpuck("debug maze " + rest + " -x '" + write("commands", commands) + "'");
    EXPECT_EQ(said.exit_code, 0) << said.text;
    return said.text;
  };
  expect_in_order(gdb("--fw '" + path("mine") + "' --way register",
                      "break weigh\nignore 3 2\ncontinue\nbt\nfinish\nprint ticks\nwatch sum\ncontinue\n"),
                  {"main () at", "weigh (n=3) at", "#1", "work (n=3) at", "#2", "main () at",
                   "Value returned is $1 = 30", "$2 = 3", "Old value = 30", "New value = 60"});
  expect_in_order(
      gdb("--fw obstacle --way native --for 1", "break drive\ncontinue\nnext\nnext\nprint last_left\n"),
      {"main () at", "drive (left=", "last_left = left;", "$1 = "});
  for (const char* words : {"--robot puck", "--dap"})
    EXPECT_EQ(twinpuck(std::string("debug maze --way native ") + words).exit_code, 2);
}

TEST_F(Debug, mistakes_are_answered) {
  expect_in_order(
      debug("brake main\nbreak nowhere\nbreak main.c:9999\nbreak work if nonsense\nwatch nothing\nprint 1 +\n"
            "set nothing = 1\ninfo nothing\ngoto soon\ndelete 9\nx\ntrace\n"),
      {"unknown command 'brake'", "got 'nowhere', expected a function, file:line", "got 'main.c:9999'",
       "condition: unknown symbol 'nonsense'", "got 'nothing', expected a variable", "a value is missing",
       "got 'nothing', expected a variable", "expected info break, interrupts or world",
       "got 'soon', expected a time", "there is no breakpoint 9"});
  EXPECT_EQ(twinpuck("debug maze --fw '*=" + elf() + "' -x /nonexistent").exit_code, 2);
  EXPECT_EQ(twinpuck("debug maze --fw '*=" + elf() + "' --robot nobody").exit_code, 2);
  EXPECT_EQ(twinpuck("debug nowhere").exit_code, 2);
}

// values as C writes them, by the image's own debug information
TEST_F(Debug, variables_have_types_and_functions_have_locals) {
  write("mine/main.c", kTypes);
  const auto built = twinpuck("build '" + path("mine") + "' --way chip -o '" + elf() + "'");
  ASSERT_EQ(built.exit_code, 0) << built.text;
  expect_in_order(
      debug(
          "break weigh\nc 2\nlocals\nprint motors\nprint motors[0].mode\nprint motors[1]\nprint table[1]\n"
          "print table[1][2]\nprint gain\nset motors[1].speed = 17\nprint motors[1].speed\nprint motors[2]\n"
          "print motors[1].colour\nprint nothing[1]\nfinish\nprint rounds\n"),
      {"> locals", "  n = 2 (0x2)\n", "  m = 0x0", "> print motors\n",
       "motors = {{speed = -300 (0xfed4), on = 1 (0x1), mode = 5 (0x5), rest = 9 (0x9)}, {speed = 300 "
       "(0x12c)",
       "motors[0].mode = 5 (0x5)",
       "motors[1] = {speed = 300 (0x12c), on = 0 (0x0), mode = 2 (0x2), rest = 1 (0x1)}",
       "table[1] = {4 (0x4), 5 (0x5), -6 (0xfffa)}", "table[1][2] = -6 (0xfffa)", "gain = 1.5",
       "motors[1].speed = 17 (0x11)", "motors[1].speed = 17 (0x11)",
       "got 'motors[2]', index 2, expected 0 to 1", "got 'motors[1].colour'",
       "expected a variable of the image", "rounds = 2 (0x2)"});
  // and so a trace knows them
  const auto traced = twinpuck("run maze --fw '*=" + elf() + "' --for 0.01 --vcd '" + path("x.vcd") +
                               "' --vcd-signals '*:motors[1].speed'");
  EXPECT_EQ(traced.exit_code, 0) << traced.text;
  std::ifstream in(path("x.vcd"));
  const std::string vcd((std::istreambuf_iterator<char>(in)), {});
  EXPECT_NE(vcd.find("b100101100 "), std::string::npos) << vcd;  // 300
}

constexpr const char* kPointers = R"(#include <p30F6014A.h>
struct node { int value; struct node *next; const char *name; };
struct node nodes[3] = {{5, &nodes[1], "ab"}, {-7, &nodes[2], "cd"}, {9, 0, "ef"}};
int counts[4] = {10, 20, 30, 40};
int *volatile middle = &counts[1];
volatile float level = -2.75f;

__attribute__((noinline)) int visit(struct node *n, int round) {
  LATA = n->value + *middle + (int)level;
  return LATB + round;
}

int main(void) {
  int round = 0;
  while (1) {
    struct node *n;
    for (n = nodes; n; n = n->next) counts[3] += visit(n, round);
    round++;
  }
}
)";

// pointers are followed, and conditions see what the function sees
TEST_F(Debug, pointers_are_followed_and_conditions_know_locals) {
  write("mine/main.c", kPointers);
  const auto built = twinpuck("build '" + path("mine") + "' --way chip -o '" + elf() + "'");
  ASSERT_EQ(built.exit_code, 0) << built.text;
  expect_in_order(
      debug("break visit if n->value == -7 && round == 2\nc\nprint round\nprint n->value\nprint *n\n"
            "print n->next->value\nprint n->name[1]\nprint *middle\nprint middle[1] + counts[round]\n"
            "print nodes[round - 1].value * 2\nprint -counts[0] * (*middle)\nprint level\nprint level + 1\n"
            "set n->next->value = 77\nprint nodes[2].value\nprint round->value\n"
            "print *round\nprint n->colour\nprint counts[9]\nprint *(n)\nprint n[\n"
            "break visit if nothing[2] > 1\nbreak main if n > 0\nwatch n->next->value\ninfo break\n"),
      {"round = 2 (0x2)",
       "n->value = -7 (0xfff9)",
       "*n = {value = -7 (0xfff9), next = 0x0",
       "n->next->value = 9 (0x9)",
       "n->name[1] = 100 (0x64)",
       "*middle = 20 (0x14)",
       "middle[1] + counts[round] = 60",
       "nodes[round - 1].value * 2 = -14",
       "-counts[0] * (*middle) = -200",
       "level = -2.75",
       "level + 1 = -1",
       "n->next->value = 77",
       "nodes[2].value = 77",
       "got 'round->value', expected a pointer",
       "got '*round', expected a pointer",
       "got 'n->colour', no member 'colour'",
       "got 'counts[9]', index 9, expected 0 to 3",
       "expected a variable behind the *",
       "condition: ",
       "nothing",
       "n->next->value"});
}

}  // namespace
