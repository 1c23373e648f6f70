// SPDX-License-Identifier: MIT
#include "dspic30/translate/stretch.h"

#include <algorithm>
#include <string_view>

namespace dspic::translate {

namespace {

constexpr std::ptrdiff_t kLongest = 48;          // words
constexpr std::ptrdiff_t kLongestFunction = 32;  // of one that is called
constexpr std::size_t kMostItems = 120;          // with the functions that are called
constexpr int kDeepest = 3;                      // calls within calls
constexpr int kMostPieces = 3;                   // of a function, from GOTO to GOTO
constexpr int kGotoCycles = 2;
constexpr int kMostReads = 2;  // of an instruction

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

bool is_direct_call(Insn id) { return id == Insn::Rcall_Expr || id == Insn::Call_Expr; }

class Scanner {
 public:
  Scanner(const Cpu& cpu, const Decoded* head) : cpu_(cpu), head_(head) { items.reserve(kLongest); }
  std::vector<Item> items;

  /// One piece from a place on, as words follow one another; is its end the function's, or a jump out of it?
  bool add_piece(std::ptrdiff_t begin, std::ptrdiff_t longest, int frame, int caller, int depth);
  bool has(std::ptrdiff_t place, int frame) const {
    return std::any_of(items.begin(), items.end(),
                       [&](const Item& i) { return i.place == place && i.frame == frame; });
  }

 private:
  bool is_flash(std::ptrdiff_t place) const {
    const std::ptrdiff_t index = head_ - cpu_.code() + place;
    return index >= 0 && index < static_cast<std::ptrdiff_t>(kFlashWords);
  }
  std::ptrdiff_t target_of(const Item& item, Insn id) const;
  bool add_function(std::size_t caller, int depth);
  bool is_answered(Item& call) const;

  const Cpu& cpu_;
  const Decoded* head_;
  int frames_ = 1;
};

std::ptrdiff_t Scanner::target_of(const Item& item, Insn id) const {
  const std::ptrdiff_t imm = item.decoded.imm;
  return id == Insn::Call_Expr || id == Insn::Goto_Expr ? imm / 2 - (head_ - cpu_.code()) : item.place + imm;
}

bool Scanner::add_piece(std::ptrdiff_t begin, std::ptrdiff_t longest, int frame, int caller, int depth) {
  std::ptrdiff_t reach = begin;  // as far as jumps within it lead
  const auto is_reached = [&](std::ptrdiff_t place) {
    if (place - begin < longest) reach = std::max(reach, place);
  };
  const std::size_t first = items.size();
  for (std::ptrdiff_t place = begin; place - begin < longest && is_flash(place);) {
    // What may not lie within a stretch ends it.
    const Decoded* const d = head_ + place;
    Item item;
    item.word = cpu_.program.read(cpu_.address_of(d));
    const Row* const row = find_row(item.word);
    if (!row || d == cpu_.loop_end) return false;
    if (cpu_.table().is_wait(d) && d != head_) return false;  // the program stops there to look
    // Is this an instruction as the decoder left it, of which the translator knows all?
    const bool is_routine = cpu_.table().known_at(cpu_.address_of(d));
    const Run plain = cpu_.is_decoded(d) && !is_routine ? cpu_.table().plain(d) : nullptr;
    item.is_host = plain == &call_host;
    item.is_told = plain && cpu_.table().tells(d);
    // what leads to address 0 is told where it stands
    const bool leads_to_zero = dspic::translate::has(*row, Operand::Target)   ? d->imm == 0
                               : dspic::translate::has(*row, Operand::Branch) ? d - cpu_.code() + d->imm == 0
                                                                              : false;
    const bool is_known = plain && !leads_to_zero && (item.is_host || plain == function_of(item.word)) &&
                          !(item.is_told && (item.is_host || ends_a_stretch(row->id)));
    if (!is_known && (items.size() == first || place >= reach)) return false;
    bool ends = ends_a_stretch(row->id) && !item.is_host;
    if (is_known) {
      // Where it leads, and how long it takes at most.
      item.place = place;
      item.decoded = *d;
      item.plain = plain;
      item.words = row->words;
      item.frame = frame;
      item.caller = caller;
      item.returns = row->id == Insn::Return || row->id == Insn::Retlw_lit10_Wn;
      const bool has_target = is_direct_call(row->id) || row->id == Insn::Goto_Expr;
      if (has_target) item.target = target_of(item, row->id);
      const bool is_followed =
          row->id == Insn::Bra_Expr || item.returns || (has_target && is_flash(item.target));
      item.is_last = ends && !is_followed;
      // a branch that is taken, a skip over two words, and reading through the PSV window take longer
      const bool branches = dspic::translate::has(*row, Operand::Branch) && row->id != Insn::Rcall_Expr;
      item.most_cycles = d->cycles +
                         (branches        ? 1
                          : is_skip(*row) ? 2
                                          : 0) +
                         (d->pointers ? kMostReads * d->psv : 0);
      if (branches) is_reached(place + d->imm);
      if (is_skip(*row)) is_reached(place + 1 + d->d);
      const bool calls = is_direct_call(row->id) && ends && !item.is_last;
      const bool is_answered = calls && this->is_answered(item);
      items.push_back(item);
      if (is_answered || (calls && add_function(items.size() - 1, depth))) ends = false;
    }
    place += row->words;
    if (ends && place > reach) return true;
  }
  return false;
}

// does it call a routine that is known by heart, perhaps by a handle?
bool Scanner::is_answered(Item& call) const {
  auto address = static_cast<unsigned>(2 * (head_ - cpu_.code() + call.target));
  const std::uint32_t word = cpu_.program.read(address);
  const Row* const row = find_row(word);
  const bool by_handle = row && row->id == Insn::Goto_Expr && !cpu_.table().known_at(address);
  if (by_handle) address = (cpu_.program.read(address + 2) & 0x7F) << 16 | (word & 0xFFFE);
  const KnownRoutine* const routine = cpu_.table().known_at(address);
  if (!routine) return false;
  call.routine = routine;
  call.routine_place = static_cast<std::ptrdiff_t>(address / 2) - (head_ - cpu_.code());
  call.way = by_handle ? kGotoCycles : 0;
  return true;
}

// a short function becomes part of the stretch: from its first word to its RETURN, over jumps out of it
bool Scanner::add_function(std::size_t caller, int depth) {
  const std::size_t before = items.size();
  const int frames_before = frames_, frame = frames_++;
  const auto returns = [&] {
    return std::any_of(items.begin() + static_cast<std::ptrdiff_t>(before), items.end(),
                       [&](const Item& i) { return i.frame == frame && i.returns && !i.is_last; });
  };
  std::ptrdiff_t begin = items[caller].target;
  bool is_whole = depth < kDeepest;
  for (int piece = 0; is_whole && piece < kMostPieces; ++piece) {
    is_whole = add_piece(begin, kLongestFunction, frame, static_cast<int>(caller), depth + 1);
    const Item& last = items.back();
    const Row* const row = find_row(last.word);
    if (!is_whole || last.frame != frame || last.is_last) break;
    if (row->id != Insn::Goto_Expr && row->id != Insn::Bra_Expr) break;
    begin = row->id == Insn::Goto_Expr ? last.target : last.place + last.decoded.imm;
    if (has(begin, frame) || !is_flash(begin)) break;
  }
  if (is_whole && returns() && items.size() <= kMostItems) {
    items[caller].callee = frame;
    return true;
  }
  items.resize(before);
  frames_ = frames_before;
  return false;
}

}  // namespace

std::vector<Item> stretch(const Cpu& cpu, const Decoded* head) {
  Scanner scanner(cpu, head);
  scanner.add_piece(0, kLongest, 0, -1, 0);
  std::vector<Item> items = std::move(scanner.items);
  // a loop is worth it however short it is
  const bool goes_round = std::any_of(items.begin(), items.end(), [](const Item& i) {
    return has(*find_row(i.word), Operand::Branch) && i.place + i.decoded.imm == 0 && i.frame == 0;
  });
  if ((items.size() < 3 && !goes_round) || items.empty() || items[0].plain == &no_operation) items.clear();
  return items;
}

std::string key_of(const Cpu& cpu, const std::vector<Item>& items) {
  std::string key;
  key.reserve(items.size() * sizeof(Item));
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
    add(item.target);
    add(item.frame);
    add(item.callee);
    add(item.is_host);
    add(item.is_told);
    add(item.way);
    add(item.routine_place);
    add(item.routine ? item.routine->code : 0);
    if (item.routine) key += item.routine->name;
  }
  return key;
}

}  // namespace dspic::translate
