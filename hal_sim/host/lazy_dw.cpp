// SPDX-License-Identifier: MIT
// libdw, with three libraries behind it, is loaded when a line or variable of a program is asked for.
#include "sim_core/base/lazy_library.h"

// clang-format off
#define CALLS(X) \
  X(dw, dwarf_aggregate_size) X(dw, dwarf_attr) X(dw, dwarf_attr_integrate) X(dw, dwarf_begin) \
  X(dw, dwarf_child) X(dw, dwarf_cu_getdwarf) X(dw, dwarf_diename) X(dw, dwarf_end) \
  X(dw, dwarf_formref_die) X(dw, dwarf_formudata) X(dw, dwarf_getelf) X(dw, dwarf_getlocation) \
  X(dw, dwarf_getsrc_die) X(dw, dwarf_hasattr) X(dw, dwarf_haspc) X(dw, dwarf_lineno) \
  X(dw, dwarf_linesrc) X(dw, dwarf_nextcu) X(dw, dwarf_offdie) X(dw, dwarf_peel_type) \
  X(dw, dwarf_siblingof) X(dw, dwarf_tag)
// clang-format on

LAZY_LIBRARY(dw, "libdw.so.1", CALLS)
