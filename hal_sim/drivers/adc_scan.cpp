// SPDX-License-Identifier: MIT
// See adc_scan.h. Interrupts of ALL_ADC mode are numbered from 0; number i has slot i % 65 and period i / 65.
// In period q the lit sample of pair_of_lit(q) arrives, and the dark one of pair_of_lit(q + 1).
#include "hal_sim/drivers/adc_scan.h"

#include <algorithm>
#include <utility>

#include "hal_sim/board/analogue_inputs.h"

namespace drivers {

using namespace board;

namespace {
/// `pair` of a sensor: 0 and 4 share an emitter line, and so on; 8 and 9 are the turret's.
int pair_of_sensor(int sensor) { return sensor >= 8 ? 4 : sensor & 3; }

/// A frame's channels and converter clock, cycles.
struct Frame {
  int channels;
  Cycle tad;
};
constexpr Frame frame_of(int slot) {
  if (slot == kScanLitSlot || slot == kScanDarkSlot) return {5, kScanTadCycles};
  if (slot == kScanAccSlot) return {6, kScanTadCycles6};
  return {3, kScanTadCycles3};
}
constexpr Cycle kInTime = 150;  // more than agendas take that set a flag
constexpr Frame kMicroFrame{3, kScanTadCycles6};
/// Cycles from a channel's hold instant to the end of its frame.
constexpr Cycle hold_to_end(Frame f, int channel) {
  return ((f.channels - channel) * kScanChannelTad - 1) * f.tad + kScanFlagCycles;
}
constexpr Cycle hold_to_end(int sensor) {
  return hold_to_end(frame_of(kScanLitSlot), sensor < 4 ? 3 : sensor < 8 ? 4 : 9 - sensor);
}
// converter clocks of scans of 3, 5 and 6 channels give sequences of one length
static_assert(3 * kScanChannelTad * kScanTadCycles3 == kScanSequenceCycles);
static_assert(6 * kScanChannelTad * kScanTadCycles6 == kScanSequenceCycles);
static_assert(3 * kScanChannelTad * kScanTadCycles6 == kScanMicroFrameCycles);
static_assert(5 * kScanChannelTad * kScanTadCycles == kScanSequenceCycles);
static_assert(hold_to_end(frame_of(kScanLitSlot), 3) == 349);

}  // namespace

Cycle scan_flash_cycles(int sensor) { return kScanFlashCycles - kScanLightCycles - hold_to_end(sensor); }

AdcScan::AdcScan(const AnalogueInputs& inputs) : ir_(inputs.ir()), inputs_(inputs) {}

void AdcScan::settle(Cycle at) {
  // samples so far must not depend on frame times that are about to be forgotten
  for (int sensor = 0; sensor < kRingSensors; ++sensor) {
    const auto i = static_cast<std::size_t>(sensor);
    const std::int64_t count = clock_.full_interrupts(at);
    keep(dark_[i], sensor, newest(count, kScanDarkSlot, 1, pair_of_sensor(sensor)), false);
    keep(lit_[i], sensor, newest(count, kScanLitSlot, 0, pair_of_sensor(sensor)), true);
  }
  fill_acc(ScanClock::acc_samples_of(clock_.full_interrupts(at)));
  const std::int64_t passed = clock_.frames(at);
  if (passed > 0) {
    runs_.push_back(clock_.run);
    while (runs_.size() > 1 && runs_[1].first <= clock_.run.first + passed - kMicSamples)
      runs_.erase(runs_.begin());
  }
  clock_.run = {clock_.run.first + passed, clock_.full_interrupts(at), at + kScanStartCycles,
                clock_.run.micro_only, clock_.run.round};
  for (Samples* samples : {&dark_, &lit_})
    for (Sample& s : *samples) s.until = 0, s.is_regular = false;
  regular_dark_ = 0;
}

void AdcScan::start(bool micro_only, bool five_pairs, Cycle at) {
  settle(at);
  const std::int64_t period = (clock_.run.full + kScanPeriod - 1 - kScanLitSlot) / kScanPeriod;
  pair_base_ = pair_of_lit(period);
  period_base_ = period;
  pairs_ = five_pairs ? 5 : 4;
  pair_base_ %= pairs_;
  clock_.run.micro_only = micro_only;
  clock_.run.round = micro_only ? kScanPeriod * kScanMicroFrameCycles : clock_.full_round;
  clock_.is_on = true;
  ++starts_;
}

// the frame under way keeps its end
void AdcScan::set_round(Cycle round, Cycle at) {
  if (round == clock_.full_round) return;
  clock_.full_round = round;
  if (clock_.run.micro_only) return;
  if (clock_.is_on) {
    const Cycle end = clock_.run.cycle_of(clock_.run.first + clock_.frames(at));
    settle(at);
    clock_.run.origin = end - clock_.run.sequence();
  }
  clock_.run.round = round;
}

// The converter goes on meanwhile without a stop and sets the flag, which remembers one call. That call comes
// now and begins a new sequence. One that is hardly late is taken to be in time: all samples are looked at
// otherwise, too often beside agendas.
void AdcScan::release(Cycle at) {
  const Cycle since = std::exchange(clock_.held_since, -1);
  if (since < 0 || !clock_.is_on) return;
  const Cycle first = clock_.run.cycle_of(clock_.run.first + clock_.frames(since));
  if (at - first < kInTime) return;
  settle(since);
  clock_.run.origin = at - clock_.run.sequence();
}

void AdcScan::switch_converter(bool on, Cycle at) {
  if (on == clock_.is_on) return;
  settle(at);
  clock_.is_on = on;
}

void AdcScan::reset(Cycle at) {
  settle(at);
  runs_.clear();
  acc_kept_ = 0;
  acc_used_ = false;
  acc_.reset();
  clock_.is_on = false;
  clock_.held_since = -1;
  starts_ = 0;
  pairs_ = 4;
  period_base_ = 0;
  pair_base_ = 0;
  clock_.run = ScanClock::Run{};
  clock_.run.round = clock_.full_round;
  dark_.fill(Sample{});
  lit_.fill(Sample{});
  regular_dark_ = 0;
}

int AdcScan::pair_of_lit(std::int64_t period) const {
  return static_cast<int>((pair_base_ + (period - period_base_) % pairs_ + pairs_) % pairs_);
}

Cycle AdcScan::first_fill(Cycle at) const {
  if (!clock_.is_on || clock_.run.micro_only) return at;
  const std::int64_t have = clock_.acc_samples(at);
  const std::int64_t missing = (2 * kAccSamples - 1 - have % kAccSamples) % kAccSamples;
  if (missing == 0) return at;
  if (clock_.held_since >= 0) return kNever;  // no handler comes by itself that would fill it
  return clock_.full_cycle(kScanPeriod * (have + missing - 1) + kScanAccSlot) + kScanAccIsrCycles;
}

/// Newest period whose interrupt in `slot` has come and that serves `pair`; a value below 0 if none.
std::int64_t AdcScan::newest(std::int64_t interrupts, int slot, int shift, int pair) const {
  if (interrupts <= slot) return -1;
  const std::int64_t period = (interrupts - 1 - slot) / kScanPeriod;
  const int ahead = (pair_of_lit(period + shift) - pair + pairs_) % pairs_;
  return period - ahead;
}

std::int64_t AdcScan::dark_number(int sensor, Cycle at) const {
  return newest(clock_.full_interrupts(at - kScanFileCycles), kScanDarkSlot, 1, pair_of_sensor(sensor));
}

std::int64_t AdcScan::lit_number(int sensor, Cycle at) const {
  return newest(clock_.full_interrupts(at - kScanFileCycles), kScanLitSlot, 0, pair_of_sensor(sensor));
}

int AdcScan::evaluate(int sensor, std::int64_t period, bool lit_sample) const {
  if (sensor >= kRingSensors) return 0;
  const std::int64_t interrupt = period * kScanPeriod + (lit_sample ? kScanLitSlot : kScanDarkSlot);
  const Cycle at = clock_.full_cycle(interrupt) - hold_to_end(sensor);
  // the LED was switched on at the dark interrupt of the period before; in the very first period nobody did
  const Cycle lit_for = lit_sample && period > 0 ? scan_flash_cycles(sensor) : -1;
  return ir_.counts(sensor, at, lit_for);
}

void AdcScan::keep(Sample& kept, int sensor, std::int64_t number, bool lit_sample) const {
  if (number < 0 || number == kept.number) return;
  kept.counts = static_cast<std::int16_t>(evaluate(sensor, number, lit_sample));
  kept.number = static_cast<std::int32_t>(number);
}

/// On to the newest sample at `at` of one that is regular and over. Returns when it was held.
inline Cycle AdcScan::turn_to(Sample& kept, int sensor, Cycle at) const {
  // whole turns take whole cycles: the new sample's frame ends a turn before the next one's
  const Cycle turn = pairs_ * clock_.run.round;
  const std::int64_t turns = 1 + quotient(at - kept.until, turn);
  kept.until += turns * turn;
  kept.number += static_cast<std::int32_t>(turns * pairs_);
  return kept.until - turn - kScanFileCycles - hold_to_end(sensor);
}

inline int AdcScan::read(Sample& kept, int sensor, Cycle at, bool lit_sample) {
  if (at < kept.until) return kept.counts;
  if (!kept.is_regular || clock_.held_since >= 0) return read_anew(kept, sensor, at, lit_sample);
  const Cycle held = turn_to(kept, sensor, at);
  if (sensor >= kRingSensors) return kept.counts;
  kept.counts =
      static_cast<std::int16_t>(ir_.counts(sensor, held, lit_sample ? scan_flash_cycles(sensor) : -1));
  return kept.counts;
}

int AdcScan::read_anew(Sample& kept, int sensor, Cycle at, bool lit_sample) {
  const std::int64_t filed = clock_.full_interrupts(at - kScanFileCycles);
  const int slot = lit_sample ? kScanLitSlot : kScanDarkSlot, shift = lit_sample ? 0 : 1;
  const std::int64_t number = newest(filed, slot, shift, pair_of_sensor(sensor));
  keep(kept, sensor, number, lit_sample);
  // a pair's turn comes round every so many periods; before its first time it has to be looked for
  kept.is_regular = number >= 0 && number >= period_base_ && clock_.is_on && !clock_.run.micro_only;
  kept.until = kept.is_regular ? clock_.full_cycle((number + pairs_) * kScanPeriod + slot) + kScanFileCycles
                               : next_sample(filed, slot, shift, pair_of_sensor(sensor));
  return kept.counts;
}

// in darkness, once there is a dark sample, the others are the same
bool AdcScan::stays_dark(int sensor) const {
  return (regular_dark_ >> sensor & 1) && clock_.held_since < 0 && sensor < kRingSensors && ir_.is_dark();
}

int AdcScan::dark(int sensor, Cycle at) {
  if (stays_dark(sensor)) return kAdcMax;
  Sample& kept = dark_[static_cast<std::size_t>(sensor)];
  const int counts = read(kept, sensor, at, false);
  const auto bit = static_cast<std::uint16_t>(1 << sensor);
  regular_dark_ = static_cast<std::uint16_t>(kept.is_regular ? regular_dark_ | bit : regular_dark_ & ~bit);
  return counts;
}

int AdcScan::both_read(int sensor, Cycle dark_at, Cycle lit_at) {
  const int dark = this->dark(sensor, dark_at);
  return dark - lit(sensor, lit_at);
}

int AdcScan::lit(int sensor, Cycle at) {
  return read(lit_[static_cast<std::size_t>(sensor)], sensor, at, true);
}

int AdcScan::dark_less_lit(int sensor, Cycle dark_at, Cycle lit_at) {
  if (!stays_dark(sensor)) return both_read(sensor, dark_at, lit_at);
  Sample& kept = lit_[static_cast<std::size_t>(sensor)];
  if (lit_at >= kept.until) {
    if (!kept.is_regular) return kAdcMax - read_anew(kept, sensor, lit_at, true);
    const Cycle held = turn_to(kept, sensor, lit_at);
    kept.counts = static_cast<std::int16_t>(ir_.counts_in_dark(sensor, held, scan_flash_cycles(sensor)));
  }
  return kAdcMax - kept.counts;
}

AdcScan::Pair AdcScan::pair(int sensor, Cycle at) {
  const int lit = this->lit(sensor, at);
  const Cycle until = lit_[static_cast<std::size_t>(sensor)].until;
  if (stays_dark(sensor)) return {kAdcMax, lit, until};
  const int dark = this->dark(sensor, at);
  return {dark, lit, std::min(until, dark_[static_cast<std::size_t>(sensor)].until)};
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
  ScanClock::Run run = clock_.run;
  for (std::size_t i = runs_.size(); number < run.first && i-- > 0;) run = runs_[i];
  const int slot = static_cast<int>((run.full + number - run.first) % kScanPeriod);
  return run.cycle_of(number) - hold_to_end(run.micro_only ? kMicroFrame : frame_of(slot), microphone);
}

int AdcScan::mic_sample(int microphone, std::int64_t number) const {
  return inputs_.ears().counts(microphone, mic_hold(microphone, number));
}

Cycle AdcScan::next_sample(std::int64_t filed, int slot, int shift, int pair) const {
  if (!clock_.is_on || clock_.run.micro_only) return kNever;
  // first period whose interrupt in this slot is still to come, then on to the one that serves the pair
  std::int64_t period = (filed + kScanPeriod - 1 - slot) / kScanPeriod;
  period += (pair - pair_of_lit(period + shift) + pairs_) % pairs_;
  return clock_.full_cycle(period * kScanPeriod + slot) + kScanFileCycles;
}

int AdcScan::evaluate_acc(int axis, std::int64_t sample) const {
  const Cycle end = clock_.full_cycle(sample * kScanPeriod + kScanAccSlot);
  const Cycle hold = end - hold_to_end(frame_of(kScanAccSlot), 3 + axis);
  return inputs_.counts(kAccChannel + axis, hold);
}

void AdcScan::fill_acc(std::int64_t count) {
  if (!acc_ && count > acc_kept_) acc_ = std::make_unique<AccRing>();
  // what the ring has lost again need not be known
  for (std::int64_t k = std::max(acc_kept_, count - kAccSamples); k < count; ++k)
    for (int axis = 0; axis < 3; ++axis)
      (*acc_)[static_cast<std::size_t>(axis)][static_cast<std::size_t>((k + 1) % kAccSamples)] =
          static_cast<std::int16_t>(evaluate_acc(axis, k));
  acc_kept_ = count;
}

int AdcScan::peek_acc(int axis, int index, Cycle at) const {
  const std::int64_t count = clock_.acc_samples(at), newest = count - 1;
  // the newest sample of that index
  const std::int64_t ago = ((newest + 1 - index) % kAccSamples + kAccSamples) % kAccSamples;
  const std::int64_t sample = newest - ago;
  if (sample < 0) return 0;
  if (sample < acc_kept_) return (*acc_)[static_cast<std::size_t>(axis)][static_cast<std::size_t>(index)];
  return evaluate_acc(axis, sample);
}

const AdcScan::AccRing& AdcScan::acc_scan(Cycle at) {
  acc_used_ = true;
  fill_acc(clock_.acc_samples(at));
  if (!acc_) acc_ = std::make_unique<AccRing>();
  return *acc_;
}

Cycle AdcScan::acc_until(Cycle at) const {
  if (!clock_.is_on || clock_.run.micro_only) return kNever;
  return clock_.full_cycle(kScanPeriod * clock_.acc_samples(at) + kScanAccSlot) + kScanFileCycles;
}

unsigned AdcScan::pulses(Cycle at) const {
  const std::int64_t count = clock_.full_interrupts(at - kScanLightCycles);
  if (count <= kScanDarkSlot) return 0;
  const std::int64_t last = count - 1;
  const int slot = static_cast<int>(last % kScanPeriod);
  const std::int64_t period = last / kScanPeriod;
  if (slot >= kScanDarkSlot) return 1u << pair_of_lit(period + 1);
  if (slot < kScanLitSlot) return 1u << pair_of_lit(period);
  return 0;
}

Cycle AdcScan::pulses_horizon(Cycle at) const {
  if (!clock_.is_on || clock_.run.micro_only) return kNever;
  const std::int64_t count = clock_.full_interrupts(at - kScanLightCycles);
  const int slot = static_cast<int>(count % kScanPeriod);  // of the next interrupt
  const int wait = slot <= kScanLitSlot    ? kScanLitSlot - slot
                   : slot <= kScanDarkSlot ? kScanDarkSlot - slot
                                           : kScanPeriod - slot + kScanLitSlot;
  return clock_.full_cycle(count + wait) + kScanLightCycles;
}

}  // namespace drivers
