// SPDX-License-Identifier: MIT
#include "hal_sim/chip/code_cycles.h"

#include <algorithm>

#include "dspic30/memory/host_places.h"
#include "hal_sim/chip/step_counts.h"

namespace chip {

using dspic::Cycle;
using dspic::Insn;

namespace {

constexpr int kDeepest = 1000;           // jumps and calls
constexpr Cycle kEntryOfHandler = 3;     // as Profile counts a service
constexpr unsigned kTables = 0x8000;     // data addresses from here on read the flash
constexpr std::uint16_t kCalled = 0xFF;  // W0 to W7 are anybody's behind a call

constexpr std::uint16_t bit(unsigned n) { return static_cast<std::uint16_t>(1u << n); }

bool calls(Insn id) { return id == Insn::Call_Expr || id == Insn::Rcall_Expr; }
bool calls_by_register(Insn id) { return id == Insn::Call_Wn || id == Insn::Rcall_Wn; }
bool is_jump(Insn id) { return id == Insn::Bra_Expr || id == Insn::Goto_Expr; }
bool is_return(Insn id) { return id == Insn::Return || id == Insn::Retfie || id == Insn::Retlw_lit10_Wn; }

}  // namespace

CodeCycles::CodeCycles(const dspic::FirmwareFile& file) : file_(file) {
  for (const auto& [address, word] : file.words) program_.write(address, word);
}

CodeCycles::Instruction CodeCycles::at(std::uint32_t address) const {
  Instruction i;
  const auto word = file_.words.find(address);
  if (word == file_.words.end() || !(i.row = dspic::find_row(word->second))) return i;
  dspic::WordRegisters registers;
  i.decoded = dspic::decode_word(program_, address, {}, registers);
  i.least = i.most = i.decoded.cycles - i.decoded.lead;
  i.target = dspic::destination(*i.row, word->second, program_.read(address + 2), address).value_or(0);
  if (i.row->id == Insn::Repeat_lit14) i.repeats = dspic::fields_of(*i.row, word->second).k;
  return i;
}

/// Of what a REPEAT repeats, those behind the first.
Cycle CodeCycles::iterations(const Instruction& repeat, const Instruction& repeated) {
  const bool stalls = (repeated.decoded.writes & repeated.decoded.pointers) != 0;  // behind itself
  return static_cast<Cycle>(repeat.repeats) * (repeated.decoded.cycles - repeated.decoded.lead + stalls);
}

/// A read of a constant in flash takes longer; where a pointer leads is not always known.
void CodeCycles::add_table_reads(Instruction& i, const Pointers& pointers) const {
  const dspic::Decoded& d = i.decoded;
  if (i.row->id == Insn::Mov_f_Wnd && static_cast<unsigned>(d.imm) >= kTables) {
    i.least += d.psv;
    i.most += d.psv;
  }
  if (is_return(i.row->id) || i.row->id == Insn::Ulnk) return;
  const auto unknown = static_cast<std::uint16_t>(d.pointers & ~pointers.ram);
  if ((d.pointers & pointers.ram) == d.pointers || d.pointers == 0) return;
  // an index beside a base does not say where it leads
  if (i.row->has(dspic::Operand::SourceOffset) && (d.pointers & pointers.ram) &&
      !(d.pointers & pointers.table))
    return;
  if (d.pointers & pointers.table) i.least += d.psv;
  if (unknown) i.most += d.psv;
}

void CodeCycles::follow(const Instruction& i, Pointers& p) {
  const dspic::Decoded& d = i.decoded;
  const auto set = [&](unsigned n, bool ram, bool table) {
    p.ram = static_cast<std::uint16_t>(ram ? p.ram | bit(n) : p.ram & ~bit(n));
    p.table = static_cast<std::uint16_t>(table ? p.table | bit(n) : p.table & ~bit(n));
  };
  // What is written points nowhere known, unless it is one of the forms below.
  const Pointers before = p;
  p.ram = static_cast<std::uint16_t>(p.ram & ~d.writes);
  p.table = static_cast<std::uint16_t>(p.table & ~d.writes);
  const bool to_register = d.writes == bit(d.d) && d.d < 14;
  const auto is_ram = [&](unsigned n) { return (before.ram & bit(n)) != 0; };
  const auto is_table = [&](unsigned n) { return (before.table & bit(n)) != 0; };
  switch (i.row->id) {
    case Insn::Mov_lit16_Wnd:
      set(d.d, static_cast<unsigned>(d.imm) < kTables, static_cast<unsigned>(d.imm) >= kTables);
      break;
    case Insn::Mov_Wso_Wdo:
      if (to_register && d.pointers == 0) set(d.d, is_ram(d.s), is_table(d.s));
      break;
    case Insn::Add_Wb_lit5_Wd:
    case Insn::Sub_Wb_lit5_Wd:
      if (to_register) set(d.d, is_ram(d.b), is_table(d.b));
      break;
    case Insn::Add_lit10_Wn:
    case Insn::Sub_lit10_Wn:
      set(d.d, is_ram(d.d), is_table(d.d));
      break;
    case Insn::Add_Wb_Ws_Wd:
      // a base and an index
      if (to_register && d.pointers == 0)
        set(d.d, (is_ram(d.b) || is_ram(d.s)) && !is_table(d.b) && !is_table(d.s),
            is_table(d.b) || is_table(d.s));
      break;
    default:
      break;
  }
  p.ram |= Pointers::kFrames;
}

PathCycles CodeCycles::of_function(std::uint32_t begin) { return from(begin, true, 0); }

PathCycles CodeCycles::without_bound(const std::string& why, std::uint32_t address) const {
  PathCycles none;
  none.why_not = why;
  if (const auto* line = file_.code.line_at(address)) {
    const std::string& file = file_.code.lines().files[line->file];
    none.why_not += " (" + file.substr(file.rfind('/') + 1) + ":" + std::to_string(line->line) + ")";
  }
  return none;
}

/// From a place that the course jumps, calls or branches to, up to RETURN.
PathCycles CodeCycles::from(std::uint32_t address, bool jumped, int depth) {
  const auto key = std::make_pair(address, jumped);
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  const auto* const function = file_.code.function_at(address);
  if (open_.count(key)) {
    // a call of what is being called, or a way back
    const bool is_entry = function && function->begin == address;
    return without_bound(is_entry ? "loops or calls itself" : "loops", address);
  }
  if (depth > kDeepest) return without_bound("has too many ways", address);
  open_.insert(key);
  PathCycles cycles = walk(address, jumped, depth);
  open_.erase(key);
  // what was met again on the way belongs to whoever went round, not to what lies in the round alone; without
  // a bound it is all the same
  known_[key] = cycles;
  return cycles;
}

PathCycles CodeCycles::walk(std::uint32_t address, bool jumped, int depth) {
  PathCycles sum;
  Pointers pointers;
  const auto add = [&sum](Cycle least, Cycle most) {
    sum.least += least;
    sum.most += most;
  };
  // Two ways on: the shorter one is the least, the longer one the most.
  const auto name_at = [this](std::uint32_t begin) {
    const auto* const function = file_.code.function_at(begin);
    return function ? function->name + "()" : std::string("code without a name");
  };
  // the rest by one way or another
  const auto either = [&](const PathCycles& one, Cycle more, const PathCycles& other) {
    if (!one.is_known()) return one;
    if (!other.is_known()) return other;
    add(std::min(one.least, other.least + more), std::max(one.most, other.most + more));
    return sum;
  };
  for (;; jumped = false) {
    Instruction i = at(address);
    if (dspic::is_host_place(address)) return without_bound("is played by the simulator", address);
    if (!i.row) return without_bound("goes where no instruction is", address);
    // What the instruction itself takes.
    add_table_reads(i, pointers);
    if (!jumped) add(i.decoded.lead, i.decoded.lead);
    add(i.least, i.most);
    const std::uint32_t next = address + 2 * static_cast<unsigned>(i.row->words);
    const Insn id = i.row->id;
    if (id == Insn::Retfie) add(kEntryOfHandler, kEntryOfHandler);
    if (is_return(id)) return sum;
    // Where the course, or how often it goes round, depends on a register, code alone says nothing.
    if (calls_by_register(id)) return without_bound("calls through a pointer", address);
    if (id == Insn::Bra_Wn || id == Insn::Goto_Wn) return without_bound("jumps through a pointer", address);
    if (id == Insn::Do_lit14_Expr || id == Insn::Do_Wn_Expr) return without_bound("loops by DO", address);
    if (id == Insn::Pwrsav_lit1) return without_bound("sleeps", address);
    if (id == Insn::Reset) return without_bound("resets", address);
    if (id == Insn::Repeat_Wn)
      return without_bound("repeats an instruction as often as a register says", address);
    // A jump: the rest is what it leads to.
    if (is_jump(id)) {
      PathCycles rest = from(i.target, true, depth + 1);
      if (!rest.is_known()) return rest;
      add(rest.least, rest.most);
      return sum;
    }
    // A call takes what its callee takes, and goes on behind it.
    if (calls(id)) {
      const PathCycles callee = from(i.target, true, depth + 1);
      if (!callee.is_known()) {
        const bool is_told =
            callee.why_not.rfind("calls ", 0) == 0 && callee.why_not.find("which") != std::string::npos;
        PathCycles none = callee;
        if (!is_told) none.why_not = "calls " + name_at(i.target) + ", which " + callee.why_not;
        return none;
      }
      add(callee.least, callee.most);
      pointers.ram = static_cast<std::uint16_t>(pointers.ram & ~kCalled);
      pointers.table = static_cast<std::uint16_t>(pointers.table & ~kCalled);
      address = next;
      // the return is a jump: nothing stalls behind it
      const Instruction behind = at(address);
      if (behind.row) add(-behind.decoded.lead, -behind.decoded.lead);
      continue;
    }
    // A branch or skip: both ways are followed to their ends.
    if (is_conditional(program_.read(address))) {
      const bool skips = i.target == 0;
      const Cycle more = skips ? i.decoded.d : 1;
      const std::uint32_t other = skips ? next + 2 * i.decoded.d : i.target;
      const PathCycles straight = from(next, false, depth + 1), jumping = from(other, true, depth + 1);
      return either(straight, more, jumping);
    }
    if (i.repeats > 0) {
      const Cycle further = iterations(i, at(next));
      add(further, further);
    }
    follow(i, pointers);
    address = next;
  }
}

std::vector<CodeCycles::Line> CodeCycles::lines(std::uint32_t begin, std::uint32_t end) const {
  std::map<std::pair<std::string, int>, Line> all;
  Pointers pointers;
  for (std::uint32_t address = begin; address < end;) {
    // Each instruction counts for the source line that it belongs to.
    Instruction i = at(address);
    if (!i.row) break;
    const auto* const row = file_.code.line_at(address);
    const std::string file = row ? file_.code.lines().files[row->file] : "";
    Line& line = all[{file, row ? row->line : 0}];
    line.file = file;
    line.line = row ? row->line : 0;
    ++line.instructions;
    add_table_reads(i, pointers);
    const Insn id = i.row->id;
    const bool is_branch = is_conditional(program_.read(address));
    const std::uint32_t next = address + 2 * static_cast<unsigned>(i.row->words);
    Cycle more = is_branch ? (i.target == 0 ? i.decoded.d : 1) : 0;
    // What it takes once, and its repetitions.
    line.least += i.least + i.decoded.lead;
    line.most += i.most + i.decoded.lead + more;
    if (i.repeats > 0) {
      more = iterations(i, at(next));
      line.least += more;
      line.most += more;
    }
    line.repeats |= id == Insn::Repeat_Wn;
    const bool leaves = is_jump(id) && (i.target < begin || i.target >= end);
    // What it calls is named, not counted.
    if (calls_by_register(id)) line.calls.push_back("a pointer");
    if (calls(id) || leaves) {
      const auto* const function = file_.code.function_at(i.target);
      line.calls.push_back(function ? function->name : "?");
    }
    follow(i, pointers);
    // Behind a branch or a call nothing is known of what registers point to.
    if (calls(id) || calls_by_register(id) || is_branch || i.target != 0) pointers = {};
    address = next;
  }
  std::vector<Line> sorted;
  for (auto& [place, line] : all) sorted.push_back(std::move(line));
  return sorted;
}

}  // namespace chip
