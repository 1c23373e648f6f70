// SPDX-License-Identifier: MIT
// Takes the frames of a film one by one and writes each to its file at once: what is in the file can be shown
// even when the program is killed. Needs no more memory for a longer film. The same frames give the same
// bytes: one thread, no clock, no random number.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sim {

/// A file that is written at its end and patched in places; remembers the first error.
class FilmFile {
 public:
  explicit FilmFile(std::string path);
  ~FilmFile();
  FilmFile(const FilmFile&) = delete;
  FilmFile& operator=(const FilmFile&) = delete;
  /// Writes all of it, or notes why not.
  void write_at(std::int64_t at, const std::vector<std::uint8_t>& bytes);
  /// All of it or, when that fails, nothing of it; `end` is what the file then ends with.
  void append(const std::vector<std::uint8_t>& bytes, const std::vector<std::uint8_t>& end = {});
  /// Bytes so far: where append() writes.
  std::int64_t size() const { return size_; }
  /// Cuts off or goes on: where append() writes from now on.
  void set_size(std::int64_t size) { size_ = size; }
  void close();
  void fail(const std::string& reason);
  /// "PATH: cannot be written: reason", or empty.
  const std::string& error() const { return error_; }

 private:
  std::string path_, error_;
  int file_ = -1;
  std::int64_t size_ = 0;
};

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
  FilmFile file_;
};

/// VP9 in WebM. Sides must be even.
std::unique_ptr<FrameEncoder> make_webm_encoder(const std::string& path, int width_px, int height_px,
                                                int frames_per_s);
/// Animated PNG, without loss; played over and over.
std::unique_ptr<FrameEncoder> make_apng_encoder(const std::string& path, int width_px, int height_px,
                                                int frames_per_s);

}  // namespace sim
