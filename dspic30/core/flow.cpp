// SPDX-License-Identifier: MIT
// Branches, calls, returns, loops.
#include "dspic30/core/host_handlers.h"
#include "dspic30/core/operands.h"

namespace dspic {

namespace {

// --- conditions

bool is_ov(const Cpu& c) { return c.flag_ov(); }
bool is_c(const Cpu& c) { return c.flag_c(); }
bool is_z(const Cpu& c) { return c.flag_z(); }
bool is_n(const Cpu& c) { return c.flag_n(); }
bool is_lt(const Cpu& c) { return c.flag_n() != c.flag_ov(); }
bool is_le(const Cpu& c) { return c.flag_z() || is_lt(c); }
bool is_leu(const Cpu& c) { return !c.flag_c() || c.flag_z(); }
bool is_oa(const Cpu& c) { return c.oa; }
bool is_ob(const Cpu& c) { return c.ob; }
bool is_sa(const Cpu& c) { return c.sa; }
bool is_sb(const Cpu& c) { return c.sb; }

template <bool (*Condition)(const Cpu&), bool Wanted>
const Decoded* branch_if(Cpu& cpu, const Decoded* d) {
  if (Condition(cpu) != Wanted) return d + 1;
  ++cpu.now;
  return cpu.offset(d, d->imm);
}

// --- branches and calls; imm of a branch counts words from the instruction itself

const Decoded* branch(Cpu& cpu, const Decoded* d) { return cpu.offset(d, d->imm); }
const Decoded* branch_register(Cpu& cpu, const Decoded* d) {
  return cpu.offset(d, 1 + sign_extend(cpu.w[d->s], 16));
}
const Decoded* go_to(Cpu& cpu, const Decoded* d) {
  return cpu.jump(cpu.pointed(static_cast<unsigned>(d->imm), d), d);
}
const Decoded* go_to_register(Cpu& cpu, const Decoded* d) {
  return cpu.jump(cpu.pointed(cpu.w[d->s] & 0xFFFE, d), d);
}

const Decoded* call(Cpu& cpu, const Decoded* d) {
  const unsigned back = cpu.address_of(d) + 4;
  cpu.push_address(back);
  return cpu.call_to(cpu.pointed(static_cast<unsigned>(d->imm), d), d, back);
}
const Decoded* call_register(Cpu& cpu, const Decoded* d) {
  cpu.push_address(cpu.address_of(d) + 2);
  return cpu.jump(cpu.pointed(cpu.w[d->s] & 0xFFFE, d), d);
}
const Decoded* call_relative(Cpu& cpu, const Decoded* d) {
  const unsigned here = cpu.address_of(d), back = here + 2;
  cpu.push_address(back);
  return cpu.call_to(cpu.pointed((here + 2 * static_cast<unsigned>(d->imm)) & 0x7FFFFE, d), d, back);
}
const Decoded* call_relative_register(Cpu& cpu, const Decoded* d) {
  cpu.push_address(cpu.address_of(d) + 2);
  return branch_register(cpu, d);
}

// --- returns: 3 cycles, or 2 when an exception is pending

/// All events up to now have been.
void hurry_to_pending(Cpu& cpu) {
  const Interrupts& interrupts = cpu.parts.interrupts;
  if (interrupts.pending(cpu.true_now() + 2, interrupts.cpu().level()) == kNoVector) return;
  --cpu.now;
  cpu.note_effect();  // no other round of a wait takes as long
}
void hurry_to_exception(Cpu& cpu) {
  if (cpu.deadline > cpu.now + kInterruptReturnCycles) return;  // nothing comes so soon
  cpu.parts.events.run_to(cpu.true_now());
  hurry_to_pending(cpu);
}

const Decoded* return_from_call(Cpu& cpu, const Decoded* d) {
  const unsigned address = cpu.pop_address();
  if constexpr (!kIsTranslated) hurry_to_exception(cpu);  // translated, it runs only if nothing comes so soon
  return cpu.return_to(address, d);
}
template <bool Byte>
const Decoded* return_literal(Cpu& cpu, const Decoded* d) {
  operands::put_register<Byte>(cpu, d, static_cast<unsigned>(d->imm) & operands::kMask<Byte>);
  return return_from_call(cpu, d);
}
const Decoded* return_from_interrupt(Cpu& cpu, const Decoded* d) {
  return return_from_handler(cpu, d, d->cycles);
}

// --- loops

const Decoded* do_literal(Cpu& cpu, const Decoded* d) {
  cpu.begin_do(static_cast<unsigned>(d->imm), d + 2,
               d + 2 + sign_extend(static_cast<unsigned>(d->d) << 8 | d->b, 16));
  return d + 2;
}
const Decoded* do_register(Cpu& cpu, const Decoded* d) {
  cpu.begin_do(cpu.w[d->s] & 0x3FFF, d + 2, d + 2 + sign_extend(static_cast<unsigned>(d->d) << 8 | d->b, 16));
  return d + 2;
}

// the count is written before the next instruction runs, which belongs to this one's time
const Decoded* repeat(Cpu& cpu, const Decoded* d, unsigned count) {
  cpu.rcount = static_cast<std::uint16_t>(count);
  if (count == 0 || cpu.repeating) return d + 1;  // repeated itself, it only counts anew [?]
  cpu.repeating = cpu.repeat_is_fresh = true;
  cpu.now += d->cycles;
  const Decoded* next = cpu.run_repeated(d + 1);
  cpu.now -= d->cycles;
  return next;
}
const Decoded* repeat_literal(Cpu& cpu, const Decoded* d) {
  return repeat(cpu, d, static_cast<unsigned>(d->imm));
}
const Decoded* repeat_register(Cpu& cpu, const Decoded* d) { return repeat(cpu, d, cpu.w[d->s] & 0x3FFF); }

}  // namespace

// a function of the host that was cut goes on waiting
const Decoded* return_from_handler(Cpu& cpu, const Decoded* from, Cycle rest) {
  cpu.settle();
  const unsigned top = cpu.pop(), low = cpu.pop();
  cpu.set_flags(top >> 8);
  cpu.repeating = cpu.repeat_is_fresh = (top >> 12 & 1) != 0;
  cpu.parts.events.run_to(cpu.now);
  cpu.parts.interrupts.leave_to(static_cast<int>((top >> 13 & 7) | (top >> 4 & 8)), cpu.now);
  hurry_to_pending(cpu);  // at the lower level it may be one that was held off
  if (cpu.course) cpu.course->handler_ends(cpu.now + rest);
  cpu.deadline = 0;
  cpu.returned = true;
  const unsigned address = (top & 0x7F) << 16 | (low & 0xFFFE);
  return cpu.jump_back(address, from);
}

// The function of each instruction that moves the program's place; null: it does not.
Run choose_flow(Insn id, const Fields& f) {
  switch (id) {
    case Insn::Bra_OV_Expr:
      return &branch_if<is_ov, true>;
    case Insn::Bra_C_Expr:
      return &branch_if<is_c, true>;
    case Insn::Bra_Z_Expr:
      return &branch_if<is_z, true>;
    case Insn::Bra_N_Expr:
      return &branch_if<is_n, true>;
    case Insn::Bra_LE_Expr:
      return &branch_if<is_le, true>;
    case Insn::Bra_LT_Expr:
      return &branch_if<is_lt, true>;
    case Insn::Bra_LEU_Expr:
      return &branch_if<is_leu, true>;
    case Insn::Bra_NOV_Expr:
      return &branch_if<is_ov, false>;
    case Insn::Bra_NC_Expr:
      return &branch_if<is_c, false>;
    case Insn::Bra_NZ_Expr:
      return &branch_if<is_z, false>;
    case Insn::Bra_NN_Expr:
      return &branch_if<is_n, false>;
    case Insn::Bra_GT_Expr:
      return &branch_if<is_le, false>;
    case Insn::Bra_GE_Expr:
      return &branch_if<is_lt, false>;
    case Insn::Bra_GTU_Expr:
      return &branch_if<is_leu, false>;
    case Insn::Bra_OA_Expr:
      return &branch_if<is_oa, true>;
    case Insn::Bra_OB_Expr:
      return &branch_if<is_ob, true>;
    case Insn::Bra_SA_Expr:
      return &branch_if<is_sa, true>;
    case Insn::Bra_SB_Expr:
      return &branch_if<is_sb, true>;
    case Insn::Bra_Expr:
      return &branch;
    case Insn::Bra_Wn:
      return &branch_register;
    case Insn::Goto_Expr:
      return &go_to;
    case Insn::Goto_Wn:
      return &go_to_register;
    case Insn::Call_Expr:
      return &call;
    case Insn::Call_Wn:
      return &call_register;
    case Insn::Rcall_Expr:
      return &call_relative;
    case Insn::Rcall_Wn:
      return &call_relative_register;
    case Insn::Return:
      return &return_from_call;
    case Insn::Retfie:
      return &return_from_interrupt;
    case Insn::Retlw_lit10_Wn:
      return f.B ? &return_literal<true> : &return_literal<false>;
    case Insn::Do_lit14_Expr:
      return &do_literal;
    case Insn::Do_Wn_Expr:
      return &do_register;
    case Insn::Repeat_lit14:
      return &repeat_literal;
    case Insn::Repeat_Wn:
      return &repeat_register;
    default:
      return nullptr;
  }
}

}  // namespace dspic
