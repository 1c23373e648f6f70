// SPDX-License-Identifier: MIT
// The serial command program, byte by byte: start-up, framing, every text and every binary command, the
// remote control. Expectations are the protocol's, worked out by hand; docs/connecting.md says where they come
// from.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "sim_core/random/counter_random.h"
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

const std::string kBanner =
    "\f\aWELCOME to the SerCom protocol on e-Puck\r\nthe EPFL education robot type \"H\" for help\r\n";

/// A sequence of binary commands: letters are negated, numbers go as they are.
std::string binary(const std::string& commands) {
  std::string out;
  for (char c : commands) out += static_cast<char>(-c);
  return out;
}

std::string word(int value) {
  return {static_cast<char>(value & 0xFF), static_cast<char>(value >> 8 & 0xFF)};
}

int word_at(const std::string& bytes, std::size_t i) {
  return static_cast<std::int16_t>(static_cast<unsigned char>(bytes.at(i)) |
                                   static_cast<unsigned char>(bytes.at(i + 1)) << 8);
}

std::vector<int> numbers_of(const std::string& line) {
  std::vector<int> out;
  for (std::size_t at = line.find(','); at != std::string::npos; at = line.find(',', at + 1))
    out.push_back(std::atoi(line.c_str() + at + 1));
  return out;
}

const std::string kEnd(1, '\0');

/// The program uses every device from its start on: without one of them there is nothing to test.
class Probe : public FirmwareTest {
 public:
  std::string missing_device() {
    Robot& robot = add_robot("asercom");
    run_for(2);
    for (const auto& trap : robot.traps())
      if (trap.kind == host::kTrapUnsimulated) return trap.message;
    return "";
  }
  void TestBody() override {}
};

class Asercom : public FirmwareTest {
 protected:
  void SetUp() override {
    static const std::string missing = Probe().missing_device();
    if (!missing.empty()) GTEST_SKIP() << missing;
  }
  Robot& puck(int selector = 3) {
    puck_ = &add_robot("asercom").selector(selector);
    return *puck_;
  }
  Robot& started(int selector = 3) {
    Robot& robot = puck(selector);
    EXPECT_TRUE(run_until([&] { return ends_with(robot.uart(1).text(), kBanner); }, 5))
        << robot.uart(1).text();
    return robot;
  }
  /// What comes back within `wait_s` after these bytes were sent.
  std::string reply(const std::string& bytes, double wait_s = 0.1) {
    const std::size_t before = puck_->uart(1).text().size();
    puck_->uart(1).send(bytes);
    run_for(wait_s + static_cast<double>(bytes.size()) / 11520);
    return puck_->uart(1).text().substr(before);
  }
  static bool ends_with(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
  }

  Robot* puck_ = nullptr;
};

// --- start-up

TEST_F(Asercom, begins_with_selector_and_banner_and_only_once_after_power_up) {
  Robot& robot = puck(3);
  run_for(3);
  EXPECT_EQ(robot.uart(1).text(), "Selector pos 3\r\n" + kBanner);
  EXPECT_EQ(kBanner.size(), 88u);
  expect_no_traps();
}

TEST_F(Asercom, serves_bluetooth_in_every_position_but_ten) {
  Robot& robot = puck(0);
  run_for(3);
  EXPECT_EQ(robot.uart(1).text(), "Selector pos 0\r\n" + kBanner);
  EXPECT_EQ(reply("C\r"), "c,0\r\n");
}

// the driver says that a text is sent when its last byte begins; the reset then cuts that byte off
TEST_F(Asercom, in_position_two_it_is_what_webots_expects) {
  started(2);
  EXPECT_EQ(reply("V\n"), "v,Version 1.5.3 November 2016 (Webots)\r\nHW version: FFFD\r\n");
  EXPECT_EQ(reply(std::string("S\n\0", 3)), "s\r\n");
  EXPECT_EQ(reply("X,5\r"), "x,11111\r\n");
  EXPECT_EQ(reply("X,5000\r", 0.6).size(), 4056u - 5 + 4);
  EXPECT_EQ(reply("M\r", 0.3), "m,-1,-1,-1\r\n");
  EXPECT_EQ(reply(binary("M") + kEnd, 0.3), std::string(6, '\xFF'));
  EXPECT_EQ(reply("J,1,52,39,8\rI\r", 1.5), "j\r\ni,1,52,39,8,4056\r\n");
  EXPECT_EQ(reply(binary("NI") + kEnd, 2).size(), 16u + 3 + 4056);
  expect_no_traps();
}

TEST_F(Asercom, reset_begins_again) {
  started(3);
  EXPECT_EQ(reply("R\r", 3), "r\rSelector pos 3\r\n" + kBanner);
  EXPECT_EQ(reply("C\r"), "c,3\r\n");
  expect_no_traps();
}

// --- framing

TEST_F(Asercom, cr_or_lf_end_a_line_and_letters_may_be_small) {
  started(5);
  EXPECT_EQ(reply("C\r"), "c,5\r\n");
  EXPECT_EQ(reply("C\n"), "c,5\r\n");
  EXPECT_EQ(reply("c\r\n"), "c,5\r\n");
  EXPECT_EQ(reply("c\r\n\r\nC\r"), "c,5\r\nc,5\r\n");
  EXPECT_EQ(reply("x,3\r"), "z,Command not found\r\n");
  EXPECT_EQ(reply("?what,1\r"), "z,Command not found\r\n");
}

TEST_F(Asercom, a_zero_between_commands_is_nothing) {
  started(5);
  EXPECT_EQ(reply(std::string(3, '\0') + "C\r"), "c,5\r\n");
}

// after CR LF the LF is pending: the next byte, binary or not, is taken for text
TEST_F(Asercom, a_binary_command_after_cr_lf_is_eaten_as_text) {
  started();
  EXPECT_EQ(reply("C\r\n" + binary("E") + kEnd), "c,3\r\n");  // the text that has begun has no end yet
  EXPECT_EQ(reply("V\r"), "z,Command not found\r\n");
  EXPECT_EQ(reply(binary("E") + kEnd), word(0) + word(0));  // and all is well again
}

TEST_F(Asercom, missing_numbers_keep_their_value) {
  started();
  EXPECT_EQ(reply("D,120,-70\rE\r"), "d\r\ne,120,-70\r\n");
  EXPECT_EQ(reply("D,33\rE\r"), "d\r\ne,33,-70\r\n");
  EXPECT_EQ(reply("D\rE\r"), "d\r\ne,33,-70\r\n");
  EXPECT_EQ(reply("D, 5,\t6\rE\r"), "d\r\ne,5,6\r\n");
}

TEST_F(Asercom, binary_commands_answer_together_and_in_order_after_the_zero) {
  started(3);
  EXPECT_EQ(reply(binary("E") + binary("Q")), "");
  EXPECT_EQ(reply(kEnd), word(0) + word(0) + word(0) + word(0));
  // orders answer nothing; unknown codes and ASCII inside a sequence are skipped
  EXPECT_EQ(reply(binary("L") + "\x02\x01" + kEnd), "");
  EXPECT_EQ(reply(binary("zE") + "Hello" + binary("\x01") + kEnd), word(0) + word(0));
}

// --- motors

TEST_F(Asercom, text_drives_and_counts) {
  Robot& robot = started();
  EXPECT_EQ(reply("D,200,-200\r"), "d\r\n");
  run_for(2);
  EXPECT_EQ(reply("D,0,0\r"), "d\r\n");
  const std::string counts =
      "q," + std::to_string(robot.left_steps()) + "," + std::to_string(robot.right_steps());
  EXPECT_EQ(reply("Q\r"), counts + "\r\n");
  EXPECT_NEAR(robot.left_steps(), 420, 12);  // 2.1 s of 200 steps/s
  EXPECT_NEAR(robot.right_steps(), -420, 12);
  EXPECT_EQ(reply("P,1000,-30000\rQ\r"), "p\r\nq,1000,-30000\r\n");
}

TEST_F(Asercom, binary_drives_and_counts) {
  Robot& robot = started();
  EXPECT_EQ(reply(binary("D") + word(-100) + word(256) + kEnd, 1), "");  // 256: a parameter byte of 0
  EXPECT_EQ(reply(binary("E") + kEnd), word(-100) + word(256));
  EXPECT_LT(robot.left_steps(), -80);
  EXPECT_GT(robot.right_steps(), 200);
  EXPECT_EQ(reply(binary("D") + word(0) + word(0) + binary("P") + word(-2) + word(515) + binary("Q") + kEnd),
            word(-2) + word(515));
}

// E repeats what was ordered, limited or not; stopping by S does not change it
TEST_F(Asercom, speeds_are_reported_as_ordered) {
  Robot& robot = started();
  EXPECT_EQ(reply("D,3000,-1200\rE\r"), "d\r\ne,3000,-1200\r\n");
  run_for(0.5);
  EXPECT_EQ(reply("L,8,1\rS\r"), "l\r\ns\r\n");
  EXPECT_EQ(robot.leds(), 0u);
  const auto steps = robot.left_steps();
  EXPECT_EQ(reply("E\r", 0.3), "e,3000,-1200\r\n");
  EXPECT_EQ(robot.left_steps(), steps);
}

// --- LEDs

TEST_F(Asercom, text_switches_leds) {
  Robot& robot = started();
  EXPECT_EQ(reply("L,3,1\rL,0,2\r"), "l\r\nl\r\n");
  EXPECT_EQ(robot.leds(), 1u << 3 | 1u << 0);
  EXPECT_EQ(reply("L,0,2\r"), "l\r\n");
  EXPECT_EQ(robot.leds(), 1u << 3);
  EXPECT_EQ(reply("L,8,1\r"), "l\r\n");
  EXPECT_EQ(robot.leds(), 0xFFu);
  EXPECT_EQ(reply("L,9,0\r"), "l\r\n");
  EXPECT_EQ(robot.leds(), 0u);
  EXPECT_EQ(reply("B,1\rF,2\r"), "b\r\nf\r\n");
  EXPECT_EQ(robot.leds(), 0x300u);
  EXPECT_EQ(reply("B,2\rF,0\r"), "b\r\nf\r\n");
  EXPECT_EQ(robot.leds(), 0u);
}

TEST_F(Asercom, binary_switches_leds_body_and_front_by_number) {
  Robot& robot = started();
  const auto set = [&](char n, char v) { EXPECT_EQ(reply(binary("L") + n + v + kEnd), ""); };
  set(0, 1);
  set(7, 2);
  EXPECT_EQ(robot.leds(), 0x81u);
  set(8, 1);
  set(9, 1);
  EXPECT_EQ(robot.leds(), 0x381u);
  set(8, 2);
  set(10, 1);
  EXPECT_EQ(robot.leds(), 0x2FFu);
  set(10, 0);
  EXPECT_EQ(robot.leds(), 0x200u);
}

// --- proximity, light, battery, remote control

TEST_F(Asercom, proximity_is_what_the_sensors_give) {
  box(0.08, 0, 0.06);  // its face 5 cm before the wheels' middle
  Robot& robot = started();
  std::string expected = "n", expected_words;
  for (int i = 0; i < 8; ++i) {
    expected += "," + std::to_string(robot.proximity(i));
    expected_words += word(robot.proximity(i));
  }
  EXPECT_GT(robot.proximity(0), 300);
  EXPECT_EQ(reply("N\r"), expected + "\r\n");
  EXPECT_EQ(reply(binary("N") + kEnd), expected_words);
}

TEST_F(Asercom, light_readings_fall_with_light) {
  world.ambient_w_m2 = 1.5;  // 400 counts each
  started();
  EXPECT_EQ(reply("O\r"), "o,3495,3495,3495,3495,3495,3495,3495,3495\r\n");
  std::string words;
  for (int i = 0; i < 8; ++i) words += word(3495);
  EXPECT_EQ(reply(binary("O") + kEnd), words);
}

TEST_F(Asercom, calibration_takes_the_readings_of_now_for_nothing) {
  box(0.08, 0, 0.06);
  started();
  EXPECT_EQ(reply("K\r", 6),
            "k, Starting calibration - Remove any object in sensors range\r\nk, Calibration finished\r\n");
  EXPECT_EQ(reply("N\r"), "n,0,0,0,0,0,0,0,0\r\n");
}

TEST_F(Asercom, battery_is_good_or_low) {
  puck().battery(3.9);
  run_for(3);
  EXPECT_EQ(reply("b\r"), "b,1\r\n");
  EXPECT_EQ(reply(binary("b") + kEnd), word(1));
}

TEST_F(Asercom, low_battery_is_said) {
  puck().battery(3.3);
  run_for(3);
  EXPECT_EQ(reply("b\r"), "b,0\r\n");
  EXPECT_EQ(reply(binary("b") + kEnd), word(0));
}

TEST_F(Asercom, remote_control_is_reported) {
  Robot& robot = started();
  EXPECT_EQ(reply("G\r"), "g IR check : 0x2, address : 0x0, data : 0x0\r\n");
  robot.press_key(35, 0, 5);
  run_for(0.1);
  EXPECT_EQ(reply("G\r"), "g IR check : 0x0, address : 0x5, data : 0x23\r\n");
  robot.press_key(35, 0, 5);
  run_for(0.1);
  EXPECT_EQ(reply("G\r"), "g IR check : 0x1, address : 0x5, data : 0x23\r\n");
}

struct KeyMove {
  int key, left, right;
};

TEST_F(Asercom, remote_control_drives) {
  Robot& robot = started();
  for (const KeyMove& move : {KeyMove{1, 300, 600},
                              {2, 600, 600},
                              {3, 600, 300},
                              {4, -600, 600},
                              {5, 0, 0},
                              {6, 600, -600},
                              {7, -300, -600},
                              {8, -600, -600},
                              {9, -600, -300},
                              {12, 0, 0}}) {
    robot.press_key(move.key);
    run_for(0.1);
    EXPECT_EQ(reply("E\r"), "e," + std::to_string(move.left) + "," + std::to_string(move.right) + "\r\n")
        << "key " << move.key;
  }
  // a television's and a hi-fi's control count, others do not; nor does the same key again
  robot.press_key(2, 0.1, 8);
  run_for(0.1);
  EXPECT_EQ(reply("E\r"), "e,600,600\r\n");
  robot.press_key(8, 0.1, 3);
  run_for(0.1);
  EXPECT_EQ(reply("E\r"), "e,600,600\r\n");
  EXPECT_EQ(reply("D,1,2\r"), "d\r\n");
  robot.press_key(8, 0.1, 3);
  run_for(0.1);
  EXPECT_EQ(reply("E\r"), "e,1,2\r\n");
}

TEST_F(Asercom, key_nought_does_nothing_at_power_up) {
  Robot& robot = started();
  robot.press_key(0);
  run_for(0.2);
  EXPECT_EQ(reply("E\r"), "e,0,0\r\n");
  expect_no_traps();
}

// --- words about itself

// the last word of the data EEPROM: 01 in its lowest bits for a camera that stands upright
TEST_F(Asercom, version_and_hardware) {
  started();
  const std::string v = reply("V\r");
  EXPECT_EQ(v, "v,Version 1.2.2 August 2008 GCtronic\r\nHW version: FFFD\r\n");
  EXPECT_EQ(v.at(10), '1');  // programs look here
}

TEST_F(Asercom, help_has_a_line_for_each_command) {
  started();
  const std::string help = reply("H\r", 0.5);
  EXPECT_EQ(help.at(0), '\n');
  EXPECT_EQ(std::count(help.begin(), help.end(), '\n'), 1 + 25);
  for (char letter : std::string("ABbCDEFGHIJKLMNOPQRSTUVWY")) {
    const std::string start = std::string("\n\"") + letter;
    EXPECT_NE(help.find(start), std::string::npos) << letter;
  }
}

TEST_F(Asercom, selector_is_read_live) {
  Robot& robot = started(4);
  EXPECT_EQ(reply("C\r"), "c,4\r\n");
  robot.turn_selector(14);
  EXPECT_EQ(reply("C\r"), "c,14\r\n");
}

// --- accelerometer, microphones, I2C, camera, sound

TEST_F(Asercom, accelerometer_raw_in_text_and_binary) {
  started();
  const std::vector<int> text = numbers_of(reply("A\r"));
  ASSERT_EQ(text.size(), 3u);
  // level and at rest: 2048 counts for nothing, and one g more on z (some hundred counts, GRAVITY is 768)
  EXPECT_NEAR(text[0], 2048, 100);
  EXPECT_NEAR(text[1], 2048, 100);
  EXPECT_NEAR(text[2], 2048 + 768, 150);
  const std::string raw = reply(binary("a") + kEnd);
  ASSERT_EQ(raw.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(word_at(raw, 2 * i), text[i], 45);  // noise of 6.3 counts in each
}

TEST_F(Asercom, accelerometer_spherical_is_three_floats) {
  started();
  const std::string bytes = reply(binary("A") + kEnd);
  ASSERT_EQ(bytes.size(), 12u);
  float values[3];
  std::memcpy(values, bytes.data(), sizeof values);
  EXPECT_NEAR(values[0], 768, 60);  // what calibration makes of one g
  EXPECT_NEAR(values[2], 0, 10);    // level
}

TEST_F(Asercom, without_gyroscope_rotation_and_temperature_are_nought) {
  started();
  EXPECT_EQ(reply("g\r"), "g,0,0,0\r\n");
  EXPECT_EQ(reply(binary("g") + kEnd), std::string(6, '\0'));
  EXPECT_EQ(reply(binary("t") + kEnd), std::string(1, '\0'));
}

// 8.75 mdps a count: 400, -800 and 200; of single axes the library takes the low byte as signed, so 0x0190 is 256 - 112,
// 0xFCE0 is -1024 - 32 and 0x00C8 is -56
TEST_F(Asercom, rotation_temperature_and_charge_of_revision_1_3) {
  Robot& robot = puck().battery(3.8);
  robot.settings().own["revision"] = "1.3";
  robot.settings().variation.motion_noise_scale = 0;
  robot.settings().variation.gyro_offset_rad_s = {sim::radians(3.5), sim::radians(-7), sim::radians(1.75)};
  run_for(3);
  EXPECT_EQ(reply("g\r"), "g,144,-1056,-56\r\n");
  EXPECT_EQ(reply(binary("t") + kEnd), std::string(1, 25));
  const std::string charge = reply("b\r");
  int raw = 0, percent = 0;
  ASSERT_EQ(std::sscanf(charge.c_str(), "b,%d (%d%%)\r\n", &raw, &percent), 2) << charge;
  EXPECT_NEAR(raw, 2070 + 245, 30);
  EXPECT_EQ(percent, (raw - 2070) * 100 / 490);
}

TEST_F(Asercom, loudness_and_samples) {
  started();
  const std::vector<int> text = numbers_of(reply("U\r"));
  ASSERT_EQ(text.size(), 3u);
  EXPECT_EQ(reply(binary("u") + kEnd).size(), 6u);
  // 600 bytes of samples come first, then the replies in order: E, and the index of the oldest sample
  const std::string dump = reply(binary("EU") + kEnd, 0.3);
  ASSERT_EQ(dump.size(), 600u + 4 + 1);
  EXPECT_EQ(dump.substr(600, 4), word(0) + word(0));
  EXPECT_LT(static_cast<unsigned char>(dump.back()), 100);
}

TEST_F(Asercom, ground_sensors_that_are_not_there_read_minus_one) {
  started();
  EXPECT_EQ(reply("M\r", 0.3), "m,-1,-1,-1,-1,-1\r\n");
  EXPECT_EQ(reply(binary("M") + kEnd, 0.3), std::string(10, '\xFF'));
}

// 3.3 mm above a white floor: 1000 - 700 * 3.3 / 16 = 856 by the published table
TEST_F(Asercom, ground_sensors_are_read_high_byte_first) {
  world.floor.colour = {1, 1, 1};
  sim::PartDesc board;
  board.kind = "ground-sensors";
  board.values["noise"].numbers = {0};
  puck().settings().parts.push_back(board);
  run_for(3);
  const std::vector<int> text = numbers_of(reply("M\r", 0.3));
  ASSERT_EQ(text.size(), 5u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(text[static_cast<std::size_t>(i)], 856);
  std::string words;
  for (int value : text) words += word(value);
  EXPECT_EQ(reply(binary("M") + kEnd, 0.3), words);
}

TEST_F(Asercom, i2c_goes_through) {
  started();
  EXPECT_EQ(reply("W,192,3,-5\r"), "w\r\n");
  EXPECT_EQ(reply("Y,192,3\r"), "y,192,3\r\ny,-1\r\n");  // nobody there: the bus reads ones
  EXPECT_EQ(reply(binary("W") + std::string("\xC0\x03\x07") + binary("E") + kEnd), word(0) + word(0));
  EXPECT_EQ(reply(binary("w") + std::string(35, '\0') + binary("E") + kEnd, 0.5), word(0) + word(0));
  // a line for every device with a first register below 128: the numbers depend on what hangs on the bus
  const std::string scan = reply("Z\r", 2);
  for (std::size_t at = 0; at < scan.size();) {
    int device = -1, value = -1, length = 0;
    ASSERT_EQ(std::sscanf(scan.c_str() + at, "%d: %d\r\n%n", &device, &value, &length), 2) << scan;
    EXPECT_EQ(device % 2, 0);
    EXPECT_GE(value, 0);
    at += static_cast<std::size_t>(length);
  }
  EXPECT_EQ(reply("C\r"), "c,3\r\n");
  expect_no_traps();
}

TEST_F(Asercom, camera_settings_are_set_and_told) {
  started();
  EXPECT_EQ(reply("I\r"), "i,1,40,40,8,3200\r\n");
  EXPECT_EQ(reply("J,0,60,20,8\r", 1.5), "j\r\n");
  EXPECT_EQ(reply("I\r"), "i,0,60,20,8,1200\r\n");
  // 3456 bytes fit, more does not: back to 40 x 40 in colour, the zoom stays
  EXPECT_EQ(reply("J,1,48,36,4\rI\r", 1.5), "j\r\ni,1,48,36,4,3456\r\n");
  EXPECT_EQ(reply("J,1,60,60,4\rI\r", 1.5), "j\r\ni,1,40,40,4,3200\r\n");
  EXPECT_EQ(reply("J,0,20,20,8,10,20\rI\r", 1.5), "j\r\ni,0,20,20,8,400\r\n");
  // what no camera can do
  EXPECT_EQ(reply("J,7,-300,9,0\rI\r", 1.5), "j\r\ni,1,40,40,8,3200\r\n");
  expect_no_traps();
}

TEST_F(Asercom, a_picture_follows_its_header) {
  started();
  const std::string colour = reply(binary("I") + kEnd, 2);
  ASSERT_EQ(colour.size(), 3u + 3200);
  EXPECT_EQ(colour.substr(0, 3), "\x01\x28\x28");
  EXPECT_EQ(reply("J,0,40,20,8\r", 1.5), "j\r\n");
  const std::string grey = reply(binary("EIQ") + kEnd, 2);
  ASSERT_EQ(grey.size(), 4u + 3 + 800 + 4);
  EXPECT_EQ(grey.substr(0, 4), word(0) + word(0));
  EXPECT_EQ(grey.substr(4, 3), std::string("\0\x28\x14", 3));
  EXPECT_EQ(grey.substr(807), word(0) + word(0));
  // two pictures in one sequence: both whole, one after the other
  EXPECT_EQ(reply(binary("II") + kEnd, 3).size(), 2 * 803u);
}

TEST_F(Asercom, sounds_are_played_or_stopped) {
  started();
  for (const char* command : {"T,1\r", "T,5\r", "T,0\r", "T,3\r", "T,9\r"})
    EXPECT_EQ(reply(command, 0.3), "t\r\n") << command;
  EXPECT_EQ(reply("t,2\r", 0.3), "t\r\n");  // a small t is a T as well
  expect_no_traps();
}

// --- hardware revision 1.3

TEST_F(Asercom, revision_1_3_measures_its_battery_rotation_and_temperature) {
  puck().battery(4.0).settings().own["revision"] = "1.3";
  run_for(4);
  // 4.0 V are 2437.5 counts; camera and infrared draw some 38 mA more through 0.2 ohm: 5 counts less
  int counts = 0, percent = 0, length = 0;
  const std::string battery = reply("b\r");
  ASSERT_EQ(std::sscanf(battery.c_str(), "b,%d (%d%%)\r\n%n", &counts, &percent, &length), 2) << battery;
  EXPECT_EQ(static_cast<std::size_t>(length), battery.size());
  EXPECT_NEAR(counts, 2433, 3);
  EXPECT_EQ(percent, 100 * (counts - 2070) / 490);
  EXPECT_NEAR(word_at(reply(binary("b") + kEnd), 0), counts, 1);
  // at rest: 8.75 mdps a count, so a few hundred counts are a few degrees a second
  const std::vector<int> rotation = numbers_of(reply("g\r"));
  ASSERT_EQ(rotation.size(), 3u);
  for (int axis : rotation) EXPECT_NEAR(axis, 0, 500);
  const std::string raw = reply(binary("gt") + kEnd);
  ASSERT_EQ(raw.size(), 7u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(word_at(raw, 2 * i), 0, 500);
  // two lines more: rotation and temperature
  const std::string help = reply("H\r", 0.5);
  EXPECT_EQ(std::count(help.begin(), help.end(), '\n'), 1 + 27);
  const std::vector<int> acceleration = numbers_of(reply("A\r"));
  ASSERT_EQ(acceleration.size(), 3u);
  expect_no_traps();
}

// --- noise

// A million bytes of noise at full speed: nothing hangs, and after what ends any unfinished command (more
// zeros than the longest one asks for, and a line end) the next command is answered.
TEST_F(Asercom, a_million_random_bytes_do_no_harm) {
  Robot& robot = started();
  constexpr int kBytes = 1000000;
  const sim::RandomKey key{1, 0, 0};
  std::string noise;
  for (int i = 0; i < kBytes; ++i)
    noise += static_cast<char>(sim::random_bits(key, static_cast<std::uint64_t>(i)) & 255);
  robot.uart(1).send(noise);
  run_for(kBytes / 11520.0 + 1);
  run_for(8);  // a calibration or a bus scan that began last
  robot.uart(1).send(std::string(64, '\0') + "\r");
  run_for(8);
  EXPECT_EQ(reply("C\r", 0.5), "c,3\r\n");
  EXPECT_EQ(reply("D,100,-50\rE\r"), "d\r\ne,100,-50\r\n");
  EXPECT_EQ(reply(binary("E") + kEnd), word(100) + word(-50));
  expect_no_traps();
}

// --- turret mode

TEST_F(Asercom, in_position_ten_the_turret_is_served_and_some_commands_are_not) {
  Robot& robot = puck(10);
  run_for(3);
  EXPECT_EQ(robot.uart(1).text(), "Selector pos 10\r\n");
  EXPECT_EQ(robot.uart(2).text(), kBanner);
  const auto ask = [&](const std::string& bytes) {
    const std::size_t before = robot.uart(2).text().size();
    robot.uart(2).send(bytes);
    run_for(0.2);
    return robot.uart(2).text().substr(before);
  };
  EXPECT_EQ(ask("C\r"), "c,10\r\n");
  EXPECT_EQ(ask("D,100,50\rE\r"), "d\r\ne,100,50\r\n");
  EXPECT_EQ(ask("B,1\rF,1\r"), "b\r\nf\r\n");
  EXPECT_EQ(ask("T,1\r"), "t\r\n");
  for (const char* silent : {"G\r", "I\r", "J,0,20,20,8\r", "M\r", "W,1,2,3\r", "Y,1,2\r", "Z\r"})
    EXPECT_EQ(ask(silent), "") << silent;
  EXPECT_EQ(numbers_of(ask("N\r")).size(), 10u);
  EXPECT_EQ(numbers_of(ask("O\r")).size(), 10u);
  EXPECT_EQ(ask(binary("N") + kEnd).size(), 20u);
  EXPECT_EQ(ask(binary("O") + kEnd).size(), 20u);
  EXPECT_EQ(ask(binary("IME") + kEnd), word(100) + word(50));
  EXPECT_EQ(robot.uart(1).text(), "Selector pos 10\r\n");
}

}  // namespace
