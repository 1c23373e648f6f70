// SPDX-License-Identifier: MIT
#include "hal_sim/api/host_library.h"

#include <cstdlib>

#include "dspic30/periph/vectors.h"
#include "hal_sim/api/host_functions.h"
#include "hal_sim/board/board.h"
#include "sim_core/base/hash.h"

namespace api {

namespace {

constexpr int kAgendaHandler = 0, kScanHandler = 1;
// the fourth cycle between flag and handler is the last one of the program's own instruction [DS70143 5.4, 19.1]
constexpr Cycle kEntryCycles = 3, kRetfieCycles = 3, kCallCycles = 2;

drivers::AgendaCosts costs_of(Level level) {
  const CallCycles& c = call_cycles(level);
  drivers::AgendaCosts costs;
  costs.empty = kEntryCycles + c.walk_empty + kRetfieCycles;
  costs.list = kEntryCycles + c.walk_begin + c.walk_end + kRetfieCycles;
  costs.paused = c.walk_paused;
  costs.resting = c.walk_resting;
  costs.counts = c.walk_counts;
  costs.fires = 0;
  costs.after = c.walk_after;
  costs.after_destroyed = c.walk_destroyed;
  costs.motor_half = c.share_motor_half;
  costs.motor_off = c.share_motor_off;
  costs.motor_step = c.share_motor_step;
  return costs;
}

/// Of all robots whose library was compiled alike.
const drivers::AgendaCosts& common_costs(Level level) {
  static const std::array<drivers::AgendaCosts, 4> kCosts = {
      costs_of(static_cast<Level>(0)), costs_of(static_cast<Level>(1)), costs_of(static_cast<Level>(2)),
      costs_of(static_cast<Level>(3))};
  return kCosts[static_cast<std::size_t>(level)];
}

}  // namespace

const std::array<HostLibrary::Method, kHostFunctionCount> HostLibrary::kMethods = {
#define HOST_FUNCTION(driver, name) &HostLibrary::name,
#include "hal_sim/api/host_table.inc"
};

HostLibrary::HostLibrary(board::Board& board, Served served)
    : board_(board),
      served_(served),
      cycles_(call_cycles(served.level)),
      drivers_(std::make_unique<drivers::Drivers>(board)),
      variables_(drivers_->scan(), cycles_),
      rhythm_(cycles_) {
  agendas().leave_flag_to_others();
  agendas().set_costs(common_costs(served.level));
  begin(0);
}

/// Nothing is enabled: the program holds both handlers off, until the core says otherwise.
void HostLibrary::begin(Cycle at) {
  agendas().name_motor(board::Wheel::Left, key_of(HostFunction::run_left_motor));
  agendas().name_motor(board::Wheel::Right, key_of(HostFunction::run_right_motor));
  agendas().hold(at);
  scan().hold(at);
  held_ = 1u << kAgendaHandler | 1u << kScanHandler;
}

// --- calls

HostResult HostLibrary::call(Cpu& cpu, unsigned index, Cycle at, bool again) {
  if (index == static_cast<unsigned>(HostFunction::e_get_prox) && is_right_reading(cpu, index) &&
      !cpu.watching) {
    cpu.w[0] = static_cast<std::uint16_t>(
        variables_.dark_less_lit(cpu.w[0], at + cycles_.prox_dark, at + cycles_.prox_lit));
    return HostResult::done(cycles_.prox);
  }
  return call_any(cpu, index, at, again);
}

HostResult HostLibrary::call_any(Cpu& cpu, unsigned index, Cycle at, bool again) {
  if (index >= kHostFunctionCount) return {};
  if (watch_ && !again && !is_right_reading(cpu, index)) watch_->called(static_cast<HostFunction>(index));
  return (this->*kMethods[index])({cpu, index, at, again});
}

/// By far the most calls: of a sensor that there is, and a scan was started. Nobody need hear of them.
inline bool HostLibrary::is_right_reading(const Cpu& cpu, unsigned index) const {
  return index >= static_cast<unsigned>(HostFunction::e_get_prox) &&
         index <= static_cast<unsigned>(HostFunction::e_get_ambient_light) &&
         cpu.w[0] < board::kRingSensors && variables_.was_started();
}

void HostLibrary::note(std::uint64_t what, Cycle at) {
  digest_ += sim::mix64(what ^ sim::mix64(static_cast<std::uint64_t>(at)));
}

/// The call changes something: by its function and arguments, in the digest.
void HostLibrary::effect(const Call& call) {
  call.cpu.note_effect();
  note(std::uint64_t{call.index} << 48 | std::uint64_t{call.word(1)} << 16 | call.word(0), call.at);
}

/// How the two handlers are in each other's way may be other than before; a hair's breadth is not worth a
/// look at all samples.
void HostLibrary::follow_ticks(Cycle at) {
  const Cycle round = rhythm_.round(agendas().shares().tick_cycles()), old = scan().clock().full_round;
  if (std::abs(round - old) > old / 1000) scan().set_round(round, at);
}

/// When the next agenda comes, and what the handlers take, may be other than before.
void HostLibrary::changed(const Call& call) {
  follow_ticks(call.at);
  call.cpu.host_changed();
}

void HostLibrary::reset(Cycle at) {
  // the board has told the drivers of it
  variables_.reset();
  heap_ = {};
  zero_steps_ = {};
  walk_begins_ = false;
  held_by_agendas_ = 0;
  owed_q32_ = 0;
  begin(at);
  note(~std::uint64_t{0}, at);
}

void HostLibrary::begin_anew(Cycle at) {
  agendas().forget(at);
  board_.pins().follow_motors(at);
  heap_ = {};
  zero_steps_ = {};
  note(3, at);
}

// --- registers

std::uint16_t HostLibrary::read(unsigned address, Cycle at) { return variables_.read(address, at); }

void HostLibrary::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle at) {
  for (const auto& [index, size] : {std::pair{HostVariable::e_last_mic_scan_id, drivers::kMicSamples},
                                    std::pair{HostVariable::e_last_acc_scan_id, drivers::kAccSamples}})
    if (watch_ && address == served_address(index) && lanes == 0xFFFF && value >= size)
      watch_->index_written(index, value, size);
  variables_.write(address, value, lanes, at);
}

Cycle HostLibrary::horizon(unsigned address, Cycle at) { return variables_.horizon(address, at); }

std::uint16_t HostLibrary::peek(unsigned address, Cycle at) const { return variables_.peek(address, at); }

// --- handlers

int HostLibrary::vector(int handler) const {
  if (handler == kAgendaHandler)
    return served_.agenda ? dspic::kFirstIrqVector + dspic::irq::T2 : dspic::kNoVector;
  return served_.scan ? dspic::kFirstIrqVector + dspic::irq::Adc : dspic::kNoVector;
}

// while its functions run, a tick finds them running, and the handler begins anew
Cycle HostLibrary::due() const {
  return agendas().ticks().is_walking() ? agendas().ticks().after(handler_began_)
                                        : agendas().ticks().next_interrupt();
}

Cycle HostLibrary::source_event(int handler, Cycle after) const {
  return handler == kAgendaHandler ? agendas().ticks().after(after) : scan().clock().interrupt_after(after);
}

Cycle HostLibrary::pending_cycles() const {
  return scan().clock().run.micro_only ? cycles_.share_scan_micro
                                       : cycles_.share_scan_round / drivers::kScanPeriod;
}

std::uint64_t HostLibrary::share_q32() const {
  std::uint64_t share = 0;
  if (!(held_ >> kAgendaHandler & 1))
    share += agendas().shares().share_q32() - agendas().shares().calling_share_q32();
  if (!(held_ >> kScanHandler & 1)) share += variables_.share_q32();
  return share;
}

void HostLibrary::hold_handler(int handler, bool held, bool pending, Cycle at) {
  const auto bit = static_cast<std::uint8_t>(1u << handler);
  if (!held) {
    if (held_by_agendas_ & bit) settle_hold(handler, at);
    held_by_agendas_ &= static_cast<std::uint8_t>(~bit);
  } else if (handler_ended_ < handler_began_) {
    held_by_agendas_ |= bit;
  }
  held_ = static_cast<std::uint8_t>(held ? held_ | bit : held_ & ~bit);
  if (handler == kAgendaHandler)
    held ? agendas().hold(at) : agendas().release(at, pending);
  else
    held ? scan().hold(at) : scan().release(at);
}

/// While the agendas' handler runs, no share is taken. Ticks that call a function keep the others away: what those take
/// in all is due all the same. The converter's events come meanwhile, and are charged one by one unless they are
/// lost: too much or too little where handlers and events beat slowly.
void HostLibrary::settle_hold(int handler, Cycle at) {
  // what stays held off, as if each event came for itself, is charged for itself
  constexpr Cycle kAtOnce = 2 * kRetfieCycles;
  if (at - handler_ended_ > kAtOnce) return;
  const Cycle took = at - handler_began_;
  if (handler == kAgendaHandler) {
    if (took < drivers::kAgendaTickCycles)
      owed_q32_ += took * static_cast<std::int64_t>(agendas().shares().share_q32() -
                                                    agendas().shares().calling_share_q32());
    return;
  }
  const Cycle first = source_event(kScanHandler, handler_began_);
  const bool has_come = first <= at;
  if (has_come && source_event(kScanHandler, first) <= at) return;
  owed_q32_ +=
      took * static_cast<std::int64_t>(variables_.share_q32()) - (has_come ? pending_cycles() << 32 : 0);
}

void HostLibrary::begin_handler(Cycle at) {
  handler_began_ = at;
  agendas().begin(at);
  walk_begins_ = true;
}

HandlerStep HostLibrary::next_in_handler(Cycle at) {
  HandlerStep step;
  const Function function = agendas().next(at, step.divides_by_zero);
  step.cycles = agendas().take_walk_cost();
  if (walk_begins_) step.cycles += agendas().list().size() == 0 ? cycles_.walk_empty : cycles_.walk_begin;
  // a walk that begins with no list has no end of its own
  const bool is_empty = walk_begins_ && agendas().list().size() == 0;
  walk_begins_ = false;
  step.function = address_of(function);
  if (function) step.cycles += kCallCycles;
  if (!function && !is_empty) step.cycles += cycles_.walk_end;
  if (step.divides_by_zero) step.cycles += cycles_.run_divides;
  note(step.function, at);
  if (watch_) watch_->calls_back(step.function, step.function ? at + step.cycles : at);
  return step;
}

void HostLibrary::end_handler(Cycle at) {
  handler_ended_ = at;
  agendas().finish(at);
  note(2, at);
}

}  // namespace api
