// SPDX-License-Identifier: MIT
// Input capture IC1 to IC8 (RD8 to RD15) and output compare OC1 to OC8 (RD0 to RD7) on timers 2 and 3.
//
// Modelled: capture on every, falling, rising, fourth and sixteenth rising edge, four-deep FIFO, ICI, ICBNE,
// ICOV; compare modes 1 to 6 with OCxR, OCxRS, pin levels and flags, PWM reloading at the period. Not
// modelled: ICM = 7 (wake-up), ICSIDL, OCSIDL; OCM = 7's fault input (behaves as 6), ABAUD routing, capture
// of edges that the chip makes itself, and captures of a 32-bit pair. Source: [chip P9], pins [DS70286C].
#pragma once
#include <array>
#include <cstdint>

#include "dspic30/periph/timers.h"

namespace dspic {

inline constexpr int kCaptures = 8, kCompares = 8;

class InputCapture final : public SfrOwner, public EventOwner {
 public:
  InputCapture(const Fabric& fabric, Timers& timers) : f_(fabric), timers_(timers) {}
  void attach();
  void reset(Cycle now);
  void outside_changed(Cycle now);

  std::uint16_t read(unsigned address, Cycle now) override;
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;
  void on_event(int id, Cycle at) override;

 private:
  struct Unit {
    std::uint16_t con = 0;
    std::array<std::uint16_t, 4> words{};
    int waiting = 0;
    bool overflow = false;
    int since_interrupt = 0;
    int slot = -1;
  };
  void schedule(int n, Cycle after);
  void capture(Unit& u, int n, Cycle at);

  const Fabric& f_;
  Timers& timers_;
  std::array<Unit, kCaptures> units_{};
};

class OutputCompare final : public SfrOwner, public EventOwner, public TimerListener {
 public:
  OutputCompare(const Fabric& fabric, Timers& timers) : f_(fabric), timers_(timers) {}
  void attach();
  void reset(Cycle now);

  std::uint16_t read(unsigned address, Cycle now) override { return peek(address, now); }
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;
  void on_event(int id, Cycle at) override;
  void timer_changed(int timer, Cycle at) override;

 private:
  struct Unit {
    std::uint16_t con = 0, r = 0, rs = 0;
    bool high = false;
    bool done = false;       // single actions have happened
    std::uint16_t duty = 0;  // OCxR of the period that runs, PWM
    Cycle compared = -1;     // last tick dealt with
    int slot = -1;
  };
  static constexpr std::uint16_t kOctsel = sfr_bits("OC1CON", "OCTSEL");
  static constexpr SfrBits kOcm = sfr_field("OC1CON", "OCM");
  int timer(const Unit& u) const { return (u.con & kOctsel) ? 3 : 2; }
  static int mode(const Unit& u) { return static_cast<int>(kOcm.of(u.con)); }
  void schedule(int n, Cycle after);
  void drive(int n, bool high, Cycle at);

  const Fabric& f_;
  Timers& timers_;
  std::array<Unit, kCompares> units_{};
};

}  // namespace dspic
