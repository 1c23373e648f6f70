// SPDX-License-Identifier: MIT
// Takes the frames of a film one by one and writes each to its file at once: what is in the file can be shown
// even when the program is killed. Needs no more memory for a longer film. The same frames give the same
// bytes: one thread, no clock, no random number.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "sim_core/base/output_file.h"

namespace sim {

class FrameEncoder {
 public:
  explicit FrameEncoder(const std::string& path) : file_(path) {}
  virtual ~FrameEncoder() = default;
  /// The next frame: 0x00RRGGBB, rows from the top, `stride_px` from one to the next.
  virtual void add(const std::uint32_t* pixels, int stride_px) = 0;
  /// Duration and index, where the format has them.
  virtual void finish() = 0;
  const std::string& error() const { return file_.error(); }

 protected:
  OutputFile file_;
};

/// VP9 in WebM. Sides must be even.
std::unique_ptr<FrameEncoder> make_webm_encoder(const std::string& path, int width_px, int height_px,
                                                int frames_per_s);
/// Animated PNG, without loss; played over and over.
std::unique_ptr<FrameEncoder> make_apng_encoder(const std::string& path, int width_px, int height_px,
                                                int frames_per_s);

}  // namespace sim
