// SPDX-License-Identifier: MIT
#include "dspic30/llvm/asm_directives.h"

#include "dspic30/asm/device_names.h"
#include "dspic30/asm/expression.h"
#include "dspic30/asm/section_text.h"
#include "dspic30/link/memory_spaces.h"
#include "llvm/ADT/StringExtras.h"
#include "llvm/MC/MCContext.h"
#include "llvm/MC/MCExpr.h"
#include "llvm/MC/MCSectionELF.h"
#include "llvm/MC/MCStreamer.h"

namespace llvm {

namespace assembly = dspic::assembly;

namespace {

using dspic_elf::kWordOctets;

/// A section whose name alone says what it is, to us but not to LLVM; or one with the vendor's attributes.
bool is_vendors_section(const std::string& operands) {
  const std::vector<std::string> parts = assembly::split(operands);
  if (parts.size() < 2) return !parts.empty() && dspic_elf::space_of(parts[0]);
  return parts[1][0] != '"' || StringRef("\"x\" \"b\" \"d\" \"r\" \"n\"").contains(parts[1]);
}

}  // namespace

std::string without_asm_comments(StringRef text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const StringRef here = text.substr(i);
    if (here.startswith("/*")) {
      out += ' ';
      i = std::min(text.find("*/", i + 2), text.size()) + 1;
    } else if (here[0] == ';' || here.startswith("//")) {
      i = std::min(text.find('\n', i), text.size());
      out += ' ';
    } else if (here[0] == '\n' || here[0] == '\r') {
      out += ' ';
    } else if (here[0] == '\'') {  // a character, whose second quote may be missing
      const std::size_t length = here.size() > 1 && here[1] == '\\' ? 3 : 2;
      out += here.take_front(length);
      i += std::min(length, here.size()) - 1;
    } else if (here[0] == '"') {
      const std::size_t end = std::min(text.find('"', i + 1), text.size() - 1);
      out += text.slice(i, end + 1);
      i = end;
    } else {
      out += here[0];
    }
  }
  return out;
}

bool DSPICDirectives::is_in_code() const {
  const auto* section = cast_or_null<MCSectionELF>(parser_.getStreamer().getCurrentSectionOnly());
  return section && section->getFlags() & ELF::SHF_EXECINSTR;
}

// what follows on the line, which stays unread
std::string DSPICDirectives::rest_of_line() {
  const StringRef text = parser_.getTok().getLoc().getPointer();
  return assembly::trimmed(
      without_asm_comments(text.take_until([](char c) { return c == '\n' || c == '\r'; })));
}

bool DSPICDirectives::parse(StringRef name) {
  const SMLoc at = parser_.getTok().getLoc();
  const std::string directive = name.lower();
  if (directive == ".section" || directive == ".pushsection") {
    const std::string operands = rest_of_line();
    if (!is_vendors_section(operands)) return true;
    parser_.eatToEndOfStatement();
    if (directive == ".pushsection") parser_.getStreamer().PushSection();
    section(operands, at);
  } else if (directive == ".hword" || directive == ".word") {
    values(2);
  } else if (directive == ".pword") {
    values(3);
  } else if (!is_in_code() && directive != ".palign") {
    return true;
  } else if (directive == ".short" || directive == ".2byte") {  // in data LLVM's, which align nothing
    values(2);
  } else if (directive == ".byte") {
    bytes_in_code(at, false, false);
  } else if (directive == ".ascii") {
    bytes_in_code(at, true, false);
  } else if (directive == ".asciz" || directive == ".string") {
    bytes_in_code(at, true, true);
  } else if (directive == ".align" || directive == ".palign") {
    alignment(at);
  } else if (directive == ".org") {
    parser_.Error(at, "the linker says where code lies; `twinpuck asm` takes whole programs");
  } else {
    return true;
  }
  return false;  // mistakes are reported
}

bool DSPICDirectives::section(const std::string& operands, SMLoc at) {
  bool failed = false;
  const auto complain = [&](const std::string& message) { failed |= parser_.Error(at, message); };
  assembly::SectionText text;
  if (!assembly::read_section(operands, text, complain)) return true;
  using Kind = assembly::SectionKind;
  // Attributes become flags that the linker knows.
  const dspic_elf::MemorySpace* const space = dspic_elf::space_of(text.name);
  unsigned flags = (text.is_info ? 0u : ELF::SHF_ALLOC) | (space ? space->flags : 0u);
  if (text.kind == Kind::Code && !text.is_info) flags |= ELF::SHF_EXECINSTR;
  if (text.kind == Kind::Constants) flags |= dspic_elf::kPsv;
  if (text.kind == Kind::Eeprom) flags |= unsigned{ELF::SHF_WRITE} | dspic_elf::kEeprom;
  if (text.kind == Kind::Ram) flags |= ELF::SHF_WRITE;
  if (text.is_near) flags |= dspic_elf::kNearSpace;
  if (text.is_x) flags |= dspic_elf::kXSpace;
  if (text.is_y) flags |= dspic_elf::kYSpace;
  if (text.is_persistent) flags |= dspic_elf::kPersistent;
  if (text.is_noload) flags |= dspic_elf::kNoload;
  // An address becomes part of the name, as a variable's does.
  std::int64_t number = 0;
  if (!text.address.empty()) {
    if (text.kind == Kind::Code)
      return parser_.Error(at, ".section: code at an address: `twinpuck asm` does that");
    if (!value_(text.address, number) || number < 0)
      return parser_.Error(at, ".section: address: got no number");
    flags |= dspic_elf::kAbsolute;
    text.name += "@" + utohexstr(std::uint64_t(number));
  }
  const unsigned type = text.is_zeroed ? ELF::SHT_NOBITS : ELF::SHT_PROGBITS;
  parser_.getStreamer().SwitchSection(parser_.getContext().getELFSection(text.name, type, flags));
  if (text.alignment.empty()) return false;
  return !value_(text.alignment, number) ? parser_.Error(at, ".section: align: got no number")
                                         : align(number, at);
}

bool DSPICDirectives::values(unsigned bytes) {
  const bool in_code = is_in_code();
  if (bytes == 3 && !in_code) return parser_.TokError(".pword outside a code section");
  if (!in_code) parser_.getStreamer().emitValueToAlignment(bytes);
  return parser_.parseMany([&] {
    const MCExpr* value;
    const SMLoc at = parser_.getTok().getLoc();
    if (parser_.parseExpression(value)) return true;
    std::int64_t number;
    if (bytes == 3) {
      if (!value->evaluateAsAbsolute(number)) return parser_.Error(at, ".pword: expected a number");
      parser_.getStreamer().emitIntValue(std::uint64_t(number) & 0xFFFFFF, kWordOctets);
      return false;
    }
    if (value->evaluateAsAbsolute(number))
      parser_.getStreamer().emitIntValue(std::uint64_t(number) & 0xFFFF, bytes);
    else
      parser_.getStreamer().emitValue(value, bytes, at);
    if (in_code) parser_.getStreamer().emitZeros(kWordOctets - bytes);
    return false;
  });
}

bool DSPICDirectives::bytes_in_code(SMLoc at, bool are_texts, bool with_zero) {
  std::string bytes;
  const bool failed = parser_.parseMany([&] {
    if (are_texts) {
      std::string text;
      if (parser_.parseEscapedString(text)) return true;
      bytes += text;
      if (with_zero) bytes += '\0';
      return false;
    }
    std::int64_t number;
    if (parser_.parseAbsoluteExpression(number)) return true;
    bytes += static_cast<char>(number);
    return false;
  });
  if (failed) return true;
  if (bytes.size() % 2) {
    // the next directive's first byte would belong into the same word
    parser_.Warning(at, "an odd number of bytes in code; a zero follows");
    bytes += '\0';
  }
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    parser_.getStreamer().emitBytes(StringRef(bytes).substr(i, 2));
    parser_.getStreamer().emitZeros(kWordOctets - 2);
  }
  return false;
}

bool DSPICDirectives::alignment(SMLoc at) {
  std::int64_t number;
  if (parser_.parseAbsoluteExpression(number) || parser_.parseToken(AsmToken::EndOfStatement)) return true;
  return align(number, at);
}

bool DSPICDirectives::align(std::int64_t to, SMLoc at) {
  constexpr std::int64_t kMost = 0x8000;  // a page of the PSV window
  if (to <= 0 || to > kMost || !isPowerOf2_64(std::uint64_t(to)))
    return parser_.Error(at, "alignment: got " + std::to_string(to) + ", expected a power of two up to " +
                                 std::to_string(kMost));
  parser_.getStreamer().emitValueToAlignment(unsigned(to) * (is_in_code() ? kWordOctets / 2 : 1));
  return false;
}

bool DSPICDirectives::configure(StringRef operands, SMLoc at) {
  const std::vector<std::string> parts = assembly::split(operands.str());
  if (parts.size() != 2) return parser_.Error(at, "config: expected a word's name and its value");
  const std::uint32_t address = assembly::configuration_address(parts[0]);
  std::int64_t value = 0;
  if (address == 0) return parser_.Error(at, "config: unknown word '" + parts[0] + "'");
  if (!value_(parts[1], value)) return parser_.Error(at, "config: got no value: " + parts[1]);
  MCStreamer& out = parser_.getStreamer();
  MCContext& context = parser_.getContext();
  out.PushSection();
  out.SwitchSection(
      context.getELFSection(".config@" + utohexstr(address), ELF::SHT_PROGBITS, ELF::SHF_ALLOC));
  // named as C's, so that the library's own word stays out
  MCSymbol* const symbol =
      context.getOrCreateSymbol("_tp_config_" + StringRef(parts[0]).drop_front(2).lower());
  out.emitSymbolAttribute(symbol, MCSA_Weak);
  out.emitLabel(symbol);
  out.emitIntValue(std::uint64_t(value) & 0xFFFF, 2);
  out.PopSection();
  return false;
}

}  // namespace llvm
