// SPDX-License-Identifier: MIT
// INT0 to INT4 (RF6, RA12 to RA15) and change notification CN0 to CN23.
//
// Modelled: edge by INTCON2.INTxEP, edges that the chip makes itself on such a pin, CN enables and pull-ups,
// CNIF when an enabled pin comes to differ from what was last read of its port. While an INTx flag is set its
// edges are counted only when the flag is cleared. Not modelled: pulses shorter than a cycle; CNIF again
// while a mismatch lasts. Source: [chip P3], pins [DS70286C]; [?] two cycles from edge to flag, the
// reference of the comparison.
#pragma once
#include <array>
#include <cstdint>

#include "dspic30/periph/adc.h"
#include "dspic30/periph/ports.h"

namespace dspic {

class ExternalInterrupts final : public EventOwner, public FlagListener, public PinListener {
 public:
  ExternalInterrupts(const Fabric& fabric, Adc& adc) : f_(fabric), adc_(adc) {}
  void attach();
  void reset(Cycle now);
  void outside_changed(Cycle now);
  void converter_changed(Cycle now);  ///< the converter may or may not wait for INT0

  void on_event(int id, Cycle at) override;
  void flag_cleared(int irq, Cycle now) override;
  void edge_chosen(int irq, Cycle now) override;
  void own_edge(Pin pin, Edge edge, Cycle at) override;

 private:
  static constexpr int kLines = 5;
  Edge edge(int n) const { return f_.interrupts.control().falling_edge(n) ? Edge::Falling : Edge::Rising; }
  void schedule(int n, Cycle now);
  void forget_before(int n, Cycle now);

  const Fabric& f_;
  Adc& adc_;
  std::array<int, kLines> slots_{};
  std::array<Cycle, kLines> seen_{};      // edges up to here have been dealt with
  std::array<Cycle, kLines> own_flag_{};  // of an edge of the chip's own
  bool adc_waits_ = false;
};

class ChangeNotification final : public SfrOwner, public EventOwner, public PinListener {
 public:
  explicit ChangeNotification(const Fabric& fabric) : f_(fabric) {}
  void attach();
  void reset(Cycle now);
  void outside_changed(Cycle now);

  std::uint16_t read(unsigned address, Cycle now) override { return peek(address, now); }
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  void on_event(int id, Cycle at) override;
  void own_edge(Pin pin, Edge edge, Cycle at) override;

 private:
  void schedule(Cycle now);
  void compare(Cycle at);
  std::uint16_t watched(Port port) const;

  const Fabric& f_;
  int slot_ = -1, flag_slot_ = -1;
  std::uint32_t enabled_ = 0, pull_ups_ = 0;
  std::array<std::uint16_t, kPorts> levels_{};  // as the comparison saw them last
};

}  // namespace dspic
