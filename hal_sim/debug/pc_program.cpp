// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <gelf.h>
#include <unistd.h>

#include <map>
#include <memory>

#include "hal_sim/debug/pc_machine.h"

namespace debug {

namespace {

struct Closer {
  void operator()(Elf* elf) const { elf_end(elf); }
};

void read_symbols(Elf* elf, Elf_Scn* section, const GElf_Shdr& head, dspic::FirmwareFile& file) {
  Elf_Data* const data = elf_getdata(section, nullptr);
  if (!data || head.sh_entsize == 0) return;
  for (std::size_t i = 0; i < head.sh_size / head.sh_entsize; ++i) {
    GElf_Sym symbol;
    if (!gelf_getsym(data, static_cast<int>(i), &symbol)) return;
    const char* const name = elf_strptr(elf, head.sh_link, symbol.st_name);
    if (!name || !*name || symbol.st_shndx == SHN_UNDEF || symbol.st_shndx >= SHN_LORESERVE) continue;
    const auto value = static_cast<std::uint32_t>(symbol.st_value);
    const auto bytes = static_cast<std::uint32_t>(symbol.st_size);
    if (GELF_ST_TYPE(symbol.st_info) == STT_FUNC) {
      if (file.functions.emplace(name, value).second)
        file.code.functions.push_back({value, value + bytes, name});
    } else if (GELF_ST_TYPE(symbol.st_info) == STT_OBJECT) {
      file.objects[name] = value;
      file.object_bytes[name] = bytes;
    }
  }
}

}  // namespace

dspic::FirmwareFile read_pc_program(const std::string& path) {
  dspic::FirmwareFile file;
  elf_version(EV_CURRENT);
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return file;
  {
    const std::unique_ptr<Elf, Closer> elf(elf_begin(descriptor, ELF_C_READ, nullptr));
    std::map<std::string, dspic::DebugInfo::Section> sections;
    std::size_t names = 0;
    if (elf) elf_getshdrstrndx(elf.get(), &names);
    for (Elf_Scn* s = nullptr; elf && (s = elf_nextscn(elf.get(), s));) {
      GElf_Shdr head;
      if (!gelf_getshdr(s, &head)) break;
      if (head.sh_type == SHT_SYMTAB) read_symbols(elf.get(), s, head, file);
      const char* const name = elf_strptr(elf.get(), names, head.sh_name);
      if (!name || std::string(name).compare(0, 7, ".debug_") != 0) continue;
      if (const Elf_Data* data = elf_getdata(s, nullptr); data && data->d_buf)
        sections[name] = {static_cast<const unsigned char*>(data->d_buf), data->d_size};
    }
    file.debug.keep(sections);
    if (const auto lines = sections.find(".debug_line"); lines != sections.end())
      file.code.add_lines(lines->second.bytes, lines->second.size, dspic::DebugInfo::folders_in(sections));
    file.code.sort();
  }
  close(descriptor);
  return file;
}

}  // namespace debug
