// SPDX-License-Identifier: MIT
#pragma once

namespace tools {

/// The command twinpuck, whole: reads the command line, does what it says, tells what went wrong. Returns the
/// exit code (docs/start.md).
int twinpuck(int argc, char** argv);

}  // namespace tools
