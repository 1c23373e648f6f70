// SPDX-License-Identifier: MIT
// Feeds an encoder on a thread of its own, so that the next frame is drawn while the last one is compressed.
// Frames come out in the order in which they were given: the file is the same bytes as without a thread.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "sim_core/record/frame_encoder.h"

namespace sim {

class FrameFeed {
 public:
  explicit FrameFeed(std::unique_ptr<FrameEncoder> encoder);
  ~FrameFeed();
  FrameFeed(const FrameFeed&) = delete;
  FrameFeed& operator=(const FrameFeed&) = delete;

  /// Copies `rows` rows; waits while the frame before has not been taken up.
  void add(const std::uint32_t* pixels, int stride_px, int rows);
  /// All frames are in the file, and it is whole. Nothing may be added any more.
  void finish();
  /// The encoder's, of the frames that are done.
  std::string error();

 private:
  void run();
  void end();

  std::unique_ptr<FrameEncoder> encoder_;
  std::mutex mutex_;
  std::condition_variable news_;
  std::vector<std::uint32_t> next_;  // empty: room for a frame
  int stride_px_ = 0;
  bool ending_ = false;
  std::string error_;
  std::thread thread_;
};

}  // namespace sim
