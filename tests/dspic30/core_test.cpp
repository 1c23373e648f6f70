// SPDX-License-Identifier: MIT
// Programs on the whole chip: stalls, loops, windows, pointers, interrupts, resets, power saving,
// self-programming. A program at 0x100 begins in cycle 2: GOTO at 0 takes 2.
#include "tests/dspic30/core_bench.h"

namespace {

using bench::CoreBench;
using bench::Cycle;
using bench::kFlashMacro;
using dspic::Cause;

/// Cycles from label `from` to label `to`.
Cycle between(CoreBench& b, const std::string& from, const std::string& to) {
  EXPECT_TRUE(b.run_to(from));
  const Cycle begin = b.cpu->now();
  EXPECT_TRUE(b.run_to(to));
  return b.cpu->now() - begin;
}

Cycle cycles_of(const std::string& text, const std::string& before = "") {
  CoreBench b("__reset: mov #0x900, w1\n mov #0x910, w2\n mov #0x920, w3\n clr w4\n" + before + "\nfrom:\n" +
              text + "\nto: bra to\n nop\n");
  return between(b, "from", "to");
}

TEST(Core, counts_down_and_stops) {
  CoreBench b(R"(
    mov #10, w0
    clr w1
1:  add w1, w0, w1     ; 1
    dec w0, w0         ; 1
    bra nz, 1b         ; 2, the last one 1
end: bra end)");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(1), 55u);
  EXPECT_EQ(b.cpu->now(), 2 + 2 + 10 * 4 - 1);
}

// between IFS2 and IEC0 there is none
TEST(Core, bits_where_no_register_is_are_told_and_ignored) {
  CoreBench b("bset 0x8A, #3\n bclr.b 0x8B, #0\n mov 0x8A, w0\nend: bra end");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(0), 0u);
  EXPECT_GT(b.notes.count(Cause::UnimplementedAddress), 0);
  b.chip->state_hash(b.cpu->now());
}

// --- stalls: [chip C6]

TEST(Stall, direct_write_before_indirect_source) {
  EXPECT_EQ(cycles_of("inc2 w4, w1\n mov [w3], w5"), 2);
  EXPECT_EQ(cycles_of("mov w2, w3\n mov [w3], w5"), 3);
  EXPECT_EQ(cycles_of("mov w2, w3\n mov [w3++], w5"), 3);
  EXPECT_EQ(cycles_of("mov w2, w3\n mov [w3+2], w5"), 3);
  EXPECT_EQ(cycles_of("mov w2, w3\n nop\n mov [w3], w5"), 3);  // two later: none
  EXPECT_EQ(cycles_of("mov w4, w5\n mov [w1+w5], w6"), 3);     // the offset, too
}

TEST(Stall, moved_destination_pointer_before_source) {
  EXPECT_EQ(cycles_of("mov w4, [w1++]\n mov [w1], w5"), 3);
  EXPECT_EQ(cycles_of("mov w4, [w1]\n mov [w1], w5"), 2);
  EXPECT_EQ(cycles_of("mov [w1++], w5\n mov [w1], w6"), 2);  // a source's own move costs nothing
}

TEST(Stall, not_before_destinations_and_direct_use) {
  EXPECT_EQ(cycles_of("mov w2, w3\n mov w4, [w3]"), 2);
  EXPECT_EQ(cycles_of("mov w2, w3\n mov w3, w5"), 2);
}

TEST(Stall, not_behind_a_jump) {
  EXPECT_EQ(cycles_of("mov w2, w3\n bra 1f\n nop\n1: mov [w3], w5"), 4);
  // the word before the branch's target writes the pointer, but it did not run
  EXPECT_EQ(cycles_of("bra 1f\n mov w2, w3\n1: mov [w3], w5"), 3);
  EXPECT_EQ(cycles_of("btss w4, #0\n mov w2, w3\n mov [w3], w5"), 4);
  EXPECT_EQ(cycles_of("btsc w4, #0\n mov w2, w3\n mov [w3], w5"), 3);
}

TEST(Stall, a_repeated_instruction_stalls_on_itself) {
  EXPECT_EQ(cycles_of("repeat #3\n mov [w1], w1", "mov w1, [w1]"), 1 + 4 + 3);
  EXPECT_EQ(cycles_of("repeat #3\n mov [w1++], [w2++]"), 1 + 4);
}

TEST(Stall, stack_pointer_written_before_return) {
  EXPECT_EQ(cycles_of("rcall sub\n bra to\nsub: sub w15, #0, w15\n return"), 2 + 1 + 1 + 3 + 2);
}

// --- loops

TEST(Loop, do_nests_twice) {
  CoreBench b(R"(
    clr w0
    do #2, 2f          ; 3 times
    do #3, 1f          ; 4 times
    inc w0, w0
1:  nop
    nop
2:  nop
end: bra end)");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(0), 12u);
  EXPECT_EQ(b.cpu->now(), 2 + 1 + 2 + 3 * (2 + 4 * 2 + 2));
  EXPECT_EQ(b.cpu->sr() & 0x200, 0);  // DA
}

TEST(Loop, edt_ends_a_do_early) {
  CoreBench b(R"(
    clr w0
    do #99, 1f
    inc w0, w0
    cp w0, #5
    bra nz, 2f
    bset CORCON, #EDT
2:  nop
    nop
1:  nop
end: bra end)");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(0), 5u);
}

// an interrupt comes between two iterations: RA is on the stack, the rest runs afterwards
TEST(Loop, repeat_is_interrupted_and_goes_on) {
  CoreBench b(R"(
__reset: mov #99, w0
    mov w0, PR1
    clr w1
    clr w2
    bset IEC0, #T1IE
    bset T1CON, #15
    repeat #999
    inc w1, w1
end: bra end
__T1Interrupt:
    bclr IFS0, #T1IF
    bclr T1CON, #15
    mov SR, w3
    mov [w15-2], w4
    inc w2, w2
    retfie)");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(1), 1000u);
  EXPECT_EQ(b.w(2), 1u);
  EXPECT_EQ(b.w(3) & 0x10, 0u);     // RA is clear in the handler
  EXPECT_EQ(b.w(4) >> 12 & 1, 1u);  // and set on the stack
}

// --- program memory as data

const std::string kWindow = R"(
    .section .const, psv
text: .asciz "AB"
    .text
__reset: mov #psvpage(text), w0
    mov w0, PSVPAG
    bset CORCON, #PSV
    mov #psvoffset(text), w1
    clr w2
)";

TEST(Psv, constants_are_read_through_the_window) {
  CoreBench b(kWindow +
              "from: mov [w1], w3\nto: mov.b [w1++], w4\n mov.b [w1++], w5\n ze [w1], w6\nend: bra end");
  EXPECT_EQ(between(b, "from", "to"), 2);  // MOV: one more
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(3), 0x4241u);
  EXPECT_EQ(b.w(4) & 0xFF, 0x41u);
  EXPECT_EQ(b.w(5) & 0xFF, 0x42u);
  EXPECT_EQ(b.w(6), 0u);
}

TEST(Psv, others_pay_two_and_repeats_only_at_their_ends) {
  CoreBench b(kWindow +
              "from: add w2, [w1], w3\nto: nop\nfrom2: repeat #9\n mov [w1], w3\nto2: nop\nend: bra end");
  EXPECT_EQ(between(b, "from", "to"), 3);
  EXPECT_EQ(between(b, "from2", "to2"), 1 + 10 + 2 * 2);
}

TEST(Psv, a_pair_pays_once) {
  CoreBench b(kWindow + "from: mov.d [w1], w4\nto: nop\nend: bra end");
  EXPECT_EQ(between(b, "from", "to"), 3);
}

TEST(Psv, writing_there_is_an_address_error) {
  CoreBench b(kWindow + "mov w2, [w1]\nend: bra end\n__AddressError: mov #7, w7\n1: bra 1b");
  b.run(100);
  EXPECT_EQ(b.w(7), 7u);
}

// --- pointers

TEST(Modulo, a_buffer_of_six_words_goes_round) {
  CoreBench b(R"(
    mov #0x900, w1
    mov w1, XMODSRT
    mov #0x90B, w0
    mov w0, XMODEND
    mov #0x8001, w0
    mov w0, MODCON
    nop
    clr w2
    do #6, 1f           ; 7 writes
    inc w2, w2
1:  mov w2, [w1++]
    mov [--w1], w3
    mov [--w1], w4
end: bra end)");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.word(0x900), 7u);  // the seventh over the first
  EXPECT_EQ(b.word(0x90A), 6u);
  EXPECT_EQ(b.w(3), 7u);
  EXPECT_EQ(b.w(4), 6u);  // backwards over the start
  EXPECT_EQ(b.w(1), 0x90Au);
}

// as a program leaves them that has a buffer in one space alone [DS70143 4.2.2]
TEST(Modulo, register_15_is_none) {
  for (const bool translated : {false, true}) {
    CoreBench b(R"(__reset: mov #0x0900, w15
    mov w15, XMODSRT
    mov #0x0903, w0
    mov w0, XMODEND
    mov #0x8004, w0
    mov w0, XBREV
    mov #0x8FFF, w0
    mov w0, MODCON
    nop
    mov #20, w1
1:  push w1
    dec w1, w1
    bra nz, 1b
end: bra end)",
                {}, translated);
    b.run(500);
    EXPECT_EQ(b.cpu->pc(), b.symbol("end"));
    EXPECT_EQ(b.w(15), 0x900u + 40);
    EXPECT_EQ(b.word(0x902), 19u);
  }
}

TEST(BitReversed, eight_words_come_in_reversed_order) {
  CoreBench b(R"(
    mov #0x900, w1
    mov #0x8004, w0      ; BREN, XB = half of 8 words
    mov w0, XBREV
    mov #0x01FF, w0      ; BWM = 1
    mov w0, MODCON
    nop
    clr w2
    do #7, 1f
    nop
1:  mov w2, [w1++]
end: bra end)");
  // each write puts 0; the pointer's course is what counts
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(1), 0x900u);  // round once
}

TEST(BitReversed, pointer_steps_from_the_highest_bit) {
  const unsigned expected[] = {0x908, 0x904, 0x90C, 0x902, 0x90A, 0x906, 0x90E, 0x900};
  for (int n = 1; n <= 8; ++n) {
    CoreBench b(
        "mov #0x900, w1\n mov #0x8004, w0\n mov w0, XBREV\n mov #0x01FF, w0\n mov w0, MODCON\n nop\n clr "
        "w2\n .rept " +
        std::to_string(n) + "\n mov w2, [w1++]\n .endr\nend: bra end");
    ASSERT_TRUE(b.run_to("end"));
    EXPECT_EQ(b.w(1), expected[n - 1]) << n;
  }
}

// --- interrupts

// T1 is switched on by the write in cycle t, counts from t + 1, and matches PR1 + 1 cycles later
TEST(Interrupt, entry_takes_three_cycles_after_the_flag_is_seen) {
  CoreBench b(R"(
__reset: mov #49, w0
    mov w0, PR1
    bset IEC0, #T1IE
    clr w1
    bset T1CON, #15
on: inc w1, w1
    bra on
__T1Interrupt: bclr IFS0, #T1IF
    mov #5, w5
    retfie)");
  ASSERT_TRUE(b.run_to("on"));
  const Cycle on = b.cpu->now();
  ASSERT_TRUE(b.run_to("__T1Interrupt"));
  const Cycle flag = b.chip->interrupts().flag_since(dspic::kFirstIrqVector + dspic::irq::T1);
  EXPECT_GE(b.cpu->now(), flag + 1 + 3);
  EXPECT_LE(b.cpu->now(), flag + 1 + 3 + 1);  // a branch of 2 cycles may be under way
  EXPECT_NEAR(static_cast<double>(flag - on), 50, 1);
  EXPECT_EQ(b.sfr("SR") >> 5 & 7, 4u);
  const unsigned sp = b.w(15);
  EXPECT_EQ(sp, 0x804u);
  EXPECT_EQ(b.word(0x802) & 0xFFu, 0u);
}

TEST(Interrupt, higher_priority_nests_and_returns) {
  CoreBench b(R"(
__reset: clr w1
    clr w2
    mov #0x4445, w0       ; INT0 5
    mov w0, IPC0
    bset IEC0, #INT0IE
    bset IEC0, #T1IE
    bset IFS0, #T1IF
    nop
    nop
end: bra end
__T1Interrupt: bclr IFS0, #T1IF
    bset IFS0, #INT0IF
    nop
    nop
    mov w1, w2            ; INT0 has run by now
    retfie
__INT0Interrupt: bclr IFS0, #INT0IF
    mov #1, w1
    mov SR, w3
    retfie)");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(2), 1u);
  EXPECT_EQ(b.w(3) >> 5 & 7, 5u);
  EXPECT_EQ(b.sfr("SR") >> 5 & 7, 0u);
  EXPECT_EQ(b.w(15), 0x800u);
}

// a trap that its own level held off shortens the return, wherever windows end
TEST(Interrupt, a_trap_that_was_held_off_shortens_the_return) {
  constexpr const char* kTraps = R"(
__reset: mov #0xFFFF, w0
    mov w0, PR1
    bset T1CON, #15
    mov #0x900, w8
    clr w2
    repeat #17
    div.s w4, w2
end: bra end
__MathError: bclr INTCON1, #MATHERR
    mov TMR1, w3
    mov w3, [w8++]
    repeat #17
    div.s w4, w2
    retfie)";
  for (const Cycle window : {1000, 1, 7}) {
    CoreBench b(kTraps);
    for (Cycle until = window; until <= 1000; until += window) ASSERT_FALSE(b.cpu->run(until));
    for (unsigned at = 0x900; at < 0x91C; at += 2) {
      // 3 to enter, three instructions, the division's 1 + 18, and 2 back
      EXPECT_EQ(b.word(at + 2) - b.word(at), 3u + 3 + 19 + 2) << window << " " << at;
    }
  }
}

TEST(Interrupt, nstdis_and_disi_hold_them_off) {
  CoreBench b(R"(
__reset: clr w1
    bset IEC0, #T1IE
    disi #20
    bset IFS0, #T1IF
    repeat #15
    nop
    mov w1, w2            ; not yet
    repeat #9
    nop
    mov w1, w3            ; now
end: bra end
__T1Interrupt: bclr IFS0, #T1IF
    inc w1, w1
    retfie)");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(2), 0u);
  EXPECT_EQ(b.w(3), 1u);
}

// --- resets

TEST(Reset, illegal_opcodes_and_unwritten_pointers) {
  for (const char* text : {".pword 0x018001", "mov [w3], w4", "clr.b w3\n mov w4, [w3]"}) {
    CoreBench b(std::string("__reset: btss RCON, #IOPUWR\n bra 1f\nend: bra end\n1: ") + text + "\n bra 1b");
    ASSERT_TRUE(b.run_to("end")) << text;
    EXPECT_EQ(b.resets, 1) << text;
  }
}

TEST(Reset, instruction_says_so_and_ram_stays) {
  CoreBench b("__reset: btsc RCON, #SWR\nend: bra end\n mov #0x1234, w0\n mov w0, 0x900\n reset");
  b.run(50);
  EXPECT_EQ(b.resets, 1);
  EXPECT_EQ(b.word(0x900), 0x1234u);
  EXPECT_EQ(b.w(0), 0u);
}

// 2 ms x 1 x 1
TEST(Reset, watchdog_bites_in_run_and_wakes_in_idle) {
  dspic::Configuration c;
  c.fwdt = 0x8000;
  CoreBench b("__reset: btsc RCON, #WDTO\nend: bra end\n1: bra 1b", c);
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.resets, 1);
  EXPECT_NEAR(static_cast<double>(b.cpu->now()), 29491 + 295, 10);  // and 20 us of reset

  CoreBench idle("__reset: pwrsav #1\nend: bra end", c);
  ASSERT_TRUE(idle.run_to("end"));
  EXPECT_EQ(idle.resets, 0);
  EXPECT_EQ(idle.sfr("RCON") & 0x14, 0x14u);  // WDTO, IDLE
  EXPECT_GT(idle.cpu->idle(idle.cpu->now()), 29000);
}

TEST(Power, idle_ends_with_an_interrupt) {
  CoreBench b(R"(
__reset: mov #999, w0
    mov w0, PR1
    clr w1
    bset IEC0, #T1IE
    bset T1CON, #15
    pwrsav #1
    nop
end: bra end
__T1Interrupt: bclr IFS0, #T1IF
    inc w1, w1
    retfie)");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(1), 1u);
  EXPECT_GT(b.cpu->idle(b.cpu->now()), 980);
  EXPECT_LT(b.cpu->now(), 1030);
}

// INT0's pin rises at 5000
TEST(Power, sleep_ends_by_what_needs_no_clock) {
  const std::string kTimer1 = "mov #999, w0\n mov w0, PR1\n bset IEC0, #T1IE\n bset T1CON, #15\n";
  const std::string kConverter = "mov #0x00E0, w0\n mov w0, ADCON1\n bset ADCON1, #15\n bset IEC0, #ADIE\n";
  const std::string kCapture = "bset IEC0, #IC1IE\n";
  const struct {
    std::string name, setup;
    std::uint64_t stands;  // sources for which it sleeps for ever; 0: it does not
  } kCases[] = {
      {"timer 1", kTimer1, std::uint64_t{1} << dspic::irq::T1},
      {"nothing", "", 0},
      {"timer 1 and a pin", kTimer1 + "bset IEC0, #INT0IE\n", 0},
      {"a pin", "bset IEC0, #INT0IE\n", 0},
      {"a flag from before", kTimer1 + "bset IFS0, #T1IF\n", 0},
      {"a converter's clock", kConverter + "bset ADCON1, #1\n", std::uint64_t{1} << dspic::irq::Adc},
      {"a converter with its own", "mov #0x0080, w0\n mov w0, ADCON3\n" + kConverter + "bset ADCON1, #1\n",
       0},
      {"a capture with its timer", kCapture + "mov #3, w0\n mov w0, IC1CON\n",
       std::uint64_t{1} << dspic::irq::Ic1},
      {"a timer with clocks from outside", kTimer1 + "mov #0x8002, w0\n mov w0, T1CON\n", 0},
      {"... in step", kTimer1 + "mov #0x8006, w0\n mov w0, T1CON\n", std::uint64_t{1} << dspic::irq::T1},
  };
  for (const auto& c : kCases) {
    CoreBench b("__reset: " + c.setup +
                "pwrsav #0\nend: bra end\n__T1Interrupt: bra end\n"
                "__INT0Interrupt: bra end\n__ADCInterrupt: bra end\n__IC1Interrupt: bra end");
    b.outside.clock({dspic::Port::F, 6}, 5000, 100000, 50000, 1);
    b.outside.clock({dspic::Port::C, 14}, 3000, 100, 50, 2000);  // T1CK
    b.chip->outside_changed(0);
    const bool wakes = b.run_to("end", 200000);
    const auto still = b.cpu->still();
    EXPECT_EQ(wakes, c.stands == 0 && c.name != "nothing") << c.name;
    EXPECT_EQ(still.since < dspic::kNever, !wakes) << c.name;
    EXPECT_EQ(still.enabled, c.stands) << c.name;
    EXPECT_EQ(b.sfr("RCON") & 0xC, 8u) << c.name;  // SLEEP
  }
  // Idle leaves timer 1 its clock; the watchdog wakes from both.
  CoreBench idle("__reset: " + kTimer1 + "pwrsav #1\nend: bra end\n__T1Interrupt: bra end");
  EXPECT_TRUE(idle.run_to("end", 2000));
  dspic::Configuration c;
  c.fwdt = 0x8000;
  CoreBench dog("__reset: " + kTimer1 + "pwrsav #0\nend: bra end", c);
  EXPECT_TRUE(dog.run_to("end", 40000));
}

// The watchdog wakes after 2 ms; before it timer 1 runs for 100 cycles, behind it for 50.
TEST(Power, timers_stand_in_sleep_and_with_tsidl_in_idle) {
  const struct {
    const char* control;
    const char* pwrsav;
    unsigned most;
  } kCases[] = {{"0x8000", "0", 153}, {"0xA000", "0", 153}, {"0xA000", "1", 153}, {"0x8000", "1", 29645}};
  for (const auto& c : kCases) {
    dspic::Configuration configuration;
    configuration.fwdt = 0x8000;
    CoreBench b(std::string("__reset: mov #") + c.control +
                    ", w0\n mov w0, T1CON\n repeat #98\n nop\n pwrsav #" + c.pwrsav +
                    "\n repeat #48\n nop\n mov TMR1, w1\nend: bra end",
                configuration);
    ASSERT_TRUE(b.run_to("end"));
    EXPECT_GE(b.w(1), c.most - 6) << c.control << " " << c.pwrsav;
    EXPECT_LE(b.w(1), c.most) << c.control << " " << c.pwrsav;
  }
}

// --- the assembler

TEST(Assembler, labels_stand_before_blocks_as_before_instructions) {
  CoreBench b(R"(
__reset: mov #0, w0
    bra two
    mov #99, w0
two: .rept 3
    inc w0, w0
    .endr
    bra three
three: .if 1
    add w0, #4, w0
    .endif
    bra four
four: .irp step, 8, 16
    add #\step, w0
    .endr
end: bra end)");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(0), 3 + 4 + 8 + 16);
}

// [the vendor's programmer's manual, DS70157: "if no extension is provided, the .Z operation is assumed"]
TEST(Assembler, tests_of_bits_in_registers_go_to_z_unless_they_name_c) {
  const auto words = [](const std::string& text) {
    const dspic::assembly::Image image = dspic::assembly::assemble(text, "test.s");
    EXPECT_TRUE(image.is_whole()) << image.report();
    return image.program;
  };
  EXPECT_EQ(words("btst w0, #3\n btsts [w1++], #15\n btst w2, w3\n bsw w4, w5"),
            words("btst.z w0, #3\n btsts.z [w1++], #15\n btst.z w2, w3\n bsw.z w4, w5"));
  EXPECT_NE(words("btst w0, #3"), words("btst.c w0, #3"));
  CoreBench b(R"(
__reset: mov #8, w0
    btst w0, #3
    bra z, end
    inc w1, w1
    btst w0, #4
    bra nz, end
    inc w1, w1
end: bra end)");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(1), 2u);
}

// what the vendor's device file defines, and a turned operand as tinybld has it
TEST(Assembler, knows_bits_and_configuration_words_by_name) {
  const dspic::assembly::Image image = dspic::assembly::assemble(R"(
    .include "p30F6014A.inc"
    config __FOSC, CSW_FSCM_OFF & XT_PLL8
__reset: bset U1STA, #URXISEL1
    mov #BLEN1, w0
    sub.b w3, #0xFF)",
                                                                 "test.s");
  ASSERT_TRUE(image.is_whole()) << image.report();
  const unsigned begin = image.symbols.at("__reset");
  EXPECT_EQ(image.program.at(0xF80000), 0xFFE6u);
  EXPECT_EQ(image.program.at(begin), 0xA8E20Eu);      // bit 7 of the byte at 0x20E
  EXPECT_EQ(image.program.at(begin + 2), 0x2000B0u);  // bit 11 of DCICON2
  EXPECT_EQ(image.program.at(begin + 4), 0xB14FF3u);
}

// --- self-programming

TEST(Flash, erases_writes_and_runs_what_was_written) {
  CoreBench b(kFlashMacro + R"(__reset: rcall routine      ; gives 1
    mov w5, w6
    clr TBLPAG
    mov #routine, w1
    mov w1, NVMADR
    clr NVMADRU
from:
    go 0x4041
to: mov #word, w2
    mov #0x0020, w3
    tblwtl w2, [w1]
    tblwth w3, [w1++]
    mov #0x0000, w2
    mov #0x06, w3
    tblwtl w2, [w1]
    tblwth w3, [w1]
    .equ word, 0x0075       ; mov #7, w5 = 0x200075, then return = 0x060000
    go 0x4001
    rcall routine
    mov #routine, w1
    tblrdl [w1], w7
    tblrdh [w1], w8
end: bra end
    .section .routine, code, address(0x1000)
routine: mov #1, w5
    return)");
  EXPECT_NEAR(static_cast<double>(between(b, "from", "to")), 29491,
              20);  // 2 ms, in which the processor stands
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(6), 1u);
  EXPECT_EQ(b.w(5), 7u);
  EXPECT_EQ(b.w(7), 0x0075u);
  EXPECT_EQ(b.w(8), 0x20u);
  EXPECT_EQ(b.program.read(0x1004), 0xFFFFFFu);  // the rest of the row is blank
}

// the first and the fourth one; what is no configuration word is left alone
TEST(Flash, configuration_words_are_written) {
  for (const unsigned address : {0xF80000u, 0xF80006u, 0x001000u}) {
    char place[120];
    std::snprintf(place, sizeof place, "__reset: mov #0x%x, w0\n mov w0, TBLPAG\n mov #0x%x, w1\n",
                  address >> 16, address & 0xFFFF);
    CoreBench b(kFlashMacro + place + R"(    mov #0x1234, w2
    tblwtl w2, [w1]
    go 0x4008
end: bra end)");
    ASSERT_TRUE(b.run_to("end"));
    if (address == 0x1000) {
      EXPECT_EQ(b.program.read(address), 0xFFFFFFu);
    } else {
      EXPECT_EQ(b.program.read(address) & 0xFFFF, 0x1234u) << address;
    }
  }
}

TEST(Flash, eeprom_words_are_written_while_the_processor_runs) {
  CoreBench b(R"(
__reset: mov #0x7F, w0
    mov w0, TBLPAG
    mov #0xF010, w1
    mov #0x1234, w2
    tblwtl w2, [w1]
    mov #0x4004, w0
    mov w0, NVMCON
    mov #0x55, w0
    mov w0, NVMKEY
    mov #0xAA, w0
    mov w0, NVMKEY
    bset NVMCON, #WR
    clr w4
1:  inc w4, w4
    btsc NVMCON, #WR
    bra 1b
    tblrdl [w1], w3
end: bra end)");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(3), 0x1234u);
  EXPECT_GT(b.w(4), 5000u);
}

// --- determinism

// found by fuzzing: where a window ended within the inner one's repetitions, the outer one went on
TEST(Core, a_repeat_that_is_repeated_goes_on_the_same_however_it_is_run) {
  const std::string text = "__reset: repeat #7\n repeat #0x909\n inc w0, w0\n1: bra 1b\n";
  CoreBench whole(text), steps(text);
  whole.run(20000);
  for (Cycle to = 37; to < 20000; to += 37) steps.run(to);
  steps.run(20000);
  EXPECT_EQ(steps.cpu->now(), whole.cpu->now());
  EXPECT_EQ(steps.cpu->state_hash(), whole.cpu->state_hash());
  EXPECT_EQ(whole.w(0), 0u);
}

TEST(Core, course_does_not_depend_on_how_it_is_run) {
  const std::string text = R"(
    .section .const, psv
text: .word 5
    .text
__reset: mov #0x900, w8
    mov #psvpage(text), w0
    mov w0, PSVPAG
    bset CORCON, #PSV
    mov #psvoffset(text), w9
    mov #99, w0
    mov w0, PR1
    clr w1
    bset IEC0, #T1IE
    bset T1CON, #15
1:  repeat #26
    add w1, [w9], w1
    mov w1, [w8]
    add w1, [w8], w2
    btsc w2, #0
    bra 1b
    bra 1b
__T1Interrupt: bclr IFS0, #T1IF
    push w2
    mov [w15-4], w3
    pop w2
    retfie)";
  CoreBench whole(text), steps(text);
  whole.run(100000);
  for (Cycle to = 1; to < 100000; to += 1 + to % 7) steps.run(to);
  steps.run(whole.cpu->now());
  EXPECT_EQ(steps.cpu->now(), whole.cpu->now());
  EXPECT_EQ(steps.cpu->state_hash(), whole.cpu->state_hash());
}

}  // namespace
