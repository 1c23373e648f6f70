// SPDX-License-Identifier: MIT
// memcpy() and its kin (firmware/libc/src/string.c): bytes of plain RAM, read from constants in flash as
// well, where each byte costs what the PSV window costs. Registers, the return address and whatever else is
// no memory: it runs.
#include <algorithm>

#include "dspic30/routines/forms.h"
#include "dspic30/routines/known_routines.h"

namespace dspic {

namespace {

using namespace forms;

constexpr int kWindow = 2;  // cycles of a byte through the PSV window
constexpr std::uint16_t kPsvOn = sfr_bits("CORCON", "PSV");

/// Bytes from an address on, which are read one after the other.
class Source {
 public:
  Source(const Cpu& cpu, unsigned address) : cpu_(cpu), address_(address) {
    is_flash_ = address >= Cpu::kPsvStart && (cpu.corcon & kPsvOn);
    // the data EEPROM has times of its own
    const unsigned start = static_cast<unsigned>(cpu.psvpag) << 15;
    if (is_flash_ && start >= kFlashEnd) is_flash_ = false;
  }
  /// -1: none is there, or the window ends.
  int byte(unsigned at) const {
    const unsigned ea = address_ + at;
    if (is_flash_) {
      if (ea > 0xFFFF) return -1;
      const std::uint32_t word = cpu_.program.read(static_cast<unsigned>(cpu_.psvpag) << 15 | (ea & 0x7FFE));
      return static_cast<int>(word >> 8 * (ea & 1) & 0xFF);
    }
    return cpu_.is_elsewhere(ea & 0xFFFF, true) || ea > 0xFFFF ? -1 : cpu_.ram[ea - Cpu::kRamStart];
  }
  bool holds(unsigned bytes) const { return byte(0) >= 0 && byte(bytes - 1) >= 0; }
  int cycles() const { return is_flash_ ? kWindow : 0; }
  bool is_flash() const { return is_flash_; }

 private:
  const Cpu& cpu_;
  unsigned address_;
  bool is_flash_;
};

/// May the routine write there? Not over its own return address.
bool can_be_written(const Cpu& cpu, unsigned address, unsigned bytes) {
  const unsigned last = address + bytes - 1, stack = cpu.w[15];
  return last <= 0xFFFF && !cpu.is_elsewhere(address, true) && !cpu.is_elsewhere(last, true) &&
         (address >= stack || last < stack - 4);
}

int nothing(Cpu& cpu, int cycles) {
  sub(cpu, 0, 0);
  return cycles;
}

// of no bytes two are the same
int equal_as_none(Cpu& cpu) {
  set(cpu, 3, cpu.w[0]);
  set(cpu, 0, 0);
  return nothing(cpu, 8);
}

// the last count came down to 0
void counted_down(Cpu& cpu) {
  set(cpu, 2, 0);
  sub(cpu, 1, 1);
}

int copy_forwards(Cpu& cpu, std::int64_t limit, int fixed) {
  const unsigned to = cpu.w[0], n = cpu.w[2];
  const Source from(cpu, cpu.w[1]);
  const auto cycles = fixed + static_cast<std::int64_t>(5 + from.cycles()) * n;
  if (cycles > limit || !from.holds(n) || !can_be_written(cpu, to, n)) return 0;
  // byte by byte, so that what overlaps comes out as on the chip
  for (unsigned i = 0; i < n; ++i) cpu.ram[to + i - Cpu::kRamStart] = static_cast<std::uint8_t>(from.byte(i));
  set(cpu, 4, cpu.ram[to + n - 1 - Cpu::kRamStart]);
  set(cpu, 1, cpu.w[1] + n);
  set(cpu, 3, to + n);
  counted_down(cpu);
  return static_cast<int>(cycles);
}

int copy_memory(Cpu& cpu, std::int64_t limit) {
  if (cpu.w[2] == 0) return limit < 6 ? 0 : nothing(cpu, 6);
  return copy_forwards(cpu, limit, 5);
}

int move_memory(Cpu& cpu, std::int64_t limit) {
  const unsigned to = cpu.w[0], n = cpu.w[2];
  const bool forwards = to < cpu.w[1];
  if (n == 0) return limit < 9 ? 0 : nothing(cpu, forwards ? 8 : 9);
  if (forwards) return copy_forwards(cpu, limit, 9);
  const Source from(cpu, cpu.w[1]);
  const auto cycles = 10 + static_cast<std::int64_t>(7 + from.cycles()) * n;
  if (cycles > limit || !from.holds(n) || !can_be_written(cpu, to, n)) return 0;
  for (unsigned i = n; i-- > 0;) cpu.ram[to + i - Cpu::kRamStart] = static_cast<std::uint8_t>(from.byte(i));
  set(cpu, 4, cpu.ram[to - Cpu::kRamStart]);
  set(cpu, 1, cpu.w[1] - 1u);
  set(cpu, 3, to - 1);
  counted_down(cpu);
  return static_cast<int>(cycles);
}

int set_memory(Cpu& cpu, std::int64_t limit) {
  const unsigned to = cpu.w[0], n = cpu.w[2];
  if (n == 0) return limit < 6 ? 0 : nothing(cpu, 6);
  const auto cycles = 5 + std::int64_t{4} * n;
  if (cycles > limit || !can_be_written(cpu, to, n)) return 0;
  std::fill_n(&cpu.ram[to - Cpu::kRamStart], n, static_cast<std::uint8_t>(cpu.w[1]));
  set(cpu, 3, to + n);
  counted_down(cpu);
  return static_cast<int>(cycles);
}

int compare_memory(Cpu& cpu, std::int64_t limit) {
  const unsigned n = cpu.w[2];
  if (n == 0) return limit < 8 ? 0 : equal_as_none(cpu);
  const Source a(cpu, cpu.w[0]), b(cpu, cpu.w[1]);
  const int more = a.cycles() + b.cycles();
  std::int64_t cycles = 4;
  for (unsigned i = 0; i < n; ++i, cycles += 9 + more) {
    const int x = a.byte(i), y = b.byte(i);
    if (cycles > limit || x < 0 || y < 0) return 0;
    if (x == y) {
      if (i + 1 < n) continue;
      cycles += 11 + more;
      if (cycles > limit) return 0;
      set(cpu, 1, cpu.w[1] + n);
      set(cpu, 3, cpu.w[0] + n);
      set(cpu, 0, 0);
      counted_down(cpu);
    } else {
      cycles += 9 + more;
      if (cycles > limit) return 0;
      set(cpu, 1, cpu.w[1] + i);
      set(cpu, 2, n - i);
      set(cpu, 3, cpu.w[0] + i);
      set(cpu, 0, sub(cpu, static_cast<unsigned>(x), static_cast<unsigned>(y)));
    }
    set(cpu, 4, static_cast<unsigned>(y));
    set(cpu, 5, static_cast<unsigned>(x));
    break;
  }
  return static_cast<int>(cycles);
}

/// Bytes before the first 0; -1: none within `most`, or no memory.
int length_of(const Source& text, std::int64_t most) {
  for (int n = 0; n <= most; ++n) {
    const int byte = text.byte(static_cast<unsigned>(n));
    if (byte <= 0) return byte < 0 ? -1 : n;
  }
  return -1;
}

int length(Cpu& cpu, std::int64_t limit) {
  const Source text(cpu, cpu.w[0]);
  const int n = length_of(text, limit / 5);
  const int cycles = 9 + 5 * n + text.cycles() * (n + 1);
  if (n < 0 || cycles > limit) return 0;
  set(cpu, 1, cpu.w[0] + static_cast<unsigned>(n) + 1);
  set(cpu, 0, static_cast<unsigned>(n));
  set(cpu, 2, 0);
  return nothing(cpu, cycles);
}

int copy_text(Cpu& cpu, std::int64_t limit) {
  const unsigned to = cpu.w[0];
  const Source from(cpu, cpu.w[1]);
  const int n = length_of(from, limit / 5);
  if (n < 0) return 0;
  const int cycles = 7 + 5 * n + from.cycles() * (n + 1);
  const auto bytes = static_cast<unsigned>(n) + 1;
  // text that is copied into itself goes on longer
  const bool overlaps = !from.is_flash() && to > cpu.w[1] && to < cpu.w[1] + bytes;
  if (cycles > limit || overlaps || !can_be_written(cpu, to, bytes)) return 0;
  for (unsigned i = 0; i < bytes; ++i)
    cpu.ram[to + i - Cpu::kRamStart] = static_cast<std::uint8_t>(from.byte(i));
  if (n == 0) {  // flags of ZE
    set(cpu, 2, 0);
    logic(cpu, 0);
    cpu.c = 1;
    return cycles;
  }
  set(cpu, 1, cpu.w[1] + bytes);
  set(cpu, 2, to + bytes);
  set(cpu, 3, 0);
  return nothing(cpu, cycles);
}

int compare_text(Cpu& cpu, std::int64_t limit) {
  const Source a(cpu, cpu.w[0]), b(cpu, cpu.w[1]);
  const int more = a.cycles() + b.cycles();
  int before = -1;
  std::int64_t cycles = more;
  for (unsigned i = 0;; ++i, cycles += 9 + more) {
    const int x = a.byte(i), y = b.byte(i);
    if (x < 0 || y < 0) return 0;
    if (x == y && x != 0) {
      if (cycles > limit) return 0;
      before = x;
      continue;
    }
    cycles += x != 0 ? 14 : i == 0 ? 11 : 10;
    if (cycles > limit) return 0;
    if (x != 0) before = x;
    if (before >= 0) set(cpu, 4, static_cast<unsigned>(before));
    set(cpu, 1, static_cast<unsigned>(x));
    set(cpu, 2, static_cast<unsigned>(x));
    set(cpu, 3, static_cast<unsigned>(y));
    set(cpu, 0, sub(cpu, static_cast<unsigned>(x), static_cast<unsigned>(y)));
    return static_cast<int>(cycles);
  }
}

int compare_text_within(Cpu& cpu, std::int64_t limit) {
  const unsigned n = cpu.w[2];
  if (n == 0) return limit < 8 ? 0 : equal_as_none(cpu);
  const Source a(cpu, cpu.w[0]), b(cpu, cpu.w[1]);
  const int more = a.cycles() + b.cycles();
  std::int64_t cycles = 4 + more;
  for (unsigned i = 0;; ++i, cycles += 11 + more) {
    const int x = a.byte(i), y = b.byte(i);
    if (cycles > limit || x < 0 || y < 0) return 0;
    const bool is_last = i + 1 == n;
    if (x == y && x != 0 && !is_last) continue;
    cycles += x != y ? 9 : x == 0 ? 10 : 13;
    if (cycles > limit) return 0;
    const unsigned passed = x == y && x != 0 ? n : i;
    set(cpu, 3, cpu.w[0] + passed);
    set(cpu, 1, cpu.w[1] + passed);
    set(cpu, 4, static_cast<unsigned>(x));
    set(cpu, 5, static_cast<unsigned>(y));
    set(cpu, 2, n - passed);
    if (passed == n)
      sub(cpu, 1, 1);
    else
      sub(cpu, static_cast<unsigned>(x), static_cast<unsigned>(y));
    set(cpu, 0, static_cast<unsigned>(x - y));
    return static_cast<int>(cycles);
  }
}

}  // namespace

const std::vector<KnownRoutine>& memory_routines() {
  static const std::vector<KnownRoutine> all = {
      {"_memcpy", 0xb8cc0b730cf62ee6, nullptr, &copy_memory},
      {"_memmove", 0x287511c30100f7cb, nullptr, &move_memory},
      {"_memset", 0xc4c5b8d0b05322d4, nullptr, &set_memory},
      {"_memcmp", 0x123860181c720b90, nullptr, &compare_memory},
      {"_strlen", 0x8f2aa31c73dc0047, nullptr, &length},
      {"_strcpy", 0x45da54b652adc00c, nullptr, &copy_text, true},
      {"_strcmp", 0x638518e71ee101d9, nullptr, &compare_text},
      {"_strncmp", 0x13818694348e5f1f, nullptr, &compare_text_within},
  };
  return all;
}

}  // namespace dspic
