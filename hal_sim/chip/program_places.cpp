// SPDX-License-Identifier: MIT
#include "hal_sim/chip/program_places.h"

#include <algorithm>
#include <map>

#include "dspic30/core/instruction_table.h"
#include "dspic30/memory/host_places.h"
#include "hal_sim/api/host_index.h"

namespace chip {

namespace {

constexpr unsigned kTable = 0x04, kAlternateTable = 0x84, kAltivt = 0x8000, kVectorMask = 0x3F;
constexpr unsigned kInttregAddress = dspic::sfr("INTTREG");
constexpr unsigned kIntcon2 = dspic::sfr("INTCON2");
constexpr int kSharedByMany = 3;          // vectors: it is the default handler
constexpr unsigned kDeepestLook = 0x400;  // bytes of stack
// CALL lit23, RCALL, CALL Wn and RCALL Wn [chip C4]
constexpr bool is_call(std::uint32_t word) { return (word & 0xFF0001) == 0x020000; }
constexpr bool is_short_call(std::uint32_t word) {
  return (word & 0xFF0000) == 0x070000 || (word & 0xFFFFF0) == 0x010000 || (word & 0xFFFFF0) == 0x010200;
}

bool is_of_library(const std::string& file) {
  for (const char* room : {"hal_dspic/", "firmware/libc/", "firmware/library/", "firmware/include/"})
    if (file.find(room) != std::string::npos) return true;
  return false;
}

}  // namespace

std::string handler_of(int vector) {
  return std::string("_") + dspic::vector_name(vector) + (vector < dspic::kFirstIrqVector ? "" : "Interrupt");
}

bool ProgramPlaces::is_of(const dspic::FirmwareFile& file, const std::string& scope,
                          const dspic::DebugInfo::Variable& v) {
  const std::size_t length = scope.size();
  if (v.file == scope ||
      (v.file.size() > length && v.file.compare(v.file.size() - length - 1, length + 1, "/" + scope) == 0))
    return true;
  if (const auto* function = v.end > v.begin ? file.code.function_at(v.begin) : nullptr)
    return function->name == scope;
  // of a function that is inlined wherever it is called, the symbol alone knows
  const auto object = file.objects.find(scope + "." + v.name);
  return object != file.objects.end() && !v.places.empty() &&
         object->second == static_cast<unsigned>(v.places[0].value);
}

unsigned ProgramPlaces::shared_handler(const dspic::FirmwareFile& file, const dspic::ProgramMemory& program) {
  std::map<unsigned, int> users;
  unsigned shared = 0;
  for (int v = 1; v < dspic::kVectors; ++v) {
    const unsigned to = program.read(kTable + 2 * static_cast<unsigned>(v)) & 0x7FFFFE;
    if (file.words.count(to) && ++users[to] >= kSharedByMany && users[to] > users[shared]) shared = to;
  }
  return shared;
}

host::Place ProgramPlaces::place_of(unsigned address) const {
  host::Place place{"?", "", 0};
  // where hal_sim stands in for code
  if (address == dspic::kHostHandlerReturn)
    place.function = handler_of(dspic::kFirstIrqVector + dspic::irq::T2);
  if (const unsigned i = (address - dspic::kHostStart) / 2;
      address >= dspic::kHostStart && i < api::kHostFunctionCount)
    place.function = api::kHostFunctions[i].name;
  if (const auto* function = file_.code.function_at(address)) place.function = function->name;
  if (const auto* line = file_.code.line_at(address)) {
    place.file = file_.code.lines().files[line->file];
    place.line = line->line;
  }
  return place;
}

bool ProgramPlaces::is_own(const dspic::FirmwareFile& file, unsigned address) {
  if (!file.words.count(address)) return false;
  if (file.code.lines().rows.empty()) return true;
  const auto* line = file.code.line_at(address);
  return line && !is_of_library(file.code.lines().files[line->file]);
}

unsigned ProgramPlaces::stack_word(unsigned address) const {
  if (address < dspic::Processor::kRamStart || address + 1 >= dspic::Processor::kRamEnd) return 0;
  return processor_.ram(address) | static_cast<unsigned>(processor_.ram(address + 1)) << 8;
}

unsigned ProgramPlaces::stack_address(unsigned top) const {
  const unsigned high = stack_word(top - 2);
  return high <= 0x7F ? high << 16 | stack_word(top - 4) : 0;
}

unsigned ProgramPlaces::call_before(unsigned address) const {
  if (address % 2 || address < 4 || !file_.words.count(address - 2)) return 0;
  if (is_short_call(program_.read(address - 2))) return address - 2;
  return is_call(program_.read(address - 4)) ? address - 4 : 0;
}

int ProgramPlaces::vector_of(unsigned address) const {
  const auto* function = file_.code.function_at(address);
  for (int v = 1; function && v < dspic::kVectors; ++v)
    if (handler(v) == function->begin) return v;
  return dspic::kNoVector;
}

// return addresses are looked for from the top of the stack down, to the frame of an interrupt: what that cut
// off has nothing to do with it
unsigned ProgramPlaces::own(unsigned address, unsigned stack) const {
  if (is_own(address) || is_handler_code(address)) return address;
  unsigned at = std::min(stack, dspic::Processor::kRamEnd) & ~1u;
  const unsigned end = std::max(at, kDeepestLook) - kDeepestLook;
  for (; at >= dspic::Processor::kRamStart + 4 && at > end; at -= 2) {
    const unsigned back = stack_address(at);
    if (back == dspic::kHostHandlerReturn) break;  // the handler's, known by heart
    const unsigned call = call_before(back);
    if (call == 0) continue;
    if (is_own(call)) return last_jump(call, address);
    if (is_handler_code(call)) break;
  }
  return address;
}

static unsigned destination_of(std::uint32_t word, std::uint32_t second, unsigned at) {
  const dspic::Row* const row = dspic::find_row(word);
  const bool is_conditional = row && row->has(dspic::Operand::Branch) && row->id != dspic::Insn::Rcall_Expr &&
                              row->id != dspic::Insn::Bra_Expr;
  return !row || is_conditional ? 0 : dspic::destination(*row, word, second, at).value_or(0);
}

unsigned ProgramPlaces::target(unsigned at) const {
  return destination_of(program_.read(at), program_.read(at + 2), at);
}

// as own(), but a call that says where it leads must lead to the function that runs further in
std::vector<unsigned> ProgramPlaces::callers(unsigned address, unsigned own_place, std::size_t most) const {
  std::vector<unsigned> calls;
  bool is_met = address == own_place;
  const auto* inner = file_.code.function_at(address);
  unsigned at = std::min<unsigned>(processor_.w(15), dspic::Processor::kRamEnd) & ~1u;
  for (; at >= dspic::Processor::kRamStart + 4 && calls.size() < most; at -= 2) {
    const unsigned back = stack_address(at);
    if (back == dspic::kHostHandlerReturn) break;
    const unsigned call = call_before(back);
    if (call == 0) continue;
    if (is_handler_code(call)) break;
    const unsigned to = target(call);
    if (to != 0 && inner && to != inner->begin) continue;
    inner = file_.code.function_at(call);
    if (call == own_place)
      is_met = true;
    else if (is_met && is_own(call))
      calls.push_back(call);
  }
  return calls;
}

/// A function may end in a jump to the next one, which leaves nothing on the stack: the jump to the function
/// of `to` in the one that is called at `call`, if that is the program's own; else `call`.
unsigned ProgramPlaces::last_jump(unsigned call, unsigned to) const {
  const unsigned called = target(call);
  const auto *between = called ? file_.code.function_at(called) : nullptr, *end = file_.code.function_at(to);
  if (!between || !end || between == end || !is_own(called)) return call;
  for (unsigned at = between->begin; at < between->end; at += 2)
    if (target(at) == end->begin && is_own(at)) return at;
  return call;
}

unsigned goto_target(const dspic::FirmwareFile& file, unsigned address) {
  constexpr std::uint32_t kGoto = 0x04, kHigh = 0x7F;
  const auto low = file.words.find(address), high = file.words.find(address + 2);
  if (low == file.words.end() || high == file.words.end() || low->second >> 16 != kGoto) return 0;
  return (high->second & kHigh) << 16 | (low->second & 0xFFFE);
}

unsigned destination(const dspic::FirmwareFile& file, unsigned address) {
  const auto word = file.words.find(address), second = file.words.find(address + 2);
  if (word == file.words.end()) return 0;
  return destination_of(word->second, second == file.words.end() ? 0 : second->second, address);
}

unsigned ProgramPlaces::caller() const {
  const unsigned stack = processor_.w(15);
  return call_before((stack_word(stack - 2) & 0x7F) << 16 | stack_word(stack - 4));
}

bool ProgramPlaces::has_alternate_table() const {
  return (chip_.device().peek(kIntcon2, chip_.latest()) & kAltivt) != 0;
}

unsigned ProgramPlaces::handler(int vector) const {
  return program_.read((has_alternate_table() ? kAlternateTable : kTable) +
                       2 * static_cast<unsigned>(vector)) &
         0x7FFFFE;
}

std::string ProgramPlaces::handler_name(int vector) const {
  const std::string usual = handler_of(vector);
  return has_alternate_table() ? "_Alt" + usual.substr(1) : usual;
}

bool ProgramPlaces::has_handler(int vector) const {
  const unsigned to = handler(vector);
  return to != shared_ && file_.words.count(to) != 0;
}

int ProgramPlaces::open_vector() const {
  if (chip_.device().interrupts().nesting() == 0) return dspic::kNoVector;
  return chip_.device().peek(kInttregAddress, chip_.latest()) & kVectorMask;
}

/// Of a handler that is about to begin, or has just begun, while `here` is what it cuts off: its vector.
int ProgramPlaces::beginning_vector(unsigned here) const {
  constexpr dspic::Cycle kEntry = 8;  // the end of a handler and the instruction behind it are over by then
  const auto& interrupts = chip_.device().interrupts();
  const int open = open_vector();
  if (open == dspic::kNoVector) return interrupts.next(std::max(chip_.latest(), processor_.now()) + kEntry);
  // its frame is the stack's last, and leads back to what stood behind the instruction
  constexpr unsigned kLongestInsn = 4;
  const unsigned stack = processor_.w(15),
                 back = (stack_word(stack - 2) & 0x7F) << 16 | (stack_word(stack - 4) & 0xFFFE);
  return back >= here && back - here <= kLongestInsn && !call_before(back) ? open : dspic::kNoVector;
}

std::string ProgramPlaces::who_runs() const {
  const unsigned here = processor_.pc_of_access(), own_code = own(here);
  const int vector = open_vector();
  if (dspic::is_host_place(own_code)) return "; meanwhile handlers of the library ran";
  if (const int next = beginning_vector(here); next != dspic::kNoVector)
    return has_handler(next) && is_own(handler(next))
               ? "; meanwhile " + text_of(handler(next)) + " ran"
               : "; meanwhile the handler of " + std::string(dspic::vector_name(next)) + " ran";
  const int of_handler = vector_of(own_code);
  if (of_handler != dspic::kNoVector && !is_own(own_code))
    return "; meanwhile the library's handler of " + std::string(dspic::vector_name(of_handler)) + " ran";
  std::string text = "; meanwhile " + text_of(own_code) + " ran";
  if (of_handler != dspic::kNoVector) return text;
  return text + (vector == dspic::kNoVector
                     ? " with the interrupt masked"
                     : ", called by the handler of " + std::string(dspic::vector_name(vector)));
}

}  // namespace chip
