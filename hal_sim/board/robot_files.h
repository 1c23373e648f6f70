// SPDX-License-Identifier: MIT
// Files of a robot's program, for programs that come from the PC (fopen() of firmware for Webots'
// interfaces). A robot writes into a folder of its own and nowhere else; what it has not written there itself
// it reads from its controller's folder. So two robots of one program do not disturb each other, a run
// repeats, and a stranger's program cannot reach the PC's files.
#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace board {

class RobotFiles {
 public:
  /// `own` is made when something is first written; empty: there are no files. `source` is only read; empty:
  /// there is none.
  void place(std::filesystem::path own, std::filesystem::path source) {
    own_ = std::move(own);
    source_ = std::move(source);
  }
  const std::filesystem::path& folder() const { return own_; }
  /// Something was written to folder().
  bool has_written() const { return written_ > 0 || made_; }

  /// A number from 1; 0, when it cannot be had. `why` is set when that is worth a line: a file to read that
  /// does not exist is not.
  int open(const std::string& name, const std::string& mode, std::string& why);
  void close(int file);
  /// How many; -1: no such file.
  std::int64_t read(int file, void* to, std::int64_t bytes);
  std::int64_t write(int file, const void* from, std::int64_t bytes);
  void flush(int file);
  std::int64_t seek(int file, std::int64_t offset, int from);
  bool remove(const std::string& name);
  /// Where a file of that name is to be written, its folder made; empty: nowhere.
  std::string path_for_writing(const std::string& name);

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct Open {
    std::unique_ptr<std::FILE, Closer> file;
    char last = 0;  // 'r' or 'w': between them C wants a seek
  };
  std::FILE* turn(int file, char direction);

  std::filesystem::path own_, source_;
  std::vector<Open> open_;  // by number - 1; null: closed
  std::int64_t written_ = 0;
  bool made_ = false;
};

}  // namespace board
