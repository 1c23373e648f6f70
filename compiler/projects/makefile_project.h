// SPDX-License-Identifier: MIT
// A Makefile beside a controller, read for what it says of the program: sources, where they and headers lie,
// macros. Webots' controllers have C_SOURCES, VPATH, INCLUDE and CFLAGS; others CSRCS, SRCS, OBJS and the
// like, or lists of any name of which a target is linked. Nothing is run: variables, $(X:.c=.o), `include` of
// files that exist and the functions wildcard, patsubst, subst, notdir, dir, basename, addprefix, addsuffix,
// filter, filter-out, foreach and if are understood, conditions count as true, other functions as empty.
#pragma once
#include <filesystem>
#include <optional>

#include "mplab_project.h"

namespace cc {

/// Null without a Makefile. `sources` is empty when it lists no C file that exists.
std::optional<MplabProject> read_makefile(const std::filesystem::path& folder);

}  // namespace cc
