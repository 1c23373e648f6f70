// SPDX-License-Identifier: MIT
// hal_sim: the e-puck library's busy drivers as functions of the host. A program of the chip calls
// them beyond the flash (host_table.inc); each does to the board what hal_dspic's own code does, and
// takes what that takes.
//
//   program --call--> HostLibrary --> hal_sim/drivers (closed forms) --> board's pins
//           <--agendas' functions, as Timer 2's interrupt; scan's arrays, served at the beginning of RAM--
//
// It sees the board's pins, counts, time, and the program's memory through Cpu, nothing else. A function acts
// at the call, or where it matters at the cycle at which its own code would; what interrupts it waits for its
// end. Not modelled: the heap that nodes of agendas take; getselector() of the program's own.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include "dspic30/core/cpu.h"
#include "dspic30/core/host_calls.h"
#include "hal_sim/api/call_cycles.h"
#include "hal_sim/api/host_index.h"
#include "hal_sim/api/node_heap.h"
#include "hal_sim/api/scan_rhythm.h"
#include "hal_sim/api/scan_variables.h"
#include "hal_sim/drivers/drivers.h"

namespace api {

using dspic::Cpu;
using dspic::HandlerStep;
using dspic::HostResult;

/// Whoever hears which functions are called, with their arguments in the processor's registers.
class CallWatch {
 public:
  virtual ~CallWatch() = default;
  virtual void called(HostFunction function) = 0;
  /// An agenda's function, at this program address, is about to be called; 0: the last one of
  /// this tick has returned.
  virtual void calls_back(unsigned function, Cycle at) = 0;
  /// The library gives up, as it does by exit(1): the processor is about to be reset.
  virtual void gives_up() = 0;
  /// The program has written an index that leads out of its array of `size`.
  virtual void index_written(HostVariable index, unsigned value, int size) = 0;
};

class HostLibrary final : public dspic::HostCalls {
 public:
  /// Which drivers an image has from here, and how its library was compiled.
  struct Served {
    bool agenda = true, scan = true;
    Level level = Level::O1;
    unsigned free_space = 0;  ///< address of hal_free_space (firmware/library/e_prox.c)
  };
  /// `board` outlives this.
  HostLibrary(board::Board& board, Served served);
  void tell_calls(CallWatch* watch) { watch_ = watch; }

  // --- dspic::HostCalls
  HostResult call(Cpu& cpu, unsigned index, Cycle at, bool again) override;
  std::uint16_t read(unsigned address, Cycle at) override;
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle at) override;
  Cycle horizon(unsigned address, Cycle at) override;
  std::uint16_t peek(unsigned address, Cycle at) const override;
  Cycle due() const override;
  std::uint64_t share_q32() const override;
  std::int64_t take_owed_q32() const override {
    return std::exchange(owed_q32_, 0) + agendas().shares().take_owed_q32();
  }
  void begin_handler(Cycle at) override;
  HandlerStep next_in_handler(Cycle at) override;
  void end_handler(Cycle at) override;
  int vector(int handler) const override;
  void hold_handler(int handler, bool held, bool pending, Cycle at) override;
  Cycle source_event(int handler, Cycle after) const override;
  Cycle pending_cycles() const override;
  std::uint16_t saved_registers() const override {
    return static_cast<std::uint16_t>(cycles_.walk_saved_registers);
  }
  int saved_words() const override { return static_cast<int>(cycles_.walk_saved_words); }
  void reset(Cycle at) override;

  /// The program has come to address 0 without a reset: its start-up code clears the library's variables.
  void begin_anew(Cycle at);
  /// What it did so far, each at its cycle, whatever the order of looks at it.
  std::uint64_t digest() const { return digest_; }
  const drivers::Drivers& drivers() const { return *drivers_; }

 private:
  using Function = drivers::AgendaTimer::Function;
  struct Call {
    Cpu& cpu;
    unsigned index;  // of the function
    Cycle at;
    bool again;

    std::uint16_t word(int n) const { return cpu.w[static_cast<std::size_t>(n)]; }
    int number(int n) const { return static_cast<std::int16_t>(word(n)); }
    void give(int result) const { cpu.w[0] = static_cast<std::uint16_t>(result); }
  };
  // one function of each name of the table; e_agenda.cpp, e_motors.cpp, e_ad_conv.cpp
#define HOST_FUNCTION(driver, name) HostResult name(const Call& call);
#include "hal_sim/api/host_table.inc"
  using Method = HostResult (HostLibrary::*)(const Call&);
  static const std::array<Method, kHostFunctionCount> kMethods;

  void begin(Cycle at);
  bool is_right_reading(const Cpu& cpu, unsigned index) const;
  /// call() of any function: apart, so that those readings need few registers.
  __attribute__((noinline)) HostResult call_any(Cpu& cpu, unsigned index, Cycle at, bool again);
  void note(std::uint64_t what, Cycle at);
  void effect(const Call& call);
  void follow_ticks(Cycle at);
  void changed(const Call& call);
  void settle_hold(int handler, Cycle at);

  // --- agendas
  drivers::AgendaTimer& agendas() { return drivers_->agendas(); }
  const drivers::AgendaTimer& agendas() const { return drivers_->agendas(); }
  Function function_at(const Cpu& cpu, std::uint16_t pointer) const;
  /// Of a search through the list, and what is done where one is found.
  Cycle found_after(Function function, Cycle empty, Cycle missing, Cycle found, Cycle step) const;
  Cycle cost_of_set_cycle(Function function) const;
  Cycle cost_while_held(const Call& call, Cycle tick, Cycle edge) const;
  Cycle activate(const Call& call, Function function, std::uint16_t cycle, Cycle at);
  template <typename Change>
  HostResult change_found(const Call& call, Cycle cost, Change change);

  // --- motors
  Cycle set_speed(const Call& call, board::Wheel wheel, int speed, Cycle at);
  HostResult get_steps(const Call& call, board::Wheel wheel, Cycle cost);
  HostResult set_steps(const Call& call, board::Wheel wheel, Cycle cost);
  HostResult run_motor(const Call& call, board::Wheel wheel);
  Cycle cost_of_half(board::Wheel wheel) const;

  // --- scan
  int reading(const Call& call, unsigned sensor, Cycle dark_after, Cycle lit_after);
  int look_at(const Call& call, HostVariable which, unsigned index, Cycle after);
  drivers::AdcScan& scan() { return drivers_->scan(); }
  const drivers::AdcScan& scan() const { return drivers_->scan(); }

  board::Board& board_;
  Served served_;
  const CallCycles& cycles_;
  std::unique_ptr<drivers::Drivers> drivers_;  // large, and apart from what each call touches
  ScanVariables variables_;
  ScanRhythm rhythm_;
  NodeHeap heap_;
  CallWatch* watch_ = nullptr;
  std::array<std::int64_t, 2> zero_steps_{};  // what a motor had counted when its counter stood at 0
  std::uint64_t digest_ = 0;
  std::uint8_t held_ = 0;  // handlers, a bit each
  bool walk_begins_ = false;
  Cycle handler_began_ = 0, handler_ended_ = 0;
  std::uint8_t held_by_agendas_ = 0;   // handlers since then, and not yet let in again, a bit each
  mutable std::int64_t owed_q32_ = 0;  // of take_owed_q32(), beside the agendas' own
};

}  // namespace api
