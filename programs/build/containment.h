// SPDX-License-Identifier: MIT
// Programs of people whom one need not trust: they run in a room of their own, made by bubblewrap.
#pragma once
#include <string>
#include <vector>

namespace programs {

/// Shall programs of the PC be contained? The environment says so: TWINPUCK_CONTAIN=1,
/// as `twinpuck grade` does.
bool is_contained();

/// `words`, which start a process, so that it sees no file but the system's programs and libraries and what
/// lies in `readable`, writes to nothing but an empty /tmp, has no network, and sees no process, for there is
/// no /proc. `folder`: where it works. What lies in the submission and is a link out of it, it does not see. Its
/// open descriptors stay. Empty when bubblewrap is not installed.
std::vector<std::string> contained(const std::vector<std::string>& words, const std::string& folder,
                                   const std::vector<std::string>& readable,
                                   const std::vector<std::string>& writable = {});

}  // namespace programs
