// SPDX-License-Identifier: MIT
// One word of flash made ready to run: registers, literals, pointer steps, cycles with the stall that it
// suffers behind the word before it.
#include <cstdio>
#include <string>
#include <string_view>

#include "dspic30/core/cpu.h"
#include "dspic30/memory/host_places.h"

namespace dspic {

namespace {

constexpr std::uint16_t bit(unsigned n) { return static_cast<std::uint16_t>(1u << n); }

// what modes 1 to 5 do to a pointer before and after
void pointer_steps(unsigned mode, int step, std::int8_t& pre, std::int8_t& post) {
  pre = static_cast<std::int8_t>(mode == 4 ? -step : mode == 5 ? step : 0);
  post = static_cast<std::int8_t>(mode == 2 ? -step : mode == 3 ? step : 0);
}

// --- registers of a word, for stalls and for pointers never written

struct Registers {
  std::uint16_t written = 0;       // as a destination, directly
  std::uint16_t moved = 0;         // as a destination's pointer
  std::uint16_t sources = 0;       // form a source's address
  std::uint16_t destinations = 0;  // form a destination's
  std::uint16_t offsets = 0;       // are added to one of these
};

void add_source(Registers& r, unsigned mode, unsigned n, unsigned offset) {
  if (mode == 0) return;
  r.sources |= bit(n);
  if (mode >= 6) r.offsets |= bit(offset);
}
void add_destination(Registers& r, unsigned mode, unsigned n) {
  if (mode == 0) {
    r.written |= bit(n);
    return;
  }
  r.destinations |= bit(n);
  if (mode >= 2 && mode <= 5) r.moved |= bit(n);
}

void add_prefetch(Registers& r, const Fields& f, bool y_target) {
  const PrefetchMode x = prefetch_mode(f.i, false), y = prefetch_mode(f.j, true);
  for (const PrefetchMode& mode : {x, y}) {
    if (!mode.on) continue;
    r.sources |= bit(static_cast<unsigned>(mode.pointer));
    if (mode.by_index) r.offsets |= bit(12);
  }
  if (x.on) r.written |= bit(4 + f.x);
  if (y.on && y_target) r.written |= bit(4 + f.y);
}

// What an operand does to registers: points with them, moves them on, writes them.
void add_operand(Registers& r, Operand kind, const Row& row, const Fields& f) {
  switch (kind) {
    case Operand::Source:
      add_source(r, f.p, f.s, 0);
      break;
    case Operand::SourceOffset:
      add_source(r, f.g, f.s, f.w);
      break;
    case Operand::SourceLiteral:
      add_source(r, 1, f.s, 0);
      break;
    case Operand::Destination:
      add_destination(r, f.q, f.d);
      break;
    case Operand::DestinationOffset:
      add_destination(r, f.h, f.d);
      break;
    case Operand::DestinationLiteral:
      add_destination(r, 1, f.d);
      break;
    case Operand::Rd:
      r.written |= bit(f.d);
      break;
    case Operand::RdPair:
      r.written |= static_cast<std::uint16_t>(3u << 2 * f.d);
      break;
    case Operand::WregOption:
      if (!f.D) r.written |= bit(0);
      break;
    case Operand::Prefetch:
      add_prefetch(r, f, true);
      break;
    case Operand::Distance:
      add_prefetch(r, f, false);
      break;
    case Operand::WriteBack:
      if (f.a == 0) r.written |= bit(13);
      if (f.a == 1) r.destinations |= bit(13);
      break;
    case Operand::File:
    case Operand::FileWord: {
      const unsigned address = kind == Operand::File ? f.f : 2 * f.f;
      const bool stores =
          row.id == Insn::Mov_Wns_f || row.id == Insn::Pop_f || row.id == Insn::Mov_WREG_f || f.D;
      if (address < 0x20 && stores) r.written |= bit(address / 2);  // the register's own address
      break;
    }
    default:
      break;
  }
}

Registers registers_of(const Row& row, const Fields& f) {
  Registers r;
  for (const Operand kind : row.kinds) add_operand(r, kind, row, f);
  // Some instructions write or point with registers that no operand of their row names.
  switch (row.id) {
    case Insn::Mul_UU_Wb_lit5_Wnd:
    case Insn::Mul_UU_Wb_Ws_Wnd:
    case Insn::Mul_US_Wb_Ws_Wnd:
    case Insn::Mul_SU_Wb_lit5_Wnd:
    case Insn::Mul_SU_Wb_Ws_Wnd:
    case Insn::Mul_SS_Wb_Ws_Wnd:
      r.written |= bit(f.d + 1);
      break;
    case Insn::Mov_D_Wns_Wd:
      if (f.q == 0) r.written |= bit(f.d + 1);
      break;
    case Insn::Mul_f:
      r.written |= f.B ? 0x4 : 0xC;
      break;
    case Insn::Div_S_Wm_Wn:
    case Insn::Div_S_Wm_Wn_long:
    case Insn::Div_U_Wm_Wn:
    case Insn::Div_U_Wm_Wn_long:
    case Insn::Divf_Wm_Wn:
      r.written |= 0x3;
      break;
    case Insn::Exch_Wns_Wnd:
    case Insn::Swap_Wn:
    case Insn::Daw_B_Wn:
      r.written |= bit(f.s);
      break;
    case Insn::Bset_Ws_bit4:
    case Insn::Bclr_Ws_bit4:
    case Insn::Btg_Ws_bit4:
    case Insn::Btsts_Ws_bit4:
    case Insn::Bsw_Ws_Wb:
      if (f.p == 0) r.written |= bit(f.s);
      break;
    case Insn::Clr_WREG:
    case Insn::Setm_WREG:
      r.written |= bit(0);
      break;
    case Insn::Pop_S:
      r.written |= 0xF;
      break;
    case Insn::Lnk_lit14:
      r.written |= bit(14);
      break;
    case Insn::Ulnk:
      r.sources |= bit(14);
      break;
    case Insn::Return:
    case Insn::Retfie:
    case Insn::Retlw_lit10_Wn:
    case Insn::Pop_f:
      r.sources |= bit(15);
      break;
    default:
      break;
  }
  return r;
}

// Cycles that an access through the PSV window adds.
std::uint8_t psv_cycles(Insn id) {
  switch (id) {
    case Insn::Mov_f_Wnd:
    case Insn::Mov_Wsslit10_Wnd:
    case Insn::Mov_Wso_Wdo:
    case Insn::Mov_D_Ws_Wnd:
    case Insn::Push_f:
    case Insn::Clr_Acc_prefetch:
    case Insn::Movsac_Acc_prefetch:
    case Insn::Mac_WmWn_Acc:
    case Insn::Msc_WmWn_Acc:
    case Insn::Mpy_WmWn_Acc:
    case Insn::Mpy_N_WmWn_Acc:
    case Insn::Mac_WmWm_Acc:
    case Insn::Mpy_WmWm_Acc:
    case Insn::Ed_WmWm_Acc_Wx_Wy_Wxd:
    case Insn::Edac_WmWm_Acc_Wx_Wy_Wxd:
      return 1;
    default:
      return 2;
  }
}

Run choose(Insn id, const Fields& f) {
  for (const auto chooser :
       {choose_arithmetic, choose_move, choose_bit, choose_multiply, choose_flow, choose_system, choose_dsp})
    if (const Run run = chooser(id, f)) return run;
  return nullptr;
}

// --- operands of a Decoded

void fill_registers(Decoded& d, const Row& row, const Fields& f) {
  d.s = static_cast<std::uint8_t>(f.s);
  d.d = static_cast<std::uint8_t>(f.d);
  d.b = static_cast<std::uint8_t>(f.w);
  if (row.id == Insn::Swap_Wn || row.id == Insn::Daw_B_Wn) d.d = d.s;
  if (row.has(Operand::RsPair)) d.s = static_cast<std::uint8_t>(2 * f.s);
  if (row.has(Operand::RdPair)) d.d = static_cast<std::uint8_t>(2 * f.d);
  if (row.has(Operand::Bit) || row.has(Operand::FileBit)) d.b = static_cast<std::uint8_t>(f.b);
  if (row.has(Operand::Dividend) || row.has(Operand::DividendLong)) d.b = static_cast<std::uint8_t>(f.v);
  if (row.has(Operand::DividendF)) d.b = static_cast<std::uint8_t>(f.t);
  d.mask = d.d == 15 ? 0xFFFE : 0xFFFF;
}

void fill_literal(Decoded& d, const Row& row, const Fields& f, std::uint32_t word, std::uint32_t second) {
  d.imm = static_cast<std::int32_t>(word);  // the DSP engine's
  for (const Operand kind : row.kinds) {
    switch (kind) {
      case Operand::File:
        d.imm = static_cast<std::int32_t>(f.f);
        break;
      case Operand::FileWord:
        d.imm = static_cast<std::int32_t>(2 * f.f);
        break;
      case Operand::Literal:
        d.imm = static_cast<std::int32_t>(f.k);
        break;
      case Operand::LiteralTwice:
        d.imm = static_cast<std::int32_t>(2 * f.k);
        break;
      case Operand::SourceLiteral:
      case Operand::DestinationLiteral:
        d.imm = sign_extend(f.k, 10) * (f.B ? 1 : 2);
        break;
      case Operand::Branch:
        d.imm = 1 + sign_extend(f.n, 16);
        break;
      case Operand::Target:
        d.imm = static_cast<std::int32_t>((second & 0x7F) << 16 | f.n << 1);
        break;
      case Operand::DoEnd:
        d.d = static_cast<std::uint8_t>(second >> 8);
        d.b = static_cast<std::uint8_t>(second);
        break;
      default:
        break;
    }
  }
}

void fill_pointers(Decoded& d, const Row& row, const Fields& f, const CodeState& state, const Registers& r) {
  const bool is_pair = row.id == Insn::Mov_D_Ws_Wnd || row.id == Insn::Mov_D_Wns_Wd;
  const bool is_byte = f.B || row.id == Insn::Se_Ws_Wnd || row.id == Insn::Ze_Ws_Wnd;
  // a table is read and written by the width of the access
  const int step = is_pair ? 4 : is_byte ? 1 : 2;
  pointer_steps(f.p | f.g, step, d.s_pre, d.s_post);
  pointer_steps(f.q | f.h, step, d.d_pre, d.d_post);
  const auto kind = [](std::uint32_t special, unsigned n) {
    return special >> n & 1 ? Pointer::Special : n == 15 ? Pointer::Stack : Pointer::Plain;
  };
  if (r.sources & bit(d.s)) d.s_kind = kind(state.special_reads, d.s);
  if (r.destinations & bit(d.d)) d.d_kind = kind(state.special_writes, d.d);
}

bool is_skip(Insn id) {
  switch (id) {
    case Insn::Btss_f_bit:
    case Insn::Btsc_f_bit:
    case Insn::Btss_Ws_bit4:
    case Insn::Btsc_Ws_bit4:
    case Insn::Cpseq_Wb_Wn:
    case Insn::Cpsne_Wb_Wn:
    case Insn::Cpsgt_Wb_Wn:
    case Insn::Cpslt_Wb_Wn:
      return true;
    default:
      return false;
  }
}

// for the stall of the instruction after it
std::uint16_t registers_written(std::uint32_t word) {
  const Row* row = find_row(word);
  if (!row) return 0;
  const Registers r = registers_of(*row, fields_of(*row, word));
  return r.written | r.moved;
}

}  // namespace

const Decoded* illegal(Cpu& cpu, const Decoded* d) {
  char place[24];
  const unsigned address = cpu.address_of(d);
  std::snprintf(place, sizeof place, "0x%06x", address);
  cpu.parts.diagnostics.report(
      Cause::IllegalOpcode, place,
      find_row(cpu.program.read(address))
          ? std::string(place) + ": an address in a register that was never written resets the chip"
          : std::string(place) + ": a word that is no instruction resets the chip",
      cpu.now);
  cpu.ask_reset(ResetKind::IllegalOpcode);
  return d;
}

Run function_of(std::uint32_t word) {
  const Row* row = find_row(word);
  return row ? choose(row->id, fields_of(*row, word)) : nullptr;
}

namespace {

// calls and jumps to the linker's handle of a function of the host (a GOTO beyond the flash) lead there
// without the GOTO, which the chip's image has not
void lead_to_host(Decoded& d, const Row& row, const ProgramMemory& program, unsigned address) {
  const bool is_relative = row.id == Insn::Rcall_Expr || row.id == Insn::Bra_Expr,
             is_call = row.id == Insn::Rcall_Expr || row.id == Insn::Call_Expr;
  if (!is_relative && !is_call && row.id != Insn::Goto_Expr) return;
  const unsigned to =
      is_relative ? (address + 2 * static_cast<unsigned>(d.imm)) & 0x7FFFFE : static_cast<unsigned>(d.imm);
  unsigned target = to;
  if (!is_host_place(to)) {
    const std::uint32_t word = program.read(to);
    const Row* const there = find_row(word);
    if (!there || there->id != Insn::Goto_Expr) return;
    target = (program.read(to + 2) & 0x7F) << 16 | (word & 0xFFFE);
  }
  if (!is_host_place(target) || target >= kHostHandlerReturn) return;
  d.run = is_call ? &call_host : &jump_to_host;
  d.imm = static_cast<std::int32_t>((target - kHostStart) / 2);
  d.b = static_cast<std::uint8_t>(row.words);
}

}  // namespace

namespace {

// W registers that an operand names. Of a kind that is not listed it may be any, so all count.
unsigned touched_by(Operand kind, const Fields& f) {
  switch (kind) {
    case Operand::File:
    case Operand::FileWord:
    case Operand::FileBit:
    case Operand::Literal:
    case Operand::LiteralTwice:
    case Operand::Bit:
    case Operand::Shift4:
    case Operand::Shift6:
    case Operand::Branch:
    case Operand::Target:
    case Operand::DoEnd:
    case Operand::Accumulator:
      return 0;
    case Operand::WregOption:
    case Operand::Wreg:
      return bit(0);
    case Operand::Wb:
      return bit(f.w);
    case Operand::Rs:
    case Operand::Source:
    case Operand::SourceLiteral:
      return bit(f.s);
    case Operand::Rd:
    case Operand::Destination:
    case Operand::DestinationLiteral:
      return bit(f.d);
    case Operand::SourceOffset:
      return bit(f.s) | bit(f.w);
    case Operand::DestinationOffset:
      return bit(f.d) | bit(f.w);
    case Operand::RsPair:
      return 3u << 2 * f.s;
    case Operand::RdPair:
      return 3u << 2 * f.d;
    default:
      return 0xFFFF;
  }
}

/// W registers that it may read or write, perhaps some more; the stack pointer always. Registers that it
/// reaches by their addresses are not among them.
std::uint16_t touched_by(const Decoded& d, const Row& row, const Fields& f, const Registers& r) {
  const std::string_view name = row.mnemonic;
  const auto begins = [&](std::string_view with) { return name.substr(0, with.size()) == with; };
  if (d.run.load(std::memory_order_relaxed) == &call_host) return 0xFFFF;
  unsigned all = bit(15) | r.written | r.moved | r.sources | r.destinations | r.offsets;
  for (const Operand kind : row.kinds) all |= touched_by(kind, f);
  if (begins("MUL") || begins("DIV") || begins("MOV.D")) all |= all << 1;  // pairs
  // Some use registers that no operand names.
  switch (row.id) {
    case Insn::Cp_f:
    case Insn::Cpb_f:
      return static_cast<std::uint16_t>(all | bit(0));
    case Insn::Mul_f:
    case Insn::Push_S:
    case Insn::Pop_S:
      return static_cast<std::uint16_t>(all | 0x000F);
    case Insn::Lnk_lit14:
    case Insn::Ulnk:
      return static_cast<std::uint16_t>(all | bit(14));
    default:
      return static_cast<std::uint16_t>(all);
  }
}

/// Of the instructions that waits begin with.
WordRegisters::Flags flags_of(Insn id) {
  switch (id) {
    case Insn::Nop:
    case Insn::Mov_f_Wnd:
    case Insn::Mov_lit16_Wnd:
    case Insn::Mov_B_lit8_Wnd:
    case Insn::Mov_Wsslit10_Wnd:
    case Insn::Mov_Wso_Wdo:
      return WordRegisters::Flags::Neither;
    case Insn::Cp0_f:
    case Insn::Cp0_Ws:
    case Insn::Cp_f:
    case Insn::Cp_Wb_lit5:
    case Insn::Cp_Wb_Ws:
    case Insn::Sub_f:
    case Insn::Sub_lit10_Wn:
    case Insn::Sub_Wb_lit5_Wd:
    case Insn::Sub_Wb_Ws_Wd:
    case Insn::Add_lit10_Wn:
    case Insn::Add_Wb_lit5_Wd:
    case Insn::Add_Wb_Ws_Wd:
      return WordRegisters::Flags::SetsAll;
    default:
      return WordRegisters::Flags::May;
  }
}

}  // namespace

Decoded decode_word(const ProgramMemory& program, unsigned address, const CodeState& state,
                    WordRegisters& registers) {
  const std::uint32_t word = program.read(address), second = program.read(address + 2);
  Decoded d;
  registers = {};
  const Row* row = find_row(word);
  if (!row) {
    d.run = &illegal;
    return d;
  }
  const Fields f = fields_of(*row, word);
  const Registers r = registers_of(*row, f);
  // What it does, and its operands in the form in which that function wants them.
  d.run = choose(row->id, f);
  fill_registers(d, *row, f);
  fill_pointers(d, *row, f, state, r);
  fill_literal(d, *row, f, word, second);
  d.psv = psv_cycles(row->id);
  // It stalls for a cycle where the instruction before it writes a register that it points with.
  d.writes = r.written | r.moved;
  d.pointers = r.sources | r.offsets;
  d.lead = address >= 2 && (registers_written(program.read(address - 2)) & d.pointers) ? 1 : 0;
  d.cycles = static_cast<std::uint8_t>(row->cycles + d.lead);
  // A skip has to know how many words it may leave out.
  if (is_skip(row->id)) {
    const Row* next = find_row(second);
    d.d = static_cast<std::uint8_t>(next ? next->words : 1);
  }
  lead_to_host(d, *row, program, address);
  // The search for waits and the look-out for registers never written want to know this.
  registers.touches = touched_by(d, *row, f, r);
  registers.flags = flags_of(row->id);
  registers.uses = (r.sources | r.destinations) & kAllWritten;
  if (!f.B || row->has(Operand::Prefetch)) registers.gives = r.written & kAllWritten;
  // a pointer that nobody has written since the reset resets the chip again
  if (registers.uses & ~state.written) d.run = &illegal;
  return d;
}

}  // namespace dspic
