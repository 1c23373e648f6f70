// SPDX-License-Identifier: MIT
// A world file as text that can be edited piece by piece: comments, order, blank lines and the style of
// numbers stay where nothing was asked to change. Knows TOML's lines, not what they mean: load/world_loader.h
// judges the result.
//
//   # a comment belongs to the table below it      an element: [arena], or one [[box]]; tables such as
//   [[robot]]                                       [robot.proximity] belong to the [[robot]] above
//   position = [0.10, 0.2]  # so does this one
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sim {

class WorldText {
 public:
  /// A key and its value as TOML writes it.
  using Values = std::vector<std::pair<std::string, std::string>>;

  struct Element {
    int id = 0;        ///< stays the same through all edits, for as long as the element exists
    std::string path;  ///< "arena", "box", "robot"; "" the keys at the top of the file
    bool many = false;
    int first_line = 0, last_line = 0;  ///< from 1; tables below it included
  };

  explicit WorldText(std::string text);

  const std::string& text() const { return text_; }
  const std::vector<Element>& elements() const { return elements_; }
  /// Element that holds a line; null: none.
  const Element* at_line(int line) const;
  const Element* find(int id) const;
  /// A value as it is written; empty: the key is not there.
  std::string value(int id, const std::string& key) const;

  /// The keys of an element's own table, as they are written.
  Values values(int id) const;
  /// All of an element as it is written; `commented`: with the comment above it.
  std::string text_of(int id, bool commented = false) const;
  /// Ids of the elements of that path, in their order.
  std::vector<int> ids_of(const std::string& path) const;
  /// Ids of elements that `before` has not, or has with another text, in their order.
  std::vector<int> differing(const WorldText& before) const;
  /// Its tables below its own, likewise.
  std::string inner_text(int id) const;

  // Edits. False: there is no such element.
  /// Changes, adds or, with an empty `value`, takes away a key of the element's own table.
  bool set(int id, const std::string& key, const std::string& value);
  bool remove(int id);
  /// Below the last element of that path, or at the end; `many`: as [[path]], otherwise as
  /// [path]. Returns its id.
  int add(const std::string& path, const Values& values, bool many = true);
  /// An element as text_of() gives it, below the last one of its path, or at the end. Returns its id.
  int append(const std::string& element);
  /// The same once more, right below, with the comment above it; returns the new one's id,
  /// 0: nothing to copy.
  int copy(int id);
  /// Adds a table such as [[robot.part]] at the end of an element.
  bool add_inner(int id, const std::string& path, const Values& values);
  /// Takes away the `index`-th table of that path within an element.
  bool remove_inner(int id, const std::string& path, int index);
  /// Another text altogether; elements keep their ids by path and order.
  void replace(std::string text);

 private:
  struct Entry {
    std::string key;
    std::size_t line = 0, begin = 0, end = 0, next = 0;  // places: its line, its value, the line after it
  };
  struct Table {
    int element = 0;   // index
    bool own = false;  // the element's first table
    std::string path;
    std::size_t top = 0, begin = 0, end = 0;  // with the comment above; header; where the next table's top is
    std::vector<Entry> entries;
  };
  void scan(const std::vector<int>& ids);
  void index_ids();
  std::vector<int> ids() const;
  int index_of(int id) const;
  std::size_t end_of(int element) const;  // 0: it has no table
  int insert(const std::string& path, const std::string& element);
  const Table* own_table(int id) const;
  std::string text_;
  std::vector<Element> elements_;
  std::vector<Table> tables_;
  std::vector<int> index_of_id_;  // by id; -1: there is none
  int next_id_ = 1;
};

/// `fresh` with the numbers written as in `old`: equal ones stay as they are, others get as many decimals.
std::string in_style_of(std::string_view old, const std::string& fresh);

}  // namespace sim
