// SPDX-License-Identifier: MIT
// The board as the pins of the dsPIC30F6014A see it: dspic::Outside on one board::Board.
//
//   pins_driven -> Pins::write: coils, LEDs, IR emitters, codec and camera reset
//   pin_levels  <- selector, battery detector, remote receiver, idle serial lines, camera clocks and data
//   analogue    <- IR phototransistors, microphones, accelerometer or battery, what parts put there
//   UART words <-> Uart ends; I2C <-> the board's bus; DCI words -> the codec
//
// Not modelled: serial lines level by level; levels of port B's pins (they are analogue inputs); a far end
// with a rate of its own: it follows the robot's, 8 bits, no parity.
#pragma once
#include <array>
#include <cstdint>

#include "dspic30/device/dspic30f6014a.h"
#include "dspic30/periph/outside.h"
#include "hal_sim/board/board.h"
#include "hal_sim/chip/camera_pins.h"
#include "hal_sim/chip/event_digest.h"

namespace chip {

using dspic::Cycle;
static_assert(board::kNever == dspic::kNever, "horizons pass from one to the other");

class BoardOutside final : public dspic::Outside {
 public:
  /// `board` outlives this.
  explicit BoardOutside(board::Board& board);

  /// May begin_window() find anything?
  bool may_have_news() const;
  /// Tick boundary, after Board::exchange(): words from outside start on their lines; what somebody did by
  /// hand (selector) reaches the chip. True: there was any such thing.
  bool begin_window(dspic::Dspic30f6014a& chip, Cycle now);
  /// The board's UARTs learn rate and switch of the chip's.
  void end_window(dspic::Dspic30f6014a& chip, Cycle now);

  /// The chip was reset, and with it what hangs on its pins: the next windows look at UARTs and camera.
  void chip_was_reset() {
    followed_writes_ = -1;
    asks_camera_ = true;
  }

  /// What the chip did to the board; others may add what they know of.
  EventDigest& digest() { return digest_; }
  const EventDigest& digest() const { return digest_; }
  /// The coils of the motors are somebody else's too: a latch that is written leaves those of its bits alone
  /// that do not change.
  void share_coils() { shares_coils_ = true; }

  void pins_driven(dspic::Port port, std::uint16_t levels, std::uint16_t driven, std::uint16_t by_peripheral,
                   Cycle at) override;
  dspic::PinLevels pin_levels(dspic::Port port, Cycle at) override;
  Cycle levels_horizon(dspic::Port port, std::uint16_t pins, Cycle after) override;
  bool take_edge(dspic::Pin pin, dspic::Edge edge) override;
  std::int64_t edges(dspic::Pin pin, dspic::Edge edge, Cycle after, Cycle until) override;
  Cycle nth_edge(dspic::Pin pin, dspic::Edge edge, Cycle after, std::int64_t n) override;
  int analogue_counts(int channel, Cycle at) override;
  bool analogue_is_function_of_time() const override { return true; }
  void uart_sent(int uart, const dspic::UartFrame& frame) override;
  void i2c_start(bool repeated, Cycle at) override;
  dspic::I2cReply i2c_write(std::uint8_t byte, Cycle at) override;
  dspic::I2cReply i2c_read(Cycle at) override;
  void i2c_stop(Cycle at) override;
  bool i2c_may_stretch() const override { return false; }
  std::uint16_t dci_word(int slot, std::uint16_t transmitted, int bits, Cycle end) override;

 private:
  /// The codec's clocks: the bit clock, and whether it agrees with the codec's registers.
  void follow_codec(dspic::Dspic30f6014a& chip, Cycle now);
  /// analogue_counts() of every channel that is no microphone's.
  __attribute__((noinline)) int beside_microphones(int channel, Cycle at);
  std::uint64_t pins_changed() const { return board_.damage() ? board_.damage()->pins_changed : 0; }
  std::uint16_t on_board(dspic::Port port, std::uint16_t lat, Cycle at);
  void follow_breaks(std::uint16_t low, Cycle at);

  board::Board& board_;
  // what every window looks at
  int selector_;
  std::uint64_t pins_changed_ = 0;  // by hand
  bool asks_camera_ = false;        // pins or registers of the camera, since it was last asked for news
  bool shares_coils_ = false;
  bool takes_pictures_ = false, sends_sound_ = false;  // the program ever did
  std::int64_t followed_writes_ = -1;  // to the chip's registers, when its UARTs were looked at last
  EventDigest digest_;
  CameraPins camera_;
  std::array<std::uint16_t, dspic::kPorts> levels_{};
  std::array<std::uint16_t, dspic::kPorts> tris_{};
  std::array<Cycle, 2> low_since_{-1, -1};  // a serial line held low by its port; -1: it is not
  std::uint16_t low_lines_ = 0;             // those lines, as pins
};

}  // namespace chip
