// SPDX-License-Identifier: MIT
// An expression of C, computed as the program would: int has 16 bits, long 32, float and double 32, long
// double 64; integer promotions and usual arithmetic conversions; pointers; bit-fields as wide as gcc takes
// them. Text in, a value with its type out. Nothing is called, nothing is changed.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "hal_sim/debug/c_value.h"

namespace debug {

inline constexpr unsigned kPointerBits = 16;

/// What an expression asks of the program that is looked at.
class Names {
 public:
  virtual ~Names() = default;
  virtual const dspic::DebugInfo& debug_info() const = 0;
  /// A variable that is known where the program stands, or would; `scope`: of that file or function, empty: any.
  virtual bool find_variable(const std::string& scope, const std::string& name, Part& part) const = 0;
  /// The function that has a local variable of that name; empty: none has.
  virtual std::string function_of(const std::string& local) const = 0;
  /// A register, a symbol without a type, the debugger's own numbers; functions as addresses.
  virtual bool find_other(const std::string& name, CValue& value) const = 0;
  virtual std::optional<Address> address_of(const Part& part) const = 0;
  /// Bits of a number or pointer; none: it is kept nowhere, or no number.
  virtual std::optional<std::uint64_t> raw_value(const Part& part) const = 0;
  /// None: there is nothing.
  virtual std::optional<std::uint64_t> raw_value(const Data& data) const = 0;
};

enum class Want {
  Place,   ///< whatever it is, with where it lies
  Number,  ///< a number or a pointer; an array becomes one to its first element
};
/// False: `error` says why. `is_tried`: values are not the program's yet, so a division by zero is none.
bool compute(const Names& names, const std::string& text, Want want, bool is_tried, CValue& value,
             std::string& error);

}  // namespace debug
