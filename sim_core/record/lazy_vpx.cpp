// SPDX-License-Identifier: MIT
// libvpx is loaded when a film is made.
#include "sim_core/base/lazy_library.h"

// clang-format off
#define CALLS(X) \
  X(vpx, vpx_codec_control_) X(vpx, vpx_codec_destroy) X(vpx, vpx_codec_enc_config_default) \
  X(vpx, vpx_codec_enc_init_ver) X(vpx, vpx_codec_encode) X(vpx, vpx_codec_error) \
  X(vpx, vpx_codec_get_cx_data) X(vpx, vpx_codec_vp9_cx) X(vpx, vpx_img_alloc) X(vpx, vpx_img_free)
// clang-format on

LAZY_LIBRARY(vpx, "libvpx.so.7", CALLS)
