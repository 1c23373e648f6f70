// SPDX-License-Identifier: MIT
#include "tools/printable.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <iostream>

namespace tools {
namespace {

// marks of the direction of writing: what follows them may be shown in front of what precedes them
bool turns_text(std::uint32_t c) {
  return (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069) || c == 0x200E || c == 0x200F;
}

bool is_plain(std::uint32_t c) {
  if (c == '\n' || c == '\t') return true;
  return c >= 0x20 && !(c >= 0x7F && c < 0xA0) && !turns_text(c) && c != 0x2028 && c != 0x2029;
}

// bytes of the UTF-8 character that begins so; 0: none does
std::size_t length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

}  // namespace

std::string take_printable(std::string& text, bool all) {
  std::string out;
  std::size_t at = 0;
  while (at < text.size()) {
    const auto first = static_cast<unsigned char>(text[at]);
    const std::size_t length = length_of(first);
    std::uint32_t character = length > 1 ? first & (0x7Fu >> length) : first;
    std::size_t have = 1;
    for (; have < length && at + have < text.size(); ++have) {
      const auto next = static_cast<unsigned char>(text[at + have]);
      if ((next & 0xC0) != 0x80) break;
      character = character << 6 | (next & 0x3Fu);
    }
    if (have < length && at + have == text.size() && !all) break;  // the rest may still come
    if (length > 0 && have == length && is_plain(character)) {
      out.append(text, at, length);
    } else {
      have = length > 0 && have == length ? length : 1;
      for (std::size_t i = 0; i < have; ++i)
        out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at + i]));
    }
    at += have;
  }
  text.erase(0, at);
  return out;
}

bool is_stdout_lost() {
  if (!std::cout) return true;
  struct stat info {};
  if (::fstat(STDOUT_FILENO, &info) != 0 || !(S_ISFIFO(info.st_mode) || S_ISSOCK(info.st_mode))) return false;
  pollfd out{STDOUT_FILENO, 0, 0};
  return ::poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

PrintableStream::PrintableStream(std::ostream& stream) : stream_(stream), below_(stream.rdbuf(this)) {}

PrintableStream::~PrintableStream() {
  pass(true);
  below_->pubsync();
  stream_.rdbuf(below_);
}

bool PrintableStream::pass(bool all) {
  const std::string out = take_printable(waiting_, all);
  const auto count = static_cast<std::streamsize>(out.size());
  errno = 0;
  if (below_->sputn(out.data(), count) == count) return true;
  if (error_ == 0) error_ = errno != 0 ? errno : EIO;
  return false;
}

int PrintableStream::finish() {
  sync();
  return error_;
}

PrintableStream::int_type PrintableStream::overflow(int_type c) {
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  waiting_ += traits_type::to_char_type(c);
  return pass(false) ? c : traits_type::eof();
}

std::streamsize PrintableStream::xsputn(const char* text, std::streamsize count) {
  waiting_.append(text, static_cast<std::size_t>(count));
  return pass(false) ? count : 0;
}

int PrintableStream::sync() {
  if (!pass(true)) return -1;
  errno = 0;
  const int done = below_->pubsync();
  if (done != 0 && error_ == 0) error_ = errno != 0 ? errno : EIO;
  return done;
}

}  // namespace tools
