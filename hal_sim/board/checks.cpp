// SPDX-License-Identifier: MIT
// Checks of the board: what a program does to motors, emitters and pins that no register knows to be
// wrong. Counters are kept where things happen anyway (stepper.h, ir_circuit.h); sentences are
// made when asked for.
#include <cstdarg>
#include <cstdio>

#include "hal_sim/board/board.h"
#include "hal_sim/board/checks_params.h"

namespace board {

namespace {

std::string text(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string text(const char* format, ...) {
  char room[240];
  va_list values;
  va_start(values, format);
  std::vsnprintf(room, sizeof room, format, values);
  va_end(values);
  return room;
}

double ms(Cycle cycles) { return 1000.0 * static_cast<double>(cycles) / static_cast<double>(kFcyHz); }

void add(std::vector<Diagnosis>& all, const StepperFaults::Fault& fault, const char* cause,
         const std::string& place, const std::string& message, const char* hint) {
  if (fault.count == 0) return;
  all.push_back({cause, place, message, hint, fault.first, 0, fault.count});
}

}  // namespace

std::vector<Diagnosis> Board::diagnoses(Cycle at) const {
  std::vector<Diagnosis> all;
  // What the motors did not follow.
  for (const Wheel wheel : {Wheel::Left, Wheel::Right}) {
    const StepperFaults faults = motors_.faults(wheel, at);
    const std::string pins = wheel == Wheel::Left ? "LATD0-3" : "LATD4-7";
    const char* motor = wheel == Wheel::Left ? "left motor" : "right motor";
    add(all, faults.jumps, "lost steps", pins,
        text("the %s's coil pattern jumps by two phases: the rotor does not follow and the step is lost",
             motor),
        "go through the patterns 1010, 0110, 0101, 1001 (D C B A) one after the other");
    add(all, faults.too_fast, "steps too fast", pins,
        text("the %s is stepped faster than %.0f steps/s: the rotor does not follow and steps are lost",
             motor, static_cast<double>(kFcyHz) / static_cast<double>(kPullOutCycles)),
        "e-pucks hold 1000 steps/s; check the timer's period and prescaler");
    add(all, faults.opposed, "opposed coil ends", pins,
        text("both ends of a coil of the %s are high: no current flows in it", motor),
        "one of A and B and one of C and D are high at a time");
    add(all, faults.held, "coils energised at rest", pins,
        text("both coils of the %s stay on for more than %.0f ms without a step and draw %.0f mA", motor,
             ms(kRestCycles), 1000 * 2 * kCoilA),
        "switch the four pins off while the motor rests");
  }
  // IR pulses: those that are over, and the one that goes on.
  for (int line = 0; line < kEmitterLines; ++line) {
    const IrCircuit::LongPulses p = ir_.long_pulses(line, at);
    if (p.count == 0) continue;
    all.push_back({"IR pulse too long", text("LAT%c%d", kEmitterPins[line].letter(), kEmitterPins[line].bit),
                   text("pulse_IR%d stays high for %.1f ms: its two IR emitters draw %.0f mA all the time",
                        line, ms(p.longest), 1000 * 2 * kIrEmitterA),
                   "lower the pulse after the lit sample, 0.3 ms after it rose", p.first, 0, p.count});
  }
  if (const Cycle empty = power_.battery().empty_since(at); empty < kNever)
    all.push_back({"battery empty", "battery",
                   text("its charge is used up (full it holds %.3g Wh); an e-puck stops, this one goes on",
                        setup().battery_wh),
                   "give it more with battery_wh for so long a run", empty, 0, 1});
  if (i2c_.unstopped() > 0)
    all.push_back({"I2C bus not stopped", "I2CCON.PEN",
                   "a transfer begins although the one before was not ended by a stop condition",
                   "end each transfer with I2CCON.PEN (e_i2c_stop()), or go on with RSEN",
                   i2c_.first_unstopped(), 0, i2c_.unstopped()});
  return all;
}

}  // namespace board
