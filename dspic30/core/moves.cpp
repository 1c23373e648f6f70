// SPDX-License-Identifier: MIT
// Moves, exchanges, extensions, stack and program memory.
#include <utility>

#include "dspic30/core/operands.h"

namespace dspic {

namespace {

using namespace operands;

// --- more places

unsigned indexed(Cpu& cpu, unsigned n, int offset, Pointer kind) {
  const unsigned ea = kind == Pointer::Special ? stepped(cpu, n, cpu.w[n], offset, false)
                                               : (cpu.w[n] + static_cast<unsigned>(offset)) & 0xFFFF;
  return kind != Pointer::Plain && n == 15 ? cpu.stack_checked(ea) : ea;
}

struct Indexed {  // [Ws+Wb], [Wd+Wb]
  template <bool Byte>
  static unsigned get(Cpu& cpu, const Decoded* d) {
    return cpu.read<Byte>(indexed(cpu, d->s, sign_extend(cpu.w[d->b], 16), d->s_kind));
  }
  template <bool Byte>
  static void put(Cpu& cpu, const Decoded* d, unsigned value) {
    cpu.write<Byte>(indexed(cpu, d->d, sign_extend(cpu.w[d->b], 16), d->d_kind), value);
  }
};
struct WithLiteral {  // [Ws+lit], [Wd+lit]
  template <bool Byte>
  static unsigned get(Cpu& cpu, const Decoded* d) {
    return cpu.read<Byte>(indexed(cpu, d->s, d->imm, d->s_kind));
  }
  template <bool Byte>
  static void put(Cpu& cpu, const Decoded* d, unsigned value) {
    cpu.write<Byte>(indexed(cpu, d->d, d->imm, d->d_kind), value);
  }
};

template <bool Byte, class From, class To>
const Decoded* move(Cpu& cpu, const Decoded* d) {
  To::template put<Byte>(cpu, d, From::template get<Byte>(cpu, d));
  return d + 1;
}

template <class From, class To>
Run choose_width(const Fields& f) {
  return f.B ? &move<true, From, To> : &move<false, From, To>;
}
template <class From>
Run choose_destination(const Fields& f) {
  if (f.h == 0) return choose_width<From, Rd>(f);
  return f.h < 6 ? choose_width<From, Memory>(f) : choose_width<From, Indexed>(f);
}

// --- pairs: the low word comes first

const Decoded* move_pair_from_registers(Cpu& cpu, const Decoded* d) {
  const unsigned low = cpu.w[d->s], high = cpu.w[d->s + 1u];
  put_register<false>(cpu, d, low);
  cpu.w[d->d + 1u] = static_cast<std::uint16_t>(d->d == 14 ? high & 0xFFFE : high);
  return d + 1;
}
// the window costs once
const Decoded* move_pair_from_memory(Cpu& cpu, const Decoded* d) {
  const unsigned ea = source_address(cpu, d), low = cpu.read16(ea);
  const unsigned high = cpu.read16_behind((ea + 2) & 0xFFFF);
  put_register<false>(cpu, d, low);
  cpu.w[d->d + 1u] = static_cast<std::uint16_t>(d->d == 14 ? high & 0xFFFE : high);
  return d + 1;
}
const Decoded* move_pair_to_memory(Cpu& cpu, const Decoded* d) {
  const unsigned low = cpu.w[d->s], high = cpu.w[d->s + 1u], ea = destination_address(cpu, d);
  cpu.write16(ea, low);
  cpu.write16((ea + 2) & 0xFFFF, high);
  return d + 1;
}

// --- within registers

const Decoded* exchange(Cpu& cpu, const Decoded* d) {
  std::swap(cpu.w[d->s], cpu.w[d->d]);
  cpu.w[15] &= 0xFFFE;
  return d + 1;
}
const Decoded* swap_bytes(Cpu& cpu, const Decoded* d) {
  const unsigned x = cpu.w[d->d];
  put_register<false>(cpu, d, (x >> 8 | x << 8) & 0xFFFF);
  return d + 1;
}
const Decoded* swap_nibbles(Cpu& cpu, const Decoded* d) {
  const unsigned x = cpu.w[d->d];
  put_register<true>(cpu, d, (x >> 4 & 15) | (x & 15) << 4);
  return d + 1;
}
template <class From>
const Decoded* extend_sign(Cpu& cpu, const Decoded* d) {
  const auto result = static_cast<unsigned>(sign_extend(From::template get<true>(cpu, d), 8)) & 0xFFFF;
  cpu.set_nz<false>(result);
  cpu.c = !cpu.flag_n();
  put_register<false>(cpu, d, result);
  return d + 1;
}
template <class From>
const Decoded* extend_zero(Cpu& cpu, const Decoded* d) {
  const unsigned result = From::template get<true>(cpu, d);
  cpu.set_nz<false>(result);
  cpu.c = 1;
  put_register<false>(cpu, d, result);
  return d + 1;
}
// the sum of two packed decimals, corrected; a carry out of the low digit goes into the high one [?]
const Decoded* decimal_adjust(Cpu& cpu, const Decoded* d) {
  unsigned x = cpu.w[d->d] & 0xFF;
  cpu.reads_core = true;  // DC
  if ((x & 15) > 9 || cpu.flag_dc()) x += 0x06;
  if (x > 0x9F || cpu.flag_c()) {
    x += 0x60;
    cpu.c = 1;
  }
  put_register<true>(cpu, d, x & 0xFF);
  return d + 1;
}

// --- stack

const Decoded* push_file(Cpu& cpu, const Decoded* d) {
  cpu.push(File::get<false>(cpu, d));
  return d + 1;
}
const Decoded* pop_file(Cpu& cpu, const Decoded* d) {
  File::put<false>(cpu, d, cpu.pop());
  return d + 1;
}
const Decoded* push_shadow(Cpu& cpu, const Decoded* d) {
  for (unsigned i = 0; i < 4; ++i) cpu.shadow.w[i] = cpu.w[i];
  cpu.shadow.flags = cpu.sr() & 0x010F;
  cpu.reads_core = true;  // DC
  return d + 1;
}
const Decoded* pop_shadow(Cpu& cpu, const Decoded* d) {
  for (unsigned i = 0; i < 4; ++i) cpu.w[i] = cpu.shadow.w[i];
  cpu.set_flags(cpu.shadow.flags);
  cpu.dc = cpu.shadow.flags;
  return d + 1;
}
const Decoded* link(Cpu& cpu, const Decoded* d) {
  cpu.push(cpu.w[14]);
  cpu.w[14] = cpu.w[15];
  cpu.w[15] = static_cast<std::uint16_t>(cpu.w[15] + d->imm);
  return d + 1;
}
const Decoded* unlink(Cpu& cpu, const Decoded* d) {
  cpu.w[15] = cpu.w[14] & 0xFFFE;
  cpu.w[14] = static_cast<std::uint16_t>(cpu.pop());
  return d + 1;
}

// --- program memory: TBLPAG and a pointer

std::uint32_t program_word(Cpu& cpu, unsigned address) {
  if (address - kEepromStart < 2 * kEepromWordCount) {
    cpu.note_effect();
    cpu.parts.events.run_to(cpu.now);
    return cpu.parts.nvm.table_read(address);
  }
  return cpu.program.read(address);
}

template <bool High, bool Byte, class To>
const Decoded* table_read(Cpu& cpu, const Decoded* d) {
  const unsigned ea = source_address(cpu, d);
  std::uint32_t word = program_word(cpu, static_cast<unsigned>(cpu.tblpag) << 16 | ea) >> (High ? 16 : 0);
  if (Byte) word >>= 8 * (ea & 1);
  To::template put<Byte>(cpu, d, word & kMask<Byte>);
  return d + 1;
}
template <bool High, bool Byte, class From>
const Decoded* table_write(Cpu& cpu, const Decoded* d) {
  const unsigned value = From::template get<Byte>(cpu, d), ea = destination_address(cpu, d);
  cpu.note_effect();
  cpu.parts.events.run_to(cpu.now);
  const std::uint32_t lanes = High   ? (Byte && (ea & 1) ? 0 : 0xFF0000)
                              : Byte ? 0xFFu << 8 * (ea & 1)
                                     : 0xFFFF;
  const std::uint32_t placed = High ? value << 16 : Byte ? value << 8 * (ea & 1) : value;
  cpu.parts.nvm.table_write(static_cast<unsigned>(cpu.tblpag) << 16 | (ea & 0xFFFE), placed, lanes);
  return d + 1;
}
template <bool High>
Run choose_table_read(const Fields& f) {
  if (f.B) return f.q == 0 ? &table_read<High, true, Rd> : &table_read<High, true, Memory>;
  return f.q == 0 ? &table_read<High, false, Rd> : &table_read<High, false, Memory>;
}
template <bool High>
Run choose_table_write(const Fields& f) {
  if (f.B) return f.p == 0 ? &table_write<High, true, Rs> : &table_write<High, true, Memory>;
  return f.p == 0 ? &table_write<High, false, Rs> : &table_write<High, false, Memory>;
}

}  // namespace

// The function of each form of the moves; null: it is none of them.
Run choose_move(Insn id, const Fields& f) {
  switch (id) {
    case Insn::Mov_WREG_f:
      return choose_width<W0, File>(f);
    case Insn::Mov_f_Wnd:
      return &move<false, File, Rd>;
    case Insn::Mov_Wns_f:
      return &move<false, Rs, File>;
    case Insn::Mov_B_lit8_Wnd:
      return &move<true, Literal, Rd>;
    case Insn::Mov_lit16_Wnd:
      return &move<false, Literal, Rd>;
    case Insn::Mov_Wsslit10_Wnd:
      return choose_width<WithLiteral, Rd>(f);
    case Insn::Mov_Wns_Wdslit10:
      return choose_width<Rs, WithLiteral>(f);
    case Insn::Mov_Wso_Wdo:
      if (f.g == 0) return choose_destination<Rs>(f);
      return f.g < 6 ? choose_destination<Memory>(f) : choose_destination<Indexed>(f);
    case Insn::Mov_D_Ws_Wnd:
      return f.p == 0 ? &move_pair_from_registers : &move_pair_from_memory;
    case Insn::Mov_D_Wns_Wd:
      return f.q == 0 ? &move_pair_from_registers : &move_pair_to_memory;
    case Insn::Exch_Wns_Wnd:
      return &exchange;
    case Insn::Swap_Wn:
      return f.B ? &swap_nibbles : &swap_bytes;
    case Insn::Se_Ws_Wnd:
      return f.p == 0 ? &extend_sign<Rs> : &extend_sign<Memory>;
    case Insn::Ze_Ws_Wnd:
      return f.p == 0 ? &extend_zero<Rs> : &extend_zero<Memory>;
    case Insn::Daw_B_Wn:
      return &decimal_adjust;
    case Insn::Push_f:
      return &push_file;
    case Insn::Pop_f:
      return &pop_file;
    case Insn::Push_S:
      return &push_shadow;
    case Insn::Pop_S:
      return &pop_shadow;
    case Insn::Lnk_lit14:
      return &link;
    case Insn::Ulnk:
      return &unlink;
    case Insn::Tblrdl_Ws_Wd:
      return choose_table_read<false>(f);
    case Insn::Tblrdh_Ws_Wd:
      return choose_table_read<true>(f);
    case Insn::Tblwtl_Ws_Wd:
      return choose_table_write<false>(f);
    case Insn::Tblwth_Ws_Wd:
      return choose_table_write<true>(f);
    default:
      return nullptr;
  }
}

}  // namespace dspic
