// SPDX-License-Identifier: MIT
// Keys of a world file that only one kind of robot or part has. Whoever knows the kind lists them and hands
// the list to the loader; sim_core checks and keeps what is written, and knows no meaning.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace sim {

enum class OwnKeyType { Number, Integer, Flag, Text, Choice, Pair, Triple, Numbers };

/// The fields of the loader's schema.
struct OwnKey {
  std::string key;
  OwnKeyType type = OwnKeyType::Number;
  std::string unit;  ///< "" for none
  double least = 0;  ///< of numbers, list members included
  double most = 0;
  std::string choices;   ///< Choice: words separated by '|'
  std::string fallback;  ///< as TOML would write it; "" where nothing stands; "required"
  std::string doc;       ///< meaning, a phrase
  int multiple_of = 1;   ///< Integer: only such numbers
};

/// A value as written.
struct OwnValue {
  std::string text;             ///< Text, Choice
  bool flag = false;            ///< Flag
  std::vector<double> numbers;  ///< Number and Integer: one; Pair, Triple, Numbers

  OwnValue() = default;
  OwnValue(std::string t) : text(std::move(t)) {}
  OwnValue(const char* t) : text(t) {}
  OwnValue(double n) : numbers{n} {}
  OwnValue(int n) : numbers{static_cast<double>(n)} {}
};

using OwnValues = std::map<std::string, OwnValue>;

/// What was written, with the defaults of what was not. A key that is not listed, or listed with another
/// type, is our bug (CHECK).
class OwnSettings {
 public:
  /// `keys` outlives this.
  OwnSettings(const std::vector<OwnKey>& keys, OwnValues values) : keys_(&keys), values_(std::move(values)) {}

  double number(const std::string& key) const;
  int integer(const std::string& key) const { return static_cast<int>(number(key)); }
  bool flag(const std::string& key) const;
  std::string text(const std::string& key) const;
  std::vector<double> numbers(const std::string& key) const;

 private:
  const OwnKey& key_of(const std::string& key) const;
  /// Null: nothing was written.
  const OwnValue* written(const std::string& key) const;

  const std::vector<OwnKey>* keys_;
  OwnValues values_;
};

}  // namespace sim
