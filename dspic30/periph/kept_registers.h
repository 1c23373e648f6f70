// SPDX-License-Identifier: MIT
// Registers that hold what was written, with the few side effects that they have here.
//
//   CpuRegisters: 0x000 to 0x052. SR.IPL and DISICNT act; W0 to W15, accumulators, CORCON, TBLPAG, PSVPAG and
//     the rest are words. A model of the core answers for this range itself.
//   Can: CAN 1 and 2. REQOP is mirrored into OPMODE; no message is sent or received.
//   PlainRegisters: BSRAM, SSRAM, PMD1 to 3 (their effect is the chip's).
//
// Source: [chip P10], [chip C2].
#pragma once
#include <array>
#include <cstdint>
#include <map>

#include "dspic30/periph/fabric.h"

namespace dspic {

class CpuRegisters final : public SfrOwner {
 public:
  explicit CpuRegisters(const Fabric& fabric) : f_(fabric) {}
  void attach();
  void reset();
  std::uint16_t read(unsigned address, Cycle now) override { return peek(address, now); }
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;

 private:
  static constexpr unsigned kEnd = 0x054;
  const Fabric& f_;
  std::array<std::uint16_t, kEnd / 2> words_{};
};

class PlainRegisters final : public SfrOwner {
 public:
  explicit PlainRegisters(const Fabric& fabric) : f_(fabric) {}
  void attach(unsigned first, unsigned last);
  void reset();
  std::uint16_t word(unsigned address) const;
  std::uint16_t read(unsigned address, Cycle /*now*/) override { return word(address); }
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle /*now*/) override {
    words_[address] = merge_lanes(word(address), value, lanes);
  }
  std::uint16_t peek(unsigned address, Cycle /*now*/) const override { return word(address); }

 private:
  const Fabric& f_;
  std::map<unsigned, std::uint16_t> words_;
};

class Can final : public SfrOwner {
 public:
  Can(const Fabric& fabric, int number) : f_(fabric), base_(kBases[number - 1]) {}
  void attach();
  void reset();
  std::uint16_t read(unsigned address, Cycle now) override { return peek(address, now); }
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;

 private:
  static constexpr unsigned kBases[2] = {sfr("C1RXF0SID"), sfr("C2RXF0SID")};
  unsigned control() const { return base_ - kBases[0] + sfr("C1CTRL"); }
  unsigned errors() const { return base_ - kBases[0] + sfr("C1EC"); }
  const Fabric& f_;
  unsigned base_;
  std::map<unsigned, std::uint16_t> words_;
  int mode_ = 4, next_mode_ = 4;
  Cycle mode_from_ = 0;
};

}  // namespace dspic
