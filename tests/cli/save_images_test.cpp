// SPDX-License-Identifier: MIT
// run --save-images: one PNG for each picture that a program got, pixels as its bytes say.
#include "outputs/saved_images.h"
#include "tests/cli/command.h"

using namespace cli_test;

namespace {

class SaveImages : public CommandTest {};

TEST_F(SaveImages, every_picture_of_every_filming_robot_is_a_file) {
  const Said s = twinpuck("run red_ball --for 3 -q --save-images " + path("images"));
  ASSERT_EQ(s.exit_code, 0) << s.text;
  int files = 0;
  for (const auto& entry : fs::directory_iterator(path("images"))) {
    const std::string name = entry.path().filename();
    EXPECT_EQ(name.substr(0, 5), "puck_") << name;  // the idler has no program
    ++files;
  }
  // the camera is set up after 0.1 s; then 4.3 to 5.1 pictures a second
  EXPECT_GE(files, 10);
  EXPECT_LE(files, 15);
  const std::string first = read(path("images/puck_000001.png"));
  EXPECT_EQ(first.substr(1, 3), "PNG");
  // width and height in the header: 39, 24
  EXPECT_EQ(first.substr(16, 8), std::string("\0\0\0\x27\0\0\0\x18", 8));
}

TEST(DecodePicture, widens_565_takes_grey_and_pairs_chroma) {
  board::CameraPicture picture{board::SensorSetup::Format::Rgb565, 2, 1, 1, 0, {0xF8, 0x00, 0x04, 0x1F}};
  // pure red; green 32 of 63 is 130, blue 31 is 255
  EXPECT_EQ(board::decode_picture(picture), (std::vector<std::uint8_t>{255, 0, 0, 0, 130, 255}));
  picture = {board::SensorSetup::Format::Grey, 2, 1, 1, 0, {7, 200}};
  EXPECT_EQ(board::decode_picture(picture), (std::vector<std::uint8_t>{7, 7, 7, 200, 200, 200}));
  // Cb 128, Cr 128 + 0.713 * 100 = 199: red is 100 above the luma
  picture = {board::SensorSetup::Format::Yuv, 2, 1, 1, 0, {100, 128, 50, 199}};
  const std::vector<std::uint8_t> rgb = board::decode_picture(picture);
  EXPECT_NEAR(rgb[0], 200, 1);
  EXPECT_NEAR(rgb[2], 100, 1);
  EXPECT_NEAR(rgb[3], 150, 1);
}

}  // namespace
