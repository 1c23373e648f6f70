// SPDX-License-Identifier: MIT
// Sum, difference, product and quotient of two floats (hal_dspic/runtime/float_arithmetic.s), in the
// routines' own steps: cycles are added as they pass. Zeros go to float.c's functions behind them; what has a
// subnormal number, an infinity or not-a-number as an operand or as its result runs.
#include <utility>

#include "dspic30/routines/float_parts.h"
#include "dspic30/routines/known_routines.h"

namespace dspic {

namespace {

using namespace float_parts;

constexpr int kOpen = 17;   // operands saved, exponents taken out and compared
constexpr int kFinish = 9;  // sign, operands given back, RETURN with the stall behind W15
constexpr int kOpenA = 15,
              kOpenB = 18;         // ... until one is found that has no hidden bit: the first, the second
constexpr int kLeaveTo = 8;        // operands given back, and on to float.c
constexpr unsigned kOperands = 8;  // bytes

struct Registers {
  std::uint32_t w3_w2 = 0;
  unsigned w5 = 0, w6 = 0;  // of W6 bit 15 is the sign
};

void leave_operands(Cpu& cpu) {
  leave_registers(cpu, 0, 0, 4);
  leave_registers(cpu, 4, 8, 2);
}

__attribute__((always_inline)) inline void leave_result(Cpu& cpu, std::uint32_t result, const Registers& r,
                                                        unsigned w4, unsigned w7) {
  leave_operands(cpu);
  set_pair(cpu, 0, result);
  set_pair(cpu, 2, r.w3_w2);
  set(cpu, 4, w4);
  set(cpu, 5, r.w5);
  set(cpu, 6, r.w6);
  set(cpu, 7, w7);
  give_back(cpu, kOperands);
}

/// m: leading one on top, the lowest eight bits decide the rounding; the exponent is above 0. `flip`: of W3,
/// before anything else.
__attribute__((always_inline)) inline int rounded(Cpu& cpu, std::int64_t limit, unsigned flip,
                                                  const Registers& r, int exponent, std::uint32_t m,
                                                  int cycles) {
  const std::uint32_t sign = (r.w6 & 0x8000u) << 16;
  if (exponent > kLargest) {
    cycles += 8 + kFinish;
    if (cycles > limit) return 0;
    set(cpu, 3, cpu.w[3] ^ flip);
    leave_result(cpu, sign | kInfinity, r, static_cast<unsigned>(exponent), kLargest);
    return cycles;
  }
  const std::uint64_t sum = std::uint64_t{m} + 0x7F + (m >> 8 & 1);
  const bool carries = sum >> 32 != 0;  // 1.11..1 has become 10.0
  cycles += 17 + carries + kFinish;
  if (cycles > limit) return 0;
  set(cpu, 3, cpu.w[3] ^ flip);
  const std::uint32_t up = static_cast<std::uint32_t>(sum) | (carries ? kSign : 0);
  // the hidden bit counts the exponent up by one
  const auto e = static_cast<std::uint32_t>(exponent + carries - 1);
  leave_result(cpu, sign | ((up >> 8) + (e << kFraction)), r, e << 7, up >> 16 << 8);
  return cycles;
}

// a zero and a number: the number; two zeros: what both are
int sum_with_zero(Cpu& cpu, std::int64_t limit, std::uint32_t a, std::uint32_t b, int cycles) {
  if (is_beyond(a) || is_beyond(b) || (magnitude(a) && magnitude(b))) return 0;
  const bool in_order = magnitude(a) >= magnitude(b);
  const std::uint32_t larger = in_order ? a : b;
  cycles +=
      (is_normal(a) ? kOpenB : kOpenA) + kLeaveTo + 36 + (in_order ? 6 : 5) + (magnitude(larger) ? 2 : 5);
  if (cycles > limit) return 0;
  leave_registers(cpu, 0, 8, 5);
  leave(cpu, 5, cpu.w[9]);
  set(cpu, 2, magnitude(larger) >> 16);
  set(cpu, 3, 0xFF);
  set(cpu, 4, 0);
  set(cpu, 5, static_cast<unsigned>(exponent_of(b)));
  set(cpu, 6, static_cast<unsigned>((is_normal(a) ? exponent_of(b) : exponent_of(a)) - 1));
  set(cpu, 7, kLargest);
  sub_pair(cpu, magnitude(larger), 0);
  if (!magnitude(larger)) logic(cpu, (a & b) >> 16);
  set_pair(cpu, 0, magnitude(larger) ? larger : a & b);
  return cycles;
}

int sum(Cpu& cpu, std::int64_t limit, unsigned flip, int cycles) {
  std::uint32_t a = pair(cpu, 0), b = pair(cpu, 2) ^ flip << 16;
  if (!is_normal(a) || !is_normal(b)) return sum_with_zero(cpu, limit, a, b, cycles);
  int e = exponent_of(a), apart = e - exponent_of(b);
  cycles += kOpen + 3;
  // a is to have the larger exponent
  if (apart < 0) {
    std::swap(a, b);
    e -= apart;
    apart = -apart;
    cycles += 3;
  }
  // The smaller one is shifted down, and a bit that falls out stays in the lowest.
  std::uint32_t m = widened(a), n = widened(b);
  const int down = apart < 31 ? apart : 31;
  n = n >> down | ((n & ((1u << down) - 1)) != 0);
  Registers r;
  r.w3_w2 = n;
  r.w5 = static_cast<unsigned>(apart < 16 ? apart : down - 16);
  r.w6 = a >> 16;
  cycles += 13 + (apart < 16 ? 9 : 11) + 3;
  // Like signs: the sum, which may have a bit more.
  if (!((a ^ b) & kSign)) {
    const std::uint64_t both = std::uint64_t{m} + n;
    if (both >> 32 == 0) return rounded(cpu, limit, flip, r, e, static_cast<std::uint32_t>(both), cycles + 6);
    const auto half = static_cast<std::uint32_t>(both >> 1) | (both & 1);
    return rounded(cpu, limit, flip, r, e + 1, half, cycles + 12);
  }
  // Unlike signs: the difference, which may have lost bits at the top.
  cycles += 7;
  if (m < n) {  // the exponents were the same
    m = n - m;
    r.w6 ^= 0x8000;
    cycles += 2;
  } else {
    m -= n;
  }
  if (m >> 31) return rounded(cpu, limit, flip, r, e, m, cycles + 3);
  if (m == 0) {
    cycles += 17;
    if (cycles > limit) return 0;
    set(cpu, 3, cpu.w[3] ^ flip);
    leave_result(cpu, 0, r, static_cast<unsigned>(e - 16), 0);
    return cycles;
  }
  const int up = __builtin_clz(m);
  if (e - up <= 0) return 0;
  r.w5 = up < 16 ? (m & 0xFFFF) >> (16 - up) : 0;
  return rounded(cpu, limit, flip, r, e - up, m << up, cycles + (up < 16 ? 5 : 9) + 10);
}

int add_floats(Cpu& cpu, std::int64_t limit) { return sum(cpu, limit, 0, 0); }
int subtract_floats(Cpu& cpu, std::int64_t limit) { return sum(cpu, limit, 0x8000, 1); }

/// float.c's function gives a zero of this sign; `frame` its words below the registers that it saves.
void leave_zero(Cpu& cpu, unsigned sign, unsigned w3, unsigned w4, unsigned w5) {
  leave_registers(cpu, 1, 1, 2);
  leave(cpu, 0, cpu.w[14]);
  leave_registers(cpu, 3, 8, 5);
  set(cpu, 0, 0);
  set(cpu, 1, sign);
  set(cpu, 2, 0);
  set(cpu, 3, w3);
  set(cpu, 4, w4);
  set(cpu, 5, w5);
  set(cpu, 6, 0xFFFF);
  set(cpu, 7, kLargest);
  sub_pair(cpu, 0, 0);
}

int product_with_zero(Cpu& cpu, std::int64_t limit, std::uint32_t a, std::uint32_t b) {
  if (is_beyond(a) || is_beyond(b) || (magnitude(a) && magnitude(b))) return 0;
  const int cycles = (is_normal(a) ? kOpenB : kOpenA) + kLeaveTo + (magnitude(a) ? 47 : 42);
  if (cycles > limit) return 0;
  leave_zero(cpu, (a ^ b) >> 16 & 0x8000, kInfinity >> 16, b >> 16 & kInfinity >> 16, 0);
  return cycles;
}

int multiply_floats(Cpu& cpu, std::int64_t limit) {
  const std::uint32_t a = pair(cpu, 0), b = pair(cpu, 2);
  if (!is_normal(a) || !is_normal(b)) return product_with_zero(cpu, limit, a, b);
  const std::uint32_t x = fraction_of(a), y = fraction_of(b);
  const std::uint64_t product = std::uint64_t{x} * y;  // 48 bits
  auto m = static_cast<std::uint32_t>(product >> 16) | ((product & 0xFFFF) != 0);
  int e = exponent_of(a) + exponent_of(b) - (kBias - 1);
  int cycles = kOpen + 20;
  if (m >> 31) {
    cycles += 3;
  } else {
    m <<= 1;
    --e;
    cycles += 5;
  }
  if (e <= 0) return 0;
  Registers r;
  r.w3_w2 = (x >> 16) * (y >> 16);
  r.w5 = ((x >> 16) * (y & 0xFFFF) + (x & 0xFFFF) * (y >> 16)) >> 16;
  r.w6 = (a ^ b) >> 16;
  return rounded(cpu, limit, 0, r, e, m, cycles + 3);
}

/// One digit of 16 bits: rest * 65536 / divisor. The chip divides by the divisor's upper word; what the lower
/// one takes makes the digit smaller, by two at most.
std::uint32_t next_digit(std::uint32_t& rest, std::uint32_t divisor, int& cycles) {
  const std::uint32_t upper = divisor >> 16, lower = divisor & 0xFFFF;
  std::uint32_t digit;
  std::int64_t left;
  if (rest >> 16 >= upper) {
    digit = 0xFFFF;
    const std::uint32_t sum = (rest & 0xFFFF) + upper;  // with a carry nothing can be too large
    left = (static_cast<std::int64_t>(sum) << 16) - static_cast<std::int64_t>(digit) * lower;
    if (sum >> 16) left = static_cast<std::uint32_t>(left);
    cycles += sum >> 16 ? 10 : left >= 0 ? 12 : 11;
  } else {
    digit = rest / upper;
    left = (static_cast<std::int64_t>(rest % upper) << 16) - static_cast<std::int64_t>(digit) * lower;
    cycles += left >= 0 ? 27 : 26;
  }
  for (bool again = false; left < 0; again = true) {
    if (again) cycles += 5;
    left += divisor;
    --digit;
    if (left >= 0) cycles += 6;
  }
  rest = static_cast<std::uint32_t>(left);
  return digit;
}

int quotient_of_zero(Cpu& cpu, std::int64_t limit, std::uint32_t a, std::uint32_t b) {
  if (magnitude(a) || !magnitude(b) || is_beyond(b)) return 0;
  const int cycles = kOpenA + kLeaveTo + 53;
  if (cycles > limit) return 0;
  leave_zero(cpu, (a ^ b) >> 16 & 0x8000, magnitude(b) >> 16, kInfinity >> 16, 0x8000);
  return cycles;
}

int divide_floats(Cpu& cpu, std::int64_t limit) {
  const std::uint32_t a = pair(cpu, 0), b = pair(cpu, 2);
  if (!is_normal(a) || !is_normal(b)) return quotient_of_zero(cpu, limit, a, b);
  int e = exponent_of(a) - exponent_of(b) + kBias;
  const std::uint32_t divisor = widened(b);
  std::uint32_t rest = widened(a) >> 1;  // less than the divisor
  int cycles = kOpen + 16;
  Registers r;
  r.w5 = next_digit(rest, divisor, cycles);
  std::uint32_t m = r.w5 << 16 | next_digit(rest, divisor, cycles);
  cycles += 3;
  if (m >> 31) {
    cycles += 3;
  } else {
    m <<= 1;
    --e;
    cycles += 5;
  }
  m |= rest != 0;
  if (e <= 0) return 0;
  r.w3_w2 = (divisor & 0xFFFF0000u) | ((rest | rest >> 16) & 0xFFFF);
  r.w6 = (a ^ b) >> 16;
  return rounded(cpu, limit, 0, r, e, m, cycles + 6);
}

}  // namespace

const std::vector<KnownRoutine>& float_routines() {
  static const std::vector<KnownRoutine> all = {
      {"___addsf3", 0xc8ef8ffc62a8e373, nullptr, &add_floats},
      {"___subsf3", 0x4bb8372ccb12872e, nullptr, &subtract_floats},
      {"___mulsf3", 0x1bb4c8a6d0cfa5aa, nullptr, &multiply_floats},
      {"___divsf3", 0x90752fbc4e2a5405, nullptr, &divide_floats},
  };
  return all;
}

}  // namespace dspic
