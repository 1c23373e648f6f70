// SPDX-License-Identifier: MIT
// A robot's course does not depend on where its windows end: ten robots with controllers of all kinds, under
// either HAL, on a floor that stands still meanwhile.
#include <algorithm>
#include <functional>

#include "hal_sim/chip/chip_runner.h"
#include "tests/chip/hal_flight.h"

namespace {

using board::Cycle;

const char* const kControllers[] = {"obstacle",     "braitenberg", "follow_wall", "square",        "tilt",
                                    "sound_locate", "asercom",     "line_follow", "soccer_player", "blink"};
constexpr int kRobots = 10;

/// What a robot has come to at an instant.
struct Look {
  Cycle now = 0, idle = 0;
  std::uint64_t hash = 0, ram = 0;
  unsigned pc = 0;
  bool operator==(const Look& o) const {
    return now == o.now && idle == o.idle && hash == o.hash && ram == o.ram && pc == o.pc;
  }
};
std::ostream& operator<<(std::ostream& out, const Look& look) {
  return out << "now " << look.now << " idle " << look.idle << " hash " << look.hash << " ram " << look.ram
             << " pc " << look.pc;
}

Look look_at(chip::ChipRunner& runner) {
  const dspic::Processor& cpu = runner.processor();
  Look look{cpu.now(), runner.idle_cycles(), runner.hash(), 0, cpu.pc()};
  for (unsigned at = dspic::Processor::kRamStart; at < dspic::Processor::kRamStart + 0x2000; ++at)
    look.ram = look.ram * 31 + cpu.ram(at);
  return look;
}

using Course = std::vector<std::vector<Look>>;

/// `cut`: the next window's length. Looks stand at instants that do not depend on it.
Course course_of(const std::string& hal, Cycle length, int robots, const std::function<Cycle()>& cut) {
  const std::string file = std::string(TWINPUCK_SOURCE_DIR) + "/bench/worlds/brait_10.toml";
  sim::LoadedWorld loaded = twin::load_world(file);
  EXPECT_TRUE(loaded.world) << loaded.report(file);
  Course course;
  if (!loaded.world) return course;
  for (int i = 0; i < kRobots; ++i)
    loaded.world->robots[static_cast<std::size_t>(i)].firmware = kControllers[i];
  twin::Options options;
  options.hal = hal;
  std::vector<std::string> problems;
  const auto twin = twin::Twin::open(*loaded.world, options, problems);
  for (const std::string& p : problems) ADD_FAILURE() << p;
  if (!twin) return course;
  for (int tick = 0; tick < 60; ++tick) twin->simulation().step();
  constexpr Cycle kLookEvery = 14'741;
  for (int i = 0; i < robots; ++i) {
    auto& runner = dynamic_cast<chip::ChipRunner&>(*twin->mind(i).runner());
    course.emplace_back();
    Cycle at = runner.cycles();
    const Cycle end = at + length;
    for (Cycle look = at + kLookEvery; look <= end; look += kLookEvery) {
      while (at < look) {
        const Cycle to = std::min(look, at + cut());
        runner.begin_window(at);
        runner.run_until(to);
        at = to;
      }
      course.back().push_back(look_at(runner));
    }
  }
  return course;
}

void expect_same(const Course& whole, const Course& other, const std::string& how) {
  for (std::size_t robot = 0; robot < other.size(); ++robot)
    for (std::size_t i = 0; i < other[robot].size(); ++i)
      ASSERT_EQ(other[robot][i], whole[robot][i])
          << how << ", " << kControllers[robot] << ", look " << i << " of " << other[robot].size();
}

class HalWindows : public ::testing::TestWithParam<const char*> {};

TEST_P(HalWindows, do_not_matter_to_ten_robots) {
  constexpr Cycle kSecond = board::kFcyHz, kLong = kSecond / 5, kShort = 60'000;
  const Course whole = course_of(GetParam(), kLong, kRobots, [] { return kSecond; });
  ASSERT_EQ(whole.size(), std::size_t{kRobots});
  EXPECT_NE(whole[0].front().hash, whole[0].back().hash);
  std::uint64_t state = 7;
  const auto draw = [&](std::uint64_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<Cycle>((state >> 33) % below);
  };
  expect_same(whole, course_of(GetParam(), kLong, kRobots, [] { return Cycle{28'800}; }), "a tick");
  expect_same(
      whole,
      course_of(GetParam(), kLong, kRobots, [&] { return 1 + draw(draw(2)   ? 90
                                                                  : draw(2) ? 900
                                                                            : 30'000); }),
      "at random");
  expect_same(whole, course_of(GetParam(), kShort, kRobots, [] { return Cycle{1}; }), "one cycle");
}

INSTANTIATE_TEST_SUITE_P(Of, HalWindows, ::testing::Values("sim", "dspic"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
