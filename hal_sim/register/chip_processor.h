// SPDX-License-Identifier: MIT
// The register way's processor: every register access and every interrupt of a compiled program goes to the
// models of the dsPIC30F6014A, on the same board and world as the native way.
//
//   compiled C --tp_sfr_read/write--> ChipProcessor --> chip::SolderedChip --> Board
//
// Time is the CompiledRunner's: estimated costs of blocks, plus what the chip adds (interrupt entry and
// RETFIE). A loop that polls registers is jumped over to the chip's horizon of what it has read. Modelled:
// everything dspic30/ models, the program's configuration words FOSC and FWDT. Not modelled: the other words,
// Sleep's stopped clocks, wait states; see docs/limits.md, "The processor".
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/chip/soldered_chip.h"
#include "hal_sim/host/compiled_runner.h"
#include "hal_sim/host/processor.h"

namespace register_way {

using host::Cycle;

/// Does an image of these flags (tp_image.flags) want this processor?
bool wants_chip(const char* image_flags);

class ChipProcessor final : public host::Processor, private dspic::EventWatch {
 public:
  /// `robot` owns this.
  explicit ChipProcessor(host::CompiledRunner& runner);

  const char* way() const override { return "register"; }
  void power_up() override;
  void reset(Cycle now) override;
  void note_reset(host::ResetCause cause) override;
  void stop(Cycle now) override { chip_.stop(now); }
  bool begin_window(Cycle now) override { return chip_.begin_window(now); }
  void end_window(Cycle now) override { chip_.end_window(now); }
  void remote_changed(Cycle now) override { device().outside_changed(at(now)); }

  std::int64_t read(unsigned address, unsigned bits) override;
  void write(unsigned address, std::uint16_t value, unsigned bits, Cycle now) override;
  void modify(unsigned address, std::uint16_t keep, std::uint16_t flip) override;
  std::uint16_t table_read(unsigned program_address, Cycle now) override;
  void table_write(unsigned program_address, std::uint16_t value, Cycle now) override;
  void watch_reads(Cycle now) override { watched_reads_ = kWatchedReads; }
  bool print(const char* bytes, std::int64_t length, int uart) override;

  Outlook look(Cycle now) override;
  bool serve(Cycle now) override;
  Outlook take(Cycle now, Entry& entry) override;
  const char* why_reset() const override { return why_reset_; }
  Entry enter(int vector, Cycle now) override;
  Return leave(Cycle now) override;
  int cpu_level() const override { return chip_.device().cpu_level(); }
  void set_cpu_level(int level, Cycle now) override { device().set_cpu_level(level, at(now)); }
  Waiting longest_waiting(Cycle now) override;

  void disi(Cycle cycles, Cycle now) override { device().disi(static_cast<unsigned>(cycles), at(now)); }
  void clear_watchdog(Cycle now) override { device().clear_watchdog(at(now)); }
  void power_save(bool sleep, Cycle now) override { device().power_save(sleep, at(now)); }
  bool wakes(Cycle now) override { return device().wakes(at(now)); }

  bool flag(int vector, Cycle at) override;
  Cycle flag_horizon(int vector, Cycle at) override;
  Cycle flag_since(int vector) override;
  void observe(host::Observer* observer) override;

  void carry_out(Cycle at) override { device().run_events(at); }
  std::uint16_t peek(unsigned address, Cycle at) override { return device().peek(address, at); }
  Cycle horizon(unsigned address, Cycle at) override { return device().horizon(address, at); }
  std::int64_t served(int vector) const override {
    return chip_.device().served_interrupts(vector + dspic::kFirstIrqVector);
  }
  std::vector<board::Diagnosis> diagnoses() const override { return chip_.diagnoses(); }

 private:
  void about_to_change(Cycle at) override;

  /// read() of a register that a read changes, or within a loop that waits.
  std::uint16_t read_closely(unsigned address, unsigned bits, Cycle t);
  /// Rounds of a waiting loop with more reads than this are not jumped over.
  static constexpr int kWatchedReads = 64;

  /// read() within a loop that waits, or while an observer hears of it.
  __attribute__((noinline)) std::int64_t read_watched(unsigned address, unsigned bits);
  /// read() of all but the converter's results.
  __attribute__((noinline)) std::int64_t read_other(unsigned address, unsigned bits, Cycle t);
  __attribute__((noinline)) void modify_other(unsigned address, std::uint16_t keep, std::uint16_t flip,
                                              Cycle t);
  static bool may_change_it(unsigned address);
  Outlook outlook_of(const dspic::Outlook& chip);
  Entry enter_at(int number, Cycle t);
  Return left(Cycle now);
  /// A write has happened at latest_; `horizon`: what the chip said of it.
  void wrote(Cycle horizon);

  Cycle at(Cycle now) { return chip_.at(now); }
  dspic::Dspic30f6014a& device() { return chip_.device(); }

  host::CompiledRunner& runner_;
  chip::SolderedChip chip_;
  dspic::ChipParts* parts_ = nullptr;  // of chip_
  const char* why_reset_ = "";
  host::Observer* observer_ = nullptr;
  int watched_reads_ = 0;
};

}  // namespace register_way
