// SPDX-License-Identifier: MIT
// libsndfile, with eight libraries behind it, is loaded when a WAV file is read or written.
#include "sim_core/base/lazy_library.h"

// clang-format off
#define CALLS(X) \
  X(sndfile, sf_close) X(sndfile, sf_command) X(sndfile, sf_open_fd) X(sndfile, sf_open_virtual) \
  X(sndfile, sf_readf_double) X(sndfile, sf_strerror) X(sndfile, sf_write_short)
// clang-format on

LAZY_LIBRARY(sndfile, "libsndfile.so.1", CALLS)
