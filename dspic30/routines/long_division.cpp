// SPDX-License-Identifier: MIT
// Quotients and remainders of 32 bits (hal_dspic/runtime/long_division.s). A divisor of one word takes two
// divisions of the chip; a longer one sixteen steps, each of which takes two cycles more where the quotient
// has a 1. Division by 0 traps, so it runs.
#include "dspic30/routines/known_routines.h"

namespace dspic {

namespace {

constexpr int kShortDivisor = 51, kLongDivisor = 171, kBitOfQuotient = 2;  // cycles of __divide_long

std::uint32_t low(std::uint64_t w) { return static_cast<std::uint32_t>(w); }
std::uint32_t high(std::uint64_t w) { return static_cast<std::uint32_t>(w >> 32); }
bool is_negative(std::uint32_t x) { return x >> 31 != 0; }
std::uint32_t magnitude(std::uint32_t x) { return is_negative(x) ? 0 - x : x; }

struct Division {
  std::uint32_t quotient = 0, remainder = 0;
  int cycles = 0;  // of __divide_long; 0: divided by 0
};
Division divide(std::uint32_t dividend, std::uint32_t divisor) {
  if (divisor == 0) return {};
  const std::uint32_t quotient = dividend / divisor;
  const int cycles =
      divisor < 0x10000 ? kShortDivisor : kLongDivisor + kBitOfQuotient * __builtin_popcount(quotient);
  return {quotient, dividend - quotient * divisor, cycles};
}

// the remainder stays where it is left, in W3:W2
KnownAnswer answer(std::uint32_t result, const Division& d, int more) {
  return {static_cast<std::uint64_t>(d.remainder) << 32 | result, d.cycles ? d.cycles + more : 0};
}

KnownAnswer divide_long(std::uint64_t w) {
  const Division d = divide(low(w), high(w));
  return answer(d.quotient, d, 0);
}
KnownAnswer unsigned_quotient(std::uint64_t w) {
  const Division d = divide(low(w), high(w));
  return answer(d.quotient, d, 2);
}
KnownAnswer unsigned_remainder(std::uint64_t w) {
  const Division d = divide(low(w), high(w));
  return answer(d.remainder, d, 7);
}

// what making both operands positive takes more than if they are
int negations(std::uint32_t a, std::uint32_t b) { return is_negative(a) + 3 * is_negative(b); }

KnownAnswer quotient(std::uint64_t w) {
  const std::uint32_t a = low(w), b = high(w);
  const Division d = divide(magnitude(a), magnitude(b));
  const bool negates = is_negative(a ^ b);
  return answer(negates ? 0 - d.quotient : d.quotient, d, 18 + negations(a, b) + 3 * negates);
}
KnownAnswer remainder(std::uint64_t w) {
  const std::uint32_t a = low(w), b = high(w);
  const Division d = divide(magnitude(a), magnitude(b));
  return answer(is_negative(a) ? 0 - d.remainder : d.remainder, d, 21 + 3 * is_negative(b));
}

}  // namespace

const std::vector<KnownRoutine>& long_division_routines() {
  static const std::vector<KnownRoutine> all = {
      {"__divide_long", 0x3ed846e3e46daf80, &divide_long, nullptr},
      {"___udivsi3", 0x3d9964e8a3765533, &unsigned_quotient, nullptr},
      {"___umodsi3", 0xefe4a285ef86e9ce, &unsigned_remainder, nullptr},
      {"___divsi3", 0x5888e942d2a33343, &quotient, nullptr},
      {"___modsi3", 0x96e160b9c1a9666e, &remainder, nullptr},
  };
  return all;
}

}  // namespace dspic
