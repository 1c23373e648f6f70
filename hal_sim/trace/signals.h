// SPDX-License-Identifier: MIT
// What can be drawn over time, by the names that e-puck programs use:
//
//   RA6, LATA, PORTG, TRISD, LATD3      pins and whole ports; a pin shows its level
//   LED0..LED7, BODY_LED, FRONT_LED     is it lit?
//   MOTOR1_PHA..D (left), MOTOR2_PHA..D (right), left_coils, right_coils, left_steps, right_steps
//   PULSE_IR0..3, AUDIO_ON, CAM_RESET, REMOTE, BATT_LOW
//   T1, ADC, U1RX ...                   an interrupt: its flag and whether its handler is open
//   T2CON, TMR2, ADCBUF3, IFS0 ...      a register of the chip; T2CON.TCKPS, IFS0bits.T2IF: one of its fields
//   TX1, RX1, TX2, RX2                  the byte on the wire, and whether there is one
//   anything else                       a variable of the firmware (hal_sim/host/variables.h)
//
// Ports and registers are the chip's.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "hal_sim/host/runner.h"
#include "hal_sim/host/variables.h"

namespace trace {

/// What a value is read from; `index` of SignalSource says which of them.
enum class Source { Lat, Port, Tris, Lights, Steps, Flag, Service, WireByte, WireBusy, Variable, Register };

struct SignalSource {
  Source kind = Source::Lat;
  int index = 0;            ///< port letter, wheel (0 left), vector, line (TX1 RX1 TX2 RX2) or address
  host::Variable variable;  ///< of Source::Variable

  bool operator==(const SignalSource& other) const {
    return kind == other.kind && index == other.index && variable.address == other.variable.address &&
           variable.bytes == other.variable.bytes && variable.first_bit == other.variable.first_bit &&
           variable.bits == other.variable.bits;
  }
};

/// One line of a picture: some bits of a source.
struct Signal {
  std::string group;  ///< "pins", "motors", "interrupts", "uart", "variables", "registers"
  std::string name;
  SignalSource source;
  int shift = 0;
  int width = 1;      ///< bits, 1 to 64
  bool real = false;  ///< the value is a double's bits
  bool is_signed = false;
  std::uint64_t possible = ~std::uint64_t{0};  ///< bits that may be set, from `shift` on
};

/// Bits of the value that a person writes: "3", "-2", "0x8010", "1.5". False: the signal cannot have it, with
/// "got value '65536', expected a whole number from -32768 to 32767" in `error`.
bool value_of_signal(const Signal& signal, const std::string& text, std::uint64_t& bits, std::string& error);

/// Signals that a name means, several for an interrupt, a line or an array. `runner` null: no firmware, no
/// variables. Empty with a sentence in `error` ("got ..., expected ..."): there is no such thing.
std::vector<Signal> find_signals(const std::string& name, const host::Runner* runner, std::string& error);

/// What is drawn when nobody says: LEDs, motors, IR pulses, AUDIO_ON, UARTs.
const std::vector<std::string>& usual_signals();

}  // namespace trace
