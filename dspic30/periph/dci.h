// SPDX-License-Identifier: MIT
// Data converter interface as the codec's master: DCICON1 to 3, DCISTAT, TSCON, RSCON,
// RXBUF0 to 3, TXBUF0 to 3.
//
//   TXBUF -> shadows -> CSDO       slots of WS+1 bits, COFSG+1 of them a frame
//   RXBUF <- shadows <- CSDI       after BLEN+1 enabled slots buffers and shadows change places: DCIIF
//
// Modelled: bit clock, words, frames, slots, buffers, RFUL, TMPTY, ROV, TUNF, SLOT, UNFM, DJST, DLOOP. Words
// are worked out at the transfers, each with the instant of its own end. Not modelled: clock or frame sync
// from outside (CSCKD, COFSD), I2S and AC-Link framing (COFSM), CSCKE and CSDOM (no digital effect on words),
// DCISIDL; DCIEN = 0 stops at once and not at the end of the frame. Source: [chip P7]; [?] delay from DCIEN
// to the first frame, when ROV and TUNF clear.
#pragma once
#include <array>
#include <cstdint>

#include "dspic30/periph/ports.h"

namespace dspic {

class Dci final : public SfrOwner, public EventOwner {
 public:
  explicit Dci(const Fabric& fabric) : f_(fabric) {}
  void attach();
  void reset(Cycle now);
  /// Words that ended up to `now` have been exchanged with the outside.
  void advance(Cycle now);

  std::uint16_t read(unsigned address, Cycle now) override;
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;
  void on_event(int id, Cycle at) override;

 private:
  static constexpr std::uint16_t kOn = sfr_bits("DCICON1", "DCIEN");
  static constexpr SfrBits kWs = sfr_field("DCICON2", "WS"), kCofsg = sfr_field("DCICON2", "COFSG"),
                           kBlen = sfr_field("DCICON2", "BLEN"), kBcg = sfr_field("DCICON3", "BCG");
  bool runs() const { return (con1_ & kOn) && kBcg.of(con3_); }
  int bits() const { return static_cast<int>(kWs.of(con2_)) + 1; }
  int frame_words() const { return static_cast<int>(kCofsg.of(con2_)) + 1; }
  int buffer_words() const { return static_cast<int>(kBlen.of(con2_)) + 1; }
  Cycle bit() const { return 2 * (Cycle{kBcg.of(con3_)} + 1); }
  Cycle word() const { return bits() * bit(); }
  std::uint16_t slots() const;
  Cycle slot_end(std::int64_t n) const;  // of the n-th enabled slot, 0 first
  int slot_number(std::int64_t n) const;
  int slot_in_progress(Cycle now) const;
  void start(Cycle now);
  void transfer();
  void schedule();

  const Fabric& f_;
  int slot_ = -1;
  std::uint16_t con1_ = 0, con2_ = 0, con3_ = 0, stat_ = 0, tscon_ = 0, rscon_ = 0;
  std::array<std::uint16_t, 4> rx_{}, tx_{}, rx_shadow_{}, tx_shadow_{};
  bool written_ = false;     // TXBUF since the last transfer
  Cycle first_ = 0;          // first bit of the first frame
  std::int64_t passed_ = 0;  // enabled slots that are over
  int index_ = 0;            // of the shadows
};

}  // namespace dspic
