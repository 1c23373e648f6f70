// SPDX-License-Identifier: MIT
// libjpeg is loaded when a world's picture is one: a shared library of its own costs every call a tenth of a
// millisecond, and the static one cannot be part of a shared one.
#include "sim_core/base/lazy_library.h"

// clang-format off
#define CALLS(X) \
  X(jpeg, jpeg_CreateDecompress) X(jpeg, jpeg_destroy_decompress) X(jpeg, jpeg_finish_decompress) \
  X(jpeg, jpeg_mem_src) X(jpeg, jpeg_read_header) X(jpeg, jpeg_read_scanlines) \
  X(jpeg, jpeg_start_decompress) X(jpeg, jpeg_std_error)
// clang-format on

LAZY_LIBRARY(jpeg, "libjpeg.so.62", CALLS)
