// SPDX-License-Identifier: MIT
// The codec's end of the line: what it takes for the rate of the frames.
#include "hal_sim/board/codec_line.h"

#include <gtest/gtest.h>

namespace {

TEST(CodecLine, a_pause_between_two_sounds_is_no_period_of_frames) {
  constexpr board::Cycle kFrame = 2048;
  board::CodecLine line;
  line.power(true);
  board::Cycle now = 0;
  for (int i = 0; i < 4; ++i) line.word(0x100, now += kFrame);
  EXPECT_DOUBLE_EQ(line.frame_rate_hz(), 7200);
  // the driver switches the DCI off and on again
  line.word(0x100, now += 1191);
  EXPECT_EQ(line.frame_rate_hz(), 0);
  line.word(0x100, now += kFrame);
  EXPECT_EQ(line.frame_rate_hz(), 0);
  line.word(0x100, now += kFrame);
  EXPECT_DOUBLE_EQ(line.frame_rate_hz(), 7200);
}

}  // namespace
