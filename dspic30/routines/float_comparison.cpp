// SPDX-License-Identifier: MIT
// Comparisons of floats: order() and its callers in hal_dspic/runtime/float_format.h.
#include "dspic30/routines/float_parts.h"
#include "dspic30/routines/known_routines.h"

namespace dspic {

namespace {

using namespace float_parts;

constexpr int kEntry = 3, kExit = 4;  // what it gives for not-a-number, and the way to order(); the result
constexpr unsigned kSmaller = 0xFFFF;

// at order()'s last step the operands are in place and flags are as they have fallen out so far
int ordered(Cpu& cpu, unsigned result, int cycles) {
  set(cpu, 0, result);
  set(cpu, 4, result);
  return cycles;
}

int order(Cpu& cpu, std::int64_t limit, unsigned unordered) {
  constexpr int kLongest = 50;
  if (limit < kLongest) return 0;
  const std::uint32_t a = pair(cpu, 0), b = pair(cpu, 2);
  const std::uint32_t x = magnitude(a), y = magnitude(b);
  set(cpu, 5, x >> 16);
  set(cpu, 7, kInfinity >> 16);
  // NaN on one side: there is no order.
  if (x > kInfinity) {
    sub_pair(cpu, x, kInfinity);
    return ordered(cpu, unordered, kEntry + 7 + kExit);
  }
  set(cpu, 6, y >> 16);
  if (y > kInfinity) {
    sub_pair(cpu, y, kInfinity);
    return ordered(cpu, unordered, kEntry + 12 + kExit);
  }
  // Both may be zero, of any sign, or the same.
  int cycles = kEntry + 13;
  if (x) {
    cycles += 2;
  } else if (y) {
    cycles += 4;
  } else {
    sub_pair(cpu, 0, 0);
    return ordered(cpu, 0, cycles + 5 + kExit + 1);
  }
  if (a == b) {
    sub_pair(cpu, a, b);
    return ordered(cpu, 0, cycles + 5 + kExit);
  }
  sub_pair(cpu, a, b);
  // Unlike signs tell it; of like signs the larger magnitude counts, in its direction.
  if ((a ^ b) & kSign) {
    const bool is_less = a & kSign;
    sub(cpu, a >> 16, 0);
    return ordered(cpu, is_less ? kSmaller : 1, cycles + 9 + (is_less ? 3 : 1) + kExit);
  }
  const unsigned is_less = a < b, is_positive = ~a >> 31;
  sub(cpu, is_positive, is_less);
  set(cpu, 1, is_positive);
  return ordered(cpu, is_less == is_positive ? kSmaller : 1,
                 cycles + 16 + (is_less == is_positive ? 2 : 4) + kExit);
}

int order_or_more(Cpu& cpu, std::int64_t limit) { return order(cpu, limit, 1); }
int order_or_less(Cpu& cpu, std::int64_t limit) { return order(cpu, limit, kSmaller); }

int is_unordered(Cpu& cpu, std::int64_t limit) {
  constexpr int kLongest = 20;
  if (limit < kLongest) return 0;
  const std::uint32_t x = magnitude(pair(cpu, 0)), y = magnitude(pair(cpu, 2));
  set(cpu, 4, x);
  set_pair(cpu, 0, (x & 0xFFFF0000u) | 1);
  set(cpu, 5, kInfinity >> 16);
  if (x > kInfinity) {
    sub_pair(cpu, x, kInfinity);
    return 11;
  }
  set(cpu, 3, y >> 16);
  sub_pair(cpu, y, kInfinity);
  set(cpu, 0, y > kInfinity);
  logic(cpu, cpu.w[0]);
  return 17;
}

}  // namespace

const std::vector<KnownRoutine>& float_comparison_routines() {
  static const std::vector<KnownRoutine> all = {
      {"___eqsf2", 0x3adab7cde0d752c0, nullptr, &order_or_more},
      {"___nesf2", 0x3adab7cde0d752c0, nullptr, &order_or_more},
      {"___ltsf2", 0x3adab7cde0d752c0, nullptr, &order_or_more},
      {"___lesf2", 0x3adab7cde0d752c0, nullptr, &order_or_more},
      {"___gtsf2", 0xa95316fb586be5e0, nullptr, &order_or_less},
      {"___gesf2", 0xa95316fb586be5e0, nullptr, &order_or_less},
      {"___unordsf2", 0xad115d546c3a5be1, nullptr, &is_unordered},
  };
  return all;
}

}  // namespace dspic
