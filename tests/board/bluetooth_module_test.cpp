// SPDX-License-Identifier: MIT
// The Bluetooth module between a UART and a computer: transparent from the beginning, out of it by a break,
// packets byte for byte, drop-outs. Packets are written out by hand from the framing.
#include "hal_sim/board/bluetooth_module.h"

#include <gtest/gtest.h>

#include <deque>

#include "hal_sim/board/uart.h"
#include "tests/support/memory_end.h"

namespace {

using board::BluetoothModule;
using board::BluetoothSetup;
using board::Cycle;
using firmware_test::MemoryEnd;

constexpr Cycle kMs = 14746;

std::string operator""_b(const char* s, std::size_t n) { return std::string(s, n); }

struct Wired {
  board::RobotClock clock;
  board::Uart uart;
  std::deque<std::pair<Cycle, char>> coming;  // to the robot, and when each has come
  MemoryEnd* computer = nullptr;
  std::shared_ptr<BluetoothModule> module;
  Cycle at = 0, said_until = 0;

  explicit Wired(bool with_computer, const BluetoothSetup& setup = {}) {
    std::unique_ptr<MemoryEnd> end;
    if (with_computer) {
      end = std::make_unique<MemoryEnd>();
      computer = end.get();
    }
    module = std::make_shared<BluetoothModule>(setup, clock, 0, std::move(end));
    uart.connect(module);
    uart.follow_chip(true, 7);
  }
  void say(const std::string& bytes) {
    for (char c : bytes) {
      at = std::max(at, said_until);
      said_until = at + uart.byte_cycles();
      uart.put_on_wire(static_cast<std::uint8_t>(c), at, said_until);
    }
  }
  void run_ms(int ms) {
    for (int i = 0; i < ms; ++i) {
      uart.exchange(at += kMs);
      std::uint8_t byte = 0;
      for (Cycle start = 0; uart.take_from_wire(byte, start);)
        coming.emplace_back(start + uart.byte_cycles(), static_cast<char>(byte));
    }
  }
  /// What has come since this was asked last.
  std::string heard() {
    std::string bytes;
    for (; !coming.empty() && coming.front().first <= at; coming.pop_front()) bytes += coming.front().second;
    return bytes;
  }
};

TEST(BluetoothModule, with_a_computer_it_is_a_plain_line) {
  Wired w(true);
  w.say("\x02R\x03\0\0U\x03hello"_b);
  w.computer->inject("back", 0);
  w.run_ms(5);
  EXPECT_EQ(w.computer->text(), "\x02R\x03\0\0U\x03hello"_b);
  EXPECT_EQ(w.heard(), "back");
  EXPECT_FALSE(w.module->is_idle());
}

TEST(BluetoothModule, answers_a_command_byte_for_byte) {
  BluetoothSetup setup;
  setup.number = 42;
  Wired w(false, setup);
  EXPECT_TRUE(w.module->is_idle());
  w.say("\x02R\x03\0\0U\x03"_b);  // read local name: 0x52 + 0x03 = 0x55 'U'
  w.run_ms(8);
  // confirm 0x43, opcode 3, 14 bytes: 0x43 + 3 + 14 = 0x54; status, 12 with the end of the text, the text
  EXPECT_EQ(w.heard(),
            "\x02\x43\x03\x0E\0\x54\0\x0C"
            "e-puck_0042\0\x03"_b);
  EXPECT_TRUE(w.module->is_idle());
}

TEST(BluetoothModule, noise_and_broken_packets_are_left_alone) {
  Wired w(false);
  w.say("noise\x02R\x03\0\0V\x03"_b);  // wrong check
  w.say(
      "\x02"
      "C\x03\0\0\x46\x03"_b);        // not a request
  w.say("\x02R\x03\0\0U\x04"_b);     // wrong end
  w.say("\x02R\x03\x34\x12\x9B"_b);  // 4660 bytes: too long
  w.run_ms(20);
  EXPECT_EQ(w.heard(), "");
  w.say("\x02R\x4F\0\0\xA1\x03"_b);  // get event filter
  w.run_ms(8);
  EXPECT_EQ(w.heard(), "\x02\x43\x4F\x01\0\x93\x01\x03"_b);
}

TEST(BluetoothModule, a_break_leaves_transparent_mode_and_the_computer_stays) {
  Wired w(true);
  w.say("a");
  w.run_ms(2);
  w.uart.break_on_wire(w.at + 2 * kMs);
  w.run_ms(3);
  EXPECT_EQ(w.computer->text().substr(0, 1), "a");
  w.say("\x02R\x4F\0\0\xA1\x03"_b);
  w.computer->inject("hi", 0);
  w.run_ms(10);
  const std::string heard = w.heard();
  EXPECT_NE(heard.find("\x02\x43\x4F\x01\0\x93\x01\x03"_b), std::string::npos);
  // incoming data: indication 0x69, opcode 0x10, 5 bytes: 0x7E; port 1, length 2
  EXPECT_NE(heard.find("\x02\x69\x10\x05\0\x7E\x01\x02\0hi\x03"_b), std::string::npos);
  w.say("\x02R\x11\x01\0\x64\x01\x03"_b);  // transparent again
  w.run_ms(8);
  EXPECT_EQ(w.heard(), "\x02\x43\x11\x02\0\x56\0\x01\x03"_b);
  w.say("through");
  w.run_ms(5);
  EXPECT_EQ(w.computer->text().substr(w.computer->text().size() - 7), "through");
}

TEST(BluetoothModule, the_computers_link_waits_is_lost_and_comes_back) {
  BluetoothSetup setup;
  setup.timeout_s = 0.050;
  Wired w(true, setup);
  w.module->blocked = true;
  w.say("late");
  w.computer->inject("too", 0);
  w.run_ms(20);
  EXPECT_EQ(w.computer->text(), "");
  EXPECT_EQ(w.heard(), "");
  w.module->blocked = false;  // sooner than the time-out: nothing is lost
  w.run_ms(5);
  EXPECT_EQ(w.computer->text(), "late");
  EXPECT_EQ(w.heard(), "too");
  w.module->blocked = true;
  w.say("gone");
  w.run_ms(70);
  EXPECT_FALSE(w.module->is_linked());
  EXPECT_EQ(w.heard(), "\x02\x69\x0E\x02\0\x79\x02\x01\x03"_b);  // link released, lost, port 1
  w.module->blocked = false;
  w.run_ms(5);
  EXPECT_TRUE(w.module->is_transparent());
  w.say("again");
  w.run_ms(5);
  EXPECT_EQ(w.computer->text(), "lateagain");
}

}  // namespace
