// SPDX-License-Identifier: MIT
#include "dspic30/core/wait_samples.h"

#include <cstring>

namespace dspic {

bool WaitSamples::look(Cpu& cpu) {
  const bool is_main = cpu.parts.interrupts.nesting() == 0;
  if (!is_looking_) {
    next_ = later_ = (cpu.now / kEvery + 1) * kEvery;
    rounds_ = 0;
    if (!is_main) return false;
    if (cpu.repeating && cpu.plain(cpu.next) == &no_operation) return end(cpu, true);
    return begin_round(cpu);
  }
  if (!is_main) {
    was_cut_ = true;
    cpu.watching = false;
    return false;
  }
  if (was_cut_) return rounds_ < kMostRounds ? begin_round(cpu) : end(cpu, false);
  if (cpu.watched_until == 0) return end(cpu, false);  // it has done something
  if (cpu.next == first_) return end(cpu, is_as_before(cpu));
  if (++steps_ > kLongestRound) return end(cpu, false);
  pointers_ |= cpu.next->pointers;
  return true;
}

bool WaitSamples::begin_round(Cpu& cpu) {
  is_looking_ = cpu.watching = true;
  next_ = 0;
  was_cut_ = false;
  cpu.watched_until = kNever;
  ++rounds_;
  steps_ = 0;
  first_ = cpu.next;
  pointers_ = first_->pointers;
  w_ = cpu.w;
  ram_ = cpu.ram;
  return true;
}

bool WaitSamples::end(Cpu& cpu, bool is_wait) {
  is_looking_ = cpu.watching = false;
  next_ = later_;
  if (is_wait) waited_ += kEvery;
  return false;
}

// a counter in RAM passes through one register
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
  for (std::size_t i = 0; i < ram_.size(); i += 2) {
    if (std::memcmp(&ram_[i], &cpu.ram[i], 2) == 0) continue;
    const auto old = static_cast<unsigned>(ram_[i] | ram_[i + 1] << 8),
               now = static_cast<unsigned>(cpu.ram[i] | cpu.ram[i + 1] << 8);
    if (++words > 1 || (registers > 0 && value != now && value != old)) return false;
  }
  return true;
}

}  // namespace dspic
