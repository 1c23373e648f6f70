// SPDX-License-Identifier: MIT
// I2C, DCI and SPI: how long each operation takes and what the other end sees.
#include "tests/dspic30/bench.h"

namespace {

using bench::Bench;
using bench::Cycle;
using dspic::Port;
namespace irq = dspic::irq;

struct I2c : ::testing::Test {
  Bench b;
  Cycle now = 1000;
  I2c() {
    b.write("I2CBRG", 150, 0);
    b.write("I2CCON", 0x9000, 0);
  }
  /// Starts an operation in `now`; its length.
  Cycle control(unsigned bit) {
    b.clear_flag(irq::MasterI2c, now);
    b.set("I2CCON", bit, now);
    return finish();
  }
  Cycle send(unsigned byte) {
    b.clear_flag(irq::MasterI2c, now);
    b.write("I2CTRN", byte, now);
    return finish();
  }
  Cycle finish() {
    const Cycle begin = now;
    now = b.flag_rises(irq::MasterI2c, now + 1);
    return now - begin;
  }
};

// SCL period: 150 + 1 + FCY / 1111111 = 151 + 13 = 164 cycles
TEST_F(I2c, operations_take_their_scl_periods) {
  b.outside.reply = {true, 0x5A, 0};
  EXPECT_EQ(control(0x01), 164);      // start, 2 halves
  EXPECT_EQ(send(0xA0), 9 * 164);     // byte and acknowledge
  EXPECT_EQ(control(0x02), 2 * 164);  // restart, 4 halves
  EXPECT_EQ(control(0x08), 8 * 164);  // receive
  EXPECT_EQ(control(0x10), 164);      // acknowledge
  EXPECT_EQ(control(0x04), 3 * 82);   // stop
  EXPECT_EQ(b.read("I2CRCV", now), 0x5Au);
  const std::vector<std::string> expected = {"start", "write 160", "restart", "read", "ack", "stop"};
  EXPECT_EQ(b.outside.i2c, expected);
  EXPECT_EQ(b.outside.i2c_at[1], 1000 + 164 + 9 * 164);
}

TEST_F(I2c, status_follows_a_transmission) {
  b.outside.reply = {false, 0xFF, 0};
  control(0x01);
  EXPECT_EQ(b.read("I2CSTAT", now) & 0x18, 0x08u);  // S
  b.write("I2CTRN", 0x42, now);
  EXPECT_EQ(b.read("I2CSTAT", now + 1) & 0x4001, 0x4001u);            // TRSTAT, TBF
  EXPECT_EQ(b.read("I2CSTAT", now + 8 * 164 - 1) & 0x4001, 0x4001u);  // eight bits
  EXPECT_EQ(b.read("I2CSTAT", now + 8 * 164) & 0x4001, 0x4000u);      // TBF falls
  EXPECT_EQ(b.read("I2CSTAT", now + 9 * 164) & 0xC001, 0x8000u);      // ACKSTAT: nobody
  now += 9 * 164;
  control(0x04);
  EXPECT_EQ(b.read("I2CSTAT", now) & 0x18, 0x10u);  // P
  EXPECT_EQ(b.read("I2CCON", now) & 0x1F, 0u);
}

// the library's port set-up holds both pins low until the module lets them go, which is a stop; pins that
// were high all the time show none
TEST(I2cPins, taking_over_pins_that_were_low_is_a_stop) {
  for (const bool low : {false, true}) {
    bench::Bench b;
    b.outside.wired[Port::G] = 0x000C;
    b.outside.waves[Port::G][0] = 0x000C;
    if (low) b.clear("TRISG", 0x000C, 1);  // outputs; the latches are 0
    b.write("I2CBRG", 150, 10);
    b.write("I2CCON", 0x9000, 20);
    EXPECT_EQ(b.read("I2CSTAT", 40) & 0x18, low ? 0x10u : 0u);
    b.write("I2CCON", 0x1000, 50);
    EXPECT_EQ(b.read("I2CSTAT", 60) & 0x18, low ? 0x10u : 0u);  // it stays seen
  }
}

TEST_F(I2c, second_operation_is_refused) {
  b.set("I2CCON", 0x01, now);
  b.write("I2CTRN", 0x42, now + 10);
  EXPECT_EQ(b.read("I2CSTAT", now + 11) & 0x80, 0x80u);  // IWCOL
  b.clear("I2CSTAT", 0x80, now + 12);
  b.set("I2CCON", 0x04, now + 13);
  EXPECT_EQ(b.read("I2CSTAT", now + 14) & 0x80, 0x80u);
  EXPECT_EQ(b.read("I2CCON", now + 14) & 0x1F, 0x01u);
  b.chip.run_to(now + 5000);
  EXPECT_EQ(b.outside.i2c, std::vector<std::string>{"start"});
  EXPECT_EQ(b.notes.count(dspic::Cause::I2cMisuse), 1);
}

TEST_F(I2c, unread_byte_is_kept_and_the_next_dropped) {
  b.outside.reply = {true, 0x11, 0};
  control(0x08);
  b.outside.reply = {true, 0x22, 0};
  control(0x08);
  EXPECT_EQ(b.read("I2CSTAT", now) & 0x42, 0x42u);  // I2COV, RBF
  EXPECT_EQ(b.peek("I2CRCV", now), 0x11u);
  EXPECT_EQ(b.read("I2CRCV", now), 0x11u);
  EXPECT_EQ(b.read("I2CSTAT", now) & 0x02, 0u);
}

TEST_F(I2c, device_that_holds_the_clock_makes_it_longer) {
  b.outside.reply = {true, 0, 500};
  control(0x01);
  EXPECT_EQ(send(1), 9 * 164 + 500);
}

TEST_F(I2c, not_acknowledging_is_told) {
  b.set("I2CCON", 0x20, now);
  control(0x10);
  EXPECT_EQ(b.outside.i2c.back(), "nack");
}

TEST_F(I2c, switching_off_forgets_the_operation) {
  b.set("I2CCON", 0x01, now);
  b.write("I2CCON", 0, now + 50);
  b.chip.run_to(now + 5000);
  EXPECT_TRUE(b.outside.i2c.empty());
  EXPECT_EQ(b.read("I2CSTAT", now + 5000), 0u);
  b.write("I2CTRN", 1, now + 5001);
  EXPECT_EQ(b.notes.count(dspic::Cause::I2cMisuse), 1);
}

TEST_F(I2c, pins_can_be_driven_by_hand_only_while_it_is_off) {
  b.write("TRISG", 0xF3C3, now);  // RG2, RG3 outputs
  EXPECT_EQ(b.read("PORTG", now + 1) & 0xC, 0u);
  b.outside.wired[Port::G] = 0x000C;
  b.outside.waves[Port::G][0] = 0x000C;
  EXPECT_EQ(b.read("PORTG", now + 2) & 0xC, 0xCu);  // pull-ups: the module is silent
  b.write("I2CCON", 0x1000, now + 3);
  EXPECT_EQ(b.read("PORTG", now + 5) & 0xC, 0u);
}

// --- DCI

/// The library's settings while it plays: bit clock 8 cycles, 16 words of 16 bits, slot 0 only, four buffers.
struct Dci : ::testing::Test {
  Bench b;
  void start(Cycle at) {
    b.write("DCICON2", 3 << 10 | 15 << 5 | 15, 0);
    b.write("DCICON3", 3, 0);
    b.write("TSCON", 1, 0);
    b.write("RSCON", 1, 0);
    for (unsigned i = 0; i < 4; ++i) b.write("TXBUF" + std::to_string(i), 0x1000 + i, 0);
    b.write("DCICON1", 0x8020, at);  // DJST
  }
};

// frame 16 x 16 x 8 = 2048 cycles, interrupt every 4 frames. Enabled at 99, frames from 100 + 8;
// slot 0 of frame 3 ends 3 x 2048 + 128 after that
TEST_F(Dci, codec_interrupt_comes_every_8192_cycles) {
  start(99);
  EXPECT_EQ(b.flag_rises(irq::Dci, 100), 108 + 3 * 2048 + 128);
  b.clear_flag(irq::Dci, 108 + 3 * 2048 + 128);
  EXPECT_EQ(b.flag_rises(irq::Dci, 108 + 3 * 2048 + 129), 108 + 3 * 2048 + 128 + 8192);
}

TEST_F(Dci, what_was_loaded_before_goes_out_first) {
  start(99);
  EXPECT_EQ(b.read("DCISTAT", 100) & 0xF, 0x1u);  // TMPTY
  for (unsigned i = 0; i < 4; ++i) b.write("TXBUF" + std::to_string(i), 0x2000 + i, 200 + i);
  b.chip.run_to(108 + 8192 * 2);
  ASSERT_EQ(b.outside.codec.size(), 8u);
  EXPECT_EQ(b.outside.codec[0], std::make_pair(std::uint16_t{0x1000}, Cycle{108 + 128}));
  EXPECT_EQ(b.outside.codec[3].first, 0x1003);
  EXPECT_EQ(b.outside.codec[4], std::make_pair(std::uint16_t{0x2000}, Cycle{108 + 8192 + 128}));
}

TEST_F(Dci, received_words_and_status) {
  b.outside.codec_answer = [n = 0](std::uint16_t) mutable {
    return static_cast<std::uint16_t>(0x3000 + n++);
  };
  start(99);
  for (unsigned i = 0; i < 4; ++i) b.write("TXBUF" + std::to_string(i), 0, 200);
  const Cycle full = 108 + 3 * 2048 + 128;
  EXPECT_EQ(b.read("DCISTAT", full - 1) & 0x4, 0u);
  EXPECT_EQ(b.read("DCISTAT", full) & 0xF, 0x5u);  // RFUL, TMPTY
  EXPECT_EQ(b.read("RXBUF0", full + 1), 0x3000u);
  EXPECT_EQ(b.read("RXBUF3", full + 1), 0x3003u);
  EXPECT_EQ(b.read("DCISTAT", full + 2) & 0x4, 0u);
  // nothing is written or read for two periods
  EXPECT_EQ(b.read("DCISTAT", full + 2 * 8192) & 0xF, 0xFu);
}

TEST_F(Dci, nothing_of_before_is_left_behind_a_reset) {
  b.outside.codec_answer = [](std::uint16_t) { return std::uint16_t{0x3333}; };
  start(99);
  for (unsigned i = 0; i < 4; ++i) b.write("TXBUF" + std::to_string(i), 0x2000 + i, 200 + i);
  const Cycle reset = 108 + 8192 + 3000;  // in the middle of the second period
  b.chip.run_to(reset);
  b.chip.reset(dspic::ResetKind::Instruction, reset);
  for (const std::string name :
       {"DCICON1", "DCICON2", "DCICON3", "DCISTAT", "TSCON", "RSCON", "RXBUF0", "RXBUF1", "RXBUF2", "RXBUF3"})
    EXPECT_EQ(b.read(name, reset + 1) & (name == "DCISTAT" ? 0xF0Eu : 0xFFFFu), 0u) << name;
  const std::size_t sent = b.outside.codec.size();
  b.write("DCICON2", 3 << 10 | 15 << 5 | 15, reset + 2);
  b.write("DCICON3", 3, reset + 2);
  b.write("TSCON", 1, reset + 2);
  b.write("DCICON1", 0x80A0, reset + 10);  // DJST, UNFM: the last words, of which there are none
  b.chip.run_to(reset + 10 + 9 + 4 * 2048 + 200);
  ASSERT_GE(b.outside.codec.size(), sent + 4);
  for (std::size_t i = sent; i < b.outside.codec.size(); ++i) EXPECT_EQ(b.outside.codec[i].first, 0u) << i;
  EXPECT_EQ(b.outside.codec[sent].second, reset + 10 + 1 + 8 + 128);
}

TEST_F(Dci, underrun_sends_zeros_or_the_last_words) {
  for (const unsigned unfm : {0x00u, 0x80u}) {
    Bench fresh;
    fresh.write("DCICON2", 15, 0);  // one word a frame, one buffer
    fresh.write("DCICON3", 3, 0);
    fresh.write("TSCON", 1, 0);
    fresh.write("TXBUF0", 0xBEEF, 0);
    fresh.write("DCICON1", 0x8020 | unfm, 0);
    fresh.chip.run_to(9 + 2 * 128);
    ASSERT_EQ(fresh.outside.codec.size(), 2u);
    EXPECT_EQ(fresh.outside.codec[0].first, 0xBEEF);
    EXPECT_EQ(fresh.outside.codec[1].first, unfm ? 0xBEEF : 0);
  }
}

// the set-up code polls SLOT for zero and non-zero: 8 slots of 128 cycles, one enabled
TEST_F(Dci, slot_counts_through_disabled_slots) {
  b.write("DCICON2", 1 << 10 | 7 << 5 | 15, 0);
  b.write("DCICON3", 3, 0);
  b.write("TSCON", 1, 0);
  b.write("DCICON1", 0x8020, 0);  // from cycle 9
  for (unsigned s = 0; s < 8; ++s) EXPECT_EQ(b.read("DCISTAT", 9 + 128 * s + 5) >> 8, s);
  EXPECT_EQ(b.read("DCISTAT", 9 + 1024) >> 8, 0u);
  EXPECT_EQ(b.chip.horizon(0x246, 9 + 10), 9 + 128);
}

TEST_F(Dci, data_follows_the_frame_sync_by_a_bit_unless_djst) {
  b.write("DCICON2", 15, 0);
  b.write("DCICON3", 3, 0);
  b.write("RSCON", 1, 0);
  b.write("DCICON1", 0x8000, 0);
  EXPECT_EQ(b.flag_rises(irq::Dci, 1), 1 + 8 + 8 + 128);
}

// 8-bit words are left-justified in the registers
TEST_F(Dci, short_words_and_loop_back) {
  b.write("DCICON2", 7, 0);
  b.write("DCICON3", 1, 0);  // 4 cycles a bit
  b.write("TSCON", 1, 0);
  b.write("RSCON", 1, 0);
  b.write("TXBUF0", 0xA500, 0);
  b.write("DCICON1", 0x8820, 0);
  EXPECT_EQ(b.flag_rises(irq::Dci, 1), 1 + 4 + 32);
  EXPECT_EQ(b.outside.codec[0].first, 0xA5);
  EXPECT_EQ(b.read("RXBUF0", 40), 0xA500u);
}

TEST_F(Dci, no_bit_clock_without_bcg) {
  b.write("DCICON2", 15, 0);
  b.write("TSCON", 1, 0);
  b.write("DCICON1", 0x8000, 0);
  EXPECT_FALSE(b.flag(irq::Dci, 1000000));
}

// --- SPI

// PPRE = 3 (1:1), SPRE = 6 (2:1): 2 cycles a bit, 16 for a byte
TEST(Spi, byte_takes_eight_clocks) {
  Bench b;
  b.write("SPI1CON", 0x0020 | 6 << 2 | 3, 0);
  b.write("SPI1STAT", 0x8000, 0);
  b.write("SPI1BUF", 0x3C, 100);
  EXPECT_EQ(b.flag_rises(irq::Spi1, 101), 101 + 16);
  EXPECT_EQ(b.read("SPI1STAT", 120) & 3, 1u);
  EXPECT_EQ(b.read("SPI1BUF", 121), 0xC3u);
  EXPECT_EQ(b.read("SPI1STAT", 122) & 3, 0u);
}

// PPRE = 1 (16:1), SPRE = 4 (4:1): 64 cycles a bit, 1024 for 16 bits
void write_two_words(Bench& b) {
  b.write("SPI2CON", 0x0420 | 4 << 2 | 1, 0);
  b.write("SPI2STAT", 0x8000, 0);
  b.write("SPI2BUF", 0x1111, 100);
  b.write("SPI2BUF", 0x2222, 101);
}

// the second word waits, unread ones overflow
TEST(Spi, words_queue_and_overflow) {
  Bench b;
  write_two_words(b);
  EXPECT_EQ(b.read("SPI2STAT", 102) & 2, 2u);  // SPITBF
  b.chip.run_to(101 + 2 * 1024 + 1);
  ASSERT_EQ(b.outside.spi.size(), 2u);
  EXPECT_EQ(b.outside.spi[0].second, 101 + 1024);
  EXPECT_EQ(b.outside.spi[1], std::make_pair(std::uint16_t{0x2222}, Cycle{101 + 1024 + 1 + 1024}));
  EXPECT_EQ(b.read("SPI2STAT", 3000) & 0x40, 0x40u);  // SPIROV
  EXPECT_EQ(b.read("SPI2BUF", 3001), 0xEEEEu);
}

TEST(Spi, what_waits_is_gone_when_it_is_switched_off) {
  Bench b;
  write_two_words(b);
  b.write("SPI2STAT", 0, 200);
  b.write("SPI2STAT", 0x8000, 300);
  EXPECT_EQ(b.read("SPI2STAT", 301) & 3, 0u);
  b.chip.run_to(5000);
  EXPECT_TRUE(b.outside.spi.empty());
  b.write("SPI2BUF", 0x3333, 5000);
  b.chip.run_to(7000);
  ASSERT_EQ(b.outside.spi.size(), 1u);
  EXPECT_EQ(b.outside.spi[0].first, 0x3333);
}

}  // namespace
