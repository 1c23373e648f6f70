// SPDX-License-Identifier: MIT
// twinpuck debug: what it does, with either HAL.
#include <sstream>
#include <vector>

#include "tests/cli/debug_fixture.h"

namespace {

using cli_test::twinpuck;

class Debug : public cli_test::Debug {
 protected:
  void SetUp() override { build(cli_test::kProgram); }
};
INSTANTIATE_TEST_SUITE_P(, Debug, ::testing::Values("sim", "dspic"), cli_test::hal_name);

TEST_P(Debug, breakpoints_stop_and_calls_are_traced_back) {
  const std::string text =
      debug("break weigh\nbreak main.c:20\nc\nbt\nfinish\nc\nbt\nprint ticks\ndelete 1\ninfo break\n");
  expect_in_order(text, {"breakpoint 1 at", "weigh() (main.c:14)", "breakpoint 2 at", "work() (main.c:20)",
                         "> c", "breakpoint", "> bt\n#0", "#1", "main()", "_reset()", "> finish",
                         "> print ticks\nticks = 1 (0x1)", "2 break main.c:20, 1 times"});
}

TEST_P(Debug, an_address_is_a_breakpoint) {
  const std::string told = debug("break work\n");
  const std::size_t at = told.find("breakpoint 1 at ") + 16;
  const std::string address = told.substr(at, told.find(' ', at) - at);
  expect_in_order(debug("tbreak " + address + "\nc\nc\n", "--for 0.005"),
                  {"breakpoint 1 at " + address + " work()", "> c\n" + address, ": " + address + " work()",
                   "> c\nthe end of the world's time"});
}

TEST_P(Debug, conditions_hold_before_it_stops) {
  expect_in_order(debug("break work if ticks == 5\nc\nprint ticks\nprint sum\nc\n", "--for 0.02"),
                  {"> c\nbreakpoint 1", "ticks = 5", "sum = 100", "> c\nthe end of the world's time"});
}

TEST_P(Debug, watchpoints_say_who_changed_what) {
  expect_in_order(debug("watch ticks\nc\nbt\ndelete\nwatch sum if sum > 30\nc\n"),
                  {"> c\nticks: 0 -> 1, by _T1Interrupt() (main.c:7)", "#0", "_T1Interrupt()",
                   "<-- interrupt", "main()", "> c\nsum: 30 -> 60, by work() (main.c:19)"});
  // by the very next instruction
  expect_in_order(debug("tbreak main.c:7\nc\nwatch ticks\nc\n"), {"> watch ticks\n", "> c\nticks: 0 -> 1"});
  expect_in_order(debug("watch LATA.LATA6\nc\n"), {"> c\n", "LATA.LATA6: 0 -> 1", ", by work() (main.c:20)"});
}

TEST_P(Debug, steps_go_by_lines_and_over_calls_and_interrupts) {
  const std::string text = debug("break work\nc\ndelete\nstep\nstep\n");
  expect_in_order(text, {"> c\nbreakpoint 1", "> step", "weigh() (main.c:", "> step", "weigh() (main.c:"});
  // over the call: the sum has its value, the program still stands in work()
  expect_in_order(debug("break work\nc\nnext\nnext\nbt\nprint sum\n"), {"> bt\n#0", "work()", "sum = 10"});
  // in the wait an interrupt comes: the step does not stop in the handler
  expect_in_order(debug("goto 110000\nnexti 20000\nprint ticks > 6\nprint nesting\n"),
                  {"ticks > 6 = 1", "nesting = 0"});
}

// a line that an interrupt comes in: the handler's breakpoint stops, else nothing of it is seen
TEST_P(Debug, a_breakpoint_in_a_handler_stops_a_step) {
  expect_in_order(debug("break main.c:30\nc\ndelete\nbreak _T1Interrupt\nnext\nbt\nfinish\nprint nesting\n"),
                  {"> next\nbreakpoint 2", "_T1Interrupt()", "<-- interrupt", "main()", "> finish", "main()",
                   "nesting = 0"});
}

TEST_P(Debug, time_goes_back_and_comes_again) {
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

TEST_P(Debug, lines_are_stepped_back_over) {
  expect_in_order(
      debug("break main.c:20\nc 2\nprint sum\nback\nprint sum\nback\nwhere\n"),
      {"> print sum\nsum = 30", "> back", "work() (main.c:19)", "sum = 10", "> back", "main() (main.c:"});
}

TEST_P(Debug, what_was_changed_by_hand_is_changed_again_on_the_way_back) {
  expect_in_order(debug("goto 50000\nset ticks = 100\ngoto 80000\nprint ticks\nbacki\nprint ticks\n"
                        "goto 40000\nprint ticks\ngoto 80000\nprint ticks\n"),
                  {"> set ticks = 100\nticks = 100", "> print ticks\nticks = 102", "> backi",
                   "> print ticks\nticks = 102", "> goto 40000", "> print ticks\nticks = 2", "> goto 80000",
                   "> print ticks\nticks = "});
}

TEST_P(Debug, a_debugger_changes_nothing) {
  const std::string without = digest("--for 0.05");
  const std::string text =
      debug("break work if 0\nwatch sum if 0\nc\ninfo world\nbacki 3\nc\ninfo world\n", "--for 0.05");
  expect_in_order(text, {"> info world\n", without, "> c\nthe end", "> info world\n", without});
  expect_in_order(debug("break weigh\nc 3\nstep 20\nfinish\nrc\nlocals\nregs\nwhy\ninfo interrupts\n"
                        "goto 0.03s\nnexti 100\nback\ndelete\nc\ninfo world\n",
                        "--for 0.05"),
                  {"> c\nthe end", "> info world\n", without});
}

TEST_P(Debug, a_trace_has_an_instruction_a_line) {
  debug("goto 50000\ntrace " + path("trace.txt") + " 50\n");
  std::ifstream in(path("trace.txt"));
  std::string line, last;
  int lines = 0;
  while (std::getline(in, line)) {
    EXPECT_NE(line.find(" ; "), std::string::npos) << line;
    ++lines;
  }
  EXPECT_EQ(lines, 50);
  expect_in_order(debug("trace /dev/full 50\n"), {"trace: /dev/full: cannot be written", "cycle"});
}

/// What a command answered: the lines between it and the next prompt.
std::vector<std::string> answer(const std::string& text, const std::string& command) {
  std::vector<std::string> lines;
  const std::size_t begin = text.find("> " + command + "\n");
  if (begin == std::string::npos) return {"not asked: " + command};
  std::istringstream in(text.substr(begin + command.size() + 3));
  for (std::string line; std::getline(in, line) && line.rfind("> ", 0) != 0;) lines.push_back(line);
  return lines;
}

TEST_P(Debug, what_is_shown_is_as_much_as_was_asked_for) {
  const std::string text = debug(
      "break work\nc\nlist\nlist 3\nlist 36\nx 0x800 4\nx 0x800\nx 0x800 10\ndis\ndis 3\ndis main 2\ndis "
      "main.c:20\nhelp\n",
      "--for 0.01");
  std::vector<std::string> source;
  std::istringstream in(cli_test::kProgram);
  for (std::string line; std::getline(in, line);)
    source.push_back(std::to_string(source.size() + 1) + "\t" + line);
  ASSERT_EQ(source.size(), 34u);
  const auto lines = [&](int first, int last) {
    return std::vector<std::string>(source.begin() + first - 1, source.begin() + last);
  };
  // five before and behind: line 19 is work()'s first, the program has 34
  EXPECT_EQ(answer(text, "list"), lines(14, 24));
  EXPECT_EQ(answer(text, "list 3"), lines(1, 8));
  EXPECT_EQ(answer(text, "list 36"), lines(31, 34));
  const auto four = answer(text, "x 0x800 4"), eight = answer(text, "x 0x800"),
             ten = answer(text, "x 0x800 10");
  ASSERT_EQ(four.size(), 1u);
  EXPECT_EQ(four[0].substr(0, 5), "0800:");
  EXPECT_NE(four[0].find(" 0001"), std::string::npos) << "one tick";
  EXPECT_EQ(four[0].size(), 5u + 4 * 5);
  ASSERT_EQ(eight.size(), 1u);
  EXPECT_EQ(eight[0].size(), 5u + 8 * 5);
  ASSERT_EQ(ten.size(), 2u);
  EXPECT_EQ(ten[0], eight[0]);
  EXPECT_EQ(ten[1].substr(0, 5), "0810:");
  EXPECT_EQ(ten[1].size(), 5u + 2 * 5);
  EXPECT_EQ(answer(text, "dis").size(), 10u);
  const auto code = answer(text, "dis 3");
  ASSERT_EQ(code.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(code[i].substr(0, 3), i == 0 ? "=> " : "   ") << code[i];
  const auto of_main = answer(text, "dis main 2");
  ASSERT_EQ(of_main.size(), 2u);
  EXPECT_EQ(of_main[0].substr(0, 3), "   ");
  EXPECT_NE(of_main[0].find("; main()"), std::string::npos) << of_main[0];
  const auto of_line = answer(text, "dis main.c:20");
  ASSERT_EQ(of_line.size(), 10u);
  EXPECT_NE(of_line[0].find("main.c:20)"), std::string::npos) << of_line[0];
  EXPECT_GT(answer(text, "help").size(), 20u);
}

TEST_P(Debug, editors_speak_with_it) {
  const std::string line = "python3 '" TWINPUCK_SOURCE_DIR "/tests/cli/dap_client.py' '" +
                           cli_test::executable() + "' '" + program() + "' '" + path("mine/main.c") +
                           "' 2>&1";
  const auto said = shell::run(line);
  EXPECT_EQ(said.exit_code, 0) << said.text;
  EXPECT_EQ(said.text, "all as expected\n");
}

TEST_P(Debug, mistakes_are_answered) {
  expect_in_order(
      debug("brake main\nbreak nowhere\nbreak main.c:9999\nbreak work if nonsense\nwatch nothing\nprint 1 +\n"
            "set nothing = 1\ninfo nothing\ngoto soon\ndelete 9\nx\ntrace\n"),
      {"unknown command 'brake'", "got 'nowhere', expected a function, file:line", "got 'main.c:9999'",
       "condition: unknown symbol 'nonsense'", "got 'nothing', expected a variable", "a value is missing",
       "got 'nothing', expected a variable", "expected info break, interrupts or world",
       "got 'soon', expected a time", "there is no breakpoint 9"});
  std::string deep = "ticks";
  for (int i = 0; i < 500; ++i) deep = "table[" + deep + "]";
  expect_in_order(
      debug("break work if " + deep + "\nprint " + std::string(9, '*') + "ticks\nbreak 0xfffffff0\n"),
      {"condition: got 'table[", "expected at most 8 [", "expected", "expected a function, file:line"});
  EXPECT_EQ(twinpuck("debug maze --fw '*=" + program() + "' -x /nonexistent").exit_code, 2);
  EXPECT_EQ(twinpuck("debug maze --fw '*=" + program() + "' --robot nobody").exit_code, 2);
  EXPECT_EQ(twinpuck("debug nowhere").exit_code, 2);
}

TEST_P(Debug, registers_changed_by_hand_are_changed_again_too) {
  expect_in_order(
      debug("goto 50000\nset ticks = 100\nset LATA.LATA6 = 1\ngoto 80000\nprint ticks\nbacki\nprint ticks\n"
            "goto 49000\nprint ticks\ngoto 80000\nprint ticks\n"),
      {"> set ticks = 100\nticks = 100", "LATA.LATA6 = 1", "> print ticks\nticks = 102", "> backi",
       "> print ticks\nticks = 102", "> goto 49000", "> print ticks\nticks = 3", "> goto 80000",
       "> print ticks\nticks = "});
}

TEST_P(Debug, why_names_the_wait_and_who_could_end_it) {
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

// the loop begins with what was inlined; who writes does so in the second line of main()'s loop
TEST_P(Debug, why_names_the_lines_of_the_loop_and_of_who_writes) {
  build(R"(#include <p30F6014A.h>
int due;
static void flash(void) {
  LATAbits.LATA6 = !LATAbits.LATA6;
}
int main(void) {
  TRISAbits.TRISA6 = 0;
  while (1) {
    flash();
  }
}
)");
  expect_in_order(debug("goto 100000\nwhy\n"), {"it goes round in main() (main.c:8)"});
  build(R"(int due;
int main(void) {
  while (1) {
    while (!*(volatile int *)&due)
      ;
    due = 0;
  }
}
)");
  expect_in_order(debug("goto 100000\nwhy\n"),
                  {"it goes round in main() (main.c:4)", "due = 0x0", "main() (main.c:6) writes it"});
}

}  // namespace
