// SPDX-License-Identifier: MIT
// Why programs began anew, told by structure alone: images without symbols, as other tools make them.
#include "tests/chip/chip_fixture.h"

namespace {

using firmware_test::Robot;

// what XC16's start-up code does: stack, a call, main(), a word that stops a debugger, RESET
const std::string kStart = R"(
__reset: mov #__SP_init, w15
    mov #__SPLIM_init, w0
    mov w0, SPLIM
    nop
    rcall prepare
    call _main
    .pword 0xDA4000
    reset
prepare: return
)";
const std::string kDefault = R"(
__DefaultInterrupt: .pword 0xDA4000
    reset
)";
// Timer 1, its interrupt enabled, after a millisecond
const std::string kTimer = R"(
    mov #14745, w0
    mov w0, PR1
    bset IEC0, #3
    bset T1CON, #15
)";

struct Case {
  const char* what;
  std::string text;
  const char* vector;  // null: silence
  std::string message;
  const char* function = nullptr;
};

const std::string kResets = ", so the processor resets";
const std::string kNoAddressError = "; the program has no _AddressError()" + kResets;
const std::string kNoT1 = "the interrupt of T1 is enabled, but the program has no _T1Interrupt()" + kResets;
const std::string kNullCall =
    "a call through a null pointer leads to address 0: the program begins anew, and nothing is reset";
const std::string kMainReturned = "main() returned: there is nothing to return to" + kResets;

class Endings : public chip_test::ChipTest {
 protected:
  static std::vector<host::TrapReport> traps_of(const std::string& text) {
    struct One : Endings {
      void TestBody() override {}
      std::vector<host::TrapReport> run(const std::string& program) {
        Robot& robot = add_robot(hex(program));
        run_for(0.05);
        return robot.traps();
      }
    } one;
    return one.run(text);
  }
};

TEST_F(Endings, resets_that_nobody_asked_for_are_told_with_vector_and_place) {
  const Case cases[] = {
      {"an interrupt without a handler", kStart + "_main:" + kTimer + "1: bra 1b\n" + kDefault, "T1", kNoT1,
       "sub_"},
      {"a trap without a handler", kStart + "_main: mov #0x1235, w1\n mov [w1], w2\n1: bra 1b\n" + kDefault,
       "AddressError", "a word at the odd address 0x1235 is read" + kNoAddressError, "sub_"},
      {"a word that is written at an odd address",
       kStart + "_main: mov #0x1235, w1\n mov w2, [w1]\n1: bra 1b\n" + kDefault, "AddressError",
       "a word at the odd address 0x1235 is written" + kNoAddressError, "sub_"},
      {"a byte behind RAM is read",
       kStart + "_main: mov #0x2801, w1\n mov.b [w1], w2\n1: bra 1b\n" + kDefault, "AddressError",
       "0x2801 is read, where nothing is; RAM ends at 0x27ff" + kNoAddressError, "sub_"},
      {"a word behind RAM is written",
       kStart + "_main: mov #0x2800, w1\n mov w2, [w1]\n1: bra 1b\n" + kDefault, "AddressError",
       "0x2800 is written, where nothing is; RAM ends at 0x27ff" + kNoAddressError, "sub_"},
      {"a constant is written", kStart + "_main: mov #0x8000, w1\n mov w2, [w1]\n1: bra 1b\n" + kDefault,
       "AddressError",
       "0x8000 is written, where nothing is; constants of the flash are read there, and none is written" +
           kNoAddressError,
       "sub_"},
      {"constants are read while their window is closed",
       kStart + "_main: bclr CORCON, #PSV\n mov #0x8000, w1\n mov [w1], w2\n1: bra 1b\n" + kDefault,
       "AddressError",
       "0x8000 is read, where nothing is; constants of the flash are read there while CORCON.PSV is 1" +
           kNoAddressError,
       "sub_"},
      {"a byte of a constant while their window is closed",
       kStart + "_main: bclr CORCON, #PSV\n mov #0x8001, w1\n mov.b [w1], w2\n1: bra 1b\n" + kDefault,
       "AddressError",
       "0x8001 is read, where nothing is; constants of the flash are read there while CORCON.PSV is 1" +
           kNoAddressError,
       "sub_"},
      {"half of two constants",
       kStart + "_main: bset CORCON, #PSV\n mov #0x8001, w1\n mov [w1], w2\n1: bra 1b\n" + kDefault,
       "AddressError", "a word at the odd address 0x8001 is read" + kNoAddressError, "sub_"},
      {"a jump to where no flash is",
       kStart + "_main: mov #0xfffe, w1\n clr w2\n mov #1, w2\n push w1\n push w2\n return\n" + kDefault,
       "AddressError", "the program is led to 0x01fffe, where there is no flash" + kNoAddressError},
      {"a frame that ends beyond RAM, and a call",
       kStart + "_main: lnk #9000\n rcall f\n1: bra 1b\nf: return\n" + kDefault, "AddressError",
       "stack overflow in sub_000114(); the program has no _AddressError()" + kResets, "sub_"},
      {"a division by zero",
       kStart + "_main: clr w2\n mov #5, w0\n repeat #17\n div.s w0, w2\n1: bra 1b\n" + kDefault, "MathError",
       "division by zero, or an overflow of an accumulator; the program has no _MathError()" + kResets,
       "sub_"},
      {"main() returns", kStart + "_main: nop\n nop\n return\n" + kDefault, "Reset", kMainReturned, "sub_"},
      {"a call through a null pointer", kStart + "_main: clr w1\n call w1\n1: bra 1b\n" + kDefault, "Reset",
       kNullCall, "sub_"},
      {"a jump through a null pointer", kStart + "_main: clr w1\n goto w1\n" + kDefault, "Reset", kNullCall,
       "sub_"},
      {"a stack that was overwritten",
       kStart +
           "_main: rcall f\n1: bra 1b\nf: clr [--w15]\n clr [--w15]\n inc2 w15, w15\n inc2 w15, w15\n "
           "return\n" +
           kDefault,
       "Reset",
       "a return to address 0: something has overwritten the stack; the program begins anew, and nothing is "
       "reset",
       "sub_"},
      {"an illegal opcode", kStart + "_main: .pword 0x018001\n" + kDefault, "Reset",
       "an illegal opcode resets the processor: the program ran into what is no code", "sub_"},
      {"a register that nobody wrote", kStart + "_main: mov [w9], w1\n" + kDefault, "Reset",
       "an address in a register that was never written resets the processor", "sub_"},
      {"a stack without end", kStart + "_main: push w0\n bra _main\n" + kDefault, "StackError",
       "stack overflow in sub_000114(); the program has no _StackError()" + kResets, "sub_"},
      {"an interrupt whose vector is empty", kStart + "_main:" + kTimer + "1: bra 1b\n", "T1", kNoT1},
      {"a bootloader before it, as far as the stack says",
       "__reset: mov #0x900, w15\n goto start\n"
       "start: mov #__SP_init, w15\n mov #__SPLIM_init, w0\n mov w0, SPLIM\n nop\n call _main\n "
       "reset\n_main: return\n" +
           kDefault,
       "Reset", kMainReturned},

      {"RESET in main()", kStart + "_main: btss RCON, #SWR\n reset\n1: bra 1b\n" + kDefault, nullptr, ""},
      {"RESET behind a call in main()",
       kStart + "_main: rcall prepare\n btss RCON, #SWR\n bra 2f\n1: bra 1b\n2: call prepare\n reset\n" +
           kDefault,
       nullptr, ""},
      {"a bootloader that has done its work",
       "__reset: mov #__SP_init, w15\n btsc RCON, #SWR\n1: bra 1b\n rcall write_row\n"
       " reset\nwrite_row: return\n" +
           kDefault,
       nullptr, ""},
      {"RESET in a handler of its own",
       kStart + "_main: btsc RCON, #SWR\n1: bra 1b\n" + kTimer + "2: bra 2b\n" + kDefault +
           "__T1Interrupt: reset\n",
       nullptr, ""},
      {"a jump to the start by its address", kStart + "_main: goto 0\n" + kDefault, "Reset",
       "a jump to address 0: the program begins anew, and nothing is reset"},
      {"a jump to the first instruction", kStart + "_main: goto __reset\n" + kDefault, "Reset",
       "the program came to its first instruction by a return, a call or a jump: the stack or a pointer was "
       "overwritten; it begins anew, and nothing is reset"},
      {"a trap with a handler that ends it",
       kStart + "_main: clr w2\n mov #5, w0\n repeat #17\n div.s w0, w2\n1: bra 1b\n" + kDefault +
           "__MathError: clr INTCON1\n mov #7, w2\n retfie\n",
       nullptr, ""},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const auto traps = traps_of(c.text);
    ASSERT_EQ(traps.size(), c.vector ? 1u : 0u) << (traps.empty() ? "" : traps[0].message);
    if (!c.vector) continue;
    EXPECT_EQ(traps[0].vector, c.vector) << traps[0].message;
    EXPECT_EQ(traps[0].message, c.message);
    if (c.function) {
      EXPECT_NE(traps[0].place.function.find(c.function), std::string::npos) << traps[0].place.function;
    }
    EXPECT_GT(traps[0].cycle, 0);
    EXPECT_GE(traps[0].count, 2) << "the program begins anew again and again";
  }
}

// a pointer that is wrong may be another one each time: what was touched first is told, and all are counted
TEST_F(Endings, a_pointer_that_is_another_one_each_time_is_one_report) {
  const auto traps = traps_of(kStart + R"(
_main: mov 0x900, w1
    inc2 0x900
    bset w1, #13
    bset w1, #14
    mov [w1], w2
)" + kDefault);
  ASSERT_EQ(traps.size(), 1u);
  EXPECT_EQ(traps[0].vector, "AddressError");
  EXPECT_NE(traps[0].place.function.find("sub_"), std::string::npos) << traps[0].place.function;
  EXPECT_GE(traps[0].count, 2);
}

// ten thousand resets a second are one line with a count, also where two alternate
TEST_F(Endings, what_comes_again_is_counted) {
  const auto traps = traps_of(kStart + R"(
_main: btg 0x900, #0
    btsc 0x900, #0
    bra 1f
    clr w2
    call w2
1:  .pword 0x018001
)" + kDefault);
  ASSERT_EQ(traps.size(), 2u);
  EXPECT_GT(traps[0].count, 100);
  EXPECT_GT(traps[1].count, 100);
}

// whoever looks changes nothing: a program whose functions are watched takes the same course
TEST_F(Endings, functions_that_are_watched_run_as_they_would) {
  const std::string text = kStart + R"(
_main: mov #100, w1
1:  mov w1, w0
    call _e_set_led
    dec w1, w1
    bra nz, 1b
    bra _main
_e_set_led: inc 0x900
    add w0, w1, w2
    xor w2, w3, w3
    mov w3, 0x902
    return
)" + kDefault;
  dspic::FirmwareFile plain = with_labels(text), watched = plain;
  plain.functions.clear();
  std::uint64_t hashes[2];
  int i = 0;
  for (const dspic::FirmwareFile& file : {plain, watched}) {
    board::Setup setup;
    board::Board board(setup);
    chip::ChipRunner runner("puck", std::make_shared<chip::ChipImage>(file), 1, board);
    runner.begin_window(0);
    runner.run_until(3000000);
    hashes[i++] = runner.hash();
    if (i == 1) {
      EXPECT_TRUE(runner.diagnoses().empty());
    } else {
      ASSERT_FALSE(runner.diagnoses().empty());
      EXPECT_EQ(runner.diagnoses()[0].cause, "LED out of range");
      EXPECT_GT(runner.diagnoses()[0].count, 1000);
    }
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
