// SPDX-License-Identifier: MIT
// What a CompiledRunner asks of its processor's registers and interrupt controller. The answer is
// NativeProcessor, which holds the little that programs touch beside the e_* library.
//
// Times are cycles of the robot's clock and never go back from one call to the next. Vectors are numbered as
// the image's (image_abi.h): 0 to TP_VECTORS - 1 in natural order; kTrapVector + n are the core's traps.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/board/diagnosis.h"
#include "hal_sim/host/context.h"

namespace host {

class CompiledRunner;
class Observer;

inline constexpr int kNoVector = -1;
inline constexpr int kResetDue = -2;  ///< the processor resets itself: why_reset() says why

enum class ResetCause { PowerUp, Instruction, Button };

class Processor {
 public:
  virtual ~Processor() = default;

  /// "native".
  virtual const char* way() const = 0;

  // --- life
  virtual void power_up() = 0;
  /// Registers to their reset values; RCON tells the causes noted since the last one.
  virtual void reset(Cycle now) = 0;
  virtual void note_reset(ResetCause cause) = 0;
  /// The program was stopped by a trap: pins are released, drivers and motors are off.
  virtual void stop(Cycle now) = 0;
  /// Tick boundary, before the program goes on: what came from outside is on its way now. True: a waiting
  /// program should look again.
  virtual bool begin_window(Cycle now) { return false; }
  /// Everything that happens by itself up to `now` has happened.
  virtual void end_window(Cycle now) {}
  /// Somebody presses a key of the remote control: its line has a new future.
  virtual void remote_changed(Cycle now) = 0;

  // --- registers
  /// By the running program, at its CompiledRunner::now(). Byte address, 8 or 16 bits; 0 to 0xFFFF.
  virtual std::int64_t read(unsigned address, unsigned bits) = 0;
  virtual void write(unsigned address, std::uint16_t value, unsigned bits, Cycle now) = 0;
  /// By the running program, which nobody observes: a word becomes (what is read & keep) ^ flip, both halves
  /// of an instruction that changes a register.
  virtual void modify(unsigned address, std::uint16_t keep, std::uint16_t flip) = 0;
  /// TBLRDL and TBLWTL at a 24-bit program address: data EEPROM.
  virtual std::uint16_t table_read(unsigned program_address, Cycle now) = 0;
  virtual void table_write(unsigned program_address, std::uint16_t value, Cycle now) = 0;
  /// A loop waits from `now` on: the following reads say how long their value stays.
  virtual void watch_reads(Cycle now) {}
  /// Text that the program prints. False: the caller puts it out itself.
  virtual bool print(const char* bytes, std::int64_t length, int uart) { return false; }

  // --- interrupts
  struct Outlook {
    int vector = kNoVector;  ///< to serve at the instruction boundary before `now`; kNoVector, kResetDue
    bool may_wait = false;   ///< level or DISI may hold a flag off: longest_waiting() is worth asking
    Cycle horizon = 0;       ///< with kNoVector: until then look() answers the same, > now
  };
  /// Its answer stays true until its instant, whatever the program reads and whatever time passes. Not after
  /// a write (ChipProcessor tells CompiledRunner::note_interrupt_horizon, NativeProcessor
  /// CompiledRunner::changed), enter() or leave().
  virtual Outlook look(Cycle now) = 0;
  virtual const char* why_reset() const { return "the processor resets"; }
  struct Entry {
    void (*handler)() = nullptr;  ///< null: the program's own, by its vector
    Cycle first_instruction = 0;
    Cycle horizon = 0;       ///< no other vector can be served before; 0: ask look()
    Cycle saving = 0;        ///< what the handler itself needs to save registers; others may come within
    bool alternate = false;  ///< by the alternate vector table
  };
  virtual Entry enter(int vector, Cycle now) = 0;
  /// take(), the program's handler and leave() at once, where one interrupt is due and nobody observes.
  /// False: nothing has happened, take() knows.
  virtual bool serve(Cycle now) { return false; }
  /// look(), and enter() at once where there is a vector to serve.
  virtual Outlook take(Cycle now, Entry& entry) = 0;
  struct Return {
    Cycle next_instruction = 0;
    Cycle horizon = 0;  ///< nothing waits, and nothing can be served before; 0: ask look()
  };
  /// The handler returns.
  virtual Return leave(Cycle now) = 0;
  virtual int cpu_level() const = 0;
  virtual void set_cpu_level(int level, Cycle now) = 0;
  /// A flag that is set and enabled but cannot be served now, and since when; vector kNoVector if none.
  struct Waiting {
    int vector = kNoVector;
    Cycle since = 0;
  };
  virtual Waiting longest_waiting(Cycle now) = 0;

  // --- instructions
  virtual void disi(Cycle cycles, Cycle now) = 0;
  virtual void clear_watchdog(Cycle now) {}
  virtual void power_save(bool sleep, Cycle now) {}
  /// Does an interrupt end Sleep or Idle at `now`?
  virtual bool wakes(Cycle now) = 0;

  // --- for whoever writes its course down; no change of course
  /// The flag of an interrupt at `at`, not before what has already run; the first cycle after `at` at which
  /// it may change by itself, kNever if none; when it rose last, -1 unknown.
  virtual bool flag(int vector, Cycle at) = 0;
  virtual Cycle flag_horizon(int vector, Cycle at) = 0;
  virtual Cycle flag_since(int vector) = 0;
  /// Told of what happens by itself, as CompiledRunner::observe() says.
  virtual void observe(Observer* observer) {}

  /// What the models have to say about the program so far, in order of time.
  virtual std::vector<board::Diagnosis> diagnoses() const { return {}; }
  /// For whoever looks without disturbing: what has happened by `at` is carried out; a register's value then,
  /// and cycle before which it keeps it; handlers of a vector begun. Of the chip's models; else nothing.
  virtual void carry_out(Cycle at) {}
  virtual std::uint16_t peek(unsigned address, Cycle at) { return 0; }
  virtual Cycle horizon(unsigned address, Cycle at) { return kNever; }
  virtual std::int64_t served(int vector) const { return 0; }
};

/// Makes the processor of a robot that is being set up.
using ProcessorFactory = std::function<std::unique_ptr<Processor>(CompiledRunner&)>;

}  // namespace host
