// SPDX-License-Identifier: MIT
// A TCP server as the far end of a robot's serial line. One program at a time; the next one waits. Bytes that
// the robot sends while nobody is connected are lost. A program that has said its last word (half-closed)
// still gets the replies until another one comes.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

#include "hal_sim/board/uart_programs.h"

namespace board {

namespace {

class TcpEnd : public UartEnd {
 public:
  bool open(int port, std::string& error) {
    const std::string where = "tcp:127.0.0.1:" + std::to_string(port);
    server_.reset(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (!server_.valid()) {
      error = where + ": no socket: " + system_error();
      return false;
    }
    const int yes = 1;
    ::setsockopt(server_.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::bind(server_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
        ::listen(server_.get(), 1) != 0) {
      error = errno == EADDRINUSE ? where + ": got a port that is in use, expected a free one; 0 takes any"
                                  : where + ": cannot listen: " + system_error();
      return false;
    }
    socklen_t length = sizeof address;
    ::getsockname(server_.get(), reinterpret_cast<sockaddr*>(&address), &length);
    port_ = ntohs(address.sin_port);
    return true;
  }

  void deliver(const std::uint8_t* bytes, const Cycle*, std::size_t count) override {
    accept_program();
    if (!program_.valid()) return;
    waiting_.append(reinterpret_cast<const char*>(bytes), std::min(count, kMostWaiting - waiting_.size()));
    send_waiting();
  }

  std::size_t collect(std::uint8_t* bytes, std::size_t room, Cycle) override {
    accept_program();
    if (!program_.valid()) return 0;
    if (!waiting_.empty()) send_waiting();
    if (!program_.valid() || has_finished_) return 0;
    const ssize_t got = ::recv(program_.get(), bytes, room, 0);
    if (got > 0) return static_cast<std::size_t>(got);
    if (got == 0) has_finished_ = true;
    if (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK) leave();
    return 0;
  }

  bool takes_packets() const override { return true; }

  std::string name() const override { return "tcp:127.0.0.1:" + std::to_string(port_); }

 private:
  void leave() {
    program_.reset();
    waiting_.clear();
  }

  void accept_program() {
    if (program_.valid() && !has_finished_) return;
    const int next = ::accept4(server_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (next < 0) return;
    leave();
    program_.reset(next);
    has_finished_ = false;
    const int yes = 1;  // replies are short and awaited
    ::setsockopt(next, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  }

  void send_waiting() {
    while (!waiting_.empty()) {
      const ssize_t done = ::send(program_.get(), waiting_.data(), waiting_.size(), MSG_NOSIGNAL);
      if (done > 0) {
        waiting_.erase(0, static_cast<std::size_t>(done));
        continue;
      }
      if (errno != EAGAIN && errno != EWOULDBLOCK) leave();
      return;
    }
  }

  Descriptor server_, program_;
  std::string waiting_;  // delivered, not yet taken by the kernel
  bool has_finished_ = false;
  int port_ = 0;
};

}  // namespace

std::unique_ptr<UartEnd> open_tcp_end(int port, std::string& error) {
  auto end = std::make_unique<TcpEnd>();
  if (end->open(port, error)) return end;
  return nullptr;
}

}  // namespace board
