// SPDX-License-Identifier: MIT
// What the debugger's core asks of whatever executes a robot's program: where it stands, what its memory
// holds, and to be stopped. Two answers exist: ChipMachine, which sees every instruction of the chip, and
// PcMachine, whose code is the PC's (native and register way).
//
//   Session (breakpoints, steps, ways back) --Look--> Machine --before(cycle)--> Session
//
// Addresses of code are those of the image's debug information; those of data are the program's pointers.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dspic30/load/firmware_file.h"
#include "hal_sim/chip/step_watch.h"
#include "hal_sim/host/runner.h"

namespace debug {

using dspic::Cycle;
using Address = std::uint64_t;

/// One level of calls.
struct Frame {
  std::uint32_t pc = 0;
  std::uint32_t call = 0;  ///< of the instruction that is under way: pc, or the call before it
  Address base = 0;        ///< grows with each call
  const dspic::CodeMap::Function* function = nullptr;
  bool is_handler = false;
};

/// A place in data.
struct Data {
  Address address = 0;
  unsigned bytes = 2;
  int bit = 0, width = 0;    ///< of a register's field or a bit-field; width 0: all of it
  bool is_register = false;  ///< of a chip whose registers do not lie in the program's memory
};

/// Which instructions somebody wants to see.
enum class Look {
  Nothing,
  Breakpoints,
  Leaving,  ///< those, and the first one behind the function that runs
  Everything,
};

class Watcher : public chip::StepWatch {
 public:
  /// What to look at next; asked after each before().
  virtual Look look() = 0;
};

class Machine {
 public:
  virtual ~Machine() = default;

  virtual host::Runner& runner() const = 0;
  const std::string& name() const { return runner().name(); }
  /// Functions, lines, names and types; the words only of the chip.
  virtual const dspic::FirmwareFile& file() const = 0;

  // --- being stopped. On the world's thread, between two windows
  /// `watcher` sees from now on what its look() says, or no longer. It outlives the machine or is taken away.
  virtual void watch(Watcher* watcher, bool on) = 0;
  /// Where the breakpoints are.
  virtual void mark(const std::vector<std::uint32_t>& addresses) {}
  /// A window has ended. Is the program's place between two windows one to stop at?
  virtual bool stands_between() { return false; }

  // --- where it stands
  virtual Cycle now() const = 0;
  virtual std::uint32_t pc() const = 0;
  /// Of the function that runs; 0: not known.
  virtual Address base() = 0;
  virtual int nesting() const = 0;  ///< handlers that are under way
  virtual std::vector<Frame> frames() = 0;
  /// How many cycles before it are looked at first when it goes back; then ever more.
  virtual Cycle first_look_back() const = 0;
  /// Will this instruction, which has just run, run again at once (REPEAT)?
  virtual bool repeats(const chip::Step& step) const { return false; }

  // --- its code
  virtual bool is_code(std::uint32_t address) const = 0;
  virtual std::uint32_t code_end() const = 0;
  /// Of a function: where its parameters have their places.
  virtual std::uint32_t body_of(std::uint32_t function) const { return function; }
  /// Does a run begin in main(), because nothing before it is the program's?
  virtual bool begins_in_main() const { return false; }
  /// Has main() not been called yet?
  virtual bool is_starting_up() { return false; }
  /// The instruction at an address as text; empty: that is not known here. `next`: the one behind it.
  virtual std::string instruction(std::uint32_t address, std::uint32_t& next) const = 0;

  // --- its data
  /// Value of what the image's debug information calls address 0.
  virtual Address data_base() const { return 0; }
  virtual Address address_mask() const { return ~Address{0}; }
  /// False: there is nothing, or it cannot be written.
  virtual bool read(const Data& data, void* to) const = 0;
  virtual bool write(const Data& data, const void* from) = 0;
  /// A register of the processor by its number in the debug information, where it has an address, and its
  /// value.
  virtual std::optional<Data> register_data(int number) const { return {}; }
  virtual Address register_value(int number) const = 0;
  /// A register by name: of the processor, or REG, REG.FIELD and REGbits.FIELD of the chip.
  virtual std::optional<Data> find_register(const std::string& name) const = 0;

  // --- for people
  virtual std::string registers() const = 0;
  virtual std::vector<std::pair<std::string, std::string>> register_list() const = 0;
  /// What the program waits for, who could set it, what is pending but held off.
  virtual std::string why() = 0;
  /// Enabled or pending interrupts with their priorities, a line each.
  virtual std::string interrupts() = 0;
};

/// A register of the chip, by its table.
std::optional<Data> find_sfr(const std::string& name);
/// "T2: enabled, priority 4 above the processor's 0, flag clear"
std::string told_interrupt(const std::string& name, bool flag, bool enabled, int priority, int level,
                           bool is_held_by_disi);
/// Of a timer's interrupt, "T1": "; timer 1 is off (T1CON.TON = 0)", or nothing. `word`: of a register.
std::string told_timer(const std::string& name, const std::function<unsigned(unsigned address)>& word);

}  // namespace debug
