// SPDX-License-Identifier: MIT
// See uart_end.h: the ends in memory and in files, and the choice among all of them. The ends that a program
// talks to are pty_end.cpp and tcp_end.cpp.
#include "hal_sim/board/uart_end.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "hal_sim/board/uart_programs.h"

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

std::string why() { return std::strerror(errno); }

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
