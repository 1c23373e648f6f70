// SPDX-License-Identifier: MIT
// How deep the stack can grow, read from the finished code: what each function pushes, whom it calls. A
// bound, except for recursion and for pointers: those are told, and a call through a pointer counts as the
// deepest function whose address is taken anywhere.
#include <algorithm>
#include <set>

#include "dspic30/core/instruction_table.h"
#include "dspic30/link/link.h"
#include "dspic30/link/relocations.h"

namespace dspic::link {

namespace {

constexpr unsigned kStackPointer = 15, kReturnAddress = 4, kInterruptEntry = 4;
constexpr unsigned kLeastGuard = 16;  // bytes between the last word below SPLIM and the end
constexpr const char* kStackLimit = "__SPLIM_init";

struct Function {
  unsigned own = 0;                     // bytes that it pushes
  std::vector<const Section*> callees;  // by name
  bool calls_by_pointer = false;
};

class Depths {
 public:
  explicit Depths(const Program& program) : program_(program) {
    for (const Section& s : program.sections)
      if (s.used && s.kind == Kind::Code) starts_[s.address] = &s;
    for (const Section& s : program.sections) {
      if (!s.used || s.kind == Kind::Debug) continue;
      if (s.kind == Kind::Code) functions_[&s] = read(s);
      for (const Relocation& r : s.relocations)
        if ((r.type == llvm::dspic_elf::kLiteral16 || r.type == llvm::dspic_elf::kWord) &&
            r.symbol->section && r.symbol->section->kind == Kind::Code)
          pointed_at_.insert(r.symbol->section);
    }
  }

  unsigned of(const Section* s) {
    if (!s || !functions_.count(s)) return 0;
    if (const auto known = known_.find(s); known != known_.end()) return known->second;
    if (!open_.insert(s).second) {
      recursive = s->name.substr(s->name.rfind("._") + 2);
      return 0;
    }
    const Function& f = functions_[s];
    unsigned below = 0;
    for (const Section* callee : f.callees) below = std::max(below, of(callee) + kReturnAddress);
    if (f.calls_by_pointer)
      for (const Section* callee : pointed_at_)
        if (!open_.count(callee)) below = std::max(below, of(callee) + kReturnAddress);
    open_.erase(s);
    return known_[s] = f.own + below;
  }

  /// What the function with the largest frame pushes by itself.
  unsigned largest_frame() const {
    unsigned most = 0;
    for (const auto& [section, function] : functions_) most = std::max(most, function.own);
    return most;
  }

  std::string recursive;  ///< a function that calls itself; then there is no bound

 private:
  const Section* at(std::uint32_t address) const {
    auto it = starts_.upper_bound(address);
    return it == starts_.begin() ? nullptr : std::prev(it)->second;
  }

  Function read(const Section& s) const {
    Function f;
    unsigned arguments = 0;  // of the call with the most on the stack
    for (std::uint32_t i = 0; i + 4 <= s.bytes.size(); i += 4) {
      const std::uint32_t here = s.address + i / 2, word = program_.words.at(here);
      const Row* row = find_row(word);
      if (!row) continue;
      const Fields v = fields_of(*row, word);
      // a jump to its own beginning is a loop, a call a recursion
      const bool is_jump = row->id == Insn::Goto_Expr || row->id == Insn::Bra_Expr;
      const auto calls = [&](std::uint32_t target) {
        const Section* callee = at(target);
        if (callee && (callee != &s || (!is_jump && target == s.address))) f.callees.push_back(callee);
      };
      const auto behind = [&](unsigned words) {
        return here + 2 + 2 * std::uint32_t(sign_extend(words, 16));
      };
      // What the instruction adds to the stack, or whom it calls.
      switch (row->id) {
        case Insn::Lnk_lit14:
          f.own += 2 + 2 * v.k;
          break;
        case Insn::Push_f:
          f.own += 2;
          break;
        case Insn::Mov_Wso_Wdo:
          if (v.h == 3 && v.d == kStackPointer) f.own += 2;
          break;
        case Insn::Mov_D_Wns_Wd:
          if (v.q == 3 && v.d == kStackPointer) f.own += 4;
          break;
        case Insn::Add_lit10_Wn:
          if (v.d == kStackPointer) arguments = std::max(arguments, v.k);
          break;
        case Insn::Call_Expr:
        case Insn::Goto_Expr: {
          const auto second = program_.words.find(here + 2);
          calls(2 * v.n | (second == program_.words.end() ? 0 : second->second << 16));
          i += 4;
          break;
        }
        case Insn::Rcall_Expr:
        case Insn::Bra_Expr:
          calls(behind(v.n));
          break;
        case Insn::Call_Wn:
        case Insn::Rcall_Wn:
          f.calls_by_pointer = true;
          break;
        default:
          break;
      }
    }
    f.own += arguments;
    return f;
  }

  const Program& program_;
  std::map<std::uint32_t, const Section*> starts_;
  std::map<const Section*, Function> functions_;
  std::set<const Section*> pointed_at_, open_;
  std::map<const Section*, unsigned> known_;
};

// SPLIM lies so far below the end that who goes beyond it still finds RAM: the frame of the function that
// does, the call that is told, the trap's entry, its handler. But no program that fits is stopped for that.
void guard_stack(Program& program, Depths& depths) {
  const auto handler = program.globals.find("__StackError");
  const Section* const section = handler == program.globals.end()
                                     ? program.global("__DefaultInterrupt")->section
                                     : handler->second->section;
  const unsigned trap = kReturnAddress + kInterruptEntry + depths.of(section),
                 least = std::max(kLeastGuard, trap), wanted = std::max(least, depths.largest_frame() + trap),
                 all = program.stack_end - program.stack_begin;
  const unsigned spare = all > program.stack_bytes ? all - program.stack_bytes : 0;
  const unsigned guard = std::min(std::min(std::max(spare, least), wanted), all) & ~1u;
  program.stack_end -= guard;
  program.define(kStackLimit, program.stack_end - 2);
  fill_for(program, *program.globals[kStackLimit]);
}

}  // namespace

void bound_stack(Program& program) {
  Depths depths(program);
  program.stack_bytes = depths.of(program.global("__reset")->section);
  // handlers of different priorities interrupt one another; which priorities they get is not known here
  for (const auto& [name, symbol] : program.globals)
    if (symbol->section && is_handler(name))
      program.stack_bytes += kInterruptEntry + depths.of(symbol->section);
  program.recursive = depths.recursive;
  guard_stack(program, depths);
  const unsigned room = program.stack_end - program.stack_begin;
  if (program.stack_bytes > room)
    program.warnings.push_back("stack: got " + std::to_string(program.stack_bytes) +
                               " bytes at most, expected at most " + std::to_string(room) +
                               ", which is what variables leave");
}

}  // namespace dspic::link
