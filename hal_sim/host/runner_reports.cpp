// SPDX-License-Identifier: MIT
// The end of a robot's program, and what is told of it: traps and resets with the place in the firmware, what
// board and chip noticed, values of variables. See robot.h.
#include <algorithm>
#include <cstring>
#include <utility>

#include "dspic30/memory/irqs.h"
#include "dspic30/memory/sfr_table.h"
#include "hal_sim/board/board.h"
#include "hal_sim/host/compiled_runner.h"
#include "hal_sim/host/endless_wait.h"
#include "hal_sim/host/host_params.h"
#include "hal_sim/host/native_processor.h"
#include "sim_core/base/check.h"

namespace host {

namespace {
bool is_library(const std::string& file) {
  for (const char* room : {"hal_sim/", "firmware/library/", "hal_dspic/"})
    if (file.find(room) != std::string::npos) return true;
  return false;
}

// the innermost frame of the program itself: what our API and libc do inside is the caller's doing
std::vector<Place>::const_iterator own_frame(const std::vector<Place>& backtrace) {
  const auto own = std::find_if(backtrace.begin(), backtrace.end(),
                                [](const Place& place) { return place.line > 0 && !is_library(place.file); });
  return own == backtrace.end() ? backtrace.begin() : own;
}

Place culprit(const std::vector<Place>& backtrace) {
  return backtrace.empty() ? Place{} : *own_frame(backtrace);
}

// the report's place, and the way to it from there on
void set_place(TrapReport& report, std::vector<Place> backtrace) {
  backtrace.erase(backtrace.begin(), own_frame(backtrace));
  report.place = culprit(backtrace);
  report.backtrace = std::move(backtrace);
}
}  // namespace

const char* trap_name(int kind) {
  switch (kind) {
    case 0:
      return "unexpected reset";
    case TP_TRAP_MATH:
      return "math error";
    case TP_TRAP_ADDRESS:
      return "address error";
    case TP_TRAP_STACK:
      return "stack error";
    case TP_TRAP_ABORT:
      return "abort";
    case TP_TRAP_INTERRUPT:
      return "interrupt trouble";
    case TP_TRAP_ILLEGAL:
      return "illegal instruction";
    case TP_TRAP_SANITIZER:
      return "sanitizer";
    case TP_TRAP_UNSIMULATED:
      return "not simulated";
    case kProgramEnded:
      return "its program";
    default:
      return "trap";
  }
}

void CompiledRunner::on_reset(const char* unexpected_reason) {
  fold();
  processor_->note_reset(ResetCause::Instruction);
  if (unexpected_reason) {
    if (!traps_.empty() && traps_.back().kind == 0 && traps_.back().message == unexpected_reason)
      ++traps_.back().count;
    else
      traps_.push_back(report_here(0, unexpected_reason));
  }
  reset_asked_ = true;
  fiber_.yield();
  CHECK(false, "a reset robot went on");
  std::abort();
}

TrapReport CompiledRunner::report_here(int kind, std::string_view message) {
  return report_at(kind, std::string(message), 0,
                   reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0)));
}

TrapReport CompiledRunner::report_at(int kind, std::string message, std::uintptr_t pc,
                                     std::uintptr_t frame) const {
  TrapReport report;
  report.robot = name();
  report.kind = kind;
  report.message = std::move(message);
  report.cycle = now_;
  report.time_s =
      to_world_s ? to_world_s(now_) : static_cast<double>(now_) / static_cast<double>(board::kFcyHz);
  set_place(report, walk(pc, frame));
  return report;
}

void CompiledRunner::trap(int kind, std::string_view message) {
  fold();
  const tp_image& image = copy_.description();
  if (kind == TP_TRAP_MATH && image.trap_vectors[3] && processor_->cpu_level() < kMathErrorPriority) {
    // the program has its own _MathError: it may reset or report; the division itself cannot be resumed
    processor_->set_cpu_level(kMathErrorPriority, now_);
    interrupt_horizon_ = 0;
    give_budget();
    image.trap_vectors[3]();
    fold();
  }
  stop_with(report_here(kind, message));
}

void CompiledRunner::fault(int kind, std::string message, std::uintptr_t pc, std::uintptr_t frame,
                           std::uintptr_t stack) {
  fiber_.drop_frames();
  fold();
  // moved, not copied: this stack is abandoned, nothing on it is freed
  TrapReport report = report_at(kind, std::move(message), pc, frame);
  if (report.place.line == 0) {
    set_place(report, walk(find_return_address(stack), 0));
  }
  // nothing is left of the stack: the program's beginning at least
  const tp_image& image = copy_.description();
  for (const tp_function* f = image.functions; report.place.line == 0 && f && f != image.functions_end; ++f)
    if (std::strcmp(f->name, "main") == 0)
      report.place = image_->symbols().find(reinterpret_cast<std::uintptr_t>(f->address) - copy_.base());
  stop_with(std::move(report));
}

/// An address of the program's code on the stack: above `stack`, where those that called lie, or else right
/// below, where the last that was called from here left one. 0: none.
std::uintptr_t CompiledRunner::find_return_address(std::uintptr_t stack) const {
  constexpr std::uintptr_t kWord = sizeof(std::uintptr_t), kBelow = 512;
  stack = (stack + kWord - 1) / kWord * kWord;
  const auto at = [this](std::uintptr_t where) {
    std::uintptr_t word = 0;
    if (fiber_.is_on_stack(where) && fiber_.is_on_stack(where + kWord - 1))
      std::memcpy(&word, reinterpret_cast<const void*>(where), kWord);
    return word;
  };
  for (std::uintptr_t where = stack; fiber_.is_on_stack(where); where += kWord)
    if (copy_.is_code(at(where)) && !walk(at(where) - 1, 0).empty()) return at(where) - 1;
  for (std::uintptr_t where = stack; where > stack - kBelow; where -= kWord)
    if (copy_.is_code(at(where - kWord)) && !walk(at(where - kWord) - 1, 0).empty())
      return at(where - kWord) - 1;
  return 0;
}

void CompiledRunner::stop_with(TrapReport report) {
  if (observer_) observer_->ended(now_);
  traps_.push_back(std::move(report));
  stopped_ = true;
  processor_->stop(now_);
  fiber_.yield();
  CHECK(false, "a stopped robot went on");
  std::abort();
}

// frames are linked through the frame pointer, which twinpuck-cc keeps
std::vector<Place> CompiledRunner::walk(std::uintptr_t pc, std::uintptr_t frame) const {
  constexpr std::size_t kMostFrames = 16;
  std::vector<Place> places;
  const auto add = [&](std::uintptr_t address) {
    if (!copy_.is_code(address)) return;
    Place place = image_->symbols().find(address - copy_.base());
    // the runtime's own frames say nothing
    if (place.function.rfind("tp_image_", 0) != 0 &&
        place.file.find("hal_sim/cc/runtime/") == std::string::npos)
      places.push_back(std::move(place));
  };
  if (pc) add(pc);
  while (places.size() < kMostFrames && fiber_.is_on_stack(frame) && frame % sizeof(void*) == 0 &&
         fiber_.is_on_stack(frame + 2 * sizeof(void*) - 1)) {
    std::uintptr_t link[2];
    std::memcpy(link, reinterpret_cast<const void*>(frame), sizeof link);
    if (link[1]) add(link[1] - 1);
    if (link[0] <= frame) break;
    frame = link[0];
  }
  return places;
}

Place CompiledRunner::place_of_code(std::uintptr_t pc, std::uintptr_t frame) const {
  Place place = culprit(walk(pc, frame));
  if (place.function.empty()) place.function = "code that is not the program's";
  return place;
}

Place CompiledRunner::place_now() const {
  return stopped_ ? traps_.back().place : culprit(walk(0, fiber_.frame()));
}

bool CompiledRunner::is_enabled(int vector) {
  if (native_) return std::as_const(native_->interrupts()).source(vector).enabled;
  constexpr unsigned kIec0 = dspic::sfr("IEC0");
  return peek(kIec0 + 2 * static_cast<unsigned>(vector / 16), now_in_code()) >> vector % 16 & 1;
}

int CompiledRunner::priority(int vector) {
  if (native_) return std::as_const(native_->interrupts()).source(vector).priority;
  constexpr unsigned kIpc0 = dspic::sfr("IPC0");
  return peek(kIpc0 + 2 * static_cast<unsigned>(vector / 4), now_in_code()) >> vector % 4 * 4 & 7;
}

bool CompiledRunner::is_held_by_disi() {
  constexpr unsigned kDisicnt = dspic::sfr("DISICNT");
  return native_ ? native_->disi_active(now_in_code()) : peek(kDisicnt, now_in_code()) != 0;
}

/// The program sleeps in the loop `loop_`, which looks at nothing outside: told, when no handler can end it.
void CompiledRunner::look_for_endless_wait() {
  if (asked_wait_ == poll_loop_) return;
  asked_wait_ = poll_loop_;
  bool any = false;
  for (int vector = 0; vector < dspic::kIrqs; ++vector) any = any || is_enabled(vector);
  const auto by_name = [this](const std::string& name) {
    for (int vector = 0; vector < dspic::kIrqs; ++vector)
      if (dspic::irq_name(vector) == name) return is_enabled(vector);
    return false;
  };
  if (!any || is_written_by_none(*this, report_here(0, "").place, by_name)) note_endless_wait();
}

void CompiledRunner::note_endless_wait() {
  if (!endless_wait_.cause.empty()) return;
  endless_wait_ = endless_wait(*this, report_here(0, "").place, now_);
}

std::vector<board::Diagnosis> CompiledRunner::diagnoses() const {
  std::vector<board::Diagnosis> all = processor_->diagnoses();
  if (!endless_wait_.cause.empty()) all.push_back(endless_wait_);
  return dated(std::move(all), board_.diagnoses(lived_cycles()));
}

std::vector<board::Diagnosis> Runner::dated(std::vector<board::Diagnosis> all,
                                            std::vector<board::Diagnosis> of_board) const {
  std::move(of_board.begin(), of_board.end(), std::back_inserter(all));
  for (board::Diagnosis& d : all) d.first_s = to_world_s ? to_world_s(d.first) : 0;
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return all;
}

std::uint64_t CompiledRunner::hash() const {
  std::uint64_t h = static_cast<std::uint64_t>(now_) * 0x9E3779B97F4A7C15u;
  h ^= static_cast<std::uint64_t>(served_) + (h << 6) + (h >> 2);
  h ^= static_cast<std::uint64_t>(traps_.size()) + (h << 6) + (h >> 2);
  return h;
}

std::vector<char> CompiledRunner::read_variable(const std::string& symbol, std::size_t bytes) const {
  std::uintptr_t address = 0;
  std::size_t size = 0;
  if (!image_->symbols().find_object(symbol, address, size)) return {};
  bytes = bytes == 0 ? size : std::min(bytes, size);
  std::vector<char> value(bytes);
  read_memory(address, value.data(), bytes);
  return value;
}

char* CompiledRunner::data_at(std::uintptr_t address) const {
  char* live = reinterpret_cast<char*>(copy_.base() + address);
  const tp_image& image = copy_.description();
  if (copy_.owner == this || live < image.data_begin || live >= image.data_end) return live;
  const std::size_t hole = static_cast<std::size_t>(image.hole_end - image.hole_begin);
  const std::size_t offset =
      static_cast<std::size_t>(live - image.data_begin) - (live >= image.hole_end ? hole : 0);
  return const_cast<char*>(data_.data()) + offset;
}

void CompiledRunner::read_memory(std::uintptr_t address, void* to, std::size_t bytes) const {
  std::memcpy(to, data_at(address), bytes);
}

void CompiledRunner::write_memory(std::uintptr_t address, const void* from, std::size_t bytes) {
  std::memcpy(data_at(address), from, bytes);
  ++writes_;
  wake();
}

bool CompiledRunner::owns_data(std::uintptr_t address, std::size_t bytes) const {
  const tp_image& image = copy_.description();
  const auto begin = reinterpret_cast<std::uintptr_t>(image.data_begin),
             end = reinterpret_cast<std::uintptr_t>(image.data_end),
             hole = reinterpret_cast<std::uintptr_t>(image.hole_begin),
             hole_end = reinterpret_cast<std::uintptr_t>(image.hole_end);
  const auto is_within = [&](std::uintptr_t low, std::uintptr_t high) {
    return address >= low && address < high && high - address >= bytes;
  };
  return is_within(begin, hole) || is_within(hole_end, end) ||
         (fiber_.is_on_stack(address) && fiber_.is_on_stack(address + bytes - 1));
}

void CompiledRunner::write_value(std::uintptr_t address, const void* from, std::size_t bytes) {
  write_memory(address - copy_.base(), from, bytes);
  note_write();
}

void CompiledRunner::poke_register(unsigned address, std::uint16_t value, bool is_in_code) {
  processor_->write(address, value, 16, is_in_code ? now_in_code() : std::max(now_, end_));
  wake();
  if (is_in_code) return;
  // the host, which is called, gives the budget
  issued_ = control_.budget = 0;
  interrupt_horizon_ = 0;
  ++writes_;
}

void CompiledRunner::restart() {
  processor_->note_reset(ResetCause::Button);
  stopped_ = false;
  now_ = std::max(now_, end_);
  reset_asked_ = true;
  wake();
}

}  // namespace host
