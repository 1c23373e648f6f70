// SPDX-License-Identifier: MIT
// Films: that what is read back is what was drawn, when frames are taken, and what is in a file that
// was never finished.
#include <sys/resource.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "sim_core/record/film.h"
#include "sim_core/record/frame_encoder.h"
#include "tests/sim_core/fixture.h"
#include "tests/support/film_reader.h"

using namespace sim_test;
using film_test::Read;

namespace {

/// A red square of 16 px on white that moves right by 8 px a frame; the frame is 64 x 48.
std::vector<std::uint32_t> square_at(int frame) {
  std::vector<std::uint32_t> pixels(64 * 48, 0xffffff);
  for (int y = 16; y < 32; ++y)
    for (int x = 8 * frame; x < 8 * frame + 16; ++x) pixels[static_cast<std::size_t>(64 * y + x)] = 0xff0000;
  return pixels;
}

void expect_squares(const Read& film, int tolerance) {
  ASSERT_EQ(film.error, "");
  EXPECT_EQ(film.width_px, 64);
  EXPECT_EQ(film.height_px, 48);
  ASSERT_EQ(film.rgb.size(), 6u);
  for (int f = 0; f < 6; ++f) {
    EXPECT_NEAR(film.time_s[static_cast<std::size_t>(f)], 0.1 * f, 1e-9);
    const auto wanted = square_at(f);
    int wrong = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      for (int c = 0; c < 3; ++c)
        wrong +=
            std::abs(static_cast<int>(wanted[i] >> (16 - 8 * c) & 255) -
                     film.rgb[static_cast<std::size_t>(f)][3 * i + static_cast<std::size_t>(c)]) > tolerance;
    EXPECT_EQ(wrong, 0) << "frame " << f;
  }
}

TEST(FrameEncoder, an_animated_png_is_read_back_exactly) {
  const std::string path = scratch("squares.apng");
  auto encoder = sim::make_apng_encoder(path, 64, 48, 10);
  for (int f = 0; f < 6; ++f) {
    encoder->add(square_at(f).data(), 64);
    // whole after each frame, as if the program ended here
    const Read so_far = film_test::read_apng(path);
    EXPECT_EQ(so_far.error, "");
    EXPECT_EQ(so_far.rgb.size(), static_cast<std::size_t>(f) + 1);
  }
  encoder->finish();
  EXPECT_EQ(encoder->error(), "");
  expect_squares(film_test::read_apng(path), 0);
}

TEST(FrameEncoder, a_webm_is_read_back_in_its_colours) {
  const std::string path = scratch("squares.webm");
  auto encoder = sim::make_webm_encoder(path, 64, 48, 10);
  for (int f = 0; f < 6; ++f) {
    encoder->add(square_at(f).data(), 64);
    // no end, no index, but every frame so far
    const Read so_far = film_test::read_webm(path);
    EXPECT_EQ(so_far.rgb.size(), static_cast<std::size_t>(f) + 1);
    EXPECT_FALSE(so_far.has_index);
    EXPECT_EQ(so_far.duration_s, 0);
  }
  encoder->finish();
  EXPECT_EQ(encoder->error(), "");
  const Read film = film_test::read_webm(path);
  expect_squares(film, 40);  // pure red loses a little, edges ring
  EXPECT_TRUE(film.has_index);
  EXPECT_NEAR(film.duration_s, 0.6, 1e-9);  // six frames of 0.1 s
}

TEST(FrameEncoder, a_disk_that_fills_up_leaves_what_was_filmed) {
  // no file above 8 KB; the signal would end the program before it can say so
  rlimit before{}, little{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  little = before;
  little.rlim_cur = 8192;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const bool webm : {true, false}) {
    const std::string path = scratch(webm ? "little.webm" : "little.apng");
    auto encoder = (webm ? sim::make_webm_encoder : sim::make_apng_encoder)(path, 64, 48, 10);
    ::setrlimit(RLIMIT_FSIZE, &little);
    int frames = 0;
    for (; frames < 100'000 && encoder->error().empty(); ++frames)
      encoder->add(square_at(frames % 6).data(), 64);
    ::setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(encoder->error(), path + ": cannot be written: File too large");
    const Read read = webm ? film_test::read_webm(path) : film_test::read_apng(path);
    EXPECT_EQ(read.error, "");
    EXPECT_EQ(static_cast<int>(read.rgb.size()), frames - 1);  // all but the one that did not fit
  }
  std::signal(SIGXFSZ, handler);
}

TEST(Film, frames_are_taken_at_exact_times_whatever_the_tick) {
  // one frame of film is 0.04 s: 20.48 ticks at 512 Hz, 3.84 at 96 Hz; wheels followed exactly, so the robot
  // is at the same place at the same instant in both worlds, and so in both films
  Read films[2];
  int i = 0;
  for (const char* hz : {"96", "512"}) {
    const std::string path = scratch(std::string("film") + hz + ".png");
    auto s = cruising(
        world_of(std::string("twinpuck = 1\ntitle = \"t\"\n[world]\nengine = \"kinematic\"\nphysics_hz = ") +
                 hz + "\n[arena]\nsize = [0.4, 0.2]\n[[robot]]\nposition = [-0.1, 0]\n"),
        4, 4);
    sim::FilmOptions options;
    options.size_px = 320;
    options.trail_s = 0;  // its points are those of ticks
    sim::Film film(path, s->scene(), options);
    film.sample(s->scene(), s->minds());
    while (s->now() < sim::from_seconds(1)) {
      s->step();
      film.sample(s->scene(), s->minds());
    }
    film.finish();
    EXPECT_EQ(film.error(), "");
    films[i] = film_test::read_apng(path);
    ASSERT_EQ(films[i].error, "");
    EXPECT_EQ(films[i].rgb.size(), 26u);  // 0, 0.04 .. 1 s
    EXPECT_EQ(films[i].width_px, film.width_px());
    EXPECT_EQ(films[i].height_px, film.height_px());
    EXPECT_EQ(std::max(films[i].width_px, films[i].height_px), 320);
    ++i;
  }
  for (std::size_t f = 0; f < 26; ++f) {
    int worst = 0;
    for (std::size_t p = 0; p < films[0].rgb[f].size(); ++p)
      worst = std::max(worst, std::abs(int(films[0].rgb[f][p]) - int(films[1].rgb[f][p])));
    EXPECT_LE(worst, 2) << "frame " << f;
  }
  EXPECT_NE(films[0].rgb[0], films[0].rgb[25]);
}

TEST(Film, the_robot_is_drawn_where_it_is) {
  // 0.4 x 0.2 m inside with walls of 1 cm: 42 cm on 320 - 2 * 8 px are 723.8 px/m
  const std::string path = scratch("place.png");
  auto s = cruising(
      world_of("twinpuck = 1\n[arena]\nsize = [0.4, 0.2]\n[[robot]]\nname = \"r\"\nposition = [0.1, 0.05]\n"
               "heading = 90\n"),
      0, 0);
  sim::FilmOptions options;
  options.size_px = 320;
  sim::Film film(path, s->scene(), options);
  film.sample(s->scene(), s->minds());
  film.finish();
  const Read read = film_test::read_apng(path);
  ASSERT_EQ(read.error, "");
  ASSERT_EQ(read.rgb.size(), 1u);
  const auto pixel = [&](double x_m, double y_m) {
    const int x = static_cast<int>(8 + (x_m + 0.21) * 723.8), y = static_cast<int>(30 + (0.11 - y_m) * 723.8);
    const auto* c = &read.rgb[0][3 * static_cast<std::size_t>(y * read.width_px + x)];
    return std::array<int, 3>{c[0], c[1], c[2]};
  };
  // the arrow points north and is white: its tip lies 0.72 radii ahead
  EXPECT_GT(pixel(0.1, 0.05 + 0.6 * 0.037)[0], 220);
  // beside the tip the body: green by default
  const auto body = pixel(0.1 + 0.45 * 0.037, 0.05 + 0.6 * 0.037);
  EXPECT_GT(body[1], body[0] + 30);
  // the floor elsewhere
  EXPECT_GT(pixel(-0.12, -0.05)[0], 215);
}

TEST(Film, speed_and_rate_set_the_instants_and_labels_are_seen) {
  const std::string path = scratch("fast.webm");
  auto s = cruising(world_of("twinpuck = 1\n[arena]\nsize = [1, 1]\n[[robot]]\n"), 2, 3);
  sim::FilmOptions options;
  options.frames_per_s = 10;
  options.speed = 5;  // a frame each 0.5 s
  options.size_px = 200;
  options.sensor_rays = true;
  sim::Film film(path, s->scene(), options);
  film.sample(s->scene(), s->minds());
  while (s->now() < sim::from_seconds(4)) {
    s->step();
    // a label that says nothing before 2 s; half the picture high, magenta
    std::vector<sim::PictureLabel> labels;
    if (s->now() >= sim::from_seconds(2))
      labels.push_back({1, "\xE2\x96\x88\xFF", 0, 0.25, 0.5, 0xff00ff, 0});
    film.sample(s->scene(), s->minds(), labels);
  }
  film.finish();
  EXPECT_EQ(film.error(), "");
  const Read read = film_test::read_webm(path);
  ASSERT_EQ(read.error, "");
  ASSERT_EQ(read.rgb.size(), 9u);  // 0, 0.5 .. 4 s
  EXPECT_NEAR(read.time_s[8], 0.8, 1e-9);
  const auto magenta = [&](std::size_t frame) {
    int count = 0;
    for (std::size_t i = 0; i < read.rgb[frame].size(); i += 3)
      count += read.rgb[frame][i] > 180 && read.rgb[frame][i + 1] < 90 && read.rgb[frame][i + 2] > 180;
    return count;
  };
  EXPECT_EQ(magenta(3), 0);
  EXPECT_GT(magenta(4), 300);
}

TEST(Film, a_long_film_has_a_key_frame_and_an_index_entry_each_five_seconds) {
  const std::string path = scratch("long.webm");
  auto encoder = sim::make_webm_encoder(path, 64, 48, 2);
  for (int f = 0; f < 100; ++f) encoder->add(square_at(f % 6).data(), 64);
  encoder->finish();
  const Read read = film_test::read_webm(path);
  EXPECT_EQ(read.error, "");
  ASSERT_EQ(read.rgb.size(), 100u);
  EXPECT_NEAR(read.time_s[99], 49.5, 1e-9);  // a cluster's own times end at 32.7 s
  EXPECT_NEAR(read.duration_s, 50, 1e-9);
}

TEST(Film, two_films_of_a_run_are_the_same_to_the_byte) {
  for (const char* ending : {".webm", ".apng"}) {
    std::string first;
    for (int round = 0; round < 2; ++round) {
      const std::string path = scratch(std::string("twin") + ending);
      auto s = cruising(world_of("twinpuck = 1\n[arena]\nsize = [1, 1]\n[[robot]]\n"), 2, 3);
      sim::FilmOptions options;
      options.size_px = 160;
      sim::Film film(path, s->scene(), options);
      film.sample(s->scene(), s->minds());
      for (int i = 0; i < 512; ++i) {
        s->step();
        film.sample(s->scene(), s->minds());
      }
      film.finish();
      if (round == 0) first = text_of(path);
    }
    EXPECT_GT(first.size(), 1000u);
    EXPECT_TRUE(first == text_of(scratch(std::string("twin") + ending))) << ending;
  }
}

TEST(Film, a_full_disk_a_missing_folder_and_a_bad_name_are_said) {
  auto s = cruising(world_of("twinpuck = 1\n[[robot]]\n"), 0, 0);
  for (const char* name : {"full.webm", "full.png"}) {
    const std::string path = scratch(name);
    std::filesystem::remove(path);
    std::filesystem::create_symlink("/dev/full", path);
    sim::Film film(path, s->scene());
    film.sample(s->scene(), s->minds());
    film.finish();
    EXPECT_EQ(film.error(), path + ": cannot be written: No space left on device");
    std::filesystem::remove(path);
  }
  EXPECT_EQ(sim::Film("/nonexistent/a.webm", s->scene()).error(),
            "/nonexistent/a.webm: cannot be written: No such file or directory");
  EXPECT_EQ(sim::Film("a.mp4", s->scene()).error(),
            "a.mp4: film: got the ending '.mp4', expected .webm, .png or .apng");
}

TEST(Trails, hold_the_last_seconds_and_break_where_a_robot_was_put) {
  // 41 mm/s on 2 rad/s; 2 s of it are 82 mm, a point each millimetre or tick's way above it
  auto s = cruising(world_of("twinpuck = 1\n[[robot]]\n"), 2, 2);
  sim::Trails trails(1, sim::from_seconds(2));
  trails.sample(s->scene());
  while (s->now() < sim::from_seconds(10)) {
    s->step();
    trails.sample(s->scene());
  }
  const auto& trail = trails.trail(0);
  EXPECT_NEAR(length(trail.back().at_m - trail.front().at_m), 0.082, 0.003);
  EXPECT_LE(trail.size(), 84u);
  s->move(0, {0, 1, 0});
  s->step();
  trails.sample(s->scene());
  EXPECT_TRUE(trails.trail(0).back().lifted);
}

}  // namespace
