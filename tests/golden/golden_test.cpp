// SPDX-License-Identifier: MIT
// Pinned digests: the whole history of a few runs, to the last bit, on any number of threads, at any
// optimisation level, under any sanitizer. A change here is a change of behaviour: say in the commit what
// changed and why, and put the number that the failing test prints.
#include <cstdio>

#include "tests/support/firmware_test.h"

using firmware_test::FirmwareTest;

namespace {

struct Pinned {
  const char* name;
  const char* world;
  double seconds;
  const char* digest;
};

class Golden : public FirmwareTest, public ::testing::WithParamInterface<std::tuple<Pinned, int>> {};

TEST_P(Golden, run_repeats_to_the_last_bit) {
  const auto& [pinned, threads] = GetParam();
  load_world(pinned.world);
  options.threads = threads;
  run_for(pinned.seconds);
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(digest()));
  EXPECT_STREQ(text, pinned.digest) << pinned.world;
  expect_no_traps();
}

INSTANTIATE_TEST_SUITE_P(
    Of, Golden,
    ::testing::Combine(::testing::Values(Pinned{"maze", "worlds/maze.toml", 20, "43d588541b95c132"},
                                         Pinned{"swarm", "worlds/swarm.toml", 5, "69bba9f27f6a1e46"},
                                         Pinned{"push", "worlds/push.toml", 10, "0a12fd8f532fbf0e"},
                                         Pinned{"braitenberg_10", "bench/worlds/brait_10.toml", 5,
                                                "ffa85167ed92f05d"}),
                       ::testing::Values(1, 3)),
    [](const auto& info) {
      return std::string(std::get<0>(info.param).name) + "_threads_" +
             std::to_string(std::get<1>(info.param));
    });

}  // namespace
