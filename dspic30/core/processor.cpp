// SPDX-License-Identifier: MIT
#include "dspic30/core/processor.h"

#include <algorithm>
#include <utility>

#include "dspic30/core/host_handlers.h"
#include "dspic30/core/memory_check.h"
#include "dspic30/core/waits.h"
#include "dspic30/memory/state_hash.h"

namespace dspic {

namespace {

// from the event that wakes to the next instruction [?]: Idle goes on at once; Sleep waits for the crystal
// (1024 periods of 7.3728 MHz) and for the PLL (20 us)
constexpr Cycle kResetCycles = 295;  // 20 us from a reset's cause to the first instruction [?]
constexpr Cycle kIdleWakeCycles = 2, kSleepWakeCycles = 2048 + 295;
// of handlers known by heart (note_hold()) [assumed: a sixth of a tick, since shorter sections change little,
// and 20 ticks, since sections that matter come again by then]
constexpr Cycle kLongHold = 250, kOneByOne = 30000;

}  // namespace

Processor::Processor(Dspic30f6014a& chip, ProgramMemory& program, std::shared_ptr<CodeStore> code,
                     HostCalls* host, unsigned plain_from)
    : cpu_(std::make_unique<Cpu>(chip.parts(), program, std::move(code))),
      waits_(std::make_unique<Waits>()),
      chip_(chip) {
  cpu_->host = host;
  cpu_->waits = waits_.get();
  if (host) cpu_->follow_host = [this] { follow_entry(); };
  cpu_->serve_ram(plain_from);
  for (std::size_t h = 0; host && h < irqs_.size(); ++h)
    if (const int vector = host->vector(static_cast<int>(h)); vector != kNoVector)
      irqs_[h] = vector - kFirstIrqVector;
}

Processor::~Processor() = default;

void Processor::restart() {
  rest_until_ = 0;
  asleep_since_ = kNever;
  cpu_->reset();
  cpu_->now += kResetCycles;
  cpu_->still_since = kNever;
  cpu_->clocks.reset(cpu_->now);
  waits_->begin_at(cpu_->now);
  by_heart_.fill({});
  held_ = 3;
  seen_ = kUnseen;
  cpu_->host_due = kNever;
}

void Processor::power_up(Cycle at) {
  restart();
  cpu_->ram.fill(0);
  cpu_->now = at;
  cpu_->clocks.reset(at);
  waits_->begin_at(at);
}

Processor::Still Processor::still() const {
  if (!is_asleep()) return {cpu_->still_since, cpu_->still_reads};
  ChipParts& parts = cpu_->parts;
  const std::uint64_t enabled = parts.interrupts.sources().enabled_mask();
  const bool ends =
      parts.system.watchdog_runs() || wakes_at() < kNever || (enabled & ~parts.interrupts.tally().standing);
  return ends ? Still{} : Still{std::min(asleep_since_, cpu_->now), false, enabled};
}

// --- the loop

// straight on until something else may happen; looks for waits come in between, and are jumped over
void Processor::execute() {
  Cpu& cpu = *cpu_;
  Cycle end = cpu.deadline;
  const Cycle stop = cpu.stop_at;
  const std::int64_t writes = cpu.writes_seen = cpu.parts.interrupts.writes();
  while (cpu.now < end) {
    if (waits_->is_due(cpu)) {
      waits_->go_on(cpu);
      if (cpu.deadline != end || cpu.host_followed || cpu.parts.interrupts.writes() != writes) return;
      if (cpu.repeating) return;
      continue;  // it may be due again at once, as it would be in a window that begins here
    }
    cpu.pause_at = std::max(waits_->look_at(cpu), cpu.now + 1);
    // by the true clock it is behind `end` anyway, as nearly always
    Cycle pause =
        cpu.pause_at >= cpu.clocks.true_at(end) ? end : std::min(end, cpu.clocks.program_at(cpu.pause_at));
    cpu.deadline = pause;
    if (cpu.looks_at_each())
      cpu.run_each();
    else
      cpu.run_straight();
    if (cpu.heads.is_met) cpu.deadline = cpu.heads.kept_deadline;
    if (cpu.host_followed) {  // by another clock now
      cpu.host_followed = false;
      end = cpu.clocks.program_at(std::min(cpu.stop_at, cpu.host_due));
      pause = std::min(end, cpu.clocks.program_at(cpu.pause_at));
    }
    cpu.pause_at = kNever;
    // something is due sooner, or may be; `end` may be too late then
    if (cpu.deadline != pause || cpu.stop_at != stop || cpu.repeating ||
        cpu.parts.interrupts.writes() != writes || cpu.is_code_stale())
      return;
    cpu.deadline = end;
  }
}

// It waits, and nobody has done anything since: the wait goes on. False: more is to be looked at.
bool Processor::rests(Cycle until) {
  Cpu& cpu = *cpu_;
  const Cycle rest = std::exchange(rest_until_, 0);
  if (rest <= cpu.now || !waits_->is_waiting() || cpu.host_stale) return false;
  cpu.settle();
  const Outlook outlook = cpu.parts.look(cpu.now);
  if (outlook.vector != kNoVector || outlook.reset_due || outlook.horizon < rest || cpu.is_code_stale())
    return false;
  const Cycle end = cpu.deadline = cpu.clocks.program_at(std::min(until, rest));
  waits_->go_on(cpu);
  if (cpu.deadline != end || !waits_->is_waiting()) return false;
  cpu.settle();
  if (cpu.now < until) return false;
  rest_until_ = rest;
  return true;
}

std::optional<ResetKind> Processor::run(Cycle until) {
  Cpu& cpu = *cpu_;
  if (rest_until_ > 0 && cpu.now < until && rests(until)) return std::nullopt;
  Cycle rest = 0;
  while (true) {
    // The run ends with a reset, or with the window.
    cpu.settle();
    if (cpu.reset_due) return cpu.reset_due;
    if (cpu.returned) waits_->resume(cpu);
    if (cpu.now >= until) {
      rest_until_ = rest;
      return std::nullopt;
    }
    rest = 0;
    // The chip says what comes next: a reset, an interrupt, or nothing up to the horizon.
    Outlook outlook = cpu.parts.look(cpu.now);
    if (outlook.reset_due) return chip_.reset_due(cpu.now);
    if (cpu.is_code_stale()) cpu.choose_code();
    // Of the handlers known by heart it may be that one is let in or held off from now on, or that one comes
    // before the chip's own interrupts.
    if (cpu.host && follow_host(outlook.vector)) continue;
    if (cpu.power != Cpu::Power::On) {
      sleep(until);
      continue;
    }
    if (cpu.host && is_host_first(outlook.vector)) {
      begin_handler();
      // straight on, unless something else is to be looked at first
      outlook.horizon = cpu.parts.interrupt_horizon();
      if (outlook.horizon <= cpu.now || cpu.now >= until || cpu.host_stale || cpu.is_code_stale()) continue;
      outlook.vector = kNoVector;
    }
    // the one that calls nothing comes when its flag is set, as an interrupt does
    if (irqs_[1] >= 0 && outlook.vector == kFirstIrqVector + irqs_[1] && !is_held(1)) {
      serve_pending(outlook.vector);
      continue;
    }
    // An interrupt is taken: its routine is known and done at once, or the program goes to its vector.
    if (outlook.vector != kNoVector) {
      if (const KnownHandler known = cpu.table().known_handlers();
          known && outlook.vector >= kFirstIrqVector && known(cpu, outlook.vector, until))
        continue;
      waits_->cut(cpu, outlook.vector);
      enter_interrupt(outlook.vector);
      if (cpu.host) continue;  // its level may hold handlers off
      outlook.horizon = cpu.parts.interrupt_horizon(outlook.vector);
      if (outlook.horizon <= cpu.now) continue;
    }
    // The program runs on, up to the next instant at which anything else may happen.
    cpu.deadline = cpu.stop_at = std::min(until, outlook.horizon);
    Cycle disi = kNever;
    if (cpu.host) {
      cpu.host_followed = false;
      disi = disi_horizon();
      cpu.stop_at = std::min(cpu.deadline, disi);
      cpu.deadline = cpu.clocks.program_at(std::min(cpu.deadline, host_horizon()));
    }
    if (cpu.repeating && waits_->is_away()) cpu.next = cpu.run_repeated(cpu.next);
    cpu.soonest = outlook.horizon;
    execute();
    // It waits at the end, nothing was written, and DISI lets no handler known by heart in from now on: the next
    // window may go on from there (rests()).
    if (waits_->is_waiting() && cpu.deadline > 0 && !cpu.host_stale && !cpu.returned &&
        cpu.parts.interrupts.writes() == cpu.writes_seen && cpu.now < disi)
      rest = std::min(cpu.soonest, host_horizon());
  }
}

// an enabled flag wakes whatever its priority, and so does the watchdog
void Processor::sleep(Cycle until) {
  Cpu& cpu = *cpu_;
  if (asleep_since_ == kNever) cpu.host_stale = true;
  asleep_since_ = std::min(asleep_since_, cpu.now);
  const Cycle wakes = wakes_at();
  if (wakes <= cpu.now || cpu.parts.system.woke()) {
    asleep_since_ = kNever;
    cpu.now += cpu.power == Cpu::Power::Sleep ? kSleepWakeCycles : kIdleWakeCycles;
    cpu.power = Cpu::Power::On;
    cpu.parts.awake(cpu.now);
    cpu.host_stale = true;  // sources of handlers known by heart stand in Sleep
    return;
  }
  const Cycle next = std::min({chip_.next_event(cpu.now), host_horizon(), wakes});
  const Cycle own = cpu.clocks.own_cycles(cpu.now), began = cpu.now;
  cpu.now = cpu.clocks.program_at(std::clamp(next, cpu.now + 1, std::max(until, cpu.now + 1)));
  slept_ += cpu.clocks.own_cycles(cpu.now) - own;
  if (cpu.course) cpu.course->waited(began, cpu.true_now());
}

Cycle Processor::wakes_at() const {
  Interrupts& interrupts = cpu_->parts.interrupts;
  return interrupts.sources().wakes_at(~interrupts.tally().standing, std::min(asleep_since_, cpu_->now));
}

// --- whoever plays the library

/// Of the handlers known by heart, a bit each: which ones the program holds off, by its level, DISI, their
/// IEC bits, or by what goes before them; asleep all are, and beside the vectors of the other table, which
/// lead elsewhere. And, from kFlagsAt on, whose flags are set.
inline unsigned Processor::handlers(int next_vector) const {
  const Cpu& cpu = *cpu_;
  const Interrupts& interrupts = cpu.parts.interrupts;
  constexpr int kMostHeldByDisi = 6;
  const bool all = cpu.power != Cpu::Power::On || interrupts.control().uses_alternate_table();
  const int floor = interrupts.cpu().disi_active(cpu.now)
                        ? std::max(interrupts.cpu().level(), kMostHeldByDisi)
                        : interrupts.cpu().level();
  unsigned state = 0;
#pragma GCC unroll 2
  for (unsigned h = 0; h < HostCalls::kHandlers; ++h) {
    const int irq = irqs_[h];
    if (irq < 0) {
      state |= held_ & 1u << h;
      continue;
    }
    const bool flag = interrupts.sources().flag(irq);
    const bool by_program = all || !interrupts.sources().enabled(irq) ||
                            interrupts.sources().priority(irq) <= floor ||
                            (flag && next_vector != kFirstIrqVector + irq),
               held = by_program || (!flag && by_heart_[h].one_by_one_until > 0);
    state |= static_cast<unsigned>(held) << h | static_cast<unsigned>(flag) << (kFlagsAt + h) |
             static_cast<unsigned>(by_program) << (kByProgramAt + h);
  }
  return state;
}

// which handlers known by heart are held off, when the next one comes, and what they take. True: a flag was
// set, and all is to be looked at again
__attribute__((always_inline)) inline bool Processor::follow_host(int next_vector) {
  Cpu& cpu = *cpu_;
  // nothing has changed since the last time
  const unsigned state = handlers(next_vector);
  if (!cpu.host_stale && state == seen_ && cpu.now < std::min(by_heart_[0].source, by_heart_[1].source))
    return false;
  return follow_changed_handlers(state, next_vector);
}

/// A handler has just begun, so that none is let in: what comes at this very instant sets its flag first.
void Processor::follow_entry() {
  while (follow_host(kNoVector)) {
  }
}

bool Processor::follow_changed_handlers(unsigned state, int next_vector) {
  Cpu& cpu = *cpu_;
  Interrupts& interrupts = cpu.parts.interrupts;
  bool raised = false, raised_own = false;
  for (std::size_t h = 0; h < irqs_.size(); ++h) {
    const int irq = irqs_[h], number = static_cast<int>(h);
    if (irq < 0) continue;
    const unsigned bit = 1u << h;
    ByHeart& handler = by_heart_[h];
    if (note_hold(h, (state >> (kByProgramAt + h) & 1) != 0)) state = handlers(next_vector);
    // events that came while it was held off set its flag
    const bool has_come = handler.source <= cpu.now || handler.missed_at > 0;
    if ((held_ & bit) && has_come && raise_held(h)) {
      raised = true;  // it is let in, if at all, once that was looked at
      continue;
    }
    const bool pending = (state >> (kFlagsAt + h) & 1) != 0;
    // a flag that the program has set brings it once more
    if (!((state | held_) & bit) && pending) {
      cpu.host->hold_handler(number, true, false, cpu.now);
      held_ |= bit;
    }
    // From here on only those that are let in or held off just now.
    if (!((state ^ held_) & bit)) continue;
    held_ ^= bit;
    if (!is_held(h) && handler.one_by_one_until <= cpu.now) handler.one_by_one_until = 0;
    if (!is_held(h) && handler.missed_at > 0) count_missed(h);
    // it was due just now
    if (is_held(h) && h == 0 && cpu.host_due <= cpu.now) {
      interrupts.raise(irq, cpu.host_due);
      raised_own = true;
    }
    cpu.parts.events.tell_change(cpu.now);
    cpu.host->hold_handler(number, is_held(h), pending, cpu.now);
    cpu.host_stale = true;
    // what waits for this handler is asked again, and what it looks at stands, or moves again
    const bool is_asked = !is_held(h) && stands_in_host(cpu) && cpu.stands_until == kNever;
    if (is_asked) cpu.stands_until = cpu.now;
    if (is_asked || waits_->is_waiting()) waits_->stir(cpu);
  }
  // a flag of one that is let in is looked at each time
  constexpr unsigned kAll = (1u << HostCalls::kHandlers) - 1;
  const bool is_let_in = (state >> kFlagsAt & kAll & ~held_) != 0;
  seen_ = raised || raised_own || is_let_in ? kUnseen : state;
  if (raised) return true;
  if (!cpu.host_stale) return false;
  cpu.host_stale = false;
  // When the sources of those that are held off come next, and what the others take.
  cpu.host_is_held = false;
  for (std::size_t h = 0; h < irqs_.size(); ++h) {
    if (irqs_[h] < 0) continue;
    ByHeart& handler = by_heart_[h];
    cpu.host_is_held |= is_held(h);
    if (handler.missed_at == 0) handler.source = is_held(h) ? source_event(h, cpu.now) : kNever;
  }
  cpu.clocks.correct(cpu.host->take_owed_q32());
  cpu.clocks.set_share(cpu.host->share_q32());
  // held off by its level alone it wakes the processor all the same
  cpu.host_comes = irqs_[0] >= 0 && interrupts.sources().enabled(irqs_[0]);
  cpu.host_due = cpu.host_comes ? cpu.host->due() : kNever;
  return false;
}

/// A program that holds a handler off for long, now and again, finds it at instants that a share of each cycle
/// does not tell: for a while each of its events sets its flag, as if it were held off until then. The same goes
/// for another handler known by heart that holds it off for long twice within such a while. True: that begins
/// now.
bool Processor::note_hold(std::size_t h, bool by_program) {
  const Cpu& cpu = *cpu_;
  ByHeart& handler = by_heart_[h];
  if (by_program == handler.held_by_program) return false;
  handler.held_by_program = by_program;
  if (by_program) {
    handler.is_held_by_other = cpu.host_handlers > 0;
    handler.held_since = handler.is_held_by_other && h == 0 ? kNever : cpu.now;
    return false;
  }
  if (handler.held_since == kNever || cpu.now - handler.held_since < kLongHold) return false;
  if (handler.is_held_by_other && cpu.now - std::exchange(handler.held_at, cpu.now) > kOneByOne) return false;
  const bool begins = handler.one_by_one_until == 0;
  handler.one_by_one_until = cpu.now + kOneByOne;
  return begins;
}

/// When the source of a handler known by heart sets its flag next: in Sleep never.
Cycle Processor::source_event(std::size_t h, Cycle after) const {
  const Cpu& cpu = *cpu_;
  return cpu.power == Cpu::Power::Sleep ? kNever : cpu.host->source_event(static_cast<int>(h), after);
}

/// Sets the flag of a handler that is held off, as its source does. A second event is lost, and told; those
/// behind it are counted when the flag falls.
bool Processor::raise_held(std::size_t h) {
  Cpu& cpu = *cpu_;
  Interrupts& interrupts = cpu.parts.interrupts;
  ByHeart& handler = by_heart_[h];
  const int irq = irqs_[h];
  if (handler.missed_at > 0 && !interrupts.sources().flag(irq)) count_missed(h);
  bool raises = false;
  while (handler.source <= cpu.now) {
    raises = true;
    const bool was_set = interrupts.sources().flag(irq);
    interrupts.raise(irq, handler.source);
    const Cycle next = source_event(h, handler.source);
    if (was_set) {
      handler.missed_at = handler.source;
      interrupts.tally().missing.begin(irq, handler.source, std::max<Cycle>(1, next - handler.source));
    }
    handler.source = was_set ? kNever : next;
  }
  if (raises) waits_->hint(cpu);  // perhaps it waits for this
  return raises;
}

void Processor::count_missed(std::size_t h) {
  Cpu& cpu = *cpu_;
  ByHeart& handler = by_heart_[h];
  const Cycle next = source_event(h, cpu.now);
  // one that stands by now came no more, as far as anybody knows
  Interrupts& interrupts = cpu.parts.interrupts;
  interrupts.note_missed(
      irqs_[h], interrupts.tally().missing.end(irqs_[h], next < kNever ? cpu.now : handler.missed_at),
      cpu.now);
  handler.missed_at = 0;
  handler.source = next;
}

/// The handler that calls the program. What it holds off is held from its first cycle on.
void Processor::begin_handler() {
  Cpu& cpu = *cpu_;
  ++cpu.handlers_begun;
  waits_->cut(cpu, kFirstIrqVector + irqs_[0]);
  enter_handler(cpu);
  cpu.host_due = kNever;
  follow_entry();
  lose_until_cleared();
  const bool overflows = cpu.parts.interrupts.control().has_trap(Trap::StackError);
  cpu.next = overflows ? host_place(kHostHandlerReturn) : go_on_with_handler(cpu, cpu.next);
}

/// The handler's own code clears its flag behind what it saves: an event that comes until then is lost.
void Processor::lose_until_cleared() {
  Cpu& cpu = *cpu_;
  ByHeart& handler = by_heart_[0];
  const Cycle saves = __builtin_popcount(cpu.host->saved_registers()) + cpu.host->saved_words();
  constexpr Cycle kClears = 1;  // and makes ready for constants, one instruction more
  if (handler.source > cpu.now + saves + kClears) return;
  cpu.parts.interrupts.note_missed(irqs_[0], 1, handler.source);
  handler.source = source_event(0, handler.source);
}

/// The handler that calls nothing was pending.
void Processor::serve_pending(int vector) {
  Cpu& cpu = *cpu_;
  ++cpu.handlers_begun;
  Interrupts& interrupts = cpu.parts.interrupts;
  const int level = interrupts.cpu().level();
  waits_->cut(cpu, vector);
  interrupts.enter(vector, cpu.now);
  interrupts.lower(vector - kFirstIrqVector);
  follow_entry();
  cpu.now += cpu.host->pending_cycles();
  cpu.settle();
  interrupts.leave_to(level, cpu.now - kInterruptReturnCycles);
  cpu.returned = true;
}

/// Does the handler known by heart begin now, rather than that of `vector`?
bool Processor::is_host_first(int vector) const {
  const Cpu& cpu = *cpu_;
  if (is_held(0)) return false;
  if (vector != kNoVector && vector == kFirstIrqVector + irqs_[0]) return true;
  if (cpu.host_due > cpu.now) return false;
  if (vector == kNoVector) return true;
  if (vector < kFirstIrqVector) return false;
  const Interrupts& interrupts = cpu.parts.interrupts;
  const int priority = interrupts.sources().priority(irqs_[0]),
            other = interrupts.sources().priority(vector - kFirstIrqVector);
  return priority > other || (priority == other && kFirstIrqVector + irqs_[0] < vector);
}

/// The next instant at which something comes of the host's handlers.
Cycle Processor::host_horizon() const {
  const Cpu& cpu = *cpu_;
  if (!cpu.host) return kNever;
  const Cycle due = is_held(0) && cpu.host_due <= cpu.now ? kNever : cpu.host_due;
  return std::min({disi_horizon(), due, by_heart_[0].source, by_heart_[1].source});
}

Cycle Processor::disi_horizon() const {
  const Interrupts& interrupts = cpu_->parts.interrupts;
  return interrupts.cpu().disi_active(cpu_->now) ? interrupts.cpu().disi_until() : kNever;
}

Cycle Processor::idle_until() const {
  const Cpu& cpu = *cpu_;
  if (rest_until_ > cpu.now && waits_->is_waiting() && !cpu.host_stale)
    return std::min(rest_until_, waits_->until(cpu));
  const bool stands = stands_in_host(cpu);
  if (!stands && !is_asleep() && !waits_->is_waiting()) return 0;
  const Outlook outlook = cpu.parts.look(cpu.now);
  // what handlers take may be another from now on
  if (cpu.host && (cpu.host_stale || handlers(outlook.vector) != seen_)) return 0;
  if (outlook.reset_due || (cpu.host_due <= cpu.now && !is_held(0))) return 0;
  Cycle until = std::min(chip_.next_event(cpu.now), host_horizon());
  if (is_asleep()) return std::min(until, wakes_at());
  if (outlook.vector != kNoVector) return 0;
  if (stands) until = std::min(until, cpu.stands_until);
  if (waits_->is_waiting()) until = std::min(until, waits_->until(cpu));
  return until;
}

void Processor::stir() {
  rest_until_ = 0;
  waits_->stir(*cpu_);
}

void Processor::enter_interrupt(int vector) {
  Cpu& cpu = *cpu_;
  const Cycle began = cpu.now;
  cpu.parts.events.tell_change(began);
  if (cpu.memory_check) cpu.memory_check->cut(cpu);
  cpu.at = cpu.next;  // what the stack's pushes belong to
  const unsigned pc = cpu.address_of(cpu.next),
                 level = static_cast<unsigned>(cpu.parts.interrupts.cpu().level());
  if (cpu.repeating && cpu.window_was_free) cpu.now += Cpu::kRepeatWindow;
  cpu.push(pc & 0xFFFF);
  cpu.push(cpu.sr_low() << 8 | (level & 8) << 4 | pc >> 16);
  cpu.repeating = false;
  const InterruptEntry entry = cpu.parts.interrupts.enter(vector, cpu.now);
  cpu.now = entry.first_instruction;
  if (cpu.course) cpu.course->handler_begins(vector, began, cpu.now);
  cpu.next = cpu.jump(cpu.program.read(entry.address) & 0x7FFFFE, cpu.next);
}

// --- what others look at

Cycle Processor::idle(Cycle at) const {
  const Cpu& cpu = *cpu_;
  const Cycle now = std::max(cpu.now, cpu.clocks.program_at(at));
  const Cycle own = cpu.clocks.own_cycles(now) - cpu.clocks.own_cycles(cpu.now);
  const bool passes = is_asleep() || stands_in_host(cpu);
  return slept_ + cpu.delayed + waits_->waited(cpu, now) + (passes ? own : 0);
}
Cycle Processor::waiting_since() const {
  const Cpu& cpu = *cpu_;
  if (is_asleep()) return std::min(asleep_since_, cpu.now);
  if (waits_->is_waiting()) return waits_->since();
  return stands_in_host(cpu) ? cpu.true_now() : kNever;
}
void Processor::set_translator(Translator* translator) { cpu_->translator = translator; }
void Processor::tell_calls(ProgramWatch* watch, std::vector<std::uint32_t> addresses) {
  if (std::exchange(cpu_->onlooker, watch) != watch) return cpu_->tell_calls(std::move(addresses));
  for (const std::uint32_t address : addresses) cpu_->tell_also(address);
}
void Processor::tell_course(CourseWatch* watch) { cpu_->course = watch; }
void Processor::know(std::shared_ptr<const KnownCalls> calls) { cpu_->know(std::move(calls)); }
void Processor::check_memory(MemoryCheck* check) { cpu_->check_memory(check); }
void Processor::translate_all() {
  cpu_->hot = 0;
  cpu_->forget_code();
}
Cycle Processor::now() const { return cpu_->true_now(); }
Cycle Processor::own_cycles() const { return cpu_->clocks.own_cycles(cpu_->now); }
void Processor::wait_until(Cycle at) {
  rest_until_ = 0;
  cpu_->now = std::max(cpu_->now, at);
  cpu_->clocks.reset(cpu_->now);
}
bool Processor::is_asleep() const { return cpu_->power != Cpu::Power::On; }
unsigned Processor::pc() const { return cpu_->address_of(cpu_->next); }
unsigned Processor::pc_of_access() const { return cpu_->at ? cpu_->address_of(cpu_->at) : pc(); }
std::uint16_t Processor::w(int n) const { return cpu_->w[static_cast<std::size_t>(n)]; }
std::uint16_t Processor::sr() const { return static_cast<std::uint16_t>(cpu_->sr()); }
std::uint8_t Processor::ram(unsigned address) const { return cpu_->ram[address - Cpu::kRamStart]; }
const std::uint8_t* Processor::ram() const { return cpu_->ram.data(); }
void Processor::set_ram(unsigned address, std::uint8_t value) { cpu_->ram[address - Cpu::kRamStart] = value; }
void Processor::fill_ram(const std::array<std::uint8_t, kRamBytes>& bytes) { cpu_->ram = bytes; }

void Processor::set_w(int n, std::uint16_t value) {
  cpu_->w[static_cast<std::size_t>(n)] = value;
  cpu_->note_written(1u << n);
}

std::uint64_t Processor::state_hash() const {
  std::uint64_t h = 0xCBF29CE484222325u;
  const auto add = [&h](std::uint64_t v) { h = (h ^ v) * 0x100000001B3u; };
  add(hash_of_memory(cpu_->ram.data(), cpu_->ram.size()));
  for (const std::uint16_t w : cpu_->w) add(w);
  for (const std::uint16_t saved : {cpu_->tblpag, cpu_->psvpag, cpu_->rcount}) add(saved);
  for (const std::int64_t a : cpu_->acc) add(static_cast<std::uint64_t>(a));
  add(static_cast<std::uint64_t>(cpu_->now));
  add(pc());
  add(cpu_->sr());
  return h;
}

}  // namespace dspic
