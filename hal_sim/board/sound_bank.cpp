// SPDX-License-Identifier: MIT
// Vowels are given by three resonances, after the averages of Peterson and Barney (1952) for men; the rest is
// chosen by ear on paper: it only has to be a different sound for each name.
#include "hal_sim/board/sound_bank.h"

#include <algorithm>
#include <cmath>

#include "hal_sim/board/sound_params.h"
#include "sim_core/base/portable_math.h"
#include "sim_core/random/counter_random.h"

namespace board {

namespace {

constexpr double kRateHz = 7200;     // samples a second, of the codec
constexpr double kHighestHz = 3300;  // no harmonic nearer to half the rate
constexpr double kPeak = 24000;      // of each sound: 2.7 dB below full scale

struct Mouth {
  double f1, f2, f3;  // resonances, Hz
};
constexpr Mouth kA{730, 1090, 2440}, kU{300, 870, 2240}, kI{270, 2290, 3010};
constexpr double kWidthHz = 90;  // of a resonance

/// The state at one moment of a sound; between moments everything changes evenly.
struct Moment {
  double at;  // share of the sound's length
  Mouth mouth;
  double pitch_hz;
  double voice;   // loudness of the buzz
  double breath;  // loudness of noise through the mouth
  double hiss;    // loudness of noise as in "s"
};

struct Word {
  int offset, length;
  std::vector<Moment> moments;
};

// Each sound with its place in the bank, its length, and the moments it goes through.
std::vector<Word> words() {
  return {
      {0,
       2112,
       {{0, kA, 150, 0, 0.6, 0},
        {0.18, kA, 160, 0.3, 0.5, 0},
        {0.3, kA, 165, 1, 0.05, 0},
        {0.8, kA, 140, 0.8, 0.05, 0},
        {1, kA, 120, 0, 0, 0}}},
      {2116,
       1760,
       {{0, kA, 170, 0, 0, 0},
        {0.04, kA, 170, 0, 0, 0.8},
        {0.26, kA, 170, 0, 0, 0.7},
        {0.28, kA, 170, 0, 0, 0},
        {0.38, kA, 170, 0, 0, 0},
        {0.4, kA, 180, 0.8, 0.6, 0},
        {0.46, kA, 190, 1, 0, 0},
        {0.85, kA, 160, 0.8, 0, 0},
        {1, kA, 140, 0, 0, 0}}},
      {3878,
       3412,
       {{0, kU, 120, 0, 0, 0},
        {0.06, kU, 125, 0.9, 0, 0},
        {0.3, kU, 150, 1, 0, 0},
        {0.5, kA, 180, 1, 0, 0},
        {0.85, kA, 150, 0.8, 0.05, 0},
        {1, kA, 110, 0, 0.1, 0}}},
      {7294,
       3732,
       {{0, kI, 180, 0, 0, 0},
        {0.05, kI, 190, 0.8, 0, 0},
        {0.2, kI, 200, 0.9, 0, 0},
        {0.4, kA, 230, 1, 0, 0},
        {0.65, kA, 200, 1, 0, 0},
        {0.85, kU, 160, 0.9, 0, 0},
        {1, kU, 130, 0, 0, 0}}},
      {11028,
       8016,
       {{0, kU, 100, 0, 0, 0},
        {0.04, kU, 110, 0.9, 0, 0},
        {0.15, kU, 140, 1, 0, 0},
        {0.27, kA, 210, 1, 0, 0},
        {0.5, kA, 240, 1, 0, 0},
        {0.8, kA, 170, 0.8, 0.05, 0},
        {1, kA, 100, 0, 0.1, 0}}},
  };
}

Moment at_share(const std::vector<Moment>& moments, double share) {
  std::size_t n = 1;
  while (n + 1 < moments.size() && moments[n].at < share) ++n;
  const Moment &a = moments[n - 1], &b = moments[n];
  const double f = std::clamp((share - a.at) / (b.at - a.at), 0.0, 1.0);
  const auto mix = [f](double x, double y) { return x + f * (y - x); };
  return {share,
          {mix(a.mouth.f1, b.mouth.f1), mix(a.mouth.f2, b.mouth.f2), mix(a.mouth.f3, b.mouth.f3)},
          mix(a.pitch_hz, b.pitch_hz),
          mix(a.voice, b.voice),
          mix(a.breath, b.breath),
          mix(a.hiss, b.hiss)};
}

/// How much of a frequency one resonance lets through.
double resonance(double f_hz, double centre_hz) {
  const double x = (f_hz * f_hz - centre_hz * centre_hz) / (f_hz * kWidthHz);
  return 1 / std::sqrt(1 + x * x);
}

double passes(const Mouth& mouth, double f_hz) {
  return resonance(f_hz, mouth.f1) + 0.6 * resonance(f_hz, mouth.f2) + 0.3 * resonance(f_hz, mouth.f3);
}

void speak(const Word& word, std::vector<double>& out) {
  const sim::RandomKey key{1, static_cast<std::uint32_t>(word.offset), 0};
  double turns = 0;          // phase of the voice
  double breath[3][2] = {};  // states of three resonators that noise goes through
  double before = 0;
  for (int i = 0; i < word.length; ++i) {
    // What the mouth does at this instant.
    const Moment now = at_share(word.moments, (i + 0.5) / word.length);
    turns += now.pitch_hz / kRateHz;
    turns -= std::floor(turns);
    double value = 0;
    // The voice: harmonics of the pitch, as strong as the mouth lets them through.
    if (now.voice > 0) {
      for (int h = 1; h * now.pitch_hz < kHighestHz; ++h)
        value += passes(now.mouth, h * now.pitch_hz) / std::sqrt(static_cast<double>(h)) *
                 sim::sin_cos(sim::kTwoPi * h * turns).s;
      value *= now.voice;
    }
    // The breath: noise that goes through the mouth's three resonances.
    const double noise = sim::random_gaussian(key, static_cast<std::uint64_t>(i));
    const double centres[3] = {now.mouth.f1, now.mouth.f2, now.mouth.f3};
    for (int r = 0; r < 3; ++r) {
      constexpr double kRadius = 0.95;
      const double next = noise +
                          2 * kRadius * sim::sin_cos(sim::kTwoPi * centres[r] / kRateHz).c * breath[r][0] -
                          kRadius * kRadius * breath[r][1];
      breath[r][1] = breath[r][0];
      breath[r][0] = next;
      value += now.breath * 0.06 * next;
    }
    value += now.hiss * 0.8 * (noise - before);  // the difference favours the highest frequencies
    before = noise;
    out[static_cast<std::size_t>(word.offset + i)] = value;
  }
  // All words are equally loud.
  const auto begin = out.begin() + word.offset, end = begin + word.length;
  const double peak =
      std::abs(*std::max_element(begin, end, [](double a, double b) { return std::abs(a) < std::abs(b); }));
  for (auto i = begin; i != end; ++i) *i *= kPeak / peak;
}

std::shared_ptr<const std::vector<std::int16_t>> make_bank() {
  std::vector<double> values(kSoundBankSamples, 0.0);
  for (const Word& word : words()) speak(word, values);
  auto bank = std::make_shared<std::vector<std::int16_t>>();
  for (double value : values)
    bank->push_back(static_cast<std::int16_t>(2 * static_cast<int>(std::floor(value / 2))));
  return bank;
}

}  // namespace

const std::shared_ptr<const std::vector<std::int16_t>>& sound_bank() {
  static const std::shared_ptr<const std::vector<std::int16_t>> bank = make_bank();
  return bank;
}

}  // namespace board
