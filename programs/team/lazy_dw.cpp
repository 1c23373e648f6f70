// SPDX-License-Identifier: MIT
// libdw, with three libraries behind it, is loaded when a program has crashed.
#include "sim_core/base/lazy_library.h"

// clang-format off
#define CALLS(X) \
  X(dw, dwarf_begin) X(dw, dwarf_end) X(dw, dwarf_getsrc_die) X(dw, dwarf_haspc) X(dw, dwarf_lineno) \
  X(dw, dwarf_linesrc) X(dw, dwarf_nextcu) X(dw, dwarf_offdie)
// clang-format on

LAZY_LIBRARY(dw, "libdw.so.1", CALLS)
