// SPDX-License-Identifier: MIT
#include "dspic30/asm/assembler.h"

#include <algorithm>

#include "dspic30/asm/device_names.h"
#include "dspic30/asm/expression.h"
#include "dspic30/asm/instruction_text.h"
#include "dspic30/asm/section_text.h"
#include "dspic30/asm/source_lines.h"
#include "dspic30/memory/program_memory.h"
#include "dspic30/memory/sfr_table.h"
#include "dspic30/periph/nvm.h"
#include "dspic30/periph/vectors.h"

namespace dspic::assembly {

namespace {

constexpr std::uint32_t kCodeStart = 0x100, kRamStart = 0x800, kRamEnd = 0x2800, kPsvPage = 0x8000;
// between the last word below SPLIM and the end of RAM, bytes: the call that goes beyond it, the trap's entry
// and the pushes of its handler; a frame comes on top
constexpr std::uint32_t kLeastGuard = 16;
constexpr std::uint32_t kVectors0 = 0x04, kAlternate0 = 0x84;
constexpr std::int64_t kMostBytes = 0x18000;  // of a section
constexpr std::int64_t kMostInAll = 2 * kMostBytes;
constexpr std::int64_t kMostAddress = 0xFFFFFE;
constexpr std::size_t kMostMessages = 50;
constexpr int kDeepestSymbols = 20;  // .equ in terms of .equ

using Kind = SectionKind;

/// Places count 2 for a word of program memory, 1 for a byte of data.
struct Section {
  Kind kind = Kind::Code;
  std::uint32_t size = 0, base = 0;
  std::int64_t address = -1;  // asked for; -1: anywhere
  std::int64_t align = 2;
};

struct Place {
  std::size_t section = 0;
  std::uint32_t offset = 0;
};

struct Symbol {
  bool is_label = false;
  Place place;            // of a label; where an .equ stands
  std::string text;       // of an .equ
  std::size_t index = 0;  // statement
  // its value as of a generation of symbols; what is being evaluated is not known
  std::uint64_t as_of = 0;
  bool is_known = false;
  std::int64_t value = 0;
};

/// What is put into a section once all values are known.
struct Item {
  Statement where;
  Place place;
  std::size_t index = 0;
  Choice choice;                    // an instruction
  int bytes = 0;                    // of each value; 3 is a whole program word
  std::vector<std::string> values;  // expressions
};

// what "name" or "_name" of the device header stands for
bool device_value(const std::string& symbol, std::int64_t& value) {
  const std::string name = symbol.size() > 1 && symbol[0] == '_' ? symbol.substr(1) : symbol;
  const SfrInfo* const info = sfr_named(name);
  if (info) value = info->address;
  return info || device_constant(name, value);
}

class Assembly final : private SourceLines::Listener {
 public:
  Assembly(const Includes& includes) : lines_(*this, includes) { enter_section(".text", Kind::Code); }

  Image run(const std::string& text, const std::string& file) {
    lines_.read(text, file);
    place_sections();
    if (image_.is_whole()) find_guard();
    if (image_.is_whole())
      for (const Item& item : items_) put(item);
    if (image_.is_whole()) put_vectors();
    for (const auto& [name, symbol] : symbols_)
      if (symbol.is_label) image_.symbols[name] = sections_[symbol.place.section].base + symbol.place.offset;
    return std::move(image_);
  }

 private:
  // --- SourceLines::Listener
  void complain(const std::string& file, int line, const std::string& text) override {
    if (image_.messages.size() < kMostMessages) image_.messages.push_back({file, line, text});
  }
  bool is_defined(const std::string& symbol) override { return symbols_.count(symbol) != 0; }
  std::int64_t value_now(const std::string& expression) override { return value(expression, index_, here()); }

  void statement(const Statement& s) override {
    current_ = s;
    ++index_;
    for (const std::string& label : s.labels) define_label(label);
    if (s.name.empty()) return;
    if (directive(s)) return;
    if (s.name[0] == '.' && s.name != ".")
      return complain(s.file, s.line, "unknown directive '" + s.name + "'");
    instruction(s);
  }

  void complain(const std::string& text) { complain(current_.file, current_.line, text); }

  // --- places
  Section& section() { return sections_[now_]; }
  Place here() const { return {now_, sections_[now_].size}; }

  void enter_section(const std::string& name, Kind kind) {
    const auto found = section_names_.find(name);
    if (found != section_names_.end()) {
      now_ = found->second;
      return;
    }
    now_ = section_names_[name] = sections_.size();
    sections_.push_back({});
    section().kind = kind;
  }

  /// Is there for so many more bytes? Complains if not.
  bool has_room(std::int64_t bytes) {
    const bool is_section_full = bytes < 0 || section().size + bytes > kMostBytes;
    if (!is_section_full && in_all_ + bytes <= kMostInAll) return true;
    complain(std::string(is_section_full ? "the section grows" : "all sections grow") + " beyond " +
             std::to_string(is_section_full ? kMostBytes : kMostInAll) + " bytes");
    return false;
  }
  void grow(std::int64_t bytes) {
    if (!has_room(bytes)) return;
    section().size += static_cast<std::uint32_t>(bytes);
    in_all_ += bytes;
  }

  void align(std::int64_t to) {
    if (to < 1 || to > kPsvPage || (to & (to - 1)))
      return complain("alignment: got " + std::to_string(to) + ", expected a power of two");
    section().align = std::max(section().align, to);
    grow((to - section().size % to) % to);
  }

  // --- symbols
  void define_label(const std::string& label) {
    if (section().kind == Kind::Code && section().size % 2) grow(1);
    if (label.size() == 1 && label[0] >= '0' && label[0] <= '9') {
      numbered_[label].push_back({here(), index_});
      return;
    }
    define(label, {true, here(), "", index_});
  }

  void define(const std::string& name, Symbol symbol, bool may_change = false) {
    if (name.empty() || !std::all_of(name.begin(), name.end(), continues_name) || !begins_name(name[0]))
      return complain("'" + name + "' is no name");
    if (symbols_.count(name) && !may_change) return complain("'" + name + "' is defined twice");
    symbols_[name] = std::move(symbol);
    ++generation_;
  }

  bool numbered(const std::string& name, std::size_t index, std::int64_t& value) const {
    const auto all = numbered_.find(name.substr(0, 1));
    if (all == numbered_.end()) return false;
    const std::pair<Place, std::size_t>* best = nullptr;
    for (const auto& label : all->second) {
      if (name[1] == 'b' && label.second <= index) best = &label;
      if (name[1] == 'f' && label.second > index && !best) best = &label;
    }
    if (best) value = sections_[best->first.section].base + best->first.offset;
    return best != nullptr;
  }

  bool symbol_value(const std::string& name, std::size_t index, const Place& place, std::int64_t& value) {
    if (name == ".") {
      value = sections_[place.section].base + place.offset;
      return placed_;
    }
    if (name.size() == 2 && name[0] >= '0' && name[0] <= '9') return placed_ && numbered(name, index, value);
    const auto found = symbols_.find(name);
    if (found == symbols_.end()) return link_value(name, value) || device_value(name, value);
    Symbol& symbol = found->second;
    if (symbol.is_label) {
      value = sections_[symbol.place.section].base + symbol.place.offset;
      return placed_;
    }
    if (symbol.as_of != generation_ && depth_ < kDeepestSymbols) {
      symbol.as_of = generation_;
      symbol.is_known = false;  // in terms of itself
      ++depth_;
      std::string error;
      const bool known = evaluate(symbol.text, resolver(symbol.index, symbol.place), handles_, value, error);
      --depth_;
      symbol.is_known = known;
      symbol.value = value;
    }
    value = symbol.value;
    return symbol.as_of == generation_ && symbol.is_known;
  }

  bool link_value(const std::string& name, std::int64_t& value) const {
    if (name == "__SP_init")
      value = stack_start_;
    else if (name == "__SPLIM_init")
      value = kRamEnd - guard_ - 2;
    else
      return false;
    return placed_;
  }

  Symbols resolver(std::size_t index, const Place& place) {
    return [this, index, place](const std::string& name, std::int64_t& value) {
      return symbol_value(name, index, place, value);
    };
  }

  std::int64_t value(const std::string& text, std::size_t index, const Place& place) {
    std::int64_t value = 0;
    std::string error;
    if (evaluate(text, resolver(index, place), handles_, value, error)) return value;
    complain(error + (placed_ || symbols_.count(text) == 0 ? "" : ": its value is not known here"));
    return 0;
  }

  // --- statements
  void instruction(const Statement& s) {
    if (s.name == "config") return configure(s);
    Item item{s, {}, index_, {}, 0, {}};
    item.choice = choose(s.name, s.operands, [this](const std::string& text) { complain(text); });
    if (!item.choice.row) return;
    if (section().kind != Kind::Code) return complain("an instruction outside a code section");
    if (section().size % 2) grow(1);
    item.place = here();
    grow(2 * item.choice.row->words);
    items_.push_back(std::move(item));
  }

  // config __FOSC, value
  void configure(const Statement& s) {
    const std::vector<std::string> parts = split(s.operands);
    if (parts.size() != 2) return complain("config: expected a word's name and its value");
    const std::uint32_t address = configuration_address(parts[0]);
    if (address == 0) return complain("config: unknown word '" + parts[0] + "'");
    image_.program[address] = static_cast<std::uint32_t>(value_now(parts[1])) & 0xFFFF;
  }

  void values(const Statement& s, int bytes) {
    if (section().kind == Kind::Ram) return complain(s.name + ": RAM has no values before the program runs");
    if (bytes == 3 && section().kind != Kind::Code) return complain(".pword outside a code section");
    if (bytes != 1) grow(section().size % 2);
    Item item{s, here(), index_, {}, bytes, split(s.operands)};
    grow(static_cast<std::int64_t>(item.values.size()) * (bytes == 3 ? 2 : bytes));
    items_.push_back(std::move(item));
  }

  void characters(const Statement& s, bool with_zero) {
    if (section().kind == Kind::Ram) return complain(s.name + ": RAM has no values before the program runs");
    Item item{s, here(), index_, {}, 1, {}};
    for (const std::string& part : split(s.operands)) {
      if (part.size() < 2 || part.front() != '"' || part.back() != '"')
        return complain(s.name + ": expected text in quotes");
      for (std::size_t i = 1; i + 1 < part.size(); ++i) {
        char c = part[i];
        if (c == '\\' && i + 2 < part.size()) {
          c = part[++i];
          c = c == 'n' ? '\n' : c == 'r' ? '\r' : c == 't' ? '\t' : c == '0' ? '\0' : c;
        }
        item.values.push_back(std::to_string(static_cast<unsigned char>(c)));
      }
      if (with_zero) item.values.push_back("0");
    }
    grow(static_cast<std::int64_t>(item.values.size()));
    items_.push_back(std::move(item));
  }

  void space(const Statement& s) {
    const std::vector<std::string> parts = split(s.operands);
    if (parts.empty()) return complain(s.name + ": how many bytes?");
    const std::int64_t bytes = value_now(parts[0]);
    if (bytes < 0 || bytes > kMostBytes)
      return complain(s.name + ": got " + std::to_string(bytes) + " bytes, expected 0 to " +
                      std::to_string(kMostBytes));
    if (!has_room(bytes)) return;
    if (section().kind != Kind::Ram) {
      Item item{s,
                here(),
                index_,
                {},
                1,
                std::vector<std::string>(static_cast<std::size_t>(bytes), parts.size() > 1 ? parts[1] : "0")};
      items_.push_back(std::move(item));
    }
    grow(bytes);
  }

  void equate(const Statement& s, bool may_change) {
    const std::vector<std::string> parts = split(s.operands);
    if (parts.size() != 2) return complain(s.name + ": expected a name and a value");
    std::string text = parts[1];
    if (may_change && symbols_.count(parts[0]))
      text = std::to_string(value_now(text));  // perhaps in terms of itself
    define(parts[0], {false, here(), text, index_}, may_change);
  }

  // .comm name, bytes: one place in RAM
  void common(const Statement& s) {
    const std::vector<std::string> parts = split(s.operands);
    if (parts.size() < 2) return complain(s.name + ": expected a name and a number of bytes");
    const std::size_t before = now_;
    enter_section(".bss", Kind::Ram);
    align(2);
    define(parts[0], {true, here(), "", index_});
    grow(value_now(parts[1]));
    now_ = before;
  }

  void choose_section(const Statement& s) {
    SectionText text;
    if (!read_section(s.operands, text, [this](const std::string& message) { complain(message); })) return;
    if (text.is_info) return complain(".section: info is no part of a program; leave it out");
    enter_section(text.name, text.kind);
    section().kind = text.kind;
    const std::int64_t address = text.address.empty() ? -1 : value_now(text.address);
    if (address > kMostAddress)
      complain(".section: got address " + std::to_string(address) + ", expected at most " +
               std::to_string(kMostAddress));
    else if (address >= 0)
      section().address = address & ~std::int64_t{1};
    if (!text.alignment.empty()) align(value_now(text.alignment));
  }

  bool directive(const Statement& s) {
    static const std::map<std::string, int> kWidths = {{".byte", 1},  {".word", 2}, {".hword", 2},
                                                       {".short", 2}, {".int", 2},  {".2byte", 2},
                                                       {".pword", 3}, {".long", 4}, {".4byte", 4}};
    static const std::set<std::string> kIgnored = {
        ".global", ".globl", ".extern", ".weak", ".local",  ".type",  ".size",  ".file",   ".loc",
        ".ident",  ".title", ".sbttl",  ".list", ".nolist", ".psize", ".eject", ".equiv_", ".version"};
    if (const auto width = kWidths.find(s.name); width != kWidths.end())
      return values(s, width->second), true;
    if (kIgnored.count(s.name)) return true;
    if (s.name == ".section") return choose_section(s), true;
    if (s.name == ".text") return enter_section(".text", Kind::Code), true;
    if (s.name == ".data" || s.name == ".bss") return enter_section(".bss", Kind::Ram), true;
    if (s.name == ".equ" || s.name == ".set") return equate(s, true), true;
    if (s.name == ".equiv") return equate(s, false), true;
    if (s.name == ".ascii") return characters(s, false), true;
    if (s.name == ".asciz" || s.name == ".string") return characters(s, true), true;
    if (s.name == ".space" || s.name == ".skip" || s.name == ".zero") return space(s), true;
    if (s.name == ".align" || s.name == ".palign" || s.name == ".balign")
      return align(value_now(split(s.operands).empty() ? "" : split(s.operands)[0])), true;
    if (s.name == ".comm" || s.name == ".lcomm") return common(s), true;
    if (s.name == ".org") {
      const std::int64_t to = value_now(s.operands);
      if (to < section().size)
        complain(".org: got " + std::to_string(to) + ", expected at least " + std::to_string(section().size));
      else
        grow(to - section().size);
      return true;
    }
    return false;
  }

  // --- placing: sections with an address first, the others behind what is there
  void place_sections() {
    std::uint32_t code = kCodeStart, ram = kRamStart, eeprom = kEepromStart;
    const auto free_from = [&](Kind kind) -> std::uint32_t& {
      return kind == Kind::Ram ? ram : kind == Kind::Eeprom ? eeprom : code;
    };
    for (Section& s : sections_)
      if (s.address >= 0) s.base = static_cast<std::uint32_t>(s.address);
    for (Section& s : sections_) {
      if (s.address >= 0 || s.size == 0) continue;
      std::uint32_t& at = free_from(s.kind);
      const auto to = static_cast<std::uint32_t>(s.align);
      if (s.kind == Kind::Constants && s.size > kPsvPage)
        return complain(
            "", 0,
            "a section of constants has " + std::to_string(s.size) + " bytes, a page of the window 32768");
      // Up to the next place where nothing lies that has an address.
      for (bool moved = true; moved && at <= kFlashEnd + kEepromStart;) {
        moved = false;
        at = (at + to - 1) / to * to;
        // constants do not cross a page of the window
        if (s.kind == Kind::Constants && at / kPsvPage != (at + s.size - 1) / kPsvPage)
          at = (at / kPsvPage + 1) * kPsvPage, moved = true;
        for (const Section& other : sections_)
          if (other.address >= 0 && other.size > 0 && (other.kind == Kind::Ram) == (s.kind == Kind::Ram) &&
              at < other.base + other.size && other.base < at + s.size)
            at = (other.base + other.size + 1) & ~1u, moved = true;
      }
      s.base = at;
      at += (s.size + 1) & ~1u;
    }
    // The stack begins behind all data.
    stack_start_ = ram;
    for (const Section& s : sections_)
      stack_start_ = std::max(stack_start_, s.kind == Kind::Ram ? (s.base + s.size + 1) & ~1u : 0);
    if (code > kFlashEnd)
      complain("", 0,
               "the program needs " + std::to_string(code / 2) + " words, the flash has " +
                   std::to_string(kFlashWords));
    if (stack_start_ > kRamEnd)
      complain("", 0,
               "the data need " + std::to_string(stack_start_ - kRamStart) + " bytes, the RAM has 8192");
    placed_ = true;
    ++generation_;
  }

  // the largest frame finds RAM above SPLIM; but frames that fit one above another are not stopped for that
  void find_guard() {
    std::uint32_t largest = 0, all = 0;
    for (const Item& item : items_) {
      if (!item.choice.row || item.choice.row->id != Insn::Lnk_lit14) continue;
      current_ = item.where;
      const auto words = encode(
          item.choice, 0, [&](const std::string& text) { return value(text, item.index, item.place); },
          [](const std::string&) {});
      if (words.empty()) continue;
      const std::uint32_t frame = 2 + 2 * fields_of(*item.choice.row, words[0]).k;
      largest = std::max(largest, frame);
      all += frame;
    }
    const std::uint32_t room = kRamEnd - std::min(stack_start_, kRamEnd), taken = all + kLeastGuard;
    guard_ = std::max(kLeastGuard, std::min(largest + kLeastGuard, room > taken ? room - taken : 0)) & ~1u;
  }

  // --- values
  void put(const Item& item) {
    current_ = item.where;
    Place place = item.place;
    const std::uint32_t address = sections_[place.section].base + place.offset;
    const Value value_here = [&](const std::string& text) { return value(text, item.index, place); };
    if (item.choice.row) {
      std::uint32_t at = address;
      for (const std::uint32_t word :
           encode(item.choice, address, value_here, [this](const std::string& text) { complain(text); })) {
        put_word(at, word);
        at += 2;
      }
      return;
    }
    for (const std::string& text : item.values) {
      const std::int64_t v = value_here(text);
      const std::int64_t limit = std::int64_t{1} << 8 * item.bytes;
      if (v >= limit || v < -limit / 2)
        complain(text + ": got " + std::to_string(v) + ", which does not fit " + item.where.name);
      const std::uint32_t at = sections_[place.section].base + place.offset;
      if (item.bytes == 1)
        put_byte(at, static_cast<std::uint32_t>(v) & 0xFF);
      else
        put_word(at, static_cast<std::uint32_t>(v) & (item.bytes == 3 ? 0xFFFFFF : 0xFFFF));
      if (item.bytes == 4) put_word(at + 2, static_cast<std::uint32_t>(v >> 16) & 0xFFFF);
      place.offset += item.bytes == 3 ? 2 : static_cast<std::uint32_t>(item.bytes);
    }
  }

  void put_word(std::uint32_t address, std::uint32_t word) {
    if (!image_.program.emplace(address, word).second)
      complain("two things stand at program address " + std::to_string(address));
  }
  void put_byte(std::uint32_t address, std::uint32_t byte) {
    std::uint32_t& word = image_.program.emplace(address & ~1u, 0).first->second;
    word |= byte << 8 * (address & 1);
  }

  void put_vectors() {
    const auto address = [&](const std::string& name, std::uint32_t& at) {
      const auto found = symbols_.find(name);
      if (found == symbols_.end() || !found->second.is_label) return false;
      at = sections_[found->second.place.section].base + found->second.place.offset;
      return true;
    };
    std::uint32_t start = 0;
    if (!address("__reset", start))
      for (const Item& item : items_)
        if (item.choice.row) {
          start = sections_[item.place.section].base + item.place.offset;
          break;
        }
    if (start == 0) return;  // nothing to run, or it stands at 0 itself
    image_.program.emplace(0, 0x040000 | (start & 0xFFFF));
    image_.program.emplace(2, start >> 16);
    for (int vector = 1; vector < kVectors; ++vector) {
      const std::string name = vector_name(vector), is_trap = vector < kFirstIrqVector ? "" : "Interrupt";
      std::uint32_t handler = 0;
      const bool known = name != "?" && address("__" + name + is_trap, handler);
      if (known || address("__DefaultInterrupt", handler))
        image_.program.emplace(kVectors0 + 2 * static_cast<std::uint32_t>(vector), handler);
      if ((name != "?" && address("__Alt" + name + is_trap, handler)) ||
          address("__DefaultInterrupt", handler))
        image_.program.emplace(kAlternate0 + 2 * static_cast<std::uint32_t>(vector), handler);
    }
  }

  SourceLines lines_;
  Image image_;
  std::vector<Section> sections_;
  std::int64_t in_all_ = 0;  // their sizes
  std::map<std::string, std::size_t> section_names_;
  std::size_t now_ = 0;
  std::map<std::string, Symbol> symbols_;
  std::map<std::string, std::vector<std::pair<Place, std::size_t>>> numbered_;
  std::vector<Item> items_;
  std::size_t index_ = 0;
  Statement current_;
  bool placed_ = false;
  std::uint64_t generation_ = 1;  // of symbols: what was evaluated before is old
  int depth_ = 0;
  std::uint32_t stack_start_ = kRamStart, guard_ = kLeastGuard;
  const Handles handles_ = [this](std::int64_t address) {
    if (address > 0xFFFF) complain("handle(): the function lies beyond 0xFFFF");
    return address;
  };
};

}  // namespace

std::string Image::report() const {
  std::string all;
  for (const Message& m : messages) all += m.file + ":" + std::to_string(m.line) + ": " + m.text + "\n";
  return all;
}

Image assemble(const std::string& text, const std::string& file, const Includes& includes) {
  return Assembly(includes).run(text, file);
}

}  // namespace dspic::assembly
