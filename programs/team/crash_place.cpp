// SPDX-License-Identifier: MIT
// From an address in a program of the PC to function, file and line, by its own debug information.
#include <cxxabi.h>
#include <elfutils/libdw.h>
#include <fcntl.h>
#include <gelf.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "programs/team/names.h"

namespace programs {

namespace {

/// A program's file, open.
struct Opened {
  int fd;
  Dwarf* dwarf = nullptr;
  Elf* elf = nullptr;

  explicit Opened(const std::string& path) : fd(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    elf_version(EV_CURRENT);
    if (fd < 0) return;
    elf = elf_begin(fd, ELF_C_READ_MMAP, nullptr);
    dwarf = dwarf_begin(fd, DWARF_C_READ);
  }
  ~Opened() {
    if (dwarf) dwarf_end(dwarf);
    if (elf) elf_end(elf);
    if (fd >= 0) close(fd);
  }
  Opened(const Opened&) = delete;
};

std::string function_at(Elf* elf, std::uintptr_t address) {
  Elf_Scn* section = nullptr;
  while (elf && (section = elf_nextscn(elf, section))) {
    GElf_Shdr header;
    if (!gelf_getshdr(section, &header) || header.sh_type != SHT_SYMTAB || header.sh_entsize == 0) continue;
    Elf_Data* data = elf_getdata(section, nullptr);
    for (std::size_t i = 0; i < header.sh_size / header.sh_entsize; ++i) {
      GElf_Sym s;
      if (gelf_getsym(data, static_cast<int>(i), &s) && GELF_ST_TYPE(s.st_info) == STT_FUNC &&
          address >= s.st_value && address < s.st_value + s.st_size)
        return elf_strptr(elf, header.sh_link, s.st_name);
    }
  }
  return "";
}

/// The compilation unit that holds an address (clang writes no table of them).
bool unit_of(Dwarf* dwarf, std::uintptr_t address, Dwarf_Die* unit) {
  Dwarf_Off offset = 0, next;
  std::size_t header;
  while (dwarf_nextcu(dwarf, offset, &next, &header, nullptr, nullptr, nullptr) == 0) {
    if (dwarf_offdie(dwarf, offset + header, unit) && dwarf_haspc(unit, address) > 0) return true;
    offset = next;
  }
  return false;
}

host::Place place_in(const std::string& path, std::uintptr_t address) {
  const Opened program(path);
  host::Place place;
  place.function = function_at(program.elf, address);
  Dwarf_Die unit;
  if (!program.dwarf || !unit_of(program.dwarf, address, &unit)) return place;
  Dwarf_Line* line = dwarf_getsrc_die(&unit, address);
  if (!line) return place;
  const char* file = dwarf_linesrc(line, nullptr, nullptr);
  dwarf_lineno(line, &place.line);
  if (file) place.file = file;
  // compiler-made code carries line 0: the nearest earlier real line says more
  for (std::uintptr_t back = 1; place.line == 0 && back < 64; ++back) {
    line = dwarf_getsrc_die(&unit, address - back);
    if (line) dwarf_lineno(line, &place.line);
  }
  return place;
}

}  // namespace

host::Place place_of_crash(const link_record& record) {
  const std::string file(record.texts[0].bytes, record.texts[0].size),
      function(record.texts[1].bytes, record.texts[1].size);
  host::Place place = place_in(file, static_cast<std::uintptr_t>(record.ints[1]));
  if (place.function.empty()) place.function = function;
  // as the program writes it
  int wrong = 0;
  if (char* readable = abi::__cxa_demangle(place.function.c_str(), nullptr, nullptr, &wrong)) {
    place.function = readable;
    std::free(readable);
  }
  return place;
}

}  // namespace programs
