// SPDX-License-Identifier: MIT
// The little of ELF that the build needs: symbols and sections of objects for the chip.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace cc {

struct ElfSymbol {
  std::string name;  ///< as in C
  bool is_defined = false, is_function = false, is_weak = false, is_global = false;
};

struct ElfFile {
  bool ok = false;
  std::vector<ElfSymbol> symbols;
  std::map<std::string, std::string> sections;  ///< those with bytes in the file
  /// Content of a section, "" when absent.
  std::string section(const std::string& name) const {
    const auto found = sections.find(name);
    return found == sections.end() ? "" : found->second;
  }
};

ElfFile read_elf(const std::filesystem::path& path);

/// Names as in C that an object or an archive for the chip defines; of an archive by its own table.
std::vector<std::string> names_defined_by(const std::filesystem::path& path);

}  // namespace cc
