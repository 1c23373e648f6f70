// SPDX-License-Identifier: MIT
// The control side of the three image sensors: registers on the I2C bus at 0xDC, and what they mean.
//
//   PO3030K   one bank                      PO6030K, PO8030D   banks A to D, chosen by register 3
//
// Modelled: identity, window, sub-sampling, format, clock, mirrors, exposure and gains by hand, switches of
// the automatics, brightness, contrast, gamma (PO3030K). Stored without effect: colour matrix, sepia, edges,
// lens, flicker, weights, sketch, bias. Reading gives back what was written, also for what the automatics
// change. Source: [lib: camera/], facts restated; [measured: ..] and [derived: ..] in camera_params.h.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "hal_sim/board/i2c_device.h"

namespace board {

enum class CameraKind { None, Po3030k, Po6030k, Po8030d };

/// What registers ask of the picture.
struct SensorSetup {
  enum class Format { Grey, Rgb565, Yuv };
  Format format = Format::Rgb565;
  int sub_sampling = 1;           ///< 1, 2, 4: pixels and lines of the array per pixel and line that come out
  int pixel_half_cycles = 8;      ///< clock of the array, half instruction cycles per pixel
  int byte_half_cycles = 16;      ///< half instruction cycles per byte on the data pins
  int line_pixels = 852;          ///< whole line, blanking included, pixels of the array
  int frame_lines = 852;          ///< whole frame, blanking included, unless a long exposure stretches it
  int longest_integration = 998;  ///< lines
  int first_x = 0,
      first_y = 0;  ///< array pixel of a line's first byte that the driver can take; first line after VSYNC
  bool mirror_columns = false, mirror_lines = false;
  bool auto_exposure = true, auto_white = true;
  double exposure_lines = 998;                    ///< by hand: integration times gain, lines
  double gain = 1, red = 1, green = 1, blue = 1;  ///< by hand
  int target = 0x70;                              ///< of the automatic exposure, counts
  double brightness = 0;                          ///< counts
  double contrast = 1;
  std::array<std::uint8_t, 12> gamma{};  ///< output at kGammaAt

  int bytes_per_pixel() const { return format == Format::Grey ? 1 : 2; }
  Cycle line_cycles() const { return Cycle{line_pixels} * pixel_half_cycles / 2; }
};

/// Inputs (of 256) at which the gamma table has its values; 256 gives 255.
/// [derived: the library's table is x to the power of 0.65 there]
inline constexpr int kGammaAt[12] = {0, 8, 16, 24, 32, 48, 64, 96, 128, 160, 192, 224};

class CameraSensor final : public I2cRegisters {
 public:
  explicit CameraSensor(CameraKind kind);

  CameraKind kind() const { return kind_; }
  /// The reset pin was pulled: registers as after power-up.
  void reset(Cycle at);
  SensorSetup setup() const;
  /// Grows with every write; `written_at` is the last one's cycle.
  std::uint64_t version() const { return version_; }
  Cycle written_at() const { return written_at_; }
  std::uint64_t state_hash() const override { return hash_; }

 protected:
  bool write_register(std::uint8_t number, std::uint8_t value, Cycle at) override;
  std::uint8_t read_register(std::uint8_t number, Cycle at) override;

 private:
  enum Bank { A, B, C, D };
  std::uint8_t at(Bank bank, int number) const {
    for (const Register& r : banks_[static_cast<std::size_t>(bank)])
      if (r.number == number) return r.value;
    return 0;
  }
  void put(Bank bank, int number, int value);
  int word(Bank bank, int high) const { return at(bank, high) << 8 | at(bank, high + 1); }
  SensorSetup setup_3030() const;
  SensorSetup setup_6030() const;
  void set_automatics(SensorSetup& s, int mirror, int automatics, int exposure, Bank gains, int red) const;
  SensorSetup setup_8030() const;

  CameraKind kind_;
  struct Register {
    std::uint8_t number, value;
  };
  std::array<std::vector<Register>, 4> banks_;  // those that are not 0, or were written
  int bank_ = 0;
  std::uint64_t version_ = 0;
  Cycle written_at_ = 0;
  std::uint64_t hash_ = 0;  // of everything written
};

}  // namespace board
