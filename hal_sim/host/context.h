// SPDX-License-Identifier: MIT
// What the functions behind pins.h may ask of the robot whose firmware is running on this thread. The host
// implements it with fibers and budgets; board tests implement it with a plain counter.
#pragma once
#include <cstdint>
#include <string_view>

#include "hal_sim/board/cycle.h"

namespace board {
class Board;
}
namespace drivers {
class Drivers;
}

namespace host {

using board::Cycle;
using board::kNever;

class Context {
 public:
  virtual ~Context() = default;

  /// The robot whose firmware is running on this thread. Calling it from outside firmware is our bug (CHECK).
  static Context& current();

  virtual board::Board& board() = 0;
  /// Of the native way; calling it from the register way is our bug (CHECK).
  virtual drivers::Drivers& drivers() = 0;

  /// Cycles now, background work included.
  virtual Cycle now() = 0;
  /// What was just read cannot change by itself before `at`.
  virtual void lower_horizon(Cycle at) = 0;
  /// Something the program can observe was changed by the program.
  virtual void note_write() = 0;
  /// Spends cycles; delivers interrupts; may let other robots run.
  virtual void spend(Cycle cycles) = 0;
  virtual void wait_until(Cycle at) = 0;
  /// What drivers().handler_share_q32() says has changed at this moment.
  virtual void follow_handlers() = 0;

  virtual void irq_install(int vector, void (*handler)(), int priority, Cycle entry_cycles) = 0;
  virtual void irq_at(int vector, Cycle at) = 0;  ///< at < 0 cancels
  virtual void set_background(int slot, Cycle period, Cycle cost) = 0;
  /// An agenda's function is called next; null: none in this interrupt. For traces.
  virtual void callback(const void*) {}

  /// Text that the program prints, put out by the processor's own means. False: there are none.
  virtual bool print(const char*, std::int64_t, int) { return false; }

  /// A trap of the running firmware; does not return. kind: TP_TRAP_*.
  [[noreturn]] virtual void trap(int kind, std::string_view message) = 0;
};

/// After a change to the agendas: their next interrupt is asked for.
void request_agenda_interrupt(Context& context);

}  // namespace host
