// SPDX-License-Identifier: MIT
// Longs as floats and floats as longs: from_unsigned() and to_unsigned() of hal_dspic/runtime/float_format.h
// and their callers. Parts lie where the linker has put them, so places are read from the branches.
#include "dspic30/routines/float_parts.h"
#include "dspic30/routines/known_routines.h"

namespace dspic {

namespace {

using namespace float_parts;

unsigned entry(const Cpu& cpu) { return cpu.address_of(cpu.at); }

// --- packed(): rounds m, whose leading bit is at 26, and puts exponent and sign to it

int cycles_of_packing(std::uint32_t m) {
  const unsigned rest = m & 7;
  return 22 + (rest == 4 ? 5 + (m >> 3 & 1) : 0);
}
void pack(Cpu& cpu, std::uint32_t sign, int e, std::uint32_t m) {
  const unsigned rest = m & 7;
  const std::uint32_t cut = (m >> 3) + (rest > 4 || (rest == 4 && (m >> 3 & 1)));
  const unsigned upper = (static_cast<unsigned>(e) << 7) + (cut >> 16);
  set_pair(cpu, 4, rest == 4 ? m & 8 : m);
  set(cpu, 7, rest);
  set(cpu, 6, cut);
  set(cpu, 3, cut >> 16);
  set(cpu, 2, sub(cpu, upper & 0xFFFF, 0x80));
  set_pair(cpu, 0, sign | ((upper - 0x80) << 16 & ~kSign) | (cut & 0xFFFF));
  logic(cpu, cpu.w[1]);
}

// --- from_unsigned()

// words above W15: behind W14 and four locals, behind W8 to W13, behind a return address
constexpr unsigned kSavedAt = 5, kReturnAt = 11, kShiftAt = 13;
constexpr unsigned kBehindPacking = 0xEC, kBehindPackingLarge = 0xDA, kBehindPackingLargest = 0x13E;
constexpr int kWorked = kFraction + 3;  // leading bit of what packed() rounds
constexpr int kShifts = 99;             // a shift down, and another to see what it lost

int from_unsigned(Cpu& cpu, std::int64_t limit, std::uint32_t v, std::uint32_t sign, unsigned place,
                  int cycles) {
  if (v == 0) {
    cycles += 37;
    if (cycles > limit) return 0;
    set_four(cpu, 0, 0);
    set_four(cpu, 4, 0);
    sub_pair(cpu, 0, 0);
    cpu.set_z(false);
  } else {
    const int leading = 31 - __builtin_clz(v), down = leading - kWorked;
    const std::uint32_t cut = down > 0 ? v >> down : v << -down;
    const std::uint32_t m = cut | (down > 0 && (v & ((1u << down) - 1)) != 0);
    cycles += 37 + cycles_of_packing(m);
    if (leading <= kFraction)
      cycles += 30 + 11 * (kFraction - leading);
    else
      cycles += 45 + 26 * (leading - kFraction) + (down > 0 ? kShifts : 0);
    if (cycles > limit) return 0;
    if (leading > kFraction) leave(cpu, 1, 0);
    if (down > 0) {
      leave(cpu, 2, sign >> 16);
      leave(cpu, 3, cut >> 16);
      leave(cpu, 4, cut & 0xFFFF);
      leave(cpu, kShiftAt, static_cast<unsigned>(down));
    }
    leave_return(cpu, kReturnAt,
                 place + (down > 0              ? kBehindPackingLargest
                          : leading > kFraction ? kBehindPackingLarge
                                                : kBehindPacking));
    pack(cpu, sign, kBias + leading, m);
  }
  leave(cpu, 0, cpu.w[14]);
  leave_registers(cpu, kSavedAt, 8, 6);
  return cycles;
}

int from_long(Cpu& cpu, std::int64_t limit) {
  const std::uint32_t x = pair(cpu, 0), sign = x & kSign;
  return from_unsigned(cpu, limit, sign ? 0 - x : x, sign, target(cpu, entry(cpu) + 0x18), 13);
}
int from_unsigned_long(Cpu& cpu, std::int64_t limit) {
  return from_unsigned(cpu, limit, pair(cpu, 0), 0, target(cpu, entry(cpu) + 8), 6);
}

// --- to_unsigned() and to_signed()

constexpr unsigned kBehindRight = 0x4E, kBehindLeft = 0x5A;    // its calls of shifts
constexpr int kShift = 36, kShiftByNone = 11, kShiftFar = 20;  // cycles of these

// what shifting the fraction, which lies in W1:W0, leaves in W7; more than 31 leaves it alone
unsigned rest_of_shift(unsigned w1, int left) {
  if (left <= 0 || left > 16) return 0;
  return w1 >> (16 - left);
}

/// `base`: words on the stack below what it saves.
int to_unsigned(Cpu& cpu, std::int64_t limit, std::uint32_t a, std::uint32_t most, unsigned place,
                unsigned base, int cycles) {
  const int e = exponent_of(a);
  std::uint32_t result = most;
  cycles += 13 + 11;
  const auto save = [&] {
    leave_registers(cpu, base, 8, 4);
    set_four(cpu, 4, static_cast<unsigned>(e) | (std::uint64_t{most} & 0xFFFF0000u));
  };
  if (e < kBias) {
    cycles += 7;
    if (cycles > limit) return 0;
    save();
    result = 0;
    sub(cpu, static_cast<unsigned>(e), kBias);
  } else if (magnitude(a) > kInfinity) {
    cycles += 12;
    if (cycles > limit) return 0;
    save();
    result = 0;
    sub_pair(cpu, magnitude(a), kInfinity);
  } else if (e >= kBias + 64) {
    cycles += 11;
    if (cycles > limit) return 0;
    save();
    sub(cpu, static_cast<unsigned>(e), kBias + 63);
  } else {
    const int left = e - kBias - kFraction;
    const bool is_far = e >= kBias + 32;  // beyond 32 bits
    const std::uint32_t fraction = fraction_of(a);
    const std::uint32_t v = is_far ? 0 : left < 0 ? fraction >> -left : fraction << left;
    const auto all = static_cast<std::uint64_t>(fraction) << (left > 0 ? left : 0);
    const bool is_more = left > 0 ? static_cast<std::uint32_t>(all) > most : v > most;  // of the lower half
    cycles += 14 + (left > 0 ? 8 : 9);
    cycles += left == 0 ? kShiftByNone : left > 31 ? kShiftFar : kShift;
    cycles += 4 + 2 + 3 + 2 + 2 + (is_far ? 8 : is_more ? 9 : 12);
    if (cycles > limit) return 0;
    leave_registers(cpu, base, 8, 4);
    leave_return(cpu, base + 4, place + (left > 0 ? kBehindLeft : kBehindRight));
    leave(cpu, base + 6, most & 0xFFFF);
    if (!is_far && !is_more) result = v;
    set(cpu, 4, is_far);
    set(cpu, 5, is_far || is_more);
    set(cpu, 6, !is_far);
    set(cpu, 7, rest_of_shift(fraction >> 16, left));
    sub(cpu, cpu.w[6], 0);
    cpu.set_z(!cpu.w[5]);
  }
  set_four(cpu, 0, result);
  return cycles;
}

constexpr unsigned kBehindUnsigned = 0x10;

int to_signed(Cpu& cpu, std::int64_t limit, std::uint32_t a, unsigned place, int cycles) {
  const unsigned of_unsigned = target(cpu, place + 4);
  if (!(a & kSign)) return to_unsigned(cpu, limit, a, 0x7FFFFFFF, of_unsigned, 0, cycles + 4);
  cycles = to_unsigned(cpu, limit - 7, a, 0x80000000u, of_unsigned, 2, cycles + 9);
  if (cycles == 0) return 0;
  leave_return(cpu, 0, place + kBehindUnsigned);
  set(cpu, 0, sub(cpu, 0, cpu.w[0]));
  for (unsigned n = 1; n < 4; ++n) set(cpu, n, subb(cpu, 0, cpu.w[n]));
  return cycles + 7;
}

int to_long(Cpu& cpu, std::int64_t limit) {
  return to_signed(cpu, limit, pair(cpu, 0), target(cpu, entry(cpu) + 8), 6);
}
int to_unsigned_long(Cpu& cpu, std::int64_t limit) {
  const std::uint32_t a = pair(cpu, 0);
  if (a & kSign) return to_signed(cpu, limit, a, target(cpu, entry(cpu) + 0x14), 9);
  return to_unsigned(cpu, limit, a, 0xFFFFFFFFu, target(cpu, entry(cpu) + 0xC), 0, 8);
}

}  // namespace

const std::vector<KnownRoutine>& float_conversion_routines() {
  static const std::vector<KnownRoutine> all = {
      {"___floatsisf", 0x15b63e4584d094e4, nullptr, &from_long},
      {"___floatunsisf", 0xda0dd667fd1863ca, nullptr, &from_unsigned_long},
      {"___fixsfsi", 0xe789722deaa67f31, nullptr, &to_long},
      {"___fixunssfsi", 0x36280420f35b99da, nullptr, &to_unsigned_long},
  };
  return all;
}

}  // namespace dspic
