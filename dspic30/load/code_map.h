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
#include <map>
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
  /// Rows of what the linker left out, in the order of the file; each function ends with is_end.
  std::vector<Line> left_out;
  /// Of each unit, by its place in .debug_line: its numbers of files, from 1 on, as numbers of `files`.
  std::map<std::uint32_t, std::vector<std::uint16_t>> unit_files;
  std::vector<std::string> files;  ///< whole paths where the folder of the compilation is known
  /// Set before lines are added: files below the first folder lie below the second one here.
  std::string moved_from, moved_to;

  /// Null where there is none.
  const Function* function_at(std::uint32_t address) const;
  const Function* function_named(const std::string& name) const;
  /// Null where there is none; else its line is above 0. Code that the compiler made by itself belongs
  /// to the line before.
  const Line* line_at(std::uint32_t address) const;
  /// Where code of that line, or of the next one that has any, begins: statements' first words, one a
  /// function and inlined copy. `file`: the end of a path. `found`: the line.
  std::vector<std::uint32_t> addresses_of(const std::string& file, int line, int& found) const;
  /// The same in any of `among`: numbers of `files`.
  std::vector<std::uint32_t> addresses_of(const std::vector<std::size_t>& among, int line, int& found) const;
  /// "control() (main.c:98)" as far as known, else "0x0003a6".
  std::string describe(std::uint32_t address) const;

  /// A .debug_line section. What cannot be read ends it: lines help, nothing depends on them. `folders`:
  /// where the compiler stood, by the place of a unit's lines in the section (DebugInfo::folders).
  void add_lines(const unsigned char* bytes, std::size_t size,
                 const std::map<std::uint32_t, std::string>& folders = {});
  /// After the last addition.
  void sort();
};

/// "C:/robot/main.c" of "C:\\robot\\build" and "..\\main.c": slashes, no dots. A `path` that is
/// whole by itself, "C:/robot/main.c" too, has no need of the folder.
std::string whole_path(const std::string& folder, const std::string& path);
/// Is `end` the end of a path, from a name's first letter on? "motors/speed.c", "speed.c".
bool ends_path(const std::string& path, const std::string& end);

}  // namespace dspic
