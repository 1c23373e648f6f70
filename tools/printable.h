// SPDX-License-Identifier: MIT
// What reaches the terminal by std::cout and std::cerr holds no control characters, whatever the names of
// files, robots and pictures hold: an escape sequence in a name could hide a message or change the terminal.
// The text of programs (their consoles) passes through here too.
#pragma once
#include <ostream>
#include <streambuf>
#include <string>

namespace tools {

/// Line feeds, tabs and UTF-8 text pass. Other control characters, marks that turn the direction of writing
/// and bytes that are no UTF-8 become "\x1b" and the like. What is left of `text` is a character that has not
/// come whole; with `all` it is written as bytes.
std::string take_printable(std::string& text, bool all);

/// Whether text for standard output goes nowhere: it could not be written, or it is a pipe that nobody reads.
bool is_stdout_lost();

/// Puts itself between a stream and its buffer, for as long as it lives.
class PrintableStream : public std::streambuf {
 public:
  explicit PrintableStream(std::ostream& stream);
  ~PrintableStream() override;
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;
  /// All that was written goes out. The first error there was, an errno; 0: none.
  int finish();

 protected:
  int_type overflow(int_type c) override;
  std::streamsize xsputn(const char* text, std::streamsize count) override;
  int sync() override;

 private:
  bool pass(bool all);
  std::ostream& stream_;
  std::streambuf* below_;
  std::string waiting_;
  int error_ = 0;
};

}  // namespace tools
