// SPDX-License-Identifier: MIT
// The 12-bit converter: ADCON1, 2, 3, ADCHS, ADCSSL, ADCBUF0 to F.
//
//   SAMP=1 --sampling--> trigger: SAMP=0, held --14 TAD--> ADCBUF[n], DONE=1 --every SMPI+1--> ADIF
//     ^------------- ASAM ------------------------------'
//
// Modelled: scan and single channel, ALTS, SSRC 0 (software), 1 (INT0), 2 (timer 3), 7 (after SAMC), ASAM,
// SMPI, BUFM with BUFS, FORM, ADON at any moment, TAD in half cycles, ADRC as a fixed period. The input is
// held at the end of sampling and asked for at that instant. Conversions within one interrupt's period are
// worked out together. Not modelled: VCFG and CH0NA/CH0NB (AVDD, AVSS), ADSIDL, settling of the input,
// invalid results of too short a sampling time. A converter that samples, converts and scans by itself
// cruises: nothing is done per conversion, and a result is worked out when it is read. Source: [chip P4]; [?]
// ADIF one cycle after the end, one TAD between clearing SAMP and the conversion, scan position when SMPI+1
// differs from the number of inputs.
#pragma once
#include <array>
#include <cstdint>

#include "dspic30/periph/timers.h"

namespace dspic {

class Adc final : public SfrOwner, public EventOwner, public TimerListener {
 public:
  Adc(const Fabric& fabric, Timers& timers) : f_(fabric), timers_(timers) {}
  void attach();
  void reset(Cycle now);
  /// Inputs held up to `now` have been asked for: before pins or the outside change.
  void advance(Cycle now) {
    if (!on()) return;
    if (cruising_) {
      if (2 * now - cruise_.start >= cruise_.sequence) cruise(now);
    } else {
      advance_by_stages(now);
    }
  }
  /// Port B is another, or ADPCFG: what is converted is checked once more.
  void pins_changed() { fine_ = 0; }
  /// Edge of INT0's active polarity.
  void int0_edge(Cycle at);
  bool wants_int0() const { return sampling_ && ssrc() == 1; }

  static constexpr unsigned kBuffer = 0x280, kBufferEnd = 0x2A0;  ///< ADCBUF0 to F
  /// Does it run by itself, so that read_result() may be asked?
  bool is_cruising() const { return cruising_; }
  /// read() of ADCBUF`slot`, when all events up to `now` have happened.
  std::uint16_t read_result(int slot, Cycle now);
  /// Bits 8 to 15 of ADCON1, which it does not change by itself; others are 0.
  std::uint16_t upper_control() const { return con1_ & 0xFF00; }
  /// Off, nothing goes by its registers until it is switched on. What is read of one of them then, ADCON1
  /// apart; null: it is on, or this is another.
  const std::uint16_t* idle_word(unsigned address) const {
    if (on()) return nullptr;
    switch (address) {
      case sfr("ADCON2"):
        return &con2_;
      case sfr("ADCON3"):
        return &con3_;
      case sfr("ADCHS"):
        return &chs_;
      case sfr("ADCSSL"):
        return &cssl_;
      default:
        return nullptr;
    }
  }
  /// write() of all bits of an idle_word().
  void write_idle(unsigned address, std::uint16_t value) {
    auto* const word = const_cast<std::uint16_t*>(idle_word(address));
    *word = word == &con2_ ? static_cast<std::uint16_t>(value & ~kBufs) : value;
  }
  std::uint16_t read(unsigned address, Cycle now) override;
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;
  void on_event(int id, Cycle at) override;
  void timer_matched(int timer, Cycle at) override;

 private:
  // half cycles: TAD may be an odd number of them
  using Half = std::int64_t;
  static Cycle up(Half h) { return (h + 1) >> 1; }
  void set_times();
  static constexpr SfrBits kSsrc = sfr_field("ADCON1", "SSRC"), kSmpi = sfr_field("ADCON2", "SMPI");
  static constexpr std::uint16_t kAsam = sfr_bits("ADCON1", "ASAM"), kOn = sfr_bits("ADCON1", "ADON"),
                                 kBufs = sfr_bits("ADCON2", "BUFS");
  int ssrc() const { return static_cast<int>(kSsrc.of(con1_)); }
  bool asam() const { return (con1_ & kAsam) != 0; }
  bool on() const { return (con1_ & kOn) != 0; }
  int per_interrupt() const { return static_cast<int>(kSmpi.of(con2_)) + 1; }

  /// Does the converter run by itself, each sequence as the one before?
  bool is_regular() const;
  void start_cruising(Half at);
  void cruise(Cycle now);
  void advance_by_stages(Cycle now);
  __attribute__((noinline)) void irregular_event(Cycle at);
  void stop_cruising(Cycle now);
  /// Results of the cruise, to the buffer; it is to end.
  void keep_results(Cycle now);
  /// Nothing of a cruise has been held yet.
  bool is_fresh(Cycle now) const { return 2 * now < cruise_.first + cruise_.sample; }
  /// Is the sequence that begins one as all that follow, and its inputs are known to be fine?
  bool begins_regularly() const;
  /// Instant at which what a slot of the buffer holds at `now` was held; below cruise_.first: before the
  /// cruise, or never.
  Half held_instant(int slot, Cycle now) const;
  std::uint16_t cruised_result(int channel, Half held) const;
  /// What a slot of the buffer holds at `now`.
  std::uint16_t slot_now(int slot, Cycle now) const;

  void start_sampling(Half at);
  void hold(Half at, Half conversion_start);
  void finish();
  void restart_sequence();
  int channel() const;
  void next_channel();
  std::uint16_t formatted(int counts) const;
  Half next_stage() const {
    if (converting_) return conversion_end_;
    if (sampling_ && ssrc() == 7) return sampling_since_ + sample_time_;
    return 2 * kNever;
  }
  void schedule(Cycle now);
  void check_channel(int channel, Cycle at);
  void changed_while_on(unsigned address, Cycle now);

  const Fabric& f_;
  Timers& timers_;
  int slot_ = -1;
  std::uint16_t con1_ = 0, con2_ = 0, con3_ = 0, chs_ = 0, cssl_ = 0;
  std::array<std::uint16_t, 16> buffer_{};
  Half tad_ = 1, sample_time_ = 0, conversion_time_ = 0;  // of ADCON3
  bool sampling_ = false, converting_ = false;
  Half sampling_since_ = 0;
  Half conversion_end_ = 0;
  Cycle flag_at_ = kNever;  // of a sequence that is complete
  int held_ = 0;            // counts
  int pointer_ = 0;         // next ADCBUF
  int count_ = 0;           // conversions since the last interrupt
  bool upper_half_ = false;
  int scan_at_ = -1;  // input of ADCSSL in turn
  bool mux_b_ = false;
  bool wants_timer_ = false;
  std::uint16_t complained_ = 0;    // channels
  std::uint16_t fine_ = 0;          // channels whose pins were checked, and nothing was wrong
  std::uint16_t changed_told_ = 0;  // registers from ADCON1 on
  bool begun_ = false;              // a whole sequence was done stage by stage since the converter was set up
  bool cruising_ = false;
  struct {
    Half sample = 0, cycle = 1, sequence = 1;  // sampling; one conversion with it; all of a sequence
    int count = 0;                             // conversions in a sequence
    std::array<std::uint8_t, 16> channel{};
    std::array<Half, 16> held{}, done{};  // instants of a slot within its sequence; held in none: far below 0
    Half first = 0;                       // start of the first sequence
    Half start = 0;                       // of the one under way
  } cruise_;
  /// ADCON1.FORM: a result is ((counts ^ flip) << shift) - zero.
  struct Form {
    int flip, shift, zero;
  };
  static constexpr Form kForms[] = {{0, 0, 0}, {0, 0, 0x800}, {0, 4, 0}, {0x800, 4, 0}};
  Form form_ = kForms[0];
  std::array<Half, 16> result_of_{};  // instant at which what stands in the buffer was held
};

// --- results of a cruise, what handlers read most

inline std::uint16_t Adc::formatted(int counts) const {
  return static_cast<std::uint16_t>(((counts ^ form_.flip) << form_.shift) - form_.zero);
}

inline std::uint16_t Adc::cruised_result(int channel, Half held) const {
  return formatted(f_.outside.analogue_counts(channel, held >> 1));
}

inline Adc::Half Adc::held_instant(int slot, Cycle now) const {
  const auto s = static_cast<std::size_t>(slot);
  const bool done = cruise_.start + cruise_.done[s] <= 2 * now;
  return (done ? cruise_.start : cruise_.start - cruise_.sequence) + cruise_.held[s];
}

__attribute__((always_inline)) inline std::uint16_t Adc::read_result(int slot, Cycle now) {
  const auto s = static_cast<std::size_t>(slot);
  const Half held = held_instant(slot, now);
  if (held < cruise_.first || result_of_[s] == held) return buffer_[s];
  result_of_[s] = held;
  return buffer_[s] = cruised_result(cruise_.channel[s], held);
}

}  // namespace dspic
