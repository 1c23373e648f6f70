// SPDX-License-Identifier: MIT
// The I2C module as a slave: a turret's program of sixteen cells, spoken to by a master that the test plays.
#include "dspic30/device/chip_parts.h"
#include "tests/dspic30/core_bench.h"

namespace {

using bench::CoreBench;
using bench::Cycle;
namespace irq = dspic::irq;

// the first byte written is a cell's number, further ones are put there and behind it; reads go on from there
constexpr const char* kCells = R"(
    .equ OWN, 0x42
__reset: mov #__SP_init, w15
    mov #OWN, w0
    mov w0, I2CADD
    bset IEC0, #SI2CIE
    bset I2CCON, #I2CEN
    clr handled
main: inc w9, w9
    bra main
__SI2CInterrupt: push.d w0
    push w2
    bclr IFS0, #SI2CIF
    inc handled
    mov #cells, w2
    btsc I2CSTAT, #D_NOT_A
    bra data
    mov I2CRCV, w0          ; the address
    setm expects
    btss I2CSTAT, #R_NOT_W
    bra done
    bra next_byte
data: btsc I2CSTAT, #R_NOT_W
    bra sent
    mov I2CRCV, w0
    cp0 expects
    bra z, store
    mov w0, index
    clr expects
    bra done
store: mov index, w1
    mov.b w0, [w2+w1]
    inc index
    bra done
sent: btsc I2CSTAT, #ACKSTAT
    bra done
next_byte: mov index, w1
    mov.b [w2+w1], w0
    inc index
    mov w0, I2CTRN
    bset I2CCON, #SCLREL
done: pop w2
    pop.d w0
    retfie
    .bss
cells: .space 16
index: .space 2
expects: .space 2
handled: .space 2
)";
constexpr std::uint8_t kWrite = 0x42 << 1, kRead = kWrite | 1;

/// Another master of the chip's I2C bus, to which the chip is a slave. The program has run up to `now`.
class I2cMaster {
 public:
  explicit I2cMaster(dspic::Dspic30f6014a& chip) : parts_(chip.parts()) {}
  void start(Cycle now) { at(now).hear_start(now); }
  bool write(std::uint8_t byte, Cycle now) { return at(now).hear_byte(byte, now); }
  std::uint8_t read(Cycle now) { return at(now).say_byte(); }
  void acknowledge(bool acknowledged, Cycle now) { at(now).hear_acknowledge(acknowledged, now); }
  void stop(Cycle now) { at(now).hear_stop(now); }
  bool holds_clock() const { return parts_.i2c.holds_clock(); }

 private:
  dspic::I2c& at(Cycle now) {
    parts_.events.run_to(now);
    return parts_.i2c;
  }
  dspic::ChipParts& parts_;
};

/// 100 kHz or so, and patient.
struct Master {
  CoreBench& b;
  I2cMaster master{*b.chip};
  Cycle now = 1000, waited = 0;
  static constexpr Cycle kBit = 147, kPatience = 10000;

  void go_on(Cycle cycles) {
    now += cycles;
    b.run(now);
    now = std::max(now, b.cpu->now());
  }
  void wait() {
    const Cycle begin = now;
    while (master.holds_clock() && now - begin < kPatience) go_on(1);
    EXPECT_LT(now - begin, kPatience) << "the slave never let SCL go";
    waited += now - begin;
  }
  void start() {
    go_on(kBit);
    master.start(now);
  }
  void stop() {
    wait();
    go_on(kBit);
    master.stop(now);
  }
  bool write(std::uint8_t byte) {
    wait();
    go_on(9 * kBit);
    return master.write(byte, now);
  }
  std::uint8_t read(bool more) {
    wait();
    go_on(8 * kBit);
    const std::uint8_t byte = master.read(now);
    go_on(kBit);
    master.acknowledge(more, now);
    return byte;
  }
};

TEST(I2cSlave, keeps_what_is_written_and_answers_what_is_read) {
  for (const bool translated : {false, true}) {
    CoreBench b(kCells, {}, translated);
    Master master{b};
    master.start();
    EXPECT_TRUE(master.write(kWrite));
    EXPECT_TRUE(master.write(3));
    for (const int value : {0x11, 0x22, 0x33}) EXPECT_TRUE(master.write(static_cast<std::uint8_t>(value)));
    master.stop();
    EXPECT_EQ(master.waited, 0);  // receiving holds no clock without STREN
    master.start();
    EXPECT_TRUE(master.write(kWrite));
    EXPECT_TRUE(master.write(4));
    master.start();  // a repeated one
    EXPECT_TRUE(master.write(kRead));
    EXPECT_EQ(master.read(true), 0x22);
    EXPECT_EQ(master.read(false), 0x33);
    master.stop();
    EXPECT_GT(master.waited, 20);  // the handler's way to SCLREL, twice
    EXPECT_LT(master.waited, 200);
    b.run(master.now + 100);
    EXPECT_EQ(b.word("handled"), 5u + 2 + 1 + 2);  // each address and byte
    EXPECT_EQ(b.cpu->ram(b.symbol("cells") + 5), 0x33);
    EXPECT_EQ(b.sfr("I2CSTAT") & 0x001Fu, 0x0014u);  // P, R_W; nothing waits
    EXPECT_EQ(b.resets, 0);
  }
}

TEST(I2cSlave, answers_to_no_other_address) {
  CoreBench b(kCells);
  Master master{b};
  for (const std::uint8_t address : {0x00, 0x40, 0x86, 0x87}) {
    master.start();
    EXPECT_FALSE(master.write(address));
    EXPECT_FALSE(master.write(1));
    EXPECT_EQ(master.read(false), 0xFF);
    master.stop();
  }
  EXPECT_EQ(b.word("handled"), 0u);
}

/// Registers alone, the module at address 0x42.
struct I2cSlaveRegisters : ::testing::Test {
  bench::Bench b;
  I2cMaster master{b.chip};
  I2cSlaveRegisters() {
    b.write("I2CADD", 0x42, 0);
    b.write("I2CCON", 0x9000, 1);
  }
};

TEST_F(I2cSlaveRegisters, an_unread_byte_is_kept_and_the_next_is_not_acknowledged) {
  master.start(100);
  EXPECT_EQ(b.read("I2CSTAT", 101) & 0x18, 0x08u);  // S
  EXPECT_TRUE(master.write(kWrite, 200));
  EXPECT_EQ(b.read("I2CSTAT", 201) & 0x26, 0x02u);  // RBF; no data, no read
  EXPECT_TRUE(b.flag(irq::SlaveI2c, 202));
  b.clear_flag(irq::SlaveI2c, 203);
  EXPECT_FALSE(master.write(0x77, 300));
  EXPECT_TRUE(b.flag(irq::SlaveI2c, 301));
  EXPECT_EQ(b.read("I2CSTAT", 302) & 0x62, 0x62u);  // I2COV, D_A, RBF
  EXPECT_EQ(b.read("I2CRCV", 303), unsigned{kWrite});
  b.clear("I2CSTAT", 0x40, 304);
  EXPECT_TRUE(master.write(0x78, 400));
  EXPECT_EQ(b.read("I2CRCV", 401), 0x78u);
  master.stop(500);
  EXPECT_EQ(b.read("I2CSTAT", 501) & 0x18, 0x10u);  // P
}

TEST_F(I2cSlaveRegisters, the_clock_is_held_until_the_program_releases_it) {
  master.start(100);
  EXPECT_TRUE(master.write(kRead, 200));
  EXPECT_TRUE(master.holds_clock());
  EXPECT_EQ(b.read("I2CCON", 201), 0x8000u);
  b.write("I2CTRN", 0xA5, 202);
  EXPECT_EQ(b.read("I2CSTAT", 203) & 0x4001, 1u);  // TBF, and no transmission of a master's
  EXPECT_TRUE(master.holds_clock());
  b.set("I2CCON", 0x1000, 204);
  EXPECT_FALSE(master.holds_clock());
  EXPECT_EQ(master.read(300), 0xA5);
  EXPECT_EQ(b.read("I2CSTAT", 301) & 0x1, 0u);
  b.write("I2CTRN", 0x5A, 302);  // in time: nothing is held
  master.acknowledge(true, 310);
  EXPECT_FALSE(master.holds_clock());
  EXPECT_EQ(master.read(400), 0x5A);
  b.clear_flag(irq::SlaveI2c, 401);
  master.acknowledge(false, 410);
  EXPECT_TRUE(b.flag(irq::SlaveI2c, 411));
  EXPECT_FALSE(master.holds_clock());
  EXPECT_EQ(master.read(500), 0xFF);  // it is over
  EXPECT_TRUE(b.outside.i2c.empty());
}

TEST_F(I2cSlaveRegisters, with_stren_each_byte_received_holds_the_clock) {
  b.write("I2CCON", 0x9040, 50);
  master.start(100);
  EXPECT_TRUE(master.write(kWrite, 200));
  EXPECT_TRUE(master.holds_clock());
  b.read("I2CRCV", 201);
  b.set("I2CCON", 0x1000, 202);
  EXPECT_FALSE(master.holds_clock());
  b.clear("I2CCON", 0x1000, 203);  // by the program, which STREN allows
  EXPECT_TRUE(master.holds_clock());
  b.set("I2CCON", 0x1000, 204);
  b.write("I2CCON", 0x9000, 205);
  b.clear("I2CCON", 0x1000, 206);  // and without it does not
  EXPECT_FALSE(master.holds_clock());
}

TEST_F(I2cSlaveRegisters, the_general_call_is_answered_with_gcen_alone) {
  master.start(100);
  EXPECT_FALSE(master.write(0, 200));
  b.write("I2CCON", 0x9080, 250);
  master.start(300);
  EXPECT_TRUE(master.write(0, 400));
  EXPECT_EQ(b.read("I2CSTAT", 401) & 0x200, 0x200u);  // GCSTAT
  EXPECT_EQ(b.read("I2CRCV", 402), 0u);
  EXPECT_TRUE(master.write(6, 500));
}

TEST_F(I2cSlaveRegisters, a_module_that_is_off_hears_nothing) {
  b.write("I2CCON", 0x1000, 50);
  master.start(100);
  EXPECT_FALSE(master.write(kWrite, 200));
  EXPECT_EQ(b.read("I2CSTAT", 201), 0u);
}

// the robot's bus has no other master: a program that waits for one is told
TEST_F(I2cSlaveRegisters, a_slave_without_a_master_is_told) {
  EXPECT_EQ(b.notes.count(dspic::Cause::UnmodelledBit), 1);
  EXPECT_EQ(b.notes.all[0].message,
            "I2CADD: the chip is the only master of its I2C bus here, so as a slave it is never spoken to");
}

}  // namespace
