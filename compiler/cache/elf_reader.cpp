// SPDX-License-Identifier: MIT
// See elf_reader.h. Malformed files give ok == false, never a crash: every offset is checked.
#include "elf_reader.h"

#include <elf.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

namespace cc {
namespace {

/// A copy: in a malformed file it may lie at any address.
template <class T>
std::optional<T> at(const std::string& bytes, uint64_t offset) {
  if (offset > bytes.size() || bytes.size() - offset < sizeof(T)) return std::nullopt;
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::optional<Elf32_Ehdr> file_header(const std::string& bytes) { return at<Elf32_Ehdr>(bytes, 0); }

std::optional<Elf32_Shdr> section_header(const std::string& bytes, unsigned index) {
  const auto head = file_header(bytes);
  if (!head || index >= head->e_shnum) return std::nullopt;
  return at<Elf32_Shdr>(bytes, head->e_shoff + std::uint64_t{index} * sizeof(Elf32_Shdr));
}

std::string string_at(const std::string& bytes, const std::optional<Elf32_Shdr>& table, uint64_t offset) {
  if (!table || offset >= table->sh_size || table->sh_offset >= bytes.size() ||
      offset >= bytes.size() - table->sh_offset)
    return "";
  const char* s = bytes.data() + table->sh_offset + offset;
  return std::string(s, strnlen(s, bytes.size() - (table->sh_offset + offset)));
}

}  // namespace

std::string ElfFile::section(const std::string& name) const {
  const auto head = file_header(bytes);
  if (!ok || !head) return "";
  for (unsigned i = 0; i < head->e_shnum; ++i) {
    const auto s = section_header(bytes, i);
    if (!s || string_at(bytes, section_header(bytes, head->e_shstrndx), s->sh_name) != name) continue;
    if (s->sh_type == SHT_NOBITS || s->sh_offset > bytes.size()) return "";
    return bytes.substr(s->sh_offset, s->sh_size);
  }
  return "";
}

ElfFile read_elf(const std::filesystem::path& path) {
  ElfFile file;
  std::ifstream in(path, std::ios::binary);
  if (!in) return file;
  std::ostringstream all;
  all << in.rdbuf();
  file.bytes = all.str();
  const auto head = file_header(file.bytes);
  if (!head || std::memcmp(head->e_ident, ELFMAG, SELFMAG) != 0 || head->e_ident[EI_CLASS] != ELFCLASS32)
    return file;
  file.ok = true;
  // All symbols of all symbol tables.
  for (unsigned i = 0; i < head->e_shnum; ++i) {
    const auto table = section_header(file.bytes, i);
    if (!table || table->sh_type != SHT_SYMTAB) continue;
    for (std::uint64_t offset = 0; offset + sizeof(Elf32_Sym) <= table->sh_size;
         offset += sizeof(Elf32_Sym)) {
      const auto symbol = at<Elf32_Sym>(file.bytes, table->sh_offset + offset);
      if (!symbol) break;
      ElfSymbol s;
      s.name = string_at(file.bytes, section_header(file.bytes, table->sh_link), symbol->st_name);
      // C's names have an underscore in front
      if (s.name.size() > 1 && s.name[0] == '_') s.name.erase(0, 1);
      s.value = symbol->st_value, s.size = symbol->st_size;
      s.is_defined = symbol->st_shndx != SHN_UNDEF;
      s.is_common = symbol->st_shndx == SHN_COMMON;
      s.is_function = ELF32_ST_TYPE(symbol->st_info) == STT_FUNC;
      s.is_weak = ELF32_ST_BIND(symbol->st_info) == STB_WEAK;
      s.is_global = ELF32_ST_BIND(symbol->st_info) != STB_LOCAL;
      if (!s.name.empty()) file.symbols.push_back(std::move(s));
    }
  }
  return file;
}

std::vector<std::string> names_defined_by(const std::filesystem::path& path) {
  std::vector<std::string> names;
  std::ifstream in(path, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  const std::string bytes = all.str();
  static const std::string kArchive = "!<arch>\n";
  if (bytes.compare(0, kArchive.size(), kArchive) != 0) {
    for (const ElfSymbol& s : read_elf(path).symbols)
      if (s.is_global && (s.is_defined || s.is_common)) names.push_back(s.name);
    return names;
  }
  // its first member, "/": how many, the place of each name's member, then the names; big endian
  constexpr std::size_t kHeader = 60, kSizeAt = 48, kSizeDigits = 10;
  const std::size_t head = kArchive.size(), body = head + kHeader;
  if (bytes.size() < body + 4 || bytes.compare(head, 2, "/ ") != 0) return names;
  const std::size_t size = std::strtoul(bytes.substr(head + kSizeAt, kSizeDigits).c_str(), nullptr, 10);
  const std::string table = bytes.substr(body, size);
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4 && i < table.size(); ++i) count = count << 8 | (unsigned char)table[i];
  for (std::size_t at = 4 + 4 * count; count > 0 && at < table.size(); --count) {
    std::string name = table.c_str() + at;
    at += name.size() + 1;
    if (name.size() > 1 && name[0] == '_') name.erase(0, 1);
    names.push_back(name);
  }
  return names;
}

}  // namespace cc
