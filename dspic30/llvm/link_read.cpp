// SPDX-License-Identifier: MIT
// Objects and archives in. A library's object is read when it defines what is undefined so far.
#include "dspic30/llvm/fixups.h"
#include "dspic30/llvm/link.h"
#include "dspic30/llvm/memory_spaces.h"
#include "dspic30/memory/sfr_table.h"
#include "llvm/Object/Archive.h"
#include "llvm/Object/ELF.h"
#include "llvm/Support/MemoryBuffer.h"

namespace dspic::link {

using namespace llvm;
using Elf = object::ELFFile<object::ELF32LE>;

Symbol* Program::global(const std::string& name) {
  Symbol*& symbol = globals[name];
  if (!symbol) {
    symbol = &symbols.emplace_back();
    symbol->name = name;
  }
  return symbol;
}

void Program::define(const std::string& name, std::uint32_t value) {
  Symbol* s = global(name);
  s->is_defined = true;
  s->value = value;
}

namespace {

struct Member {
  std::string name;
  StringRef bytes;
  bool is_taken = false, is_of_library = false;
};

class Reader {
 public:
  explicit Reader(Program& program) : program_(program) {}

  std::map<std::string, std::string> rename;  ///< of what objects ask for

  bool open(const std::string& path, std::vector<Member>& members) {
    auto buffer = MemoryBuffer::getFile(path);
    if (!buffer) return problem(path, buffer.getError().message());
    const StringRef bytes = (*buffer)->getBuffer();
    buffers_.push_back(std::move(*buffer));
    if (!bytes.startswith("!<arch>\n")) {
      members.push_back({path, bytes});
      return true;
    }
    auto archive = object::Archive::create(MemoryBufferRef(bytes, path));
    if (!archive) return problem(path, toString(archive.takeError()));
    Error error = Error::success();
    for (const auto& child : (*archive)->children(error)) {
      auto name = child.getName();
      auto data = child.getBuffer();
      if (!name || !data) {
        if (!name) consumeError(name.takeError());
        if (!data) consumeError(data.takeError());
        return problem(path, "damaged archive");
      }
      members.push_back({path + "(" + name->str() + ")", *data});
    }
    archives_.push_back(std::move(*archive));
    return error ? problem(path, toString(std::move(error))) : true;
  }

  bool take(Member& member) {
    member.is_taken = true;
    auto elf = Elf::create(member.bytes);
    if (!elf) return problem(member.name, toString(elf.takeError()));
    if (elf->getHeader().e_machine != ELF::EM_DSPIC30F || elf->getHeader().e_type != ELF::ET_REL)
      return problem(member.name, "got no object for this chip, expected one of twinpuck-cc or XC16");
    return read(member, *elf);
  }

  /// Names that the object defines.
  std::vector<std::string> defined_by(const Member& member) {
    std::vector<std::string> names;
    for_globals(member, [&](const Elf::Elf_Sym& s, StringRef name) {
      if (s.st_shndx != ELF::SHN_UNDEF) names.push_back(name.str());
    });
    return names;
  }

 private:
  bool problem(const std::string& where, const std::string& text) {
    program_.errors.push_back(where + ": " + text);
    return false;
  }

  template <class Visit>
  void for_globals(const Member& member, const Visit& visit) {
    auto elf = Elf::create(member.bytes);
    auto sections = elf ? elf->sections() : elf.takeError();
    if (!sections) return consumeError(sections.takeError());
    for (const auto& section : *sections) {
      if (section.sh_type != ELF::SHT_SYMTAB) continue;
      auto names = elf->getStringTableForSymtab(section);
      auto symbols = elf->symbols(&section);
      if (!names || !symbols) return;
      for (const auto& s : *symbols) {
        auto name = s.getName(*names);
        if (s.getBinding() != ELF::STB_LOCAL && name) visit(s, *name);
      }
    }
  }

  static Kind kind_of(const Elf::Elf_Shdr& header, StringRef name) {
    if (!(header.sh_flags & ELF::SHF_ALLOC)) return Kind::Debug;
    if (name.startswith(".config@")) return Kind::Configuration;
    if (header.sh_flags & ELF::SHF_EXECINSTR) return Kind::Code;
    if (header.sh_flags & dspic_elf::kEeprom) return Kind::Eeprom;
    if (name.startswith(".prog")) return Kind::Table;
    const bool is_constant = header.sh_flags & dspic_elf::kPsv || !(header.sh_flags & ELF::SHF_WRITE);
    return is_constant ? Kind::Constant : Kind::Ram;
  }

  /// Flags name the chip; ours say nothing.
  static bool is_of_vendor(const Elf& elf) { return elf.getHeader().e_flags != 0; }

  bool read(const Member& member, const Elf& elf) {
    auto headers = elf.sections();
    if (!headers) return problem(member.name, toString(headers.takeError()));
    std::vector<Section*> sections(headers->size(), nullptr);
    const Elf::Elf_Shdr* table = nullptr;
    const bool is_vendors = is_of_vendor(elf);
    for (size_t i = 0; i < headers->size(); ++i) {
      const auto& h = (*headers)[i];
      auto name = elf.getSectionName(h);
      if (!name) return problem(member.name, toString(name.takeError()));
      if (h.sh_type == ELF::SHT_SYMTAB) table = &h;
      const bool is_debug = !(h.sh_flags & ELF::SHF_ALLOC);
      if (is_debug && !(h.sh_type == ELF::SHT_PROGBITS && name->startswith(".debug_") && !is_vendors))
        continue;
      if (h.sh_type != ELF::SHT_PROGBITS && h.sh_type != ELF::SHT_NOBITS) continue;
      Section& s = program_.sections.emplace_back();
      s.name = name->str();
      s.from = member.name;
      s.kind = kind_of(h, *name);
      s.flags = h.sh_flags;
      s.size = h.sh_size;
      s.align = std::max<std::uint32_t>(1, h.sh_addralign);
      s.zeroed = h.sh_type == ELF::SHT_NOBITS;
      if (!s.zeroed) {
        auto bytes = elf.getSectionContents(h);
        if (!bytes) return problem(member.name, toString(bytes.takeError()));
        s.bytes.assign(bytes->begin(), bytes->end());
      }
      if (is_vendors) {
        drop_phantom_octets(s);
        if (h.sh_flags & dspic_elf::kAbsolute) s.name += "@" + utohexstr(h.sh_addr);
      }
      sections[i] = &s;
    }
    if (!table) return true;
    std::vector<Symbol*> symbols;
    return read_symbols(member, elf, *table, sections, symbols) &&
           read_relocations(member, elf, sections, symbols);
  }

  bool read_symbols(const Member& member, const Elf& elf, const Elf::Elf_Shdr& table,
                    const std::vector<Section*>& sections, std::vector<Symbol*>& symbols) {
    auto names = elf.getStringTableForSymtab(table);
    auto all = elf.symbols(&table);
    if (!names || !all) return problem(member.name, "damaged symbol table");
    const bool is_vendors = is_of_vendor(elf);
    for (const auto& e : *all) {
      auto name = e.getName(*names);
      if (!name) return problem(member.name, toString(name.takeError()));
      Symbol own;
      own.name = name->str();
      own.from = member.name;
      own.value = e.st_value;
      if (e.st_shndx < sections.size()) own.section = sections[e.st_shndx];
      if (is_vendors && own.section && own.section->kind == Kind::Code) own.value *= 2;
      own.size = e.st_size;
      own.is_function = e.getType() == ELF::STT_FUNC;
      own.is_common = e.st_shndx == ELF::SHN_COMMON;
      own.is_defined = e.st_shndx != ELF::SHN_UNDEF && !own.is_common;
      // what a program defines itself takes the place of a library's
      own.is_weak = e.getBinding() == ELF::STB_WEAK || (own.is_defined && member.is_of_library);
      if (own.is_common) own.align = e.st_value, own.value = 0;
      if (!own.is_defined && !own.is_common) {
        if (is_vendors) own.name = name_of_library(own.name);
        if (rename.count(own.name)) own.name = rename[own.name];
      }
      const bool is_dropped = own.is_defined && !own.section && e.st_shndx != ELF::SHN_ABS;
      if (e.getBinding() == ELF::STB_LOCAL || is_dropped) {
        program_.symbols.push_back(own);
        symbols.push_back(&program_.symbols.back());
      } else {
        symbols.push_back(merge(own));
      }
    }
    return true;
  }

  /// One global symbol of all objects: a definition beats a common one, that beats a weak one.
  Symbol* merge(const Symbol& own) {
    const bool is_new = !program_.globals.count(own.name);
    Symbol* known = program_.global(own.name);
    if (is_new && !own.is_defined && !own.is_common) known->is_weak = own.is_weak;
    if (!own.is_defined && !own.is_common) {
      if (!known->is_defined && !known->is_common) known->is_weak = known->is_weak && own.is_weak;
      return known;
    }
    const auto strength = [](const Symbol& s) {
      return s.is_defined && !s.is_weak ? 3 : s.is_common ? 2 : s.is_defined ? 1 : 0;
    };
    if (strength(own) == 3 && strength(*known) == 3) {
      problem(own.from, own.name.substr(own.name[0] == '_') + ": got a second definition, the first is in " +
                            known->from);
    } else if (own.is_common && known->is_common) {
      known->size = std::max(known->size, own.size);
      known->align = std::max(known->align, own.align);
    } else if (strength(own) > strength(*known)) {
      *known = own;
    }
    return known;
  }

  bool read_vendor_relocations(const Member& member, const Elf& elf, const Elf::Elf_Shdr& header,
                               Section& section, const std::vector<Symbol*>& symbols) {
    auto all = elf.rels(header);
    if (!all) return problem(member.name, toString(all.takeError()));
    for (const auto& r : *all) {
      const unsigned n = r.getSymbol(false), type = r.getType(false);
      if (n >= symbols.size()) return problem(member.name, "damaged relocation");
      if (!add_vendor_relocation(section, r.r_offset, type, *symbols[n]))
        return problem(member.name, section.name + ": relocation of type " + std::to_string(type) + " to " +
                                        symbols[n]->name + " is not known here");
    }
    return true;
  }

  bool read_relocations(const Member& member, const Elf& elf, const std::vector<Section*>& sections,
                        const std::vector<Symbol*>& symbols) {
    for (const auto& h : cantFail(elf.sections())) {
      if (h.sh_info >= sections.size() || !sections[h.sh_info]) continue;
      if (h.sh_type == ELF::SHT_REL &&
          !read_vendor_relocations(member, elf, h, *sections[h.sh_info], symbols))
        return false;
      if (h.sh_type != ELF::SHT_RELA) continue;
      auto all = elf.relas(h);
      if (!all) return problem(member.name, toString(all.takeError()));
      for (const auto& r : *all) {
        const unsigned n = r.getSymbol(false);
        if (n >= symbols.size()) return problem(member.name, "damaged relocation");
        sections[h.sh_info]->relocations.push_back(
            {std::uint32_t(r.r_offset), r.getType(false), symbols[n], std::int32_t(r.r_addend)});
      }
    }
    return true;
  }

  Program& program_;
  std::vector<std::unique_ptr<MemoryBuffer>> buffers_;
  std::vector<std::unique_ptr<object::Archive>> archives_;
};

/// Registers by the names that assembler programs use, with and without underscore.
void define_registers(Program& program) {
  for (const SfrInfo& r : kSfrRows)
    for (const std::string& name :
         {std::string(r.name), "_" + std::string(r.name), "_" + std::string(r.name) + "bits"})
      if (program.globals.count(name) && !program.globals[name]->is_defined) program.define(name, r.address);
}

}  // namespace

bool read_all(Program& program, const Options& options) {
  Reader reader(program);
  std::vector<Member> members, lazy;
  for (const std::string& path : options.inputs)
    if (!reader.open(path, StringRef(path).endswith(".a") ? lazy : members)) return false;
  for (const std::string& path : options.libraries)
    if (!reader.open(path, lazy)) return false;
  std::map<std::string, Member*> who;  // the first that defines a name
  for (Member& m : lazy) {
    m.is_of_library = true;
    for (const std::string& name : reader.defined_by(m)) who.emplace(name, &m);
  }
  // names with a label of their own have no underscore
  for (const auto& [from, to] : options.renames) {
    const std::string target = who.count(to) ? to : "_" + to;
    reader.rename[from] = reader.rename["_" + from] = target;
  }
  for (Member& m : members)
    if (!reader.take(m)) return false;
  reader.rename.clear();
  program.global("__reset");
  program.global("_tp_config_fosc");  // the robot's configuration words, if the program has none
  for (bool again = true; again;) {
    again = false;
    std::vector<Member*> needed;
    for (const auto& [name, symbol] : program.globals) {
      if (symbol->is_defined || symbol->is_common || symbol->is_weak) continue;
      const auto it = who.find(name);
      if (it != who.end() && !it->second->is_taken) needed.push_back(it->second);
    }
    for (Member* m : needed) {
      if (m->is_taken) continue;
      if (!reader.take(*m)) return false;
      again = true;
    }
  }
  define_registers(program);
  return program.errors.empty();
}

}  // namespace dspic::link
