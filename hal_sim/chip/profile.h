// SPDX-License-Identifier: MIT
// Where a chip robot's time goes, exact to the cycle: functions, interrupts, turns of the main loop, busy
// waits, the deepest stack.
//
//   ChipRunner --Step--> Profile: a stack of contexts (main, handlers), each with its own clock and its own
//                        stack of calls --> report()
//
// A context's clock stands while another one interrupts it. So a function's cycles are those of its code and
// of what it calls, from its first instruction to RETURN, without the handlers served meanwhile: what its
// code alone says (code_cycles.h), where that tells. A turn of the main loop is told in the robot's time,
// handlers included. A wait is a round of a loop that changes nothing but one counter that is no pointer:
// polling, or a delay.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "dspic30/load/firmware_file.h"
#include "dspic30/memory/host_places.h"
#include "hal_sim/chip/step_watch.h"

namespace chip {

/// Least, mean and most of something, and when the most was.
struct Spread {
  std::int64_t count = 0;
  Cycle sum = 0, min = 0, max = 0, max_at = 0;
  void add(Cycle value, Cycle at);
  double mean() const { return count > 0 ? static_cast<double>(sum) / static_cast<double>(count) : 0; }
};

struct ProfileReport {
  struct Function {
    std::string name, place;  ///< "main.c:98"
    Spread cycles;            ///< a call, callees included, handlers not
    Cycle own = 0;            ///< its own code alone, all calls
    std::string max_caller;
    bool is_agenda = false;  ///< called by a handler through a pointer
  };
  struct Interrupt {
    int vector = 0;
    std::string name;         ///< "T1", "AddressError"
    Spread cycles;            ///< a service: entry to RETFIE, without handlers that interrupt it
    Spread latency;           ///< from the flag to the first instruction
    Spread period;            ///< from flag to flag
    std::int64_t merged = 0;  ///< events that came while the flag was set: one service for several
    std::int64_t missed = 0;  ///< flags that the program cleared although they were enabled and not served
  };
  struct Wait {
    std::string place;    ///< "main() (main.c:110)"
    Spread cycles;        ///< a wait, from the first round that changed nothing
    bool counts = false;  ///< a delay loop; else it polls
  };
  Cycle from = 0, to = 0;       ///< what was seen
  Cycle slept = 0, waited = 0;  ///< as the run's load counts them
  Cycle in_handlers = 0;
  Spread turn;  ///< of the main loop; count 0: none was found
  std::string turn_place;
  int stack_bytes = 0;  ///< deepest
  int stack_free = 0;   ///< of the chip's RAM, above
  int data_bytes = 0;   ///< below the stack
  Cycle stack_at = 0;
  std::string stack_path;  ///< "main > drive | T2 > control_tick"
  std::vector<Function> functions;
  std::vector<Interrupt> interrupts;
  std::vector<std::string> by_heart;  ///< of these hal_sim knows the handlers: charged, but not measured
  std::vector<Wait> waits;

  /// Share of the time spent neither asleep nor waiting, 0 to 1.
  double load() const {
    return to > from ? 1 - static_cast<double>(slept + waited) / static_cast<double>(to - from) : 0;
  }
};

class Profile final : public StepWatch {
 public:
  /// All outlive this. `host`: who plays handlers (ChipRunner::host()); null: nobody.
  Profile(const dspic::FirmwareFile& file, const dspic::Processor& processor, dspic::Dspic30f6014a& device,
          const dspic::HostCalls* host);

  void after(const Step& step) override;
  void was_reset(Cycle at) override;
  ProfileReport report() const;

 private:
  enum class Kind : std::uint8_t { Unknown, Plain, Call, CallRegister, Return, Branch };
  /// The latest turn of a loop, where a wait is looked for. A function that is called may
  /// have waits of its own.
  struct Round {
    unsigned target = ~0u;
    std::array<std::uint16_t, 16> w{};
    std::int64_t writes = 0, steps = 0;  // of registers, and instructions, up to its end
    std::int64_t length = 0;             // instructions
    Cycle clock = 0, waited = 0;
    int trusted = 0;                // rounds that pass without a look at RAM
    int ignored = 0;                // rounds that are not looked at
    int failures = 0;               // in a row
    std::vector<std::uint8_t> ram;  // at its end; empty: not kept
    Cycle wait = 0, wait_at = -1;   // the wait that goes on, and when it began; -1: none
  };
  struct Frame {
    int function = 0;
    unsigned sp = 0;  // after the call
    Cycle began = 0;  // by the context's clock
    Cycle at = 0;     // by the robot's
    int caller = 0;
    Round round = {};
  };
  struct Context {
    int vector = dspic::kNoVector;
    Cycle clock = 0, waited = 0;
    Cycle at = 0;  // when it began
    std::vector<Frame> frames;
  };
  struct FunctionTally {
    Spread cycles;
    Cycle own = 0;
    int max_caller = 0;
    bool is_agenda = false;
  };
  struct Loop {
    Spread turn;
    Cycle last = -1;
    // of the branches that close it those behind which it only waited, as `while (1) while (!flag) ;` has one;
    // and the turns by the others
    std::set<unsigned> waits_by;
    Spread long_turn;
    Cycle long_last = -1;
    unsigned begin = 0, end = 0;
    std::size_t depth = 0;
    int pointers = -1;  // registers that form addresses in it; -1: not looked for
    Spread wait;
    Cycle polled = 0;  // of the waits: nothing counted
  };
  /// What a handler did that does not concern the round that it cuts.
  struct Cut {
    std::vector<std::uint8_t> ram;
    std::int64_t writes = 0, steps = 0;
  };
  struct InterruptTally {
    Spread cycles, latency, period;
    Cycle flagged = -1;
    std::int64_t missed = 0;
  };

  static constexpr int kNone = -1, kTooMany = -2;

  Kind kind_of(unsigned pc);
  std::string name_of(int function) const;
  int function_of(unsigned pc) const {
    if (dspic::is_host_place(pc)) return host_functions_[(pc - dspic::kHostStart) / 2];
    return function_of_[pc / 2 < function_of_.size() ? pc / 2 : 0];
  }
  int host_function_called(unsigned pc) const;
  Context& here() { return contexts_.back(); }
  void enter_handler(const Step& step);
  void leave_handler();
  void call(const Step& step, bool by_register);
  void call_agenda(const Step& step);
  void note_host_call(const Step& step, int function);
  void come_back(Context& context, unsigned sp);
  void finish(Context& context, const Frame& frame);
  void turn_loop(const Step& step);
  void look_for_wait(const Step& step);
  bool is_wait(const Step& step, Round& round, bool& counts);
  int changed_register(const Step& step, const Round& round);
  bool is_same_ram(const std::vector<std::uint8_t>& before, int counter, bool& counts) const;
  unsigned pointers_of(unsigned begin, unsigned end) const;
  void end_wait(Round& round);
  void watch_flags();
  void watch_stack(Cycle at);

  const dspic::FirmwareFile& file_;
  const dspic::Processor& processor_;
  dspic::Dspic30f6014a& device_;
  std::vector<Kind> kinds_;
  std::vector<std::int16_t> function_of_;  // by word; 0: none, else 1 + index
  std::vector<int> host_functions_;        // as above, by place of the host
  int handler_by_heart_ = 0;               // stands for it; behind the last function of the file
  std::vector<Context> contexts_;
  std::vector<FunctionTally> functions_;
  std::map<int, InterruptTally> interrupts_;
  std::map<unsigned, Loop> loops_;     // by their first instruction
  std::vector<Cut> cuts_;              // one a handler
  std::uint64_t flags_ = 0;            // enabled ones, as they were
  std::uint64_t served_by_heart_ = 0;  // flags, bit i of IRQ i, whose handlers the host plays
  Cycle from_ = -1, to_ = 0, in_handlers_ = 0, slept_ = 0, idle_before_ = 0;
  std::int64_t steps_ = 0;
  unsigned stack_base_ = 0, stack_top_ = 0;
  Cycle stack_at_ = 0;
  struct Nested {
    int vector;
    std::vector<int> functions;
  };
  std::vector<Nested> stack_path_;
};

}  // namespace chip
