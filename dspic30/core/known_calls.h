// SPDX-License-Identifier: MIT
// Where an image has routines that are known by heart (known_routine.h), and what the core does when its
// course comes there: the routine's answer and its return at once, if nothing else can happen before.
//
// A KnownAction leaves what the routine itself leaves: all registers, flags, RCOUNT, RAM with the stack below
// W15. So nothing shows which of both was done, and nothing depends on where the time is cut into windows. Of
// a KnownFunction, W4 to W7, flags and the stack below W15 stay as they were; then programs that look at
// what they never wrote can tell.
#pragma once
#include <cstddef>
#include <vector>

#include "dspic30/core/known_routine.h"
#include "dspic30/memory/cycle.h"

namespace dspic {

struct Decoded;

class KnownCalls {
 public:
  /// The routine begins at this program address. A second one for an address is ignored.
  void add(unsigned address, const KnownRoutine& routine);
  /// Null: none begins there.
  const KnownRoutine* find(unsigned address) const {
    if (places_.empty()) return nullptr;
    for (std::size_t i = slot(address);; i = (i + 1) & (places_.size() - 1)) {
      if (places_[i].address == address) return places_[i].routine;
      if (!places_[i].routine) return nullptr;
    }
  }
  std::size_t size() const { return count_; }
  /// Handlers that are answered, too; null: none.
  void add_handlers(KnownHandler handlers) { handlers_ = handlers; }
  KnownHandler handlers() const { return handlers_; }

  /// W registers that count as written once a known routine has been called: the ones that C's
  /// callees use freely.
  static constexpr unsigned kWrites = 0x00FF;
  /// Bytes of stack that a routine of registers alone may use. Where the stack has less, it runs.
  static constexpr unsigned kStack = 128;

 private:
  struct Place {
    unsigned address = 1;  // odd: nobody's
    const KnownRoutine* routine = nullptr;
  };
  std::size_t slot(unsigned address) const {
    return (address / 2 * 0x9E3779B1u >> 16) & (places_.size() - 1);
  }
  void put(const Place& place);

  std::vector<Place> places_;  // open addressing, a power of two, half empty
  std::size_t count_ = 0;
  KnownHandler handlers_ = nullptr;
};

/// The course has come to `d`, where `routine` begins, and its return address is on top of the stack. Where
/// it can be answered, all is done up to behind its RETURN, and the instruction there is returned; as with an
/// instruction's own function, Decoded::cycles of `d` are not counted yet. Null: nothing was done.
const Decoded* recall(Cpu& cpu, const Decoded* d, const KnownRoutine& routine);

/// What recall() does, for translated code, which has just pushed the return address: the routine's cycles,
/// with that address taken off the stack. `begin` is when its first instruction would; the clock is not
/// moved. All W registers are in their places, and so are flags that it may keep (KnownRoutine); W0 to W7,
/// W15 and the flags may be changed. 0: nothing was done, and the routine has to run.
Cycle answered(Cpu& cpu, const Decoded* d, const KnownRoutine& routine, Cycle begin);

}  // namespace dspic
