// SPDX-License-Identifier: MIT
// Interrupt controller: IFS, IEC, IPC, INTCON1, INTCON2, INTTREG, DISICNT and the CPU's level.
//
//   flag --+-- IEC --+-- IPC > CPU level --+-- not held by DISI --> pending()
//
// Modelled: priorities 0 to 7, natural order among equals, nesting, NSTDIS, DISI (holds 1 to 6), traps 11 to
// 14 with their flags, hard-trap conflict, alternate vector table, acceptance one cycle after the flag, one
// instruction between RETFIE and the next acceptance, a flag set by hardware between the read and the write
// of one read-modify-write survives. Not modelled: INTTREG.VHOLD, IRQTOCPU and TMODE. The causes of
// traps are the core's. Source: [chip C11].
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "dspic30/memory/sfr_bus.h"
#include "dspic30/periph/cpu_level.h"
#include "dspic30/periph/interrupt_control.h"
#include "dspic30/periph/interrupt_sources.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

class Interrupts final : public SfrOwner {
 public:
  explicit Interrupts(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}
  void attach(SfrBus& bus);
  void reset(Cycle now);

  const InterruptSources& sources() const { return sources_; }
  const InterruptControl& control() const { return control_; }
  const CpuLevel& cpu() const { return cpu_; }
  InterruptTally& tally() { return tally_; }
  FlagListeners& listeners() { return listeners_; }

  // --- for peripherals
  /// The flag is set at `at`. `is_event`: one raise stands for one event, so that a second one is a loss.
  void raise(int irq, Cycle at, bool is_event = true) {
    if (sources_.flag(irq)) {
      if (is_event) note_missed(irq, 1, at);
      return;
    }
    sources_.set(irq, at);
    stirred_ = true;
  }
  /// Events that passed unseen while the flag was set; for sources that did not raise() them one by one.
  void note_missed(int irq, std::int64_t events, Cycle at);

  // --- for the processor
  int pending(Cycle now, int cpu_level) const;
  /// Earliest cycle > now at which pending() changes without a new flag.
  Cycle pending_horizon(Cycle now) const;
  InterruptEntry enter(int vector, Cycle now);
  Cycle leave(Cycle now);
  /// The handler of this source, which is known by heart, clears its flag.
  void lower(int irq) { lower_all(std::uint64_t{1} << irq); }
  /// leave() to the level that the program's stack tells.
  Cycle leave_to(int level, Cycle now) {
    const Cycle next = leave(now);
    cpu_.resume_at(level, next);
    stirred_ = true;
    return next;
  }
  void set_level(int level, Cycle now);
  void disi(unsigned count, Cycle now) {
    cpu_.disi(count, now);
    stirred_ = true;
  }
  void raise_trap(Trap trap, Cycle now);
  /// Is neither a trap nor an enabled flag set but that of `vector`?
  bool has_no_other(int vector) const {
    std::uint64_t ready = sources_.ready();
    if (vector >= kFirstIrqVector) ready &= ~(std::uint64_t{1} << (vector - kFirstIrqVector));
    return !ready && !control_.traps();
  }
  /// Did anything happen since forget_stir() after which pending() may answer a vector, or pending_horizon()
  /// earlier? A flag that falls is no such thing.
  bool stirred() const { return stirred_; }
  void forget_stir() { stirred_ = false; }
  /// Writes to its registers so far.
  std::int64_t writes() const { return writes_; }

  // --- flags of IFS0 to 2, what handlers touch most
  std::uint16_t read_flags(int word, Cycle now) {
    flags_read_[static_cast<std::size_t>(word)] = now;
    return static_cast<std::uint16_t>(sources_.flags() >> 16 * word);
  }
  /// read_flags() and write_flags() of the same without the bits that `keep` has not, where all that this
  /// does is lower flags of which nobody hears. False: it would do more, and nothing has happened.
  bool lower_flags(int word, std::uint16_t keep, Cycle now) {
    const auto lowered =
        static_cast<std::uint64_t>(static_cast<std::uint16_t>(~keep)) << 16 * word & sources_.flags();
    if ((lowered & listeners_.heard()) || sources_.newest() > now) return false;
    ++writes_;
    flags_read_[static_cast<std::size_t>(word)] = now;
    lower_all(lowered);
    return true;
  }
  /// `value` holds bits that exist.
  void write_flags(int word, std::uint16_t value, std::uint16_t lanes, Cycle now);

  // --- SfrOwner
  std::uint16_t read(unsigned address, Cycle now) override;
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;

 private:
  __attribute__((noinline)) void set_by_program(std::uint64_t flags, Cycle now);
  void note_lowered(std::uint64_t flags) {
    cleared_ |= flags;
    uncleared_ &= ~flags;
    uncleared_again_ &= ~flags;
  }
  void lower_all(std::uint64_t flags) {
    sources_.set_flags(sources_.flags() & ~flags);
    note_lowered(flags);
  }
  __attribute__((noinline)) void check_cleared(int irq, Cycle entered, Cycle now);
  __attribute__((noinline)) void check_trap_cleared(int trap, Cycle now);
  void tell_uncleared(int vector, const std::string& bit, const char* who_waits, Cycle now);

  // what every turn of the processor looks at, together
  CpuLevel cpu_;
  InterruptControl control_;
  bool stirred_ = false;
  std::int64_t writes_ = 0;
  InterruptSources sources_;
  std::uint64_t cleared_ = 0;  // bit i: software cleared the flag of IRQ i since its handler began
  // bit i: the last handler of IRQ i returned with its flag untouched; more than one in turn did
  std::uint64_t uncleared_ = 0, uncleared_again_ = 0;
  unsigned uncleared_traps_ = 0;  // bit i: so did the last handler of trap i
  std::array<Cycle, 4> flags_read_{};
  std::uint16_t last_vector_ = 0, last_level_ = 0;
  FlagListeners listeners_;

  Diagnostics& diagnostics_;
  InterruptTally tally_;
};

// --- acceptance, asked after everything that may change it

inline int Interrupts::pending(Cycle now, int cpu_level) const {
  if (const int trap = control_.trap_above(cpu_level); trap != kNoVector) return trap;
  std::uint64_t ready = sources_.ready();
  if (!ready) return kNoVector;
  // a flag is seen one cycle after it is set
  if (sources_.newest() >= now) ready &= ~sources_.younger_than(now - 1, ready);
  const int lowest = cpu_.lowest(now, cpu_level);
  if (!(ready & (ready - 1))) {  // one alone at most, as nearly always
    if (!ready) return kNoVector;
    const int i = __builtin_ctzll(ready);
    return sources_.priority(i) >= lowest ? kFirstIrqVector + i : kNoVector;
  }
  for (int level = 7; level >= lowest; --level)
    if (const std::uint64_t here = ready & sources_.at_priority(level))
      return kFirstIrqVector + __builtin_ctzll(here);
  return kNoVector;
}

inline Cycle Interrupts::pending_horizon(Cycle now) const {
  Cycle next = kNever;
  const std::uint64_t ready = sources_.waking();
  if (!ready) return next;
  if (sources_.newest() >= now) {
    for (std::uint64_t rest = ready; rest; rest &= rest - 1) {
      const Cycle since = sources_.since(__builtin_ctzll(rest));
      if (since >= now) next = std::min(next, since + 1);
    }
  }
  return cpu_.horizon(now, next);
}

// a write that follows the read of the same flags within this many cycles is the second
// half of one instruction
inline constexpr Cycle kReadModifyWrite = 3;

__attribute__((always_inline)) inline void Interrupts::write_flags(int word, std::uint16_t value,
                                                                   std::uint16_t lanes, Cycle now) {
  ++writes_;
  const int shift = 16 * word;
  const auto mask = static_cast<std::uint64_t>(lanes) << shift;
  const std::uint64_t flags = sources_.flags();
  std::uint64_t wanted = (flags & ~mask) | ((static_cast<std::uint64_t>(value) << shift) & mask);
  std::uint64_t cleared = flags & ~wanted;
  // what the hardware set after the program's read is not in the value that it writes back
  const Cycle read = flags_read_[static_cast<std::size_t>(word)];
  if (cleared && sources_.newest() > read && now - read <= kReadModifyWrite) {
    wanted |= sources_.younger_than(read, cleared);
    cleared = flags & ~wanted;
  }
  if (const std::uint64_t set = wanted & ~flags) set_by_program(set, now);
  sources_.set_flags(wanted);
  note_lowered(cleared);
  for (std::uint64_t told = cleared & listeners_.heard(); told; told &= told - 1) {
    const int i = __builtin_ctzll(told);
    listeners_.of(i)->flag_cleared(i, now);
  }
}

__attribute__((always_inline)) inline InterruptEntry Interrupts::enter(int vector, Cycle now) {
  InterruptEntry entry;
  entry.vector = vector;
  if (vector < kFirstIrqVector)
    entry.level = trap_level(vector);
  else
    entry.level = control_.nesting_disabled() ? 7 : sources_.priority(vector - kFirstIrqVector);
  entry.address = (control_.uses_alternate_table() ? 0x84u : 0x04u) + 2 * static_cast<unsigned>(vector);
  entry.first_instruction = now + kInterruptEntryCycles;
  cpu_.enter(vector, entry.level, now);
  if (vector >= kFirstIrqVector) cleared_ &= ~(std::uint64_t{1} << (vector - kFirstIrqVector));
  last_vector_ = static_cast<std::uint16_t>(vector);
  last_level_ = static_cast<std::uint16_t>(entry.level);
  tally_.served.add(vector);
  return entry;
}

__attribute__((always_inline)) inline Cycle Interrupts::leave(Cycle now) {
  const Cycle next = now + kInterruptReturnCycles;
  if (cpu_.nesting() == 0) return next;
  const CpuLevel::Frame& frame = cpu_.leave(next);
  const int irq = frame.vector - kFirstIrqVector;
  if (irq < 0)
    check_trap_cleared(frame.vector, now);
  else if (!(cleared_ >> irq & 1))
    check_cleared(irq, frame.entered, now);
  return next;
}

}  // namespace dspic
