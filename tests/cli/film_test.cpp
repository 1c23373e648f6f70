// SPDX-License-Identifier: MIT
// run --film and --heatmap: what a user gets, and what is said when that cannot be.
#include <algorithm>
#include <sstream>

#include "tests/cli/command.h"
#include "tests/support/film_reader.h"

using namespace cli_test;

namespace {

class FilmOption : public CommandTest {};

TEST_F(FilmOption, has_the_frames_the_size_and_the_same_bytes_whatever_the_threads) {
  const std::string run = "run maze --for 2 -q --rays --film-fps 10 --film-size 320 ";
  ASSERT_EQ(twinpuck(run + "--film " + path("a.webm")).exit_code, 0);
  ASSERT_EQ(twinpuck(run + "--threads 3 --film " + path("b.webm")).exit_code, 0);
  const film_test::Read film = film_test::read_webm(path("a.webm"));
  EXPECT_EQ(film.error, "");
  EXPECT_EQ(film.rgb.size(), 21u);  // 0, 0.1 .. 2 s
  EXPECT_EQ(std::max(film.width_px, film.height_px), 320);
  EXPECT_TRUE(read(path("a.webm")) == read(path("b.webm")));
}

TEST_F(FilmOption, does_not_change_the_run) {
  const auto summary = [&](const std::string& more, const std::string& name) {
    EXPECT_EQ(twinpuck("run maze --for 2 -q --summary " + path(name) + more).exit_code, 0);
    const std::string text = read(path(name));
    return text.substr(text.find("\"digest\""), 30);
  };
  EXPECT_EQ(
      summary("", "a.json"),
      summary(" --rays --film " + path("f.apng") + " --film-size 160 --heatmap " + path("h.svg"), "b.json"));
  EXPECT_EQ(film_test::read_apng(path("f.apng")).rgb.size(), 51u);  // 25 a second
}

TEST_F(FilmOption, heat_maps_are_written_as_picture_and_as_numbers_at_once) {
  const Said s = twinpuck("run maze --for 3 -q --heatmap " + path("h.png") + " --heatmap " + path("h.csv") +
                          " --heatmap-cell 0.05 --heatmap-scale linear");
  ASSERT_EQ(s.exit_code, 0) << s.text;
  EXPECT_EQ(read(path("h.png")).substr(1, 3), "PNG");
  std::istringstream csv(read(path("h.csv")));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "x_m,y_m,time_s,share");
  double time_s = 0, share = 0, x, y, t, p;
  while (std::getline(csv, line)) {
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &x, &y, &t, &p), 4) << line;
    time_s += t;
    share += p;
  }
  EXPECT_NEAR(time_s, 3, 1e-4);  // one robot
  EXPECT_NEAR(share, 1, 1e-6);
}

}  // namespace
