// SPDX-License-Identifier: MIT
// The debugger's core: a world in which one robot stops where it is told to.
//
//   face (monitor, DAP) --run(Plan)--> Session --world's thread--> Twin, Machine --before(cycle)--> stop?
//
// While the robot stands, the whole world stands: its time does not go on. So what a run does depends on
// neither breakpoints nor patience. Going back is running again: a new world, the same seed, up to the cycle
// that is wanted, at full speed as far as nobody has to look; what was changed by hand is changed again.
//
// Steps do not stop in a handler that comes meanwhile. A breakpoint in it does.
#pragma once
#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hal_sim/debug/machine.h"
#include "hal_sim/debug/values.h"
#include "hal_sim/twin/twin.h"

namespace debug {

struct Stop {
  enum class Why { Entry, Step, Breakpoint, Watchpoint, Pause, Trap, Reset, End };
  Why why = Why::Entry;
  int id = 0;        ///< of the breakpoint
  std::string text;  ///< "breakpoint 1", "control_due: 0 -> 1, by control_tick() (main.c:39)"
};

/// What a robot's program runs on to.
enum class Plan {
  Continue,
  GoTo,             ///< past breakpoints, to a cycle
  AnyInstruction,   ///< into calls and handlers
  Instruction,      ///< into calls
  NextInstruction,  ///< over calls
  Line,
  NextLine,
  Finish,  ///< until this function has returned
  // backwards
  BackInstruction,
  BackLine,
  BackContinue,
};

struct Breakpoint {
  int id = 0;
  std::string what;                      ///< as it was asked for
  std::vector<std::uint32_t> addresses;  ///< empty: a watchpoint
  std::string condition;                 ///< an expression; empty: always
  Data data{0, 0};                       ///< of a watchpoint; no bytes: it is none
  std::optional<Values::Shape> shape;    ///< of a watchpoint's bits
  bool once = false;
  std::int64_t hits = 0;
};

class Session final : private chip::StepWatch {
 public:
  struct Setup {
    sim::WorldDesc world;
    twin::Options options;
    std::string robot;                        ///< empty: the first that has a program
    double seconds = 1e6;                     ///< the world ends
    std::function<void(twin::Twin&)> opened;  ///< told of each new world; this and the others may be empty
    std::function<void()> closes;             ///< told before a world goes for another one
    std::function<void(twin::Twin&)> step;    ///< steps it, a tick, also in a repetition; empty: that alone
    std::function<void()> ticked;             ///< after each tick that is not a repetition
    std::function<void()> repeated;           ///< after a repetition
  };
  /// Stopped before the program's first instruction. Null with lines in `problems`.
  static std::unique_ptr<Session> open(Setup setup, std::vector<std::string>& problems);
  ~Session() override;

  // --- running
  /// Returns when it has stopped. `idle` is asked about 50 times a second of real time; true: pause.
  Stop run(Plan plan, const std::function<bool()>& idle = nullptr);
  /// Forwards or backwards to the first instruction at or after a cycle.
  Stop go_to(Cycle cycle, const std::function<bool()>& idle = nullptr);
  bool has_ended() const { return state_ == State::Ended; }
  /// Its world goes no further, for good: what `step` and the others stand on may go.
  void halt() { abandon(); }

  // --- where it stands
  Cycle now() const;
  double seconds() const;  ///< the world's time
  std::uint32_t pc() const { return machine_->pc(); }
  std::vector<Frame> frames() { return machine_->frames(); }
  Machine& machine() { return *machine_; }
  const Machine& machine() const { return *machine_; }
  const dspic::FirmwareFile& file() const { return machine_->file(); }
  twin::Twin& twin() { return *twin_; }
  const std::string& robot() const { return setup_.robot; }

  // --- data
  /// The level of calls whose names and values are meant until it runs on: 0 is the innermost, as frames() has
  /// them. False: there is none.
  bool select_frame(std::size_t number);
  /// Null: the innermost one.
  const Frame* selected() const { return selected_ ? &*selected_ : nullptr; }
  /// What the program's names mean; without `pc`, where it stands, or in the level of calls that was selected.
  /// Until it runs on.
  Values values(std::optional<std::uint32_t> pc = {}) const {
    return selected_ && !pc ? Values(machine_->runner(), *selected_) : Values(machine_->runner(), pc);
  }
  /// As C's assignment. False: `error` says why.
  bool assign(const std::string& name, const std::string& expression, std::string& error);
  /// As the debugger's doing, again in each repetition. False: not a place that can be written.
  bool write(const Data& data, std::uint64_t value);

  // --- breakpoints
  /// Where code begins, at each of its copies, and how it is called.
  struct CodePlace {
    std::vector<std::uint32_t> addresses;  ///< none: `error` says why
    std::string what;
    bool is_function = false;  ///< named by its name
  };
  /// `where`: a function or label, file:line, line (of the current file), 0x-address.
  CodePlace find_code(const std::string& where, std::string& error) const;
  /// At find_code(). Null with `error`.
  const Breakpoint* add_breakpoint(const std::string& where, const std::string& condition,
                                   std::string& error);
  /// What is to be said of it: "weight() is part of main(); to measure it alone, ..."; empty: nothing.
  std::string note_of(const Breakpoint& b) const;
  /// `what`: a variable, a register or *address.
  const Breakpoint* add_watchpoint(const std::string& what, const std::string& condition, std::string& error);
  /// The program's source files (of file().code.lines().files) that a path means: the very file, or, of a path that
  /// does not begin at the root, those that end so. Of a program that was built somewhere else, or from a
  /// copy: the file of that name whose path agrees furthest.
  std::vector<std::size_t> files_meant(const std::string& path) const;
  bool remove(int id);
  std::vector<Breakpoint>& breakpoints() { return breakpoints_; }

 private:
  enum class State { Running, Stopped, Ended };
  struct Moment {
    Cycle at = 0;
    std::uint32_t pc = 0;
    Address base = 0;
    int nesting = 0;
    int hit = 0;               // id of the breakpoint that would stop here
    bool is_anywhere = false;  // of its cycle
  };
  struct Poke {
    Moment when;
    Data data;
    std::uint64_t value = 0;
  };

  explicit Session(Setup setup) : setup_(std::move(setup)) {}
  bool open_world(std::vector<std::string>& problems);
  void start(Cycle fast_until);
  void abandon();
  void run_world();
  Stop resume(const std::function<bool()>& idle);
  Stop go_to_main(const std::function<bool()>& idle);
  Stop repeat_to(const Moment& to, Cycle look_from, const std::function<bool()>& idle);
  Stop go_back(Plan plan, const std::function<bool()>& idle);

  void before(Cycle at) override;
  void after(const chip::Step& step) override;
  void was_reset(Cycle at) override;
  bool is_reached(const Moment& moment) const;
  bool wants_stop(Cycle at);
  bool is_step_over(Cycle at);
  bool is_way_back(const Moment& here);
  bool begins_line(std::uint32_t pc) const;
  bool is_same_line(std::uint32_t a, std::uint32_t b) const;
  int hit_here(bool count);
  bool watch_hit();
  void look_at_watchpoints();
  Moment moment(Cycle at);
  void apply_pokes();
  Cycle quiet_until() const;
  void stand();
  bool holds(const Breakpoint& b) const;
  void set_marks();
  bool place(Breakpoint& b, const std::string& where, std::string& error) const;
  void follow_flash();

  Setup setup_;
  std::unique_ptr<twin::Twin> twin_;
  std::unique_ptr<Machine> machine_;  // goes before its program
  int robot_ = 0;

  // the world's thread runs while state_ is Running, the face's otherwise
  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable changed_;
  State state_ = State::Stopped;
  std::optional<Frame> selected_;
  std::atomic<bool> pause_{false}, abandoned_{false};
  Cycle fast_until_ = 0;  // nobody looks before

  // what it runs to
  Plan plan_ = Plan::Continue;
  Moment from_;  // where the step began
  std::optional<Moment> target_;
  Stop stop_;
  std::string trap_;       // seen in the step before
  std::size_t traps_ = 0;  // of the program when this run began
  bool was_reset_ = false;
  std::uint32_t last_pc_ = 0;  // of the step before
  bool last_repeats_ = false;  // it was an iteration of a REPEAT
  struct PutOff {
    std::uint32_t pc;
    int nesting;
  };
  std::vector<PutOff> put_off_;  // instructions that a handler came before

  bool is_repeating_ = false;
  bool looks_back_ = false;  // and keeps the latest moment that a way back may end at
  std::optional<Moment> latest_;

  std::vector<Breakpoint> breakpoints_;
  std::vector<char> marks_;             // by address: is there a breakpoint?
  bool marks_host_ = false;             // at a function that the simulator plays?
  std::vector<std::uint64_t> watched_;  // values of watchpoints, in their order
  int last_id_ = 0;
  std::vector<Poke> pokes_;
  std::size_t next_poke_ = 0;
};

}  // namespace debug
