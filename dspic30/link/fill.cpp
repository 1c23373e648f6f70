// SPDX-License-Identifier: MIT
// Addresses into instructions, data and debugging information; then the words of the image.
#include <algorithm>
#include <memory>
#include <set>

#include "dspic30/link/link.h"
#include "dspic30/link/memory_spaces.h"
#include "dspic30/link/relocations.h"
#include "dspic30/periph/vectors.h"

namespace dspic::link {

namespace {

using namespace llvm::dspic_elf;

constexpr std::uint32_t kGoto = 0x040000;

/// Messages with function and line; of one name in one function one.
class Mistakes {
 public:
  explicit Mistakes(Program& program) : program_(program) {}

  void add(const Section& section, std::uint32_t offset, const std::string& text) {
    program_.errors.push_back(places().line(section, offset) + ": error: " + text);
  }

  /// "main.c:12: error: drive() calls blink(): got no definition, ...".
  void add_undefined(const Section& section, const Relocation& r) {
    const bool is_call = r.type == kBranch || r.type == kCallLow || r.type == kCallHigh;
    std::string user = section.kind == Kind::Code ? places().function(section, r.offset) : "";
    if (!told_.insert(section.from + " " + user + " " + r.symbol->name).second) return;
    user = user.empty() ? "uses " : user + (is_call ? "() calls " : "() uses ");
    add(section, r.offset,
        user + in_c(r.symbol->name) + (is_call ? "()" : "") +
            ": got no definition, expected one in the program or the library" +
            (program_.unread.empty() ? "" : "; " + program_.unread));
  }

 private:
  const Whereabouts& places() {
    if (!places_) places_ = std::make_unique<Whereabouts>(program_);
    return *places_;
  }
  Program& program_;
  std::unique_ptr<Whereabouts> places_;
  std::set<std::string> told_;
};

/// Fills one section's places.
class Filler {
 public:
  Filler(Program& program, Section& section, Mistakes& mistakes)
      : program_(program), section_(section), mistakes_(mistakes) {}

  void fill() {
    for (const Relocation& r : section_.relocations) {
      if (r.offset + width(r.type) > section_.bytes.size()) {
        complain(r, "a place outside its section");
        continue;
      }
      if (!resolve(r)) continue;
      apply(r);
    }
  }

 private:
  static std::uint32_t width(unsigned type) { return type == kByte ? 1 : type == kWord ? 2 : 4; }

  void complain(const Relocation& r, const std::string& text) {
    mistakes_.add(section_, r.offset, in_c(r.symbol->name) + ": " + text);
  }

  /// False: nothing to fill in.
  bool resolve(const Relocation& r) {
    const Symbol& s = *r.symbol;
    value_ = 0;
    if (section_.kind == Kind::Debug && s.section && s.section->kind != Kind::Debug && !s.section->used)
      return true;  // of a function that was left out
    if (!s.is_defined) {
      if (s.is_weak) return true;
      mistakes_.add_undefined(section_, r);
      return false;
    }
    value_ = program_.address_of(s, r.addend);
    is_code_ = s.section && s.section->kind == Kind::Code;
    return true;
  }

  /// Where a GOTO to the function lies.
  std::uint32_t jump() {
    const auto next = program_.handles_at + 4 * std::uint32_t(program_.handles.size());
    return program_.handles.emplace(value_, next).first->second;
  }
  /// A function as 16 bits: its address, or that of a GOTO to it where that is too far up.
  std::uint32_t handle() { return !is_code_ || value_ <= 0xFFFF ? value_ : jump(); }

  void checked(const Relocation& r, bool fits, const char* expected) {
    char got[16];
    std::snprintf(got, sizeof got, "0x%X", value_);
    if (!fits) complain(r, std::string("got address ") + got + ", expected " + expected);
  }

  void apply(const Relocation& r) {
    // program address of the word being filled
    const std::uint32_t here = section_.address + r.offset / 2;
    switch (r.type) {
      case kByte:
        return put(r.offset, 1, value_);
      case kWord:
        return put(r.offset, 2, section_.kind == Kind::Debug ? value_ : handle());
      case kLong:
        return put(r.offset, 4, value_);
      case kNearByte:
        checked(r, value_ < 0x2000, "below 0x2000: a near variable");
        return insert(r.offset, 0, 0x1FFF, value_);
      case kNear:
        checked(r, value_ < 0x2000 && !(value_ & 1), "even and below 0x2000: a near variable");
        return insert(r.offset, 0, 0x1FFE, value_);  // the lowest bit is BSET's own
      case kFile:
        checked(r, !(value_ & 1), "even");
        return insert(r.offset, 0, 0xFFFF, value_);
      case kFileOfMove:
        checked(r, !(value_ & 1), "even");
        return insert(r.offset, 4, 0x7FFF, value_ >> 1);
      case kLiteral16:
        return insert(r.offset, 4, 0xFFFF, handle());
      case llvm::dspic_elf::kPsvOffset:
        return insert(r.offset, 4, 0xFFFF, (program_address(r) & 0x7FFF) | 0x8000);
      case llvm::dspic_elf::kPsvPage:
        return insert(r.offset, 4, 0xFFFF, program_address(r) >> 15);
      case llvm::dspic_elf::kTableOffset:
        return insert(r.offset, 4, 0xFFFF, program_address(r) & 0xFFFF);
      case llvm::dspic_elf::kTablePage:
        return insert(r.offset, 4, 0xFFFF, program_address(r) >> 16);
      case kBranch:
      case kDoEnd: {
        const auto words_to = [&](std::uint32_t to) {
          return (std::int32_t(to) - std::int32_t(here) - 2) / 2;
        };
        const auto reaches = [](std::int32_t words) { return words >= -0x8000 && words <= 0x7FFF; };
        std::int32_t words = words_to(value_);
        // a call that is too far goes by a jump in between
        if (!reaches(words) && is_code_ && r.type == kBranch) words = words_to(jump());
        checked(r, reaches(words), "within 32767 words of the branch");
        return insert(r.offset, 0, 0xFFFF, std::uint32_t(words));
      }
      case kCallLow:
        return insert(r.offset, 0, 0xFFFE, value_);
      case kCallHigh:
        return insert(r.offset, 0, 0x7F, value_ >> 16);
    }
    complain(r, "relocation " + std::to_string(r.type) + " is not known here");
  }

  /// Where table instructions find it: of a constant not what the window shows.
  std::uint32_t program_address(const Relocation& r) const {
    const Section* s = r.symbol->section;
    if (!s || s->kind == Kind::Code || s->kind == Kind::Ram) return value_;
    return s->load + r.symbol->value + std::uint32_t(r.addend);
  }

  void put(std::uint32_t at, int octets, std::uint32_t v) {
    for (int i = 0; i < octets; ++i) section_.bytes[at + std::uint32_t(i)] = std::uint8_t(v >> 8 * i);
  }
  void insert(std::uint32_t at, unsigned shift, std::uint32_t mask, std::uint32_t v) {
    std::uint32_t word = 0;
    for (unsigned i = 0; i < 4; ++i) word |= std::uint32_t(section_.bytes[at + i]) << 8 * i;
    put(at, 4, (word & ~(mask << shift)) | (v & mask) << shift);
  }

  Program& program_;
  Section& section_;
  Mistakes& mistakes_;
  std::uint32_t value_ = 0;
  bool is_code_ = false;
};

// --- words

void put_code(Program& program, const Section& s) {
  for (std::uint32_t i = 0; i + 4 <= s.bytes.size(); i += 4)
    program.words[s.address + i / 2] = s.bytes[i] | s.bytes[i + 1] << 8 | s.bytes[i + 2] << 16;
}

/// Two bytes a word: constants, tables, EEPROM.
void put_bytes(Program& program, const Section& s) {
  for (std::uint32_t i = 0; i < s.bytes.size(); ++i) {
    auto& word = program.words[(s.load + i) & ~1u];
    word = (word & ~(0xFFu << 8 * ((s.load + i) & 1))) | std::uint32_t(s.bytes[i]) << 8 * ((s.load + i) & 1);
  }
}

/// XC16's table: destination, bytes, format (0 clear, 1 copy), the data in words; 0 ends it.
void put_dinit(Program& program) {
  constexpr std::uint32_t kClear = 0, kCopy = 1;
  std::uint32_t at = program.dinit;
  const auto put = [&](std::uint32_t word) {
    program.words[at] = word & 0xFFFF;
    at += 2;
  };
  for (const Section& s : program.sections) {
    if (!s.used || s.kind != Kind::Ram || s.flags & kPersistent || !s.size) continue;
    put(s.address), put(s.size), put(s.zeroed ? kClear : kCopy);
    for (std::uint32_t i = 0; i < s.bytes.size(); i += 2)
      put(s.bytes[i] | (i + 1 < s.bytes.size() ? s.bytes[i + 1] << 8 : 0));
  }
  put(0);
}

void put_jumps(Program& program) {
  const auto jump = [&](std::uint32_t at, std::uint32_t to) {
    program.words[at] = kGoto | (to & 0xFFFE);
    program.words[at + 2] = to >> 16;
  };
  for (const auto& [function, at] : program.handles) jump(at, function);
  jump(0, program.address_of(*program.global("__reset")));
}

}  // namespace

std::uint32_t Program::address_of(const Symbol& symbol, std::int32_t addend) const {
  const std::uint32_t offset = symbol.value + std::uint32_t(addend);
  if (!symbol.section) return offset;
  // code counts four octets a word, two addresses
  return symbol.section->address + (symbol.section->kind == Kind::Code ? offset / 2 : offset);
}

void put_vectors(Program& program) {
  constexpr std::uint32_t kVectors0 = 0x04, kAlternate0 = 0x84;
  const auto target = [&](const std::string& name) -> std::uint32_t {
    const auto it = program.globals.find(name);
    const bool is_there = it != program.globals.end() && it->second->is_defined &&
                          (!it->second->section || it->second->section->used);
    return is_there ? program.address_of(*it->second) : 0;
  };
  const std::uint32_t otherwise = target("__DefaultInterrupt");
  for (int v = 0; v < kVectors; ++v) {
    const std::uint32_t usual = v ? target("__" + handler_name(v)) : 0,
                        alternate = v ? target("__Alt" + handler_name(v)) : 0;
    program.words[kVectors0 + 2 * std::uint32_t(v)] = usual ? usual : otherwise;
    program.words[kAlternate0 + 2 * std::uint32_t(v)] = alternate ? alternate : otherwise;
  }
}

void put_section(Program& program, const Section& s) {
  if (s.kind == Kind::Ram || s.kind == Kind::Debug) return;
  s.kind == Kind::Code ? put_code(program, s) : put_bytes(program, s);
}

void refill_debug(Program& program) {
  Mistakes mistakes(program);
  for (Section& s : program.sections)
    if (s.kind == Kind::Debug) Filler(program, s, mistakes).fill();
}

void fill_for(Program& program, const Symbol& symbol) {
  Mistakes mistakes(program);
  for (Section& s : program.sections) {
    const bool asks = std::any_of(s.relocations.begin(), s.relocations.end(),
                                  [&](const Relocation& r) { return r.symbol == &symbol; });
    if (!s.used || !asks) continue;
    Filler(program, s, mistakes).fill();
    put_section(program, s);
  }
}

void fill_all(Program& program) {
  Mistakes mistakes(program);
  for (Section& s : program.sections)
    if (s.used) Filler(program, s, mistakes).fill();
  if (!program.errors.empty()) return;
  put_dinit(program);
  put_jumps(program);
  put_vectors(program);
  for (const Section& s : program.sections)
    if (s.used) put_section(program, s);
}

}  // namespace dspic::link
