// SPDX-License-Identifier: MIT
// What the chip has to say about the program that uses it: each cause once per place, in words.
//
// A diagnosis never changes what the chip does. Counters go on counting after the first report.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "dspic30/memory/cycle.h"

namespace dspic {

enum class Cause : std::uint8_t {
  UnmodelledBit,         ///< a register bit was set that exists on the chip and does nothing here
  UnimplementedAddress,  ///< an address of the register space with nothing behind it was written
  UninitialisedRead,     ///< a register whose power-on value is not defined was read before it was written
  UartOverrun,           ///< a received word was lost: four waited, the fifth stayed in the shift register
  UartFrameError,        ///< a received word without its stop bit: wrong baud rate or format
  UartOff,               ///< a word was written to a transmitter that is off: it is lost
  UartFull,              ///< a word was written while four waited to be sent: it is lost
  BaudError,             ///< the nearest standard rate is more than 2 % off
  MissedInterrupt,       ///< an event found its flag, enabled, still set: one handler run for two events
  FlagNeverCleared,      ///< a handler returned twice without having cleared its flag: it runs for ever
  InputDriven,           ///< the latch of a pin is toggled while its TRIS bit says input
  AnalogueDigital,       ///< a channel was converted whose ADPCFG bit says digital, or whose pin is an output
  DigitalAnalogue,       ///< a port was read where a driven pin reads 0, because ADPCFG says analogue
  ChangedWhileOn,        ///< converter set-up written while ADON = 1, which the manual forbids
  NotUnlocked,           ///< OSCCON or NVMCON.WR written without its unlock sequence; nothing happened
  NvmBusy,               ///< an operation on EEPROM or flash was asked for while another one ran
  I2cMisuse,             ///< an operation was asked for while another was under way (IWCOL), or I2CEN is 0
  WatchdogReset,         ///< the watchdog was not cleared in time
  CodecRate,             ///< the codec's own sample rate is not that of the frames it gets
  TrapConflict,          ///< a hard trap met another one
  CpuTrap,               ///< an instruction led to a trap, and on to the trap's vector
  IllegalOpcode,         ///< an illegal word was executed, or a pointer used that was never written: a reset
};

/// "unmodelled bit", "UART overrun", ... for messages and tests.
const char* cause_name(Cause cause);

struct Diagnosis {
  Cause cause = Cause::UnmodelledBit;
  std::string place;    ///< register, bit or vector: "U1STA.OERR", "TRISA.6", "T2"
  std::string message;  ///< one sentence that names the place
  Cycle cycle = 0;      ///< of the first occurrence
};

/// Receives each (cause, place) once.
class DiagnosticSink {
 public:
  virtual ~DiagnosticSink() = default;
  virtual void report(const Diagnosis& diagnosis) = 0;
};

/// Remembers what has been said. Survives resets of the processor: once per life of the chip.
class Diagnostics {
 public:
  /// `sink` may be null and outlives this.
  explicit Diagnostics(DiagnosticSink* sink) : sink_(sink) {}
  /// Reports the first occurrence of (cause, place); counts all of them.
  void report(Cause cause, const std::string& place, const std::string& message, Cycle at);
  /// Occurrences so far.
  std::int64_t count(Cause cause, const std::string& place) const;
  std::int64_t count(Cause cause) const;

 private:
  DiagnosticSink* sink_;
  std::map<std::pair<Cause, std::string>, std::int64_t> seen_;
};

}  // namespace dspic
