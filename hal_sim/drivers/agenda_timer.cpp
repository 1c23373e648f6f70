// SPDX-License-Identifier: MIT
// See agenda_timer.h. Invariants: a node's count.tick never exceeds the ticks it has processed; next_fire_ is
// up to date whenever no walk is under way; outside a walk no tick at or after next_fire_ is processed.
#include "hal_sim/drivers/agenda_timer.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace drivers {

using namespace board;

namespace {
constexpr int kDone = 1;      // EXIT_OK of the library, AG_ALREADY_CREATED too
constexpr int kNotFound = 2;  // AG_NOT_FOUND
constexpr std::uint32_t kBeforeAll = UINT32_MAX;
constexpr std::uint64_t kAllTicks = std::uint64_t{1} << 32;
constexpr AgendaCosts kNoCosts;

std::int64_t floor_div(std::int64_t a, std::int64_t b) {
  const std::int64_t q = a / b;
  return a % b < 0 ? q - 1 : q;
}
}  // namespace

AgendaTimer::AgendaTimer(Stepper& left, Stepper& right)
    : costs_(&kNoCosts), steppers_{&left, &right}, motors_{AgendaMotor(-1), AgendaMotor(+1)} {
  nodes_.reserve(4);
  for (AgendaMotor& m : motors_) m.count.active = false;
}

// --- ticks

std::int64_t AgendaTimer::ticks_at(Cycle at) const {
  if (walking_) return walk_tick_;
  if (!running_) return stopped_tick_;
  if (held_since_ >= 0 && has_no_flag_) return held_done_;
  if (held_since_ >= 0) at = std::min(at, held_since_);
  std::int64_t tick = floor_div(at - line_.origin, kAgendaTickCycles);
  if (tick < line_.late_tick) tick = at >= line_.late_cycle ? line_.late_tick : line_.late_tick - 1;
  if (tick == line_.late_tick && at < line_.late_cycle) tick = line_.late_tick - 1;
  // the handler is due: until it has begun, the interrupt is pending and nothing counts
  if (next_fire_ >= 0 && tick >= next_fire_) tick = next_fire_ - 1;
  return tick;
}

std::int64_t AgendaTimer::done_tick(std::uint32_t serial, Cycle at) const {
  if (!walking_) return ticks_at(at);
  return serial >= walk_serial_ ? walk_tick_ : walk_tick_ - 1;
}

void AgendaTimer::start(Cycle at) {
  const std::int64_t tick = ticks_at(at);
  settle_motors_at(at);
  // a callback may do this: motors further down the list still belong to the tick that is being walked
  line_.late_cycle = line_.cycle_of(tick);
  line_.late_tick = walking_ ? tick : -1;
  line_.origin = at - tick * kAgendaTickCycles;
  running_ = true;
  shares_known_ = 0;
  for (AgendaMotor& m : motors_) m.disturb();
  find_next_fire();
}

void AgendaTimer::stop(Cycle at) {
  stopped_tick_ = ticks_at(at);
  settle_motors_at(at);
  running_ = false;
  shares_known_ = 0;
}

void AgendaTimer::reset(Cycle at) {
  for (Wheel wheel : {Wheel::Left, Wheel::Right}) {
    bring(wheel, ticks_at(at));
    stepper(wheel).connect(false);
    stepper(wheel).set_coils_only(0);
    motor(wheel) = AgendaMotor(stepper(wheel).forward());
    motor(wheel).count.active = false;
    motor_functions_[static_cast<int>(wheel)] = nullptr;
    motor_serial_[static_cast<int>(wheel)] = 0;
    has_node_[static_cast<int>(wheel)] = false;
  }
  nodes_.clear();
  line_ = TickLine{};
  running_ = walking_ = in_callback_ = false;
  shares_known_ = 0;
  stopped_tick_ = 0;
  next_fire_ = -1;
  last_serial_ = 0;
  held_since_ = -1;
  lost_ticks_ = 0;
}

void AgendaTimer::forget(Cycle at) {
  for (Wheel wheel : {Wheel::Left, Wheel::Right}) {
    bring(wheel, done_tick(serial_of(wheel), at));
    motor(wheel) = AgendaMotor(stepper(wheel).forward());
    motor(wheel).count.active = false;
    motor_serial_[static_cast<int>(wheel)] = 0;
    has_node_[static_cast<int>(wheel)] = false;
  }
  nodes_.clear();
  shares_known_ = 0;
  if (!walking_) find_next_fire();
}

// --- the list

AgendaTimer::Node* AgendaTimer::find(Function function) {
  for (Node& node : nodes_)
    if (node.function == function) return &node;
  return nullptr;
}

int AgendaTimer::nodes_passed(Function function) const {
  int passed = 0;
  for (std::size_t i = nodes_.size(); i-- > 0 && nodes_[i].function != function;) ++passed;
  return passed;
}

AgendaCount& AgendaTimer::count_of(Node& node) {
  return node.kind == Kind::User ? node.count : motor(wheel_of(node.kind)).count;
}

const AgendaCount& AgendaTimer::count_of(const Node& node) const {
  return node.kind == Kind::User ? node.count : motor(wheel_of(node.kind)).count;
}

bool AgendaTimer::needs_handler(const Node& node) const {
  return node.kind == Kind::User || motor(wheel_of(node.kind)).speed() == 0;
}

void AgendaTimer::settle(Node& node, std::int64_t tick) {
  if (node.kind != Kind::User) {
    bring(wheel_of(node.kind), tick);
    return;
  }
  AgendaCount& count = node.count;
  if (tick <= count.tick) return;
  if (count.counts()) count.counter = static_cast<std::uint16_t>(count.counter + (tick - count.tick));
  count.tick = tick;
}

/// The rhythm of a motor's node is another one from now on.
void AgendaTimer::disturb(const Node& node) {
  if (node.kind != Kind::User) motor(wheel_of(node.kind)).disturb();
}

void AgendaTimer::settle_motors(std::int64_t tick) {
  for (Wheel wheel : {Wheel::Left, Wheel::Right}) bring(wheel, tick);
}

void AgendaTimer::settle_motors_at(Cycle at) {
  for (Wheel wheel : {Wheel::Left, Wheel::Right}) bring(wheel, done_tick(serial_of(wheel), at));
}

void AgendaTimer::find_next_fire() {
  next_fire_ = -1;
  for (const Node& node : nodes_) {
    const AgendaCount& count = count_of(node);
    if (!count.counts() || !needs_handler(node)) continue;
    const std::int64_t fire = count.tick + count.ticks_to_fire();
    if (next_fire_ < 0 || fire < next_fire_) next_fire_ = fire;
  }
}

int AgendaTimer::activate(Function function, int cycle, Cycle at) {
  if (find(function)) return kDone;
  Node node;
  node.function = function;
  node.serial = ++last_serial_;
  const std::int64_t done = walking_ ? walk_tick_ : ticks_at(at);
  for (Wheel wheel : {Wheel::Left, Wheel::Right}) {
    if (motor_functions_[static_cast<int>(wheel)] != function) continue;
    node.kind = wheel == Wheel::Left ? Kind::Left : Kind::Right;
    bring(wheel, done);
    motor_serial_[static_cast<int>(wheel)] = node.serial;
    has_node_[static_cast<int>(wheel)] = true;
  }
  disturb(node);
  AgendaCount& count = node.kind == Kind::User ? node.count : motor(wheel_of(node.kind)).count;
  count = AgendaCount{static_cast<std::uint16_t>(cycle), 0, true, done};
  nodes_.push_back(node);
  shares_known_ = 0;
  if (!walking_) find_next_fire();
  return kDone;
}

int AgendaTimer::destroy(Function function, Cycle at) {
  Node* node = find(function);
  if (!node) return kNotFound;
  settle(*node, done_tick(node->serial, at));
  if (node->kind != Kind::User) {
    count_of(*node).active = false;
    has_node_[static_cast<int>(wheel_of(node->kind))] = false;
  }
  nodes_.erase(nodes_.begin() + (node - nodes_.data()));
  note(Command::Destroy, at);
  shares_known_ = 0;
  if (!walking_) find_next_fire();
  return kDone;
}

int AgendaTimer::set_cycle(Function function, int cycle, Cycle at) {
  Node* node = find(function);
  if (!node) return kNotFound;
  settle(*node, done_tick(node->serial, at));
  count_of(*node).cycle = static_cast<std::uint16_t>(cycle);
  disturb(*node);
  note(Command::SetCycle, at);
  shares_known_ = 0;
  if (!walking_) find_next_fire();
  return kDone;
}

int AgendaTimer::reset_count(Function function, Cycle at) {
  Node* node = find(function);
  if (!node) return kNotFound;
  settle(*node, done_tick(node->serial, at));
  count_of(*node).counter = 0;
  disturb(*node);
  note(Command::ResetCount, at);
  shares_known_ = 0;
  if (!walking_) find_next_fire();
  return kDone;
}

int AgendaTimer::pause(Function function, Cycle at) {
  Node* node = find(function);
  if (!node) return kNotFound;
  settle(*node, done_tick(node->serial, at));
  count_of(*node).active = false;
  note(Command::Pause, at);
  shares_known_ = 0;
  if (!walking_) find_next_fire();
  return kDone;
}

int AgendaTimer::restart(Function function, Cycle at) {
  Node* node = find(function);
  if (!node) return kNotFound;
  settle(*node, done_tick(node->serial, at));
  count_of(*node).active = true;
  disturb(*node);
  note(Command::Restart, at);
  shares_known_ = 0;
  if (!walking_) find_next_fire();
  return kDone;
}

void AgendaTimer::name_motor(Wheel wheel, Function function) {
  motor_functions_[static_cast<int>(wheel)] = function;
}

// --- motors

void AgendaTimer::set_speed(Wheel wheel, int speed, Cycle coils_off_at, Cycle at) {
  if (coils_off_at < at) {
    // a tick between may switch them on again
    bring(wheel, done_tick(serial_of(wheel), coils_off_at));
    stepper(wheel).set_coils_only(0);
    motor(wheel).disturb();
  }
  AgendaMotor& m = bring(wheel, done_tick(serial_of(wheel), at));
  const bool counted = m.count.counts(), was_handled = counted && m.speed() == 0;
  if (coils_off_at == at) stepper(wheel).set_coils_only(0);
  note(static_cast<std::uint64_t>(speed) << 1 | static_cast<std::uint64_t>(wheel), at);
  m.set_speed(std::clamp(speed, -kMaxSpeed, kMaxSpeed));
  if (has_node_[static_cast<int>(wheel)]) m.set_cycle(m.step_ticks());
  shares_known_ &= ~((m.count.counts() == counted ? 0 : kTicks) | 1u << static_cast<unsigned>(wheel));
  // a motor that runs, or stands without a cycle, needs no interrupt
  if (was_handled && !walking_) find_next_fire();
}

bool AgendaTimer::run_motor(Wheel wheel, Cycle at) {
  AgendaMotor& m = bring(wheel, done_tick(serial_of(wheel), at));
  const bool counted = m.count.counts();
  const bool fine = m.fire(at, stepper(wheel));
  note(Command::Run, at);
  if (m.count.counts() != counted) shares_known_ = 0;
  m.disturb();
  if (!walking_) find_next_fire();
  return fine;
}

std::int64_t AgendaTimer::commanded_steps(Wheel wheel, Cycle at) const {
  return motor_at(wheel, at).commanded;
}

const Stepper& AgendaTimer::stepper_at(Wheel wheel, Cycle at) const {
  motor_at(wheel, at);
  return *steppers_[static_cast<std::size_t>(wheel)];
}

Stepper& AgendaTimer::stepper(Wheel wheel, Cycle at) {
  AgendaMotor& m = bring(wheel, done_tick(serial_of(wheel), at));
  m.disturb();  // the caller may write pins
  note(Command::Pins, at);
  return stepper(wheel);
}

board::RotorCourse AgendaTimer::course(Wheel wheel, Cycle at) const {
  const AgendaMotor& m = motor_at(wheel, at);
  const Stepper& rotor = *steppers_[static_cast<std::size_t>(wheel)];
  const Cycle step = next_step(m), period = m.full_period() * kAgendaTickCycles;
  if (step < kNever && !walking_ && m.is_even() && period <= kRotorMoveCycles && rotor.is_at(m.phase)) {
    const double rate = m.step_direction() / static_cast<double>(period);
    return {static_cast<double>(rotor.steps()) - rate * static_cast<double>(step - at), rate, kNever};
  }
  board::RotorCourse course = rotor.course(at);
  course.until = std::min(course.until, step);
  return course;
}

Cycle AgendaTimer::next_step(const AgendaMotor& motor) const {
  if ((!running_ && !walking_) || held_since_ >= 0) return kNever;
  const std::int64_t tick = motor.next_step_tick();
  return tick < 0 ? kNever : line_.cycle_of(tick);
}

Cycle AgendaTimer::coils_horizon(Wheel wheel, Cycle at) const {
  if ((!running_ && !walking_) || held_since_ >= 0) return kNever;
  const AgendaMotor& m = motor_at(wheel, at);
  if (!m.count.counts() || m.speed() == 0) return kNever;
  return line_.cycle_of(m.count.tick + m.count.ticks_to_fire());
}

// --- the interrupt handler

Cycle AgendaTimer::next_interrupt() const {
  if (!running_ || walking_ || next_fire_ < 0) return kNever;
  return line_.cycle_of(next_fire_);
}

void AgendaTimer::begin(Cycle at) {
  if (walking_) abandon(at);
  walk_tick_ = next_fire_ >= 0 && at >= next_interrupt() ? next_fire_ : ticks_at(at);
  // ticks that came while the flag was already set are lost
  const std::int64_t lost =
      floor_div(at - (line_.origin + walk_tick_ * kAgendaTickCycles), kAgendaTickCycles);
  if (lost > 0 && running_) {
    settle_motors(walk_tick_ - 1);
    lose(lost);
    line_.late_tick = walk_tick_;
    line_.late_cycle = at;
  }
  walking_ = true;
  walk_serial_ = kBeforeAll;
  walk_cost_ = 0;
  in_callback_ = false;
}

AgendaTimer::Function AgendaTimer::next(bool& divided_by_zero) {
  divided_by_zero = false;
  if (!walking_) return nullptr;
  // the callback has returned: its counter is zeroed now, whatever it did itself
  if (in_callback_) {
    in_callback_ = false;
    Node* node = nullptr;
    for (Node& one : nodes_)
      if (one.serial == walk_serial_) node = &one;
    if (node) node->count.counter = 0;
    walk_cost_ += node ? costs_->after : costs_->after_destroyed;
  }
  // newest first, those that are older than the one just processed
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    if (node.serial >= walk_serial_) continue;
    const Cycle cost = cost_of(node);
    walk_cost_ += cost;
    if (!needs_handler(node)) continue;  // a motor, whose firings are a share
    settle(node, walk_tick_ - 1);
    walk_serial_ = node.serial;
    AgendaCount& count = count_of(node);
    count.tick = walk_tick_;
    if (!count.counts()) continue;
    ++count.counter;
    if (count.counter < count.cycle) continue;
    // It fires: a function is called by whoever asked, a motor steps here.
    if (node.kind == Kind::User) {
      walk_cost_ += costs_->fires - cost;
      in_callback_ = true;
      return node.function;
    }
    AgendaMotor& m = motor(wheel_of(node.kind));
    divided_by_zero = !m.fire(line_.cycle_of(walk_tick_), stepper(wheel_of(node.kind)));
    count.counter = 0;
    if (divided_by_zero) return nullptr;
  }
  walk_serial_ = 0;
  return nullptr;
}

void AgendaTimer::finish(Cycle at) {
  if (!walking_) return;
  walking_ = false;
  in_callback_ = false;
  stopped_tick_ = held_done_ = walk_tick_;
  if (running_ && !has_no_flag_) resume(walk_tick_, at);
  if (held_since_ >= 0) held_since_ = at;
  find_next_fire();
}

// a callback that let the handler come again, or that was left by a jump
void AgendaTimer::abandon(Cycle at) {
  for (Node& node : nodes_) {
    if (node.serial >= walk_serial_ || node.kind != Kind::User) continue;
    settle(node, walk_tick_ - 1);
    node.count.tick = walk_tick_;
  }
  walking_ = in_callback_ = false;
  stopped_tick_ = held_done_ = walk_tick_;
  if (held_since_ < 0) resume(walk_tick_, at, true);
  find_next_fire();
}

// Ticks after `done` that came by `at` found the handler busy or masked: one was remembered by the flag and
// runs now; the others are lost.
void AgendaTimer::resume(std::int64_t done, Cycle at) {
  const std::int64_t since = floor_div(at - (line_.origin + done * kAgendaTickCycles), kAgendaTickCycles);
  if (since < 1) return;
  settle_motors(done);
  lose(since - 1);
  line_.late_tick = done + 1;
  line_.late_cycle = at;
}

void AgendaTimer::resume(std::int64_t done, Cycle at, bool pending) {
  if (!running_) {
    if (pending) stopped_tick_ = done + 1;
    return;
  }
  const std::int64_t since = floor_div(at - (line_.origin + done * kAgendaTickCycles), kAgendaTickCycles);
  if (since < 1 && !pending) return;
  settle_motors(done);
  lose(since - (pending ? 1 : 0));
  if (!pending) return;
  line_.late_tick = done + 1;
  line_.late_cycle = at;
}

void AgendaTimer::release(Cycle at, bool pending) {
  if (held_since_ < 0) return;
  held_since_ = -1;
  if (!walking_) resume(held_done_, at, pending);
}

Cycle AgendaTimer::tick_after(Cycle after) const {
  if (!running_) return kNever;
  return line_.origin + (floor_div(after - line_.origin, kAgendaTickCycles) + 1) * kAgendaTickCycles;
}

/// Ticks that never come; below 0: more than come by themselves.
void AgendaTimer::lose(std::int64_t ticks) {
  line_.origin += ticks * kAgendaTickCycles;
  for (AgendaMotor& m : motors_) m.disturb();
  if (ticks <= 0) return;
  lost_ticks_ += ticks;
}

void AgendaTimer::release(Cycle at) {
  if (held_since_ < 0) return;
  const std::int64_t done = ticks_at(held_since_);
  held_since_ = -1;
  if (!running_ || walking_ || at < line_.cycle_of(done + 1)) return;
  resume(done, at);
}

// --- costs and digest

Cycle AgendaTimer::cost_of(const Node& node) const {
  const AgendaCount& count = count_of(node);
  return !count.active ? costs_->paused : count.cycle == 0 ? costs_->resting : costs_->counts;
}

const AgendaTimer::Node* AgendaTimer::node_of(std::uint32_t serial) const {
  for (const Node& node : nodes_)
    if (node.serial == serial) return &node;
  return nullptr;
}

AgendaTimer::Function AgendaTimer::running() const {
  const Node* node = walking_ && in_callback_ ? node_of(walk_serial_) : nullptr;
  return node ? node->function : nullptr;
}

AgendaTimer::Function AgendaTimer::following() const {
  if (!walking_) return nullptr;
  for (std::size_t i = nodes_.size(); i-- > 0;)
    if (nodes_[i].serial < walk_serial_) return nodes_[i].function;
  return nullptr;
}

Cycle AgendaTimer::take_walk_cost() { return std::exchange(walk_cost_, 0); }

/// Ticks that call a function, of all, as a fraction of 2^32. Several agendas that fire at the same tick make
/// it one: the sum of all is too many by those that two share, which is too few by those that three share ...
std::uint64_t AgendaTimer::calling_ticks_q32() const {
  constexpr std::size_t kMost = 8;  // beyond that they are taken to meet nowhere
  struct Rhythm {
    std::int64_t first, period;
  };
  std::vector<Rhythm> rhythms;
  std::int64_t calling = 0;
  // When each agenda fires first, and how often.
  for (const Node& node : nodes_) {
    const AgendaCount& count = count_of(node);
    if (!needs_handler(node) || !count.counts()) continue;
    const bool runs = in_callback_ && node.serial == walk_serial_;  // its counter will be 0
    const std::int64_t first = count.tick + (runs ? count.cycle : count.ticks_to_fire());
    if (rhythms.size() < kMost)
      rhythms.push_back({first, count.cycle});
    else
      calling += static_cast<std::int64_t>(kAllTicks) / count.cycle;
  }
  constexpr std::int64_t kNeverMeet = 1 << 20;  // a minute and more
  // For each choice of agendas: the ticks at which all of them fire, found by joining them one by one.
  for (unsigned chosen = 1; chosen < 1u << rhythms.size(); ++chosen) {
    Rhythm all{0, 0};
    for (std::size_t i = 0; i < rhythms.size() && all.period < kNeverMeet; ++i) {
      if (!(chosen >> i & 1)) continue;
      Rhythm one = rhythms[i];
      if (all.period == 0) {
        all = one;
        continue;
      }
      if (one.period > all.period) std::swap(one, all);
      const std::int64_t common = std::gcd(all.period, one.period),
                         together = all.period / common * one.period;
      const bool meet = together < kNeverMeet && (one.first - all.first) % common == 0;
      if (meet)
        while ((all.first - one.first) % one.period != 0) all.first += all.period;
      all.period = meet ? together : kNeverMeet;
    }
    if (all.period >= kNeverMeet) continue;
    // counted in and out by turns (inclusion and exclusion)
    const std::int64_t part = static_cast<std::int64_t>(kAllTicks) / all.period;
    calling += __builtin_popcount(chosen) % 2 ? part : -part;
  }
  return static_cast<std::uint64_t>(
      std::clamp<std::int64_t>(calling, 0, static_cast<std::int64_t>(kAllTicks)));
}

void AgendaTimer::find_shares() const {
  const auto share = [](Cycle cycles, std::int64_t ticks) {
    return (static_cast<std::uint64_t>(cycles) << 32) / static_cast<std::uint64_t>(ticks * kAgendaTickCycles);
  };
  if (!(shares_known_ & kTicks)) {
    tick_cycles_ = nodes_.empty() ? costs_->empty : costs_->list;
    for (const Node& node : nodes_) tick_cycles_ += cost_of(node);
    tick_share_q32_ = share(tick_cycles_, 1);
    calling_share_q32_ = tick_share_q32_ * (calling_ticks_q32() >> 8) / (kAllTicks >> 8);
  }
  for (std::size_t i = 0; i < 2; ++i)
    if (const AgendaMotor& m = motors_[i]; !(shares_known_ >> i & 1))
      motor_share_q32_[i] =
          m.count.counts() && m.speed() != 0
              ? share(m.saves_power() ? costs_->motor_half + costs_->motor_off : costs_->motor_step,
                      m.full_period())
              : 0;
  shares_known_ = kAllShares;
}

std::uint64_t AgendaTimer::state_sum(Cycle at) const {
  std::uint64_t sum = static_cast<std::uint64_t>(ticks_at(at)) * 2 + (running_ ? 1 : 0);
  std::uint64_t factor = 0xA0761D6478BD642Fu;
  const auto add = [&](std::uint64_t part) {
    sum += part * factor;
    factor += 0xE7037ED1A0B428DAu;  // even, so the factor stays odd
  };
  // motors: what they have done since a command follows from the ticks
  add(history_);
  for (const Node& node : nodes_) add(node.count.cycle | std::uint64_t{node.serial} << 16);
  return sum;
}

}  // namespace drivers
