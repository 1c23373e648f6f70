// SPDX-License-Identifier: MIT
// A pseudo-terminal as the far end of a robot's serial line: programs open it as they would open the serial
// port of a Bluetooth connection, set a baud rate (which means nothing here), come and go.
//
// - Raw mode from the start, and again after each program: a terminal that echoes would send the robot its
//   own replies as commands. Our hand on the far side keeps the mode between programs. One that claimed the
//   terminal for itself alone does not keep the next one out.
// - What the robot says while nobody has the terminal open is lost, and so is what a program left unread: a
//   Bluetooth link to a robot that has been on for a while begins silent.
// - A thread takes what programs write as soon as it is there: many flush a port before each command and
//   when they close it, and what had not been taken by then would be lost. Robots see it at the next tick.
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <termios.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <thread>

#include "hal_sim/board/uart_programs.h"
#include "sim_core/base/hash.h"

namespace board {

namespace {

constexpr std::size_t kMostHeard = 65536;  // bytes [assumed: above, a sender is slowed down]

class PtyEnd : public UartEnd {
 public:
  ~PtyEnd() override {
    // somebody may have put something else there
    if (!link_.empty() && target_of(link_) == path_) ::unlink(link_.c_str());
    if (!listener_.joinable()) return;
    const std::uint64_t one = 1;
    while (::write(stop_.get(), &one, sizeof one) < 0 && errno == EINTR) continue;
    listener_.join();
  }

  bool open(const std::string& link, std::string& error) {
    // The terminal, and our own hand on its far end, so that it stays when others leave.
    master_.reset(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!master_.valid() || ::grantpt(master_.get()) != 0 || ::unlockpt(master_.get()) != 0) {
      error = "pty: cannot be opened: " + system_error();
      return false;
    }
    char path[128];
    if (::ptsname_r(master_.get(), path, sizeof path) != 0) {
      error = "pty: has no name: " + system_error();
      return false;
    }
    path_ = path;
    slave_.reset(::open(path, O_RDWR | O_NOCTTY | O_CLOEXEC));
    if (!slave_.valid()) {
      error = "pty: " + path_ + ": " + system_error();
      return false;
    }
    make_raw();
    // who opens and closes it; without this service everybody counts as one program that never leaves
    watch_.reset(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC));
    if (watch_.valid() && ::inotify_add_watch(watch_.get(), path, IN_OPEN | IN_CLOSE) < 0) watch_.reset();
    stop_.reset(::eventfd(0, EFD_CLOEXEC));
    if (!stop_.valid()) {
      error = "pty: no event descriptor: " + system_error();
      return false;
    }
    listener_ = std::thread([this] { listen(); });
    if (link.empty()) return true;
    // a link left by an earlier run is replaced; anything else is not ours
    if (!claim(link)) {
      error = "pty: link " + link +
              ": got the link of a run that goes on, expected a name of its own, by pty:LINK";
      return false;
    }
    if (target_of(link).rfind("/dev/pts/", 0) == 0) ::unlink(link.c_str());
    if (::symlink(path, link.c_str()) != 0) {
      error = "pty: link " + link + ": " + system_error();
      return false;
    }
    link_ = link;
    return true;
  }

  void deliver(const std::uint8_t* bytes, const Cycle*, std::size_t count) override {
    std::lock_guard<std::mutex> hold(said_lock_);
    look_who_is_there();
    if (is_alone()) return;
    const std::size_t room = kMostWaiting - waiting_.size();
    waiting_.append(reinterpret_cast<const char*>(bytes), std::min(count, room));
    write_waiting();
  }

  std::size_t collect(std::uint8_t* bytes, std::size_t room, Cycle) override {
    {
      std::lock_guard<std::mutex> hold(said_lock_);
      look_who_is_there();
      write_waiting();
    }
    std::lock_guard<std::mutex> hold(heard_lock_);
    const std::size_t count = std::min(room, heard_.size());
    std::memcpy(bytes, heard_.data(), count);
    heard_.erase(0, count);
    return count;
  }

  bool takes_packets() const override { return true; }

  std::string name() const override { return link_.empty() ? path_ : link_; }

 private:
  static std::string target_of(const std::string& link) {
    char target[256];
    const ssize_t got = ::readlink(link.c_str(), target, sizeof target);
    return got > 0 && got < static_cast<ssize_t>(sizeof target)
               ? std::string(target, static_cast<std::size_t>(got))
               : "";
  }

  /// One process at a time has a link of that name: the claim is a socket's name in the kernel, which is gone
  /// with the process and leaves no file behind.
  bool claim(const std::string& link) {
    std::error_code none;
    const std::filesystem::path whole = std::filesystem::absolute(link, none);
    std::uint64_t h = 0;
    for (unsigned char c :
         (std::filesystem::weakly_canonical(whole.parent_path(), none) / whole.filename()).string())
      h = sim::mix64(h ^ c);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    // the first byte stays zero: a name that is no file
    const int length = std::snprintf(address.sun_path + 1, sizeof address.sun_path - 1,
                                     "twinpuck-pty-%016llx", static_cast<unsigned long long>(h));
    claim_.reset(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const auto size =
        static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + static_cast<std::size_t>(length));
    return !claim_.valid() || ::bind(claim_.get(), reinterpret_cast<const sockaddr*>(&address), size) == 0 ||
           errno != EADDRINUSE;
  }

  bool is_alone() const { return watch_.valid() && programs_ <= 0; }

  void make_raw() {
    termios settings{};
    if (::tcgetattr(slave_.get(), &settings) != 0) return;
    ::cfmakeraw(&settings);
    ::cfsetspeed(&settings, B115200);
    ::tcsetattr(slave_.get(), TCSANOW, &settings);
    ::ioctl(slave_.get(), TIOCNXCL);
  }

  // With said_lock_. Who opens the terminal finds nothing in it: what is there now was said before.
  void look_who_is_there() {
    alignas(inotify_event) char events[4096];
    for (ssize_t got; watch_.valid() && (got = ::read(watch_.get(), events, sizeof events)) > 0;)
      for (ssize_t at = 0; at < got;) {
        const auto* event = reinterpret_cast<const inotify_event*>(events + at);
        const bool was_alone = is_alone();
        if (event->mask & IN_OPEN) ++programs_;
        if (event->mask & IN_CLOSE) --programs_;
        at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
        if (programs_ <= 0) make_raw();
        if (was_alone == is_alone()) continue;
        waiting_.clear();
        ::tcflush(slave_.get(), TCIFLUSH);
      }
  }

  void write_waiting() {
    while (!waiting_.empty()) {
      const ssize_t done = ::write(master_.get(), waiting_.data(), waiting_.size());
      if (done <= 0) return;
      waiting_.erase(0, static_cast<std::size_t>(done));
    }
  }

  // the thread: from the terminal to heard_; and who left is noticed before the next one
  // can read what it left
  void listen() {
    pollfd watched[3] = {{master_.get(), POLLIN, 0}, {stop_.get(), POLLIN, 0}, {watch_.get(), POLLIN, 0}};
    while (::poll(watched, watch_.valid() ? 3 : 2, -1) >= 0 || errno == EINTR) {
      if (watched[1].revents != 0) return;
      if (watched[2].revents != 0) {
        std::lock_guard<std::mutex> hold(said_lock_);
        look_who_is_there();
      }
      if (watched[0].revents == 0) continue;
      // a program that sends faster than the line carries waits, as flow control makes it wait
      char bytes[4096];
      const ssize_t got = has_room() ? ::read(master_.get(), bytes, sizeof bytes) : 0;
      if (got <= 0) {
        ::usleep(2000);
        continue;
      }
      std::lock_guard<std::mutex> hold(heard_lock_);
      heard_.append(bytes, static_cast<std::size_t>(got));
    }
  }
  bool has_room() {
    std::lock_guard<std::mutex> hold(heard_lock_);
    return heard_.size() < kMostHeard;
  }

  Descriptor master_, slave_, watch_, stop_, claim_;
  std::thread listener_;
  std::mutex heard_lock_;
  std::string heard_;  // said by programs, not yet taken by the robot's line
  std::string path_, link_;
  std::mutex said_lock_;  // what follows
  std::string waiting_;   // delivered, not yet taken by the kernel
  int programs_ = 0;      // that have the terminal open
};

}  // namespace

std::unique_ptr<UartEnd> open_pty_end(const std::string& link, std::string& error) {
  auto end = std::make_unique<PtyEnd>();
  if (end->open(link, error)) return end;
  return nullptr;
}

}  // namespace board
