// SPDX-License-Identifier: MIT
// UTF-8, as texts from outside may or may not be. Source: RFC 3629, section 4.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sim {

/// Bytes of the well-formed character that begins at `at`: 1 to 4; 0: none does. Forms that are longer than need
/// be, halves of pairs (surrogates) and what lies beyond U+10FFFF are none.
std::size_t utf8_length(std::string_view text, std::size_t at);

/// The bytes of a text in which each character stands for one, up to U+00FF; none: one lies beyond.
std::optional<std::string> bytes_of_characters(std::string_view text);

}  // namespace sim
