// SPDX-License-Identifier: MIT
// The air: levels, distance, delay, Doppler, every kind of source, loudspeakers across tick boundaries, and
// that no value depends on when it is asked for. Expectations by hand beside each.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "sim_core/sound/sound_field.h"
#include "sim_core/sound/wav_file.h"
#include "tests/sim_core/fixture.h"

using namespace sim_test;

namespace {

constexpr sim::Clicks kTick = sim::kClicksPerSecond / 512;

sim::SoundDesc tone(double frequency_hz, double pressure_pa, sim::Vec3 at = {0, 0, 0}) {
  sim::SoundDesc s;
  s.kind = sim::SoundKind::Tone;
  s.frequency_hz = frequency_hz;
  s.pressure_pa = pressure_pa;
  s.position_m = at;
  return s;
}

sim::SoundField field_of(const sim::SoundDesc& sound) {
  sim::WorldDesc world;
  world.sounds = {sound};
  return sim::SoundField(world, kTick);
}

double rms(const sim::SoundField& field, const sim::Vec3& place, double from_s, double to_s, int samples) {
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const double p = field.pressure_pa(place, from_s + (to_s - from_s) * i / samples);
    sum += p * p;
  }
  return std::sqrt(sum / samples);
}

TEST(Sound, a_level_of_94_decibels_is_one_pascal) {
  EXPECT_NEAR(sim::pressure_of_level_pa(94), 1.0024, 1e-4);  // 20 uPa * 10^4.7
  EXPECT_NEAR(sim::pressure_of_level_pa(0), 20e-6, 1e-18);
  EXPECT_NEAR(sim::pressure_of_level_pa(-20), 2e-6, 1e-16);
}

TEST(Sound, pressure_falls_with_distance_and_arrives_late) {
  const sim::SoundField field = field_of(tone(1000, 1));
  // sqrt(2) Pa at 1 m; at 2 m half of it, and 2/343 s late
  for (double t : {0.1, 0.10013, 0.1007}) {
    EXPECT_NEAR(field.pressure_pa({1, 0, 0}, t), std::sqrt(2.0) * std::sin(2 * M_PI * 1000 * (t - 1 / 343.0)),
                1e-9);
    EXPECT_NEAR(field.pressure_pa({0, 0, 2}, t),
                std::sqrt(2.0) / 2 * std::sin(2 * M_PI * 1000 * (t - 2 / 343.0)), 1e-9);
  }
  EXPECT_EQ(field.pressure_pa({3.43, 0, 0}, 0.00999), 0);  // not there yet
  EXPECT_NE(field.pressure_pa({3.43, 0, 0}, 0.0101), 0);
}

TEST(Sound, nearer_than_two_centimetres_it_gets_no_louder) {
  const sim::SoundField field = field_of(tone(100, 1));
  EXPECT_NEAR(rms(field, {0.005, 0, 0}, 0.1, 0.2, 1000), 50, 0.01);  // 1 Pa m / 0.02 m
}

TEST(Sound, a_source_starts_and_stops_at_its_own_place) {
  sim::SoundDesc s = tone(1000, 1);
  s.start_s = 1;
  s.stop_s = 2;
  const sim::SoundField field = field_of(s);
  EXPECT_EQ(field.pressure_pa({1, 0, 0}, 1.0029), 0);   // 1/343 s = 2.915 ms
  EXPECT_NE(field.pressure_pa({1, 0, 0}, 1.00315), 0);  // a quarter of a period later
  EXPECT_NE(field.pressure_pa({1, 0, 0}, 2.0027), 0);
  EXPECT_EQ(field.pressure_pa({1, 0, 0}, 2.0030), 0);
}

TEST(Sound, white_noise_has_its_level_and_no_memory) {
  sim::SoundDesc s = tone(0, 0.5);
  s.kind = sim::SoundKind::Noise;
  const sim::SoundField field = field_of(s);
  // 20000 nearly independent samples: 0.5 within 2 %
  EXPECT_NEAR(rms(field, {1, 0, 0}, 1, 3, 20000), 0.5, 0.01);
  double product = 0;
  for (int i = 0; i < 20000; ++i)
    product += field.pressure_pa({1, 0, 0}, 1 + i * 1e-4) * field.pressure_pa({1, 0, 0}, 1.00005 + i * 1e-4);
  EXPECT_NEAR(product / 20000, 0, 0.25 * 0.03);  // 50 us apart: more than two steps of the grid
}

// a noise of 900 to 1100 Hz, looked at through a window of 0.1 s (10 Hz wide): nearly all
// power lies in the band
TEST(Sound, noise_with_a_band_stays_in_it) {
  sim::SoundDesc s = tone(0, 1);
  s.kind = sim::SoundKind::Noise;
  s.band_hz = {900.0, 1100.0};
  const sim::SoundField field = field_of(s);
  constexpr int kSamples = 4000;
  std::vector<double> p(kSamples);
  double all = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double window = 0.5 - 0.5 * std::cos(2 * M_PI * i / kSamples);
    p[static_cast<std::size_t>(i)] = window * field.pressure_pa({1, 0, 0}, 1 + i * 0.1 / kSamples);
    all += p[static_cast<std::size_t>(i)] * p[static_cast<std::size_t>(i)];
  }
  double inside = 0;
  for (int bin = 88; bin <= 112; ++bin) {
    double re = 0, im = 0;
    for (int i = 0; i < kSamples; ++i) {
      re += p[static_cast<std::size_t>(i)] * std::cos(2 * M_PI * bin * i / kSamples);
      im += p[static_cast<std::size_t>(i)] * std::sin(2 * M_PI * bin * i / kSamples);
    }
    inside += 2 * (re * re + im * im) / kSamples;
  }
  EXPECT_GT(inside, 0.999 * all);
  EXPECT_NEAR(rms(field, {1, 0, 0}, 1, 6, 50000), 1, 0.05);
}

TEST(Sound, claps_come_at_the_given_times_and_die_away) {
  sim::SoundDesc s = tone(0, 10);
  s.kind = sim::SoundKind::Clap;
  s.times_s = {2.5, 1.0};  // in any order
  const sim::SoundField field = field_of(s);
  const sim::Vec3 near{1, 0, 0};
  const double late = 1 / 343.0;
  EXPECT_EQ(rms(field, near, 0.5, 1.0 + late - 1e-6, 2000), 0);
  const double first = rms(field, near, 1.0 + late, 1.002 + late, 400);
  EXPECT_GT(first, 3);
  // four decay times of 4 ms later: e^-4 = 0.018 of it, if the noise were the same
  EXPECT_LT(rms(field, near, 1.016 + late, 1.018 + late, 400), 0.1 * first);
  EXPECT_EQ(rms(field, near, 1.032 + late + 1e-9, 2.5 + late - 1e-6, 2000), 0);
  EXPECT_GT(rms(field, near, 2.5 + late, 2.502 + late, 400), 3);
  EXPECT_EQ(rms(field, near, 2.6, 9, 2000), 0);
}

TEST(Sound, claps_every_so_often_are_shifted_by_their_jitter) {
  sim::SoundDesc s = tone(0, 10);
  s.kind = sim::SoundKind::Clap;
  s.start_s = 0.5;
  s.every_s = 2;
  const sim::SoundSource even(s, 1, 0);
  for (int n = 0; n < 5; ++n) EXPECT_DOUBLE_EQ(even.clap_s(n), 0.5 + 2 * n);
  s.jitter_s = 0.8;
  s.seed = 7;
  const sim::SoundSource shifted(s, 1, 0), same(s, 99, 0);
  s.seed = 8;
  const sim::SoundSource other(s, 1, 0);
  int different = 0;
  for (int n = 0; n < 50; ++n) {
    EXPECT_GE(shifted.clap_s(n), 0.5 + 2 * n);
    EXPECT_LE(shifted.clap_s(n), 1.3 + 2 * n);
    EXPECT_EQ(shifted.clap_s(n), same.clap_s(n));  // its own seed counts, not the world's
    different += shifted.clap_s(n) != other.clap_s(n);
    // and that is where it sounds
    double power = 0;
    for (int i = 0; i < 100; ++i) power += std::abs(shifted.pressure_pa(shifted.clap_s(n) + i * 2e-5));
    EXPECT_GT(power, 0);
    EXPECT_EQ(shifted.pressure_pa(shifted.clap_s(n) - 1e-6), 0);
  }
  EXPECT_GT(different, 45);
}

TEST(Sound, a_file_is_played_once_or_again_and_again) {
  sim::SoundDesc s;
  s.kind = sim::SoundKind::Wav;
  s.pressure_pa = 1 / std::sqrt(2.0);  // a full-scale sample is 1 Pa
  s.samples = {0, 1, -0.5f, 0.25f};
  s.sample_rate_hz = 1000;
  const sim::SoundSource again(s, 1, 0);
  EXPECT_NEAR(again.pressure_pa(0.001), 1, 1e-9);
  EXPECT_NEAR(again.pressure_pa(0.0015), 0.25, 1e-6);   // half way from 1 to -0.5
  EXPECT_NEAR(again.pressure_pa(0.0035), 0.125, 1e-6);  // from the last back to the first
  EXPECT_NEAR(again.pressure_pa(0.401), 1, 1e-9);
  s.loop = false;
  const sim::SoundSource once(s, 1, 0);
  EXPECT_NEAR(once.pressure_pa(0.003), 0.25, 1e-6);
  EXPECT_EQ(once.pressure_pa(0.004), 0);
  EXPECT_EQ(once.pressure_pa(0.401), 0);
}

// --- WAV

std::string wav(int bits, int channels, const std::string& data, int format = 1, int rate = 8000) {
  const auto little = [](int value, int count) {
    std::string out;
    for (int i = 0; i < count; ++i) out += static_cast<char>(value >> (8 * i));
    return out;
  };
  return "RIFF" + little(36, 4) + "WAVE" + "LIST" + little(3, 4) + "abc" +
         std::string(1, '\0') +  // odd: padded
         "fmt " + little(16, 4) + little(format, 2) + little(channels, 2) + little(rate, 4) +
         little(rate * channels * bits / 8, 4) + little(channels * bits / 8, 2) + little(bits, 2) + "data" +
         little(static_cast<int>(data.size()), 4) + data;
}

TEST(Wav, all_widths_and_stereo_are_read) {
  sim::WavSound out;
  EXPECT_EQ(sim::parse_wav(wav(16, 1, std::string("\x00\x40\x00\x80\xff\x7f", 6)), out), "");
  EXPECT_EQ(out.rate_hz, 8000);
  EXPECT_EQ(out.samples, (std::vector<float>{0.5f, -1.0f, 32767 / 32768.0f}));
  EXPECT_EQ(sim::parse_wav(wav(8, 1, std::string("\x80\xc0\x00", 3)), out), "");
  EXPECT_EQ(out.samples, (std::vector<float>{0, 0.5f, -1}));
  // left 0.5, right -0.25: the mean is 0.125
  EXPECT_EQ(sim::parse_wav(wav(16, 2, std::string("\x00\x40\x00\xe0", 4)), out), "");
  EXPECT_EQ(out.samples, (std::vector<float>{0.125f}));
  // what editors export beside these: 24 bits, and numbers with a point, of which 4 is cut to 1 and none is silence
  EXPECT_EQ(sim::parse_wav(wav(24, 1, std::string("\x00\x00\x40\x00\x00\x80", 6)), out), "");
  EXPECT_EQ(out.samples, (std::vector<float>{0.5f, -1.0f}));
  EXPECT_EQ(
      sim::parse_wav(wav(32, 1, std::string("\x00\x00\x00\xbf\x00\x00\x80\x40\x00\x00\xc0\x7f", 12), 3), out),
      "");
  EXPECT_EQ(out.samples, (std::vector<float>{-0.5f, 1, 0}));
}

TEST(Wav, more_is_said_than_is_there) {
  sim::WavSound out;
  std::string cut = wav(16, 1, std::string("\x00\x40\x00\x80", 4));
  for (const char* said : {"\xff\xff\xff\xff", "\xff\xff\xff\x7f"}) {
    cut.replace(cut.size() - 8, 4, said, 4);
    EXPECT_EQ(sim::parse_wav(cut, out), "");
    EXPECT_EQ(out.samples, (std::vector<float>{0.5f, -1.0f}));
  }
  cut.replace(cut.size() - 8, 4, "\x10\x00\x00\x00", 4);
  EXPECT_EQ(sim::parse_wav(cut, out), "got 4 of 16 bytes of samples, expected a whole file");
}

// libsndfile looked for what is in such a chunk for a minute
TEST(Wav, a_chunk_longer_than_the_file_ends_it) {
  sim::WavSound out;
  std::string endless = wav(16, 1, "abcd");
  endless.replace(endless.find("LIST") + 4, 4, "\x04\xff\xff\xff", 4);
  EXPECT_EQ(sim::parse_wav(endless, out),
            "got a WAV file that cannot be read (Error in WAV file. No 'data' chunk marker.), expected a "
            "whole one");
}

TEST(Wav, mistakes_are_named) {
  sim::WavSound out;
  EXPECT_EQ(sim::parse_wav("RIFX0000WAVE", out),
            "got a file that does not begin as a WAV file does, expected \"RIFF....WAVE\"");
  EXPECT_EQ(sim::parse_wav(wav(0, 1, "abcd", 0x55), out),
            "got samples in MPEG, expected a WAV file of another format");
  EXPECT_EQ(sim::parse_wav(wav(16, 6, "abcdefghijkl"), out), "got 6 channels, expected 1 or 2");
  for (const int rate : {10, 999, 1000, 192000, 192001})
    EXPECT_EQ(sim::parse_wav(wav(16, 1, "ab", 1, rate), out),
              rate >= 1000 && rate <= 192000
                  ? ""
                  : "got " + std::to_string(rate) + " samples a second, expected 1000 to 192000");
  EXPECT_EQ(sim::parse_wav(wav(16, 1, ""), out),
            "got no samples, expected a \"data\" chunk with at least one");
  EXPECT_EQ(sim::parse_wav("RIFF0000WAVE", out),
            "got a WAV file that cannot be read (Error in WAV file. No 'data' chunk marker.), expected a "
            "whole one");
  EXPECT_EQ(sim::read_wav("/nowhere/at/all.wav", out), "cannot be read: No such file or directory");
  // cut off anywhere: an answer, never a crash
  const std::string whole = wav(16, 2, "abcdefgh");
  for (std::size_t n = 0; n < whole.size(); ++n) sim::parse_wav(whole.substr(0, n), out);
}

TEST(Wav, a_recording_is_whole_after_every_append) {
  const std::string path = ::testing::TempDir() + "/recording.wav";
  sim::WavRecorder recorder(path, 7200);
  sim::WavSound out;
  EXPECT_EQ(sim::read_wav(path, out), "got no samples, expected a \"data\" chunk with at least one");
  EXPECT_TRUE(recorder.append({16384, -32768}));
  EXPECT_EQ(sim::read_wav(path, out), "");  // while the recorder still has it open
  EXPECT_EQ(out.samples, (std::vector<float>{0.5f, -1.0f}));
  EXPECT_TRUE(recorder.append({8192}));
  EXPECT_EQ(sim::read_wav(path, out), "");
  EXPECT_EQ(out.samples, (std::vector<float>{0.5f, -1.0f, 0.25f}));
  EXPECT_EQ(out.rate_hz, 7200);
  EXPECT_EQ(std::filesystem::file_size(path), 44u + 3 * 2u);  // the shortest header, and two bytes a sample
  std::remove(path.c_str());
  sim::WavRecorder nowhere("/nowhere/at/all.wav", 7200);
  EXPECT_EQ(nowhere.error(), "/nowhere/at/all.wav: cannot be written: No such file or directory");
  EXPECT_FALSE(nowhere.append({1}));
  sim::WavRecorder full("/dev/full", 7200);
  EXPECT_FALSE(full.append({1}));
  EXPECT_EQ(full.error(), "/dev/full: cannot be written: No space left on device");
}

// --- world files

std::string report_of(const std::string& text) {
  return sim::parse_world("twinpuck = 1\n" + text, "w.toml", {puck()}).report("w.toml");
}

TEST(SoundInWorlds, keys_arrive) {
  const auto world = world_of(R"(twinpuck = 1
[[sound]]
kind = "tone"
position = [0.3, 0.1, 0.04]
frequency = 440
level = 60
start = 1.5
stop = 2
[[sound]]
kind = "clap"
position = [0, 0, 0]
every = 3
jitter = 0.5
seed = 12
[[sound]]
kind = "noise"
position = [0, 0, 0]
band = [200, 400]
pressure = 0.25
)");
  ASSERT_EQ(world.sounds.size(), 3u);
  EXPECT_EQ(world.sounds[0].frequency_hz, 440);
  EXPECT_EQ(world.sounds[0].level_db, 60);
  EXPECT_EQ(world.sounds[0].position_m.y, 0.1);
  EXPECT_EQ(world.sounds[0].start_s, 1.5);
  EXPECT_EQ(world.sounds[0].stop_s, 2);
  EXPECT_EQ(world.sounds[1].every_s, 3);
  EXPECT_EQ(world.sounds[1].jitter_s, 0.5);
  EXPECT_EQ(world.sounds[1].seed, 12u);
  EXPECT_EQ((*world.sounds[2].band_hz)[1], 400);
  EXPECT_EQ(world.sounds[2].pressure_pa, 0.25);
}

TEST(SoundInWorlds, mistakes_are_named) {
  EXPECT_EQ(
      report_of("[[sound]]\nkind = \"tune\"\nposition = [0, 0, 0]\n"),
      "w.toml:3:8: sound.kind: got \"tune\", expected one of tone, noise, wav, clap; did you mean 'tone'?");
  EXPECT_EQ(report_of("[[sound]]\nkind = \"noise\"\nposition = [0, 0, 0]\nband = [400, 200]\n"),
            "w.toml:5:8: sound.band: got 400 to 200 Hz, expected the lower frequency first");
  EXPECT_EQ(report_of("[[sound]]\nkind = \"noise\"\nposition = [0, 0, 0]\nband = [300, 300]\n"),
            "w.toml:5:8: sound.band: got 300 to 300 Hz, expected the lower frequency first");
  EXPECT_EQ(report_of("[[sound]]\nkind = \"tone\"\nposition = [0, 0, 0]\nstart = 3\nstop = 2\n"),
            "w.toml:6:8: sound.stop: got 2 s, expected more than the start at 3 s");
  EXPECT_EQ(report_of("[[sound]]\nkind = \"wav\"\nposition = [0, 0, 0]\n"),
            "w.toml:2:1: sound.file: missing, expected the name of a WAV file, since kind is \"wav\"");
  EXPECT_EQ(report_of("[[sound]]\nkind = \"wav\"\nposition = [0, 0, 0]\nfile = \"no.wav\"\n"),
            "w.toml:5:8: sound.file: cannot be read: No such file or directory");
}

// --- loudspeakers

/// Plays a track from a given instant on, and samples its ears in every tick.
class Singer : public Cruise {
 public:
  Singer(double left_rad_s, double right_rad_s) : Cruise(left_rad_s, right_rad_s) { set_idle_until(0); }
  void run_until(const sim::Scene& scene, sim::Clicks end) override {
    for (; next_ < end; next_ += 900) {
      if (listen) heard.push_back(sim::sense_sound_pa(scene, robot, ear_m, next_));
      // the same instant, asked for again 5 ms later
      const sim::Clicks before = next_ - 81 * 900;
      if (listen && before >= 0) again.push_back(sim::sense_sound_pa(scene, robot, ear_m, before));
    }
    if (!track.samples && end >= play_at && play_at >= 0) {
      track.samples = wave;
      track.count = static_cast<std::int64_t>(wave->size());
      track.start_s = sim::to_seconds(play_at);
      track.sample_s = 1 / 7200.0;
      track.pa_per_unit = 1e-4;
      news_ = true;
    }
    if (stop_at >= 0 && end > stop_at) stop_at = -1, stopping_ = news_ = true;
  }
  bool has_sound_news() const override { return news_; }
  void publish_sound(sim::SoundField& field, int robot_index, sim::Clicks now) override {
    if (stopping_)
      field.stop(robot_index, now);
    else
      field.play(robot_index, track, now);
    news_ = stopping_ = false;
  }

  int robot = 0;
  bool listen = false;
  sim::Vec3 ear_m{0, 0, 0.035};
  sim::Clicks play_at = -1, stop_at = -1;
  std::shared_ptr<std::vector<std::int16_t>> wave =
      std::make_shared<std::vector<std::int16_t>>(7200, std::int16_t{1000});
  sim::SpeakerTrack track;
  std::vector<double> heard, again;

 private:
  sim::Clicks next_ = 0;
  bool news_ = false, stopping_ = false;
};

struct Pair {
  Pair(double distance_m, double speed_rad_s, int threads = 1, double spin_rad_s = 0) {
    sim::WorldDesc world;
    world.models = {puck()};
    world.robots.resize(2);
    world.robots[0].name = "ear";
    world.robots[1].name = "mouth";
    world.robots[1].pose = {distance_m, 0, 0};
    auto a = std::make_unique<Singer>(-spin_rad_s, spin_rad_s),
         b = std::make_unique<Singer>(speed_rad_s, speed_rad_s);
    ear = a.get(), mouth = b.get();
    ear->listen = true;
    mouth->robot = 1;
    sim::Minds minds;
    minds.push_back(std::move(a));
    minds.push_back(std::move(b));
    simulation = std::make_unique<sim::Simulation>(world, std::move(minds), threads);
  }
  Singer *ear, *mouth;
  std::unique_ptr<sim::Simulation> simulation;
};

TEST(Speaker, is_heard_after_the_way_from_the_next_tick_on) {
  Pair p(0.686, 0);  // 2 ms away; heights differ by 35 mm
  p.mouth->track.at_m = {0, 0, 0.035};
  p.mouth->play_at = 10 * kTick + kTick / 2;
  p.simulation->run_until(sim::from_seconds(0.1));
  const auto& heard = p.ear->heard;
  // 1000 units of 1e-4 Pa over 0.686 m; begun within tick 10, so published at tick 11, arriving 2 ms later
  const sim::Clicks arrival = 11 * kTick + sim::from_seconds(0.002);
  for (std::size_t i = 0; i < heard.size(); ++i) {
    const auto at = static_cast<sim::Clicks>(i) * 900;
    if (at < arrival - 1) {
      EXPECT_EQ(heard[i], 0) << i;
    }
    if (at > arrival + 1) {
      EXPECT_NEAR(heard[i], 0.1 / 0.686, 1e-9) << i;
    }
  }
}

TEST(Speaker, a_sample_has_one_value_whenever_it_is_asked_for) {
  for (int threads : {1, 2}) {
    Pair p(0.2, -6, threads, 4);  // backwards at 12 cm/s, towards a listener that turns
    p.ear->ear_m = {0.01, 0.03, 0.035};
    p.mouth->play_at = 5 * kTick + 77;
    p.mouth->stop_at = 40 * kTick + 1000;
    for (std::size_t i = 0; i < p.mouth->wave->size(); ++i)
      (*p.mouth->wave)[i] = static_cast<std::int16_t>(20000 * std::sin(0.7 * static_cast<double>(i)));
    p.simulation->run_until(sim::from_seconds(0.2));
    const auto &heard = p.ear->heard, &again = p.ear->again;
    ASSERT_GT(again.size(), 2000u);
    int sounding = 0;
    for (std::size_t i = 0; i < again.size(); ++i) {
      EXPECT_EQ(heard[i], again[i]) << i;
      sounding += heard[i] != 0;
    }
    // from tick 6 to tick 41, 2.2 of 900 clicks a tick make 32 questions each
    EXPECT_NEAR(sounding, 35 * 32, 40);
  }
}

// 12.3 cm/s towards the listener: a tone of 1000 Hz is heard at 1000 / (1 - 0.123 / 343) Hz. Measured over
// 0.6 s by counting the phase: 0.6 * 0.359 Hz = 0.215 turns more than at rest.
TEST(Speaker, doppler_comes_from_the_way) {
  double turns[2];
  for (int moving = 0; moving < 2; ++moving) {
    Pair p(0.5, moving ? -6 : 0);
    p.mouth->play_at = 0;
    for (std::size_t i = 0; i < p.mouth->wave->size(); ++i)
      (*p.mouth->wave)[i] = static_cast<std::int16_t>(
          std::lround(20000 * std::sin(2 * M_PI * 1000 * static_cast<double>(i) / 7200)));
    p.simulation->run_until(sim::from_seconds(0.9));
    const auto phase = [&](double at_s) {
      double re = 0, im = 0;
      const int first = static_cast<int>(at_s * 16384);
      for (int i = first; i < first + 1024; ++i) {
        const double t = i / 16384.0;
        re += p.ear->heard[static_cast<std::size_t>(i)] * std::cos(2 * M_PI * 1000 * t);
        im += p.ear->heard[static_cast<std::size_t>(i)] * std::sin(2 * M_PI * 1000 * t);
      }
      return std::atan2(re, im) / (2 * M_PI);
    };
    turns[moving] = phase(0.8) - phase(0.2);
    turns[moving] -= std::floor(turns[moving] + 0.5);
  }
  EXPECT_NEAR(turns[0], 0, 1e-3);
  EXPECT_NEAR(turns[1], 0.215, 0.01);
}

TEST(Speaker, silence_is_forgotten_and_costs_nothing) {
  Pair p(0.3, 0);
  p.mouth->play_at = 0;
  p.mouth->wave->resize(72);  // 10 ms
  EXPECT_TRUE(p.simulation->sound().is_silent());
  p.simulation->run_until(sim::from_seconds(0.05));
  EXPECT_FALSE(p.simulation->sound().is_silent());
  p.simulation->run_until(sim::from_seconds(0.3));
  EXPECT_TRUE(p.simulation->sound().is_silent());
}

}  // namespace
