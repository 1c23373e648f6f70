// SPDX-License-Identifier: MIT
// What is said of a compiler that a signal ended: its stack was too small for a program, as far as we know.
#pragma once
#include <string>

namespace cc {

/// "compiler: got a program that it cannot take (signal 11, Segmentation fault), expected ...".
std::string crash_words(int signal);

/// From now on this process says that of `file`, or of the place below, and ends with exit code 1, when a signal comes
/// that would end it.
void tell_crashes(const std::string& file);
/// Where the compiler is, "main.c:12:5"; "": no more than the file is known. Too long a text is cut.
void note_place(const std::string& place);

}  // namespace cc
