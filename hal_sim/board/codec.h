// SPDX-License-Identifier: MIT
// The Si3000 codec and the loudspeaker behind it.
//
//   driver in closed form: stretches of the sound bank, put_out() --+
//   models of the chip: the DCI's words, codec_line.h --------------+--> AUDIO_ON, configured --> loudspeaker
//
// What reaches the loudspeaker is evaluated when asked. Not modelled: the codec's filters, recording. Source:
// [lib: codec/], facts restated; samples are our own (sound_bank.h).
#pragma once
#include <cstdint>
#include <vector>

#include "hal_sim/board/codec_line.h"
#include "hal_sim/board/sound_params.h"

namespace board {

class Codec {
 public:
  /// First start_frames(); the line has its own.
  FirstUse first_use;

  /// One stretch of the loudspeaker's life.
  struct Play {
    Cycle from = 0;          ///< it counts from this cycle on, until the next one does
    Cycle first_at = 0;      ///< cycle at which its first sample is put out
    std::int64_t first = 0;  ///< index of that sample in the bank
    std::int64_t count = 0;  ///< samples; 0 is silence
  };

  /// AUDIO_ON: the codec's reset pin.
  void power(bool on, Cycle at);
  /// The DCI's frames begin; the codec's clock.
  void start_frames(Cycle at);
  /// Since when there are frames; -1: there are none.
  Cycle frames_since() const { return frames_since_; }
  /// Its registers are written; needs power and frames.
  void configure() { configured_ = powered_ && frames_since_ >= 0; }
  bool is_configured() const { return configured_; }
  /// What the frames carry from play.from on, instead of what was to come.
  void put_out(const Play& play);
  /// The last stretch, which counts for ever, is no silence.
  bool sounds() const { return plays_.back().count > 0; }
  void reset(Cycle at);

  /// What the loudspeaker is given, -32768 to 32767. `at` not before the last forget().
  int output(Cycle at) const;
  /// What went on before `at` will not be asked for any more.
  void forget(Cycle at);

  /// The codec at the end of a modelled DCI. What leaves here is a robot's either way.
  CodecLine& line() { return line_; }
  const CodecLine& line() const { return line_; }

  /// True from the first start_frames(), or the first word of the line, on.
  bool was_used() const { return used_ || line_.was_used(); }
  /// Something began or ended since the last time the news was taken.
  bool has_news() const { return news_ || line_.has_news(); }
  /// What plays now, or will from the next group on.
  const Play& take_news();
  std::uint64_t state_hash() const;

 private:
  CodecLine line_;
  bool powered_ = false;
  bool configured_ = false;
  bool used_ = false;
  bool news_ = false;
  Cycle frames_since_ = -1;
  std::vector<Play> plays_{Play{}};  // in order of `from`; the last one counts for ever
};

}  // namespace board
