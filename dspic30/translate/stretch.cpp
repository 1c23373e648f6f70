// SPDX-License-Identifier: MIT
#include "dspic30/translate/stretch.h"

#include <algorithm>
#include <string_view>

namespace dspic::translate {

namespace {

constexpr std::ptrdiff_t kLongest = 48;  // words
constexpr int kMostReads = 2;            // of an instruction

bool has(const Row& row, Operand kind) {
  return std::find(row.kinds.begin(), row.kinds.end(), kind) != row.kinds.end();
}

bool ends_a_stretch(Insn id) {
  switch (id) {
    case Insn::Bra_Expr:
    case Insn::Bra_Wn:
    case Insn::Goto_Expr:
    case Insn::Goto_Wn:
    case Insn::Call_Expr:
    case Insn::Call_Wn:
    case Insn::Rcall_Expr:
    case Insn::Rcall_Wn:
    case Insn::Return:
    case Insn::Retfie:
    case Insn::Retlw_lit10_Wn:
    case Insn::Do_lit14_Expr:
    case Insn::Do_Wn_Expr:
    case Insn::Reset:
    case Insn::Pwrsav_lit1:
    case Insn::Clrwdt:
    case Insn::Disi_lit14:
      return true;
    default:
      return false;
  }
}

bool is_skip(const Row& row) {
  const std::string_view name = row.mnemonic;
  return name.substr(0, 4) == "BTSS" || name.substr(0, 4) == "BTSC" || name.substr(0, 3) == "CPS";
}

}  // namespace

std::vector<Item> stretch(const Cpu& cpu, const Decoded* head) {
  std::vector<Item> items;
  std::ptrdiff_t reach = 0;  // as far as jumps within it lead
  for (std::ptrdiff_t place = 0; place < kLongest && head + place < cpu.code() + kFlashWords;) {
    const Decoded* const d = head + place;
    Item item;
    item.word = cpu.program.read(cpu.address_of(d));
    const Row* const row = find_row(item.word);
    if (!row || d == cpu.loop_end) break;
    if (place > 0 && cpu.is_wait_head(d)) break;  // the program stops there to look
    const bool is_known = cpu.is_decoded(d) && cpu.plain(d) == function_of(item.word);
    if (!is_known && (items.empty() || place >= reach)) break;
    const bool ends = ends_a_stretch(row->id);
    if (is_known) {
      item.is_last = ends && row->id != Insn::Bra_Expr;
      item.place = place;
      item.decoded = *d;
      item.plain = cpu.plain(d);
      item.words = row->words;
      // a branch that is taken, a skip over two words, and reading through the PSV window take longer
      item.most_cycles = d->cycles +
                         (has(*row, Operand::Branch) ? 1
                          : is_skip(*row)            ? 2
                                                     : 0) +
                         (d->pointers ? kMostReads * d->psv : 0);
      if (has(*row, Operand::Branch) && row->id != Insn::Rcall_Expr)
        reach = std::max<std::ptrdiff_t>(reach, place + d->imm);
      if (is_skip(*row)) reach = std::max<std::ptrdiff_t>(reach, place + 1 + d->d);
      items.push_back(item);
    }
    place += row->words;
    if (ends && place > reach) break;
  }
  if (items.size() < 3 || items[0].plain == &no_operation) items.clear();
  return items;
}

std::string key_of(const Cpu& cpu, const std::vector<Item>& items) {
  std::string key;
  const auto add = [&key](const auto& value) {
    key.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(cpu.plain_start);
  for (const Item& item : items) {
    add(item.place);
    add(item.word);
    add(item.decoded.lead);
    add(item.decoded.d);
    add(item.decoded.psv);
    add(item.decoded.s_kind);
    add(item.decoded.d_kind);
  }
  return key;
}

}  // namespace dspic::translate
