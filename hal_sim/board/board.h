// SPDX-License-Identifier: MIT
// The e-puck, electrically: everything between the processor's pins and the world, for one robot.
//
//   Pins --> Motors, IrCircuit, Power, codec, camera     what a program does to the pins
//   AnalogueInputs --> IrCircuit, Ears, parts, Power     what the converter finds
//   all of these --> Specimen --> Scene                  the robot's own figures, and the world
//   UARTs, I2C bus, data EEPROM, packets                 what goes to and fro in bytes
//
// Arrows say who asks whom; nobody asks back. Drivers in closed form (pin_driver.h) move pins, and sample
// AnalogueInputs. Motion sensors: accelerometer.h (before revision 1.3), lsm330.h (1.3).
//
// Every method takes the cycle of this robot's clock at which it happens. Cycles never go back between calls
// that change something. Nothing depends on who looked before: const methods have no side effects, and a
// sample has one value however often it is read. One Board is used by one thread at a time.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hal_sim/board/analogue_inputs.h"
#include "hal_sim/board/codec.h"
#include "hal_sim/board/data_eeprom.h"
#include "hal_sim/board/diagnosis.h"
#include "hal_sim/board/i2c_bus.h"
#include "hal_sim/board/packet_devices.h"
#include "hal_sim/board/pins.h"
#include "hal_sim/board/remote.h"
#include "hal_sim/board/uart.h"
#include "hal_sim/board/virtual_devices.h"

namespace board {

class Board : public Specimen {
 public:
  explicit Board(const Setup& setup);
  ~Board();

  // --- its parts, each with one rule
  Pins& pins() { return pins_; }
  const Pins& pins() const { return pins_; }
  Motors& motors() { return motors_; }
  const Motors& motors() const { return motors_; }
  Power& power() { return power_; }
  const Power& power() const { return power_; }
  const IrCircuit& ir() const { return ir_; }
  const Ears& ears() const { return ears_; }
  const AnalogueInputs& inputs() const { return inputs_; }

  // --- devices
  Codec& codec() { return codec_; }
  const Codec& codec() const { return codec_; }
  /// UART 1 (Bluetooth) or 2 (RS232).
  Uart& uart(int number) { return uarts_[static_cast<std::size_t>(number - 1)]; }
  const Uart& uart(int number) const { return uarts_[static_cast<std::size_t>(number - 1)]; }
  /// Camera, motion sensors and turrets hang here.
  I2cBus& i2c() { return i2c_; }
  const I2cBus& i2c() const { return i2c_; }
  /// Null: the robot carries none.
  Camera* camera() { return camera_.get(); }
  const Camera* camera() const { return camera_.get(); }
  /// Emitters and receivers of packets, and sensors that a supervisor defines: for programs written for
  /// Webots' interfaces.
  PacketDevices& packets() { return packets_; }
  VirtualDevices& virtual_devices() { return virtual_; }
  const VirtualDevices& virtual_devices() const { return virtual_; }
  /// Data EEPROM; resets leave it alone.
  DataEeprom& eeprom() { return eeprom_; }
  /// What somebody does with a remote control.
  RemoteReceiver& remote() { return remote_; }
  /// Plugs a turret or another part in; before power-up.
  void plug_in(std::unique_ptr<Part> part);
  const std::vector<std::unique_ptr<Part>>& parts() const { return parts_; }

  // --- its life
  /// As when it was first switched on, from world time `now` on, which is cycle `at`: rotors, devices, parts,
  /// battery, data EEPROM, noise, the clock's fractions and the boot delay. Selector, sensors that somebody
  /// defined, keys and the ends of UARTs stay. Behind processor_reset().
  void begin_again(sim::Clicks now, Cycle at);
  /// The reset button, or asm("reset"): pins to inputs, drivers stop, wheels stay where they are. Wiring,
  /// selector, UART ends and the noise's sample numbers stay.
  void processor_reset(Cycle at);
  /// Tick boundary: bytes from outside enter, bytes sent so far go out, old bookkeeping is dropped.
  void exchange(Cycle at);
  /// Until when exchange() has nothing to do and nothing that firmware has not asked for happens; `at`: not
  /// known.
  Cycle horizon(Cycle at) const;
  /// For models of the chip: has exchange() put a byte on a wire, since it was last taken note of?
  bool has_wire_news() const { return has_wire_news_; }
  bool take_wire_news() { return std::exchange(has_wire_news_, false); }
  /// Has publish_sound() anything to tell?
  bool has_sound_news() const { return is_any_used_ && codec_.has_news(); }
  /// Tells the air what the loudspeaker began or ended, at the tick boundary `now`.
  void publish_sound(sim::SoundField& field, sim::Clicks now) { ears_.publish(codec_, field, now); }

  // --- looks from outside
  /// Dark minus lit of the last completed pair of samples, or of a noise-free pair taken at `at` when no
  /// driver runs. No side effects, and what firmware reads later does not depend on it.
  int proximity_counts(int sensor, Cycle at) const;
  /// The same of the scan of a driver that the board knows; nothing: there is none.
  std::optional<int> scanned_proximity(int sensor, Cycle at) const;
  /// A single conversion of input AN`channel` as pins and drivers are at `at`: AnalogueInputs::counts().
  int convert(int channel, Cycle at) const;
  /// What the program makes of the board that an e-puck would not do for it, or would suffer from; up to
  /// `at`, in no order. Costs nothing while nobody asks.
  std::vector<Diagnosis> diagnoses(Cycle at) const;
  /// Everything that must repeat from run to run.
  std::uint64_t state_hash(Cycle at) const;

 private:
  // what every run looks at, together
  bool has_run_ = false;
  bool is_any_used_ = false;  // of the devices below and the parts; until then nobody looks at them
  bool has_wire_news_ = false;
  Pins pins_;
  Motors motors_{setup().wheel_ratio};
  IrCircuit ir_{*this};
  Power power_{setup()};
  Ears ears_{*this};
  AnalogueInputs inputs_{*this, ir_, ears_, power_, parts_};

  RemoteReceiver remote_{clock()};
  Codec codec_;
  std::array<Uart, 2> uarts_;
  I2cBus i2c_;
  DataEeprom eeprom_;
  std::unique_ptr<Camera> camera_;
  std::vector<std::unique_ptr<Part>> parts_;
  PacketDevices packets_{clock(), setup().robot, setup().devices};
  VirtualDevices virtual_;
};

}  // namespace board
