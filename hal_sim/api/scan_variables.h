// SPDX-License-Identifier: MIT
// The converter driver's public variables as its handler would have left them, at the places that
// host_table.inc gives them. What a program writes stays until the handler writes that element; indices and
// counters go on from what was written.
#pragma once
#include <array>
#include <cstdint>
#include <memory>

#include "hal_sim/api/call_cycles.h"
#include "hal_sim/api/host_index.h"
#include "hal_sim/drivers/adc_scan.h"

namespace api {

class ScanVariables {
 public:
  /// Both outlive this.
  ScanVariables(drivers::AdcScan& scan, const CallCycles& cycles) : scan_(scan), cycles_(cycles) {}
  /// A reset of the chip: the drivers begin anew, words that nothing else writes stay.
  void reset();

  std::uint16_t read(unsigned address, Cycle at);
  /// Word `index` of an array of samples, by now.
  std::uint16_t read(HostVariable array, unsigned index, Cycle at) const {
    return sample({array, index}, at, true);
  }
  /// A sensor's dark word at one instant less its lit one at another, the difference as a word too.
  int dark_less_lit(unsigned sensor, Cycle dark_at, Cycle lit_at) const {
    return overlay_
               ? written_dark_less_lit(sensor, dark_at, lit_at)
               : static_cast<std::int16_t>(scan_.dark_less_lit(static_cast<int>(sensor), dark_at, lit_at));
  }
  /// Since the last reset.
  bool was_started() const { return scan_.starts() > 0; }
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle at);
  /// Until when a read gives the same, > at.
  Cycle horizon(unsigned address, Cycle at);
  std::uint16_t peek(unsigned address, Cycle at) const;

  /// e_init_ad_scan() sets the selector's variable and counts.
  void started(int selector);
  /// What the handler takes of each cycle, as a fraction of 2^32.
  std::uint64_t share_q32() const;

 private:
  struct Place {
    HostVariable which = HostVariable::Count;
    unsigned index = 0;  // word
  };
  static Place place_of(unsigned address);
  /// dark_less_lit() where a program has written samples.
  int written_dark_less_lit(unsigned sensor, Cycle dark_at, Cycle lit_at) const;
  struct Written {
    std::uint16_t value = 0;
    std::int64_t number = kNobody;  // of the newest sample then; kNobody: not written
  };
  static constexpr std::int64_t kNobody = -2;
  static constexpr int kMicWords = 3 * drivers::kMicSamples, kAccWords = 3 * drivers::kAccSamples;
  /// What a program has written; most write nothing.
  struct Overlay {
    std::array<Written, 10> dark{}, lit{};
    std::array<Written, kMicWords> mic{};
    std::array<Written, kAccWords> acc{};
  };
  /// A counter that the handler increments up to `most`, from what was written.
  struct Counter {
    std::uint16_t base = 0;
    std::int64_t since = 0;  // interrupts then
    std::uint16_t at(std::int64_t interrupts, int most) const;
  };

  std::int64_t filed(Cycle at) const;  // microphone samples
  /// Number of the newest sample of a ring's element, -1: none yet.
  static std::int64_t newest(std::int64_t count, std::int64_t offset, unsigned index, int ring);
  Written* written_at(Place place) const;
  bool is_left_out(Place place) const;
  std::int64_t number_of(Place place, Cycle at) const;
  std::uint16_t sample(Place place, Cycle at, bool keep) const;
  std::uint16_t value(unsigned address, Cycle at, bool keep) const;

  drivers::AdcScan& scan_;
  const CallCycles& cycles_;
  struct Share {
    Cycle taken = -1, of = 0;
    std::uint64_t q32 = 0;
  };
  mutable Share share_;  // asked for last
  std::unique_ptr<Overlay> overlay_;
  Counter ticks_, acc_refresh_;
  std::uint8_t beside_refresh_ = 0;  // byte behind updateAccI2CCounter, which is nobody's
  std::uint16_t selector_ = 0, starts_ = 0;
  std::int64_t mic_offset_ = 0,
               acc_offset_ = 0;  // of the rings: index less number, once an index was written
};

}  // namespace api
