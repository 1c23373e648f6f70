// SPDX-License-Identifier: MIT
// See elf_reader.h. libelf checks what a file says of itself; of a malformed one there is what it finds.
#include "elf_reader.h"

#include <gelf.h>

#include <memory>

#include "object_cache.h"

namespace cc {
namespace {

/// Null: `bytes` are nothing that libelf knows. They must outlive it.
std::unique_ptr<Elf, int (*)(Elf*)> open_elf(std::string& bytes) {
  elf_version(EV_CURRENT);
  return {elf_memory(bytes.data(), bytes.size()), elf_end};
}

/// Names of C have an underscore in front.
std::string in_c(const char* name) { return name[0] == '_' && name[1] ? name + 1 : name; }

}  // namespace

ElfFile read_elf(const std::filesystem::path& path) {
  ElfFile file;
  std::string bytes = bytes_of(path);
  const auto elf = open_elf(bytes);
  std::size_t names = 0;
  if (!elf || elf_kind(elf.get()) != ELF_K_ELF || gelf_getclass(elf.get()) != ELFCLASS32) return file;
  file.ok = true;
  elf_getshdrstrndx(elf.get(), &names);
  for (Elf_Scn* section = nullptr; (section = elf_nextscn(elf.get(), section));) {
    GElf_Shdr head;
    Elf_Data* const data = elf_getdata(section, nullptr);
    if (!gelf_getshdr(section, &head) || !data || !data->d_buf) continue;
    if (const char* const name = elf_strptr(elf.get(), names, head.sh_name);
        name && head.sh_type == SHT_PROGBITS)
      file.sections.emplace(name, std::string(static_cast<const char*>(data->d_buf), data->d_size));
    if (head.sh_type != SHT_SYMTAB) continue;
    GElf_Sym symbol;
    for (int i = 0; gelf_getsym(data, i, &symbol); ++i) {
      const char* const name = elf_strptr(elf.get(), head.sh_link, symbol.st_name);
      if (!name || !*name) continue;
      ElfSymbol& s = file.symbols.emplace_back();
      s.name = in_c(name);
      s.is_defined = symbol.st_shndx != SHN_UNDEF;
      s.is_function = GELF_ST_TYPE(symbol.st_info) == STT_FUNC;
      s.is_weak = GELF_ST_BIND(symbol.st_info) == STB_WEAK;
      s.is_global = GELF_ST_BIND(symbol.st_info) != STB_LOCAL;
    }
  }
  return file;
}

std::vector<std::string> names_defined_by(const std::filesystem::path& path) {
  std::vector<std::string> names;
  std::string bytes = bytes_of(path);
  const auto archive = open_elf(bytes);
  if (archive && elf_kind(archive.get()) == ELF_K_AR) {
    std::size_t count = 0;
    const Elf_Arsym* const table = elf_getarsym(archive.get(), &count);
    for (std::size_t i = 0; table && i < count && table[i].as_name; ++i)
      names.push_back(in_c(table[i].as_name));
    return names;
  }
  for (const ElfSymbol& s : read_elf(path).symbols)
    if (s.is_global && s.is_defined) names.push_back(s.name);
  return names;
}

}  // namespace cc
