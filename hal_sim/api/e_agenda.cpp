// SPDX-License-Identifier: MIT
// motor_led/advance_one_timer/e_agenda.h. Source:
// [lib: motor_led/advance_one_timer/e_agenda.c], facts restated.
#include "hal_sim/api/host_functions.h"
#include "hal_sim/api/host_library.h"
#include "hal_sim/board/board.h"

namespace api {

namespace {

constexpr int kDone = 1, kNotFound = 2;                // EXIT_OK and AG_ALREADY_CREATED, AG_NOT_FOUND
constexpr unsigned kTickBit = 1u << 6, kEdgeBit = 1u;  // T2, INT0 [DS70143 5]
constexpr std::uint32_t kGoto = 0x040000, kGotoMask = 0xFF0000;

}  // namespace

/// What an agenda with this pointer is known by: a handle of one of the motors' functions is that function.
HostLibrary::Function HostLibrary::function_at(const Cpu& cpu, std::uint16_t pointer) const {
  const std::uint32_t word = cpu.program.read(pointer & ~1u);
  if ((word & kGotoMask) == kGoto) {
    const unsigned target = (cpu.program.read((pointer & ~1u) + 2) & 0x7F) << 16 | (word & 0xFFFE);
    for (HostFunction motor : {HostFunction::run_left_motor, HostFunction::run_right_motor})
      if (target == host_place(motor)) return key_of(motor);
  }
  return key_of(pointer);
}

Cycle HostLibrary::found_after(Function function, Cycle empty, Cycle missing, Cycle found, Cycle step) const {
  const int passed = agendas().list().passed(function), nodes = agendas().list().size();
  if (passed < nodes) return found + step * passed;
  return nodes == 0 ? empty : missing + step * (nodes - 1);
}

Cycle HostLibrary::cost_of_set_cycle(Function function) const {
  const CallCycles& c = cycles_;
  return found_after(function, c.set_cycle_empty, c.set_cycle_missing, c.set_cycle_found, c.set_cycle_step);
}

/// The list changes while the tick and the remote control's edge are held off: those that are let come again.
Cycle HostLibrary::cost_while_held(const Call& call, Cycle tick, Cycle edge) const {
  const unsigned enabled = call.cpu.read16(kIec0);
  return (enabled & kTickBit ? tick : 0) + (enabled & kEdgeBit ? edge : 0);
}

HostResult HostLibrary::e_start_agendas_processing(const Call& call) {
  effect(call);
  Cpu& cpu = call.cpu;
  cpu.write16(kIfs0, cpu.read16(kIfs0) & ~kTickBit);
  cpu.write16(kIec0, cpu.read16(kIec0) | kTickBit);
  const Cycle on = call.at + cycles_.agendas_start - kReturnCycles;
  agendas().start(on);
  board_.pins().follow_motors(on);
  changed(call);
  return HostResult::done(cycles_.agendas_start);
}

HostResult HostLibrary::e_end_agendas_processing(const Call& call) {
  effect(call);
  agendas().stop(call.at);
  board_.pins().follow_motors(call.at);
  changed(call);
  return HostResult::done(cycles_.agendas_stop);
}

/// What activating takes.
Cycle HostLibrary::activate(const Call& call, Function function, std::uint16_t cycle, Cycle at) {
  const CallCycles& c = cycles_;
  if (agendas().list().has(function))
    return c.activate_known + c.activate_known_step * agendas().list().passed(function);
  const int nodes = agendas().list().size();
  const NodeHeap::Search search = heap_.take(function);
  if (!search.found) {
    if (watch_) watch_->gives_up();
    call.cpu.ask_reset(dspic::ResetKind::Instruction);
    return cycles_.activate_new + c.activate_step * (nodes - 1) + search.used * c.malloc_used;
  }
  Cycle cost = nodes == 0 ? c.activate_empty : c.activate_new + c.activate_step * (nodes - 1);
  cost += (search.first ? c.malloc_first : 0) + search.used * c.malloc_used + search.merged * c.malloc_merge;
  if (search.merged > 0) cost += c.malloc_merges;
  cost += !search.split ? c.malloc_whole : search.followed ? c.malloc_followed : 0;
  cost += cost_while_held(call, c.activate_tick_on, c.activate_edge_on);
  agendas().activate(function, cycle, at);
  return cost;
}

HostResult HostLibrary::e_activate_agenda(const Call& call) {
  effect(call);
  const Cycle cost = activate(call, function_at(call.cpu, call.word(0)), call.word(1), call.at);
  board_.pins().follow_motors(call.at);
  changed(call);
  call.give(kDone);
  return HostResult::done(cost);
}

HostResult HostLibrary::e_destroy_agenda(const Call& call) {
  effect(call);
  const CallCycles& c = cycles_;
  const Function function = function_at(call.cpu, call.word(0));
  const int passed = agendas().list().passed(function), nodes = agendas().list().size();
  Cycle cost = 0;
  if (passed == nodes) {
    cost = cost_while_held(call, c.destroy_missing_tick_on, c.destroy_missing_edge_on);
    cost += nodes == 0 ? c.destroy_empty : c.destroy_missing + c.destroy_missing_step * (nodes - 1);
  } else {
    cost = cost_while_held(call, c.destroy_tick_on, c.destroy_edge_on);
    cost += passed == 0 ? c.destroy_first : c.destroy_second + c.destroy_step * (passed - 1);
    if (agendas().list().running(agendas().ticks()) == function) cost += c.destroy_running;
    if (agendas().list().following(agendas().ticks()) == function) cost += c.destroy_following;
    heap_.give_back(function);
  }
  const int result = agendas().destroy(function, call.at);
  board_.pins().follow_motors(call.at);
  changed(call);
  call.give(result);
  return HostResult::done(cost);
}

/// Shape of what changes an agenda that the list has; the change is the last that the function does.
template <typename Change>
HostResult HostLibrary::change_found(const Call& call, Cycle cost, Change change) {
  effect(call);
  const Function function = function_at(call.cpu, call.word(0));
  const Cycle then = call.at + cost - kReturnCycles;
  const int result = change(function, then);
  if (result != kNotFound) board_.pins().follow_motors(then);
  changed(call);
  call.give(result);
  return HostResult::done(cost);
}

HostResult HostLibrary::e_set_agenda_cycle(const Call& call) {
  const Cycle cost = cost_of_set_cycle(function_at(call.cpu, call.word(0)));
  return change_found(call, cost, [&](Function function, Cycle then) {
    return agendas().set_cycle(function, call.word(1), then);
  });
}

HostResult HostLibrary::e_reset_agenda(const Call& call) {
  const CallCycles& c = cycles_;
  const Cycle cost = found_after(function_at(call.cpu, call.word(0)), c.reset_empty, c.reset_missing,
                                 c.reset_found, c.reset_step);
  return change_found(call, cost,
                      [&](Function function, Cycle then) { return agendas().reset_count(function, then); });
}

HostResult HostLibrary::e_pause_agenda(const Call& call) {
  const CallCycles& c = cycles_;
  const Cycle cost = found_after(function_at(call.cpu, call.word(0)), c.pause_empty, c.pause_missing,
                                 c.pause_found, c.pause_step);
  return change_found(call, cost,
                      [&](Function function, Cycle then) { return agendas().pause(function, then); });
}

HostResult HostLibrary::e_restart_agenda(const Call& call) {
  const CallCycles& c = cycles_;
  const Cycle cost = found_after(function_at(call.cpu, call.word(0)), c.restart_empty, c.restart_missing,
                                 c.restart_found, c.restart_step);
  return change_found(call, cost,
                      [&](Function function, Cycle then) { return agendas().restart(function, then); });
}

}  // namespace api
