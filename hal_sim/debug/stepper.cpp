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
constexpr unsigned char kInt3 = 0xCC, kRet = 0xC3;
constexpr unsigned char kMakeFrame[] = {0x55, 0x48, 0x89, 0xE5};  // push %rbp; mov %rsp,%rbp
constexpr std::uintptr_t kWord = sizeof(std::uintptr_t);
constexpr std::size_t kDeepest = 256;  // frames

greg_t* registers_of(void* context) { return static_cast<ucontext_t*>(context)->uc_mcontext.gregs; }

Stepper::Place place_of(const greg_t* r) {
  return {static_cast<std::uintptr_t>(r[REG_RIP]), static_cast<std::uintptr_t>(r[REG_RSP]),
          static_cast<std::uintptr_t>(r[REG_RBP])};
}

}  // namespace

/// The code, as long as this lives.
class Stepper::Writable {
 public:
  explicit Writable(const Stepper& stepper) : stepper_(stepper) { allow(PROT_WRITE); }
  ~Writable() { allow(0); }

 private:
  void allow(int write) const {
    CHECK(mprotect(reinterpret_cast<void*>(stepper_.code_begin_), stepper_.code_bytes_,
                   PROT_READ | PROT_EXEC | write) == 0,
          "cannot put breakpoints into a program's code");
  }
  const Stepper& stepper_;
};

Stepper::Stepper(host::CompiledRunner& runner, const dspic::CodeMap& map, Reached reached)
    : runner_(runner), map_(map), reached_(std::move(reached)), base_(runner.copy().base()) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  code_begin_ = runner.copy().code_begin() & ~(page - 1);
  code_bytes_ = (runner.copy().code_end() - code_begin_ + page - 1) & ~(page - 1);
  for (const auto& function : map.functions) {
    if (is_told(base_ + function.begin)) beginnings_.push_back(base_ + function.begin);
    const auto* const end = reinterpret_cast<const unsigned char*>(base_ + function.end);
    const auto* const make = std::search(reinterpret_cast<const unsigned char*>(base_ + function.begin), end,
                                         std::begin(kMakeFrame), std::end(kMakeFrame));
    frames_made_.push_back(reinterpret_cast<std::uintptr_t>(make));
  }
  std::sort(beginnings_.begin(), beginnings_.end());
}

Stepper::~Stepper() { insert({}); }

void Stepper::mark(std::vector<std::uintptr_t> addresses) {
  marks_ = std::move(addresses);
  std::sort(marks_.begin(), marks_.end());
  begun_turn_ = kNoTurn;
}

// --- the code's bytes

unsigned char Stepper::byte(std::uintptr_t address) const {
  const auto saved = inserted_.find(address);
  return saved != inserted_.end() ? saved->second : *reinterpret_cast<const unsigned char*>(address);
}

void Stepper::put(std::uintptr_t address, unsigned char byte) {
  *reinterpret_cast<volatile unsigned char*>(address) = byte;
}

void Stepper::insert(std::vector<std::uintptr_t> wanted) {
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  wanted.erase(std::remove_if(wanted.begin(), wanted.end(), [this](std::uintptr_t a) { return !owns(a); }),
               wanted.end());
  const auto is_there = [](const auto& saved, std::uintptr_t address) { return saved.first == address; };
  if (wanted.size() == inserted_.size() &&
      std::equal(inserted_.begin(), inserted_.end(), wanted.begin(), is_there))
    return;
  const Writable code(*this);
  for (auto it = inserted_.begin(); it != inserted_.end();) {
    const bool stays = std::binary_search(wanted.begin(), wanted.end(), it->first);
    if (!stays) put(it->first, it->second);
    it = stays ? std::next(it) : inserted_.erase(it);
  }
  for (const std::uintptr_t address : wanted)
    if (inserted_.emplace(address, *reinterpret_cast<const unsigned char*>(address)).second)
      put(address, kInt3);
}

void Stepper::lift(std::uintptr_t address, void* context) {
  const Writable code(*this);
  lifted_ = address;
  put(address, inserted_.at(address));
  registers_of(context)[REG_EFL] |= kTrapFlag;
}

void Stepper::put_back() {
  if (!lifted_) return;
  const Writable code(*this);
  put(lifted_, kInt3);
  lifted_ = 0;
}

bool Stepper::is_told(std::uintptr_t pc) const {
  const auto* function = map_.function_at(static_cast<std::uint32_t>(pc - base_));
  return function && function->name.compare(0, 9, "tp_image_") != 0;
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
  // the optimiser may put a way out before the frame is made
  const std::uintptr_t made = frames_made_[static_cast<std::size_t>(function - map_.functions.data())];
  if (place.pc <= made) return At::Beginning;
  if (place.pc == made + 1) return At::Pushed;
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
  for (std::size_t depth = 0; depth < kDeepest && all.size() < most && back; ++depth) {
    if (owns(back) && is_told(back - 1)) all.push_back({{back, end, frame}, std::exchange(by_host, false)});
    by_host = by_host || !owns(back);
    if (frame < end) break;  // no frame of the stack
    back = word(frame + kWord);
    end = frame + 2 * kWord;
    frame = word(frame);
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

void Stepper::begin(Look look) {
  const bool is_as_before = look == look_ && runner_.turns() == begun_turn_;
  begun_turn_ = runner_.turns();
  if (is_as_before) return;  // it sleeps, and is not given the processor
  put_back();
  is_passing_ = false;
  last_ = 0;
  const auto place = place_between();
  look_for(look, place);
  if (look == Look::Everything && place) wait_for_host(place->pc + 1);
}

// the breakpoints that a look needs
void Stepper::look_for(Look look, const std::optional<Place>& place) {
  forget_host();
  look_ = look;
  exit_.reset();
  std::vector<std::uintptr_t> wanted;
  if (look == Look::Everything) wanted = beginnings_;
  if (look == Look::Breakpoints || look == Look::Leaving) wanted = marks_;
  if (look == Look::Leaving && place)
    if (const auto all = callers(*place, 1); !all.empty()) exit_ = all[0].place;
  if (exit_) wanted.push_back(exit_->pc);
  insert(std::move(wanted));
}

// it has gone there by a call, or because a handler has returned
void Stepper::follow_host(const Place& place) {
  const bool is_call = last_ && byte(last_) != kRet;
  const auto outer = is_call ? std::nullopt : innermost(place.frame);
  wait_for_host(is_call ? word(place.sp) : outer ? outer->pc + 1 : 0);
}

void Stepper::wait_for_host(std::uintptr_t back) {
  if (!owns(back) || inserted_.count(back)) return;
  const Writable code(*this);
  inserted_.emplace(back, byte(back));
  put(back, kInt3);
  host_return_ = back;
}

void Stepper::forget_host() {
  if (!host_return_) return;
  const Writable code(*this);
  put(host_return_, inserted_.at(host_return_));
  inserted_.erase(host_return_);
  host_return_ = 0;
}

bool Stepper::take(int code, void* context) {
  greg_t* const r = registers_of(context);
  Place place = place_of(r);
  const bool is_breakpoint = code == SI_KERNEL && inserted_.count(place.pc - 1);
  if (!is_breakpoint && code != TRAP_TRACE) return false;
  put_back();
  r[REG_EFL] &= ~kTrapFlag;
  if (is_breakpoint) r[REG_RIP] = static_cast<greg_t>(--place.pc);
  if (host::CompiledRunner::running() != &runner_) {  // another robot with the same code
    if (is_breakpoint) lift(place.pc, context);
    return true;
  }
  if (std::exchange(is_passing_, false) && !is_breakpoint) return true;
  if (!owns(place.pc)) {
    follow_host(place);
    return true;
  }
  forget_host();
  if (is_told(place.pc) && !is_for_another(place)) look_for(reached_(place, context), place);
  step_off(place, context);
  return true;
}

// where a function returns to that is left: another call of it, deeper
bool Stepper::is_for_another(const Place& place) const {
  return look_ == Look::Leaving && exit_ && place.pc == exit_->pc && place.sp < exit_->sp &&
         !std::binary_search(marks_.begin(), marks_.end(), place.pc);
}

void Stepper::step_off(const Place& place, void* context) {
  last_ = place.pc;
  if (inserted_.count(place.pc))
    lift(place.pc, context);
  else if (look_ == Look::Everything)
    registers_of(context)[REG_EFL] |= kTrapFlag;
  is_passing_ = lifted_ && look_ != Look::Everything;
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
