// SPDX-License-Identifier: MIT
// Reads a whole file that a user named. Whatever the name leads to (a folder, /dev/zero, a loop of links),
// the caller gets its text or one line that says what is wrong; never an exception, never an endless read.
#pragma once
#include <cstddef>
#include <string>

namespace sim {

/// Puts the bytes of a regular file, or of a pipe that somebody writes, into `text`. Returns an empty string,
/// or what is wrong: "cannot be read: No such file or directory", "got a folder, expected a file".
std::string read_input_file(const std::string& path, std::size_t most_bytes, std::string& text);

}  // namespace sim
