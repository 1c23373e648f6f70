// SPDX-License-Identifier: MIT
// A variable of a program, or a part of one: where its bytes are and which number they stand for.
#pragma once
#include <cstddef>
#include <cstdint>

namespace host {

/// Where something is and what its bytes mean.
struct Variable {
  enum class Kind { Signed, Unsigned, Float, Aggregate };
  std::uintptr_t address = 0;  ///< in the chip's data memory
  std::size_t bytes = 0;
  Kind kind = Kind::Aggregate;  ///< Aggregate: an array or a struct as a whole
  int first_bit = 0;            ///< of a bit-field, from the lowest bit of the bytes on
  int bits = 0;                 ///< width of a bit-field; 0: none
};

/// The number that a scalar's bytes stand for; `at` holds variable.bytes of them.
double variable_value(const Variable& variable, const char* at);
/// Changes these bytes to hold `value`, cut to the variable's width.
void set_variable_value(const Variable& variable, char* at, double value);

}  // namespace host
