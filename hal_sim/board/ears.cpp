// SPDX-License-Identifier: MIT
#include "hal_sim/board/ears.h"

#include <cmath>

#include "hal_sim/board/codec.h"
#include "hal_sim/board/sound_bank.h"
#include "sim_core/sound/sound_field.h"

namespace board {

namespace {

constexpr double kMicLoudest = 1e6;                       // counts; beyond what any converter tells apart
constexpr std::int64_t kOpenEnd = std::int64_t{1} << 40;  // samples of a sound whose end is not known

}  // namespace

Ears::Ears(const Specimen& robot)
    : robot_(robot),
      noise_per_face_(
          std::llround(robot.setup().mic_noise_counts * SampleNoise::kPerFace * (1 << kFraction))) {}

int Ears::counts_in_sound(int microphone, Cycle at) const {
  const Place& place = kMicrophone[microphone];
  double level = kMicIdleCounts + kMicCountsPerPa * sim::sense_sound_pa(*robot_.scene(), robot_.setup().robot,
                                                                        {place.x_m, place.y_m, kMicrophoneZM},
                                                                        robot_.clock().click_at(at));
  level = std::clamp(level, -kMicLoudest, kMicLoudest);
  const Damage* const damage = robot_.damage();
  if (damage && damage->deaf[static_cast<std::size_t>(microphone)].at(at) != 0) {
    // less than a count is nothing that a converter tells apart
    if (std::fabs(level - kMicIdleCounts) >= 1)
      damage->note(damage->heard_nothing[static_cast<std::size_t>(microphone)], at);
    level = kMicIdleCounts;
  }
  return with_noise(std::llround((level + 0.5) * (1 << kFraction)), microphone, at);
}

void Ears::publish(Codec& codec, sim::SoundField& field, sim::Clicks now) {
  const RobotClock& clock = robot_.clock();
  const int robot = robot_.setup().robot;
  const auto sample_s = [&](Cycle cycles) {
    return static_cast<double>(cycles) / static_cast<double>(kFcyHz) /
           (1 + static_cast<double>(clock.ppb()) * 1e-9);
  };
  sim::SpeakerTrack track;
  track.pa_per_unit = kSpeakerFullScalePa / 32768;
  track.at_m = {kSpeaker.x_m, kSpeaker.y_m, kSpeakerZM};
  if (codec.line().was_used()) {
    const CodecLine::Stretch* heard = codec.line().publish();
    if (!heard) on_air_.reset();
    if (!heard) return field.stop(robot, now);
    if (heard->published == on_air_) return;  // the air has it, and sees what has been added
    on_air_ = heard->published;
    track.samples = heard->published;
    track.count = kOpenEnd;
    track.sample_s = sample_s(heard->period);
    // what is put out within a tick is known after it: everything leaves a tick and a sample late
    track.start_s = sim::to_seconds(clock.click_at(heard->first_at) + field.tick()) + track.sample_s;
    return field.play(robot, track, now);
  }
  const Codec::Play& play = codec.take_news();
  if (play.count == 0) return field.stop(robot, now);
  track.samples = sound_bank();
  track.first = play.first;
  track.count = play.count;
  track.start_s = sim::to_seconds(clock.click_at(play.first_at));
  track.sample_s = sample_s(kCodecSampleCycles);
  field.play(robot, track, now);
}

}  // namespace board
