// SPDX-License-Identifier: MIT
// Profiles: every number is counted by hand from the program's text.
#include "hal_sim/chip/profile.h"

#include "tests/chip/chip_fixture.h"

namespace {

using chip::ProfileReport;

// Timer 1 comes every 1000 cycles; the main loop calls `work` and, every other time, `rare`
const std::string kProgram = R"(
__reset: mov #__SP_init, w15
    clr w8
    mov #999, w0
    mov w0, PR1
    bset IEC0, #3
    mov #0x8000, w0
    mov w0, T1CON
main: rcall work
    btg w8, #0
    btsc w8, #0
    rcall rare
    bra main
work: repeat #9               ; 1 + 10 + 3
    nop
    return
rare: push w0                 ; 1 + 2 + 14 + 1 + 3
    rcall work
    pop w0
    return
__T1Interrupt: bclr IFS0, #3  ; 3 + 1 + 3
    retfie
)";

// timer 1 every 10000 cycles; the main loop begins by a wait for its flag
const std::string kPollsTimer1 = R"(
__reset: mov #__SP_init, w15
    mov #9999, w0
    mov w0, PR1
    mov #0x8000, w0
    mov w0, T1CON
main: btss IFS0, #3
    bra main
    bclr IFS0, #3
)";

class ProfileTest : public chip_test::ChipTest {
 protected:
  ProfileReport profile(const std::string& text, double seconds) {
    add_robot(hex(text));
    file_ = with_labels(text);
    chip::Profile profile(file_, runner().processor(), runner().device(), runner().host());
    runner().watch_steps(&profile, true);
    run_for(seconds);
    runner().watch_steps(&profile, false);
    return profile.report();
  }
  static const ProfileReport::Function& function(const ProfileReport& report, const std::string& name) {
    for (const auto& f : report.functions)
      if (f.name == name) return f;
    ADD_FAILURE() << "no function " << name;
    return report.functions.front();
  }

 private:
  dspic::FirmwareFile file_;
};

TEST_F(ProfileTest, functions_take_their_cycles_whatever_interrupts) {
  const ProfileReport report = profile(kProgram, 0.05);
  const auto &work = function(report, "work"), &rare = function(report, "rare");
  EXPECT_EQ(work.cycles.min, 13);  // RETURN is a cycle shorter when an interrupt follows
  EXPECT_EQ(work.cycles.max, 14);
  EXPECT_EQ(rare.cycles.min, 20);
  EXPECT_EQ(rare.cycles.max, 21);
  EXPECT_EQ(rare.max_caller, "main");
  EXPECT_GT(rare.cycles.count, 1000);
  EXPECT_NEAR(static_cast<double>(work.cycles.count) / static_cast<double>(rare.cycles.count), 3, 0.01);
  // its own code: not what it calls
  EXPECT_NEAR(static_cast<double>(rare.own) / static_cast<double>(rare.cycles.count), 7, 0.01);
}

TEST_F(ProfileTest, a_last_call_that_is_a_jump_is_a_call) {
  const ProfileReport report = profile(R"(
__reset: mov #__SP_init, w15
main: rcall first
    bra main
first: nop                    ; 1 + 2, and all of second
    bra second
second: nop                   ; 1 + 3
    return
)",
                                       0.01);
  EXPECT_EQ(function(report, "first").cycles.max, 7);
  EXPECT_EQ(function(report, "second").cycles.max, 4);
  EXPECT_NEAR(static_cast<double>(function(report, "second").cycles.count),
              static_cast<double>(function(report, "first").cycles.count), 1);
}

TEST_F(ProfileTest, interrupts_have_a_latency_and_a_period) {
  const ProfileReport report = profile(kProgram, 0.05);
  ASSERT_EQ(report.interrupts.size(), 1u);
  const auto& t1 = report.interrupts[0];
  EXPECT_EQ(t1.name, "T1");
  EXPECT_NEAR(static_cast<double>(t1.cycles.count), static_cast<double>(report.to) / 1000, 1);
  EXPECT_EQ(t1.cycles.min, 7);
  EXPECT_EQ(t1.cycles.max, 7);
  EXPECT_EQ(t1.period.min, 1000);
  EXPECT_EQ(t1.period.max, 1000);
  EXPECT_EQ(t1.latency.min, 4);  // one cycle after the flag, and three of entry
  EXPECT_LE(t1.latency.max, 7);  // behind a RETURN
  EXPECT_EQ(t1.merged, 0);
  EXPECT_EQ(t1.missed, 0);
}

TEST_F(ProfileTest, turns_of_the_main_loop_hold_the_handlers) {
  const ProfileReport report = profile(kProgram, 0.05);
  // rcall 2, work 14, btg 1, btsc 1 or 2, rcall 2, rare 21, bra 2: with rare 43; btsc skips: 21
  EXPECT_EQ(report.turn.min, 21);
  EXPECT_GE(report.turn.max, 43 + 7);
  EXPECT_EQ(report.turn_place, "main() (0x" + report.turn_place.substr(report.turn_place.find("0x") + 2));
  // every second turn is back where it was: a wait, as in the run's load, but for the handlers and what finds it again
  EXPECT_GT(report.load(), 0.007);
  EXPECT_LT(report.load(), 0.03);
  EXPECT_NEAR(static_cast<double>(report.in_handlers) / static_cast<double>(report.to - report.from), 0.007,
              1e-4);
}

TEST_F(ProfileTest, the_deepest_stack_is_known_with_its_way) {
  const ProfileReport report = profile(kProgram, 0.05);
  // main calls rare (4), which pushes (2) and calls work (4), where Timer 1 comes (4)
  EXPECT_EQ(report.stack_bytes, 14);
  EXPECT_EQ(report.stack_path, "main > rare > work | T1: _T1Interrupt");
  EXPECT_EQ(report.stack_bytes + report.data_bytes + report.stack_free, 8192);
}

TEST_F(ProfileTest, waits_are_told_apart_from_work) {
  // polls Timer 1's flag, then counts 100 down, 3 cycles a round
  const ProfileReport report = profile(kPollsTimer1 + R"(    mov #100, w1
delay: dec w1, w1
    bra nz, delay
    bra main
)",
                                       0.1);
  ASSERT_EQ(report.waits.size(), 2u);
  EXPECT_EQ(report.waits[0].place.substr(0, 6), "main()");
  EXPECT_FALSE(report.waits[0].counts);
  EXPECT_NEAR(static_cast<double>(report.waits[0].cycles.count), static_cast<double>(report.to) / 10000, 1);
  EXPECT_NEAR(report.waits[0].cycles.mean(), 9700, 30);
  EXPECT_EQ(report.waits[1].place.substr(0, 7), "delay()");
  EXPECT_TRUE(report.waits[1].counts);
  EXPECT_NEAR(report.waits[1].cycles.mean(), 294, 6);
  EXPECT_LT(report.load(), 0.01);
}

// asleep as well: the handler is seen, and what it does
TEST_F(ProfileTest, handlers_that_wake_the_processor_are_counted) {
  std::string sleeps = kProgram;
  sleeps.replace(sleeps.find("main: "), 6, "main: pwrsav #1\n ");
  const ProfileReport report = profile(sleeps, 0.05);
  ASSERT_EQ(report.interrupts.size(), 1u);
  const double periods = static_cast<double>(report.to - report.from) / 1000;
  EXPECT_NEAR(static_cast<double>(report.interrupts[0].cycles.count), periods, 2);
  EXPECT_EQ(report.interrupts[0].cycles.max, 7);
  EXPECT_NEAR(static_cast<double>(function(report, "rare").cycles.count), periods / 2, 2);
}

// without optimisation `while (1) { while (!flag) ; ... }` has one beginning for both loops
TEST_F(ProfileTest, rounds_of_a_wait_at_the_head_are_no_turns) {
  const ProfileReport report = profile(kPollsTimer1 + R"(    repeat #300
    nop
    bra main
)",
                                       0.1);
  EXPECT_NEAR(static_cast<double>(report.turn.min), 10000, 5);
  EXPECT_NEAR(static_cast<double>(report.turn.max), 10000, 5);
}

// a main loop of some 200 instructions that calls a function three times, which only reads, while a handler
// counts: the handler is the load. With work in it, all is
TEST_F(ProfileTest, a_long_round_that_changes_nothing_is_a_wait) {
  for (const bool works : {false, true}) {
    struct One : ProfileTest {
      void TestBody() override {}
      std::pair<double, double> loads(const std::string& work) {
        const ProfileReport report = profile(R"(
__reset: mov #__SP_init, w15
    mov #__SPLIM_init, w0
    mov w0, SPLIM
    nop
    clr w8
    clr w9
    mov #999, w0
    mov w0, PR1
    bset IEC0, #3
    mov #0x8000, w0
    mov w0, T1CON
main: rcall ask
    rcall ask
    rcall ask
)" + work + R"(
    bra main
ask:
    .rept 60
    mov PORTA, w0
    .endr
    return
__T1Interrupt: push w0
    mov ticks, w0
    inc w0, w0
    mov w0, ticks
    bclr IFS0, #3
    pop w0
    retfie
    .bss
ticks: .space 2
)",
                                             1);
        return {report.load(), runner().cpu_load()};
      }
    } one;
    const auto [profiled, sampled] = one.loads(works ? "inc w8, w8\n add w9, w8, w9" : "nop");
    EXPECT_NEAR(profiled, works ? 1 : 0.014, 0.003);
    EXPECT_NEAR(sampled, works ? 1 : 0.014, works ? 1e-9 : 0.1);
  }
}

TEST_F(ProfileTest, events_that_came_too_soon_are_merged_or_missed) {
  const ProfileReport merged = profile(R"(
__reset: mov #__SP_init, w15
    mov #99, w0
    mov w0, PR1
    bset IEC0, #3
    mov #0x8000, w0
    mov w0, T1CON
main: bra main
__T1Interrupt: repeat #349
    nop
    bclr IFS0, #3
    retfie
)",
                                       0.01);
  ASSERT_EQ(merged.interrupts.size(), 1u);
  EXPECT_NEAR(static_cast<double>(merged.interrupts[0].merged) /
                  static_cast<double>(merged.interrupts[0].cycles.count),
              3, 0.1);
}

TEST_F(ProfileTest, flags_that_the_program_clears_unserved_are_missed) {
  const ProfileReport report = profile(R"(
__reset: mov #__SP_init, w15
    mov #999, w0
    mov w0, PR1
    bset IEC0, #3
    mov #0x8000, w0
    mov w0, T1CON
main: mov #0xE0, w0           ; level 7: nothing is served
    mov w0, SR
wait: btss IFS0, #3
    bra wait
    bclr IFS0, #3
    bra main
__T1Interrupt: reset
)",
                                       0.01);
  ASSERT_EQ(report.interrupts.size(), 1u);
  EXPECT_EQ(report.interrupts[0].cycles.count, 0);
  EXPECT_NEAR(static_cast<double>(report.interrupts[0].missed), static_cast<double>(report.to) / 1000, 1);
}

TEST_F(ProfileTest, a_profile_changes_nothing) {
  std::uint64_t digests[2];
  for (const bool profiled : {false, true}) {
    struct One : ProfileTest {
      void TestBody() override {}
      std::uint64_t run(bool with_profile) {
        if (with_profile) {
          profile(kProgram, 0.05);
        } else {
          add_robot(hex(kProgram));
          run_for(0.05);
        }
        return digest();
      }
    } one;
    digests[profiled] = one.run(profiled);
  }
  EXPECT_EQ(digests[0], digests[1]);
}

}  // namespace
