// SPDX-License-Identifier: MIT
// See uart_end.h: the end in files, and the choice among all of them. The ends that a program
// talks to are pty_end.cpp and tcp_end.cpp.
#include "hal_sim/board/uart_end.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

#include "hal_sim/board/uart_programs.h"
#include "sim_core/base/output_file.h"

namespace board {

namespace {

class FileEnd : public UartEnd {
 public:
  bool open(const std::string& out, const std::string& in, std::string& error) {
    if (!in.empty() && !open_input(in, error)) return false;
    struct stat info {};
    if (::stat(out.c_str(), &info) == 0 && S_ISFIFO(info.st_mode) && out.rfind("/dev/", 0) != 0) {
      error = "file:" + out + ": got a pipe, expected a file";  // opening it would wait for a reader
      return false;
    }
    out_ = std::make_unique<sim::OutputFile>(out, "", true);
    path_ = out;
    error = this->error();
    return error.empty();
  }
  void begin() override { out_->clear(); }  // not before: something else may be refused
  void deliver(const std::uint8_t* bytes, const Cycle*, std::size_t count) override {
    // after the first error the robot goes on; further bytes are lost
    if (out_->error().empty()) out_->append({reinterpret_cast<const char*>(bytes), count});
  }
  std::size_t collect(std::uint8_t* bytes, std::size_t room, Cycle) override {
    if (!in_.valid()) return 0;
    const ssize_t got = ::read(in_.get(), bytes, room);
    return got > 0 ? static_cast<std::size_t>(got) : 0;
  }
  std::string name() const override { return "file:" + path_; }
  std::string error() const override { return out_->error().empty() ? "" : "file:" + out_->error(); }

 private:
  bool open_input(const std::string& in, std::string& error) {
    in_.reset(::open(in.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
    struct stat info {};
    if (!in_.valid() || ::fstat(in_.get(), &info) != 0) {
      error = "file:" + in + ": cannot be read: " + system_error();
      return false;
    }
    if (!S_ISDIR(info.st_mode)) return true;
    error = "file:" + in + ": got a folder, expected a file";
    return false;
  }

  std::unique_ptr<sim::OutputFile> out_;
  Descriptor in_;
  std::string path_;
};

}  // namespace

bool is_file_end(const std::string& description, std::string& out, std::string& in) {
  if (description.rfind("file:", 0) != 0) return false;
  const std::string rest = description.substr(5);
  const std::size_t comma = rest.find(',');
  out = rest.substr(0, comma);
  in = comma == std::string::npos ? "" : rest.substr(comma + 1);
  return !rest.empty();
}

std::unique_ptr<UartEnd> open_uart_end(const std::string& description, const std::string& default_link,
                                       std::string& error) {
  error.clear();
  const std::size_t colon = description.find(':');
  const std::string kind = description.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : description.substr(colon + 1);
  if ((kind == "none" || kind == "-") && colon == std::string::npos) return nullptr;
  if (kind == "pty") {
    return open_pty_end(rest.empty() ? default_link : rest, error);
  }
  if (kind == "tcp") {
    char* tail = nullptr;
    const long port = std::strtol(rest.c_str(), &tail, 10);
    if (rest.empty() || *tail != '\0' || port < 0 || port > 65535) {
      error = "uart: port: got '" + rest + "', expected 0 to 65535";
      return nullptr;
    }
    return open_tcp_end(static_cast<int>(port), error);
  }
  if (std::string out, in; is_file_end(description, out, in)) {
    auto end = std::make_unique<FileEnd>();
    if (end->open(out, in, error)) return end;
    return nullptr;
  }
  error = "uart: got '" + description + "', expected none, -, pty[:LINK], tcp:PORT or file:OUT[,IN]";
  return nullptr;
}

}  // namespace board
