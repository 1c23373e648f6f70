// SPDX-License-Identifier: MIT
// What instructions do: a function for each form, which gets the Cpu and the decoded word and returns the next
// one. The decoder chooses it, group by group of the manual.
#pragma once
#include "dspic30/core/decoded.h"
#include "dspic30/core/instruction_table.h"

namespace dspic {

/// A call, or a jump, to a function of the host, whose number is Decoded::imm.
const Decoded* call_host(Cpu& cpu, const Decoded* d);
const Decoded* jump_to_host(Cpu& cpu, const Decoded* d);

/// Does it do nothing in iterations of REPEAT with this RCOUNT and less, until the last one? Division's.
bool is_idle_step(Run run, unsigned rcount);

/// NOP's.
const Decoded* no_operation(Cpu& cpu, const Decoded* d);

// --- semantics, in the manual's groups; null: not of this group
Run choose_arithmetic(Insn id, const Fields& f);
Run choose_move(Insn id, const Fields& f);
Run choose_bit(Insn id, const Fields& f);
Run choose_multiply(Insn id, const Fields& f);
Run choose_flow(Insn id, const Fields& f);
Run choose_system(Insn id, const Fields& f);
Run choose_dsp(Insn id, const Fields& f);

}  // namespace dspic
