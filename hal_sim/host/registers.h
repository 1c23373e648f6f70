// SPDX-License-Identifier: MIT
// The special-function registers that natively run firmware may touch beside the e_* API: ports, timers 1 to
// 5, interrupt control, RCON and SR. Reached through tp_sfr_read / tp_sfr_write.
//
// Modelled: TRIS/PORT/LAT of all ports (on the board), Timer 1 to 5 with internal clock and prescaler,
// IFS/IEC/IPC, INTCON1.NSTDIS, INTCON2.DISI, DISICNT, SR.IPL, RCON. Kept but without effect: ADPCFG, CORCON,
// PSVPAG, TBLPAG, PMD1, PMD2, CNPU1, CNPU2, CNEN1, CNEN2, OSCTUN. Not modelled: gated, external-clock and
// 32-bit timers, every other peripheral: the first touch is a trap that names the register. Source: DS70143
// sections 5, 8 and 9 to 11.
#pragma once
#include <array>
#include <cstdint>
#include <map>

#include "hal_sim/host/context.h"

namespace host {

class CompiledRunner;
class NativeProcessor;

class NativeRegisters {
 public:
  NativeRegisters(CompiledRunner& runner, NativeProcessor& processor)
      : runner_(runner), processor_(processor) {}

  void power_up();         ///< everything at power-on reset values, RCON = POR | BOR
  void processor_reset();  ///< same, but RCON keeps what a software reset keeps
  void note_software_reset();
  void note_reset_button();
  void processor_stopped();  ///< a trapped robot: motors and drivers off

  /// Byte address, width 8 or 16; result in the low bits. Unmodelled registers trap.
  std::uint16_t read(unsigned address, unsigned bits);
  void write(unsigned address, std::uint16_t value, unsigned bits);

  /// A table instruction in a program of the native way: a trap that says what to do.
  [[noreturn]] void refuse_table() const;

  bool int0_on_falling_edge() const { return (intcon2_ & 1) != 0; }
  bool nesting_disabled() const { return (intcon1_ & 0x8000) != 0; }

 private:
  struct Timer {
    std::uint16_t con = 0;
    std::uint16_t pr = 0xFFFF;
    std::uint16_t count = 0;  // TMR at cycle `since`
    Cycle since = 0;
  };

  std::uint16_t read_word(unsigned address);
  void write_word(unsigned address, std::uint16_t value);
  [[noreturn]] void refuse(unsigned address, const char* what) const;

  Timer* timer_at(unsigned address, int& which);
  Cycle prescale(const Timer& t) const;
  bool runs(const Timer& t) const { return (t.con & 0x8000) != 0; }
  std::uint16_t count_at(const Timer& t, Cycle at) const;
  void settle(Timer& t, Cycle at);
  void schedule(int number);

  CompiledRunner& runner_;
  NativeProcessor& processor_;
  std::array<Timer, 5> timers_;
  std::uint16_t rcon_ = 0;
  std::uint16_t intcon1_ = 0;
  std::uint16_t intcon2_ = 0;
  std::map<unsigned, std::uint16_t> kept_;
};

}  // namespace host
