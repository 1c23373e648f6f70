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

/// Who hangs on a port, pin by pin: the bits of each consumer. The first group is moved by the processor.
struct PortWiring {
  std::uint16_t implemented;
  std::uint16_t leds, coils, emitters, codec_on, camera_reset, serial_out, i2c;
  std::uint16_t serial_in, battery_good, remote, selector, camera;  ///< moved by the board
  /// What e_init_port() makes outputs, at 0, and inputs; without port D.
  constexpr std::uint16_t first_outputs() const {
    return static_cast<std::uint16_t>(leds | emitters | codec_on | camera_reset | i2c);
  }
  constexpr std::uint16_t first_inputs() const {
    return static_cast<std::uint16_t>(battery_good | remote | selector);
  }
};

constexpr PortWiring wiring_of(Port port) {
  constexpr std::uint16_t kImplemented[kPorts] = {0xF6C0, 0xFFFF, 0xE01E,
                                                  0xFFFF, 0x01FF, 0xF3CF};  // [DS70143 3.2]
  const std::uint16_t coils = port == kD ? kLeftCoils | kRightCoils : 0, data = port == kD ? kCameraData : 0;
  return {kImplemented[port],
          mask(port, kRingLedPins, kFrontLedPin, kBodyLedPin),
          coils,
          mask(port, kEmitterPins),
          mask(port, kCodecOnPin),
          mask(port, kCameraResetPin),
          mask(port, kUartOutPins),
          mask(port, kI2cPins),
          mask(port, kUartInPins),
          mask(port, kBatteryGoodPin),
          mask(port, kRemotePin),
          mask(port, kSelectorPins),
          static_cast<std::uint16_t>(data | mask(port, kCameraHrefPin, kCameraVsyncPin, kCameraClockPin))};
}

/// The one table from pin to consumer.
inline constexpr PortWiring kWiring[kPorts] = {wiring_of(kA), wiring_of(kB), wiring_of(kC),
                                               wiring_of(kD), wiring_of(kF), wiring_of(kG)};

}  // namespace board
