// SPDX-License-Identifier: MIT
// What a program makes of the e-puck library, seen where its functions begin: arguments out of range,
// what was never started, a speed that moves nothing. Functions are known by the image's symbols (also
// of the other forms of a driver, whose labels our headers give a prefix), so images without symbols are
// not watched. A call that is right costs the PC a look; nothing else in the program does, and nothing
// of its course changes.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "dspic30/load/firmware_file.h"
#include "hal_sim/api/host_index.h"
#include "hal_sim/board/board.h"
#include "hal_sim/chip/program_places.h"

namespace chip {

class LibraryCalls final {
 public:
  /// Where the library's functions lie in an image; for all robots that run it.
  class Functions;
  /// All of them outlive this.
  LibraryCalls(const Functions& functions, const dspic::Processor& processor, const ProgramPlaces& places,
               SolderedChip& chip, const board::Board& board);

  /// The function at `address` begins.
  void entered(unsigned address);
  /// Where the function that begins will return to; 0: unknown.
  unsigned return_address() const;
  /// A function of the host is called.
  void called(api::HostFunction function);
  /// The program has written an index of the library's that leads out of its array of `size`.
  void index_written(api::HostVariable index, unsigned value, int size);
  /// W15 leaves no room between `least` and `limit` for the `pushed` bytes of an interrupt.
  void stack_out_of_range(unsigned stack, unsigned least, unsigned limit, unsigned pushed);
  /// A reset, or a jump to address 0: everything is to be started again.
  void forget_starts();
  /// To be called from time to time, at least each second: does the robot stand?
  void look(Cycle now);
  /// The next look is due then.
  Cycle next_look() const { return next_look_; }
  std::vector<board::Diagnosis> diagnoses(Cycle now) const;

 private:
  enum class Function : std::uint8_t;
  struct Known;
  static const Known kKnown[];
  struct Site {
    const Known* known = nullptr;
    std::string prefix;     // of the form of the driver
    bool is_whole = false;  // e_set_speed() calls no function for each wheel
  };
  struct Wheel {
    int speed = 0;           // steps/s, as asked for
    Cycle since = 0;         // when it began to be other than 0, or the wheel was last seen to turn
    std::int64_t steps = 0;  // at that time
    unsigned place = 0;      // of the call that set it
    // since the last look: calls that set the same speed, or that there was another
    int again = 0;
    bool is_steady = false;
    std::int64_t looked_steps = 0;
  };
  void look_for_slow(int wheel, std::int64_t steps, double span_s);
  void look_for_dark_emitters(Cycle now);
  bool is_told(const char* cause, const std::string& place) const;

  void note(const std::string& cause, const std::string& place, const std::string& message,
            const std::string& hint);
  /// The same of any place in the program.
  void note_at(const std::string& cause, const std::string& place, const std::string& message,
               const std::string& hint);
  void note_range(const Site& site, const std::string& what, int got, int least, int most,
                  const std::string& then);
  static bool starts(Function f);
  bool is_right(const Site& site) const;
  void set_speed(const Site& site, int wheel, int speed);
  void activate_agenda(const Site& site);
  static unsigned bit(Function f) { return 1u << static_cast<unsigned>(f); }
  bool has_started(Function f) const { return (started_ & bit(f)) != 0; }
  bool is_of_agendas(const Site& site) const { return site.prefix.empty(); }
  std::int64_t steps_of(int wheel, Cycle now) const;
  std::string where() const;
  unsigned caller() const;

  const Functions& functions_;
  const dspic::Processor& processor_;
  const ProgramPlaces& places_;
  SolderedChip& chip_;
  const board::Board& board_;
  unsigned started_ = 0;  // functions that start something, a bit each
  std::array<Wheel, 2> wheels_;
  Cycle first_speed_ = -1;  // of one that agendas shall turn into steps
  unsigned first_speed_at_ = 0;
  std::int64_t first_steps_ = 0;                       // of both wheels, then
  std::map<unsigned, board::Diagnosis> idle_agendas_;  // by function, until they get a period
  std::vector<board::Diagnosis> diagnoses_;
  Cycle looked_at_ = 0, next_look_ = 0;
};

class LibraryCalls::Functions {
 public:
  explicit Functions(const dspic::FirmwareFile& file);
  /// Those that LibraryCalls wants to hear of, in order.
  const std::vector<std::uint32_t>& addresses() const { return addresses_; }
  /// Is it e_activate_agenda()? The agenda's function is in W0 then.
  bool activates_agenda(unsigned address) const;

 private:
  friend class LibraryCalls;
  static std::size_t slot_of(unsigned address) {
    return dspic::is_host_place(address) ? (address - dspic::kHostStart) / 2
                                         : dspic::kMostHostFunctions + address / 2;
  }
  /// What is known of the function at an address; null: nothing.
  const Site* at(unsigned address) const {
    const std::size_t slot = slot_of(address);
    return slot < by_slot_.size() ? by_slot_[slot] : nullptr;
  }
  /// Did the program bring it itself? Such a function is the program's own affair, where lines tell; but it
  /// starts what it says. Several threads may ask.
  bool is_own(unsigned address) const;

  const dspic::FirmwareFile& file_;
  std::map<unsigned, Site> sites_;  // by address; of the host's functions the place beyond the flash
  mutable std::once_flag own_once_;
  mutable std::set<unsigned> own_;  // of sites_, found when one is entered: lines are read for it
  std::set<unsigned> motors_;       // the library's own agendas
  std::vector<std::uint32_t> addresses_;
  std::vector<const Site*> by_slot_;
};

}  // namespace chip
