// SPDX-License-Identifier: MIT
#include "dspic30/core/waits.h"

#include <algorithm>

namespace dspic {

// one instruction, by its own function
void Waits::step(Cpu& cpu) {
  const Decoded* const d = cpu.at = cpu.next;  // a REPEAT moves `at` on
  const Decoded* following = Cpu::run_alone(cpu, d);
  cpu.now += d->cycles;
  if (d == cpu.loop_end) following = cpu.loop_back(d, following);
  cpu.next = following;
}

void Waits::go_on(Cpu& cpu) {
  if (state_ == State::Away) begin(cpu);
  if (state_ == State::Looking) look(cpu);
  if (state_ == State::Waiting) wait(cpu);
}

// --- looking

void Waits::begin(Cpu& cpu) {
  at_head_ = cpu.head_met;
  cpu.head_met = false;
  look_began_ = cpu.true_now();
  round_began_ = cpu.clocks.own_cycles(cpu.now);
  if (was_cut_) resumed_ = round_began_;
  cpu.looks_outside = cpu.reads_core = false;
  cpu.watched_until = kNever;
  if (const KnownWaits::Wait* known = cpu.known_waits.find(cpu)) return enter(cpu, known);
  const KnownWaits::Wait* const of_head = at_head_ ? cpu.known_waits.at(cpu.next) : nullptr;
  // what it waited for has come: the program goes on, and will come back
  if (of_head && !of_head->memory.are_as_read(cpu.ram.data())) {
    cpu.still_since = kNever;
    cpu.passes_head = true;
    was_cut_ = false;
    if (schedule(cpu).at <= look_began_) schedule(cpu).at = look_began_ + kRarestLooks;
    return;
  }
  // behind an interrupt it comes to the wait's first instruction by itself
  if (was_cut_ && cpu.has_heads()) {
    was_cut_ = false;
    schedule(cpu).at = look_began_ + kRarestLooks;
    return;
  }
  was_cut_ = false;
  state_ = State::Looking;
  chances_ = 2;
  begin_round(cpu);
}

void Waits::begin_round(Cpu& cpu) {
  round_.first = cpu.next;
  round_.state = CoreState(cpu);
  round_.memory.clear();
  round_began_ = cpu.clocks.own_cycles(cpu.now);
  steps_ = 0;
  cpu.looks_outside = cpu.reads_core = false;
  cpu.watched_until = kNever;
}

// a round or two; where the time is up it goes on from there the next time
void Waits::look(Cpu& cpu) {
  const Cycle end = cpu.deadline;
  cpu.watch_round(&round_.memory);
  while (cpu.now < end && state_ == State::Looking) {
    step(cpu);
    ++steps_;
    if (cpu.deadline != end || cpu.watched_until <= cpu.true_now())
      fail(cpu);
    else if (cpu.next == round_.first)
      is_proven(cpu);
    else if (steps_ == kLongestRound)
      fail(cpu);
  }
  cpu.watch_round(nullptr);
}

bool Waits::is_proven(Cpu& cpu) {
  round_.took = cpu.clocks.own_cycles(cpu.now) - round_began_;
  if (round_.memory.is_whole() && round_.state.is_of(cpu) && round_.memory.are_as_read(cpu.ram.data())) {
    round_.memory.take_written(cpu.ram.data());
    if (cpu.watched_until == kNever && !cpu.looks_outside && !cpu.reads_core)
      cpu.known_waits.add(cpu, round_);
    cpu.mark_head(round_.first);
    enter(cpu, &round_);
    return true;
  }
  if (const KnownWaits::Wait* known = cpu.known_waits.find(cpu)) {
    enter(cpu, known);
    return true;
  }
  if (round_.memory.is_whole() && --chances_ > 0)
    begin_round(cpu);
  else
    fail(cpu);
  return false;
}

void Waits::fail(Cpu& cpu) {
  state_ = State::Away;
  cpu.still_since = kNever;
  const Cycle now = cpu.true_now();
  if (at_head_) {
    cpu.heads_from = now + head_pause_;
    head_pause_ = std::min(2 * head_pause_, kRarestLooks);
  }
  Schedule& next = schedule(cpu);
  if (next.at > now) return;
  next.at = now + next.between;
  next.between = std::min(2 * next.between, kRarestLooks);
}

// --- waiting

void Waits::enter(Cpu& cpu, const KnownWaits::Wait* wait) {
  state_ = State::Waiting;
  was_cut_ = false;
  wait_ = wait;
  until_ = cpu.watched_until;
  entered_ = round_began_;  // the round that proved it was one of it
  // ... and so was the rest of the one that an interrupt had come into
  if (resumed_ >= 0 && cut_ == wait->first && entered_ - resumed_ <= wait->took) entered_ = resumed_;
  resumed_ = -1;
  head_pause_ = kFirstPause;
  cpu.heads_from = 0;
  schedule(cpu).between = kFirstLooks;
  cpu.still_since = until_ == kNever && !cpu.looks_outside ? std::min(cpu.still_since, look_began_) : kNever;
  cpu.still_reads = wait->memory.reads() || cpu.reads_core;
}

void Waits::wait(Cpu& cpu) {
  const Cycle end = std::min(cpu.deadline, cpu.clocks.program_at(until_));
  while (cpu.now < end && cpu.next != wait_->first) step(cpu);  // the rest of a round
  if (const Cycle rounds = std::max<Cycle>(end - cpu.now, 0) / wait_->took; rounds > 0) {
    wait_->memory.put_written(cpu.ram.data());
    cpu.now += rounds * wait_->took;
    jumped_ += rounds * wait_->took;
  }
  while (cpu.now < end) step(cpu);
  if (cpu.true_now() < until_) return;
  leave(cpu);
  schedule(cpu).at = cpu.true_now();  // perhaps it goes on
}

void Waits::leave(Cpu& cpu) {
  waited_ += cpu.clocks.own_cycles(cpu.now) - entered_;
  state_ = State::Away;
}

void Waits::cut(Cpu& cpu) {
  const bool waits = is_waiting();
  if (waits) {
    cut_ = wait_->first;
    leave(cpu);
  }
  if (waits || state_ == State::Looking) schedule(cpu).at = 0;
  was_cut_ = was_cut_ || waits;
  state_ = State::Away;
  cpu.head_met = false;
  // handlers seldom wait, so they may work on for a while first
  schedules_[1] = {cpu.true_now() + kFirstLooks, kFirstLooks};
}

void Waits::stir(Cpu& cpu) {
  if (is_waiting()) leave(cpu);
  state_ = State::Away;
  schedule(cpu).at = 0;
}

void Waits::forget(Cpu& cpu) {
  if (is_waiting()) leave(cpu);
  state_ = State::Away;
  was_cut_ = at_head_ = false;
  resumed_ = -1;
  for (Schedule& s : schedules_) s = {cpu.now + kFirstLooks, kFirstLooks};
}

}  // namespace dspic
