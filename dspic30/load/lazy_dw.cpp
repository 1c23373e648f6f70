// SPDX-License-Identifier: MIT
// libdw is loaded when somebody asks for a variable or a frame: with what it unpacks sections by, it takes a
// millisecond to load.
#include "sim_core/base/lazy_library.h"

// clang-format off
#define CALLS(X) \
  X(dw, dwarf_attr) X(dw, dwarf_begin) X(dw, dwarf_begin_elf) X(dw, dwarf_child) X(dw, dwarf_dieoffset) \
  X(dw, dwarf_end) X(dw, dwarf_formref_die) X(dw, dwarf_formstring) X(dw, dwarf_formudata) \
  X(dw, dwarf_get_units) X(dw, dwarf_getlocation) X(dw, dwarf_getlocations) X(dw, dwarf_getsrc_die) \
  X(dw, dwarf_hasattr) X(dw, dwarf_haspc) X(dw, dwarf_highpc) X(dw, dwarf_lineno) X(dw, dwarf_linesrc) \
  X(dw, dwarf_lowpc) X(dw, dwarf_nextcu) X(dw, dwarf_offdie) X(dw, dwarf_ranges) X(dw, dwarf_siblingof) \
  X(dw, dwarf_tag)
// clang-format on

LAZY_LIBRARY(dw, "libdw.so.1", CALLS)
