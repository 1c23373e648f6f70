// SPDX-License-Identifier: MIT
// The one table of everything a world file may say: key, type, unit, range, default, meaning, and where the
// value goes. The parser, its messages and docs/worlds.md are all made from it.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim_core/world/world_desc.h"

namespace sim {

/// Version of the format; the first line of a world file says `twinpuck = 1`.
inline constexpr int kWorldFormatVersion = 1;
inline constexpr int kMostRobots = 25000;

enum class ValueType {
  Integer,
  Number,
  Text,
  Bytes,  ///< a text of any characters
  Flag,
  Choice,
  Pair,
  Triple,
  Colour,   ///< two or three numbers
  Numbers,  ///< a list of numbers
  Points,   ///< a list of [x, y]
  Colours,  ///< a list of [red, green, blue]
  Rows      ///< a list of [distance, value, noise]
};

/// A value as read, already checked against its type and range.
struct Value {
  std::int64_t integer = 0;
  double number = 0;
  bool flag = false;
  std::string text;
  std::vector<double> numbers;
  std::vector<std::vector<double>> rows;
};

/// Puts a value into its struct. `draft` is the world so far (materials are read first). Returns what is
/// wrong beyond type and range as "got ..., expected ...", or an empty string.
using Setter = std::function<std::string(void* target, const Value& value, const WorldDesc& draft)>;

struct KeySpec {
  const char* key;
  ValueType type;
  const char* unit;  ///< "" for none
  double least;      ///< of numbers, list members included
  double most;
  const char* choices;  ///< Choice: words separated by '|'; otherwise ""
  const char*
      fallback;  ///< as TOML would write it; "" where nothing stands; "required" where it must be written
  const char* doc;
  Setter set;
};

struct SectionSpec {
  const char* path;  ///< "" the file itself, "arena", "robot.variation", ...
  bool many;         ///< [[path]]: may be written again and again
  const char* doc;
  std::vector<KeySpec> keys;
};

const std::vector<SectionSpec>& world_schema();
const SectionSpec& section(const std::string& path);

/// "number in m, 0.001 to 1000" and the like, for messages and documents.
std::string expected_text(const KeySpec& key);

/// `[[robot.part]]` of one kind: `kind`, then its own keys. Points into `kind`, which must outlive it.
SectionSpec part_section(const PartKind& kind);

/// `[[robot]]` of one model, its own keys last. Points into `model`, which must outlive it.
SectionSpec robot_section(const RobotModel& model);

/// The tables of keys in docs/worlds.md. `models`, `part_kinds`: the kinds of robot and part to describe.
std::string world_format_page(const std::vector<RobotModel>& models, const std::vector<PartKind>& part_kinds);

}  // namespace sim
