// SPDX-License-Identifier: MIT
// What an image's code is made of: function and source line of an address, and back.
//
//   .symtab --> functions ---+--> CodeMap: function_at(0x3a6), line_at(0x3a6), addresses_of("main.c", 98)
//   .debug_line --> lines ---+
//
// Addresses are program addresses (2 a word). Lines: line_table.h. Types and variables: debug_info.h. Not
// read: ranges of scopes.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "dspic30/load/late.h"
#include "dspic30/load/line_table.h"

namespace dspic {

struct CodeMap {
  /// Up to where the next one begins, or its section ends.
  struct Function {
    std::uint32_t begin = 0, end = 0;
    std::string name;
  };
  using Line = LineTable::Row;
  std::vector<Function> functions;  ///< by address
  Late<LineTable> late_lines;
  /// For whoever keeps the lines; as LineTable's.
  std::string moved_from, moved_to;

  const LineTable& lines() const { return late_lines.value(); }
  /// Null where there is none.
  const Function* function_at(std::uint32_t address) const;
  const Function* function_named(const std::string& name) const;
  /// As LineTable's.
  const Line* line_at(std::uint32_t address) const { return lines().line_at(address); }
  /// Where code of that line, or of the next one that has any, begins: statements' first words, one a
  /// function and inlined copy. `file`: the end of a path. `found`: the line.
  std::vector<std::uint32_t> addresses_of(const std::string& file, int line, int& found) const;
  /// The same in any of `among`: numbers of `files`.
  std::vector<std::uint32_t> addresses_of(const std::vector<std::size_t>& among, int line, int& found) const;
  /// Where a function that begins there has its arguments in their places; where it begins, if nothing tells.
  std::uint32_t body_of(std::uint32_t begin) const;
  /// "control() (main.c:98)" as far as known, else "0x0003a6".
  std::string describe(std::uint32_t address) const;

  /// After the last function.
  void sort();
};

/// Is `end` the end of a path, from a name's first letter on? "motors/speed.c", "speed.c".
bool ends_path(const std::string& path, const std::string& end);

}  // namespace dspic
