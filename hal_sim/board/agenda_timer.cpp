// SPDX-License-Identifier: MIT
// See agenda_timer.h. Invariants: a node's count.tick never exceeds the ticks it has processed; next_fire_ is
// up to date whenever no walk is under way; outside a walk no tick at or after next_fire_ is processed.
#include "hal_sim/board/agenda_timer.h"

#include <algorithm>
#include <utility>

#include "hal_sim/board/adc_scan.h"
#include "sim_core/base/hash.h"

namespace board {

namespace {
constexpr int kDone = 1;      // EXIT_OK of the library, AG_ALREADY_CREATED too
constexpr int kNotFound = 2;  // AG_NOT_FOUND
constexpr std::uint32_t kBeforeAll = UINT32_MAX;

std::int64_t floor_div(std::int64_t a, std::int64_t b) {
  const std::int64_t q = a / b;
  return a % b < 0 ? q - 1 : q;
}
}  // namespace

AgendaTimer::AgendaTimer(const AdcScan* scan)
    : scan_(scan), motors_{AgendaMotor(-1), AgendaMotor(+1)}, ahead_{AgendaMotor(-1), AgendaMotor(+1)} {
  nodes_.reserve(8);
  for (AgendaMotor& m : motors_) m.count.active = false;
}

// --- ticks -----------------------------------------------------------------------------------------------

std::int64_t AgendaTimer::ticks_at(Cycle at) const {
  if (walking_) return walk_tick_;
  if (!running_) return stopped_tick_;
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
  settle_motors(walking_ ? -1 : tick);
  // a callback may do this: motors further down the list still belong to the tick that is being walked
  line_.late_cycle = line_.cycle_of(tick);
  line_.late_tick = walking_ ? tick : -1;
  line_.origin = at - tick * kAgendaTickCycles;
  started_tick_ = tick;
  running_ = enabled_ = true;
  for (AgendaMotor& m : motors_) m.disturb();
  find_next_fire();
}

void AgendaTimer::stop(Cycle at) {
  stopped_tick_ = ticks_at(at);
  settle_motors(walking_ ? -1 : stopped_tick_);
  running_ = false;
}

void AgendaTimer::reset(Cycle at) {
  for (Wheel wheel : {Wheel::Left, Wheel::Right}) {
    Stepper kept = stepper_at(wheel, at);
    kept.connect(false);
    kept.set_coils_only(0);
    motor(wheel) = AgendaMotor(kept.forward());
    motor(wheel).stepper = kept;
    motor(wheel).count.active = false;
    motor_functions_[static_cast<int>(wheel)] = nullptr;
    motor_serial_[static_cast<int>(wheel)] = 0;
    has_ahead_[static_cast<int>(wheel)] = has_node_[static_cast<int>(wheel)] = false;
  }
  nodes_.clear();
  line_ = TickLine{};
  running_ = enabled_ = walking_ = in_callback_ = false;
  stopped_tick_ = started_tick_ = 0;
  next_fire_ = -1;
  last_serial_ = 0;
  find_costs();
}

// --- the list --------------------------------------------------------------------------------------------

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

// A motor whose node comes later in the list waits for the other one's firings: these must still be known. In
// a walk they have been charged already, and its own turn is still to come.
AgendaMotor& AgendaTimer::bring(Wheel wheel, std::int64_t tick) {
  const Wheel other = wheel == Wheel::Left ? Wheel::Right : Wheel::Left;
  if (!walking_ && walks_before(wheel, other)) bring_alone(other, tick);
  return bring_alone(wheel, tick);
}

AgendaMotor& AgendaTimer::bring_alone(Wheel wheel, std::int64_t tick) {
  const std::size_t i = static_cast<std::size_t>(wheel);
  AgendaMotor& m = motors_[i];
  if (has_ahead_[i] && ahead_[i].count.tick <= tick) m = ahead_[i];
  has_ahead_[i] = false;
  advance(m, wheel, tick);
  return m;
}

void AgendaTimer::advance(AgendaMotor& m, Wheel wheel, std::int64_t tick) const {
  if (scan_)
    m.advance_to(tick, line_, [&](std::int64_t t, Cycle cycles) { return pins_at(wheel, t, cycles); });
  else
    m.advance_to(tick, line_, [&](std::int64_t t, Cycle) { return line_.cycle_of(t); });
}

void AgendaTimer::settle_motors(std::int64_t tick) {
  if (tick < 0) return;
  bring(Wheel::Left, tick);
  bring(Wheel::Right, tick);
}

void AgendaTimer::find_next_fire() {
  find_costs();
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
  if (!walking_) find_next_fire();
  return kDone;
}

int AgendaTimer::set_cycle(Function function, int cycle, Cycle at) {
  Node* node = find(function);
  if (!node) return kNotFound;
  settle(*node, done_tick(node->serial, at));
  count_of(*node).cycle = static_cast<std::uint16_t>(cycle);
  disturb(*node);
  if (!walking_) find_next_fire();
  return kDone;
}

int AgendaTimer::reset_count(Function function, Cycle at) {
  Node* node = find(function);
  if (!node) return kNotFound;
  settle(*node, done_tick(node->serial, at));
  count_of(*node).counter = 0;
  disturb(*node);
  if (!walking_) find_next_fire();
  return kDone;
}

int AgendaTimer::pause(Function function, Cycle at) {
  Node* node = find(function);
  if (!node) return kNotFound;
  settle(*node, done_tick(node->serial, at));
  count_of(*node).active = false;
  if (!walking_) find_next_fire();
  return kDone;
}

int AgendaTimer::restart(Function function, Cycle at) {
  Node* node = find(function);
  if (!node) return kNotFound;
  settle(*node, done_tick(node->serial, at));
  count_of(*node).active = true;
  disturb(*node);
  if (!walking_) find_next_fire();
  return kDone;
}

void AgendaTimer::name_motor(Wheel wheel, Function function) {
  motor_functions_[static_cast<int>(wheel)] = function;
}

// --- motors ----------------------------------------------------------------------------------------------

void AgendaTimer::set_speed(Wheel wheel, int speed, Cycle at) {
  AgendaMotor& m = bring(wheel, done_tick(serial_of(wheel), at));
  const bool counted = m.count.counts(), was_handled = counted && m.speed() == 0;
  m.stepper.set_coils_only(0);
  m.disturb();
  m.set_speed(std::clamp(speed, -kMaxSpeed, kMaxSpeed));
  if (has_node_[static_cast<int>(wheel)]) m.set_cycle(m.speed() == 0 ? 0 : kSpeedUnit / std::abs(m.speed()));
  // a motor that runs, or stands without a cycle, needs no interrupt
  if (was_handled && !walking_) find_next_fire();
  if (m.count.counts() != counted)
    find_costs();
  else if (scan_)
    find_moments();
}

bool AgendaTimer::run_motor(Wheel wheel, Cycle at) {
  AgendaMotor& m = bring(wheel, done_tick(serial_of(wheel), at));
  const bool fine = m.fire([at](Cycle) { return at; });
  m.disturb();
  if (!walking_) find_next_fire();
  return fine;
}

const AgendaMotor& AgendaTimer::motor_at(Wheel wheel, Cycle at) const {
  const std::size_t i = static_cast<std::size_t>(wheel);
  const AgendaMotor& m = motors_[i];
  if (!m.count.counts() || m.speed() == 0) return m;
  const std::int64_t tick = done_tick(motor_serial_[i], at);
  if (!has_ahead_[i] || ahead_[i].count.tick > tick) {
    if (tick < m.count.tick + m.count.ticks_to_fire()) return m;
    ahead_[i] = m;
    has_ahead_[i] = true;
  }
  advance(ahead_[i], wheel, tick);
  return ahead_[i];
}

std::int64_t AgendaTimer::commanded_steps(Wheel wheel, Cycle at) const {
  return motor_at(wheel, at).commanded;
}

const Stepper& AgendaTimer::stepper_at(Wheel wheel, Cycle at) const { return motor_at(wheel, at).stepper; }

Stepper& AgendaTimer::stepper(Wheel wheel, Cycle at) {
  AgendaMotor& m = bring(wheel, done_tick(serial_of(wheel), at));
  m.disturb();  // the caller may write pins
  return m.stepper;
}

Cycle AgendaTimer::steps_horizon(Wheel wheel, Cycle at) const {
  if (!running_ && !walking_) return host::kNever;
  const std::int64_t tick = motor_at(wheel, at).next_step_tick();
  return tick < 0 ? host::kNever : line_.cycle_of(tick);
}

Cycle AgendaTimer::coils_horizon(Wheel wheel, Cycle at) const {
  if (!running_ && !walking_) return host::kNever;
  const AgendaMotor& m = motor_at(wheel, at);
  if (!m.count.counts() || m.speed() == 0) return host::kNever;
  return line_.cycle_of(m.count.tick + m.count.ticks_to_fire());
}

// --- the interrupt handler -------------------------------------------------------------------------------

Cycle AgendaTimer::next_interrupt() const {
  if (!running_ || walking_ || next_fire_ < 0) return host::kNever;
  return line_.cycle_of(next_fire_);
}

void AgendaTimer::begin(Cycle at) {
  walk_tick_ = next_fire_ >= 0 && at >= next_interrupt() ? next_fire_ : ticks_at(at);
  settle_motors(walk_tick_ - 1);
  // ticks that came while the flag was already set are lost
  const std::int64_t lost =
      floor_div(at - (line_.origin + walk_tick_ * kAgendaTickCycles), kAgendaTickCycles);
  if (lost > 0) {
    line_.origin += lost * kAgendaTickCycles;
    line_.late_tick = walk_tick_;
    line_.late_cycle = at;
    for (AgendaMotor& m : motors_) m.disturb();
  }
  walking_ = true;
  walk_serial_ = kBeforeAll;
  walk_cost_ = 0;
  in_callback_ = false;
}

AgendaTimer::Function AgendaTimer::next(bool& divided_by_zero, Cycle at) {
  divided_by_zero = false;
  walk_at_ = at;
  if (!walking_) return nullptr;
  // the callback has returned: its counter is zeroed now, whatever it did itself
  if (in_callback_) {
    in_callback_ = false;
    for (Node& node : nodes_)
      if (node.serial == walk_serial_) node.count.counter = 0;
  }
  for (;;) {
    // newest node that is older than the one just processed
    Node* node = nullptr;
    for (std::size_t i = nodes_.size(); i-- > 0 && !node;)
      if (nodes_[i].serial < walk_serial_) node = &nodes_[i];
    if (!node) {
      walk_serial_ = 0;
      return nullptr;
    }
    settle(*node, walk_tick_ - 1);
    walk_serial_ = node->serial;
    walk_cost_ += cost_of(*node);
    if (!needs_handler(*node)) {
      const AgendaMotor& m = motor(wheel_of(node->kind));
      const Cycle firing = m.firing_cycles(walk_tick_);
      settle(*node, walk_tick_);
      walk_cost_ += firing;
      continue;
    }
    AgendaCount& count = count_of(*node);
    count.tick = walk_tick_;
    if (!count.counts()) continue;
    ++count.counter;
    if (count.counter < count.cycle) continue;
    if (node->kind == Kind::User) {
      in_callback_ = true;
      return node->function;
    }
    AgendaMotor& m = motor(wheel_of(node->kind));
    divided_by_zero =
        !m.fire([&](Cycle cycles) { return pins_at(wheel_of(node->kind), walk_tick_, cycles); });
    count.counter = 0;
    if (divided_by_zero) return nullptr;
  }
}

void AgendaTimer::finish(Cycle at) {
  if (!walking_) return;
  walking_ = false;
  in_callback_ = false;
  stopped_tick_ = walk_tick_;
  settle_motors(walk_tick_);
  if (running_) {
    // one tick was remembered by the flag and runs now; the others are lost
    const std::int64_t since =
        floor_div(at - (line_.origin + walk_tick_ * kAgendaTickCycles), kAgendaTickCycles);
    if (since >= 1) {
      line_.origin += (since - 1) * kAgendaTickCycles;
      line_.late_tick = walk_tick_ + 1;
      line_.late_cycle = at;
      for (AgendaMotor& m : motors_) m.disturb();
    }
  }
  find_next_fire();
}

// --- costs and digest ------------------------------------------------------------------------------------

Cycle AgendaTimer::cost_of(const Node& node) const {
  return kAgendaNodeCycles + (count_of(node).counts() ? kAgendaCountCycles : 0);
}

Cycle AgendaTimer::take_walk_cost() { return std::exchange(walk_cost_, 0); }

void AgendaTimer::find_costs() {
  tick_cycles_ = kAgendaIsrCycles + (nodes_.empty() ? 0 : kAgendaListCycles);
  way_to_[0] = way_to_[1] = 0;
  for (const Node& node : nodes_) {
    const Cycle cycles = cost_of(node);
    tick_cycles_ += cycles;
    for (Wheel wheel : {Wheel::Left, Wheel::Right})
      if (node.serial >= serial_of(wheel)) way_to_[static_cast<std::size_t>(wheel)] += cycles;
  }
  if (scan_) find_moments();
}

// Firings that a tick may hold: none or one of either motor, a step or the coils' switching off.
void AgendaTimer::find_moments() {
  const std::array<Cycle, 5> key{tick_cycles_, motors_[0].step_cycles(), motors_[1].step_cycles(),
                                 motors_[0].saves_power(), motors_[1].saves_power()};
  if (key == moments_key_) return;
  moments_key_ = key;
  moment_count_ = 0;
  delayed_phases_ = 0;
  const auto add = [&](Cycle since) {
    for (int i = 0; i < moment_count_; ++i)
      if (moments_[i] == since) return;
    moments_[moment_count_++] = static_cast<std::int16_t>(since);
    delayed_phases_ |= 1u << since % kPhaseCycles;
  };
  for (Cycle since = 1; since <= kEntryCycles; ++since) add(since);
  const auto kinds = [](const AgendaMotor& m) {
    return std::array<Cycle, 4>{0, m.step_cycles(), m.step_cycles() + m.long_step_more(),
                                m.saves_power() ? m.off_cycles() : 0};
  };
  for (const Cycle one : kinds(motors_[0]))
    for (const Cycle other : kinds(motors_[1]))
      for (Cycle left = 0; left < kExitCycles; ++left) add(tick_cycles_ - kExitCycles + one + other + left);
}

Cycle AgendaTimer::firing_cycles(std::int64_t from, std::int64_t to) const {
  Cycle cycles = 0;
  for (const AgendaMotor& m : motors_) {
    const std::int64_t until = m.firings_until(to);
    if (until == 0) continue;
    const std::int64_t before = m.firings_until(from);
    cycles += m.cycles_of(before, until - before);
  }
  return cycles;
}

Cycle AgendaTimer::handler_cycles(Cycle from, Cycle to) const {
  if (!running_ || walking_) return 0;
  const std::int64_t first = std::max(ticks_at(from - 1), started_tick_), last = ticks_at(to - 1);
  return last <= first ? 0 : (last - first) * tick_cycles_ + firing_cycles(first, last);
}

std::uint64_t AgendaTimer::share_q32() const {
  if (!running_) return 0;
  const auto share = [](Cycle cycles, std::int64_t ticks) {
    return (static_cast<std::uint64_t>(cycles) << 32) / static_cast<std::uint64_t>(ticks * kAgendaTickCycles);
  };
  std::uint64_t sum = share(tick_cycles_, 1);
  for (const AgendaMotor& m : motors_)
    if (m.count.counts() && m.speed() != 0) sum += share(m.period_cycles(), m.full_period());
  return sum;
}

Cycle AgendaTimer::last_call(Cycle at) const {
  const std::int64_t tick = ticks_at(at - 1);
  return running_ && !walking_ && tick > started_tick_ ? line_.cycle_of(tick) : -1;
}

Cycle AgendaTimer::next_call(Cycle at) const {
  return running_ && !walking_ ? line_.cycle_of(std::max(ticks_at(at - 1), started_tick_) + 1) : host::kNever;
}

AgendaTimer::Wait AgendaTimer::first_wait(Cycle at, Cycle since, std::int64_t rounds) const {
  // a round moves an interrupt by 39 of the 59 phases of a tick; 56 rounds move it by one
  constexpr Cycle kPhases = kAgendaTickCycles / kPhaseCycles;
  constexpr Cycle kRoundsAPhase = 56;
  static_assert(kScanRoundCycles * kRoundsAPhase % kAgendaTickCycles == kPhaseCycles);
  Wait first{rounds + 1, 0};
  for (int i = 0; i < moment_count_; ++i) {
    const Cycle ahead = moments_[i] - since;
    if (ahead % kPhaseCycles != 0) continue;
    const Cycle phases = ahead / kPhaseCycles;
    std::int64_t round = (phases < 0 ? phases + kPhases : phases) * kRoundsAPhase % kPhases;
    for (; round < first.round; round += kPhases) {
      const Cycle wait = wait_at(at + round * kScanRoundCycles, moments_[i]);
      if (wait > 0) first = {round, wait};
    }
  }
  return first;
}

Cycle AgendaTimer::wait_at(Cycle at, Cycle since) const {
  if (since <= kEntryCycles) return kEntryCycles + 1 - since;
  const std::int64_t tick = ticks_at(at);
  const Cycle left =
      since - (tick_cycles_ - kExitCycles) - motors_[0].firing_cycles(tick) - motors_[1].firing_cycles(tick);
  return left >= 0 && left < kExitCycles ? kExitCycles - left : 0;
}

Cycle AgendaTimer::pins_at(Wheel wheel, std::int64_t tick, Cycle cycles) const {
  if (!scan_) return line_.cycle_of(tick);
  cycles -= kPinBlockCycles;
  if (walking_ && tick == walk_tick_) return scan_->done(walk_at_, cycles + walk_cost_) + kPinBlockCycles;
  const Wheel other = wheel == Wheel::Left ? Wheel::Right : Wheel::Left;
  cycles += kAgendaEntryCycles + way_to_[static_cast<std::size_t>(wheel)];
  if (walks_before(other, wheel)) cycles += motor(other).firing_cycles(tick);
  return scan_->served(line_.cycle_of(tick), cycles) + kPinBlockCycles;
}

std::uint64_t AgendaTimer::state_sum(Cycle at) const {
  std::uint64_t sum = static_cast<std::uint64_t>(ticks_at(at)) * 2 + (running_ ? 1 : 0);
  std::uint64_t factor = 0xA0761D6478BD642Fu;
  const auto add = [&](std::uint64_t part) {
    sum += part * factor;
    factor += 0xE7037ED1A0B428DAu;  // even, so the factor stays odd
  };
  // motors as the last command left them: what they have done since follows from the ticks
  for (const AgendaMotor& m : motors_) {
    add(static_cast<std::uint64_t>(m.count.tick) << 16 | m.count.counter);
    add(static_cast<std::uint64_t>(m.stepper.steps()));
    add(static_cast<std::uint64_t>(m.commanded));
    add(m.stepper.coils() | static_cast<std::uint64_t>(m.phase) << 8 |
        static_cast<std::uint64_t>(m.speed() + kMaxSpeed) << 16 | (m.phase_on ? 1ull << 40 : 0));
  }
  for (const Node& node : nodes_) add(node.count.cycle | std::uint64_t{node.serial} << 16);
  return sum;
}

}  // namespace board
