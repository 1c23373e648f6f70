// SPDX-License-Identifier: MIT
// Sound on whole robots: the library's microphone, transform and loudspeaker functions as firmware calls
// them, in a world with sources. Expectations by hand or from the physics.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim_core/sound/sound_field.h"
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

class SoundTest : public FirmwareTest {
 protected:
  SoundTest() { world.seed = 5; }
  sim::SoundDesc& tone(double frequency_hz, double level_db, sim::Vec3 at) {
    sim::SoundDesc s;
    s.kind = sim::SoundKind::Tone;
    s.frequency_hz = frequency_hz;
    s.level_db = level_db;
    s.position_m = at;
    world.sounds.push_back(s);
    return world.sounds.back();
  }
};

// fills the buffers once, stops the scan, keeps what the functions say about them
const char* const kOneBuffer = R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_micro.h>
extern int e_mic_scan[3][MIC_SAMP_NB];
extern unsigned int e_last_mic_scan_id;
void e_get_micro_last_values(int micro_id, int *result, unsigned samples_nb);
int scan[3][MIC_SAMP_NB], last[MIC_SAMP_NB], five[6];
unsigned int id;
int oldest, average1, average2, average100, too_many, wrong_id, volume[3];
int main(void) {
  int m, i;
  e_init_ad_scan(ALL_ADC);
  while (!e_ad_is_array_filled());
  while (e_ad_is_array_filled());
  for (i = 0; i < 37; i++) { while (e_ad_is_array_filled()); }
  e_ad_scan_off();
  for (m = 0; m < 3; m++) {
    volume[m] = e_get_micro_volume(m);
    for (i = 0; i < MIC_SAMP_NB; i++) scan[m][i] = e_mic_scan[m][i];
  }
  id = e_last_mic_scan_id;
  oldest = e_get_micro(1);
  average1 = e_get_micro_average(1, 1);
  average2 = e_get_micro_average(1, 2);
  average100 = e_get_micro_average(1, MIC_SAMP_NB);
  too_many = e_get_micro_average(1, MIC_SAMP_NB + 1);
  wrong_id = e_get_micro_average(3, 10);
  e_get_micro_last_values(1, last, MIC_SAMP_NB);
  five[5] = 77;
  e_get_micro_last_values(1, five, 5);
  e_get_micro_last_values(1, five, 0);
  e_get_micro_last_values(1, five, 101);
  while (1);
}
)";

TEST_F(SoundTest, microphone_functions_read_the_buffer_as_the_library_does) {
  Robot& r = add_robot_with_source(kOneBuffer);
  tone(1000, 90, {0.3, 0, 0.035});
  run_for(0.5);
  expect_no_traps();
  const auto all = r.variables("scan", 300);
  const int id = r.variable("id");
  const auto at = [&](int m, int place) {
    return all[static_cast<std::size_t>(100 * m + (place + 200) % 100)];
  };
  ASSERT_NE(id, 0);  // some samples past the wrap, so that the ends of the ring are not its ends in memory
  EXPECT_EQ(r.variable("oldest"), at(1, id));
  EXPECT_EQ(r.variable("average1"), at(1, id));
  EXPECT_EQ(r.variable("average2"), (at(1, id) + at(1, id - 1)) / 2);  // the oldest and the newest
  int sum = 0;
  for (int i = 0; i < 100; ++i) sum += at(1, i);
  EXPECT_EQ(r.variable("average100"), sum / 100);
  EXPECT_EQ(r.variable("too_many"), 0);
  EXPECT_EQ(r.variable("wrong_id"), 0);
  for (int m = 0; m < 3; ++m) {
    const auto [low, high] = std::minmax_element(all.begin() + 100 * m, all.begin() + 100 * m + 100);
    EXPECT_EQ(r.variables("volume", 3)[static_cast<std::size_t>(m)], *high - *low);
  }
  const auto last = r.variables("last", 100);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(last[static_cast<std::size_t>(i)], at(1, id + 99 - i));
  // fewer than all: the oldest ones, the oldest of them last
  const auto five = r.variables("five", 6);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(five[static_cast<std::size_t>(i)], at(1, id + 4 - i));
  EXPECT_EQ(five[5], 77);
}

// 90 dB at 1 m is 0.632 Pa rms; at 0.3 m 2.98 Pa peak; 98.55 counts/Pa: 294 counts. The microphones are
// 0.2937, 0.2937 and 0.322 m away: amplitudes 300 and 274
TEST_F(SoundTest, loudness_follows_the_distance_of_each_microphone) {
  Robot& r = add_robot_with_source(kOneBuffer);
  tone(1000, 90, {0.3, 0, 0.035});
  run_for(0.5);
  const auto volume = r.variables("volume", 3);
  EXPECT_NEAR(volume[0], 600, 12);
  EXPECT_NEAR(volume[1], 600, 12);
  EXPECT_NEAR(volume[2], 548, 12);
}

TEST_F(SoundTest, silence_is_2048_and_a_little_noise) {
  Robot& r = add_robot_with_source(kOneBuffer);
  run_for(0.5);
  for (int v : r.variables("volume", 3)) {
    EXPECT_GT(v, 3);
    EXPECT_LT(v, 16);
  }
  EXPECT_NEAR(r.variable("average100"), 2048, 1);
}

TEST_F(SoundTest, average_of_nothing_divides_by_zero) {
  Robot& r = add_robot_with_source(R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_micro.h>
int main(void) { e_init_ad_scan(MICRO_ONLY); return e_get_micro_average(0, 0); })");
  run_for(0.1);
  ASSERT_EQ(r.traps().size(), 1u);
  EXPECT_EQ(r.traps()[0].kind, host::kTrapMath);
}

// the slip of the volume function: while samples only rise, none is looked at for the lowest, which stays
// 4999. A tone of 20 Hz rises for 25 ms, a buffer holds 3 (noise is switched off by a level far above it)
TEST_F(SoundTest, volume_of_a_buffer_that_only_rises_is_wrong_as_in_the_library) {
  Robot& r = add_robot_with_source(R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_micro.h>
extern int e_mic_scan[3][MIC_SAMP_NB];
int volume, still;
int main(void) {
  int i;
  e_init_ad_scan(MICRO_ONLY);
  while (!e_ad_is_array_filled());
  e_ad_scan_off();
  for (i = 0; i < MIC_SAMP_NB; i++) e_mic_scan[0][i] = 1000 + i;
  volume = e_get_micro_volume(0);
  for (i = 0; i < MIC_SAMP_NB; i++) e_mic_scan[0][i] = 1000;
  still = e_get_micro_volume(0);
  while (1);
})");
  run_for(0.05);
  EXPECT_EQ(r.variable("volume"), 1099 - 4999);
  EXPECT_EQ(r.variable("still"), 0);
}

TEST_F(SoundTest, basic_microphones_convert_and_start_timer_1) {
  Robot& r = add_robot_with_source(R"(
#include <a_d/e_micro.h>
#include <motor_led/e_epuck_ports.h>
int m[3], running_before, running_after;
unsigned long cycles;
int main(void) {
  e_init_micro();
  T2CON = 0; TMR2 = 0; PR2 = 0xFFFF; T2CONbits.TON = 1;
  running_before = T1CONbits.TON;
  e_get_micro(&m[0], &m[1], &m[2]);
  cycles = TMR2;
  running_after = T1CONbits.TON;
  while (1);
})");
  run_for(0.05);
  expect_no_traps();
  for (int counts : r.variables("m", 3)) EXPECT_NEAR(counts, 2048, 10);
  EXPECT_EQ(r.variable("running_before"), 0);
  EXPECT_EQ(r.variable("running_after"), 1);
  EXPECT_NEAR(r.variable<std::uint32_t>("cycles"), 3 * 315, 150);  // three blocking conversions and the calls
}

// --- transform

// as runfftlistener does: 33 kHz, a full buffer, scan off, mean off, transform. 100 samples, the rest zeros:
// bins of 32768 / 256 = 128 Hz, so 1 kHz lies at 7.8: bin 8
const char* const kListener = R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_micro.h>
#include <fft/e_fft.h>
#include <fft/e_fft_utilities.h>
extern int e_mic_scan[3][MIC_SAMP_NB];
extern fractcomplex sigCmpx[FFT_BLOCK_LENGTH];
int peak[3], copied[3][MIC_SAMP_NB];
long power[3];
unsigned int ticks;
int main(void) {
  int m, i;
  e_init_ad_scan(MICRO_ONLY);
  while (!e_ad_is_array_filled());
  while (e_ad_is_array_filled());
  while (!e_ad_is_array_filled());
  e_ad_scan_off();
  for (m = 0; m < 3; m++) {
    long sum = 0;
    for (i = 0; i < MIC_SAMP_NB; i++) { copied[m][i] = e_mic_scan[m][i]; sum += copied[m][i]; }
    for (i = 0; i < FFT_BLOCK_LENGTH; i++) {
      sigCmpx[i].real = i < MIC_SAMP_NB ? (copied[m][i] - (int)(sum / MIC_SAMP_NB)) * 16 : 0;
      sigCmpx[i].imag = 0;
    }
    T4CON = 0; TMR4 = 0; PR4 = 0xFFFF; T4CONbits.TON = 1;
    e_doFFT_asm(sigCmpx);
    ticks = TMR4;
    for (i = 1; i < FFT_BLOCK_LENGTH / 2; i++) {
      long p = (long)sigCmpx[i].real * sigCmpx[i].real + (long)sigCmpx[i].imag * sigCmpx[i].imag;
      if (p > power[m]) { power[m] = p; peak[m] = i; }
    }
  }
  while (1);
}
)";

TEST_F(SoundTest, a_tone_of_1_khz_at_30_cm_peaks_in_its_bin_on_all_microphones) {
  Robot& r = add_robot_with_source(std::string("#include <motor_led/e_epuck_ports.h>\n") + kListener);
  r.at(0, 0, 25);
  tone(1000, 80, {0.3, 0, 0.035});
  run_for(0.1);
  expect_no_traps();
  EXPECT_EQ(r.variables("peak", 3), (std::vector<std::int16_t>{8, 8, 8}));
  // turned by 25 degrees to the left: microphones at (0.0204, -0.0247), (-0.0059, 0.0315), (-0.0199,
  // -0.0093); 0.281, 0.308 and 0.320 m from the source
  const auto power = r.variables<std::int32_t>("power", 3);
  EXPECT_GT(power[0], power[1]);
  EXPECT_GT(power[1], power[2]);
  EXPECT_NEAR(std::sqrt(static_cast<double>(power[0]) / power[2]), 0.320 / 0.281, 0.03);
  // published: 21361 cycles for the transform, 1905 to reorder; our transforms in C take 9 % longer than
  // the vendor's assembler
  EXPECT_NEAR(static_cast<std::uint16_t>(r.variable("ticks")), 1.09 * (21361 + 1905), 250);
}

// the same buffers: the phase of the tone at each microphone against its distance. 1 kHz: 360 degrees
// are 34.3 cm; a degree is 0.95 mm or 0.09 samples. Channels are held 150 cycles (10.17 us) apart.
class Bearing : public SoundTest, public ::testing::WithParamInterface<int> {};

TEST_P(Bearing, delays_between_microphones_match_the_geometry) {
  const double heading = sim::radians(GetParam());
  Robot& r = add_robot_with_source(std::string("#include <motor_led/e_epuck_ports.h>\n") + kListener);
  r.at(0, 0, GetParam());
  tone(1000, 94, {0.3, 0, 0.035});
  run_for(0.1);
  expect_no_traps();
  const auto copied = r.variables("copied", 300);
  const double forward[3] = {0.008, 0.008, -0.022}, left[3] = {-0.031, 0.031, 0};
  double late_s[3], way_m[3];
  for (int m = 0; m < 3; ++m) {
    // 98 samples of 450 cycles are 2.99 periods; the least-squares phase of a sine and a mean
    double ss = 0, cc = 0, sc = 0, ps = 0, pc = 0;
    const double mean = std::accumulate(copied.begin() + 100 * m, copied.begin() + 100 * m + 98, 0.0) / 98;
    for (int i = 0; i < 98; ++i) {
      const double t = (i * 450 + (15 * m + 1) * 10) / 14745600.0, s = std::sin(2 * M_PI * 1000 * t),
                   c = std::cos(2 * M_PI * 1000 * t),
                   p = copied[static_cast<std::size_t>(100 * m + i)] - mean;
      ss += s * s, cc += c * c, sc += s * c, ps += p * s, pc += p * c;
    }
    const double a = (ps * cc - pc * sc) / (ss * cc - sc * sc), b = (pc * ss - ps * sc) / (ss * cc - sc * sc);
    late_s[m] = -std::atan2(b, a) / (2 * M_PI * 1000);
    const double x = forward[m] * std::cos(heading) - left[m] * std::sin(heading);
    const double y = forward[m] * std::sin(heading) + left[m] * std::cos(heading);
    way_m[m] = std::hypot(0.3 - x, y);
  }
  for (int m = 1; m < 3; ++m) {
    double difference_s = late_s[m] - late_s[0] - (way_m[m] - way_m[0]) / 343;
    difference_s -= 1e-3 * std::round(difference_s * 1e3);
    EXPECT_NEAR(difference_s, 0, 2e-6) << m;  // a fifteenth of a sample
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Bearing, ::testing::Values(0, 25, 100, 200, 290));

// a cosine of 8 periods and amplitude 16000, all in one bin: 16000 / 2 = 8000 in bins 8 and 248, 0
// elsewhere; rounding once a stage leaves at most 2. And a constant: all in bin 0. And an impulse of
// 25600: 100 in every bin.
TEST_F(SoundTest, transforms_of_known_signals) {
  Robot& r = add_robot_with_source(R"(
#include <fft/e_fft.h>
#include <math.h>
extern fractcomplex sigCmpx[FFT_BLOCK_LENGTH];
int cosine[512], constant[512], impulse[512];
static void keep(int *to) {
  int i;
  e_doFFT_asm(sigCmpx);
  for (i = 0; i < 256; i++) { to[2 * i] = sigCmpx[i].real; to[2 * i + 1] = sigCmpx[i].imag; }
}
static void fill(int value) {
  int i;
  for (i = 0; i < 256; i++) { sigCmpx[i].real = value; sigCmpx[i].imag = 0; }
}
int main(void) {
  int i;
  for (i = 0; i < 256; i++) {
    sigCmpx[i].real = (int)floorf(16000 * cosf(2 * 3.14159265f * 8 * i / 256) + 0.5f);
    sigCmpx[i].imag = 0;
  }
  keep(cosine);
  fill(1234);
  keep(constant);
  fill(0);
  sigCmpx[0].real = 25600;
  keep(impulse);
  while (1);
})");
  run_for(0.5);
  expect_no_traps();
  const auto cosine = r.variables("cosine", 512), constant = r.variables("constant", 512),
             impulse = r.variables("impulse", 512);
  for (std::size_t i = 0; i < 256; ++i) {
    EXPECT_NEAR(cosine[2 * i], i == 8 || i == 248 ? 8000 : 0, 3) << i;
    EXPECT_NEAR(cosine[2 * i + 1], 0, 3) << i;
    EXPECT_EQ(constant[2 * i], i == 0 ? 1234 : 0) << i;
    EXPECT_EQ(constant[2 * i + 1], 0) << i;
    EXPECT_NEAR(impulse[2 * i], 100, 1) << i;
    EXPECT_NEAR(impulse[2 * i + 1], 0, 1) << i;
  }
}

TEST_F(SoundTest, programs_may_use_the_vendors_functions_themselves) {
  Robot& r = add_robot_with_source(R"(
#include <dsp.h>
#define LOG2 6
fractcomplex sig[64] __attribute__((section(".ydata, data, ymemory"), aligned(256)));
fractcomplex tw[32] __attribute__((section(".xbss, bss, xmemory"), aligned(128)));
fractcomplex conjugate[32];
const fractcomplex four[2] __attribute__((space(auto_psv), aligned(8))) = {{32767, 0}, {0, -32768}};
fractcomplex small[4] = {{1000, 0}, {0, 0}, {0, 0}, {0, 0}}, copy[4];
fractional squares[64];
int where, highest, w8[2], w8c[2], small_real[4], half;
int main(void) {
  int i;
  TwidFactorInit(LOG2, tw, 0);
  TwidFactorInit(LOG2, conjugate, 1);
  w8[0] = tw[8].real; w8[1] = tw[8].imag;
  w8c[0] = conjugate[8].real; w8c[1] = conjugate[8].imag;
  for (i = 0; i < 64; i++) { sig[i].real = i & 2 ? -8000 : 8000; sig[i].imag = 0; }
  FFTComplexIP(LOG2, &sig[0], &tw[0], COEFFS_IN_DATA);
  BitReverseComplex(LOG2, &sig[0]);
  SquareMagnitudeCplx(64, &sig[0], &squares[0]);
  highest = VectorMax(32, &squares[0], &where);
  FFTComplex(2, copy, small, (fractcomplex *) __builtin_psvoffset(&four[0]), (int) __builtin_psvpage(&four[0]));
  for (i = 0; i < 4; i++) small_real[i] = copy[i].real;
  half = Float2Fract(0.5) - 16384 + (Fract2Float(-16384) == -0.5f);
  while (1);
})");
  run_for(0.1);
  expect_no_traps();
  // exp(-i pi / 4) is 0.7071: 32767 times it 23169.8, -32768 times it -23170.5
  EXPECT_NEAR(r.variables("w8", 2)[0], 23170, 1);
  EXPECT_NEAR(r.variables("w8", 2)[1], -23170, 1);
  EXPECT_NEAR(r.variables("w8c", 2)[1], 23170, 1);
  // a square wave of period 4 and amplitude 8000, that begins ++--: bin 16 is 4000 - 4000 i
  EXPECT_EQ(r.variable("where"), 16);
  EXPECT_NEAR(r.variable("highest"), 2 * 4000.0 * 4000 / 32768, 3);
  for (int v : r.variables("small_real", 4)) EXPECT_EQ(v, 250);
  EXPECT_EQ(r.variable("half"), 1);
}

// --- loudspeaker

// haa: 2112 samples; the flag falls with the interrupt at which the last four go out, 527
// groups after the first
const char* const kPlayer = R"(
#include <codec/e_sound.h>
#include <motor_led/e_init_port.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/advance_one_timer/e_led.h>
extern volatile int e_dci_unavailable;
extern volatile int e_stop_flag;
int before, during, stop_during, after, stop_after, powered;
unsigned int ticks;
int main(void) {
  e_init_port();
  before = e_dci_unavailable;
  e_init_sound();
  powered = AUDIO_ON;
  T4CON = 0; TMR4 = 0; PR4 = 0xFFFF; T4CONbits.TCKPS = 3; T4CONbits.TON = 1;
  e_play_sound(0, 2112);
  during = e_dci_unavailable;
  stop_during = e_stop_flag;
  while (e_dci_unavailable);
  ticks = TMR4;
  after = e_dci_unavailable;
  stop_after = e_stop_flag;
  e_set_body_led(1);
  while (1);
}
)";

TEST_F(SoundTest, a_sound_occupies_the_driver_for_its_length) {
  Robot& r = add_robot_with_source(kPlayer);
  run_for(1);
  expect_no_traps();
  EXPECT_EQ(r.variable("before"), 0);
  EXPECT_EQ(r.variable("powered"), 1);
  EXPECT_EQ(r.variable("during"), -1);
  EXPECT_EQ(r.variable("stop_during"), 0);
  EXPECT_EQ(r.variable("after"), 0);
  EXPECT_EQ(r.variable("stop_after"), -1);
  // timer ticks of 256 cycles: 527 groups of 32 ticks, and up to one group until the first
  EXPECT_GE(static_cast<std::uint16_t>(r.variable("ticks")), 527 * 32 - 1);
  EXPECT_LE(static_cast<std::uint16_t>(r.variable("ticks")), 528 * 32 + 1);
  EXPECT_TRUE(r.led(8));
}

TEST_F(SoundTest, without_init_nothing_plays_and_the_flag_stays) {
  Robot& r = add_robot_with_source(R"(
#include <codec/e_sound.h>
extern int e_dci_unavailable;
int main(void) { e_play_sound(0, 2112); while (1); })");
  run_for(1);
  EXPECT_EQ(r.variable("e_dci_unavailable"), -1);
  EXPECT_TRUE(twin().simulation().sound().is_silent());
}

TEST_F(SoundTest, the_stop_flag_ends_a_sound_at_the_next_interrupt) {
  Robot& r = add_robot_with_source(R"(
#include <codec/e_sound.h>
#include <motor_led/e_init_port.h>
#include <motor_led/e_epuck_ports.h>
extern int e_dci_unavailable, e_stop_flag;
unsigned int ticks;
int main(void) {
  long i;
  e_init_port();
  e_init_sound();
  e_play_sound(11028, 8016);
  for (i = 0; i < 100000; i++) Nop();
  T4CON = 0; TMR4 = 0; PR4 = 0xFFFF; T4CONbits.TON = 1;
  e_stop_flag = 1;
  while (e_dci_unavailable);
  ticks = TMR4;
  while (1);
})");
  run_for(0.5);
  expect_no_traps();
  EXPECT_LE(static_cast<std::uint16_t>(r.variable("ticks")), 8192 + 300);
  const auto& codec = twin().mind(0).board().codec();
  EXPECT_EQ(codec.output(r.cycles()), 0);
  run_for(0.1);
}

TEST_F(SoundTest, a_length_that_is_no_multiple_of_four_plays_on) {
  Robot& r = add_robot_with_source(R"(
#include <codec/e_sound.h>
#include <motor_led/e_init_port.h>
extern int e_dci_unavailable;
int main(void) { e_init_port(); e_init_sound(); e_play_sound(0, 2110); while (1); })");
  run_for(12);  // 16384 groups are 9.1 s
  EXPECT_EQ(r.variable("e_dci_unavailable"), -1);
}

// the second robot, 20 cm away, hears "wouaaaah": 0.0894 Pa * 24000/32768 / 0.2 m = 0.33 Pa peak, 32 counts;
// and the player hears itself much louder, its loudspeaker being 9 to 37 mm from its microphones
TEST_F(SoundTest, other_robots_hear_it_and_so_does_the_robot_itself) {
  const char* const listener = R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_micro.h>
#include <codec/e_sound.h>
#include <motor_led/e_init_port.h>
int loudest[3];
int main(void) {
  int m;
  e_init_port();
  SOUND
  e_init_ad_scan(MICRO_ONLY);
  while (!e_ad_is_array_filled());
  while (1) {
    for (m = 0; m < 3; m++) {
      int v = e_get_micro_volume(m);
      if (v > loudest[m]) loudest[m] = v;
    }
  }
})";
  const std::string source(listener);
  const auto with = [&](const char* what) {
    std::string s = source;
    return s.replace(s.find("SOUND"), 5, what);
  };
  Robot& player = add_robot_with_source(with("e_init_sound(); e_play_sound(11028, 8016);"), "player");
  Robot& ear = add_robot_with_source(with(""), "ear");
  Robot& deaf = add_robot_with_source(with(""), "far");
  ear.at(0.2, 0, 180);  // faces it
  deaf.at(30, 0);       // beyond 20 m nothing is heard
  run_for(1.3);
  expect_no_traps();
  const auto heard = ear.variables("loudest", 3), own = player.variables("loudest", 3),
             nothing = deaf.variables("loudest", 3);
  for (std::size_t m = 0; m < 3; ++m) {
    EXPECT_GT(heard[m], 30);
    EXPECT_LT(heard[m], 90);
    EXPECT_GT(own[m], 4 * heard[m]);
    EXPECT_LT(nothing[m], 20);
  }
  EXPECT_GT(heard[0], heard[2]);  // its back is 6 cm further away
}

// four robots that all play and all listen while they turn
struct Choir : FirmwareTest {
  explicit Choir(int threads) {
    options.threads = threads;
    for (int i = 0; i < 4; ++i)
      add_robot_with_source(R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_micro.h>
#include <codec/e_sound.h>
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
extern int e_dci_unavailable;
unsigned int sum;
int loudest;
int main(void) {
  e_init_port();
  e_init_motors();
  e_init_sound();
  e_init_ad_scan(ALL_ADC);
  e_start_agendas_processing();
  e_set_speed_left(300);
  e_set_speed_right(-300);
  while (1) {
    if (!e_dci_unavailable) e_play_sound(2116, 1760);
    int volume = e_get_micro_volume(0);
    if (volume > loudest) loudest = volume;
    sum = sum * 31 + volume + e_get_micro(1) + e_get_micro_average(2, 10);
  }
})",
                            "r" + std::to_string(i))
          .at(0.15 * i, 0.05 * (i & 1), 70 * i);
    run_for(0.7);
  }
  void TestBody() override {}
  std::vector<std::uint16_t> sums() {
    std::vector<std::uint16_t> all;
    for (int i = 0; i < 4; ++i) all.push_back(robot(i).variable<std::uint16_t>("sum"));
    return all;
  }
  bool is_heard(int i) { return robot(i).variable("loudest") > 100; }
  using FirmwareTest::digest;
};

TEST(SoundThreads, what_is_heard_does_not_depend_on_them) {
  std::vector<std::uint16_t> sums[2];
  std::uint64_t digests[2];
  for (int run = 0; run < 2; ++run) {
    Choir choir(run == 0 ? 1 : 3);
    sums[run] = choir.sums();
    digests[run] = choir.digest();
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(choir.is_heard(i));
  }
  EXPECT_EQ(sums[0], sums[1]);
  EXPECT_EQ(digests[0], digests[1]);
  EXPECT_NE(sums[0][0], sums[0][1]);
}

}  // namespace
