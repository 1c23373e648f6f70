// SPDX-License-Identifier: MIT
#include "hal_sim/host/native_processor.h"

#include <algorithm>

#include "hal_sim/board/board.h"
#include "hal_sim/host/compiled_runner.h"
#include "hal_sim/host/host_params.h"
#include "hal_sim/host/pins.h"

namespace host {

NativeProcessor::NativeProcessor(CompiledRunner& runner)
    : runner_(runner), drivers_(runner.board()), registers_(runner, *this) {}

void NativeProcessor::reset(Cycle now) {
  interrupts_.reset();
  cpu_level_ = 0;
  disi_until_ = 0;
  masked_ = false;
  outer_levels_.clear();
  registers_.processor_reset();
  watch_remote(now);
}

void NativeProcessor::note_reset(ResetCause cause) {
  if (cause == ResetCause::Instruction) registers_.note_software_reset();
  if (cause == ResetCause::Button) registers_.note_reset_button();
}

void NativeProcessor::watch_remote(Cycle now) {
  const board::RemoteReceiver& remote = runner_.board().remote();
  if (!remote.in_use()) return;
  // the library waits for falling edges; a program with its own handler says which
  interrupts_.watch_int0(
      [this, &remote](Cycle after) {
        const bool falling = interrupts_.source(TP_V_INT0).self_clearing || registers_.int0_on_falling_edge();
        return remote.next_edge(after, falling);
      },
      now);
}

Processor::Outlook NativeProcessor::look(Cycle now) {
  if (masked_) follow_mask(now);  // DISI may have run out
  interrupts_.raise_due(now);
  const bool held = disi_until_ > now;
  Outlook outlook{interrupts_.select(cpu_level_, held), held || cpu_level_ > 0, interrupts_.next_due()};
  if (held) outlook.horizon = std::min(outlook.horizon, disi_until_);
  return outlook;
}

Processor::Entry NativeProcessor::enter(int vector, Cycle now) {
  const InterruptSource& s = interrupts_.source(vector);
  if (s.self_clearing) interrupts_.take(vector);
  outer_levels_.push_back(cpu_level_);
  cpu_level_ = registers_.nesting_disabled() ? 7 : s.priority;
  follow_mask(now);
  return {s.self_clearing ? s.handler : nullptr,
          now + (s.self_clearing ? s.entry_cycles : kInterruptEntryCycles)};
}

Processor::Return NativeProcessor::leave(Cycle now) {
  cpu_level_ = outer_levels_.back();
  outer_levels_.pop_back();
  follow_mask(now);
  return {now};
}

Processor::Waiting NativeProcessor::longest_waiting(Cycle now) {
  const int vector = interrupts_.longest_waiting(cpu_level_, disi_until_ > now);
  if (vector < 0) return {};
  return {vector, interrupts_.source(vector).flag_since};
}

void NativeProcessor::disi(Cycle cycles, Cycle now) {
  disi_until_ = std::max(disi_until_, now + cycles);
  if (cycles <= 2) disi_until_ = now + cycles;  // INTERRUPT_ON() writes a short count over a long one
  follow_mask(now);
}

void NativeProcessor::follow_mask(Cycle now) {
  const bool masked = cpu_level_ >= drivers::kHandlerPriority || now < disi_until_;
  if (masked == masked_) return;
  masked_ = masked;
  drivers_.mask_handlers(masked, now);
  runner_.follow_mask();
  if (!masked) request_agenda_interrupt(runner_);  // ticks that were lost have moved it
}

bool NativeProcessor::flag(int vector, Cycle at) {
  const InterruptSource& s = interrupts_.source(vector);
  return (s.flag && s.flag_since <= at) || s.due <= at;
}

Cycle NativeProcessor::flag_horizon(int vector, Cycle at) {
  const InterruptSource& s = interrupts_.source(vector);
  if (s.flag && s.flag_since > at) return s.flag_since;
  return s.due > at ? s.due : kNever;
}

void NativeProcessor::modify(unsigned address, std::uint16_t keep, std::uint16_t flip) {
  const std::uint16_t old = registers_.read(address, 16);
  registers_.write(address, static_cast<std::uint16_t>((old & keep) ^ flip), 16);
}

host::Processor::Outlook NativeProcessor::take(Cycle now, Entry& entry) {
  const Outlook outlook = look(now);
  if (outlook.vector >= 0) entry = enter(outlook.vector, now);
  return outlook;
}

}  // namespace host
