// SPDX-License-Identifier: MIT
// Values of C as the robot's program has them: their types, widths and conversions. For expression.h.
#pragma once
#include <cstdint>
#include <optional>

#include "dspic30/load/debug_info.h"
#include "hal_sim/debug/code.h"

namespace debug {

/// A number, or something of the image's, under so many pointers.
struct CType {
  enum class Kind : std::uint8_t { Signed, Unsigned, Float, Image, Unknown };
  Kind kind = Kind::Signed;
  unsigned bits = 16;     ///< of a number
  int index = 0;          ///< Image: an array or struct among the image's types
  int stars = 0;          ///< "char **": 2
  bool is_truth = false;  ///< _Bool: whatever is not 0 becomes 1

  bool is_integer() const { return stars == 0 && (kind == Kind::Signed || kind == Kind::Unsigned); }
  bool is_float() const { return stars == 0 && kind == Kind::Float; }
};

/// A variable of a known type, a part of one, or what a pointer points to.
struct Part {
  dspic::DebugInfo::Found found;
  std::optional<Address> pointed;  ///< address that found.offset counts from; none: the variable's place
  std::uint32_t pc = 0;            ///< where the program would have to stand
};

struct CValue {
  CType type;
  std::uint64_t raw = 0;  ///< an integer or a pointer, extended by its sign
  double real = 0;        ///< a float
  std::optional<Part>
      part;  ///< what it was read from, of a known type; an array or struct has no other value
  std::optional<Data> data;  ///< what it was read from, else: a register, a symbol, *(char *)0x900

  bool is_true() const { return type.is_float() ? real != 0 : raw != 0; }
  std::int64_t whole() const;  ///< a float's whole part
};

/// Type of a part as C sees it; `index` among the image's.
CType type_of(const dspic::DebugInfo& debug, int index);
/// The value as another type holds it.
CValue converted(const CValue& value, const CType& to);
/// An integer cut to its width and extended by its sign.
std::uint64_t cut(std::uint64_t raw, unsigned bits, bool is_signed);
CValue integer(CType type, std::uint64_t raw);
CValue real_number(CType type, double value);
/// What is narrower than int becomes int; a wide bit-field keeps its width.
CType promoted(CType type);
/// The usual arithmetic conversions.
CType common_type(CType a, CType b);

}  // namespace debug
