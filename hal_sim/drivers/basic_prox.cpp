// SPDX-License-Identifier: MIT
// See basic_prox.h.
#include "hal_sim/drivers/basic_prox.h"

#include "hal_sim/board/board.h"

namespace drivers {

using namespace board;

namespace {
constexpr Cycle kPairCycles = kBasicPulseCycles + kBasicRestCycles;
constexpr int kEventsPerRound = 8;
/// Cycles from an interrupt to the moment its LED is switched: both conversions come first.
constexpr Cycle kSwitchCycles = kBasicIsrEntryCycles + 2 * kReadAdCycles;
}  // namespace

void BasicProx::settle(Cycle at) {
  if (!on_) return;
  for (int sensor = 0; sensor < kRingSensors; ++sensor) {
    ambient(sensor, at);
    reflected(sensor, at);
  }
  base_ = events(at);
}

void BasicProx::start(Cycle at) {
  settle(at);
  started_ = at;
  on_ = true;
}

void BasicProx::stop(Cycle at) { hold(at); }

void BasicProx::hold(Cycle at) {
  if (!on_) return;
  const Cycle next = horizon(at);
  settle(at);
  left_ = next - at;
  on_ = false;
}

void BasicProx::release(Cycle at) {
  if (on_ || left_ == 0) return;
  started_ = at + left_ - kBasicPulseCycles;
  on_ = true;
}

void BasicProx::reset(Cycle at) {
  settle(at);
  on_ = false;
  left_ = 0;
  base_ = 0;
  dark_.fill(Sample{});
  reflected_.fill(Sample{});
}

std::int64_t BasicProx::events(Cycle at) const {
  if (!on_) return base_;
  const Cycle since = at - (started_ + kBasicPulseCycles) + span(base_);
  if (since < span(base_)) return base_;
  return since / kPairCycles * 2 + (since % kPairCycles >= kBasicPulseCycles ? 1 : 0) + 1;
}

std::int64_t BasicProx::newest(std::int64_t events, int sensor, int phase) {
  const int wanted = 2 * (sensor & 3) + phase;
  const std::int64_t last = events - 1;
  return last - ((last - wanted) % kEventsPerRound + kEventsPerRound) % kEventsPerRound;
}

int BasicProx::evaluate(int sensor, std::int64_t event) const {
  const Cycle interrupt = event_cycle(event);
  const Cycle at = interrupt + kBasicIsrEntryCycles + kReadAdSampleCycles + (sensor >= 4 ? kReadAdCycles : 0);
  const Cycle lit_for = event % 2 == 1 ? at - (interrupt - kBasicPulseCycles + kSwitchCycles) : -1;
  return board_.ir_counts(sensor, at, lit_for);
}

int BasicProx::evaluate_reflected(int sensor, std::int64_t event) const {
  const Sample& kept = dark_[static_cast<std::size_t>(sensor)];
  const int dark = kept.event == event - 1 ? kept.counts : evaluate(sensor, event - 1);
  return dark - evaluate(sensor, event);
}

int BasicProx::ambient(int sensor, Cycle at) {
  Sample& kept = dark_[static_cast<std::size_t>(sensor)];
  const std::int64_t event = newest(events(at), sensor, 0);
  if (event >= 0 && event != kept.event) {
    if (on_ && event >= base_) kept = {event, evaluate(sensor, event)};
  }
  return kept.counts;
}

int BasicProx::reflected(int sensor, Cycle at) {
  Sample& kept = reflected_[static_cast<std::size_t>(sensor)];
  const std::int64_t event = newest(events(at), sensor, 1);
  if (event >= 0 && event != kept.event && on_ && event >= base_)
    kept = {event, evaluate_reflected(sensor, event)};
  return kept.counts;
}

int BasicProx::peek_reflected(int sensor, Cycle at) const {
  const Sample& kept = reflected_[static_cast<std::size_t>(sensor)];
  const std::int64_t event = newest(events(at), sensor, 1);
  if (event < 0 || event == kept.event || !on_ || event < base_) return kept.counts;
  return evaluate_reflected(sensor, event);
}

Cycle BasicProx::horizon(Cycle at) const { return on_ ? event_cycle(events(at)) : kNever; }

unsigned BasicProx::pulses(Cycle at) const {
  const std::int64_t count = events(at);
  return on_ && count % 2 == 1 ? 1u << (count / 2 % 4) : 0u;
}

}  // namespace drivers
