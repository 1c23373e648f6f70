// SPDX-License-Identifier: MIT
// Variables of a firmware image by an expression in C, through its DWARF: count, speed[1], state.mode,
// grid[2][3].x; main.c:count and tick:count for statics of a file and of a function. Read: location, type,
// bit-fields, anonymous members. Not read: locals, pointers' targets, what the optimiser keeps otherwise.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

typedef struct Dwarf Dwarf;

namespace host {

/// Where something is and what its bytes mean.
struct Variable {
  enum class Kind { Signed, Unsigned, Float, Aggregate };
  std::uintptr_t address = 0;  ///< relative to the image's load address
  std::size_t bytes = 0;
  Kind kind = Kind::Aggregate;  ///< Aggregate: an array or a struct as a whole
  int first_bit = 0;            ///< of a bit-field, from the lowest bit of the bytes on
  int bits = 0;                 ///< width of a bit-field; 0: none
};

/// Empty, or what is wrong: "got ..., expected ...". `dwarf` may be null: no debug information.
std::string find_variable(Dwarf* dwarf, const std::string& expression, Variable& out);

/// The number that a scalar's bytes stand for; `at` holds variable.bytes of them.
double variable_value(const Variable& variable, const char* at);
/// Changes these bytes to hold `value`, cut to the variable's width.
void set_variable_value(const Variable& variable, char* at, double value);

}  // namespace host
