// SPDX-License-Identifier: MIT
// Quotients and remainders of 32 bits (hal_dspic/runtime/long_division.s). A divisor of one word takes two
// divisions of the chip; a longer one sixteen steps, each of which takes two cycles more where the quotient
// has a 1. Division by 0 traps, so it runs.
#include "dspic30/routines/long_division.h"

#include "dspic30/routines/forms.h"
#include "dspic30/routines/known_routines.h"

namespace dspic {

namespace {

using namespace forms;
using long_division::divide;
using long_division::Division;
using long_division::leave_division;

constexpr int kShortDivisor = 51, kLongDivisor = 171, kBitOfQuotient = 2;  // cycles of __divide_long

bool is_negative(std::uint32_t x) { return x >> 31 != 0; }
std::uint32_t magnitude_of(std::uint32_t x) { return is_negative(x) ? 0 - x : x; }

}  // namespace

namespace long_division {

Division divide(std::uint32_t dividend, std::uint32_t divisor) {
  if (divisor == 0) return {};
  Division d{dividend, divisor, dividend / divisor, dividend % divisor, kShortDivisor};
  if (divisor > 0xFFFF) d.cycles = kLongDivisor + kBitOfQuotient * __builtin_popcount(d.quotient);
  return d;
}

void leave_division(Cpu& cpu, const Division& d) {
  set_pair(cpu, 0, d.quotient);
  set_pair(cpu, 2, d.remainder);
  set(cpu, 4, d.divisor);
  if (d.divisor > 0xFFFF) {
    const std::uint32_t at_last = d.remainder + (d.quotient & 1 ? d.divisor : 0);
    set(cpu, 5, d.divisor >> 16);
    set(cpu, 6, 0);
    set(cpu, 7, (at_last - d.divisor) >> 16);
    sub(cpu, 1, 1);
    return;
  }
  set_pair(cpu, 5, d.dividend);
  set(cpu, 7, d.quotient >> 16);
  sub(cpu, 0, 0);
  // flags of the chip's division
  logic(cpu, d.remainder);
  cpu.n = 0;
  cpu.c = cpu.ov = 0;
}

}  // namespace long_division

namespace {

int divide_long(Cpu& cpu, std::int64_t limit) {
  const Division d = divide(pair(cpu, 0), pair(cpu, 2));
  if (d.cycles == 0 || d.cycles > limit) return 0;
  leave_division(cpu, d);
  return d.cycles;
}
int unsigned_quotient(Cpu& cpu, std::int64_t limit) {
  const int cycles = divide_long(cpu, limit - 2);
  return cycles ? cycles + 2 : 0;
}
// the call's return address stays below
int unsigned_remainder(Cpu& cpu, std::int64_t limit) {
  const int cycles = divide_long(cpu, limit - 7);
  if (!cycles) return 0;
  leave_return(cpu, 0, cpu.address_of(cpu.at) + 4);
  set_pair(cpu, 0, pair(cpu, 2));
  return cycles + 7;
}

// 0 - x
std::uint32_t negated(Cpu& cpu, std::uint32_t x) {
  const unsigned low = sub(cpu, 0, x & 0xFFFF);
  return low | subb(cpu, 0, x >> 16) << 16;
}

int quotient(Cpu& cpu, std::int64_t limit) {
  const std::uint32_t a = pair(cpu, 0), b = pair(cpu, 2);
  const Division d = divide(magnitude_of(a), magnitude_of(b));
  const bool negates = is_negative(a ^ b);
  const int cycles = d.cycles + 18 + is_negative(a) + 3 * is_negative(b) + 3 * negates;
  if (d.cycles == 0 || cycles > limit) return 0;
  leave(cpu, 0, (a ^ b) >> 16);
  leave_return(cpu, 1, cpu.address_of(cpu.at) + 12);
  leave_division(cpu, d);
  set(cpu, 4, (a ^ b) >> 16);
  if (negates) set_pair(cpu, 0, negated(cpu, d.quotient));
  return cycles;
}
int remainder(Cpu& cpu, std::int64_t limit) {
  const std::uint32_t a = pair(cpu, 0), b = pair(cpu, 2);
  const Division d = divide(magnitude_of(a), magnitude_of(b));
  const int cycles = d.cycles + 21 + 3 * is_negative(b);
  if (d.cycles == 0 || cycles > limit) return 0;
  leave(cpu, 0, a >> 16);
  leave_return(cpu, 1, cpu.address_of(cpu.at) + 10);
  leave_division(cpu, d);
  set(cpu, 4, a >> 16);
  set_pair(cpu, 0, is_negative(a) ? negated(cpu, d.remainder) : d.remainder);
  return cycles;
}

}  // namespace

const std::vector<KnownRoutine>& long_division_routines() {
  static const std::vector<KnownRoutine> all = {
      {"__divide_long", 0x3ed846e3e46daf80, nullptr, &divide_long},
      {"___udivsi3", 0x3d9964e8a3765533, nullptr, &unsigned_quotient},
      {"___umodsi3", 0xefe4a285ef86e9ce, nullptr, &unsigned_remainder},
      {"___divsi3", 0x5888e942d2a33343, nullptr, &quotient},
      {"___modsi3", 0x96e160b9c1a9666e, nullptr, &remainder},
  };
  return all;
}

}  // namespace dspic
