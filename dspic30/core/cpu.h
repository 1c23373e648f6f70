// SPDX-License-Identifier: MIT
// The processor's state, as its instructions see it; Processor (processor.h) is the front door.
//
//   flash word --decode once--> Decoded {run, registers, literal, cycles} --run(cpu, decoded)--> next Decoded
//                                  in a CodeTable (code_store.h), which robots with the same image share
//
// In layers: CoreFields (W, flags), CodeWords (what it runs on), DataSpace (RAM, registers, stack, traps), and
// here the program's course. Beside them: CoreRegisters (0x000 to 0x052), pointers.h, host_handlers.h.
//
// Time: `now` is the cycle in which an instruction begins, by the program's clock (two_clocks.h); a stall
// delays its accesses by `lead`. Straight code runs until `deadline`, the next instant at which anything else
// may happen, by the same clock; whatever changes that instant lowers it. What leaves the core sees the true
// time. Stalls are found when a word is decoded. Flags are kept as they fall out of an operation and put
// together when SR is read.
//
// Modelled: see docs/dev/chip.md. Source: [chip C2] to [chip C16].
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>

#include "dspic30/core/counting.h"
#include "dspic30/core/data_space.h"
#include "dspic30/core/host_place.h"
#include "dspic30/core/instruction_table.h"
#include "dspic30/core/known_waits.h"
#include "dspic30/core/semantics.h"
#include "dspic30/core/wait_heads.h"
#include "dspic30/memory/host_places.h"

namespace dspic {

class Cpu final : public DataSpace {
 public:
  /// `store`: of the image that `memory` holds; null: its own.
  Cpu(ChipParts& chip, ProgramMemory& memory, std::shared_ptr<CodeStore> store);
  void reset();
  /// Moves to the code that goes with its flash, the registers that were written, and special pointers.
  void choose_code();

  // --- where the program goes
  /// The instruction at a program address that the course jumps to.
  const Decoded* jump(unsigned address, const Decoded* from);
  const Decoded* arrive(const Decoded* target) {
    if (!is_decoded(target)) decode(target);
    now -= target->lead;
    count_jump(target);
    return target;
  }
  DSPIC_JUMP const Decoded* offset(const Decoded* from, std::int32_t words) {
    const std::ptrdiff_t index = from - code_ + words;
    return index > 0 && index < static_cast<std::ptrdiff_t>(kFlashWords)
               ? arrive(code_ + index)
               : jump(pointed(static_cast<unsigned>(2 * index) & 0x7FFFFE, from), from);
  }
  /// Back to where an interrupt cut the program: as jump(), but nothing begins there.
  const Decoded* jump_back(unsigned address, const Decoded* from);
  /// A call of the function at a program address, with the one that it returns to; and a return.
  DSPIC_JUMP const Decoded* call_to(unsigned address, const Decoded* from, [[maybe_unused]] unsigned back) {
    return jump(address, from);
  }
  DSPIC_JUMP const Decoded* return_to(unsigned address, const Decoded* from) {
    return jump(pointed(address, from), from);
  }
  /// ... of the instruction at `at`, out of translated code.
  static const Decoded* return_from(Cpu& cpu, const Decoded*, unsigned address) {
    return cpu.return_to(address, cpu.at);
  }
  static const Decoded* arrive_from(Cpu& cpu, const Decoded* from, std::int32_t words) {
    return cpu.offset(from, words);
  }
  /// Straight on to a place that counts as one that is jumped to: translated code ended before it.
  static const Decoded* go_on(Cpu& cpu, const Decoded* from, std::int32_t words) {
    const Decoded* const d = from + words;
    if (is_decoded(d)) cpu.count_jump(d);
    return d;
  }
  /// Where a call, jump or return at `from` leads. Address 0 is told.
  unsigned pointed(unsigned address, const Decoded* from) {
    if (address == 0) tell_null_pointer(address_of(from));
    return address;
  }

  // --- running
  /// This one instruction alone, with its own function: not the translated code that begins there.
  static const Decoded* run_alone(Cpu& cpu, const Decoded* d) {
    if (cpu.looks_at_each_) return cpu.looked_at(d, true)(cpu, d);
    if (!is_decoded(d)) cpu.decode(d);
    return cpu.table().plain(d)(cpu, d);
  }
  /// ... and the onlooker hears of it.
  static const Decoded* run_one(Cpu& cpu, const Decoded* d) {
    if (!cpu.looks_at_each_ && !address_of_host_place(d) && is_decoded(d) && cpu.table().tells(d) &&
        !cpu.table().known_at(cpu.address_of(d)))
      hear(cpu, d);
    return run_alone(cpu, d);
  }
  /// Runs up to `deadline` as long as not all registers are written, when each instruction
  /// has to be looked at.
  void run_each();
  /// Up to `deadline`, as straight as code goes.
  void run_straight() {
    const Decoded* d = next;
    while (now < deadline) {
      at = d;
      const Decoded* following = d->run.load(std::memory_order_acquire)(*this, d);
      now += d->cycles;
      if (d == loop_end) following = loop_back(d, following);
      d = following;
    }
    next = d;
  }

  // --- loops
  void begin_do(unsigned count, const Decoded* first, const Decoded* last);
  const Decoded* loop_back(const Decoded* last, const Decoded* next);
  /// `loop` was changed.
  void find_loop_end();
  /// Iterations up to the last one or to `deadline`; then d itself is next.
  const Decoded* run_repeated(const Decoded* d);

  // --- status
  unsigned sr() const;
  unsigned sr_low() const;
  void set_sr(unsigned value, unsigned lanes);
  void set_flags(unsigned sr_low_bits);  ///< C Z OV N

  // --- waits (waits.h)
  /// A wait was proven that begins here: from now on the program stops there to look, if `heads` says so.
  void mark_head(const Decoded* first);
  /// ... and all that is known of waits: of other code, or behind a reset.
  void forget_waits();
  /// The program comes to a head: does it stop?
  bool stops_at(const Decoded* head);
  /// Where waits of this program begin.
  WaitHeads heads;
  KnownWaits known_waits;
  KnownCounts known_counts;

  std::array<std::uint16_t, 4> modulo{};  ///< XMODSRT, XMODEND, YMODSRT, YMODEND
  struct Loop {
    unsigned count = 0, start = 0, end = 0;
  } loop, outer_loop;
  int loop_depth = 0;  ///< DL
  std::array<std::int64_t, 2> acc{};
  struct {
    std::array<std::uint16_t, 4> w{};
    unsigned flags = 0;  // SR<8>, SR<3:0>
  } shadow;
  /// The host hears which handlers known by heart the program holds off by now.
  std::function<void()> follow_host;

 private:
  void run_checked();
  /// The function of this one instruction for this robot, whose registers count as written by it. `is_alone`: not the
  /// translated code that begins there.
  Run looked_at(const Decoded* d, bool is_alone);
  void count_jump(const Decoded* target) {
    const std::uint8_t left = target->heat.load(std::memory_order_relaxed);
    if (left > 1)
      target->heat.store(static_cast<std::uint8_t>(left - 1), std::memory_order_relaxed);
    else if (left == 1)
      warm(target);
  }
  __attribute__((noinline)) void warm(const Decoded* target);
  __attribute__((noinline)) void tell_null_pointer(unsigned from);
  void run_on(std::shared_ptr<CodeTable> table);
};

#ifdef DSPIC_TRANSLATED
/// All files meet the types in one order, or else their bitcode has types of its own for each.
__attribute__((used)) static void meet_types(Cpu&) {}
#endif

}  // namespace dspic
