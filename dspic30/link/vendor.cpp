// SPDX-License-Identifier: MIT
// Objects of XC16 and of the older C30, made what ours are. They differ in three ways (facts that their
// objects show; those of C30 say the chip's number 0 and have a symbol __C30ELF instead):
//
//   bytes of data    two octets each, of which the second says nothing, so sizes and offsets are twice ours
//   labels of code   count program addresses, two a word; ours count octets, four a word
//   relocations      without addend; what the place holds already is added, and two more types mean a handle
//
// Besides, its compiler writes into the name of a call of printf() and its like which
// conversions the format has.
#include "dspic30/link/link.h"
#include "dspic30/link/relocations.h"

namespace dspic::link {

using namespace llvm::dspic_elf;

namespace {

constexpr unsigned kHandle = 11, kLiteralHandle = 16;  // of a function, in data and in MOV #lit16

std::uint32_t word_at(const Section& s, std::uint32_t offset, std::uint32_t octets) {
  std::uint32_t word = 0;
  for (std::uint32_t i = 0; i < octets; ++i) word |= std::uint32_t(s.bytes[offset + i]) << 8 * i;
  return word;
}

/// What the place adds to the symbol, in our octets; `of_code`: the symbol is a label of code.
std::int32_t addend_at(const Section& s, std::uint32_t offset, unsigned type, bool of_code) {
  const std::uint32_t octets = type == kByte ? 1 : type == kWord ? 2 : 4, word = word_at(s, offset, octets);
  std::int32_t addend = 0;
  switch (type) {
    case kByte:
      addend = static_cast<std::int32_t>((word & 0xFF) ^ 0x80) - 0x80;  // it has a sign
      break;
    case kWord:
      addend = std::int16_t(word);
      break;
    case kLong:
      addend = std::int32_t(word);
      break;
    case kNearByte:
    case kNear:
      addend = std::int32_t(word & 0x1FFF);
      break;
    case kFile:
    case kCallLow:
      addend = std::int16_t(word);
      break;
    case kFileOfMove:
      addend = std::int16_t((word >> 4 & 0x7FFF) << 1);
      break;
    case kBranch:
    case kDoEnd:
      addend = 2 * std::int16_t(word);
      break;
    case kCallHigh:
      return 0;  // the low half has it
    default:     // literals of MOV
      addend = std::int16_t(word >> 4 & 0xFFFF);
  }
  return of_code ? 2 * addend : addend;
}

bool is_known(unsigned type) {
  for (const auto& fixup : llvm::kFixups)
    if (fixup.relocation == type) return true;
  return type == kByte || type == kWord || type == kLong;
}

}  // namespace

std::string name_of_library(const std::string& name) {
  static const char* const kFormatted[] = {"fprintf",  "fscanf",    "printf",  "scanf",
                                           "snprintf", "sprintf",   "sscanf",  "vfprintf",
                                           "vprintf",  "vsnprintf", "vsprintf"};
  for (const char* function : kFormatted) {
    const std::string start = std::string("__") + function + "_";
    if (name.rfind(start, 0) != 0 || name.size() == start.size()) continue;
    if (name.find_first_not_of("0123456789acdefginopsuxAEFGX", start.size()) == std::string::npos)
      return std::string("_") + function;
  }
  return name;
}

void drop_phantom_octets(Section& s) {
  if (s.kind == Kind::Code) return;
  s.size /= 2;
  for (std::size_t i = 0; i < s.bytes.size() / 2; ++i) s.bytes[i] = s.bytes[2 * i];
  s.bytes.resize(s.bytes.size() / 2);
}

bool add_vendor_relocation(Section& s, std::uint32_t offset, unsigned type, Symbol& symbol) {
  if (type == kNone) return true;
  const bool is_handle = type == kHandle || type == kLiteralHandle;
  if (is_handle) type = type == kHandle ? kWord : kLiteral16;
  if (!is_known(type)) return false;
  if (s.kind != Kind::Code) offset /= 2;
  if (offset + (s.kind == Kind::Code ? 4 : 1) > s.bytes.size()) return false;
  const bool is_jump = type == kBranch || type == kDoEnd || type == kCallLow;
  const bool of_code = is_handle || is_jump || (symbol.section && symbol.section->kind == Kind::Code);
  s.relocations.push_back({offset, type, &symbol, addend_at(s, offset, type, of_code)});
  return true;
}

}  // namespace dspic::link
