// SPDX-License-Identifier: MIT
// From a folder of firmware C to an image of the chip. Spawns twinpuck-cc, which compiles and links; contains
// no compiler itself. In: a controller's folder. Out: an .elf with the controller, the e-puck library linked
// with one of the HALs, the firmware libc and the runtime; with .hex, .lst and .map.
#pragma once
#include "compiler/cache/options.h"

namespace cc {

/// Compiles and links. On failure the output file is left as it was.
BuildResult build_image(const BuildOptions& options);

/// Compiles with strict warnings and looks for what compiles but misbehaves: polled flags that are not
/// volatile, two drivers on one timer. Writes no image. ok is false when there is an error or a warning.
BuildResult lint_folder(const BuildOptions& options);

}  // namespace cc
