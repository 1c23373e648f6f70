// SPDX-License-Identifier: MIT
// Same inputs, same bytes: for any number of threads, any order of reading, and from run to run.
#include "sim_core/random/counter_random.h"
#include "tests/sim_core/fixture.h"
#include "twinpuck_paths.h"

using namespace sim_test;

namespace {

sim::WorldDesc bench_world(int robots) {
  const std::string file =
      std::string(TWINPUCK_SOURCE_DIR "/bench/worlds/brait_") + std::to_string(robots) + ".toml";
  const sim::LoadedWorld loaded = sim::load_world(file, {puck()});
  EXPECT_TRUE(loaded.world) << loaded.report(file);
  return *loaded.world;
}

std::uint64_t digest_of(const sim::WorldDesc& world, int threads, double seconds, bool look = false) {
  auto s = simulation_of(
      world, [](int r) { return std::make_unique<Braitenberg>(r); }, threads);
  while (s->now() < sim::from_seconds(seconds)) {
    s->step();
    if (!look) continue;
    for (int r = 0; r < s->robots(); ++r)
      s->minds()[static_cast<std::size_t>(r)]->proximity_counts(s->scene(), r % 8);
  }
  return s->digest();
}

TEST(Determinism, one_two_and_three_threads_give_the_same_digest) {
  for (int robots : {5, 100}) {
    const sim::WorldDesc world = bench_world(robots);
    const std::uint64_t one = digest_of(world, 1, 5);
    EXPECT_EQ(digest_of(world, 2, 5), one);
    EXPECT_EQ(digest_of(world, 3, 5), one);
    EXPECT_EQ(digest_of(world, 1, 5, true), one) << "reading sensors must change nothing";
  }
}

TEST(Determinism, where_a_step_ends_changes_nothing) {
  for (int robots : {1, 5, 10}) {
    const sim::WorldDesc world = bench_world(robots);
    auto s = simulation_of(world, [](int r) { return std::make_unique<Braitenberg>(r); });
    int steps = 0;
    for (; s->now() < 5 * sim::kClicksPerSecond; ++steps) s->advance(5 * sim::kClicksPerSecond);
    EXPECT_EQ(s->digest(), digest_of(world, 1, 5)) << robots;
    EXPECT_EQ(s->now(), 5 * sim::kClicksPerSecond);
    if (robots == 1) {
      EXPECT_LT(steps, 5 * 96 / 2) << "free ways between control steps are passed over";
    }
    auto stepped = simulation_of(world, [](int r) { return std::make_unique<Braitenberg>(r); });
    while (stepped->now() < s->now()) stepped->step();
    for (int r = 0; r < robots; ++r) {
      EXPECT_EQ(stepped->pose(r).x_m, s->pose(r).x_m);
      EXPECT_EQ(stepped->distance_m(r), s->distance_m(r));
      EXPECT_EQ(stepped->touches(r).touch_s, s->touches(r).touch_s);
      const sim::Clicks past = s->now() - 100000;
      EXPECT_EQ(stepped->scene().pose(r, past).heading_rad, s->scene().pose(r, past).heading_rad);
    }
  }
}

TEST(Determinism, a_thousand_robots_run_and_repeat) {
  const sim::WorldDesc world = bench_world(1000);
  EXPECT_EQ(digest_of(world, 1, 2), digest_of(world, 2, 2));
}

TEST(Determinism, seeds_and_poses_change_the_digest) {
  sim::WorldDesc world = bench_world(5);
  const std::uint64_t base = digest_of(world, 1, 1);
  world.robots[0].pose.x_m += 1e-9;
  EXPECT_NE(digest_of(world, 1, 1), base);
}

TEST(Determinism, no_robots_no_trouble) {
  auto s = cruising(world_of("twinpuck = 1\n"), 0, 0);
  run_for(*s, 1);
  EXPECT_EQ(s->now(), sim::kClicksPerSecond);
  EXPECT_EQ(s->robots(), 0);
}

TEST(Determinism, robots_never_enter_walls_or_each_other) {
  auto s = simulation_of(bench_world(100), [](int r) { return std::make_unique<Braitenberg>(r); });
  double deepest = 1;
  for (int round = 0; round < 200; ++round) {
    run_for(*s, 0.1);
    for (int r = 0; r < 100; ++r) {
      const sim::Vec2 at{s->pose(r).x_m, s->pose(r).y_m};
      for (const sim::Placed& p : s->scene().layout().fixed)
        deepest = std::min(deepest, sim::plan_distance_m(at, p) - 0.037);
      for (int o = 0; o < r; ++o) {
        deepest = std::min(deepest, sim::length(at - sim::Vec2{s->pose(o).x_m, s->pose(o).y_m}) - 0.074);
      }
    }
  }
  EXPECT_GT(deepest, -0.0003);
}

TEST(Random, draws_are_pure_and_well_spread) {
  const sim::RandomKey key{7, 3, 64};
  EXPECT_EQ(sim::random_bits(key, 5), sim::random_bits(key, 5));
  EXPECT_NE(sim::random_bits(key, 5), sim::random_bits({7, 4, 64}, 5));
  EXPECT_NE(sim::random_bits(key, 5), sim::random_bits({8, 3, 64}, 5));
  EXPECT_NE(sim::random_bits(key, 5), sim::random_bits({7, 3, 65}, 5));
  double sum = 0, sum2 = 0, mean = 0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double g = sim::random_gaussian(key, static_cast<std::uint64_t>(i));
    sum += g;
    sum2 += g * g;
    mean += sim::random_uniform(key, static_cast<std::uint64_t>(i));
  }
  EXPECT_NEAR(sum / n, 0, 0.01);  // 4.5 standard errors
  EXPECT_NEAR(sum2 / n, 1, 0.02);
  EXPECT_NEAR(mean / n, 0.5, 0.003);
}

TEST(Random, own_sine_and_logarithm_agree_with_the_library) {
  for (int i = -100000; i <= 100000; ++i) {
    const double x = i * 0.0137;
    EXPECT_NEAR(sim::sin_cos(x).s, std::sin(x), 1e-15);
    EXPECT_NEAR(sim::sin_cos(x).c, std::cos(x), 1e-15);
  }
  for (int i = 1; i < 100000; ++i) {
    const double x = i * 1e-5;
    EXPECT_NEAR(sim::natural_log(x), std::log(x), 4e-15);
  }
}

}  // namespace
