// SPDX-License-Identifier: MIT
// A robot's own binary on the model of its chip, soldered to the board.
//
//   .hex or .elf --FirmwareFile--> flash --> dspic::Processor <--> SolderedChip <--> Board
//                                                    |                                 |
//                                                    '-------- api::HostLibrary -------'
//                                                    when it is linked with hal_sim: drivers known by heart
//
// Time is the chip's, exact to the cycle as far as docs/dev/chip.md says. Traps and resets are the chip's
// own: the program goes on at their vectors; a beginning that the program did not ask for is reported
// (endings.h), and so is what it makes of the library (library_calls.h). Lines, variables and types are those
// of the image's debug information; without it, functions and variables are known by name.
#pragma once
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "dspic30/core/course_watch.h"
#include "dspic30/core/processor.h"
#include "dspic30/core/program_watch.h"
#include "hal_sim/api/host_library.h"
#include "hal_sim/chip/chip_data.h"
#include "hal_sim/chip/chip_image.h"
#include "hal_sim/chip/endings.h"
#include "hal_sim/chip/library_calls.h"
#include "hal_sim/chip/memory_reports.h"
#include "hal_sim/chip/program_places.h"
#include "hal_sim/chip/soldered_chip.h"
#include "hal_sim/chip/step_watch.h"
#include "hal_sim/host/runner.h"

namespace chip {

using dspic::Cycle;

class ChipRunner final : public host::Runner,
                         private dspic::EventWatch,
                         private dspic::ProgramWatch,
                         private dspic::CourseWatch,
                         private api::CallWatch {
 public:
  /// `board` outlives the runner. `clock_factor`: the program's instruction rate over the usual one.
  /// `start`: when it is powered up. `seed`: of what RAM holds then, which is chance on the robot.
  ChipRunner(std::string name, std::shared_ptr<const ChipImage> image, double clock_factor,
             board::Board& board, Cycle start = 0, std::uint64_t seed = 0);

  void begin_window(Cycle now) override;
  void run_until(Cycle end) override;
  /// Whoever looks at each instruction sees those of waits, too.
  Cycle idle_until() const override {
    return !watches_.empty() && !processor_->is_asleep() ? 0 : idle_until_;
  }
  void pass_to(Cycle end) override;
  void add_hot(sim::HotMemory& memory) const override;
  std::uint64_t turns() const override { return turns_; }
  void wake() override {
    idle_until_ = 0;
    processor_->stir();
  }
  void remote_changed() override;
  void restart() override;
  void begin_again() override;

  Cycle cycles() const override { return end_; }
  Cycle idle_cycles() const override { return processor_->idle(end_); }
  Cycle waiting_since() const override { return processor_->waiting_since(); }
  bool has_stopped() const override { return !has_clock_; }
  const std::vector<host::TrapReport>& traps() const override { return traps_; }
  std::vector<board::Diagnosis> diagnoses() const override;
  std::uint64_t hash() const override;
  bool hashes_events() const override { return true; }

  host::ProgramData& data() const override { return *data_; }
  host::ChipView* chip() const override { return view_.get(); }

  void observe(host::Observer* observer) override;
  std::int64_t interrupts_served() const override;

  /// Tests change how it runs, and not what it does.
  dspic::Processor& processor() const { return *processor_; }
  dspic::Dspic30f6014a& device() const { return chip_.device(); }
  const std::shared_ptr<const ChipImage>& image() const { return image_; }
  /// Its flash as it is now: programs write it, the image stays.
  const dspic::ProgramMemory& program() const { return program_; }
  const drivers::Drivers* closed_drivers() const override {
    return library_ ? &library_->drivers() : nullptr;
  }
  /// Who plays handlers: registers of their timers and counts of the chip do not show those. Null: nobody.
  const dspic::HostCalls* host() const { return library_.get(); }
  /// `watch` sees every step from now on, or no longer. It outlives the runner or is taken away.
  void watch_steps(StepWatch* watch, bool on);

 private:
  void about_to_change(Cycle at) override { observer_->about_to_change(at); }
  void about_to_be_read(Cycle at) override {
    if (observer_->sees_registers) observer_->about_to_change(at);
  }
  void handler_begins(int vector, Cycle entry, Cycle first) override;
  void handler_ends(Cycle at) override;
  void waited(Cycle from, Cycle to) override { observer_->waited(from, to, device().interrupts().nesting()); }
  void program_eeprom();
  void fill_ram();
  void run_watched(Cycle end);
  void run_looked_at(Cycle end);
  void add_endless_wait(std::vector<board::Diagnosis>& all) const;
  void tell_reset(Cycle at);
  void tell_calls();
  void follow_agendas(unsigned address);
  void trapped(const dspic::TrapRecord& trap) override {
    chip_.digest().note(EventDigest::Kind::Trap, static_cast<std::uint64_t>(trap.trap) << 32 | trap.pc,
                        processor_->now());
    endings_->note_trap(trap);
  }
  void went_to_reset_vector(unsigned from) override;
  void came_to_start();
  void entered(unsigned address) override {
    if (address == start_) return came_to_start();
    if (observer_ && !library_) follow_agendas(address);
    if (!memory_ || !memory_->entered(address)) calls_->entered(address);
  }
  void called(api::HostFunction function) override { calls_->called(function); }
  void gives_up() override { gives_up_ = true; }
  void index_written(api::HostVariable index, unsigned value, int size) override {
    calls_->index_written(index, value, size);
  }
  void look_at_stack();
  void check_memory();
  void calls_back(unsigned function, Cycle at) override {
    if (observer_) observer_->callback(function, at);
  }
  void catch_up(Cycle now);
  void report(const Ending& ending, const std::vector<unsigned>& callers = {});
  bool is_ending(const board::Diagnosis& diagnosis) const;
  std::string comment(const dspic::Diagnosis& diagnosis) const;
  void reset(dspic::ResetKind kind);
  void note_own_reset(Cycle at);

  std::shared_ptr<const ChipImage> image_;
  const dspic::FirmwareFile& file_;
  board::Board& board_;
  mutable SolderedChip chip_;  // looking advances closed forms
  dspic::ProgramMemory program_;
  std::unique_ptr<api::HostLibrary> library_;  // null: all drivers are the image's own
  std::unique_ptr<dspic::Processor> processor_;
  std::unique_ptr<ProgramPlaces> places_;
  std::unique_ptr<Endings> endings_;
  std::unique_ptr<LibraryCalls> calls_;
  std::unique_ptr<ChipData> data_;
  std::unique_ptr<host::ChipView> view_;
  std::unique_ptr<MemoryReports> memory_;              // null: the image was not built to be checked
  unsigned start_ = 0;                                 // where the reset vector leads; 0: not by a GOTO
  Cycle null_told_at_ = -1;                            // a jump to address 0
  unsigned plain_from_ = dspic::Processor::kRamStart;  // plain RAM begins there
  std::vector<host::TrapReport> traps_;
  std::vector<StepWatch*> watches_;
  Cycle end_ = 0, idle_until_ = 0;
  bool runs_ = false;                // run_until() has begun and not ended
  std::set<std::uint32_t> agendas_;  // functions, and where they return to; of an observer's, with hal_dspic
  unsigned agenda_returns_to_ = 0;   // of the one that runs
  int open_handlers_ = 0, agenda_depth_ = 0;      // how many when it was called
  mutable Cycle asked_since_ = dspic::kNever;     // the wait that was looked at last
  mutable std::optional<board::Diagnosis> wait_;  // what is told of it
  struct OwnResets {                              // by the program's own RESET
    std::int64_t count = 0;
    Cycle first = 0;
    unsigned last_place = 0;
  } own_resets_;
  std::uint64_t turns_ = 0;
  std::uint64_t seed_;     // of RAM at power-up
  bool has_clock_ = true;  // by its configuration words
  bool gives_up_ = false;  // the reset that comes is the library's
};

}  // namespace chip
