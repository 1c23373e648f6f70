// SPDX-License-Identifier: MIT
// Ports A B C D F G: TRIS, PORT, LAT, ADPCFG, and who owns a pin.
//
//   TRIS=0, LAT --.
//   peripheral ---+--> pin <--> outside        PORT reads the pin, LAT the latch; writing either sets the
//   latch
//
// Modelled: implemented pins, outputs of peripherals that override LAT and TRIS, pins taken as inputs (open
// drain) by a peripheral, pull-ups, analogue pins of port B that read 0, edges that the chip makes itself on
// a pin which another peripheral watches, the one-cycle read synchroniser where asked for. Not modelled:
// contention with the outside (the chip wins), levels of serial lines bit by bit (owned pins read high).
// Source: [chip P1].
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "dspic30/periph/fabric.h"

namespace dspic {

/// Hears of edges that the chip itself makes on a pin that it watches.
class PinListener {
 public:
  virtual ~PinListener() = default;
  virtual void own_edge(Pin pin, Edge edge, Cycle at) = 0;
};

class Ports final : public SfrOwner {
 public:
  Ports(const Fabric& fabric, bool synchronised) : f_(fabric), synchronised_(synchronised) {}
  void attach();
  void reset(Cycle now);
  void watch(Pin pin, PinListener& listener);

  // --- for peripherals; effective from cycle `at`
  void own_output(Pin pin, bool level, Cycle at);
  void own_input(Pin pin, Cycle at);
  void release(Pin pin, Cycle at);
  void set_pull_ups(Port port, std::uint16_t mask) { state(port).pull_ups = mask; }
  bool is_analogue(int channel) const { return !(adpcfg_ >> channel & 1); }
  bool is_output(Pin pin) const { return (driven(state(pin.port)) >> pin.bit & 1) != 0; }
  /// Level of the pin itself, whatever ADPCFG says.
  bool level(Pin pin, Cycle at) const { return (pins(pin.port, at) >> pin.bit & 1) != 0; }
  std::uint16_t pins(Port port, Cycle at) const;
  /// Edges that the outside makes; none on a pin that the chip drives.
  std::int64_t edges(Pin pin, Edge edge, Cycle after, Cycle until) const;
  Cycle nth_edge(Pin pin, Edge edge, Cycle after, std::int64_t n) const;
  /// Pins of `port` as the program last read them, for change notification.
  std::uint16_t last_read(Port port) const { return state(port).last_read; }
  void note_read(Port port, Cycle now) { state(port).last_read = pins(port, now); }

  std::uint16_t read(unsigned address, Cycle now) override;
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;

 private:
  struct State {
    std::uint16_t implemented = 0;
    std::uint16_t tris = 0, lat = 0;
    std::uint16_t owned_out = 0, owned_in = 0, owned_levels = 0;
    std::uint16_t pull_ups = 0;
    std::uint16_t last_read = 0;
    std::uint16_t watched = 0;
    // what the outside was told last, and before that
    std::uint16_t levels = 0, driven = 0;
    std::uint16_t old_levels = 0, old_driven = 0;
    Cycle changed = -1;
    std::array<std::uint8_t, 16> vain_writes{};  // of an input's latch
  };
  struct Watch {
    Pin pin;
    PinListener* listener;
  };
  State& state(Port port) { return ports_[static_cast<std::size_t>(port)]; }
  const State& state(Port port) const { return ports_[static_cast<std::size_t>(port)]; }
  static std::uint16_t driven(const State& s) {
    return static_cast<std::uint16_t>(((~s.tris & ~s.owned_in) | s.owned_out) & s.implemented);
  }
  void publish(Port port, Cycle at);
  void look_for_blind_pins(Cycle now);
  void count_vain(Port port, std::uint16_t bits, Cycle now);
  /// Levels of the pins of `wanted`; the others' are anything. Asks the outside only when it decides one.
  std::uint16_t combine(Port port, std::uint16_t levels, std::uint16_t driven, Cycle at,
                        std::uint16_t wanted = 0xFFFF) const;
  std::uint16_t digital(Port port, std::uint16_t pins) const;

  Fabric f_;
  bool synchronised_;
  std::array<State, kPorts> ports_{};
  std::uint16_t adpcfg_ = 0;
  std::uint16_t blind_told_ = 0;  // pins of port B whose analogue setting has been reported
  std::vector<Watch> watches_;
};

}  // namespace dspic
