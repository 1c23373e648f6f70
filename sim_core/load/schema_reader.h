// SPDX-License-Identifier: MIT
// What readers of TOML files by a schema share: parsing, messages with line and column, keys with their types
// and ranges, unknown keys with what they may mean.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sim_core/load/schema.h"
#include "sim_core/load/toml_parser.h"
#include "sim_core/load/world_loader.h"

namespace sim {

inline constexpr std::size_t kMostProblems = 200;  // reported; more would help nobody

void sort_by_place(std::vector<WorldProblem>& problems);

class SchemaReader {
 protected:
  /// `known`: the tree of a text before, and behind parse() of this one; null: there is none.
  explicit SchemaReader(TomlTree* known = nullptr) : tree_(known ? known : &own_tree_) {}

  /// The tree of a file; null, with a problem, where it is none. `text` outlives the reading.
  const toml::table* parse(std::string_view text);
  void problem(const toml::source_region& where, std::string text);
  void problem(WorldProblem one);
  /// Those that stay, in the order of their places.
  void sort_problems();
  /// A value as it stands in the file, for messages.
  std::string written(const toml::node& node) const;
  static int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

  /// Applies every key of a table and names the unknown ones. `inner`: keys that somebody else reads.
  void read_table(const SectionSpec& spec, const std::vector<std::string>& inner, const toml::table& table,
                  void* target, const WorldDesc& draft);

  /// Every [[section]], in order; `each` gets the table.
  template <typename F>
  void read_many(const char* path, const toml::table& parent, const char* key, F each) {
    const toml::node* node = parent.get(key);
    if (!node) return;
    const toml::array* list = node->as_array();
    if (!list) {
      problem(node->source(), std::string(path) + ": got " + written(*node) + ", expected [[" + path +
                                  "]] with double brackets");
      return;
    }
    for (const toml::node& item : *list) {
      if (const toml::table* table = item.as_table()) {
        each(*table);
      } else {
        problem(item.source(), std::string(path) + ": got " + written(item) +
                                   ", expected a table, written [[" + path + "]]");
      }
    }
  }

  std::vector<WorldProblem> problems_;
  bool is_place_in_doubt_ = false;  // a key that read_table() refused may have been to say where a body is
  std::size_t more_ = 0;            // that are not kept

 private:
  static std::string choice_hint(const KeySpec& k, const std::string& got);
  std::vector<std::string_view> lines_;
  TomlTree own_tree_;
  TomlTree* const tree_;
};

}  // namespace sim
