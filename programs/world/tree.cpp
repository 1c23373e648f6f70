// SPDX-License-Identifier: MIT
#include "programs/world/tree.h"

#include <algorithm>
#include <cmath>

namespace programs {

using wbt::Affine;
using wbt::Vec3;

namespace {

/// As a node has it of which nothing is said.
Value usual(const FieldRow& row) {
  Value v;
  v.name = row.name;
  v.type = row.type;
  v.numbers = row.numbers;
  if (row.type == kText) v.texts = {row.text};
  return v;
}

/// What a field is that no table knows, by what stands in it.
int guessed_type(const wbt::Field& f) {
  if (!f.nodes.empty()) return f.nodes.size() == 1 ? kNode : kNode + kList;
  if (!f.strings.empty()) return f.strings.size() == 1 ? kText : kText + kList;
  if (f.truth) return kBool;
  switch (f.numbers.size()) {
    case 1:
      return kFloat;
    case 2:
      return kVec2;
    case 3:
      return kVec3;
    case 4:
      return kTurn;
    case 0:
      return kNode;
    default:
      return kFloat + kList;
  }
}

int type_of(const std::string& node_type, const wbt::Field& f) {
  for (const FieldRow& row : fields_of(node_type))
    if (row.name == f.name) return row.type;
  const int usual = fields_of(node_type).empty() ? usual_field_type(f.name) : kNoField;
  return usual != kNoField ? usual : guessed_type(f);
}

}  // namespace

int Value::count() const {
  if (!is_list(type)) return -1;
  if (member_of(type) == kNode) return static_cast<int>(nodes.size());
  if (member_of(type) == kText) return static_cast<int>(texts.size());
  return static_cast<int>(numbers.size() / width_of(type));
}

Value* TreeNode::find(const std::string& name) {
  for (Value& v : values)
    if (v.name == name) return &v;
  return nullptr;
}

std::vector<double> TreeNode::numbers(const std::string& name, std::vector<double> otherwise) const {
  const Value* v = find(name);
  if (v && v->numbers.size() >= otherwise.size()) return v->numbers;
  return otherwise;
}

std::string TreeNode::text(const std::string& name) const {
  const Value* v = find(name);
  return v && !v->texts.empty() ? v->texts.front() : "";
}

Tree::Tree() { make("Group", "", 0); }

TreeNode& Tree::make(const std::string& type, const std::string& def, int parent) {
  nodes_.emplace_back();
  TreeNode& n = nodes_.back();
  n.id = count();
  ++there_;
  n.parent = parent;
  n.type = type;
  n.base = base_of(type);
  n.def = def;
  for (const FieldRow& row : fields_of(type)) n.values.push_back(usual(row));
  return n;
}

void Tree::attach(int id, int parent, const std::string& field, int index) {
  TreeNode& above = node(parent);
  Value* v = above.find(field);
  if (!v) {
    above.values.emplace_back();
    v = &above.values.back();
    v->name = field;
    v->type = kNode + kList;
  }
  v->written = true;
  if (!is_list(v->type)) {
    v->nodes = {id};
    return;
  }
  const int count = static_cast<int>(v->nodes.size());
  const int at = index < 0 || index > count ? count : index;
  v->nodes.insert(v->nodes.begin() + at, id);
}

int Tree::add(const std::string& type, const std::string& def, int parent, const std::string& field) {
  const int id = make(type, def, parent).id;
  attach(id, parent, field, -1);
  return id;
}

int Tree::add(const wbt::Node& from, int parent, const std::string& field, int index,
              wbt::ProtoFiles& protos) {
  int depth = 0;
  for (int at = parent; at != 0; at = node(at).parent) ++depth;
  if (there_ >= kMostTreeNodes || depth >= kDeepest) return 0;
  TreeNode& n = make(from.type, from.def, parent);
  const int id = n.id;
  lines_[from.line].push_back(id);
  // a PROTO of the project: its own fields, and what it is made of at last
  const wbt::Proto* proto = protos.find(from.type);
  const auto fill = [&](const wbt::Field& f, bool written) {
    TreeNode& into = node(id);
    Value* v = into.find(f.name);
    if (!v) {
      into.values.emplace_back();
      v = &into.values.back();
      v->name = f.name;
      v->type = type_of(from.type, f);
    }
    v->written = written;
    v->texts = f.strings;
    if (!is_list(v->type) && member_of(v->type) == kText) v->texts.resize(1);
    v->numbers = f.numbers;
    if (f.truth && v->numbers.empty()) v->numbers = {*f.truth ? 1.0 : 0.0};
    if (!is_list(v->type)) v->numbers.resize(width_of(v->type));
    v->nodes.clear();
    if (member_of(v->type) != kNode) return;
    for (const wbt::NodePtr& inner : f.nodes) add(*inner, id, f.name, -1, protos);
  };
  if (proto) {
    for (const wbt::Field& f : proto->defaults)
      if (!from.field(f.name)) fill(f, false);
    std::string type = from.type;
    for (int depth = 0; depth < 8 && protos.find(type); ++depth) {
      const std::string& body = protos.find(type)->body;
      const std::size_t brace = body.find('{');
      std::size_t end = body.find_last_not_of(" \t\r\n", brace == std::string::npos ? brace : brace - 1);
      if (brace == std::string::npos || brace == 0 || end == std::string::npos) break;
      const std::size_t begin = body.find_last_of(" \t\r\n", end);
      type = body.substr(begin == std::string::npos ? 0 : begin + 1,
                         end - (begin == std::string::npos ? 0 : begin + 1) + 1);
    }
    node(id).base = base_of(type);
  } else if (fields_of(from.type).empty() && kind_number(from.type) == 0) {
    node(id).base = "Solid";  // a PROTO from elsewhere
  }
  for (const wbt::Field& f : from.fields) fill(f, true);
  // whatever is placed can be asked for its place
  for (const FieldRow& row : fields_of(node(id).base))
    if (!node(id).find(row.name)) node(id).values.push_back(usual(row));
  attach(id, parent, field, index);
  return id;
}

Value& Tree::set(int id, const std::string& name, int type, std::vector<double> numbers) {
  TreeNode& n = node(id);
  Value* v = n.find(name);
  if (!v) {
    n.values.emplace_back();
    v = &n.values.back();
    v->name = name;
    v->type = type;
  }
  v->type = type;
  v->numbers = std::move(numbers);
  v->written = true;
  return *v;
}

void Tree::set(int id, const std::string& name, const std::string& text) {
  set(id, name, kText, {}).texts = {text};
}

void Tree::remove(int id) {
  const int parent = node(id).parent;
  for (const int n : below(id)) {
    node(n).gone = true;
    node(n).values.clear();
    --there_;
  }
  if (parent != 0) {
    for (Value& v : node(parent).values)
      v.nodes.erase(std::remove(v.nodes.begin(), v.nodes.end(), id), v.nodes.end());
  }
}

int Tree::find_def(const std::string& def) const {
  if (def.empty()) return 0;
  const std::size_t dot = def.find('.');
  if (dot != std::string::npos) {
    const int outer = find_def(def.substr(0, dot));
    if (outer == 0) return 0;
    std::string rest = def.substr(dot + 1);
    const std::string first = rest.substr(0, rest.find('.'));
    int at = 0;
    for (const int n : below(outer))
      if (n != outer && node(n).def == first && at == 0) at = n;
    if (at == 0 || first == rest) return at;
    rest = rest.substr(first.size() + 1);
    for (const int n : below(at))
      if (n != at && node(n).def == rest) return n;
    return 0;
  }
  for (const int n : below(kRoot))
    if (node(n).def == def) return n;
  return 0;
}

int Tree::find_name(const std::string& name) const {
  if (name.empty()) return 0;
  for (const int n : below(kRoot))
    if (node(n).is != Is::Plain && node(n).text("name") == name) return n;
  return 0;
}

std::vector<int> Tree::below(int id) const {
  std::vector<int> all, open{id};
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    if (node(at).gone) continue;
    all.push_back(at);
    const std::size_t from = open.size();
    for (const Value& v : node(at).values) open.insert(open.end(), v.nodes.begin(), v.nodes.end());
    std::reverse(open.begin() + static_cast<std::ptrdiff_t>(from), open.end());
  }
  return all;
}

std::vector<int> Tree::at_line(int line) const {
  const auto found = lines_.find(line);
  return found == lines_.end() ? std::vector<int>{} : found->second;
}

wbt::NodePtr Tree::to_wbt(int id) const {
  const TreeNode& n = node(id);
  auto out = std::make_shared<wbt::Node>();
  out->type = n.type;
  out->def = n.def;
  out->line = id;
  for (const Value& v : n.values) {
    if (!v.written) continue;
    wbt::Field f;
    f.name = v.name;
    f.line = id;
    f.strings = v.texts;
    if (member_of(v.type) == kBool && !v.numbers.empty())
      f.truth = v.numbers.back() != 0;
    else
      f.numbers = v.numbers;
    for (const int inner : v.nodes) f.nodes.push_back(to_wbt(inner));
    out->fields.push_back(std::move(f));
  }
  return out;
}

std::map<std::string, wbt::NodePtr> Tree::defs() const {
  std::map<std::string, wbt::NodePtr> all;
  for (const int n : below(kRoot))
    if (!node(n).def.empty() && !all.count(node(n).def)) all[node(n).def] = to_wbt(n);
  return all;
}

Affine Tree::local(int id) const {
  const TreeNode& n = node(id);
  if (!n.find("translation") && !n.find("rotation")) return {};
  const std::vector<double> t = n.numbers("translation", {0, 0, 0}), r = n.numbers("rotation", {0, 0, 1, 0});
  Affine own = wbt::turned({r[0], r[1], r[2]}, r[3]);
  own.translation() = Vec3(t[0], t[1], t[2]);
  if (n.base == "Transform") {
    const std::vector<double> s = n.numbers("scale", {1, 1, 1});
    own.scale(Vec3(s[0], s[1], s[2]));
  }
  return own;
}

std::vector<double> axis_angle(const Affine& frame, bool nue) {
  const auto& m = frame.matrix();
  // the usual case first: about what is up
  const int up = nue ? 1 : 2;
  if (m(up, up) > 1 - 1e-12)
    return nue ? std::vector<double>{0, 1, 0, std::atan2(m(0, 2), m(2, 2))}
               : std::vector<double>{0, 0, 1, std::atan2(m(1, 0), m(0, 0))};
  const Eigen::AngleAxisd turn(frame.linear());
  return {turn.axis().x(), turn.axis().y(), turn.axis().z(), turn.angle()};
}

Affine rigid(const Affine& frame) {
  Affine out = frame;
  for (int i = 0; i < 3; ++i)
    if (const double n = out.linear().col(i).norm(); n > 1e-12) out.linear().col(i) /= n;
  return out;
}

}  // namespace programs
