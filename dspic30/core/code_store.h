// SPDX-License-Identifier: MIT
// The words of an image made ready to run, and their translations, for all robots that run it,
// on whatever thread.
//
//   image --CodeStore--> CodeTable of {registers written, special pointers} <--runs on-- Cpu, Cpu, ...
//
// How a word is to be run depends on its robot in two respects: on the registers that the program has written
// since its reset, since an address in one that it has not written resets the chip; and on those that are
// modulo or bit-reversed pointers. So there is a table for each such state that lasts, and a Cpu whose state
// changes moves to another one. A Cpu that changes its flash gets a store of its own.
//
// A word is published by its function and then by its state, both stored behind all else. Zeros are a word
// that is not met; one that the course may step to has meet() as its function. Decoding is guarded by the
// table's mutex, running is not. Whoever runs on a table keeps it.
#pragma once
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "dspic30/core/decoded.h"
#include "dspic30/core/host_place.h"
#include "dspic30/core/known_calls.h"
#include "dspic30/memory/program_memory.h"

namespace dspic {

class Translator;

/// W0 to W14, a bit each.
inline constexpr unsigned kAllWritten = 0x7FFF;

/// What a robot's state means to its code.
struct CodeState {
  unsigned written = kAllWritten;                       ///< registers that were written since the reset
  std::uint32_t special_reads = 0, special_writes = 0;  ///< Cpu::special_registers()
  bool operator==(const CodeState& o) const {
    return written == o.written && special_reads == o.special_reads && special_writes == o.special_writes;
  }
};

/// Registers of a word that matter to what may run.
struct WordRegisters {
  std::uint16_t uses = 0;          ///< as pointers
  std::uint16_t gives = 0;         ///< they count as written from then on
  std::uint16_t touches = 0xFFFF;  ///< that it may read or write, W15 among them; others as well
  /// N, OV, Z, C and DC: whatever they were, it sets all; it neither reads nor writes any; or it may do both.
  enum class Flags : std::uint8_t { May, Neither, SetsAll } flags = Flags::May;
};

/// The functions of words that are no instructions, and of those that are not decoded yet.
const Decoded* illegal(Cpu& cpu, const Decoded* d);
const Decoded* meet(Cpu& cpu, const Decoded* d);
/// An instruction that the onlooker wants to know of: it hears, and then it runs.
const Decoded* tell(Cpu& cpu, const Decoded* d);
/// ... it only hears.
const Decoded* hear(Cpu& cpu, const Decoded* d);

class CodeTable {
 public:
  /// `told`: program addresses whose instructions tell the onlooker that they begin, in order.
  /// `known`: its routines that are known by heart; null: none.
  CodeTable(const CodeState& state, std::vector<std::uint32_t> told, std::shared_ptr<const KnownCalls> known);

  /// One a flash word, then one for addresses where no flash is.
  const Decoded* words() const { return words_.get(); }
  const CodeState& state() const { return state_; }
  static bool is_decoded(const Decoded* d) {
    return d->state.load(std::memory_order_acquire) != Decoded::Unmet;
  }
  /// Makes a word of `program`, which holds this store's image, ready, unless it is. `jumps`: so many to it
  /// make it warm.
  void decode(const Decoded* d, const ProgramMemory& program, std::uint8_t jumps);
  /// Its own function, not what was put in front of it; also of a host_place().
  Run plain(const Decoded* d) const {
    const Run run = d->run.load(std::memory_order_acquire);
    return !address_of_host_place(d) && is_decoded(d) ? beside_[index_of(d)].plain : run;
  }
  /// W registers that an instruction that was met may read or write, a bit each.
  unsigned touched_by(const Decoded* d) const {
    return address_of_host_place(d) ? 0xFFFFu : registers(d).touches;
  }
  /// Does the program, straight on from an instruction that was met, set all flags before it reads one?
  bool sets_flags(const Decoded* d) const {
    using Flags = WordRegisters::Flags;
    constexpr int kFirstOnes = 4;
    for (int i = 0; i < kFirstOnes && !address_of_host_place(d) && is_decoded(d); ++i, ++d) {
      const Flags flags = registers(d).flags;
      if (flags != Flags::Neither) return flags == Flags::SetsAll;
    }
    return false;
  }
  /// Of a word that is decoded.
  const WordRegisters& registers(const Decoded* d) const { return beside_[index_of(d)].registers; }
  bool tells(const Decoded* d) const { return beside_[index_of(d)].tells.load(std::memory_order_acquire); }
  /// The routine known by heart that begins at a program address; null: none.
  const KnownRoutine* known_at(unsigned address) const { return known_ ? known_->find(address) : nullptr; }
  /// Handlers of interrupts that are known by heart; null: none.
  KnownHandler known_handlers() const { return known_ ? known_->handlers() : nullptr; }
  /// The jumps are over that Decoded::heat counts: translates it, unless it is too early. `hot`: as Cpu::hot.
  void warm(const Cpu& cpu, const Decoded* d, Translator& translator, int hot);
  /// A wait is known to begin at a word that was met: `stop` runs there each time, and what ran before is
  /// beside_wait(). What was translated with it would go round past it, so it is forgotten.
  void mark_wait(const Decoded* d, Run stop);
  /// The onlooker is told of one more instruction. What was translated with it would not tell, so it is forgotten.
  void tell_also(std::uint32_t address);
  bool is_wait(const Decoded* d) const { return beside_[index_of(d)].wait.load(std::memory_order_acquire); }
  Run beside_wait(const Decoded* d) const {
    return beside_[index_of(d)].wait.load(std::memory_order_acquire);
  }
  /// Places where translated code begins.
  int translated() const;
  /// Words are decoded again. Nobody else runs on this table.
  void forget();
  /// The flash holds other routines now; before forget().
  void forget_known() { known_.reset(); }

 private:
  struct Beside {
    Run plain;
    WordRegisters registers;
    std::atomic<bool> tells;  // the onlooker, or is known by heart
    std::atomic<Run> wait;    // null: no wait is known to begin here
  };
  struct Warmth {
    int times = 0, refusals = 0;
    bool is_busy = false;                // somebody translates it
    std::ptrdiff_t first = 0, last = 0;  // words from it that its translation holds
  };
  struct Free {
    void operator()(void* memory) const { std::free(memory); }
  };
  template <class T>
  using Zeroed = std::unique_ptr<T[], Free>;  // pages that nobody touches take no memory
  std::size_t index_of(const Decoded* d) const { return static_cast<std::size_t>(d - words_.get()); }

  void forget_translations_of(std::size_t index);

  const CodeState state_;
  std::shared_ptr<const KnownCalls> known_;
  mutable std::mutex mutex_;  // of all that follows, but what was published
  std::vector<std::uint32_t> told_;
  std::uint64_t marks_ = 0;  // of waits and told ones: what is translated meanwhile may go past one
  const Zeroed<Decoded> words_;
  const Zeroed<Beside> beside_;
  std::vector<std::uint32_t> decoded_;
  std::unordered_map<const Decoded*, Warmth> warmth_;
  int translated_ = 0;
};

/// The tables of one image: what flash holds is the same for all that run on them.
class CodeStore {
 public:
  /// From now on, the onlooker is told of these addresses, in order. False: it is told of others already, and not
  /// of all these.
  bool tell(const std::vector<std::uint32_t>& addresses);
  /// ... of one more.
  void tell_also(std::uint32_t address);
  std::vector<std::uint32_t> told() const;
  /// The image's routines that are known by heart, from now on; null: none. False: others are known already.
  bool know(std::shared_ptr<const KnownCalls> calls);
  std::shared_ptr<const KnownCalls> known() const;
  /// The table of a state; null: `make` is false, and nobody has needed it.
  std::shared_ptr<CodeTable> table(const CodeState& state, bool make);
  /// As CodeTable::forget(), of all tables. `is_other`: flash was written, so no routine is known any more.
  void forget(bool is_other);

 private:
  static constexpr std::size_t kMost = 8;  // tables; those in use do not count
  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<CodeTable>> tables_;
  std::vector<std::uint32_t> told_;
  std::shared_ptr<const KnownCalls> known_;
  bool is_told_known_ = false;
};

/// A word made ready for a state. Of the function itself: illegal(), where the state does not allow it.
Decoded decode_word(const ProgramMemory& program, unsigned address, const CodeState& state,
                    WordRegisters& registers);
/// The function of a word, whatever registers were written before; null: it is no instruction.
Run function_of(std::uint32_t word);

}  // namespace dspic
