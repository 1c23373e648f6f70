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
#include <optional>
#include <vector>

#include "dspic30/memory/sfr_bus.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

/// A source that counts for itself while its flag is set hears when software clears it.
class FlagListener {
 public:
  virtual ~FlagListener() = default;
  virtual void flag_cleared(int irq, Cycle now) = 0;
  /// INTCON2.INTxEP of this source was changed.
  virtual void edge_chosen(int /*irq*/, Cycle /*now*/) {}
};

/// Level of trap 1 to 4 [chip C11].
constexpr int trap_level(int trap) { return 15 - trap; }
/// Its flag in INTCON1, where the order is another than that of the vectors.
constexpr std::uint16_t trap_flag(int trap) {
  constexpr std::uint16_t kFlags[] = {0, sfr_bits("INTCON1", "OSCFAIL"), sfr_bits("INTCON1", "ADDRERR"),
                                      sfr_bits("INTCON1", "STKERR"), sfr_bits("INTCON1", "MATHERR")};
  return kFlags[trap];
}
inline constexpr std::uint16_t kTrapFlags = trap_flag(1) | trap_flag(2) | trap_flag(3) | trap_flag(4);
inline constexpr std::uint16_t kMostDisi = sfr_bits("DISICNT", "DISICNT"),
                               kNstdis = sfr_bits("INTCON1", "NSTDIS"),
                               kAltivt = sfr_bits("INTCON2", "ALTIVT");

class Interrupts final : public SfrOwner {
 public:
  explicit Interrupts(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}
  void attach(SfrBus& bus);
  void reset(Cycle now);
  void listen(int irq, FlagListener& listener) {
    listeners_[static_cast<std::size_t>(irq)] = &listener;
    hear(irq, true);
  }
  /// Does it want to hear of it now? From listen() on it does.
  void hear(int irq, bool wants) {
    const std::uint64_t bit = std::uint64_t{1} << irq;
    heard_ = wants ? heard_ | bit : heard_ & ~bit;
  }

  // --- for peripherals
  /// The flag is set at `at`. `is_event`: one raise stands for one event, so that a second one is a loss.
  void raise(int irq, Cycle at, bool is_event = true) {
    const std::uint64_t bit = std::uint64_t{1} << irq;
    if (ifs_ & bit) {
      if (is_event) note_missed(irq, 1, at);
      return;
    }
    ifs_ |= bit;
    since_[static_cast<std::size_t>(irq)] = at;
    newest_ = std::max(newest_, at);
    stirred_ = true;
  }
  /// Events that passed unseen while the flag was set; for sources that did not raise() them one by one.
  void note_missed(int irq, std::int64_t events, Cycle at);
  bool flag(int irq) const { return (ifs_ >> irq & 1) != 0; }
  bool enabled(int irq) const { return (iec_ >> irq & 1) != 0; }
  std::uint64_t flags() const { return ifs_; }
  std::uint64_t enabled_mask() const { return iec_; }
  bool uses_alternate_table() const { return (intcon2_ & kAltivt) != 0; }  ///< INTCON2.ALTIVT
  int priority(int irq) const { return priority_[static_cast<std::size_t>(irq)]; }
  Cycle since(int irq) const { return since_[static_cast<std::size_t>(irq)]; }
  /// 1: external interrupt n waits for the falling edge.
  bool falling_edge(int n) const { return (intcon2_ >> n & 1) != 0; }

  // --- for the processor
  int pending(Cycle now, int cpu_level) const;
  /// Earliest cycle > now at which pending() changes without a new flag.
  Cycle pending_horizon(Cycle now) const;
  InterruptEntry enter(int vector, Cycle now);
  Cycle leave(Cycle now);
  /// The handler of this source, which is known by heart, clears its flag.
  void lower(int irq) {
    ifs_ &= ~(std::uint64_t{1} << irq);
    note_lowered(std::uint64_t{1} << irq);
  }
  /// leave() to the level that the program's stack tells.
  Cycle leave_to(int level, Cycle now) {
    const Cycle next = leave(now);
    resumed_ = next;
    level_ = level;
    stirred_ = true;
    return next;
  }
  int level() const { return level_; }
  void set_level(int level, Cycle now);
  int nesting() const { return depth_; }
  void disi(unsigned count, Cycle now) {
    disi_until_ = now + 1 + static_cast<Cycle>(count & kMostDisi);
    stirred_ = true;
  }
  bool disi_active(Cycle now) const { return now < disi_until_; }
  Cycle disi_until() const { return disi_until_; }
  void raise_trap(Trap trap, Cycle now);
  /// Is its flag set?
  bool has_trap(Trap trap) const { return (intcon1_ & trap_flag(static_cast<int>(trap))) != 0; }
  bool nesting_disabled() const { return (intcon1_ & kNstdis) != 0; }
  /// Is neither a trap nor an enabled flag set but that of `vector`?
  bool has_no_other(int vector) const {
    std::uint64_t ready = ifs_ & iec_;
    if (vector >= kFirstIrqVector) ready &= ~(std::uint64_t{1} << (vector - kFirstIrqVector));
    return !ready && !(intcon1_ & kTrapFlags);
  }
  bool wakes() const { return (ifs_ & iec_ & ~at_priority_[0]) != 0; }
  /// When an enabled flag wakes the processor, whatever its priority: a cycle after it was set;
  /// kNever: none is set.
  Cycle wakes_at() const {
    Cycle at = kNever;
    for (std::uint64_t ready = ifs_ & iec_ & ~at_priority_[0]; ready; ready &= ready - 1)
      at = std::min(at, since_[static_cast<std::size_t>(__builtin_ctzll(ready))] + 1);
    return at;
  }
  const std::optional<ResetKind>& reset_due() const { return reset_due_; }
  /// Did anything happen since forget_stir() after which pending() may answer a vector, or pending_horizon()
  /// earlier? A flag that falls is no such thing.
  bool stirred() const { return stirred_; }
  void forget_stir() { stirred_ = false; }
  /// Writes to its registers so far.
  std::int64_t writes() const { return writes_; }

  // --- flags of IFS0 to 2, what handlers touch most
  std::uint16_t read_flags(int word, Cycle now) {
    flags_read_[static_cast<std::size_t>(word)] = now;
    return static_cast<std::uint16_t>(ifs_ >> 16 * word);
  }
  /// read_flags() and write_flags() of the same without the bits that `keep` has not, where all that this
  /// does is lower flags of which nobody hears. False: it would do more, and nothing has happened.
  bool lower_flags(int word, std::uint16_t keep, Cycle now) {
    const auto lowered = static_cast<std::uint64_t>(static_cast<std::uint16_t>(~keep)) << 16 * word & ifs_;
    if ((lowered & heard_) || newest_ > now) return false;
    ++writes_;
    flags_read_[static_cast<std::size_t>(word)] = now;
    ifs_ &= ~lowered;
    note_lowered(lowered);
    return true;
  }
  /// `value` holds bits that exist.
  void write_flags(int word, std::uint16_t value, std::uint16_t lanes, Cycle now);

  std::int64_t missed(int irq) const { return missed_[static_cast<std::size_t>(irq)]; }
  std::int64_t served(int vector) const { return served_[static_cast<std::size_t>(vector)]; }

  // --- SfrOwner
  std::uint16_t read(unsigned address, Cycle now) override;
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;

 private:
  static constexpr int kMostFrames = 64;
  struct Frame {
    int vector;
    int outer_level;
    Cycle entered;
  };
  void push(const Frame& frame) {
    if (depth_ == static_cast<int>(frames_.size())) make_room();
    frames_[static_cast<std::size_t>(depth_++)] = frame;
  }
  __attribute__((noinline)) void make_room();
  __attribute__((noinline)) std::uint64_t younger_than(Cycle read, std::uint64_t flags) const;
  __attribute__((noinline)) void set_by_program(std::uint64_t flags, Cycle now);
  void set_priority(int irq, int priority);
  void note_lowered(std::uint64_t flags) {
    cleared_ |= flags;
    uncleared_ &= ~flags;
    uncleared_again_ &= ~flags;
  }
  __attribute__((noinline)) void check_cleared(int irq, Cycle entered, Cycle now);

  // what every turn of the processor looks at, together
  std::uint64_t ifs_ = 0, iec_ = 0;
  std::uint16_t intcon1_ = 0, intcon2_ = 0;
  int level_ = 0;
  int depth_ = 0;
  int resumed_level_ = 0;  // level of the handler that ended at resumed_
  Cycle resumed_ = -1;     // first instruction after RETFIE
  Cycle disi_until_ = 0;
  Cycle newest_ = -1;  // latest of since_
  std::optional<ResetKind> reset_due_;
  bool stirred_ = false;
  std::int64_t writes_ = 0;
  std::array<std::uint64_t, 8> at_priority_{};  // bit i: IRQ i has this priority
  std::array<std::uint8_t, kIrqs> priority_{};
  std::uint64_t heard_ = 0;    // bit i: IRQ i has a listener that wants to hear
  std::uint64_t cleared_ = 0;  // bit i: software cleared the flag of IRQ i since its handler began
  // bit i: the last handler of IRQ i returned with its flag untouched; more than one in turn did
  std::uint64_t uncleared_ = 0, uncleared_again_ = 0;
  std::vector<Frame> frames_;  // of handlers under way, the innermost last; and room for more
  std::array<Cycle, 4> flags_read_{};
  std::uint16_t last_vector_ = 0, last_level_ = 0;
  std::array<Cycle, kIrqs> since_{};

  Diagnostics& diagnostics_;
  std::array<FlagListener*, kIrqs> listeners_{};
  std::array<std::int64_t, kIrqs> missed_{};
  std::array<std::int64_t, kVectors> served_{};
};

// --- acceptance, asked after everything that may change it

inline int Interrupts::pending(Cycle now, int cpu_level) const {
  if (intcon1_ & kTrapFlags) {
    for (int trap = 1; trap <= 4; ++trap)
      if ((intcon1_ & trap_flag(trap)) && trap_level(trap) > cpu_level) return trap;
  }
  std::uint64_t ready = ifs_ & iec_;
  if (!ready) return kNoVector;
  if (newest_ >= now) {  // a flag is seen one cycle after it is set
    for (std::uint64_t rest = ready; rest; rest &= rest - 1) {
      const int i = __builtin_ctzll(rest);
      if (since_[static_cast<std::size_t>(i)] >= now) ready &= ~(std::uint64_t{1} << i);
    }
  }
  int lowest = cpu_level + 1;
  if (disi_active(now)) lowest = std::max(lowest, 7);
  if (now <= resumed_) lowest = std::max(lowest, resumed_level_ + 1);
  if (!(ready & (ready - 1))) {  // one alone at most, as nearly always
    if (!ready) return kNoVector;
    const int i = __builtin_ctzll(ready);
    return priority(i) >= lowest ? kFirstIrqVector + i : kNoVector;
  }
  for (int level = 7; level >= lowest; --level)
    if (const std::uint64_t here = ready & at_priority_[static_cast<std::size_t>(level)])
      return kFirstIrqVector + __builtin_ctzll(here);
  return kNoVector;
}

inline Cycle Interrupts::pending_horizon(Cycle now) const {
  Cycle next = kNever;
  const std::uint64_t ready = ifs_ & iec_ & ~at_priority_[0];
  if (!ready) return next;
  if (newest_ >= now) {
    for (std::uint64_t rest = ready; rest; rest &= rest - 1) {
      const Cycle since = since_[static_cast<std::size_t>(__builtin_ctzll(rest))];
      if (since >= now) next = std::min(next, since + 1);
    }
  }
  if (disi_active(now)) next = std::min(next, disi_until_);
  if (now <= resumed_) next = std::min(next, resumed_ + 1);
  return std::max(next, now + 1);
}

// a write that follows the read of the same flags within this many cycles is the second
// half of one instruction
inline constexpr Cycle kReadModifyWrite = 3;

__attribute__((always_inline)) inline void Interrupts::write_flags(int word, std::uint16_t value,
                                                                   std::uint16_t lanes, Cycle now) {
  ++writes_;
  const int shift = 16 * word;
  const auto mask = static_cast<std::uint64_t>(lanes) << shift;
  std::uint64_t wanted = (ifs_ & ~mask) | ((static_cast<std::uint64_t>(value) << shift) & mask);
  std::uint64_t cleared = ifs_ & ~wanted;
  // what the hardware set after the program's read is not in the value that it writes back
  const Cycle read = flags_read_[static_cast<std::size_t>(word)];
  if (cleared && newest_ > read && now - read <= kReadModifyWrite) {
    wanted |= younger_than(read, cleared);
    cleared = ifs_ & ~wanted;
  }
  if (const std::uint64_t set = wanted & ~ifs_) set_by_program(set, now);
  ifs_ = wanted;
  note_lowered(cleared);
  for (std::uint64_t told = cleared & heard_; told; told &= told - 1) {
    const int i = __builtin_ctzll(told);
    listeners_[static_cast<std::size_t>(i)]->flag_cleared(i, now);
  }
}

__attribute__((always_inline)) inline InterruptEntry Interrupts::enter(int vector, Cycle now) {
  InterruptEntry entry;
  entry.vector = vector;
  if (vector < kFirstIrqVector)
    entry.level = trap_level(vector);
  else
    entry.level = nesting_disabled() ? 7 : priority(vector - kFirstIrqVector);
  entry.address = (uses_alternate_table() ? 0x84u : 0x04u) + 2 * static_cast<unsigned>(vector);
  entry.first_instruction = now + kInterruptEntryCycles;
  push({vector, level_, now});
  if (vector >= kFirstIrqVector) cleared_ &= ~(std::uint64_t{1} << (vector - kFirstIrqVector));
  level_ = entry.level;
  last_vector_ = static_cast<std::uint16_t>(vector);
  last_level_ = static_cast<std::uint16_t>(entry.level);
  ++served_[static_cast<std::size_t>(vector)];
  return entry;
}

__attribute__((always_inline)) inline Cycle Interrupts::leave(Cycle now) {
  if (depth_ == 0) return now + kInterruptReturnCycles;
  const Frame& frame = frames_[static_cast<std::size_t>(--depth_)];
  resumed_ = now + kInterruptReturnCycles;
  resumed_level_ = std::min(level_, 7);
  level_ = frame.outer_level;
  const int irq = frame.vector - kFirstIrqVector;
  if (irq >= 0 && !(cleared_ >> irq & 1)) check_cleared(irq, frame.entered, now);
  return now + kInterruptReturnCycles;
}

}  // namespace dspic
