// SPDX-License-Identifier: MIT
// Old C calls a function before it is defined and later defines it with a result other than int. XC16
// warns and goes on; clang refuses. A second attempt with declarations in front of the file compiles
// what XC16 compiles.
#pragma once
#include <string>

namespace cc {

/// Declarations "void f();" of those functions that `messages` (clang's) reports as defined in conflict with
/// an implicit declaration and that `source` defines with a built-in result type. Empty when there is none.
std::string forward_declarations(const std::string& messages, const std::string& source);

}  // namespace cc
