// SPDX-License-Identifier: MIT
#include <gelf.h>
#include <libelf.h>

#include <memory>

#include "dspic30/load/firmware_file.h"
#include "dspic30/memory/hex.h"
#include "dspic30/memory/host_places.h"

namespace dspic {

namespace {

constexpr unsigned kMachine = 118, kDevice = 31;  // EM_DSPIC30F; the 6014A's number in e_flags
constexpr std::uint32_t kPsv = 1u << 28, kEeprom = 1u << 29, kNoLoad = 1u << 23;
constexpr std::uint32_t kOctetsAWord = 4;

struct Closer {
  void operator()(Elf* elf) const { elf_end(elf); }
};

class ElfReader {
 public:
  ElfReader(const std::string& name, FirmwareFile& file) : name_(name), file_(file) {}

  bool read(std::string bytes, std::string& error) {
    elf_version(EV_CURRENT);
    elf_.reset(elf_memory(bytes.data(), bytes.size()));
    if (!elf_ || elf_kind(elf_.get()) != ELF_K_ELF) fail("not an ELF file that can be read: " + why());
    if (error_.empty()) check_header(bytes.size());
    for (Elf_Scn* s = nullptr; error_.empty() && (s = elf_nextscn(elf_.get(), s));) read_section(s);
    if (error_.empty() && file_.words.empty()) fail("there is no program in it");
    file_.code.sort();
    error = error_;
    elf_.reset();
    const auto kept = std::make_shared<std::string>(std::move(bytes));
    LineTable lines;
    lines.moved_from = file_.code.moved_from;
    lines.moved_to = file_.code.moved_to;
    file_.code.late_lines.keep(kept, std::move(lines));
    file_.debug.keep(kept);
    return error_.empty();
  }

 private:
  void fail(const std::string& what) {
    if (error_.empty()) error_ = name_ + ": " + what;
  }
  static std::string why() {
    const char* text = elf_errmsg(-1);
    return text ? text : "unknown reason";
  }

  void check_header(std::size_t size) {
    GElf_Ehdr head;
    if (!gelf_getehdr(elf_.get(), &head)) return fail("its header cannot be read: " + why());
    if (head.e_ident[EI_CLASS] != ELFCLASS32 || head.e_ident[EI_DATA] != ELFDATA2LSB ||
        head.e_machine != kMachine)
      return fail("machine: got " + std::to_string(head.e_machine) + ", expected " +
                  std::to_string(kMachine) + " (dsPIC30F, 32 bits, little-endian)");
    if (head.e_type != ET_EXEC) return fail("it is no linked program (an object file?)");
    const unsigned device = head.e_flags & 0xFFFF;
    if (device != 0 && device != kDevice)
      return fail("device: got number " + std::to_string(device) + ", expected " + std::to_string(kDevice) +
                  " (30F6014A)");
    if (head.e_shoff == 0 || head.e_shoff > size)
      return fail("its table of sections lies outside of the file; is it cut off?");
  }

  void read_section(Elf_Scn* section) {
    GElf_Shdr head;
    if (!gelf_getshdr(section, &head)) return fail("a section's header cannot be read: " + why());
    if (head.sh_type == SHT_SYMTAB) return read_symbols(section, head);
    const bool is_program = (head.sh_flags & (SHF_EXECINSTR | kPsv | kEeprom)) != 0;
    if (head.sh_type != SHT_PROGBITS || !(head.sh_flags & SHF_ALLOC) || !is_program ||
        (head.sh_flags & kNoLoad) || head.sh_size == 0)
      return;
    Elf_Data* data = elf_getdata(section, nullptr);
    if (!data || !data->d_buf || data->d_size != head.sh_size)
      return fail("a section's bytes are missing; is the file cut off?");
    put(static_cast<const unsigned char*>(data->d_buf), data->d_size, program_address(head));
  }

  // constants say where they are seen; the segment says where they lie
  std::uint64_t program_address(const GElf_Shdr& section) {
    if (!(section.sh_flags & kPsv)) return section.sh_addr;
    std::size_t count = 0;
    elf_getphdrnum(elf_.get(), &count);
    for (std::size_t i = 0; i < count; ++i) {
      GElf_Phdr segment;
      if (!gelf_getphdr(elf_.get(), static_cast<int>(i), &segment) || segment.p_type != PT_LOAD) continue;
      if (section.sh_offset >= segment.p_offset && section.sh_offset - segment.p_offset < segment.p_filesz)
        return segment.p_paddr + (section.sh_offset - segment.p_offset) / 2;
    }
    fail("a section of constants lies in no segment");
    return 0;
  }

  void put(const unsigned char* bytes, std::size_t size, std::uint64_t address) {
    for (std::size_t i = 0; i + kOctetsAWord <= size && error_.empty(); i += kOctetsAWord, address += 2) {
      if (address > 0xFFFFFF || (address & 1) || !is_program_memory(static_cast<std::uint32_t>(address)))
        return fail("program address " + hex(address) + " is in no memory of this chip");
      const std::uint32_t word = bytes[i] | bytes[i + 1] << 8 | bytes[i + 2] << 16;
      const std::size_t before = file_.words.size();
      file_.words.emplace_hint(file_.words.end(), static_cast<std::uint32_t>(address), word);
      if (file_.words.size() == before) return fail("two sections lie at program address " + hex(address));
    }
  }

  void read_symbols(Elf_Scn* section, const GElf_Shdr& head) {
    Elf_Data* data = elf_getdata(section, nullptr);
    if (!data || head.sh_entsize == 0) return;
    for (std::size_t i = 0; i < head.sh_size / head.sh_entsize; ++i) {
      GElf_Sym symbol;
      if (!gelf_getsym(data, static_cast<int>(i), &symbol)) return;
      const char* name = elf_strptr(elf_.get(), head.sh_link, symbol.st_name);
      if (name && symbol.st_shndx == SHN_ABS && std::string(name).rfind("_tp_", 0) == 0)
        file_.marks[name] = static_cast<std::uint32_t>(symbol.st_value);
      if (!name || !*name || symbol.st_shndx == SHN_UNDEF || symbol.st_shndx >= SHN_LORESERVE) continue;
      const int type = GELF_ST_TYPE(symbol.st_info);
      GElf_Shdr home;
      Elf_Scn* at = elf_getscn(elf_.get(), symbol.st_shndx);
      if (!at || !gelf_getshdr(at, &home) || type == STT_SECTION || type == STT_FILE) continue;
      // C names have an underscore before them
      const std::string plain = name[0] == '_' ? name + 1 : name;
      const auto value = static_cast<std::uint32_t>(symbol.st_value);
      if (!(home.sh_flags & SHF_EXECINSTR)) {
        file_.objects[plain] = value;
        if (symbol.st_size > 0) file_.object_bytes[plain] = static_cast<std::uint32_t>(symbol.st_size);
        continue;
      }
      file_.functions[plain] = value;
      // a local label of assembler text is a place within a function
      if (type == STT_FUNC || GELF_ST_BIND(symbol.st_info) != STB_LOCAL)
        file_.code.functions.push_back(
            {value, static_cast<std::uint32_t>(home.sh_addr + home.sh_size / kOctetsAWord * 2), plain});
    }
  }

  const std::string& name_;
  FirmwareFile& file_;
  std::unique_ptr<Elf, Closer> elf_;
  std::string error_;
};

}  // namespace

int source_of(const FirmwareFile& file, const DebugInfo::Function& function) {
  const auto& units = file.code.lines().unit_files;
  const auto unit = units.find(function.unit);
  const bool is_known = unit != units.end() && function.file > 0 && function.file <= unit->second.size();
  return is_known ? unit->second[function.file - 1] : -1;
}

std::string hal_of(const FirmwareFile& file) {
  const auto mark = file.marks.find(kHalSymbol);
  return mark == file.marks.end() ? "own" : mark->second ? "sim" : "dspic";
}

std::uint32_t host_table_of(const FirmwareFile& file) {
  const auto mark = file.marks.find(kHostTableSymbol);
  return mark == file.marks.end() ? 0 : mark->second;
}

std::uint32_t place_of_host_call(const FirmwareFile& file) {
  constexpr std::uint32_t kGoto = 0x040000;
  for (auto at = file.words.begin(); at != file.words.end(); ++at) {
    const auto next = std::next(at);
    if ((at->second & 0xFF0000) != kGoto || next == file.words.end() || next->first != at->first + 2)
      continue;
    if (is_host_place(next->second << 16 | (at->second & 0xFFFF))) return at->first;
  }
  return kNoPlace;
}

FileKind kind_of(const std::string& bytes) {
  if (bytes.compare(0, 4,
                    "\x7f"
                    "ELF") == 0) {
    // a program for another machine is no image of the chip
    const bool is_chips =
        bytes.size() > 19 && static_cast<unsigned char>(bytes[18]) == kMachine && bytes[19] == 0;
    return is_chips ? FileKind::Elf : FileKind::Other;
  }
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string::npos && bytes[first] == ':' ? FileKind::Hex : FileKind::Other;
}

namespace {

bool is_coff(const std::string& bytes) { return bytes.compare(0, 2, "\x36\x12") == 0; }

/// Of a file that is no image, for people.
std::string what_is(const std::string& bytes) {
  if (bytes.empty()) return "an empty file";
  if (is_coff(bytes)) return "a COFF of the dsPIC, as MPLAB C30 made by default";
  if (bytes.compare(0, 4, ELFMAG) != 0) return "a file that is neither Intel HEX nor ELF";
  constexpr unsigned char kThisPc[] = {EM_X86_64, 0};
  if (bytes.size() < 20) return "an ELF file that has been cut off";
  if (static_cast<unsigned char>(bytes[18]) == kThisPc[0] && bytes[19] == 0)
    return "a program or library of this PC";
  return "an ELF file of another machine (number " +
         std::to_string(static_cast<unsigned char>(bytes[18]) | static_cast<unsigned char>(bytes[19]) << 8) +
         ")";
}

}  // namespace

bool load_elf(const std::string& bytes, const std::string& name, FirmwareFile& file, std::string& error) {
  return ElfReader(name, file).read(bytes, error);
}

bool load_firmware(const std::string& bytes, const std::string& name, FirmwareFile& file,
                   std::string& error) {
  switch (kind_of(bytes)) {
    case FileKind::Hex:
      if (!load_hex(bytes, name, file, error)) return false;
      find_functions(file);
      return true;
    case FileKind::Elf:
      return load_elf(bytes, name, file, error);
    default:
      error = name + ": firmware image: got " + what_is(bytes) + ", expected the .hex or .elf of a dsPIC30F" +
              (is_coff(bytes) ? "; take the .hex that was made beside it"
                              : "; name the program's folder, or build it");
      return false;
  }
}

}  // namespace dspic
