// SPDX-License-Identifier: MIT
// Data space as instructions see it: RAM, the library's registers where a host serves them, the core's and the
// peripherals' registers, the PSV window, the stack; and the traps that accesses lead to.
//
//   instruction --read16(ea)--> plain RAM                   most, at once
//                               HostCalls, CoreRegisters, ChipParts, flash
//
// A stall delays an access by Decoded::lead; what leaves the core sees the true time. Source: [chip C4 to C9].
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>

#include "dspic30/core/code_words.h"
#include "dspic30/core/core_registers.h"
#include "dspic30/core/course_watch.h"
#include "dspic30/core/host_side.h"
#include "dspic30/core/round_notes.h"
#include "dspic30/core/trap_record.h"
#include "dspic30/core/two_clocks.h"
#include "dspic30/device/chip_parts.h"

namespace dspic {

class MemoryCheck;  // memory_check.h

class DataSpace : public CodeWords, public HostSide, public RoundNotes {
 public:
  /// `cpu`: what this is the data space of.
  DataSpace(Cpu& cpu, ChipParts& chip, ProgramMemory& memory, std::shared_ptr<CodeStore> store);

  static constexpr unsigned kRamStart = 0x800, kRamBytes = 0x2000, kRamEnd = kRamStart + kRamBytes,
                            kPsvStart = 0x8000, kYStart = 0x1800;
  static constexpr unsigned kFlashPages = kFlashEnd >> 15;  ///< of the PSV window
  static constexpr std::uint16_t kPsvOn = sfr_bits("CORCON", "PSV");
  /// Reading through the PSV window in the first and last iteration of a REPEAT, and around an interrupt.
  static constexpr Cycle kRepeatWindow = 2;

  // --- accesses; a word at an odd address, and what lies nowhere, is an address error's trap
  unsigned read16(unsigned ea) {
    if (ea - plain_start < plain_ram() && !(ea & 1)) return load(ea - kRamStart);
    if constexpr (kIsTranslated) {
      if (!(ea & 1) && is_flash_constant(ea)) return flash_constant(ea);
      if (is_served(ea) && !(ea & 1)) return read_served(ea, 16);
    }
    return read_elsewhere(ea, 16);
  }
  /// The second word of a pair: through the PSV window it costs nothing.
  unsigned read16_behind(unsigned ea) {
    if constexpr (kIsTranslated)
      if (is_flash_constant(ea) && !(ea & 1)) return flash_word(ea);
    const Window before = window;
    window = Window::Free;
    const unsigned value = read16(ea);
    window = before;
    return value;
  }
  unsigned read8(unsigned ea) {
    if (ea - plain_start < plain_ram()) return ram[ea - kRamStart];
    if constexpr (kIsTranslated) {
      if (is_flash_constant(ea)) return flash_constant(ea) >> 8 * (ea & 1) & 0xFF;
      if (is_served(ea)) return read_served(ea, 8);
    }
    return read_elsewhere(ea, 8);
  }
  void write16(unsigned ea, unsigned value) {
    if (ea - plain_start < plain_ram() && !(ea & 1))
      store(ea - kRamStart, value);
    else
      write_elsewhere(ea, value, 16);
  }
  void write8(unsigned ea, unsigned value) {
    if (ea - plain_start < plain_ram())
      ram[ea - kRamStart] = static_cast<std::uint8_t>(value);
    else
      write_elsewhere(ea, value, 8);
  }
  template <bool Byte>
  unsigned read(unsigned ea) {
    return Byte ? read8(ea) : read16(ea);
  }
  template <bool Byte>
  void write(unsigned ea, unsigned value) {
    Byte ? write8(ea, value) : write16(ea, value);
  }
  /// Is it no RAM, or not to be had as it is?
  bool is_elsewhere(unsigned ea, bool byte) const {
    return ea - plain_start >= plain_ram() || (!byte && (ea & 1));
  }
  /// What stands there becomes (old & keep) ^ flip; as read and write, faster for what handlers change.
  void modify_elsewhere(unsigned ea, unsigned keep, unsigned flip, unsigned bits);
  /// What handlers save and give back: a word that is nobody's affair but the core's, and its bits.
  /// Null: another address.
  struct Saved {
    std::uint16_t CoreFields::*word = nullptr;
    std::uint16_t bits = 0;
  };
  static Saved saved_register(unsigned ea);

  // --- the stack
  void push(unsigned value) {
    const unsigned ea = stack_checked(w[15]);
    w[15] = static_cast<std::uint16_t>(ea + 2);
    write16(ea, value);
  }
  unsigned pop() {
    w[15] = static_cast<std::uint16_t>(w[15] - 2);
    const unsigned ea = stack_checked(w[15]);
    return ea - plain_start < plain_ram() && !(ea & 1) ? load(ea - kRamStart) : read_elsewhere(ea, 16);
  }
  /// A return address: two words, as push() puts them one after the other, and as pop() takes them.
  void push_address(unsigned address) {
    const unsigned ea = w[15];
    if (is_plain_pair(ea)) {
      std::memcpy(&ram[ea - kRamStart], &address, 4);
      w[15] = static_cast<std::uint16_t>(ea + 4);
      return;
    }
    push_slowly(address);
  }
  unsigned pop_address() {
    const auto ea = static_cast<std::uint16_t>(w[15] - 4);
    if (is_plain_pair(ea)) {
      std::uint32_t address;
      std::memcpy(&address, &ram[ea - kRamStart], 4);
      w[15] = ea;
      return address & 0x7FFFFE;
    }
    return pop_slowly();
  }
  /// What a handler known by heart saves: registers, bits W0 to W14, from W0 up, then RCOUNT, PSVPAG, and
  /// others that are nobody's affair, `words` in all. A stack that is full ends it there.
  void push_frame(unsigned registers, int words);
  void pop_frame(unsigned registers, int words);
  /// An address that goes by the stack pointer: beyond the limit it is a stack error's trap.
  unsigned stack_checked(unsigned ea) {
    if constexpr (kIsTranslated) {
      if (ea - plain_start >= plain_ram() || ea > stack_most) check_stack(ea);
    } else if (ea < kRamStart || ea > stack_most) {
      trap(Trap::StackError);
    }
    return ea;
  }

  /// The instruction at `at` does what the chip does not allow: the flag is set, and the trap's handler comes
  /// before the next instruction. An address error is about what it touched.
  void trap(Trap which, std::optional<TrapRecord::Touch> touch = {});
  void trap_at(unsigned address, TrapRecord::Access access, bool is_odd_word = false) {
    trap(Trap::AddressError, TrapRecord::Touch{address, access, is_odd_word});
  }

  // --- time
  /// The true time.
  Cycle true_now() const { return clocks.true_at(now); }
  /// Both clocks agree from here on. Not where straight code goes on: `deadline` is by the clock of before.
  void settle() { clocks.settle(now); }
  /// Time since `from`, by the program's clock, only passed.
  void note_delay(Cycle from) {
    delayed += now - from;
    if (course && !in_wait && now > from) course->waited(clocks.true_at(from), true_now());
  }

  // --- who looks on
  /// Plain RAM begins here; what is below is served by the host.
  void serve_ram(unsigned plain_from) { plain_start = plain_from, watch_round(round_memory); }
  /// Accesses to RAM are noted from now on; null: no longer.
  void watch_round(RoundMemory* memory) {
    round_memory = memory;
    watching = memory != nullptr;
    plain_bytes_ = memory || memory_check ? 0 : kRamEnd - plain_start;
  }
  /// RAM is looked after from now on, before anything has run: each instruction is interpreted. Nothing but
  /// the PC's time depends on it.
  void check_memory(MemoryCheck* check);

  CourseWatch* course = nullptr;        ///< null: nobody
  MemoryCheck* memory_check = nullptr;  ///< null: nobody looks after RAM
  TwoClocks clocks;
  Cycle delayed = 0;     ///< cycles spent in repeated NOPs, and in functions of the host that wait
  bool in_wait = false;  ///< it is told as a whole
  unsigned plain_start = kRamStart;  ///< serve_ram()
  ChipParts& parts;

 private:
  /// Bytes of RAM that are accessed without further ado: none while somebody notes it.
  unsigned plain_ram() const {
#ifdef DSPIC_TRANSLATED
    return kRamEnd - plain_start;
#else
    return plain_bytes_;
#endif
  }
  unsigned load(unsigned i) const {
    std::uint16_t value;
    std::memcpy(&value, &ram[i], 2);
    return value;
  }
  void store(unsigned i, unsigned value) {
    const auto word = static_cast<std::uint16_t>(value);
    std::memcpy(&ram[i], &word, 2);
  }
  /// In translated code, of which none is repeated: a word of the flash through the PSV window, and what that
  /// costs (Decoded::psv; the translator knows it).
  bool is_flash_constant(unsigned ea) const { return ea >= kPsvStart && window_words; }
  unsigned flash_constant(unsigned ea) {
    now += psv_cost();
    return flash_word(ea);
  }
  unsigned flash_word(unsigned ea) const { return window_words[(ea & 0x7FFE) >> 1] & 0xFFFF; }
  static int psv_cost();
  /// Does whoever plays the library hold it?
  bool is_served(unsigned ea) const { return ea - kRamStart < plain_start - kRamStart; }
  /// What it holds there by now: nothing else comes of the look, so translated code goes on behind it.
  unsigned read_served(unsigned ea, unsigned bits);
  unsigned read_served(unsigned ea, unsigned bits, Cycle t);
  unsigned read_elsewhere(unsigned ea, unsigned bits);
  __attribute__((noinline)) unsigned read_other(unsigned ea, unsigned bits, Cycle t);
  void write_elsewhere(unsigned ea, unsigned value, unsigned bits);
  __attribute__((noinline)) void write_other(unsigned ea, unsigned value, unsigned bits);
  unsigned read_psv(unsigned ea, unsigned bits);
  /// Is it RAM that somebody looks after, and nobody notes?
  bool is_checked(unsigned ea, unsigned bits) const {
    return ea - plain_start < kRamEnd - plain_start && memory_check && !watching && !(bits == 16 && (ea & 1));
  }
  bool is_plain_pair(unsigned ea) const {
    const unsigned bytes = plain_ram();
    return bytes >= 4 && ea - plain_start <= bytes - 4 && !(ea & 1) && ea + 2 <= stack_most;
  }
  bool is_plain_frame(unsigned begin, unsigned words) const;
  __attribute__((noinline)) void push_slowly(unsigned address);
  __attribute__((noinline)) unsigned pop_slowly();
  __attribute__((noinline)) void check_stack(unsigned ea);
  /// The deadline is no later than `when`, which is true time.
  void hurry_to(Cycle when) {
    deadline = std::min(deadline, clocks.program_at(when));
    stop_at = std::min(stop_at, when);
    soonest = std::min(soonest, when);
  }

  const Cpu& whole() const;

  unsigned plain_bytes_ = kRamBytes;  // 0 while accesses are noted
  CoreRegisters registers_;

 public:
  /// What led to the last trap that was told (Cause::CpuTrap), through all resets. Of a stack error, the
  /// instruction that went beyond the limit, also where that was beyond RAM and so an address error as well. A
  /// store to a frame beyond RAM is an address error with the stack pointer above the limit.
  std::optional<TrapRecord> latest_trap;
  std::array<std::uint8_t, kRamBytes> ram{};
};

}  // namespace dspic
