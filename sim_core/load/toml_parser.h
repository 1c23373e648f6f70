// SPDX-License-Identifier: MIT
// The one place that includes toml++, so that every file which parses TOML is built with the same settings.
// The parser's functions are inline and have one copy in the program: where two files set different macros,
// the linker takes either copy, and asserts that one file had switched off came back from the other.
#pragma once
// the parser asserts where it goes on to report the very same mistake ("[=]"): let it report
#define TOML_ASSERT(condition) static_cast<void>(0)
#define TOML_EXCEPTIONS 0
#define TOML_MAX_NESTED_VALUES 32  // lists in lists; ours are three deep
#include <toml++/toml.h>

#include <string_view>

namespace sim {

/// What the parser cannot take: a character beyond ASCII outside quotes and comments, a key of very many
/// parts ("a.a.a", which it follows by recursion).
struct TomlTrap {
  int line = 0;  ///< 0: there is none
  int column = 0;
  const char* text = "";
};
TomlTrap find_toml_trap(std::string_view text);

}  // namespace sim
