// SPDX-License-Identifier: MIT
// The processor of the dsPIC30F6014A: runs the program in flash, cycle by cycle, on the chip's peripherals.
//
//   ProgramMemory --words--> Processor --registers, traps--> Dspic30f6014a
//                            run(until) <--interrupts, resets--
//
// Deterministic: cycles depend on the program and the chip alone, not on how run() is called.
// What is modelled and what is doubted: docs/dev/chip.md.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dspic30/device/dspic30f6014a.h"
#include "dspic30/memory/program_memory.h"

namespace dspic {

class CodeStore;  // code_store.h
class CourseWatch;
class Cpu;
class HostCalls;
class KnownCalls;   // known_calls.h
class MemoryCheck;  // memory_check.h
class ProgramWatch;
class Translator;
class Waits;

class Processor {
 public:
  /// `chip` and `program`, which is the chip's Configuration::program, outlive this, and so does `host`:
  /// whoever plays the library's drivers, and serves RAM below `plain_from`; null: nobody. `code`: of the
  /// image that `program` holds, shared by all that run it, threads included; null: its own.
  Processor(Dspic30f6014a& chip, ProgramMemory& program, std::shared_ptr<CodeStore> code = nullptr,
            HostCalls* host = nullptr, unsigned plain_from = kRamStart);
  ~Processor();

  /// Runs until the cycle `until`, or a few more: instructions are whole. A reset ends it earlier: its kind
  /// is returned, the caller resets the chip and calls restart().
  std::optional<ResetKind> run(Cycle until);
  /// As after a reset: PC = 0; RAM stays.
  void restart();
  /// As in the constructor: RAM is empty, and its first instruction comes at `at`. Behind restart(), before
  /// anything has run; not before the end of the last window.
  void power_up(Cycle at);

  Cycle now() const;
  /// Time passes without the processor, which stands still: before it was switched on, in a reset.
  void wait_until(Cycle at);
  bool is_asleep() const;
  /// Cycles of the program so far: now() without the share of handlers known by heart.
  Cycle own_cycles() const;
  /// Cycles of the program up to `at` in which it only waited: in Idle and Sleep, in waits (waits.h), in
  /// repeated NOPs, in functions of the host that wait. Exact, and the same however run() is called. `at` may
  /// be ahead of now() up to idle_until().
  Cycle idle(Cycle at) const;
  /// Until when nothing happens but that time passes, so that run() need not be called; in the past: the
  /// program is at work.
  Cycle idle_until() const;
  /// Since when the program has been in a wait, or asleep, as CourseWatch will hear of it; kNever: it is not.
  Cycle waiting_since() const;
  /// Something from outside, or a debugger, may have changed what the program waits for.
  void stir();
  /// Hot code runs translated from now on; null: no more is translated. Nothing but the PC's
  /// time depends on it.
  void set_translator(Translator* translator);
  /// Whoever hears of traps, null pointers, and of the beginning of the functions at `addresses`; it outlives
  /// this. Asked again, of these as well. Nothing but the PC's time depends on it.
  void tell_calls(ProgramWatch* watch, std::vector<std::uint32_t> addresses);
  /// Whoever hears of handlers and waits from now on; null: nobody. Outlives this, or is taken away. Nothing
  /// but the PC's time depends on it.
  void tell_course(CourseWatch* watch);
  /// Routines of the program that are answered by heart from now on; null: none. Nothing but the PC's time
  /// depends on it.
  void know(std::shared_ptr<const KnownCalls> calls);
  /// Whoever looks after RAM, before anything has run; it outlives this. Then all is interpreted. Nothing but
  /// the PC's time depends on it.
  void check_memory(MemoryCheck* check);
  /// The core, for MemoryCheck, reports and tests.
  const Cpu& cpu() const { return *cpu_; }
  /// Translates whatever is jumped to, at once: for tests.
  void translate_all();
  /// The loop in which it is and nothing that it reads can change unless an interrupt comes; or a sleep that
  /// nothing ends, neither the watchdog nor an interrupt that is enabled.
  struct Still {
    Cycle since = kNever;       ///< kNever: it is in none. Depends, by some looks, on how run() is called
    bool reads = false;         ///< a round looks at something; else it is no wait, but the end of a program
    std::uint64_t enabled = 0;  ///< of a sleep: sources that are enabled, but stand, a bit each
  };
  Still still() const;

  // --- for debuggers, tests and reports: no side effects
  unsigned pc() const;
  /// Of the instruction that runs, or ran last.
  unsigned pc_of_access() const;
  std::uint16_t w(int n) const;
  std::uint16_t sr() const;
  std::uint8_t ram(unsigned address) const;  ///< 0x800 to 0x27FF
  static constexpr unsigned kRamStart = 0x800, kRamEnd = 0x2800;
  static constexpr std::size_t kRamBytes = kRamEnd - kRamStart;
  const std::uint8_t* ram() const;  ///< all of it
  void set_ram(unsigned address, std::uint8_t value);
  void fill_ram(const std::array<std::uint8_t, kRamBytes>& bytes);  ///< set_ram() of all of it
  void set_w(int n, std::uint16_t value);
  std::uint64_t state_hash() const;

 private:
  void enter_interrupt(int vector);
  void execute();
  bool rests(Cycle until);
  void sleep(Cycle until);
  Cycle wakes_at() const;
  bool follow_host(int vector);
  void follow_entry();
  unsigned handlers(int next_vector) const;
  bool follow_changed_handlers(unsigned state, int next_vector);
  bool is_held(std::size_t handler) const { return (held_ >> handler & 1) != 0; }
  bool raise_held(std::size_t handler);
  Cycle source_event(std::size_t handler, Cycle after) const;
  bool note_hold(std::size_t handler, bool by_program);
  void lose_until_cleared();
  void count_missed(std::size_t handler);
  bool is_host_first(int vector) const;
  void begin_handler();
  void serve_pending(int vector);
  Cycle host_horizon() const;
  Cycle disi_horizon() const;

  std::unique_ptr<Cpu> cpu_;
  std::unique_ptr<Waits> waits_;
  Dspic30f6014a& chip_;
  Cycle rest_until_ = 0;  // it waits, and up to then nothing else will happen; 0: who knows
  Cycle slept_ = 0, asleep_since_ = kNever;
  /// A handler known by heart.
  struct ByHeart {
    Cycle source = kNever;  // when the source of a held one sets the flag next
    Cycle missed_at = 0;  // ... found it set; what comes later is counted when the flag falls. 0: it did not
    bool held_by_program = true;    // or it is asleep
    bool is_held_by_other = false;  // ... it is one known by heart that does
    Cycle held_since = kNever;      // ... kNever: never let in so far, or its own handler does
    Cycle held_at = 0;              // when another one let it in last
    Cycle one_by_one_until = 0;     // it was held off for long: each time it comes is an event; 0: it was not
  };
  std::array<ByHeart, 2> by_heart_;
  std::array<int, 2> irqs_{-1, -1};  // theirs; -1: there is none
  static constexpr unsigned kFlagsAt = 2, kByProgramAt = 4, kUnseen = ~0u;
  unsigned held_ = 3;        // handlers that the program holds off, or it is asleep, a bit each
  unsigned seen_ = kUnseen;  // handlers() when follow_host() looked last
};

}  // namespace dspic
