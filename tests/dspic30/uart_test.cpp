// SPDX-License-Identifier: MIT
// UARTs at BRG 7: 8 cycles a sixteenth, 128 a bit, 1280 a character of 8N1.
// Enabled in cycle 0, so the baud counter runs from cycle 1: sixteenths begin at 1, 9, 17 ...
#include "dspic30/periph/events.h"
#include "tests/dspic30/bench.h"

namespace {

using bench::Bench;
using bench::Cycle;
using dspic::UartFrame;
namespace irq = dspic::irq;

struct Uart : ::testing::Test {
  Bench b;
  void open(unsigned mode = 0x8000, unsigned sta = 0x8400, unsigned brg = 7) {
    b.write("U1BRG", brg, 0);
    b.write("U1MODE", mode, 0);
    b.write("U1STA", sta, 0);
    b.clear_flag(irq::U1Tx, 2);
  }
  void arrive(std::uint16_t word, Cycle start) {
    UartFrame f;
    f.word = word;
    f.start = start;
    b.chip.uart_receive(1, f, f.start);
  }
};

// written at 100: in the shift register at 101, start bit at the next sixteenth, 105
TEST_F(Uart, character_takes_ten_bits) {
  open();
  b.write("U1TXREG", 0x41, 100);
  b.chip.run_to(200);
  ASSERT_EQ(b.outside.sent.size(), 1u);
  EXPECT_EQ(b.outside.sent[0].start, 105);
  EXPECT_EQ(b.outside.sent[0].bit, 128);
  EXPECT_EQ(b.outside.sent[0].end(), 105 + 1280);
  EXPECT_EQ(b.outside.sent[0].word, 0x41);
  EXPECT_EQ(b.read("U1STA", 105 + 1279) & 0x100, 0u);
  EXPECT_EQ(b.read("U1STA", 105 + 1280) & 0x100, 0x100u);  // TRMT
}

TEST_F(Uart, characters_follow_without_a_gap) {
  open();
  for (int i = 0; i < 5; ++i) b.write("U1TXREG", 'a' + i, 100 + i);
  b.chip.run_to(105 + 5 * 1280);
  ASSERT_EQ(b.outside.sent.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(b.outside.sent[i].start, 105 + i * 1280);
}

TEST_F(Uart, fifo_of_four_and_shift_register_hold_five) {
  open();
  b.write("U1TXREG", '0', 100);
  for (int i = 1; i < 5; ++i) {
    EXPECT_EQ(b.read("U1STA", 101 + i) & 0x200, 0u);
    b.write("U1TXREG", '0' + i, 101 + i);
  }
  EXPECT_EQ(b.read("U1STA", 110) & 0x200, 0x200u);  // UTXBF
  b.write("U1TXREG", 'x', 111);                     // ignored
  b.chip.run_to(20000);
  ASSERT_EQ(b.outside.sent.size(), 5u);
  EXPECT_EQ(b.outside.sent[4].word, '4');
}

// UTXISEL = 1: the move that leaves the FIFO empty; 0: every move
TEST_F(Uart, transmit_interrupt_of_both_modes) {
  for (const unsigned utxisel : {0x8000u, 0x0000u}) {
    Bench fresh;
    fresh.write("U1BRG", 7, 0);
    fresh.write("U1MODE", 0x8000, 0);
    fresh.write("U1STA", utxisel | 0x400, 0);
    EXPECT_TRUE(fresh.flag(irq::U1Tx, 1));  // switching on sets it
    fresh.write("U1TXREG", 1, 100);
    fresh.write("U1TXREG", 2, 100);
    fresh.write("U1TXREG", 3, 100);
    fresh.clear_flag(irq::U1Tx, 100);
    EXPECT_EQ(fresh.flag_rises(irq::U1Tx, 101), utxisel ? 105 + 2 * 1280 : 101);
  }
}

TEST_F(Uart, words_written_before_utxen_wait) {
  open(0x8000, 0x0000);
  b.write("U1TXREG", 7, 50);
  b.chip.run_to(5000);
  EXPECT_TRUE(b.outside.sent.empty());
  b.set("U1STA", 0x0400, 5000);
  b.chip.run_to(5100);
  EXPECT_EQ(b.outside.sent.size(), 1u);
}

// start 1001 (a sixteenth), stop bit's middle after 9.5 bits: 1001 + 9 x 128 + 64
TEST_F(Uart, received_word_is_there_in_the_middle_of_its_stop_bit) {
  open();
  arrive(0x5A, 1001);
  EXPECT_EQ(b.read("U1STA", 1000) & 0x11, 0x10u);
  EXPECT_EQ(b.read("U1STA", 1500) & 0x11, 0x00u);  // RIDLE falls
  EXPECT_EQ(b.flag_rises(irq::U1Rx, 1), 1001 + 1216);
  EXPECT_EQ(b.read("U1STA", 2217) & 0x01, 0x01u);
  EXPECT_EQ(b.peek("U1RXREG", 2218), 0x5Au);
  EXPECT_EQ(b.peek("U1STA", 2218) & 1, 1u);  // looking takes nothing
  EXPECT_EQ(b.read("U1RXREG", 2219), 0x5Au);
  EXPECT_EQ(b.read("U1STA", 2220) & 0x01, 0u);
}

TEST_F(Uart, byte_accesses_push_and_pop) {
  open();
  b.chip.write(0x210, 0x33, 8, 100);
  arrive(0x77, 1001);
  EXPECT_EQ(b.chip.read(0x212, 8, 4000), 0x77);
  EXPECT_EQ(b.chip.read(0x20E, 8, 4001) & 1, 0);
  EXPECT_EQ(b.outside.sent.at(0).word, 0x33);
}

TEST_F(Uart, receive_interrupt_waits_for_three_or_four_words) {
  const std::pair<unsigned, int> cases[] = {{0x00, 1}, {0x40, 1}, {0x80, 3}, {0xC0, 4}};
  for (const auto& [urxisel, words] : cases) {
    Bench fresh;
    fresh.write("U2BRG", 7, 0);
    fresh.write("U2MODE", 0x8000, 0);
    fresh.write("U2STA", urxisel, 0);
    for (int i = 0; i < 4; ++i) {
      UartFrame f;
      f.start = 1001 + 1280 * i;
      fresh.chip.uart_receive(2, f, f.start);
    }
    EXPECT_EQ(fresh.flag_rises(irq::U2Rx, 1), 1001 + 1216 + (words - 1) * 1280);
  }
}

TEST_F(Uart, fifth_word_overruns_and_blocks) {
  open();
  for (int i = 0; i < 7; ++i) arrive(static_cast<std::uint16_t>('a' + i), 1001 + 1280 * i);
  b.chip.run_to(20000);
  EXPECT_EQ(b.read("U1STA", 20000) & 0x3, 0x3u);
  EXPECT_EQ(b.chip.uart_overruns(1), 3);
  ASSERT_EQ(b.notes.count(dspic::Cause::UartOverrun), 1);
  EXPECT_EQ(b.notes.all[0].place, "U1STA.OERR");
  EXPECT_EQ(b.read("U1RXREG", 20001), static_cast<unsigned>('a'));
  b.clear("U1STA", 0x2, 20002);
  EXPECT_EQ(b.read("U1STA", 20003) & 0x3, 0u);  // clearing empties the FIFO
  arrive('z', 30001);
  EXPECT_EQ(b.read("U1RXREG", 32000), static_cast<unsigned>('z'));
}

TEST_F(Uart, a_word_for_which_there_is_no_room_is_lost_and_told) {
  open();
  // one goes on to the shift register at once, four wait
  for (int i = 0; i < 5; ++i) b.write("U1TXREG", static_cast<unsigned>('a' + i), 100 + 2 * i);
  EXPECT_EQ(b.notes.count(dspic::Cause::UartFull), 0);
  b.write("U1TXREG", 'f', 110);
  ASSERT_EQ(b.notes.count(dspic::Cause::UartFull), 1);
  EXPECT_EQ(b.notes.all[0].place, "U1TXREG");
  EXPECT_EQ(b.notes.all[0].message,
            "U1TXREG is written while four words wait in it: what is written is lost");
  b.chip.run_to(20000);
  std::string sent;
  for (const UartFrame& frame : b.outside.sent) sent += static_cast<char>(frame.word);
  EXPECT_EQ(sent, "abcde");
}

TEST_F(Uart, words_wait_for_a_transmitter_that_is_not_enabled) {
  b.write("U1MODE", 0x8000, 0);
  for (int i = 0; i < 5; ++i) b.write("U1TXREG", static_cast<unsigned>('a' + i), 100 + 2 * i);
  ASSERT_EQ(b.notes.count(dspic::Cause::UartFull), 1);
  EXPECT_EQ(b.notes.all[0].message,
            "U1TXREG is written while four words wait in it, for U1STA.UTXEN is 0: what is written is lost");
}

TEST_F(Uart, clearing_oerr_that_is_clear_keeps_the_words) {
  open();
  arrive('q', 1001);
  b.clear("U1STA", 0x2, 3000);
  EXPECT_EQ(b.read("U1RXREG", 3001), static_cast<unsigned>('q'));
}

// parity bit even of 0x07 is 1; 11 bits a word
TEST_F(Uart, parity_is_sent_and_checked) {
  open(0x8002);  // 8 bits, even
  b.write("U1TXREG", 0x07, 100);
  b.chip.run_to(200);
  EXPECT_EQ(b.outside.sent[0].end(), 105 + 11 * 128);
  EXPECT_TRUE(b.outside.sent[0].level(105 + 9 * 128 + 64));
  UartFrame good;
  good.word = 0x07;
  good.parity = dspic::Parity::Even;
  good.start = 1001;
  b.chip.uart_receive(1, good, good.start);
  EXPECT_EQ(b.read("U1STA", 3000) & 0x9, 0x1u);
  b.read("U1RXREG", 3000);
  good.parity = dspic::Parity::Odd;
  good.start = 4001;
  b.chip.uart_receive(1, good, good.start);
  EXPECT_EQ(b.read("U1STA", 6000) & 0x9, 0x9u);
  b.read("U1RXREG", 6000);
  EXPECT_EQ(b.read("U1STA", 6001) & 0x8, 0u);  // belongs to the word
}

TEST_F(Uart, nine_bits_and_two_stop_bits) {
  open(0x8007);
  b.write("U1TXREG", 0x1A5, 100);
  b.chip.run_to(200);
  EXPECT_EQ(b.outside.sent[0].word, 0x1A5);
  EXPECT_EQ(b.outside.sent[0].end(), 105 + 12 * 128);
}

// nine bits and parity into a receiver of eight bits and two stop bits: bit 8 lies where the first stop bit
// should be, the parity bit where the second should. Word 0x100: even parity sends 1, odd 0
TEST_F(Uart, both_of_two_stop_bits_must_be_high) {
  open(0x8001);
  UartFrame f;
  f.data_bits = 9;
  f.word = 0x100;
  f.parity = dspic::Parity::Even;
  f.start = 1001;
  b.chip.uart_receive(1, f, f.start);
  EXPECT_EQ(b.read("U1STA", 3000) & 0x5, 0x1u);
  b.read("U1RXREG", 3000);
  f.parity = dspic::Parity::Odd;
  f.start = 5001;
  b.chip.uart_receive(1, f, f.start);
  EXPECT_EQ(b.read("U1STA", 8000) & 0x5, 0x5u);
}

TEST_F(Uart, address_detection_drops_data_words) {
  open(0x8006, 0x0020);  // 9 bits, ADDEN
  UartFrame f;
  f.data_bits = 9;
  f.word = 0x055;
  f.start = 1001;
  b.chip.uart_receive(1, f, f.start);
  f.word = 0x1AA;
  f.start = 3001;
  b.chip.uart_receive(1, f, f.start);
  b.chip.run_to(6000);
  EXPECT_EQ(b.read("U1RXREG", 6000), 0x1AAu);
  EXPECT_EQ(b.read("U1STA", 6001) & 1, 0u);
}

TEST_F(Uart, loop_back_returns_what_is_sent) {
  open(0x8040);
  b.write("U1TXREG", 0x3C, 100);
  EXPECT_EQ(b.flag_rises(irq::U1Rx, 101), 105 + 1216);
  EXPECT_EQ(b.read("U1RXREG", 1400), 0x3Cu);
}

TEST_F(Uart, break_is_received_as_zero_with_a_frame_error) {
  open();
  UartFrame f;
  f.broken = true;
  f.start = 1001;
  b.chip.uart_receive(1, f, f.start);
  EXPECT_EQ(b.read("U1STA", 3000) & 0x5, 0x5u);
  EXPECT_EQ(b.read("U1RXREG", 3000), 0u);
}

// the receiver has its word of zeros while the line is still low, and no second one before it was high
TEST_F(Uart, a_break_comes_back_in_loop_back) {
  open(0x8040);
  b.set("U1STA", 0x0800, 1000);
  EXPECT_EQ(b.read("U1STA", 1001 + 9 * 128) & 0x5, 0u);
  EXPECT_EQ(b.flag_rises(irq::U1Rx, 1001), 1001 + 9 * 128 + 64);
  EXPECT_EQ(b.read("U1STA", 3000) & 0xF, 0x5u);  // FERR, URXDA
  EXPECT_EQ(b.read("U1RXREG", 3001), 0u);
  b.clear("U1STA", 0x0800, 21000);
  b.write("U1TXREG", 'a', 21001);
  EXPECT_EQ(b.read("U1STA", 22000) & 0x1, 0u);
  EXPECT_EQ(b.read("U1STA", 23000) & 0xF, 0x1u);
  EXPECT_EQ(b.read("U1RXREG", 23001), unsigned{'a'});
  ASSERT_EQ(b.outside.sent.size(), 2u);
  EXPECT_TRUE(b.outside.sent[0].broken);
}

// 512 cycles are a start bit and three data bits
TEST_F(Uart, a_break_shorter_than_a_word_comes_back_as_the_word_that_it_looks_like) {
  open(0x8040);
  b.set("U1STA", 0x0800, 1000);
  b.clear("U1STA", 0x0800, 1512);
  EXPECT_EQ(b.read("U1STA", 3000) & 0xF, 0x1u);
  EXPECT_EQ(b.read("U1RXREG", 3001), 0xF8u);
  b.set("U1STA", 0x0800, 4000);  // shorter than half a bit: nothing
  b.clear("U1STA", 0x0800, 4032);
  EXPECT_EQ(b.read("U1STA", 8000) & 0x1, 0u);
}

// behind what is being sent
TEST_F(Uart, a_break_waits_for_the_word_before_it) {
  open(0x8040);
  b.write("U1TXREG", 'a', 100);
  b.set("U1STA", 0x0800, 200);
  EXPECT_EQ(b.read("U1STA", 2000) & 0xF, 0x1u);
  EXPECT_EQ(b.read("U1RXREG", 2001), unsigned{'a'});
  EXPECT_EQ(b.read("U1STA", 4000) & 0xF, 0x5u);
  b.read("U1RXREG", 4001);
  b.clear("U1STA", 0x0800, 5000);
  b.write("U1TXREG", 'b', 5001);
  b.set("U1STA", 0x0800, 5002);  // withdrawn before the word is out
  b.clear("U1STA", 0x0800, 5100);
  EXPECT_EQ(b.read("U1STA", 9000) & 0xF, 0x1u);
  EXPECT_EQ(b.read("U1RXREG", 9001), unsigned{'b'});
  EXPECT_EQ(b.read("U1STA", 9002) & 0x1, 0u);
}

TEST_F(Uart, break_is_sent_for_as_long_as_it_is_asked_for) {
  open();
  b.set("U1STA", 0x0800, 1000);
  b.clear("U1STA", 0x0800, 21000);
  ASSERT_EQ(b.outside.sent.size(), 1u);
  EXPECT_TRUE(b.outside.sent[0].broken);
  EXPECT_EQ(b.outside.sent[0].start, 1001);
  EXPECT_EQ(b.outside.sent[0].end(), 21001);
}

// half the receiver's rate: 0x55 at 57600 baud is read as bits held twice as long
TEST_F(Uart, wrong_rate_is_received_wrongly_and_named) {
  open();
  UartFrame f;
  f.word = 0x00;
  f.bit = 256;
  f.start = 1001;
  b.chip.uart_receive(1, f, f.start);
  b.chip.run_to(6000);
  EXPECT_EQ(b.notes.count(dspic::Cause::UartFrameError), 1);
  EXPECT_EQ(b.read("U1STA", 6000) & 0x4, 0x4u);
}

// 4 % fast: sampled in the middle of the receiver's bits the word is still right
TEST_F(Uart, small_rate_error_is_tolerated) {
  open();
  UartFrame f;
  f.word = 0xA5;
  f.bit = 123;
  f.start = 1001;
  b.chip.uart_receive(1, f, f.start);
  EXPECT_EQ(b.read("U1RXREG", 3000), 0xA5u);
  EXPECT_EQ(b.notes.count(dspic::Cause::UartFrameError), 0);
}

// BRG 95 gives 9600 baud exactly; 100: 9124 baud, 5 % low; 23 gives 38400; 15: 57600; 10:
// 83782, 9 % off 76800
TEST_F(Uart, rate_more_than_two_percent_off_is_named) {
  const std::pair<unsigned, int> cases[] = {{95, 0}, {100, 1}, {23, 0}, {7, 0},
                                            {3, 0},  {1, 0},   {0, 0},  {10, 1}};
  for (const auto& [brg, reports] : cases) {
    Bench fresh;
    fresh.write("U1BRG", brg, 0);
    fresh.write("U1MODE", 0x8000, 0);
    fresh.write("U1STA", 0x0400, 0);
    fresh.write("U1TXREG", 1, 1);
    fresh.chip.run_to(100);
    EXPECT_EQ(fresh.notes.count(dspic::Cause::BaudError), reports) << brg;
  }
}

TEST_F(Uart, switching_off_forgets_everything) {
  open();
  arrive('x', 1001);
  b.chip.run_to(3000);
  b.write("U1TXREG", 'y', 3000);
  b.write("U1MODE", 0, 3000);  // before it has reached the shift register
  b.write("U1MODE", 0x8000, 3100);
  EXPECT_EQ(b.read("U1STA", 3101) & 0x0FFF, 0x0110u);
  b.chip.run_to(9000);
  EXPECT_TRUE(b.outside.sent.empty());
  EXPECT_EQ(b.read("U1RXREG", 9000), 0u);
}

TEST_F(Uart, pins_belong_to_the_uart_while_it_is_on) {
  open();
  EXPECT_EQ(b.outside.driven.back().port, dspic::Port::F);
  EXPECT_EQ(b.outside.driven.back().driven, 1 << 3);
  EXPECT_EQ(b.outside.driven.back().levels, 1 << 3);  // idle line
  b.write("U1MODE", 0, 100);
  EXPECT_EQ(b.outside.driven.back().driven, 0);
}

// nothing is sent yet: U1STA keeps its reset value, as long as UTXEN is not set
TEST_F(Uart, transmitter_is_empty_from_the_cycle_in_which_it_is_switched_on) {
  b.write("U1MODE", 0x8000, 50);
  EXPECT_EQ(b.read("U1STA", 50), 0x0110);
  EXPECT_EQ(b.read("U1STA", 51), 0x0110);
}

TEST_F(Uart, wait_for_trmt_knows_when_to_look_again) {
  open();
  b.write("U1TXREG", 1, 100);
  b.chip.run_to(102);
  EXPECT_EQ(b.chip.horizon(0x20E, 102), 105 + 1280);
}

// words at 105, 1385, 2665 and 3945, the last of which leaves the FIFO empty: in between nothing comes of a
// word, and it is told when somebody looks
TEST_F(Uart, words_that_follow_are_told_when_somebody_looks) {
  open();
  b.enable(irq::U1Tx, 3);
  for (int i = 0; i < 4; ++i) b.write("U1TXREG", 'a' + i, 100);
  b.chip.run_events(101);
  EXPECT_EQ(b.outside.sent.size(), 1u);
  EXPECT_EQ(b.chip.next_event(102), 3945 + 1);
  b.chip.run_events(2000);
  EXPECT_EQ(b.outside.sent.size(), 1u);
  EXPECT_EQ(b.chip.horizon(0x20E, 2000), 2001);  // too early, never too late
  EXPECT_EQ(b.peek("U1STA", 2000) & 0x300, 0u);
  EXPECT_EQ(b.outside.sent.size(), 2u);
  EXPECT_EQ(b.chip.horizon(0x20E, 2000), 2665);
  b.chip.run_to(2665);
  EXPECT_EQ(b.outside.sent.size(), 3u);
  EXPECT_FALSE(b.flag(irq::U1Tx, 3944));
  b.chip.run_events(3945);
  EXPECT_TRUE(b.flag(irq::U1Tx, 3946));
  ASSERT_EQ(b.outside.sent.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(b.outside.sent[i].start, 105 + i * 1280);
    EXPECT_EQ(b.outside.sent[i].word, 'a' + i);
  }
}

// the FIFO is full from the fourth word that waits up to 1385, when the next one moves
TEST_F(Uart, a_full_fifo_has_room_again_when_a_word_moves_that_nobody_looked_at) {
  open();
  b.write("U1TXREG", '0', 100);
  b.chip.run_to(101);
  for (int i = 1; i < 5; ++i) b.write("U1TXREG", '0' + i, 102);
  EXPECT_EQ(b.read("U1STA", 1384) & 0x200, 0x200u);
  b.write("U1TXREG", 'x', 1384);  // lost
  b.write("U1TXREG", '5', 1385);
  b.chip.run_to(105 + 6 * 1280);
  ASSERT_EQ(b.outside.sent.size(), 6u);
  EXPECT_EQ(b.outside.sent[5].word, '5');
  EXPECT_EQ(b.outside.sent[5].start, 105 + 5 * 1280);
  EXPECT_TRUE(b.flag(irq::U1Tx, 105 + 5 * 1280 + 1));
}

// at 2000 the second of four words is on its way
TEST_F(Uart, what_changes_in_the_middle_finds_the_words_where_they_are) {
  const auto send = [](Bench& b) {
    b.write("U1BRG", 7, 0);
    b.write("U1MODE", 0x8000, 0);
    b.write("U1STA", 0x8400, 0);
    for (int i = 0; i < 4; ++i) b.write("U1TXREG", 'a' + i, 100);
    b.chip.run_events(2000);
  };
  {
    Bench b;
    send(b);
    b.write("U1MODE", 0x8040, 2000);  // LPBACK: those that begin from now on come back
    b.chip.run_to(8000);
    EXPECT_EQ(b.outside.sent.size(), 4u);
    EXPECT_EQ(b.read("U1RXREG", 8000), 'c');
    EXPECT_EQ(b.read("U1RXREG", 8000), 'd');
  }
  {
    Bench b;
    send(b);
    b.write("U1STA", 0x0400, 2000);  // UTXISEL = 0: the next move interrupts
    b.clear_flag(irq::U1Tx, 2001);
    EXPECT_EQ(b.flag_rises(irq::U1Tx, 2001), 2665);
  }
  {
    Bench b;
    send(b);
    b.write("U1BRG", 15, 2000);  // from the next word on twice as long, by a baud counter that begins at 2001
    b.chip.run_to(12000);
    ASSERT_EQ(b.outside.sent.size(), 4u);
    EXPECT_EQ(b.outside.sent[1].bit, 128);
    EXPECT_EQ(b.outside.sent[2].start, 2665);
    EXPECT_EQ(b.outside.sent[2].bit, 256);
    EXPECT_EQ(b.outside.sent[3].start, 2665 + 2560);
  }
  {
    Bench b;
    send(b);
    b.chip.reset(dspic::ResetKind::Pin, 2000);  // what has begun was told, the rest is gone
    EXPECT_EQ(b.outside.sent.size(), 2u);
    b.chip.run_to(8000);
    EXPECT_EQ(b.outside.sent.size(), 2u);
  }
  {
    Bench b;
    send(b);
    b.write("U1MODE", 0, 2000);  // UARTEN = 0
    b.chip.run_to(8000);
    EXPECT_EQ(b.outside.sent.size(), 2u);
  }
}

// whoever draws registers over time sees each word move
TEST_F(Uart, each_move_is_an_instant_for_who_looks_on) {
  struct Watch : dspic::EventWatch {
    std::vector<Cycle> instants;
    void about_to_change(Cycle at) override { instants.push_back(at); }
  } watch;
  open();
  b.chip.watch(&watch);
  for (int i = 0; i < 3; ++i) b.write("U1TXREG", 'a' + i, 100);
  watch.instants.clear();
  b.chip.run_events(8000);
  EXPECT_EQ(watch.instants, (std::vector<Cycle>{101, 1385, 2665}));
}

}  // namespace
