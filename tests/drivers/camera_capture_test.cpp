// SPDX-License-Identifier: MIT
// The bytes that the library's camera drivers take, beside the same bytes asked of the camera by name.
#include "hal_sim/drivers/camera_capture.h"

#include <gtest/gtest.h>

#include "hal_sim/board/board.h"
#include "tests/board/flat_scene.h"

namespace {

using board::Cycle;
using drivers::CameraCapture;

struct Robot {
  Robot() : board(setup()), capture(board.camera()) { board.look_at(&scene); }
  static board::Setup setup() {
    board::Setup s;
    s.camera_noise = 0;
    return s;
  }
  /// What the camera puts out on line `row` at these places.
  std::vector<std::uint8_t> by_name(std::vector<int> bytes, int row, int row_step, Cycle& at) {
    board::Camera& camera = *board.camera();
    const Cycle vsync = camera.await_frame(0);
    board::Camera::Cut cut;
    cut.columns = static_cast<int>(bytes.size());
    cut.rows = row + 1;
    cut.row_step = row_step;
    cut.bytes = bytes;
    camera.begin_frame(cut, vsync);
    at = camera.line_at(row);
    std::vector<std::uint8_t> line(bytes.size());
    camera.put_line(row, line.data(), at);
    return line;
  }

  // every pixel and line another light
  sim::Scene scene = [] {
    sim::Scene s;
    s.light = [](double u, double v, sim::Clicks) {
      const auto light = static_cast<float>(1 + u + 0.5 * v);
      return sim::Light{light, 0.5F * light, 0.25F * light};
    };
    return s;
  }();
  board::Board board;
  CameraCapture capture;
};

TEST(CameraCapture, the_fast_driver_takes_a_byte_every_eight_cycles_from_the_seventeenth_on) {
  Robot robot, other;
  const int half = robot.board.camera()->setup_at(0).byte_half_cycles;
  CameraCapture::Request request;
  request.rows = 2;
  request.columns = 3;
  request.skipped_pixels = 1;
  request.skipped_lines = 3;
  const Cycle vsync = robot.capture.launch(request, 0);
  std::uint8_t line[4] = {1, 2, 3, 4};
  EXPECT_EQ(robot.capture.take_line(line, 4, vsync), 0);  // the frame has not begun
  const Cycle first = robot.capture.begin_frame(vsync);
  EXPECT_EQ(robot.capture.take_line(line, 4, first), 3);
  const Cycle second = robot.capture.next_line();
  EXPECT_EQ(robot.capture.take_line(line, 4, second), 3);
  EXPECT_EQ(robot.capture.take_line(line, 4, second), 0);  // that was the last one
  Cycle at = 0;
  const auto expected =
      other.by_name({2 * 17 / half, 2 * (17 + 2 * 8) / half, 2 * (17 + 4 * 8) / half}, 1, 4, at);
  EXPECT_EQ(second, at);
  EXPECT_EQ(std::vector<std::uint8_t>(line, line + 3), expected);
  EXPECT_NE(expected[0], expected[2]);
  EXPECT_EQ(line[3], 4);
}

TEST(CameraCapture, a_short_buffer_gets_what_it_holds_and_a_reset_ends_the_picture) {
  Robot robot;
  CameraCapture::Request request;
  request.rows = 2;
  request.columns = 4;
  const Cycle first = robot.capture.begin_frame(robot.capture.launch(request, 0));
  std::uint8_t line[4] = {9, 9, 9, 9};
  EXPECT_EQ(robot.capture.take_line(line, 2, first), 4);
  EXPECT_EQ(line[2], 9);
  robot.capture.reset();
  EXPECT_EQ(robot.capture.take_line(line, 4, first), 0);
}

}  // namespace
