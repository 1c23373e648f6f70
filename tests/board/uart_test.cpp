// SPDX-License-Identifier: MIT
// UART timing, and the ends outside.
#include "hal_sim/board/uart.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

#include "tests/support/memory_end.h"
#include "tests/support/wording.h"

namespace {

using board::Cycle;
using board::Uart;
using firmware_test::MemoryEnd;

constexpr Cycle kByte = 1280;  // 10 bits of 128 cycles at 115,200 baud

/// What the chip takes from the wire now. `starts` gets when each byte begins.
std::string taken(Uart& uart, std::vector<Cycle>* starts = nullptr) {
  std::string text;
  std::uint8_t byte = 0;
  for (Cycle start = 0; uart.take_from_wire(byte, start);) {
    text += static_cast<char>(byte);
    if (starts) starts->push_back(start);
  }
  return text;
}

struct Wired {
  Uart uart;
  MemoryEnd* end;
  Wired() : end(new MemoryEnd) { uart.connect(std::unique_ptr<MemoryEnd>(end)); }
};

TEST(Uart, a_byte_takes_ten_bits_at_115200_baud) {
  Wired w;
  w.uart.follow_chip(true, 7);
  EXPECT_EQ(w.uart.byte_cycles(), kByte);
  EXPECT_NEAR(14'745'600.0 / static_cast<double>(w.uart.byte_cycles()), 11520, 1e-9);  // bytes/s
  w.uart.put_on_wire('a', 100, 100 + kByte);
  w.uart.exchange(100 + kByte - 1);
  EXPECT_EQ(w.end->text(), "");
  w.uart.exchange(100 + kByte);
  EXPECT_EQ(w.end->text(), "a");
  EXPECT_EQ(w.end->ended_at(0), 100 + kByte);
}

TEST(Uart, disabled_lets_the_outside_wait) {
  Wired w;
  w.end->inject("hi", 0);
  w.uart.exchange(0);
  EXPECT_EQ(w.uart.next_arrival(0), board::kNever);
  w.uart.follow_chip(true, 7);
  w.uart.exchange(11 * kByte);
  std::vector<Cycle> starts;
  EXPECT_EQ(taken(w.uart, &starts), "hi");
  EXPECT_EQ(starts, (std::vector<Cycle>{11 * kByte, 12 * kByte}));
  EXPECT_EQ(w.uart.came(), 2);
}

TEST(Uart, bytes_that_nobody_takes_are_lost) {
  Wired w;
  w.uart.follow_chip(true, 7);
  w.end->inject("lost", 0);
  w.uart.exchange(0);
  EXPECT_TRUE(w.uart.has_on_wire());
  EXPECT_EQ(w.uart.next_arrival(2 * kByte), 3 * kByte);
  EXPECT_EQ(taken(w.uart), "st");
  w.end->inject("lost", 10 * kByte);
  w.uart.exchange(10 * kByte);
  EXPECT_EQ(w.uart.next_arrival(20 * kByte), board::kNever);
  EXPECT_EQ(taken(w.uart), "");
}

TEST(Uart, bytes_arrive_one_after_another) {
  Wired w;
  w.uart.follow_chip(true, 7);
  w.end->inject("abc", 28800);
  w.uart.exchange(28799);
  EXPECT_EQ(w.uart.next_arrival(28799), board::kNever);
  w.uart.exchange(28800);
  EXPECT_EQ(w.uart.next_arrival(28800), 28800 + kByte);
  std::vector<Cycle> starts;
  EXPECT_EQ(taken(w.uart, &starts), "abc");
  EXPECT_EQ(starts, (std::vector<Cycle>{28800, 28800 + kByte, 28800 + 2 * kByte}));
}

TEST(Uart, other_rates) {
  Uart uart;
  uart.follow_chip(true, 0);
  EXPECT_EQ(uart.byte_cycles(), 160);  // 921,600 baud
  uart.follow_chip(true, 3);
  EXPECT_EQ(uart.byte_cycles(), 640);
}

TEST(Uart, a_reset_cuts_off_what_has_not_left) {
  Wired w;
  w.uart.follow_chip(true, 7);
  Cycle at = 0;
  for (char c : {'a', 'b', 'c'})
    w.uart.put_on_wire(static_cast<std::uint8_t>(c), at, at + kByte), at += kByte;
  w.uart.reset(kByte + 10);
  w.uart.exchange(10 * kByte);
  EXPECT_EQ(w.end->text(), "a");
  // and it is off
  w.end->inject("x", 10 * kByte);
  w.uart.exchange(11 * kByte);
  EXPECT_FALSE(w.uart.has_on_wire());
}

// --- ends

TEST(UartEnd, pty_carries_bytes_both_ways_under_a_stable_name) {
  // a bare chroot may come without /dev/pts; then there is nothing to test
  const int probe = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (probe < 0) GTEST_SKIP() << "this machine has no pseudo-terminals";
  ::close(probe);
  const std::string link = "/tmp/twinpuck_uart_test_" + std::to_string(::getpid());
  std::string error;
  auto end = board::open_uart_end("pty", link, error);
  ASSERT_TRUE(end) << error;
  EXPECT_EQ(end->name(), link);
  const int fd = ::open(link.c_str(), O_RDWR | O_NOCTTY);
  ASSERT_GE(fd, 0);
  const std::uint8_t out[] = {'h', 'i', 0, 255, '\n', 13};
  const Cycle ends[6] = {};
  end->deliver(out, ends, 6);
  std::uint8_t got[8] = {};
  EXPECT_EQ(::read(fd, got, 8), 6);
  EXPECT_EQ(std::memcmp(got, out, 6), 0);
  EXPECT_EQ(::write(fd, "ok\r", 3), 3);
  // the kernel hands bytes over in its own time
  std::uint8_t in[8] = {};
  std::size_t count = 0;
  for (int i = 0; i < 2000 && count < 3; ++i) {
    count += end->collect(in + count, 8 - count, 0);
    if (count < 3) ::usleep(1000);
  }
  EXPECT_EQ(count, 3u);
  EXPECT_EQ(in[2], '\r');
  EXPECT_EQ(end->collect(in, 8, 0), 0u);
  ::close(fd);
  end.reset();
  EXPECT_NE(::access(link.c_str(), F_OK), 0);  // the link goes with the end
}

TEST(UartEnd, a_pty_link_never_takes_the_place_of_what_is_not_its_own) {
  const std::string link = "/tmp/twinpuck_pty_own_" + std::to_string(getpid());
  const auto target = [&] {
    char text[256];
    const ssize_t got = readlink(link.c_str(), text, sizeof text);
    return got > 0 ? std::string(text, static_cast<std::size_t>(got)) : std::string();
  };
  std::string error;
  // a link of the user's own, to a file
  ASSERT_EQ(symlink("/etc/hostname", link.c_str()), 0);
  EXPECT_FALSE(board::open_uart_end("pty", link, error));
  EXPECT_EQ(error, "pty: link " + link + ": File exists");
  EXPECT_EQ(target(), "/etc/hostname");
  // one that a run left behind is replaced
  unlink(link.c_str());
  ASSERT_EQ(symlink("/dev/pts/99999", link.c_str()), 0);
  auto first = board::open_uart_end("pty", link, error);
  ASSERT_TRUE(first) << error;
  const std::string ours = target();
  // two runs in one folder: the second is told, and the first keeps its link
  EXPECT_FALSE(board::open_uart_end("pty", link, error));
  EXPECT_EQ(error, "pty: link " + link +
                       ": got the link of a run that goes on, expected a name of its own, by pty:LINK");
  EXPECT_EQ(target(), ours);
  // what somebody else put there meanwhile stays
  unlink(link.c_str());
  ASSERT_EQ(symlink("/etc/hostname", link.c_str()), 0);
  first.reset();
  EXPECT_EQ(target(), "/etc/hostname");
  unlink(link.c_str());
  // the name is free again
  first = board::open_uart_end("pty", link, error);
  EXPECT_TRUE(first) << error;
  first.reset();
  EXPECT_EQ(target(), "");
}

TEST(UartEnd, a_file_on_a_full_disk_says_so) {
  std::string error;
  auto end = board::open_uart_end("file:/dev/full", "", error);
  ASSERT_TRUE(end) << error;
  EXPECT_EQ(end->error(), "");
  const std::uint8_t bytes[] = {1, 2};
  const Cycle ends[] = {1, 2};
  end->deliver(bytes, ends, 2);
  EXPECT_EQ(end->error(), "file:/dev/full: cannot be written: No space left on device");
}

// another address of this PC: a server for all interfaces would answer there
TEST(UartEnd, tcp_answers_at_127_0_0_1_alone) {
  std::string error;
  auto end = board::open_uart_end("tcp:0", "", error);
  ASSERT_TRUE(end) << error;
  const std::string name = end->name();
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(std::atoi(name.substr(name.rfind(':') + 1).c_str())));
  for (const std::uint32_t host : {INADDR_LOOPBACK + 1, INADDR_LOOPBACK}) {
    const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
    address.sin_addr.s_addr = htonl(host);
    EXPECT_EQ(::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0,
              host == INADDR_LOOPBACK);
    ::close(fd);
  }
}

TEST(UartEnd, tcp_listens_on_loopback_and_says_when_the_port_is_taken) {
  std::string error;
  auto end = board::open_uart_end("tcp:0", "", error);
  ASSERT_TRUE(end) << error;
  const std::string name = end->name();
  const int port = std::atoi(name.substr(name.rfind(':') + 1).c_str());
  EXPECT_GT(port, 0);
  auto second = board::open_uart_end("tcp:" + std::to_string(port), "", error);
  EXPECT_FALSE(second);
  EXPECT_TRUE(
      wording::reads(error, "tcp:127.0.0.1:…: got a port that is in use, expected a free one; 0 takes any"));

  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  const std::uint8_t out[] = {'x'};
  const Cycle ends[1] = {};
  end->deliver(out, ends, 1);
  char got = 0;
  EXPECT_EQ(::recv(fd, &got, 1, 0), 1);
  EXPECT_EQ(got, 'x');
  ASSERT_EQ(::send(fd, "in", 2, 0), 2);
  std::uint8_t in[4];
  std::size_t count = 0;
  for (int i = 0; i < 1000 && count == 0; ++i) {
    count = end->collect(in, 4, 0);
    ::usleep(1000);
  }
  EXPECT_EQ(count, 2u);
  ::close(fd);
}

TEST(UartEnd, file_takes_the_output_and_gives_the_input) {
  const std::string base = "/tmp/twinpuck_uart_test_" + std::to_string(::getpid());
  std::ofstream(base + ".in") << "go";
  std::string error;
  {
    Uart uart;
    auto end = board::open_uart_end("file:" + base + ".out," + base + ".in", "", error);
    ASSERT_TRUE(end) << error;
    uart.connect(std::move(end));
    uart.follow_chip(true, 7);
    uart.put_on_wire('!', 0, kByte);
    uart.exchange(2 * kByte);
    EXPECT_EQ(taken(uart), "go");
  }
  std::stringstream text;
  text << std::ifstream(base + ".out").rdbuf();
  EXPECT_EQ(text.str(), "!");
  std::remove((base + ".out").c_str());
  std::remove((base + ".in").c_str());
}

TEST(UartEnd, nonsense_is_refused_in_one_line) {
  for (const char* bad :
       {"tcp:", "tcp:70000", "tcp:abc", "usb", "file:", "file:/nonexistent/dir/x", "", "none:1"}) {
    std::string error;
    EXPECT_FALSE(board::open_uart_end(bad, "", error)) << bad;
    EXPECT_FALSE(error.empty()) << bad;
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
  std::string error;
  EXPECT_FALSE(board::open_uart_end("none", "", error));
  EXPECT_TRUE(error.empty());
}

}  // namespace
