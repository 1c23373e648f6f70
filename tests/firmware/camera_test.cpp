// SPDX-License-Identifier: MIT
// The camera through the library's functions on whole robots: what the buffer holds, when, and what each
// setter sends. Geometry: 640 columns over 0.84 rad, so a pixel of zoom 8 is 8 / 716.54 wide; the lens is 30
// mm ahead of the axle.
#include <algorithm>

#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

// 40 x 40 in colour at zoom 8 from the middle, again and again
const char* const kFilm = R"(
#include <camera/fast_2_timer/e_poxxxx.h>
#include <motor_led/e_init_port.h>
char buffer[3200];
int version, configured, before, during, pictures, orientation;
int main(void) {
  before = e_poxxxx_is_img_ready();
  version = e_poxxxx_init_cam();
  configured = e_poxxxx_config_cam((640 - 320) / 2, (480 - 320) / 2, 320, 320, 8, 8, MODE);
  EXTRA
  e_poxxxx_write_cam_registers();
  orientation = e_poxxxx_get_orientation();
  for (;;) {
    e_poxxxx_launch_capture(buffer);
    during = e_poxxxx_is_img_ready();
    while (!e_poxxxx_is_img_ready());
    pictures++;
  }
}
)";

std::string film(const std::string& mode = "RGB_565_MODE", const std::string& extra = "") {
  std::string text = kFilm;
  text.replace(text.find("MODE)"), 4, mode);
  text.replace(text.find("EXTRA"), 5, extra);
  return text;
}

struct Rgb {
  int r, g, b;  // 5, 6, 5 bits
};

class CameraApi : public FirmwareTest {
 protected:
  void cylinder(double x_m, double y_m, double radius_m, sim::Colour colour, double height_m = 0.3) {
    sim::ObjectDesc o;
    o.kind = sim::ObjectKind::Cylinder;
    o.pose = {x_m, y_m, 0};
    o.radius_m = radius_m;
    o.size_m.z = height_m;
    o.material.colour = colour;
    world.objects.push_back(o);
  }
  static Rgb pixel(const std::vector<std::uint8_t>& bytes, int row, int column, int columns = 40) {
    const std::size_t i = static_cast<std::size_t>(2 * (row * columns + column));
    return {bytes[i] >> 3, (bytes[i] & 7) << 3 | bytes[i + 1] >> 5, bytes[i + 1] & 31};
  }
  static bool is_red(const Rgb& p) { return p.r > 8 && p.g < p.r && p.b < p.r / 2; }
  std::vector<std::uint8_t> picture(Robot& r, std::size_t bytes = 3200) {
    return r.variables<std::uint8_t>("buffer", bytes);
  }
  /// First and last red column of a row; -1 when there is none.
  std::pair<int, int> red_columns(const std::vector<std::uint8_t>& bytes, int row) {
    int first = -1, last = -1;
    for (int c = 0; c < 40; ++c)
      if (is_red(pixel(bytes, row, c))) first = first < 0 ? c : first, last = c;
    return {first, last};
  }
};

// 0.2 m from the lens and 40 mm to the left: the axis at tan = 0.2, 17.91 columns left of 20; radius 20 mm at
// a distance of 0.20396: bearing 11.310 deg, half angle 5.627 deg, tangents 0.0995 and 0.3041: columns 20
// - 27.2 to 20 - 8.91, so all from 0 to 10 (11.09 is the edge)
TEST_F(CameraApi, red_cylinder_on_white_ground_stands_where_it_is) {
  cylinder(0.23, 0.04, 0.020, {1, 0, 0});
  world.floor.colour = {1, 1, 1};
  Robot& r = add_robot_with_source(film());
  r.settings().own["camera"] = "po3030k";
  r.settings().own["camera_noise"] = 0;
  ASSERT_TRUE(run_until([&] { return r.variable("pictures") >= 3; }, 3));
  EXPECT_EQ(r.variable<std::uint16_t>("version"), 0x3030);
  EXPECT_EQ(r.variable("configured"), 0);
  EXPECT_EQ(r.variable("before"), 0);
  EXPECT_EQ(r.variable("during"), 0);
  const auto bytes = picture(r);
  const auto [first, last] = red_columns(bytes, 20);
  EXPECT_EQ(first, 0);
  EXPECT_NEAR(last, 10, 1);
  EXPECT_FALSE(is_red(pixel(bytes, 20, 30)));
  // the floor is white, upright faces get 0.8 of its light: grey floor, pure red
  const Rgb ground = pixel(bytes, 39, 39), red = pixel(bytes, 20, 5);
  EXPECT_NEAR(ground.r, ground.b, 1);
  EXPECT_EQ(red.g, 0);
  EXPECT_EQ(red.b, 0);
  EXPECT_LT(red.r, ground.r);
  expect_no_traps();
}

// 25 mm at 0.2 m straight ahead: half angle asin(0.125), tangent 0.12599, 11.284 columns: 9 to 30
TEST_F(CameraApi, all_three_sensors_see_it_upright_and_as_wide_as_it_is) {
  cylinder(0.23, 0, 0.025, {1, 0, 0}, 0.02);
  const char* const cameras[] = {"po3030k", "po6030k", "po8030d"};
  for (int i = 0; i < 3; ++i) {
    Robot& r = add_robot_with_source(film(), cameras[i]);
    r.settings().own["camera"] = cameras[i];
    // out of one another's sight, all at the same place before their own cylinder
    if (i > 0) cylinder(0.23, 2.0 * i, 0.025, {1, 0, 0}, 0.02);
    r.at(0, 2.0 * i);
  }
  run_for(2.5);
  const unsigned versions[] = {0x3030, 0x6030, 0x8030};
  for (int i = 0; i < 3; ++i) {
    SCOPED_TRACE(cameras[i]);
    EXPECT_EQ(robot(i).variable<std::uint16_t>("version"), versions[i]);
    EXPECT_EQ(robot(i).variable("configured"), 0);
    EXPECT_EQ(robot(i).variable("orientation"), 1);
    ASSERT_GE(robot(i).variable("pictures"), 2);
    const auto bytes = picture(robot(i));
    // PO8030D pictures begin at the array's first line: the horizon is in row 30 instead of 20. The
    // top of the cylinder, 20 mm high, is 8 mm below the lens 0.175 m away: 4.1 rows below the
    // horizon; its foot 14.3
    const int horizon = i == 2 ? 30 : 20;
    const auto [first, last] = red_columns(bytes, horizon + 8);
    EXPECT_NEAR(first, 9, 1);
    EXPECT_NEAR(last, 30, 1);
    EXPECT_FALSE(is_red(pixel(bytes, horizon + 1, 20)));
    EXPECT_TRUE(is_red(pixel(bytes, horizon + 6, 20)));
  }
  expect_no_traps();
}

// mirrors and mounts: a cylinder to the left, 40 mm at 0.2 m, and higher than the lens only from 60 mm on
TEST_F(CameraApi, mirrors_and_mounts_turn_the_picture) {
  struct Case {
    const char* camera;
    const char* mount;
    const char* extra;
    int rotation;  // 0 upright, 2 half a turn, 1 and 3 quarters
    int orientation;
  };
  const Case cases[] = {
      {"po3030k", "upright", "", 0, 1},
      {"po3030k", "upright", "e_poxxxx_set_mirror(1, 1);", 2, 1},
      {"po3030k", "inverted", "", 2, 2},
      {"po3030k", "inverted", "e_poxxxx_set_mirror(1, 1);", 0, 2},
      {"po6030k", "upright", "e_poxxxx_set_mirror(1, 1);", 0, 1},
      {"po6030k", "upright", "e_poxxxx_set_mirror(0, 0);", 2, 1},
      {"po8030d", "upright", "e_poxxxx_set_mirror(1, 1);", 2, 1},
      // a quarter: with both mirrors the lines go from left to right, each from below upwards
      {"po3030k", "sideways", "e_poxxxx_set_mirror(1, 1);", 1, 0},
      {"po3030k", "sideways", "", 3, 0},
  };
  int i = 0;
  for (const Case& c : cases) {
    Robot& r = add_robot_with_source(film("RGB_565_MODE", c.extra), "r" + std::to_string(i));
    r.settings().own["camera"] = c.camera;
    r.settings().own["camera_mount"] = c.mount;
    r.at(0, 2.0 * i);
    sim::ObjectDesc o;  // hovers 10 mm above the lens, on the left
    o.kind = sim::ObjectKind::Box;
    o.pose = {0.23, 2.0 * i + 0.03, 0};
    o.size_m = {0.02, 0.02, 0.2};
    o.z_m = 0.038;
    o.material.colour = {1, 0, 0};
    world.objects.push_back(o);
    ++i;
  }
  run_for(2.5);
  for (i = 0; i < static_cast<int>(std::size(cases)); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(robot(i).variable("orientation"), cases[i].orientation);
    const auto bytes = picture(robot(i));
    // centre of gravity of what is red, from the middle
    double x = 0, y = 0;
    int n = 0;
    for (int row = 0; row < 40; ++row)
      for (int column = 0; column < 40; ++column)
        if (is_red(pixel(bytes, row, column))) x += column - 19.5, y += row - 19.5, ++n;
    ASSERT_GT(n, 20);
    switch (cases[i].rotation) {
      case 0:
        EXPECT_LT(x, 0);
        break;
      case 2:
        EXPECT_GT(x, 0);
        break;
      case 1:  // line number = column of the scene, place in the line = height
        EXPECT_LT(y, 0);
        EXPECT_GT(x, 0);
        break;
      case 3:
        EXPECT_GT(y, 0);
        EXPECT_LT(x, 0);
        break;
    }
    if (cases[i].camera != std::string("po8030d")) {
      if (cases[i].rotation == 0) {
        EXPECT_LT(y, 0);
      }
      if (cases[i].rotation == 2) {
        EXPECT_GT(y, 0);
      }
    }
  }
  expect_no_traps();
}

// by hand, without automatics and noise: white under 1 W/m2 for E lines of 852 pixels at 4 cycles,
// response 1.4 per second. 500 lines: 500 * 852 * 4 / 14745600 = 0.115560 s -> 0.161784 of full scale; of
// 256: 41.417, between the gamma table's 32 (0x42 = 66) and 48 (0x56 = 86): 66 + 20 * 9.417 / 16 = 77.8
// -> 78. In 565: 78 >> 3 = 9, 78 >> 2 = 19: 01001 010011 01001 = 0x4A69
TEST_F(CameraApi, rgb565_has_the_high_byte_first) {
  world.floor.colour = {1, 1, 1};
  Robot& r = add_robot_with_source(
      film("RGB_565_MODE", "e_poxxxx_set_awb_ae(0, 0); e_poxxxx_set_exposure(500L * 64);"));
  r.settings().own["camera"] = "po3030k";
  r.settings().own["camera_noise"] = 0;
  ASSERT_TRUE(run_until([&] { return r.variable("pictures") >= 1; }, 3));
  const auto bytes = picture(r);
  EXPECT_EQ(bytes[3198], 0x4A);
  EXPECT_EQ(bytes[3199], 0x69);
}

// twice the exposure: 0.323568, 82.83 of 256, between 64 (104) and 96 (135): 104 + 31 * 18.83 / 32 = 122.2 ->
// 122; a green gain of a half by hand: 78 as before. Grey: 0.299 * 122 + 0.587 * 78 + 0.114 * 122 = 96.17 ->
// 96
TEST_F(CameraApi, exposure_and_gains_by_hand_are_linear_in_light) {
  world.floor.colour = {1, 1, 1};
  Robot& r = add_robot_with_source(
      film("GREY_SCALE_MODE",
           "e_poxxxx_set_awb_ae(0, 0); e_po3030k_set_color_gain(0x10, 0x40, 0x20, 0x20, 0x40); "
           "e_po3030k_set_speed(0x20); e_poxxxx_set_exposure(998L * 64 + 2L * 64);"));
  r.settings().own["camera"] = "po3030k";
  r.settings().own["camera_noise"] = 0;
  // with the clock of colour, the fast driver takes every byte twice; white ground stays white ground
  ASSERT_TRUE(run_until([&] { return r.variable("pictures") >= 1; }, 3));
  EXPECT_NEAR(picture(r, 1600)[1599], 96, 1);  // 998 lines is the longest integration: 0.2 % less
}

// neutral grey: chroma 128 for both kinds; luma as the grey of the same exposure: 78
TEST_F(CameraApi, yuv_gives_luma_and_chroma_in_turn) {
  world.floor.colour = {1, 1, 1};
  Robot& r =
      add_robot_with_source(film("YUV_MODE", "e_poxxxx_set_awb_ae(0, 0); e_poxxxx_set_exposure(500L * 64);"));
  r.settings().own["camera"] = "po3030k";
  r.settings().own["camera_noise"] = 0;
  ASSERT_TRUE(run_until([&] { return r.variable("pictures") >= 1; }, 3));
  const auto bytes = picture(r);
  EXPECT_EQ(bytes[3198], 78);
  EXPECT_EQ(bytes[3199], 128);
}

// the authors: colour 4.3, 2.6, 1.3 pictures a second at sub-sampling 4, 2, 1; grey 8.6, 4.3, 2.2
TEST_F(CameraApi, frame_rates_are_the_authors) {
  struct Case {
    int zoom;
    const char* mode;
    double per_s, tolerance;
  };
  const Case cases[] = {{8, "RGB_565_MODE", 4.3, 0.05},    {2, "RGB_565_MODE", 2.6, 0.08},
                        {1, "RGB_565_MODE", 1.3, 0.05},    {4, "GREY_SCALE_MODE", 8.6, 0.1},
                        {2, "GREY_SCALE_MODE", 4.3, 0.05}, {1, "GREY_SCALE_MODE", 2.2, 0.4}};
  int i = 0;
  for (const Case& c : cases) {
    std::string text = film(c.mode);
    const std::string zoom = std::to_string(c.zoom), size = std::to_string(40 * c.zoom);
    text.replace(text.find("320, 320, 8, 8"), 14, size + ", " + size + ", " + zoom + ", " + zoom);
    Robot& r = add_robot_with_source(text, "r" + std::to_string(i));
    r.settings().own["camera"] = "po3030k";
    r.at(0, 1.0 * i++);
  }
  run_for(3);
  std::vector<int> first;
  for (int k = 0; k < i; ++k) first.push_back(robot(k).variable("pictures"));
  run_for(20);
  for (int k = 0; k < i; ++k)
    EXPECT_NEAR((robot(k).variable("pictures") - first[static_cast<std::size_t>(k)]) / 20.0, cases[k].per_s,
                cases[k].tolerance + 0.05)
        << k;
  expect_no_traps();
}

TEST_F(CameraApi, rows_arrive_one_by_one_and_a_new_launch_starts_over) {
  Robot& r = add_robot_with_source(R"(
#include <camera/fast_2_timer/e_poxxxx.h>
char buffer[3200], other[3200];
int step, early;
int main(void) {
  int i;
  e_poxxxx_init_cam();
  e_poxxxx_config_cam(160, 80, 320, 320, 8, 8, RGB_565_MODE);
  e_poxxxx_write_cam_registers();
  e_poxxxx_launch_capture(buffer);
  while (!buffer[0] && !buffer[1]);          /* the first line has come */
  early = e_poxxxx_is_img_ready();
  for (i = 0; i < 3200; i++) if (!buffer[i]) { early += 1000; break; }
  e_poxxxx_launch_capture(other);
  while (!e_poxxxx_is_img_ready());
  step = 1;
  while (1);
}
)");
  r.settings().own["camera"] = "po3030k";
  ASSERT_TRUE(run_until([&] { return r.variable("step") == 1; }, 3));
  EXPECT_EQ(r.variable("early"), 1000);
  const auto first = r.variables<std::uint8_t>("buffer", 3200),
             second = r.variables<std::uint8_t>("other", 3200);
  EXPECT_EQ(std::count(first.begin() + 160, first.end(), 0), 3040);  // at most two lines
  EXPECT_LT(std::count(second.begin(), second.end(), 0), 100);
  expect_no_traps();
}

// the demo of 2007: one line of 120 grey pixels, by the names that the fast driver had then
TEST_F(CameraApi, older_names_of_the_fast_driver_take_its_pictures) {
  Robot& r = add_robot_with_source(R"(
#include <camera/fast_2_timer/e_po3030k.h>
#include <motor_led/e_init_port.h>
#include <motor_led/e_epuck_ports.h>
unsigned char before[8], line[120], behind[8];
int pictures, toggled;
int main(void) {
  e_init_port();
  e_po3030k_init_cam();
  e_po3030k_config_cam(ARRAY_WIDTH / 2 - 2, 0, 4, ARRAY_HEIGHT, 4, 4, GREY_SCALE_MODE);
  e_po3030k_set_mirror(1, 1);
  e_po3030k_write_cam_registers();
  for (;;) {
    e_po3030k_launch_capture((char *)line);
    while (!e_po3030k_is_img_ready()) if (LED0) toggled++;
    pictures++;
  }
}
)");
  r.settings().own["camera"] = "po3030k";
  run_for(3);
  EXPECT_GT(r.variable("pictures"), 8);  // 4.3 a second
  EXPECT_EQ(r.variable("toggled"), 0) << "the slow driver's LED";
  const auto line = r.variables<std::uint8_t>("line", 120);
  EXPECT_LT(std::count(line.begin(), line.end(), 0), 5);
  for (const char* beside : {"before", "behind"})
    for (const std::uint8_t byte : r.variables<std::uint8_t>(beside, 8)) EXPECT_EQ(byte, 0) << beside;
  expect_no_traps();
}

TEST_F(CameraApi, a_reset_robot_starts_over_and_a_robot_without_camera_gets_nothing) {
  Robot& r = add_robot_with_source(R"(
#include <p30F6014A.h>
#include <camera/fast_2_timer/e_poxxxx.h>
char buffer[3200];
int done, version, configured, orientation;
int main(void) {
  if (RCONbits.POR) { RCONbits.POR = 0; e_poxxxx_init_cam();
    e_poxxxx_config_cam(160, 80, 320, 320, 8, 8, RGB_565_MODE);
    e_poxxxx_write_cam_registers(); e_poxxxx_launch_capture(buffer);
    while (!buffer[0] && !buffer[1]);
    asm("reset");
  }
  version = e_poxxxx_is_img_ready();
  e_poxxxx_init_cam();
  e_poxxxx_config_cam(160, 80, 320, 320, 8, 8, RGB_565_MODE);
  e_poxxxx_write_cam_registers();
  e_poxxxx_launch_capture(buffer);
  while (!e_poxxxx_is_img_ready());
  done = 1;
  while (1);
}
)",
                                   "resets");
  Robot& blind = add_robot_with_source(film(), "blind");
  blind.at(0, 1);
  blind.settings().own["camera"] = "none";
  run_for(3);
  EXPECT_EQ(r.variable("done"), 1);
  EXPECT_EQ(r.variable("version"), 0);
  EXPECT_EQ(blind.variable<std::uint16_t>("version"), 0xFFFF);
  EXPECT_EQ(blind.variable("configured"), 11);
  EXPECT_EQ(blind.variable("orientation"), -1);
  EXPECT_EQ(blind.variable("pictures"), 0);
  expect_no_traps();
}

// config_cam's checks [lib]: zoom, window, multiples, a line of at most 329 bytes
TEST_F(CameraApi, wrong_requests_are_refused_as_the_library_does) {
  const char* const text = R"(
#include <camera/fast_2_timer/e_poxxxx.h>
#include <camera/fast_2_timer/e_po8030d.h>
int answer[12], done;
int main(void) {
  e_poxxxx_init_cam();
  answer[0] = e_poxxxx_config_cam(0, 0, 320, 320, 0, 8, RGB_565_MODE);
  answer[1] = e_poxxxx_config_cam(321, 0, 320, 320, 8, 8, RGB_565_MODE);
  answer[2] = e_poxxxx_config_cam(160, 161, 320, 320, 8, 8, RGB_565_MODE);
  answer[3] = e_poxxxx_config_cam(160, 80, 321, 320, 8, 8, RGB_565_MODE);
  answer[4] = e_poxxxx_config_cam(160, 80, 320, 321, 8, 8, RGB_565_MODE);
  answer[5] = e_poxxxx_config_cam(0, 0, 640, 480, 8, 8, RGB_565_MODE);       /* 80 * 2 * 2 + 1 = 321 fits */
  answer[6] = e_poxxxx_config_cam(160, 80, 320, 320, 2, 2, RGB_565_MODE);    /* 160 * 2 + 1 fits */
  answer[7] = e_poxxxx_config_cam(4, 80, 632, 320, 1, 1, RGB_565_MODE);      /* does not */
  answer[8] = e_poxxxx_config_cam(160, 80, 320, 320, 8, 8, 7);               /* mode */
  answer[9] = e_poxxxx_apply_timer_config(1, 329, 1, 0, 0);
  answer[10] = e_poxxxx_apply_timer_config(1, 330, 1, 0, 0);
  answer[11] = e_poxxxx_config_cam(160, 80, 320, 320, 8, 8, RGB_565_MODE);
  done = 1;
  while (1);
}
)";
  const char* const cameras[] = {"po3030k", "po6030k", "po8030d"};
  for (int i = 0; i < 3; ++i) {
    Robot& r = add_robot_with_source(text, cameras[i]);
    r.settings().own["camera"] = cameras[i];
    r.at(0, i);
  }
  run_for(2);
  using List = std::vector<std::int16_t>;
  EXPECT_EQ(robot(0).variables("answer", 12), (List{-1, -1, -1, -1, -1, 0, 0, -1, -1, 0, -1, 0}));
  // the PO6030K's check of columns allows 64 more; then the mask is too long for it as well
  EXPECT_EQ(robot(1).variables("answer", 12), (List{-1, 0, -1, -1, -1, 0, 0, -1, -1, 0, -1, 0}));
  // PO8030D: its own numbers; at the left edge 0 - 4 is 65532 / 4 + 1 in 16 bits, beyond the window's end
  EXPECT_EQ(robot(2).variables("answer", 12), (List{1, 2, 3, 4, 5, 6, 0, 10, 9, 0, -1, 0}));
  expect_no_traps();
}

// 4.3 pictures a second of 40 lines of 160 bytes, taken or skipped, at 8 cycles, and 26 for the
// interrupt: 1.5 %
TEST_F(CameraApi, a_capture_takes_its_time_from_the_program) {
  // counts rounds, without and with captures running
  for (const char* filming : {"0", "1"}) {
    Robot& r = add_robot_with_source(std::string("volatile int filming = ") + filming + R"(;
#include <camera/fast_2_timer/e_poxxxx.h>
char buffer[3200];
long rounds;
int main(void) {
  e_poxxxx_init_cam();
  e_poxxxx_config_cam(160, 80, 320, 320, 8, 8, RGB_565_MODE);
  e_poxxxx_write_cam_registers();
  e_poxxxx_launch_capture(buffer);
  while (!e_poxxxx_is_img_ready());
  for (;;) {
    rounds++;
    if (e_poxxxx_is_img_ready() & filming) e_poxxxx_launch_capture(buffer);
  }
}
)",
                                     std::string("filming") + filming);
    r.settings().own["camera"] = "po3030k";
    r.at(0, *filming - '0');
  }
  run_for(1.5);
  double rounds[2] = {};
  for (int i = 0; i < 2; ++i) rounds[i] = -robot(i).variable<std::int32_t>("rounds");
  run_for(4);
  for (int i = 0; i < 2; ++i) rounds[i] += robot(i).variable<std::int32_t>("rounds");
  EXPECT_NEAR(1 - rounds[1] / rounds[0], 0.015, 0.01) << rounds[0] << ' ' << rounds[1];
}

}  // namespace
