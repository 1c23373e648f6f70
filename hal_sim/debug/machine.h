// SPDX-License-Identifier: MIT
// A robot's program as the debugger sees it: where it stands and what its memory holds, read from the model
// of the chip and the image's code.
//
//   Session (breakpoints, steps, ways back) ---> Machine ---> chip::ChipRunner
//
// Addresses of code are the chip's program addresses; those of data its 64 KB.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal_sim/chip/chip_runner.h"
#include "hal_sim/debug/code.h"

namespace debug {

inline constexpr Address kAddressMask = 0xFFFF;  ///< of data

class Machine {
 public:
  /// `runner` outlives it.
  explicit Machine(chip::ChipRunner& runner) : runner_(runner), code_(runner.image()->file()) {}

  chip::ChipRunner& runner() const { return runner_; }
  const std::string& name() const { return runner_.name(); }
  /// Words, functions, lines, names and types.
  const dspic::FirmwareFile& file() const { return runner_.image()->file(); }
  Code& code() { return code_; }

  /// `watcher` sees each step from now on, or no longer. It outlives the machine or is taken away. Between
  /// two windows, on the world's thread. True: it did not before.
  bool watch(chip::StepWatch* watcher, bool on);
  bool is_watched() const { return is_watched_; }

  // --- where it stands
  Cycle now() const { return runner_.processor().now(); }
  std::uint32_t pc() const { return runner_.processor().pc(); }
  /// Grows with each call; of the function that runs; 0: not known.
  Address base();
  int nesting() const { return runner_.device().interrupts().nesting(); }  ///< handlers that are under way
  std::vector<Frame> frames();
  /// Has main() not been called yet?
  bool is_starting_up();
  /// Will this instruction, which has just run, run again at once (REPEAT)?
  bool repeats(const chip::Step& step) const;

  // --- its code
  bool is_code(std::uint32_t address) const { return address < dspic::kFlashEnd && address % 2 == 0; }
  static constexpr std::uint32_t code_end() { return dspic::kFlashEnd; }
  /// Where a function that begins there has its arguments in their places; one that is answered for the program
  /// goes nowhere else.
  std::uint32_t body_of(std::uint32_t begin) const;
  /// The instruction at an address as text; empty: there is none. `next`: the one behind it.
  std::string instruction(std::uint32_t address, std::uint32_t& next) const;

  // --- its data
  void read(const Data& data, void* to) const;
  /// False: it cannot be written.
  bool write(const Data& data, const void* from);
  unsigned word(Address address) const;
  /// A register of the processor by its number in the debug information: its place.
  static Data register_data(int number) { return {2 * static_cast<Address>(number)}; }
  /// A register by name: of the processor, or REG, REG.FIELD and REGbits.FIELD of the chip.
  static std::optional<Data> find_register(const std::string& name);

  // --- for people
  std::string registers() const;
  std::vector<std::pair<std::string, std::string>> register_list() const;
  /// What the program waits for, who could set it, what is pending but held off.
  std::string why();
  /// Enabled or pending interrupts with their priorities, a line each.
  std::string interrupts();

 private:
  chip::ChipRunner& runner_;
  Code code_;
  bool is_watched_ = false;
};

/// A register of the chip, by its table.
std::optional<Data> find_sfr(const std::string& name);
/// "T2: enabled, priority 4 above the processor's 0, flag clear"
std::string told_interrupt(const std::string& name, bool flag, bool enabled, int priority, int level,
                           bool is_held_by_disi);
/// Of a timer's interrupt, "T1": "; timer 1 is off (T1CON.TON = 0)", or nothing. `word`: of a register.
std::string told_timer(const std::string& name, const std::function<unsigned(unsigned address)>& word);

}  // namespace debug
