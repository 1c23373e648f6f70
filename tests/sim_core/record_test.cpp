// SPDX-License-Identifier: MIT
// Recordings and pictures: their form, that they agree with the simulation, and what happens
// when a disk is full.
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "sim_core/record/csv_recorder.h"
#include "sim_core/record/picture.h"
#include "tests/sim_core/fixture.h"
#include "twinpuck_paths.h"

using namespace sim_test;

namespace {

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(CsvRecorder, rows_have_the_documented_form) {
  const std::string path = scratch("run.csv");
  auto s = cruising(
      world_of("twinpuck = 1\n[[robot]]\nname = \"a\"\n[[robot]]\nname = \"b\"\nposition = [1, 0]\n"), 1, 1);
  {
    sim::CsvRecorder csv(path);
    csv.sample(s->scene(), s->minds());
    while (s->now() < sim::from_seconds(0.1)) {
      s->step();
      csv.sample(s->scene(), s->minds());
    }
    EXPECT_TRUE(csv.flush()) << csv.error();
  }
  const auto lines = lines_of(path);
  ASSERT_EQ(lines.size(), 1 + 2 * 11u);  // t = 0, 0.01 ... 0.1
  EXPECT_EQ(lines[0],
            "time_s,robot,x_m,y_m,heading_rad,left_steps,right_steps,ir0,ir1,ir2,ir3,ir4,ir5,ir6,ir7,leds");
  EXPECT_EQ(lines[1], "0.000000,a,0.000000,0.000000,0.000000,0,0,0,0,0,0,0,0,0,0,000");
  EXPECT_EQ(lines[2], "0.000000,b,1.000000,0.000000,0.000000,0,0,0,0,0,0,0,0,0,0,000");
  for (const auto& line : lines) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 15);
  double t = 0, x = 0;
  ASSERT_EQ(std::sscanf(lines.back().c_str(), "%lf,b,%lf", &t, &x), 2);
  EXPECT_NEAR(x, s->pose(1).x_m, 1e-6);
}

TEST(CsvRecorder, at_most_64_kilobytes_wait_for_the_disk) {
  const std::string path = scratch("long.csv");
  auto s = cruising(world_of("twinpuck = 1\n[[robot]]\n"), 1, 1);
  sim::CsvRecorder csv(path);
  std::size_t rows = 0;
  const auto wait = [&] {  // bytes that are not there yet, of rows of at least 60 bytes each
    return static_cast<std::ptrdiff_t>(60 * rows) -
           static_cast<std::ptrdiff_t>(std::filesystem::file_size(path));
  };
  while (s->now() < sim::from_seconds(30)) {
    s->step();
    csv.sample(s->scene(), s->minds());
    rows = static_cast<std::size_t>(sim::to_seconds(s->now()) / 0.01);
    ASSERT_LE(wait(), 65536);
  }
  EXPECT_GT(std::filesystem::file_size(path), 2 * 65536u);
  const auto written = lines_of(path);
  EXPECT_EQ(std::count(written.back().begin(), written.back().end(), ','), 15) << "whole lines alone";
  EXPECT_TRUE(csv.flush());
  EXPECT_EQ(lines_of(path).size(), 1 + 3001u);
}

TEST(CsvRecorder, a_full_disk_and_a_missing_folder_are_said_once) {
  auto s = cruising(world_of("twinpuck = 1\n[[robot]]\n"), 1, 1);
  sim::CsvRecorder full("/dev/full");
  for (int i = 0; i < 3000; ++i) {
    s->step();
    full.sample(s->scene(), s->minds());
  }
  EXPECT_FALSE(full.flush());
  EXPECT_EQ(full.error(), "/dev/full: cannot be written: No space left on device");
  sim::CsvRecorder missing("/nonexistent/run.csv");
  EXPECT_FALSE(missing.is_good());
  EXPECT_EQ(missing.error(), "/nonexistent/run.csv: cannot be written: No such file or directory");
}

TEST(Picture, is_written_for_every_world) {
  for (const char* name : {"maze", "arena", "empty", "corridor", "wall", "u_obstacle", "u_obstacle_black",
                           "lamp", "push", "swarm"}) {
    const auto loaded =
        sim::load_world(std::string(TWINPUCK_SOURCE_DIR "/worlds/") + name + ".toml", {puck()});
    ASSERT_TRUE(loaded.world) << loaded.report(name);
    auto s = simulation_of(*loaded.world, [](int r) { return std::make_unique<Braitenberg>(r); });
    sim::Trajectories ways(s->robots());
    ways.sample(s->scene());
    while (s->now() < sim::from_seconds(20)) {
      s->step();
      ways.sample(s->scene());
    }
    sim::PictureOptions options;
    options.sensor_rays = true;
    for (const char* ending : {".png", ".svg"}) {
      const std::string path = scratch(std::string(name) + ending);
      EXPECT_EQ(sim::write_picture(path, s->scene(), s->minds(), &ways, options), "");
      struct stat st {};
      EXPECT_EQ(::stat(path.c_str(), &st), 0);
      EXPECT_GT(st.st_size, 2000) << path;
    }
  }
}

TEST(Picture, trajectories_agree_with_the_distance) {
  auto s = cruising(world_of("twinpuck = 1\n[[robot]]\n"), 2, 3);
  sim::Trajectories ways(1);
  ways.sample(s->scene());
  for (int i = 0; i < 5120; ++i) {
    s->step();
    ways.sample(s->scene());
  }
  double length = 0;
  const auto& points = ways.ways()[0].points_m;
  for (std::size_t i = 1; i < points.size(); ++i) length += sim::length(points[i] - points[i - 1]);
  EXPECT_NEAR(length, s->distance_m(0), 0.005);
}

TEST(Picture, bad_names_are_said) {
  auto s = cruising(world_of("twinpuck = 1\n"), 0, 0);
  EXPECT_EQ(sim::write_picture("a.gif", s->scene(), s->minds(), nullptr),
            "a.gif: picture: got the ending '.gif', expected .png or .svg");
  EXPECT_EQ(sim::write_picture("/nonexistent/a.png", s->scene(), s->minds(), nullptr)
                .rfind("/nonexistent/a.png: cannot be written: ", 0),
            0u);
}

}  // namespace
