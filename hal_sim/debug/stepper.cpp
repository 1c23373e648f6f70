// SPDX-License-Identifier: MIT
#include "hal_sim/debug/stepper.h"

#include <signal.h>
#include <sys/mman.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "sim_core/base/check.h"

namespace debug {

namespace {

constexpr greg_t kTrapFlag = 0x100;
constexpr unsigned char kInt3 = 0xCC, kPushRbp = 0x55, kRet = 0xC3;
constexpr std::uintptr_t kWord = sizeof(std::uintptr_t);
constexpr std::size_t kDeepest = 256;  // frames

greg_t* registers_of(void* context) { return static_cast<ucontext_t*>(context)->uc_mcontext.gregs; }

Stepper::Place place_of(const greg_t* r) {
  return {static_cast<std::uintptr_t>(r[REG_RIP]), static_cast<std::uintptr_t>(r[REG_RSP]),
          static_cast<std::uintptr_t>(r[REG_RBP])};
}

}  // namespace

Stepper::Stepper(host::CompiledRunner& runner, const dspic::CodeMap& map, Reached reached)
    : runner_(runner), map_(map), reached_(std::move(reached)), base_(runner.copy().base()) {
  for (const auto& function : map.functions) beginnings_.push_back(base_ + function.begin);
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const std::uintptr_t begin = runner.copy().code_begin() & ~(page - 1);
  const std::size_t bytes = (runner.copy().code_end() - begin + page - 1) & ~(page - 1);
  CHECK(mprotect(reinterpret_cast<void*>(begin), bytes, PROT_READ | PROT_WRITE | PROT_EXEC) == 0,
        "cannot put breakpoints into a program's code");
}

Stepper::~Stepper() { insert({}); }

// --- the code's bytes

unsigned char Stepper::byte(std::uintptr_t address) const {
  const auto saved = inserted_.find(address);
  return saved != inserted_.end() ? saved->second : *reinterpret_cast<const unsigned char*>(address);
}

void Stepper::insert(std::vector<std::uintptr_t> addresses) {
  std::sort(addresses.begin(), addresses.end());
  for (auto it = inserted_.begin(); it != inserted_.end();) {
    const bool stays = std::binary_search(addresses.begin(), addresses.end(), it->first);
    if (!stays) *reinterpret_cast<unsigned char*>(it->first) = it->second;
    it = stays ? std::next(it) : inserted_.erase(it);
  }
  for (const std::uintptr_t address : addresses) {
    if (!owns(address)) continue;
    auto* const at = reinterpret_cast<unsigned char*>(address);
    if (inserted_.emplace(address, *at).second) *at = kInt3;
  }
}

void Stepper::lift(std::uintptr_t address, void* context) {
  lifted_ = address;
  *reinterpret_cast<unsigned char*>(address) = inserted_.at(address);
  registers_of(context)[REG_EFL] |= kTrapFlag;
}

void Stepper::put_back() {
  if (lifted_) *reinterpret_cast<unsigned char*>(lifted_) = kInt3;
  lifted_ = 0;
}

// --- frames

std::uintptr_t Stepper::word(std::uintptr_t address) const {
  std::uintptr_t value = 0;
  if (address % kWord == 0 && runner_.fiber().is_on_stack(address))
    std::memcpy(&value, reinterpret_cast<const void*>(address), kWord);
  return value;
}

// how far the function has got with its frame
Stepper::At Stepper::at(const Place& place) const {
  if (place.is_call) return At::Body;
  const auto* function = map_.function_at(static_cast<std::uint32_t>(place.pc - base_));
  if (!function) return At::Beginning;  // a jump into the host
  const std::uintptr_t begin = base_ + function->begin;
  if (place.pc == begin) return At::Beginning;
  if (place.pc == begin + 1 && byte(begin) == kPushRbp) return At::Pushed;
  return byte(place.pc) == kRet ? At::Return : At::Body;
}

std::uintptr_t Stepper::frame_end(const Place& place) const {
  switch (at(place)) {
    case At::Beginning:
    case At::Return:
      return place.sp + kWord;
    case At::Pushed:
      return place.sp + 2 * kWord;
    default:
      return place.frame + 2 * kWord;
  }
}

std::vector<Stepper::Caller> Stepper::callers(const Place& place, std::size_t most) const {
  std::vector<Caller> all;
  std::uintptr_t end = frame_end(place), back = word(end - kWord);
  std::uintptr_t frame = at(place) == At::Body ? word(place.frame) : place.frame;
  bool by_host = false;
  for (std::size_t depth = 0; depth < kDeepest && all.size() < most; ++depth) {
    if (owns(back)) all.push_back({{back, end, frame}, by_host});
    by_host = !owns(back);
    if (!runner_.fiber().is_on_stack(frame) || frame < end - 2 * kWord) break;
    back = word(frame + kWord);
    end = frame + 2 * kWord;
    const std::uintptr_t next = word(frame);
    if (next <= frame) {
      if (owns(back)) all.push_back({{back, end, next}, by_host});
      break;
    }
    frame = next;
  }
  return all;
}

// from a frame of the host
std::optional<Stepper::Place> Stepper::innermost(std::uintptr_t frame) const {
  for (std::size_t depth = 0; depth < kDeepest && runner_.fiber().is_on_stack(frame); ++depth) {
    const std::uintptr_t back = word(frame + kWord), next = word(frame);
    if (owns(back)) return Place{back - 1, frame + 2 * kWord, next, true};
    if (next <= frame) break;
    frame = next;
  }
  return {};
}

std::optional<Stepper::Place> Stepper::place_between() const {
  if (fault_ && fault_turn_ == runner_.turns()) return fault_;
  return innermost(runner_.fiber().frame());
}

// --- running

void Stepper::note_exit(const Place& place) {
  const auto all = callers(place, 1);
  exit_ = all.empty() ? std::nullopt : std::optional(all[0].place);
}

void Stepper::begin(Look look) {
  look_ = look;
  is_passing_ = false;
  lifted_ = 0;
  const auto place = place_between();
  std::vector<std::uintptr_t> wanted;
  if (look == Look::Breakpoints || look == Look::Leaving) wanted = marks_;
  if (look == Look::Everything) {
    wanted = beginnings_;
    if (place) wanted.push_back(place->pc + 1);
  }
  if (look == Look::Leaving && place) {
    note_exit(*place);
    if (exit_) wanted.push_back(exit_->pc);
  }
  insert(std::move(wanted));
}

bool Stepper::take(int code, void* context) {
  greg_t* const r = registers_of(context);
  Place place = place_of(r);
  const bool is_breakpoint = code == SI_KERNEL && inserted_.count(place.pc - 1);
  if (!is_breakpoint && code != TRAP_TRACE) return false;
  put_back();
  const bool was_passing = std::exchange(is_passing_, false);
  if (is_breakpoint) r[REG_RIP] = static_cast<greg_t>(--place.pc);
  if (host::CompiledRunner::running() != &runner_) {  // another robot with the same code
    r[REG_EFL] &= ~kTrapFlag;
    if (is_breakpoint) lift(place.pc, context);
    return true;
  }
  if (owns(place.pc) && (is_breakpoint || !was_passing)) {
    const bool is_deeper = look_ == Look::Leaving && exit_ && place.pc == exit_->pc && place.sp < exit_->sp &&
                           std::find(marks_.begin(), marks_.end(), place.pc) == marks_.end();
    if (!is_deeper) {
      look_ = reached_(place, context);
      if (look_ == Look::Leaving) note_exit(place);
    }
  }
  go_on(place, context);
  return true;
}

void Stepper::go_on(const Place& place, void* context) {
  greg_t* const r = registers_of(context);
  r[REG_EFL] &= ~kTrapFlag;
  if (look_ == Look::Everything) {
    if (owns(place.pc)) {
      insert({});
      r[REG_EFL] |= kTrapFlag;
      return;
    }
    // in the host: back at a function's beginning, or where it returns to
    std::vector<std::uintptr_t> wanted = beginnings_;
    const std::uintptr_t back = word(place.sp);
    if (owns(back))
      wanted.push_back(back);
    else if (const auto outer = innermost(place.frame))
      wanted.push_back(outer->pc + 1);
    insert(std::move(wanted));
    return;
  }
  std::vector<std::uintptr_t> wanted;
  if (look_ != Look::Nothing) wanted = marks_;
  if (look_ == Look::Leaving && exit_) wanted.push_back(exit_->pc);
  insert(std::move(wanted));
  is_passing_ = inserted_.count(place.pc) > 0;
  if (is_passing_) lift(place.pc, context);
}

void Stepper::note_fault(void* context) {
  greg_t* const r = registers_of(context);
  r[REG_EFL] &= ~kTrapFlag;
  put_back();
  is_passing_ = false;
  if (host::CompiledRunner::running() != &runner_) return;
  fault_ = place_of(r);
  if (!owns(fault_->pc)) {  // a function of the host was at it
    const std::uintptr_t back = word(fault_->sp);
    const auto caller = owns(back) ? Place{back - 1, fault_->sp + kWord, fault_->frame, true}
                                   : innermost(fault_->frame).value_or(Place{});
    fault_ = caller.pc ? std::optional(caller) : std::nullopt;
  }
  fault_turn_ = runner_.turns();
}

}  // namespace debug
