// SPDX-License-Identifier: MIT
#include "hal_sim/debug/code.h"

#include "dspic30/memory/program_memory.h"
#include "dspic30/periph/vectors.h"
#include "hal_sim/chip/program_places.h"

namespace debug {

namespace {

using dspic::Insn;
using dspic::Operand;

constexpr std::uint32_t kVectors = 0x04, kAlternateVectors = 0x84;
constexpr unsigned kW14 = 14, kW15 = 15;

/// By how much a pointer's mode moves W15: [Ws--], [Ws++], [--Ws], [++Ws].
int moved(unsigned mode, int bytes) {
  return mode == 2 || mode == 4 ? -bytes : mode == 3 || mode == 5 ? bytes : 0;
}

/// What an instruction adds to W15, but for LNK, ULNK and loads of W15.
int growth(const Instruction& i) {
  const dspic::Fields& f = i.fields;
  const int size = i.row->id == Insn::Mov_D_Ws_Wnd || i.row->id == Insn::Mov_D_Wns_Wd ? 4 : f.B ? 1 : 2;
  switch (i.row->id) {
    case Insn::Push_f:
      return 2;
    case Insn::Pop_f:
      return -2;
    case Insn::Add_lit10_Wn:
      return f.d == kW15 ? static_cast<int>(f.k) : 0;
    case Insn::Sub_lit10_Wn:
      return f.d == kW15 ? -static_cast<int>(f.k) : 0;
    case Insn::Add_Wb_lit5_Wd:
    case Insn::Sub_Wb_lit5_Wd:
      if (f.d != kW15 || f.w != kW15 || f.q != 0) break;
      return i.row->id == Insn::Add_Wb_lit5_Wd ? static_cast<int>(f.k) : -static_cast<int>(f.k);
    case Insn::Inc2_Ws_Wd:
    case Insn::Dec2_Ws_Wd:
      if (f.d != kW15 || f.s != kW15 || f.p || f.q) break;
      return i.row->id == Insn::Inc2_Ws_Wd ? 2 : -2;
    default:
      break;
  }
  // A pointer that is W15 itself moves it.
  int bytes = 0;
  for (const Operand kind : i.row->kinds) {
    if (kind == Operand::Source && f.s == kW15) bytes += moved(f.p, size);
    if (kind == Operand::SourceOffset && f.s == kW15) bytes += moved(f.g, size);
    if (kind == Operand::Destination && f.d == kW15) bytes += moved(f.q, size);
    if (kind == Operand::DestinationOffset && f.d == kW15) bytes += moved(f.h, size);
  }
  return bytes;
}

std::optional<Instruction::Access> access_of(const dspic::Row& row, const dspic::Fields& f) {
  const bool by_word = row.has(Operand::FileWord), by_bit = row.has(Operand::FileBit);
  if (!by_word && !by_bit && !row.has(Operand::File)) return {};
  Instruction::Access a;
  a.address = by_word ? 2 * f.f : f.f;
  switch (row.id) {
    case Insn::Mov_Wns_f:
    case Insn::Mov_WREG_f:
    case Insn::Clr_f:
    case Insn::Setm_f:
    case Insn::Pop_f:
      a.writes = true;
      break;
    case Insn::Mov_f_Wnd:
    case Insn::Push_f:
    case Insn::Cp_f:
    case Insn::Cpb_f:
    case Insn::Cp0_f:
    case Insn::Mul_f:
    case Insn::Btst_f_bit:
    case Insn::Btss_f_bit:
    case Insn::Btsc_f_bit:
      a.reads = true;
      break;
    case Insn::Bset_f_bit:
    case Insn::Bclr_f_bit:
    case Insn::Btg_f_bit:
      a.writes = true;
      break;
    default:  // f {,WREG}: the result goes where D says
      a.reads = true;
      a.writes = !row.has(&dspic::Fields::D) || f.D != 0;
  }
  if (by_bit) a.bit = static_cast<int>(f.b & 7) + 8 * static_cast<int>(a.address & 1);
  if (by_bit) a.address &= ~1u;
  return a;
}

}  // namespace

bool Instruction::is_return() const {
  return row->id == Insn::Return || row->id == Insn::Retfie || row->id == Insn::Retlw_lit10_Wn;
}
bool Instruction::is_call() const {
  return row->id == Insn::Call_Expr || row->id == Insn::Call_Wn || row->id == Insn::Rcall_Expr ||
         row->id == Insn::Rcall_Wn;
}
bool Instruction::is_skip() const {
  const std::string name = row->mnemonic;
  return name.rfind("BTSS", 0) == 0 || name.rfind("BTSC", 0) == 0 || name.rfind("CPS", 0) == 0;
}
bool Instruction::is_branch() const { return target && !is_call(); }

Code::Code(const dspic::FirmwareFile& file) : file_(file) {
  for (int v = 0; v < dspic::kVectors; ++v)
    for (const std::uint32_t table : {kVectors, kAlternateVectors}) {
      const auto word = file.words.find(table + 2 * static_cast<std::uint32_t>(v));
      if (word == file.words.end() || word->second == dspic::kErasedWord) continue;
      const auto [first, last] = vectors_.equal_range(word->second);
      bool is_known = false;
      for (auto known = first; known != last; ++known) is_known |= known->second == v;
      if (!is_known) vectors_.emplace(word->second, v);
    }
  for (const auto& function : file.code.functions)
    if (const unsigned to = chip::goto_target(file, function.begin); dspic::is_host_place(to))
      host_functions_.emplace(to, &function);
}

const dspic::CodeMap::Function* Code::function_at(std::uint32_t address) const {
  static const dspic::CodeMap::Function kByHeart{dspic::kHostHandlerReturn, dspic::kHostEnd, "_T2Interrupt"};
  if (address == kByHeart.begin) return &kByHeart;
  if (!dspic::is_host_place(address)) return file_.code.function_at(address);
  const auto found = host_functions_.find(address);
  return found == host_functions_.end() ? nullptr : found->second;
}

std::string Code::describe(std::uint32_t address) const {
  const auto* function = dspic::is_host_place(address) ? function_at(address) : nullptr;
  return function ? function->name + "()" : file_.code.describe(address);
}

std::uint32_t Code::host_function_called(std::uint32_t address) const {
  if (host_functions_.empty()) return 0;
  const auto i = at(address);
  if (!i || !i->target || !(i->is_call() || i->is_branch())) return 0;
  return dspic::is_host_place(chip::goto_target(file_, *i->target)) ? *i->target : 0;
}

std::optional<Instruction> Code::at(std::uint32_t address) const {
  const auto word = file_.words.find(address);
  if (word == file_.words.end() || address >= dspic::kFlashEnd) return {};
  Instruction i;
  i.address = address;
  i.row = dspic::find_row(word->second);
  if (!i.row) return {};
  i.fields = dspic::fields_of(*i.row, word->second);
  i.access = access_of(*i.row, i.fields);
  const std::string name = i.row->mnemonic;
  const auto second = file_.words.find(address + 2);
  i.target =
      dspic::destination(*i.row, word->second, second == file_.words.end() ? 0 : second->second, address);
  i.goes_on = !i.is_return() && name != "GOTO" && name != "RESET" && i.row->id != Insn::Bra_Expr &&
              i.row->id != Insn::Bra_Wn;
  return i;
}

std::vector<Instruction> Code::of(const dspic::CodeMap::Function& function) const {
  std::vector<Instruction> all;
  for (std::uint32_t a = function.begin; a < function.end;) {
    const auto i = at(a);
    if (i) all.push_back(*i);
    a = i ? i->next() : a + 2;
  }
  return all;
}

std::vector<int> Code::vectors_of(std::uint32_t address) const {
  std::vector<int> vectors;
  const auto [first, last] = vectors_.equal_range(address);
  for (auto v = first; v != last; ++v) vectors.push_back(v->second);
  return vectors;
}

const Code::Depth* Code::stack_at(std::uint32_t pc) {
  const auto* function = file_.code.function_at(pc);
  if (!function) return nullptr;
  if (!depths_.count(function->begin)) follow(*function);
  const auto& depths = depths_[function->begin];
  const auto found = depths.find(pc);
  return found == depths.end() ? nullptr : &found->second;
}

/// Is it a push of registers, before this one's instruction moves the stack?
void Code::note_push(const Instruction& i, Depth& depth) {
  const dspic::Fields& f = i.fields;
  const auto note = [&](unsigned n, int at) {
    if (n < depth.saved.size() && depth.saved[n] < 0) depth.saved[n] = static_cast<std::int16_t>(at);
  };
  constexpr unsigned kAfter = 3;  // of a pointer: [Wn++]
  switch (i.row->id) {
    case Insn::Lnk_lit14:
      return note(kW14, depth.bytes);
    case Insn::Push_S:
      depth.shadows = true;
      return;
    case Insn::Mov_Wso_Wdo:
      if (f.d == kW15 && f.h == kAfter && f.g == 0 && !f.B) note(static_cast<unsigned>(f.s), depth.bytes);
      return;
    case Insn::Mov_D_Wns_Wd:
      if (f.d != kW15 || f.q != kAfter) return;
      note(static_cast<unsigned>(f.s), depth.bytes);
      return note(static_cast<unsigned>(f.s) + 1, depth.bytes + 2);
    default:
      return;
  }
}

void Code::follow(const dspic::CodeMap::Function& function) {
  auto& depths = depths_[function.begin];
  std::vector<std::pair<std::uint32_t, Depth>> open{{function.begin, {}}};
  while (!open.empty()) {
    auto [address, depth] = open.back();
    open.pop_back();
    if (address < function.begin || address >= function.end || !depths.emplace(address, depth).second)
      continue;
    const auto i = at(address);
    if (!i) continue;
    const dspic::Fields& f = i->fields;
    note_push(*i, depth);
    if (i->row->id == Insn::Lnk_lit14) {
      depth.frame = depth.bytes + 2;
      depth.bytes = depth.frame + 2 * static_cast<int>(f.k);
    } else if (i->row->id == Insn::Ulnk) {
      depth.bytes = depth.frame - 2;
    } else if (i->row->id == Insn::Mov_lit16_Wnd && f.d == kW15) {
      depth.bytes = 0;
    } else if (i->row->id == Insn::Mov_Wso_Wdo && f.d == kW15 && f.s == kW14 && f.g == 0 && f.h == 0) {
      depth.bytes = depth.frame;
    } else {
      depth.bytes += growth(*i);
    }
    // a routine within a function, as assembler text has them, begins with its caller's address alone
    if (i->target) open.emplace_back(*i->target, i->is_call() ? Depth{} : depth);
    if (i->goes_on) open.emplace_back(i->next(), depth);
    if (i->is_skip())
      if (const auto skipped = at(i->next())) open.emplace_back(skipped->next(), depth);
  }
}

}  // namespace debug
