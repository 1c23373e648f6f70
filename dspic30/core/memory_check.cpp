// SPDX-License-Identifier: MIT
// RAM and the stack's end; what each instruction costs: memory_check_each.h; what it does
// with values: value_check.cpp.
#include "dspic30/core/memory_check.h"

#include <algorithm>

#include "dspic30/core/memory_check_each.h"
#include "dspic30/core/value_shape.h"

namespace dspic {

void DataSpace::check_memory(MemoryCheck* check) {
  memory_check = check;
  watch_round(round_memory);
  code_is_stale = true;
}

// as run_straight(): whoever runs on all registers need not look at each for any other reason
void Cpu::run_checked() {
  const Decoded* d = next;
  while (now < deadline) {
    if (!is_decoded(d) && !address_of_host_place(d)) decode(d);  // its pointers are asked for
    memory_check->begins(*this, d);
    at = d;
    const Decoded* following = d->run.load(std::memory_order_acquire)(*this, d);
    now += d->cycles;
    if (d == loop_end) following = loop_back(d, following);
    d = following;
  }
  next = d;
}

MemoryCheck::MemoryCheck(MemoryFindings& findings) : findings_(findings) {
  bits_.fill(0xFF);
  states_.fill(State::Plain);
}

MemoryCheck::~MemoryCheck() = default;

void MemoryCheck::mark(unsigned begin, unsigned end, State state) {
  begin = std::max(begin, kStart), end = std::min(end, kStart + kBytes);
  if (begin < end) std::fill(states_.begin() + (begin - kStart), states_.begin() + (end - kStart), state);
}

void MemoryCheck::set_bits(unsigned begin, unsigned end, std::uint8_t bits) {
  begin = std::max(begin, kStart), end = std::min(end, kStart + kBytes);
  if (begin < end) std::fill(bits_.begin() + (begin - kStart), bits_.begin() + (end - kStart), bits);
}

void MemoryCheck::await_return(const Cpu& cpu) {
  if (is_away_) return;
  const unsigned top = cpu.w[kStackPointer];
  if (top < Cpu::kRamStart + 4 || top > Cpu::kRamEnd) return;
  const auto word = [&](unsigned at) {
    return cpu.ram[at - Cpu::kRamStart] | static_cast<unsigned>(cpu.ram[at + 1 - Cpu::kRamStart]) << 8;
  };
  return_pc_ = (word(top - 2) & 0x7F) << 16 | (word(top - 4) & 0xFFFE);
  return_top_ = top - 4;
  is_away_ = true;
}

void MemoryCheck::restart() {
  register_bits_.fill(0);
  unwritten_ = 0;
  flags_unwritten_ = read_unwritten_ = is_away_ = false;
  at_ = nullptr;
  reads_ = writes_ = 0;
  top_ = kStart;
  base_ = 0;
}

// what lies beyond the stack's end was somebody's, and is not any more
void MemoryCheck::move_top(unsigned top) {
  if (base_ != 0 && top < top_ && top >= base_) {
    forget(top, top_);
    mark(top, top_, State::Plain);
    findings_.stack_fell(top);
  }
  top_ = top;
}

// a function that is not looked at has returned, or was left
void MemoryCheck::come_back(const Cpu& cpu, const Decoded* d) {
  if (top_ > return_top_ || (top_ == return_top_ && cpu.address_of(d) != return_pc_)) return;
  is_away_ = false;
  findings_.returned(cpu.w[0]);
}

void MemoryCheck::cut(const Cpu& cpu) {
  if (unwritten_ | static_cast<unsigned>(flags_unwritten_ || read_unwritten_)) finish(cpu);
  if (cpu.w[kStackPointer] != top_) move_top(cpu.w[kStackPointer]);
  at_ = nullptr;
  read_unwritten_ = false;
}

bool MemoryCheck::look_at(const Cpu& cpu, unsigned ea, unsigned bytes, bool is_write) {
  if (is_away_) return false;
  const State state = std::max(states_[ea - kStart], states_[ea - kStart + bytes - 1]);
  MemoryFinding finding;
  finding.address = ea;
  finding.bytes = bytes;
  finding.pc = cpu.address_of(cpu.at);
  finding.writes = is_write;
  if (state != State::Plain) {
    finding.kind = state == State::Freed ? MemoryFinding::Kind::Freed : MemoryFinding::Kind::Outside;
  } else if (base_ != 0 && ea >= std::max<unsigned>(top_, cpu.w[kStackPointer]) &&
             ea <= cpu.stack_most + 1u) {
    finding.kind = MemoryFinding::Kind::AboveStack;
  } else {
    return false;
  }
  findings_.found(finding);
  return true;
}

void MemoryCheck::meets_null(const Cpu& cpu, unsigned ea, unsigned bits, bool is_write) {
  if (is_away_) return;
  MemoryFinding finding;
  finding.kind = MemoryFinding::Kind::Null;
  finding.address = ea;
  finding.bytes = bits / 8;
  finding.pc = cpu.address_of(cpu.at);
  finding.writes = is_write;
  findings_.found(finding);
}

}  // namespace dspic
