// SPDX-License-Identifier: MIT
// The host's places as instructions: functions that somebody else plays, and the way back from what a handler
// known by heart has called.
#include "dspic30/memory/host_places.h"

#include <algorithm>
#include <array>
#include <memory>

#include "dspic30/core/cpu.h"
#include "dspic30/core/memory_check.h"

namespace dspic {

namespace {

constexpr unsigned kRcount = sfr("RCOUNT"), kPsvpag = sfr("PSVPAG");

/// Calls function `index`. False: it waits, or there is none.
bool is_done(Cpu& cpu, unsigned index, Cycle at, bool again, HostResult& result) {
  cpu.parts.events.tell_change(at);
  result = cpu.host->call(cpu, index, at, again);
  cpu.note_written(0x00FF);  // what a function may leave
  return result.cycles > 0;
}

// the function is called here, or asked again: it stands until its time has come, then it returns
const Decoded* at_function(Cpu& cpu, const Decoded* d) {
  const Cycle at = cpu.true_now();
  // it is not asked before its time, however often the clock is looked at
  if (cpu.host_again && cpu.stands_at == d && at < cpu.stands_until) {
    cpu.note_effect();
    cpu.stand(cpu.stands_until, d);
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
    cpu.trap(Trap::AddressError);  // there is none
    return d;
  }
  if (cpu.host_stale) cpu.deadline = 0;
  cpu.note_effect();
  cpu.host_again = true;
  cpu.stand(result.wait_until, d);
  return d;
}

// what the handler has called is over; being there takes no time. The clock goes back behind what follows,
// for it may have been settled just now
const Decoded* at_handler_return(Cpu& cpu, const Decoded* d) {
  if (cpu.host_handlers > 0) {
    const Decoded* const following = cpu.go_on_with_handler(d);
    cpu.now -= d->cycles;
    return following;
  }
  cpu.trap(Trap::AddressError);
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
static const Decoded* stand_in_host(Cpu& cpu, const Decoded* d, Cycle at, Cycle until) {
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
  if (cpu.host_stale) cpu.follow_changed_host(d->cycles);
  return d + d->b;
}

const Decoded* jump_to_host(Cpu& cpu, const Decoded* d) {
  if (!cpu.host) return cpu.jump(kHostStart + 2 * static_cast<unsigned>(d->imm), d);
  cpu.host_again = false;
  return host_place(kHostStart + 2 * static_cast<unsigned>(d->imm));
}

bool Cpu::stands_in_host() const { return host_again && address_of_host_place(next) != 0; }

void Cpu::follow_changed_host(Cycle ahead) {
  // it stops anyway, or flags of handlers are to be followed
  if (deadline <= now || host_is_held || parts.interrupts.writes() != writes_seen) {
    deadline = 0;
    return;
  }
  host_stale = false;
  host_followed = true;
  now += ahead;
  settle();
  clocks.set_share(host->share_q32());
  host_due = host_comes ? host->due() : kNever;
  deadline = clocks.program_at(std::min({stop_at, pause_at, host_due}));
  now -= ahead;
}

// time goes on without the program, up to `until` or the deadline
void Cpu::stand(Cycle until, const Decoded* d) {
  const Cycle began = now;
  stands_until = until;
  stands_at = d;
  now = std::max(now + 1, std::min(deadline, clocks.program_at(until)));
  note_delay(began);
  now -= d->cycles;
}

// --- handlers known by heart

/// Of the stack, `words` from `begin` on: are they plain RAM below the limit, and nobody notes it?
bool Cpu::is_plain_frame(unsigned begin, unsigned words) const {
  const unsigned end = begin + 2 * words;
  return plain_bytes > 0 && !(begin & 1) && begin >= plain_start && end <= kRamEnd &&
         (!splim_on || end <= splim);
}

// how many of them are W0, W1, ... without a gap
static unsigned count_low(unsigned registers) { return static_cast<unsigned>(__builtin_ctz(~registers)); }

// registers from W0 up, then RCOUNT, PSVPAG, and others that are nobody's affair
void Cpu::push_frame(unsigned registers, int words) {
  const auto other = [&](int i) { return i == 0 ? rcount : i == 1 ? psvpag : std::uint16_t{0}; };
  const auto count = static_cast<unsigned>(__builtin_popcount(registers) + words);
  if (!is_plain_frame(w[15], count)) {
    // a stack that is full ends it there
    const auto is_full = [&] { return parts.interrupts.control().has_trap(Trap::StackError); };
    for (unsigned left = registers; left != 0 && !is_full(); left &= left - 1) push(w[__builtin_ctz(left)]);
    for (int i = 0; i < words && !is_full(); ++i) push(other(i));
    return;
  }
  unsigned at_byte = w[15] - kRamStart;
  const unsigned low = count_low(registers);
  std::memcpy(&ram[at_byte], w.data(), 2 * low);
  at_byte += 2 * low;
  for (unsigned left = registers >> low << low; left != 0; left &= left - 1, at_byte += 2)
    store(at_byte, w[__builtin_ctz(left)]);
  for (int i = 0; i < words; ++i, at_byte += 2) store(at_byte, other(i));
  w[15] = static_cast<std::uint16_t>(at_byte + kRamStart);
}

void Cpu::pop_frame(unsigned registers, int words) {
  const auto count = static_cast<unsigned>(__builtin_popcount(registers) + words);
  const unsigned begin = w[15] - 2 * count;
  const bool is_plain = is_plain_frame(begin, count);
  unsigned at_byte = w[15] - kRamStart;
  const auto next_word = [&] { return static_cast<std::uint16_t>(is_plain ? load(at_byte -= 2) : pop()); };
  for (int i = words; i-- > 0;) {
    const std::uint16_t word = next_word();
    if (i == 0) rcount = word & saved_register(kRcount).bits;
    if (i == 1 && psvpag != (word & saved_register(kPsvpag).bits)) {
      psvpag = word & saved_register(kPsvpag).bits;
      window_words = nullptr;
    }
  }
  const unsigned low = is_plain ? count_low(registers) : 0;
  for (unsigned left = registers >> low << low; left != 0;) {
    const unsigned highest = 31u - static_cast<unsigned>(__builtin_clz(left));
    w[highest] = next_word();
    left &= ~(1u << highest);
  }
  if (low > 0) std::memcpy(w.data(), &ram[at_byte - 2 * low], 2 * low);
  if (is_plain) w[15] = static_cast<std::uint16_t>(begin);
}

// as the interrupt and the handler's first instructions do
void Cpu::enter_handler() {
  if (memory_check) memory_check->cut(*this);
  const unsigned pc = address_of(next), level = static_cast<unsigned>(parts.interrupts.cpu().level());
  const Cycle entry = now;
  at = next;
  parts.events.tell_change(entry);
  if (repeating && window_was_free) now += kRepeatWindow;
  push(pc & 0xFFFF);
  push(sr_low() << 8 | (level & 8) << 4 | pc >> 16);
  repeating = false;
  const int vector = host->vector(0);
  now = parts.interrupts.enter(vector, now).first_instruction;
  if (course) course->handler_begins(vector, entry, now);
  parts.interrupts.lower(vector - kFirstIrqVector);
  push_frame(host->saved_registers(), host->saved_words());
  ++host_handlers;
  host->begin_handler(now);
  host_stale = true;
}

const Decoded* Cpu::go_on_with_handler(const Decoded* from) {
  note_effect();
  settle();
  parts.events.tell_change(now);
  const HandlerStep step = host->next_in_handler(now);
  now += step.cycles;
  deadline = 0;
  if (step.divides_by_zero) {
    at = host_place(kHostHandlerReturn);
    trap(Trap::MathError);
    return at;
  }
  if (step.function) {
    push_address(kHostHandlerReturn);
    at = host_place(kHostHandlerReturn);
    return jump(pointed(step.function & ~1u, at), from);
  }
  host->end_handler(now);
  --host_handlers;
  host_stale = true;
  pop_frame(host->saved_registers(), host->saved_words());
  const Decoded* const following = return_from_handler(from, kInterruptReturnCycles);
  now += kInterruptReturnCycles;
  return following;
}

}  // namespace dspic
