// SPDX-License-Identifier: MIT
#include "hal_sim/host/symbols.h"

#include <elfutils/libdw.h>
#include <fcntl.h>
#include <gelf.h>
#include <unistd.h>

#include <cstring>
#include <mutex>

namespace host {

namespace {
std::mutex reading;  // libdw is not thread-safe; traps are rare

// calls visit(name, symbol) for every symbol until it returns true
template <typename Visit>
bool visit_symbols(Elf* elf, Visit visit) {
  Elf_Scn* section = nullptr;
  while ((section = elf_nextscn(elf, section))) {
    GElf_Shdr header;
    if (!gelf_getshdr(section, &header) || header.sh_type != SHT_SYMTAB || header.sh_entsize == 0) continue;
    Elf_Data* data = elf_getdata(section, nullptr);
    for (std::size_t i = 0; i < header.sh_size / header.sh_entsize; ++i) {
      GElf_Sym symbol;
      if (!gelf_getsym(data, static_cast<int>(i), &symbol)) continue;
      if (visit(elf_strptr(elf, header.sh_link, symbol.st_name), symbol)) return true;
    }
  }
  return false;
}

std::string function_symbol(Elf* elf, std::uintptr_t address) {
  std::string found = "?";
  visit_symbols(elf, [&](const char* name, const GElf_Sym& s) {
    if (GELF_ST_TYPE(s.st_info) != STT_FUNC || address < s.st_value || address >= s.st_value + s.st_size)
      return false;
    found = name;
    return true;
  });
  return found;
}
// the compilation unit that holds an address (clang writes no table of them)
bool unit_of(Dwarf* dwarf, std::uintptr_t address, Dwarf_Die* unit) {
  Dwarf_Off offset = 0, next;
  std::size_t header;
  while (dwarf_nextcu(dwarf, offset, &next, &header, nullptr, nullptr, nullptr) == 0) {
    if (dwarf_offdie(dwarf, offset + header, unit) && dwarf_haspc(unit, address) > 0) return true;
    offset = next;
  }
  return false;
}
}  // namespace

std::string to_string(const Place& place) {
  if (place.line == 0) return place.function;
  return place.function + " (" + place.file + ":" + std::to_string(place.line) + ")";
}

struct Symbols::Reader {
  int fd;
  Dwarf* dwarf = nullptr;
  Elf* elf = nullptr;

  explicit Reader(const std::string& path) : fd(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    elf_version(EV_CURRENT);
    if (fd < 0) return;
    elf = elf_begin(fd, ELF_C_READ_MMAP, nullptr);
    dwarf = dwarf_begin(fd, DWARF_C_READ);
  }
  ~Reader() {
    if (dwarf) dwarf_end(dwarf);
    if (elf) elf_end(elf);
    if (fd >= 0) close(fd);
  }
};

Symbols::Symbols(std::string path) : path_(std::move(path)) {}
Symbols::~Symbols() = default;

Place Symbols::find(std::uintptr_t address) const {
  std::lock_guard<std::mutex> lock(reading);
  if (!reader_) reader_ = std::make_unique<Reader>(path_);
  Place place;
  place.function = reader_->elf ? function_symbol(reader_->elf, address) : "?";
  Dwarf_Die unit;
  if (!reader_->dwarf || !unit_of(reader_->dwarf, address, &unit)) return place;
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

const Variable* Symbols::find_variable(const std::string& expression, std::string& error) const {
  std::lock_guard<std::mutex> lock(reading);
  const auto known = variables_.find(expression);
  if (known != variables_.end()) return &known->second;
  if (!reader_) reader_ = std::make_unique<Reader>(path_);
  Variable found;
  error = host::find_variable(reader_->dwarf, expression, found);
  if (!error.empty()) return nullptr;
  return &variables_.emplace(expression, found).first->second;
}

bool Symbols::find_object(const std::string& name, std::uintptr_t& address, std::size_t& bytes) const {
  std::lock_guard<std::mutex> lock(reading);
  if (!reader_) reader_ = std::make_unique<Reader>(path_);
  if (!reader_->elf) return false;
  return visit_symbols(reader_->elf, [&](const char* symbol, const GElf_Sym& s) {
    if (GELF_ST_TYPE(s.st_info) != STT_OBJECT || name != symbol) return false;
    address = s.st_value;
    bytes = s.st_size;
    return true;
  });
}

}  // namespace host
