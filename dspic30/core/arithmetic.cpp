// SPDX-License-Identifier: MIT
// Arithmetic, logic, rotates, shifts and compares, in the manual's order.
#include "dspic30/core/operands.h"

namespace dspic {

namespace {

using namespace operands;

// --- what is done with two operands

template <bool Byte>
unsigned inverse(unsigned x) {
  return ~x & kMask<Byte>;
}

struct Add {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned a, unsigned b) {
    return cpu.add<Byte, false>(a, b, 0);
  }
};
struct Addc {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned a, unsigned b) {
    return cpu.add<Byte, true>(a, b, cpu.flag_c());
  }
};
struct Sub {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned a, unsigned b) {
    return cpu.add<Byte, false>(a, inverse<Byte>(b), 1);
  }
};
struct Subb {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned a, unsigned b) {
    return cpu.add<Byte, true>(a, inverse<Byte>(b), cpu.flag_c());
  }
};
struct Subr {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned a, unsigned b) {
    return Sub::of<Byte>(cpu, b, a);
  }
};
struct Subbr {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned a, unsigned b) {
    return Subb::of<Byte>(cpu, b, a);
  }
};
struct And {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned a, unsigned b) {
    cpu.set_nz<Byte>(a & b);
    return a & b;
  }
};
struct Xor {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned a, unsigned b) {
    cpu.set_nz<Byte>(a ^ b);
    return a ^ b;
  }
};
struct Ior {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned a, unsigned b) {
    cpu.set_nz<Byte>(a | b);
    return a | b;
  }
};

// --- what is done with one

template <int Step>
struct Inc {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned x) {
    return Add::of<Byte>(cpu, x, Step);
  }
};
template <int Step>
struct Dec {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned x) {
    return Sub::of<Byte>(cpu, x, Step);
  }
};
struct Neg {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned x) {
    return Sub::of<Byte>(cpu, 0, x);
  }
};
struct Com {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned x) {
    return And::of<Byte>(cpu, inverse<Byte>(x), kMask<Byte>);
  }
};

template <bool Byte>
constexpr int kTop = Byte ? 7 : 15;

// C takes the bit that falls out
template <bool Byte>
unsigned shifted(Cpu& cpu, unsigned result, unsigned carry) {
  cpu.c = carry & 1;
  return Ior::of<Byte>(cpu, result & kMask<Byte>, 0);
}

struct Sl {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned x) {
    return shifted<Byte>(cpu, x << 1, x >> kTop<Byte>);
  }
};
struct Lsr {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned x) {
    return shifted<Byte>(cpu, x >> 1, x);
  }
};
struct Asr {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned x) {
    return shifted<Byte>(cpu, x >> 1 | (x & (1u << kTop<Byte>)), x);
  }
};
struct Rlnc {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned x) {
    return Ior::of<Byte>(cpu, (x << 1 | x >> kTop<Byte>)&kMask<Byte>, 0);
  }
};
struct Rlc {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned x) {
    return shifted<Byte>(cpu, x << 1 | cpu.flag_c(), x >> kTop<Byte>);
  }
};
struct Rrnc {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned x) {
    return Ior::of<Byte>(cpu, (x >> 1 | x << kTop<Byte>)&kMask<Byte>, 0);
  }
};
struct Rrc {
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned x) {
    return shifted<Byte>(cpu, x >> 1 | static_cast<unsigned>(cpu.flag_c()) << kTop<Byte>, x);
  }
};
struct Same {  // MOV f
  template <bool Byte>
  static unsigned of(Cpu& cpu, unsigned x) {
    return Ior::of<Byte>(cpu, x, 0);
  }
};

// --- instructions

template <class Op, bool Byte, class A, class B, class To>
const Decoded* binary(Cpu& cpu, const Decoded* d) {
  const unsigned a = A::template get<Byte>(cpu, d), b = B::template get<Byte>(cpu, d);
  To::template put<Byte>(cpu, d, Op::template of<Byte>(cpu, a, b));
  return d + 1;
}

template <class Op, bool Byte, class A, class To>
const Decoded* unary(Cpu& cpu, const Decoded* d) {
  const unsigned a = A::template get<Byte>(cpu, d);
  To::template put<Byte>(cpu, d, Op::template of<Byte>(cpu, a));
  return d + 1;
}

template <class Op>
struct Binary {
  static Run in_registers(const Fields& f) { return pick<Rs, Memory>(f.B != 0, f.p, f.q); }
  static Run with_literal(const Fields& f) { return pick<Literal, Literal>(f.B != 0, 0, f.q); }
  static Run on_register(const Fields& f) {  // #lit10,Wn
    return f.B ? &binary<Op, true, Rd, Literal, Rd> : &binary<Op, false, Rd, Literal, Rd>;
  }
  static Run on_file(const Fields& f) {
    if (f.B) return f.D ? &binary<Op, true, File, W0, File> : &binary<Op, true, File, W0, W0>;
    return f.D ? &binary<Op, false, File, W0, File> : &binary<Op, false, File, W0, W0>;
  }

 private:
  template <class Direct, class Indirect>
  static Run pick(bool byte, unsigned p, unsigned q) {
    if (byte) {
      if (p == 0) return q == 0 ? &binary<Op, true, Wb, Direct, Rd> : &binary<Op, true, Wb, Direct, Memory>;
      return q == 0 ? &binary<Op, true, Wb, Indirect, Rd> : &binary<Op, true, Wb, Indirect, Memory>;
    }
    if (p == 0) return q == 0 ? &binary<Op, false, Wb, Direct, Rd> : &binary<Op, false, Wb, Direct, Memory>;
    return q == 0 ? &binary<Op, false, Wb, Indirect, Rd> : &binary<Op, false, Wb, Indirect, Memory>;
  }
};

template <class Op>
struct Unary {
  static Run in_registers(const Fields& f) {
    if (f.B) {
      if (f.p == 0) return f.q == 0 ? &unary<Op, true, Rs, Rd> : &unary<Op, true, Rs, Memory>;
      return f.q == 0 ? &unary<Op, true, Memory, Rd> : &unary<Op, true, Memory, Memory>;
    }
    if (f.p == 0) return f.q == 0 ? &unary<Op, false, Rs, Rd> : &unary<Op, false, Rs, Memory>;
    return f.q == 0 ? &unary<Op, false, Memory, Rd> : &unary<Op, false, Memory, Memory>;
  }
  static Run on_file(const Fields& f) {
    if (f.B) return f.D ? &unary<Op, true, File, File> : &unary<Op, true, File, W0>;
    return f.D ? &unary<Op, false, File, File> : &unary<Op, false, File, W0>;
  }
};

// CLR and SETM: no flags
template <unsigned Value, bool Byte, class To>
const Decoded* fill(Cpu& cpu, const Decoded* d) {
  To::template put<Byte>(cpu, d, Value);
  return d + 1;
}

template <unsigned Value>
Run choose_fill(const Fields& f, bool to_wreg, bool to_file) {
  if (to_wreg) return f.B ? &fill<Value, true, W0> : &fill<Value, false, W0>;
  if (to_file) return f.B ? &fill<Value, true, File> : &fill<Value, false, File>;
  if (f.q == 0) return f.B ? &fill<Value, true, Rd> : &fill<Value, false, Rd>;
  return f.B ? &fill<Value, true, Memory> : &fill<Value, false, Memory>;
}

// compares: a subtraction without a result
template <class Op, class B>
Run choose_compare(const Fields& f) {
  return f.B ? &binary<Op, true, Wb, B, Nowhere> : &binary<Op, false, Wb, B, Nowhere>;
}
template <class Op>
Run choose_compare_file(const Fields& f) {
  return f.B ? &binary<Op, true, File, W0, Nowhere> : &binary<Op, false, File, W0, Nowhere>;
}
template <class A>
Run choose_compare_zero(const Fields& f) {
  return f.B ? &unary<Dec<0>, true, A, Nowhere> : &unary<Dec<0>, false, A, Nowhere>;
}

// shifts by several bits: words only, C stays
constexpr unsigned kMostShift = 31;  // Wns<4:0>

struct Left {
  static unsigned of(unsigned x, unsigned bits) { return bits > 15 ? 0 : x << bits & 0xFFFF; }
};
struct Right {
  static unsigned of(unsigned x, unsigned bits) { return bits > 15 ? 0 : x >> bits; }
};
struct RightSigned {
  static unsigned of(unsigned x, unsigned bits) {
    return static_cast<unsigned>(sign_extend(x, 16) >> (bits > 15 ? 15 : bits)) & 0xFFFF;
  }
};

template <class Op, class Amount>
const Decoded* shift(Cpu& cpu, const Decoded* d) {
  const unsigned result = Op::of(cpu.w[d->b], Amount::template get<false>(cpu, d) & kMostShift);
  cpu.set_nz<false>(result);
  put_register<false>(cpu, d, result);
  return d + 1;
}

}  // namespace

#define BINARY(Name, Op)                \
  case Insn::Name##_f:                  \
    return Binary<Op>::on_file(f);      \
  case Insn::Name##_Wb_lit5_Wd:         \
    return Binary<Op>::with_literal(f); \
  case Insn::Name##_Wb_Ws_Wd:           \
    return Binary<Op>::in_registers(f);
#define LITERAL(Name, Op)     \
  case Insn::Name##_lit10_Wn: \
    return Binary<Op>::on_register(f);
#define UNARY(Name, Op)           \
  case Insn::Name##_f:            \
    return Unary<Op>::on_file(f); \
  case Insn::Name##_Ws_Wd:        \
    return Unary<Op>::in_registers(f);
#define SHIFT(Name, Op)          \
  case Insn::Name##_Wb_lit4_Wnd: \
    return &shift<Op, Literal>;  \
  case Insn::Name##_Wb_Wns_Wnd:  \
    return &shift<Op, Rs>;

// The function of each form of the arithmetic instructions; null: it is none of them.
Run choose_arithmetic(Insn id, const Fields& f) {
  switch (id) {
    BINARY(Add, Add)
    BINARY(Addc, Addc)
    BINARY(Sub, Sub)
    BINARY(Subb, Subb)
    BINARY(Subr, Subr)
    BINARY(Subbr, Subbr)
    BINARY(And, And)
    BINARY(Xor, Xor)
    BINARY(Ior, Ior)
    LITERAL(Add, Add)
    LITERAL(Addc, Addc)
    LITERAL(Sub, Sub)
    LITERAL(Subb, Subb)
    LITERAL(And, And)
    LITERAL(Xor, Xor)
    LITERAL(Ior, Ior)
    UNARY(Inc, Inc<1>)
    UNARY(Inc2, Inc<2>)
    UNARY(Dec, Dec<1>)
    UNARY(Dec2, Dec<2>)
    UNARY(Neg, Neg)
    UNARY(Com, Com)
    UNARY(Sl, Sl)
    UNARY(Lsr, Lsr)
    UNARY(Asr, Asr)
    UNARY(Rlnc, Rlnc)
    UNARY(Rlc, Rlc)
    UNARY(Rrnc, Rrnc)
    UNARY(Rrc, Rrc)
    SHIFT(Sl, Left)
    SHIFT(Lsr, Right)
    SHIFT(Asr, RightSigned)
    case Insn::Clr_f:
    case Insn::Clr_WREG:
    case Insn::Clr_Wd:
      return choose_fill<0>(f, id == Insn::Clr_WREG, id == Insn::Clr_f);
    case Insn::Setm_f:
    case Insn::Setm_WREG:
    case Insn::Setm_Wd:
      return choose_fill<0xFFFF>(f, id == Insn::Setm_WREG, id == Insn::Setm_f);
    case Insn::Cp_f:
      return choose_compare_file<Sub>(f);
    case Insn::Cp_Wb_lit5:
      return choose_compare<Sub, Literal>(f);
    case Insn::Cp_Wb_Ws:
      return f.p == 0 ? choose_compare<Sub, Rs>(f) : choose_compare<Sub, Memory>(f);
    case Insn::Cpb_f:
      return choose_compare_file<Subb>(f);
    case Insn::Cpb_Wb_lit5:
      return choose_compare<Subb, Literal>(f);
    case Insn::Cpb_Wb_Ws:
      return f.p == 0 ? choose_compare<Subb, Rs>(f) : choose_compare<Subb, Memory>(f);
    case Insn::Cp0_f:
      return choose_compare_zero<File>(f);
    case Insn::Cp0_Ws:
      return f.p == 0 ? choose_compare_zero<Rs>(f) : choose_compare_zero<Memory>(f);
    case Insn::Mov_f:
      return Unary<Same>::on_file(f);
    default:
      return nullptr;
  }
}

}  // namespace dspic
