// SPDX-License-Identifier: MIT
// The little of ELF that the build needs: symbols and sections of objects for the chip.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cc {

struct ElfSymbol {
  std::string name;
  uint64_t value = 0, size = 0;
  bool is_defined = false, is_function = false, is_weak = false, is_global = false, is_common = false;
};

struct ElfFile {
  bool ok = false;
  std::vector<ElfSymbol> symbols;
  /// Content of a section, "" when absent.
  std::string section(const std::string& name) const;
  std::string bytes;
};

ElfFile read_elf(const std::filesystem::path& path);

/// Names as in C that an object or an archive for the chip defines; of an archive by its own table.
std::vector<std::string> names_defined_by(const std::filesystem::path& path);

}  // namespace cc
