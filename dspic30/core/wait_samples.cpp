// SPDX-License-Identifier: MIT
#include "dspic30/core/wait_samples.h"

#include <algorithm>
#include <cstring>

namespace dspic {

bool WaitSamples::look(Cpu& cpu) {
  const bool is_main = cpu.parts.interrupts.nesting() == 0;
  if (!is_looking_) {
    next_ = later_ = (cpu.now / kEvery + 1) * kEvery;
    ++looks_;
    steps_ = begun_ = 0;
    if (!is_main) return false;
    if (cpu.repeating && cpu.plain(cpu.next) == &no_operation) return end(cpu, true);
    begin_look(cpu);
    return true;
  }
  if (is_main == in_handler_) is_main ? leave_handler(cpu) : enter_handler(cpu);
  if (!is_main) return false;
  if (cpu.watched_until == 0) return end(cpu, false);  // it has done something
  const bool is_patient = looks_ % kLongEach == 0;
  const unsigned sp = cpu.w[15];
  if (cpu.next == first_ && sp == w_[15])
    return end(cpu, (is_patient || steps_ - begun_ <= kShortRound) && is_as_before(cpu));
  // a round begins with a jump back, not in a function that it may call more than once
  if (sp < lowest_sp_) first_ = nullptr;
  lowest_sp_ = std::min(lowest_sp_, sp);
  if (!first_ && sp == lowest_sp_ && cpu.next <= last_) begin_round(cpu);
  last_ = cpu.next;
  pointers_ |= cpu.next->pointers;
  if (++steps_ > 2 * (is_patient ? kLongestRound : kShortRound)) return end(cpu, false);
  return true;
}

void WaitSamples::begin_look(Cpu& cpu) {
  is_looking_ = cpu.watching = true;
  next_ = 0;
  cpu.watched_until = kNever;
  first_ = nullptr;
  last_ = cpu.next;
  lowest_sp_ = cpu.w[15];
}

void WaitSamples::begin_round(const Cpu& cpu) {
  first_ = cpu.next;
  begun_ = steps_;
  pointers_ = 0;
  w_ = cpu.w;
  ram_ = cpu.ram;
}

void WaitSamples::enter_handler(Cpu& cpu) {
  in_handler_ = true;
  cpu.watching = false;
  watched_until_ = cpu.watched_until;
  ram_at_entry_ = cpu.ram;
}

void WaitSamples::leave_handler(Cpu& cpu) {
  in_handler_ = false;
  cpu.watching = true;
  cpu.watched_until = watched_until_;
  for (std::size_t i = 0; i < ram_.size(); ++i)
    if (ram_at_entry_[i] != cpu.ram[i]) ram_[i] = cpu.ram[i];
}

bool WaitSamples::end(Cpu& cpu, bool is_wait) {
  is_looking_ = cpu.watching = false;
  next_ = later_;
  if (is_wait) waited_ += steps_ - begun_ > kShortRound ? kEvery * kLongEach : kEvery;
  return false;
}

// a counter in RAM passes through one register; what lies beyond the stack's end is nobody's
bool WaitSamples::is_as_before(const Cpu& cpu) const {
  int registers = 0;
  unsigned value = 0;
  for (std::size_t n = 0; n < w_.size(); ++n) {
    if (w_[n] == cpu.w[n]) continue;
    if (++registers > 1 || (pointers_ >> n & 1)) return false;
    value = cpu.w[n];
  }
  if (ram_ == cpu.ram) return true;
  int words = 0;
  const unsigned sp = cpu.w[15], limit = cpu.splim_on ? cpu.splim + 2u : sp;
  for (std::size_t i = 0; i < ram_.size(); i += 2) {
    const auto address = static_cast<unsigned>(i) + Cpu::kRamStart;
    if (address >= sp && address < limit) continue;
    if (std::memcmp(&ram_[i], &cpu.ram[i], 2) == 0) continue;
    const auto old = static_cast<unsigned>(ram_[i] | ram_[i + 1] << 8),
               now = static_cast<unsigned>(cpu.ram[i] | cpu.ram[i + 1] << 8);
    if (++words > 1 || (registers > 0 && value != now && value != old)) return false;
  }
  return true;
}

}  // namespace dspic
