// SPDX-License-Identifier: MIT
// A world as the page draws it and edits it: everything that stands in it, with the number of its piece of
// the world file. docs/connecting.md, "world".
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"
#include "sim_core/load/world_loader.h"
#include "sim_core/load/world_text.h"

namespace viewer {

/// `loaded`: what was made of `text`; with problems its draft is shown, and they stand beside what they are
/// about. `base` names the text. `twin`: the world that runs, null: none does, and `movable` its movable
/// objects' pieces: what is not in it has body -1.
nlohmann::json world_json(const sim::LoadedWorld& loaded, const sim::WorldText& text, const std::string& base,
                          const twin::Twin* twin, const std::vector<int>& movable);

/// What pages know of a world.
struct Told {
  sim::WorldText text{""};
  std::vector<int> movable;  ///< ids
  bool runs = false;
  bool is_good = false;  ///< it had no problems
};
/// What became other since then, docs/connecting.md, "world_changed": it costs what changed, not what there is.
/// None where that is more than pieces of the world, or where it has problems: then all is told.
std::optional<nlohmann::json> world_changes(const Told& told, const sim::LoadedWorld& loaded,
                                            const sim::WorldText& text, const std::string& base,
                                            const twin::Twin* twin, const std::vector<int>& movable);

/// The picture on the floor: `width`, `height`, `rgb` in base64, rows from the north.
nlohmann::json floor_json(const sim::FloorDesc& floor);

/// Numbers (ids) of the movable objects' pieces, in the order of the simulation's bodies behind the robots.
std::vector<int> movable_ids(const sim::WorldDesc& world, const sim::WorldText& text);

/// What the file may say about a piece: keys with type, unit, range, default and meaning.
nlohmann::json schema_json();

}  // namespace viewer
