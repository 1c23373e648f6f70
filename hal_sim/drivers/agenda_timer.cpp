// SPDX-License-Identifier: MIT
// See agenda_timer.h. Invariants: a node's count.tick never exceeds the ticks it has processed; the ticks know
// the next one that needs the handler whenever no walk is under way.
#include "hal_sim/drivers/agenda_timer.h"

#include <algorithm>
#include <utility>

namespace drivers {

using namespace board;

namespace {
constexpr int kDone = 1;      // EXIT_OK of the library, AG_ALREADY_CREATED too
constexpr int kNotFound = 2;  // AG_NOT_FOUND
}  // namespace

AgendaTimer::AgendaTimer(Stepper& left, Stepper& right)
    : motors_(ticks_, left, right), shares_(ticks_, list_, motors_) {}

// --- ticks

void AgendaTimer::start(Cycle at) {
  motors_.note_command();
  motors_.bring_both(at);
  ticks_.start(at);
  shares_.change();
  motors_.disturb();
  find_next_fire();
}

void AgendaTimer::stop(Cycle at) {
  motors_.note_command();
  motors_.bring_both(at);
  ticks_.stop(at);
  shares_.change();
}

void AgendaTimer::reset(Cycle at) {
  motors_.note_command();
  for (Wheel wheel : {Wheel::Left, Wheel::Right}) {
    motors_.bring_to(wheel, ticks_.at(at));
    motors_.stepper(wheel).connect(false);
    motors_.stepper(wheel).set_coils_only(0);
    motors_.forget(wheel);
  }
  list_.reset();
  ticks_.reset();
  shares_.change();
}

void AgendaTimer::forget(Cycle at) {
  for (Wheel wheel : {Wheel::Left, Wheel::Right}) {
    motors_.bring(wheel, at);
    motors_.forget(wheel);
  }
  list_.nodes().clear();
  changed();
}

// --- the list

void AgendaTimer::settle(Node& node, std::int64_t tick) {
  if (node.kind != Kind::User) {
    motors_.bring_to(AgendaList::wheel_of(node.kind), tick);
    return;
  }
  AgendaCount& count = node.count;
  if (tick <= count.tick) return;
  if (count.counts()) count.counter = static_cast<std::uint16_t>(count.counter + (tick - count.tick));
  count.tick = tick;
}

/// The rhythm of a motor's node is another one from now on.
void AgendaTimer::disturb(const Node& node) {
  if (node.kind != Kind::User) motors_.of(AgendaList::wheel_of(node.kind)).disturb();
}

/// The list, or a node's cycle is another one from now on.
void AgendaTimer::changed() {
  motors_.note_command();
  shares_.change();
  if (!ticks_.is_walking()) find_next_fire();
}

void AgendaTimer::find_next_fire() {
  std::int64_t next = -1;
  for (const Node& node : list_.nodes()) {
    const AgendaCount& count = motors_.count_of(node);
    if (!count.counts() || !motors_.needs_handler(node)) continue;
    const std::int64_t fire = count.tick + count.ticks_to_fire();
    if (next < 0 || fire < next) next = fire;
  }
  ticks_.set_next_fire(next);
}

int AgendaTimer::activate(Function function, int cycle, Cycle at) {
  if (list_.find(function)) return kDone;
  Node node;
  node.function = function;
  node.serial = list_.next_serial();
  const std::int64_t done = ticks_.at(at);
  for (Wheel wheel : {Wheel::Left, Wheel::Right}) {
    if (!list_.is_of(wheel, function)) continue;
    node.kind = wheel == Wheel::Left ? Kind::Left : Kind::Right;
    motors_.bring_to(wheel, done);
    motors_.add_node(wheel, node.serial);
  }
  disturb(node);
  motors_.count_of(node) = AgendaCount{static_cast<std::uint16_t>(cycle), 0, true, done};
  list_.nodes().push_back(node);
  changed();
  return kDone;
}

/// `change` gets the function's node, whose count is that of `at`.
template <typename Change>
int AgendaTimer::change(Function function, Command command, Cycle at, const Change& change) {
  Node* const node = list_.find(function);
  if (!node) return kNotFound;
  settle(*node, ticks_.done(node->serial, at));
  change(*node, motors_.count_of(*node));
  note(command, at);
  changed();
  return kDone;
}

int AgendaTimer::destroy(Function function, Cycle at) {
  return change(function, Command::Destroy, at, [this](Node& node, AgendaCount& count) {
    count.active = false;
    if (node.kind != Kind::User) motors_.drop_node(AgendaList::wheel_of(node.kind));
    list_.erase(&node);
  });
}

int AgendaTimer::set_cycle(Function function, int cycle, Cycle at) {
  return change(function, Command::SetCycle, at, [&](Node& node, AgendaCount& count) {
    count.cycle = static_cast<std::uint16_t>(cycle);
    disturb(node);
  });
}

int AgendaTimer::reset_count(Function function, Cycle at) {
  return change(function, Command::ResetCount, at, [this](Node& node, AgendaCount& count) {
    count.counter = 0;
    disturb(node);
  });
}

int AgendaTimer::pause(Function function, Cycle at) {
  return change(function, Command::Pause, at, [](Node&, AgendaCount& count) { count.active = false; });
}

int AgendaTimer::restart(Function function, Cycle at) {
  return change(function, Command::Restart, at, [this](Node& node, AgendaCount& count) {
    count.active = true;
    disturb(node);
  });
}

// --- motors

bool AgendaTimer::set_speed(Wheel wheel, int speed, Cycle at, std::optional<Cycle> coils_off_at) {
  const int clamped = std::clamp(speed, -kMaxSpeed, kMaxSpeed);
  const auto keeps_rhythm = [&](const AgendaMotor& m) { return !ticks_.stands() && m.keeps_rhythm(clamped); };
  const bool is_off_before = coils_off_at && *coils_off_at < at;
  if (is_off_before) {
    // a tick between may switch them on again
    AgendaMotor& before = motors_.bring(wheel, *coils_off_at);
    if (!keeps_rhythm(before)) before.disturb();
    motors_.stepper(wheel).set_coils_only(0);
  }
  AgendaMotor& m = motors_.bring(wheel, at);
  const bool counted = m.count.counts(), was_handled = counted && m.speed() == 0;
  if (!is_off_before) motors_.stepper(wheel).set_coils_only(0);
  note(static_cast<std::uint64_t>(speed) << 1 | static_cast<std::uint64_t>(wheel), at);
  if (keeps_rhythm(m)) return false;
  motors_.note_command();
  shares_.settle_firings(wheel, at);
  m.set_speed(clamped);
  if (motors_.has_node(wheel)) m.set_cycle(m.step_ticks());
  shares_.change_motor(wheel, m.count.counts() != counted);
  shares_.count_firings(wheel, at);
  // a motor that runs, or stands without a cycle, needs no interrupt
  if (was_handled && !ticks_.is_walking()) find_next_fire();
  return true;
}

bool AgendaTimer::run_motor(Wheel wheel, Cycle at) {
  motors_.note_command();
  AgendaMotor& m = motors_.bring(wheel, at);
  const bool counted = m.count.counts();
  const bool fine = m.fire(at, motors_.stepper(wheel));
  note(Command::Run, at);
  if (m.count.counts() != counted) shares_.change();
  m.disturb();
  if (!ticks_.is_walking()) find_next_fire();
  return fine;
}

Stepper& AgendaTimer::stepper(Wheel wheel, Cycle at) {
  motors_.note_command();
  motors_.bring(wheel, at).disturb();  // the caller may write pins
  note(Command::Pins, at);
  return motors_.stepper(wheel);
}

// --- the interrupt handler

void AgendaTimer::begin(Cycle at) {
  if (ticks_.is_walking()) abandon(at);
  const std::int64_t tick = ticks_.tick_due(at);
  // ticks that came while the flag was already set are lost
  const std::int64_t lost = ticks_.came(tick, at);
  if (lost > 0 && ticks_.is_running()) {
    motors_.bring_both_to(tick - 1);
    lose(lost);
    ticks_.come_late(tick, at);
  }
  ticks_.begin_walk(tick);
  walk_cost_ = 0;
}

/// The callback has returned. Behind a long one the rest of the list is late, motors among them.
void AgendaTimer::walk_on(Cycle at) {
  const std::int64_t tick = ticks_.walk_tick();
  if (!ticks_.is_running() || at - ticks_.line().cycle_of(tick) < kAgendaTickCycles) return;
  motors_.note_command();
  motors_.bring_both(at);  // those that were earlier have come to this tick in time
  ticks_.come_late(tick, at);
}

AgendaTimer::Function AgendaTimer::next(Cycle at, bool& divided_by_zero) {
  divided_by_zero = false;
  const AgendaCosts& costs = shares_.costs();
  const std::int64_t tick = ticks_.walk_tick();
  if (!ticks_.is_walking()) return nullptr;
  // the callback has returned: its counter is zeroed now, whatever it did itself
  if (ticks_.is_calling()) {
    walk_on(at);
    ticks_.walk_to(ticks_.walked(), false);
    Node* node = nullptr;
    for (Node& one : list_.nodes())
      if (one.serial == ticks_.walked()) node = &one;
    if (node) node->count.counter = 0;
    walk_cost_ += node ? costs.after : costs.after_destroyed;
  }
  // newest first, those that are older than the one just processed
  for (std::size_t i = list_.nodes().size(); i-- > 0;) {
    Node& node = list_.nodes()[i];
    if (node.serial >= ticks_.walked()) continue;
    const Cycle cost = shares_.cost_of(node);
    walk_cost_ += cost;
    if (!motors_.needs_handler(node)) {  // a motor, whose firings are a share
      if (pays_firings_) walk_cost_ += cost_of_firing(node, tick);
      continue;
    }
    settle(node, tick - 1);
    ticks_.walk_to(node.serial, false);
    AgendaCount& count = motors_.count_of(node);
    count.tick = tick;
    if (!count.counts()) continue;
    ++count.counter;
    if (count.counter < count.cycle) continue;
    // It fires: a function is called by whoever asked, a motor steps here.
    if (node.kind == Kind::User) {
      walk_cost_ += costs.fires - cost;
      ticks_.walk_to(node.serial, true);
      return node.function;
    }
    const Wheel wheel = AgendaList::wheel_of(node.kind);
    motors_.note_command();
    divided_by_zero = !motors_.of(wheel).fire(ticks_.line().cycle_of(tick), motors_.stepper(wheel));
    count.counter = 0;
    if (divided_by_zero) return nullptr;
  }
  ticks_.walk_to(0, false);
  return nullptr;
}

/// What a motor that fires at this tick adds to the handler; 0: it does not.
Cycle AgendaTimer::cost_of_firing(Node& node, std::int64_t tick) {
  const AgendaMotor& m = motors_.bring_to(AgendaList::wheel_of(node.kind), tick - 1);
  if (!m.count.counts() || m.count.tick != tick - 1 || m.count.ticks_to_fire() > 1) return 0;
  const AgendaCosts& costs = shares_.costs();
  return !m.saves_power() ? costs.motor_step : m.phase_on ? costs.motor_off : costs.motor_half;
}

void AgendaTimer::finish(Cycle at) {
  pays_firings_ = false;
  if (!ticks_.is_walking()) return;
  ticks_.end_walk();
  if (ticks_.is_running() && !ticks_.has_no_flag()) resume(ticks_.walk_tick(), at);
  if (ticks_.is_held()) ticks_.hold_from(at);
  find_next_fire();
}

// a callback that let the handler come again, or that was left by a jump
void AgendaTimer::abandon(Cycle at) {
  for (Node& node : list_.nodes()) {
    if (node.serial >= ticks_.walked() || node.kind != Kind::User) continue;
    settle(node, ticks_.walk_tick() - 1);
    node.count.tick = ticks_.walk_tick();
  }
  ticks_.end_walk();
  if (!ticks_.is_held()) resume(ticks_.walk_tick(), at, true);
  find_next_fire();
}

// Ticks after `done` that came by `at` found the handler busy or masked: one was remembered by the flag and
// runs now; the others are lost.
void AgendaTimer::resume(std::int64_t done, Cycle at) {
  if (ticks_.came(done, at) >= 1) resume(done, at, true);
}

void AgendaTimer::resume(std::int64_t done, Cycle at, bool pending) {
  if (!ticks_.is_running()) {
    if (pending) ticks_.count_stopped(done + 1);
    return;
  }
  const std::int64_t came = ticks_.came(done, at);
  if (came < 1 && !pending) return;
  motors_.bring_both_to(done);
  lose(came - (pending ? 1 : 0));
  if (pending) ticks_.come_late(done + 1, at);
}

void AgendaTimer::release(Cycle at, bool pending) {
  if (!ticks_.is_held()) return;
  pays_firings_ = pending;
  const std::int64_t done = ticks_.let_go();
  if (!ticks_.is_walking()) resume(done, at, pending);
}

void AgendaTimer::release(Cycle at) {
  if (!ticks_.is_held()) return;
  const std::int64_t done = ticks_.let_go();
  if (!ticks_.is_running() || ticks_.is_walking() || at < ticks_.line().cycle_of(done + 1)) return;
  resume(done, at);
}

void AgendaTimer::lose(std::int64_t ticks) {
  motors_.note_command();
  shares_.forget_firings();
  ticks_.lose(ticks);
  motors_.disturb();
}

// --- costs and digest

Cycle AgendaTimer::take_walk_cost() { return std::exchange(walk_cost_, 0); }

std::uint64_t AgendaTimer::state_sum(Cycle at) const {
  std::uint64_t sum = static_cast<std::uint64_t>(ticks_.at(at)) * 2 + (ticks_.is_running() ? 1 : 0);
  std::uint64_t factor = 0xA0761D6478BD642Fu;
  const auto add = [&](std::uint64_t part) {
    sum += part * factor;
    factor += 0xE7037ED1A0B428DAu;  // even, so the factor stays odd
  };
  // motors: what they have done since a command follows from the ticks
  add(history_);
  for (const Node& node : list_.nodes()) add(node.count.cycle | std::uint64_t{node.serial} << 16);
  return sum;
}

}  // namespace drivers
