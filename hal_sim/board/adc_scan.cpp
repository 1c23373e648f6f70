// SPDX-License-Identifier: MIT
// See adc_scan.h. Interrupts of ALL_ADC mode are numbered from 0; number i has slot i % 65 and period i / 65.
// In period q the lit sample of pair_of_lit(q) arrives, and the dark one of pair_of_lit(q + 1).
#include "hal_sim/board/adc_scan.h"

#include <algorithm>
#include <iterator>

#include "hal_sim/board/accelerometer.h"
#include "hal_sim/board/agenda_timer.h"
#include "hal_sim/board/board.h"
#include "hal_sim/board/sound_params.h"

namespace board {

namespace {
/// `pair` of a sensor: 0 and 4 share an emitter line, and so on; 8 and 9 are the turret's.
int pair_of_sensor(int sensor) { return sensor >= 8 ? 4 : sensor & 3; }

/// A frame's channels and converter clock; the latter in halves of a cycle.
struct Frame {
  int channels;
  Cycle half_tad;
};
constexpr Frame frame_of(int slot) {
  if (slot == kScanLitSlot || slot == kScanDarkSlot) return {5, 2 * kScanTadCycles};
  if (slot == kScanAccSlot) return {6, 2 * kScanTadCycles6};
  return {3, 2 * kScanTadCycles3 - (slot > 4 && slot < 33 ? 1 : 0)};
}
constexpr Frame kMicroFrame{3, 2 * kScanTadCycles6};
/// Cycles from a channel's hold instant to the end of its frame.
constexpr Cycle hold_to_end(Frame f, int channel) {
  return (((f.channels - channel) * kScanChannelTad - 1) * f.half_tad + 1) / 2 + kScanFlagCycles;
}
Cycle hold_to_end(int sensor) {
  return hold_to_end(frame_of(kScanLitSlot), sensor < 4 ? 3 : sensor < 8 ? 4 : 9 - sensor);
}
// converter clocks of scans of 3, 5 and 6 channels give frames of one length
static_assert(3 * kScanChannelTad * kScanTadCycles3 == kScanFrameCycles);
static_assert(6 * kScanChannelTad * kScanTadCycles6 == kScanFrameCycles);
static_assert(3 * kScanChannelTad * kScanTadCycles6 == kScanMicroFrameCycles);
static_assert(5 * kScanChannelTad * kScanTadCycles == kScanFrameCycles);
static_assert(hold_to_end(frame_of(kScanLitSlot), 3) == 349);

/// Handlers of a period: when they are called, what they take, and what those before a slot take together.
struct Round {
  Cycle at[kScanPeriod];
  Cycle cycles[kScanPeriod];
  Cycle before[kScanPeriod + 1];
};
constexpr Round make_round() {
  Round r{};
  for (int slot = 0; slot < kScanPeriod; ++slot) {
    const ScanHandler handler = scan_handler(slot);
    r.at[slot] = (slot + 1) * kScanFrameCycles + handler.late;
    r.cycles[slot] = handler.cycles;
    r.before[slot + 1] = r.before[slot] + handler.cycles;
  }
  return r;
}
constexpr Round kRound = make_round();
constexpr Cycle kLongestCall =
    *std::max_element(std::begin(kRound.cycles), std::end(kRound.cycles)) + kScanWrapCycles;
static_assert(kRound.at[kScanPeriod - 1] == kScanRoundCycles);

/// Slots in whose calls the converter stands.
constexpr int kStopSlots[] = {2, 3, 32, 61, 62, 63};
constexpr int kStops = static_cast<int>(std::size(kStopSlots));
/// When such a call comes, after the round's beginning.
constexpr Cycle stop_at(int kind) { return kRound.at[kStopSlots[kind]]; }
}  // namespace

Cycle scan_flash_cycles(int sensor) {
  return kScanRoundCycles + kRound.at[kScanLitSlot] - kRound.at[kScanDarkSlot] - kScanLightCycles -
         hold_to_end(sensor);
}

void AdcScan::settle(Cycle at) {
  // samples so far must not depend on frame times that are about to be forgotten
  for (int sensor = 0; sensor < kRingSensors; ++sensor) {
    const auto i = static_cast<std::size_t>(sensor);
    const std::int64_t count = full_interrupts(at);
    keep(dark_[i], sensor, newest(count, kScanDarkSlot, 1, pair_of_sensor(sensor)), false);
    keep(lit_[i], sensor, newest(count, kScanLitSlot, 0, pair_of_sensor(sensor)), true);
  }
  fill_acc(acc_samples_of(full_interrupts(at)));
  const std::int64_t passed = frames(at);
  if (passed > 0) {
    runs_.push_back({total_base_, full_base_, round_, micro_only_});
    while (runs_.size() > 1 && runs_[1].first <= total_base_ + passed - kMicSamples)
      runs_.erase(runs_.begin());
  }
  total_base_ += passed;
  if (!micro_only_) full_base_ += passed;
  find_round(at);
  for (auto* samples : {&dark_, &lit_})
    for (Sample& s : *samples) s.until = 0;
}

void AdcScan::start(bool micro_only, bool five_pairs, Cycle at) {
  settle(at);
  const std::int64_t period = (full_base_ + kScanPeriod - 1 - kScanLitSlot) / kScanPeriod;
  pair_base_ = pair_of_lit(period);
  period_base_ = period;
  pairs_ = five_pairs ? 5 : 4;
  pair_base_ %= pairs_;
  micro_only_ = micro_only;
  find_round(at);
  on_ = true;
  ++starts_;
}

void AdcScan::switch_converter(bool on, Cycle at) {
  if (on == on_) return;
  settle(at);
  on_ = on;
}

void AdcScan::reset(Cycle at) {
  settle(at);
  runs_.clear();
  acc_kept_ = 0;
  acc_used_ = false;
  acc_ = AccRing{};
  on_ = micro_only_ = false;
  starts_ = 0;
  pairs_ = 4;
  total_base_ = full_base_ = period_base_ = ticks_base_ = 0;
  pair_base_ = 0;
  find_round(at);
  dark_.fill(Sample{});
  lit_.fill(Sample{});
}

int AdcScan::pair_of_lit(std::int64_t period) const {
  return static_cast<int>((pair_base_ + (period - period_base_) % pairs_ + pairs_) % pairs_);
}

/// When a call is asked for, not with MICRO_ONLY.
inline Cycle AdcScan::cycle_of(Place p) const {
  return round_ + p.round * kScanRoundCycles + kRound.at[p.slot];
}

Cycle AdcScan::full_cycle(std::int64_t interrupt) const {
  const std::int64_t period = interrupt / kScanPeriod;
  return cycle_of({period - first_period_, static_cast<int>(interrupt - period * kScanPeriod)});
}

std::int64_t AdcScan::frames(Cycle at) const {
  if (!on_) return 0;
  const Place next = place(at + 1);
  return micro_only_ ? next.round : next.round * kScanPeriod + next.slot - first_slot_;
}

Cycle AdcScan::interrupt_cycle(std::int64_t count) const {
  if (!on_) return host::kNever;
  const std::int64_t number = count - total_base_ - 1;
  return micro_only_ ? call({number, 0}).at : full_cycle(full_base_ + number);
}

// The round in which this run of frames began would have begun then.
void AdcScan::find_round(Cycle at) {
  noted_stops_ = 0;
  first_period_ = full_base_ / kScanPeriod;
  first_slot_ = static_cast<int>(full_base_ % kScanPeriod);
  round_ = at + kScanStartCycles;
  if (!micro_only_ && first_slot_ > 0) round_ -= kRound.at[first_slot_ - 1];
}

/// Of the first call from `at` on.
inline AdcScan::Place AdcScan::place(Cycle at) const {
  if (micro_only_) return {at > round_ ? (at - round_ - 1) / kScanMicroFrameCycles : 0, 0};
  if (at <= round_) return {0, first_slot_};
  const std::uint64_t before = static_cast<std::uint64_t>(at - round_ - 1);  // the first call beyond this
  const std::uint64_t round = before / kScanRoundCycles;
  const Cycle rest = static_cast<Cycle>(before - round * kScanRoundCycles);
  Place p{static_cast<std::int64_t>(round), static_cast<int>(rest / kScanFrameCycles)};
  if (p.slot > 0 && kRound.at[p.slot - 1] > rest) --p.slot;
  if (kRound.at[p.slot] <= rest) p = after(p);
  if (p.round == 0 && p.slot < first_slot_) p.slot = first_slot_;
  return p;
}

Cycle AdcScan::cycles_before(Cycle at) const {
  if (!on_) return 0;
  const Place p = place(at);
  const Cycle more =
      number(p) / kMicSamples * kScanWrapCycles - std::max<std::int64_t>(0, uncounted(p)) * kScanTickCycles;
  if (micro_only_) return p.round * kScanMicroIsrCycles + more;
  return p.round * kRound.before[kScanPeriod] + kRound.before[p.slot] + more;
}

AdcScan::Call AdcScan::call(Place p) const {
  const Cycle more = (is_wrap(p) ? kScanWrapCycles : 0) - (uncounted(p) >= 0 ? kScanTickCycles : 0);
  if (micro_only_) return {round_ + (p.round + 1) * kScanMicroFrameCycles, kScanMicroIsrCycles + more};
  return {cycle_of(p), kRound.cycles[p.slot] + more};
}

AdcScan::Place AdcScan::after(Place p) const {
  if (micro_only_ || ++p.slot == kScanPeriod) p = {p.round + 1, 0};
  return p;
}

AdcScan::Call AdcScan::call_before(Place p) const {
  if (micro_only_) return p.round > 0 ? call({p.round - 1, 0}) : Call{};
  if (p.slot > (p.round > 0 ? 0 : first_slot_)) return call({p.round, p.slot - 1});
  return p.round > 0 ? call({p.round - 1, kScanPeriod - 1}) : Call{};
}

std::uint64_t AdcScan::share_q32() const {
  if (!on_) return 0;
  const Cycle cycles = micro_only_ ? kScanMicroIsrCycles : kRound.before[kScanPeriod];
  const Cycle of = micro_only_ ? kScanMicroFrameCycles : kScanRoundCycles;
  return (static_cast<std::uint64_t>(cycles) << 32) / static_cast<std::uint64_t>(of);
}

AdcScan::Call AdcScan::last_call(Cycle at) const { return on_ ? call_before(place(at)) : Call{}; }

Cycle AdcScan::next_call(Cycle at) const { return on_ ? call(place(at)).at : host::kNever; }

Cycle AdcScan::done(Cycle from, Cycle work) const {
  return on_ ? done(place(from), from + work) : from + work;
}

Cycle AdcScan::done(Place next, Cycle end) const {
  for (Call c = call(next); c.at < end; c = call(next)) {
    end += c.cycles;
    next = after(next);
  }
  return end;
}

Cycle AdcScan::served(Cycle asked, Cycle work) const {
  if (!on_) return asked + work;
  const Place next = place(asked);
  // calls are far apart: the usual one needs neither the length of the one before nor that of the next
  const bool apart =
      !micro_only_ && next.slot > 0 && asked - cycle_of({next.round, next.slot - 1}) > kLongestCall;
  const Cycle end = (apart ? asked : free_from(call_before(next), asked)) + work;
  return !micro_only_ && cycle_of(next) >= end ? end : done(next, end);
}

AdcScan::Delay AdcScan::next_delay(const AgendaTimer& ticks, Cycle until) const {
  Delay first{noted_stops_, until, 0};
  if (!on_ || micro_only_ || !ticks.is_running()) return first;
  // each kind of stop comes once a round, at a phase that it keeps
  for (int kind = 0; kind < kStops; ++kind) {
    std::int64_t round = (noted_stops_ - kind + kStops - 1) / kStops;
    if (kStopSlots[kind] < first_slot_) round = std::max<std::int64_t>(round, 1);
    const Cycle call = round_ + round * kScanRoundCycles + stop_at(kind);
    if (call >= first.at) continue;
    const Cycle since = ticks.since_tick(call);
    if (!ticks.may_delay(since)) continue;
    const AgendaTimer::Wait wait = ticks.first_wait(call, since, (first.at - 1 - call) / kScanRoundCycles);
    if (wait.cycles == 0) continue;
    first = {(round + wait.round) * kStops + kind + 1, call + wait.round * kScanRoundCycles, wait.cycles};
  }
  if (first.cycles == 0) first.stops = stops_before(until);
  return first;
}

AdcScan::Delay AdcScan::delay_at_exit(Cycle at) const {
  Delay delay{noted_stops_, at, 0};
  if (!on_ || micro_only_) return delay;
  delay.stops = stops_before(at);
  const int kind = static_cast<int>(delay.stops % kStops);
  const Cycle call = round_ + delay.stops / kStops * kScanRoundCycles + stop_at(kind);
  if (delay.stops < kStops && kStopSlots[kind] < first_slot_) return delay;
  if (call < at + kExitCycles) delay = {delay.stops + 1, call, at + kExitCycles - call};
  return delay;
}

std::int64_t AdcScan::stops_before(Cycle at) const {
  const Cycle since = at - round_;
  if (since <= stop_at(0)) return noted_stops_;
  const std::int64_t round = since / kScanRoundCycles;
  int kind = 0;
  while (kind < kStops && round * kScanRoundCycles + stop_at(kind) < since) ++kind;
  return round * kStops + kind;
}

Cycle AdcScan::first_fill(Cycle at) const {
  if (!on_ || micro_only_) return at;
  const std::int64_t have = acc_samples(at);
  const std::int64_t missing = (2 * kAccSamples - 1 - have % kAccSamples) % kAccSamples;
  if (missing == 0) return at;
  const Cycle filled = full_cycle(kScanPeriod * (have + missing - 1) + kScanAccSlot);
  return filled + kRound.cycles[kScanAccSlot];
}

/// Newest period whose interrupt in `slot` has come and that serves `pair`; a value below 0 if none.
std::int64_t AdcScan::newest(std::int64_t interrupts, int slot, int shift, int pair) const {
  if (interrupts <= slot) return -1;
  const std::int64_t period = (interrupts - 1 - slot) / kScanPeriod;
  const int ahead = (pair_of_lit(period + shift) - pair + pairs_) % pairs_;
  return period - ahead;
}

std::int64_t AdcScan::dark_number(int sensor, Cycle at) const {
  return newest(full_interrupts(at - kScanFileCycles), kScanDarkSlot, 1, pair_of_sensor(sensor));
}

std::int64_t AdcScan::lit_number(int sensor, Cycle at) const {
  return newest(full_interrupts(at - kScanFileCycles), kScanLitSlot, 0, pair_of_sensor(sensor));
}

int AdcScan::evaluate(int sensor, std::int64_t period, bool lit_sample) const {
  if (sensor >= kRingSensors) return 0;
  const std::int64_t interrupt = period * kScanPeriod + (lit_sample ? kScanLitSlot : kScanDarkSlot);
  const Cycle at = full_cycle(interrupt) - hold_to_end(sensor);
  // the LED was switched on at the dark interrupt of the period before; in the very first period nobody did
  const Cycle lit_for = lit_sample && period > 0 ? scan_flash_cycles(sensor) : -1;
  return board_.ir_counts(sensor, at, lit_for);
}

void AdcScan::keep(Sample& kept, int sensor, std::int64_t number, bool lit_sample) const {
  if (number < 0 || number == kept.number) return;
  kept.counts = evaluate(sensor, number, lit_sample);
  kept.number = number;
}

int AdcScan::read(Sample& kept, int sensor, Cycle at, bool lit_sample) {
  if (at < kept.until) return kept.counts;
  const std::int64_t filed = full_interrupts(at - kScanFileCycles);
  const int slot = lit_sample ? kScanLitSlot : kScanDarkSlot, shift = lit_sample ? 0 : 1;
  keep(kept, sensor, newest(filed, slot, shift, pair_of_sensor(sensor)), lit_sample);
  kept.until = next_sample(filed, slot, shift, pair_of_sensor(sensor));
  return kept.counts;
}

int AdcScan::dark(int sensor, Cycle at) {
  return read(dark_[static_cast<std::size_t>(sensor)], sensor, at, false);
}

int AdcScan::lit(int sensor, Cycle at) {
  return read(lit_[static_cast<std::size_t>(sensor)], sensor, at, true);
}

int AdcScan::peek_dark(int sensor, Cycle at) const {
  const Sample& kept = dark_[static_cast<std::size_t>(sensor)];
  const std::int64_t number = dark_number(sensor, at);
  return number < 0 || number == kept.number ? kept.counts : evaluate(sensor, number, false);
}

int AdcScan::peek_lit(int sensor, Cycle at) const {
  const Sample& kept = lit_[static_cast<std::size_t>(sensor)];
  const std::int64_t number = lit_number(sensor, at);
  return number < 0 || number == kept.number ? kept.counts : evaluate(sensor, number, true);
}

Cycle AdcScan::mic_hold(int microphone, std::int64_t number) const {
  Run run{total_base_, full_base_, round_, micro_only_};
  for (std::size_t i = runs_.size(); number < run.first && i-- > 0;) run = runs_[i];
  const std::int64_t frame = number - run.first;
  if (run.micro_only)
    return run.round + (frame + 1) * kScanMicroFrameCycles - hold_to_end(kMicroFrame, microphone);
  const std::int64_t from_round = run.full % kScanPeriod + frame;
  const int slot = static_cast<int>(from_round % kScanPeriod);
  return run.round + from_round / kScanPeriod * kScanRoundCycles + kRound.at[slot] -
         hold_to_end(frame_of(slot), microphone);
}

int AdcScan::mic_sample(int microphone, std::int64_t number) const {
  return board_.mic_counts(microphone, mic_hold(microphone, number));
}

Cycle AdcScan::next_sample(std::int64_t filed, int slot, int shift, int pair) const {
  if (!on_ || micro_only_) return host::kNever;
  // first period whose interrupt in this slot is still to come, then on to the one that serves the pair
  std::int64_t period = (filed + kScanPeriod - 1 - slot) / kScanPeriod;
  period += (pair - pair_of_lit(period + shift) + pairs_) % pairs_;
  return full_cycle(period * kScanPeriod + slot) + kScanFileCycles;
}

Cycle AdcScan::horizon(int sensor, Cycle at) {
  dark(sensor, at);
  lit(sensor, at);
  return std::min(dark_[static_cast<std::size_t>(sensor)].until,
                  lit_[static_cast<std::size_t>(sensor)].until);
}

void AdcScan::fill_acc(std::int64_t count) {
  // what the ring has lost again need not be known
  for (std::int64_t k = std::max(acc_kept_, count - kAccSamples); k < count; ++k) {
    const Cycle end = full_cycle(k * kScanPeriod + kScanAccSlot);
    for (int axis = 0; axis < 3; ++axis) {
      const Cycle hold = end - hold_to_end(frame_of(kScanAccSlot), 3 + axis);
      const auto other = board_.counts_of_others(kAccChannel + axis, hold);
      const int counts = other ? *other : accelerometer_counts(board_, axis, hold);
      acc_[static_cast<std::size_t>(axis)][static_cast<std::size_t>((k + 1) % kAccSamples)] =
          static_cast<std::int16_t>(counts);
    }
  }
  acc_kept_ = count;
}

const AdcScan::AccRing& AdcScan::acc_scan(Cycle at) {
  acc_used_ = true;
  fill_acc(acc_samples(at));
  return acc_;
}

Cycle AdcScan::acc_until(Cycle at) const {
  if (!on_ || micro_only_) return host::kNever;
  return full_cycle(kScanPeriod * acc_samples(at) + kScanAccSlot) + kScanFileCycles;
}

unsigned AdcScan::pulses(Cycle at) const {
  const std::int64_t count = full_interrupts(at - kScanLightCycles);
  if (count <= kScanDarkSlot) return 0;
  const std::int64_t last = count - 1;
  const int slot = static_cast<int>(last % kScanPeriod);
  const std::int64_t period = last / kScanPeriod;
  if (slot >= kScanDarkSlot) return 1u << pair_of_lit(period + 1);
  if (slot < kScanLitSlot) return 1u << pair_of_lit(period);
  return 0;
}

Cycle AdcScan::pulses_horizon(Cycle at) const {
  if (!on_ || micro_only_) return host::kNever;
  const std::int64_t count = full_interrupts(at - kScanLightCycles);
  const int slot = static_cast<int>(count % kScanPeriod);  // of the next interrupt
  const int wait = slot <= kScanLitSlot    ? kScanLitSlot - slot
                   : slot <= kScanDarkSlot ? kScanDarkSlot - slot
                                           : kScanPeriod - slot + kScanLitSlot;
  return full_cycle(count + wait) + kScanLightCycles;
}

}  // namespace board
