// SPDX-License-Identifier: MIT
// Integer products, and division: one step of 18 each time REPEAT runs it. The result is
// made in the last one.
#include "dspic30/core/operands.h"

namespace dspic {

namespace {

using namespace operands;

void put_pair(Cpu& cpu, unsigned d, std::uint32_t value) {
  cpu.w[d] = static_cast<std::uint16_t>(value);
  cpu.w[d + 1] = static_cast<std::uint16_t>(d == 14 ? value >> 16 & 0xFFFE : value >> 16);
}

template <bool SignedA, bool SignedB, class B>
const Decoded* multiply(Cpu& cpu, const Decoded* d) {
  const unsigned a = cpu.w[d->b], b = B::template get<false>(cpu, d);
  const std::int64_t product = std::int64_t{SignedA ? sign_extend(a, 16) : static_cast<int>(a)} *
                               (SignedB ? sign_extend(b, 16) : static_cast<int>(b));
  put_pair(cpu, d->d, static_cast<std::uint32_t>(product));
  return d + 1;
}
template <bool SignedA, bool SignedB>
Run choose_product(const Fields& f) {
  return f.p == 0 ? &multiply<SignedA, SignedB, Rs> : &multiply<SignedA, SignedB, Memory>;
}

const Decoded* multiply_file(Cpu& cpu, const Decoded* d) {
  put_pair(cpu, 2, File::get<false>(cpu, d) * cpu.w[0]);
  return d + 1;
}
const Decoded* multiply_file_byte(Cpu& cpu, const Decoded* d) {
  cpu.w[2] = static_cast<std::uint16_t>(File::get<true>(cpu, d) * (cpu.w[0] & 0xFFu));
  return d + 1;
}

// --- division

constexpr int kIterations = 18;

// flags of the remainder; on overflow the registers are undefined, here the low bits
const Decoded* divided(Cpu& cpu, const Decoded* d, std::int64_t quotient, std::int64_t remainder,
                       bool overflow) {
  cpu.w[0] = static_cast<std::uint16_t>(quotient);
  cpu.w[1] = static_cast<std::uint16_t>(remainder);
  cpu.set_nz<false>(cpu.w[1]);
  if (remainder >= 0) cpu.n = 0;
  cpu.ov = overflow ? 0x8000 : 0;
  cpu.c = 0;
  return d + 1;
}

// is there nothing to compute yet? A zero divisor traps in the first iteration alone,
// whatever its handler does
bool is_on_its_way(Cpu& cpu, const Decoded* d) {
  if (cpu.w[d->s] == 0) {
    const bool is_repeated = cpu.window != Cpu::Window::Plain;
    if (cpu.rcount == kIterations - 1 || !is_repeated) cpu.trap(Trap::MathError);
    return true;
  }
  return cpu.rcount != 0;
}

template <bool Long>
const Decoded* divide_signed(Cpu& cpu, const Decoded* d) {
  if (is_on_its_way(cpu, d)) return d + 1;
  const std::int64_t divisor = sign_extend(cpu.w[d->s], 16);
  const std::int64_t dividend =
      Long ? static_cast<std::int32_t>(static_cast<std::uint32_t>(cpu.w[d->b]) |
                                       static_cast<std::uint32_t>(cpu.w[d->b + 1u]) << 16)
           : sign_extend(cpu.w[d->b], 16);
  const std::int64_t quotient = dividend / divisor;
  return divided(cpu, d, quotient, dividend % divisor, quotient != static_cast<std::int16_t>(quotient));
}
template <bool Long>
const Decoded* divide_unsigned(Cpu& cpu, const Decoded* d) {
  if (is_on_its_way(cpu, d)) return d + 1;
  const std::uint32_t divisor = cpu.w[d->s];
  const std::uint32_t dividend =
      cpu.w[d->b] | (Long ? static_cast<std::uint32_t>(cpu.w[d->b + 1u]) << 16 : 0);
  return divided(cpu, d, dividend / divisor, dividend % divisor, dividend / divisor > 0xFFFF);
}
const Decoded* divide_fraction(Cpu& cpu, const Decoded* d) {
  if (is_on_its_way(cpu, d)) return d + 1;
  const std::int64_t divisor = sign_extend(cpu.w[d->s], 16),
                     dividend = std::int64_t{sign_extend(cpu.w[d->b], 16)} * 0x8000;
  const std::int64_t quotient = dividend / divisor;
  return divided(cpu, d, quotient, dividend % divisor, quotient != static_cast<std::int16_t>(quotient));
}

}  // namespace

bool is_idle_step(Run run, unsigned rcount) {
  return rcount < kIterations - 1 &&
         (run == &divide_signed<false> || run == &divide_signed<true> || run == &divide_unsigned<false> ||
          run == &divide_unsigned<true> || run == &divide_fraction);
}

Run choose_multiply(Insn id, const Fields& f) {
  switch (id) {
    case Insn::Mul_f:
      return f.B ? &multiply_file_byte : &multiply_file;
    case Insn::Mul_UU_Wb_lit5_Wnd:
      return &multiply<false, false, Literal>;
    case Insn::Mul_UU_Wb_Ws_Wnd:
      return choose_product<false, false>(f);
    case Insn::Mul_US_Wb_Ws_Wnd:
      return choose_product<false, true>(f);
    case Insn::Mul_SU_Wb_lit5_Wnd:
      return &multiply<true, false, Literal>;
    case Insn::Mul_SU_Wb_Ws_Wnd:
      return choose_product<true, false>(f);
    case Insn::Mul_SS_Wb_Ws_Wnd:
      return choose_product<true, true>(f);
    case Insn::Div_S_Wm_Wn:
      return &divide_signed<false>;
    case Insn::Div_S_Wm_Wn_long:
      return &divide_signed<true>;
    case Insn::Div_U_Wm_Wn:
      return &divide_unsigned<false>;
    case Insn::Div_U_Wm_Wn_long:
      return &divide_unsigned<true>;
    case Insn::Divf_Wm_Wn:
      return &divide_fraction;
    default:
      return nullptr;
  }
}

}  // namespace dspic
