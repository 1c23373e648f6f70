// SPDX-License-Identifier: MIT
// The pins that programs are told of (firmware/include) are those of the board.
#include "hal_sim/board/wiring.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <string>

#include "twinpuck_paths.h"

namespace {

using board::Pin;

/// "LED0" -> "A6", "ACCX" -> "5", as the contract's header says.
std::map<std::string, std::string> told() {
  std::ifstream in(std::string(TWINPUCK_SOURCE_DIR) + "/firmware/include/motor_led/e_epuck_ports.h");
  const std::regex line(R"(#define (\w+) (?:_(?:LAT|R)([A-G]\d+)|(\d+)).*)");
  std::map<std::string, std::string> out;
  std::string text;
  for (std::smatch m; std::getline(in, text);)
    if (std::regex_match(text, m, line)) out[m[1]] = m[2].matched ? m[2] : m[3];
  return out;
}

TEST(Wiring, the_contract_names_the_same_pins) {
  const auto names = told();
  const auto expect = [&](const std::string& name, const Pin& pin) {
    const auto at = names.find(name);
    ASSERT_NE(at, names.end()) << name;
    EXPECT_EQ(at->second, pin.letter() + std::to_string(pin.bit)) << name;
  };
  for (int n = 0; n < 8; ++n) expect("LED" + std::to_string(n), board::kRingLedPins[n]);
  for (int n = 0; n < 4; ++n) expect("PULSE_IR" + std::to_string(n), board::kEmitterPins[n]);
  for (int n = 0; n < 4; ++n) expect("SELECTOR" + std::to_string(n), board::kSelectorPins[n]);
  expect("FRONT_LED", board::kFrontLedPin);
  expect("BODY_LED", board::kBodyLedPin);
  expect("AUDIO_ON", board::kCodecOnPin);
  expect("BATT_LOW", board::kBatteryGoodPin);
  expect("REMOTE", board::kRemotePin);
  expect("SIO_C", board::kI2cPins[0]);
  expect("SIO_D", board::kI2cPins[1]);
  expect("CAM_RESET", board::kCameraResetPin);
  expect("CAM_HREF", board::kCameraHrefPin);
  expect("CAM_VSYNC", board::kCameraVsyncPin);
  expect("CAM_PCLK", board::kCameraClockPin);
  for (int n = 0; n < 8; ++n) expect("CAM_y" + std::to_string(n), {board::kD, board::kCameraDataBit + n});
  for (int n = 0; n < 4; ++n) {
    expect(std::string("MOTOR1_PH") + "ABCD" [n], { board::kD, n });
    expect(std::string("MOTOR2_PH") + "ABCD" [n], { board::kD, board::kRightCoilsBit + n });
  }
  EXPECT_EQ(names.at("MIC1"), std::to_string(board::kMicChannel));
  EXPECT_EQ(names.at("ACCX"), std::to_string(board::kAccChannel));
  EXPECT_EQ(names.at("IR0"), std::to_string(board::kIrChannel));
}

}  // namespace
