// SPDX-License-Identifier: MIT
// The instruction set as a table, one row a form of the manual: what decoder, disassembler and assembler
// read. Rows are generated from instructions.csv by scripts/gen_instruction_table.py.
//
//   word --find_row--> Row --fields_of--> Fields {w, q, d, p, s, ...}     Row, Fields --encode--> word
//
// A field is a letter of the manual's pattern: ADD Wb,Ws,Wd is 0100 0www wBqq qddd dppp ssss. Source: [chip
// C], the columns of instructions.csv.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace dspic {

/// Fields of a word, by their letter in the pattern; 0 where the row has none.
struct Fields {
  unsigned A = 0, B = 0, D = 0, Z = 0, a = 0, b = 0, d = 0, f = 0, g = 0, h = 0, i = 0, j = 0, k = 0, m = 0,
           n = 0, p = 0, q = 0, r = 0, s = 0, t = 0, v = 0, w = 0, x = 0, y = 0;
};

struct Field {
  unsigned Fields::*member;
  std::uint32_t mask;  ///< bits of the word; need not be adjacent
};

/// How an operand is written, and which fields hold it.
enum class Operand : std::uint8_t {
  File,                ///< f: byte address, 13 bits
  FileWord,            ///< f: half the address of a word
  FileBit,             ///< b: bit of the byte at f; with f+1 bits 8 to 15 of a word
  WregOption,          ///< D: 0 when ", WREG" is written
  Wreg,                ///< WREG, fixed
  Literal,             ///< k, unsigned
  LiteralTwice,        ///< k: half of an even number
  Bit,                 ///< b: 0 to 15
  Shift4,              ///< r: -8 to 7
  Shift6,              ///< k: -16 to 16
  Wb,                  ///< w
  Rs,                  ///< s
  Rd,                  ///< d
  RsPair,              ///< s: half of an even register's number
  RdPair,              ///< d: the same
  Source,              ///< p, s: Ws or [Ws] with its modes
  Destination,         ///< q, d
  SourceOffset,        ///< g, s, w: with [Ws+Wb]
  DestinationOffset,   ///< h, d, w
  SourceLiteral,       ///< [Ws+k]
  DestinationLiteral,  ///< [Wd+k]
  Accumulator,         ///< A
  Branch,              ///< n: words from the next instruction
  Target,              ///< n, and the second word
  DoEnd,               ///< the second word: words from the next instruction
  Product,             ///< m: W4*W5 ...
  Square,              ///< m: W4*W4 ...
  Prefetch,            ///< i, x, j, y: [Wx], Wxd, [Wy], Wyd
  WriteBack,           ///< a
  Distance,            ///< i, j, x: [Wx], [Wy], Wxd
  Dividend,            ///< v
  DividendLong,        ///< v, t: an even register
  DividendF,           ///< t
};

/// One constant a row: Add_f, Add_Wb_Ws_Wd, Mov_lit16_Wnd ...
enum class Insn : std::uint8_t {
#define ROW(name, ...) name,
#include "dspic30/core/instruction_rows.inc"
#undef ROW
};

struct Row {
  Insn id;
  const char* mnemonic;  ///< "ADD", "MUL.UU", "BRA LTU"
  const char* operands;  ///< as the manual writes them
  std::uint32_t mask, match;
  int words, cycles;  ///< cycles: without what depends on operands or the course
  bool repeatable;
  std::vector<Field> fields;
  std::vector<Operand> kinds;
  bool (*legal)(const Fields&);  ///< null: always

  bool has(unsigned Fields::*member) const;
  bool has(Operand kind) const { return std::find(kinds.begin(), kinds.end(), kind) != kinds.end(); }
};

/// All rows, in the order of Insn.
const std::vector<Row>& instruction_rows();
inline const Row& row_of(Insn id) { return instruction_rows()[static_cast<std::size_t>(id)]; }
/// Row of a 24-bit word; null for an illegal opcode.
const Row* find_row(std::uint32_t word);
Fields fields_of(const Row& row, std::uint32_t word);
/// fields_of() the other way; bits of a field beyond its width are lost.
std::uint32_t encode(const Row& row, const Fields& fields);
/// Largest value that a field of the row can hold.
unsigned field_limit(const Row& row, unsigned Fields::*member);

/// The low `bits` of a value, signed.
constexpr int sign_extend(unsigned value, int bits) {
  const unsigned sign = 1u << (bits - 1);
  return static_cast<int>((value & (2 * sign - 1)) ^ sign) - static_cast<int>(sign);
}

/// Bits of the program counter.
inline constexpr std::uint32_t kPcMask = 0x7FFFFE;
/// Where the instruction at `address` leads that branches, jumps or calls; `second` is the word behind it. None: it
/// does no such thing, or a register says where to.
std::optional<std::uint32_t> destination(const Row& row, std::uint32_t word, std::uint32_t second,
                                         std::uint32_t address);

// --- DSP prefetch

/// What i or j of a MAC-class instruction says.
struct PrefetchMode {
  bool on;        ///< 4: none
  int pointer;    ///< W register
  bool by_index;  ///< [W9+W12], [W11+W12]
  int step;       ///< bytes, after the read
};
inline PrefetchMode prefetch_mode(unsigned code, bool y_space) {
  const int pointer = (y_space ? 10 : 8) + static_cast<int>(code >> 3 & 1);
  const int low = static_cast<int>(code & 7);
  if (code == 4) return {false, 0, false, 0};
  if (code == 12) return {true, pointer, true, 0};
  return {true, pointer, false, low < 4 ? 2 * low : 2 * low - 16};
}
/// Registers W4 to W7 of m, for rows with Operand::Product: 0 W4*W5, 1 W4*W6, 2 W4*W7, 4
/// W5*W6, 5 W5*W7, 6 W6*W7.
inline void product_registers(unsigned m, int& first, int& second) {
  constexpr int kFirst[] = {4, 4, 4, 0, 5, 5, 6, 0}, kSecond[] = {5, 6, 7, 0, 6, 7, 7, 0};
  first = kFirst[m & 7];
  second = kSecond[m & 7];
}

}  // namespace dspic
