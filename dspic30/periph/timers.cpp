// SPDX-License-Identifier: MIT
#include "dspic30/periph/timers.h"

#include <algorithm>
#include <utility>

namespace dspic {

namespace {

struct Addresses {
  unsigned tmr, pr, con;
};
constexpr Addresses kAt[kTimers] = {{sfr("TMR1"), sfr("PR1"), sfr("T1CON")},
                                    {sfr("TMR2"), sfr("PR2"), sfr("T2CON")},
                                    {sfr("TMR3"), sfr("PR3"), sfr("T3CON")},
                                    {sfr("TMR4"), sfr("PR4"), sfr("T4CON")},
                                    {sfr("TMR5"), sfr("PR5"), sfr("T5CON")}};
constexpr unsigned kHold23 = sfr("TMR3HLD"), kHold45 = sfr("TMR5HLD");
constexpr int kFlags[kTimers] = {irq::T1, irq::T2, irq::T3, irq::T4, irq::T5};
constexpr Pin kClockPins[kTimers] = {{Port::C, 14}, {Port::C, 1}, {Port::C, 2}, {Port::C, 3}, {Port::C, 4}};
constexpr std::uint16_t kTon = sfr_bits("T2CON", "TON"), kTgate = sfr_bits("T2CON", "TGATE"),
                        kT32 = sfr_bits("T2CON", "T32"), kTcs = sfr_bits("T2CON", "TCS"),
                        kTsidl = sfr_bits("T2CON", "TSIDL"), kTsync = sfr_bits("T1CON", "TSYNC");
constexpr SfrBits kTckps = sfr_field("T2CON", "TCKPS");
constexpr int kPrescaleBits[] = {0, 3, 6, 8};  // 1, 8, 64, 256
constexpr Cycle kEdgeToTick = 1;               // synchroniser of TxCK
constexpr Cycle kMatchToFlag = 1;              // [chip P2]

/// Timer whose own flag an IRQ is.
constexpr std::array<std::uint8_t, kIrqs> timers_by_flag() {
  std::array<std::uint8_t, kIrqs> timers{};
  for (int t = 1; t <= kTimers; ++t)
    timers[static_cast<std::size_t>(kFlags[t - 1])] = static_cast<std::uint8_t>(t);
  return timers;
}
constexpr std::array<std::uint8_t, kIrqs> kTimerOfFlag = timers_by_flag();

// which register of which timer
enum class What { Tmr, Pr, Con, Hold };
struct Register {
  int timer;
  What what;
};
Register find(unsigned address) {
  if (address == kHold23) return {2, What::Hold};
  if (address == kHold45) return {4, What::Hold};
  for (int t = 1; t <= kTimers; ++t) {
    const Addresses& a = kAt[t - 1];
    if (address == a.tmr) return {t, What::Tmr};
    if (address == a.pr) return {t, What::Pr};
    if (address == a.con) return {t, What::Con};
  }
  return {1, What::Con};
}

}  // namespace

void Timers::attach() {
  f_.bus.attach(*this, kAt[0].tmr, kAt[4].con);
  for (int t = 1; t <= kTimers; ++t) {
    // a pair's match sets the flag of its high half
    std::uint64_t flags = std::uint64_t{1} << kFlags[t - 1];
    if (t == 2 || t == 4) flags |= std::uint64_t{1} << kFlags[t];
    if (t == 3) flags |= std::uint64_t{1} << irq::Adc;
    unit(t).slot = f_.events.add(*this, t, flags, false);
    f_.interrupts.listeners().listen(kFlags[t - 1], *this);
    f_.ports.watch(kClockPins[t - 1], *this);
  }
}

void Timers::reset(Cycle now) {
  clock_ = Clock::Runs;
  for (int t = 1; t <= kTimers; ++t) {
    count_missed(t, now);
    const int slot = unit(t).slot;
    const bool wanted = unit(t).wanted;
    unit(t) = Unit{};
    unit(t).slot = slot;
    unit(t).wanted = wanted;
    unit(t).base = now;
    f_.events.set(slot, kNever);
  }
}

int Timers::flag_of(int timer) const { return kFlags[(unit(timer).wide ? timer + 1 : timer) - 1]; }
Pin Timers::clock_pin(int timer) const { return kClockPins[timer - 1]; }

// --- the counter in closed form

std::int64_t Timers::clocks(int timer, Cycle at) const {
  const Unit& u = unit(timer);
  if (at <= u.base) return u.residue;
  switch (u.mode) {
    case Mode::Internal:
      return u.residue + (at - u.base);
    case Mode::Gated:
      return u.gate_high ? u.residue + (at - u.base) : u.residue;
    case Mode::External:
      return u.residue +
             f_.ports.edges(clock_pin(timer), Edge::Rising, u.base - kEdgeToTick, at - kEdgeToTick);
    case Mode::Stopped:
      break;
  }
  return u.residue;
}

Cycle Timers::tick_instant(int timer, std::int64_t n) const {
  const Unit& u = unit(timer);
  const std::int64_t edges = (n << u.prescale_bits) - u.residue;
  switch (u.mode) {
    case Mode::Internal:
      return u.base + edges;
    case Mode::Gated:
      return u.gate_high ? u.base + edges : kNever;
    case Mode::External: {
      const Cycle edge = f_.ports.nth_edge(clock_pin(timer), Edge::Rising, u.base - kEdgeToTick, edges);
      return edge >= kNever ? kNever : edge + kEdgeToTick;
    }
    case Mode::Stopped:
      break;
  }
  return kNever;
}

std::uint32_t Timers::after_ticks(const Unit& u, std::int64_t n) const {
  const std::int64_t period = std::int64_t{u.pr} + 1;
  const std::int64_t first = u.count <= u.pr ? period - u.count : std::int64_t{top(u)} + 1 - u.count;
  if (n < first) return static_cast<std::uint32_t>(u.count + n);
  return static_cast<std::uint32_t>((n - first) % period);
}

std::int64_t Timers::ticks_to(const Unit& u, std::uint32_t value) const {
  if (u.count > u.pr) {  // runs up to the top, then from 0
    if (value > u.count && value <= top(u)) return std::int64_t{value} - u.count;
    return value <= u.pr ? std::int64_t{top(u)} + 1 - u.count + value : -1;
  }
  if (value > u.pr) return -1;
  const std::int64_t distance = std::int64_t{value} - u.count;
  return distance > 0 ? distance : distance + u.pr + 1;
}

std::int64_t Timers::matches_by(int timer, Cycle flag_at) const {
  const Unit& u = unit(timer);
  if (u.pr == 0 || u.mode == Mode::Gated) return 0;
  const std::int64_t n = ticks(timer, flag_at - kMatchToFlag), first = ticks_to(u, u.pr);
  return n < first ? 0 : 1 + (n - first) / (std::int64_t{u.pr} + 1);
}

Cycle Timers::next_flag(int timer, Cycle after) const {
  const Unit& u = unit(timer);
  Cycle next = u.pending_flag > after ? u.pending_flag : kNever;
  if (u.mode == Mode::Stopped || u.mode == Mode::Gated || u.pr == 0) return next;
  const std::int64_t nth = ticks_to(u, u.pr) + matches_by(timer, after) * (std::int64_t{u.pr} + 1);
  const Cycle tick = tick_instant(timer, nth);
  return std::min(next, tick >= kNever ? kNever : tick + kMatchToFlag);
}

Cycle Timers::next_internal(int timer, Cycle after) {
  Unit& u = unit(timer);
  if (after < u.next && after >= u.next_from) return u.next;
  if (u.next > 0 && after == u.next && u.pending_flag == kNever && u.pr != 0) {
    u.next += (Cycle{u.pr} + 1) << u.prescale_bits;  // the match after this one
  } else {
    u.next = next_flag(timer, after);
    // what a rewritten counter still owes comes at no regular distance
    if (u.pending_flag < kNever) return std::exchange(u.next, -1);
  }
  u.next_from = after;
  return u.next;
}

std::uint32_t Timers::count(int timer, Cycle at) const {
  const Unit& u = unit(timer);
  if (u.slave) return unit(timer - 1).wide ? count(timer - 1, at) >> 16 : u.count;
  return after_ticks(u, ticks(timer, at));
}

bool Timers::is_running(int timer) const { return unit(timer).mode != Mode::Stopped; }

Cycle Timers::next_reach(int timer, std::uint32_t value, Cycle after) const {
  const Unit& u = unit(timer);
  if (u.mode == Mode::Stopped || u.slave) return kNever;
  std::int64_t nth = ticks_to(u, value);
  if (nth < 0) return kNever;
  const std::int64_t done = ticks(timer, after), period = std::int64_t{u.pr} + 1;
  if (nth <= done) {
    if (value > u.pr) return kNever;  // passed once, on the way to the top
    nth += ((done - nth) / period + 1) * period;
  }
  return tick_instant(timer, nth);
}

// --- changes of course

void Timers::settle(int timer, Cycle at, Cycle done) {
  Unit& u = unit(timer);
  if (u.slave) return;
  // ticks up to `at` give flags up to `at` + 1; those after `done` have not been told yet
  const Cycle flag = next_flag(timer, done);
  u.pending_flag = flag <= at + kMatchToFlag ? flag : kNever;
  const std::int64_t all = clocks(timer, at);
  u.count = after_ticks(u, all >> u.prescale_bits);
  u.residue = all & (u.prescale() - 1);
  u.base = std::max(u.base, at);
  u.next = -1;
}

bool Timers::stands(int timer) const {
  const std::uint16_t con = unit(timer).con;
  const bool has_own = timer == 1 && (con & (kTcs | kTsync)) == kTcs;
  return clock_ == Clock::Stands ? !has_own : clock_ == Clock::Idles && (con & kTsidl);
}

// the count stays, and what the prescaler holds
void Timers::set_clock(Clock clock, Cycle now) {
  clock_ = clock;
  for (int t = 1; t <= kTimers; ++t) {
    Unit& u = unit(t);
    if (u.slave || (u.mode != Mode::Stopped) == ((u.con & kTon) && !stands(t))) continue;
    count_missed(t, now);
    settle(t, now, now);
    const Cycle residue = u.residue;
    configure(t, now);
    u.residue = residue;
    schedule(t, now);
    tell_changed(t, now);
  }
}

void Timers::configure(int timer, Cycle at) {
  Unit& u = unit(timer);
  const Mode before = u.mode;
  if (u.slave || !(u.con & kTon) || stands(timer))
    u.mode = Mode::Stopped;
  else if (u.con & kTcs)
    u.mode = Mode::External;
  else
    u.mode = (u.con & kTgate) ? Mode::Gated : Mode::Internal;
  u.prescale_bits = kPrescaleBits[kTckps.of(u.con)];
  u.next = -1;
  u.pr = u.wide ? u.pr16 | std::uint32_t{unit(timer + 1).pr16} << 16 : u.pr16;
  u.residue = std::min(u.residue, u.prescale() - 1);
  if (u.mode == Mode::Stopped || before == Mode::Stopped) u.residue = 0;
  if (u.mode == Mode::Gated) u.gate_high = f_.ports.level(clock_pin(timer), at);
}

void Timers::schedule(int timer, Cycle now) {
  Unit& u = unit(timer);
  Cycle at = kNever;
  u.lazy = false;
  if (u.mode == Mode::Gated) {
    const Cycle edge =
        f_.ports.nth_edge(clock_pin(timer), u.gate_high ? Edge::Falling : Edge::Rising, now - kEdgeToTick, 1);
    u.gate_edge = edge >= kNever ? kNever : edge + kEdgeToTick;
    at = std::min(u.pending_flag, u.gate_edge);
  } else if (f_.interrupts.sources().flag(flag_of(timer)) && !u.wanted) {
    u.lazy = true;
    u.lazy_since = now;
    if (u.mode == Mode::Internal) next_internal(timer, now);  // for count_missed()
  } else {
    at = u.mode == Mode::Internal ? next_internal(timer, now) : next_flag(timer, now);
  }
  f_.interrupts.listeners().hear(flag_of(timer), u.lazy);
  f_.events.set(u.slot, at);
}

void Timers::count_missed(int timer, Cycle now) {
  Unit& u = unit(timer);
  if (!u.lazy) return;
  f_.interrupts.note_missed(flag_of(timer), uncounted(timer, now), now);
  u.lazy_since = now;
}

std::int64_t Timers::uncounted(int timer, Cycle now) const {
  const Unit& u = unit(timer);
  if (u.lazy_since >= u.next_from && now < u.next) return 0;
  const bool had_pending = u.pending_flag > u.lazy_since && u.pending_flag <= now;
  return matches_by(timer, now) - matches_by(timer, u.lazy_since) + had_pending;
}

std::int64_t Timers::missed_of(int irq, Cycle now) const {
  for (int t = 1; t <= kTimers; ++t)
    if (unit(t).lazy && flag_of(t) == irq && f_.interrupts.sources().enabled(irq)) return uncounted(t, now);
  return 0;
}

void Timers::tell_changed(int timer, Cycle at) {
  for (TimerListener* l : listeners_) l->timer_changed(timer, at);
}

void Timers::on_event(int id, Cycle at) {
  Unit& u = unit(id);
  const int flag = flag_of(id);
  if (u.mode != Mode::Internal || u.wanted || at != u.next || u.pr == 0 || f_.interrupts.sources().flag(flag))
    return irregular_event(id, at);
  // a period as the one before, and the flag was lowered meanwhile
  u.next += (Cycle{u.pr} + 1) << u.prescale_bits;
  u.next_from = at;
  f_.events.fill(u.slot, u.next);
  f_.interrupts.raise(flag, at);
}

void Timers::irregular_event(int id, Cycle at) {
  Unit& u = unit(id);
  if (u.mode == Mode::Gated) {
    if (u.pending_flag == at) f_.interrupts.raise(flag_of(id), at);
    const bool at_edge = u.gate_edge == at;
    if (at_edge) {
      settle(id, at, at);
      u.gate_high = !u.gate_high;
    }
    if (u.pending_flag <= at) u.pending_flag = kNever;
    if (at_edge && !u.gate_high) u.pending_flag = at + kMatchToFlag;
    return schedule(id, at);
  }
  if (u.pending_flag == at) u.pending_flag = kNever;
  if (u.mode == Mode::External) settle(id, at, at);  // edges are counted from here on
  f_.interrupts.raise(flag_of(id), at);
  if (u.wanted)
    for (TimerListener* l : listeners_) l->timer_matched(u.wide ? id + 1 : id, at);
  schedule(id, at);
}

void Timers::flag_cleared(int irq, Cycle now) {
  int t = kTimerOfFlag[static_cast<std::size_t>(irq)];
  if (unit(t).slave) --t;
  if (flag_of(t) != irq) return;  // of the low half of a pair
  if (unit(t).lazy) catch_up(t, now);
}

void Timers::catch_up(int timer, Cycle now) {
  count_missed(timer, now);
  schedule(timer, now);
}

void Timers::want_matches(int timer, bool wanted, Cycle now) {
  const int owner = timer > 1 && unit(timer).slave ? timer - 1 : timer;
  if (unit(timer).wanted == wanted && unit(owner).wanted == wanted) return;
  count_missed(owner, now);
  unit(timer).wanted = unit(owner).wanted = wanted;
  schedule(owner, now);
}

void Timers::outside_changed(Cycle now) {
  for (int t = 1; t <= kTimers; ++t) {
    if (unit(t).mode != Mode::External && unit(t).mode != Mode::Gated) continue;
    settle(t, now, now);
    if (unit(t).mode == Mode::Gated) unit(t).gate_high = f_.ports.level(clock_pin(t), now);
    schedule(t, now);
    tell_changed(t, now);
  }
}

void Timers::own_edge(Pin pin, Edge edge, Cycle at) {
  for (int t = 1; t <= kTimers; ++t) {
    Unit& u = unit(t);
    if (pin.port != clock_pin(t).port || pin.bit != clock_pin(t).bit) continue;
    if (u.mode == Mode::External && edge == Edge::Rising) {
      settle(t, at, at - 1);
      const std::uint32_t before = u.count;
      if (++u.residue == u.prescale()) {
        u.count = after_ticks(u, 1);
        u.residue = 0;
        if (u.count == u.pr && before != u.pr) u.pending_flag = at + kEdgeToTick + kMatchToFlag;
      }
      schedule(t, at);
      tell_changed(t, at);
    } else if (u.mode == Mode::Gated) {
      settle(t, at, at - 1);
      u.gate_high = edge == Edge::Rising;
      if (!u.gate_high) u.pending_flag = at + kMatchToFlag;
      schedule(t, at);
    }
  }
}

// --- registers

std::uint16_t Timers::read(unsigned address, Cycle now) {
  const Register r = find(address);
  if (r.what == What::Tmr && unit(r.timer).wide)
    unit(r.timer).hold = static_cast<std::uint16_t>(count(r.timer, now) >> 16);
  return peek(address, now);
}

std::uint16_t Timers::peek(unsigned address, Cycle now) const {
  const Register r = find(address);
  const Unit& u = unit(r.timer);
  switch (r.what) {
    case What::Tmr:
      return static_cast<std::uint16_t>(count(r.timer, now));
    case What::Pr:
      return u.pr16;
    case What::Con:
      return u.con;
    case What::Hold:
      return u.hold;
  }
  return 0;
}

void Timers::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  const Register r = find(address);
  Unit& named = unit(r.timer);
  if (r.what == What::Hold) {
    named.hold = merge_lanes(named.hold, value, lanes);
    return;
  }
  // A write acts from the next cycle on. The upper half of a pair is counted by the lower one.
  const Cycle at = now + 1;
  const bool is_low = r.timer == 2 || r.timer == 4;
  const int owner = named.slave ? r.timer - 1 : r.timer;
  Unit& u = unit(owner);
  const std::uint16_t tmr = static_cast<std::uint16_t>(count(r.timer, at));
  count_missed(owner, now);
  settle(owner, at, now);
  const std::uint32_t count_before = u.count, pr_before = u.pr;
  switch (r.what) {
    case What::Tmr: {
      const std::uint16_t word = merge_lanes(tmr, value, lanes);
      if (u.wide && owner == r.timer)
        u.count = std::uint32_t{u.hold} << 16 | word;
      else if (u.wide)
        u.count = std::uint32_t{word} << 16 | (u.count & 0xFFFF);
      else
        u.count = word;
      u.residue = 0;
      u.base = at;
      if (u.pending_flag == at + kMatchToFlag) u.pending_flag = kNever;  // the write beats the tick
      break;
    }
    case What::Pr:
      named.pr16 = merge_lanes(named.pr16, value, lanes);
      break;
    case What::Con: {
      named.con = merge_lanes(named.con, value, lanes);
      const bool wide = is_low && (named.con & kT32);
      // two timers become one, or one becomes two
      if (wide != named.wide && is_low) {
        const int high = r.timer + 1;
        Unit& upper = unit(high);
        if (wide) {
          settle(high, at, now);
          named.count |= upper.count << 16;
          upper.pending_flag = kNever;
        } else {
          upper.count = named.count >> 16;
          upper.base = at;
          upper.residue = 0;
          named.count &= 0xFFFF;
        }
        named.wide = upper.slave = wide;
        configure(high, at);
        schedule(high, now);
      }
      break;
    }
    case What::Hold:
      break;
  }
  // From here on the closed form is another one.
  configure(owner, at);
  // equality made by the program counts as a match, but once
  const bool equal = u.count == u.pr && u.pr != 0;
  if (equal && r.what != What::Con && !(count_before == pr_before) && u.mode != Mode::Stopped &&
      u.mode != Mode::Gated)
    u.pending_flag = at + kMatchToFlag;
  schedule(owner, now);
  tell_changed(r.timer, at);
}

Cycle Timers::horizon(unsigned address, Cycle now) const {
  const Register r = find(address);
  if (r.what != What::Tmr) return kNever;
  const int owner = unit(r.timer).slave ? r.timer - 1 : r.timer;
  const Unit& u = unit(owner);
  if (u.mode == Mode::Stopped) return kNever;
  if (u.mode == Mode::Gated && !u.gate_high) return f_.events.when(u.slot);
  if (u.base > now) return now + 1;
  return std::max(now + 1, tick_instant(owner, ticks(owner, now) + 1));
}

}  // namespace dspic
