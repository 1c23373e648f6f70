// SPDX-License-Identifier: MIT
// The dsPIC30F6014A without its processor core: all peripherals, their registers and the interrupt
// controller, at one virtual time. The core uses it (dspic30/core).
//
//   program --read/write--> SfrBus --> peripherals --flags--> interrupt controller --pending--> program
//                                        |  ^
//                                        v  |  Outside: pins, volts, bytes
//
// Nothing is ticked: every peripheral knows its next instant, and reads between two instants are closed
// forms. Times in instruction cycles (memory/cycle.h); `now` never goes back from one call to the next. One
// object is used by one thread at a time. Deterministic: the same calls give the same answers.
//
// Not modelled as a whole: the processor core, program memory, Sleep and Idle beyond timers and what wakes,
// other clocks than the configured one. Each file of periph/ says what it leaves out. Source: [chip C],
// [chip P], see docs/dev/sources.md.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "dspic30/device/chip_interrupts.h"
#include "dspic30/memory/cycle.h"
#include "dspic30/memory/diagnosis.h"
#include "dspic30/periph/outside.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

class EepromMemory;  // nvm.h
class EventWatch;
class ProgramMemory;
struct ChipParts;

/// Configuration words and what else is fixed while the chip is powered. Defaults are the e-puck's.
struct Configuration {
  std::uint16_t fosc = 0xFFE6;      ///< XT with PLL x8, no clock switching
  std::uint16_t fwdt = 0x7FFF;      ///< watchdog off, postscalers 1:512 and 1:16 when RCON.SWDTEN turns it on
  double fcy_hz = 14745600;         ///< instruction cycles a second: for times given in seconds, baud rates
  bool warn_uninitialised = false;  ///< report reads of registers with an undefined power-on value
  /// The data EEPROM, which outlives the chip; null: its own, blank.
  EepromMemory* eeprom = nullptr;
  /// Flash, which the chip may program itself and which outlives it; null: there is none.
  ProgramMemory* program = nullptr;
};

/// What the processor has to do at an instruction boundary, and when to ask again.
struct Outlook {
  int vector = kNoVector;  ///< to serve now
  int level = 0;           ///< the CPU's
  bool disi = false;       ///< priorities 1 to 6 are held off
  bool reset_due = false;  ///< reset_due() says which
  Cycle horizon = 0;       ///< next_event()
};

class Dspic30f6014a {
 public:
  /// `outside` and `sink` (may be null) outlive the chip. Powers up at cycle 0, and so asks and tells
  /// `outside` already here.
  explicit Dspic30f6014a(Outside& outside, DiagnosticSink* sink = nullptr,
                         const Configuration& configuration = {});
  ~Dspic30f6014a();
  Dspic30f6014a(const Dspic30f6014a&) = delete;
  Dspic30f6014a& operator=(const Dspic30f6014a&) = delete;

  /// Registers to their reset values, RCON told why, pins to inputs. EEPROM and diagnoses stay.
  void reset(ResetKind kind, Cycle now);

  // --- registers

  /// Byte address 0x000 to 0x7FF; bits 8 or 16 (a word access ignores address bit 0; the address error of an
  /// odd one is the core's). Result in the low bits. Addresses with nothing behind them read 0.
  std::uint16_t read(unsigned address, unsigned bits, Cycle now);
  /// Returns the instant with which whoever remembers next_event() has to compare it: the earlier one of both
  /// is true now; 0, or in the past: ask again.
  Cycle write(unsigned address, std::uint16_t value, unsigned bits, Cycle now);
  /// The register's value as a debugger shows it: no FIFO moves, no flag falls, no latch is loaded.
  std::uint16_t peek(unsigned address, Cycle now);
  /// Until when a read of that register gives the same value, if the program writes nothing and no interrupt
  /// handler runs: > now, kNever if it cannot change by itself. Never too late; may be too early.
  Cycle horizon(unsigned address, Cycle now);
  /// "T2CON"; nullptr where nothing is.
  static const char* register_name(unsigned address);

  // --- time

  /// Everything that happens up to and in cycle `now` has happened. Call it before the outside changes.
  void run_to(Cycle now);
  /// What has instants of its own has happened up to `now`; closed forms can still be peeked at in between.
  void run_events(Cycle now);
  /// Whoever draws registers over time; hears of every such instant. Null: nobody. Outlives the chip or is
  /// taken away; changes nothing.
  void watch(EventWatch* watch);
  /// Earliest cycle >= now + 1 at which pending() or reset_due() may answer something new, or an output pin
  /// changes by itself; kNever if none. Never too late; may be too early.
  Cycle next_event(Cycle now);
  /// Answers of the outside (edges to come, levels) are no longer what they were, from `now` on.
  void outside_changed(Cycle now);
  /// A word arrives at UART 1 or 2. Words are told in their order and may be told ahead of time; one that
  /// begins before `now`, or before the end of the one before, is moved to the next free instant.
  void uart_receive(int uart, const UartFrame& frame, Cycle now);

  // --- interrupts

  ChipInterrupts& interrupts() { return interrupts_; }
  const ChipInterrupts& interrupts() const { return interrupts_; }

  // --- instructions that peripherals know of

  void clear_watchdog(Cycle now);
  /// A reset that the chip itself wants (watchdog, trap conflict); the caller answers with reset().
  std::optional<ResetKind> reset_due(Cycle now);
  /// Flash programming holds the processor up to this cycle; <= now otherwise.
  Cycle stalled_until() const;

  // --- data EEPROM

  /// TBLRDL at a program address inside the EEPROM; 0 elsewhere.
  std::uint16_t table_read(unsigned program_address, Cycle now);
  /// TBLWTL: loads a write latch and NVMADR, NVMADRU.
  void table_write(unsigned program_address, std::uint16_t value, Cycle now);
  std::array<std::uint16_t, 2048>& eeprom();

  // --- diagnosis

  Diagnostics& diagnostics();
  /// Words lost by receive overruns of UART 1 or 2 since power-up.
  std::int64_t uart_overruns(int uart);
  /// Hash of FIFOs, of the registers that were written since power-on and of the EEPROM as
  /// operations left it, for determinism checks.
  std::uint64_t state_hash(Cycle now);

  /// For a host that includes chip_parts.h.
  ChipParts& parts() { return *parts_; }

 private:
  std::unique_ptr<ChipParts> parts_;
  ChipInterrupts interrupts_;
};

}  // namespace dspic
