// SPDX-License-Identifier: MIT
// From what a user calls a supervisor's program to a shared object of the PC: C and C++ sources are compiled
// by the system's gcc and kept under a name made of their content.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace supervisor {

/// The file or folder that a program's name means; empty, with a line in `problems`, when there is none.
std::string find_program(const std::string& name, const std::string& from_folder,
                         std::vector<std::string>& problems);

/// `name`: a .so, a .c or .cpp file, a folder of such, or the name of one under supervisor/programs/;
/// relative paths start in `from_folder`. Returns the shared object's path; empty on failure, with lines
/// appended to `problems`. `tell` gets the compiler's warnings, a line each; may be empty.
std::string provide_program(const std::string& name, const std::string& from_folder,
                            const std::function<void(const std::string&)>& tell,
                            std::vector<std::string>& problems);

/// The folder that a program works in, absolute: its own, or that of its file.
std::string program_folder(const std::string& name, const std::string& from_folder);

/// True when `folder` is one of supervisor/programs/, or holds C or C++ that includes a supervisor's header.
bool is_program_folder(const std::string& folder);

}  // namespace supervisor
