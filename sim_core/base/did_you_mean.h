// SPDX-License-Identifier: MIT
// What somebody may have meant by a word that is not known.
#pragma once
#include <string>
#include <vector>

namespace sim {

/// The candidate most like `word`, or an empty string when none is near enough to be meant.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

/// How a message ends that tells it: "; did you mean 'wall'?". Empty when there is none.
std::string did_you_mean_tail(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace sim
