// SPDX-License-Identifier: MIT
#include "hal_sim/chip/endings.h"

#include <algorithm>

#include "dspic30/core/instruction_table.h"
#include "dspic30/memory/host_places.h"
#include "sim_core/base/did_you_mean.h"

namespace chip {

namespace {

using dspic::Trap;

constexpr unsigned kStackLimit = dspic::sfr("SPLIM"), kIntcon1 = dspic::sfr("INTCON1"), kTrapFlags = 0x001E;
constexpr std::uint32_t kNop = 0x000000, kHalt = 0xDA4000;  // the second one stops a debugger, no chip
constexpr std::uint32_t kReturn = 0x060000, kSetsLimit = 0x880100;  // MOV Wn, SPLIM [chip C4]
constexpr unsigned kLongestStart = 0x400;  // bytes of program counter: of a start-up code
constexpr unsigned kStackPointer = 15;
constexpr Cycle kEntry = 100;  // more than lies between an instruction and the default handler's RESET
constexpr const char* kGaveUp = "abort(), or exit() with a failure, resets the processor";

bool does_nothing(std::uint32_t word) { return word == kNop || word == kHalt; }

int kind_of(Trap trap) {
  switch (trap) {
    case Trap::AddressError:
      return host::kTrapAddress;
    case Trap::StackError:
      return host::kTrapStack;
    case Trap::MathError:
      return host::kTrapMath;
    default:
      return host::kTrapInterrupt;
  }
}

bool is_vector(const std::string& function) {
  for (int v = 1; v < dspic::kVectors; ++v)
    if (function == handler_of(v)) return true;
  return false;
}

}  // namespace

void Endings::note_trap(const dspic::TrapRecord& record) {
  const Trap trap = record.trap;
  const unsigned from = record.pc;
  // one leads to the next, unless the program's own handler of the first one goes wrong itself
  const int open = places_.open_vector();
  const bool is_in_own =
      open != dspic::kNoVector && open < dspic::kFirstIrqVector && places_.has_handler(open);
  if ((chip_.device().peek(kIntcon1, chip_.latest()) & kTrapFlags) != 0 && !is_in_own) return;
  // what a stack does that has outgrown its limit, or RAM, fails in more ways than one
  const unsigned stack = processor_.w(kStackPointer),
                 limit = chip_.device().peek(kStackLimit, chip_.latest());
  const bool overflows =
      trap == Trap::StackError || (trap == Trap::AddressError && limit != 0 && stack > limit);
  noted_ = {record, places_.own(from), overflows,
            trap == Trap::StackError && stack < dspic::Processor::kRamStart, dspic::kNoVector};
  // a vector that holds no address leads nowhere
  if (open == dspic::kNoVector || places_.handler(open) != from || file_.words.count(from)) return;
  noted_.missing = open;
  noted_.place = cut_off();
}

/// What the interrupt that has just been entered cut off: its frame is the stack's last.
unsigned Endings::cut_off() const {
  const unsigned stack = processor_.w(kStackPointer);
  const unsigned cut = (places_.stack_word(stack - 2) & 0x7F) << 16 | places_.stack_word(stack - 4);
  return places_.own(cut, stack - 4);
}

std::optional<Ending> Endings::of_reset(dspic::ResetKind kind) const {
  const unsigned here = processor_.pc();
  switch (kind) {
    case dspic::ResetKind::Instruction:
      return of_instruction(here);
    case dspic::ResetKind::TrapConflict:
      if (noted_.missing != dspic::kNoVector) return of_interrupt(noted_.missing, noted_.place);
      return of_trap(noted_.record.trap,
                     "a second trap came before the first one's handler, so the processor resets", true);
    case dspic::ResetKind::IllegalOpcode: {
      // the chip takes all for an illegal opcode; what stands there tells them apart
      const std::uint32_t word = program_.read(here);
      const char* const why =
          word == dspic::kUndefinedWord
              ? "an illegal opcode resets the processor: the compiler put it where the program does what C "
                "leaves undefined, such as to use a pointer that was never set"
          : dspic::find_row(word)
              ? "an address in a register that was never written resets the processor"
              : "an illegal opcode resets the processor: the program ran into what is no code";
      return Ending{host::kTrapIllegal, "Reset", why, places_.own(here)};
    }
    case dspic::ResetKind::Watchdog:
      return Ending{0, "Reset", "the watchdog was not cleared in time, so it resets the processor",
                    places_.own(here)};
    default:
      return Ending{0, "Reset", "the processor resets", places_.own(here)};
  }
}

Ending Endings::of_null_pointer(unsigned from) const {
  const dspic::Row* row = dspic::find_row(program_.read(from));
  const auto is = [row](auto... ids) { return row && ((row->id == ids) || ...); };
  using dspic::Insn;
  const char* const why =
      is(Insn::Return, Insn::Retlw_lit10_Wn) ? "a return to address 0: something has overwritten the stack;"
      : is(Insn::Call_Expr, Insn::Rcall_Expr)
          ? "a call of address 0, where no function lies (a weak one that nobody defines?):"
      : row && (row->has(dspic::Operand::Target) || row->has(dspic::Operand::Branch))
          ? "a jump to address 0:"
          : "a call through a null pointer leads to address 0:";
  return {0, "Reset", std::string(why) + " the program begins anew, and nothing is reset", places_.own(from)};
}

std::optional<Ending> Endings::of_start(unsigned at, Cycle null_at) const {
  constexpr Cycle kOnTheWay = 8;  // over the GOTO there
  if (processor_.w(kStackPointer) == dspic::Processor::kRamStart ||
      (null_at >= 0 && processor_.now() - null_at <= kOnTheWay))
    return std::nullopt;
  return Ending{
      0, "Reset",
      "the program came to its first instruction by a return, a call or a jump: the stack or a pointer "
      "was overwritten; it begins anew, and nothing is reset",
      places_.own(at)};
}

// --- RESET

std::optional<Ending> Endings::of_instruction(unsigned at) const {
  if (auto given_up = of_giving_up(at)) return given_up;
  const int vector = places_.open_vector();
  if (vector != dspic::kNoVector && is_default_handler(vector, at))
    return vector < dspic::kFirstIrqVector
               ? of_trap(static_cast<Trap>(vector),
                         "the program has no " + places_.handler_name(vector) + "(), so the processor resets",
                         processor_.now() - noted_.record.at <= kEntry)
               : of_interrupt(vector, resets_at_once(vector, at) ? cut_off() : at);
  if (vector != dspic::kNoVector) return std::nullopt;
  if (const auto* function = file_.code.function_at(at);
      function && function->name == "_DefaultInterrupt" && !places_.is_own(at))
    return Ending{0, "Reset",
                  "the program came to _DefaultInterrupt() without an interrupt: the stack or a pointer was "
                  "overwritten, so the processor resets",
                  at};
  const unsigned main_at = called_main(at);
  if (main_at == 0) return std::nullopt;
  // its last line, where one is known
  unsigned last = main_at;
  const auto* function = file_.code.function_at(main_at);
  for (unsigned a = main_at; function && a < function->end; a += 2)
    if (file_.code.line_at(a) && places_.is_own(a) && program_.read(a) == kReturn) last = a;
  return Ending{0, "Reset", "main() returned: there is nothing to return to, so the processor resets", last};
}

Ending Endings::of_giving_up() const {
  return {host::kTrapAbort, "Reset", kGaveUp, places_.own(processor_.pc_of_access())};
}

/// What our C library does for abort(), a failed assert() and exit() with a failure.
std::optional<Ending> Endings::of_giving_up(unsigned at) const {
  const auto is_in = [this](unsigned address, const char* name) {
    const auto* function = file_.code.function_at(address);
    return function && function->name == name;
  };
  const unsigned from = is_in(at, "tp_reset") ? places_.caller() : at;
  const bool asserted = is_in(from, "tp_assert_failed");
  if (!asserted && !is_in(from, "tp_give_up") && !is_in(from, "abort")) return std::nullopt;
  return Ending{host::kTrapAbort, "Reset", asserted ? "an assert() failed, so the processor resets" : kGaveUp,
                places_.own(at)};
}

/// A handler that many vectors share and that resets at once; a program's own one has a name.
bool Endings::is_default_handler(int vector, unsigned reset_at) const {
  if (places_.has_handler(vector)) return false;
  const auto* function = file_.code.function_at(reset_at);
  return (function && function->name == "_DefaultInterrupt") || resets_at_once(vector, reset_at);
}

bool Endings::resets_at_once(int vector, unsigned reset_at) const {
  unsigned at = places_.handler(vector);
  while (at < reset_at && does_nothing(program_.read(at))) at += 2;
  return at == reset_at;
}

/// A RESET that comes straight behind a call, where the stack is as empty as the start-up code made it:
/// the address of what was called; 0: it is none.
unsigned Endings::called_main(unsigned reset_at) const {
  unsigned behind = reset_at;
  while (behind > 2 && does_nothing(program_.read(behind - 2)) && !places_.call_before(behind)) behind -= 2;
  const unsigned call = places_.call_before(behind);
  const unsigned to = call ? places_.target(call) : 0;
  if (to == 0) return 0;
  if (const auto* main_function = file_.code.function_named("main"))
    return main_function->begin == to ? to : 0;
  // without names: the code before sets the stack's limit, and its pointer to what it is now
  bool has_limit = false;
  for (unsigned at = call; at >= 2 && at + kLongestStart > call; at -= 2) {
    const std::uint32_t before = program_.read(at - 2);
    has_limit |= (before & 0xFFFFF0) == kSetsLimit;
    if ((before & 0xF0000F) == (0x200000 | kStackPointer))
      return has_limit && (before >> 4 & 0xFFFF) == processor_.w(kStackPointer) ? to : 0;
    if (before == kReturn) break;
  }
  return 0;
}

/// `is_of_noted`: the trap that was noted last may have led here; else the program set its flag.
Ending Endings::of_trap(Trap trap, const std::string& then, bool is_of_noted) const {
  Ending ending{kind_of(trap), dspic::vector_name(static_cast<int>(trap)), "", processor_.pc()};
  // a stack that has gone beyond RAM is an address error as well, whose handler comes first
  const bool is_noted = is_of_noted && noted_.place != 0 &&
                        (noted_.record.trap == trap || (noted_.overflows && trap == Trap::AddressError));
  if (is_noted) {
    ending.place = noted_.place;
    if (noted_.overflows) trap = Trap::StackError;
    ending.kind = kind_of(trap);
  } else if (places_.open_vector() != dspic::kNoVector) {
    ending.place = cut_off();
  }
  const host::Place place = places_.place_of(ending.place);
  switch (trap) {
    case Trap::StackError:
      ending.message =
          std::string(is_noted && noted_.underflows ? "stack underflow in " : "stack overflow in ") +
          (place.function == "?" ? places_.text_of(ending.place) : place.function + "()");
      break;
    case Trap::MathError:
      ending.message = "division by zero, or an overflow of an accumulator";
      break;
    case Trap::AddressError:
      ending.message = is_noted && noted_.record.touch ? text_of(*noted_.record.touch)
                       : !is_noted                     ? "its flag in INTCON1 was set by the program"
                                   : "an access to an address that is not there, or to a word at an odd one";
      break;
    default:
      ending.message = "the oscillator failed";
  }
  ending.message += "; " + then;
  return ending;
}

/// A function of the program whose name is nearly that of a handler.
std::string Endings::handler_like(const std::string& wanted) const {
  std::vector<std::string> names;
  for (const auto& function : file_.code.functions)
    if (!is_vector(function.name) && function.name != "_DefaultInterrupt" && function.name[0] == '_')
      names.push_back(function.name);
  return sim::did_you_mean(wanted, names);
}

Ending Endings::of_interrupt(int vector, unsigned place) const {
  const std::string name = dspic::vector_name(vector), wanted = places_.handler_name(vector);
  Ending ending{host::kTrapInterrupt, name, "", place};
  if (vector < dspic::kFirstIrqVector) ending.kind = kind_of(static_cast<Trap>(vector));
  ending.message = vector < dspic::kFirstIrqVector ? "the trap " + name + " came"
                                                   : "the interrupt of " + name + " is enabled";
  if (file_.code.function_named(wanted) && !places_.has_handler(vector)) {
    ending.message += ", but its vector no longer leads to " + wanted +
                      "(): program memory was erased or written there (NVMCON), so the processor resets";
    return ending;
  }
  ending.message += ", but the program has no " + wanted + "(), so the processor resets";
  const auto [meant, is_new] = meant_.emplace(vector, "");
  if (is_new) meant->second = handler_like(wanted);
  if (!meant->second.empty()) ending.message += "; is " + meant->second + "() meant for it?";
  return ending;
}

}  // namespace chip
