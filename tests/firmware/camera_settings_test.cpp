// SPDX-License-Identifier: MIT
// Settings of the three sensors: which register each setter of the library changes, to what, and when the
// sensor learns of it. Expectations are the library's register numbers and formulae, worked out by hand.
#include <algorithm>
#include <map>

#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

class CameraSettings : public FirmwareTest {
 protected:
  /// A register as somebody else on the bus would read it; bank -1: the one selected.
  int read(int number, int bank = -1, int robot = 0) {
    if (bank >= 0) {
      board::I2cDevice& sensor = *twin().mind(robot).board().i2c().find(0xDC);
      const auto at = twin().mind(robot).now();
      sensor.begin(0xDC, false, at);
      sensor.write(3, at);
      sensor.write(static_cast<std::uint8_t>(bank), at);
    }
    return bus_register(robot, 0xDC, number);
  }
  Robot& run_statements(const std::string& header, const std::string& statements, const char* camera,
                        double seconds = 1) {
    Robot& r = add_robot_with_source(
        "#include <p30F6014A.h>\n#include <camera/fast_2_timer/e_poxxxx.h>\n#include <camera/" + header +
        ">\nint done, answer[16];\nint main(void) {\n  e_poxxxx_init_cam();\n" + statements +
        "\n  done = 1;\n  while (1);\n}\n");
    r.settings().own["camera"] = camera;
    run_for(seconds);
    EXPECT_EQ(r.variable("done"), 1);
    expect_no_traps();
    return r;
  }
  void expect(const std::map<int, int>& registers, int bank = -1) {
    for (const auto& [number, value] : registers) EXPECT_EQ(read(number, bank), value) << std::hex << number;
  }
};

const char* const k3030 = "fast_2_timer/e_po3030k.h";

TEST_F(CameraSettings, po3030k_table_reaches_the_sensor_with_write_only) {
  run_statements(k3030, "  e_po3030k_set_ref_exposure(0x55);", "po3030k");
  EXPECT_EQ(read(0xb3), 0x70);
}

TEST_F(CameraSettings, po3030k_sends_its_108_registers_in_45_ms) {
  Robot& r = run_statements(k3030, R"(
  T1CON = 0; PR1 = 0xFFFF; TMR1 = 0; T1CONbits.TCKPS = 2; T1CONbits.TON = 1;
  e_po3030k_write_cam_registers();
  answer[0] = TMR1;
  answer[1] = e_po3030k_sync_register_array(0x15, 0x1c);
  answer[2] = e_po3030k_sync_register_array(0x21, 0x3a);
)",
                            "po3030k");
  // 108 writes of 29 bits of 164 cycles, 64 cycles a count: 8026 counts, and the calls between
  EXPECT_NEAR(r.variables("answer", 1)[0] / 14745600.0 * 64, 0.0375, 0.010);
  EXPECT_EQ(r.variables("answer", 3)[1], 8);
  EXPECT_EQ(r.variables("answer", 3)[2], 0);
  // frame height is sent as frame width, 0x0353
  expect({{0x04, 0x03}, {0x05, 0x53}, {0x06, 0x03}, {0x07, 0x53}, {0x48, 0x60}, {0xd8, 0x80}, {0x9c, 0x96}});
}

TEST_F(CameraSettings, po3030k_light_and_colour) {
  Robot& r = run_statements(k3030, R"(
  unsigned char curve[12] = {9, 8, 7, 6, 5, 4, 3, 2, 1, 1, 1, 1}, v;
  e_po3030k_set_bias(1, 3);
  answer[0] = e_po3030k_set_color_gain(80, 1, 1, 1, 1);
  answer[1] = e_po3030k_set_color_gain(79, 0x41, 0x42, 0x43, 0x44);
  e_po3030k_set_integr_time(0x123456L);
  e_po3030k_set_adc_offset(5);
  e_po3030k_set_sepia(1);
  e_po3030k_set_lens_gain(1, 2, 3);
  e_po3030k_set_edge_prop(0xFF, 7);
  e_po3030k_set_gamma_coef(curve, 1);
  e_po3030k_set_color_matrix(curve);
  e_po3030k_set_cb_cr_gain(0x11, 0x22);
  e_po3030k_set_brigh_contr(0x85, 0x70);
  e_po3030k_set_sepia_tone(0x31, 0x32);
  answer[2] = e_po3030k_set_register(0xd5, 0x77);
  answer[3] = e_po3030k_set_register(0x10, 1);
  answer[4] = e_po3030k_get_register(0x16, &v);
  answer[5] = v;
  answer[6] = e_po3030k_get_register(0x11, &v);
  e_po3030k_write_cam_registers();
)",
                            "po3030k");
  EXPECT_EQ(r.variables("answer", 7), (std::vector<std::int16_t>{-1, 0, 0, -1, 0, 0x41, -1}));
  expect({{0x12, 3}, {0x13, 1}, {0x15, 79}, {0x16, 0x41}, {0x17, 0x42}, {0x18, 0x44}, {0x19, 0x43}});
  // 0x123456 >> 14 = 0x48, >> 6 = 0x48D1: D1, lowest byte lost
  expect({{0x1a, 0x48}, {0x1b, 0xd1}, {0x1c, 0}, {0x3b, 5}, {0x4f, 0x8a}, {0x59, 1}, {0x5a, 2}, {0x5b, 3}});
  // 0x50 + (0xFF & 0x1F) = 0x6F; arrays are pointers of two bytes, so two values arrive
  expect({{0x5c, 0x6f}, {0x5d, 7}, {0x76, 9}, {0x77, 8}, {0x78, 0x2a}, {0xd8, 0xa0}});
  expect({{0x8e, 9}, {0x8f, 8}, {0x90, 0x0d}, {0x97, 0x11}, {0x98, 0x22}, {0x9b, 0x85}, {0x9c, 0x70}});
  expect({{0x9f, 0x31}, {0xa0, 0x32}, {0xd5, 0x77}});
}

TEST_F(CameraSettings, po3030k_automatics_and_flicker) {
  Robot& r = run_statements(k3030, R"(
  e_po3030k_set_ww(5);
  e_po3030k_set_awb_ae_tol(3, 0x14);
  e_po3030k_set_ae_speed(0x21, 6);
  e_po3030k_set_exposure(0x123456L);
  e_po3030k_set_ref_exposure(0x66);
  e_po3030k_set_max_min_exp(0x0102, 0x0304);
  e_po3030k_set_max_min_awb(1, 2, 3, 4, 5, 6);
  answer[0] = e_po3030k_set_weight_win(212, 423, 161, 319);
  answer[1] = e_po3030k_set_weight_win(211, 423, 161, 319);
  answer[2] = e_po3030k_set_weight_win(212, 424, 161, 319);
  answer[3] = e_po3030k_set_weight_win(300, 300, 161, 319);
  e_po3030k_set_awb_ae(0, 1);
  e_po3030k_set_flicker_mode(1);
  e_po3030k_set_flicker_detection(1, 0);
  e_po3030k_set_color_mode(RGB_565_MODE);
  e_po3030k_set_speed(SPEED_64);
  answer[4] = e_po3030k_set_flicker_man_set(50, 60, 1, 2, 1);
  answer[5] = e_po3030k_set_flicker_man_set(50, 60, 1, 4, 1);
  answer[6] = e_po3030k_set_speed(SPEED_128);
  answer[7] = e_po3030k_set_sampling_mode(0x22);
  answer[8] = e_po3030k_set_color_mode(3);
  answer[9] = e_po3030k_set_wx(5, 900);
  answer[10] = e_po3030k_set_wy(10, 9);
  answer[11] = e_po3030k_set_vsync(1, 2, 900);
  answer[12] = e_po3030k_set_wx(0x123, 0x234);
  answer[13] = e_po3030k_set_wy(0x45, 0x156);
  answer[14] = e_po3030k_set_vsync(0x12, 0x134, 0x203);
  e_po3030k_set_mirror(1, 0);
  e_po3030k_write_cam_registers();
)",
                            "po3030k");
  EXPECT_EQ(r.variables("answer", 15),
            (std::vector<std::int16_t>{0, -1, -1, -1, 0, -1, -1, -1, -1, -1, -1, -1, 0, 0, 0}));
  expect({{0xad, 0x5f}, {0xae, 0x34}, {0xaf, 0x61}, {0xb0, 0x12}, {0xb1, 0x34}, {0xb2, 0x56}, {0xb3, 0x66}});
  // the definition swaps the header's names: first the longest
  expect({{0xbb, 1},
          {0xbc, 2},
          {0xbd, 3},
          {0xbe, 4},
          {0xc1, 3},
          {0xc2, 4},
          {0xc3, 1},
          {0xc4, 2},
          {0xc5, 5},
          {0xc6, 6}});
  // 212 + 210 = 0x1A6, 423 + 210 = 0x279, 161 + 7 = 0xA8, 319 + 7 = 0x146
  expect(
      {{0xc7, 1}, {0xc8, 0xa6}, {0xc9, 2}, {0xca, 0x79}, {0xcb, 0}, {0xcc, 0xa8}, {0xcd, 1}, {0xce, 0x46}});
  // 230400 * 2 * 851 = 392140800; / 50 = 7842816 = 0x77AC00, / 60 = 6535680 = 0x63BA00; mode 0x80 -> 0x20 +
  // 0x10 + 8 + 1
  expect({{0xd4, 0x1c}, {0x46, 0x39}, {0x49, 0xac}, {0x4a, 0x00}, {0x4b, 0xba}, {0x4c, 0x00}});
  expect(
      {{0x08, 1}, {0x09, 0x22}, {0x0c, 2}, {0x0d, 0x34}, {0x0a, 0}, {0x0b, 0x45}, {0x0e, 1}, {0x0f, 0x56}});
  expect(
      {{0xa5, 0}, {0xa6, 0x12}, {0xa7, 1}, {0xa8, 0x34}, {0xa9, 2}, {0xaa, 3}, {0x1e, 0x4a}, {0x1d, 0x60}});
}

TEST_F(CameraSettings, po3030k_gamma_alone_and_reading_back) {
  Robot& r = run_statements(k3030, R"(
  unsigned char curve[12] = {3, 30}, v;
  e_po3030k_set_gamma_coef(curve, 2);
  e_po3030k_set_ref_exposure(0x55);
  e_po3030k_write_gamma_coef();
  e_po3030k_read_cam_registers();
  answer[0] = e_po3030k_get_register(0xb3, &v);
  answer[1] = v;
  answer[2] = e_po3030k_get_register(0x77, &v);
  answer[3] = v;
)",
                            "po3030k");
  // the curve went out, the target did not and was read back as the sensor has it
  EXPECT_EQ(r.variables("answer", 4), (std::vector<std::int16_t>{0, 0x70, 0, 30}));
  expect({{0x76, 3}, {0x77, 30}, {0xd8, 0xc0}});
}

TEST_F(CameraSettings, po3030k_window_of_config_cam) {
  run_statements(
      k3030,
      "  e_poxxxx_config_cam(160, 80, 320, 320, 8, 8, GREY_SCALE_MODE); e_poxxxx_write_cam_registers();",
      "po3030k");
  // 160 + 210 - 4 - 1 = 365 = 0x16D, 80 + 7 - 4 = 83; stop at 210 + 640 + 1 = 851, 488; VSYNC
  // 83, 487, column 367
  expect({{0x08, 1}, {0x09, 0x6d}, {0x0a, 0}, {0x0b, 83}, {0x0c, 3}, {0x0d, 0x53}, {0x0e, 1}, {0x0f, 0xe8}});
  expect({{0xa5, 0}, {0xa6, 83}, {0xa7, 1}, {0xa8, 0xe7}, {0xa9, 1}, {0xaa, 0x6f}});
  expect({{0x1d, 0x00}, {0x20, 0x33}, {0x4e, 0x0c}});
}

// 160 + 16 - 4 = 172, 80 + 8 - 4 = 84: columns from 172 / 4 - 1 on, VSYNC 84 to 488
TEST_F(CameraSettings, po6030k_window_of_config_cam) {
  Robot& r = run_statements("fast_2_timer/e_po6030k.h", R"(
  answer[0] = e_po6030k_config_cam(160, 80, 320, 320, 8, 8, GREY_SCALE_MODE);
  e_po6030k_set_bank(BANK_C);
)",
                            "po6030k");
  EXPECT_EQ(r.variables("answer", 1)[0], 0);
  EXPECT_EQ(read(0x03), 2);
  expect({{0x91, 0x10}}, 0);  // PO_6030_SPEED_1
  expect({{0x38, 0x0d}, {0x68, 7}, {0x80, 0x80}, {0x81, 0x80}, {0x82, 1}, {0x50, 0}, {0x51, 42}}, 1);
  expect({{0x60, 0}, {0x61, 84}, {0x62, 1}, {0x63, 0xe8}}, 1);
}

// columns from 400 + 16 - 1 = 415, lines from 300 + 8 - 1 = 307 on; PO_6030_SPEED_8
TEST_F(CameraSettings, po6030k_window_in_colour) {
  run_statements("fast_2_timer/e_po6030k.h", "  e_po6030k_config_cam(400, 300, 40, 30, 1, 1, RGB_565_MODE);",
                 "po6030k");
  expect({{0x91, 0xb0}}, 0);
  expect({{0x38, 0x08}, {0x68, 0}, {0x80, 0x20}, {0x81, 0x20}, {0x50, 1}, {0x51, 0x9e}}, 1);  // 415 - 1
  expect({{0x60, 1}, {0x61, 0x33}, {0x62, 1}, {0x63, 0xe8}}, 1);
}

// x 160 - 4 = 156, y 76: window 156 / 4 + 1 = 40 to 156 + 80 - 1 = 235, 20 to 155; its middle thirds 182 to 209 and
// 102 to 129; (648 - 195) * (195 + 8) / 656 = 140
TEST_F(CameraSettings, po8030d_window_of_config_cam) {
  Robot& r = run_statements("fast_2_timer/e_po8030d.h", R"(
  answer[0] = e_po8030d_config_cam(160, 80, 320, 320, 8, 8, GREY_SCALE_MODE);
  e_po8030d_set_bank(BANK_C);
)",
                            "po8030d");
  EXPECT_EQ(r.variables("answer", 1)[0], 0);
  EXPECT_EQ(read(0x03), 2);
  expect({{0x08, 0}, {0x09, 39}, {0x0c, 0}, {0x0d, 235}, {0x11, 3}, {0x6a, 4}}, 0);
  expect({{0x35, 0}, {0x36, 40}, {0x37, 0}, {0x38, 235}, {0x39, 0}, {0x3a, 20}, {0x3b, 0}, {0x3c, 155}}, 0);
  expect({{0x3d, 0}, {0x3e, 182}, {0x3f, 0}, {0x40, 209}, {0x41, 0}, {0x42, 102}, {0x43, 0}, {0x44, 129}}, 0);
  expect({{0x4e, 0x43}, {0x93, 0x80}, {0x94, 0x80}, {0xb7, 1}, {0x95, 0}, {0x96, 140}}, 1);
}

// x 500 - 1 = 499, y 299: 499 to 538, 299 to 328; thirds 512 to 525 and 309 to 319; (648 - 39) * 2 * 86 / 1304 = 80
TEST_F(CameraSettings, po8030d_window_in_colour) {
  run_statements("fast_2_timer/e_po8030d.h", R"(
  e_po8030d_config_cam(500, 300, 40, 30, 1, 1, RGB_565_MODE);
  e_po8030d_write_register(BANK_D, 0x20, 0x99);
)",
                 "po8030d");
  expect({{0x08, 1}, {0x09, 0xf2}, {0x0c, 2}, {0x0d, 0x1a}, {0x11, 10}, {0x6a, 5}}, 0);
  expect({{0x35, 1}, {0x36, 0xf3}, {0x37, 2}, {0x38, 0x1a}, {0x39, 1}, {0x3a, 0x2b}, {0x3b, 1}, {0x3c, 0x48}},
         0);
  expect({{0x3d, 2}, {0x3e, 0}, {0x3f, 2}, {0x40, 0x0d}, {0x41, 1}, {0x42, 0x35}, {0x43, 1}, {0x44, 0x3f}},
         0);
  expect({{0x4e, 0x30}, {0x93, 0x20}, {0x94, 0x20}, {0xb7, 0}, {0x95, 0}, {0x96, 80}}, 1);
  expect({{0x20, 0x99}}, 3);
}

// the call that serves all three: each sensor has its own registers for red, green and blue
TEST_F(CameraSettings, gains_of_whichever_sensor_it_is) {
  struct {
    const char* camera;
    int bank;
    std::map<int, int> registers;
  } const kSensors[] = {{"po3030k", -1, {{0x15, 40}, {0x16, 0x41}, {0x17, 0x42}, {0x18, 0x43}, {0x19, 0x42}}},
                        {"po6030k", 2, {{0xa4, 0x41}, {0xa5, 0x42}, {0xa6, 0x43}}},
                        {"po8030d", 0, {{0x23, 0x41}, {0x24, 0x42}, {0x25, 0x43}}}};
  for (int i = 0; i < 3; ++i) {
    Robot& r = add_robot_with_source(
        "#include <camera/fast_2_timer/e_poxxxx.h>\nint main(void) {\n  e_poxxxx_init_cam();\n"
        "  e_poxxxx_set_rgb_gain(0x41, 0x42, 0x43);\n  e_poxxxx_write_cam_registers();\n  while (1);\n}\n",
        kSensors[i].camera);
    r.settings().own["camera"] = kSensors[i].camera;
    r.at(0, i);
  }
  run_for(1);
  for (int i = 0; i < 3; ++i)
    for (const auto& [number, value] : kSensors[i].registers)
      EXPECT_EQ(read(number, kSensors[i].bank, i), value) << kSensors[i].camera << std::hex << number;
  expect_no_traps();
}

TEST_F(CameraSettings, po6030k_writes_at_once) {
  Robot& r = run_statements("fast_2_timer/e_po6030k.h", R"(
  answer[0] = e_po6030k_set_mode(GREY_SCALE_MODE, PO_6030_MODE_QVGA);
  answer[1] = e_po6030k_set_mode(9, PO_6030_MODE_QVGA);
  answer[2] = e_po6030k_set_mode(RGB_565_MODE, 1);
  answer[3] = e_po6030k_set_mode(YUV_MODE, PO_6030_MODE_QQVGA);
  answer[4] = e_po6030k_set_wx(0x123, 799);
  answer[5] = e_po6030k_set_wx(0x123, 800);
  answer[6] = e_po6030k_set_wy(9, 1);
  answer[7] = e_po6030k_set_vsync(0x12, 0x134);
  answer[8] = e_po6030k_set_vsync(1, 500);
  e_po6030k_set_speed(PO_6030_SPEED_4);
  e_po6030k_set_awb_ae(1, 0);
  e_po6030k_set_rgb_gain(0x41, 0x42, 0x43);
  e_po6030k_set_exposure(0x12345678L);
  e_po6030k_set_mirror(1, 0);
  e_po6030k_set_sketch_mode(E_PO6030K_SKETCH_COLOR);
  e_po6030k_write_register(BANK_D, 0x20, 0x99);
  answer[9] = e_po6030k_get_bytes_per_pixel(YUV_MODE);
)",
                            "po6030k");
  EXPECT_EQ(r.variables("answer", 10), (std::vector<std::int16_t>{0, -1, -1, 0, 0, -1, 0, 0, -1, 2}));
  expect({{0x90, 0x80}, {0x91, 0x90}}, 0);
  expect({{0x38, 0x02}, {0x68, 3}, {0x80, 0x80}, {0x81, 0x80}, {0x82, 1}, {0x50, 1}, {0x51, 0x22}}, 1);
  expect(
      {{0x60, 0}, {0x61, 0x12}, {0x62, 1}, {0x63, 0x34}, {0x32, 0x41}, {0x88, 0x20}, {0x89, 0x80}, {0x8a, 8}},
      1);
  expect({{0x04, 0x99}, {0x55, 0}, {0x56, 0}, {0xa4, 0x41}, {0xa5, 0x42}, {0xa6, 0x43}, {0x5a, 1}}, 2);
  expect({{0x2c, 0x12}, {0x2d, 0x34}, {0x2e, 0x56}, {0x2f, 0x78}}, 2);
  expect({{0x20, 0x99}}, 3);
}

TEST_F(CameraSettings, po8030d_writes_at_once) {
  Robot& r = run_statements("fast_2_timer/e_po8030d.h", R"(
  answer[0] = e_po8030d_set_mode(GREY_SCALE_MODE, PO_8030_MODE_QVGA);
  answer[1] = e_po8030d_set_mode(9, PO_8030_MODE_QVGA);
  answer[2] = e_po8030d_set_mode(RGB_565_MODE, 1);
  answer[3] = e_po8030d_set_wx(0x123, 775);
  answer[4] = e_po8030d_set_wx(0x123, 776);
  answer[5] = e_po8030d_set_wy(9, 1);
  answer[6] = e_po8030d_set_vsync(0x12, 0x134);
  answer[7] = e_po8030d_set_vsync(1, 516);
  answer[8] = testWriteReg(BANK_C);
  answer[9] = init_po8030();
  e_po8030d_set_awb_ae(0, 1);
  e_po8030d_set_rgb_gain(0x41, 0x42, 0x43);
  e_po8030d_set_exposure(0x12345678L);
  e_po8030d_set_mirror(0, 1);
  e_po8030d_set_sketch_mode(E_PO8030D_SKETCH_BW);
  e_po8030d_set_pclkdiv(5);
  answer[10] = e_po8030d_get_bytes_per_pixel(GREY_SCALE_MODE);
)",
                            "po8030d");
  EXPECT_EQ(r.variables("answer", 11), (std::vector<std::int16_t>{0, -1, -1, 0, -1, 0, 0, -1, 2, 0, 1}));
  expect({{0x08, 1}, {0x09, 0x22}, {0x0c, 3}, {0x0d, 0x07}, {0x10, 0}, {0x11, 0x12}, {0x12, 1}, {0x13, 0x34}},
         0);
  expect({{0x23, 0x41}, {0x24, 0x42}, {0x25, 0x43}, {0x5b, 0}, {0x6c, 0x40}}, 0);
  expect({{0x4e, 0x30}, {0x93, 0x40}, {0x94, 0x40}, {0xb7, 5}, {0x9e, 0x28}, {0x04, 0x80}, {0x06, 0x02}}, 1);
  expect({{0x04, 0x9c}, {0x48, 8}, {0x49, 0xc}, {0x12, 0x12}, {0x13, 0x34}, {0x14, 0x56}, {0x15, 0x78}}, 2);
}

TEST_F(CameraSettings, po8030d_brightness_lifts_black) {
  Robot& r = run_statements("fast_2_timer/e_po8030d.h", R"(
  static unsigned char line[40];
  e_poxxxx_set_awb_ae(0, 0); /* exposure 0: nothing but brightness */
  e_poxxxx_config_cam(160, 80, 320, 8, 8, 8, GREY_SCALE_MODE);
  e_po8030d_set_brightness(0x28);
  e_poxxxx_launch_capture((char *)line);
  while (!e_poxxxx_is_img_ready());
  answer[0] = line[5];
  e_po8030d_set_brightness((signed char)0xA8); /* sign and magnitude: -40 */
  e_poxxxx_launch_capture((char *)line);
  while (!e_poxxxx_is_img_ready());
  answer[1] = line[5];
)",
                            "po8030d", 3);
  // read noise of one count at most
  EXPECT_NEAR(r.variables("answer", 2)[0], 40, 5);
  EXPECT_EQ(r.variables("answer", 2)[1], 0);
}

// the slow driver: clock divided by 32 at sub-sampling 4, 852 lines: 0.63 pictures a second; LED 0 flickers
TEST_F(CameraSettings, slow_driver_takes_its_time) {
  Robot& r = add_robot_with_source(R"(
#include <camera/slow_3_timer/e_po3030k.h>
#include <motor_led/e_init_port.h>
char picture[800];
int pictures, configured, before;
int main(void) {
  before = e_po3030k_is_img_ready();
  e_po3030k_init_cam();
  configured = e_po3030k_config_cam(240, 160, 160, 160, 8, 8, RGB_565_MODE);
  e_po3030k_write_cam_registers();
  for (;;) {
    e_po3030k_launch_capture(picture);
    while (!e_po3030k_is_img_ready());
    pictures++;
  }
}
)");
  r.settings().own["camera"] = "po3030k";
  run_for(4);
  const int first = r.variable("pictures");
  run_for(16);
  EXPECT_EQ(r.variable("before"), 0);
  EXPECT_EQ(r.variable("configured"), 0);
  EXPECT_NEAR(r.variable("pictures") - first, 16 * 14745600.0 / 32 / 852 / 852, 1);
  const auto bytes = r.variables<std::uint8_t>("picture", 800);
  EXPECT_LT(std::count(bytes.begin(), bytes.end(), 0), 20);
  EXPECT_EQ(read(0x1d), 0x50);
  // 160 + 7 - 4 = 163 for lines, VSYNC one earlier, columns without the fast driver's pixel:
  // 240 + 210 - 1 = 449
  expect({{0x08, 1}, {0x09, 0xc1}, {0x0b, 163}, {0xa6, 162}});
  expect_no_traps();
}

// three robots that film one another's blinking ring: nothing depends on threads
TEST(CameraDigest, does_not_depend_on_threads) {
  class Run : public FirmwareTest {
   public:
    void TestBody() override {}
    std::uint64_t of(int threads) {
      options.threads = threads;
      for (int i = 0; i < 4; ++i) {
        Robot& r = add_robot_with_source(R"(
#include <camera/fast_2_timer/e_poxxxx.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
char buffer[3200];
int sum;
int main(void) {
  int i;
  e_poxxxx_init_cam();
  e_poxxxx_config_cam(160, 80, 320, 320, 8, 8, RGB_565_MODE);
  e_poxxxx_write_cam_registers();
  e_start_agendas_processing();
  e_init_motors();
  for (;;) {
    e_poxxxx_launch_capture(buffer);
    while (!e_poxxxx_is_img_ready());
    for (i = 0; i < 3200; i++) sum += buffer[i];
    e_set_led(8, 2);
    e_set_speed_left(sum & 127);
    e_set_speed_right(-(sum & 255));
  }
}
)");
        r.at(0.1 * (i % 2), 0.1 * (i / 2), 90 * i);
      }
      run_for(4);
      return digest();
    }
  };
  const std::uint64_t one = Run().of(1);
  EXPECT_EQ(Run().of(3), one);
  EXPECT_EQ(Run().of(4), one);
}

}  // namespace
