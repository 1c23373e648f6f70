// SPDX-License-Identifier: MIT
// Regular expressions for texts of any length. The standard library's usual matcher calls itself once a
// character and overflows the stack from 50,000 characters on; the one asked for here follows all
// alternatives at once, in a time that grows with the text only.
#pragma once
#include <regex>
#include <string>

namespace sim {

struct Pattern : std::regex {
  explicit Pattern(const std::string& form, flag_type more = {})
      : std::regex(form, std::regex::ECMAScript | std::regex_constants::__polynomial | more) {}
};

}  // namespace sim
