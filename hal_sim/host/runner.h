// SPDX-License-Identifier: MIT
// What executes one robot's firmware, as everybody else sees it: the mind that gives it time, and traces,
// supervisors, tools and tests that look at the program.
//
//   FirmwareMind --begin_window, run_until--> Runner --pins--> Board
//
// Runners: chip::ChipRunner, the robot's own code; programs::ProgramRunner, a process of the PC.
//
// Time: a Cycle is an instruction cycle of the robot's own clock since power-up. The mind gives windows, one
// a tick of the world, each from the end of the one before to a later end; a runner never looks beyond its
// window. Threads: run_until() may run beside those of other robots; everything else, and all of it between
// windows, on one thread at a time. Errors: nothing throws; what is wrong with a program is a TrapReport or a
// diagnosis. Equal programs, boards and windows give equal courses, whoever looks in between.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/board/diagnosis.h"
#include "hal_sim/host/chip_view.h"
#include "hal_sim/host/observer.h"
#include "hal_sim/host/place.h"
#include "hal_sim/host/program_data.h"
#include "sim_core/base/hot_memory.h"

namespace board {
class Board;
}
namespace drivers {
class Drivers;
}

namespace host {

/// Kind of a TrapReport.
enum TrapKind : int {
  kUnexpectedReset = 0,  ///< the robot went on
  kTrapMath,             ///< division by zero, accumulator overflow
  kTrapAddress,          ///< null, wild or odd address
  kTrapStack,            ///< beyond SPLIM
  kTrapAbort,            ///< abort(), failed assert(), exit() with a failure
  kTrapInterrupt,        ///< an enabled interrupt without a handler, or the oscillator's trap
  kTrapIllegal,          ///< illegal instruction
  kTrapSanitizer,        ///< --sanitize found it
  kTrapUnsimulated,      ///< a device, or a source of clock, that the robot has not
  kProgramEnded,         ///< a program of the PC ended by a signal, or with a status that says so
};

/// Why a robot stopped or restarted, for reports.
struct TrapReport {
  std::string robot;
  int kind = kUnexpectedReset;   ///< TrapKind
  std::string vector;            ///< "MathError", "T1"; "Reset": of none; empty: of a program of the PC
  std::string message;           ///< one sentence
  Place place;                   ///< where in the firmware
  Cycle cycle = 0;               ///< cycles since power-up
  double time_s = 0;             ///< world time
  std::vector<Place> backtrace;  ///< from `place` outwards, at most 16
  int count = 1;                 ///< how often (where the robot went on)
};

/// "division by zero", "address error" ...
const char* trap_name(int kind);

class Runner {
 public:
  explicit Runner(std::string name) : name_(std::move(name)) {}
  virtual ~Runner() = default;
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// The robot's, for messages.
  const std::string& name() const { return name_; }

  // --- time
  /// A window begins at `now`, after Board::exchange(): what came from outside is on its way. Windows that
  /// were left out, because idle_until() lies beyond them, have passed.
  virtual void begin_window(Cycle now) = 0;
  /// The program runs until cycle `end`, or up to the end of the instruction or block that reaches it,
  /// which the next window makes up for. Returns when it is there, sleeps beyond it or has stopped; blocks
  /// on nothing outside.
  virtual void run_until(Cycle end) = 0;
  /// Until this cycle run_until() would do nothing, if nothing comes from outside; 0: it runs
  /// on, kNever: for ever.
  virtual Cycle idle_until() const = 0;
  /// The windows up to `end`, before which it is idle, have passed.
  virtual void pass_to(Cycle end) = 0;
  /// Handlers that have returned since it was made; what drivers in closed form do is none.
  virtual std::int64_t interrupts_served() const = 0;
  /// Adds what each run_until() looks at.
  virtual void add_hot(sim::HotMemory& /*memory*/) const {}
  /// Grows whenever the program has run: what it knows and did is as it was until then.
  virtual std::uint64_t turns() const = 0;
  /// Something outside changed (a byte came in, the selector was turned): a wait looks again.
  virtual void wake() {}
  /// Somebody will press, or presses, a key of a remote control: the receiver's line has a new future.
  virtual void remote_changed() {}
  /// The reset button: the program begins anew at the end of the last window, also after a trap. Traps stay
  /// reported.
  virtual void restart() = 0;
  /// Behind restart(): as when it was first switched on, not as behind the button. The time of a program of
  /// the PC begins anew.
  virtual void begin_again() {}

  // --- how it has gone
  /// End of the last window.
  virtual Cycle cycles() const = 0;
  /// Of these, cycles in which the processor only waited, a wait that still goes on included.
  virtual Cycle idle_cycles() const = 0;
  /// Since when the program has been in a wait that has not ended; kNever: it is in none.
  virtual Cycle waiting_since() const = 0;
  /// Share of its life in which it did anything but wait, 0 to 1.
  double cpu_load() const {
    return cycles() > 0 ? 1 - static_cast<double>(idle_cycles()) / static_cast<double>(cycles()) : 0;
  }
  /// A trap has stopped it for good, or until restart().
  virtual bool has_stopped() const = 0;
  /// Traps and unexpected resets, in order of time.
  virtual const std::vector<TrapReport>& traps() const = 0;
  /// What board and chip have to say about the program so far, in order of time.
  virtual std::vector<board::Diagnosis> diagnoses() const = 0;
  /// Of what the program did; the board's own state is not in it. Equal courses have equal ones.
  virtual std::uint64_t hash() const = 0;
  /// Is that a sum of all it did to the board, each at its cycle? Then the board's state adds nothing.
  virtual bool hashes_events() const { return false; }
  /// World time of a cycle, for reports; set by the mind, empty on a bench.
  std::function<double(Cycle)> to_world_s;

  /// The program's data and code; those of a program of the PC nobody sees.
  virtual ProgramData& data() const = 0;
  /// The chip with its registers; null: there is none. It belongs to the runner.
  virtual ChipView* chip() const { return nullptr; }

  // --- for whoever writes its course down; no change of course
  /// Null: nobody. The observer outlives the robot or is taken away.
  virtual void observe(Observer* observer) { observer_ = observer; }
  bool is_observed() const { return observer_ != nullptr; }
  /// Somebody else is about to ask the board how it is at `at`: what closed forms have been asked once they
  /// no longer know of before, so the observer looks first.
  void tell_asked(Cycle at) const {
    if (observer_) observer_->reached(at);
  }
  /// The library's drivers where they are closed forms; null: the program's own run.
  virtual const drivers::Drivers* closed_drivers() const { return nullptr; }

 protected:
  /// Of the chip and of the board, as diagnoses() gives them: in order of time, with the world's time.
  std::vector<board::Diagnosis> dated(std::vector<board::Diagnosis> of_chip,
                                      std::vector<board::Diagnosis> of_board) const;
  Observer* observer_ = nullptr;

 private:
  std::string name_;
};

/// Makes what executes the firmware of a robot that is being set up, on its board.
using RunnerFactory = std::function<std::unique_ptr<Runner>(board::Board&)>;

}  // namespace host
