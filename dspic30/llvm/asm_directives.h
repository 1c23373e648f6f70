// SPDX-License-Identifier: MIT
// Directives that the vendor's assembler has and LLVM's has not, or reads otherwise.
//
//   .section NAME, data, near     types and attributes as words (dspic30/asm/section_text.h)
//   .pushsection NAME, data       the same
//   .hword .word .pword           values of 2 bytes, aligned; whole words of program memory
//   .short .byte .ascii .asciz    in code: two bytes in the lower half of each word
//   .align .palign                in code: counts 2 for a word
//   config __FOSC, value          a configuration word
#pragma once
#include <functional>
#include <string>

#include "llvm/MC/MCParser/MCAsmParser.h"

namespace llvm {

/// Text without what stands between /* and */ or behind ; and //, but for quoted ones: mov #';', w0.
std::string without_asm_comments(StringRef text);

class DSPICDirectives {
 public:
  /// The value of an expression of constants; false: it has none.
  using Value = std::function<bool(const std::string& text, std::int64_t& value)>;

  DSPICDirectives(MCAsmParser& parser, Value value) : parser_(parser), value_(std::move(value)) {}
  /// Behind the directive's name. True: it is not one of these, and nothing was read.
  bool parse(StringRef name);
  /// Of `config`. True: a mistake was reported at `at`.
  bool configure(StringRef operands, SMLoc at);

 private:
  bool is_in_code() const;
  std::string rest_of_line();
  bool section(const std::string& operands, SMLoc at);
  bool values(unsigned bytes);
  bool bytes_in_code(SMLoc at, bool are_texts, bool with_zero);
  bool alignment(SMLoc at);
  bool align(std::int64_t to, SMLoc at);

  MCAsmParser& parser_;
  Value value_;
};

}  // namespace llvm
