// SPDX-License-Identifier: MIT
// The bound on a user's caches. Whoever has put something there asks for it; what was used longest ago goes
// first, and whoever misses it makes it again.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace places {

/// All caches of a user together, bytes; TWINPUCK_CACHE_MB says another bound, in MB.
inline constexpr std::uint64_t kMostCacheBytes =
    std::uint64_t{512} << 20;  // [assumed: a class of 200 controllers, each with both HALs, takes 100 MB]

/// Removes what was used longest ago below `folder` until it holds at most `bytes`, and what builds left that
/// were killed. What was written or read within the last ten minutes stays, since somebody may be about to
/// use it. Several at once do no harm. Returns how many bytes are left.
std::uint64_t keep_within(const std::filesystem::path& folder, std::uint64_t bytes);

/// The same for the user's caches and their bound, once a minute at most, among all programs. Full ones take a
/// sixth of a second, so a run that puts nothing there does not ask.
void keep_caches_within_bound();

/// What is wrong with TWINPUCK_CACHE_MB; empty: nothing, or it is not set.
std::string wrong_cache_bound();

/// Says that a file of a cache is of use, where its time of reading is not kept. Costs a look at most calls.
void note_used(const std::filesystem::path& file);

}  // namespace places
