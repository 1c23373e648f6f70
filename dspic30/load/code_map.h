// SPDX-License-Identifier: MIT
// What an image's code is made of: function and source line of an address, and back.
//
//   .symtab --> functions ---+--> CodeMap: function_at(0x3a6), line_at(0x3a6), addresses_of("main.c", 98)
//   .debug_line --> lines ---+
//
// Addresses are program addresses (2 a word). Line tables of DWARF 2 to 4, with addresses of 2 or 4 bytes, as
// our own compiler and XC16 write them. Types and variables: debug_info.h. Not read: ranges of scopes.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace dspic {

struct CodeMap {
  /// Up to where the next one begins, or its section ends.
  struct Function {
    std::uint32_t begin = 0, end = 0;
    std::string name;
  };
  /// From `address` up to the next one's.
  struct Line {
    std::uint32_t address = 0;
    std::uint16_t file = 0;  ///< of `files`
    int line = 0;            ///< 0: code that stands in no source line
    bool is_statement = false;
    bool is_end = false;  ///< nothing is known from here on
  };
  std::vector<Function> functions;  ///< by address
  std::vector<Line> lines;          ///< by address
  std::vector<std::string> files;   ///< as compiled

  /// Null where there is none.
  const Function* function_at(std::uint32_t address) const;
  const Function* function_named(const std::string& name) const;
  /// Null where there is none; else its line is above 0. Code that the compiler made by itself belongs to the
  /// line before.
  const Line* line_at(std::uint32_t address) const;
  /// Where code of that line, or of the next one that has any, begins: statements' first words, one a
  /// function and inlined copy. `file`: the end of a path. `found`: the line.
  std::vector<std::uint32_t> addresses_of(const std::string& file, int line, int& found) const;
  /// "control() (main.c:98)" as far as known, else "0x0003a6".
  std::string describe(std::uint32_t address) const;

  /// A .debug_line section. What cannot be read ends it: lines help, nothing depends on them.
  void add_lines(const unsigned char* bytes, std::size_t size);
  /// After the last addition.
  void sort();
};

}  // namespace dspic
