// SPDX-License-Identifier: MIT
#include "dspic30/core/processor.h"

#include <algorithm>

#include "dspic30/core/cpu.h"
#include "dspic30/core/wait_samples.h"
#include "dspic30/memory/state_hash.h"

namespace dspic {

namespace {

// from the event that wakes to the next instruction [?]: Idle goes on at once; Sleep waits for the crystal
// (1024 periods of 7.3728 MHz) and for the PLL (20 us)
constexpr Cycle kResetCycles = 295;  // 20 us from a reset's cause to the first instruction [?]
constexpr Cycle kIdleWakeCycles = 2, kSleepWakeCycles = 2048 + 295;

constexpr Cycle kWorthALook = 100;  // cycles

}  // namespace

Processor::Processor(Dspic30f6014a& chip, ProgramMemory& program)
    : cpu_(std::make_unique<Cpu>(chip.parts(), program)),
      waits_(std::make_unique<WaitSamples>()),
      chip_(chip),
      code_version_(program.version()) {}

Processor::~Processor() = default;

void Processor::restart() {
  cpu_->reset();
  cpu_->now += kResetCycles;
  cpu_->still_since = kNever;
  waits_->forget(*cpu_);
  code_version_ = cpu_->program.version();
}

void Processor::power_up(Cycle at) {
  restart();
  cpu_->ram.fill(0);
  cpu_->now = at;
}

Cycle Processor::still_since() const { return cpu_->still_since; }
bool Processor::still_reads() const { return cpu_->still_reads; }

// --- the loop -------------------------------------------------------------------------------------------

// straight on until something else may happen; now and then a look whether the program only waits, ever more
// rarely while it does not; handlers seldom do, so they may work on for a while first
void Processor::execute() {
  Cpu& cpu = *cpu_;
  const Cycle end = cpu.deadline;
  const std::int64_t writes = cpu.parts.bus.writes();
  Cycle look_at = cpu.parts.interrupts.nesting() > 0 ? std::max(look_at_, cpu.now + kFirstLooks) : look_at_;
  while (cpu.now < end) {
    if (look_at <= cpu.now && end - cpu.now > kWorthALook) {
      const Cycle jumped = cpu.skip_wait();
      jumped_ += jumped;
      look_at = cpu.now + (jumped > 0 ? kFirstLooks : between_looks_);
      look_at_ = jumped > 0 ? cpu.now : look_at;  // behind an interrupt the wait may go on
      between_looks_ = jumped > 0 ? kFirstLooks : std::min(2 * between_looks_, kRarestLooks);
      if (cpu.deadline != end || cpu.parts.bus.writes() != writes) return;
    }
    const Cycle pause = look_at > cpu.now ? std::min(end, look_at) : end;  // too near its end for a look
    cpu.deadline = pause;
    const Decoded* d = cpu.next;
    while (cpu.now < cpu.deadline) {
      cpu.at = d;
      const Decoded* next = d->run(cpu, d);
      cpu.now += d->cycles;
      if (d == cpu.loop_end) next = cpu.loop_back(d, next);
      d = next;
    }
    cpu.next = d;
    if (cpu.deadline != pause || cpu.repeating || cpu.parts.bus.writes() != writes) return;
    cpu.deadline = end;
  }
}

std::optional<ResetKind> Processor::run(Cycle until) {
  Cpu& cpu = *cpu_;
  while (true) {
    if (cpu.reset_due) return cpu.reset_due;
    if (cpu.now >= until) return std::nullopt;
    Outlook outlook = cpu.parts.look(cpu.now);
    if (outlook.reset_due) return chip_.reset_due(cpu.now);
    if (cpu.program.version() != code_version_) {
      code_version_ = cpu.program.version();
      cpu.forget_code();
    }
    if (cpu.stale_pointers) cpu.forget_pointers();
    if (cpu.power != Cpu::Power::On) {
      sleep(until);
      continue;
    }
    if (outlook.vector != kNoVector) {
      enter_interrupt(outlook.vector);
      outlook.horizon = cpu.parts.interrupt_horizon(outlook.vector);
      if (outlook.horizon <= cpu.now) continue;
    }
    cpu.deadline = std::min(until, outlook.horizon);
    if (cpu.now < waits_->next())
      cpu.deadline = std::min(cpu.deadline, waits_->next());
    else if (waits_->look(cpu))
      cpu.deadline = cpu.now + 1;
    if (cpu.repeating) cpu.next = cpu.run_repeated(cpu.next);
    execute();
  }
}

// an enabled flag wakes whatever its priority, and so does the watchdog
void Processor::sleep(Cycle until) {
  Cpu& cpu = *cpu_;
  if (cpu.parts.interrupts.wakes() || cpu.parts.system.woke()) {
    cpu.now += cpu.power == Cpu::Power::Sleep ? kSleepWakeCycles : kIdleWakeCycles;
    cpu.power = Cpu::Power::On;
    cpu.parts.system.awake();
    return;
  }
  const Cycle next = std::clamp(chip_.next_event(cpu.now), cpu.now + 1, std::max(until, cpu.now + 1));
  slept_ += next - cpu.now;
  cpu.now = next;
}

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
Cycle Processor::waited() const { return waits_->waited(); }
void Processor::set_translator(Translator* translator) { cpu_->translator = translator; }
void Processor::tell_calls(ProgramWatch* watch, std::vector<std::uint32_t> addresses) {
  cpu_->onlooker = watch;
  cpu_->tell_calls(std::move(addresses));
}
void Processor::translate_all() {
  cpu_->hot = 0;
  cpu_->forget_code();
}
int Processor::translated() const { return cpu_->translated(); }
Cycle Processor::now() const { return cpu_->now; }
void Processor::wait_until(Cycle at) { cpu_->now = std::max(cpu_->now, at); }
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
  cpu_->written |= 1u << n;
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
