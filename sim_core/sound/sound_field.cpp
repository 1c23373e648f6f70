// SPDX-License-Identifier: MIT
#include "sim_core/sound/sound_field.h"

#include <algorithm>
#include <cmath>

#include "sim_core/sound/sound_params.h"
#include "sim_core/world/scene.h"
#include "sim_core/world/world_desc.h"

namespace sim {
namespace {

/// How long a voice is kept after it has fallen silent, s: its way to the furthest ear, and late questions.
constexpr double kMemoryS = kSpeakerRangeM / kSoundSpeedMs + 0.06;

double distance(const Vec3& a, const Vec3& b) {
  const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return std::sqrt(x * x + y * y + z * z);
}

Vec3 placed_at(const Pose2& pose, const Vec3& point_m) {
  const Vec2 at = Frame2(pose).to_world({point_m.x, point_m.y});
  return {at.x, at.y, point_m.z};
}

}  // namespace

double SpeakerTrack::value(double at_s) const {
  const double place = (at_s - start_s) / sample_s;
  if (!(place > -1.0) || place >= static_cast<double>(count)) return 0;
  const double whole = std::floor(place);
  const auto sample = [&](std::int64_t n) -> double {
    if (n < 0 || n >= count || !samples) return 0;
    n += first;
    return n >= 0 && n < static_cast<std::int64_t>(samples->size()) ? (*samples)[static_cast<std::size_t>(n)]
                                                                    : 0;
  };
  const auto n = static_cast<std::int64_t>(whole);
  const double f = place - whole;
  return (1 - f) * sample(n) + f * sample(n + 1);
}

SoundField::SoundField(const WorldDesc& world, Clicks tick) : tick_(tick), tick_s_(to_seconds(tick)) {
  refurnish(world);
}

void SoundField::refurnish(const WorldDesc& world) {
  sources_.clear();
  for (std::size_t i = 0; i < world.sounds.size(); ++i)
    sources_.emplace_back(world.sounds[i], world.seed, static_cast<int>(i));
}

double SoundField::pressure_pa(const Vec3& place_m, double at_s) const {
  double sum = 0;
  for (const SoundSource& source : sources_) {
    const double way_m = distance(place_m, source.position_m());
    sum += source.pressure_pa(at_s - begun_s_ - way_m / kSoundSpeedMs) / std::max(way_m, kNearestM);
  }
  for (const Voice& voice : voices_) sum += heard_pa(voice, place_m, at_s);
  return sum;
}

void SoundField::begin_again(Clicks now) {
  begun_s_ = to_seconds(now);
  voices_.clear();
}

void SoundField::play(int robot, const SpeakerTrack& track, Clicks now) {
  stop(robot, now);
  const double from_s = std::max(to_seconds(now), track.start_s - track.sample_s);
  if (track.end_s() <= from_s) return;
  voices_.push_back({robot, track, from_s, track.end_s(), now, {}});
}

void SoundField::stop(int robot, Clicks now) {
  const double now_s = to_seconds(now);
  for (Voice& voice : voices_)
    if (voice.robot == robot) voice.until_s = std::min(voice.until_s, std::max(now_s, voice.from_s));
}

void SoundField::advance(const Scene& scene) {
  const double now_s = to_seconds(scene.now());
  for (std::size_t i = 0; i < voices_.size();) {
    Voice& voice = voices_[i];
    if (now_s - voice.until_s > kMemoryS) {
      voices_.erase(voices_.begin() + static_cast<std::ptrdiff_t>(i));
      continue;
    }
    if (voice.places_m.empty()) voice.first_tick = scene.now();
    voice.places_m.push_back(placed_at(scene.state(voice.robot).pose, voice.track.at_m));
    while (now_s - to_seconds(voice.first_tick) > kMemoryS + 2 * tick_s_) {
      voice.places_m.pop_front();
      voice.first_tick += tick_;
    }
    ++i;
  }
}

/// Where the loudspeaker was one tick before `at_s`.
Vec3 SoundField::place_of(const Voice& voice, double at_s) const {
  const double place = (at_s - to_seconds(voice.first_tick)) / tick_s_ - 1;
  const auto last = static_cast<double>(voice.places_m.size() - 1);
  if (place <= 0) return voice.places_m.front();
  if (place >= last) return voice.places_m.back();
  const auto n = static_cast<std::size_t>(place);
  const double f = place - static_cast<double>(n);
  const Vec3 &a = voice.places_m[n], &b = voice.places_m[n + 1];
  return {a.x + f * (b.x - a.x), a.y + f * (b.y - a.y), a.z + f * (b.z - a.z)};
}

double SoundField::heard_pa(const Voice& voice, const Vec3& place_m, double at_s) const {
  if (voice.places_m.empty()) return 0;
  // robots are slow: two rounds find the instant of emission to below a nanosecond
  double left_s = at_s, way_m = 0;
  for (int round = 0; round < 2; ++round) {
    way_m = distance(place_m, place_of(voice, left_s));
    left_s = at_s - way_m / kSoundSpeedMs;
  }
  if (way_m > kSpeakerRangeM || left_s < voice.from_s || left_s >= voice.until_s) return 0;
  return voice.track.value(left_s) * voice.track.pa_per_unit / std::max(way_m, kNearestM);
}

double sense_sound_pa(const Scene& scene, int robot, const Vec3& point_m, Clicks at) {
  const SoundField* field = scene.sound();
  if (!field || field->is_silent()) return 0;
  // a pose of the tick that is running is not known yet
  const Pose2 pose = scene.pose_on_way(robot, std::max<Clicks>(0, at - scene.tick_clicks()));
  return field->pressure_pa(placed_at(pose, point_m), to_seconds(at));
}

bool has_sound(const Scene& scene) { return scene.sound() && !scene.sound()->is_silent(); }

}  // namespace sim
