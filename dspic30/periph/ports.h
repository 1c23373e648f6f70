// SPDX-License-Identifier: MIT
// Ports A B C D F G: TRIS, PORT, LAT, ADPCFG, and who owns a pin.
//
//   TRIS=0, LAT --.                        reading PORT gives the pin, reading LAT the latch;
//   peripheral ---+--> pin <--> outside    writing either sets the latch
//
// Modelled: implemented pins, outputs of peripherals that override LAT and TRIS, pins taken as inputs (open
// drain) by a peripheral, pull-ups, analogue pins of port B that read 0, edges that the chip makes itself on
// a pin which another peripheral watches, the one-cycle read synchroniser. Not modelled: contention with the
// outside (the chip wins), levels of serial lines bit by bit (owned pins read high). Source: [chip P1].
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
  explicit Ports(const Fabric& fabric) : f_(fabric) {}
  void attach();
  void reset(Cycle now);
  void watch(Pin pin, PinListener& listener);
  /// Whether a listener hears anything at present; at first it does.
  void set_hearing(const PinListener& listener, bool hears);

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

  /// Port whose LAT register is at `address`; -1: none.
  static int latch_at(unsigned address) {
    static constexpr signed char kLatchAt[] = {-1, -1, 0,  -1, -1, 1,  -1, -1, 2,  -1, -1,
                                               3,  -1, -1, -1, -1, -1, 4,  -1, -1, 5};
    const unsigned word = (address - kFirst) / 2;
    return word < sizeof kLatchAt ? kLatchAt[word] : -1;
  }
  std::uint16_t latch(int port) const { return ports_[static_cast<std::size_t>(port)].lat; }
  /// write() of a LAT register, all of it.
  void write_latch(int port, std::uint16_t next, Cycle now) {
    State& s = ports_[static_cast<std::size_t>(port)];
    const auto changed = static_cast<std::uint16_t>(next ^ s.lat);
    if (!changed) return;
    if (changed & ~s.plain_outputs) return write(kBases[port] + 4, next, 0xFFFF, now);
    s.lat = next;
    put_out(static_cast<Port>(port), static_cast<std::uint16_t>(s.levels ^ changed), s.driven, now + 1);
  }

  std::uint16_t read(unsigned address, Cycle now) override;
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;

 private:
  static Port port_of(unsigned address) {
    int p = kPorts - 1;
    while (address < kBases[p]) --p;
    return static_cast<Port>(p);
  }
  static constexpr unsigned kFirst = sfr("TRISA");
  static constexpr unsigned kBases[kPorts] = {sfr("TRISA"), sfr("TRISB"), sfr("TRISC"),
                                              sfr("TRISD"), sfr("TRISF"), sfr("TRISG")};
  struct State {
    std::uint16_t implemented = 0;
    std::uint16_t plain_outputs = 0;  // outputs that are the latch's alone, and that nobody watches
    std::uint16_t tris = 0, lat = 0;
    std::uint16_t owned_out = 0, owned_in = 0, owned_levels = 0;
    std::uint16_t pull_ups = 0;
    std::uint16_t last_read = 0;
    std::uint16_t heard = 0;  // watched by somebody who does something about it now
    // what the outside was told last, and before that
    std::uint16_t levels = 0, driven = 0;
    std::uint16_t old_levels = 0, old_driven = 0;
    Cycle changed = -1;
    std::array<std::uint8_t, 16> vain_writes{};  // of an input's latch
  };
  struct Watch {
    PinListener* listener = nullptr;
    std::array<std::uint16_t, kPorts> pins{};
    bool hears = true;
  };
  State& state(Port port) { return ports_[static_cast<std::size_t>(port)]; }
  const State& state(Port port) const { return ports_[static_cast<std::size_t>(port)]; }
  static std::uint16_t driven(const State& s) {
    return static_cast<std::uint16_t>(((~s.tris & ~s.owned_in) | s.owned_out) & s.implemented);
  }
  void publish(Port port, Cycle at);
  void put_out(Port port, std::uint16_t levels, std::uint16_t driven_now, Cycle at) {
    State& s = state(port);
    if (at != s.changed) {
      s.old_driven = s.driven;
      s.old_levels = s.levels;
    }
    s.changed = at;
    s.driven = driven_now;
    s.levels = levels;
    f_.outside.pins_driven(port, levels, driven_now, s.owned_out, at);
  }
  static void find_plain_outputs(State& s) {
    s.plain_outputs = static_cast<std::uint16_t>(s.driven & ~s.owned_out & ~s.heard);
  }
  void look_for_blind_pins(Cycle now);
  void count_vain(Port port, std::uint16_t bits, Cycle now);
  /// Levels of the pins of `wanted`; the others' are anything. Asks the outside only when it decides one.
  std::uint16_t combine(Port port, std::uint16_t levels, std::uint16_t driven, Cycle at,
                        std::uint16_t wanted = 0xFFFF) const;
  std::uint16_t digital(Port port, std::uint16_t pins) const;

  const Fabric& f_;
  std::array<State, kPorts> ports_{};
  std::uint16_t adpcfg_ = 0;
  std::uint16_t blind_told_ = 0;  // pins of port B whose analogue setting has been reported
  std::vector<Watch> watches_;
};

}  // namespace dspic
