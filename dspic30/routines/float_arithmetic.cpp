// SPDX-License-Identifier: MIT
// Sum, difference, product and quotient of two floats (hal_dspic/runtime/float_arithmetic.s) and how long
// they take: `Cycles` below count as the routine's parts do, in its order.
//
// Numbers with a hidden bit are here; other operands are float.c's (float_any.cpp).
#include "dspic30/routines/float_parts.h"
#include "dspic30/routines/known_routines.h"

namespace dspic {

namespace {

using namespace float_parts;

constexpr int kOpen = 17;   // operands saved, exponents taken out and compared
constexpr int kLeave = 12;  // operands given back, RETURN with the stall behind W15

/// 32 bits, leading one on top, the lowest eight decide the rounding; exponent above 0.
KnownAnswer rounded(std::uint64_t w, bool negative, int exponent, std::uint32_t m, int cycles) {
  std::uint32_t bits;
  if (exponent > kLargest) {
    bits = kInfinity;
    cycles += 8;
  } else {
    const std::uint64_t sum = std::uint64_t{m} + 0x7F + (m >> 8 & 1);
    const bool carries = sum >> 32 != 0;
    // the hidden bit counts the exponent up by one
    bits = (static_cast<std::uint32_t>(sum) >> 8 | (carries ? 0x800000u : 0)) +
           (static_cast<std::uint32_t>(exponent + carries - 1) << kFraction);
    cycles += 17 + carries;
  }
  return returned(w, bits | (negative ? kSign : 0), cycles + kLeave - 3);
}

KnownAnswer sum(std::uint64_t w, std::uint32_t a, std::uint32_t b, int cycles) {
  if (!is_normal(a) || !is_normal(b)) return {};
  int e = exponent_of(a);
  int apart = e - exponent_of(b);
  cycles += kOpen + 1 + 2;
  // a is to have the larger exponent
  if (apart < 0) {
    std::swap(a, b);
    e -= apart;
    apart = -apart;
    cycles += 3;
  }
  std::uint32_t m = widened(a), n = widened(b);
  cycles += 2 + 10 + 1;
  cycles += apart < 16 ? 9 : 11;
  const int down = apart < 31 ? apart : 31;
  n = n >> down | ((n & ((1u << down) - 1)) != 0);
  cycles += 3;
  if (!((a ^ b) & kSign)) {
    const std::uint64_t both = std::uint64_t{m} + n;
    if (both >> 32 == 0) return rounded(w, a & kSign, e, static_cast<std::uint32_t>(both), cycles + 6);
    const auto half = static_cast<std::uint32_t>(both >> 1) | (both & 1);
    return rounded(w, a & kSign, e + 1, half, cycles + 12);
  }
  bool negative = a & kSign;
  std::uint32_t rest = m - n;
  cycles += 3 + 2 + 2;
  if (m < n) {
    rest = 0 - rest;
    negative = !negative;
    cycles += 2;
  }
  if (rest >> 31) return rounded(w, negative, e, rest, cycles + 3);
  if (rest == 0) return returned(w, 0, cycles + 2 + 1 + 1 + 4 + 2 + 7);
  const int up = __builtin_clz(rest);
  cycles += 2 + 1 + (up < 16 ? 2 : 6);
  if (e - up <= 0) return {};
  return rounded(w, negative, e - up, rest << up, cycles + 10);
}

KnownAnswer add(std::uint64_t w) { return sum(w, first(w), second(w), 0); }
KnownAnswer subtract(std::uint64_t w) { return sum(w, first(w), second(w) ^ kSign, 1); }

KnownAnswer multiply(std::uint64_t w) {
  const std::uint32_t a = first(w), b = second(w);
  if (!is_normal(a) || !is_normal(b)) return {};
  const std::uint64_t product = std::uint64_t{fraction_of(a)} * fraction_of(b);  // 48 bits
  auto m = static_cast<std::uint32_t>(product >> 16) | ((product & 0xFFFF) != 0);
  int e = exponent_of(a) + exponent_of(b) - (kBias - 1);
  int cycles = kOpen + 6 + 11 + 3;
  if (m >> 31) {
    cycles += 3;
  } else {
    m <<= 1;
    --e;
    cycles += 5;
  }
  if (e <= 0) return {};
  return rounded(w, (a ^ b) & kSign, e, m, cycles + 3);
}

/// One digit of 16 bits: rest * 65536 / divisor. The chip divides by the divisor's upper word; what the lower
/// one takes makes the digit smaller, by two at most.
std::uint32_t next_digit(std::uint64_t& rest, std::uint32_t divisor, int& cycles) {
  const std::uint32_t upper = divisor >> 16, lower = divisor & 0xFFFF;
  const auto r = static_cast<std::uint32_t>(rest);
  std::uint32_t digit;
  std::int64_t left;
  if (r >> 16 >= upper) {
    digit = 0xFFFF;
    const std::uint32_t sum = (r & 0xFFFF) + upper;  // its carry: nothing can be too large
    left = (static_cast<std::int64_t>(sum) << 16) - static_cast<std::int64_t>(digit) * lower;
    cycles += 2 + 1 + 3;
    cycles += sum >> 16 ? 2 + 2 : 1 + 2 + (left >= 0 ? 1 + 2 : 2);
    if (sum >> 16) left = static_cast<std::uint32_t>(left);
  } else {
    digit = r / upper;
    left = (static_cast<std::int64_t>(r % upper) << 16) - static_cast<std::int64_t>(digit) * lower;
    cycles += 2 + 19 + 1 + 3 + (left >= 0 ? 2 : 1);
  }
  for (bool again = false; left < 0; again = true) {
    cycles += again ? 5 : 0;
    left += divisor;
    --digit;
    if (left >= 0) cycles += 3 + 1 + 2;
  }
  rest = static_cast<std::uint64_t>(left);
  return digit;
}

KnownAnswer divide(std::uint64_t w) {
  const std::uint32_t a = first(w), b = second(w);
  if (!is_normal(a) || !is_normal(b)) return {};
  int e = exponent_of(a) - exponent_of(b) + kBias;
  const std::uint32_t divisor = widened(b);
  std::uint64_t rest = widened(a) >> 1;  // less than the divisor
  int cycles = kOpen + 4 + 10 + 2;
  const std::uint32_t upper = next_digit(rest, divisor, cycles);
  const std::uint32_t lower = next_digit(rest, divisor, cycles);
  std::uint32_t m = upper << 16 | lower;
  cycles += 3;
  if (m >> 31) {
    cycles += 3;
  } else {
    m <<= 1;
    --e;
    cycles += 5;
  }
  m |= rest != 0;
  if (e <= 0) return {};
  return rounded(w, (a ^ b) & kSign, e, m, cycles + 6);
}

}  // namespace

const std::vector<KnownRoutine>& float_routines() {
  static const std::vector<KnownRoutine> all = {
      {"___addsf3", 0xc8ef8ffc62a8e373, &add, nullptr},
      {"___subsf3", 0x4bb8372ccb12872e, &subtract, nullptr},
      {"___mulsf3", 0x1bb4c8a6d0cfa5aa, &multiply, nullptr},
      {"___divsf3", 0x90752fbc4e2a5405, &divide, nullptr},
  };
  return all;
}

}  // namespace dspic
