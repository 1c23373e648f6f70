// SPDX-License-Identifier: MIT
// What code takes by itself: every number is counted by hand, and a run of the same text agrees.
#include "hal_sim/chip/code_cycles.h"

#include "hal_sim/chip/profile.h"
#include "tests/chip/chip_fixture.h"

namespace {

using chip::CodeCycles;
using chip::PathCycles;

class CodeCyclesTest : public chip_test::ChipTest {
 protected:
  void read(const std::string& text) { file_ = with_labels(text); }
  PathCycles of(const std::string& function) {
    return CodeCycles(file_).of_function(file_.functions.at(function));
  }
  void expect(const std::string& function, int least, int most) {
    const PathCycles cycles = of(function);
    EXPECT_EQ(cycles.why_not, "") << function;
    EXPECT_EQ(cycles.least, least) << function;
    EXPECT_EQ(cycles.most, most) << function;
  }
  void expect_none(const std::string& function, const std::string& why) {
    EXPECT_EQ(of(function).why_not, why) << function;
  }
  dspic::FirmwareFile file_;
};

const std::string kStraight = R"(
__reset: mov #__SP_init, w15
main: mov #3, w0
    rcall plain
    rcall stalls
    rcall repeats
    rcall divides
    rcall skips
    rcall long_skip
    rcall branches
    mov #0, w0
    rcall branches
    rcall skips
    rcall long_skip
    rcall calls
    rcall tail
    bra main
plain: nop                    ; 1 + 2 + 1 + 3
    mov.d w4, w2
    nop
    return
stalls: mov #0x900, w1        ; 1 + 1 + 1 stall + 3
    mov [w1], w2
    return
repeats: repeat #9            ; 1 + 10 + 3
    nop
    return
divides: mov #7, w4           ; 1 + 1 + 1 + 18 + 1 + 3
    mov w0, w6
    repeat #17
    div.u w4, w4
    mov w6, w0
    return
skips: btss w0, #0            ; 1 and 1, or 2; and 3
    nop
    return
long_skip: btss w0, #0        ; 1 and 2 + 4 + 3, or 3; and 3
    call repeat_none
    return
repeat_none: nop              ; 1 + 3
    return
branches: cp0 w0              ; 1, 1 and 2, or 2; and 3
    bra z, over
    nop
    nop
over: return
calls: mov #0x900, w9         ; 1 + 2 + 7 + 1 + 3
    rcall plain
    mov [w9], w3
    return
tail: nop                     ; 1 + 2 + 7
    bra plain
)";

TEST_F(CodeCyclesTest, straight_code_is_exact_and_branches_have_a_least_and_a_most) {
  read(kStraight);
  expect("plain", 7, 7);
  expect("stalls", 6, 6);
  expect("repeats", 14, 14);
  expect("divides", 25, 25);
  expect("skips", 5, 5);
  expect("long_skip", 6, 10);
  expect("branches", 6, 7);
  expect("calls", 14, 14);
  expect("tail", 10, 10);
}

TEST_F(CodeCyclesTest, a_run_agrees) {
  read(kStraight);
  add_robot(hex(kStraight));
  chip::Profile profile(file_, runner().processor(), runner().device(), runner().host());
  runner().watch_steps(&profile, true);
  run_for(0.01);
  runner().watch_steps(&profile, false);
  int compared = 0;
  for (const auto& f : profile.report().functions) {
    if (f.cycles.count == 0 || f.name == "main") continue;
    const PathCycles code = of(f.name);
    ASSERT_TRUE(code.is_known()) << f.name << ": " << code.why_not;
    EXPECT_EQ(code.least, f.cycles.min) << f.name;
    EXPECT_EQ(code.most, f.cycles.max) << f.name;
    ++compared;
  }
  EXPECT_EQ(compared, 11);  // "over" is a function of its own
}

TEST_F(CodeCyclesTest, what_no_code_tells_is_said_with_the_reason) {
  read(R"(
__reset: mov #__SP_init, w15
main: bra main
loop: dec w0, w0
    bra nz, loop
    return
caller: rcall above
    return
above: nop
back: dec w0, w0
    bra nz, back
    return
itself: cp0 w0
    bra z, done
    rcall itself
done: return
pointer: call w0
    return
leaps: bra w0
sleeps: pwrsav #1
    return
counted: repeat w3
    nop
    return
hardware: do #3, ends
ends: nop
    return
)");
  expect_none("main", "loops or calls itself");
  expect_none("loop", "loops or calls itself");
  expect_none("caller", "calls above(), which loops or calls itself");
  expect_none("itself", "calls itself(), which loops or calls itself");
  expect_none("pointer", "calls through a pointer");
  expect_none("leaps", "jumps through a pointer");
  expect_none("sleeps", "sleeps");
  expect_none("counted", "repeats an instruction as often as a register says");
  expect_none("hardware", "loops by DO");
  // what follows a loop is known all the same
  EXPECT_TRUE(of("done").is_known());
}

TEST_F(CodeCyclesTest, a_pointer_of_which_nothing_is_known_may_read_the_flash) {
  read(R"(
__reset: mov #__SP_init, w15
main: bra main
given: mov [w0], w1            ; 1, or 2; and 3
    return
bytes: ze [w0], w1             ; 1, or 3; and 3
    return
table: mov #0x8100, w2         ; 1 + 1 + 1 + 1 stall + 3
    mov [w2], w1
    return
frame: mov [w14+2], w1         ; 1 + 3
    return
)");
  expect("given", 4, 5);
  expect("bytes", 4, 6);
  expect("table", 7, 7);
  expect("frame", 4, 4);
}

TEST_F(CodeCyclesTest, a_handler_has_its_entry) {
  read("__reset: mov #__SP_init, w15\nmain: bra main\n__T1Interrupt: bclr IFS0, #3\n retfie\n");
  expect("_T1Interrupt", 7, 7);  // 3 + 1 + 3, as the profile has it
}

}  // namespace
