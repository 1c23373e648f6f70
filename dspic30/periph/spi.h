// SPDX-License-Identifier: MIT
// SPI 1 or 2 as master: SPIxSTAT, SPIxCON, SPIxBUF.
//
// Modelled: 8 and 16 bits, both prescalers, SPITBF, SPIRBF, SPIROV, flag, pins. A word reaches the outside
// when it is complete. Not modelled: slave mode (MSTEN = 0), framed mode (FRMEN, SPIFSD), SSEN, SPISIDL; CKE,
// CKP and SMP have no effect on whole words. Source: [chip P8], pins [DS70286C].
#pragma once
#include <cstdint>

#include "dspic30/periph/ports.h"

namespace dspic {

class Spi final : public SfrOwner, public EventOwner {
 public:
  Spi(const Fabric& fabric, int number) : f_(fabric), number_(number), base_(kBases[number - 1]) {}
  void attach();
  void reset(Cycle now);

  std::uint16_t read(unsigned address, Cycle now) override;
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;
  void on_event(int id, Cycle at) override;

 private:
  static constexpr unsigned kBases[2] = {sfr("SPI1STAT"), sfr("SPI2STAT")};
  static constexpr std::uint16_t kOn = sfr_bits("SPI1STAT", "SPIEN"), kMode16 = sfr_bits("SPI1CON", "MODE16");
  bool on() const { return (stat_ & kOn) != 0; }
  int bits() const { return (con_ & kMode16) ? 16 : 8; }
  Cycle clock() const;
  void start(Cycle now);

  const Fabric& f_;
  int number_;
  unsigned base_;
  int slot_ = -1;
  std::uint16_t stat_ = 0, con_ = 0;
  std::uint16_t waiting_ = 0, shifting_ = 0, received_ = 0;
  bool has_waiting_ = false, is_shifting_ = false;
};

}  // namespace dspic
