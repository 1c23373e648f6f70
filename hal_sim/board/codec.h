// SPDX-License-Identifier: MIT
// The Si3000 codec behind the data converter interface (DCI), as codec/e_sound.c runs them.
//
//   e_play_sound -> four words in the DCI's buffers -> every 4 samples: buffers out, interrupt, four new
//   words
//                                                      -> codec (AUDIO_ON, configured) -> loudspeaker
//
// The interrupt handler itself runs in the firmware image (hal_sim/api/e_sound.c), since it keeps two
// variables that programs read and write; what reaches the loudspeaker is evaluated here, in closed form.
// Modelled: 7200 samples a second in groups of four, the driver's pointer that is moved before it is read (so
// a sound lacks its first sample and has one more at its end), the lowest bit cleared, lengths that are no
// multiple of four and never end, silence without e_init_sound() or after e_close_sound(). Not modelled: the
// codec's filters, recording. Programs whose DCI is a model of the chip (the register way) reach the codec
// word by word instead: codec_line.h. Source: [lib: codec/], facts restated; samples are our own
// (sound_bank.h).
#pragma once
#include <cstdint>
#include <vector>

#include "hal_sim/board/codec_line.h"
#include "hal_sim/board/sound_params.h"

namespace board {

class Codec {
 public:
  /// One stretch of the loudspeaker's life.
  struct Play {
    Cycle from = 0;          ///< it counts from this cycle on, until the next one does
    Cycle first_at = 0;      ///< cycle at which its first sample is put out
    std::int64_t first = 0;  ///< index of that sample in the bank
    std::int64_t count = 0;  ///< samples; 0 is silence
  };

  /// AUDIO_ON: the codec's reset pin.
  void power(bool on, Cycle at);
  /// e_init_dci_master(): frames begin.
  void start_dci(Cycle at);
  /// e_init_codec_slave(): registers written; needs power and frames.
  void configure();
  bool dci_runs() const { return dci_since_ >= 0; }
  /// First cycle after `at` at which four samples go out and the interrupt comes; kNever when the DCI is off.
  Cycle next_group(Cycle at) const;

  /// e_sub_dci_kickoff(): `length` samples from `offset` on, beginning with the next group.
  void play(int offset, int length, Cycle at);
  /// No further groups: silence once the one that is under way is over.
  void stop(Cycle at);
  void reset(Cycle at);

  /// What the loudspeaker is given, -32768 to 32767. `at` not before the last forget().
  int output(Cycle at) const;
  /// What went on before `at` will not be asked for any more.
  void forget(Cycle at);

  /// The codec at the end of a modelled DCI. What leaves here is a robot's either way.
  CodecLine& line() { return line_; }
  const CodecLine& line() const { return line_; }

  /// True from the first start_dci(), or the first word of the line, on.
  bool was_used() const { return used_ || line_.was_used(); }
  /// Something began or ended since the last time the news was taken.
  bool has_news() const { return news_ || line_.has_news(); }
  /// What plays now, or will from the next group on.
  const Play& take_news();
  std::uint64_t state_hash() const;

 private:
  void begin(const Play& play);

  CodecLine line_;
  bool powered_ = false;
  bool configured_ = false;
  bool used_ = false;
  bool news_ = false;
  Cycle dci_since_ = -1;
  std::vector<Play> plays_{Play{}};  // in order of `from`; the last one counts for ever
};

}  // namespace board
