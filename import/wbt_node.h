// SPDX-License-Identifier: MIT
// What a .wbt file says, as a tree without meaning: nodes with fields of numbers, words and further nodes.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wbt {

struct Node;
using NodePtr = std::shared_ptr<const Node>;  // USE shares what DEF named

/// One field. Single values and lists look alike: `size 1 2` and `size [1, 2]` hold the same numbers.
struct Field {
  std::string name;
  int line = 0;
  std::vector<double> numbers;  ///< finite
  std::vector<std::string> strings;
  std::optional<bool> truth;   ///< TRUE or FALSE; of a list the last one
  std::vector<NodePtr> nodes;  ///< never null; NULL leaves it empty
};

struct Node {
  std::string type;
  std::string def;
  int line = 0;
  std::vector<Field> fields;

  /// The field of that name, null when it is not written.
  const Field* field(std::string_view name) const;
  /// Number `i` of a field, or `otherwise`.
  double number(std::string_view name, double otherwise, std::size_t i = 0) const;
  /// First word of a field, or `otherwise`.
  std::string text(std::string_view name, std::string otherwise = {}) const;
  bool truth(std::string_view name, bool otherwise) const;
  /// First node of a field, null when there is none.
  const Node* node(std::string_view name) const;
};

/// A place that is wrong, or a line that says what could not be understood.
struct Remark {
  int line = 0;
  int column = 0;
  std::string text;
};

}  // namespace wbt
