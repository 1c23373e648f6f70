// SPDX-License-Identifier: MIT
// Many robots with one image: what each takes, and that it does not matter who runs them.
#include <malloc.h>

#include "tests/chip/chip_fixture.h"

namespace {

using chip_test::ChipTest;

struct ManyRobots : ChipTest {
  using ChipTest::add_robot;
  using ChipTest::digest;
  using ChipTest::options;
  using ChipTest::robot;
  using ChipTest::run_for;
  using ChipTest::runner;
  void TestBody() override {}
  void add(int robots) {
    options.hal = "dspic";
    for (int i = 0; i < robots; ++i)
      add_robot("bench_braitenberg", "r" + std::to_string(i)).at(0.3 * (i % 40), 0.3 * (i / 40));  // NOLINT
  }
};

const char* const kPrograms[] = {"obstacle",     "braitenberg", "follow_wall",
                                 "sound_locate", "tilt",        "soccer_player"};

std::size_t bytes_in_use() {
  const auto all = mallinfo2();
  return all.uordblks + all.hblkhd;
}

// RAM, the chip, board and place in the world, and the fixture's 4 KB; nothing of the image's
TEST(ManyRobots, a_robot_takes_its_RAM_and_not_much_more) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "memory is the sanitizer's";
#endif
  constexpr int kFew = 10, kMany = 1010;
  std::size_t bytes[2];
  for (const bool many : {false, true}) {
    ManyRobots run;
    run.add(many ? kMany : kFew);
    const std::size_t before = bytes_in_use();
    run.run_for(0.05);
    bytes[many] = bytes_in_use() - before;
    EXPECT_GT(run.runner(many ? kMany - 1 : 0).processor().now(), 0);
  }
  const std::size_t each = (bytes[1] - bytes[0]) / (kMany - kFew);
  EXPECT_LT(each, 40'000u);
  EXPECT_GT(each, 8192u);
  ::testing::Test::RecordProperty("bytes_a_robot", static_cast<int>(each));
}

// either HAL; with the simulator's drivers each robot runs another program, and all of them share what was
// found of the library
TEST(ManyRobots, threads_do_not_matter) {
  for (const char* hal : {"sim", "dspic"}) {
    SCOPED_TRACE(hal);
    std::vector<std::uint64_t> digests;
    for (int threads = 1; threads <= 4; ++threads) {
      ManyRobots run;
      run.options.hal = hal;
      run.options.threads = threads;
      for (int i = 0; i < 12; ++i)
        run.add_robot(kPrograms[i % 6], "r" + std::to_string(i)).at(0.2 * (i % 4), 0.2 * (i / 4));  // NOLINT
      run.run_for(0.5);
      EXPECT_GT(run.robot(0).distance_m(), 0.005);
      digests.push_back(run.digest());
    }
    EXPECT_EQ(digests, std::vector<std::uint64_t>(4, digests[0]));
  }
}

}  // namespace
