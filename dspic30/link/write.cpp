// SPDX-License-Identifier: MIT
// The image as files: Intel HEX and ELF in the vendor's manner, which the simulator, debuggers
// and programmers read.
#include <elf.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "dspic30/link/link.h"
#include "dspic30/link/memory_spaces.h"

namespace dspic::link {

namespace {

constexpr unsigned kMachine = 118;  // EM_DSPIC30F
constexpr unsigned kFlags = 31;     // machine number of the 30F6014A
constexpr std::uint32_t kEntry = 0x100;

// --- Intel HEX: four octets a word, at twice its address

void record(std::string& out, unsigned type, unsigned address, const std::vector<std::uint8_t>& data) {
  char text[16];
  std::snprintf(text, sizeof text, ":%02X%04X%02X", unsigned(data.size()), address & 0xFFFF, type);
  out += text;
  unsigned sum = unsigned(data.size()) + (address >> 8 & 0xFF) + (address & 0xFF) + type;
  for (const std::uint8_t b : data) {
    std::snprintf(text, sizeof text, "%02X", b);
    out += text;
    sum += b;
  }
  std::snprintf(text, sizeof text, "%02X\n", -sum & 0xFF);
  out += text;
}

std::string hex_file(const Program& program) {
  constexpr std::size_t kLine = 16;
  std::string out;
  // the first record says where the first data go: an uploader may know no place before one of them
  std::uint32_t upper = ~0u, begin = 0;
  std::vector<std::uint8_t> line;
  const auto flush = [&] {
    if (!line.empty()) record(out, 0, begin, line);
    line.clear();
  };
  for (const auto& [address, word] : program.words) {
    const std::uint32_t at = 2 * address;
    if (at >> 16 != upper) {
      flush();
      upper = at >> 16;
      record(out, 4, 0, {std::uint8_t(upper >> 8), std::uint8_t(upper)});
    }
    if (line.size() == kLine || (!line.empty() && at != begin + line.size())) flush();
    if (line.empty()) begin = at;
    for (int i = 0; i < 4; ++i) line.push_back(i < 3 ? std::uint8_t(word >> 8 * i) : 0);
  }
  flush();
  record(out, 1, 0, {});
  return out;
}

// --- ELF: addresses are the chip's, and each takes two octets of the file

class ElfFile {
 public:
  explicit ElfFile(const Program& program) : program_(program) {}

  std::string make() {
    bytes_.resize(sizeof(Elf32_Ehdr));
    add("", SHT_NULL, 0, 0, 0, "");
    add_flash();
    add_ram();
    for (const char* name :
         {".debug_info", ".debug_abbrev", ".debug_line", ".debug_str", ".debug_ranges", ".debug_loc",
          ".debug_frame", ".debug_aranges", ".debug_pubnames", ".debug_pubtypes"})
      add_debug(name);
    add_symbols();
    finish();
    return bytes_;
  }

 private:
  std::uint32_t add(const std::string& name, unsigned type, std::uint32_t flags, std::uint32_t address,
                    std::uint32_t load, const std::string& content, std::uint32_t size = 0) {
    while (bytes_.size() % 4) bytes_ += '\0';
    Elf32_Shdr h{};
    h.sh_name = std::uint32_t(names_.size());
    names_ += name + '\0';
    h.sh_type = type;
    h.sh_flags = flags;
    h.sh_addr = address;
    h.sh_offset = std::uint32_t(bytes_.size());
    h.sh_size = type == SHT_NOBITS ? size : std::uint32_t(content.size());
    h.sh_addralign = type == SHT_NULL ? 0 : 1;
    sections_.push_back(h);
    bytes_ += content;
    if (flags & SHF_ALLOC && type == SHT_PROGBITS) segments_.push_back({address, load, sections_.size() - 1});
    return std::uint32_t(sections_.size() - 1);
  }

  /// Each run of words without a gap is a section.
  void add_flash() {
    std::uint32_t first = 0, next = ~0u;
    std::string content;
    const auto flush = [&] {
      if (content.empty()) return;
      const bool is_configuration = first >= 0xF80000, is_eeprom = first >= 0x7FF000 && !is_configuration;
      const char* name = first == 0         ? ".reset"
                         : is_configuration ? ".config"
                         : is_eeprom        ? ".eedata"
                         : first < 0x100    ? ".ivt"
                                            : ".text";
      const std::uint32_t flags =
          SHF_ALLOC | (is_eeprom ? unsigned(llvm::dspic_elf::kEeprom) : unsigned(SHF_EXECINSTR));
      add(name, SHT_PROGBITS, flags, first, first, content);
      content.clear();
    };
    for (const auto& [address, word] : program_.words) {
      if (address != next) {
        flush();
        first = address;
      }
      for (int i = 0; i < 4; ++i) content += i < 3 ? char(word >> 8 * i) : '\0';
      next = address + 2;
    }
    flush();
  }

  void add_ram() {
    std::uint32_t least = ~0u, most = 0;
    for (const Section& s : program_.sections)
      if (s.used && s.kind == Kind::Ram)
        least = std::min(least, s.address), most = std::max(most, s.address + s.size);
    if (least < most) add(".bss", SHT_NOBITS, SHF_ALLOC | SHF_WRITE, least, 0, "", 2 * (most - least));
  }

  void add_debug(const std::string& name) {
    std::string content;
    for (const Section& s : program_.sections)
      if (s.kind == Kind::Debug && s.name == name) content.append(s.bytes.begin(), s.bytes.end());
    if (!content.empty()) add(name, SHT_PROGBITS, 0, 0, 0, content);
  }

  void add_symbols() {
    std::string table(sizeof(Elf32_Sym), '\0'), names(1, '\0');
    const auto put = [&](const Symbol& s, unsigned binding) {
      if (!s.is_defined || s.name.empty() ||
          (s.section && (!s.section->used || s.section->kind == Kind::Debug)))
        return;
      Elf32_Sym e{};
      e.st_name = std::uint32_t(names.size());
      names += s.name + '\0';
      e.st_value = program_.address_of(s);
      e.st_size = s.size;
      const unsigned type = s.is_function                                ? STT_FUNC
                            : s.section && s.section->kind != Kind::Code ? STT_OBJECT
                                                                         : STT_NOTYPE;
      e.st_info = ELF32_ST_INFO(binding, type);
      e.st_shndx = s.section ? home_of(*s.section) : std::uint16_t(SHN_ABS);
      table.append(reinterpret_cast<const char*>(&e), sizeof e);
    };
    for (const Symbol& s : program_.symbols)
      if (!is_global(s)) put(s, STB_LOCAL);
    const auto locals = std::uint32_t(table.size() / sizeof(Elf32_Sym));
    for (const auto& [name, s] : program_.globals) put(*s, STB_GLOBAL);
    const auto strings = std::uint32_t(sections_.size() + 1);
    const auto at = add(".symtab", SHT_SYMTAB, 0, 0, 0, table);
    sections_[at].sh_link = strings;
    sections_[at].sh_info = locals;
    sections_[at].sh_entsize = sizeof(Elf32_Sym);
    add(".strtab", SHT_STRTAB, 0, 0, 0, names);
  }
  /// The section of the file in which a section of the program has come to lie.
  std::uint16_t home_of(const Section& s) const {
    const std::uint32_t at = s.kind == Kind::Code ? s.address : s.load;
    for (std::size_t i = 0; i < sections_.size(); ++i) {
      const Elf32_Shdr& h = sections_[i];
      if (!(h.sh_flags & SHF_ALLOC) || (h.sh_type == SHT_NOBITS) != (s.kind == Kind::Ram)) continue;
      if (s.kind == Kind::Ram || (at >= h.sh_addr && at < h.sh_addr + h.sh_size / 2)) return std::uint16_t(i);
    }
    return SHN_ABS;
  }
  bool is_global(const Symbol& s) const {
    const auto it = program_.globals.find(s.name);
    return it != program_.globals.end() && it->second == &s;
  }

  void finish() {
    const auto names = std::uint32_t(sections_.size());
    names_ += std::string(".shstrtab") + '\0';
    add("", SHT_STRTAB, 0, 0, 0, names_);
    sections_[names].sh_name = std::uint32_t(names_.size() - sizeof ".shstrtab" - 1);
    while (bytes_.size() % 4) bytes_ += '\0';
    // The head is known last: where the tables lie, and how many there are.
    Elf32_Ehdr h{};
    std::memcpy(h.e_ident, ELFMAG, SELFMAG);
    h.e_ident[EI_CLASS] = ELFCLASS32;
    h.e_ident[EI_DATA] = ELFDATA2LSB;
    h.e_ident[EI_VERSION] = EV_CURRENT;
    h.e_type = ET_EXEC;
    h.e_machine = kMachine;
    h.e_version = EV_CURRENT;
    h.e_entry = kEntry;
    h.e_flags = kFlags;
    h.e_ehsize = sizeof h;
    h.e_phentsize = sizeof(Elf32_Phdr);
    h.e_shentsize = sizeof(Elf32_Shdr);
    h.e_phoff = std::uint32_t(bytes_.size());
    for (const auto& s : segments_) {
      Elf32_Phdr p{};
      p.p_type = PT_LOAD;
      p.p_offset = sections_[s.section].sh_offset;
      p.p_vaddr = s.address;
      p.p_paddr = s.load;
      p.p_filesz = p.p_memsz = sections_[s.section].sh_size;
      p.p_flags = PF_R | PF_X;
      bytes_.append(reinterpret_cast<const char*>(&p), sizeof p);
      ++h.e_phnum;
    }
    h.e_shoff = std::uint32_t(bytes_.size());
    h.e_shnum = std::uint16_t(sections_.size());
    h.e_shstrndx = std::uint16_t(names);
    for (const auto& s : sections_) bytes_.append(reinterpret_cast<const char*>(&s), sizeof s);
    bytes_.replace(0, sizeof h, reinterpret_cast<const char*>(&h), sizeof h);
  }

  struct Segment {
    std::uint32_t address, load;
    std::size_t section;
  };
  const Program& program_;
  std::string bytes_, names_;
  std::vector<Elf32_Shdr> sections_;
  std::vector<Segment> segments_;
};

bool write_file(Program& program, const std::string& path, const std::string& content) {
  std::ofstream out(path, std::ios::binary);
  out << content;
  out.close();
  if (!out)
    program.errors.push_back(path + ": output: got " + std::strerror(errno) +
                             ", expected a file that can be written");
  return bool(out);
}

}  // namespace

bool write_all(Program& program, const Options& options) {
  const std::string stem = options.output.substr(0, options.output.rfind('.'));
  bool is_written = write_file(program, options.output, ElfFile(program).make());
  // no chip could run the other
  if (!options.is_filled_by_host)
    is_written = is_written && write_file(program, stem + ".hex", hex_file(program));
  if (options.with_texts)
    is_written = is_written && write_file(program, stem + ".lst", listing(program, options)) &&
                 write_file(program, stem + ".map", map_file(program));
  return is_written;
}

}  // namespace dspic::link
