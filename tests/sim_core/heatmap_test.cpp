// SPDX-License-Identifier: MIT
// Heat maps: which cell a robot's time counts for, in numbers and in colours.
#include "sim_core/record/heatmap.h"
#include "tests/sim_core/fixture.h"

using namespace sim_test;

namespace {

// at 128 Hz a tick is 1/128 s
const char* kTwo =
    "twinpuck = 1\n[world]\nphysics_hz = 128\n[[robot]]\nname = \"a\"\nposition = [0.25, -0.15]\n"
    "[[robot]]\nname = \"b\"\nposition = [0.75, 0.35]\n";

TEST(Heatmap, each_tick_counts_for_the_cell_under_the_middle) {
  auto s = cruising(world_of(kTwo), 0, 0);
  sim::Heatmap heat(2, 0.1);
  for (int i = 0; i < 32; ++i) {
    s->step();
    heat.sample(s->scene());
  }
  // b is put beside a for another 32 ticks
  s->move(1, {0.38, -0.11, 0});
  for (int i = 0; i < 32; ++i) {
    s->step();
    heat.sample(s->scene());
  }
  EXPECT_EQ(heat.total_ticks(), 128);  // two robots, 64 ticks each
  const auto cells = heat.cells();
  ASSERT_EQ(cells.size(), 3u);
  // a: x 0.2 to 0.3, y -0.2 to -0.1, all its 64 ticks; then b's second place, then its first, north of both
  EXPECT_EQ(std::make_tuple(cells[0].column, cells[0].row, cells[0].ticks), std::make_tuple(2, -2, 64));
  EXPECT_EQ(std::make_tuple(cells[1].column, cells[1].row, cells[1].ticks), std::make_tuple(3, -2, 32));
  EXPECT_EQ(std::make_tuple(cells[2].column, cells[2].row, cells[2].ticks), std::make_tuple(7, 3, 32));

  const std::string csv = scratch("heat.csv");
  ASSERT_EQ(sim::write_heatmap(csv, heat, s->scene()), "");
  // 64 ticks of 1/128 s are half a second, half of what both robots have; 32 are a quarter
  EXPECT_EQ(text_of(csv),
            "x_m,y_m,time_s,share\n"
            "0.25,-0.15,0.500000,0.500000000\n"
            "0.35,-0.15,0.250000,0.250000000\n"
            "0.75,0.35,0.250000,0.250000000\n");
}

TEST(Heatmap, a_robot_that_drives_leaves_equal_times_in_equal_cells) {
  // 2 rad/s on both wheels of 20.5 mm: 41 mm/s, so each full cell of 2 cm takes 0.488 s,
  // 62.4 ticks of 1/128 s
  auto s = cruising(world_of("twinpuck = 1\n[world]\nphysics_hz = 128\n[[robot]]\nposition = [0.01, 0.01]\n"),
                    2, 2);
  sim::Heatmap heat(1, 0.02);
  for (int i = 0; i < 384; ++i) {
    s->step();
    heat.sample(s->scene());
  }
  const auto cells = heat.cells();
  // 3 s are 12.3 cm: from 1 cm to 13.3 cm, so in cells 0 to 6
  ASSERT_EQ(cells.size(), 7u);
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(cells[static_cast<std::size_t>(i)].column, i);
    EXPECT_EQ(cells[static_cast<std::size_t>(i)].row, 0);
  }
  for (int i = 1; i < 6; ++i)
    EXPECT_NEAR(static_cast<double>(cells[static_cast<std::size_t>(i)].ticks), 62.4, 3);
}

TEST(Heatmap, colours_go_from_dark_to_light_and_the_ends_are_those_of_viridis) {
  const auto luma = [](const sim::Colour& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; };
  for (int i = 0; i < 100; ++i)
    EXPECT_LT(luma(sim::heat_colour(i / 100.0)), luma(sim::heat_colour((i + 1) / 100.0)));
  // #440154 and #fde725; beyond the ends the ends
  EXPECT_NEAR(sim::heat_colour(-1).b, 0x54 / 255.0, 1e-9);
  EXPECT_NEAR(sim::heat_colour(2).r, 0xfd / 255.0, 1e-9);
}

TEST(Heatmap, pictures_are_written_even_when_nobody_was_anywhere) {
  auto s = cruising(world_of("twinpuck = 1\n"), 0, 0);
  sim::Heatmap heat(0, 0.02);
  for (const char* name : {"heat.png", "heat.svg"}) {
    EXPECT_EQ(sim::write_heatmap(scratch(name), heat, s->scene()), "");
    EXPECT_GT(text_of(scratch(name)).size(), 1000u);
  }
  EXPECT_EQ(sim::write_heatmap("a.gif", heat, s->scene()),
            "a.gif: heat map: got the ending '.gif', expected .png, .svg or .csv");
  EXPECT_EQ(sim::write_heatmap("/nonexistent/a.csv", heat, s->scene()),
            "/nonexistent/a.csv: cannot be written: No such file or directory");
}

}  // namespace
