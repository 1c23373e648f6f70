// SPDX-License-Identifier: MIT
// Source lines of an image's code.
//
//   .debug_line --add()--> rows by address --> line_at(0x3a6)
//
// Addresses are program addresses (2 a word). Line tables of DWARF 2 to 4, with addresses of 2 or 4 bytes, as
// our own compiler and XC16 write them.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dspic {

struct LineTable {
  /// From `address` up to the next one's.
  struct Row {
    std::uint32_t address = 0;
    std::uint16_t file = 0;  ///< of `files`
    int line = 0;            ///< 0: code that stands in no source line
    bool is_statement = false;
    bool is_end = false;   ///< nothing is known from here on
    bool is_body = false;  ///< a function has made its frame and put its arguments there
  };
  std::vector<Row> rows;  ///< by address
  /// Rows of what the linker left out, in the order of the file; each function ends with is_end.
  std::vector<Row> left_out;
  /// Of each unit, by its place in .debug_line: its numbers of files, from 1 on, as numbers of `files`.
  std::map<std::uint32_t, std::vector<std::uint16_t>> unit_files;
  std::vector<std::string> files;  ///< whole paths where the folder of the compilation is known
  /// Set before anything is added: files below the first folder lie below the second one here.
  std::string moved_from, moved_to;

  /// Null where there is none; else its line is above 0. Code that the compiler made by itself belongs
  /// to the line before.
  const Row* line_at(std::uint32_t address) const;

  /// A .debug_line section. What cannot be read ends it: lines help, nothing depends on them. `folders`:
  /// where the compiler stood, by the place of a unit's lines in the section (DebugInfo::folders).
  void add(const unsigned char* bytes, std::size_t size,
           const std::map<std::uint32_t, std::string>& folders = {});
  /// After the last addition.
  void sort();
};

/// Its section of lines, with the folders that its units tell; for Late.
void read_elf(std::string& elf, LineTable& into);

/// "C:/robot/main.c" of "C:\\robot\\build" and "..\\main.c": slashes, no dots. A `path` that is
/// whole by itself, "C:/robot/main.c" too, has no need of the folder.
std::string whole_path(const std::string& folder, const std::string& path);

}  // namespace dspic
