// SPDX-License-Identifier: MIT
// Animated PNG [PNG-3 11.3.6]: a frame holds what differs from the one before. The end
// chunk is written after each frame and overwritten by the next, and the number of frames is kept up to date,
// so the file is whole at any time.
#include <zlib.h>

#include <algorithm>

#include "sim_core/record/frame_encoder.h"

namespace sim {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kCompression = 6;                    // zlib's own default, spelled out: the bytes depend on it
constexpr std::uint32_t kMostFrames = 0x3fffffff;  // sequence numbers, two a frame, have 31 bits

void put32(Bytes& out, std::uint32_t v) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(v >> shift));
}

void put16(Bytes& out, std::uint32_t v) {
  out.push_back(static_cast<std::uint8_t>(v >> 8));
  out.push_back(static_cast<std::uint8_t>(v));
}

void put_chunk(Bytes& out, const char* type, const Bytes& data) {
  put32(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t from = out.size();
  out.insert(out.end(), type, type + 4);
  out.insert(out.end(), data.begin(), data.end());
  put32(out,
        static_cast<std::uint32_t>(crc32(0, out.data() + from, static_cast<unsigned>(out.size() - from))));
}

class ApngEncoder : public FrameEncoder {
 public:
  ApngEncoder(const std::string& path, int width, int height, int frames_per_s)
      : FrameEncoder(path), width_(width), height_(height), frames_per_s_(frames_per_s) {
    Bytes head{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    Bytes size;
    put32(size, static_cast<std::uint32_t>(width));
    put32(size, static_cast<std::uint32_t>(height));
    size.insert(size.end(), {8, 6, 0, 0, 0});  // eight bits a channel, RGBA
    put_chunk(head, "IHDR", size);
    file_.append(head);
    control_at_ = file_.size();
    file_.append(control());
  }

  void add(const std::uint32_t* pixels, int stride_px) override {
    if (frames_ >= kMostFrames) return file_.fail("got too many frames for an animated PNG, expected fewer");
    // Only what has changed is in a frame.
    Box box{0, 0, width_, height_};
    if (frames_) box = changed(pixels, stride_px);
    const std::vector<std::uint32_t> before = last_;
    last_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (int y = 0; y < height_; ++y)
      std::copy_n(pixels + static_cast<std::ptrdiff_t>(y) * stride_px, width_,
                  last_.begin() + static_cast<std::ptrdiff_t>(y) * width_);
    // How it is shown, then its pixels.
    Bytes frame;
    put32(frame, sequence_++);
    for (int v : {box.right - box.left, box.bottom - box.top, box.left, box.top})
      put32(frame, static_cast<std::uint32_t>(v));
    put16(frame, 1);  // a frame lasts 1 / frames_per_s
    put16(frame, static_cast<std::uint32_t>(frames_per_s_));
    frame.insert(frame.end(), {0, 1});  // stays, lies over what is there
    Bytes out;
    put_chunk(out, "fcTL", frame);
    if (frames_ == 0) {
      put_chunk(out, "IDAT", packed(box, before));
    } else {
      Bytes data;
      put32(data, sequence_++);
      const Bytes rows = packed(box, before);
      data.insert(data.end(), rows.begin(), rows.end());
      put_chunk(out, "fdAT", data);
    }
    // The file is whole after each frame: the end follows at once, and the next frame takes its place.
    const std::int64_t end = file_.size() + static_cast<std::int64_t>(out.size());
    Bytes last;
    put_chunk(last, "IEND", {});
    out.insert(out.end(), last.begin(), last.end());
    file_.append(out, frames_ ? last : Bytes());
    if (!error().empty()) return;
    file_.set_size(end);
    ++frames_;
    file_.write_at(control_at_, control());
  }

  void finish() override { file_.close(); }

 private:
  struct Box {
    int left, top, right, bottom;
  };

  Bytes control() const {
    Bytes data, out;
    put32(data, std::max(frames_, 1u));
    put32(data, 0);  // over and over
    put_chunk(out, "acTL", data);
    return out;
  }

  /// At least one pixel, since an empty frame does not exist.
  Box changed(const std::uint32_t* pixels, int stride_px) const {
    Box box{width_, height_, 0, 0};
    for (int y = 0; y < height_; ++y) {
      const std::uint32_t* now = pixels + static_cast<std::ptrdiff_t>(y) * stride_px;
      const std::uint32_t* before = last_.data() + static_cast<std::ptrdiff_t>(y) * width_;
      for (int x = 0; x < width_; ++x) {
        if ((now[x] ^ before[x]) & 0xffffff) {
          box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1), y + 1};
        }
      }
    }
    return box.right ? box : Box{0, 0, 1, 1};
  }

  /// Rows of the last frame, unfiltered: drawings have even areas. What has not changed is transparent.
  Bytes packed(const Box& box, const std::vector<std::uint32_t>& before) const {
    Bytes rows;
    rows.reserve(static_cast<std::size_t>((4 * (box.right - box.left) + 1) * (box.bottom - box.top)));
    for (int y = box.top; y < box.bottom; ++y) {
      rows.push_back(0);
      for (int x = box.left; x < box.right; ++x) {
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
        const std::uint32_t c = last_[at];
        if (!before.empty() && !((c ^ before[at]) & 0xffffff)) {
          rows.insert(rows.end(), {0, 0, 0, 0});
        } else {
          rows.insert(rows.end(), {static_cast<std::uint8_t>(c >> 16), static_cast<std::uint8_t>(c >> 8),
                                   static_cast<std::uint8_t>(c), 255});
        }
      }
    }
    uLongf size = compressBound(static_cast<uLong>(rows.size()));
    Bytes out(size);
    compress2(out.data(), &size, rows.data(), static_cast<uLong>(rows.size()), kCompression);
    out.resize(size);
    return out;
  }

  int width_, height_, frames_per_s_;
  std::int64_t control_at_ = 0;
  std::uint32_t frames_ = 0, sequence_ = 0;
  std::vector<std::uint32_t> last_;
};

}  // namespace

std::unique_ptr<FrameEncoder> make_apng_encoder(const std::string& path, int width_px, int height_px,
                                                int frames_per_s) {
  return std::make_unique<ApngEncoder>(path, width_px, height_px, frames_per_s);
}

}  // namespace sim
