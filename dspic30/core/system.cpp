// SPDX-License-Identifier: MIT
// Instructions that act on the chip as a whole. BREAK and SIMIO, which only debuggers and simulators know, do
// nothing here [?].
#include "dspic30/core/cpu.h"

namespace dspic {

namespace {

const Decoded* clear_watchdog(Cpu& cpu, const Decoded* d) {
  cpu.settle();
  cpu.parts.events.run_to(cpu.now);
  cpu.parts.system.clear_watchdog(cpu.now);
  cpu.deadline = 0;
  return d + 1;
}

const Decoded* save_power(Cpu& cpu, const Decoded* d) {
  cpu.settle();
  cpu.power = d->imm ? Cpu::Power::Idle : Cpu::Power::Sleep;
  cpu.parts.fall_asleep(d->imm != 0, cpu.now);
  cpu.deadline = 0;
  return d + 1;
}

const Decoded* reset(Cpu& cpu, const Decoded* d) {
  cpu.ask_reset(ResetKind::Instruction);
  return d;
}

const Decoded* disable_interrupts(Cpu& cpu, const Decoded* d) {
  cpu.settle();
  cpu.parts.interrupts.disi(static_cast<unsigned>(d->imm), cpu.now);
  cpu.deadline = 0;
  return d + 1;
}

}  // namespace

const Decoded* no_operation(Cpu&, const Decoded* d) { return d + 1; }

Run choose_system(Insn id, const Fields&) {
  switch (id) {
    case Insn::Nop:
    case Insn::Nopr:
    case Insn::Break:
    case Insn::Simio:
      return &no_operation;
    case Insn::Clrwdt:
      return &clear_watchdog;
    case Insn::Pwrsav_lit1:
      return &save_power;
    case Insn::Reset:
      return &reset;
    case Insn::Disi_lit14:
      return &disable_interrupts;
    default:
      return nullptr;
  }
}

}  // namespace dspic
