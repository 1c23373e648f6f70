// SPDX-License-Identifier: MIT
// VP9 by libvpx in a WebM file, which is written here: the package of libwebm has no header of its writer, and
// libmatroska cannot be loaded late, which would cost each start 0.9 ms. A cluster begins with each key frame,
// every five seconds of film; segment and cluster have no stated length until they are over, so a file that
// was cut off plays up to its last frame. When the film is finished its length and an index of the clusters
// are put in. Colours: BT.709, 16 to 235, chroma at half the resolution.
#include <vpx/vp8cx.h>
#include <vpx/vpx_encoder.h>

#include <cstring>

#include "sim_core/record/frame_encoder.h"

namespace sim {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kClusterS = 5;             // of film; times in a cluster must stay below 32.7 s
constexpr int kQuality = 24;             // 0 to 63, less is better; thin lines stay sharp
constexpr int kHaste = 8;                // libvpx's cpu-used: 0 slow to 9
constexpr std::size_t kMostCues = 4096;  // of the index; beyond it every other one goes
constexpr std::uint64_t kUnknown = 0x00ffffffffffffff;

// Names of elements. [Matroska, RFC 9559]
enum Id : std::uint32_t {
  kEbml = 0x1A45DFA3,
  kEbmlVersion = 0x4286,
  kEbmlReadVersion = 0x42F7,
  kEbmlMaxId = 0x42F2,
  kEbmlMaxSize = 0x42F3,
  kDocType = 0x4282,
  kDocTypeVersion = 0x4287,
  kDocTypeReadVersion = 0x4285,
  kVoid = 0xEC,
  kSegment = 0x18538067,
  kSeekHead = 0x114D9B74,
  kSeek = 0x4DBB,
  kSeekId = 0x53AB,
  kSeekPosition = 0x53AC,
  kInfo = 0x1549A966,
  kTimestampScale = 0x2AD7B1,
  kDuration = 0x4489,
  kMuxingApp = 0x4D80,
  kWritingApp = 0x5741,
  kTracks = 0x1654AE6B,
  kTrackEntry = 0xAE,
  kTrackNumber = 0xD7,
  kTrackUid = 0x73C5,
  kTrackType = 0x83,
  kFlagLacing = 0x9C,
  kDefaultDuration = 0x23E383,
  kCodecId = 0x86,
  kVideo = 0xE0,
  kFlagInterlaced = 0x9A,
  kPixelWidth = 0xB0,
  kPixelHeight = 0xBA,
  kColour = 0x55B0,
  kMatrix = 0x55B1,
  kRange = 0x55B9,
  kTransfer = 0x55BA,
  kPrimaries = 0x55BB,
  kCluster = 0x1F43B675,
  kTimestamp = 0xE7,
  kSimpleBlock = 0xA3,
  kCues = 0x1C53BB6B,
  kCuePoint = 0xBB,
  kCueTime = 0xB3,
  kCueTrackPositions = 0xB7,
  kCueTrack = 0xF7,
  kCueClusterPosition = 0xF1,
};

void put_big_endian(Bytes& out, std::uint64_t v, int bytes) {
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
    out.push_back(static_cast<std::uint8_t>(v >> shift));
}

void put_id(Bytes& out, Id id) {
  int bytes = 1;
  while (bytes < 4 && id >> (8 * bytes)) ++bytes;
  put_big_endian(out, id, bytes);
}

/// Lengths always take eight bytes, so they can be patched.
Bytes length_field(std::uint64_t size) {
  Bytes out;
  put_big_endian(out, size | 1ull << 56, 8);
  return out;
}

void put(Bytes& out, Id id, const Bytes& content) {
  put_id(out, id);
  const Bytes size = length_field(content.size());
  out.insert(out.end(), size.begin(), size.end());
  out.insert(out.end(), content.begin(), content.end());
}

void put(Bytes& out, Id id, std::uint64_t value) {
  Bytes content;
  put_big_endian(content, value, 8);
  put(out, id, content);
}

void put(Bytes& out, Id id, const char* text) { put(out, id, Bytes(text, text + std::strlen(text))); }

/// An element whose end is not known yet; returns where its content begins.
std::size_t put_open(Bytes& out, Id id) {
  put_id(out, id);
  const Bytes size = length_field(kUnknown);
  out.insert(out.end(), size.begin(), size.end());
  return out.size();
}

class WebmEncoder : public FrameEncoder {
 public:
  WebmEncoder(const std::string& path, int width, int height, int frames_per_s)
      : FrameEncoder(path), width_(width), height_(height), frames_per_s_(frames_per_s) {
    open_codec();
    write_head();
  }

  ~WebmEncoder() override {
    if (open_) vpx_codec_destroy(&codec_);
    vpx_img_free(image_);
  }

  void add(const std::uint32_t* pixels, int stride_px) override {
    if (!open_ || !error().empty()) return;
    convert(pixels, stride_px);
    const bool key = frames_ % (kClusterS * frames_per_s_) == 0;
    if (vpx_codec_encode(&codec_, image_, frames_, 1, key ? VPX_EFLAG_FORCE_KF : 0, VPX_DL_REALTIME) !=
        VPX_CODEC_OK)
      return file_.fail(std::string("libvpx: ") + vpx_codec_error(&codec_));
    const std::int64_t at_ms = time_ms(frames_);
    ++frames_;
    vpx_codec_iter_t iterator = nullptr;
    while (const vpx_codec_cx_pkt_t* packet = vpx_codec_get_cx_data(&codec_, &iterator)) {
      if (packet->kind != VPX_CODEC_CX_FRAME_PKT) continue;
      const bool is_key = packet->data.frame.flags & VPX_FRAME_IS_KEY;
      if (is_key) begin_cluster(at_ms);
      Bytes block{0x81};  // track 1
      put_big_endian(block, static_cast<std::uint64_t>(at_ms - cluster_ms_), 2);
      block.push_back(is_key ? 0x80 : 0);
      const auto* data = static_cast<const std::uint8_t*>(packet->data.frame.buf);
      block.insert(block.end(), data, data + packet->data.frame.sz);
      Bytes out;
      put(out, kSimpleBlock, block);
      file_.append(out);
    }
  }

  void finish() override {
    end_cluster();
    const std::int64_t cues_at = file_.size();
    Bytes cues, index;
    for (const Cue& cue : cues_) {
      Bytes where, point;
      put(where, kCueTrack, 1);
      put(where, kCueClusterPosition, static_cast<std::uint64_t>(cue.at));
      put(point, kCueTime, static_cast<std::uint64_t>(cue.ms));
      put(point, kCueTrackPositions, where);
      put(cues, kCuePoint, point);
    }
    put(index, kCues, cues);
    file_.append(index);
    file_.write_at(seek_head_at_, seek_head(kSeekHead, cues_at - segment_at_));
    file_.write_at(duration_at_, duration(kDuration, static_cast<double>(time_ms(frames_))));
    file_.write_at(segment_at_ - 8, length_field(static_cast<std::uint64_t>(file_.size() - segment_at_)));
    file_.close();
  }

 private:
  struct Cue {
    std::int64_t ms, at;
  };

  std::int64_t time_ms(std::int64_t frame) const { return (2000 * frame / frames_per_s_ + 1) / 2; }

  void open_codec() {
    vpx_codec_enc_cfg_t c;
    vpx_codec_iface_t* vp9 = vpx_codec_vp9_cx();
    vpx_codec_enc_config_default(vp9, &c, 0);
    c.g_w = static_cast<unsigned>(width_);
    c.g_h = static_cast<unsigned>(height_);
    c.g_timebase = {1, frames_per_s_};
    c.g_threads = 1;
    c.g_lag_in_frames = 0;  // each frame comes out at once
    c.rc_end_usage = VPX_Q;
    c.rc_min_quantizer = 0;
    c.rc_max_quantizer = kQuality + 12;
    c.kf_mode = VPX_KF_DISABLED;  // key frames where we say
    image_ = vpx_img_alloc(nullptr, VPX_IMG_FMT_I420, c.g_w, c.g_h, 16);
    if (!image_) return file_.fail("not enough memory for a frame");
    image_->cs = VPX_CS_BT_709;
    image_->range = VPX_CR_STUDIO_RANGE;
    if (vpx_codec_enc_init(&codec_, vp9, &c, 0) != VPX_CODEC_OK)
      return file_.fail(std::string("libvpx: ") + vpx_codec_error(&codec_));
    open_ = true;
    vpx_codec_control(&codec_, VP8E_SET_CPUUSED, kHaste);
    vpx_codec_control(&codec_, VP8E_SET_CQ_LEVEL, kQuality);
    vpx_codec_control(&codec_, VP9E_SET_TUNE_CONTENT, VP9E_CONTENT_SCREEN);
    vpx_codec_control(&codec_, VP9E_SET_COLOR_SPACE, VPX_CS_BT_709);
    vpx_codec_control(&codec_, VP9E_SET_COLOR_RANGE, VPX_CR_STUDIO_RANGE);
  }

  void write_head() {
    Bytes ebml, out;
    put(ebml, kEbmlVersion, 1);
    put(ebml, kEbmlReadVersion, 1);
    put(ebml, kEbmlMaxId, 4);
    put(ebml, kEbmlMaxSize, 8);
    put(ebml, kDocType, "webm");
    put(ebml, kDocTypeVersion, 4);
    put(ebml, kDocTypeReadVersion, 2);
    put(out, kEbml, ebml);
    segment_at_ = static_cast<std::int64_t>(put_open(out, kSegment));
    // room for what is known at the end only
    seek_head_at_ = static_cast<std::int64_t>(out.size());
    const Bytes head = seek_head(kVoid, 0);
    out.insert(out.end(), head.begin(), head.end());
    // What the file is; how long it is comes at the end.
    Bytes info;
    put(info, kTimestampScale, 1'000'000);  // ns: times are in ms
    put(info, kMuxingApp, "twinpuck");
    put(info, kWritingApp, "twinpuck");
    const Bytes room = duration(kVoid, 0);
    info.insert(info.end(), room.begin(), room.end());
    put(out, kInfo, info);
    duration_at_ = static_cast<std::int64_t>(out.size() - room.size());
    // Its one track.
    Bytes colour, video, entry, tracks;
    for (Id id : {kMatrix, kRange, kTransfer, kPrimaries}) put(colour, id, 1);  // BT.709, 16 to 235
    put(video, kFlagInterlaced, 2);                                             // it is not
    put(video, kPixelWidth, static_cast<std::uint64_t>(width_));
    put(video, kPixelHeight, static_cast<std::uint64_t>(height_));
    put(video, kColour, colour);
    put(entry, kTrackNumber, 1);
    put(entry, kTrackUid, 1);
    put(entry, kTrackType, 1);  // video
    put(entry, kFlagLacing, std::uint64_t{0});
    put(entry, kDefaultDuration, static_cast<std::uint64_t>(1'000'000'000 / frames_per_s_));
    put(entry, kCodecId, "V_VP9");
    put(entry, kVideo, video);
    put(tracks, kTrackEntry, entry);
    put(out, kTracks, tracks);
    file_.append(out);
  }

  /// One entry: where the index begins. As kVoid it keeps the room.
  static Bytes seek_head(Id id, std::int64_t position) {
    Bytes name, seek, content, out;
    put_id(name, kCues);
    put(seek, kSeekId, name);
    put(seek, kSeekPosition, static_cast<std::uint64_t>(position));
    put(content, kSeek, seek);
    // the name of an empty place is three bytes shorter
    if (id == kVoid) content.insert(content.end(), 3, 0);
    put(out, id, content);
    return out;
  }

  static Bytes duration(Id id, double ms) {
    std::uint64_t bits;
    std::memcpy(&bits, &ms, sizeof bits);
    Bytes content, out;
    put_big_endian(content, bits, 8);
    if (id == kVoid) content.push_back(0);  // its name is a byte shorter
    put(out, id, content);
    return out;
  }

  void begin_cluster(std::int64_t at_ms) {
    end_cluster();
    Bytes out;
    const std::size_t content = put_open(out, kCluster);
    put(out, kTimestamp, static_cast<std::uint64_t>(at_ms));
    cluster_at_ = file_.size() + static_cast<std::int64_t>(content);
    cluster_ms_ = at_ms;
    cues_.push_back({at_ms, file_.size() - segment_at_});
    if (cues_.size() > kMostCues) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < cues_.size(); i += 2) cues_[kept++] = cues_[i];
      cues_.resize(kept);
    }
    file_.append(out);
  }

  void end_cluster() {
    if (cluster_at_)
      file_.write_at(cluster_at_ - 8, length_field(static_cast<std::uint64_t>(file_.size() - cluster_at_)));
    cluster_at_ = 0;
  }

  /// RGB to Y'CbCr, BT.709 in 256ths; chroma of four pixels together.
  void convert(const std::uint32_t* pixels, int stride_px) {
    for (int y = 0; y < height_; y += 2) {
      for (int x = 0; x < width_; x += 2) {
        int red = 0, green = 0, blue = 0;
        for (int k = 0; k < 4; ++k) {
          const int px = x + (k & 1), py = y + (k >> 1);
          const std::uint32_t c = pixels[static_cast<std::ptrdiff_t>(py) * stride_px + px];
          const int r = c >> 16 & 255, g = c >> 8 & 255, b = c & 255;
          image_->planes[0][py * image_->stride[0] + px] =
              static_cast<std::uint8_t>(16 + ((47 * r + 157 * g + 16 * b + 128) >> 8));
          red += r, green += g, blue += b;
        }
        image_->planes[1][y / 2 * image_->stride[1] + x / 2] =
            static_cast<std::uint8_t>(128 + ((-26 * red - 86 * green + 112 * blue + 512) >> 10));
        image_->planes[2][y / 2 * image_->stride[2] + x / 2] =
            static_cast<std::uint8_t>(128 + ((112 * red - 102 * green - 10 * blue + 512) >> 10));
      }
    }
  }

  int width_, height_, frames_per_s_;
  vpx_codec_ctx_t codec_{};
  bool open_ = false;
  vpx_image_t* image_ = nullptr;
  std::int64_t frames_ = 0;
  std::int64_t segment_at_ = 0, seek_head_at_ = 0, duration_at_ = 0;  // in the file
  std::int64_t cluster_at_ = 0;  // where the open cluster's content begins; 0: none is open
  std::int64_t cluster_ms_ = 0;
  std::vector<Cue> cues_;
};

}  // namespace

std::unique_ptr<FrameEncoder> make_webm_encoder(const std::string& path, int width_px, int height_px,
                                                int frames_per_s) {
  return std::make_unique<WebmEncoder>(path, width_px, height_px, frames_per_s);
}

}  // namespace sim
