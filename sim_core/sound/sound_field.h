// SPDX-License-Identifier: MIT
// The air: what arrives at a place from the world's sound sources and from robots' loudspeakers, in Pa.
//
//   p(t) = sum over sources of  p_1m(t - r/c) / max(r, 2 cm)
//   r: way from where the source was; c = 343 m/s
//
// Free field: no echoes, nothing in the way, no air absorption, sources sound the same in all directions.
// Doppler needs no term of its own: r is measured to where a loudspeaker was when the sound left it.
//
// A pressure is a pure function of place, time and what was published at tick boundaries, however often and
// whenever it is asked for (up to 60 ms back):
//   - what a robot begins or ends to play counts from the next tick boundary on (below one tick late); the
//     samples themselves keep their instants, so a sound that begins within a tick lacks its first part
//   - robots are where they were one tick before
// Reading is safe from any thread while nobody publishes.
#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "sim_core/base/clock.h"
#include "sim_core/geometry/pose.h"
#include "sim_core/sound/sound_source.h"

namespace sim {

class Scene;
struct WorldDesc;

/// What a loudspeaker plays: samples at even distances of time, linear in between, silence before and after.
struct SpeakerTrack {
  std::shared_ptr<const std::vector<std::int16_t>> samples;
  std::int64_t first = 0;  ///< index of the first sample to be played; those outside `samples` are silent
  std::int64_t count = 0;  ///< how many are played
  double start_s = 0;      ///< when the first one leaves the loudspeaker, s since the world began
  double sample_s = 0;     ///< from one sample to the next
  double pa_per_unit = 0;  ///< Pa at 1 m
  Vec3 at_m;               ///< place of the loudspeaker in the robot's frame

  double end_s() const { return start_s + static_cast<double>(count) * sample_s; }
  /// Sample value at an instant, in the samples' own unit.
  double value(double at_s) const;
};

class SoundField {
 public:
  /// `tick`: from one publication to the next.
  SoundField(const WorldDesc& world, Clicks tick);

  /// True when nothing can be heard anywhere.
  bool is_silent() const { return sources_.empty() && voices_.empty(); }
  const std::vector<SoundSource>& sources() const { return sources_; }
  /// From one publication to the next.
  Clicks tick() const { return tick_; }

  /// Pressure at a place of the world at an instant, Pa.
  double pressure_pa(const Vec3& place_m, double at_s) const;

  // --- at tick boundaries, by the simulation

  /// Other sources from now on; what robots play goes on.
  void refurnish(const WorldDesc& world);
  /// The world begins again: its sources sound as at the beginning, from `now` on, and nothing
  /// else is in the air.
  void begin_again(Clicks now);
  /// The robot's loudspeaker plays this from `now` on instead of whatever it played.
  void play(int robot, const SpeakerTrack& track, Clicks now);
  /// It falls silent at `now`.
  void stop(int robot, Clicks now);
  /// True when advance() has anything to do.
  bool has_voices() const { return !voices_.empty(); }
  /// Notes where the loudspeakers are now; forgets what nobody can hear any more.
  void advance(const Scene& scene);

 private:
  struct Voice {
    int robot;
    SpeakerTrack track;
    double from_s;  // audible in [from_s, until_s) of the loudspeaker's time
    double until_s;
    Clicks first_tick;          // instant of places.front()
    std::deque<Vec3> places_m;  // one per tick
  };
  Vec3 place_of(const Voice& voice, double at_s) const;
  double heard_pa(const Voice& voice, const Vec3& place_m, double at_s) const;

  std::vector<SoundSource> sources_;
  double begun_s_ = 0;  // when their time began
  std::vector<Voice> voices_;
  Clicks tick_;
  double tick_s_;
};

/// Pressure at a point fixed to a robot (its frame, z up from the floor), Pa. `at` may lie up to 30 ms back,
/// not after the end of the tick that is running. 0 where the scene has no sound.
double sense_sound_pa(const Scene& scene, int robot, const Vec3& point_m, Clicks at);

/// False when sense_sound_pa() is 0 everywhere.
bool has_sound(const Scene& scene);

}  // namespace sim
