// SPDX-License-Identifier: MIT
#include "dspic30/core/instruction_table.h"

#include <array>

namespace dspic {

namespace {

constexpr std::size_t kRows = 0
#define ROW(name, mnemonic, operands, mask, match, words, cycles, repeatable, fields, kinds, legal) +1
#include "dspic30/core/instruction_rows.inc"
#undef ROW
    ;

using FieldList = std::vector<Field>;
using Operands = std::vector<Operand>;

std::vector<Row> make_rows() {
  std::vector<Row> rows;
  rows.reserve(kRows);
#define ROW(name, mnemonic, operands, mask, match, words, cycles, repeatable, fields, kinds, legal) \
  rows.push_back(                                                                                   \
      Row{Insn::name, mnemonic, operands, mask, match, words, cycles, repeatable, fields, kinds, legal});
#include "dspic30/core/instruction_rows.inc"
#undef ROW
  return rows;
}

// rows by the top eight bits of their words
using Index = std::array<std::vector<const Row*>, 256>;

Index make_index() {
  Index index;
  for (const Row& row : instruction_rows()) {
    // whatever the bits are that its mask leaves open
    const std::uint32_t open = ~row.mask >> 16 & 0xFF, given = row.match >> 16 & 0xFF;
    std::uint32_t bits = open;
    do {
      index[given | bits].push_back(&row);
      bits = (bits - 1) & open;
    } while (bits != open);
  }
  return index;
}

}  // namespace

bool Row::has(unsigned Fields::*member) const {
  for (const Field& field : fields)
    if (field.member == member) return true;
  return false;
}

const std::vector<Row>& instruction_rows() {
  static const std::vector<Row> rows = make_rows();
  return rows;
}

const Row* find_row(std::uint32_t word) {
  static const Index index = make_index();
  for (const Row* row : index[word >> 16 & 0xFF])
    if ((word & row->mask) == row->match && (!row->legal || row->legal(fields_of(*row, word)))) return row;
  return nullptr;
}

// most fields are one piece
static unsigned bits_at(std::uint32_t mask, std::uint32_t word) {
  if (mask == 0) return 0;
  const int low = __builtin_ctz(mask);
  if (const std::uint32_t piece = mask >> low; !(piece & (piece + 1))) return word >> low & piece;
  unsigned value = 0;
  int at = 0;
  for (std::uint32_t rest = mask; rest; rest &= rest - 1) value |= (word >> __builtin_ctz(rest) & 1) << at++;
  return value;
}

Fields fields_of(const Row& row, std::uint32_t word) {
  Fields fields;
  for (const Field& field : row.fields) {
    fields.*field.member = bits_at(field.mask, word);
  }
  return fields;
}

std::uint32_t encode(const Row& row, const Fields& fields) {
  std::uint32_t word = row.match;
  for (const Field& field : row.fields) {
    int at = 0;
    for (std::uint32_t rest = field.mask; rest; rest &= rest - 1)
      word |= (fields.*field.member >> at++ & 1) << __builtin_ctz(rest);
  }
  return word;
}

unsigned field_limit(const Row& row, unsigned Fields::*member) {
  for (const Field& field : row.fields)
    if (field.member == member) return (1u << __builtin_popcount(field.mask)) - 1;
  return 0;
}

std::optional<std::uint32_t> destination(const Row& row, std::uint32_t word, std::uint32_t second,
                                         std::uint32_t address) {
  const unsigned n = fields_of(row, word).n;
  if (row.has(Operand::Target)) return (second & 0x7F) << 16 | n << 1;
  if (!row.has(Operand::Branch)) return {};
  return (address + 2 + 2 * static_cast<std::uint32_t>(sign_extend(n, 16))) & kPcMask;
}

}  // namespace dspic
