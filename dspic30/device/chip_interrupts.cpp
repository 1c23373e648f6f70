// SPDX-License-Identifier: MIT
#include "dspic30/device/chip_interrupts.h"

#include "dspic30/device/chip_parts.h"

namespace dspic {

int ChipInterrupts::pending(Cycle now) {
  parts_.events.run_to(now);
  return parts_.interrupts.pending(now, cpu_level());
}

int ChipInterrupts::next(Cycle now) const { return parts_.interrupts.pending(now, cpu_level()); }

InterruptEntry ChipInterrupts::enter(int vector, Cycle now) { return parts_.interrupts.enter(vector, now); }
Cycle ChipInterrupts::leave(Cycle now) { return parts_.interrupts.leave(now); }

int ChipInterrupts::cpu_level() const { return parts_.interrupts.cpu().level(); }
int ChipInterrupts::nesting() const { return parts_.interrupts.cpu().nesting(); }
void ChipInterrupts::disi(unsigned count, Cycle now) { parts_.interrupts.disi(count, now); }
bool ChipInterrupts::disi_active(Cycle now) const { return parts_.interrupts.cpu().disi_active(now); }
void ChipInterrupts::raise_trap(Trap trap, Cycle now) { parts_.interrupts.raise_trap(trap, now); }

bool ChipInterrupts::has_flag(int vector, Cycle now) {
  parts_.events.run_to(now);
  return vector >= kFirstIrqVector && parts_.interrupts.sources().flag(vector - kFirstIrqVector);
}

bool ChipInterrupts::is_enabled(int vector) const {
  return vector >= kFirstIrqVector && parts_.interrupts.sources().enabled(vector - kFirstIrqVector);
}

int ChipInterrupts::priority(int vector) const {
  return vector >= kFirstIrqVector ? parts_.interrupts.sources().priority(vector - kFirstIrqVector)
                                   : trap_level(vector);
}

Cycle ChipInterrupts::flag_since(int vector) const {
  return vector >= kFirstIrqVector ? parts_.interrupts.sources().since(vector - kFirstIrqVector) : 0;
}

bool ChipInterrupts::wakes(Cycle now) {
  parts_.events.run_to(now);
  return parts_.interrupts.sources().waking() != 0;
}

std::int64_t ChipInterrupts::missed(int vector, Cycle now) const {
  if (vector < kFirstIrqVector) return 0;
  const int irq = vector - kFirstIrqVector;
  const InterruptTally& tally = parts_.interrupts.tally();
  const std::int64_t uncounted = is_enabled(vector) ? tally.missing.of(irq, now) : 0;
  return tally.missed.of(irq) + uncounted + parts_.timers.missed_of(irq, now);
}

std::int64_t ChipInterrupts::served(int vector) const { return parts_.interrupts.tally().served.of(vector); }

}  // namespace dspic
