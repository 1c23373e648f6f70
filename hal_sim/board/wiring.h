// SPDX-License-Identifier: MIT
// Which pin of the processor leads where: the one home of it in C++. Facts restated from the
// library [lib: motor_led/e_epuck_ports.h]; tests/board/wiring_test.cpp holds firmware/include's
// copy against this one.
//
//   RA6 7 9 12 10 13 14 15  ring LEDs 0..7      RC1 front LED   RC2 body LED   RC13 camera reset
//   RC3 HREF  RC4 VSYNC  RC14 pixel clock       RD8..15 camera data
//   RD0..3 left coils A..D  RD4..7 right coils
//   RF0 codec on   RF1 battery good   RF2..5 UARTs   RF6 remote receiver   RF7 RF8 RG0 RG1 IR emitters 0..3
//   RG2 RG3 I2C    RG6..9 selector
//   AN2..4 microphones  AN5..7 accelerometer (revision 1.3: AN7 battery)  AN8..15 proximity sensors
#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace board {

/// Ports in the order in which the board keeps them.
enum Port : int { kA, kB, kC, kD, kF, kG, kPorts };
inline constexpr char kPortLetters[] = "ABCDFG";

struct Pin {
  Port port;
  int bit;
  constexpr std::uint16_t mask() const { return static_cast<std::uint16_t>(1u << bit); }
  constexpr char letter() const { return kPortLetters[port]; }
};

inline constexpr int kEmitterLines = 4;  // each lights the sensors n and n + 4
inline constexpr Pin kRingLedPins[] = {{kA, 6},  {kA, 7},  {kA, 9},  {kA, 12},
                                       {kA, 10}, {kA, 13}, {kA, 14}, {kA, 15}};
inline constexpr Pin kFrontLedPin{kC, 1}, kBodyLedPin{kC, 2};
inline constexpr Pin kEmitterPins[kEmitterLines] = {{kF, 7}, {kF, 8}, {kG, 0}, {kG, 1}};
inline constexpr Pin kCodecOnPin{kF, 0}, kBatteryGoodPin{kF, 1}, kRemotePin{kF, 6};
inline constexpr Pin kUartInPins[2] = {{kF, 2}, {kF, 4}}, kUartOutPins[2] = {{kF, 3}, {kF, 5}};
inline constexpr Pin kI2cPins[2] = {{kG, 2}, {kG, 3}};
inline constexpr Pin kSelectorPins[4] = {{kG, 6}, {kG, 7}, {kG, 8}, {kG, 9}};
inline constexpr Pin kCameraHrefPin{kC, 3}, kCameraVsyncPin{kC, 4}, kCameraClockPin{kC, 14};
inline constexpr Pin kCameraResetPin{kC, 13};  // 1 = out of reset

// of port D: four coils a wheel, left first, A lowest; the camera's byte
inline constexpr std::uint16_t kLeftCoils = 0x000F, kRightCoils = 0x00F0, kCameraData = 0xFF00;
inline constexpr int kRightCoilsBit = 4, kCameraDataBit = 8;

// analogue inputs, first of each
inline constexpr int kMicChannel = 2, kAccChannel = 5, kIrChannel = 8, kBatteryChannel = 7;

/// The bits of a port that these pins are.
template <typename... Pins>
constexpr std::uint16_t mask(Port port, const Pins&... groups) {
  unsigned bits = 0;
  const auto add = [&](const Pin& pin) { bits |= pin.port == port ? pin.mask() : 0u; };
  const auto add_all = [&](const auto& group) {
    if constexpr (std::is_array_v<std::remove_reference_t<decltype(group)>>)
      for (const Pin& pin : group) add(pin);
    else
      add(group);
  };
  (add_all(groups), ...);
  return static_cast<std::uint16_t>(bits);
}

inline constexpr std::uint16_t kEmitterMask[kPorts] = {
    0, 0, 0, 0, mask(kF, kEmitterPins), mask(kG, kEmitterPins)};

}  // namespace board
