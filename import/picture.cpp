// SPDX-License-Identifier: MIT
// PNG is read by the loader of floor pictures, JPEG by libjpeg, scaled down to an eighth while it is decoded.
#include "import/picture.h"

#include <csetjmp>
#include <cstdio>
// libjpeg wants FILE to be known
#include <jpeglib.h>

#include <memory>
#include <vector>

#include "sim_core/load/floor_image.h"

namespace wbt {
namespace {

struct JpegError {
  jpeg_error_mgr base;
  std::jmp_buf back;
};

void give_up(j_common_ptr info) { std::longjmp(reinterpret_cast<JpegError*>(info->err)->back, 1); }
void keep_quiet(j_common_ptr) {}

// no objects with destructors live between setjmp and longjmp here
bool read_jpeg(std::FILE* file, std::vector<unsigned char>& row, double* sum, double& pixels) {
  jpeg_decompress_struct info;
  JpegError error;
  info.err = jpeg_std_error(&error.base);
  error.base.error_exit = give_up;
  error.base.output_message = keep_quiet;
  if (setjmp(error.back)) {
    jpeg_destroy_decompress(&info);
    return false;
  }
  jpeg_create_decompress(&info);
  jpeg_stdio_src(&info, file);
  jpeg_read_header(&info, TRUE);
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
  double sum[3] = {0, 0, 0}, pixels = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name.c_str(), "rb"), std::fclose);
  if (!file) return std::nullopt;
  unsigned char magic[2] = {0, 0};
  if (std::fread(magic, 1, 2, file.get()) != 2) return std::nullopt;
  if (magic[0] == 0xFF && magic[1] == 0xD8) {
    std::rewind(file.get());
    std::vector<unsigned char> row;
    if (!read_jpeg(file.get(), row, sum, pixels)) return std::nullopt;
  } else {
    sim::FloorDesc floor;
    if (!sim::read_floor_image(name, floor).empty()) return std::nullopt;
    for (std::size_t i = 0; i < floor.image_rgb.size(); ++i) sum[i % 3] += floor.image_rgb[i];
    pixels = static_cast<double>(floor.image_rgb.size() / 3);
  }
  if (!(pixels > 0)) return std::nullopt;
  return sim::Colour{sum[0] / pixels / 255, sum[1] / pixels / 255, sum[2] / pixels / 255};
}

}  // namespace wbt
