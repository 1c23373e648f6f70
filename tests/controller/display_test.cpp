// SPDX-License-Identifier: MIT
// Displays: pixels of the PNG that a program writes.
#include <gtest/gtest.h>
#include <webots/camera.h>
#include <webots/display.h>
#include <webots/robot.h>

#include <unistd.h>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "tests/controller/fake_simulator.h"
#include "tests/controller/picture.h"

using fake::Picture;
using fake::read_picture;

namespace {

/// What a program draws on a display of 12 x 9 pixels, in a folder of its own.
Picture drawn(const std::function<void(WbDeviceTag)>& draw, std::string* output = nullptr,
              std::string* errors = nullptr) {
  char folder[] = "/tmp/controller_testXXXXXX";
  if (!mkdtemp(folder)) return {};
  fake::Simulator sim([&] {
    if (chdir(folder) != 0) exit(9);
    const WbDeviceTag display = wb_robot_get_device("display");
    draw(display);
    wb_display_image_save(display, nullptr, "screen.png");
  });
  fake::World world;
  world.devices = {{1, WB_NODE_DISPLAY, "display", {12, 9}}, {2, WB_NODE_CAMERA, "camera", {2, 1, 1, 0, 0}}};
  sim.welcome(world);
  EXPECT_EQ(sim.wait(), 0);
  if (output) *output = sim.output();
  if (errors) *errors = sim.errors();
  const Picture picture = read_picture(std::string(folder) + "/screen.png");
  EXPECT_EQ(system(("rm -r " + std::string(folder)).c_str()), 0);
  return picture;
}

}  // namespace

TEST(ControllerDisplay, lines_and_rectangles) {
  const Picture p = drawn([](WbDeviceTag d) {
    wb_display_draw_pixel(d, 0, 0);
    wb_display_draw_pixel(d, 12, 0);
    wb_display_draw_line(d, 0, 2, 3, 5);
    wb_display_draw_rectangle(d, 5, 1, 4, 3);
    wb_display_fill_rectangle(d, 9, 6, 100, 100);
    wb_display_fill_rectangle(d, 0, 0, 0, 5);
    wb_display_draw_line(d, -2000000000, 8, 2000000000, 8);
  });
  EXPECT_EQ(p.text(),
            "#...........\n"
            ".....####...\n"
            "#....#..#...\n"
            ".#...####...\n"
            "..#.........\n"
            "...#........\n"
            ".........###\n"
            ".........###\n"
            "############\n");
}

TEST(ControllerDisplay, ovals) {
  const Picture p = drawn([](WbDeviceTag d) {
    wb_display_draw_oval(d, 3, 4, 3, 3);
    wb_display_fill_oval(d, 9, 4, 2, 3);
    wb_display_fill_oval(d, 1000000, 1000000, 5, 5);
    wb_display_draw_oval(d, 3, 4, 0, 0);
  });
  // radius 3: half widths by rows 0 to 3 from the middle: 3, 2.83, 2.24, 0; of 2 by 3: 2, 1.89, 1.49, 0
  EXPECT_EQ(p.text(),
            "............\n"
            "..###....#..\n"
            ".#...#..###.\n"
            "#.....######\n"
            "#..#..######\n"
            "#.....######\n"
            ".#...#..###.\n"
            "..###....#..\n"
            "............\n");
}

TEST(ControllerDisplay, dents_of_a_polygon_are_not_filled) {
  const Picture p = drawn([](WbDeviceTag d) {
    const int x[] = {0, 10, 10, 5, 0}, y[] = {0, 0, 8, 2, 8};
    wb_display_fill_polygon(d, x, y, 5);
    wb_display_draw_polygon(d, x, y, 0);
  });
  EXPECT_EQ(p.text().substr(0, 13), "###########.\n");
  // the edge from (0, 8) to (5, 2) passes row 6 at 1.67
  EXPECT_EQ(p.text().substr(13 * 6, 13), "###.....###.\n") << p.text();
  EXPECT_EQ(p.text().substr(13 * 8, 13), "#.........#.\n");
}

TEST(ControllerDisplay, colours_mix_by_opacity) {
  const Picture p = drawn([](WbDeviceTag d) {
    wb_display_set_color(d, 0xFF8000);
    wb_display_fill_rectangle(d, 0, 0, 12, 9);
    wb_display_set_color(d, 0x0000FF);
    wb_display_set_opacity(d, 0.5);
    wb_display_draw_pixel(d, 1, 0);
    wb_display_set_opacity(d, 0);
    wb_display_draw_pixel(d, 2, 0);
    wb_display_set_opacity(d, 1);
    wb_display_set_alpha(d, 0);
    wb_display_draw_pixel(d, 3, 0);
  });
  ASSERT_EQ(p.width, 12);
  EXPECT_EQ(p.argb[0], 0xFFFF8000u);
  EXPECT_EQ(p.argb[1], 0xFF804080u);  // halves of 255, 128 and 255, rounded
  EXPECT_EQ(p.argb[2], 0xFFFF8000u);
  EXPECT_EQ(p.argb[3], 0x000000FFu);
}

TEST(ControllerDisplay, text_has_a_font) {
  const Picture p = drawn([](WbDeviceTag d) { wb_display_draw_text(d, "T1\nx", 0, 0); });
  EXPECT_EQ(p.text(),
            "#####...#...\n"
            "..#....##...\n"
            "..#...#.#...\n"
            "..#.....#...\n"
            "..#.....#...\n"
            "..#.....#...\n"
            "..#...#####.\n"
            "............\n"
            "............\n");
}

TEST(ControllerDisplay, images_are_made_copied_pasted_saved_and_loaded) {
  std::string output;
  const Picture p = drawn(
      [](WbDeviceTag d) {
        const unsigned char rgb[] = {255, 255, 255, 0, 0, 0}, bgra[] = {0, 0, 255, 255, 0, 255, 0, 0};
        WbImageRef two = wb_display_image_new(d, 2, 1, rgb, WB_IMAGE_RGB);
        WbImageRef red = wb_display_image_new(d, 2, 1, bgra, WB_IMAGE_BGRA);
        wb_display_image_paste(d, two, 10, 0, false);
        wb_display_image_paste(d, two, 11, 1, false);  // half of it is beyond
        wb_display_fill_rectangle(d, 0, 2, 2, 1);
        wb_display_image_paste(d, red, 0, 2, true);  // the second pixel is transparent
        WbImageRef copy = wb_display_image_copy(d, 10, 0, 2, 2);
        wb_display_image_save(d, copy, "copy.png");
        WbImageRef again = wb_display_image_load(d, "copy.png");
        wb_display_image_paste(d, again, 4, 4, false);
        wb_display_image_save(d, copy, "copy.jpg");
        WbImageRef jpeg = wb_display_image_load(d, "copy.jpg");
        printf("%d", jpeg != nullptr);
        wb_display_image_save(d, copy, "no/such/folder.png");
        printf("%d%d", wb_display_image_load(d, "nothing.png") == nullptr,
               wb_display_image_new(d, -1, 5, rgb, WB_IMAGE_RGB) == nullptr);
        for (WbImageRef image : {two, red, copy, again, jpeg}) wb_display_image_delete(d, image);
        wb_display_image_delete(d, nullptr);
      },
      &output);
  EXPECT_EQ(output, "111");
  EXPECT_EQ(p.text(),
            "..........#.\n"
            "...........#\n"
            "+#..........\n"
            "............\n"
            "....#.......\n"
            ".....#......\n"
            "............\n"
            "............\n"
            "............\n");
  EXPECT_EQ(p.argb[24], 0xFFFF0000u);
}

TEST(ControllerDisplay, a_camera_writes_its_picture) {
  std::string output;
  drawn(
      [](WbDeviceTag) {
        const WbDeviceTag camera = wb_robot_get_device("camera");
        wb_camera_enable(camera, 32);
        printf("%d%d", wb_camera_save_image(camera, "seen.png", 100),
               wb_camera_save_image(camera, "seen.jpg", 50));
        FILE* png = fopen("seen.png", "rb");
        FILE* jpeg = fopen("seen.jpg", "rb");
        printf(" %02x %02x", png ? fgetc(png) : 0, jpeg ? fgetc(jpeg) : 0);
        printf(" %d%d", wb_camera_save_image(camera, "seen.gif", 100), access("seen.gif", F_OK));
      },
      &output);
  EXPECT_EQ(output, "00 89 ff -1-1");
}
