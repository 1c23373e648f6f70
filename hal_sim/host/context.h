// SPDX-License-Identifier: MIT
// What the functions behind pins.h may ask of the robot whose firmware is running on this thread. The host
// implements it with fibers and budgets; board tests implement it with a plain counter.
#pragma once
#include <cstdint>
#include <string_view>

#include "hal_sim/board/cycle.h"
#include "sim_core/base/check.h"

namespace board {
class Board;
}
namespace drivers {
class Drivers;
}

namespace host {

using board::Cycle;
using board::kNever;

class Context;

namespace detail {
// Context::current(); in the executable itself, so no function needs to be asked for its place
__attribute__((tls_model("initial-exec"))) inline thread_local Context* running_here = nullptr;
}  // namespace detail

class Context {
 public:
  explicit Context(board::Board& board) : board_(board) {}
  virtual ~Context() = default;

  /// The robot whose firmware is running on this thread. Calling it from outside firmware is our bug (CHECK).
  static Context& current() {
    CHECK(detail::running_here, "a firmware function was called outside firmware");
    return *detail::running_here;
  }

  board::Board& board() { return board_; }
  /// Of the native way; calling it from the register way is our bug (CHECK).
  drivers::Drivers& drivers() {
    CHECK(drivers_, "a function of the native way was called in the register way");
    return *drivers_;
  }

  /// Cycles now, background work included.
  virtual Cycle now() = 0;
  /// What was just read cannot change by itself before `at`.
  void lower_horizon(Cycle at) {
    if (at < horizon_) horizon_ = at;
    looked_outside_ = true;
  }
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

 protected:
  board::Board& board_;
  drivers::Drivers* drivers_ = nullptr;  // null: the register way
  Cycle horizon_ = kNever;               // the least of lower_horizon() since somebody set it
  bool looked_outside_ = false;          // lower_horizon() was called since
};

/// After a change to the agendas: their next interrupt is asked for.
void request_agenda_interrupt(Context& context);

}  // namespace host
