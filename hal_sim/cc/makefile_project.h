// SPDX-License-Identifier: MIT
// A Makefile beside a controller, read for what it says of the program: sources, where they and headers lie,
// macros. Webots' controllers have C_SOURCES, VPATH, INCLUDE and CFLAGS; others CSRCS, SRCS, OBJS and the
// like. Nothing is run: variables, $(wildcard), $(X:.c=.o) and `include` of files that exist are understood,
// conditions count as true, other functions of make as empty.
#pragma once
#include <filesystem>
#include <optional>

#include "mplab_project.h"

namespace cc {

/// Null without a Makefile. `sources` is empty when it lists no C file that exists.
std::optional<MplabProject> read_makefile(const std::filesystem::path& folder);

}  // namespace cc
