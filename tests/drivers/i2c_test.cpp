// SPDX-License-Identifier: MIT
// The I2C module and its bus: times, who hears what, and the functions of pins_i2c.h through a fake host.
// Bits at BRG 150: 151 + 13 = 164 cycles. Start, stop, acknowledge 1 bit; a byte sent 9, received 8.
#include <gtest/gtest.h>

#include <vector>

#include "hal_sim/board/board.h"
#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_i2c.h"
#include "tests/drivers/driven_board.h"
#include "tests/drivers/fake_context.h"

namespace {

using board::Cycle;
using drivers::I2cMaster;

/// 256 registers at 0x42 that remember when they were used.
struct Registers : board::I2cRegisters {
  Registers() : I2cRegisters(0x42) {}
  std::array<std::uint8_t, 256> held{};
  std::vector<Cycle> uses;
  int ends = 0;
  bool write_register(std::uint8_t number, std::uint8_t value, Cycle at) override {
    held[number] = value;
    uses.push_back(at);
    return true;
  }
  std::uint8_t read_register(std::uint8_t number, Cycle at) override {
    uses.push_back(at);
    return held[number];
  }
  void end(Cycle) override { ++ends; }
};

struct I2c : ::testing::Test {
  DrivenBoard robot{board::Setup{}};
  Registers* device = nullptr;
  Cycle now = 1000;

  void SetUp() override {
    auto made = std::make_unique<Registers>();
    device = made.get();
    robot.i2c().attach(std::move(made));
  }
  I2cMaster& master() { return robot.i2c_master(); }
  Cycle run(I2cMaster::Operation operation, int byte = 0) {
    const Cycle began = now;
    const Cycle over = master().begin(operation, static_cast<std::uint8_t>(byte), now);
    if (over < 0) return over;
    now = over;
    master().settle(now);
    return over - began;
  }
};

using Op = I2cMaster::Operation;

TEST_F(I2c, operations_take_their_bits) {
  master().switch_on(150, now);
  EXPECT_EQ(run(Op::Start), 164);
  EXPECT_EQ(run(Op::Write, 0x43), 9 * 164);
  EXPECT_EQ(run(Op::Read), 8 * 164);
  EXPECT_EQ(run(Op::Refuse), 164);
  EXPECT_EQ(run(Op::Restart), 2 * 164);
  EXPECT_EQ(run(Op::Stop), 3 * 82);  // half bits, as the chip's module
  master().switch_on(20, now);       // 21 + 13
  EXPECT_EQ(run(Op::Start), 34);
}

TEST_F(I2c, a_register_is_written_and_read_back_and_counts_on) {
  master().switch_on(150, now);
  run(Op::Start);
  for (int byte : {0x42, 7, 11, 22}) {
    run(Op::Write, byte);
    EXPECT_TRUE(master().is_acknowledged()) << byte;
  }
  run(Op::Stop);
  EXPECT_EQ(device->held[7], 11);
  EXPECT_EQ(device->held[8], 22);
  EXPECT_EQ(device->ends, 1);
  run(Op::Start);
  run(Op::Write, 0x42);
  run(Op::Write, 7);
  run(Op::Restart);
  run(Op::Write, 0x43);
  run(Op::Read);
  EXPECT_EQ(master().received(), 11);
  run(Op::Acknowledge);
  run(Op::Read);
  EXPECT_EQ(master().received(), 22);
}

TEST_F(I2c, a_byte_arrives_when_its_last_bit_is_over_however_late_one_looks) {
  master().switch_on(150, 0);
  now = 0;
  run(Op::Start);        // over at 164
  run(Op::Write, 0x43);  // over at 1640
  master().begin(Op::Read, 0, 2000);
  master().settle(2000 + 8 * 164 - 1);
  EXPECT_TRUE(device->uses.empty());
  master().settle(1'000'000);
  ASSERT_EQ(device->uses.size(), 1u);
  EXPECT_EQ(device->uses[0], 2000 + 8 * 164);
}

TEST_F(I2c, nobody_answers_with_a_released_line) {
  master().switch_on(150, now);
  run(Op::Start);
  run(Op::Write, 0x44);
  EXPECT_FALSE(master().is_acknowledged());
  run(Op::Write, 3);
  EXPECT_FALSE(master().is_acknowledged());
  run(Op::Restart);
  run(Op::Write, 0x45);
  run(Op::Read);
  EXPECT_EQ(master().received(), 0xFF);
}

TEST_F(I2c, one_operation_at_a_time_and_none_while_off) {
  EXPECT_EQ(run(Op::Start), -1);
  EXPECT_FALSE(master().is_stopped());
  master().switch_on(150, now);
  EXPECT_TRUE(master().is_stopped());
  EXPECT_GT(master().begin(Op::Start, 0, now), now);
  EXPECT_EQ(master().begin(Op::Write, 0x42, now + 163), -1);
  master().settle(now + 164);
  EXPECT_TRUE(master().is_started());
  EXPECT_FALSE(master().is_stopped());
  EXPECT_GT(master().begin(Op::Write, 0x42, now + 164), now);
}

TEST_F(I2c, switching_off_releases_the_bus) {
  master().switch_on(150, now);
  run(Op::Start);
  run(Op::Write, 0x42);
  master().switch_off(now);
  EXPECT_EQ(device->ends, 1);
  master().switch_on(150, now);
  EXPECT_TRUE(master().is_stopped());
}

TEST_F(I2c, exports_ask_for_the_interrupt_and_lower_the_horizon) {
  FakeContext context(robot);
  context.cycle = 500;
  tp_i2c_switch(150);
  EXPECT_EQ(tp_i2c_begin(TP_I2C_START, 0), 500 + 164);
  EXPECT_EQ(context.requested[TP_V_MI2C], 500 + 164);
  EXPECT_EQ(tp_i2c_begin(TP_I2C_WRITE, 0x42), -1);
  context.horizon = host::kNever;
  EXPECT_EQ(tp_i2c_started(), 0);
  EXPECT_EQ(context.horizon, 500 + 164);
  context.cycle = 664;
  context.horizon = host::kNever;
  EXPECT_EQ(tp_i2c_started(), 1);
  EXPECT_EQ(tp_i2c_stopped(), 0);
  EXPECT_EQ(context.horizon, host::kNever);
  EXPECT_EQ(tp_i2c_begin(99, 0), -1);
  tp_i2c_switch(-1);
  EXPECT_EQ(context.requested[TP_V_MI2C], -1);
}

}  // namespace
