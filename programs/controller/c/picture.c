/* SPDX-License-Identifier: MIT
 * Pictures of files: PNG and JPEG, by their libraries.
 */
#include <errno.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <jpeglib.h>
#include <png.h>

#include "programs/controller/c/library.h"

#define MOST_SIDE 4096 /* pixels */

static bool ends_in(const char* file, const char* ending) {
  const char* dot = strrchr(file, '.');
  return dot && strcasecmp(dot, ending) == 0;
}
static bool is_jpeg(const char* file) { return ends_in(file, ".jpg") || ends_in(file, ".jpeg"); }

/* the library would end the program */
struct jpeg_trouble {
  struct jpeg_error_mgr manager;
  jmp_buf back;
};
static void on_trouble(j_common_ptr info) { longjmp(((struct jpeg_trouble*)info->err)->back, 1); }

static bool write_jpeg(const struct image* image, FILE* file, int quality) {
  struct jpeg_compress_struct info;
  struct jpeg_trouble trouble;
  unsigned char* row = grow(0, 3 * (size_t)image->width);
  volatile bool is_written = false;
  info.err = jpeg_std_error(&trouble.manager);
  trouble.manager.error_exit = on_trouble;
  jpeg_create_compress(&info);
  if (!setjmp(trouble.back)) {
    jpeg_stdio_dest(&info, file);
    info.image_width = (JDIMENSION)image->width;
    info.image_height = (JDIMENSION)image->height;
    info.input_components = 3;
    info.in_color_space = JCS_RGB;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, quality < 1 ? 1 : quality > 100 ? 100 : quality, TRUE);
    jpeg_start_compress(&info, TRUE);
    while (info.next_scanline < info.image_height) {
      const unsigned char* from = image->bgra + 4 * (size_t)info.next_scanline * (size_t)image->width;
      int x;
      for (x = 0; x < image->width; x++) row[3 * x] = from[4 * x + 2], row[3 * x + 1] = from[4 * x + 1], row[3 * x + 2] = from[4 * x];
      jpeg_write_scanlines(&info, &row, 1);
    }
    jpeg_finish_compress(&info);
    is_written = true;
  }
  jpeg_destroy_compress(&info);
  free(row);
  return is_written;
}

static bool write_png(const struct image* image, FILE* file, bool with_alpha) {
  png_image png = {.version = PNG_IMAGE_VERSION};
  size_t i, pixels = (size_t)image->width * (size_t)image->height;
  unsigned char* bytes = image->bgra;
  int is_written;
  png.width = (png_uint_32)image->width;
  png.height = (png_uint_32)image->height;
  png.format = with_alpha ? PNG_FORMAT_BGRA : PNG_FORMAT_BGR;
  if (!with_alpha) {
    bytes = grow(0, 3 * pixels);
    for (i = 0; i < pixels; i++) memcpy(bytes + 3 * i, image->bgra + 4 * i, 3);
  }
  is_written = png_image_write_to_stdio(&png, file, 0, bytes, 0, 0);
  if (bytes != image->bgra) free(bytes);
  return is_written != 0;
}

bool image_write(const struct image* image, const char* file, int quality, bool with_alpha, const char* function) {
  FILE* to;
  bool is_written;
  if (file && *file && !is_jpeg(file) && !ends_in(file, ".png")) {
    WARN("%s(): got '%s', expected a name that ends in .png, .jpg or .jpeg", function, file);
    return false;
  }
  to = file && *file ? fopen(file, "wb") : 0;
  if (!to) {
    WARN("%s(): cannot write '%s': %s", function, file ? file : "", file && *file ? strerror(errno) : "got no name");
    return false;
  }
  is_written = is_jpeg(file) ? write_jpeg(image, to, quality) : write_png(image, to, with_alpha);
  if (fclose(to) != 0) is_written = false;
  if (!is_written) WARN("%s(): cannot write '%s'", function, file);
  return is_written;
}

static bool read_jpeg(struct image* image, FILE* file) {
  struct jpeg_decompress_struct info;
  struct jpeg_trouble trouble;
  unsigned char* volatile row = 0;
  volatile bool is_read = false;
  info.err = jpeg_std_error(&trouble.manager);
  trouble.manager.error_exit = on_trouble;
  jpeg_create_decompress(&info);
  if (!setjmp(trouble.back)) {
    jpeg_stdio_src(&info, file);
    jpeg_read_header(&info, TRUE);
    info.out_color_space = JCS_RGB;
    jpeg_start_decompress(&info);
    if (info.output_width <= MOST_SIDE && info.output_height <= MOST_SIDE) {
      image->width = (int)info.output_width;
      image->height = (int)info.output_height;
      image->bgra = grow(0, 4 * (size_t)image->width * (size_t)image->height);
      row = grow(0, 3 * (size_t)image->width);
      while (info.output_scanline < info.output_height) {
        unsigned char* to = image->bgra + 4 * (size_t)info.output_scanline * (size_t)image->width;
        unsigned char* from = row;
        int x;
        jpeg_read_scanlines(&info, &from, 1);
        for (x = 0; x < image->width; x++)
          to[4 * x] = from[3 * x + 2], to[4 * x + 1] = from[3 * x + 1], to[4 * x + 2] = from[3 * x], to[4 * x + 3] = 255;
      }
      jpeg_finish_decompress(&info);
      is_read = true;
    }
  }
  jpeg_destroy_decompress(&info);
  free(row);
  return is_read;
}

static bool read_png(struct image* image, FILE* file) {
  png_image png = {.version = PNG_IMAGE_VERSION};
  bool is_read = false;
  if (!png_image_begin_read_from_stdio(&png, file)) return false;
  if (png.width <= MOST_SIDE && png.height <= MOST_SIDE) {
    png.format = PNG_FORMAT_BGRA;
    image->width = (int)png.width;
    image->height = (int)png.height;
    image->bgra = grow(0, PNG_IMAGE_SIZE(png));
    is_read = png_image_finish_read(&png, 0, image->bgra, 0, 0) != 0;
  }
  png_image_free(&png);
  return is_read;
}

bool image_read(struct image* image, const char* file, const char* function) {
  FILE* from = file && *file ? fopen(file, "rb") : 0;
  unsigned char first = 0;
  bool is_read;
  memset(image, 0, sizeof *image);
  if (!from) {
    WARN("%s(): cannot read '%s': %s", function, file ? file : "", file && *file ? strerror(errno) : "got no name");
    return false;
  }
  /* the first byte tells which it is, whatever it is called */
  if (fread(&first, 1, 1, from) == 1) rewind(from);
  is_read = first == 0xFF ? read_jpeg(image, from) : read_png(image, from);
  fclose(from);
  if (is_read) return true;
  WARN("%s(): cannot read '%s', expected a PNG or JPEG of at most %d x %d pixels", function, file, MOST_SIDE, MOST_SIDE);
  free(image->bgra);
  image->bgra = 0;
  return false;
}
