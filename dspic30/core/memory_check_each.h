// SPDX-License-Identifier: MIT
// What MemoryCheck does at each instruction, for cpu.cpp alone: most have nothing to do
// with what nobody wrote.
#pragma once
#include <algorithm>
#include <cstring>

#include "dspic30/core/cpu.h"
#include "dspic30/core/memory_check.h"

namespace dspic {

inline void MemoryCheck::begins(const Cpu& cpu, const Decoded* d) {
  if (unwritten_ | static_cast<unsigned>(flags_unwritten_) | static_cast<unsigned>(read_unwritten_))
    finish(cpu);
  if (base_ == 0 && cpu.splim_on) base_ = cpu.w[kStackPointer];
  if (cpu.w[kStackPointer] != top_) move_top(cpu.w[kStackPointer]);
  if (is_away_) come_back(cpu, d);
  if (unwritten_ | static_cast<unsigned>(flags_unwritten_)) before(cpu, d);
  at_ = d;
  w_ = cpu.w;
  reads_ = writes_ = 0;
  read_unwritten_ = false;
}

/// Is there nothing to look at? Nearly always.
inline bool MemoryCheck::is_plain(unsigned i, unsigned bits) const {
  static_assert(static_cast<int>(State::Plain) == 0);
  std::uint16_t states = 0;
  bits == 16 ? std::memcpy(&states, &states_[i], 2) : std::memcpy(&states, &states_[i], 1);
  return states == 0 && i + kStart < top_;
}

inline void MemoryCheck::reads(const Cpu& cpu, unsigned ea, unsigned bits) {
  const unsigned i = ea - kStart, bytes = bits / 8;
  std::uint16_t unwritten = 0, value = 0;
  if (bits == 16) {
    std::memcpy(&unwritten, &bits_[i], 2);
    std::memcpy(&value, &cpu.ram[i], 2);
  } else {
    unwritten = bits_[i], value = cpu.ram[i];
  }
  // what it is worth has been said, or is not looked at
  if ((!is_plain(i, bits) && look_at(cpu, ea, bytes, false)) || is_away_) unwritten = 0;
  read_unwritten_ |= unwritten != 0;
  if (reads_ < read_.size()) read_[reads_++] = {ea, bytes, value, unwritten};
}

inline void MemoryCheck::writes(const Cpu& cpu, unsigned ea, unsigned bits) {
  const unsigned i = ea - kStart, bytes = bits / 8;
  if (i < kBytes) {
    // an interrupt's entry pushes between two instructions
    top_ = std::max<unsigned>(top_, cpu.w[kStackPointer]);
    if (!is_plain(i, bits)) look_at(cpu, ea, bytes, true);
    bits == 16 ? std::memset(&bits_[i], 0, 2) : std::memset(&bits_[i], 0, 1);
  } else if (ea < kRegisterBytes) {
    meets_null(cpu, ea, bits, true);
  }
  if (writes_ < written_.size()) written_[writes_++] = {ea, bytes, 0, 0};
}

}  // namespace dspic
