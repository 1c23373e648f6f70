// SPDX-License-Identifier: MIT
#include "hal_sim/board/camera_sensor.h"

#include <algorithm>

#include "hal_sim/board/camera_params.h"
#include "sim_core/base/hash.h"

namespace board {

namespace {

constexpr std::uint8_t kAddress = 0xDC;  // [lib: camera/fast_2_timer/e_common.c]

constexpr std::uint8_t kGammaDefault[12] = {0x00, 0x1a, 0x2a, 0x37, 0x42, 0x56, 0x68,
                                            0x87, 0xa3, 0xbc, 0xd4, 0xea};  // [lib: e_po3030k_registers.c]

// PO3030K [lib: camera/fast_2_timer/e_po3030k_registers.c]
namespace po3030 {
enum : int {
  kFrameWidth = 0x04,
  kFrameHeight = 0x06,
  kWindowX = 0x08,
  kWindowY = 0x0a,
  kGlobalGain = 0x15,
  kRed = 0x16,
  kGreen = 0x17,
  kBlue = 0x18,
  kClock = 0x1d,
  kMirror = 0x1e,
  kSampling = 0x20,
  kFormat = 0x4e,
  kGamma = 0x76,
  kBrightness = 0x9b,
  kContrast = 0x9c,
  kVsync = 0xa5,
  kExposure = 0xb0,
  kTarget = 0xb3,
  kIntegration = 0xb9,
  kAutomatics = 0xd4
};
constexpr int kOriginX = 210, kOriginY = 7;
constexpr int kContrastOne = 0x96;
constexpr int kGainOne = 0x10;
}  // namespace po3030

// PO6030K [lib: camera/fast_2_timer/e_po6030k_registers.c, e_calc_po6030k.c]
namespace po6030 {
enum : int {
  kMirror = 0x90,
  kClock = 0x91,
  kFormat = 0x38,
  kWindowX = 0x50,
  kVsync = 0x60,
  kScale = 0x80,
  kAutomatics = 0x04,
  kExposure = 0x2c,
  kRed = 0xa4
};
constexpr int kOriginX = 16, kOriginY = 8;
}  // namespace po6030

// PO8030D [lib: camera/fast_2_timer/e_po8030d_registers.c, e_calc_po8030d.c]
namespace po8030 {
enum : int {
  kWindowX = 0x08,
  kRed = 0x23,
  kClock = 0x6a,
  kMirror = 0x6c,
  kFormat = 0x4e,
  kScale = 0x93,
  kBrightness = 0x9e,
  kAutomatics = 0x04,
  kExposure = 0x12
};
}  // namespace po8030

// sign and magnitude [lib: comment of e_po8030d_set_brightness]
double signed_magnitude(int value) { return value & 0x80 ? -(value & 0x7f) : value & 0x7f; }

// four steps of 16 double the gain, each divided in 16 [assumed: law of the maker's family; 79 gives 31]
double global_gain(int value) { return static_cast<double>(1 << (value >> 4)) * (16 + (value & 15)) / 16.0; }

int scale_of(int value) { return value == 0x80 ? 4 : value == 0x40 ? 2 : 1; }

}  // namespace

CameraSensor::CameraSensor(CameraKind kind) : I2cRegisters(kAddress), kind_(kind) { reset(0); }

void CameraSensor::put(Bank bank, int number, int value) {
  const auto byte = static_cast<std::uint8_t>(value);
  auto& registers = banks_[static_cast<std::size_t>(bank)];
  for (Register& r : registers)
    if (r.number == number) {
      r.value = byte;
      return;
    }
  registers.push_back({static_cast<std::uint8_t>(number), byte});
}

void CameraSensor::reset(Cycle at) {
  // Who keeps what it knows of the registers sees by the version that they are others now.
  for (auto& bank : banks_) bank.clear();
  bank_ = 0;
  hash_ = sim::fold(hash_, std::uint64_t{1});
  ++version_;
  written_at_ = at;
  // The registers' values after a reset.
  switch (kind_) {
    case CameraKind::Po3030k: {
      using namespace po3030;
      put(A, 0, 0x30);
      put(A, 1, 0x30);
      put(A, kFrameWidth, 0x03), put(A, kFrameWidth + 1, 0x53);
      put(A, kFrameHeight, 0x01), put(A, kFrameHeight + 1, 0xe8);
      put(A, kWindowX + 1, kOriginX - 1), put(A, kWindowY + 1, kOriginY);
      put(A, kGlobalGain, kGainOne);
      for (int gain = kRed; gain <= kBlue + 1; ++gain) put(A, gain, 0x40);  // two greens
      put(A, kClock, 0x00);
      put(A, kMirror, 0x0a);
      put(A, kSampling, 0x44);
      put(A, kFormat, 0x08);
      for (int i = 0; i < 12; ++i) put(A, kGamma + i, kGammaDefault[i]);
      put(A, kContrast, kContrastOne);
      put(A, kVsync + 1, kOriginY);
      put(A, kExposure, 0x07), put(A, kExposure + 1, 0xcc);
      put(A, kTarget, 0x70);
      put(A, kIntegration, 0x03), put(A, kIntegration + 1, 0xe6);
      put(A, kAutomatics, 0x3c);
      break;
    }
    case CameraKind::Po6030k: {
      using namespace po6030;
      put(A, 0, 0x60);
      put(A, 1, 0x30);
      put(A, kClock, 0x10);
      put(B, kFormat, 0x08);
      put(B, kScale, 0x20), put(B, kScale + 1, 0x20);
      put(B, kVsync + 1, kOriginY);
      put(C, kAutomatics, 0x98);
      for (int i = 0; i < 3; ++i) put(C, kRed + i, 0x40);
      break;
    }
    case CameraKind::Po8030d: {
      using namespace po8030;
      put(A, 0, 0x80);
      put(A, 1, 0x30);
      for (int i = 0; i < 3; ++i) put(A, kRed + i, 0x40);
      put(B, kFormat, 0x30);
      put(B, kScale, 0x20), put(B, kScale + 1, 0x20);
      put(C, kAutomatics, 0x98);
      break;
    }
    case CameraKind::None:
      break;
  }
}

bool CameraSensor::write_register(std::uint8_t number, std::uint8_t value, Cycle at) {
  if (number < 2) return true;  // the identity cannot be written
  if (kind_ != CameraKind::Po3030k && number == 3) {
    bank_ = value & 3;
    return true;
  }
  put(static_cast<Bank>(bank_), number, value);
  hash_ = sim::fold(hash_, static_cast<std::uint64_t>(bank_ << 16 | number << 8 | value));
  ++version_;
  written_at_ = at;
  return true;
}

std::uint8_t CameraSensor::read_register(std::uint8_t number, Cycle) {
  if (number < 2) return at(A, number);
  if (kind_ != CameraKind::Po3030k && number == 3) return static_cast<std::uint8_t>(bank_);
  return at(static_cast<Bank>(bank_), number);
}

SensorSetup CameraSensor::setup() const {
  SensorSetup s;
  switch (kind_) {
    case CameraKind::Po3030k:
      s = setup_3030();
      break;
    case CameraKind::Po6030k:
      s = setup_6030();
      break;
    case CameraKind::Po8030d:
      s = setup_8030();
      break;
    case CameraKind::None:
      break;
  }
  if (kind_ != CameraKind::Po3030k)
    std::copy(std::begin(kGammaDefault), std::end(kGammaDefault), s.gamma.begin());
  return s;
}

SensorSetup CameraSensor::setup_3030() const {
  using namespace po3030;
  SensorSetup s;
  // What the picture is made of: scale, format, clock, size, window, mirrors.
  const int sampling = at(A, kSampling);
  s.sub_sampling = sampling == 0x33 ? 4 : sampling == 0x11 ? 2 : 1;
  const int format = at(A, kFormat);
  s.format = format == 0x0c   ? SensorSetup::Format::Grey
             : format == 0x02 ? SensorSetup::Format::Yuv
                              : SensorSetup::Format::Rgb565;
  constexpr int kHalfCycles[8] = {4, 3, 8, 16, 32, 64, 128, 256};  // of SPEED_2, _2_3, _4 ... _128
  s.pixel_half_cycles = kHalfCycles[at(A, kClock) >> 4 & 7];
  s.byte_half_cycles = s.pixel_half_cycles * s.sub_sampling / s.bytes_per_pixel();
  s.line_pixels = word(A, kFrameWidth) + 1;
  s.frame_lines = word(A, kFrameHeight) + 1;
  s.longest_integration = std::max(1, word(A, kIntegration));
  s.first_x = word(A, kWindowX) + 1 + s.sub_sampling - kOriginX;
  s.first_y = word(A, kVsync) + s.sub_sampling - kOriginY;
  s.mirror_lines = (at(A, kMirror) & 0x40) != 0;
  s.mirror_columns = (at(A, kMirror) & 0x80) != 0;
  // What the automatics do, and what holds where they are off.
  s.auto_white = (at(A, kAutomatics) & 0x20) != 0;
  s.auto_exposure = (at(A, kAutomatics) & 0x10) != 0;
  s.exposure_lines = (at(A, kExposure) << 16 | at(A, kExposure + 1) << 8 | at(A, kExposure + 2)) / 64.0;
  s.gain = global_gain(at(A, kGlobalGain)) / global_gain(kGainOne);
  s.red = at(A, kRed) / 64.0;
  s.green = (at(A, kGreen) + at(A, kBlue + 1)) / 128.0;
  s.blue = at(A, kBlue) / 64.0;
  s.target = at(A, kTarget);
  s.brightness = signed_magnitude(at(A, kBrightness));
  s.contrast = at(A, kContrast) / static_cast<double>(kContrastOne);
  for (int i = 0; i < 12; ++i) s.gamma[static_cast<std::size_t>(i)] = at(A, kGamma + i);
  return s;
}

// mirrors, automatics, exposure and gains, which both later kinds have alike
void CameraSensor::set_automatics(SensorSetup& s, int mirror, int automatics, int exposure, Bank gains,
                                  int red) const {
  s.mirror_lines = (at(A, mirror) & 0x80) != 0;
  s.mirror_columns = (at(A, mirror) & 0x40) != 0;
  s.auto_white = (at(C, automatics) & 4) == 0;
  s.auto_exposure = (at(C, automatics) & 1) == 0;
  s.exposure_lines = (static_cast<double>(word(C, exposure)) * 65536 + word(C, exposure + 2)) / 64.0;
  s.red = at(gains, red) / 64.0;
  s.green = at(gains, red + 1) / 64.0;
  s.blue = at(gains, red + 2) / 64.0;
}

SensorSetup CameraSensor::setup_6030() const {
  using namespace po6030;
  SensorSetup s;
  s.sub_sampling = scale_of(at(B, kScale));
  const int format = at(B, kFormat);
  s.format = format == 0x0d   ? SensorSetup::Format::Grey
             : format == 0x02 ? SensorSetup::Format::Yuv
                              : SensorSetup::Format::Rgb565;
  const int clock = at(A, kClock);
  const int divisor = clock == 0xb0 ? 8 : clock == 0x90 ? 4 : clock == 0x50 ? 2 : 1;
  s.pixel_half_cycles = 4 * divisor;
  s.byte_half_cycles = s.pixel_half_cycles * s.sub_sampling / s.bytes_per_pixel();
  s.line_pixels = kPo6030LinePixels;
  s.frame_lines = kPo6030FrameLines;
  s.longest_integration = kLongestFrames * kPo6030FrameLines - kIntegrationMargin;
  s.first_x = (static_cast<std::int16_t>(word(B, kWindowX)) + 2) * s.sub_sampling - kOriginX;
  s.first_y = word(B, kVsync) + s.sub_sampling - kOriginY;
  set_automatics(s, kMirror, kAutomatics, kExposure, C, kRed);
  return s;
}

SensorSetup CameraSensor::setup_8030() const {
  using namespace po8030;
  SensorSetup s;
  s.sub_sampling = scale_of(at(B, kScale));
  const int format = at(B, kFormat);
  s.format = format == 0x43   ? SensorSetup::Format::Grey
             : format == 0x02 ? SensorSetup::Format::Yuv
                              : SensorSetup::Format::Rgb565;
  const int clock = at(A, kClock);
  s.pixel_half_cycles = clock == 5 ? 32 : clock == 4 ? 16 : clock == 2 ? 8 : 4;
  // a line buffer lets the scaled line out at the array's own rate
  s.byte_half_cycles = s.pixel_half_cycles / s.bytes_per_pixel();
  s.line_pixels = kPo8030LinePixels;
  s.frame_lines = kPo8030FrameLines;
  s.longest_integration = kLongestFrames * kPo8030FrameLines - kIntegrationMargin;
  s.first_x = word(A, kWindowX) * s.sub_sampling + s.sub_sampling + (s.sub_sampling == 1 ? 1 : 0);
  s.first_y = 0;  // the library never sets the window's first line
  set_automatics(s, kMirror, kAutomatics, kExposure, A, kRed);
  s.brightness = signed_magnitude(at(B, kBrightness));
  return s;
}

}  // namespace board
