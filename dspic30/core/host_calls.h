// SPDX-License-Identifier: MIT
// Whoever plays the library's busy drivers for a program on this core: their functions lie beyond the flash,
// their handlers are not run but known by heart.
//
//   program --call--> Cpu --HostCalls::call()--> C++ --W0 to W3, cycles--> program
//           <--injected call--  due, begin_handler(), next_in_handler(), end_handler()
//
// Two clocks: the program's counts the cycles that the program itself has taken since settled(); the true one
// has what the handlers known by heart took besides, a share of each cycle. Everything that leaves the core
// sees the true time: each Cycle in this file is one. So nothing depends on where run() is cut.
#pragma once
#include <cstdint>

#include "dspic30/memory/cycle.h"

namespace dspic {

class Cpu;

/// What a function of the host comes to.
struct HostResult {
  Cycle cycles = 0;  ///< from behind the call instruction to behind RETURN, as the driver's own code takes
  Cycle wait_until = 0;  ///< above `at`: it is not over, and is asked again then; cycles do not count

  static HostResult done(Cycle cycles) { return {cycles, 0}; }
  static HostResult waits(Cycle until) { return {0, until}; }
};

/// What a handler known by heart does next.
struct HandlerStep {
  unsigned function = 0;         ///< program address that it calls; 0: it is over
  Cycle cycles = 0;              ///< that it takes before the call, or before its RETFIE
  bool divides_by_zero = false;  ///< the handler's own code does, behind these cycles: a math error's trap
};

class HostCalls {
 public:
  static constexpr int kHandlers = 2;
  virtual ~HostCalls() = default;

  /// Function `index` is called at `at`. Arguments are in cpu.w by the ABI, other data are reached by
  /// cpu.read16() and its kin; results go to cpu.w. `again`: it has waited, nothing else changed in between
  /// but by interrupts. What changes anything calls cpu.note_effect(); what only looks, cpu.note_look(until
  /// when it stays so); what changes due or share, cpu.host_changed().
  virtual HostResult call(Cpu& cpu, unsigned index, Cycle at, bool again) = 0;

  // --- the library's registers: words of RAM that are served (kServedEndSymbol)
  virtual std::uint16_t read(unsigned address, Cycle at) = 0;
  /// `lanes`: 0xFFFF, 0x00FF or 0xFF00, bits that are written.
  virtual void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle at) = 0;
  /// Until when a read gives the same value, > at.
  virtual Cycle horizon(unsigned address, Cycle at) = 0;
  /// read() without side effects, for debuggers.
  virtual std::uint16_t peek(unsigned address, Cycle at) const = 0;

  // --- handlers known by heart
  /// When the next one comes that calls the program; kNever: none. Read after host_changed() and
  /// after each handler.
  virtual Cycle due() const = 0;
  /// What handlers that call nothing take of each cycle, as a fraction of 2^32. Read as due() is.
  virtual std::uint64_t share_q32() const = 0;
  /// What the shares have taken too little by now, once, in cycles of 2^-32; negative: too much.
  virtual std::int64_t take_owed_q32() const = 0;
  /// The handler that is due, or pending, begins: its entry as an interrupt is the core's. Its vector is
  /// vector(0). One that has not ended is begun anew.
  virtual void begin_handler(Cycle at) = 0;
  /// Asked at its beginning, and whenever what it called has returned.
  virtual HandlerStep next_in_handler(Cycle at) = 0;
  /// Behind its last step; registers are given back and RETFIE comes.
  virtual void end_handler(Cycle at) = 0;
  /// Vectors of the handlers known by heart (vectors.h): the one that calls the program, then one
  /// that does not; kNoVector: there is none. Their IEC bits and priorities say whether they can
  /// come. Stay as they are.
  virtual int vector(int handler) const = 0;
  /// From `at` on the program holds this handler off (its level, DISI, its IEC bit), or does no longer. A
  /// held one takes no share, and its flag is the chip's: set at each source_event(), cleared and set by the
  /// program as it likes. `pending`: the flag is set as it is let go, so it comes now.
  virtual void hold_handler(int handler, bool held, bool pending, Cycle at) = 0;
  /// The first instant after `after` at which its source sets its flag; kNever: none.
  virtual Cycle source_event(int handler, Cycle after) const = 0;
  /// What the handler that calls nothing takes when it comes because it was pending, entry
  /// and RETFIE included.
  virtual Cycle pending_cycles() const = 0;
  /// Registers that the handler's own code saves before it calls anything, as bits W0 to W14, and other words
  /// that it pushes (RCOUNT, PSVPAG ...): the stack grows by so much.
  virtual std::uint16_t saved_registers() const = 0;
  virtual int saved_words() const = 0;
  /// A reset of the chip.
  virtual void reset(Cycle at) = 0;
};

}  // namespace dspic
