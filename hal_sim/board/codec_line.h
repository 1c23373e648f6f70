// SPDX-License-Identifier: MIT
// The Si3000 codec as its serial line finds it: words in the first slot of each frame, in which a set lowest
// bit asks that the next frame carry a control word for one of its registers.
//
//   frame    | 0x7FFF asks | 0x0413 register 4 := 0x13 | sample | sample | ...
//   bits      15..1 sample, 0 asks                control: 13 read, 12..8 register, 7..0 value
//
// In: reset pin, words with the cycle at which their last bit ended, the bit clock. Out: what the loudspeaker
// is given (registers' power-down, mute, digital volume and attenuation applied), as stretches of samples at
// even distances, and the codec's answers.
// Modelled: registers 1 to 9, software reset, sample rate by frames, and by bit clock, N1, M1 and divider.
// Not modelled: the codec's filters and delays, loopbacks; its inputs, to which the robot connects nothing,
// so that frames from the codec carry 0; a codec whose clocks disagree plays at the rate of the frames.
// Source: register map of the Si3000 [SI3000], see docs/dev/sources.md.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "hal_sim/board/cycle.h"
#include "hal_sim/board/first_use.h"

namespace board {

class CodecLine {
 public:
  /// First word.
  FirstUse first_use;

  /// Samples that leave the loudspeaker one after the other, a period apart.
  struct Stretch {
    Cycle first_at = 0;                                    ///< cycle at which sample 0 is put out
    Cycle period = 0;                                      ///< cycles from one sample to the next
    std::shared_ptr<std::vector<std::int16_t>> published;  ///< that the air knows of
    std::vector<std::int16_t> fresh;                       ///< since then
    std::int64_t size() const {
      return static_cast<std::int64_t>(published->size()) + static_cast<std::int64_t>(fresh.size());
    }
  };

  /// The reset pin; `on`: it is high and the codec works.
  void power(bool on);
  /// Cycles a bit on the line; the codec's master clock is the same.
  void set_bit_clock(Cycle cycles) { bit_cycles_ = cycles; }
  /// The word that began a frame, left-aligned in 16 bits; its last bit ended at `end`. Returns what the
  /// codec sent in that time.
  std::uint16_t word(std::uint16_t word, Cycle end);

  /// What the loudspeaker is given at `at`, -32768 to 32767; not before the last forget().
  int output(Cycle at) const;
  void forget(Cycle at);
  /// True from the first word on.
  bool was_used() const { return used_; }
  /// Words have come since it was last asked.
  bool take_activity();
  /// A sound goes on.
  bool is_heard() const { return open_; }
  /// The sample rate that registers and bit clock give, and that of the frames, Hz; 0 where unknown: a pause
  /// of the DCI between two frames is no period.
  double register_rate_hz() const;
  double frame_rate_hz() const;

  /// Samples have come, or a stretch ended, since the last publication.
  bool has_news() const { return news_; }
  /// At a tick boundary: fresh samples become published ones. The stretch that goes on; null: silence.
  const Stretch* publish();
  std::uint64_t state_hash() const;

 private:
  static constexpr int kRegisters = 10;
  void reset_registers();
  void write_register(unsigned number, std::uint8_t value);
  void sample(std::int16_t value, Cycle at);
  double gain() const;

  bool powered_ = false;
  bool used_ = false;
  bool active_ = false;  // words since take_activity()
  bool asked_ = false;   // the next frame is a control word
  bool news_ = false;
  bool open_ = false;     // the last stretch goes on
  bool is_even_ = false;  // the latest period is as long as the one before
  Cycle bit_cycles_ = 0;
  Cycle last_end_ = -1, last_sample_ = -1, period_ = 0;
  int zeros_ = 0;  // in a row at the end of the open stretch
  double gain_ = 0;
  std::array<std::uint8_t, kRegisters> registers_{};
  std::vector<Stretch> stretches_;
  std::uint64_t heard_hash_ = 0;
};

}  // namespace board
