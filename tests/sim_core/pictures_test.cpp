// SPDX-License-Identifier: MIT
// Pinned pictures: every shape that is drawn, by place and colour to a pixel, and how many letters. Who changes a picture
// looks at it (the build keeps the files), and puts the number that the failing test prints.
#include <cmath>
#include <fstream>
#include <regex>
#include <set>

#include "sim_core/record/heatmap.h"
#include "sim_core/record/picture.h"
#include "sim_core/record/sensor_picture.h"
#include "sim_core/record/share_plot.h"
#include "tests/sim_core/fixture.h"

using namespace sim_test;

namespace {

/// Of an SVG, without what depends on the PC's fonts: the letters' outlines and widths.
std::string shapes(const std::string& path) {
  static const std::regex number("-?[0-9]+(\\.[0-9]+)?");
  std::ifstream in(path);
  std::uint64_t hash = 0;
  bool is_definition = false;
  for (std::string line; std::getline(in, line);) {
    if (line == "<defs>") is_definition = true;
    if (line == "</defs>") is_definition = false;
    if (is_definition || line.find("surface") != std::string::npos) continue;
    std::string rounded;
    if (line.find("<use ") != std::string::npos) {
      rounded = "letter";
    } else {
      std::size_t at = 0;
      for (std::sregex_iterator it(line.begin(), line.end(), number), end; it != end; ++it) {
        rounded += line.substr(at, static_cast<std::size_t>(it->position()) - at) +
                   std::to_string(std::lround(std::stod(it->str())));
        at = static_cast<std::size_t>(it->position() + it->length());
      }
      rounded += line.substr(at);
    }
    for (const char c : rounded) hash = sim::mix64(hash ^ static_cast<unsigned char>(c));
  }
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

constexpr const char* kFurnished = R"(twinpuck = 1
title = "furnished"
[arena]
size = [2, 1.2]
wall_height = 0.2
wall_thickness = 0.02
colour = [0.7, 0.3, 0.2]
[floor]
colour = [0.9, 0.95, 1]
[[ramp]]
position = [-0.6, 0.3]
size = [0.3, 0.2]
heading = 30
heights = [0, 0.05]
[[wall]]
points = [[0.5, 0.2], [0.5, 0.4], [0.8, 0.4]]
thickness = 0.03
[[box]]
name = "crate"
position = [0.7, -0.3]
heading = 30
size = [0.1, 0.2, 0.3]
movable = true
colour = [0, 1, 0]
[[cylinder]]
position = [0.1, 0.3]
radius = 0.05
[[ball]]
position = [0.2, -0.4]
radius = 0.03
colour = [1, 0.5, 0]
[[polygon]]
points = [[0, 0], [0.1, 0], [0, 0.1]]
position = [-0.8, -0.4]
[[lamp]]
name = "sun"
position = [0.2, 0.5, 0.6]
colour = [1, 1, 0.3]
[[lamp]]
position = [-0.2, 0.5, 0.6]
on = false
[[robot]]
name = "ada"
model = "puck"
position = [-0.3, -0.2]
[[robot]]
name = "bob"
model = "puck"
position = [0.3, 0.1]
heading = 100
)";

struct Furnished : testing::Test {
  Furnished() {
    ways.sample(s->scene());
    heat.sample(s->scene());
    while (s->now() < sim::from_seconds(8)) {
      if (s->now() == sim::from_seconds(4)) {
        s->move(1, {-0.6, -0.3, 1});
        ways.lift_pen(1);
      }
      s->step();
      ways.sample(s->scene());
      heat.sample(s->scene());
      fine.sample(s->scene());
    }
  }
  std::unique_ptr<sim::Simulation> s =
      simulation_of(world_of(kFurnished), [](int r) { return std::make_unique<Braitenberg>(r); });
  sim::Trajectories ways{2};
  sim::Heatmap heat{2, 0.04}, fine{2, 0.015};
};

TEST_F(Furnished, maps_show_all_that_there_is) {
  sim::PictureOptions options;
  EXPECT_EQ(sim::write_picture(scratch("plain.svg"), s->scene(), s->minds(), nullptr, options), "");
  EXPECT_EQ(shapes(scratch("plain.svg")), "bce7bf76a619e614");
  options.sensor_rays = true;
  options.names = false;
  options.caption = "8 s";
  options.width_px = 700;
  options.labels = {{0, "first", 0, 0, 0.1, 0, 0}, {1, "said", 0.1, 0.2, 0.05, 0xff0000, 0.5}};
  EXPECT_EQ(sim::write_picture(scratch("full.svg"), s->scene(), s->minds(), &ways, options), "");
  EXPECT_EQ(shapes(scratch("full.svg")), "d9b5100565b8db80");
}

TEST(Names, of_up_to_40_robots_are_drawn) {
  for (const int count : {1, 40, 41}) {
    std::string text = "twinpuck = 1\n";
    for (int i = 0; i < count; ++i)
      text += "[[robot]]\nposition = [" + std::to_string(0.1 * (i % 8)) + ", " +
              std::to_string(0.1 * (i / 8)) + "]\n";
    auto s = cruising(world_of(text), 0, 0);
    std::string shown[2];
    for (const bool names : {false, true}) {
      sim::PictureOptions options;
      options.names = names;
      EXPECT_EQ(sim::write_picture(scratch("names.svg"), s->scene(), s->minds(), nullptr, options), "");
      shown[names] = shapes(scratch("names.svg"));
    }
    EXPECT_EQ(shown[0] != shown[1], count <= 40) << count;
  }
}

/// Lines of a file.
std::set<std::string> lines_of(const std::string& path) {
  std::ifstream in(path);
  std::set<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.insert(line);
  return lines;
}

/// Where the outlines of the longest line begin that is in one SVG and not in another, a word's letters: in px from the left,
/// in order.
std::vector<double> letters_added(const std::string& with, const std::string& without) {
  static const std::regex begin("M ([-0-9.]+) ");
  const std::set<std::string> others = lines_of(without);
  std::string word;
  for (const std::string& line : lines_of(with))
    if (!others.count(line) && line.size() > word.size()) word = line;
  std::vector<double> found;
  for (std::sregex_iterator it(word.begin(), word.end(), begin), end; it != end; ++it)
    found.push_back(std::stod((*it)[1]));
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Names, stand_on_the_side_where_there_is_room) {
  const auto letters_at = [](const std::string& x) {
    auto s = cruising(
        world_of("twinpuck = 1\n[arena]\nsize = [2, 1]\n[[robot]]\nname = \"explorer\"\nposition = [" + x +
                 ", 0]\n"),
        0, 0);
    for (const bool names : {false, true}) {
      sim::PictureOptions options;
      options.names = names;
      options.width_px = 600;
      EXPECT_EQ(sim::write_picture(scratch(names ? "named.svg" : "nameless.svg"), s->scene(), s->minds(),
                                   nullptr, options),
                "");
    }
    return letters_added(scratch("named.svg"), scratch("nameless.svg"));
  };
  const auto middle = letters_at("0"), right = letters_at("0.9");
  ASSERT_FALSE(middle.empty());
  ASSERT_FALSE(right.empty());
  // 300 px a metre behind a margin of 28 px: robots at 328 and 598 px, whose radius is 11 px, and 6 px beside it
  EXPECT_GT(middle.front(), 328 + 17);
  EXPECT_LT(middle.front(), 328 + 25);
  EXPECT_LT(right.back(), 598 - 17);
  EXPECT_GT(right.back(), 598 - 30);
}

TEST_F(Furnished, heat_maps_have_the_scale_that_was_asked_for) {
  sim::HeatmapOptions options;
  EXPECT_EQ(sim::write_heatmap(scratch("orders.svg"), heat, s->scene(), options), "");
  EXPECT_EQ(shapes(scratch("orders.svg")), "b4cd7384941856b1");
  EXPECT_EQ(sim::write_heatmap(scratch("fine.svg"), fine, s->scene(), options), "");
  EXPECT_EQ(shapes(scratch("fine.svg")), "baaf9803064a2908");
  options.linear = true;
  options.width_px = 500;
  EXPECT_EQ(sim::write_heatmap(scratch("linear.svg"), heat, s->scene(), options), "");
  EXPECT_EQ(shapes(scratch("linear.svg")), "c10df75d0d4cd17b");
}

TEST_F(Furnished, a_sensors_picture_shows_its_rays_and_its_curve) {
  const sim::CurveLine curve{
      "front", {{0, 3000, 2900, 3100}, {0.02, 700, 650, 750}, {0.1, 60, 50, 70}}, {{0.02, 700, 0.1}}};
  sim::SensorPictureOptions options;
  options.title = "ada, sensor 0";
  EXPECT_EQ(sim::write_sensor_picture(scratch("sensor.svg"), s->scene(), 0, s->now(),
                                      sim::explain_proximity(s->scene(), 0, 0, s->now()), curve, options),
            "");
  EXPECT_EQ(shapes(scratch("sensor.svg")), "f28e6fc5c54f340b");
  sim::CurvePlotOptions plot;
  plot.caption = "white";
  EXPECT_EQ(sim::write_curve_plot(scratch("curve.svg"),
                                  {curve, {"back", {{0, 2000, 1900, 2100}, {0.1, 50, 40, 60}}, {}}}, plot),
            "");
  EXPECT_EQ(shapes(scratch("curve.svg")), "6ba7df6bb31d6ce9");
}

TEST(SharePlot, has_a_point_and_its_doubt_for_each_share) {
  EXPECT_EQ(sim::write_share_plot(scratch("shares.svg"),
                                  {"escaped", "noise", {{0, 1, 20}, {0.1, 0.5, 10}, {0.3, 0, 4}}}),
            "");
  EXPECT_EQ(shapes(scratch("shares.svg")), "b7486c155fc115bc");
}

}  // namespace
