// SPDX-License-Identifier: MIT
// Reads debug information and other bytes: numbers and texts one after the other, never beyond the end.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

namespace dspic {

/// Bytes one after the other; zero beyond the end.
class Cursor {
 public:
  Cursor(const unsigned char* bytes, std::size_t size) : at_(bytes), end_(bytes + size) {}
  bool is_at_end() const { return at_ >= end_; }
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  const unsigned char* here() const { return at_; }
  std::uint32_t number(std::size_t bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) {
      const std::uint32_t b = byte();
      if (i < 4) value |= b << 8 * i;
    }
    return value;
  }
  std::uint8_t byte() { return is_at_end() ? std::uint8_t{0} : *at_++; }
  std::uint32_t leb() { return static_cast<std::uint32_t>(bits(false)); }
  std::int32_t signed_leb() { return static_cast<std::int32_t>(bits(true)); }
  std::string text() {
    std::string out;
    while (!is_at_end() && *at_) out += static_cast<char>(*at_++);
    byte();
    return out;
  }
  /// The next `size` bytes for themselves; they are passed.
  Cursor part(std::size_t size) {
    const Cursor inner(at_, std::min(size, left()));
    at_ = inner.end_;
    return inner;
  }

 private:
  std::int64_t bits(bool is_signed) {
    std::uint64_t value = 0;
    unsigned shift = 0;
    std::uint8_t b = 0x80;
    while ((b & 0x80) && !is_at_end()) {
      b = byte();
      if (shift < 63) value |= static_cast<std::uint64_t>(b & 0x7F) << shift;
      shift += 7;
    }
    if (is_signed && shift < 64 && (b & 0x40)) value |= ~std::uint64_t{0} << shift;
    return static_cast<std::int64_t>(value);
  }
  const unsigned char *at_, *end_;
};

}  // namespace dspic
