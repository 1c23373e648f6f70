// SPDX-License-Identifier: MIT
// Relocations: [System V ABI, AMD64 supplement, 4.4]. An image has four kinds; whatever would run code before
// the program is told to (constructors, indirect functions) is refused.
#include "hal_sim/host/image_memory.h"

#include <dlfcn.h>
#include <elf.h>
#include <sys/mman.h>

#include <cstring>

#include "sim_core/base/check.h"

/// For debuggers: scripts/firmware.gdb stops here and reads the symbols.
extern "C" __attribute__((noinline, used)) void twinpuck_image_loaded(const char* path, const void* base) {
  asm volatile("" : : "r"(path), "r"(base) : "memory");
}

namespace host {

namespace {

constexpr std::size_t kImageOffset = 0x1000'0000;  // in the slot: where images begin
constexpr std::uintptr_t kPage = 4096;

std::uintptr_t page_down(std::uintptr_t a) { return a & ~(kPage - 1); }
std::uintptr_t page_up(std::uintptr_t a) { return page_down(a + kPage - 1); }

/// The headers of a shared object; every look is checked against the file's end.
class File {
 public:
  explicit File(const std::string& bytes) : bytes_(bytes) {}
  template <typename T>
  bool read(std::uint64_t at, T& to) const {
    if (at > bytes_.size() || bytes_.size() - at < sizeof to) return false;
    std::memcpy(&to, bytes_.data() + at, sizeof to);
    return true;
  }
  template <typename T>
  std::vector<T> table(std::uint64_t at, std::uint64_t bytes) const {
    std::vector<T> entries;
    T entry;
    for (std::uint64_t i = 0; i < bytes / sizeof(T) && read(at + i * sizeof(T), entry); ++i)
      entries.push_back(entry);
    return entries;
  }
  const char* text(std::uint64_t at) const {  // the file ends in a stamp, so a text has an end
    return at < bytes_.size() ? bytes_.data() + at : "";
  }
  std::vector<Elf64_Phdr> segments() const {
    Elf64_Ehdr head{};
    if (!read(0, head)) return {};
    return table<Elf64_Phdr>(head.e_phoff, head.e_phnum * sizeof(Elf64_Phdr));
  }
  std::vector<Elf64_Shdr> sections() const {
    Elf64_Ehdr head{};
    if (!read(0, head)) return {};
    return table<Elf64_Shdr>(head.e_shoff, head.e_shnum * sizeof(Elf64_Shdr));
  }

 private:
  const std::string& bytes_;
};

}  // namespace

ImageMemory::ImageMemory(std::size_t bytes) : slot_(AddressSlot::Kind::Image, kImageOffset, bytes) {}
ImageMemory::~ImageMemory() = default;

std::unique_ptr<ImageMemory> ImageMemory::load(const std::string& file, const std::string& path,
                                               std::string& error) {
  std::uintptr_t end = 0;
  for (const Elf64_Phdr& segment : File(file).segments()) {
    if (segment.p_type != PT_LOAD) continue;
    if (segment.p_offset > file.size() || segment.p_filesz > file.size() - segment.p_offset ||
        segment.p_filesz > segment.p_memsz || segment.p_vaddr + segment.p_memsz > kImageOffset) {
      error = "a segment that does not fit";
      return nullptr;
    }
    end = std::max(end, page_up(segment.p_vaddr + segment.p_memsz));
  }
  if (end == 0) {
    error = "a shared object without a segment";
    return nullptr;
  }
  std::unique_ptr<ImageMemory> image(new ImageMemory(end));
  if (!image->fill(file, error)) return nullptr;
  twinpuck_image_loaded(path.c_str(), reinterpret_cast<const void*>(image->base()));
  return image;
}

bool ImageMemory::fill(const std::string& bytes, std::string& error) {
  const File file(bytes);
  char* const memory = reinterpret_cast<char*>(base());
  const auto allow = [&](std::uintptr_t from, std::uintptr_t to, int access) {
    CHECK(mprotect(reinterpret_cast<void*>(base() + page_down(from)), page_up(to) - page_down(from),
                   access) == 0,
          "cannot set the access of an image's pages");
  };
  // contents first, all writable
  const std::vector<Elf64_Phdr> segments = file.segments();
  for (const Elf64_Phdr& s : segments) {
    if (s.p_type != PT_LOAD) continue;
    allow(s.p_vaddr, s.p_vaddr + s.p_memsz, PROT_READ | PROT_WRITE);
    std::memcpy(memory + s.p_vaddr, bytes.data() + s.p_offset, s.p_filesz);
  }
  // names: those it offers, and those it needs
  std::vector<std::uintptr_t> addresses;
  std::vector<Elf64_Rela> relocations;
  for (const Elf64_Shdr& section : file.sections()) {
    if (!(section.sh_flags & SHF_ALLOC)) continue;
    if ((section.sh_type == SHT_INIT_ARRAY || section.sh_type == SHT_PREINIT_ARRAY) && section.sh_size > 0) {
      error = "a function with the attribute constructor, which nobody calls on the chip";
      return false;
    }
    if (section.sh_type == SHT_RELA)
      for (const auto& r : file.table<Elf64_Rela>(section.sh_offset, section.sh_size))
        relocations.push_back(r);
    if (section.sh_type != SHT_DYNSYM) continue;
    const std::vector<Elf64_Shdr> all = file.sections();
    if (section.sh_link >= all.size()) return error = "a symbol table without names", false;
    for (const Elf64_Sym& s : file.table<Elf64_Sym>(section.sh_offset, section.sh_size)) {
      const char* name = file.text(all[section.sh_link].sh_offset + s.st_name);
      std::uintptr_t address = 0;
      if (ELF64_ST_TYPE(s.st_info) == STT_GNU_IFUNC || ELF64_ST_TYPE(s.st_info) == STT_TLS) {
        error = std::string("'") + name + "', a kind of symbol that firmware has not";
        return false;
      }
      if (s.st_shndx != SHN_UNDEF) {
        address = base() + s.st_value;
        exports_.push_back({name, address});
      } else if (*name) {
        address = reinterpret_cast<std::uintptr_t>(dlsym(RTLD_DEFAULT, name));
        if (!address && ELF64_ST_BIND(s.st_info) != STB_WEAK) {
          error = std::string("undefined symbol: ") + name;
          return false;
        }
      }
      addresses.push_back(address);
    }
  }
  for (const Elf64_Rela& r : relocations) {
    const std::uint64_t type = ELF64_R_TYPE(r.r_info), symbol = ELF64_R_SYM(r.r_info);
    std::uintptr_t value = static_cast<std::uintptr_t>(r.r_addend);
    if (type == R_X86_64_NONE) continue;
    if (type == R_X86_64_RELATIVE) {
      value += base();
    } else if ((type == R_X86_64_64 || type == R_X86_64_GLOB_DAT || type == R_X86_64_JUMP_SLOT) &&
               symbol < addresses.size()) {
      if (type != R_X86_64_64) value = 0;
      value += addresses[symbol];
    } else {
      error = "a relocation of kind " + std::to_string(type) + ", which firmware has not";
      return false;
    }
    bool is_inside = false;
    for (const Elf64_Phdr& s : segments)
      is_inside = is_inside || (s.p_type == PT_LOAD && r.r_offset >= s.p_vaddr &&
                                r.r_offset + sizeof value <= s.p_vaddr + s.p_memsz);
    if (!is_inside) return error = "a relocation outside of its segments", false;
    std::memcpy(memory + r.r_offset, &value, sizeof value);
  }
  // then what each segment allows
  for (const Elf64_Phdr& s : segments) {
    if (s.p_type != PT_LOAD) continue;
    allow(s.p_vaddr, s.p_vaddr + s.p_memsz,
          (s.p_flags & PF_R ? PROT_READ : 0) | (s.p_flags & PF_W ? PROT_WRITE : 0) |
              (s.p_flags & PF_X ? PROT_EXEC : 0));
    if (!(s.p_flags & PF_X)) continue;
    code_begin_ = base() + s.p_vaddr;
    code_end_ = code_begin_ + s.p_memsz;
  }
  for (const Elf64_Phdr& s : segments)
    if (s.p_type == PT_GNU_RELRO && page_down(s.p_vaddr + s.p_memsz) > s.p_vaddr)
      allow(s.p_vaddr, page_down(s.p_vaddr + s.p_memsz), PROT_READ);
  return true;
}

void* ImageMemory::symbol(const char* name) const {
  for (const Export& e : exports_)
    if (e.name == name) return reinterpret_cast<void*>(e.address);
  return nullptr;
}

}  // namespace host
