// SPDX-License-Identifier: MIT
// Drivers that the host fills: the image is linked as for the chip, whole, and laid out as for the chip. Then
// the drivers' code is taken out again, and where one of their functions began, a GOTO leads to the host's.
// So every other function, variable and constant lies where it lies on the chip, and so does the stack.
//
//   hal_dspic   _e_set_speed_left:  MOV ...      hal_sim   _e_set_speed_left:  GOTO kHostStart + 2 i
//               __T2Interrupt:      PUSH ...               (vector: as if there were no handler)
//
// Functions of other files that only read the drivers' variables are filled likewise (shortcuts). A driver of
// which the program has a part, or whose registers somebody else names, stays as it is.
#include <algorithm>

#include "dspic30/core/instruction_table.h"
#include "dspic30/link/link.h"
#include "dspic30/link/memory_spaces.h"
#include "dspic30/memory/host_places.h"
#include "dspic30/memory/sfr_table.h"
#include "dspic30/periph/vectors.h"

namespace dspic::link {

namespace {

using llvm::dspic_elf::kWordOctets;

constexpr std::uint32_t kRam = 0x0800;
constexpr std::uint32_t kHandleOctets = 8;  // a GOTO has two words

bool is_variable(const Symbol& s) { return s.section && s.section->kind == Kind::Ram; }

/// A function of the library, in a section of its own in which a GOTO has room.
bool is_alone(const Symbol& s) {
  return s.section && s.section->is_hal && s.section->kind == Kind::Code && s.value == 0 &&
         s.section->size >= kHandleOctets;
}

/// What a program has of one driver.
class Look {
 public:
  Look(const Program& program, const HostDriver& driver) : program_(program), driver_(driver) {
    for (const auto& [name, index] : driver.functions) add(name);
    for (const auto& [name, bytes] : driver.registers) add(name);
    for (const std::string& name : driver.owned) {
      if (const std::size_t split = name.find('_'); split != std::string::npos) {
        const SfrInfo* const r = sfr_named(name.substr(0, split));
        for (const SfrField& field : r ? fields_of(*r) : std::vector<SfrField>{})
          if (field.name == name.substr(split + 1))
            flags_[{r->address, field.bit}] = r->name + ("." + field.name);
        continue;
      }
      for (const SfrInfo& r : kSfrRows)
        if (r.name == name) registers_[r.address] = name;
      for (const std::string& label : {name, "_" + name, "_" + name + "bits"})  // registers have no section
        if (const Symbol* s = find(label); s && !s->section) owned_.insert(s);
      for (const std::string& label : {"__" + name, "__Alt" + name})
        if (const Symbol* s = find(label); s && s->section) handlers_.push_back(s);
    }
  }

  /// Some of the chip's own driver is linked.
  bool is_linked() const {
    return std::any_of(program_.sections.begin(), program_.sections.end(),
                       [&](const Section& s) { return s.used && s.kind != Kind::Debug && is_drivers(s); });
  }
  bool is_drivers(const Section& s) const { return s.is_hal && modules_.count(s.from); }

  /// "main.c:12 uses T2CON"; empty: nothing keeps the host from filling it.
  std::string obstacle() const {
    std::string why;
    for (const auto& [name, index] : driver_.functions) {
      const Symbol* s = find("_" + name);
      if (why.empty() && s && is_there(*s) && !can_be_filled(*s)) why = told(*s, " has ", name + "()");
    }
    for (const auto& [name, bytes] : driver_.registers) {
      const Symbol* s = is_linked() ? find("_" + name) : nullptr;
      if (why.empty() && s && is_there(*s) && !can_be_served(*s, bytes)) why = told(*s, " has ", name);
    }
    if (!is_linked()) return why;
    if (why.empty()) why = of_vectors();
    if (why.empty()) why = of_others();
    return why.empty() ? of_places() : why;
  }

 private:
  const Symbol* find(const std::string& label) const {
    const auto it = program_.globals.find(label);
    return it == program_.globals.end() ? nullptr : it->second;
  }
  void add(const std::string& name) {
    const Symbol* s = find("_" + name);
    if (!s) return;
    known_.insert(s);
    if (s->section && s->section->is_hal) modules_.insert(s->section->from);
  }
  static bool is_there(const Symbol& s) { return s.is_defined && (!s.section || s.section->used); }

  bool can_be_filled(const Symbol& s) const { return is_alone(s) && is_drivers(*s.section); }
  /// The library's variable, or one of the program's that takes its place, with nothing beside it.
  static bool can_be_served(const Symbol& s, unsigned bytes) {
    return is_variable(s) && s.value == 0 && s.section->size <= bytes && can_lie_anywhere(*s.section);
  }

  /// "main.c:12", "library(time.c)".
  std::string place(const Section& s, std::uint32_t offset) const {
    return s.is_hal ? s.from : Whereabouts(program_).line(s, offset);
  }
  std::string told(const Symbol& s, const char* verb, const std::string& what) const {
    return (s.section ? place(*s.section, s.value) : s.from) + verb + what;
  }

  std::string of_vectors() const {
    for (const Symbol* s : handlers_)
      if (s->section->used && !is_drivers(*s->section)) return told(*s, " has ", in_c(s->name) + "()");
    return "";
  }

  /// Whoever names a register of the driver's timer, or something of the driver that the host has not.
  std::string of_others() const {
    for (const Section& s : program_.sections) {
      if (!s.used || s.kind == Kind::Debug || is_drivers(s)) continue;
      if (std::string why = of_code(s); !why.empty()) return why;
      for (const Relocation& r : s.relocations) {
        const Symbol* to = r.symbol;
        const bool is_inner = to->section && is_drivers(*to->section) && !known_.count(to);
        if (!is_inner && !owned_.count(to)) continue;
        const std::string name = in_c(to->name);
        return place(s, r.offset) + " uses " + name.substr(0, name.find("bits"));
      }
    }
    return "";
  }

  static std::uint32_t word_at(const Section& s, std::uint32_t i) {
    return i + kWordOctets <= s.bytes.size() ? s.bytes[i] | s.bytes[i + 1] << 8 | s.bytes[i + 2] << 16 : 0;
  }
  /// Is this constant put into Wn anywhere in the section?
  static bool holds(const Section& s, unsigned n, unsigned constant) {
    for (std::uint32_t i = 0; i < s.bytes.size(); i += kWordOctets) {
      const Row* const row = find_row(word_at(s, i));
      if (!row || row->id != Insn::Mov_lit16_Wnd) continue;
      if (const Fields f = fields_of(*row, word_at(s, i)); f.d == n && f.k == constant) return true;
    }
    return false;
  }

  /// Does the instruction at `i` look at one bit of Wn?
  static bool looks_at_bit(const Section& s, std::uint32_t i, unsigned n, int bit) {
    const Row* const row = find_row(word_at(s, i));
    if (!row) return false;
    const Fields f = fields_of(*row, word_at(s, i));
    switch (row->id) {
      case Insn::Btst_Ws_bit4:
      case Insn::Btss_Ws_bit4:
      case Insn::Btsc_Ws_bit4:
        return f.s == n && static_cast<int>(f.b) == bit;
      case Insn::And_lit10_Wn:
        return f.d == n && (f.k >> bit & 1) != 0;
      case Insn::And_Wb_Ws_Wd:
        return f.p == 0 && (f.w == n || f.s == n) && holds(s, f.w == n ? f.s : f.w, 1u << bit);
      default:
        return false;
    }
  }

  /// The driver's flag that the instruction at `at` looks at, or one soon behind it that has its word: the flag is the
  /// host's, and never rises. Empty: none.
  std::string flag_tested(const Section& s, std::uint32_t at, Insn id, const Fields& f) const {
    constexpr std::uint32_t kSoon = 3;  // instructions
    if (id == Insn::Btst_f_bit || id == Insn::Btss_f_bit || id == Insn::Btsc_f_bit) {
      const auto known = flags_.find({f.f & ~1u, static_cast<int>(f.b + 8 * (f.f & 1))});
      return known == flags_.end() ? "" : known->second;
    }
    if (id != Insn::Mov_f_Wnd) return "";
    for (const auto& [flag, name] : flags_)
      for (std::uint32_t n = 1; flag.first == 2 * f.f && n <= kSoon; ++n)
        if (looks_at_bit(s, at + n * kWordOctets, f.d, flag.second)) return name;
    return "";
  }

  /// An instruction with a register's address in it, as compilers write them. Not seen: one
  /// that goes by a pointer.
  std::string of_code(const Section& s) const {
    if (s.kind != Kind::Code) return "";
    for (std::uint32_t i = 0; i + kWordOctets <= s.bytes.size(); i += kWordOctets) {
      const std::uint32_t word = word_at(s, i);
      const Row* row = find_row(word);
      if (!row) continue;
      const Fields fields = fields_of(*row, word);
      if (const std::string flag = flag_tested(s, i, row->id, fields); !flag.empty())
        return place(s, i) + " uses " + flag;
      for (const Operand kind : row->kinds) {
        if (kind != Operand::File && kind != Operand::FileWord && kind != Operand::FileBit) continue;
        const unsigned f = fields.f, address = kind == Operand::FileWord ? 2 * f : f & ~1u;
        const auto known = registers_.find(address);
        if (known == registers_.end()) continue;
        const bool is_variable = std::any_of(s.relocations.begin(), s.relocations.end(),
                                             [&](const Relocation& r) { return r.offset == i; });
        if (!is_variable) return place(s, i) + " uses " + known->second;
      }
      i += kWordOctets * std::uint32_t(row->words - 1);
    }
    return "";
  }

  /// A variable that is to lie where the driver's registers do.
  std::string of_places() const {
    std::uint32_t bytes = 0;
    for (const auto& [name, size] : driver_.registers) bytes += (size + 1) & ~1u;
    for (const Section& s : program_.sections) {
      std::uint32_t at = 0;
      if (!s.used || s.kind != Kind::Ram || !fixed_address(s, at) || at >= kRam + bytes) continue;
      char text[16];
      std::snprintf(text, sizeof text, "0x%04X", at);
      return s.from + " has a variable at " + text;
    }
    return "";
  }

  const Program& program_;
  const HostDriver& driver_;
  std::map<std::pair<unsigned, int>, std::string> flags_;  // address and bit
  std::set<const Symbol*> known_, owned_;                  // asked for membership only
  std::vector<const Symbol*> handlers_;
  std::map<unsigned, std::string> registers_;  // by address
  std::set<std::string> modules_;
};

}  // namespace

void choose_filled(Program& program, const Options& options) {
  if (!options.host.empty()) program.define(kHalSymbol, options.is_filled_by_host);
  for (const HostDriver& driver : options.host) {
    const Look look(program, driver);
    if (const std::string why = look.obstacle(); look.is_linked() || !why.empty())
      program.host.push_back({&driver, look.is_linked(), why});
  }
}

void fill_by_host(Program& program, const Options& options) {
  const auto erase = [&](const Section& s) {
    for (std::uint32_t i = 0; i < s.size / 2; i += 2) program.words.erase(s.address + i);
  };
  // its code is gone, and a GOTO leads to the host
  const auto fill = [&](Section& s, unsigned index) {
    const std::uint32_t to = kHostStart + 2 * index;
    s.relocations.clear();
    s.size = kHandleOctets;
    s.bytes = {std::uint8_t(to), std::uint8_t(to >> 8), 0x04, 0, std::uint8_t(to >> 16), 0, 0, 0};
    put_section(program, s);
  };
  // Of each driver that the host takes over: its functions lead there, and the rest of it goes.
  for (const HostChoice& choice : program.host) {
    if (!choice.why_not.empty()) continue;
    const Look look(program, *choice.driver);
    std::map<const Section*, unsigned> functions;
    std::set<const Section*> registers;
    for (const auto& [name, index] : choice.driver->functions)
      if (const Symbol* s = program.global("_" + name); s->section) functions[s->section] = index;
    for (const auto& [name, bytes] : choice.driver->registers)
      registers.insert(program.global("_" + name)->section);
    for (Section& s : program.sections) {
      if (!s.used || s.kind == Kind::Debug || !look.is_drivers(s) || registers.count(&s)) continue;
      if (s.kind == Kind::Code) erase(s);
      const auto function = functions.find(&s);
      if (function == functions.end()) {
        s.used = false;  // its place stays empty
        continue;
      }
      fill(s, function->second);
    }
    // Functions elsewhere that only read its variables lead to the host too, where nothing else
    // shares their section.
    for (const auto& [name, index] : choice.driver->shortcuts) {
      const auto found = program.globals.find("_" + name);
      if (found == program.globals.end() || !is_alone(*found->second) || !found->second->section->used)
        continue;
      erase(*found->second->section);
      fill(*found->second->section, index);
      found->second->size = kHandleOctets;
    }
    for (const auto& [name, index] : choice.driver->functions)
      if (Symbol* s = program.global("_" + name); s->section && s->section->used) s->size = kHandleOctets;
  }
  // What the simulator asks of the image before it runs it.
  put_vectors(program);
  program.define(kServedEndSymbol, program.served_end);
  program.define(kHostTableSymbol, options.host_table);
  program.define(kLibraryLevelSymbol, options.library_level);
  refill_debug(program);
}

}  // namespace dspic::link
