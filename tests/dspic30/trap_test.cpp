// SPDX-License-Identifier: MIT
// Traps: what leads to them, their flags by the device header's names, and the stack's limit.
#include "dspic30/core/cpu.h"
#include "tests/dspic30/core_bench.h"

namespace {

using bench::CoreBench;

TEST(Trap, each_has_its_vector) {
  const std::pair<const char*, const char*> causes[] = {
      {"mov #0x901, w1\n mov [w1], w2", "AddressError"},
      {"mov #0x3000, w1\n mov [w1], w2", "AddressError"},
      {"mov #0x7FE, w15\n push w0", "StackError"},
      {"mov #0x900, w0\n mov w0, SPLIM\n nop\n mov #0x902, w15\n push w0", "StackError"},
      {"clr w4\n clr w3\n repeat #17\n div.u w4, w3", "MathError"},
      {"mov #17, w3\n sftac A, w3", "MathError"},
      {"mov #0x7FFF, w4\n bset INTCON1, #OVATE\n lac w4, #-4, A", "MathError"},
      {"goto 0x18000", "AddressError"},
  };
  for (const auto& [text, trap] : causes) {
    CoreBench b("__reset: mov #0x900, w15\n clr w7\n clr w4\n" + std::string(text) +
                "\n nop\n nop\n nop\nend: bra end\n"
                "__AddressError: mov #1, w7\n1: bra 1b\n__StackError: mov #0x900, w15\n mov #2, w7\n1: bra "
                "1b\n__MathError: mov #3, w7\n1: bra 1b");
    b.run(200);
    const std::string names[] = {"none", "AddressError", "StackError", "MathError"};
    EXPECT_EQ(names[b.w(7) & 3], trap) << text;
  }
}

// flags by the names of the device header, which the assembler takes from sfr.csv. No clock fails here, so
// that flag is set by the program
TEST(Trap, a_handler_that_clears_its_flag_by_name_is_entered_once) {
  struct {
    const char *trap, *flag, *cause;
  } const kTraps[] = {
      {"OscillatorFail", "OSCFAIL", "bset INTCON1, #OSCFAIL"},
      {"AddressError", "ADDRERR", "mov #0x901, w1\n mov [w1], w2"},
      {"AddressError", "ADDRERR", "mov #0x3000, w1\n mov w1, [w1]"},
      {"AddressError", "ADDRERR", "bset INTCON1, #ADDRERR"},
      {"StackError", "STKERR", "mov #0xA00, w1\n mov w1, SPLIM\n nop\n mov [w15+0x120], w2"},
      {"StackError", "STKERR", "bset INTCON1, #STKERR"},
      {"MathError", "MATHERR", "clr w3\n repeat #17\n div.u w4, w3"},
      {"MathError", "MATHERR", "clr w3\n repeat #17\n div.sd w4, w3"},
      {"MathError", "MATHERR", "clr w3\n div.u w4, w3"},
      {"MathError", "MATHERR", "mov #17, w3\n sftac A, w3"},
      {"MathError", "MATHERR", "bset INTCON1, #MATHERR"},
  };
  for (const bool translated : {false, true})
    for (const auto& t : kTraps) {
      SCOPED_TRACE(std::string(t.trap) + ": " + t.cause);
      CoreBench b("__reset: mov #0x900, w15\n clr w4\n clr w5\n clr w7\n clr w8\n " + std::string(t.cause) +
                      "\n nop\n inc w8, w8\nend: bra end\n__" + t.trap +
                      ": inc w7, w7\n mov INTCON1, w6\n bclr INTCON1, #" + t.flag + "\n retfie",
                  {}, translated);
      b.run(2000);
      EXPECT_EQ(b.cpu->pc(), b.symbol("end"));
      EXPECT_EQ(b.w(7), 1u);
      EXPECT_EQ(b.w(8), 1u);
      EXPECT_EQ(b.sfr("INTCON1"), 0u);
      const dspic::SfrInfo& intcon1 = *dspic::sfr_named("INTCON1");
      EXPECT_EQ(dspic::sfr_bit_name(intcon1, __builtin_ctz(b.w(6))), std::string("INTCON1.") + t.flag);
      const bool by_program = std::string(t.cause).rfind("bset INTCON1", 0) == 0;
      EXPECT_EQ(b.chip->diagnostics().count(dspic::Cause::CpuTrap), by_program ? 0 : 1);
      EXPECT_EQ(b.resets, 0);
    }
}

// the trap's own entry and its handler work above the limit, and that is no further error
TEST(Trap, a_stack_that_goes_beyond_its_limit_is_told_once_and_by_whom) {
  CoreBench b(R"(__reset: mov #__SP_init, w15
    mov #__SPLIM_init, w0
    mov w0, SPLIM
    nop
    clr w7
    rcall deeper
end: bra end
deeper: lnk #20
    push w1
    rcall deeper
    ulnk
    return
__StackError: push.d w0
    push w2
    inc w7, w7
    bclr INTCON1, #STKERR
told: bra told
__AddressError: mov #99, w7
1:  bra 1b)");
  b.run(100000);
  EXPECT_EQ(b.cpu->pc(), b.symbol("told"));
  EXPECT_EQ(b.w(7), 1u);
  EXPECT_EQ(b.notes.count(dspic::Cause::CpuTrap), 1);
  EXPECT_EQ(b.chip->diagnostics().count(dspic::Cause::CpuTrap), 1);
  const auto& trap = b.cpu->cpu().latest_trap;
  ASSERT_TRUE(trap);
  EXPECT_EQ(trap->trap, dspic::Trap::StackError);
  EXPECT_GE(trap->pc, b.symbol("deeper"));
  EXPECT_LT(trap->pc, b.symbol("__StackError"));
  EXPECT_LE(b.w(15), dspic::Processor::kRamEnd);
}

// without a handler the program resets; who went beyond the limit stays known
TEST(Trap, what_led_to_a_reset_is_known_behind_it) {
  CoreBench b(R"(__reset: mov #__SP_init, w15
    mov #__SPLIM_init, w0
    mov w0, SPLIM
    btsc RCON, #SWR
end: bra end
deeper: push w1
    rcall deeper
__DefaultInterrupt: reset)");
  b.run(100000);
  EXPECT_EQ(b.resets, 1);
  EXPECT_EQ(b.cpu->pc(), b.symbol("end"));
  const auto& trap = b.cpu->cpu().latest_trap;
  ASSERT_TRUE(trap);
  EXPECT_EQ(trap->trap, dspic::Trap::StackError);
  EXPECT_GE(trap->pc, b.symbol("deeper"));
  EXPECT_LT(trap->pc, b.symbol("__DefaultInterrupt"));
}

// a frame that ends beyond RAM: the push behind it breaks both rules, and there is no room for any handler
TEST(Trap, an_overflow_beyond_ram_is_a_stack_error_first) {
  CoreBench b(R"(__reset: mov #__SP_init, w15
    mov #__SPLIM_init, w0
    mov w0, SPLIM
    btsc RCON, #SWR
end: bra end
    rcall large
large: lnk #8190
guilty: push w1
    bra guilty
__DefaultInterrupt: reset)");
  b.run(10000);
  EXPECT_EQ(b.resets, 1);
  const auto& trap = b.cpu->cpu().latest_trap;
  ASSERT_TRUE(trap);
  EXPECT_EQ(trap->trap, dspic::Trap::StackError);
  EXPECT_EQ(trap->pc, b.symbol("guilty"));
}

// the entry of an interrupt may be what goes beyond; its handler has not begun by then
TEST(Trap, an_interrupt_that_finds_no_stack_is_a_stack_error_of_what_it_cut) {
  CoreBench b(R"(__reset: mov #__SPLIM_init, w15
    mov w15, SPLIM
    nop
    clr w7
    mov #99, w0
    mov w0, PR1
    bset IEC0, #T1IE
    bset T1CON, #TON
work: inc w8, w8
    bra work
__T1Interrupt: bclr IFS0, #T1IF
    mov #7, w7
    retfie
__StackError: bclr INTCON1, #STKERR
told: bra told)");
  b.run(1000);
  EXPECT_EQ(b.cpu->pc(), b.symbol("told"));
  EXPECT_EQ(b.w(7), 0u);
  const auto& trap = b.cpu->cpu().latest_trap;
  ASSERT_TRUE(trap);
  EXPECT_GE(trap->pc, b.symbol("work"));
  EXPECT_LT(trap->pc, b.symbol("__T1Interrupt"));
  EXPECT_EQ(b.chip->diagnostics().count(dspic::Cause::CpuTrap), 1);
}

TEST(Trap, the_assembler_leaves_a_guard_above_the_stack) {
  const auto limit = [](const std::string& text) {
    CoreBench b("__reset: mov #__SPLIM_init, w0\n mov w0, SPLIM\nend: bra end\n" + text);
    EXPECT_TRUE(b.run_to("end"));
    return b.sfr("SPLIM") + 2;
  };
  constexpr unsigned kEnd = dspic::Processor::kRamEnd;
  EXPECT_LE(limit(""), kEnd - 16);
  EXPECT_LE(limit("f: lnk #1000\n ulnk\n return"), kEnd - 1000 - 16);
  // those that fit as they are stay so
  EXPECT_GE(limit("f: lnk #7000\n ulnk\n return"), 0x800u + 7000 + 16);
  EXPECT_GE(limit("f: lnk #3000\n ulnk\n return\ng: lnk #4000\n ulnk\n return"), 0x800u + 7000 + 16);
}

TEST(Trap, a_push_at_splim_itself_is_allowed) {
  CoreBench b(
      "__reset: mov #0x900, w15\n mov #0x902, w0\n mov w0, SPLIM\n nop\n push w0\n push w0\nend: bra "
      "end\n__StackError: mov #0x800, w15\n mov #1, w7\n1: bra 1b");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(15), 0x904u);
}

}  // namespace
