// SPDX-License-Identifier: MIT
// What an edit of the world's text asks of a run that goes on.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sim_core/load/world_text.h"
#include "sim_core/world/world_desc.h"

namespace viewer {

struct LiveEdit {
  std::string why_not;                                // a sentence: it needs a new run; empty: it does not
  std::vector<nlohmann::json> inputs;                 // of robots
  std::vector<std::pair<int, std::string>> firmware;  // robots that get another program
};

/// `to` is the text of `world`, `from` that of the run.
LiveEdit live_edit(const sim::WorldText& from, const sim::WorldText& to, const sim::WorldDesc& world);

}  // namespace viewer
