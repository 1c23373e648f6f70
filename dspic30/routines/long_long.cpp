// SPDX-License-Identifier: MIT
// 64 bits: quotients and remainders (hal_dspic/runtime/long_long_division.s), products and shifts
// (long_long.c). A division of 32 bits within is that routine's; else a bit a round, from the dividend's
// first word that is not 0 on. Division by 0 traps, so it runs.
#include "dspic30/routines/forms.h"
#include "dspic30/routines/known_routines.h"
#include "dspic30/routines/long_division.h"

namespace dspic {

namespace {

using namespace forms;
using long_division::Division;

constexpr unsigned kSavedWords = 5;
constexpr unsigned kBehindCall = 0x16;  // of __divide_long

bool is_below_0(std::uint64_t x) { return x >> 63 != 0; }
std::uint64_t without_sign(std::uint64_t x) { return is_below_0(x) ? 0 - x : x; }

/// __divide_long_long at `place`; `base`: words on the stack below what it saves, `w8` what it finds there.
int divide_wide(Cpu& cpu, std::int64_t limit, std::uint64_t a, std::uint64_t b, unsigned place, unsigned base,
                unsigned w8, int cycles) {
  if (b == 0) return 0;
  const auto save = [&] {
    leave_registers(cpu, base, 8, kSavedWords);
    leave(cpu, base, w8);
  };
  if ((a | b) >> 32 == 0) {
    const Division d = long_division::divide(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    cycles += 29 + d.cycles;
    if (cycles > limit) return 0;
    save();
    leave_return(cpu, base + kSavedWords, place + kBehindCall);
    long_division::leave_division(cpu, d);
    set_four(cpu, 0, d.quotient);
    set_four(cpu, 4, d.remainder);
    return cycles;
  }
  const std::uint64_t quotient = a / b;
  const int empty_words = a == 0 ? 4 : __builtin_clzll(a) / 16;
  cycles += 18 + 12;
  if (a == 0)
    cycles += 3 * 9 + 10;
  else
    cycles += 9 * empty_words + 3 + 18 * (64 - 16 * empty_words) + 4 * __builtin_popcountll(quotient) - 1;
  if (cycles > limit) return 0;
  save();
  set_four(cpu, 0, quotient);
  set_four(cpu, 4, a % b);
  sub(cpu, a == 0 ? 16 : 1, a == 0 ? 16 : 1);  // the last count
  return cycles;
}

/// Where the BRA or RCALL of the routine's first instruction leads, `at` bytes from its start.
unsigned reached(const Cpu& cpu, unsigned at) { return target(cpu, cpu.address_of(cpu.at) + at); }

int divide_long_long(Cpu& cpu, std::int64_t limit) {
  return divide_wide(cpu, limit, four(cpu, 0), four(cpu, 4), cpu.address_of(cpu.at), 0, cpu.w[8], 0);
}
int wide_unsigned_quotient(Cpu& cpu, std::int64_t limit) {
  return divide_wide(cpu, limit, four(cpu, 0), four(cpu, 4), reached(cpu, 0), 0, cpu.w[8], 2);
}
int wide_unsigned_remainder(Cpu& cpu, std::int64_t limit) {
  const int cycles = divide_wide(cpu, limit, four(cpu, 0), four(cpu, 4), reached(cpu, 0), 2, cpu.w[8], 9);
  if (!cycles) return 0;
  leave_return(cpu, 0, cpu.address_of(cpu.at) + 2);
  set_four(cpu, 0, four(cpu, 4));
  return cycles;
}

void negate(Cpu& cpu) {
  set(cpu, 0, sub(cpu, 0, cpu.w[0]));
  for (unsigned n = 1; n < 4; ++n) set(cpu, n, subb(cpu, 0, cpu.w[n]));
}

/// `sign`: word whose bit 15 is the result's sign.
int signed_result(Cpu& cpu, std::int64_t limit, unsigned sign, bool is_remainder) {
  const std::uint64_t a = four(cpu, 0), b = four(cpu, 4);
  const bool negates = sign & 0x8000;
  int cycles =
      6 + (is_below_0(a) ? 6 : 3) + (is_below_0(b) ? 9 : 4) + (is_remainder ? 4 : 0) + (negates ? 6 : 3) + 4;
  cycles = divide_wide(cpu, limit, without_sign(a), without_sign(b), reached(cpu, 6), 3, sign, cycles);
  if (!cycles) return 0;
  leave(cpu, 0, cpu.w[8]);
  leave_return(cpu, 1, cpu.address_of(cpu.at) + 8);
  if (is_remainder) set_four(cpu, 0, four(cpu, 4));
  if (negates) negate(cpu);
  return cycles;
}
int wide_quotient(Cpu& cpu, std::int64_t limit) {
  return signed_result(cpu, limit, cpu.w[3] ^ cpu.w[7], false);
}
int wide_remainder(Cpu& cpu, std::int64_t limit) { return signed_result(cpu, limit, cpu.w[3], true); }

// --- products and shifts

int product(Cpu& cpu, std::int64_t limit) {
  constexpr int kCycles = 68;
  if (limit < kCycles) return 0;
  const std::uint64_t x = four(cpu, 0), y = four(cpu, 4);
  const auto of = [&](unsigned i, unsigned j) { return std::uint32_t{cpu.w[i]} * cpu.w[4 + j]; };
  const std::uint32_t x1y0 = of(1, 0), x0y1 = of(0, 1), x3y0 = of(3, 0);
  const unsigned middle = (of(0, 0) >> 16) + (x0y1 & 0xFFFF);
  const std::uint64_t upper = (x & 0xFFFFFFFF) * (y & 0xFFFFFFFF) >> 32;
  // W14 and locals: x3 x2 y2 y3, x1 * y0, the highest word of the lower halves' product
  leave(cpu, 0, cpu.w[14]);
  leave(cpu, 1, cpu.w[3]);
  leave(cpu, 2, cpu.w[2]);
  leave_registers(cpu, 3, 6, 2);
  leave(cpu, 5, x1y0 & 0xFFFF);
  leave(cpu, 6, x1y0 >> 16);
  leave(cpu, 7, static_cast<unsigned>(upper >> 16));
  leave_registers(cpu, 8, 8, 6);
  set_four(cpu, 0, x * y);
  for (unsigned n = 1; n < 4; ++n) set(cpu, 3 + n, cpu.w[n]);
  set(cpu, 7, x3y0 >> 16);
  add(cpu, middle & 0xFFFF, x1y0 & 0xFFFF);
  return kCycles;
}

// by a register, whose five lowest bits count
unsigned left_by(unsigned word, unsigned bits) { return (bits & 31) > 15 ? 0 : word << (bits & 31) & 0xFFFF; }
unsigned right_by(unsigned word, unsigned bits) { return (bits & 31) > 15 ? 0 : word >> (bits & 31); }

constexpr int kByNone = 11, kNear = 36, kFar = 20;  // 0, 1 to 31, 32 to 63 bits

int shift(Cpu& cpu, std::int64_t limit, bool to_left) {
  const unsigned n = cpu.w[4];
  if (n > 63) return 0;
  const int cycles = n == 0 ? kByNone : n < 32 ? kNear : kFar;
  if (cycles > limit) return 0;
  const std::uint64_t x = four(cpu, 0), result = to_left ? x << n : x >> n;
  leave(cpu, 0, cpu.w[8]);
  if (n == 0) {
    sub(cpu, 0, 0);
  } else if (n < 32) {
    set(cpu, 5, to_left ? right_by(cpu.w[0], 32 - n) : left_by(cpu.w[3], 32 - n));
    set(cpu, 7, to_left ? right_by(cpu.w[1], 16 - n) : left_by(cpu.w[2], 16 - n));
    set_four(cpu, 0, result);
    set(cpu, 6, cpu.w[to_left ? 1 : 2]);
    sub(cpu, 16, 32 - n);
    logic(cpu, cpu.w[to_left ? 0 : 3]);
  } else {
    set(cpu, 4, sub(cpu, n, 32));
    set_four(cpu, 0, result);
    logic(cpu, cpu.w[to_left ? 2 : 1]);
  }
  return cycles;
}
int shift_right_signed(Cpu& cpu, std::int64_t limit) {
  const unsigned n = cpu.w[4];
  if (n > 63) return 0;
  const int cycles = n == 0 ? 15 : n < 16 ? 40 : n < 32 ? 39 : n < 48 ? 26 : 27;
  if (cycles > limit) return 0;
  const auto x = static_cast<std::int64_t>(four(cpu, 0));
  leave(cpu, 0, cpu.w[8]);
  if (n == 0) {
    set(cpu, 5, cpu.w[2]);
    sub(cpu, 0, 0);
    return cycles;
  }
  if (n < 32) {
    set(cpu, 6, left_by(cpu.w[3], 32 - n));
    set(cpu, 7, left_by(cpu.w[2], 16 - n));
    sub(cpu, 16, 32 - n);
  } else {
    set(cpu, 4, left_by(cpu.w[3], 48 - n));
    sub(cpu, 48, n);
  }
  set_four(cpu, 0, static_cast<std::uint64_t>(x >> n));
  set(cpu, 5, cpu.w[2]);
  logic(cpu, cpu.w[3]);
  return cycles;
}
int shift_left(Cpu& cpu, std::int64_t limit) { return shift(cpu, limit, true); }
int shift_right(Cpu& cpu, std::int64_t limit) { return shift(cpu, limit, false); }

}  // namespace

const std::vector<KnownRoutine>& long_long_routines() {
  static const std::vector<KnownRoutine> all = {
      {"__divide_long_long", 0x5fb30539b809d22d, nullptr, &divide_long_long},
      {"___udivdi3", 0x7f4227873fd8d8a9, nullptr, &wide_unsigned_quotient},
      {"___umoddi3", 0xbddda211cc587a41, nullptr, &wide_unsigned_remainder},
      {"___divdi3", 0xd54776ec2614e09b, nullptr, &wide_quotient},
      {"___moddi3", 0x70e64835dfa84ce3, nullptr, &wide_remainder},
      {"___muldi3", 0xbe41b8451630d70b, nullptr, &product},
      {"___ashldi3", 0x37dc3bd2f6ba05fc, nullptr, &shift_left},
      {"___lshrdi3", 0xdb6b685a8e336c44, nullptr, &shift_right},
      {"___ashrdi3", 0x5cc762533a75525c, nullptr, &shift_right_signed},
  };
  return all;
}

}  // namespace dspic
