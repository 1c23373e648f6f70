// SPDX-License-Identifier: MIT
// The processor of the native way: the library's drivers run as closed forms on the board, and what is left
// of the chip is registers.h and interrupts.h.
#pragma once
#include <vector>

#include "hal_sim/drivers/drivers.h"
#include "hal_sim/host/interrupts.h"
#include "hal_sim/host/processor.h"
#include "hal_sim/host/registers.h"

namespace host {

class NativeProcessor final : public Processor {
 public:
  explicit NativeProcessor(CompiledRunner& runner);

  const char* way() const override { return "native"; }
  void power_up() override { registers_.power_up(); }
  void reset(Cycle now) override;
  void note_reset(ResetCause cause) override;
  void stop(Cycle now) override { registers_.processor_stopped(); }
  void remote_changed(Cycle now) override { watch_remote(now); }

  std::int64_t read(unsigned address, unsigned bits) override { return registers_.read(address, bits); }
  void write(unsigned address, std::uint16_t value, unsigned bits, Cycle) override {
    registers_.write(address, value, bits);
  }

  void modify(unsigned address, std::uint16_t keep, std::uint16_t flip) override;

  std::uint16_t table_read(unsigned, Cycle) override { registers_.refuse_table(); }
  void table_write(unsigned, std::uint16_t, Cycle) override { registers_.refuse_table(); }

  Outlook look(Cycle now) override;
  Outlook take(Cycle now, Entry& entry) override;
  Entry enter(int vector, Cycle now) override;
  Return leave(Cycle now) override;
  int cpu_level() const override { return cpu_level_; }
  void set_cpu_level(int level, Cycle now) override {
    cpu_level_ = level;
    follow_mask(now);
  }
  Waiting longest_waiting(Cycle now) override;
  void disi(Cycle cycles, Cycle now) override;
  bool wakes(Cycle now) override { return look(now).vector >= 0; }

  bool flag(int vector, Cycle at) override;
  Cycle flag_horizon(int vector, Cycle at) override;
  Cycle flag_since(int vector) override { return interrupts_.source(vector).flag_since; }

  InterruptController& interrupts() { return interrupts_; }
  drivers::Drivers& drivers() { return drivers_; }
  bool disi_active(Cycle now) const { return now < disi_until_; }
  /// Does the program keep the drivers' handlers that are not run from coming?
  bool masks_handlers() const { return masked_; }
  /// INTCON2.INT0EP was written: external interrupt 0 waits for the other edge.
  void int0_polarity_changed(Cycle now) { interrupts_.refresh_int0(now); }

 private:
  void watch_remote(Cycle now);
  /// After a change of level or DISI: do the handlers that are not run still come?
  void follow_mask(Cycle now);

  CompiledRunner& runner_;
  drivers::Drivers drivers_;
  InterruptController interrupts_;
  NativeRegisters registers_;
  int cpu_level_ = 0;
  Cycle disi_until_ = 0;
  bool masked_ = false;
  std::vector<int> outer_levels_;
};

}  // namespace host
