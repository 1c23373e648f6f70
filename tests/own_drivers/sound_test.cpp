// SPDX-License-Identifier: MIT
// Sound: the library's codec driver, and programs that write the DCI themselves, against the samples and
// instants worked out from the chip's documents and the codec's registers.
#include <algorithm>
#include <cmath>

#include "hal_sim/board/sound_bank.h"
#include "hal_sim/signals/signals.h"
#include "sim_core/sound/sound_field.h"
#include "tests/own_drivers/fixture.h"
#include "tests/support/wording.h"

namespace own_drivers {
namespace {

// what left the loudspeaker, a value each `period` cycles from the first that is not 0 on
struct Speech {
  std::vector<int> samples;
  host::Cycle begin = -1;
};

class Sound : public OwnDrivers {
 protected:
  Speech listen(int robot, double seconds, host::Cycle period = 2048) {
    Speech speech;
    const board::Board& board = twin().mind(robot).board();
    host::Cycle next = 0;
    const double until = now_s() + seconds;
    while (now_s() < until - 1e-9) {
      const host::Cycle from = twin().mind(robot).now();
      run_for(1.0 / 512);
      const host::Cycle to = twin().mind(robot).now();
      for (host::Cycle at = from; speech.begin < 0 && at < to; ++at)
        if (board.codec().output(at) != 0) next = speech.begin = at;
      for (; speech.begin >= 0 && next < to; next += period)
        speech.samples.push_back(board.codec().output(next));
    }
    while (!speech.samples.empty() && speech.samples.back() == 0) speech.samples.pop_back();
    return speech;
  }
};

// "spaah": 1760 samples from number 2116 on; the driver moves before it reads, so 2117 to 3876
TEST_F(Sound, the_loudspeaker_gets_the_banks_samples_one_by_one) {
  add_robot_with_source(R"(
#include <codec/e_sound.h>
#include <motor_led/e_init_port.h>
extern volatile int e_dci_unavailable;
int main(void) { e_init_port(); e_init_sound(); e_play_sound(2116, 1760); while (1); })");
  run_for(1.0 / 512);
  const Speech heard = listen(0, 0.36);
  const auto& bank = *board::sound_bank();
  std::vector<int> expected(bank.begin() + 2117, bank.begin() + 2117 + 1760);
  while (expected.back() == 0) expected.pop_back();
  expected.erase(expected.begin(), std::find_if(expected.begin(), expected.end(), [](int v) { return v; }));
  EXPECT_EQ(heard.samples, expected);
  expect_no_traps();
}

TEST_F(Sound, a_closed_codec_is_silent_at_once) {
  add_robot_with_source(R"(
#include <codec/e_sound.h>
#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>
int main(void) {
  long i;
  e_init_port();
  e_init_sound();
  e_play_sound(11028, 8016);
  for (i = 0; i < 60000; i++) asm("nop");
  e_close_sound();
  while (1);
})");
  const Speech heard = listen(0, 0.3);
  EXPECT_GT(heard.samples.size(), 100u);
  EXPECT_LT(heard.samples.size(), 1500u);
  const auto& codec = twin().mind(0).board().codec();
  EXPECT_EQ(codec.output(twin().mind(0).now()), 0);
  // the air falls silent once the last sample has left the range of 20 m
  run_for(0.2);
  EXPECT_TRUE(twin().simulation().sound().is_silent());
}

// --- programs that write the DCI themselves

// Set-up as the codec wants it: reset, 8-word frames with control words, then 16-word frames. VOLUME and RATE
// are registers 7 and the multiplier; FRAME is DCICON2 while playing.
std::string own_codec(const std::string& volume, const std::string& frame,
                      const std::string& multiplier = "0x13") {
  return program(R"(
static const unsigned int controls[5] = {0x0300, 0x0400 | )" +
                 multiplier + R"(, 0x0118, 0x0200, 0x0700 | )" + volume + R"(};
unsigned int interrupts, phase;
void _ISR _DCIInterrupt(void)
{
  IFS2bits.DCIIF = 0;
  (void)RXBUF0; (void)RXBUF1; (void)RXBUF2; (void)RXBUF3;
  TXBUF0 = TXBUF1 = 8000;
  TXBUF2 = TXBUF3 = -8000;
  interrupts++;
}
int main(void)
{
  int i;
  TRISFbits.TRISF0 = 0;
  TRISG = 0x1FFF;
  LATFbits.LATF0 = 0;
  for (i = 0; i < 100; i++) Nop();
  LATFbits.LATF0 = 1;
  DCICON1 = 0x0040;
  DCICON2 = 0x04EF;
  DCICON3 = 3;
  TSCON = RSCON = 1;
  TXBUF0 = 0x7FFF;
  TXBUF1 = controls[0];
  DCICON1bits.DCIEN = 1;
  for (i = 1; i < 5; i++) {
    while (!DCISTATbits.TMPTY);
    TXBUF0 = 0x7FFF;
    TXBUF1 = controls[i];
  }
  while (!DCISTATbits.TMPTY);
  TXBUF0 = TXBUF1 = 0;
  _DCIIF = 0;
  while (!_DCIIF);
  DCICON1bits.DCIEN = 0;
  DCICON2 = )" + frame +
                 R"(;
  _DCIIF = 0;
  _DCIIE = 1;
  TXBUF0 = TXBUF1 = 8000;
  TXBUF2 = TXBUF3 = -8000;
  DCICON1bits.DCIEN = 1;
  while (1);
}
)");
}

// 16 words of 16 bits of 8 cycles: 7200 samples a second; two up, two down: 1800 Hz. The four samples loaded
// before the module is switched on go out at once; what the handler loads at the first interrupt follows four
// frames later, and zeros between
TEST_F(Sound, own_handler_plays_a_square_wave) {
  Robot& player = add_robot_with_source(own_codec("0x5F", "0x0DEF"));
  const Speech heard = listen(0, 0.1);
  ASSERT_GT(heard.samples.size(), 500u);
  for (std::size_t i = 10; i < 400; ++i)
    EXPECT_EQ(heard.samples[i], heard.samples[i - 2] == 8000 ? -8000 : 8000) << i;
  const int before = player.variable<std::uint16_t>("interrupts");
  run_for(1);
  EXPECT_NEAR(player.variable<std::uint16_t>("interrupts") - before, 1800, 1);
  EXPECT_NEAR(signals::find(twin(), 0, "speaker").value(twin()), 100 * 8000.0 / 32768, 0.1);
  EXPECT_EQ(robot(0).diagnoses_text().find("codec"), std::string::npos) << robot(0).diagnoses_text();
  expect_no_traps();
}

// register 7 counts 1.5 dB a step around 0x17: 0x13 is -6 dB (a factor of 0.501187: 4009.498); bits 1 and 0
// unmute the loudspeakers
TEST_F(Sound, volume_and_mute_are_the_codecs_registers) {
  add_robot_with_source(own_codec("(0x13 << 2 | 3)", "0x0DEF"));
  add_robot_with_source(own_codec("(0x17 << 2)", "0x0DEF")).at(0.5, 0);
  const Speech quiet = listen(0, 0.05);
  ASSERT_GT(quiet.samples.size(), 200u);
  for (std::size_t i = 8; i < 200; ++i) EXPECT_EQ(std::abs(quiet.samples[i]), 4009) << i;
  EXPECT_TRUE(listen(1, 0.02).samples.empty());
}

// frames of 8 words come 14400 times a second; the codec's own clock still makes 7200: told, and played at
// the frames' rate
TEST_F(Sound, frames_at_another_rate_than_the_codecs_are_told) {
  add_robot_with_source(own_codec("0x5F", "0x0CEF"));
  const Speech heard = listen(0, 0.05, 1024);
  ASSERT_GT(heard.samples.size(), 200u);
  for (std::size_t i = 10; i < 200; ++i)
    EXPECT_EQ(heard.samples[i], heard.samples[i - 2] == 8000 ? -8000 : 8000) << i;
  EXPECT_TRUE(
      wording::reads(robot(0).diagnoses_text(),
                     "codec: codec rate: codec: its registers 3 and 4 and the bit clock give 7200 samples a "
                     "second, frames come 14400 times a second; choose the divider N1 and multiplier M1 in "
                     "the codec's registers 3 and 4 for the rate of the DCI's frames"));
}

// multiplied by 40 instead of 20
TEST_F(Sound, the_multiplier_register_doubles_the_codecs_rate) {
  add_robot_with_source(own_codec("0x5F", "0x0CEF", "0x27"));
  ASSERT_GT(listen(0, 0.05, 1024).samples.size(), 200u);
  EXPECT_EQ(robot(0).diagnoses_text().find("codec"), std::string::npos) << robot(0).diagnoses_text();
}

// heard by another robot's microphones for longer than the samples that are kept (8192 are 1.1 s): no gap
TEST_F(Sound, a_long_tone_reaches_an_ear_without_a_gap) {
  add_robot_with_source(own_codec("0x5F", "0x0DEF"));
  Robot& ear = add_robot_with_source(R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_micro.h>
#include <motor_led/e_init_port.h>
int quietest = 9999, rounds;
int main(void) {
  long i;
  e_init_port();
  e_init_ad_scan(MICRO_ONLY);
  for (i = 0; i < 200000; i++) asm("nop");
  while (1) {
    int v;
    while (!e_ad_is_array_filled());
    while (e_ad_is_array_filled());
    v = e_get_micro_volume(0);
    if (v < quietest) quietest = v;
    rounds++;
  }
})",
                                     "ear")
                   .at(0.1, 0, 180);
  run_for(2.7);
  EXPECT_GT(ear.variable("rounds"), 300);
  // 0.0894 Pa x 8000/32768 / 0.08 m x 98.55 counts/Pa = 27 counts, so 54 from peak to peak; straight lines
  // between samples leave the peaks of this square wave
  EXPECT_GT(ear.variable("quietest"), 25);
  expect_no_traps();
}

}  // namespace
}  // namespace own_drivers
