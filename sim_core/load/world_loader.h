// SPDX-License-Identifier: MIT
// World files in, checked WorldDescs out. All problems of a file are found in one go; nothing here throws.
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim_core/base/did_you_mean.h"
#include "sim_core/world/world_desc.h"

namespace sim {

inline constexpr std::size_t kLongestWorld = 8u << 20;  // bytes; ten thousand robots need a tenth of it

/// One thing that is wrong with a world file.
struct WorldProblem {
  int line = 0;      ///< from 1; 0 where no place can be named
  int column = 0;    ///< from 1; 0 where no place can be named
  std::string text;  ///< "what: got value, expected set or range with unit"
};

struct LoadedWorld {
  std::optional<WorldDesc> world;      ///< set when there are no problems
  WorldDesc draft;                     ///< otherwise what could be read, for further checks
  std::vector<WorldProblem> problems;  ///< in the order of their places
  /// One line per problem, "file:line:column: ...", without a line break at the end of the last.
  std::string report(std::string_view file) const;
  /// What somebody else has found; a world with problems is none, and a draft.
  void add(std::vector<WorldProblem> more);
};

/// Reads and checks a file. `models`: the kinds of robot that the caller knows; the first is the default.
/// `part_kinds`: what may be plugged into them.
LoadedWorld load_world(const std::string& path, const std::vector<RobotModel>& models,
                       const std::vector<PartKind>& part_kinds = {});

class TomlTree;
/// What was made of a text, for a next one that differs in little: that goes quicker, the result is the same.
struct KnownWorld {
  std::shared_ptr<TomlTree> tree;  ///< null: of none so far
};

/// Same for text already in memory; `path` serves messages and relative file names. `known`: of the text
/// before, afterwards of this one; null: there is none.
LoadedWorld parse_world(std::string_view text, const std::string& path, const std::vector<RobotModel>& models,
                        const std::vector<PartKind>& part_kinds = {}, KnownWorld* known = nullptr);

/// Checks what no single key shows: names, overlaps, sensors that do not exist. Also for worlds built in C++.
/// `unplaced`: robots of whom nobody knows where they are.
std::vector<WorldProblem> check_world(const WorldDesc& world, const std::vector<std::size_t>& unplaced = {});

/// What is allowed and may not be meant: robots outside the arena. "note: ..."
std::vector<WorldProblem> place_notices(const WorldDesc& world);

/// Whether a robot of a good world begins inside nothing. Quicker than check_world(), which
/// looks at all bodies.
bool has_room(const WorldDesc& world, int robot);

/// A file name as written in a world file, resolved against the world's own folder.
std::string resolve_path(const WorldDesc& world, const std::string& name);

}  // namespace sim
