// SPDX-License-Identifier: MIT
// Waits: a program that goes round without changing anything is found, jumped over, and counted.
//
//   Away --look due, or a known wait's first instruction--> Looking --proven--> Waiting
//        <--no wait--                                                <--an interrupt, or what it reads may
//        change--
//
//   round 1, or else round 2: the core ends as it began, and what was read of RAM is as it was when it was
//   read  ->  all rounds to come are like it, until what it reads from peripherals may change
//
// The second chance is for a wait that an interrupt came into: RETFIE leaves the handler's DC behind. What
// reads no peripheral is remembered (known_waits.h) and need not be run again. A round that writes a
// register, reads a FIFO, loads a write latch or leads to a trap is no wait. So the course is the same to the
// cycle as if every round had been run. When a look begins, and how far it has come, depends on the program
// and its clock alone, not on how Processor::run() is called; so the time counted as waited does not either.
#pragma once
#include <array>
#include <vector>

#include "dspic30/core/cpu.h"

namespace dspic {

class Waits {
 public:
  /// At an instruction boundary: does go_on() have anything to do?
  bool is_due(const Cpu& cpu) const {
    return state_ != State::Away || cpu.head_met || cpu.true_now() >= schedule(cpu).at;
  }
  /// Looks or jumps, up to cpu.deadline. Behind it the program is where it would be anyway.
  void go_on(Cpu& cpu);
  /// When the next look is due.
  Cycle look_at(const Cpu& cpu) const { return schedule(cpu).at; }
  /// An interrupt is about to be entered.
  void cut(Cpu& cpu);
  /// Something from outside, or a debugger, may have changed what a wait looks at.
  void stir(Cpu& cpu);
  /// A reset.
  void forget(Cpu& cpu);

  bool is_waiting() const { return state_ == State::Waiting; }
  /// When what the present wait looks at may change but by an interrupt; kNever: never.
  Cycle until() const { return until_; }
  /// Cycles of the program in waits so far, when its clock shows `now` (which may be ahead, in a wait).
  Cycle waited(const Cpu& cpu, Cycle now) const {
    return waited_ + (is_waiting() ? cpu.clocks.own_cycles(now) - entered_ : 0);
  }
  Cycle jumped() const { return jumped_; }

 private:
  enum class State { Away, Looking, Waiting };
  struct Schedule {
    Cycle at = kFirstLooks;  // true time
    Cycle between = kFirstLooks;
  };
  static constexpr Cycle kFirstLooks = 200, kRarestLooks = 65536;  // cycles between two looks
  static constexpr Cycle kFirstPause = 50;                         // ... at a wait's first instruction
  static constexpr int kLongestRound = 256;                        // instructions

  const Schedule& schedule(const Cpu& cpu) const {
    return schedules_[cpu.parts.interrupts.nesting() > 0 ? 1 : 0];
  }
  Schedule& schedule(const Cpu& cpu) { return schedules_[cpu.parts.interrupts.nesting() > 0 ? 1 : 0]; }
  void begin(Cpu& cpu);
  void begin_round(Cpu& cpu);
  void look(Cpu& cpu);
  bool is_proven(Cpu& cpu);
  void fail(Cpu& cpu);
  void enter(Cpu& cpu, const KnownWaits::Wait* wait);
  void wait(Cpu& cpu);
  void leave(Cpu& cpu);
  static void step(Cpu& cpu);

  State state_ = State::Away;
  std::array<Schedule, 2> schedules_;  // of the program, of its handlers
  bool at_head_ = false;               // the look began at a known wait's first instruction
  bool was_cut_ = false;               // ... behind an interrupt that came into a wait
  const Decoded* cut_ = nullptr;       // its first instruction
  Cycle resumed_ = -1;                 // cycles of the program behind the interrupt; -1: there was none
  Cycle head_pause_ = kFirstPause;
  // the round that is looked at
  KnownWaits::Wait round_;
  Cycle look_began_ = 0, round_began_ = 0;  // true time; cycles of the program
  int chances_ = 0, steps_ = 0;
  // the wait
  const KnownWaits::Wait* wait_ = nullptr;  // round_, or a known one
  Cycle until_ = kNever, entered_ = 0;      // true time; cycles of the program
  Cycle waited_ = 0, jumped_ = 0;
};

}  // namespace dspic
