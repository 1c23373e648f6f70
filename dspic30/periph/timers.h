// SPDX-License-Identifier: MIT
// Timers 1 to 5: TMRx, PRx, TxCON, TMRxHLD, pairs 2:3 and 4:5.
//
//   TCY or TxCK edges --> prescaler 1 8 64 256 --> TMR, back to 0 on the tick after TMR == PR --> TxIF
//
// Modelled: internal and external clock, prescalers, gate, 32-bit pairs with holding registers, period
// below the count (runs through 0xFFFF), PR = 0, match on writing TMR or PR, standing in Sleep and, with
// TSIDL, in Idle. The count is a closed form; only matches are events, and not even those while the flag is
// still set and nobody else listens. Not modelled: the 32 kHz crystal, T1 asynchronous, edges above TCY/2.
// Times: a write in cycle t acts from t + 1; a tick that makes TMR == PR sets the flag one cycle later; an
// external edge ticks one cycle after it. Source: [chip P2], pins of T2CK and T3CK [DS70286C]; [?] flag
// phase with prescalers.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "dspic30/periph/ports.h"

namespace dspic {

inline constexpr int kTimers = 5;

/// Hears of matches (timer 3: the converter's trigger) and of changes to a timer's course.
class TimerListener {
 public:
  virtual ~TimerListener() = default;
  virtual void timer_matched(int /*timer*/, Cycle /*at*/) {}
  virtual void timer_changed(int /*timer*/, Cycle /*at*/) {}
};

class Timers final : public SfrOwner, public EventOwner, public FlagListener, public PinListener {
 public:
  explicit Timers(const Fabric& fabric) : f_(fabric) {}
  void attach();
  void reset(Cycle now);
  void outside_changed(Cycle now);
  /// The processor's clock, which timer 1 need not have: in Idle it runs but for those with TSIDL.
  enum class Clock { Runs, Idles, Stands };
  void set_clock(Clock clock, Cycle now);

  // --- for peripherals; timers 1 to 5
  void listen(TimerListener& listener) { listeners_.push_back(&listener); }
  /// Every match of the timer is told one by one, or not.
  void want_matches(int timer, bool wanted, Cycle now);
  std::uint32_t count(int timer, Cycle at) const;
  bool is_running(int timer) const;
  /// Matches that have found their enabled flag set since it was, up to `now`, and are counted once it falls.
  std::int64_t missed_of(int irq, Cycle now) const;
  std::uint32_t period(int timer) const { return unit(timer).pr; }
  /// First tick after `after` at which the count becomes `value`; kNever when it does not.
  Cycle next_reach(int timer, std::uint32_t value, Cycle after) const;

  std::uint16_t read(unsigned address, Cycle now) override;
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;
  void on_event(int id, Cycle at) override;
  void flag_cleared(int irq, Cycle now) override;
  void own_edge(Pin pin, Edge edge, Cycle at) override;

 private:
  enum class Mode { Stopped, Internal, External, Gated };
  struct Unit {
    std::uint16_t con = 0;
    std::uint16_t pr16 = 0xFFFF;
    std::uint16_t hold = 0;  // TMRxHLD of the pair, in its low unit
    // the running counter; of a pair in its low unit
    Mode mode = Mode::Stopped;
    bool wide = false;        // 32 bits
    bool slave = false;       // the high half of a pair: its counter lies in the low unit
    std::uint32_t count = 0;  // at cycle `base`
    std::uint32_t pr = 0xFFFF;
    Cycle base = 0;
    int prescale_bits = 0;  // of 1, 8, 64, 256
    Cycle residue = 0;      // clock edges that the prescaler holds at `base`
    bool gate_high = false;
    Cycle gate_edge = kNever;     // of the gate, next
    Cycle pending_flag = kNever;  // of a match whose counter has been rewritten meanwhile
    bool wanted = false;
    bool lazy = false;     // matches are not events now, but counted when the flag is cleared
    Cycle lazy_since = 0;  // last flag instant that was an event
    Cycle next = -1;       // next_flag() of any cycle from next_from on and before this; -1 unknown
    Cycle next_from = 0;
    int slot = -1;

    Cycle prescale() const { return Cycle{1} << prescale_bits; }
  };

  Unit& unit(int timer) { return units_[static_cast<std::size_t>(timer - 1)]; }
  const Unit& unit(int timer) const { return units_[static_cast<std::size_t>(timer - 1)]; }
  int flag_of(int timer) const;
  Pin clock_pin(int timer) const;
  std::uint32_t top(const Unit& u) const { return u.wide ? 0xFFFFFFFFu : 0xFFFFu; }

  std::int64_t clocks(int timer, Cycle at) const;  // clock edges since base, residue included
  std::int64_t ticks(int timer, Cycle at) const { return clocks(timer, at) >> unit(timer).prescale_bits; }
  Cycle tick_instant(int timer, std::int64_t n) const;  // of the n-th tick since base
  std::uint32_t after_ticks(const Unit& u, std::int64_t n) const;
  std::int64_t ticks_to(const Unit& u, std::uint32_t value) const;  // 0 < result, or -1
  std::int64_t matches_by(int timer, Cycle flag_at) const;          // flags at or before that cycle
  Cycle next_flag(int timer, Cycle after) const;
  /// The same for a timer on the chip's clock, remembered.
  Cycle next_internal(int timer, Cycle after);
  /// The counter's state moves to `at`; flags up to `done` have been told.
  void settle(int timer, Cycle at, Cycle done);
  void configure(int timer, Cycle at);
  bool stands(int timer) const;
  void schedule(int timer, Cycle now);
  void count_missed(int timer, Cycle now);
  std::int64_t uncounted(int timer, Cycle now) const;  // of matches that found the flag set, if it is lazy
  // apart from the usual course of a timer on the chip's clock, which then keeps little on the stack
  __attribute__((noinline)) void irregular_event(int id, Cycle at);
  __attribute__((noinline)) void catch_up(int timer, Cycle now);
  void tell_changed(int timer, Cycle at);

  const Fabric& f_;
  std::array<Unit, kTimers> units_{};
  Clock clock_ = Clock::Runs;
  std::vector<TimerListener*> listeners_;
};

}  // namespace dspic
