// SPDX-License-Identifier: MIT
#include "hal_sim/chip/memory_reports.h"

#include <algorithm>

#include "dspic30/core/cpu.h"
#include "dspic30/memory/hex.h"
#include "dspic30/memory/host_places.h"

namespace chip {

namespace {

using Kind = dspic::MemoryFinding::Kind;
using State = dspic::MemoryCheck::State;
constexpr std::size_t kMostTold = 1000;  // places and kinds
constexpr std::size_t kMostObjects = 4;
constexpr int kMostLooks = 1000;
constexpr unsigned kNear = 64;  // bytes beside a variable that are said to be beyond it
constexpr std::size_t kLongestName = 60;

const std::pair<const char*, const char*> kFailedChecks[] = {
    {"add_overflow", "integer overflow in an addition"},
    {"sub_overflow", "integer overflow in a subtraction"},
    {"mul_overflow", "integer overflow in a multiplication"},
    {"divrem_overflow", "integer overflow in a division"},
    {"negate_overflow", "integer overflow in a negation"},
    {"shift_out_of_bounds", "shift by more than the width of the operand"},
    {"out_of_bounds", "array index out of bounds"}};

}  // namespace

bool MemoryReports::is_for(const dspic::FirmwareFile& file) {
  return file.marks.count(dspic::kCheckedSymbol) != 0;
}

MemoryReports::MemoryReports(const dspic::FirmwareFile& file, const dspic::Processor& processor,
                             const ProgramPlaces& places,
                             std::function<void(const std::string&, unsigned)> tell)
    : file_(file), processor_(processor), places_(places), tell_(std::move(tell)), check_(*this) {
  const auto mark = [&](const char* name) {
    const auto found = file.marks.find(name);
    return found == file.marks.end() ? 0u : found->second;
  };
  heap_begin_ = mark(dspic::kCheckedHeapSymbol), heap_end_ = mark(dspic::kCheckedHeapEndSymbol);
  stack_begin_ = mark(dspic::kCheckedSymbol);
  const auto hear = [&](const std::string& name, Function function, const char* message = "") {
    if (const auto found = file.functions.find(name); found != file.functions.end())
      entries_[found->second] = {function, message};
  };
  hear("main", Function::Main);
  hear(dspic::kLocalFunction, Function::Local);
  for (const auto& [name, message] : kFailedChecks)
    hear(std::string(dspic::kCheckedPrefix) + name, Function::FailedCheck, message);
  if (heap_end_ > heap_begin_) {
    hear("malloc", Function::Malloc);
    hear("calloc", Function::Calloc);
    hear("realloc", Function::Realloc);
    hear("free", Function::Free);
    check_.mark(heap_begin_, heap_end_, State::Outside);
  }
  // statics of the same name, in files and functions, are in the debugger's list alone
  const auto add = [&](unsigned address, unsigned bytes, const std::string& name) {
    if (address >= dspic::Processor::kRamStart && address < dspic::Processor::kRamEnd)
      globals_.push_back({address, bytes, name});
  };
  const dspic::DebugInfo& info = file.debug.value();
  for (const auto& variable : info.variables)
    if (variable.is_static && !variable.places.empty() &&
        variable.places[0].in == dspic::DebugInfo::Place::In::Memory)
      add(static_cast<unsigned>(variable.places[0].value),
          info.types[static_cast<std::size_t>(variable.type)].bytes, variable.name);
  for (const auto& [name, address] : file.objects) {
    const auto bytes = file.object_bytes.find(name);
    add(address, bytes == file.object_bytes.end() ? 0 : bytes->second, name);
  }
  std::stable_sort(globals_.begin(), globals_.end(),
                   [](const Object& a, const Object& b) { return a.begin < b.begin; });
}

/// What start-up code has left alone belongs to nobody, unless it is known to.
void MemoryReports::find_gaps() {
  using dspic::Processor;
  // the same each time the program begins
  const unsigned limit = processor_.cpu().splim + 2u;
  if (gaps_limit_ != limit) {
    gaps_limit_ = limit;
    gaps_.clear();
    const auto served = file_.marks.find(dspic::kServedEndSymbol);
    std::vector<std::pair<unsigned, unsigned>> kept = {
        {Processor::kRamStart, served == file_.marks.end() ? Processor::kRamStart : served->second},
        {heap_begin_, heap_end_},
        {stack_begin_, limit},
        {Processor::kRamEnd, Processor::kRamEnd}};
    for (const Object& o : globals_) kept.push_back({o.begin, o.begin + (o.bytes ? o.bytes : 2)});
    std::sort(kept.begin(), kept.end());
    unsigned at = Processor::kRamStart;
    for (const auto& [begin, end] : kept) {
      if (begin > at) gaps_.push_back({at, std::min(begin, Processor::kRamEnd)});
      at = std::max(at, end);
    }
  }
  for (const auto& [begin, end] : gaps_)
    for (unsigned at = begin; at < end; ++at)
      if (!check_.is_written(at)) check_.mark(at, at + 1, State::Outside);
}

std::vector<std::uint32_t> MemoryReports::addresses() const {
  std::vector<std::uint32_t> all;
  for (const auto& [address, entry] : entries_) all.push_back(address);
  return all;
}

void MemoryReports::restart() {
  locals_.clear();
  heap_.clear();
  check_.mark(dspic::Processor::kRamStart, dspic::Processor::kRamEnd, State::Plain);
  if (heap_end_ > heap_begin_) check_.mark(heap_begin_, heap_end_, State::Outside);
}

// --- what the program tells

bool MemoryReports::entered(unsigned address) {
  const auto found = entries_.find(address);
  if (found == entries_.end()) return false;
  const auto w = [&](int n) { return static_cast<unsigned>(processor_.w(n)); };
  const Function function = found->second.function;
  switch (function) {
    case Function::Main:
      find_gaps();
      return false;
    case Function::Local:
      note_local();
      break;
    case Function::FailedCheck: {
      const unsigned call = places_.caller();
      tell_(found->second.message, call);
      break;
    }
    case Function::Malloc:
    case Function::Calloc:
    case Function::Realloc:
    case Function::Free:
      if (check_.is_away()) break;  // one of these calls another
      // What was asked for is kept until the call returns, and with that the block is known.
      asked_ = function;
      asked_bytes_ = function == Function::Malloc    ? w(0)
                     : function == Function::Calloc  ? w(0) * w(1)
                     : function == Function::Realloc ? w(1)
                                                     : 0;
      asked_block_ = function == Function::Realloc || function == Function::Free ? w(0) : 0;
      if (asked_block_ != 0) {
        const auto block = heap_.find(asked_block_);
        const char* const name = function == Function::Free ? "free()" : "realloc()";
        if (block == heap_.end())
          tell_(std::string(name) + " of what malloc() did not give", places_.own(places_.caller()));
        else if (block->second.is_free)
          tell_(std::string(name) + " of heap memory that is freed already", places_.own(places_.caller()));
      }
      check_.await_return(processor_.cpu());
      break;
  }
  return true;
}

/// W0 its address, W1 its bytes, W2 its name.
void MemoryReports::note_local() {
  Object local{processor_.w(0), processor_.w(1), ""};
  const dspic::Cpu& cpu = processor_.cpu();
  for (unsigned at = processor_.w(2); at >= dspic::Cpu::kPsvStart && local.name.size() < kLongestName; ++at) {
    const unsigned word = cpu.program.read(static_cast<unsigned>(cpu.psvpag) << 15 | (at & 0x7FFE));
    const char c = static_cast<char>(word >> 8 * (at & 1) & 0xFF);
    if (c == 0) break;
    local.name += c;
  }
  const unsigned end = local.begin + local.bytes;
  // It takes the place of locals that lay there before, and gets its gaps.
  if (local.begin < stack_begin_ || end > processor_.w(15)) return;
  locals_.erase(
      std::remove_if(locals_.begin(), locals_.end(),
                     [&](const Object& o) { return o.begin < end && local.begin < o.begin + o.bytes; }),
      locals_.end());
  check_.forget(local.begin, end);
  check_.mark(local.begin, end, State::Plain);
  check_.mark(local.begin - dspic::kLocalGap, local.begin, State::Outside);
  check_.mark(end, end + dspic::kLocalGap, State::Outside);
  locals_.push_back(std::move(local));
}

void MemoryReports::stack_fell(unsigned top) {
  if (locals_.empty()) return;
  locals_.erase(std::remove_if(locals_.begin(), locals_.end(),
                               [top](const Object& o) { return o.begin + o.bytes > top; }),
                locals_.end());
}

void MemoryReports::allocate(unsigned at, unsigned bytes, bool is_written) {
  const unsigned end = at + bytes;
  // blocks that lay there before
  for (auto it = heap_.begin(); it != heap_.end();)
    it = it->first < end && at < it->first + std::max(1u, it->second.bytes) ? heap_.erase(it) : std::next(it);
  heap_[at] = {bytes, false};
  check_.mark(at, end, State::Plain);
  // rounded up: its own, up to the next thing
  if (is_written)
    check_.define(at, end);
  else
    check_.forget(at, end);
}

void MemoryReports::free_block(unsigned at) {
  const auto block = heap_.find(at);
  if (block == heap_.end() || block->second.is_free) return;
  block->second.is_free = true;
  check_.mark(at, at + block->second.bytes, State::Freed);
}

void MemoryReports::returned(std::uint16_t w0) {
  switch (asked_) {
    case Function::Free:
      return free_block(asked_block_);
    case Function::Realloc: {
      const auto old = heap_.find(asked_block_);
      const unsigned before = old == heap_.end() ? 0 : old->second.bytes;
      // The old block is free where it moved, or where 0 bytes were asked for; what it held stays written.
      if (w0 != asked_block_ && (w0 != 0 || asked_bytes_ == 0)) free_block(asked_block_);
      if (w0 == 0) return;
      allocate(w0, asked_bytes_, false);
      return check_.define(w0, w0 + std::min(before, asked_bytes_));
    }
    default:
      if (w0 != 0) allocate(w0, asked_bytes_, asked_ == Function::Calloc);
  }
}

// --- findings

/// Once for each place, kind and object, and no more of a place that goes on and on.
bool MemoryReports::is_told(const dspic::MemoryFinding& f, unsigned place) {
  Told& told = told_[{place, 2 * static_cast<int>(f.kind) + f.writes}];
  if (told.objects.size() >= kMostObjects || told.looked_at++ >= kMostLooks) return true;
  if (f.kind == Kind::AboveStack || f.kind == Kind::Null) return !told.objects.insert(0).second;
  std::string name;
  Object block;
  const Object* const o = owner(f.address, f.bytes, name, block);
  return !told.objects.insert(o ? o->begin : f.address).second;
}

/// A variable that the debugger knows by its place in the frame of the function that runs.
std::string MemoryReports::local_by_frame(unsigned address, unsigned pc) const {
  using In = dspic::DebugInfo::Place::In;
  const dspic::DebugInfo& info = file_.debug.value();
  for (const auto& variable : info.variables) {
    if (variable.is_static || pc < variable.begin || pc >= variable.end) continue;
    const auto* place = dspic::DebugInfo::place_at(variable, pc);
    if (!place || place->in != In::Frame) continue;
    const unsigned begin = (processor_.w(place->base) + static_cast<unsigned>(place->value)) & 0xFFFF;
    const unsigned bytes = info.types[static_cast<std::size_t>(variable.type)].bytes;
    if (address >= begin && address < begin + std::max(1u, bytes)) return variable.name;
  }
  return "";
}

/// The nearest to an access: "a", "the local variable k", "a heap block". Null: nothing is near. `block`:
/// room for one.
const MemoryReports::Object* MemoryReports::owner(unsigned address, unsigned bytes, std::string& name,
                                                  Object& block) const {
  const Object* best = nullptr;
  unsigned nearest = kNear;
  const auto offer = [&](const Object& o, const std::string& called) {
    const unsigned gap = address + bytes <= o.begin     ? o.begin - (address + bytes) + 1
                         : address >= o.begin + o.bytes ? address - (o.begin + o.bytes) + 1
                                                        : 0u;
    if (gap >= nearest) return false;
    nearest = gap;
    best = &o;
    name = called;
    return true;
  };
  // In the heap the owner is a block, elsewhere a local variable or a global one.
  if (is_heap(address)) {
    name = "the heap";
    for (const auto& [at, of_heap] : heap_) {
      const Object o{at, of_heap.bytes, ""};
      if (!offer(o, "a heap block")) continue;
      block = o;
      best = &block;
    }
    return best;
  }
  name = "any variable, at " + dspic::hex(address, 4);
  for (auto it = locals_.rbegin(); it != locals_.rend(); ++it) offer(*it, "the local variable " + it->name);
  for (const Object& o : globals_)
    if (o.bytes > 0 && address < stack_begin_) offer(o, o.name);
  return best;
}

std::string MemoryReports::owner(unsigned address, unsigned bytes) const {
  std::string name;
  Object block;
  const Object* const o = owner(address, bytes, name, block);
  if (!o) return name;
  const int first = static_cast<int>(address) - static_cast<int>(o->begin);
  const int last = first + static_cast<int>(bytes) - 1;
  return name + ": got byte " + std::to_string(first < 0 ? first : last) + ", expected 0 to " +
         std::to_string(static_cast<int>(o->bytes) - 1);
}

std::string MemoryReports::what(const dspic::MemoryFinding& f) const {
  const std::string does = f.writes ? "write" : "read";
  switch (f.kind) {
    case Kind::Freed:
      return "use of freed heap memory: " + does + " of " + owner(f.address, f.bytes);
    case Kind::Outside:
      if (is_heap(f.address)) return does + " out of the bounds of " + owner(f.address, f.bytes);
      return does + " out of bounds of " + owner(f.address, f.bytes);
    case Kind::AboveStack:
      return does + " beyond the top of the stack, at " + dspic::hex(f.address, 4) +
             ": a variable of a function that has returned";
    case Kind::Null:
      return does + " through a null pointer, at " + dspic::hex(f.address, 4);
    default:
      break;
  }
  // Nobody wrote it: what it is called, by what knows its place.
  std::string name;
  for (const Object& o : locals_)
    if (f.address >= o.begin && f.address < o.begin + o.bytes) name = o.name;
  if (name.empty() && f.address >= stack_begin_) name = local_by_frame(f.address, f.pc);
  if (name.empty() && is_heap(f.address)) name = "a heap block";
  for (const Object& o : globals_)
    if (name.empty() && f.address >= o.begin && f.address < o.begin + o.bytes) name = o.name;
  if (name.empty()) name = "what lies at " + dspic::hex(f.address, 4);
  using Use = dspic::MemoryFinding::Use;
  return name + " is read, and nobody has written it; " +
         (f.use == Use::Branch    ? "a branch depends on it"
          : f.use == Use::Address ? "an address is made of it"
                                  : "it goes to a register of the chip");
}

void MemoryReports::found(const dspic::MemoryFinding& finding) {
  if (told_.size() >= kMostTold) return;
  const unsigned place = places_.own(finding.pc);
  if (is_told(finding, place)) return;
  // the library's own lines are not the program's doing
  const std::string function = places_.place_of(finding.pc).function;
  const bool is_own = place == finding.pc || function == "?";
  tell_((is_own ? "" : "in " + function + "(): ") + what(finding), place);
}

}  // namespace chip
