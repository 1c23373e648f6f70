// SPDX-License-Identifier: MIT
// What is used gets its place.
//
//   flash  0x0000  jump to the start
//          0x0004  vectors
//          0x0100  start-up code, constants (one PSV page of 32 KB), code
//   RAM    0x0800  near variables first (below 0x2000), then the others; the stack gets the largest gap left
//
// Order within a kind is that of the inputs, so the same inputs give the same image.
#include <algorithm>
#include <map>
#include <set>

#include "dspic30/link/link.h"
#include "dspic30/link/memory_spaces.h"
#include "dspic30/link/relocations.h"
#include "dspic30/memory/host_places.h"
#include "dspic30/memory/program_memory.h"
#include "dspic30/periph/vectors.h"

namespace dspic::link {

namespace {

using namespace llvm::dspic_elf;

constexpr std::uint32_t kRamBegin = 0x0800, kRamEnd = 0x2800, kYBegin = 0x1800, kNearEnd = 0x2000;
constexpr std::uint32_t kLeastStack = 1024;  // bytes that gaps leave
constexpr std::uint32_t kLeastOfAll = 16;    // bytes of stack without which XC16 does not link
constexpr std::uint32_t kCodeBegin = 0x0100, kPageUnits = 0x8000, kEepromBegin = 0x7FF000,
                        kEepromEnd = 0x800000;

/// Free memory, given away from below.
class Space {
 public:
  explicit Space(std::uint32_t begin, std::uint32_t end) : free_{{begin, end}} {}

  /// The lowest place for `size` in [least, most); false: there is none.
  bool take(std::uint32_t size, std::uint32_t align, std::uint32_t least, std::uint32_t most,
            std::uint32_t& at) {
    for (auto it = free_.begin(); it != free_.end(); ++it) {
      at = (std::max(it->first, least) + align - 1) / align * align;
      if (at + size > std::min(it->second, most)) continue;
      const auto [begin, end] = *it;
      it = free_.erase(it);
      if (at + size < end) it = free_.insert(it, {at + size, end});
      if (begin < at) free_.insert(it, {begin, at});
      return true;
    }
    return false;
  }
  /// The highest one.
  bool take_last(std::uint32_t size, std::uint32_t align, std::uint32_t least, std::uint32_t most,
                 std::uint32_t& at) {
    for (auto it = free_.rbegin(); it != free_.rend(); ++it) {
      const std::uint32_t end = std::min(it->second, most), begin = std::max(it->first, least);
      if (end < begin + size) continue;
      const std::uint32_t last = (end - size) / align * align;
      if (last >= begin) return take(size, 1, last, last + size, at);
    }
    return false;
  }
  /// Empty where nothing is free.
  std::pair<std::uint32_t, std::uint32_t> largest() const {
    if (free_.empty()) return {0, 0};
    return *std::max_element(free_.begin(), free_.end(),
                             [](auto& a, auto& b) { return a.second - a.first < b.second - b.first; });
  }

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> free_;  // begin, end; ascending
};

std::string readable(const Section& s) {
  // ".nbss._name" -> "name"
  const auto dot = s.name.rfind("._");
  return dot == std::string::npos ? s.name : s.name.substr(dot + 2);
}

std::string hex(std::uint32_t v) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%04X", v);
  return text;
}

/// The largest sections of a kind, for a message.
std::string largest_of(const Program& program, Kind kind) {
  constexpr std::size_t kShown = 8;
  std::vector<const Section*> all;
  for (const Section& s : program.sections)
    if (s.used && s.kind == kind) all.push_back(&s);
  std::stable_sort(all.begin(), all.end(), [](auto* a, auto* b) { return a->size > b->size; });
  std::string text;
  for (std::size_t i = 0; i < std::min(all.size(), kShown); ++i)
    text += (i ? ", " : "") + readable(*all[i]) + " " + std::to_string(all[i]->size);
  return text;
}

/// Does the linker make a heap? Asked before the first placing, which defines where it lies.
enum class Heap { None, Made };
Heap heap_of(const Program& program) {
  const auto asked = program.globals.find("__heap");
  return asked == program.globals.end() || asked->second->is_defined ? Heap::None : Heap::Made;
}

/// " for f(), g()": who calls the heap's functions.
std::string askers_of_heap(const Program& program) {
  const auto is_heap = [](const std::string& name) {
    return name == "_malloc" || name == "_calloc" || name == "_realloc";
  };
  std::set<std::string> own;  // sections of the heap's functions
  for (const auto& [name, symbol] : program.globals)
    if (is_heap(name) && symbol->section) own.insert(symbol->section->name);
  std::string text;
  constexpr int kShown = 3;
  int shown = 0;
  for (const Section& s : program.sections) {
    if (!s.used || s.kind != Kind::Code || own.count(s.name)) continue;
    const bool asks = std::any_of(s.relocations.begin(), s.relocations.end(),
                                  [&](const Relocation& r) { return is_heap(r.symbol->name); });
    if (asks && ++shown <= kShown) text += (shown > 1 ? ", " : " for ") + readable(s) + "()";
  }
  return text + (shown > kShown ? " and others" : "");
}

/// A common variable becomes a section like any other.
void place_commons(Program& program) {
  constexpr std::uint32_t kSmall = 32;  // as in sections.cpp
  for (auto& [name, symbol] : program.globals) {
    if (!symbol->is_common) continue;
    Section& s = program.sections.emplace_back();
    s.name = (symbol->size <= kSmall ? ".nbss." : ".bss.") + name;
    s.from = symbol->from;
    s.is_hal = symbol->is_hal;
    s.is_program = symbol->is_program;
    s.flags = symbol->size <= kSmall ? unsigned(kNearSpace) : 0u;
    s.size = symbol->size;
    s.align = symbol->align;
    s.zeroed = true;
    symbol->section = &s;
    symbol->is_common = false;
    symbol->is_defined = true;
  }
}

struct Range {
  std::uint32_t least, most;
};
Range range_of(const Section& s) {
  if (s.flags & kXSpace) return {kRamBegin, kYBegin};
  if (s.flags & kYSpace) return {kYBegin, kRamEnd};
  if (s.flags & kNearSpace) return {kRamBegin, kNearEnd};
  return {kRamBegin, kRamEnd};
}

/// Variables of drivers that the host can fill come first, each at its place of the table, used or not.
std::set<const Section*> place_registers(Program& program, Space& ram) {
  std::set<const Section*> placed;
  std::uint32_t end = kRamBegin;
  for (const HostChoice& choice : program.host) {
    if (!choice.why_not.empty()) continue;
    for (const auto& [name, bytes] : choice.driver->registers) {
      Section* s = program.global("_" + name)->section;
      if (s && s->used && placed.insert(s).second) s->address = end;
      end += (bytes + 1) & ~1u;
    }
  }
  std::uint32_t at;
  if (end > kRamBegin && !ram.take(end - kRamBegin, 2, kRamBegin, end, at))
    program.errors.push_back("RAM: no room for the library's registers at its beginning");
  program.served_end = end;
  return placed;
}

/// `y_last`: what must lie in Y memory is at its end, not its beginning. `gap`: bytes behind each variable.
void place_ram(Program& program, const Options& options, Heap heap, bool y_last, unsigned gap) {
  // One place for each variable; with a gap behind it as long as there is room.
  Space ram(kRamBegin, kRamEnd);
  const auto place = [&](Section& s, Range r, std::uint32_t align) {
    const auto take = y_last && (s.flags & kYSpace) ? &Space::take_last : &Space::take;
    if (gap && (ram.*take)(s.size + gap, align, r.least, r.most, s.address)) return;
    if ((ram.*take)(s.size, align, r.least, r.most, s.address)) return;
    program.errors.push_back("RAM: no room for " + readable(s) + ", " + std::to_string(s.size) +
                             " bytes in " + hex(r.least) + " to " + hex(r.most - 1) +
                             "; largest: " + largest_of(program, Kind::Ram));
  };
  const auto each = [&](auto&& wanted, auto&& act) {
    for (Section& s : program.sections)
      if (s.used && s.kind == Kind::Ram && wanted(s)) act(s);
  };
  std::uint32_t at;
  const std::set<const Section*> served = place_registers(program, ram);
  const auto is_fixed = [&](const Section& s) { return fixed_address(s, at); };
  // First what wants a certain address, then by how narrow the choice is: Y memory, X memory, near, all else.
  each(is_fixed, [&](Section& s) {
    fixed_address(s, at);
    if (!ram.take(s.size, 1, at, at + s.size, s.address))
      program.errors.push_back("RAM: " + readable(s) + " is to lie at " + hex(at) +
                               ", where something else lies");
  });
  for (std::uint32_t space : {kYSpace, kXSpace, kNearSpace, SectionFlag(0)}) {
    const auto belongs = [&](const Section& s) {
      return !is_fixed(s) && !served.count(&s) && (s.flags & (kXSpace | kYSpace | kNearSpace)) == space;
    };
    each(belongs, [&](Section& s) { place(s, range_of(s), s.align); });
  }
  each([](const Section&) { return true; }, [&](Section& s) { program.ram_bytes += s.size; });
  // The heap, if somebody asks for it, and the stack takes the largest gap that is left.
  if (heap != Heap::None) {
    const auto [begin, end] = ram.largest();
    if (!ram.take(options.heap_bytes, 2, kRamBegin, kRamEnd, at))
      program.errors.push_back("RAM: no room for the heap: got " +
                               std::to_string(end - std::min((begin + 1) & ~1u, end)) +
                               " bytes that variables leave in one piece, expected at least " +
                               std::to_string(options.heap_bytes) + askers_of_heap(program) +
                               "; largest: " + largest_of(program, Kind::Ram));
    program.define("__heap", at);
    program.define("__eheap", at + options.heap_bytes);
    program.ram_bytes += options.heap_bytes;
  }
  std::tie(program.stack_begin, program.stack_end) = ram.largest();
  program.stack_begin = std::min((program.stack_begin + 1) & ~1u, program.stack_end);
  if (const std::uint32_t left = program.stack_end - program.stack_begin; left < kLeastOfAll)
    program.errors.push_back(
        "RAM: no room for the stack: got " + std::to_string(left) + " bytes that variables" +
        (heap == Heap::None ? "" : " and the heap of " + std::to_string(options.heap_bytes) + " bytes") +
        " leave in one piece, expected at least " + std::to_string(kLeastOfAll) +
        "; largest: " + largest_of(program, Kind::Ram));
}

/// A large array may need the room on both sides of where Y memory begins.
void place_ram(Program& program, const Options& options, Heap heap, unsigned gap) {
  const std::size_t errors = program.errors.size();
  const auto bytes = program.ram_bytes;
  place_ram(program, options, heap, false, gap);
  if (program.errors.size() == errors) return;
  std::vector<std::string> first(program.errors.begin() + std::ptrdiff_t(errors), program.errors.end());
  program.errors.resize(errors);
  program.ram_bytes = bytes;
  place_ram(program, options, heap, true, gap);
  if (program.errors.size() == errors) return;
  program.errors.resize(errors);
  program.errors.insert(program.errors.end(), first.begin(), first.end());
}

/// Gaps are left out where they take the room of variables, or of the stack.
void place_ram(Program& program, const Options& options) {
  const Heap heap = heap_of(program);
  const std::size_t errors = program.errors.size();
  const auto bytes = program.ram_bytes;
  if (options.gap_bytes > 0) {
    place_ram(program, options, heap, options.gap_bytes);
    if (program.errors.size() == errors && program.stack_end - program.stack_begin >= kLeastStack) return;
    program.errors.resize(errors);
    program.ram_bytes = bytes;
  }
  place_ram(program, options, heap, 0u);
}

/// Data that must be set before main(): a table entry each (fill_dinit() in fill.cpp).
std::uint32_t dinit_words(const Program& program) {
  std::uint32_t words = 1;  // the end
  for (const Section& s : program.sections)
    if (s.used && s.kind == Kind::Ram && !(s.flags & kPersistent) && s.size)
      words += 3 + (s.zeroed ? 0 : (s.size + 1) / 2);
  return words;
}

/// More code than a RCALL reaches from one end to the other.
bool is_far(const Program& program) {
  constexpr std::uint32_t kReach = 0x8000 - 0x100;  // words, less the vectors
  std::uint32_t words = 0;
  for (const Section& s : program.sections)
    if (s.used && s.kind != Kind::Ram && s.kind != Kind::Debug)
      words += s.size / (s.kind == Kind::Code ? kWordOctets : 2);
  return words > kReach;
}

/// An upper bound: functions whose 16-bit address is asked for, or that may be too far for a RCALL.
std::uint32_t handle_count(const Program& program, bool far) {
  std::map<const Symbol*, int> asked;
  for (const Section& s : program.sections)
    if (s.used && s.kind != Kind::Debug)
      for (const Relocation& r : s.relocations)
        if ((r.type == kLiteral16 || r.type == kWord || (far && r.type == kBranch)) && r.symbol->section &&
            r.symbol->section->kind == Kind::Code)
          asked[r.symbol] = 1;
  return std::uint32_t(asked.size());
}

void place_flash(Program& program) {
  Space flash(kCodeBegin, kFlashEnd);
  const auto no_room = [&](const std::string& what, std::uint32_t words) {
    program.errors.push_back("flash: no room for " + what + ", " + std::to_string(words) +
                             " words; largest: " + largest_of(program, Kind::Code));
  };
  // start-up first: its place is then the same in every image
  const auto code = [&](Section& s) {
    const std::uint32_t units = s.size / kWordOctets * 2;
    if (!flash.take(units, std::max(2u, s.align / 2), 0, kFlashEnd, s.address))
      no_room(readable(s), s.size / kWordOctets);
  };
  // what a vendor's object wants at an address
  std::uint32_t fixed = 0;
  const auto is_at_address = [&](const Section& s) {
    return s.kind == Kind::Code && fixed_address(s, fixed);
  };
  for (Section& s : program.sections) {
    if (!s.used || !is_at_address(s)) continue;
    const std::uint32_t units = s.size / kWordOctets * 2;
    if (!flash.take(units, 2, fixed, fixed + units, s.address))
      program.errors.push_back("flash: " + readable(s) + " is to lie at " + hex(fixed) +
                               ", where something else lies");
  }
  Section* start = program.global("__reset")->section;
  if (start && start->used && !is_at_address(*start)) code(*start);
  // a RCALL reaches the middle of flash from everywhere
  constexpr std::uint32_t kMiddle = 0x8000, kHandlesEnd = 0x10000;
  const bool far = is_far(program);
  const std::uint32_t handles = handle_count(program, far);
  if (!flash.take(4 * handles, 2, far ? kMiddle : 0, kHandlesEnd, program.handles_at))
    no_room("handles", 2 * handles);

  // all constants in one page of the window, at the beginning of flash if they fit there
  std::uint32_t bytes = 0, align = 2;
  for (Section& s : program.sections)
    if (s.used && s.kind == Kind::Constant) {
      align = std::max(align, s.align);
      bytes = (bytes + s.align - 1) / s.align * s.align;
      s.load = bytes;
      bytes += s.size;
    }
  const std::uint32_t units = (bytes + 1) & ~1u;
  std::uint32_t at = 0;
  bool placed = false;
  for (std::uint32_t page = 0; page < kFlashEnd && !placed; page += kPageUnits)
    placed = flash.take(units, align, page, std::min(page + kPageUnits, kFlashEnd), at);
  if (!placed)
    program.errors.push_back("constants: got " + std::to_string(bytes) + " bytes, expected at most " +
                             std::to_string(kPageUnits) +
                             " in one page; largest: " + largest_of(program, Kind::Constant));
  for (Section& s : program.sections)
    if (s.used && s.kind == Kind::Constant) {
      s.load += at;
      s.address = (s.load & (kPageUnits - 1)) | kPageUnits;
    }
  program.define("__const_psvpage", at / kPageUnits);

  // What is left: start values, code, tables.
  program.dinit_words = dinit_words(program);
  if (!flash.take(2 * program.dinit_words, 2, 0, kFlashEnd, program.dinit))
    no_room("start values", program.dinit_words);
  for (Section& s : program.sections)
    if (s.used && s.kind == Kind::Code && &s != start && !is_at_address(s)) code(s);
  for (Section& s : program.sections)
    if (s.used && s.kind == Kind::Table) {
      const std::uint32_t units = (s.size + 1) & ~1u;
      if (!flash.take(units, std::max(2u, s.align), 0, kFlashEnd, s.address)) no_room(readable(s), units / 2);
      s.load = s.address;
    }
}

void place_rest(Program& program) {
  Space eeprom(kEepromBegin, kEepromEnd);
  for (Section& s : program.sections) {
    if (!s.used) continue;
    if (s.kind == Kind::Configuration) fixed_address(s, s.load), s.address = s.load;
    if (s.kind != Kind::Eeprom) continue;
    if (!eeprom.take((s.size + 1) & ~1u, std::max(2u, s.align), kEepromBegin, kEepromEnd, s.load))
      program.errors.push_back("EEPROM: no room for " + readable(s) + ", " + std::to_string(s.size) +
                               " bytes");
    s.address = s.load & 0xFFFF;
  }
}

}  // namespace

bool fixed_address(const Section& s, std::uint32_t& address) {
  const auto at = s.name.find('@');
  if (at == std::string::npos) return false;
  address = std::uint32_t(std::stoul(s.name.substr(at + 1), nullptr, 16));
  return true;
}

bool can_lie_anywhere(const Section& section) {
  std::uint32_t at;
  return !fixed_address(section, at) && !(section.flags & (kXSpace | kYSpace));
}

std::string handler_name(int vector) {
  return vector < kFirstIrqVector ? vector_name(vector) : irq_handler(vector - kFirstIrqVector);
}

bool is_handler(const std::string& name) {
  for (const char* prefix : {"__", "__Alt"})
    for (int v = 1; v < kVectors; ++v)
      if (name == prefix + handler_name(v)) return true;
  return false;
}

/// Of several drivers with one handler it is that one's which the program calls, of whose module something else
/// is used; two of those are what the robot's linker calls a multiple definition.
static void choose_handlers(Program& program) {
  std::set<int> used;
  for (const Section& s : program.sections)
    if (s.used && s.kind != Kind::Debug) used.insert(s.module);
  std::map<std::string, std::vector<const Symbol*>> all;
  for (const auto& [first, second] : program.rivals) {
    auto& those = all[first.name];
    if (those.empty()) those.push_back(&first);
    those.push_back(&second);
  }
  for (auto& [name, those] : all) {
    const Symbol* chosen = nullptr;
    for (const Symbol* s : those) {
      if (!used.count(s->section->module)) continue;
      if (chosen)
        program.errors.push_back(
            s->from + ": error: " + in_c(name) +
            "(): got a second handler of this interrupt, expected one; the first is in " + chosen->from +
            ": the robot's linker refuses two; call functions of one of these drivers only, or take a "
            "form of one that has another timer");
      else
        chosen = s;
    }
    if (chosen) *program.global(name) = *chosen;
  }
}

// as XC16 does, all of the program's own variables stay: somebody may look at them, or set them
void keep_used(Program& program) {
  place_commons(program);
  std::set<std::string> rivals;
  for (const auto& [first, second] : program.rivals) rivals.insert(first.name);
  std::vector<Section*> todo;
  const auto keep = [&](Section* s) {
    if (s && !s->used) s->used = true, todo.push_back(s);
  };
  keep(program.global("__reset")->section);
  for (auto& [name, symbol] : program.globals)
    if ((is_handler(name) && !rivals.count(name)) || name == "__DefaultInterrupt" ||
        (symbol->section && symbol->section->kind == Kind::Configuration))
      keep(symbol->section);
  for (Section& s : program.sections)
    if (s.kind == Kind::Eeprom || (s.kind == Kind::Ram && s.is_program)) keep(&s);
  const auto keep_all = [&] {
    while (!todo.empty()) {
      Section* s = todo.back();
      todo.pop_back();
      for (const Relocation& r : s->relocations) keep(r.symbol->section);
    }
  };
  keep_all();
  choose_handlers(program);
  for (const std::string& name : rivals) keep(program.global(name)->section);
  keep_all();
  // debugging information of what stays; of what goes its addresses are 0
  for (Section& s : program.sections) s.used |= s.kind == Kind::Debug;
}

void place_all(Program& program, const Options& options) {
  place_ram(program, options);
  place_flash(program);
  place_rest(program);
  program.define("__SP_init", program.stack_begin);
  if (options.gap_bytes > 0) {
    program.define(kCheckedSymbol, program.stack_begin);
    if (const auto heap = program.globals.find("__heap"), end = program.globals.find("__eheap");
        heap != program.globals.end() && end != program.globals.end()) {
      program.define(kCheckedHeapSymbol, heap->second->value);
      program.define(kCheckedHeapEndSymbol, end->second->value);
    }
  }
  program.define("__SPLIM_init", program.stack_end - 2);
  program.define("__dinit_page", program.dinit >> 16);
  program.define("__dinit_offset", program.dinit & 0xFFFF);
}

}  // namespace dspic::link
