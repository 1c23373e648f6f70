// SPDX-License-Identifier: MIT
// Resets, watchdog, oscillator and low-voltage detector: RCON, OSCCON, OSCTUN.
//
// Modelled: what each reset leaves in RCON, sticky bits, watchdog with both postscalers by FWDT or
// RCON.SWDTEN, unlock sequences of OSCCON's two bytes, COSC from FOSC, LVDL thresholds with BGST and
// LVDIF, RCON.SLEEP and IDLE, in which the watchdog wakes. Not modelled: another clock than the configured
// one (OSWEN is kept and clears itself), the postscaler POST, the fail-safe monitor, LPOSCEN, tuning,
// start-up times. Source: [chip C14], [chip C16], [chip P11], thresholds [DS70138G 23-10]; [?] OSCCON and
// LVDL after a reset.
#pragma once
#include <cstdint>

#include "dspic30/periph/fabric.h"

namespace dspic {

class SystemControl final : public SfrOwner, public EventOwner {
 public:
  SystemControl(const Fabric& fabric, std::uint16_t fosc, std::uint16_t fwdt)
      : f_(fabric), fosc_(fosc), fwdt_(fwdt) {}
  void attach();
  void reset(ResetKind kind, Cycle now);
  void outside_changed(Cycle now) { watch_supply(now); }
  void clear_watchdog(Cycle now);
  bool watchdog_bit() const { return bitten_; }
  /// Into Sleep, or Idle. From now on a time-out wakes instead (RCON.WDTO, woke()), until awake().
  void fall_asleep(bool sleep, Cycle now);
  bool woke() const { return woke_; }
  void awake() { asleep_ = woke_ = false; }
  /// Cycles from a clear to the time-out.
  Cycle watchdog_period() const;
  static constexpr std::uint16_t kSwdtenBit = sfr_bits("RCON", "SWDTEN");
  bool watchdog_runs() const { return (fwdt_ & 0x8000) || (rcon_ & kSwdtenBit); }

  std::uint16_t read(unsigned address, Cycle now) override { return peek(address, now); }
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  void on_event(int id, Cycle at) override;

 private:
  void write_osccon(std::uint16_t value, std::uint16_t lanes, Cycle now);
  void watch_supply(Cycle now);

  const Fabric& f_;
  std::uint16_t fosc_, fwdt_;
  int slot_ = -1;
  std::uint16_t rcon_ = 0, osccon_ = 0, osctun_ = 0;
  bool bitten_ = false;
  bool asleep_ = false, woke_ = false;
  // how far each byte's unlock sequence has come, and at which write of the bus
  struct Lock {
    int step = 0;
    std::int64_t at_write = 0;
  } low_, high_;
};

}  // namespace dspic
