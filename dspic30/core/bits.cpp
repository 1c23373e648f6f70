// SPDX-License-Identifier: MIT
// Bits set, cleared, toggled, tested, and found; skips.
#include "dspic30/core/operands.h"

namespace dspic {

namespace {

using operands::kMask;

// --- where the bit is: read and written through one address

struct AtFile {
  static constexpr bool kIsMemory = true;
  static unsigned address(Cpu&, const Decoded* d) { return static_cast<unsigned>(d->imm); }
  template <bool Byte>
  static unsigned read(Cpu& cpu, const Decoded*, unsigned ea) {
    return cpu.read<Byte>(ea);
  }
  template <bool Byte>
  static void write(Cpu& cpu, const Decoded*, unsigned ea, unsigned value) {
    cpu.write<Byte>(ea, value);
  }
};
struct AtMemory : AtFile {
  static unsigned address(Cpu& cpu, const Decoded* d) { return source_address(cpu, d); }
};
struct AtRegister {
  static constexpr bool kIsMemory = false;
  static unsigned address(Cpu&, const Decoded*) { return 0; }
  template <bool Byte>
  static unsigned read(Cpu& cpu, const Decoded* d, unsigned) {
    return cpu.w[d->s] & kMask<Byte>;
  }
  template <bool Byte>
  static void write(Cpu& cpu, const Decoded* d, unsigned, unsigned value) {
    if (Byte) value |= cpu.w[d->s] & 0xFF00;
    cpu.w[d->s] = static_cast<std::uint16_t>(d->s == 15 ? value & 0xFFFE : value);
  }
};

// --- which bit

struct ByLiteral {
  static unsigned bit(Cpu&, const Decoded* d) { return d->b; }
};
struct ByRegister {
  static unsigned bit(Cpu& cpu, const Decoded* d) { return cpu.w[d->b] & 15; }
};

// --- what is done

// kChanges: whatever the bit was, what is left of the old word and what is flipped then is known
template <bool Keeps, bool Flips>
struct Change {
  static constexpr bool kWrites = true, kChanges = true;
  static unsigned keep(unsigned bit) { return ~(Keeps ? 0 : 1u << bit); }
  static unsigned flip(unsigned bit) { return Flips ? 1u << bit : 0; }
  static unsigned of(Cpu&, unsigned x, unsigned bit) { return (x & keep(bit)) ^ flip(bit); }
};
using Set = Change<false, true>;
using Clear = Change<false, false>;
using Toggle = Change<true, true>;
template <bool IntoZ, bool ThenSet>
struct Test {
  static constexpr bool kWrites = ThenSet, kChanges = false;
  static unsigned of(Cpu& cpu, unsigned x, unsigned bit) {
    if (IntoZ)
      cpu.set_z(!(x >> bit & 1));
    else
      cpu.c = x >> bit & 1;
    return x | 1u << bit;
  }
};
template <bool FromZ>
struct Write {
  static constexpr bool kWrites = true, kChanges = false;
  static unsigned of(Cpu& cpu, unsigned x, unsigned bit) {
    const unsigned value = FromZ ? !cpu.flag_z() : cpu.flag_c();
    return (x & ~(1u << bit)) | value << bit;
  }
};

template <class Op, bool Byte, class Where, class Which>
const Decoded* change(Cpu& cpu, const Decoded* d) {
  const unsigned ea = Where::address(cpu, d);
  if constexpr (Op::kChanges && Where::kIsMemory) {
    if (cpu.is_elsewhere(ea, Byte)) {
      const unsigned bit = Which::bit(cpu, d);
      cpu.modify_elsewhere(ea, Op::keep(bit), Op::flip(bit), Byte ? 8 : 16);
      return d + 1;
    }
  }
  const unsigned x = Where::template read<Byte>(cpu, d, ea);
  const unsigned y = Op::of(cpu, x, Which::bit(cpu, d));
  if (Op::kWrites) Where::template write<Byte>(cpu, d, ea, y);
  return d + 1;
}

template <class Op>
Run on_file() {
  return &change<Op, true, AtFile, ByLiteral>;
}
template <class Op, class Which = ByLiteral>
Run on_word(const Fields& f) {
  return f.p == 0 ? &change<Op, false, AtRegister, Which> : &change<Op, false, AtMemory, Which>;
}
template <class Op>
Run on_either(const Fields& f) {
  if (!f.B) return on_word<Op>(f);
  return f.p == 0 ? &change<Op, true, AtRegister, ByLiteral> : &change<Op, true, AtMemory, ByLiteral>;
}

// --- skips: register d holds the words of the next instruction

const Decoded* skip_if(Cpu& cpu, const Decoded* d, bool yes) {
  if (!yes) return d + 1;
  cpu.now += d->d;
  return cpu.offset(d, 1 + d->d);
}

template <bool IfSet, bool Byte, class Where>
const Decoded* skip_on_bit(Cpu& cpu, const Decoded* d) {
  const unsigned x = Where::template read<Byte>(cpu, d, Where::address(cpu, d));
  return skip_if(cpu, d, (x >> d->b & 1) == IfSet);
}
template <bool IfSet>
Run skip_on_word(const Fields& f) {
  return f.p == 0 ? &skip_on_bit<IfSet, false, AtRegister> : &skip_on_bit<IfSet, false, AtMemory>;
}

enum class Compared { Equal, Unequal, Greater, Less };

template <Compared How, bool Byte>
const Decoded* compare_and_skip(Cpu& cpu, const Decoded* d) {
  const int a = sign_extend(cpu.w[d->b], Byte ? 8 : 16), b = sign_extend(cpu.w[d->s], Byte ? 8 : 16);
  switch (How) {
    case Compared::Equal:
      return skip_if(cpu, d, a == b);
    case Compared::Unequal:
      return skip_if(cpu, d, a != b);
    case Compared::Greater:
      return skip_if(cpu, d, a > b);
    default:
      return skip_if(cpu, d, a < b);
  }
}
template <Compared How>
Run choose_compared(const Fields& f) {
  return f.B ? &compare_and_skip<How, true> : &compare_and_skip<How, false>;
}

// --- finds

struct FirstOneLeft {
  static unsigned of(unsigned x) { return x ? static_cast<unsigned>(__builtin_clz(x)) - 15 : 0; }
  static bool carry(unsigned result) { return result == 0; }
};
struct FirstOneRight {
  static unsigned of(unsigned x) { return x ? static_cast<unsigned>(__builtin_ctz(x)) + 1 : 0; }
  static bool carry(unsigned result) { return result == 0; }
};
// bits below the sign that repeat it, negated
struct FirstChange {
  static unsigned of(unsigned x) {
    const unsigned changed = (x & 0x8000 ? ~x : x) & 0x7FFF;
    const int same = changed ? __builtin_clz(changed) - 17 : 15;
    return static_cast<unsigned>(-same) & 0xFFFF;
  }
  static bool carry(unsigned result) { return result == 0xFFF1; }
};

template <class Op, class From>
const Decoded* find(Cpu& cpu, const Decoded* d) {
  const unsigned result = Op::of(From::template get<false>(cpu, d));
  cpu.c = Op::carry(result);
  operands::put_register<false>(cpu, d, result);
  return d + 1;
}
template <class Op>
Run choose_find(const Fields& f) {
  return f.p == 0 ? &find<Op, operands::Rs> : &find<Op, operands::Memory>;
}

}  // namespace

// The function of each form of the bit instructions; null: it is none of them.
Run choose_bit(Insn id, const Fields& f) {
  switch (id) {
    case Insn::Bset_f_bit:
      return on_file<Set>();
    case Insn::Bclr_f_bit:
      return on_file<Clear>();
    case Insn::Btg_f_bit:
      return on_file<Toggle>();
    case Insn::Btst_f_bit:
      return on_file<Test<true, false>>();
    case Insn::Btsts_f_bit:
      return on_file<Test<true, true>>();
    case Insn::Btss_f_bit:
      return &skip_on_bit<true, true, AtFile>;
    case Insn::Btsc_f_bit:
      return &skip_on_bit<false, true, AtFile>;
    case Insn::Bset_Ws_bit4:
      return on_either<Set>(f);
    case Insn::Bclr_Ws_bit4:
      return on_either<Clear>(f);
    case Insn::Btg_Ws_bit4:
      return on_either<Toggle>(f);
    case Insn::Btst_Ws_bit4:
      return f.Z ? on_word<Test<true, false>>(f) : on_word<Test<false, false>>(f);
    case Insn::Btsts_Ws_bit4:
      return f.Z ? on_word<Test<true, true>>(f) : on_word<Test<false, true>>(f);
    case Insn::Btst_Ws_Wb:
      return f.Z ? on_word<Test<true, false>, ByRegister>(f) : on_word<Test<false, false>, ByRegister>(f);
    case Insn::Btss_Ws_bit4:
      return skip_on_word<true>(f);
    case Insn::Btsc_Ws_bit4:
      return skip_on_word<false>(f);
    case Insn::Bsw_Ws_Wb:
      return f.Z ? on_word<Write<true>, ByRegister>(f) : on_word<Write<false>, ByRegister>(f);
    case Insn::Cpseq_Wb_Wn:
      return choose_compared<Compared::Equal>(f);
    case Insn::Cpsne_Wb_Wn:
      return choose_compared<Compared::Unequal>(f);
    case Insn::Cpsgt_Wb_Wn:
      return choose_compared<Compared::Greater>(f);
    case Insn::Cpslt_Wb_Wn:
      return choose_compared<Compared::Less>(f);
    case Insn::Ff1l_Ws_Wnd:
      return choose_find<FirstOneLeft>(f);
    case Insn::Ff1r_Ws_Wnd:
      return choose_find<FirstOneRight>(f);
    case Insn::Fbcl_Ws_Wnd:
      return choose_find<FirstChange>(f);
    default:
      return nullptr;
  }
}

}  // namespace dspic
