// SPDX-License-Identifier: MIT
#include "sim_core/load/floor_image.h"

#include <cairo.h>
#include <fmt/format.h>

#include <cstring>
#include <string_view>

#include "sim_core/base/input_file.h"

namespace sim {
namespace {

constexpr std::size_t kLongestPicture = 256u << 20;  // bytes
constexpr int kMostPixels = 64'000'000;
constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

// what cairo has not read yet
cairo_status_t next_bytes(void* rest, unsigned char* out, unsigned count) {
  auto& bytes = *static_cast<std::string_view*>(rest);
  if (bytes.size() < count) return CAIRO_STATUS_READ_ERROR;
  std::memcpy(out, bytes.data(), count);
  bytes.remove_prefix(count);
  return CAIRO_STATUS_SUCCESS;
}

// width and height stand in the first chunk; what they ask for is known before anything is allocated
std::string check_size(std::string_view bytes) {
  if (bytes.size() < 24) return "a file that has been cut off";
  const auto number = [&](std::size_t at) {
    std::uint32_t n = 0;
    for (std::size_t i = 0; i < 4; ++i) n = n << 8 | static_cast<std::uint8_t>(bytes[at + i]);
    return n;
  };
  const std::uint64_t width = number(16), height = number(20);
  if (width * height <= static_cast<std::uint64_t>(kMostPixels)) return {};
  return fmt::format("{} by {} pixels", width, height);
}

}  // namespace

std::string read_floor_image(const std::string& path, FloorDesc& floor) {
  std::string bytes;
  std::string wrong = read_input_file(path, kLongestPicture, bytes);
  if (wrong.empty()) wrong = parse_floor_image(bytes, floor);
  return wrong.empty() ? wrong : fmt::format("got {} ({}), expected a PNG file", path, wrong);
}

std::string parse_floor_image(std::string_view bytes, FloorDesc& floor) {
  if (bytes.empty()) return "an empty file";
  // what cairo says of another kind of file is about cairo ("out of memory")
  if (bytes.substr(0, kSignature.size()) != kSignature)
    return kSignature.substr(0, bytes.size()) == bytes ? "a file that has been cut off" : "no PNG";
  // A picture that is too large is refused before anything is unpacked.
  const std::string size = check_size(bytes);
  if (!size.empty()) return fmt::format("{}; at most {} pixels", size, kMostPixels);
  cairo_surface_t* image = cairo_image_surface_create_from_png_stream(next_bytes, &bytes);
  const cairo_status_t status = cairo_surface_status(image);
  if (status != CAIRO_STATUS_SUCCESS) {
    cairo_surface_destroy(image);
    // this is cairo's word for whatever the PNG library finds wrong
    return status == CAIRO_STATUS_READ_ERROR || status == CAIRO_STATUS_NO_MEMORY
               ? "one that is damaged or has been cut off"
               : cairo_status_to_string(status);
  }
  const int width = cairo_image_surface_get_width(image);
  const int height = cairo_image_surface_get_height(image);
  std::string wrong;
  if (width < 1 || height < 1 || static_cast<long>(width) * height > kMostPixels) {
    wrong = fmt::format("{} by {} pixels; at most {} in all", width, height, kMostPixels);
  } else {
    // paint onto white, so that transparent parts show the paper
    cairo_surface_t* flat = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    cairo_t* cr = cairo_create(flat);
    cairo_set_source_rgb(cr, 1, 1, 1);
    cairo_paint(cr);
    cairo_set_source_surface(cr, image, 0, 0);
    cairo_paint(cr);
    cairo_destroy(cr);
    cairo_surface_flush(flat);
    floor.image_width = width;
    floor.image_height = height;
    floor.image_rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::uint8_t* to = floor.image_rgb.data();
    for (int y = 0; y < height; ++y) {
      const auto* row = reinterpret_cast<const std::uint32_t*>(
          cairo_image_surface_get_data(flat) + static_cast<long>(y) * cairo_image_surface_get_stride(flat));
      for (int x = 0; x < width; ++x)
        for (int shift = 16; shift >= 0; shift -= 8) *to++ = static_cast<std::uint8_t>(row[x] >> shift);
    }
    cairo_surface_destroy(flat);
  }
  cairo_surface_destroy(image);
  return wrong;
}

}  // namespace sim
