// SPDX-License-Identifier: MIT
#include "dspic30/core/disassembler.h"

#include <cctype>

#include "dspic30/core/instruction_table.h"
#include "dspic30/memory/hex.h"

namespace dspic {

namespace {

std::string w(unsigned n) { return "w" + std::to_string(n); }

// modes 0 to 5 of p, q, g, h; 6 is [Wn+Wb]
std::string indirect(unsigned mode, unsigned n, unsigned offset) {
  switch (mode) {
    case 0:
      return w(n);
    case 1:
      return "[" + w(n) + "]";
    case 2:
      return "[" + w(n) + "--]";
    case 3:
      return "[" + w(n) + "++]";
    case 4:
      return "[--" + w(n) + "]";
    case 5:
      return "[++" + w(n) + "]";
    default:
      return "[" + w(n) + "+" + w(offset) + "]";
  }
}

std::string with_literal(unsigned n, unsigned k, bool byte) {
  const int offset = sign_extend(k, 10) * (byte ? 1 : 2);
  return "[" + w(n) + (offset < 0 ? "-" : "+") + std::to_string(offset < 0 ? -offset : offset) + "]";
}

std::string prefetch(unsigned code, bool y_space) {
  const PrefetchMode mode = prefetch_mode(code, y_space);
  const std::string base = "[" + w(static_cast<unsigned>(mode.pointer));
  if (mode.by_index) return base + "+w12]";
  if (mode.step == 0) return base + "]";
  return base + (mode.step < 0 ? "]-=" : "]+=") + std::to_string(mode.step < 0 ? -mode.step : mode.step);
}

std::uint32_t branch_target(unsigned n, std::uint32_t next) {
  return next + 2 * static_cast<std::uint32_t>(sign_extend(n, 16));
}

// --- words that nobody writes

bool is_free_of_oddities(const Row& row, const Fields& f, std::uint32_t word, std::uint32_t second,
                         std::uint32_t address) {
  const std::uint32_t fixed = encode(row, f);
  if (fixed != word) return false;  // bits of NOP and BREAK
  const bool offset_in = row.has(Operand::SourceOffset), offset_out = row.has(Operand::DestinationOffset);
  if (offset_in || offset_out) {
    if ((offset_in && f.g == 7) || (offset_out && f.h == 7)) return false;
    if (!(offset_in && f.g == 6) && !(offset_out && f.h == 6) && f.w != 0) return false;
  }
  if (row.has(Operand::Literal) && f.B && f.k > 0xFF) return false;
  if (row.has(Operand::File) && row.has(&Fields::B) && !f.B && (f.f & 1)) return false;
  if (row.has(Operand::Shift6) && (sign_extend(f.k, 6) < -16 || sign_extend(f.k, 6) > 16)) return false;
  if (row.has(Operand::Prefetch) && ((f.i == 4 && f.x) || (f.j == 4 && f.y))) return false;
  if (row.has(Operand::Distance) && (f.i == 4 || f.j == 4)) return false;
  if (row.id == Insn::Mov_D_Wns_Wd && f.q == 0) return false;  // the other MOV.D
  if (row.has(Operand::Target) && second > 0x7F) return false;
  if (row.has(Operand::DoEnd) && (second > 0xFFFF || (branch_target(second, address + 4) & ~kPcMask)))
    return false;
  return !row.has(Operand::Branch) || !(branch_target(f.n, address + 2) & ~kPcMask);
}

// --- operands

// an operand as XC16 writes it
std::string operand(Operand kind, const Fields& f, std::uint32_t second, std::uint32_t address) {
  switch (kind) {
    case Operand::File:
      return hex(f.f, 4);
    case Operand::FileWord:
      return hex(2 * f.f, 4);
    case Operand::FileBit:
    case Operand::Bit:
      return "#" + std::to_string(f.b);
    case Operand::WregOption:
      return f.D ? "" : "WREG";
    case Operand::Wreg:
      return "WREG";
    case Operand::Literal:
      return "#" + hex(f.k);
    case Operand::LiteralTwice:
      return "#" + hex(2 * f.k);
    case Operand::Shift4:
      return "#" + std::to_string(sign_extend(f.r, 4));
    case Operand::Shift6:
      return "#" + std::to_string(sign_extend(f.k, 6));
    case Operand::Wb:
      return w(f.w);
    case Operand::Rs:
      return w(f.s);
    case Operand::Rd:
      return w(f.d);
    case Operand::RsPair:
      return w(2 * f.s);
    case Operand::RdPair:
      return w(2 * f.d);
    case Operand::Source:
      return indirect(f.p, f.s, 0);
    case Operand::Destination:
      return indirect(f.q, f.d, 0);
    case Operand::SourceOffset:
      return indirect(f.g, f.s, f.w);
    case Operand::DestinationOffset:
      return indirect(f.h, f.d, f.w);
    case Operand::SourceLiteral:
      return with_literal(f.s, f.k, f.B != 0);
    case Operand::DestinationLiteral:
      return with_literal(f.d, f.k, f.B != 0);
    case Operand::Accumulator:
      return f.A ? "B" : "A";
    case Operand::Branch:
      return hex(branch_target(f.n, address + 2), 6);
    case Operand::Target:
      return hex((second & 0x7F) << 16 | f.n << 1, 6);
    case Operand::DoEnd:
      return hex(branch_target(second, address + 4), 6);
    case Operand::Product: {
      int first, other;
      product_registers(f.m, first, other);
      return w(static_cast<unsigned>(first)) + "*" + w(static_cast<unsigned>(other));
    }
    case Operand::Square:
      return w(4 + f.m) + "*" + w(4 + f.m);
    case Operand::Prefetch: {
      std::string text = f.i == 4 ? "" : prefetch(f.i, false) + ", " + w(4 + f.x);
      if (f.j != 4) text += (text.empty() ? "" : ", ") + prefetch(f.j, true) + ", " + w(4 + f.y);
      return text;
    }
    case Operand::WriteBack:
      return f.a == 0 ? "w13" : f.a == 1 ? "[w13]+=2" : "";
    case Operand::Distance:
      return prefetch(f.i, false) + ", " + prefetch(f.j, true) + ", " + w(4 + f.x);
    case Operand::Dividend:
    case Operand::DividendLong:
      return w(f.v);
    case Operand::DividendF:
      return w(f.t);
  }
  return "";
}

std::string mnemonic(const Row& row, const Fields& f) {
  std::string text = row.mnemonic;
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (const std::size_t space = text.find(' '); space != std::string::npos) return text + ",";  // bra ltu,
  if (row.id == Insn::Div_S_Wm_Wn || row.id == Insn::Div_U_Wm_Wn) return text + "w";
  if (row.id == Insn::Div_S_Wm_Wn_long || row.id == Insn::Div_U_Wm_Wn_long) return text + "d";
  if (row.has(&Fields::Z)) return text + (f.Z ? ".z" : ".c");
  return f.B || row.has(Operand::FileBit) ? text + ".b" : text;
}

}  // namespace

int instruction_words(std::uint32_t word) {
  const Row* row = find_row(word);
  return row ? row->words : 1;
}

std::string disassemble(std::uint32_t word, std::uint32_t second, std::uint32_t address) {
  const Row* row = find_row(word);
  const Fields f = row ? fields_of(*row, word) : Fields{};
  if (!row || !is_free_of_oddities(*row, f, word, second, address)) return ".pword " + hex(word, 6);
  std::string text = mnemonic(*row, f);
  const char* separator = " ";
  for (const Operand kind : row->kinds) {
    const std::string part = operand(kind, f, second, address);
    if (part.empty()) continue;
    text += separator + part;
    separator = ", ";
  }
  return text;
}

}  // namespace dspic
