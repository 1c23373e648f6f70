// SPDX-License-Identifier: MIT
// A film of a run: the map with robots, their last ways, LEDs, labels and the time, at exact multiples of
// simulated time. Poses are interpolated to the frame's instant; LEDs and heights are those of the tick that
// follows it. Frames are written as they come: WebM (VP9) or animated PNG by the file's ending.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "sim_core/record/picture.h"

namespace sim {

class Canvas;
class FrameFeed;
class Legend;
struct MapPlace;

struct FilmOptions {
  int frames_per_s = 25;     ///< of film, 1 to 100
  double speed = 1;          ///< simulated seconds in a second of film, above 0
  int size_px = 640;         ///< the longer side of a frame, 160 to 4096
  double trail_s = 10;       ///< how far back, in simulated seconds, a robot's trail reaches; 0: no trails
  bool sensor_rays = false;  ///< as in a picture
};

class Film {
 public:
  /// Opens the file; error() tells whether it could.
  Film(const std::string& path, const Scene& scene, const FilmOptions& options = {});
  ~Film();
  /// Call before the first step and after every step. Draws the frames that are due, the first
  /// one at the first call.
  void sample(const Scene& scene, const Minds& minds, const std::vector<PictureLabel>& labels = {});
  /// Whether sample() at `now` will draw, and so show its labels.
  bool is_due(Clicks now) const { return time_of(frame_) <= now; }
  /// A robot was put somewhere else: its trail is broken there.
  void lift_pen(int robot) { trails_.lift_pen(robot); }
  /// Length and index are put in; until then the file holds what was filmed so far.
  void finish();

  /// Whether a file of this name can become a film: .webm, .png, .apng.
  static bool is_film(const std::string& path);
  /// First error, or empty.
  const std::string& error() const { return error_; }
  int width_px() const;
  int height_px() const;

 private:
  void draw(Clicks at, const Scene& scene, const Minds& minds, const std::vector<PictureLabel>& labels);
  Clicks time_of(std::int64_t frame) const;

  FilmOptions options_;
  Trails trails_;
  std::int64_t frame_ = 0;  // the next one
  std::unique_ptr<Legend> legend_;
  std::unique_ptr<MapPlace> place_;
  std::unique_ptr<Canvas> canvas_;
  std::unique_ptr<FrameFeed> feed_;  // the encoder's
  std::string error_;
};

}  // namespace sim
