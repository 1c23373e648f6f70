// SPDX-License-Identifier: MIT
// The radio turret of SWIS (a CC2420 behind a small processor with TinyOS) on the robot's
// I2C bus, address 0x7E.
//
//   e_i2cp_* -> registers: settings, send buffer, status -> sim::RadioMedium -> receive buffers of others
//
// Modelled: all registers of the library's driver; one receive buffer, freed by reading its last byte; a
// packet that comes while it is full is lost and says so; groups and addresses; attenuators; time on the air.
// Not modelled: the time the turret's processor takes, its start-up, acknowledgements. The
// library writes no length before it sends, and how the turret knows it is not published.
// Here: what the program wrote to offset 0 since the last packet, else the number of data
// bytes it wrote. [assumed: users get back the size they sent]
// Source: [lib: contrib/SWIS_com_module/], facts restated; radio_params.h.
#pragma once
#include <array>

#include "hal_sim/board/clock.h"
#include "hal_sim/board/i2c_device.h"
#include "hal_sim/board/radio_params.h"
#include "sim_core/radio/radio_medium.h"

namespace board {

class RadioTurret final : public I2cRegisters, public sim::RadioPort {
 public:
  /// `clock` is the robot's; `robot` its index in the world.
  RadioTurret(const RobotClock& clock, int robot_index) : I2cRegisters(kRadioAddress), clock_(clock) {
    robot = robot_index;
  }

  // --- the channel, between ticks
  void on_frame(const sim::RadioFrame& frame, double level_db) override;
  void on_sent(bool given_up, sim::Clicks at) override;

  /// Packets for this turret that found the buffer full, since power-up.
  std::int64_t lost() const { return lost_; }
  std::uint64_t state_hash() const override { return hash_; }
  void begin_again(Cycle at) override;

  /// Power of what is sent by the attenuators, dB below full power (0 to -50).
  double power_db() const;

 protected:
  bool write_register(std::uint8_t number, std::uint8_t value, Cycle at) override;
  std::uint8_t read_register(std::uint8_t number, Cycle at) override;

 private:
  using Buffer = std::array<std::uint8_t, kRadioBufferLast + 1>;
  void send(Cycle at);
  void mix(std::uint64_t word);

  const RobotClock& clock_;
  std::uint8_t status_ = kRadioIdle;
  std::uint8_t config_ = 0;
  std::uint8_t soft_attenuator_ = 1;
  std::uint8_t group_ = kRadioDefaultGroup;
  std::uint16_t own_address_ = 0;
  Buffer send_{}, receive_{};
  int written_ = 0;          // data bytes since the last packet
  bool has_length_ = false;  // the program wrote the length itself
  std::int64_t lost_ = 0;
  std::uint64_t hash_ = 1;
};

}  // namespace board
