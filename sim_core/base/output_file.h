// SPDX-License-Identifier: MIT
// A file that a run writes: it grows by whole records, may be patched in places and remembers the first
// error. When a disk is full it ends with its last whole record, never in the middle of one.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sim {

/// Opens a file to be written, and keeps other runs from it until it is closed. What is in it stays. `mode`: O_WRONLY or
/// O_RDWR. -1: `why_not` says why.
int open_output(const std::string& path, int mode, std::string& why_not);

class OutputFile {
 public:
  /// `option`: what the file was asked for with, for messages: "--vcd"; empty: nothing is said about it.
  /// `keeps`: what is in the file stays until clear().
  explicit OutputFile(const std::string& path, const std::string& option = "", bool keeps = false);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// All of it or, when that fails, nothing of it; `end` is what the file then ends with.
  void append(std::string_view records, std::string_view end = {});
  void append(const std::vector<std::uint8_t>& records, const std::vector<std::uint8_t>& end = {}) {
    append(text_of(records), text_of(end));
  }
  /// All of it or, when that fails, the lines that there is room for.
  void append_lines(std::string_view lines);
  /// Writes all of it, or notes why not. Returns how many bytes were written.
  std::size_t write_at(std::int64_t at, std::string_view bytes);
  void write_at(std::int64_t at, const std::vector<std::uint8_t>& bytes) { write_at(at, text_of(bytes)); }
  /// Bytes so far: where append() writes.
  std::int64_t size() const { return size_; }
  /// Cuts off or goes on: where append() writes from now on.
  void set_size(std::int64_t size) { size_ = size; }
  /// What was in the file before goes; nothing for a pipe or a device.
  void clear();
  void close();
  void fail(const std::string& reason);
  /// "PATH: OPTION: cannot be written: reason", or empty.
  const std::string& error() const { return error_; }

 private:
  static std::string_view text_of(const std::vector<std::uint8_t>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  std::string where_, error_;
  int file_ = -1;
  bool has_places_ = false;  // a pipe or a terminal only takes what comes next
  std::int64_t size_ = 0;
};

}  // namespace sim
