// SPDX-License-Identifier: MIT
// The camera on the board, its world a function of direction: frames in time, light to
// counts, automatics, noise.
#include "hal_sim/board/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hal_sim/board/board.h"
#include "tests/board/flat_scene.h"

namespace {

using board::Camera;
using board::CameraKind;
using board::Cycle;

class CameraBoard : public ::testing::Test {
 protected:
  void make(CameraKind kind, double noise = 0) {
    board::Setup setup;
    setup.camera = kind;
    setup.camera_noise = noise;
    robot_ = std::make_unique<board::Board>(setup);
    robot_->look_at(&scene_);
  }
  Camera& camera() { return *robot_->camera(); }
  void write(int number, int value, Cycle at = 0) {
    board::I2cDevice& sensor = *robot_->i2c().find(0xDC);
    sensor.begin(0xDC, false, at);
    sensor.write(static_cast<std::uint8_t>(number), at);
    sensor.write(static_cast<std::uint8_t>(value), at);
  }
  /// PO3030K as the library's table and config_cam() leave it: 320 x 320 in the middle at sub-sampling 4.
  void configure(int format, int clock) {
    const int registers[][2] = {{0x04, 3},     {0x05, 0x53}, {0x06, 3},     {0x07, 0x53}, {0x08, 1},
                                {0x09, 0x6d},  {0x0a, 0},    {0x0b, 83},    {0xa5, 0},    {0xa6, 83},
                                {0x1d, clock}, {0x20, 0x33}, {0x4e, format}};
    for (const auto& r : registers) write(r[0], r[1]);
  }
  void by_hand(double exposure_lines) {
    const long value = std::lround(exposure_lines * 64);
    write(0xd4, 0x0c);
    write(0xb0, static_cast<int>(value >> 16 & 255));
    write(0xb1, static_cast<int>(value >> 8 & 255));
    write(0xb2, static_cast<int>(value & 255));
  }
  /// Bytes of a whole picture, taken where the library's fast driver takes them; `at` becomes
  /// the cycle of its end.
  std::vector<std::uint8_t> shoot(Cycle& at, int rows = 40, int columns = 40, int bpp = 2, int skip = 1) {
    at = vsync_ = camera().await_frame(at);
    Camera::Cut cut;
    cut.rows = rows;
    cut.row_step = 1 + skip;
    cut.columns = columns;
    for (int column = 0; column < columns; ++column)
      for (int part = 0; part < bpp; ++part)
        cut.bytes.push_back(2 * (17 + 8 * (column * bpp * (1 + skip) + part)) /
                            camera().setup_at(at).byte_half_cycles);
    camera().begin_frame(cut, at);
    std::vector<std::uint8_t> all(static_cast<std::size_t>(rows * columns * bpp));
    for (int row = 0; row < rows; ++row) {
      at = camera().line_at(row);
      lines_.push_back(at);
      camera().put_line(row, all.data() + row * columns * bpp, at);
    }
    return all;
  }
  sim::Scene scene_;
  std::unique_ptr<board::Board> robot_;
  Cycle vsync_ = 0;
  std::vector<Cycle> lines_;
};

sim::Light grey(double light) {
  const float l = static_cast<float>(light);
  return {l, l, l};
}

// colour at a quarter of the clock: a line of 852 pixels is 3408 cycles, a frame 852 lines; of every eighth
// line one is taken, the first four lines after VSYNC
TEST_F(CameraBoard, frames_and_lines_come_at_the_sensors_pace) {
  make(CameraKind::Po3030k);
  configure(0x08, 0x20);
  by_hand(100);
  EXPECT_EQ(camera().frame_cycles(), 852 * 3408);
  Cycle at = 1000;
  shoot(at);
  EXPECT_EQ(vsync_, 852 * 3408);
  EXPECT_EQ(lines_[0], vsync_ + 4 * 3408);
  EXPECT_EQ(lines_[1] - lines_[0], 8 * 3408);
  EXPECT_EQ(lines_[39] - lines_[0], 39 * 8 * 3408);
  // launched right after the last line: the next frame
  shoot(at);
  EXPECT_EQ(vsync_, 2 * 852 * 3408);
  // grey at half the clock
  write(0x1d, 0x00, at);
  EXPECT_EQ(camera().frame_cycles(), 852 * 1704);
  // 1000 lines by hand are cut at 998, which stretch the frame to 1006
  by_hand(1000);
  EXPECT_EQ(camera().frame_cycles(), 1006 * 1704);
}

TEST_F(CameraBoard, po6030k_and_po8030d_have_frames_of_their_own) {
  make(CameraKind::Po6030k);
  write(3, 2);
  write(0x04, 0x9d);  // automatics off
  write(3, 0);
  write(0x91, 0x50);  // half the sensor's clock, a quarter of ours
  EXPECT_EQ(camera().frame_cycles(), 800 * 500 * 4);
  make(CameraKind::Po8030d);
  write(3, 2);
  write(0x04, 0x9d);
  write(3, 0);
  write(0x6a, 0x05);
  EXPECT_EQ(camera().frame_cycles(), 776 * 516 * 16);
}

// pixel (row, column) looks where the window says: column 0 is array column 160 + 2, so (162 - 320) / 716.54
TEST_F(CameraBoard, pixels_look_where_window_and_lens_say) {
  make(CameraKind::Po3030k);
  configure(0x08, 0x20);
  by_hand(500);
  std::vector<std::pair<double, double>> seen;
  scene_.light = [&](double u, double v, sim::Clicks) {
    seen.push_back({u, v});
    return grey(0.5);
  };
  Cycle at = 0;
  shoot(at);
  ASSERT_EQ(seen.size(), 1600u);
  EXPECT_NEAR(seen[0].first, -158 / 716.54, 1e-12);
  EXPECT_NEAR(seen[0].second, 158 / 716.54, 1e-12);
  EXPECT_NEAR(seen[1].first, -150 / 716.54, 1e-12);
  EXPECT_NEAR(seen[1599].first, 154 / 716.54, 1e-12);
  EXPECT_NEAR(seen[1599].second, -154 / 716.54, 1e-12);
}

TEST_F(CameraBoard, lines_are_exposed_one_after_the_other) {
  make(CameraKind::Po3030k);
  configure(0x08, 0x20);
  by_hand(500);
  std::vector<sim::Clicks> when;
  scene_.light = [&](double, double, sim::Clicks at) {
    if (when.empty() || when.back() != at) when.push_back(at);
    return grey(0.5);
  };
  Cycle at = 0;
  shoot(at);
  // bands of four lines
  ASSERT_EQ(when.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(when[i], lines_[4 * i]);
}

// full scale is light * 1.4 * seconds; 998 lines of 3408 cycles are 0.230664 s, so light 1 gives
// 0.32293, 82.67 of 256: between the curve's 64 (104) and 96 (135): 122.1
TEST_F(CameraBoard, light_becomes_counts_through_exposure_gain_and_curve) {
  make(CameraKind::Po3030k);
  configure(0x0c, 0x20);  // grey, so that luma is read; clock of colour
  by_hand(998);
  scene_.light = [](double u, double, sim::Clicks) { return u < 0 ? grey(1) : grey(100); };
  Cycle at = 0;
  // grey at a quarter of the clock: a byte lasts 16 cycles, the driver takes one every 8, so
  // the same pixel twice
  std::vector<std::uint8_t> image = shoot(at, 1, 40, 1, 1);
  EXPECT_EQ(image[0], 122);
  // gain 0x20 doubles twice where 0x10 doubles once: 2 x, 0.64586, 165.3: between 160 (188)
  // and 192 (212): 192.0
  write(0x15, 0x20);
  image = shoot(at, 1, 40, 1, 1);
  EXPECT_NEAR(image[0], 192, 1);
  // contrast 0x4B is a half, brightness 0x81 minus one: 192 / 2 - 1
  write(0x9c, 0x4b);
  write(0x9b, 0x81);
  image = shoot(at, 1, 40, 1, 1);
  EXPECT_NEAR(image[0], 95, 1);
}

TEST_F(CameraBoard, exposure_follows_the_light_until_the_mean_is_at_its_target) {
  make(CameraKind::Po3030k);
  configure(0x0c, 0x00);
  double light = 0.3;
  scene_.light = [&](double, double, sim::Clicks) { return grey(light); };
  Cycle at = 0;
  std::vector<int> means;
  for (int i = 0; i < 12; ++i) means.push_back(shoot(at, 4, 40, 1, 1)[40]);
  // from 0.23 s on: too dark at first, then 0x70 = 112 within 6 % of the light (4 % of the count)
  EXPECT_LT(means[0], 100);
  EXPECT_NEAR(means[11], 112, 5);
  light = 5;
  shoot(at, 4, 40, 1, 1);
  for (int i = 0; i < 12; ++i) means.push_back(shoot(at, 4, 40, 1, 1)[40]);
  EXPECT_NEAR(means.back(), 112, 5);
  // a pause counts: after 40 frames without a picture the first one is right
  light = 0.4;
  at += 60 * camera().frame_cycles();
  EXPECT_NEAR(shoot(at, 4, 40, 1, 1)[40], 112, 5);
  // in the dark it stops at its limit, 998 lines times 8
  light = 1e-6;
  for (int i = 0; i < 20; ++i) shoot(at, 4, 40, 1, 1);
  EXPECT_NEAR(camera().exposure_s(), 8 * 998 * 1704 / 14745600.0, 1e-9);
}

TEST_F(CameraBoard, white_balance_makes_yellowish_light_grey_and_spares_colours) {
  make(CameraKind::Po3030k);
  configure(0x08, 0x20);
  // a fifth of the view is strongly red, the rest white under yellowish light
  scene_.light = [](double u, double, sim::Clicks) {
    return u > 0.25 ? sim::Light{1.0f, 0.05f, 0.05f} : sim::Light{1.0f, 0.9f, 0.75f};
  };
  Cycle at = 0;
  std::vector<std::uint8_t> image;
  for (int i = 0; i < 25; ++i) image = shoot(at, 4, 40, 2, 1);
  const int r = image[0] >> 3, g = (image[0] & 7) << 3 | image[1] >> 5, b = image[1] & 31;
  EXPECT_NEAR(r, b, 1);
  EXPECT_NEAR(2 * r, g, 2);
}

TEST_F(CameraBoard, noise_is_as_large_as_said_and_repeats) {
  make(CameraKind::Po3030k, 1);
  configure(0x0c, 0x00);
  by_hand(998);
  scene_.light = [](double, double, sim::Clicks) { return grey(1); };
  Cycle at = 0;
  const std::vector<std::uint8_t> image = shoot(at, 40, 40, 1, 1);
  double sum = 0, squares = 0;
  for (int value : image) sum += value, squares += double(value) * value;
  const double mean = sum / 1600, deviation = std::sqrt(squares / 1600 - mean * mean);
  // 998 lines of 1704 cycles: 0.16146 of full scale, sigma sqrt(0.004^2 + 0.01^2 * 0.16146) = 0.00567; the
  // curve's slope there is 20 counts per 16 / 256: 1.81 counts a colour; luma of three: * sqrt(0.299^2 +
  // 0.587^2 + 0.114^2) = 0.669, and rounding (0.29)
  EXPECT_NEAR(deviation, std::sqrt(1.81 * 1.81 * 0.4475 + 0.083), 0.15);
  make(CameraKind::Po3030k, 1);
  configure(0x0c, 0x00);
  by_hand(998);
  at = 0;
  EXPECT_EQ(shoot(at, 40, 40, 1, 1), image);
  // the next frame has noise of its own
  EXPECT_NE(shoot(at, 40, 40, 1, 1), image);
}

TEST_F(CameraBoard, every_picture_is_told_with_the_bytes_the_program_got) {
  make(CameraKind::Po3030k, 1);
  configure(0x08, 0x20);
  scene_.light = [](double u, double v, sim::Clicks) {
    return sim::Light{static_cast<float>(u + 0.3), static_cast<float>(v + 0.3), 0.2f};
  };
  std::vector<board::CameraPicture> told;
  camera().on_picture = [&](const board::CameraPicture& picture) { told.push_back(picture); };
  Cycle at = 0;
  const std::vector<std::uint8_t> first = shoot(at), second = shoot(at);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0].bytes, first);
  EXPECT_EQ(told[1].bytes, second);
  EXPECT_EQ(told[1].number, 2);
  EXPECT_EQ(told[1].columns, 40);
  EXPECT_EQ(told[1].at, at);
}

TEST_F(CameraBoard, the_reset_pin_forgets_the_settings_and_bytes_beyond_the_array_are_zero) {
  make(CameraKind::Po3030k);
  configure(0x08, 0x20);
  scene_.light = [](double, double, sim::Clicks) { return grey(1); };
  Cycle at = 0;
  // 100 columns of 8 from 160 on: the array ends after 60
  const std::vector<std::uint8_t> wide = shoot(at, 1, 100, 2, 1);
  EXPECT_NE(wide[2 * 59], 0);
  EXPECT_EQ(wide[2 * 60], 0);
  EXPECT_EQ(camera().setup().sub_sampling, 4);
  robot_->pins().write_bit('C', 13, true, at);
  robot_->pins().write_bit('C', 13, false, at);
  EXPECT_EQ(camera().setup().sub_sampling, 1);
}

TEST_F(CameraBoard, an_idle_camera_leaves_the_state_hash_alone) {
  make(CameraKind::None);
  const std::uint64_t without = robot_->state_hash(1000);
  make(CameraKind::Po3030k);
  EXPECT_EQ(robot_->state_hash(1000), without);
}

}  // namespace
