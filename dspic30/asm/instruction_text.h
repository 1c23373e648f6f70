// SPDX-License-Identifier: MIT
// One instruction of assembler text: which row of the instruction table it is, and its words. Rows are found
// by how operands look, so the number of words is known before any symbol is.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "dspic30/core/instruction_table.h"

namespace dspic::assembly {

/// An operand by its looks.
struct Written {
  enum Kind { Register, Indirect, IndirectLiteral, Immediate, Wreg, Stepped, Multiplied, Plain } kind = Plain;
  unsigned mode = 0;      ///< of Indirect: 1 to 6
  unsigned n = 0, m = 0;  ///< registers: Wn; Wb of mode 6, the second factor of Multiplied
  int step = 0;           ///< of Stepped, [Wn]+=step
  std::string text;       ///< expression of IndirectLiteral, Immediate, Plain
};

struct Choice {
  const Row* row = nullptr;
  Fields fields;          ///< what needs no symbols
  bool word_bit = false;  ///< a bit of a word in memory: 0 to 15
  std::vector<Written> operands;
};

/// The value of an expression; reports and answers 0 where it has none.
using Value = std::function<std::int64_t(const std::string& text)>;
using Complaint = std::function<void(const std::string& message)>;

/// The row that fits; null, with a complaint, if there is none.
Choice choose(const std::string& mnemonic, const std::string& operands, const Complaint& complain);
/// Words of a chosen instruction at `address`; ranges are checked.
std::vector<std::uint32_t> encode(const Choice& choice, std::uint32_t address, const Value& value,
                                  const Complaint& complain);
/// Parts between commas, outside brackets, parentheses and quotes.
std::vector<std::string> split(const std::string& text);

}  // namespace dspic::assembly
