// SPDX-License-Identifier: MIT
#include "dspic30/core/known_waits.h"

#include <algorithm>
#include <cstring>

#include "dspic30/core/cpu.h"

namespace dspic {

namespace {

std::uint64_t four(const std::uint16_t* of) {
  std::uint64_t all;
  std::memcpy(&all, of, sizeof all);
  return all;
}

// four words, those of `bits`
std::uint64_t lanes(unsigned bits) {
  constexpr std::uint64_t kEach = 0x0001000100010001u;
  const std::uint64_t spread = ((bits & 0xFu) * 0x0000200040008001u) & kEach;
  return spread * 0xFFFF;
}

// word `i` of the state; a constant where it is called
__attribute__((always_inline)) inline std::uint64_t state_word(const Cpu& c, std::size_t i) {
  switch (i) {
    case 0:
    case 1:
    case 2:
    case 3:
      return four(&c.w[4 * i]);
    case 4:
      return four(c.shadow.w.data());
    case 5: {
      // flags as SR would show them, RCOUNT, and the flags that PUSH.S has kept
      const std::uint64_t z = c.z == 0, carry = c.c & 1, ov = c.ov & 0x8000, dc = c.dc & 0x100;
      return std::uint64_t{c.n & 0x8000u} << 48 | std::uint64_t{c.rcount} << 32 | ov << 16 | dc << 16 |
             z << 16 | carry << 17 | c.shadow.flags;
    }
    case 6:
    case 7:
      return static_cast<std::uint64_t>(c.acc[i - 6]);
    case 8:
      return static_cast<std::uint64_t>(c.loop_depth) << 32 | c.loop.count;
    case 9:
      return static_cast<std::uint64_t>(c.oa | c.ob << 1 | c.sa << 2 | c.sb << 3 | c.repeating << 4 |
                                        c.end_loop << 5 | c.splim_on << 6);
    default:
      return std::uint64_t{c.corcon} << 48 | std::uint64_t{c.splim} << 32 | std::uint64_t{c.psvpag} << 16 |
             c.tblpag;
  }
}

}  // namespace

CoreState::CoreState(const Cpu& c) {
#pragma GCC unroll 11
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = state_word(c, i);
}

void CoreState::put_flags(Cpu& c) const {
  c.n = words[5] & kN ? 0x8000 : 0;
  c.z = words[5] & kZ ? 0 : 1;
  c.c = words[5] & kC ? 1 : 0;
  c.ov = words[5] & kOv ? 0x8000 : 0;
  c.dc = words[5] & kDc ? 0x100 : 0;
}

__attribute__((always_inline)) inline bool CoreState::is_of_round(const Cpu& c, unsigned registers,
                                                                  bool sets_flags) const {
  // one decision for all words: that they are alike is what is asked nearly always
  std::uint64_t other = (words[5] ^ state_word(c, 5)) & ~(sets_flags ? kDc | kZ | kC | kOv | kN : kDc);
#pragma GCC unroll 11
  for (std::size_t i = 4; i < words.size(); ++i)
    if (i != 5) other |= words[i] ^ state_word(c, i);
  for (std::size_t i = 0; registers != 0; ++i, registers >>= 4)
    if (registers & 0xF) other |= (words[i] ^ four(&c.w[4 * i])) & lanes(registers & 0xF);
  return other == 0;
}

bool CoreState::is_of(const Cpu& c) const {
#pragma GCC unroll 11
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i] != state_word(c, i)) return false;
  return true;
}

// --- words of RAM

bool RoundMemory::Words::holds(unsigned at) const {
  for (const Word& word : words)
    if (word.place == at) return true;
  return false;
}

bool RoundMemory::Words::holds_any(unsigned first, unsigned end) const {
  for (const Word& word : words)
    if (word.place + 2u > first && word.place < end) return true;
  return false;
}

bool RoundMemory::Words::add(const std::uint8_t* ram, unsigned at) {
  if (words.size() == kMost) return false;
  Word& word = words.emplace_back();
  word.place = static_cast<std::uint16_t>(at);
  std::memcpy(&word.value, &ram[at], 2);
  return true;
}

bool RoundMemory::Words::are_in(const std::uint8_t* ram) const {
  for (const Word& word : words)
    if (std::memcmp(&ram[word.place], &word.value, 2) != 0) return false;
  return true;
}

bool RoundMemory::Words::are_in(const std::uint8_t* ram, unsigned but_for) const {
  for (const Word& word : words)
    if (word.place != but_for && std::memcmp(&ram[word.place], &word.value, 2) != 0) return false;
  return true;
}

std::uint16_t RoundMemory::Words::value_at(unsigned at) const {
  for (const Word& word : words)
    if (word.place == at) return word.value;
  return 0;
}

void RoundMemory::Words::take(const std::uint8_t* ram) {
  for (Word& word : words) std::memcpy(&word.value, &ram[word.place], 2);
}

void RoundMemory::Words::put(std::uint8_t* ram) const {
  for (const Word& word : words) std::memcpy(&ram[word.place], &word.value, 2);
}

// --- waits

std::size_t KnownWaits::place_of(const Decoded* first) const { return words_between(code_, first) % kMost; }

void KnownWaits::move(const Decoded* code) {
  for (const auto& wait : waits_)
    if (wait) wait->first = code + (wait->first - code_);
  code_ = code;
}

// no DO loop, whose place is not in the state; no modulo addressing
bool KnownWaits::is_plain(const Cpu& cpu) { return !cpu.loop_end && cpu.modcon == 0; }

const KnownWaits::Wait* KnownWaits::find(const Cpu& cpu) const {
  const Wait* const wait = at(cpu.next);
  return wait && is_plain(cpu) && wait->memory.are_as_read(cpu.ram.data()) &&
                 wait->state.is_of_round(cpu, wait->registers, wait->sets_flags)
             ? wait
             : nullptr;
}

void KnownWaits::add(const Cpu& cpu, const Wait& wait) {
  if (!is_plain(cpu)) return;
  // at its own place, else at the first that is free, else instead of another
  std::size_t place = place_of(wait.first);
  for (std::size_t i = kTried; i-- > 0;)
    if (const auto& known = waits_[(place_of(wait.first) + i) % kMost]; !known || known->first == wait.first)
      place = place_of(wait.first) + i;
  auto& known = waits_[place % kMost];
  if (known)
    *known = wait;
  else
    known = std::make_unique<Wait>(wait);
}

}  // namespace dspic
