// SPDX-License-Identifier: MIT
// Objects and archives in. A library's object is read when it defines what is undefined so far.
#include <set>

#include "dspic30/link/link.h"
#include "dspic30/link/memory_spaces.h"
#include "dspic30/link/relocations.h"
#include "dspic30/memory/program_memory.h"
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
  std::string name;  // as messages and the map have it
  StringRef bytes;
  bool is_taken = false, is_of_library = false, is_of_archive = false, is_driver = false, is_hal = false;
};

/// COFF, which C30 wrote before it wrote ELF.
bool is_coff(StringRef bytes) { return bytes.startswith("\x36\x12"); }

class Reader {
 public:
  explicit Reader(Program& program) : program_(program) {}

  std::map<std::string, std::string> rename, rename_in_archives;  ///< of what objects ask for

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
      members.back().is_of_archive = true;
      if (is_coff(*data)) program_.unread = path + " holds COFF, C30's first format, which is not read";
    }
    archives_.push_back(std::move(*archive));
    return error ? problem(path, toString(std::move(error))) : true;
  }

  bool take(Member& member) {
    member.is_taken = true;
    if (is_coff(member.bytes))
      return problem(member.name,
                     "got an object in COFF, C30's first format, expected ELF; have it compiled "
                     "with -omf=elf, or give its source");
    auto elf = Elf::create(member.bytes);
    if (!elf) return problem(member.name, toString(elf.takeError()));
    if (elf->getHeader().e_machine != ELF::EM_DSPIC30F || elf->getHeader().e_type != ELF::ET_REL)
      return problem(member.name, "got no object for this chip, expected one of twinpuck-cc, XC16 or C30");
    return read(member, *elf);
  }

  /// A driver's object with a handler that nobody has, and with names of what is linked: the other half of
  /// what a project lists. Not a second form of what is linked already.
  bool is_missing_handler(const Member& member) {
    if (member.is_taken || !member.is_driver) return false;
    bool has_handler = false, is_second = false, is_at_home = false;
    for_globals(member, [&](const Elf::Elf_Sym& s, StringRef name) {
      const auto known = program_.globals.find(name.str());
      const bool is_there =
          known != program_.globals.end() && (known->second->is_defined || known->second->is_common);
      const bool is_ours = s.st_shndx != ELF::SHN_UNDEF;
      has_handler |= is_ours && is_handler(name.str());
      is_second |= is_ours && is_there;
      is_at_home |= !is_ours && is_there && of_program_.count(known->second->from);
    });
    return has_handler && is_at_home && !is_second;
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
  static void for_globals(const Member& member, const Visit& visit) {
    for_symbols(member, [&](const Elf::Elf_Sym& s, StringRef name) {
      if (s.getBinding() != ELF::STB_LOCAL) visit(s, name);
    });
  }
  template <class Visit>
  static void for_symbols(const Member& member, const Visit& visit) {
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
        name ? visit(s, *name) : consumeError(name.takeError());
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

  /// Flags name the chip; ours say nothing. Those of C30 say nothing either, but have __C30ELF.
  static bool is_of_vendor(const Member& member, const Elf& elf) {
    if (elf.getHeader().e_flags != 0) return true;
    bool is_c30 = false;
    for_symbols(member, [&](const Elf::Elf_Sym& s, StringRef name) {
      is_c30 |= s.st_shndx == ELF::SHN_ABS && name == "__C30ELF";
    });
    return is_c30;
  }

  /// By its source, where that is known: "src/main.c", "library(e_led.c)".
  void name_by_source(Member& member, bool is_vendors) const {
    const auto known = program_.sources.find(member.name);
    if (known != program_.sources.end()) {
      member.name = known->second;
    } else if (!is_vendors) {
      std::string source;
      for_symbols(member, [&](const Elf::Elf_Sym& s, StringRef of) {
        if (s.getType() == ELF::STT_FILE && source.empty()) source = of.str();
      });
      const auto archive = program_.sources.find(member.name.substr(0, member.name.rfind('(')));
      if (archive == program_.sources.end())
        member.name = source.empty() ? member.name : source;
      else
        member.name = archive->second +
                      (source.empty() ? member.name.substr(member.name.rfind('(')) : "(" + source + ")");
    }
  }

  /// A word of the configuration, which C30 and XC16 make a section "__FOSC.sec" at the word's address.
  static void make_configuration(Section& s, std::uint32_t address) {
    s.kind = Kind::Configuration;
    s.bytes.resize(2);
    s.size = 2;
    s.name = ".config@" + utohexstr(address);
  }

  bool read(Member& member, const Elf& elf) {
    auto headers = elf.sections();
    if (!headers) return problem(member.name, toString(headers.takeError()));
    std::vector<Section*> sections(headers->size(), nullptr);
    const Elf::Elf_Shdr* table = nullptr;
    const bool is_vendors = is_of_vendor(member, elf);
    ++modules_;
    name_by_source(member, is_vendors);
    if (!member.is_of_archive) of_program_.insert(member.name);
    // Sections that reach the chip, and our debugging information; a vendor's is not read.
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
      s.module = modules_;
      s.is_hal = member.is_hal;
      s.is_program = !member.is_of_library;
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
      // A vendor's object has phantom octets between its data, and sections that ask for an address.
      if (is_vendors) {
        drop_phantom_octets(s);
        if (h.sh_flags & dspic_elf::kAbsolute && h.sh_addr >= kConfigurationStart && s.bytes.size() >= 2) {
          make_configuration(s, h.sh_addr);
          // named as C's, so that the library's own word stays out
          Symbol* word = program_.global(
              "_tp_config_" + name->drop_front(2).take_until([](char c) { return c == '.'; }).lower());
          if (!word->is_defined || word->is_weak) word->section = &s;
          word->is_defined = word->is_weak = true;
        } else if (h.sh_flags & dspic_elf::kAbsolute) {
          s.name += "@" + utohexstr(h.sh_addr);
        }
      }
      sections[i] = &s;
    }
    // Symbols and relocations refer to these sections.
    if (!table) return true;
    std::vector<Symbol*> symbols;
    return read_symbols(member, elf, *table, sections, symbols, is_vendors) &&
           read_relocations(member, elf, sections, symbols);
  }

  bool read_symbols(const Member& member, const Elf& elf, const Elf::Elf_Shdr& table,
                    const std::vector<Section*>& sections, std::vector<Symbol*>& symbols, bool is_vendors) {
    auto names = elf.getStringTableForSymtab(table);
    auto all = elf.symbols(&table);
    if (!names || !all) return problem(member.name, "damaged symbol table");
    for (const auto& e : *all) {
      auto name = e.getName(*names);
      if (!name) return problem(member.name, toString(name.takeError()));
      Symbol own;
      own.name = name->str();
      own.from = member.name;
      own.is_hal = member.is_hal;
      own.is_program = !member.is_of_library;
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
        const auto& names = member.is_of_archive ? rename_in_archives : rename;
        if (const auto other = names.find(own.name); other != names.end()) own.name = other->second;
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
      program_.twice.emplace_back(*known, own);
    } else if (strength(own) == 1 && strength(*known) == 1 && are_rivals(*known, own)) {
      program_.rivals.emplace_back(*known, own);
    } else if (own.is_common && known->is_common) {
      known->size = std::max(known->size, own.size);
      known->align = std::max(known->align, own.align);
      known->is_program |= own.is_program;
    } else if (strength(own) > strength(*known)) {
      *known = own;
    }
    return known;
  }

  /// Two modules of the library with a handler of one vector. A project's copy of a module is no other module.
  static bool are_rivals(const Symbol& one, const Symbol& other) {
    const auto stem = [](const Symbol& s) {
      const std::string file = s.from.substr(s.from.find_last_of("/(") + 1);
      return file.substr(0, file.rfind('.'));
    };
    return is_handler(other.name) && one.section && other.section && stem(one) != stem(other);
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
  std::set<std::string> of_program_;  // modules outside of archives
  int modules_ = 0;
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

/// What the robot's linker calls a multiple definition.
void tell_of_twice(Program& program) {
  if (program.twice.empty()) return;
  const Whereabouts places(program);
  for (const auto& [first, second] : program.twice)
    program.errors.push_back(
        places.line(second) + ": error: " + in_c(second.name) + (second.is_function ? "()" : "") +
        ": got a second definition, expected one; the first is in " + places.line(first));
}

}  // namespace

bool read_all(Program& program, const Options& options) {
  // What is linked in any case, and what only when somebody asks for it.
  Reader reader(program);
  std::vector<Member> members, lazy;
  for (const std::string& path : options.inputs)
    if (!reader.open(path, StringRef(path).endswith(".a") ? lazy : members)) return false;
  for (const std::string& path : options.drivers) {
    if (!reader.open(path, lazy)) return false;
    lazy.back().is_driver = true;
  }
  for (const std::string& path : options.libraries) {
    const std::size_t before = lazy.size();
    if (!reader.open(path, lazy)) return false;
    for (std::size_t i = before; i < lazy.size(); ++i) lazy[i].is_hal = path == options.host_library;
  }
  std::map<std::string, Member*> who;  // the first that defines a name
  for (Member& m : lazy) {
    m.is_of_library = true;
    for (const std::string& name : reader.defined_by(m)) who.emplace(name, &m);
  }
  // names with a label of their own have no underscore
  const auto add_names = [&](const std::map<std::string, std::string>& pairs, auto& names) {
    for (const auto& [from, to] : pairs) names[from] = names["_" + from] = who.count(to) ? to : "_" + to;
  };
  add_names(options.renames, reader.rename);
  add_names(options.library_renames, reader.rename_in_archives);
  for (Member& m : members)
    if (!reader.take(m)) return false;
  program.global("__reset");
  program.global("_tp_config_fosc");  // the robot's configuration words, if the program has none
  // Members that define what is missing, and what these need, until nothing is.
  const auto take_needed = [&] {
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
    return true;
  };
  if (!take_needed()) return false;
  // nobody asks for a driver's handler by name
  for (Member& m : lazy)
    if (reader.is_missing_handler(m) && (!reader.take(m) || !take_needed())) return false;
  define_registers(program);
  tell_of_twice(program);
  return program.errors.empty();
}

}  // namespace dspic::link
