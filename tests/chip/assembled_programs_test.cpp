// SPDX-License-Identifier: MIT
// Programs assembled here, run as .hex files in a world.
#include "tests/chip/chip_fixture.h"
#include "tests/chip/onlooker.h"
#include "tests/support/wording.h"

namespace {

using firmware_test::Robot;

// steps of both motors, 5898 loops of 5 cycles between two, 500 a second, for ever; LED 0 changes every 512 steps
std::string text_of(const std::string& file) {
  std::ifstream in(TWINPUCK_SOURCE_DIR + file);
  return {std::istreambuf_iterator<char>(in), {}};
}
const std::string kDrive = text_of("/tests/fuzz/seeds/assembler/drive.s");

const std::string kHello = R"(
__reset: mov #7, w0
    mov w0, U1BRG
    mov #0x8000, w0
    mov w0, U1MODE
    bset U1STA, #10
    mov #tblpage(text), w0
    mov w0, TBLPAG
    mov #tbloffset(text), w1
1:  tblrdl.b [w1++], w2
    cp0.b w2
    bra z, 3f
2:  btsc U1STA, #9
    bra 2b
    ze w2, w2
    mov w2, U1TXREG
    bra 1b
3:  btss U1STA, #0            ; then every byte comes back, one more
    bra 3b
    mov U1RXREG, w0
    inc w0, w0
    mov w0, U1TXREG
    bra 3b
    .section .const, psv
text: .asciz "hello\r\n"
)";

class AssembledPrograms : public chip_test::ChipTest {
 protected:
  std::string drive() { return hex(kDrive); }
};

// 500 steps/s of 0.1288 mm: 64 mm/s
TEST_F(AssembledPrograms, drives_straight_and_blinks) {
  Robot& robot = add_robot(drive());
  run_for(2.0);
  EXPECT_NEAR(static_cast<double>(robot.left_steps()), 999, 3);
  EXPECT_EQ(robot.left_steps(), robot.right_steps());
  EXPECT_NEAR(robot.distance_m(), 0.128, 0.004);
  EXPECT_NEAR(robot.heading_deg(), 0, 0.5);
  EXPECT_TRUE(robot.led(0));  // step 512 to 1023
  expect_no_traps();
  expect_no_diagnoses();
}

TEST_F(AssembledPrograms, serial_line_speaks_and_listens) {
  Robot& robot = add_robot(hex(kHello));
  run_for(0.1);
  EXPECT_EQ(robot.uart(1).text(), "hello\r\n");
  robot.uart(1).send("HAL");
  run_for(0.1);
  EXPECT_EQ(robot.uart(1).text(), "hello\r\nIBM");
  expect_no_traps();
}

TEST_F(AssembledPrograms, images_mix_and_threads_do_not_matter) {
  std::uint64_t digests[2];
  for (int threads = 1; threads <= 2; ++threads) {
    struct Mixed : AssembledPrograms {
      void TestBody() override {}
      std::uint64_t run(int count) {
        options.threads = count;
        add_robot(drive(), "chip").at(0, 0);
        add_robot("blink", "blinker").at(0.3, 0);
        add_robot(hex(kHello), "talker").at(0.6, 0);
        run_for(0.5);
        EXPECT_GT(robot(0).distance_m(), 0.02);
        EXPECT_EQ(robot(2).uart(1).text(), "hello\r\n");
        return digest();
      }
    } mixed;
    digests[threads - 1] = mixed.run(threads);
  }
  EXPECT_EQ(digests[0], digests[1]);
}

// whoever is told what happens, or looks at each instruction, changes nothing
TEST_F(AssembledPrograms, an_observer_changes_nothing) {
  hal_test::Onlooker nobody;
  std::uint64_t digests[3];
  double loads[3];
  for (int looks = 0; looks < 3; ++looks) {
    if (looks == 2) nobody.look_every = 1;
    struct One : AssembledPrograms {
      void TestBody() override {}
      std::pair<std::uint64_t, double> run(host::Observer* observer) {
        add_robot(drive());
        twin().mind(0).runner()->observe(observer);
        run_for(0.2);
        return {digest(), twin().mind(0).runner()->cpu_load()};
      }
    } one;
    std::tie(digests[looks], loads[looks]) = one.run(looks ? &nobody : nullptr);
    if (looks == 1) {
      EXPECT_LT(nobody.reaches, 1000);
    }
  }
  for (int looks = 1; looks < 3; ++looks) {
    EXPECT_EQ(digests[0], digests[looks]);
    EXPECT_EQ(loads[0], loads[looks]);
  }
  EXPECT_GT(nobody.reaches, 2000);  // delays, which are most of it, are passed over
}

// load is the share of the time in which the program does anything but poll, count a delay down or sleep
TEST_F(AssembledPrograms, waits_are_no_load) {
  const auto load_of = [](const std::string& text) {
    struct One : AssembledPrograms {
      void TestBody() override {}
      double run(const std::string& program) {
        add_robot(hex(program));
        run_for(0.5);
        return twin().mind(0).runner()->cpu_load();
      }
    } one;
    return one.run(text);
  };
  EXPECT_LT(load_of(kHello), 0.05);  // polls
  EXPECT_LT(load_of(kDrive), 0.05);  // a delay loop
  EXPECT_LT(load_of("__reset: repeat #16383\n nop\n bra __reset\n"), 0.05);
  EXPECT_GT(load_of("__reset: clr w0\n1: inc w0, w0\n inc w1, w1\n bra 1b\n"), 0.95);  // two values change
  EXPECT_GT(load_of("__reset: mov #0x800, w1\n mov #0x7ff, w2\n1: mov [w1++], w0\n and w1, w2, w1\n bset w1, "
                    "#11\n bra 1b\n"),
            0.95);  // the counter is a pointer
  EXPECT_GT(load_of("__reset: bclr TRISA, #6\n1: btg LATA, #6\n bra 1b\n"), 0.95);  // an LED blinks
}

TEST_F(AssembledPrograms, diagnoses_say_when) {
  Robot& robot =
      add_robot(hex("__reset: repeat #14744\n nop\n mov #0x1235, w1\n mov [w1], w2\nend: bra end\n"
                    "__AddressError: bra __AddressError\n"));
  run_for(0.1);
  ASSERT_EQ(robot.diagnoses().size(), 1u) << robot.diagnoses_text();
  EXPECT_NEAR(robot.diagnoses()[0].first_s, 0.001, 1e-5);
}

TEST_F(AssembledPrograms, resets_that_nobody_asked_for_are_told) {
  Robot& robot =
      add_robot(hex("__reset: btsc RCON, #IOPUWR\nend: bra end\n mov #0x1235, w1\n mov [w1], w2\n nop\n "
                    "nop\n nop\nend2: bra end2\n"
                    "__AddressError: .pword 0x018001"));
  run_for(0.1);
  ASSERT_EQ(robot.traps().size(), 1u);
  EXPECT_TRUE(wording::reads(robot.traps()[0].message,
                             "an illegal opcode resets the processor: the program ran into what is no code"));
  EXPECT_TRUE(
      wording::reads(robot.diagnoses_text(),
                     "AddressError at 0x000106: trap: AddressError at 0x000106: a word at the odd address "
                     "0x1235 is read: the program goes on at the trap's vector; at sub_000104() "
                     "(0x000106); twinpuck dis shows the instruction there; without a handler of "
                     "its own a program resets"));
}

TEST_F(AssembledPrograms, broken_files_are_named) {
  for (const auto& [bytes, wanted] :
       {std::pair{":0400000000010400F6\n:00000001FF\n", "…: line 1: checksum got 0xf6, expected 0xf7"},
        std::pair{":0400000000010400F7\n",
                  "…: the file ends without an end record (:00000001FF); is it cut off?"}}) {
    std::vector<std::string> problems;
    sim::WorldDesc desc = world;
    sim::RobotDesc robot;
    robot.name = "puck";
    desc.robots.push_back(robot);
    twin::Options with;
    with.firmware = {{"puck", write(bytes)}};
    EXPECT_EQ(twin::Twin::open(desc, with, problems), nullptr);
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_TRUE(wording::reads(problems[0], wanted));
  }
}

}  // namespace
