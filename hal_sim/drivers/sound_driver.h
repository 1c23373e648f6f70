// SPDX-License-Identifier: MIT
// codec/e_sound.c: sounds of the bank, put out by the data converter interface (DCI).
//
//   e_play_sound -> four words in the DCI's buffers --every 4 samples--> out, to board::Codec
//                   ^-- the interrupt brings four new words ---'
//
// For programs of the PC: what the interrupt handler puts out is told to the codec in closed form. Modelled:
// 7200 samples a second in groups of four, the pointer that is moved before it is read (so a sound lacks its
// first sample and has one more at its end), lengths that are no multiple of four and never end, silence
// without e_init_sound() or after e_close_sound(). Source: [lib: codec/], facts restated.
#pragma once
#include "hal_sim/board/codec.h"

namespace drivers {

using board::Cycle;

class SoundDriver {
 public:
  explicit SoundDriver(board::Codec& codec) : codec_(codec) {}

  /// e_init_dci_master(): frames begin. e_init_codec_slave() is codec().configure().
  void start(Cycle at) { codec_.start_frames(at); }
  board::Codec& codec() { return codec_; }
  /// First cycle after `at` at which four samples go out and the interrupt comes; kNever when the DCI is off.
  Cycle next_group(Cycle at) const;
  /// e_sub_dci_kickoff(): `length` samples from `offset` on, beginning with the next group.
  void play(int offset, int length, Cycle at);
  /// No further groups: silence once the one that is under way is over.
  void stop(Cycle at);

 private:
  board::Codec& codec_;
};

}  // namespace drivers
