// SPDX-License-Identifier: MIT
// Inside programs/build: files and folders of a project, and what text says.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace programs {

namespace fs = std::filesystem;

inline constexpr std::size_t kMostFiles = 5000;                 ///< of a folder that are looked at
inline constexpr std::size_t kMostText = std::size_t{4} << 20;  ///< bytes of a source that are read

/// Regular files below a folder, but for hidden ones and hidden folders; sorted. Links are
/// followed, not in circles.
std::vector<fs::path> files_below(const fs::path& folder);
/// A pipe, socket or device whose name is that of a source or header; empty: none. Reading one may never end.
fs::path odd_file_below(const fs::path& folder);

/// The bytes of a regular file, at most kMostText; empty for anything else.
std::string text_of(const fs::path& file);
/// C without comments, and with empty strings.
std::string without_comments(const std::string& source);
/// Whether C or C++ without comments defines main().
bool defines_main(const std::string& bare);

std::string lower_case(std::string text);
/// The ending of a name in lower case, with its dot.
std::string kind_of(const fs::path& file);
bool is_c(const fs::path& file);
bool is_cxx(const fs::path& file);
bool is_header(const fs::path& file);

/// The file that a name means from `folder` on, also with "\" for "/" and in another case; empty: none.
fs::path resolve(const fs::path& folder, const std::string& name);
/// The executable of a name on PATH, absolute; empty: none.
fs::path on_path(const std::string& name);

/// Names that a controller's folder has: as it is called, and where it really lies.
std::vector<std::string> names_of(const fs::path& folder);

std::uint64_t hash_of(std::uint64_t h, const std::string& bytes);

}  // namespace programs
