// SPDX-License-Identifier: MIT
#include "hal_sim/drivers/uart_ring.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/support/memory_end.h"

namespace {

using board::Cycle;

constexpr Cycle kByte = 1280;  // 10 bits of 128 cycles at 115,200 baud

struct Wired {
  board::Uart uart;
  drivers::UartRing ring{uart};
  firmware_test::MemoryEnd* end = new firmware_test::MemoryEnd;
  Wired() { uart.connect(std::unique_ptr<firmware_test::MemoryEnd>(end)); }
};

TEST(UartRing, counts_what_has_come_and_was_not_taken) {
  Wired w;
  w.ring.init(7, 0);
  w.end->inject("abc", 0);
  w.uart.exchange(0);
  EXPECT_EQ(w.ring.unread(kByte - 1), 0);
  EXPECT_EQ(w.ring.unread(kByte), 1);
  EXPECT_EQ(w.ring.take(kByte), 'a');
  EXPECT_EQ(w.ring.take(kByte), -1);
  EXPECT_EQ(w.ring.unread(3 * kByte), 2);
}

// 70 bytes into 64 places: the count says 70, the first six places hold the newest bytes
TEST(UartRing, overwrites_silently) {
  Wired w;
  w.ring.init(7, 0);
  std::string bytes;
  for (int i = 0; i < 70; ++i) bytes += static_cast<char>(i);
  w.end->inject(bytes, 0);
  for (Cycle at = 0; at <= 80 * kByte; at += 10 * kByte) w.uart.exchange(at);
  const Cycle late = 100 * kByte;
  EXPECT_EQ(w.ring.unread(late), 70);
  for (int i = 0; i < 70; ++i) EXPECT_EQ(w.ring.take(late), i < 6 ? i + 64 : i);
  EXPECT_EQ(w.ring.take(late), -1);
}

TEST(UartRing, takes_nothing_before_it_is_set_up_and_begins_empty) {
  Wired w;
  w.uart.switch_on(7, 0);  // by somebody else
  w.end->inject("a", 0);
  w.uart.exchange(0);
  EXPECT_EQ(w.ring.unread(kByte), 0);
  w.ring.init(7, 2 * kByte);
  w.end->inject("bc", 2 * kByte);
  w.uart.exchange(2 * kByte);
  EXPECT_EQ(w.ring.unread(4 * kByte), 2);
  w.ring.init(7, 5 * kByte);
  EXPECT_EQ(w.ring.take(5 * kByte), -1);
}

}  // namespace
