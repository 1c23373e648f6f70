// SPDX-License-Identifier: MIT
#include "sim_core/record/frame_feed.h"

namespace sim {

FrameFeed::FrameFeed(std::unique_ptr<FrameEncoder> encoder)
    : encoder_(std::move(encoder)), error_(encoder_->error()), thread_([this] { run(); }) {}

FrameFeed::~FrameFeed() { end(); }

void FrameFeed::end() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  news_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void FrameFeed::run() {
  std::vector<std::uint32_t> frame;
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    news_.wait(lock, [&] { return ending_ || !next_.empty(); });
    if (next_.empty()) return;
    frame.swap(next_);
    next_.clear();
    const int stride_px = stride_px_;  // the next frame may come with another
    news_.notify_all();
    lock.unlock();
    encoder_->add(frame.data(), stride_px);
    lock.lock();
    error_ = encoder_->error();
  }
}

void FrameFeed::add(const std::uint32_t* pixels, int stride_px, int rows) {
  std::unique_lock<std::mutex> lock(mutex_);
  news_.wait(lock, [&] { return next_.empty(); });
  stride_px_ = stride_px;
  next_.assign(pixels, pixels + static_cast<std::ptrdiff_t>(stride_px) * rows);
  news_.notify_all();
}

void FrameFeed::finish() {
  end();
  if (!error_.empty()) return;
  encoder_->finish();
  error_ = encoder_->error();
}

std::string FrameFeed::error() {
  std::lock_guard<std::mutex> lock(mutex_);
  return error_;
}

}  // namespace sim
