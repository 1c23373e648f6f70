// SPDX-License-Identifier: MIT
// The host's places as instructions: functions that somebody else plays, and the way back from what a handler
// known by heart has called.
#include "dspic30/memory/host_places.h"

#include <algorithm>
#include <array>

#include "dspic30/core/host_handlers.h"
#include "dspic30/core/memory_check.h"

namespace dspic {

namespace {

/// Calls function `index`. False: it waits, or there is none.
bool is_done(Cpu& cpu, unsigned index, Cycle at, bool again, HostResult& result) {
  cpu.parts.events.tell_change(at);
  result = cpu.host->call(cpu, index, at, again);
  cpu.note_written(0x00FF);  // what a function may leave
  return result.cycles > 0;
}

// goes by what handlers take from now on, `ahead` cycles from now, unless it stops before its next instruction
__attribute__((noinline)) void follow_changed_host(Cpu& cpu, Cycle ahead) {
  // it stops anyway, or flags of handlers are to be followed
  if (cpu.deadline <= cpu.now || cpu.host_is_held || cpu.parts.interrupts.writes() != cpu.writes_seen) {
    cpu.deadline = 0;
    return;
  }
  cpu.host_stale = false;
  cpu.host_followed = true;
  cpu.now += ahead;
  cpu.settle();
  cpu.clocks.correct(cpu.host->take_owed_q32());
  cpu.clocks.set_share(cpu.host->share_q32());
  cpu.host_due = cpu.host_comes ? cpu.host->due() : kNever;
  cpu.deadline = cpu.clocks.program_at(std::min({cpu.stop_at, cpu.pause_at, cpu.host_due}));
  cpu.now -= ahead;
}

// time goes on without the program, up to `until` or the deadline
void stand(Cpu& cpu, Cycle until, const Decoded* d) {
  const Cycle began = cpu.now;
  cpu.stands_until = until;
  cpu.stands_at = d;
  cpu.now = std::max(cpu.now + 1, std::min(cpu.deadline, cpu.clocks.program_at(until)));
  cpu.note_delay(began);
  cpu.now -= d->cycles;
}

// the function is called here, or asked again: it stands until its time has come, then it returns
const Decoded* at_function(Cpu& cpu, const Decoded* d) {
  const Cycle at = cpu.true_now();
  // it is not asked before its time, however often the clock is looked at
  if (cpu.host_again && cpu.stands_at == d && at < cpu.stands_until) {
    cpu.note_effect();
    stand(cpu, cpu.stands_until, d);
    return d;
  }
  HostResult result;
  if (is_done(cpu, static_cast<unsigned>(d->imm), at, cpu.host_again, result)) {
    cpu.host_again = false;
    if (cpu.host_stale) cpu.deadline = 0;
    cpu.now += result.cycles - d->cycles;
    const unsigned high = cpu.pop() & 0x7F, low = cpu.pop();
    return cpu.jump(high << 16 | (low & 0xFFFE), d);
  }
  if (result.wait_until <= at) {
    cpu.trap_at(cpu.address_of(d), TrapRecord::Access::Fetch);  // there is none
    return d;
  }
  if (cpu.host_stale) cpu.deadline = 0;
  cpu.note_effect();
  cpu.host_again = true;
  stand(cpu, result.wait_until, d);
  return d;
}

// what the handler has called is over; being there takes no time. The clock goes back behind what follows,
// for it may have been settled just now
const Decoded* at_handler_return(Cpu& cpu, const Decoded* d) {
  if (cpu.host_handlers > 0) {
    const Decoded* const following = go_on_with_handler(cpu, d);
    cpu.now -= d->cycles;
    return following;
  }
  cpu.trap_at(cpu.address_of(d), TrapRecord::Access::Fetch);
  return d;
}

std::array<Decoded, kHostPlaces> make_places() {
  std::array<Decoded, kHostPlaces> places;
  for (unsigned i = 0; i < kHostPlaces; ++i) {
    Decoded& d = places[i];
    d.run = i < kMostHostFunctions ? &at_function : &at_handler_return;
    d.imm = static_cast<std::int32_t>(i);
    d.cycles = 1;
    d.state = Decoded::Met;
  }
  return places;
}

}  // namespace

const std::array<Decoded, kHostPlaces> host_places = make_places();

// the function waits, or there is none: the program stands at it, with the address that it returns to
__attribute__((noinline)) static const Decoded* stand_in_host(Cpu& cpu, const Decoded* d, Cycle at,
                                                              Cycle until) {
  const unsigned place = kHostStart + 2 * static_cast<unsigned>(d->imm);
  if (cpu.host_stale) cpu.deadline = 0;
  cpu.push_address(cpu.address_of(d) + 2u * d->b);
  cpu.host_again = until > at;
  cpu.stands_until = until;
  cpu.stands_at = host_place(place);
  cpu.note_effect();
  return host_place(place);
}

// a function that does not wait needs no return address; d->cycles are the call's
const Decoded* call_host(Cpu& cpu, const Decoded* d) {
  if (!cpu.host) {  // an address beyond the flash like any other
    cpu.push_address(cpu.address_of(d) + 2u * d->b);
    return cpu.jump(kHostStart + 2 * static_cast<unsigned>(d->imm), d);
  }
  const Cycle at = cpu.clocks.true_at(cpu.now + d->cycles);
  HostResult result;
  if (!is_done(cpu, static_cast<unsigned>(d->imm), at, false, result))
    return stand_in_host(cpu, d, at, result.wait_until);
  cpu.now += result.cycles;
  if (cpu.host_stale) follow_changed_host(cpu, d->cycles);
  return d + d->b;
}

const Decoded* jump_to_host(Cpu& cpu, const Decoded* d) {
  if (!cpu.host) return cpu.jump(kHostStart + 2 * static_cast<unsigned>(d->imm), d);
  cpu.host_again = false;
  return host_place(kHostStart + 2 * static_cast<unsigned>(d->imm));
}

bool stands_in_host(const Cpu& cpu) { return cpu.host_again && address_of_host_place(cpu.next) != 0; }

// --- handlers known by heart

// as the interrupt and the handler's first instructions do
void enter_handler(Cpu& cpu) {
  if (cpu.memory_check) cpu.memory_check->cut(cpu);
  Interrupts& interrupts = cpu.parts.interrupts;
  const unsigned pc = cpu.address_of(cpu.next), level = static_cast<unsigned>(interrupts.cpu().level());
  const Cycle entry = cpu.now;
  cpu.at = cpu.next;
  cpu.parts.events.tell_change(entry);
  if (cpu.repeating && cpu.window_was_free) cpu.now += Cpu::kRepeatWindow;
  cpu.push(pc & 0xFFFF);
  cpu.push(cpu.sr_low() << 8 | (level & 8) << 4 | pc >> 16);
  cpu.repeating = false;
  const int vector = cpu.host->vector(0);
  cpu.now = interrupts.enter(vector, cpu.now).first_instruction;
  if (cpu.course) cpu.course->handler_begins(vector, entry, cpu.now);
  interrupts.lower(vector - kFirstIrqVector);
  cpu.push_frame(cpu.host->saved_registers(), cpu.host->saved_words());
  ++cpu.host_handlers;
  cpu.host->begin_handler(cpu.now);
  cpu.host_stale = true;
}

const Decoded* go_on_with_handler(Cpu& cpu, const Decoded* from) {
  cpu.note_effect();
  cpu.settle();
  cpu.parts.events.tell_change(cpu.now);
  const HandlerStep step = cpu.host->next_in_handler(cpu.now);
  cpu.now += step.cycles;
  cpu.deadline = 0;
  if (step.divides_by_zero) {
    cpu.at = host_place(kHostHandlerReturn);
    cpu.trap(Trap::MathError);
    return cpu.at;
  }
  if (step.function) {
    cpu.push_address(kHostHandlerReturn);
    cpu.at = host_place(kHostHandlerReturn);
    return cpu.jump(cpu.pointed(step.function & ~1u, cpu.at), from);
  }
  cpu.host->end_handler(cpu.now);
  --cpu.host_handlers;
  cpu.host_stale = true;
  cpu.pop_frame(cpu.host->saved_registers(), cpu.host->saved_words());
  const Decoded* const following = return_from_handler(cpu, from, kInterruptReturnCycles);
  cpu.now += kInterruptReturnCycles;
  return following;
}

}  // namespace dspic
