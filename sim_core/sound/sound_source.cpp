// SPDX-License-Identifier: MIT
#include "sim_core/sound/sound_source.h"
#include "sim_core/base/portable_math.h"

#include <algorithm>
#include <cmath>

#include "sim_core/sound/sound_params.h"

namespace sim {
namespace {

constexpr double kNever = 1e300;
constexpr std::uint32_t kStreamSound = 32;  // of the world's sources: below what boards use
constexpr std::uint64_t kDrawsPerBurst = 2 * kClapTones;
constexpr std::uint64_t kJitterDraws = std::uint64_t{1} << 60;  // apart from the bursts' draws

/// Sine of a number of turns; whole turns are taken off first, so late times lose nothing.
double sine_of_turns(double turns) { return sin_cos(kTwoPi * (turns - std::floor(turns))).s; }

/// e to the power of -x, x >= 0, the same on every PC: halved until small, then a series.
double decay(double x) {
  int halvings = 0;
  while (x > 0.125) x *= 0.5, ++halvings;
  double term = 1, sum = 1;
  for (int i = 1; i <= 10; ++i) sum += term *= -x / i;
  for (; halvings > 0; --halvings) sum *= sum;
  return sum;
}

}  // namespace

double pressure_of_level_pa(double level_db) {
  constexpr double kPerDb = 0.11512925464970228;  // ln 10 / 20
  const double x = level_db * kPerDb;
  return kReferencePressurePa * (x < 0 ? decay(-x) : 1 / decay(x));
}

SoundSource::SoundSource(const SoundDesc& desc, std::uint64_t world_seed, int number)
    : desc_(desc),
      key_{desc.seed.value_or(world_seed), static_cast<std::uint32_t>(number), kStreamSound},
      rms_pa_(desc.pressure_pa.value_or(pressure_of_level_pa(desc.level_db))) {
  std::sort(desc_.times_s.begin(), desc_.times_s.end());
  if (desc_.kind == SoundKind::Noise && desc_.band_hz)
    band_ = partials(key_, 0, kBandTones, (*desc_.band_hz)[0], (*desc_.band_hz)[1]);
}

double SoundSource::pressure_pa(double at_s) const {
  if (at_s < desc_.start_s || at_s >= desc_.stop_s) return 0;
  const double since_s = at_s - desc_.start_s;
  switch (desc_.kind) {
    case SoundKind::Tone:
      return rms_pa_ * std::sqrt(2.0) * sine_of_turns(desc_.frequency_hz * since_s);
    case SoundKind::Noise:
      return rms_pa_ * (band_.empty() ? white(since_s) : sum_at(band_, since_s));
    case SoundKind::Wav:
      // a sine at full scale has the level that was asked for
      return rms_pa_ * std::sqrt(2.0) * sample(since_s);
    case SoundKind::Clap:
      return rms_pa_ * claps(at_s);
  }
  return 0;
}

/// Tones side by side in a band, one in each of `count` equal parts of it.
std::vector<SoundSource::Partial> SoundSource::partials(const RandomKey& key, std::uint64_t draw, int count,
                                                        double low_hz, double high_hz) {
  std::vector<Partial> out;
  const double part_hz = (high_hz - low_hz) / count;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t n = draw + 2 * static_cast<std::uint64_t>(i);
    out.push_back({low_hz + (i + random_uniform(key, n)) * part_hz, random_uniform(key, n + 1)});
  }
  return out;
}

/// Root mean square 1.
double SoundSource::sum_at(const std::vector<Partial>& partials, double s) {
  double sum = 0;
  for (const Partial& p : partials) sum += sine_of_turns(p.frequency_hz * s + p.turn);
  return sum * std::sqrt(2.0 / static_cast<double>(partials.size()));
}

double SoundSource::white(double since_s) const {
  const double place = since_s * kWhiteNoiseHz;
  const double whole = std::floor(place);
  const auto n = static_cast<std::uint64_t>(whole);
  const double f = place - whole;
  const double drawn = (1 - f) * random_gaussian(key_, n) + f * random_gaussian(key_, n + 1);
  return drawn * std::sqrt(1.5);  // lines between draws have two thirds of the draws' power
}

double SoundSource::sample(double since_s) const {
  const std::size_t count = desc_.samples.size();
  if (count == 0) return 0;
  double place = since_s * desc_.sample_rate_hz;
  const double length = static_cast<double>(count);
  if (place >= length) {
    if (!desc_.loop) return 0;
    place -= length * std::floor(place / length);
  }
  const auto n = std::min(static_cast<std::size_t>(place), count - 1);
  const double f = place - static_cast<double>(n);
  const double next = n + 1 < count ? desc_.samples[n + 1] : desc_.loop ? desc_.samples[0] : 0.0;
  return (1 - f) * desc_.samples[n] + f * next;
}

double SoundSource::clap_s(std::int64_t number) const {
  if (number < 0) return kNever;
  if (!desc_.times_s.empty()) {
    const auto n = static_cast<std::size_t>(number);
    return n < desc_.times_s.size() ? desc_.times_s[n] : kNever;
  }
  const double shift =
      desc_.jitter_s > 0
          ? desc_.jitter_s * random_uniform(key_, kJitterDraws + static_cast<std::uint64_t>(number))
          : 0.0;
  return desc_.start_s + static_cast<double>(number) * desc_.every_s + shift;
}

double SoundSource::claps(double at_s) const {
  const double longest_s = kClapDecays * kClapDecayS;
  double sum = 0;
  if (!desc_.times_s.empty()) {
    const auto& times = desc_.times_s;
    for (auto i = std::upper_bound(times.begin(), times.end(), at_s); i != times.begin();) {
      --i;
      if (at_s - *i >= longest_s) break;
      sum += burst(i - times.begin(), at_s - *i);
    }
    return sum;
  }
  const auto last = static_cast<std::int64_t>(std::floor((at_s - desc_.start_s) / desc_.every_s));
  const auto first = static_cast<std::int64_t>(
      std::floor((at_s - desc_.start_s - desc_.jitter_s - longest_s) / desc_.every_s));
  for (std::int64_t n = std::max<std::int64_t>(0, first); n <= last; ++n) {
    const double since_s = at_s - clap_s(n);
    if (since_s >= 0 && since_s < longest_s) sum += burst(n, since_s);
  }
  return sum;
}

/// Every clap sounds a little different.
double SoundSource::burst(std::int64_t number, double since_s) const {
  double sum = 0;
  const double part_hz = (kClapHighHz - kClapLowHz) / kClapTones;
  for (int i = 0; i < kClapTones; ++i) {
    const std::uint64_t n =
        static_cast<std::uint64_t>(number) * kDrawsPerBurst + 2 * static_cast<std::uint64_t>(i);
    const double frequency_hz = kClapLowHz + (i + random_uniform(key_, n)) * part_hz;
    sum += sine_of_turns(frequency_hz * since_s + random_uniform(key_, n + 1));
  }
  return std::min(1.0, since_s / kClapRiseS) * decay(since_s / kClapDecayS) * sum *
         std::sqrt(2.0 / kClapTones);
}

}  // namespace sim
