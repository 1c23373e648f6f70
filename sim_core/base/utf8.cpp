// SPDX-License-Identifier: MIT
#include "sim_core/base/utf8.h"

namespace sim {

std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(at);
  const std::size_t length = at >= text.size()                ? 0
                             : first < 0x80                   ? 1
                             : first >= 0xC2 && first <= 0xDF ? 2
                             : first >= 0xE0 && first <= 0xEF ? 3
                             : first >= 0xF0 && first <= 0xF4 ? 4
                                                              : 0;
  for (std::size_t i = 1; i < length; ++i)
    if (byte(at + i) >> 6 != 2) return 0;
  const unsigned second = byte(at + 1);
  const bool is_overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90),
             is_surrogate = first == 0xED && second > 0x9F, is_beyond = first == 0xF4 && second > 0x8F;
  return is_overlong || is_surrogate || is_beyond ? 0 : length;
}

std::optional<std::string> bytes_of_characters(std::string_view text) {
  std::string bytes;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    const auto first = static_cast<unsigned char>(text[at]);
    if (length == 0 || length > 2 || (length == 2 && first > 0xC3)) return {};
    bytes += length == 1
                 ? text[at]
                 : static_cast<char>((first & 3) << 6 | (static_cast<unsigned char>(text[at + 1]) & 0x3F));
    at += length;
  }
  return bytes;
}

}  // namespace sim
