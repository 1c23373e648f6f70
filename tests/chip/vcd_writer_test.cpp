// SPDX-License-Identifier: MIT
// Which changes of a signal a VCD file has: those of its window, both ends included.
#include "hal_sim/trace/vcd_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace {

constexpr sim::Clicks kStep = sim::kClicksPerSecond / 100;

/// What follows the head when a line is 1 and 0 in turns, at each 10 ms.
std::string written(const trace::Window& window) {
  const std::string path = ::testing::TempDir() + "vcd_writer_" + std::to_string(getpid());
  trace::Signal line;
  line.group = "pins", line.name = "a";
  trace::VcdWriter vcd(path, {{"puck", {line}}}, window);
  for (int step = 1; step <= 5; ++step) vcd.change(step * kStep, 0, static_cast<std::uint64_t>(step % 2));
  vcd.finish(6 * kStep);
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  unlink(path.c_str());
  return text.substr(text.find("$enddefinitions $end\n") + 21);
}

TEST(VcdWriter, a_window_has_the_changes_of_both_its_ends) {
  trace::Window window;
  window.from = 2 * kStep, window.to = 4 * kStep;
  EXPECT_EQ(written(window), "#20000000\n$dumpvars\n0!\n$end\n#30000000\n1!\n#40000000\n0!\n");
  window.trigger = 0, window.trigger_value = 1;
  EXPECT_EQ(written(window), "#30000000\n$dumpvars\n1!\n$end\n#40000000\n0!\n");
  window.to = INT64_MAX;
  EXPECT_EQ(written(window), "#30000000\n$dumpvars\n1!\n$end\n#40000000\n0!\n#50000000\n1!\n#60000000\n");
}

}  // namespace
