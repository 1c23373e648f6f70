// SPDX-License-Identifier: MIT
// Parts that may be plugged into a robot (turrets, sensor boards), as pure data: which kinds there are, which
// keys each takes in a world file, and what a robot's file says of its own. Whoever knows real parts hands
// their kinds to the loader, as it hands the robot models; sim_core itself names none.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace sim {

enum class PartKeyType { Number, Integer, Flag, Text, Choice, Pair, Triple, Numbers };

/// One key of a kind of part; the fields of the loader's schema.
struct PartKey {
  std::string key;
  PartKeyType type = PartKeyType::Number;
  std::string unit;  ///< "" for none
  double least = 0;  ///< of numbers, list members included
  double most = 0;
  std::string choices;   ///< Choice: words separated by '|'
  std::string fallback;  ///< as TOML would write it; "" where nothing stands; "required"
  std::string doc;       ///< meaning, a phrase
};

struct PartKind {
  std::string name;  ///< what world files write in `kind`
  std::string doc;   ///< a sentence
  std::vector<PartKey> keys;
};

/// A value as written.
struct PartValue {
  std::string text;             ///< Text, Choice
  bool flag = false;            ///< Flag
  std::vector<double> numbers;  ///< Number and Integer: one; Pair, Triple, Numbers
};

/// A part of one robot: its kind and the keys that were written.
struct PartDesc {
  std::string kind;
  std::map<std::string, PartValue> values;
  int line = 0;  ///< line in the world file; 0 when built in C++
};

}  // namespace sim
