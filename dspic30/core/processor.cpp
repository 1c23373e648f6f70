// SPDX-License-Identifier: MIT
#include "dspic30/core/processor.h"

#include <algorithm>
#include <utility>

#include "dspic30/core/cpu.h"
#include "dspic30/core/waits.h"
#include "dspic30/memory/state_hash.h"

namespace dspic {

namespace {

// from the event that wakes to the next instruction [?]: Idle goes on at once; Sleep waits for the crystal
// (1024 periods of 7.3728 MHz) and for the PLL (20 us)
constexpr Cycle kResetCycles = 295;  // 20 us from a reset's cause to the first instruction [?]
constexpr Cycle kIdleWakeCycles = 2, kSleepWakeCycles = 2048 + 295;

}  // namespace

Processor::Processor(Dspic30f6014a& chip, ProgramMemory& program, std::shared_ptr<CodeStore> code,
                     HostCalls* host, unsigned plain_from)
    : cpu_(std::make_unique<Cpu>(chip.parts(), program, std::move(code))),
      waits_(std::make_unique<Waits>()),
      chip_(chip) {
  cpu_->host = host;
  cpu_->serve_ram(plain_from);
  for (std::size_t h = 0; host && h < irqs_.size(); ++h)
    if (const int vector = host->vector(static_cast<int>(h)); vector != kNoVector)
      irqs_[h] = vector - kFirstIrqVector;
}

Processor::~Processor() = default;

void Processor::restart() {
  waits_->forget(*cpu_);
  cpu_->reset();
  cpu_->now += kResetCycles;
  cpu_->still_since = kNever;
  cpu_->clocks.reset(cpu_->now);
  held_.fill(true);
}

void Processor::power_up(Cycle at) {
  restart();
  cpu_->ram.fill(0);
  cpu_->now = at;
  cpu_->clocks.reset(at);
}

Cycle Processor::still_since() const { return cpu_->still_since; }
bool Processor::still_reads() const { return cpu_->still_reads; }

// --- the loop -------------------------------------------------------------------------------------------

// straight on until something else may happen; looks for waits come in between, and are jumped over
void Processor::execute() {
  Cpu& cpu = *cpu_;
  const Cycle end = cpu.deadline;
  const std::int64_t writes = cpu.writes_seen = cpu.parts.bus.writes();
  while (cpu.now < end) {
    if (waits_->is_due(cpu)) {
      waits_->go_on(cpu);
      if (cpu.deadline != end || cpu.host_followed || cpu.parts.bus.writes() != writes) return;
      if (cpu.repeating) return;
      continue;  // it may be due again at once, as it would be in a window that begins here
    }
    cpu.pause_at = std::max(waits_->look_at(cpu), cpu.now + 1);
    const Cycle pause = std::min(end, cpu.clocks.program_at(cpu.pause_at));
    cpu.deadline = pause;
    if (cpu.looks_at_each())
      cpu.run_each();
    else
      cpu.run_straight();
    cpu.pause_at = kNever;
    if (cpu.head_met) cpu.deadline = cpu.kept_deadline;
    if (cpu.deadline != pause || cpu.host_followed || cpu.repeating || cpu.parts.bus.writes() != writes ||
        cpu.is_code_stale())
      return;
    cpu.deadline = end;
  }
}

std::optional<ResetKind> Processor::run(Cycle until) {
  Cpu& cpu = *cpu_;
  while (true) {
    if (cpu.reset_due) return cpu.reset_due;
    cpu.settle();
    if (cpu.returned) waits_->resume(cpu);
    if (cpu.now >= until) return std::nullopt;
    Outlook outlook = cpu.parts.look(cpu.now);
    if (outlook.reset_due) return chip_.reset_due(cpu.now);
    if (cpu.is_code_stale()) {
      cpu.choose_code();
      waits_->forget(cpu);
    }
    if (cpu.host) follow_host();
    if (cpu.power != Cpu::Power::On) {
      sleep(until);
      continue;
    }
    if (cpu.host && is_host_first(outlook.vector)) {
      waits_->cut(cpu);
      cpu.begin_handler();
      continue;
    }
    if (outlook.vector != kNoVector) {
      waits_->cut(cpu);
      enter_interrupt(outlook.vector);
      if (cpu.host) continue;  // its level may hold handlers off
      outlook.horizon = cpu.parts.interrupt_horizon(outlook.vector);
      if (outlook.horizon <= cpu.now) continue;
    }
    cpu.deadline = std::min(until, outlook.horizon);
    if (cpu.host) {
      cpu.host_followed = false;
      cpu.stop_at = std::min(cpu.deadline, disi_horizon());
      cpu.deadline = cpu.clocks.program_at(std::min(cpu.deadline, host_horizon()));
    }
    if (cpu.repeating && waits_->is_away()) cpu.next = cpu.run_repeated(cpu.next);
    execute();
  }
}

// an enabled flag wakes whatever its priority, and so does the watchdog
void Processor::sleep(Cycle until) {
  Cpu& cpu = *cpu_;
  const Cycle wakes = std::min(cpu.parts.interrupts.wakes_at(), cpu.host_due);
  if (wakes <= cpu.now || cpu.parts.system.woke()) {
    cpu.now += cpu.power == Cpu::Power::Sleep ? kSleepWakeCycles : kIdleWakeCycles;
    cpu.power = Cpu::Power::On;
    cpu.parts.system.awake();
    return;
  }
  const Cycle next = std::min({chip_.next_event(cpu.now), host_horizon(), wakes});
  const Cycle own = cpu.clocks.own_cycles(cpu.now);
  cpu.now = cpu.clocks.program_at(std::clamp(next, cpu.now + 1, std::max(until, cpu.now + 1)));
  slept_ += cpu.clocks.own_cycles(cpu.now) - own;
}

// --- whoever plays the library --------------------------------------------------------------------------

/// Does the program hold a handler known by heart off? In Sleep, timer and converter stand.
bool Processor::is_held(int irq) const {
  const Interrupts& interrupts = cpu_->parts.interrupts;
  const int priority = interrupts.priority(irq);
  return !interrupts.enabled(irq) || priority <= interrupts.level() || cpu_->power == Cpu::Power::Sleep ||
         (priority < 7 && interrupts.disi_active(cpu_->now));
}

// which handlers known by heart the program holds off, when the next one comes, and what they take
void Processor::follow_host() {
  Cpu& cpu = *cpu_;
  for (std::size_t h = 0; h < irqs_.size(); ++h) {
    if (irqs_[h] < 0) continue;
    const bool held = is_held(irqs_[h]);
    if (held == held_[h]) continue;
    held_[h] = held;
    cpu.host->hold_handler(static_cast<int>(h), held, cpu.now);
    cpu.host_stale = true;
  }
  if (!cpu.host_stale) return;
  cpu.host_stale = false;
  cpu.clocks.set_share(cpu.host->share_q32());
  // held off by its level alone it wakes the processor all the same
  cpu.host_comes = irqs_[0] >= 0 && cpu.parts.interrupts.enabled(irqs_[0]) && cpu.power != Cpu::Power::Sleep;
  cpu.host_held = held_[0];
  cpu.host_due = cpu.host_comes ? cpu.host->due() : kNever;
}

/// Does the handler known by heart begin now, rather than that of `vector`?
bool Processor::is_host_first(int vector) const {
  const Cpu& cpu = *cpu_;
  if (cpu.host_due > cpu.now || held_[0]) return false;
  if (vector == kNoVector) return true;
  if (vector < kFirstIrqVector) return false;
  const Interrupts& interrupts = cpu.parts.interrupts;
  const int priority = interrupts.priority(irqs_[0]), other = interrupts.priority(vector - kFirstIrqVector);
  return priority > other || (priority == other && kFirstIrqVector + irqs_[0] < vector);
}

/// The next instant at which something comes of the host's handlers.
Cycle Processor::host_horizon() const {
  const Cpu& cpu = *cpu_;
  if (!cpu.host) return kNever;
  return std::min(disi_horizon(), held_[0] && cpu.host_due <= cpu.now ? kNever : cpu.host_due);
}

Cycle Processor::disi_horizon() const {
  const Interrupts& interrupts = cpu_->parts.interrupts;
  return interrupts.disi_active(cpu_->now) ? interrupts.disi_until() : kNever;
}

Cycle Processor::idle_until() const {
  const Cpu& cpu = *cpu_;
  const bool stands = cpu.stands_in_host();
  if (!stands && !is_asleep() && !waits_->is_waiting()) return 0;
  const Outlook outlook = cpu.parts.look(cpu.now);
  if (outlook.reset_due || (cpu.host_due <= cpu.now && !held_[0])) return 0;
  Cycle until = std::min(chip_.next_event(cpu.now), host_horizon());
  if (is_asleep()) return std::min({until, cpu.parts.interrupts.wakes_at(), cpu.host_due});
  if (outlook.vector != kNoVector) return 0;
  if (stands) until = std::min(until, cpu.stands_until);
  if (waits_->is_waiting()) until = std::min(until, waits_->until(cpu));
  return until;
}

void Processor::stir() { waits_->stir(*cpu_); }

void Processor::enter_interrupt(int vector) {
  Cpu& cpu = *cpu_;
  cpu.at = cpu.next;  // what the stack's pushes belong to
  const unsigned pc = cpu.address_of(cpu.next), level = static_cast<unsigned>(cpu.parts.interrupts.level());
  if (cpu.repeating && cpu.window_was_free) cpu.now += Cpu::kRepeatWindow;
  cpu.push(pc & 0xFFFF);
  cpu.push(cpu.sr_low() << 8 | (level & 8) << 4 | pc >> 16);
  cpu.repeating = false;
  const InterruptEntry entry = cpu.parts.interrupts.enter(vector, cpu.now);
  cpu.now = entry.first_instruction;
  cpu.next = cpu.jump(cpu.program.read(entry.address) & 0x7FFFFE, cpu.next);
}

// --- what others look at --------------------------------------------------------------------------------

const TrapRecord* Processor::latest_trap() const { return cpu_->latest_trap ? &*cpu_->latest_trap : nullptr; }
Cycle Processor::idle(Cycle at) const {
  const Cpu& cpu = *cpu_;
  const Cycle now = std::max(cpu.now, cpu.clocks.program_at(at));
  const Cycle own = cpu.clocks.own_cycles(now) - cpu.clocks.own_cycles(cpu.now);
  const bool passes = is_asleep() || cpu.stands_in_host();
  return slept_ + cpu.delayed + waits_->waited(cpu, now) + (passes ? own : 0);
}
Cycle Processor::jumped() const { return waits_->jumped(); }
void Processor::set_translator(Translator* translator) { cpu_->translator = translator; }
void Processor::tell_calls(ProgramWatch* watch, std::vector<std::uint32_t> addresses) {
  cpu_->onlooker = watch;
  cpu_->tell_calls(std::move(addresses));
}
void Processor::know(std::shared_ptr<const KnownCalls> calls) { cpu_->know(std::move(calls)); }
void Processor::translate_all() {
  cpu_->hot = 0;
  cpu_->forget_code();
}
int Processor::translated() const { return cpu_->translated(); }
Cycle Processor::now() const { return cpu_->now; }
void Processor::wait_until(Cycle at) {
  cpu_->now = std::max(cpu_->now, at);
  cpu_->clocks.reset(cpu_->now);
}
bool Processor::is_asleep() const { return cpu_->power != Cpu::Power::On; }
unsigned Processor::pc() const { return cpu_->address_of(cpu_->next); }
unsigned Processor::pc_of_access() const { return cpu_->at ? cpu_->address_of(cpu_->at) : pc(); }
std::uint16_t Processor::w(int n) const { return cpu_->w[static_cast<std::size_t>(n)]; }
std::uint16_t Processor::sr() const { return static_cast<std::uint16_t>(cpu_->sr()); }
std::int64_t Processor::accumulator(int n) const { return cpu_->acc[static_cast<std::size_t>(n)]; }
std::uint8_t Processor::ram(unsigned address) const { return cpu_->ram[address - Cpu::kRamStart]; }
const std::uint8_t* Processor::ram() const { return cpu_->ram.data(); }
void Processor::set_ram(unsigned address, std::uint8_t value) { cpu_->ram[address - Cpu::kRamStart] = value; }

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
