// SPDX-License-Identifier: MIT
// See uart_end.h. Descriptors are non-blocking; a reader that is slower than the robot loses bytes, never
// time.
#include "hal_sim/board/uart_end.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace board {

void MemoryEnd::deliver(const std::uint8_t* bytes, const Cycle* ends, std::size_t count) {
  text_.append(reinterpret_cast<const char*>(bytes), count);
  ends_.insert(ends_.end(), ends, ends + count);
}

std::size_t MemoryEnd::collect(std::uint8_t* bytes, std::size_t room, Cycle at) {
  std::size_t count = 0;
  while (count < room && !waiting_.empty() && waiting_.front().at <= at) {
    bytes[count++] = waiting_.front().byte;
    waiting_.pop_front();
  }
  return count;
}

void MemoryEnd::inject(const std::string& bytes, Cycle at) {
  for (char c : bytes) waiting_.push_back({static_cast<std::uint8_t>(c), at});
}

namespace {

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  void reset(int fd = -1) {
    if (fd_ >= 0) ::close(fd_);
    fd_ = fd;
  }
  int get() const { return fd_; }
  bool valid() const { return fd_ >= 0; }

 private:
  int fd_;
};

std::string why() { return std::strerror(errno); }

class PtyEnd : public UartEnd {
 public:
  ~PtyEnd() override {
    if (!link_.empty()) ::unlink(link_.c_str());
  }

  bool open(const std::string& link, std::string& error) {
    master_.reset(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!master_.valid() || ::grantpt(master_.get()) != 0 || ::unlockpt(master_.get()) != 0) {
      error = "pty: cannot be opened: " + why();
      return false;
    }
    char path[128];
    if (::ptsname_r(master_.get(), path, sizeof path) != 0) {
      error = "pty: has no name: " + why();
      return false;
    }
    path_ = path;
    // holding the other side open keeps its raw mode, and bytes sent before anybody listens
    slave_.reset(::open(path, O_RDWR | O_NOCTTY | O_CLOEXEC));
    termios settings{};
    if (slave_.valid() && ::tcgetattr(slave_.get(), &settings) == 0) {
      ::cfmakeraw(&settings);
      ::tcsetattr(slave_.get(), TCSANOW, &settings);
    }
    if (link.empty()) return true;
    // a link left by an earlier run is replaced; anything else is not ours
    char old[256];
    if (::readlink(link.c_str(), old, sizeof old) >= 0) ::unlink(link.c_str());
    if (::symlink(path, link.c_str()) != 0) {
      error = "pty: link " + link + ": " + why();
      return false;
    }
    link_ = link;
    return true;
  }

  void deliver(const std::uint8_t* bytes, const Cycle*, std::size_t count) override {
    // a full terminal drops the rest
    if (::write(master_.get(), bytes, count) < 0) return;
  }
  std::size_t collect(std::uint8_t* bytes, std::size_t room, Cycle) override {
    const ssize_t got = ::read(master_.get(), bytes, room);
    return got > 0 ? static_cast<std::size_t>(got) : 0;
  }
  std::string name() const override { return link_.empty() ? path_ : link_; }

 private:
  Descriptor master_, slave_;
  std::string path_, link_;
};

class TcpEnd : public UartEnd {
 public:
  bool open(int port, std::string& error) {
    const std::string where = "tcp:127.0.0.1:" + std::to_string(port);
    server_.reset(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (!server_.valid()) {
      error = where + ": no socket: " + why();
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
      error = errno == EADDRINUSE ? where + ": port is in use; choose another, or 0 for any free port"
                                  : where + ": cannot listen: " + why();
      return false;
    }
    socklen_t length = sizeof address;
    ::getsockname(server_.get(), reinterpret_cast<sockaddr*>(&address), &length);
    port_ = ntohs(address.sin_port);
    return true;
  }

  void deliver(const std::uint8_t* bytes, const Cycle*, std::size_t count) override {
    accept_client();
    if (!client_.valid()) return;
    while (count > 0) {
      const ssize_t done = ::send(client_.get(), bytes, count, MSG_NOSIGNAL);
      if (done <= 0) {
        if (errno != EAGAIN && errno != EWOULDBLOCK) client_.reset();
        return;
      }
      bytes += done;
      count -= static_cast<std::size_t>(done);
    }
  }
  std::size_t collect(std::uint8_t* bytes, std::size_t room, Cycle) override {
    accept_client();
    if (!client_.valid()) return 0;
    const ssize_t got = ::recv(client_.get(), bytes, room, 0);
    if (got == 0) client_.reset();
    return got > 0 ? static_cast<std::size_t>(got) : 0;
  }
  std::string name() const override { return "tcp:127.0.0.1:" + std::to_string(port_); }

 private:
  void accept_client() {
    if (client_.valid()) return;
    client_.reset(::accept4(server_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  }
  Descriptor server_, client_;
  int port_ = 0;
};

class FileEnd : public UartEnd {
 public:
  ~FileEnd() override {
    if (out_) std::fclose(out_);
    if (in_) std::fclose(in_);
  }
  bool open(const std::string& out, const std::string& in, std::string& error) {
    path_ = out;
    if (!in.empty() && !(in_ = std::fopen(in.c_str(), "rb"))) {
      error = "file:" + in + ": cannot be read: " + why();
      return false;
    }
    if (!(out_ = std::fopen(out.c_str(), "wb"))) {
      error = "file:" + out + ": cannot be written: " + why();
      return false;
    }
    return true;
  }
  void deliver(const std::uint8_t* bytes, const Cycle*, std::size_t count) override {
    if (failed_) return;
    if (std::fwrite(bytes, 1, count, out_) == count && std::fflush(out_) == 0) return;
    failed_ = true;  // said once; the robot goes on
    std::fprintf(stderr, "file:%s: cannot be written: %s; further bytes are lost\n", path_.c_str(),
                 why().c_str());
  }
  std::size_t collect(std::uint8_t* bytes, std::size_t room, Cycle) override {
    return in_ ? std::fread(bytes, 1, room, in_) : 0;
  }
  std::string name() const override { return "file:" + path_; }

 private:
  std::FILE* out_ = nullptr;
  std::FILE* in_ = nullptr;
  std::string path_;
  bool failed_ = false;
};

}  // namespace

std::unique_ptr<UartEnd> open_uart_end(const std::string& description, const std::string& default_link,
                                       std::string& error) {
  error.clear();
  const std::size_t colon = description.find(':');
  const std::string kind = description.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : description.substr(colon + 1);
  if (kind == "none" && colon == std::string::npos) return nullptr;
  if (kind == "pty") {
    auto end = std::make_unique<PtyEnd>();
    if (end->open(rest.empty() ? default_link : rest, error)) return end;
    return nullptr;
  }
  if (kind == "tcp") {
    char* tail = nullptr;
    const long port = std::strtol(rest.c_str(), &tail, 10);
    if (rest.empty() || *tail != '\0' || port < 0 || port > 65535) {
      error = "uart: port: got '" + rest + "', expected 0 to 65535";
      return nullptr;
    }
    auto end = std::make_unique<TcpEnd>();
    if (end->open(static_cast<int>(port), error)) return end;
    return nullptr;
  }
  if (kind == "file" && !rest.empty()) {
    const std::size_t comma = rest.find(',');
    auto end = std::make_unique<FileEnd>();
    if (end->open(rest.substr(0, comma), comma == std::string::npos ? "" : rest.substr(comma + 1), error))
      return end;
    return nullptr;
  }
  error = "uart: got '" + description + "', expected none, pty[:LINK], tcp:PORT or file:OUT[,IN]";
  return nullptr;
}

}  // namespace board
