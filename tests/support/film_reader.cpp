// SPDX-License-Identifier: MIT
#include "tests/support/film_reader.h"

#include <vpx/vp8dx.h>
#include <vpx/vpx_decoder.h>
#include <webm/callback.h>
#include <webm/file_reader.h>
#include <webm/status.h>
#include <webm/webm_parser.h>
#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>

namespace film_test {
namespace {

class Collector : public webm::Callback {
 public:
  explicit Collector(Read& film) : film_(film) {
    vpx_codec_dec_init(&codec_, vpx_codec_vp9_dx(), nullptr, 0);
  }
  ~Collector() override { vpx_codec_destroy(&codec_); }

  webm::Status OnInfo(const webm::ElementMetadata&, const webm::Info& info) override {
    if (info.duration.is_present()) film_.duration_s = info.duration.value() / 1000;
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnTrackEntry(const webm::ElementMetadata&, const webm::TrackEntry& track) override {
    if (track.codec_id.value() != "V_VP9") film_.error = "codec " + track.codec_id.value();
    film_.width_px = static_cast<int>(track.video.value().pixel_width.value());
    film_.height_px = static_cast<int>(track.video.value().pixel_height.value());
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnCuePoint(const webm::ElementMetadata&, const webm::CuePoint&) override {
    film_.has_index = true;
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnClusterBegin(const webm::ElementMetadata&, const webm::Cluster& cluster,
                              webm::Action* action) override {
    cluster_ms_ = static_cast<double>(cluster.timecode.value());
    *action = webm::Action::kRead;
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnSimpleBlockBegin(const webm::ElementMetadata&, const webm::SimpleBlock& block,
                                  webm::Action* action) override {
    block_ms_ = cluster_ms_ + block.timecode;
    *action = webm::Action::kRead;
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnFrame(const webm::FrameMetadata&, webm::Reader* reader, std::uint64_t* left) override {
    std::uint8_t buffer[4096];
    while (*left) {
      std::uint64_t got = 0;
      const auto status =
          reader->Read(static_cast<std::size_t>(std::min<std::uint64_t>(*left, sizeof buffer)), buffer, &got);
      data_.insert(data_.end(), buffer, buffer + got);
      *left -= got;
      if (!status.completed_ok() && status.code != webm::Status::kOkPartial) return status;
    }
    decode();
    data_.clear();
    return webm::Status(webm::Status::kOkCompleted);
  }

 private:
  void decode() {
    if (vpx_codec_decode(&codec_, data_.data(), static_cast<unsigned>(data_.size()), nullptr, 0) !=
        VPX_CODEC_OK)
      film_.error = vpx_codec_error(&codec_);
    vpx_codec_iter_t iterator = nullptr;
    while (const vpx_image_t* image = vpx_codec_get_frame(&codec_, &iterator)) {
      if (static_cast<int>(image->d_w) != film_.width_px || static_cast<int>(image->d_h) != film_.height_px)
        film_.error = "a frame has another size than the track";
      film_.time_s.push_back(block_ms_ / 1000);
      film_.rgb.push_back(rgb_of(*image));
    }
  }

  // BT.709, 16 to 235 [ITU-R BT.709]
  static std::vector<std::uint8_t> rgb_of(const vpx_image_t& image) {
    std::vector<std::uint8_t> rgb;
    for (unsigned y = 0; y < image.d_h; ++y) {
      for (unsigned x = 0; x < image.d_w; ++x) {
        const auto plane = [&](int p, unsigned px, unsigned py) {
          return static_cast<double>(
              image.planes[p][static_cast<int>(py) * image.stride[p] + static_cast<int>(px)]);
        };
        const double luma = 1.164 * (plane(0, x, y) - 16), cb = plane(1, x / 2, y / 2) - 128,
                     cr = plane(2, x / 2, y / 2) - 128;
        for (double v : {luma + 1.793 * cr, luma - 0.213 * cb - 0.533 * cr, luma + 2.112 * cb})
          rgb.push_back(static_cast<std::uint8_t>(std::clamp(v + 0.5, 0.0, 255.0)));
      }
    }
    return rgb;
  }

  Read& film_;
  vpx_codec_ctx_t codec_{};
  double cluster_ms_ = 0, block_ms_ = 0;
  std::vector<std::uint8_t> data_;
};

std::uint32_t big_endian(const std::uint8_t* p) {
  return static_cast<std::uint32_t>(p[0]) << 24 | static_cast<std::uint32_t>(p[1]) << 16 |
         static_cast<std::uint32_t>(p[2]) << 8 | p[3];
}

}  // namespace

Read read_webm(const std::string& path) {
  Read film;
  FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) {
    film.error = "cannot be opened";
    return film;
  }
  webm::FileReader reader(file);
  Collector collector(film);
  webm::WebmParser parser;
  const webm::Status status = parser.Feed(&collector, &reader);
  if (!status.completed_ok() && film.error.empty())
    film.error = "parser: " + std::to_string(static_cast<int>(status.code));
  return film;
}

Read read_apng(const std::string& path) {
  Read film;
  std::ifstream in(path, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
  const auto bad = [&](const std::string& what) {
    if (film.error.empty()) film.error = what;
  };
  if (bytes.size() < 8 || std::memcmp(bytes.data(), "\x89PNG\r\n\x1a\n", 8) != 0) return bad("no PNG"), film;
  std::uint32_t stated = 0, sequence = 0, width = 0, height = 0, left = 0, top = 0;
  double now_s = 0, delay_s = 0;
  std::vector<std::uint8_t> screen, packed;
  bool ended = false;
  const auto show = [&] {
    if (packed.empty()) return;
    std::vector<std::uint8_t> rows((4 * width + 1) * static_cast<std::size_t>(height));
    uLongf size = static_cast<uLongf>(rows.size());
    if (uncompress(rows.data(), &size, packed.data(), static_cast<uLong>(packed.size())) != Z_OK ||
        size != rows.size())
      return bad("data of a frame");
    packed.clear();
    for (std::uint32_t y = 0; y < height; ++y) {
      const std::uint8_t* row = rows.data() + y * (4 * width + 1);
      if (row[0] != 0) return bad("a filter");
      for (std::uint32_t x = 0; x < width; ++x) {
        const std::uint8_t* c = row + 1 + 4 * x;
        if (c[3] == 255)
          std::copy_n(c, 3,
                      screen.data() + 3 * ((top + y) * static_cast<std::uint32_t>(film.width_px) + left + x));
      }
    }
    film.time_s.push_back(now_s);
    film.rgb.push_back(screen);
    now_s += delay_s;
  };
  for (std::size_t at = 8; at + 12 <= bytes.size() && film.error.empty();) {
    const std::uint32_t size = big_endian(&bytes[at]);
    if (at + 12 + size > bytes.size()) return bad("cut off"), film;
    const std::string type(bytes.begin() + static_cast<long>(at) + 4,
                           bytes.begin() + static_cast<long>(at) + 8);
    const std::uint8_t* data = &bytes[at + 8];
    if (crc32(0, &bytes[at + 4], size + 4) != big_endian(data + size)) return bad("sum of " + type), film;
    if (ended) bad("something behind the end");
    if (type == "IHDR") {
      film.width_px = static_cast<int>(big_endian(data));
      film.height_px = static_cast<int>(big_endian(data + 4));
      if (data[8] != 8 || data[9] != 6) bad("not eight bits RGBA");
      screen.assign(3 * static_cast<std::size_t>(film.width_px) * static_cast<std::size_t>(film.height_px),
                    0);
    } else if (type == "acTL") {
      stated = big_endian(data);
    } else if (type == "fcTL") {
      show();
      if (big_endian(data) != sequence++) bad("sequence number");
      width = big_endian(data + 4), height = big_endian(data + 8);
      left = big_endian(data + 12), top = big_endian(data + 16);
      delay_s = double(data[20] << 8 | data[21]) / (data[22] << 8 | data[23]);
      if (data[24] != 0 || data[25] != 1) bad("disposal or blending");
      if (left + width > static_cast<std::uint32_t>(film.width_px) ||
          top + height > static_cast<std::uint32_t>(film.height_px) || !width || !height)
        bad("a frame's place");
    } else if (type == "IDAT") {
      packed.insert(packed.end(), data, data + size);
    } else if (type == "fdAT") {
      if (big_endian(data) != sequence++) bad("sequence number");
      packed.insert(packed.end(), data + 4, data + size);
    } else if (type == "IEND") {
      show();
      ended = true;
    }
    at += 12 + size;
  }
  if (!ended) bad("no end");
  if (stated != film.rgb.size()) bad("another number of frames than stated");
  film.duration_s = now_s;
  return film;
}

}  // namespace film_test
