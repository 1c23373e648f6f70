// SPDX-License-Identifier: MIT
// Expressions of assembler text: numbers (10, 0x1F, 0b101, 017, 'a'), symbols, operators of C with C's
// precedence, and what XC16 offers on addresses: tblpage, tbloffset, psvpage, psvoffset, paddr,
// handle, lo16, hi16.
#pragma once
#include <cstdint>
#include <functional>
#include <string>

namespace dspic::assembly {

/// Value of a symbol into `value`; false: unknown. "." is the place of the statement; "1b" and "1f" are the
/// nearest label 1 before and after it.
using Symbols = std::function<bool(const std::string& name, std::int64_t& value)>;
/// Program address of a jump to `address`, for handle().
using Handles = std::function<std::int64_t(std::int64_t address)>;

/// True: `value` is that of the whole text. Else `error` says what is wrong with it: "unknown symbol 'x'".
bool evaluate(const std::string& text, const Symbols& symbols, const Handles& handles, std::int64_t& value,
              std::string& error);
/// May a symbol's name begin, or go on, with this character?
bool begins_name(char c);
bool continues_name(char c);
std::string lower(std::string text);
std::string trimmed(const std::string& text);

}  // namespace dspic::assembly
