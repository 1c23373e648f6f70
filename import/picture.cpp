// SPDX-License-Identifier: MIT
// PNG is read by the loader of floor pictures, JPEG by libjpeg, scaled down to an eighth while it is decoded.
#include "import/picture.h"

#include <csetjmp>
// libjpeg wants FILE to be known
#include <jpeglib.h>

#include <vector>

#include "sim_core/base/input_file.h"
#include "sim_core/load/floor_image.h"

namespace wbt {
namespace {

constexpr std::size_t kLongestPicture = 64u << 20;  // bytes
constexpr unsigned long kMostPixels = 64'000'000;
constexpr int kMostScans = 100;  // of a progressive picture; a handful is usual

struct JpegError {
  jpeg_error_mgr base;
  std::jmp_buf back;
};

void give_up(j_common_ptr info) { std::longjmp(reinterpret_cast<JpegError*>(info->err)->back, 1); }
void keep_quiet(j_common_ptr) {}
// a few bytes may ask for thousands of scans over the whole picture
void count_scans(j_common_ptr info) {
  if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number > kMostScans) give_up(info);
}

// no objects with destructors live between setjmp and longjmp here
bool read_jpeg(const std::string& bytes, std::vector<unsigned char>& row, double* sum, double& pixels) {
  jpeg_decompress_struct info;
  jpeg_progress_mgr progress{};
  progress.progress_monitor = count_scans;
  JpegError error;
  info.err = jpeg_std_error(&error.base);
  error.base.error_exit = give_up;
  error.base.output_message = keep_quiet;
  if (setjmp(error.back)) {
    jpeg_destroy_decompress(&info);
    return false;
  }
  // It is read at an eighth of its size, which is enough for its mean colour.
  jpeg_create_decompress(&info);
  info.progress = &progress;
  jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&info, TRUE);
  if (static_cast<unsigned long>(info.image_width) * info.image_height > kMostPixels)
    give_up(reinterpret_cast<j_common_ptr>(&info));
  info.out_color_space = JCS_RGB;
  info.scale_num = 1;
  info.scale_denom = 8;
  jpeg_start_decompress(&info);
  row.resize(static_cast<std::size_t>(info.output_width) * 3);
  while (info.output_scanline < info.output_height) {
    unsigned char* line = row.data();
    jpeg_read_scanlines(&info, &line, 1);
    for (std::size_t i = 0; i < row.size(); ++i) sum[i % 3] += row[i];
    pixels += info.output_width;
  }
  jpeg_finish_decompress(&info);
  jpeg_destroy_decompress(&info);
  return true;
}

}  // namespace

std::optional<sim::Colour> average_colour(const std::string& name) {
  std::string bytes;
  if (!sim::read_input_file(name, kLongestPicture, bytes).empty()) return std::nullopt;
  return average_colour_of(bytes);
}

std::optional<sim::Colour> average_colour_of(const std::string& bytes) {
  double sum[3] = {0, 0, 0}, pixels = 0;
  if (bytes.compare(0, 2, "\xFF\xD8") == 0) {
    std::vector<unsigned char> row;
    if (!read_jpeg(bytes, row, sum, pixels)) return std::nullopt;
  } else {
    sim::FloorDesc floor;
    if (!sim::parse_floor_image(bytes, floor).empty()) return std::nullopt;
    for (std::size_t i = 0; i < floor.image_rgb.size(); ++i) sum[i % 3] += floor.image_rgb[i];
    pixels = static_cast<double>(floor.image_rgb.size()) / 3;
  }
  if (!(pixels > 0)) return std::nullopt;
  return sim::Colour{sum[0] / pixels / 255, sum[1] / pixels / 255, sum[2] / pixels / 255};
}

}  // namespace wbt
