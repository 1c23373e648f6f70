// SPDX-License-Identifier: MIT
// Stops compiled code of the PC at its instructions: breakpoints (int3) and the processor's trap flag, which
// come as SIGTRAP to the thread that runs the program. The world stands in the signal's handler.
//
//   program --call--> host --handler, return--> program
//   seen           not seen, at full speed     seen again
//
// While the program is in the host, it is caught again at the beginning of each of its functions, for the
// host calls its handlers, and where the host's function returns to. Frames are linked through the frame
// pointer, which host and program keep. The code can be written only while a breakpoint is put in or taken
// out, so what a wild pointer does is the same as without a debugger.
// Source: Intel 64 manual, volume 3, 17.3 (debug exceptions).
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "hal_sim/debug/machine.h"
#include "hal_sim/host/compiled_runner.h"
#include "hal_sim/host/faults.h"

namespace debug {

class Stepper final : public host::StepGuest {
 public:
  /// Where code stands: addresses in memory.
  struct Place {
    std::uintptr_t pc = 0, sp = 0, frame = 0;
    bool is_call = false;  ///< in a call of the host; pc is within the calling instruction
  };
  /// Told of each instruction of the program's functions before it runs; not of the image's own, between them
  /// and the host. May block; says what to look at next.
  using Reached = std::function<Look(const Place&, void* context)>;

  /// `map`: of the program's code, from its base on.
  Stepper(host::CompiledRunner& runner, const dspic::CodeMap& map, Reached reached);
  ~Stepper() override;  ///< the code is as it was

  /// On the program's thread while it is between two windows: from now on.
  void begin(Look look);
  /// Breakpoints, from the next begin() or answer of `reached` on.
  void mark(std::vector<std::uintptr_t> addresses);
  /// Where the program is between two windows, or was when a fault ended it; none: it has not begun.
  std::optional<Place> place_between() const;

  /// Stack pointer before the call of the function at a place.
  std::uintptr_t frame_end(const Place& place) const;
  /// The calls that led to a place: return addresses of the program's code. `by_host`: the frame below was
  /// called by the host.
  struct Caller {
    Place place;
    bool by_host = false;
  };
  std::vector<Caller> callers(const Place& place, std::size_t most) const;
  /// In a function of the program?
  bool is_told(std::uintptr_t pc) const;

  bool take(int code, void* context) override;
  void note_fault(void* context) override;

 private:
  enum class At { Beginning, Pushed, Body, Return };
  class Writable;
  At at(const Place& place) const;
  std::uintptr_t word(std::uintptr_t address) const;
  unsigned char byte(std::uintptr_t address) const;
  void put(std::uintptr_t address, unsigned char byte);
  bool owns(std::uintptr_t pc) const { return runner_.owns_code(pc); }
  std::optional<Place> innermost(std::uintptr_t frame) const;
  void look_for(Look look, const std::optional<Place>& place);
  bool is_for_another(const Place& place) const;
  void insert(std::vector<std::uintptr_t> addresses);
  void lift(std::uintptr_t address, void* context);  // for one instruction
  void put_back();
  void step_off(const Place& place, void* context);
  void follow_host(const Place& place);
  void wait_for_host(std::uintptr_t back);
  void forget_host();

  host::CompiledRunner& runner_;
  const dspic::CodeMap& map_;
  Reached reached_;
  std::uintptr_t base_, code_begin_;
  std::size_t code_bytes_;
  std::vector<std::uintptr_t> marks_, beginnings_;    // sorted
  std::vector<std::uintptr_t> frames_made_;           // of the map's functions: where
  std::map<std::uintptr_t, unsigned char> inserted_;  // breakpoints in the code, and what was there
  std::uintptr_t lifted_ = 0;                         // one that is passed over now
  bool is_passing_ = false;                           // one instruction; nobody asked to see the next
  Look look_ = Look::Nothing;
  std::uintptr_t last_ = 0;         // Look::Everything: the instruction before
  std::uintptr_t host_return_ = 0;  // ... and where the host returns to, if a breakpoint was put in for it
  std::optional<Place> exit_;       // Look::Leaving: the instruction, and the least stack pointer there
  std::optional<Place> fault_;      // the last one
  std::uint64_t fault_turn_ = 0;
  static constexpr std::uint64_t kNoTurn = ~std::uint64_t{0};
  std::uint64_t begun_turn_ = kNoTurn;  // of the last begin()
};

}  // namespace debug
