// SPDX-License-Identifier: MIT
// The robot's camera: sensor, lens, and the picture on its way into the processor.
//
//   CAM_RESET, I2C 0xDC -> CameraSensor (registers) -> SensorSetup
//   VSYNC, HREF (interrupts of timers 5 and 4) <- frames and lines of SensorSetup's clock
//   world -> sim::render_camera -> exposure, gains, noise, gamma -> 8 bits -> RGB565, grey, YUV -> data pins
//
// Frames follow one another without end; none is computed before somebody takes a line. Lines are rendered at
// the instant at which they begin, kRowsAtOnce of those that are taken at a time. The automatics are a loop
// over frames, evaluated when a frame begins that is captured, for all the frames since the last one, with
// what the camera sees now:
//   exposure: times clamp(target / mean, 1/2, 2) per frame, target and mean as light, until within 6 %
//   white:    red and blue gain a quarter of the way per frame to where nearly grey pixels are grey
// Not modelled: motion blur, the Bayer pattern, lens distortion and shading, crosstalk of colours,
// flicker of lamps.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "hal_sim/board/camera_params.h"
#include "hal_sim/board/camera_sensor.h"
#include "hal_sim/board/first_use.h"
#include "sim_core/camera/camera.h"

namespace board {

class Specimen;

/// How the sensor sits in the robot; e_poxxxx_get_orientation() answers 1, 0, 2.
enum class CameraMount {
  Upright,   ///< pictures are upright with the mirrors that e_poxxxx_init_cam() sets
  Sideways,  ///< then turned by a quarter: lines of the picture run down the scene, the first one at its
             ///< right
  Inverted,  ///< turned by a half
};

/// A picture that a program has just got, for whoever wants to keep it.
struct CameraPicture {
  SensorSetup::Format format;
  int columns, rows;
  std::int64_t number;              ///< of this robot's completed pictures, from 1
  Cycle at;                         ///< cycle of its last line
  std::vector<std::uint8_t> bytes;  ///< what was taken
  /// Its edges as tangents of directions from the lens: left, right, low, high.
  std::array<double, 4> edges{};
};

/// The bytes the program got as colours, three bytes a pixel, rows from the top: 565 widened to eight bits by
/// repeating its upper bits, grey as it is, YUV with the chroma of its neighbours.
std::vector<std::uint8_t> decode_picture(const CameraPicture& picture);

class Camera {
 public:
  /// First await_frame().
  FirstUse first_use;

  /// `board` outlives the camera. The sensor belongs to the board's I2C bus.
  Camera(const Specimen& robot, CameraSensor& sensor, CameraMount mount, double noise);

  /// What somebody takes of a frame as it comes over the data pins.
  struct Cut {
    std::vector<int> bytes;  ///< of a line, by their place in it, from 0, ascending
    int columns = 0;         ///< pixels that these are
    int rows = 0;            ///< lines, from the frame's first one
    int row_step = 1;        ///< from one that is taken to the next
    bool is_picture = true;  ///< the last one completes a picture; else note_picture() tells of it
  };
  /// What a program has made of a frame of which all was taken: a rectangle of it, by places in the cut.
  struct Part {
    int first_column = 0, last_column = 0, columns = 0;
    int first_row = 0, last_row = 0, rows = 0;
  };
  /// Another lens: its focal length in pixels of the array.
  void set_focal_px(double focal_px) { focal_px_ = focal_px; }
  /// Somebody waits for a frame. Returns the cycle of the next VSYNC.
  Cycle await_frame(Cycle at);
  /// As the sensor is set at `at`.
  const SensorSetup& setup_at(Cycle at) {
    refresh(at);
    return now_;
  }
  /// VSYNC has come: the frame is exposed as the sensor is set now, and this is taken of it.
  void begin_frame(Cut cut, Cycle at);
  /// HREF of a line of the cut, from 0.
  Cycle line_at(int row) const { return first_line_ + row * cut_.row_step * line_cycles_; }
  /// Puts that line's bytes to `to`; there must be such a line. `at`: when it was taken.
  void put_line(int row, std::uint8_t* to, Cycle at);

  /// A program has got this from the data pins, the last byte at `at`.
  void note_picture(const Part& part, std::vector<std::uint8_t> bytes, Cycle at);

  /// Grows whenever frames may have got another beginning or length.
  std::uint64_t timing() const { return sensor_.version() + exposed_; }
  Cycle frame_cycles() const;
  /// A VSYNC from which frames are counted, as the sensor is set at `at`.
  Cycle frame_origin(Cycle at) {
    refresh(at);
    return frame_start_;
  }
  SensorSetup setup() const;
  double exposure_s() const { return exposure_s_; }
  CameraMount mount() const { return mount_; }
  std::int64_t pictures() const { return pictures_; }
  /// As CameraPicture's, of all that the sensor could see.
  std::array<double, 4> widest_edges() const;

  void sensor_reset(Cycle at);
  /// As when it was switched on, at `at`: registers, frames, automatics, noise.
  void begin_again(Cycle at);
  bool is_used() const { return awaited_ > 0; }
  std::uint64_t state_hash() const { return hash_; }

  /// Told every completed picture on the thread that runs the robot.
  std::function<void(const CameraPicture&)> on_picture;

 private:
  struct Byte {
    std::uint16_t pixel;  // index into columns_
    std::uint8_t part;    // 0 or 1
    bool odd;             // its place in the line, for YUV
  };
  void refresh(Cycle at);
  void plan_line();
  std::array<double, 2> scale() const;
  std::array<double, 4> edges(const Part& part) const;
  void run_automatics(std::int64_t frames, Cycle at);
  void render(const std::vector<double>& x, const std::vector<double>& y, Cycle at);
  void make_curve();
  std::array<std::uint8_t, 3> develop(const sim::Light& light, std::uint64_t pixel) const;
  void render_rows(int first_row, Cycle at);

  const Specimen& robot_;
  CameraSensor& sensor_;
  CameraMount mount_;
  double focal_px_ = kFocalPx;
  double noise_;

  SensorSetup now_;  // registers as last looked at
  std::uint64_t seen_version_ = 0;
  Cycle frame_start_ = 0;  // a VSYNC, from which frames are counted
  double exposure_s_;
  double auto_red_ = 1, auto_blue_ = 1;

  Cut cut_;
  SensorSetup taken_;                       // of the frame being captured
  double scale_[3] = {};                    // light to share of full scale, per colour
  Cycle first_line_ = 0, line_cycles_ = 0;  // HREF of the cut's first line; from a line to the next
  std::vector<Byte> line_;
  std::vector<double> columns_;     // array x of the pixels that are taken
  std::vector<double> lines_;       // scratch: array y
  std::vector<double> right_, up_;  // scratch: tangents
  std::vector<sim::Light> light_;
  bool transposed_ = false;  // light_ holds columns of the scene as rows of the picture
  int first_rendered_ = 0, rendered_ = 0;
  std::vector<std::uint8_t> curve_;  // gamma, contrast, brightness
  std::uint64_t curve_version_ = 0;
  std::vector<std::uint8_t> picture_;
  std::int64_t pictures_ = 0;
  std::int64_t awaited_ = 0;
  std::int64_t awaited_before_ = 0;  // it began again
  std::uint64_t exposed_ = 0;        // frames, and resets of the exposure
  std::uint64_t hash_ = 0;
};

}  // namespace board
