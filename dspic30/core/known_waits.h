// SPDX-License-Identifier: MIT
// Waits that were proven, for when the program comes back to them from a handler.
//
//   round: state of the core, words of RAM that it reads --> the same state, words of RAM that it writes
//
// Whenever the state and the words that it reads are as they were, the round will do the same again. So it
// need not be run to be known; what it writes (a call leaves its return address behind) is put there. Rounds
// that read registers, of the core or of peripherals, by their addresses are not remembered.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "dspic30/core/decoded.h"
#include "dspic30/memory/cycle.h"

namespace dspic {

class Cpu;

/// All that a round may change or depend on and that is neither RAM nor a peripheral's, in words that compare
/// quickly. Not of DO loops: their places.
struct CoreState {
  CoreState() = default;
  explicit CoreState(const Cpu& cpu);
  /// Is the core in this state?
  bool is_of(const Cpu& cpu) const;
  /// ... as far as a round with these W registers goes, a bit each; and but for DC, which RETFIE leaves as
  /// the handler had it; `sets_flags`: but for all flags.
  bool is_of_round(const Cpu& cpu, unsigned registers, bool sets_flags) const;
  bool dc() const { return (words[5] & kDc) != 0; }
  /// Gives it the flags of this state.
  void put_flags(Cpu& cpu) const;
  static constexpr std::uint64_t kDc = std::uint64_t{0x100} << 16, kZ = std::uint64_t{1} << 16,
                                 kC = std::uint64_t{2} << 16, kOv = std::uint64_t{0x8000} << 16,
                                 kN = std::uint64_t{0x8000} << 48;
  std::uint16_t w(unsigned n) const { return static_cast<std::uint16_t>(words[n / 4] >> 16 * (n % 4)); }
  std::array<std::uint64_t, 11> words;
};

/// Words of RAM that a round reads before it writes them, with what it finds, and those that it writes.
/// Places are bytes from RAM's start.
class RoundMemory {
 public:
  /// Places that one instruction reads, or writes: those are odd.
  struct Touched {
    std::uint8_t count = 0;  // above the array's size: there were more
    std::array<std::uint16_t, 4> places{};
  };

  void clear() {
    reads_.words.clear();
    writes_.words.clear();
    is_whole_ = true;
  }
  /// An instruction begins.
  void begin_step() { touched_.count = 0; }
  const Touched& touched() const { return touched_; }
  void note_read(const std::uint8_t* ram, unsigned place) {
    touch(place & ~1u);
    if (!writes_.holds(place & ~1u) && !reads_.holds(place & ~1u)) is_whole_ &= reads_.add(ram, place & ~1u);
  }
  /// `whole`: a word, else a byte, of whose word the rest stays.
  void note_write(const std::uint8_t* ram, unsigned place, bool whole) {
    if (!whole) note_read(ram, place);
    touch(place | 1u);
    if (!writes_.holds(place & ~1u)) is_whole_ &= writes_.add(ram, place & ~1u);
  }
  /// Does a round read anything of RAM?
  bool reads() const { return !reads_.words.empty(); }
  /// False: there were too many.
  bool is_whole() const { return is_whole_; }
  /// Are words that it reads as they were when it read them? `but_for`: a place that does not matter.
  bool are_as_read(const std::uint8_t* ram) const { return reads_.are_in(ram); }
  bool are_as_read(const std::uint8_t* ram, unsigned but_for) const { return reads_.are_in(ram, but_for); }
  /// Does a round read any of the bytes [first, end) before it writes them?
  bool reads(unsigned first, unsigned end) const { return reads_.holds_any(first, end); }
  /// What it finds at a place that it reads before it writes it.
  std::uint16_t found(unsigned place) const { return reads_.value_at(place); }
  /// The round is over: what it wrote is there.
  void take_written(const std::uint8_t* ram) { writes_.take(ram); }
  void put_written(std::uint8_t* ram) const { writes_.put(ram); }

 private:
  void touch(unsigned place) {
    if (touched_.count < touched_.places.size())
      touched_.places[touched_.count] = static_cast<std::uint16_t>(place);
    ++touched_.count;
  }
  static constexpr std::size_t kMost = 24;
  struct Words {
    struct Word {
      std::uint16_t place, value;
    };
    std::vector<Word> words;  // mostly one or two
    bool holds(unsigned at) const;
    bool holds_any(unsigned first, unsigned end) const;
    bool add(const std::uint8_t* ram, unsigned at);
    bool are_in(const std::uint8_t* ram) const;
    bool are_in(const std::uint8_t* ram, unsigned but_for) const;
    std::uint16_t value_at(unsigned at) const;
    void take(const std::uint8_t* ram);
    void put(std::uint8_t* ram) const;
  };
  Words reads_, writes_;
  bool is_whole_ = true;
  Touched touched_;
};

class KnownWaits {
 public:
  struct Wait {
    const Decoded* first = nullptr;
    Cycle took = 0;
    bool sets_dc = false;     // else it stays as it is; nothing in the round reads it
    bool sets_flags = false;  // all, before anything reads one
    CoreState state;
    unsigned registers = 0xFFFF;  // W registers that an instruction of it may read or write, a bit each
    RoundMemory memory;
  };
  /// If the program goes round from cpu.next on, reading nothing that can change without an
  /// interrupt; null: not known.
  const Wait* find(const Cpu& cpu) const;
  /// The one that begins at an instruction; null: none is known.
  const Wait* at(const Decoded* first) const {
    const std::size_t place = place_of(first);
    for (std::size_t i = 0; i < kTried; ++i)
      if (const auto& wait = waits_[(place + i) % kMost]; wait && wait->first == first) return wait.get();
    return nullptr;
  }
  /// Proven, with cpu.next at its first instruction.
  void add(const Cpu& cpu, const Wait& wait);
  void forget() {
    for (auto& wait : waits_) wait.reset();
  }
  /// The program goes on in other words, alike and in the same order; `code` is the first.
  void move(const Decoded* code);

 private:
  static constexpr std::size_t kMost = 16, kTried = 4;
  std::size_t place_of(const Decoded* first) const;
  /// Does a round depend on no more than Wait holds?
  static bool is_plain(const Cpu& cpu);

  // By the instruction that a round is met at: an interrupt comes to any of them. One is at its place, or at one
  // of the next.
  std::array<std::unique_ptr<Wait>, kMost> waits_;
  const Decoded* code_ = nullptr;
};

}  // namespace dspic
