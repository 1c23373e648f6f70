// SPDX-License-Identifier: MIT
// The simulator's end of the link, played by a test: a child process runs a program, the test reads what it
// says and answers. Every read waits at most 20 s.
#pragma once
#include <sys/types.h>
#include <functional>
#include <string>
#include <vector>

#include "programs/link/packet.h"

namespace fake {

/// A record with its members copied out of the packet.
struct Record {
  int number = 0;
  std::vector<std::int64_t> ints;
  std::vector<double> reals;
  std::vector<std::string> texts;
  std::vector<std::vector<double>> lists;
};

/// A packet that is being written: records by number, members in their order.
class Packet {
 public:
  ~Packet() { link_free(&packet_); }
  template <class... Members>
  Packet& add(int number, const Members&... members) {
    link_begin(&packet_, number);
    (member(members), ...);
    link_end(&packet_);
    return *this;
  }
  const void* bytes() const { return packet_.bytes; }
  std::size_t size() const { return packet_.size; }

 private:
  void member(int value) { link_int(&packet_, value); }
  void member(std::int64_t value) { link_int(&packet_, value); }
  void member(double value) { link_number(&packet_, value); }
  void member(const char* value) { link_text(&packet_, value); }
  void member(const std::string& value) { link_bytes(&packet_, value.data(), value.size()); }
  void member(const std::vector<double>& values) { link_numbers(&packet_, values.data(), values.size()); }
  link_packet packet_{};
};

struct Device {
  int tag, kind;
  std::string name;
  std::vector<double> numbers;
};

struct World {
  int version = LINK_VERSION;
  bool supervisor = false, nue = false;
  std::int64_t seed = 7;
  std::int64_t time_ns = 0;
  std::vector<Device> devices;
};

class Simulator {
 public:
  /// Runs `program` in a child process; its standard output and errors are kept apart.
  explicit Simulator(const std::function<void()>& program);
  /// Runs a program file, in a folder.
  Simulator(const std::string& file, const std::string& folder);
  ~Simulator();
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  /// The next packet; empty: the program has closed its end.
  std::vector<Record> next();
  /// The same without looking at it; its size.
  std::size_t next_raw();
  void send(const Packet& packet);
  void send_bytes(const std::string& bytes);
  /// HELLO's answer. Returns HELLO.
  Record welcome(const World& world);
  /// A packet that ends in STEP, without it; an empty answer to a packet that does not is a
  /// failure of the test.
  std::vector<Record> until_step();
  /// DONE, with samples before it.
  void done(std::int64_t time_ns, Packet& samples);
  void done(std::int64_t time_ns);
  /// Nobody is there any more.
  void close();

  /// Waits for the end of the program: exit status, or 1000 and the signal.
  int wait();
  /// What it has printed, whole after wait().
  const std::string& output() const { return output_; }
  const std::string& errors() const { return errors_; }
  std::int64_t asked_ms() const { return asked_ms_; }

 private:
  void start(const std::function<void()>& program);
  pid_t child_ = -1;
  int socket_ = -1, out_ = -1, err_ = -1;
  std::int64_t asked_ms_ = -1;  // of the last STEP
  std::string output_, errors_;
};

/// The records of a number.
std::vector<Record> of(const std::vector<Record>& records, int number);

}  // namespace fake
