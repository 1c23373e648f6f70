// SPDX-License-Identifier: MIT
// A robot on the bench: a board in the dark and a firmware, without a world.
#pragma once
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>

#include "hal_sim/board/board.h"
#include "hal_sim/host/compiled_runner.h"
#include "twinpuck_paths.h"

namespace host_test {

inline std::shared_ptr<host::Image> open_image(const std::string& name) {
  std::string error;
  auto image = host::Image::open(std::string(TWINPUCK_BUILD_DIR) + "/tests/images/" + name + ".so", error);
  EXPECT_TRUE(image) << error;
  return image;
}

struct BenchRobot {
  board::Board board;
  host::CompiledRunner robot;

  BenchRobot(std::shared_ptr<host::Image> image, const std::string& name = "r", std::size_t copy = 0)
      : board(board::Setup{}), robot({name, 1, 256 * 1024}, std::move(image), copy, board) {}
  /// Runs in windows of 28,800 cycles (1/512 s), as a world does.
  void run(host::Cycle cycles) {
    const host::Cycle end = robot.cycles() + cycles;
    while (robot.cycles() < end) robot.run_until(std::min(end, robot.cycles() + 28'800));
  }
  std::int64_t variable(const std::string& name) {
    std::int64_t value = 0;
    const auto bytes = robot.read_variable(name, sizeof value);
    EXPECT_EQ(bytes.size(), sizeof value) << name;
    std::memcpy(&value, bytes.data(), std::min(bytes.size(), sizeof value));
    return value;
  }
};

inline constexpr host::Cycle kSecond = 14'745'600;

}  // namespace host_test
