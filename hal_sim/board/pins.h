// SPDX-License-Identifier: MIT
// The pins between the processor and the board: latches, directions, and the level that follows from them.
//
//   latch of the program, or of a driver --.
//   directions -----------------------------+--> level of a pin <-- held by hand
//   what the board puts on inputs ---------'        |
//                                                   '--> consumers of wiring.h: motors, LEDs, IR emitters,
//                                                        codec, camera, parts, and what they draw
//
// A change is told to the consumers of those pins that changed. Levels of camera and serial pins are not kept
// here: the chip's models follow them frame by frame and word by word (chip/board_outside.h).
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hal_sim/board/ir_circuit.h"
#include "hal_sim/board/motors.h"
#include "hal_sim/board/pin_driver.h"
#include "hal_sim/board/power.h"
#include "hal_sim/board/wiring.h"

namespace board {

class Camera;
class Codec;
class Part;
class RemoteReceiver;

class Pins {
 public:
  enum class Register { Tris, Port, Lat };

  /// What hangs on the pins; all of it outlives them.
  struct Consumers {
    Specimen& robot;
    Motors& motors;
    IrCircuit& ir;
    Power& power;
    Codec& codec;
    const RemoteReceiver& remote;
    const std::unique_ptr<Camera>& camera;
    const std::vector<std::unique_ptr<Part>>& parts;
  };
  /// As a processor's reset leaves them.
  explicit Pins(const Consumers& consumers);

  // --- registers
  /// Word of port 'A' 'B' 'C' 'D' 'F' 'G' as the processor reads it now; other letters read 0. PORT gives
  /// levels().
  std::uint16_t read(char port, Register reg, Cycle at) const;
  /// Writing PORT writes the latch. Other letters: nothing happens.
  void write(char port, Register reg, std::uint16_t value, Cycle at);
  /// One latch bit, as BSET/BCLR do it (the read half of the instruction included).
  void write_bit(char port, int bit, bool level, Cycle at);
  /// First cycle after `at` at which a PORT or LAT word can change by itself; kNever if it cannot.
  Cycle horizon(char port, Cycle at) const;
  /// e_init_port(): latches 0, directions as the library wants them. (Its cost is the caller's.)
  void init(Cycle at);
  /// Latches 0, all pins inputs; wheels stay where they are.
  void processor_reset(Cycle at);
  /// Latch and direction of a port, for a hash; the coils are the motors'.
  std::uint64_t state_word(int port) const {
    const auto p = static_cast<std::size_t>(port);
    return lat_[p] | static_cast<std::uint64_t>(tris_[p]) << 16;
  }

  // --- levels
  /// Level of every pin of a port: the latch where it is an output, else what the board puts there; and what
  /// somebody holds.
  std::uint16_t levels(Port port, Cycle at) const;
  /// What the board alone puts on the inputs of a port, pins that somebody holds included: selector, battery
  /// detector, remote receiver, lines with a pull-up; open pins are 0.
  std::uint16_t given(Port port, Cycle at) const { return with_held(port, given_free(port, at)); }
  /// First cycle after `at` at which that can change by itself; kNever if it cannot.
  Cycle given_horizon(Port port, Cycle at) const;
  /// Bits 0 to 7 the ring, 8 body, 9 front; those that give light.
  std::uint32_t leds(Cycle at) const;
  /// The LEDs that a program has switched on, dead ones too.
  std::uint32_t driven_leds(Cycle at) const;
  /// Cycles for which the emitter beside a sensor has been on, whoever flashes it: a driver's flash is a
  /// settled one; -1: it is off.
  Cycle lit_for(int sensor, Cycle at) const;

  // --- by hand
  /// Can a level be forced on this pin? Inputs, and those of LEDs.
  static bool can_be_held(char port, int bit);
  /// Somebody holds a pin that can be held at a level, or (empty) lets it go.
  void hold(char port, int bit, std::optional<bool> level, Cycle at);
  /// Pins that somebody holds.
  std::uint16_t held(Port port) const;
  /// Has hold() made such an edge on an input since this was asked?
  bool take_edge(Port port, int bit, bool rising);
  /// Held pins, dead LEDs or the battery were changed.
  void changed_by_hand(Cycle at);

  // --- drivers in closed form
  /// Whoever moves pins by itself; null: nobody. Outlives the pins' use or takes itself away.
  void attach(PinDriver* driver);
  PinDriver* driver() const { return driver_; }
  /// A driver was commanded: what is on draws its mean current from `at` on. All of it, or the motors alone.
  void follow(Cycle at);
  void follow_motors(Cycle at);
  void follow_motor(Wheel wheel, Cycle at);

 private:
  static int port_index(char port);
  /// The latch of a port, what a driver does to it included.
  std::uint16_t latch(Port port, Cycle at) const;
  /// What a program may not write, because a driver moves it: it must not latch the driver's flashes.
  std::uint16_t beside_driver(Port port, std::uint16_t value, Cycle at) const;
  std::uint16_t given_free(Port port, Cycle at) const;
  std::uint16_t with_held(Port port, std::uint16_t levels) const;
  unsigned pulses(Cycle at) const { return driver_ ? driver_->pulses(at) : 0; }
  /// By its latch.
  bool is_on(Pin pin) const {
    return (lat_[pin.port] & ~static_cast<unsigned>(tris_[pin.port]) & pin.mask()) != 0;
  }
  /// Latch or direction of these pins of a port changed: their consumers follow.
  void outputs_changed(Port port, unsigned changed, Cycle at);
  void emitter_directions_changed();

  PinDriver* driver_ = nullptr;
  std::array<std::uint16_t, kPorts> lat_{};  // of D the high byte only: the low one is the coils
  std::array<std::uint16_t, kPorts> tris_{};
  Consumers to_;
};

}  // namespace board
