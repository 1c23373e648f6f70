// SPDX-License-Identifier: MIT
// Counts of instructions, and lcov's files. Every count was made by hand.
#include "hal_sim/chip/lcov.h"
#include "hal_sim/chip/step_counts.h"
#include "tests/chip/chip_fixture.h"

namespace {

using chip::Lcov;

class StepCountsTest : public chip_test::ChipTest {};

TEST_F(StepCountsTest, instructions_and_conditions_are_counted) {
  const std::string text = R"(
__reset: mov #__SP_init, w15
    mov #3, w0
    bset IEC0, #3           ; Timer 1 comes between them
    mov #20, w1
    mov w1, PR1
    mov #0x8000, w1
    mov w1, T1CON
loop: repeat #9
rep: nop
    btss w0, #0             ; 3, 2, 1: skips twice
even: nop
    dec w0, w0
branch: bra nz, loop
    bclr IEC0, #3
end: bra end
__T1Interrupt: bclr IFS0, #3
    retfie
)";
  add_robot(hex(text));
  const dspic::FirmwareFile file = with_labels(text);
  chip::StepCounts counts(file);
  runner().watch_steps(&counts, true);
  run_for(0.001);
  runner().watch_steps(&counts, false);
  const auto at = [&](const std::string& label) { return file.functions.at(label); };
  EXPECT_EQ(counts.ran(at("loop")), 3u);
  EXPECT_EQ(counts.ran(at("rep")), 3u);  // its iterations are one
  EXPECT_EQ(counts.ran(at("rep") + 2), 3u);
  EXPECT_EQ(counts.jumped(at("rep") + 2), 2u);
  EXPECT_EQ(counts.ran(at("even")), 1u);
  EXPECT_EQ(counts.ran(at("branch")), 3u);
  EXPECT_EQ(counts.jumped(at("branch")), 2u);
  EXPECT_GE(counts.ran(at("_T1Interrupt")), 2u);
  EXPECT_GT(counts.ran(at("end")), 1000u);  // a jump to itself is one each time
  EXPECT_EQ(counts.ran(0x17000), 0u);
}

TEST_F(StepCountsTest, an_instruction_that_resets_has_run) {
  const std::string text =
      "__reset: mov #__SP_init, w15\n  mov #5000, w0\nwait: dec w0, w0\n  bra nz, wait\nend: reset\n";
  add_robot(hex(text));
  const dspic::FirmwareFile file = with_labels(text);
  chip::StepCounts counts(file);
  runner().watch_steps(&counts, true);
  run_for(0.01);
  runner().watch_steps(&counts, false);
  EXPECT_GE(counts.ran(file.functions.at("end")), 2u);
}

TEST(lcov, text_and_back) {
  Lcov lcov, again;
  auto& source = lcov.sources["/a/main.c"];
  source.version = "12";
  source.lines = {{3, 10}, {4, 0}};
  source.branches = {{{3, 0, 0}, {true, 0}}, {{3, 0, 1}, {true, 10}}, {{4, 0, 0}, {}}};
  source.functions = {{"main", {1, 2}}};
  const std::string text =
      "TN:\nSF:/a/main.c\nVER:12\nFN:1,main\nFNDA:2,main\nFNF:1\nFNH:1\nBRDA:3,0,0,0\n"
      "BRDA:3,0,1,10\nBRDA:4,0,0,-\nBRF:3\nBRH:1\nDA:3,10\nDA:4,0\nLF:2\nLH:1\n"
      "end_of_record\n";
  EXPECT_EQ(lcov.text(), text);
  std::string error;
  ASSERT_TRUE(again.read(text, error)) << error;
  EXPECT_EQ(again.text(), text);
  ASSERT_TRUE(again.add(lcov, error)) << error;
  EXPECT_EQ(again.sources["/a/main.c"].lines[3], 20u);
  EXPECT_EQ(again.sources["/a/main.c"].functions["main"].calls, 4u);
  EXPECT_FALSE((again.sources["/a/main.c"].branches[{4, 0, 0}].is_known));
}

TEST(lcov, other_sources_are_not_added) {
  Lcov mine, theirs;
  std::string error;
  mine.sources["a.c"].lines = {{3, 1}};
  theirs.sources["a.c"].lines = {{4, 1}};
  EXPECT_FALSE(mine.add(theirs, error));
  EXPECT_EQ(error, "got counts of another text of a.c, expected those of the one that runs");
  EXPECT_EQ(mine.sources["a.c"].lines.size(), 1u);
  // what they say they are goes before their lines
  mine.sources["a.c"].version = theirs.sources["a.c"].version = "1";
  EXPECT_TRUE(mine.add(theirs, error));
  EXPECT_EQ(mine.sources["a.c"].lines.size(), 2u);
}

TEST(lcov, bad_records_are_named) {
  for (const std::string bad :
       {"DA:1,2", "SF:a\nDA:x,2", "SF:a\nDA:1", "SF:a\nBRDA:1,0,0", "SF:a\nFNDA:-1,f", "junk"}) {
    Lcov lcov;
    std::string error;
    EXPECT_FALSE(lcov.read(bad, error)) << bad;
    // the last line is the bad one
    const std::string line = bad.find('\n') == std::string::npos ? "line 1: got '" : "line 2: got '";
    EXPECT_EQ(error,
              line + bad.substr(bad.rfind('\n') + 1) + "', expected a record of lcov's, such as DA:12,3");
  }
}

}  // namespace
