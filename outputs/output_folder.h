// SPDX-License-Identifier: MIT
// Where a run leaves things behind: folders with a file for each robot, and whether a file can be written.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sim {
struct WorldDesc;
}

namespace outputs {

/// Makes the folder, and those above it, where it does not exist. False and a line in `problems`, which names
/// the option, when that fails.
bool make_output_folder(const std::string& folder, const char* option, std::vector<std::string>& problems);

/// Whether a file can be written, found out before the run and without a trace; an empty path can. Otherwise
/// a line in `problems`.
bool can_write(const std::string& path, const char* option, std::vector<std::string>& problems);

/// The whole text as a file, in place of what there is; an empty path is no file. False and a line in `problems`,
/// which names the option and says why, when that fails.
bool write_file(const std::string& path, std::string_view text, const char* option,
                std::vector<std::string>& problems);

/// FOLDER/NAME of a robot, without an ending: its name, '/' replaced by '_'; names that had one, or begin
/// with a dot, get the robot's number before them, and '_' behind while that is another robot's name.
std::string output_file(const std::string& folder, const sim::WorldDesc& world, int robot);

}  // namespace outputs
