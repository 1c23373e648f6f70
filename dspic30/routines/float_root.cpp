// SPDX-License-Identifier: MIT
// Square root (tp_m_sqrtf() of hal_dspic/runtime/math_functions.c): 25 digits, one a round, of which those
// that are 1 take a cycle more. Of numbers above 0 with a hidden bit; others run.
#include <cmath>

#include "dspic30/routines/float_parts.h"
#include "dspic30/routines/known_routines.h"

namespace dspic {

namespace {

using namespace float_parts;

constexpr unsigned kBehindLastCall = 0x46;  // of the last comparison
constexpr int kFixed = 906, kOddExponent = 4;

int square_root(Cpu& cpu, std::int64_t limit, unsigned place, int cycles) {
  const std::uint32_t x = pair(cpu, 0);
  if (!is_normal(x) || (x & kSign)) return 0;
  const int exponent = exponent_of(x) - kBias, odd = exponent & 1;
  // 50 bits of argument give 25 of root; exact, for a double holds both
  const std::uint64_t argument = std::uint64_t{fraction_of(x)} << (25 + odd);
  const auto root = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(argument)));
  cycles += kFixed + odd * kOddExponent + __builtin_popcount(root);
  if (cycles > limit) return 0;
  leave_registers(cpu, 0, 8, 5);
  leave_return(cpu, 5, place + kBehindLastCall);
  const std::uint32_t rounded_root = (root >> 1) + (root & 1);
  const unsigned half = static_cast<unsigned>((exponent - odd) / 2) << kFraction % 16 & 0xFFFF;
  set(cpu, 0, rounded_root);
  set(cpu, 1, add(cpu, (half + (rounded_root >> 16)) & 0xFFFF, 0x3F00));
  set(cpu, 2, 0xFF80);
  set(cpu, 3, root >> 17);
  set(cpu, 4, static_cast<unsigned>((argument - std::uint64_t{root} * root) >> 16));
  set(cpu, 5, root);
  set(cpu, 6, 0);
  set(cpu, 7, root >> 16);
  return cycles;
}

int root(Cpu& cpu, std::int64_t limit) { return square_root(cpu, limit, cpu.address_of(cpu.at), 0); }
int called_root(Cpu& cpu, std::int64_t limit) {
  return square_root(cpu, limit, target(cpu, cpu.address_of(cpu.at)), 2);
}

}  // namespace

const std::vector<KnownRoutine>& float_root_routines() {
  static const std::vector<KnownRoutine> all = {
      {"_tp_m_sqrtf", 0xbbca720984c6a9fc, nullptr, &root},
      {"_sqrtf", 0xdfb4044c071c9395, nullptr, &called_root},
      {"_sqrt", 0xdfb4044c071c9395, nullptr, &called_root},
  };
  return all;
}

}  // namespace dspic
