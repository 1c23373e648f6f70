// SPDX-License-Identifier: MIT
#include "hal_sim/signals/sound_signals.h"

#include <algorithm>
#include <cmath>

#include "sim_core/sound/sound_field.h"

namespace signals {

namespace {

// sound is listened to for so long, and at so many instants of it
constexpr sim::Clicks kListen = sim::kClicksPerSecond / 64;
constexpr int kListens = 48;
constexpr sim::Clicks kMoment = sim::kClicksPerSecond / 50000;  // for how fast it changes
constexpr double kFullScale = 32768;                            // of the loudspeaker's samples

}  // namespace

Heard listen(const sim::Scene& scene, int robot) {
  Heard heard;
  if (!sim::has_sound(scene)) return heard;
  // Pressure at each microphone, and how fast it changes, at instants of the last moments.
  const auto pressure = [&](int mic, sim::Clicks at) {
    const board::Place& p = board::kMicrophone[mic];
    return sim::sense_sound_pa(scene, robot, {p.x_m, p.y_m, board::kMicrophoneZM}, at);
  };
  double now[kListens][board::kMicrophones] = {}, change[kListens][board::kMicrophones] = {};
  for (int i = 0; i < kListens; ++i) {
    const sim::Clicks at = scene.now() - kMoment - kListen * i / kListens;
    for (int mic = 0; mic < board::kMicrophones && at >= 0; ++mic) {
      now[i][mic] = pressure(mic, at);
      change[i][mic] = pressure(mic, at + kMoment) - now[i][mic];
      heard.counts[mic] += now[i][mic] * now[i][mic] / kListens;
    }
  }
  for (double& counts : heard.counts) counts = std::sqrt(counts);
  // a wave from direction u: its gradient is u times its change in time, over the speed of sound. That a near
  // source is louder at one microphone says nothing of the wave
  double ahead = 0, left = 0;
  constexpr const board::Place* kMic = board::kMicrophone;
  for (int i = 0; i < kListens; ++i) {
    double p[board::kMicrophones], grows = 0;
    for (int mic = 0; mic < board::kMicrophones; ++mic) {
      const double loud = std::max(heard.counts[mic], 1e-12);
      p[mic] = now[i][mic] / loud;
      grows += change[i][mic] / loud;
    }
    ahead += grows * ((p[0] + p[1]) / 2 - p[2]) / (kMic[0].x_m - kMic[2].x_m);
    left += grows * (p[1] - p[0]) / (kMic[1].y_m - kMic[0].y_m);
  }
  for (double& counts : heard.counts) counts *= board::kMicCountsPerPa;
  heard.bearing_rad = std::atan2(left, ahead);
  return heard;
}

double speaker_level(const host::FirmwareMind& mind) {
  const board::Codec& codec = mind.board().codec();
  if (!codec.was_used()) return 0;
  double sum = 0;
  constexpr int kSamples = static_cast<int>(board::kFcyHz / 64 / board::kCodecSampleCycles);
  for (int i = 0; i < kSamples; ++i) {
    const double out = codec.output(std::max<board::Cycle>(0, mind.now() - i * board::kCodecSampleCycles));
    sum += out * out;
  }
  return 100 * std::sqrt(sum / kSamples) / kFullScale;
}

}  // namespace signals
