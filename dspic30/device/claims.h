// SPDX-License-Identifier: MIT
// Who set up which timer, converter, serial module and vector: two authors on one of them are reported.
//
// An author is whoever the host names (a source file, a driver). A resource is claimed by writing its set-up
// registers: TxCON and PRx, ADCONx and ADCSSL, UxMODE and UxBRG, I2CBRG, DCICONx, SPIxCON, ICxCON, OCxCON,
// and by enabling a vector in IECx. Pins are shared on purpose (LEDs) and not watched.
#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "dspic30/memory/diagnosis.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

class Claims {
 public:
  explicit Claims(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}
  /// The text outlives the chip; null: nobody.
  void set_author(const char* author) { author_ = author; }
  /// Reset: nothing is set up.
  void clear() { owners_.fill(nullptr); }
  /// The author writes this register.
  void note_write(unsigned address, Cycle now) {
    if (author_) claim_register(address, now);
  }
  /// The author enables these IRQs.
  void note_enabled(std::uint64_t irqs, Cycle now);

 private:
  // resources: modules first, vectors from kFirstVector on
  static constexpr std::size_t kFirstVector = 64, kResources = kFirstVector + kIrqs;
  void claim_register(unsigned address, Cycle now);
  void claim(std::size_t resource, const std::string& name, Cycle now);

  Diagnostics& diagnostics_;
  const char* author_ = nullptr;
  std::array<const char*, kResources> owners_{};
};

}  // namespace dspic
