// SPDX-License-Identifier: MIT
// The nodes of a world as programs see them: a tree with typed fields, made of the text of a .wbt file, of a
// string that a program imports, or of the world that runs. Knows no simulation; nodes/ ties it to one.
#pragma once
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "import/affine.h"
#include "import/proto_files.h"
#include "programs/world/catalogue.h"

namespace programs {

/// A field and what it holds. Numbers of a list's members follow each other.
struct Value {
  std::string name;
  int type = kNoField;
  std::vector<double> numbers;
  std::vector<std::string> texts;
  std::vector<int> nodes;
  bool written = false;  ///< by a file or a program; others hold their default

  int count() const;
};

/// What of the running world a node is.
enum class Is { Plain, Robot, Supervisor, Object, Lamp };

struct TreeNode {
  int id = 0;
  int parent = 0;  ///< 0: none
  std::string type, base, def;
  std::deque<Value> values;  // a deque, so that pointers stay good
  Is is = Is::Plain;
  int number = -1;    ///< of the robot, supervisor or lamp
  bool gone = false;  ///< somebody removed it

  Value* find(const std::string& name);
  const Value* find(const std::string& name) const { return const_cast<TreeNode*>(this)->find(name); }
  /// Numbers of a field; `otherwise` where there is none.
  std::vector<double> numbers(const std::string& name, std::vector<double> otherwise) const;
  std::string text(const std::string& name) const;
};

class Tree {
 public:
  /// A root without children. `text`: what file it is of (its release and PROTOs); `protos` likewise.
  Tree();

  static constexpr int kRoot = 1;
  static constexpr int kMostTreeNodes = 200'000;  // that are there at once
  static constexpr int kDeepest = 200;            // nodes in nodes

  TreeNode& node(int id) { return nodes_[static_cast<std::size_t>(id - 1)]; }
  const TreeNode& node(int id) const { return nodes_[static_cast<std::size_t>(id - 1)]; }
  int count() const { return static_cast<int>(nodes_.size()); }
  /// A node that is there; false for any other number.
  bool has(int id) const { return id >= 1 && id <= count() && !node(id).gone; }

  /// Adds what was read under a node, in its field, before member `index`; -1: at the end. Lines of the file
  /// are kept. Returns its number; 0: there are too many nodes, or too many in one another.
  int add(const wbt::Node& from, int parent, const std::string& field, int index, wbt::ProtoFiles& protos);
  /// Adds a node without fields, but for what its kind has.
  int add(const std::string& type, const std::string& def, int parent, const std::string& field);
  /// A field's value, made if it is not there.
  Value& set(int id, const std::string& name, int type, std::vector<double> numbers);
  void set(int id, const std::string& name, const std::string& text);
  /// Takes it and all in it away.
  void remove(int id);

  /// The first of that DEF that is there, or of "OUTER.INNER"; 0: none.
  int find_def(const std::string& def) const;
  int find_name(const std::string& name) const;
  /// A node and all below it that are there, in order.
  std::vector<int> below(int id) const;
  /// Nodes that a line of the file began.
  std::vector<int> at_line(int line) const;

  /// As text was read: lines are the nodes' numbers.
  wbt::NodePtr to_wbt(int id) const;
  /// Every DEF of the world, for USE.
  std::map<std::string, wbt::NodePtr> defs() const;

  /// Its own place within its parent: translation, rotation, scale.
  wbt::Affine local(int id) const;

 private:
  TreeNode& make(const std::string& type, const std::string& def, int parent);
  void attach(int id, int parent, const std::string& field, int index);

  std::deque<TreeNode> nodes_;
  std::map<int, std::vector<int>> lines_;
  int there_ = 0;  // nodes that are not gone
};

/// Axis and angle of a turn.
std::vector<double> axis_angle(const wbt::Affine& frame, bool nue);
/// Without scale.
wbt::Affine rigid(const wbt::Affine& frame);

}  // namespace programs
