// SPDX-License-Identifier: MIT
// What lies at the converter's inputs AN0 to AN15: one rule for whoever samples them, be it the chip's
// converter, the library's scan in closed form, or a look from outside.
//
//   AN2..4  microphones      AN8..15  proximity sensors
//   others  what a part puts there; else AN5..7 the accelerometer, of revision 1.3 battery and open inputs
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "hal_sim/board/ears.h"
#include "hal_sim/board/ir_circuit.h"
#include "hal_sim/board/part.h"
#include "hal_sim/board/power.h"

namespace board {

class AnalogueInputs {
 public:
  using Parts = std::vector<std::unique_ptr<Part>>;
  /// All outlive this.
  AnalogueInputs(const Specimen& robot, const IrCircuit& ir, const Ears& ears, const Power& power,
                 const Parts& parts)
      : ir_(ir), ears_(ears), robot_(robot), power_(power), parts_(parts) {}

  const IrCircuit& ir() const { return ir_; }
  const Ears& ears() const { return ears_; }
  /// Counts of a single conversion of AN`channel`, held at `at`; -1: nothing is known of that input, 0 beyond
  /// the inputs. `lit_for` of a proximity sensor: cycles for which its emitter has been on; negative: off.
  int counts(int channel, Cycle at, Cycle lit_for = -1) const;
  /// Voltage that a part puts on AN`channel`, V; empty: none does.
  std::optional<double> part_v(int channel, Cycle at) const;

 private:
  const IrCircuit& ir_;
  const Ears& ears_;
  const Specimen& robot_;
  const Power& power_;
  const Parts& parts_;
};

}  // namespace board
