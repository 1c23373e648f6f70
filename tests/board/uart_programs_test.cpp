// SPDX-License-Identifier: MIT
// The ends of a serial line that programs talk to: what they do with a terminal or a socket, and come and go.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <cstdlib>

#include "hal_sim/board/uart.h"

namespace {

using board::Cycle;
using board::Uart;
using board::UartEnd;

constexpr Cycle kByte = 1280;

void say(UartEnd& end, const std::string& text) {
  const std::vector<Cycle> ends(text.size());
  end.deliver(reinterpret_cast<const std::uint8_t*>(text.data()), ends.data(), text.size());
}

/// What the robot hears, waiting for at most a second.
std::string heard(UartEnd& end, std::size_t wanted) {
  std::string text;
  for (int i = 0; i < 1000 && text.size() < wanted; ++i) {
    std::uint8_t bytes[64];
    const std::size_t count = end.collect(bytes, sizeof bytes, 0);
    text.append(reinterpret_cast<const char*>(bytes), count);
    if (count == 0) ::usleep(1000);
  }
  return text;
}

/// What a program can read now; the end is given the chance to go on writing.
std::string read_now(int fd, UartEnd* end = nullptr) {
  std::string text;
  for (int quiet = 0; quiet < 20;) {
    char bytes[1024];
    const ssize_t got = ::read(fd, bytes, sizeof bytes);
    if (got > 0) {
      text.append(bytes, static_cast<std::size_t>(got));
      quiet = 0;
    } else {
      ++quiet;
      ::usleep(500);
    }
    std::uint8_t none[1];
    if (end) end->collect(none, 0, 0);
  }
  return text;
}

struct Pty : ::testing::Test {
  void SetUp() override {
    const int probe = ::posix_openpt(O_RDWR | O_NOCTTY);
    if (probe < 0) GTEST_SKIP() << "this machine has no pseudo-terminals";
    ::close(probe);
    std::string error;
    end = board::open_uart_end("pty:" + link, "", error);
    ASSERT_TRUE(end) << error;
  }
  int open() const { return ::open(link.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK); }

  const std::string link = "/tmp/twinpuck_pty_test_" + std::to_string(::getpid());
  std::unique_ptr<UartEnd> end;
};

TEST_F(Pty, takes_baud_rates_and_raw_settings_of_any_program) {
  const int fd = open();
  ASSERT_GE(fd, 0);
  EXPECT_EQ(::isatty(fd), 1);
  for (speed_t rate : {B9600, B115200, B230400}) {
    termios settings{};
    ASSERT_EQ(::tcgetattr(fd, &settings), 0);
    settings.c_iflag = settings.c_oflag = settings.c_lflag = 0;
    settings.c_cflag = CLOCAL | CREAD | CS8;
    settings.c_cc[VMIN] = settings.c_cc[VTIME] = 0;
    ::cfsetispeed(&settings, rate);
    ::cfsetospeed(&settings, rate);
    EXPECT_EQ(::tcsetattr(fd, TCSAFLUSH, &settings), 0);
    EXPECT_EQ(::tcflush(fd, TCIOFLUSH), 0);
  }
  ASSERT_EQ(::write(fd, "V\r", 2), 2);
  EXPECT_EQ(heard(*end, 2), "V\r");
  say(*end, "v\r\n");
  EXPECT_EQ(read_now(fd), "v\r\n");
  ::close(fd);
}

TEST_F(Pty, a_program_that_reads_slowly_loses_nothing) {
  const int fd = open();
  std::string sent;
  for (int i = 0; i < 100000; ++i) sent += static_cast<char>(i * 7);
  for (std::size_t at = 0; at < sent.size(); at += 100) say(*end, sent.substr(at, 100));
  EXPECT_EQ(read_now(fd, end.get()), sent);
  ::close(fd);
}

// an echoing terminal would send the robot its own replies
TEST_F(Pty, is_raw_again_when_a_program_has_left_it_otherwise) {
  int fd = open();
  termios settings{};
  ASSERT_EQ(::tcgetattr(fd, &settings), 0);
  settings.c_lflag |= ECHO | ICANON;
  settings.c_iflag |= ICRNL;
  ASSERT_EQ(::tcsetattr(fd, TCSANOW, &settings), 0);
  ASSERT_EQ(::ioctl(fd, TIOCEXCL), 0);
  ::close(fd);
  say(*end, "d\r\n");
  EXPECT_EQ(heard(*end, 1), "");
  fd = open();
  ASSERT_GE(fd, 0) << "claimed by a program that has left";
  EXPECT_EQ(read_now(fd), "");
  say(*end, "d\r\n");
  EXPECT_EQ(read_now(fd), "d\r\n");
  ASSERT_EQ(::write(fd, "V\r", 2), 2);
  EXPECT_EQ(heard(*end, 2), "V\r");
  ::close(fd);
}

TEST_F(Pty, who_opens_it_finds_no_old_words) {
  say(*end, "welcome\r\n");
  int fd = open();
  EXPECT_EQ(read_now(fd), "");
  say(*end, "hello\r\n");
  EXPECT_EQ(read_now(fd), "hello\r\n");
  // nor what the one before left unread, or was told when it had gone
  say(*end, "unread");
  ::close(fd);
  say(*end, "unheard");
  fd = open();
  EXPECT_EQ(read_now(fd), "");
  // a second program beside it changes nothing for the first
  say(*end, "both");
  const int second = open();
  ::close(second);
  EXPECT_EQ(heard(*end, 1), "");
  EXPECT_EQ(read_now(fd), "both");
  ::close(fd);
}

TEST_F(Pty, who_speaks_first_gets_the_answer_and_not_the_old_words) {
  say(*end, "welcome\r\n");
  const int fd = open();
  ASSERT_EQ(::write(fd, "C\r", 2), 2);
  EXPECT_EQ(heard(*end, 2), "C\r");
  say(*end, "c,3\r\n");
  EXPECT_EQ(read_now(fd), "c,3\r\n");
  // but what was said while the program was there stays
  say(*end, "more");
  ASSERT_EQ(::write(fd, "C\r", 2), 2);
  EXPECT_EQ(heard(*end, 2), "C\r");
  EXPECT_EQ(read_now(fd), "more");
  ::close(fd);
}

// many programs flush before each command: what came a moment before is heard all the same
TEST_F(Pty, flushing_does_not_take_back_what_was_said) {
  const int fd = open();
  for (int i = 0; i < 20; ++i) {
    ::tcflush(fd, TCIOFLUSH);
    ASSERT_EQ(::write(fd, "S\r", 2), 2);
    ::usleep(20000);  // the robot has not looked yet
  }
  ::tcflush(fd, TCIOFLUSH);
  ::close(fd);
  EXPECT_EQ(heard(*end, 40).size(), 40u);
}

TEST_F(Pty, programs_come_and_go) {
  for (int i = 0; i < 3; ++i) {
    const int fd = open();
    ASSERT_EQ(::write(fd, "E\r", 2), 2);
    ::close(fd);  // at once: what it said is heard all the same
    EXPECT_EQ(heard(*end, 2), "E\r");
    say(*end, "e,0,0\r\n");
  }
}

// --- TCP

struct Tcp : ::testing::Test {
  void SetUp() override {
    std::string error;
    end = board::open_uart_end("tcp:0", "", error);
    ASSERT_TRUE(end) << error;
    port = std::atoi(end->name().substr(end->name().rfind(':') + 1).c_str());
  }
  int connect() const {
    const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ::fcntl(fd, F_SETFL, O_NONBLOCK);
    return fd;
  }
  std::unique_ptr<UartEnd> end;
  int port = 0;
};

TEST_F(Tcp, a_program_that_has_said_its_last_word_still_gets_the_reply) {
  const int fd = connect();
  ASSERT_EQ(::send(fd, "V\r", 2, 0), 2);
  ::shutdown(fd, SHUT_WR);
  EXPECT_EQ(heard(*end, 2), "V\r");
  EXPECT_EQ(heard(*end, 1), "");
  say(*end, "v\r\n");
  EXPECT_EQ(read_now(fd), "v\r\n");
  ::close(fd);
}

TEST_F(Tcp, the_next_program_is_served_when_the_first_has_left) {
  const int first = connect();
  ASSERT_EQ(::send(first, "1", 1, 0), 1);
  EXPECT_EQ(heard(*end, 1), "1");
  const int second = connect();
  ASSERT_EQ(::send(second, "2", 1, 0), 1);
  ::close(first);
  EXPECT_EQ(heard(*end, 1), "2");
  say(*end, "ok");
  EXPECT_EQ(read_now(second), "ok");
  ::close(second);
}

TEST_F(Tcp, a_program_that_reads_slowly_loses_nothing) {
  const int fd = connect();
  EXPECT_EQ(heard(*end, 1), "");  // accepted
  const std::string sent(900000, 'x');
  for (std::size_t at = 0; at < sent.size(); at += 1000) say(*end, sent.substr(at, 1000));
  EXPECT_EQ(read_now(fd, end.get()).size(), sent.size());
  ::close(fd);
}

// --- packets

class PacketEnd : public UartEnd {
 public:
  void deliver(const std::uint8_t*, const Cycle*, std::size_t count) override { packets.push_back(count); }
  std::size_t collect(std::uint8_t*, std::size_t, Cycle) override { return 0; }
  bool takes_packets() const override { return true; }
  std::string name() const override { return "packets"; }
  std::vector<std::size_t> packets;
};

// a byte takes 1280 cycles, a tick 28,800: a text of 100 bytes spans five ticks and arrives as one packet
TEST(UartPackets, bytes_without_a_pause_arrive_together) {
  Uart uart;
  auto own = std::make_unique<PacketEnd>();
  PacketEnd* end = own.get();
  uart.connect(std::move(own));
  for (int i = 0; i < 100; ++i) uart.put_on_wire('x', i * kByte, (i + 1) * kByte);
  for (Cycle tick = 28800; tick <= 6 * 28800; tick += 28800) uart.exchange(tick);
  EXPECT_EQ(end->packets, std::vector<std::size_t>{100});
}

// 20 ms are 294,912 cycles: 230 bytes; a packet waits no longer than that
TEST(UartPackets, a_long_stream_arrives_in_pieces) {
  Uart uart;
  auto own = std::make_unique<PacketEnd>();
  PacketEnd* end = own.get();
  uart.connect(std::move(own));
  Cycle at = 0;
  std::size_t total = 0;
  for (int i = 0; i < 1000; ++i) {
    uart.put_on_wire('x', at, at + kByte);
    if (i % 20 == 19) uart.exchange(at);
    at += kByte;
  }
  uart.exchange(at + 10 * kByte);
  for (std::size_t packet : end->packets) {
    EXPECT_LE(packet, 230u + 21);
    total += packet;
  }
  EXPECT_EQ(total, 1000u);
  EXPECT_GE(end->packets.size(), 4u);
}

}  // namespace
