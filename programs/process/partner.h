// SPDX-License-Identifier: MIT
// A program of the PC at the other end of the link: a process that we start, or one from
// outside that connects.
//
//   start()  --socket, pipe of its output--> process in a session of its own
//   listen() --path of a socket------------> whoever connects, of the same user
//
// Packets are those of programs/link/packet.h. Nothing here blocks but receive() and await_end(), and these
// no longer than they are told. What it prints comes line by line with the packet behind it. When a Partner
// goes, its process and all that this has started are ended. One thread at a time.
#pragma once
#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "programs/link/packet.h"

namespace programs {

/// What is started, and where.
struct Start {
  std::vector<std::string> words;        ///< argv; the first is found as a shell would
  std::string name;                      ///< argv[0] in the first word's place; empty: that one
  std::vector<std::string> environment;  ///< NAME=VALUE, in addition to ours, or instead of the same name
  std::string folder;                    ///< where it works
};

/// How a process ended.
struct ProcessEnd {
  int signal = 0;  ///< 0: by itself
  int status = 0;  ///< exit status, when by itself
};

/// "signal 11 (Segmentation fault)", "exit status 3"
std::string words_of(const ProcessEnd& end);

class Partner {
 public:
  /// Null, with `why`, when it cannot be started.
  static std::unique_ptr<Partner> start(const Start& start, std::string& why);
  /// Waits for a program from outside at a socket of this name in the user's folder for them, which
  /// the environment of that program names as TWINPUCK_CONTROLLER=unix:PATH. Null, with `why`, when
  /// that cannot be made.
  static std::unique_ptr<Partner> listen(const std::string& name, std::string& why);
  ~Partner();
  Partner(const Partner&) = delete;
  Partner& operator=(const Partner&) = delete;

  /// Where a program from outside connects; empty for one that was started.
  const std::string& path() const { return path_; }
  /// 0 for a program from outside.
  pid_t pid() const { return pid_; }

  /// What it prints; set before it says anything.
  std::function<void(const char* text, std::size_t bytes)> on_text;

  enum class Got {
    Packet,   ///< in packet()
    Nothing,  ///< in that time
    Gone,     ///< its process has ended, or it closed the link
    Too_long  ///< a packet of more than LINK_MOST_BYTES
  };
  /// Waits up to `milliseconds` for the next packet; what was printed before it has been told.
  Got receive(int milliseconds);
  const void* packet() const { return buffer_.data(); }
  std::size_t packet_bytes() const { return bytes_; }

  enum class Sent { Yes, Gone, Deaf };
  /// Gone: nobody is there any more, which receive() tells as well. Deaf: it takes
  /// nothing for `milliseconds`.
  Sent send(const link_packet& packet, int milliseconds = 1000);

  /// Waits up to `milliseconds` for its process to end, and tells what it still printed. Empty: it goes on.
  std::optional<ProcessEnd> await_end(int milliseconds);
  /// How many processes it and what it has started are.
  int processes() const;
  /// Ends it, with all that it has started.
  void kill();

 private:
  Partner() : buffer_(LINK_MOST_BYTES / sizeof(std::uint64_t)) {}
  void read_text();
  Got take_packet();
  bool accept();

  int socket_ = -1, listener_ = -1, text_ = -1, process_ = -1;
  pid_t pid_ = 0;
  bool has_ended_ = false;
  ProcessEnd end_;
  std::string path_;
  std::vector<std::uint64_t> buffer_;  // aligned for the reader
  std::size_t bytes_ = 0;
};

}  // namespace programs
