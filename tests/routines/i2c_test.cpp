// SPDX-License-Identifier: MIT
// The I2C master's primitives by heart and as they run: the same bytes on the bus at the same cycles, the
// same course, whatever interrupts come and wherever time is cut.
#include "dspic30/core/processor.h"
#include "dspic30/routines/known_routines.h"
#include "tests/dspic30/core_bench.h"
#include "tests/routines/routine_program.h"

namespace {

using namespace routines_test;
using dspic::Cycle;

// `PRIORITY` of a timer's handler that comes in between, each 7001 cycles; the library's own is 5
constexpr const char* kTransactions = R"(
#include <p30F6014A.h>
#include <I2C/e_I2C_protocol.h>
volatile unsigned ticks, sum, turns;
void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) { IFS0bits.T1IF = 0; ticks++; }
int main(void)
{
  unsigned char i = 0;
  IPC0bits.T1IP = PRIORITY;
  PR1 = 7000;
  IEC0bits.T1IE = 1;
  T1CONbits.TON = 1;
  e_i2cp_init();
  e_i2cp_enable();
  for (;;) {
    sum = sum * 3 + (unsigned char)e_i2cp_read((char)0xC0, (char)i);
    e_i2cp_write((char)0xC0, (char)i, (char)sum);
    i++;
    turns++;
    if (i % 16 == 0) { SRbits.IPL = 5; SRbits.IPL = 0; }
  }
}
)";

/// Answers what it was asked before, and never stretches the clock.
struct Device : bench::FakeOutside {
  bool stretches = false;
  bool i2c_may_stretch() const override { return stretches; }
  dspic::I2cReply i2c_write(std::uint8_t byte, Cycle at) override {
    reply.byte = static_cast<std::uint8_t>(37 * byte + 11);
    reply.stretched = stretches ? 77 : 0;
    return FakeOutside::i2c_write(byte, at);
  }
};

struct Robot {
  explicit Robot(const dspic::FirmwareFile& file) {
    outside.reply.acknowledged = true;
    for (const auto& [address, word] : file.words) program.write(address, word);
    dspic::Configuration c;
    c.program = &program;
    device = std::make_unique<dspic::Dspic30f6014a>(outside, &notes, c);
    cpu = std::make_unique<dspic::Processor>(*device, program);
  }
  unsigned word(const dspic::FirmwareFile& file, const char* name) const {
    const unsigned at = file.objects.at(name);
    return cpu->ram(at) | static_cast<unsigned>(cpu->ram(at + 1)) << 8;
  }
  Device outside;
  bench::Notes notes;
  dspic::ProgramMemory program;
  std::unique_ptr<dspic::Dspic30f6014a> device;
  std::unique_ptr<dspic::Processor> cpu;
};

dspic::FirmwareFile transactions(int priority) {
  dspic::FirmwareFile file;
  std::string error, text = kTransactions;
  text.replace(text.find("PRIORITY;"), 8, std::to_string(priority));
  EXPECT_TRUE(build(text, file, error)) << error;
  return file;
}

const char* const kNames[] = {"e_i2c_start", "e_i2c_restart", "e_i2c_stop",
                              "e_i2c_nack",  "e_i2c_read",    "e_i2c_write"};
long answers[6];
dspic::KnownAction real_actions[6];
template <int n>
int counted(dspic::Cpu& cpu, std::int64_t limit) {
  const int cycles = real_actions[n](cpu, limit);
  answers[n] += cycles != 0;
  return cycles;
}
dspic::KnownRoutine counting[6];

/// The primitives alone, each answer counted.
std::shared_ptr<const dspic::KnownCalls> primitives(const dspic::FirmwareFile& file,
                                                    const dspic::ProgramMemory& program) {
  static constexpr dspic::KnownAction kCounted[] = {&counted<0>, &counted<1>, &counted<2>,
                                                    &counted<3>, &counted<4>, &counted<5>};
  auto calls = std::make_shared<dspic::KnownCalls>();
  for (int n = 0; n < 6; ++n) {
    const unsigned address = file.functions.at(kNames[n]);
    const dspic::KnownRoutine* const known = dspic::find_known(kNames[n], program, address);
    EXPECT_TRUE(known) << kNames[n]
                       << "'s code is another one: look at its form again, then this is its sum: 0x"
                       << std::hex << dspic::code_sum(program, address, true);
    if (!known) continue;
    answers[n] = 0;
    real_actions[n] = known->action;
    counting[n] = {known->name, known->code, nullptr, kCounted[n]};
    calls->add(address, counting[n]);
  }
  return calls;
}

constexpr Cycle kEnd = 12000000;

TEST(I2cByHeart, is_the_same_on_the_bus_and_in_the_program) {
  for (const int priority : {4, 6}) {
    SCOPED_TRACE(priority);
    const dspic::FirmwareFile file = transactions(priority);
    Robot plain(file), by_heart(file);
    by_heart.cpu->know(primitives(file, by_heart.program));
    for (Cycle until = 50000; until <= kEnd; until += 50000) {
      ASSERT_FALSE(plain.cpu->run(until));
      ASSERT_FALSE(by_heart.cpu->run(until));
      ASSERT_EQ(by_heart.cpu->state_hash(), plain.cpu->state_hash()) << "at " << until;
      ASSERT_EQ(by_heart.device->state_hash(until), plain.device->state_hash(until)) << "at " << until;
    }
    EXPECT_EQ(by_heart.outside.i2c, plain.outside.i2c);
    EXPECT_EQ(by_heart.outside.i2c_at, plain.outside.i2c_at);
    constexpr int kVector = dspic::kFirstIrqVector + dspic::irq::MasterI2c;
    EXPECT_EQ(by_heart.device->interrupts().served(kVector), plain.device->interrupts().served(kVector));
    EXPECT_EQ(by_heart.cpu->idle(kEnd), plain.cpu->idle(kEnd));
    // 4 of 5 primitives are over before the timer's next handler, and before the window's end
    const unsigned turns = plain.word(file, "turns");
    EXPECT_GT(turns, 900u);
    for (int n = 0; n < 6; ++n) EXPECT_GT(answers[n], turns * 6 / 10) << kNames[n];
  }
}

TEST(I2cByHeart, does_not_depend_on_windows) {
  const dspic::FirmwareFile file = transactions(4);
  std::uint64_t hash = 0;
  Cycle idle = 0;
  for (const Cycle window : {kEnd / 4, Cycle{1}, Cycle{13}, Cycle{1477}, Cycle{20011}}) {
    Robot robot(file);
    robot.cpu->know(dspic::known_calls(file.functions, robot.program));
    for (Cycle until = window; until < kEnd / 4; until += window) robot.cpu->run(until);
    robot.cpu->run(kEnd / 4);
    if (hash == 0) {
      hash = robot.cpu->state_hash();
      idle = robot.cpu->idle(kEnd / 4);
    }
    EXPECT_EQ(robot.cpu->state_hash(), hash) << window;
    EXPECT_EQ(robot.cpu->idle(kEnd / 4), idle) << window;
  }
}

// a clock that may be stretched, a handler of the program's own, an interrupt that is off: the routine runs
TEST(I2cByHeart, is_not_known_where_it_may_be_otherwise) {
  const dspic::FirmwareFile file = transactions(4);
  for (const bool stretches : {false, true}) {
    Robot plain(file), by_heart(file);
    plain.outside.stretches = by_heart.outside.stretches = true;
    if (!stretches) {
      const unsigned handler = file.functions.at("_MI2CInterrupt") + 12;  // CLR.B of the mode
      for (Robot* robot : {&plain, &by_heart}) {
        robot->outside.stretches = false;
        robot->program.write(handler + 2, robot->program.read(handler + 2));
        robot->program.write(handler - 6, 0x000000);  // PSVPAG stays: one word is another
      }
    }
    by_heart.cpu->know(primitives(file, by_heart.program));
    ASSERT_FALSE(plain.cpu->run(kEnd / 4));
    ASSERT_FALSE(by_heart.cpu->run(kEnd / 4));
    for (const long n : answers) EXPECT_EQ(n, 0);
    EXPECT_EQ(by_heart.outside.i2c_at, plain.outside.i2c_at);
    EXPECT_GT(plain.outside.i2c.size(), 1000u);
  }
}

}  // namespace
