// SPDX-License-Identifier: MIT
#include "hal_sim/chip/profile.h"

#include <algorithm>
#include <cstring>

#include "dspic30/core/host_calls.h"
#include "dspic30/core/instruction_table.h"
#include "dspic30/device/chip_parts.h"
#include "hal_sim/chip/program_places.h"

namespace chip {

namespace {

constexpr int kLongestRound = 4096;  // instructions
constexpr int kTrustedRounds = 15;   // after one whose RAM was compared
constexpr int kMostIgnored = 64;     // rounds of a loop that turned out to be no wait
constexpr std::size_t kMostFrames = 512;
constexpr unsigned kSplim = dspic::sfr("SPLIM");
constexpr Cycle kCallCycles = 2, kEntryCycles = 3;  // an interrupt's, up to its first instruction

bool is_call(dspic::Insn id) { return id == dspic::Insn::Call_Expr || id == dspic::Insn::Rcall_Expr; }
bool is_call_by_register(dspic::Insn id) { return id == dspic::Insn::Call_Wn || id == dspic::Insn::Rcall_Wn; }

}  // namespace

void Spread::add(Cycle value, Cycle at) {
  if (count == 0 || value < min) min = value;
  if (count == 0 || value > max) {
    max = value;
    max_at = at;
  }
  ++count;
  sum += value;
}

Profile::Profile(const dspic::FirmwareFile& file, const dspic::Processor& processor,
                 dspic::Dspic30f6014a& device, const dspic::HostCalls* host)
    : file_(file),
      processor_(processor),
      device_(device),
      kinds_(dspic::kFlashWords, Kind::Unknown),
      function_of_(dspic::kFlashWords, 0),
      host_functions_((dspic::kHostEnd - dspic::kHostStart) / 2, 0),
      handler_by_heart_(static_cast<int>(file.code.functions.size() + 1)),
      contexts_(1),
      functions_(file.code.functions.size() + 2) {
  for (int h = 0; host && h < dspic::HostCalls::kHandlers; ++h)
    if (const int vector = host->vector(h); vector != dspic::kNoVector)
      served_by_heart_ |= std::uint64_t{1} << (vector - dspic::kFirstIrqVector);
  const auto& functions = file.code.functions;
  // what the host plays stands in the image as a jump to it
  for (std::size_t f = 0; f < functions.size(); ++f)
    if (const unsigned to = goto_target(file, functions[f].begin); dspic::is_host_place(to))
      host_functions_[(to - dspic::kHostStart) / 2] = static_cast<int>(f + 1);
  host_functions_[(dspic::kHostHandlerReturn - dspic::kHostStart) / 2] = handler_by_heart_;
  for (std::size_t f = 0; f < functions.size(); ++f)
    for (std::uint32_t a = functions[f].begin; a < functions[f].end && a / 2 < function_of_.size(); a += 2)
      function_of_[a / 2] = static_cast<std::int16_t>(f + 1);
}

Profile::Kind Profile::kind_of(unsigned pc) {
  if (dspic::is_host_place(pc)) return Kind::Return;  // as soon as it is over
  if (pc / 2 >= kinds_.size()) return Kind::Plain;
  Kind& kind = kinds_[pc / 2];
  if (kind != Kind::Unknown) return kind;
  kind = Kind::Plain;
  const auto word = file_.words.find(pc);
  const dspic::Row* row = word == file_.words.end() ? nullptr : dspic::find_row(word->second);
  if (!row) return kind;
  const std::string name = row->mnemonic;
  if (is_call(row->id))
    kind = Kind::Call;
  else if (is_call_by_register(row->id))
    kind = Kind::CallRegister;
  else if (row->id == dspic::Insn::Return || row->id == dspic::Insn::Retlw_lit10_Wn)
    kind = Kind::Return;
  else if (name.rfind("BRA", 0) == 0 || name == "GOTO")
    kind = Kind::Branch;
  return kind;
}

// --- steps

void Profile::after(const Step& step) {
  const Cycle took = step.took;
  // The first step of all begins the profile.
  if (from_ < 0) {
    from_ = step.begin;
    idle_before_ = processor_.idle(step.end);
    here().frames.push_back({function_of(step.pc), 0, 0, step.begin});
  }
  to_ = step.end;
  if (step.slept) {
    slept_ += took;
    for (Frame& frame : here().frames) end_wait(frame.round);
    return;
  }
  if (step.served) {
    in_handlers_ += step.end - step.begin;
    return;
  }
  ++steps_;
  in_handlers_ += step.end - step.begin - took;  // the share of those by heart
  // A handler begins: its entry is its own time.
  if (step.entered != dspic::kNoVector) {
    enter_handler(step);
    here().clock += took;
    in_handlers_ += took;
    const int handler = step.by_heart ? handler_by_heart_ : function_of(step.next);
    functions_[static_cast<std::size_t>(handler)].own += took;
    if (step.by_heart) call_agenda(step);
    watch_stack(step.end);
    return;
  }
  // Its time is that of the context, and of the function.
  here().clock += took;
  functions_[static_cast<std::size_t>(function_of(step.pc))].own += took;
  if (contexts_.size() > 1) in_handlers_ += took;
  watch_stack(step.end);
  watch_flags();
  if (step.left) return leave_handler();
  if (step.pc == dspic::kHostHandlerReturn) return call_agenda(step);
  if (dspic::is_host_place(step.pc) && step.next == step.pc) {  // a function of the host that waits
    here().waited += took;
    return;
  }
  // Where the course goes: calls and returns move the context's stack, a way back may be a loop.
  switch (kind_of(step.pc)) {
    case Kind::Call:
      if (const int host = host_function_called(step.pc); host && !dspic::is_host_place(step.next))
        return note_host_call(step, host);
      return call(step, false);
    case Kind::CallRegister:
      return call(step, true);
    case Kind::Return:
      return come_back(here(), processor_.w(15));
    case Kind::Branch:
      if (contexts_.size() == 1 && here().frames.size() == 1)
        here().frames[0].function = function_of(step.next);
      else if (function_of(step.next) != function_of(step.pc))
        call(step, false);  // the last call of a function, made a jump: both return at once
      if (step.next > step.pc) return;
      turn_loop(step);
      return look_for_wait(step);
    default:
      return;
  }
}

void Profile::was_reset(Cycle) {
  while (contexts_.size() > 1) contexts_.pop_back();
  cuts_.clear();
  for (Frame& frame : here().frames) end_wait(frame.round);
  const Cycle waited = here().waited;
  here() = Context{};
  here().waited = waited;
  here().frames.push_back({function_of(0), 0, 0, to_});
  flags_ = 0;
  for (auto& [target, loop] : loops_) loop.last = loop.long_last = -1;
}

// --- calls

void Profile::call(const Step& step, bool by_register) {
  Context& context = here();
  if (context.frames.size() >= kMostFrames) return;
  const int caller = function_of(step.pc);
  if (contexts_.size() == 1 && stack_base_ == 0) stack_base_ = processor_.w(15) - 4u;
  // a routine within a function, as assembler text has them, is nobody's call
  int callee = function_of(step.next);
  if (callee > 0 && !dspic::is_host_place(step.next) &&
      file_.code.functions[static_cast<std::size_t>(callee - 1)].begin != step.next)
    callee = 0;
  if (callee == 0 && kind_of(step.pc) == Kind::Branch) return;
  context.frames.push_back({callee, processor_.w(15), context.clock, step.end, caller});
  if (by_register && contexts_.size() > 1) functions_[static_cast<std::size_t>(callee)].is_agenda = true;
}

/// The function of the host that the CALL or RCALL at `pc` leads to; 0: none.
int Profile::host_function_called(unsigned pc) const {
  unsigned to = destination(file_, pc);
  if (to == 0) return 0;
  if (!dspic::is_host_place(to)) to = goto_target(file_, to);
  return dspic::is_host_place(to) ? function_of(to) : 0;
}

// it is over already: it took what is beside the call itself
void Profile::note_host_call(const Step& step, int function) {
  FunctionTally& f = functions_[static_cast<std::size_t>(function)];
  const int caller = function_of(step.pc);
  const Cycle took = step.took - kCallCycles;
  if (f.cycles.count == 0 || took > f.cycles.max) f.max_caller = caller;
  f.cycles.add(took, step.begin);
  f.own += took;
  functions_[static_cast<std::size_t>(caller)].own -= took;
}

// the handler known by heart calls what comes next
void Profile::call_agenda(const Step& step) {
  if (step.next == dspic::kHostHandlerReturn || here().frames.size() >= kMostFrames) return;
  const int callee = function_of(step.next);
  here().frames.push_back({callee, processor_.w(15), here().clock, step.end, handler_by_heart_});
  functions_[static_cast<std::size_t>(callee)].is_agenda = true;
}

// also by longjmp(): whatever lies above the stack's end is over
void Profile::come_back(Context& context, unsigned sp) {
  while (context.frames.size() > 1 && context.frames.back().sp > sp) {
    finish(context, context.frames.back());
    end_wait(context.frames.back().round);
    context.frames.pop_back();
  }
}

void Profile::finish(Context& context, const Frame& frame) {
  FunctionTally& f = functions_[static_cast<std::size_t>(frame.function)];
  const Cycle took = context.clock - frame.began;
  if (f.cycles.count == 0 || took > f.cycles.max) f.max_caller = frame.caller;
  f.cycles.add(took, frame.at);
}

// --- handlers

void Profile::enter_handler(const Step& step) {
  InterruptTally& tally = interrupts_[step.entered];
  Context context;
  context.vector = step.entered;
  context.at = step.begin;
  const int handler = step.by_heart ? handler_by_heart_ : function_of(step.next);
  context.frames.push_back({handler, 0, 0, step.begin});
  if (step.entered >= dspic::kFirstIrqVector) {
    const Cycle flagged = step.flagged;
    // what is known by heart has come to its first call by then
    tally.latency.add((step.by_heart ? step.begin + kEntryCycles : step.end) - flagged, step.end);
    if (tally.flagged >= 0) tally.period.add(flagged - tally.flagged, flagged);
    tally.flagged = flagged;
    flags_ &= ~(std::uint64_t{1} << (step.entered - dspic::kFirstIrqVector));
  }
  Cut cut;
  const std::uint8_t* const ram = processor_.ram();
  for (const Frame& frame : here().frames)
    if (!frame.round.ram.empty() && cut.ram.empty()) cut.ram.assign(ram, ram + dspic::Processor::kRamBytes);
  cut.writes = device_.parts().bus.writes();
  cut.steps = steps_ - 1;  // this one
  cuts_.push_back(std::move(cut));
  contexts_.push_back(std::move(context));
}

void Profile::leave_handler() {
  if (contexts_.size() == 1) return;
  Context& context = here();
  come_back(context, 0);
  end_wait(context.frames[0].round);
  finish(context, context.frames[0]);
  interrupts_[context.vector].cycles.add(context.clock, context.at);
  contexts_.pop_back();
  // what the handler changed is no doing of the round that it cut
  const Cut& cut = cuts_.back();
  for (Frame& frame : here().frames) {
    Round& round = frame.round;
    round.writes += device_.parts().bus.writes() - cut.writes;
    round.steps += steps_ - cut.steps;
    for (std::size_t i = 0; i < round.ram.size(); ++i)
      if (cut.ram[i] != processor_.ram()[i]) round.ram[i] = processor_.ram()[i];
  }
  cuts_.pop_back();
}

// An enabled flag that fell without a service was cleared by the program; handlers known by heart serve theirs
// within steps.
void Profile::watch_flags() {
  const dspic::Interrupts& interrupts = device_.parts().interrupts;
  const std::uint64_t flags = interrupts.sources().flags(), enabled = interrupts.sources().enabled_mask();
  std::uint64_t fell = flags_ & ~flags & ~served_by_heart_;
  flags_ = flags & enabled;
  for (const Context& context : contexts_)
    if (context.vector >= dspic::kFirstIrqVector)
      flags_ &= ~(std::uint64_t{1} << (context.vector - dspic::kFirstIrqVector));
  for (; fell; fell &= fell - 1) ++interrupts_[dspic::kFirstIrqVector + __builtin_ctzll(fell)].missed;
}

void Profile::watch_stack(Cycle at) {
  const unsigned top = processor_.w(15);
  if (top <= stack_top_ || top > dspic::Processor::kRamEnd) return;
  stack_top_ = top;
  stack_at_ = at;
  stack_path_.clear();
  for (const Context& context : contexts_) {
    stack_path_.push_back({context.vector, {}});
    for (const Frame& frame : context.frames) stack_path_.back().functions.push_back(frame.function);
  }
}

// --- loops

void Profile::turn_loop(const Step& step) {
  if (contexts_.size() > 1 || function_of(step.next) != function_of(step.pc)) return;
  Loop& loop = loops_[step.next];
  loop.begin = step.next;
  loop.depth = here().frames.size();
  loop.end = std::max(loop.end, step.pc);
  if (loop.last >= 0) loop.turn.add(step.end - loop.last, loop.last);
  loop.last = step.end;
  if (loop.waits_by.count(step.pc)) return;
  if (loop.long_last >= 0) loop.long_turn.add(step.end - loop.long_last, loop.long_last);
  loop.long_last = step.end;
}

void Profile::look_for_wait(const Step& step) {
  Context& context = here();
  Round& round = context.frames.back().round;
  const bool again = round.target == step.next && steps_ - round.steps <= kLongestRound;
  bool counts = false;
  if (!again) {
    end_wait(round);
    round = Round{};
    round.target = step.next;
  } else if (is_wait(step, round, counts)) {
    const Cycle waited =
        context.clock - round.clock - (context.waited - round.waited);  // not in what it calls
    if (round.wait_at < 0) {
      round.wait = 0;
      round.wait_at = step.end;
    }
    round.wait += waited;
    context.waited += waited;
    Loop& loop = loops_[step.next];
    loop.polled += counts ? 0 : waited;
    if (loop.waits_by.insert(step.pc).second) {  // some were rounds of this wait
      loop.long_turn = {};
      loop.long_last = -1;
    }
  } else {
    end_wait(round);
  }
  round.length = steps_ - round.steps;
  round.steps = steps_;
  round.clock = context.clock;
  round.waited = context.waited;
  round.writes = device_.parts().bus.writes();
  for (std::size_t n = 0; n < round.w.size(); ++n) round.w[n] = processor_.w(static_cast<int>(n));
}

bool Profile::is_wait(const Step& step, Round& round, bool& counts) {
  const int counter = changed_register(step, round);
  if (counter == kTooMany || device_.parts().bus.writes() != round.writes) {
    round.trusted = 0;
    round.ram.clear();
    return false;
  }
  if (round.ignored > 0) {
    --round.ignored;
    return false;
  }
  const bool is_same_length = steps_ - round.steps == round.length;
  bool is_it = false;
  if (round.trusted > 0 && is_same_length) {
    --round.trusted;
    is_it = true;
  } else if (!round.ram.empty()) {
    is_it = is_same_ram(round.ram, counter, counts);
    round.trusted = is_it ? kTrustedRounds : 0;
    round.failures = is_it ? 0 : round.failures + 1;
    if (!is_it) round.ignored = std::min(1 << std::min(round.failures, 6), kMostIgnored);
  }
  if (counter >= 0) counts = true;
  if (round.trusted > 0)
    round.ram.clear();
  else
    round.ram.assign(processor_.ram(), processor_.ram() + dspic::Processor::kRamBytes);
  return is_it;
}

// the one register that differs from the round before; kNone, kTooMany: also where it is a pointer
int Profile::changed_register(const Step& step, const Round& round) {
  int changed = kNone;
  for (int n = 0; n < 16; ++n) {
    if (processor_.w(n) == round.w[static_cast<std::size_t>(n)]) continue;
    if (changed != kNone) return kTooMany;
    changed = n;
  }
  if (changed == kNone) return kNone;
  Loop& loop = loops_[step.next];
  if (loop.pointers < 0) loop.pointers = static_cast<int>(pointers_of(step.next, step.pc));
  return loop.pointers >> changed & 1 ? kTooMany : changed;
}

unsigned Profile::pointers_of(unsigned begin, unsigned end) const {
  unsigned registers = 0;
  for (unsigned a = begin; a <= end; a += 2) {
    const auto word = file_.words.find(a);
    const dspic::Row* row = word == file_.words.end() ? nullptr : dspic::find_row(word->second);
    if (!row) continue;
    const dspic::Fields f = dspic::fields_of(*row, word->second);
    for (const dspic::Operand kind : row->kinds) {
      if (kind == dspic::Operand::Source && f.p) registers |= 1u << f.s;
      if (kind == dspic::Operand::Destination && f.q) registers |= 1u << f.d;
    }
  }
  return registers & 0x7FFF;
}

// but for one word, a counter that passes through a register, and what lies beyond the stack's end
bool Profile::is_same_ram(const std::vector<std::uint8_t>& before, int counter, bool& counts) const {
  const std::uint8_t* ram = processor_.ram();
  if (std::memcmp(ram, before.data(), before.size()) == 0) return true;
  const unsigned sp = processor_.w(15), limit = device_.peek(kSplim, to_) + 2u;
  int words = 0;
  for (std::size_t i = 0; i < before.size(); i += 2) {
    if (ram[i] == before[i] && ram[i + 1] == before[i + 1]) continue;
    const auto address = static_cast<unsigned>(i) + dspic::Processor::kRamStart;
    if (address >= sp && address < limit) continue;
    const auto old = static_cast<unsigned>(before[i] | before[i + 1] << 8),
               now = static_cast<unsigned>(ram[i] | ram[i + 1] << 8);
    const unsigned value = counter >= 0 ? processor_.w(counter) : now;
    if (++words > 1 || (value != now && value != old)) return false;
  }
  counts |= words > 0;
  return true;
}

void Profile::end_wait(Round& round) {
  if (round.wait_at < 0) return;
  loops_[round.target].wait.add(round.wait, round.wait_at);
  round.wait_at = -1;
}

// --- the report

std::string Profile::name_of(int function) const {
  if (function == handler_by_heart_) return "_T2Interrupt";
  return function > 0 ? file_.code.functions[static_cast<std::size_t>(function - 1)].name : "?";
}

ProfileReport Profile::report() const {
  ProfileReport report;
  report.from = std::max<Cycle>(from_, 0);
  report.to = to_;
  report.slept = slept_;
  report.waited = from_ < 0 ? 0 : processor_.idle(to_) - idle_before_ - slept_;
  report.in_handlers = in_handlers_;
  for (int irq = 0; irq < dspic::kIrqs; ++irq)
    if (served_by_heart_ >> irq & 1)
      report.by_heart.push_back(dspic::vector_name(dspic::kFirstIrqVector + irq));
  // Functions, with who called the longest of their calls, and where they stand in the source.
  if (const FunctionTally& own = functions_.back(); own.own > 0)
    report.functions.push_back({name_of(handler_by_heart_), "", own.cycles, own.own, "", false});
  for (std::size_t f = 1; f + 1 < functions_.size(); ++f) {
    const FunctionTally& tally = functions_[f];
    if (tally.own == 0) continue;
    const auto& function = file_.code.functions[f - 1];
    ProfileReport::Function out{function.name,  "", tally.cycles, tally.own, name_of(tally.max_caller),
                                tally.is_agenda};
    if (const auto* line = file_.code.line_at(function.begin))
      out.place = file_.code.lines().files[line->file] + ":" + std::to_string(line->line);
    report.functions.push_back(out);
  }
  std::stable_sort(report.functions.begin(), report.functions.end(),
                   [](const auto& a, const auto& b) { return a.own > b.own; });
  // Interrupts: those that a handler known by heart serves within steps, too, where some were merged.
  std::map<int, InterruptTally> interrupts = interrupts_;
  for (int vector = dspic::kFirstIrqVector; vector < dspic::kVectors; ++vector)
    if (device_.interrupts().missed(vector, report.to) > 0) interrupts.try_emplace(vector);
  for (const auto& [vector, tally] : interrupts)
    report.interrupts.push_back(
        {vector, dspic::vector_name(vector), tally.cycles, tally.latency, tally.period,
         vector >= dspic::kFirstIrqVector ? device_.interrupts().missed(vector, report.to) : 0,
         tally.missed});
  // Waits, and among the loops the main one.
  const Loop* main_loop = nullptr;
  for (const auto& [target, loop] : loops_) {
    Spread wait = loop.wait;
    for (const Frame& frame : contexts_[0].frames)  // that goes on
      if (frame.round.target == target && frame.round.wait_at >= 0)
        wait.add(frame.round.wait, frame.round.wait_at);
    if (wait.count > 0)
      report.waits.push_back({file_.code.describe(target), wait, 2 * loop.polled < wait.sum});
    const unsigned span = loop.end - target;
    // the outermost that takes at least half of the time
    if (loop.turn.count < 2 || 2 * loop.turn.sum < to_ - report.from) continue;
    if (main_loop && (main_loop->depth < loop.depth ||
                      (main_loop->depth == loop.depth && main_loop->end - main_loop->begin >= span)))
      continue;
    main_loop = &loop;
    const bool has_more =
        !loop.waits_by.empty() && loop.long_turn.count >= 2 && loop.end > *loop.waits_by.rbegin();
    report.turn = has_more ? loop.long_turn : loop.turn;
    report.turn_place = file_.code.describe(target);
  }
  std::stable_sort(report.waits.begin(), report.waits.end(),
                   [](const auto& a, const auto& b) { return a.cycles.sum > b.cycles.sum; });
  // The stack where it was deepest, and by what calls.
  if (stack_top_ > 0) {
    const unsigned base = stack_base_ > 0 ? stack_base_ : dspic::Processor::kRamStart;
    report.data_bytes = static_cast<int>(base - dspic::Processor::kRamStart);
    report.stack_bytes = static_cast<int>(stack_top_ > base ? stack_top_ - base : 0);
    report.stack_free = static_cast<int>(dspic::Processor::kRamEnd - std::max(stack_top_, base));
    report.stack_at = stack_at_;
    for (const auto& [vector, functions] : stack_path_) {
      if (!report.stack_path.empty())
        report.stack_path += std::string(" | ") + dspic::vector_name(vector) + ": ";
      for (std::size_t i = 0; i < functions.size(); ++i)
        report.stack_path += (i > 0 ? " > " : "") + name_of(functions[i]);
    }
  }
  return report;
}

}  // namespace chip
