// SPDX-License-Identifier: MIT
// [[sound]]: what sounds in a world.
#include <fmt/format.h>

#include "sim_core/load/schema_keys.h"
#include "sim_core/load/schema_sections.h"
#include "sim_core/sound/sound_params.h"

namespace sim {

std::vector<SectionSpec> sound_sections() {
  using S = SoundDesc;
  return {
      {"sound",
       true,
       "Something that sounds. Pressure falls with 1/distance and arrives after distance / 343 m/s; no "
       "echoes, and "
       "nothing stands in the way.",
       {
           {"name", ValueType::Text, "", 0, 0, "", "", "",
            into<S>([](S& s, const Value& v) { s.name = v.text; })},
           {"kind", ValueType::Choice, "", 0, 0, "tone|noise|wav|clap", "required",
            "tone: a sine; noise: white, or in a band; wav: a file; clap: short bursts",
            into<S>([](S& s, const Value& v) {
              s.kind = v.text == "tone"    ? SoundKind::Tone
                       : v.text == "noise" ? SoundKind::Noise
                       : v.text == "wav"   ? SoundKind::Wav
                                           : SoundKind::Clap;
            })},
           {"position", ValueType::Triple, "m", -kFar, kFar, "", "required", "x, y and z",
            into<S>([](S& s, const Value& v) {
              s.position_m = {v.numbers[0], v.numbers[1], v.numbers[2]};
            })},
           {"level", ValueType::Number, "dB SPL", -50, 160, "", "70",
            "at a distance of 1 m; of a file: where a sine uses its full range; of a clap: when it begins",
            into<S>([](S& s, const Value& v) { s.level_db = v.number; })},
           {"pressure", ValueType::Number, "Pa", 0, 2000, "", "",
            "root mean square at a distance of 1 m, instead of `level`",
            into<S>([](S& s, const Value& v) { s.pressure_pa = v.number; })},
           {"frequency", ValueType::Number, "Hz", 1, 20000, "", "1000", "of a tone",
            into<S>([](S& s, const Value& v) { s.frequency_hz = v.number; })},
           {"band", ValueType::Pair, "Hz", 1, 20000, "", "", "lowest and highest frequency of a noise",
            checked<S>([](S& s, const Value& v, const WorldDesc&) {
              if (v.numbers[0] >= v.numbers[1])
                return fmt::format("got {} to {} Hz, expected the lower frequency first", v.numbers[0],
                                   v.numbers[1]);
              s.band_hz = {v.numbers[0], v.numbers[1]};
              return std::string();
            })},
           {"file", ValueType::Text, "", 0, 0, "", "",
            "WAV file, mono or stereo (averaged); relative to this file",
            into<S>([](S& s, const Value& v) { s.file = v.text; })},
           {"loop", ValueType::Flag, "", 0, 0, "", "true", "false: the file is played once",
            into<S>([](S& s, const Value& v) { s.loop = v.flag; })},
           {"times", ValueType::Numbers, "s", 0, kMany, "", "",
            "when claps begin; without it there is one every `every` seconds",
            into<S>([](S& s, const Value& v) { s.times_s = v.numbers; })},
           {"every", ValueType::Number, "s", kClapShortestGapS, kMany, "", "1",
            "from clap to clap, the first at `start`",
            into<S>([](S& s, const Value& v) { s.every_s = v.number; })},
           {"jitter", ValueType::Number, "s", 0, kMany, "", "0",
            "each of these claps comes later by a random time between 0 and this",
            into<S>([](S& s, const Value& v) { s.jitter_s = v.number; })},
           {"seed", ValueType::Integer, "", 0, 9e18, "", "",
            "of its noise, claps and jitter; otherwise the world's",
            into<S>([](S& s, const Value& v) { s.seed = static_cast<std::uint64_t>(v.integer); })},
           {"start", ValueType::Number, "s", 0, kMany, "", "0", "silent before",
            into<S>([](S& s, const Value& v) { s.start_s = v.number; })},
           {"stop", ValueType::Number, "s", 0, kMany, "", "", "silent from then on",
            into<S>([](S& s, const Value& v) { s.stop_s = v.number; })},
       }}};
}

}  // namespace sim
