// SPDX-License-Identifier: MIT
// Waits: a program that goes round without changing anything is found, jumped over, and counted.
//
//   Away --look due, or a known wait's first instruction--> Looking --proven--> Waiting
//        <--no wait--------------------------------------
//        <--an interrupt, or what it reads may change-------------------------
//
// A round proves a wait, the first one of a look or else the second: the core ends as it began, and the words
// of RAM that it read hold what they held when it read them. All rounds to come are like it, until what it
// reads from peripherals may change.
//
// The second chance is for a wait that an interrupt came into: RETFIE leaves the handler's DC behind. What
// reads no peripheral is remembered (known_waits.h) and need not be run again. A round that writes a
// register, reads a FIFO, loads a write latch or leads to a trap is no wait. A loop that only counts is one
// (counting.h) for so many rounds as are alike. So the course is the same to the cycle as if every round had
// been run. When a look begins, and how far it has come, depends on the program and its clock alone, not on
// how Processor::run() is called; so the time counted as waited does not either.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "dspic30/core/counting.h"
#include "dspic30/core/cpu.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

class Waits {
 public:
  /// At an instruction boundary: does go_on() have anything to do?
  bool is_due(const Cpu& cpu) const {
    return state_ != State::Away || cpu.heads.is_met || cpu.true_now() >= schedule(cpu).at;
  }
  /// Looks or jumps, up to cpu.deadline. Behind it the program is where it would be anyway.
  void go_on(Cpu& cpu);
  /// When the next look is due.
  Cycle look_at(const Cpu& cpu) const { return schedule(cpu).at; }
  /// At a head where the program would stop: what it waited for has come, so that it goes on. `head`: the
  /// instruction that begins now.
  bool passes(Cpu& cpu, const Decoded* head);
  /// An interrupt is about to be entered, by that vector.
  void cut(Cpu& cpu, int vector);
  /// A handler has returned.
  void resume(Cpu& cpu) {
    cpu.returned = false;
    note_resumed(cpu);
    expect_head(cpu);
  }
  /// Something from outside, or a debugger, may have changed what a wait looks at.
  void stir(Cpu& cpu);
  /// ... a flag that one may well wait for: it looks soon, outside of handlers each time more seldom where there
  /// was no wait.
  void hint(Cpu& cpu);
  /// A reset, or the flash holds other code.
  void forget(Cpu& cpu);
  /// The program begins at that true time.
  void begin_at(Cycle now);
  /// The program goes on in other words, alike and in the same order; the first ones of both.
  void move(const Decoded* from, const Decoded* to);

  /// A wait in a loop that counts, as it would be found at its own known head: when the program comes there,
  /// is cut by the handler of a vector, and goes on. Cycles of the program, and true ones.
  struct ByHeart {
    const Decoded* head = nullptr;
    int vector = 0;
    Cycle came = 0, cut = 0;
    Cycle came_true = 0, cut_true = 0;
  };
  /// Would it be found? RAM is as the loop finds it.
  bool knows(const Cpu& cpu, const ByHeart& wait) const;
  /// Is there neither a wait nor a look up to then, true time?
  bool is_free_until(const Cpu& cpu, Cycle when) const {
    return is_away() && std::min(schedule(cpu).at, look_by_) > when;
  }
  /// It has been so.
  void note(Cpu& cpu, const ByHeart& wait);
  /// Behind it the program has come to the head once more, and gone on.
  void note_over(Cpu& cpu, const Decoded* head, Cycle at, Cycle at_true);
  /// ... or has left the loop without coming to the head again.
  void note_left(Cpu& cpu);

  /// A handler known by heart comes now and is over by `over`, true time: if it changes nothing that the
  /// present wait reads, and nothing else comes, by when the program would be back at the wait's head and found
  /// waiting; kNever: it would not, or may not.
  Cycle back_by(const Cpu& cpu, Cycle over) const;
  /// Does the present wait read any of these bytes of RAM, counted from its start?
  bool reads(unsigned first, unsigned end) const { return wait_->memory.reads(first, end); }
  /// That handler, of a vector, has been there, and nothing came before back_by(): the wait goes on. It was cut
  /// when the program had taken `cut` cycles, at `cut_true`.
  void go_through(Cpu& cpu, int vector, Cycle cut, Cycle cut_true);

  bool is_away() const { return state_ == State::Away; }
  bool is_waiting() const { return state_ == State::Waiting; }
  /// When the present wait may end but by an interrupt; kNever: never.
  Cycle until(const Cpu& cpu) const {
    return counts_ ? std::min(until_, cpu.clocks.true_at(end_of_count(cpu))) : until_;
  }
  /// Cycles of the program in waits so far, when its clock shows `now` (which may be ahead, in a wait).
  Cycle waited(const Cpu& cpu, Cycle now) const {
    return waited_ + (is_waiting() ? cpu.clocks.own_cycles(now) - entered_ : 0);
  }
  /// When the present wait began, by the true clock.
  Cycle since() const { return entered_at_; }
  Cycle jumped() const { return jumped_; }

 private:
  enum class State { Away, Looking, Waiting };
  struct Schedule {
    Cycle at = kFirstLooks;  // true time
    Cycle between = kFirstLooks;
  };
  struct Cut {
    const Decoded* head = nullptr;  // first instruction of the wait that an interrupt came into last
    bool counts = false;            // it is a loop that counts, and its head is known
    Cycle took = 0, between = 0;    // a round of it; cycles since, between handlers, before it was back
    Cycle resumed = 0;              // cycles of the program when the latest handler returned
    Cycle resumed_delayed = 0;      // Cpu::delayed then
    Cycle resumed_at = 0;           // true time then
  };
  static constexpr Cycle kFirstLooks = 200, kRarestLooks = 65536;        // cycles between two looks
  static constexpr Cycle kOftenAtFirst = 32;                             // looks while the time doubles
  static constexpr Cycle kRarestInVain = 1 << 18;                        // ... where none ever found a wait
  static constexpr Cycle kFirstInHandler = 4096;                         // ... since it began
  static constexpr std::uint16_t kLooksAsOften = 8, kMostLooks = 60000;  // then a handler less has one
  static constexpr int kLongestRound = 256, kUsualRound = 32;            // instructions
  static constexpr Cycle kFewestRounds = 16;  // of a loop that counts: fewer are not jumped over
  static constexpr int kMostAgain = 2;
  // behind the first ends of a wait with a known head it looks soon, each time after another while
  static constexpr unsigned kStepsBehind = 17;
  static constexpr Cycle kFirstBehind = 40, kStepBehind = 29;
  // of kFirstBehind: so up to the length of a tick of the agenda, and of seven
  static constexpr unsigned kHandlerDoublings = 5, kBesideDoublings = 8;
  static constexpr Cycle kFirstGap = 2048, kMostGap = 1 << 27;  // between two looks beside known heads
  static constexpr int kMostPutOff = 4;                         // times, of such a look
  static constexpr unsigned kNotSet = 1u << 31;  // in Cpu::dc, of which instructions see one bit

  const Schedule& schedule(const Cpu& cpu) const { return schedules_[level(cpu)]; }
  Schedule& schedule(const Cpu& cpu) { return schedules_[level(cpu)]; }
  static std::size_t level(const Cpu& cpu) { return cpu.parts.interrupts.cpu().nesting() > 0 ? 1 : 0; }
  Cut& cut_of(const Cpu& cpu) { return cuts_[level(cpu)]; }
  const Cut& cut_of(const Cpu& cpu) const { return cuts_[level(cpu)]; }
  void begin(Cpu& cpu);
  void begin_here(Cpu& cpu);
  void begin_round(Cpu& cpu);
  void note_round(Cpu& cpu);
  void look(Cpu& cpu);
  void end_round(Cpu& cpu);
  bool goes_elsewhere(Cpu& cpu);
  void come_round(Cpu& cpu);
  bool is_passed(Cpu& cpu, const Count& count, Cycle rounds);
  bool is_passed(Cpu& cpu, const KnownWaits::Wait& wait, Cycle now);
  void note_resumed(const Cpu& cpu) {
    Cut& cut = cut_of(cpu);
    cut.resumed = cpu.clocks.own_cycles(cpu.now);
    cut.resumed_delayed = cpu.delayed;
    cut.resumed_at = cpu.true_now();
  }
  void expect_head(const Cpu& cpu);
  bool has_left(Cpu& cpu);
  void note_look(const Cpu& cpu);
  bool is_hinted_look(const Cpu& cpu);
  static Cycle soon(unsigned look, unsigned doublings);
  Cycle look_behind(Cpu& cpu, const Decoded* head, Cycle now);
  Cycle look_beside_heads(const Cpu& cpu, Cycle now) const;
  bool was_passed(const KnownWaits::Wait& wait, Cycle rounds) const;
  void pass(Cpu& cpu, const KnownWaits::Wait& wait, Cycle look_in);
  void fail(Cpu& cpu);
  bool goes_on(const Cpu& cpu, const KnownWaits::Wait& wait) const;
  bool is_rest(const Cpu& cpu, const KnownWaits::Wait& wait) const;
  void enter(Cpu& cpu, const KnownWaits::Wait* wait);
  void enter_count(Cpu& cpu, const Count* count, Cycle rounds);
  /// By the program's clock.
  Cycle end_of_count(const Cpu& cpu) const { return cpu.now + ends_ - cpu.clocks.own_cycles(cpu.now); }
  void wait(Cpu& cpu);
  void jump_over(Cpu& cpu);
  void note_cut(const Cpu& cpu);
  void begin_handler(const Cpu& cpu, int vector, Cycle at);
  /// Looks are rare, and each robot has one of these. `wait` goes on.
  void forget_probe(const KnownWaits::Wait* wait = nullptr) {
    if (probe_ && (wait == &probe_->round || wait == &probe_->proven.round()))
      std::vector<CountStep>().swap(probe_->trace);
    else
      probe_.reset();
  }
  void leave(Cpu& cpu);
  static void step(Cpu& cpu);

  // what every turn looks at, together
  State state_ = State::Away;
  bool is_by_head_ = false;                 // the wait's first instruction is one where the program stops
  bool at_head_ = false;                    // the look began at a known wait's first instruction
  bool is_hinted_ = false;                  // the program's look that is due, or goes on, is one
  std::array<Schedule, 2> schedules_;       // of the program, of its handlers
  Cycle began_ = 0;                         // the program, true time
  const KnownWaits::Wait* wait_ = nullptr;  // the wait: the probe's round, or a known one
  const Count* counts_ = nullptr;           // it is a loop that counts
  Cycle until_ = kNever, entered_ = 0;      // true time; cycles of the program
  Cycle entered_at_ = 0;                    // entered_, in true time
  Cycle ends_ = 0;                          // of a loop that counts: cycles of the program
  Cycle delayed_ = 0;                       // Cpu::delayed as it began: what passes in it counts once
  Cycle waited_ = 0, jumped_ = 0;
  struct HandlerLooks {
    std::uint16_t left = 0, done = 0;  // handlers until the next one with a soon look; such looks
  };
  std::array<HandlerLooks, kVectors> handler_looks_;
  unsigned hints_ = 0, hint_gap_ = 1;  // since the last look that one brought; between two
  std::array<Cut, 2> cuts_;            // of the program, of its handlers
  const KnownWaits::Wait* comes_round_ =
      nullptr;                              // the look's first round is one of this, its registers apart
  Cycle left_ = 0;                          // ... of that round: cycles of the program
  const Decoded* look_head_ = nullptr;      // where the look began
  Cycle look_began_ = 0, round_began_ = 0;  // true time; cycles of the program
  Cycle look_began_own_ = 0;                // cycles of the program
  Cycle round_delayed_ = 0;                 // Cpu::delayed then
  Cycle round_began_at_ = 0;                // true time then
  bool is_turned_ = false;                  // it begins at a known head that the look came to
  int chances_ = 0, steps_ = 0;
  std::uint16_t outermost_ = 0;  // the stack pointer where the round begins
  // a loop that counts, with few rounds to go: the look goes on behind it, or when it still runs then
  struct Range {
    const Decoded *first = nullptr, *last = nullptr;
  } behind_;
  int behind_in_ = 0, again_ = 0;  // instructions; looks
  struct Passed {
    const KnownWaits::Wait* wait = nullptr;
    Cycle at = 0;  // cycles of the program
  };
  std::array<Passed, 2> passed_;                      // met at their heads last, in another state
  int passes_ = 0;                                    // in a row
  Cycle look_by_ = kFirstGap, look_gap_ = kFirstGap;  // true time
  int put_off_ = 0;                                   // times that the look which is due was
  unsigned looks_beside_ = 0;                         // that were due
  // a loop that counts, behind an interrupt
  struct Expected {
    const Decoded* head = nullptr;
    Cycle at = kNever;  // the program has left it then, unless it comes to its head before; kNever: not asked
    Cycle look_if_back = 0;  // when a look is due if it does
  } expected_;               // true time
  /// The round that is looked at.
  struct Probe {
    KnownWaits::Wait round;
    std::vector<CountStep> trace;  // of the last chance
    Count proven;
  };
  std::unique_ptr<Probe> probe_;  // null: nothing is, and no wait is one that a look has found just now
};

}  // namespace dspic
