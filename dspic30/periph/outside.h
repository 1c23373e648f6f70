// SPDX-License-Identifier: MIT
// What lies beyond the chip's pins, as the peripherals ask for it and tell it. A board implements it; a test
// overrides the two or three functions it needs, the others behave like open pins and an empty bus.
//
//   chip tells:   pins_driven, uart_sent, i2c_*, dci_frame_word, spi_word
//   chip asks:    pin_levels, levels_horizon, edges, nth_edge, analogue_counts
//   outside says: Dspic30f6014a::uart_receive (a word comes in), ::i2c_start and its kin (another master),
//   ::outside_changed (an answer is no longer true)
//
// Contract: answers are functions of time. What was asked once stays true until outside_changed() is called,
// or until a pins_driven() of the chip that it depends on. Instants passed to the telling functions and to
// analogue_counts never go back, each for itself, and never lie before the last pins_driven(). A device that
// only sees bytes and levels at cycles, and no bits between them, is enough.
#pragma once
#include <cstdint>

#include "dspic30/memory/cycle.h"

namespace dspic {

enum class Port : std::uint8_t { A, B, C, D, F, G };
inline constexpr int kPorts = 6;
inline constexpr char kPortLetters[kPorts + 1] = "ABCDFG";

struct Pin {
  Port port;
  int bit;  ///< 0 to 15
};

enum class Edge : std::uint8_t { Rising, Falling };

/// Levels that the outside puts on the pins of one port. A pin that nobody drives reads its
/// pull-up (CNPUx) or 0.
struct PinLevels {
  std::uint16_t levels = 0;  ///< 1: high
  std::uint16_t driven = 0;  ///< 1: the outside decides this pin's level, digitally
};

enum class Parity : std::uint8_t { None, Even, Odd };

/// One word on a UART line. Bits follow one another at equal distances from the edge of the start bit.
struct UartFrame {
  std::uint16_t word = 0;  ///< 8 or 9 bits
  int data_bits = 8;       ///< 8 or 9, parity bit not counted
  Parity parity = Parity::None;
  int stop_bits = 1;    ///< 1 or 2
  Cycle start = 0;      ///< falling edge of the start bit
  Cycle bit = 128;      ///< cycles a bit; 128 = 115,200 baud at 14.7456 MHz
  bool broken = false;  ///< a break: the line is low for the whole frame

  int bits() const { return 1 + data_bits + (parity != Parity::None ? 1 : 0) + stop_bits; }
  /// End of the last stop bit.
  Cycle end() const { return start + bits() * bit; }
  /// Level of the line at a cycle; idle is high.
  bool level(Cycle at) const;
};

/// Answer of the I2C bus to a byte.
struct I2cReply {
  bool acknowledged = false;  ///< after a byte to a device
  std::uint8_t byte = 0xFF;   ///< after a byte from a device; 0xFF is the released line
  Cycle stretched = 0;        ///< cycles for which a device holds SCL low beyond the master's clock
};

class Outside {
 public:
  virtual ~Outside() = default;

  // --- pins
  /// What the chip puts on a port from `at` on. `driven`: its outputs; `by_peripheral`: those among them that
  /// a peripheral owns (UART, DCI, SPI, output compare; their levels are not followed bit by bit). Called
  /// when levels or driven pins have changed, and once per port at every reset.
  virtual void pins_driven(Port /*port*/, std::uint16_t /*levels*/, std::uint16_t /*driven*/,
                           std::uint16_t /*by_peripheral*/, Cycle /*at*/) {}
  /// Levels at `at`, those of clocks included.
  virtual PinLevels pin_levels(Port /*port*/, Cycle /*at*/) { return {}; }
  /// First cycle after `after` at which pin_levels(port) may differ in one of `pins`, a bit each; kNever if
  /// they stay. Pixel clocks may be left out when edges() and nth_edge() know them.
  virtual Cycle levels_horizon(Port /*port*/, std::uint16_t /*pins*/, Cycle /*after*/) { return kNever; }
  /// Edges of one pin in (after, until]. By default counted with levels_horizon(); override for fast clocks.
  virtual std::int64_t edges(Pin pin, Edge edge, Cycle after, Cycle until);
  /// Instant of the n-th (1 = first) edge after `after`; kNever if it does not come as far as is known.
  virtual Cycle nth_edge(Pin pin, Edge edge, Cycle after, std::int64_t n);

  /// Has somebody made such an edge by hand, just now? Told once, when outside_changed() is called.
  virtual bool take_edge(Pin /*pin*/, Edge /*edge*/) { return false; }

  // --- analogue inputs
  /// Counts of AN`channel` (0 to 15) against AVDD and AVSS, 0 to 4095, held at `at`. Asked once per
  /// conversion and in order, so that noise may be drawn per call.
  virtual int analogue_counts(int /*channel*/, Cycle /*at*/) { return 0; }
  /// True: analogue_counts() depends on channel and instant alone, noise and pins at that instant included,
  /// whenever and however often it is asked, for the last conversions of every channel. Then a converter that
  /// scans by itself asks only for results that somebody reads.
  virtual bool analogue_is_function_of_time() const { return false; }
  /// The chip's supply, V, for the low-voltage detector; asked when it is switched on and at
  /// outside_changed().
  virtual double supply_v(Cycle /*at*/) { return 3.3; }

  // --- UART 1 and 2
  /// A word leaves UART `uart` (1, 2) from frame.start on. Told by when Dspic30f6014a::run_to() has come to its
  /// start; each UART's in order, each for itself.
  virtual void uart_sent(int /*uart*/, const UartFrame& /*frame*/) {}

  // --- I2C module as master
  /// Each when it is complete on the bus: start or repeated start, byte with its ninth bit, stop.
  virtual void i2c_start(bool /*repeated*/, Cycle /*at*/) {}
  virtual I2cReply i2c_write(std::uint8_t /*byte*/, Cycle /*at*/) { return {}; }
  /// The device's next byte, of which the eighth bit is complete at `at`.
  virtual I2cReply i2c_read(Cycle /*at*/) { return {}; }
  /// The master's ninth bit after a byte read.
  virtual void i2c_acknowledge(bool /*acknowledged*/, Cycle /*at*/) {}
  virtual void i2c_stop(Cycle /*at*/) {}
  /// May an answer stretch the clock?
  virtual bool i2c_may_stretch() const { return true; }
  /// Is there another master, which speaks by Dspic30f6014a::i2c_start() and its kin?
  virtual bool i2c_has_master() const { return false; }

  // --- DCI (codec)
  /// A word of an enabled slot has passed; its last bit ends at `end`. `transmitted`: what CSDO carried,
  /// right-aligned, 4 to 16 bits; 0 when the slot does not transmit. Returns what CSDI carried.
  virtual std::uint16_t dci_word(int /*slot*/, std::uint16_t /*transmitted*/, int /*bits*/, Cycle /*end*/) {
    return 0;
  }

  // --- SPI 1 and 2
  /// A word of 8 or 16 bits went out as master, complete at `end`. Returns what came in.
  virtual std::uint16_t spi_word(int /*module*/, std::uint16_t /*word*/, int /*bits*/, Cycle /*end*/) {
    return 0;
  }
};

}  // namespace dspic
