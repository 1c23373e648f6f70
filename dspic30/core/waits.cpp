// SPDX-License-Identifier: MIT
#include "dspic30/core/waits.h"

#include <algorithm>
#include <utility>

#include "dspic30/core/host_handlers.h"

namespace dspic {

// one instruction, by its own function, or the rest of a REPEAT that the last window cut
__attribute__((always_inline)) inline void Waits::step(Cpu& cpu) {
  if (cpu.repeating) {
    cpu.next = cpu.run_repeated(cpu.next);
    return;
  }
  const Decoded* const d = cpu.at = cpu.next;  // a REPEAT moves `at` on
  const Decoded* following = Cpu::run_one(cpu, d);
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
  if (expected_.at < kNever && has_left(cpu)) return;
  at_head_ = cpu.heads.is_met;
  look_head_ = cpu.next;
  cpu.heads.is_met = false;
  look_began_ = cpu.true_now();
  look_began_own_ = cpu.clocks.own_cycles(cpu.now);
  note_look(cpu);
  // a function of the host that waits is none of these
  if (stands_in_host(cpu)) {
    schedule(cpu).at = std::max(cpu.stands_until, look_began_ + 1);
    return;
  }
  is_turned_ = at_head_;
  begin_here(cpu);
}

// A loop that counts was cut, perhaps by what it waits for: behind it another wait may come that is not known yet.
void Waits::expect_head(const Cpu& cpu) {
  const Cut& cut = cut_of(cpu);
  if (!cut.head || !cut.counts || level(cpu) > 0) return;
  constexpr Cycle kMore = 2;  // the branch that ends a round takes longer
  Cycle& look = schedule(cpu).at;
  const bool is_asked = expected_.at < kNever;
  const Cycle at = cut.resumed_at + cut.took + kMore;
  if (look <= at && !is_asked) return;
  expected_ = {cut.head, at, is_asked ? expected_.look_if_back : look};
  look = at;
}

/// Did nothing bring this look but that the program has left that loop? Then one is due soon.
bool Waits::has_left(Cpu& cpu) {
  const Cycle at = std::exchange(expected_.at, kNever);
  Cycle& look = schedule(cpu).at;
  if (cpu.heads.is_met) look = expected_.look_if_back;
  if (look != at) return false;
  look = look_behind(cpu, expected_.head, at);
  return true;
}

/// A round begins here.
void Waits::begin_here(Cpu& cpu) {
  state_ = State::Away;
  note_round(cpu);
  // What is known to wait or to count from here on needs no look.
  if (const KnownWaits::Wait* known = cpu.known_waits.find(cpu)) return enter(cpu, known);
  if (const Count* known = cpu.known_counts.at(cpu.next); known && known->is_plain(cpu)) {
    const Cycle rounds = known->rounds_from(cpu);
    if (rounds >= kFewestRounds || (rounds > 1 && is_rest(cpu, known->round())))
      return enter_count(cpu, known, rounds);
    if (is_passed(cpu, *known, rounds)) return;
    if (known->is_over(cpu) && is_passed(cpu, known->round(), look_began_)) return;
  }
  // The round may be one of a known wait, its registers apart.
  comes_round_ = nullptr;
  if (const KnownWaits::Wait* const of_head = cpu.known_waits.at(cpu.next)) {
    if (of_head->memory.are_as_read(cpu.ram.data())) {
      comes_round_ = of_head;
      left_ = of_head->took;
    } else {
      at_head_ = true;
      look_head_ = cpu.next;
      if (is_passed(cpu, *of_head, look_began_)) return;
    }
  }
  state_ = State::Looking;
  chances_ = 2;
  again_ = 0;
  if (!comes_round_) begin_round(cpu);
}

// Looks of the program that no known wait has brought come more and more seldom, but often enough to find the
// rest. One that is due is put off wherever the program comes to a known head first; where it always does, it
// needs none.
void Waits::note_look(const Cpu& cpu) {
  if (cpu.parts.interrupts.cpu().nesting() > 0 || look_began_ < look_by_ ||
      (at_head_ && ++put_off_ < kMostPutOff))
    return;
  put_off_ = 0;
  ++looks_beside_;
  look_by_ = look_began_ + look_gap_;
  look_gap_ = std::min(look_gap_ + look_gap_ / 2, kMostGap);
}

// a loop that counts is soon over, or comes to where its flags change: it goes on for so long.
// False: it does so still
bool Waits::is_passed(Cpu& cpu, const Count& count, Cycle rounds) {
  if (rounds < 0 || was_passed(count.round(), kFewestRounds + 4)) return false;
  const Cycle pause = (rounds + 2) * count.round().took;
  pass(cpu, count.round(), pause);
  cpu.heads.hold(count.round().first, round_began_at_ + pause);
  return true;
}

// what it waited for has come: the program goes on, and will come back. Where it is back at once, and again,
// it waits for more; once may be the rest of the round that an interrupt came into
bool Waits::is_passed(Cpu& cpu, const KnownWaits::Wait& wait, Cycle now) {
  if (!at_head_ || (passes_ > 1 && was_passed(wait, 2))) return false;
  pass(cpu, wait, kRarestLooks);
  schedule(cpu).at = look_behind(cpu, wait.first, now);
  return true;
}

bool Waits::passes(Cpu& cpu, const Decoded* head) {
  const KnownWaits::Wait* const wait = cpu.known_waits.at(head);
  if (!wait || wait->memory.are_as_read(cpu.ram.data()) || cpu.known_counts.at(head)) return false;
  at_head_ = true;
  look_began_ = cpu.true_now();
  round_began_ = cpu.clocks.own_cycles(cpu.now);
  if (!is_passed(cpu, *wait, look_began_)) return false;
  note_look(cpu);
  cpu.heads.passes = false;
  if (const Cycle at = schedule(cpu).at; at < cpu.pause_at) {
    cpu.pause_at = at;
    cpu.deadline = std::min(cpu.deadline, cpu.clocks.program_at(at));
  }
  return true;
}

// At a known head the program will stop by itself. Now and then it looks elsewhere all the same: soon behind
// a wait, where another may come that is not known yet, and by look_by_.
Cycle Waits::look_behind(Cpu& cpu, const Decoded* head, Cycle now) {
  const Cycle later = look_beside_heads(cpu, now);
  if (cpu.parts.interrupts.cpu().nesting() > 0) return later;
  const unsigned n = cpu.heads.count_end(head);
  const bool is_due = n < kStepsBehind || (n & (n - 1)) == 0;
  return is_due ? now + kFirstBehind + kStepBehind * (n % kStepsBehind) : later;
}

/// How long behind something a look comes, each time after another while, up to 40 cycles doubled so often.
Cycle Waits::soon(unsigned look, unsigned doublings) {
  constexpr unsigned kMix = 0x9E3779B1u, kByte = 24;  // evenly, whatever the rhythm
  const Cycle first = kFirstBehind << look % doublings;
  return first + (first * (look * kMix >> kByte) >> 8);
}

Cycle Waits::look_beside_heads(const Cpu& cpu, Cycle now) const {
  return cpu.parts.interrupts.cpu().nesting() > 0
             ? now + kRarestLooks
             : std::clamp(look_by_, now + soon(looks_beside_ + put_off_, kBesideDoublings),
                          now + kRarestLooks);
}

// a loop may have two heads, and come to them in turn
bool Waits::was_passed(const KnownWaits::Wait& wait, Cycle rounds) const {
  for (const Passed& passed : passed_)
    if (passed.wait == &wait) return round_began_ - passed.at <= rounds * wait.took;
  return false;
}

void Waits::pass(Cpu& cpu, const KnownWaits::Wait& wait, Cycle look_in) {
  passes_ = was_passed(wait, 2) ? passes_ + 1 : 1;
  if (passed_[0].wait != &wait) passed_[1] = passed_[0];
  passed_[0] = {&wait, round_began_};
  cpu.still_since = kNever;
  cpu.heads.passes = at_head_;
  if (schedule(cpu).at <= look_began_) schedule(cpu).at = look_began_ + look_in;
}

void Waits::note_round(Cpu& cpu) {
  round_began_ = cpu.clocks.own_cycles(cpu.now);
  round_began_at_ = cpu.true_now();
  round_delayed_ = cpu.delayed;
  cpu.looks_outside = cpu.reads_core = false;
  cpu.watched_until = kNever;
}

void Waits::begin_round(Cpu& cpu) {
  if (!probe_) probe_ = std::make_unique<Probe>();
  KnownWaits::Wait& round = probe_->round;
  round.first = cpu.next;
  round.state = CoreState(cpu);
  round.registers = 0;
  round.memory.clear();
  note_round(cpu);
  cpu.dc |= kNotSet;
  outermost_ = cpu.w[15];
  steps_ = 0;
  probe_->trace.clear();
  behind_ = {};
}

// What a known wait reads of RAM is as it was, but what the program did before has left other values in
// registers: a round sets those that it uses. Where the time is up it goes on from there the next time.
void Waits::come_round(Cpu& cpu) {
  const Cycle end = cpu.deadline;
  while (left_ > 0 && cpu.now < end) {
    const Cycle before = cpu.now;
    step(cpu);
    left_ -= cpu.now - before;
    if (cpu.deadline == end) continue;
    if (cpu.is_code_stale()) return;
    comes_round_ = nullptr;
    return fail(cpu);
  }
  if (left_ > 0) return;
  const bool is_back = cpu.next == comes_round_->first;
  comes_round_ = nullptr;
  if (const KnownWaits::Wait* const known = is_back ? cpu.known_waits.find(cpu) : nullptr)
    return enter(cpu, known);
  begin_round(cpu);
}

// a round or two; where the time is up it goes on from there the next time
void Waits::look(Cpu& cpu) {
  if (comes_round_) {
    come_round(cpu);
    if (comes_round_ || state_ != State::Looking) return;
  }
  const Cycle end = cpu.deadline;
  // Step by step, while what the round reads and writes is noted.
  KnownWaits::Wait& round = probe_->round;
  std::vector<CountStep>& trace = probe_->trace;
  cpu.watch_round(&round.memory);
  while (cpu.now < end && state_ == State::Looking) {
    const Decoded* const d = cpu.next;
    if (!cpu.repeating) {
      round.memory.begin_step();
      ++steps_;
    }
    const bool goes_on = cpu.repeating;
    step(cpu);
    round.registers |= cpu.table().touched_by(d);
    if (chances_ == 1 && !goes_on) {
      if (trace.empty()) trace.reserve(kUsualRound);
      trace.push_back({d, cpu.n, round.memory.touched()});
    }
    // It goes on in other words, once they are chosen; else something else is due.
    if (cpu.deadline != end) {
      if (!cpu.is_code_stale()) fail(cpu);
      break;
    }
    if (cpu.repeating) continue;  // the window cuts it
    // A round begins where it is in no function that it calls: those may be answered by heart.
    if (cpu.w[15] < outermost_) {
      begin_round(cpu);
    } else if (behind_.first) {
      if (goes_elsewhere(cpu)) begin_round(cpu);
    } else if (cpu.watched_until < kNever && cpu.watched_until <= cpu.true_now()) {
      fail(cpu);
    } else if (cpu.next == round.first) {
      end_round(cpu);
    } else if (!is_turned_ && cpu.heads.has(cpu.next)) {
      is_turned_ = true;  // so that a wait has one head, wherever in it the look began
      begin_here(cpu);
      if (comes_round_) break;
    } else if (steps_ == kLongestRound) {
      fail(cpu);
    }
  }
  cpu.watch_round(nullptr);
}

bool Waits::goes_elsewhere(Cpu& cpu) {
  if (cpu.next >= behind_.first && cpu.next <= behind_.last && --behind_in_ > 0) return false;
  chances_ = 2;
  return true;
}

void Waits::end_round(Cpu& cpu) {
  KnownWaits::Wait& round = probe_->round;
  Count& proven = probe_->proven;
  round.took = cpu.clocks.own_cycles(cpu.now) - round_began_;
  round.sets_dc = !(cpu.dc & kNotSet);
  round.sets_flags = cpu.table().sets_flags(round.first);
  const bool is_whole = round.memory.is_whole(),
             is_fixed = cpu.watched_until == kNever && !cpu.looks_outside && !cpu.reads_core;
  if (is_whole && round.state.is_of(cpu) && round.memory.are_as_read(cpu.ram.data())) {
    round.memory.take_written(cpu.ram.data());
    if (is_fixed) cpu.known_waits.add(cpu, round);
    cpu.mark_head(round.first);
    return enter(cpu, &round);
  }
  if (const KnownWaits::Wait* known = cpu.known_waits.find(cpu)) return enter(cpu, known);
  if (!is_whole) return fail(cpu);
  if (--chances_ > 0) return begin_round(cpu);
  if (cpu.reads_core || !proven.prove(cpu, round, probe_->trace)) return fail(cpu);
  const Cycle rounds = proven.rounds_from(cpu);
  if (rounds >= kFewestRounds) {
    cpu.mark_head(round.first);
    return enter_count(cpu, is_fixed && proven.is_plain(cpu) ? &cpu.known_counts.add(proven) : &proven,
                       rounds);
  }
  // soon over: a longer round that it is a part of may be one
  if (again_++ == kMostAgain) return fail(cpu);
  behind_ = {probe_->trace.front().at, probe_->trace.front().at};
  for (const CountStep& step : probe_->trace) {
    behind_.first = std::min(behind_.first, step.at);
    behind_.last = std::max(behind_.last, step.at);
  }
  behind_in_ = static_cast<int>(std::max<Cycle>(rounds, 0) + 2) * steps_;
}

void Waits::fail(Cpu& cpu) {
  constexpr unsigned kRarestHints = 64;
  if (is_hinted_look(cpu)) hint_gap_ = std::min(2 * hint_gap_, kRarestHints);
  state_ = State::Away;
  forget_probe();
  cpu.still_since = kNever;
  const Cycle now = stands_in_host(cpu) ? std::max(cpu.true_now(), cpu.stands_until) : cpu.true_now();
  if (at_head_) cpu.heads.pause(look_head_, false, cpu.true_now());
  Schedule& next = schedule(cpu);
  if (next.at > now) return;
  next.at = now + next.between;
  const Cycle rarest = std::min((now - began_) / kOftenAtFirst, kRarestInVain);
  next.between = std::min(2 * next.between, std::max(next.between, rarest));
}

// --- waiting

/// Is it the one that an interrupt came into? A loop may have two heads, where another one shares a function
/// with it.
bool Waits::goes_on(const Cpu& cpu, const KnownWaits::Wait& wait) const {
  const Decoded* const head = cut_of(cpu).head;
  if (head == wait.first) return true;
  const KnownWaits::Wait* const before = head ? cpu.known_waits.at(head) : nullptr;
  return before && before->memory.are_as_read(cpu.ram.data());
}

/// Is it the rest of one that an interrupt came into?
bool Waits::is_rest(const Cpu& cpu, const KnownWaits::Wait& wait) const {
  return look_began_own_ - cut_of(cpu).resumed <= wait.took && goes_on(cpu, wait);
}

void Waits::enter(Cpu& cpu, const KnownWaits::Wait* wait) {
  state_ = State::Waiting;
  forget_probe(wait);
  if (is_hinted_look(cpu)) hint_gap_ = 1;
  is_by_head_ = at_head_ || cpu.heads.has(wait->first);
  wait_ = wait;
  until_ = cpu.watched_until;
  entered_ = round_began_;  // the round that proved it was one of it
  entered_at_ = round_began_at_;
  // ... and so were, behind an interrupt, the rest of the one that it came into and those that this look has seen
  delayed_ = round_delayed_;
  Cut& cut = cut_of(cpu);
  if (is_rest(cpu, *wait)) {
    waited_ += cut.between;
    entered_ = cut.resumed;
    entered_at_ = cut.resumed_at;
    delayed_ = cut.resumed_delayed;
  }
  cpu.delayed = delayed_;
  cut.head = nullptr;
  cpu.heads.pause(wait->first, true, cpu.true_now());
  schedule(cpu).between = kFirstLooks;
  cpu.still_since = until_ == kNever && !cpu.looks_outside ? std::min(cpu.still_since, look_began_) : kNever;
  cpu.still_reads = wait->memory.reads() || cpu.reads_core;
}

void Waits::enter_count(Cpu& cpu, const Count* count, Cycle rounds) {
  enter(cpu, &count->round());
  counts_ = count;
  ends_ = cpu.clocks.own_cycles(cpu.now) + rounds * count->round().took;
  cpu.still_since = kNever;
}

void Waits::wait(Cpu& cpu) {
  cpu.in_wait = true;
  Cycle end = std::min(cpu.deadline, cpu.clocks.program_at(until_));
  if (counts_) end = std::min(end, end_of_count(cpu));
  // the rest of a round, then whole ones; behind a count one is run, as it writes more than the counter
  while (cpu.now < end && (cpu.repeating || cpu.next != wait_->first)) step(cpu);
  const Cycle took = wait_->took, fit = std::max<Cycle>(end - cpu.now, 0) / took;
  if (const Cycle rounds = counts_ ? fit - 1 : fit; rounds > 0) {
    if (counts_)
      counts_->advance(cpu, rounds);
    else
      jump_over(cpu);
    cpu.now += rounds * took;
    jumped_ += rounds * took;
  }
  while (cpu.now < end) step(cpu);
  cpu.delayed = delayed_;
  cpu.in_wait = false;
  const Cycle now = cpu.true_now();
  if (counts_ && cpu.clocks.own_cycles(cpu.now) >= ends_) {
    leave(cpu);
    // it ends now, or its flags change; then the program comes to its head again
    cpu.heads.hold(wait_->first, now + 2 * took);
    schedule(cpu).at = is_by_head_ ? look_behind(cpu, wait_->first, now) : now + 2 * took;
    return;
  }
  if (now < until_) return;
  leave(cpu);
  note_cut(cpu);  // perhaps it goes on, as behind an interrupt
  note_resumed(cpu);
  schedule(cpu).at = now;
}

// what whole rounds leave behind
void Waits::jump_over(Cpu& cpu) {
  wait_->memory.put_written(cpu.ram.data());
  if (wait_->sets_flags)
    wait_->state.put_flags(cpu);
  else if (wait_->sets_dc)
    cpu.dc = wait_->state.dc() ? 0x100 : 0;
}

void Waits::leave(Cpu& cpu) {
  waited_ += cpu.clocks.own_cycles(cpu.now) - entered_;
  if (cpu.course) cpu.course->waited(entered_at_, cpu.true_now());
  state_ = State::Away;
  counts_ = nullptr;
}

void Waits::note_cut(const Cpu& cpu) {
  Cut& cut = cut_of(cpu);
  cut.head = wait_->first;
  cut.counts = counts_ && is_by_head_;
  cut.took = wait_->took;
  cut.between = 0;
}

void Waits::cut(Cpu& cpu, int vector) {
  const bool waits = is_waiting();
  if (waits) {
    note_cut(cpu);
    leave(cpu);
  } else {
    // another one before it was back where it waited: what was between belongs to the wait, if it goes on
    const Cycle now = cpu.clocks.own_cycles(cpu.now);
    Cut& cut = cut_of(cpu);
    if ((state_ == State::Looking ? look_began_own_ : now) - cut.resumed <= cut.took)
      cut.between += now - cut.resumed;
    else
      cut.head = nullptr;  // it has gone elsewhere
  }
  // behind the handler it comes to a wait's first instruction by itself, and stops there
  if (waits && is_by_head_)
    schedule(cpu).at = look_beside_heads(cpu, cpu.true_now());
  else if (waits || state_ == State::Looking)
    schedule(cpu).at = 0;
  state_ = State::Away;
  cpu.heads.is_met = false;
  begin_handler(cpu, vector, cpu.true_now());
}

// Handlers seldom wait, so they may work on for a while before a look. Those of short ones come soon, each time
// after another while, and of each vector more and more seldom. One that comes into another goes by that one's
// time, unless its own comes first.
void Waits::begin_handler(const Cpu& cpu, int vector, Cycle at) {
  Schedule own{at + kFirstInHandler, kFirstInHandler};
  HandlerLooks& looks = handler_looks_[static_cast<std::size_t>(vector)];
  const bool is_soon = looks.left-- == 0;
  if (is_soon) {
    const Cycle after = soon(looks.done, kHandlerDoublings);
    own = {at + after, after};
    looks.left = static_cast<std::uint16_t>(++looks.done / kLooksAsOften);
    if (looks.done == kMostLooks) looks.done /= 2;
  }
  Schedule& schedule = schedules_[1];
  if (cpu.parts.interrupts.cpu().nesting() == 0)
    schedule = own;
  else if (is_soon)
    schedule.at = std::min(schedule.at, own.at);
}

// --- by heart

bool Waits::knows(const Cpu& cpu, const ByHeart& wait) const {
  if (!cpu.heads.would_stop(wait.head, wait.came_true)) return false;
  const Count* const count = cpu.known_counts.at(wait.head);
  return count && count->is_plain(cpu) && count->is_as_proven(cpu);
}

void Waits::note(Cpu& cpu, const ByHeart& wait) {
  cpu.heads.pause(wait.head, true, cpu.true_now());
  cpu.still_since = kNever;
  Schedule& next = schedule(cpu);
  next.between = kFirstLooks;
  waited_ += wait.cut - wait.came;
  jumped_ += wait.cut - wait.came;
  Cut& cut = cut_of(cpu);
  cut.head = wait.head;
  cut.counts = true;
  cut.took = cpu.known_counts.at(wait.head)->round().took;
  cut.between = 0;
  next.at = look_beside_heads(cpu, wait.cut_true);
  begin_handler(cpu, wait.vector, wait.cut_true);
  note_resumed(cpu);
}

void Waits::note_over(Cpu& cpu, const Decoded* head, Cycle at, Cycle at_true) {
  look_began_ = at_true;
  round_began_ = at;
  at_head_ = true;
  is_passed(cpu, cpu.known_counts.at(head)->round(), at_true);
  cpu.heads.passes = false;
}

void Waits::note_left(Cpu& cpu) {
  expect_head(cpu);
  if (expected_.at < kNever) has_left(cpu);
}

Cycle Waits::back_by(const Cpu& cpu, Cycle over) const {
  if (!is_waiting() || until_ != kNever) return kNever;
  const Decoded* const head = wait_->first;
  const KnownWaits::Wait* const fixed = cpu.known_waits.at(head);
  if (counts_) {
    const Cycle rounds = (ends_ - cpu.clocks.own_cycles(cpu.now)) / wait_->took;
    if (fixed || counts_ != cpu.known_counts.at(head) || !counts_->is_plain(cpu) || counts_->reads_flags() ||
        rounds <= kFewestRounds)
      return kNever;
  } else if (fixed != wait_) {
    return kNever;
  }
  const Cycle now = cpu.true_now();
  if (!cpu.heads.would_stop(head, now)) return kNever;
  const Cycle back = over + cpu.clocks.true_at(cpu.now + wait_->took) - now + 1;
  return back < std::min(look_by_, look_beside_heads(cpu, now)) ? back : kNever;
}

// cut(), resume(), and at the head begin() and enter(), at once
void Waits::go_through(Cpu& cpu, int vector, Cycle cut, Cycle cut_true) {
  waited_ += cut - entered_;
  note_resumed(cpu);
  Cut& slot = cut_of(cpu);
  entered_ = slot.resumed;
  entered_at_ = slot.resumed_at;
  delayed_ = slot.resumed_delayed;
  if (counts_) ends_ += entered_ - cut;
  schedule(cpu) = {look_beside_heads(cpu, cut_true), kFirstLooks};
  begin_handler(cpu, vector, cut_true);
  at_head_ = is_by_head_ = true;
  slot.head = nullptr;
  cpu.looks_outside = cpu.reads_core = false;
  cpu.watched_until = kNever;
}

void Waits::hint(Cpu& cpu) {
  if (!is_away()) return stir(cpu);
  const bool is_of_handler = cpu.parts.interrupts.cpu().nesting() > 0;
  if (!is_of_handler) {
    if (++hints_ < hint_gap_) return;
    hints_ = 0;
    is_hinted_ = true;
  }
  schedule(cpu).at = 0;
}

// A handler's looks have nothing to do with hints to the program: one that is known by heart has none.
bool Waits::is_hinted_look(const Cpu& cpu) {
  return cpu.parts.interrupts.cpu().nesting() == 0 && std::exchange(is_hinted_, false);
}

// where nothing has changed, it is found again within a round, and has waited all the time
void Waits::stir(Cpu& cpu) {
  if (is_waiting()) {
    note_cut(cpu);
    leave(cpu);
    note_resumed(cpu);
  }
  state_ = State::Away;
  schedule(cpu).at = 0;
}

void Waits::move(const Decoded* from, const Decoded* to) {
  const auto move = [from, to](const Decoded*& d) {
    if (d && !address_of_host_place(d)) d = to + (d - from);
  };
  for (const Decoded** d :
       {&cuts_[0].head, &cuts_[1].head, &look_head_, &expected_.head, &behind_.first, &behind_.last})
    move(*d);
  if (!probe_) return;
  move(probe_->round.first);
  for (CountStep& step : probe_->trace) move(step.at);
  if (probe_->proven.round().first) probe_->proven.move(from, to);
}

void Waits::forget(Cpu& cpu) {
  if (is_waiting()) leave(cpu);
  state_ = State::Away;
  at_head_ = false;
  for (Cut& cut : cuts_) cut.head = nullptr;
  passed_ = {};
  begin_at(cpu.true_now());
}

void Waits::begin_at(Cycle now) {
  began_ = now;
  handler_looks_ = {};
  looks_beside_ = hints_ = 0;
  hint_gap_ = 1;
  is_hinted_ = false;
  look_gap_ = kFirstGap;
  put_off_ = 0;
  expected_ = {};
  look_by_ = now + look_gap_;
  for (Schedule& s : schedules_) s = {now + kFirstLooks, kFirstLooks};
}

}  // namespace dspic
