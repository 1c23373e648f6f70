// SPDX-License-Identifier: MIT
#include "programs/world/nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "programs/world/bodies.h"
#include "programs/world/robot_fields.h"
#include "sim_core/base/hash.h"

namespace programs {

namespace {

constexpr std::size_t kMostMembers = 1'000'000;  // numbers or texts of one list
constexpr double kFastest = 1000;                // m/s, rad/s
constexpr std::size_t kMostText = 4096;          // characters of a field; Webots' own are shorter

std::string text_of(const link_record& r, int which) {
  return std::string(r.texts[which].bytes ? r.texts[which].bytes : "", r.texts[which].size);
}

std::vector<double> numbers_of(const link_record& r) {
  return std::vector<double>(r.lists[0].values, r.lists[0].values + r.lists[0].count);
}

bool are_finite(const std::vector<double>& numbers) {
  for (const double x : numbers)
    if (!std::isfinite(x)) return false;
  return true;
}

bool is_place(const std::string& field) { return field == "translation" || field == "rotation"; }

}  // namespace

struct Nodes::Inside {
  explicit Inside(SupervisorHost& its_host) : host(its_host) { begin(); }

  /// Handles stay: the same world gives the same numbers.
  void begin() {
    its_bodies.emplace(host.twin());
    its_bodies->moved = [this](int robot) { host.note_moved(robot); };
  }

  /// A field that a program has asked for.
  struct Handle {
    int node;
    std::string name;
    int type;
    enum class Of { Tree, Robot, Colour } of;
    NamedRobotField asked;  // Of::Robot
  };

  /// What comes with the steps of a program.
  struct Followed {
    int node;
    std::int64_t field;  // 0: of the node itself
    int what;
    bool operator==(const Followed& other) const {
      return node == other.node && field == other.field && what == other.what;
    }
  };

  SupervisorHost& host;
  std::map<int, std::vector<Followed>> followed;  // by program
  std::optional<Bodies> its_bodies;
  std::map<int, int> supervisors;  // program, supervisor
  std::vector<Handle> handles;
  std::map<std::pair<int, std::string>, int> numbers;  // of handles
  std::set<std::pair<int, std::string>> warned;

  Bodies& bodies() { return *its_bodies; }
  Tree& tree() { return bodies().tree(); }

  void warn(int program, const std::string& text) {
    constexpr std::size_t kMostTold = 200;  // different texts; more would help nobody
    if (warned.size() < kMostTold && warned.insert({program, text}).second) host.warn(program, text);
  }

  static void nothing(link_packet& out, const std::string& why) {
    link_begin(&out, LINK_NOTHING);
    link_bytes(&out, why.data(), why.size());
    link_end(&out);
  }

  /// Whatever a program writes is in the digest.
  void note(int id, const std::string& name, const std::vector<double>& values, const std::string& text) {
    std::uint64_t h = static_cast<std::uint64_t>(id);
    for (const char c : name + "=" + text)
      h = sim::fold(h, static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
    for (const double v : values) h = sim::fold(h, v);
    host.twin().simulation().note_intervention(h);
  }

  // --- nodes

  void tell_node(int id, link_packet& out) {
    const TreeNode& n = tree().node(id);
    link_begin(&out, LINK_NODE);
    link_int(&out, id);
    link_int(&out, n.parent);
    link_int(&out, kind_number(n.base));
    link_text(&out, n.def.c_str());
    link_text(&out, n.type.c_str());
    link_text(&out, n.base.c_str());
    link_end(&out);
  }

  int own_node(int program, int robot) {
    if (robot >= 0) return bodies().node_of(Is::Robot, robot);
    const auto found = supervisors.find(program);
    return found == supervisors.end() ? 0 : bodies().node_of(Is::Supervisor, found->second);
  }

  void find_node(const link_record& r, int program, int robot, link_packet& out) {
    enum By { Root, Own, Def, Number, Device, Selected };
    const int number = static_cast<int>(r.ints[1]);
    const std::string def = text_of(r, 0);
    int id = 0;
    std::string why;
    // By what the program knows it.
    switch (r.ints[0]) {
      case Root:
        id = Tree::kRoot;
        break;
      case Own:
        id = own_node(program, robot);
        why = "the program has no node of its own";
        break;
      case Def:
        id = tree().find_def(def);
        if (id == 0) id = tree().find_name(def);  // worlds of ours often have names only
        why = fmt::format("got '{}', expected the DEF of a node", def);
        break;
      case Number:
        id = tree().has(number) ? number : 0;
        why = fmt::format("got number {}, expected that of a node that is there", number);
        break;
      case Device: {
        const std::string name = host.device_name(program, number);
        const int own = own_node(program, robot);
        for (const int n : own ? tree().below(own) : std::vector<int>{})
          if (n != own && !name.empty() && id == 0 && tree().node(n).text("name") == name) id = n;
        why = fmt::format("the device{} has no node in the world", name.empty() ? "" : " '" + name + "'");
        break;
      }
      default:
        why = "nobody selects anything here";
    }
    if (id != 0)
      tell_node(id, out);
    else
      nothing(out, why);
  }

  enum About { Position, Axes, Speed, Centre, Contacts, Pose, Balance, Fields };

  std::vector<double> about_node(int id, std::int64_t what) {
    const wbt::Affine at = bodies().pose(id);
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> rows = at.matrix();
    std::vector<double> values;
    switch (what) {
      case Position:
        return {at.translation().begin(), at.translation().end()};
      case Axes:
        for (int i = 0; i < 9; ++i) values.push_back(rows(i / 3, i % 3));
        return values;
      case Speed:
        return bodies().velocity(id);
      case Centre: {
        const wbt::Vec3 centre = bodies().centre_of_mass(id);
        return {centre.begin(), centre.end()};
      }
      case Pose:
        return {rows.data(), rows.data() + rows.size()};
      case Balance:
        return {1};
      case Fields:
        return {static_cast<double>(tree().node(id).values.size())};
      default:
        return {};  // no points of contact
    }
  }

  void ask_node(const link_record& r, link_packet& out) {
    const int id = static_cast<int>(r.ints[0]);
    if (!tree().has(id)) return nothing(out, fmt::format("node {} is not there any more", id));
    if (r.ints[1] < Position || r.ints[1] > Fields)
      return nothing(out, fmt::format("got question {} about a node, expected 0 to 7", r.ints[1]));
    tell_value(out, r.ints[1] == Contacts ? 0 : -1, 0, about_node(id, r.ints[1]), "");
  }

  // --- what programs follow

  /// Numbers that time and supervisors change, and no robot's program in its turn.
  bool stands_until_commanded(const Handle& h) {
    if (is_list(h.type) || member_of(h.type) == kText || member_of(h.type) == kNode) return false;
    if (h.of != Handle::Of::Robot || !host.twin().launch(tree().node(h.node).number)) return true;
    const RobotField::What what = h.asked.field->what;
    return what == RobotField::What::Collisions || what == RobotField::What::LongestWallTouch ||
           what == RobotField::What::Distance;
  }

  void follow(const link_record& r, int program) {
    constexpr std::size_t kMostFollowed = 4096;
    const Followed one{static_cast<int>(r.ints[0]), r.ints[1], static_cast<int>(r.ints[2])};
    const Handle* const h = one.field == 0 ? nullptr : handle(one.field);
    const bool is_known =
        one.field == 0 ? one.what >= Position && one.what <= Pose && one.what != Contacts : h != nullptr;
    if (!is_known || !tree().has(one.node))
      return warn(program,
                  fmt::format("got FOLLOW of node {}, field {}, what {}, expected a field or a question "
                              "about a place",
                              r.ints[0], r.ints[1], r.ints[2]));
    if (h && !stands_until_commanded(*h)) return;  // the program goes on asking
    std::vector<Followed>& of_program = followed[program];
    const auto found = std::find(of_program.begin(), of_program.end(), one);
    if (r.ints[3] == 0 && found != of_program.end()) of_program.erase(found);
    if (r.ints[3] != 0 && found == of_program.end() && of_program.size() < kMostFollowed)
      of_program.push_back(one);
  }

  void tell_followed(int program, link_packet& out) {
    for (const Followed& one : followed[program]) {
      std::vector<double> numbers;
      if (one.field == 0 && tree().has(one.node)) {
        numbers = about_node(one.node, one.what);
      } else if (const Handle* h = handle(one.field)) {
        Value v;
        if (read(*h, v).empty()) numbers = std::move(v.numbers);
      }
      if (numbers.empty()) continue;
      link_begin(&out, LINK_FOLLOWED);
      link_int(&out, one.node);
      link_int(&out, one.field);
      link_int(&out, one.what);
      link_numbers(&out, numbers.data(), numbers.size());
      link_end(&out);
    }
  }

  static void tell_value(link_packet& out, int count, int node, const std::vector<double>& values,
                         const std::string& text) {
    link_begin(&out, LINK_VALUE);
    link_int(&out, count);
    link_int(&out, node);
    link_numbers(&out, values.data(), values.size());
    link_bytes(&out, text.data(), text.size());
    link_end(&out);
  }

  void do_node(const link_record& r, int program) {
    enum What { Velocity, Rest, Restart, Go, Force, Torque, Save, Load };
    const int id = static_cast<int>(r.ints[0]);
    if (!tree().has(id)) return warn(program, fmt::format("node {} is not there any more", id));
    const TreeNode& n = tree().node(id);
    std::vector<double> v = numbers_of(r);
    const std::string name = n.def.empty() ? n.type : n.def, text = text_of(r, 0);
    // What the program does to it.
    switch (r.ints[1]) {
      case Velocity:
        v.resize(6);
        for (const double part : v)
          if (!(std::abs(part) <= kFastest))
            return warn(program, fmt::format("a velocity: got {}, expected at most {:g} m/s or rad/s", part,
                                             kFastest));
        if (!bodies().set_velocity(id, v)) warn(program, name + " stands fast: it gets no velocity");
        break;
      case Rest:
        bodies().set_velocity(id, std::vector<double>(6));
        break;
      case Restart:
        if (n.is != Is::Robot) return warn(program, name + " is no robot whose program could begin again");
        host.restart_program(n.number);
        break;
      case Go:
        remove(id, program);
        break;
      case Force:
      case Torque:
        warn(program, "forces and torques from outside do nothing here; set a velocity");
        break;
      case Save:
        bodies().save(id, text);
        break;
      case Load:
        if (!bodies().load(id, text)) warn(program, fmt::format("{}: no state '{}' was kept", name, text));
        break;
      default:
        warn(program, fmt::format("got command {} for a node, expected 0 to 7", r.ints[1]));
    }
  }

  void remove(int id, int program) {
    if (id == Tree::kRoot) return warn(program, "the root of the world stays");
    std::string told;
    bodies().remove(id, told);
    note(id, "remove", {}, "");
    if (!told.empty()) warn(program, told);
  }

  // --- fields

  /// The field of a node by its name; null: there is none.
  const Handle* find_handle(int id, const std::string& name, int& number) {
    const auto known = numbers.find({id, name});
    if (known != numbers.end()) {
      number = known->second;
      return &handles[static_cast<std::size_t>(number - 1)];
    }
    const TreeNode& n = tree().node(id);
    Handle made{id, name, kNoField, Handle::Of::Tree,
                n.is == Is::Robot ? robot_field(name) : NamedRobotField{}};
    sim::Colour colour;
    if (const Value* v = n.find(name)) {
      made.type = v->type;
    } else if (made.asked.field) {
      made.type = made.asked.field->type;
      made.of = Handle::Of::Robot;
    } else if ((name == "baseColor" || name == "diffuseColor") && bodies().colour(id, colour)) {
      made.type = kColour;
      made.of = Handle::Of::Colour;
    } else if (name == "data" && n.find("customData")) {  // as it was called
      return find_handle(id, "customData", number);
    } else {
      return nullptr;
    }
    handles.push_back(made);
    number = static_cast<int>(handles.size());
    numbers[{id, name}] = number;
    return &handles.back();
  }

  /// Null: no such number, or its node is gone.
  const Handle* handle(std::int64_t number) {
    if (number < 1 || number > static_cast<std::int64_t>(handles.size())) return nullptr;
    const Handle& h = handles[static_cast<std::size_t>(number - 1)];
    return tree().has(h.node) ? &h : nullptr;
  }

  std::string name_of(const Handle& h) {
    const TreeNode& n = tree().node(h.node);
    return (n.def.empty() ? n.type : n.def) + "." + h.name;
  }

  /// What a field holds now.
  std::string read(const Handle& h, Value& value) {
    value.name = h.name;
    value.type = h.type;
    const TreeNode& n = tree().node(h.node);
    if (h.of == Handle::Of::Robot)
      return get_robot_field(host.twin(), n.number, h.asked, value.numbers, value.texts);
    if (h.of == Handle::Of::Colour) {
      sim::Colour c;
      bodies().colour(h.node, c);
      value.numbers = {c.r, c.g, c.b};
      return {};
    }
    if (is_place(h.name))
      value.numbers = bodies().place(h.node, h.name);
    else if (const Value* v = n.find(h.name))
      value = *v;
    return {};
  }

  void tell_field(int number, link_packet& out) {
    const Handle& h = handles[static_cast<std::size_t>(number - 1)];
    Value v;
    read(h, v);
    link_begin(&out, LINK_FIELD);
    link_int(&out, number);
    link_int(&out, h.type);
    link_int(&out, v.count());
    link_text(&out, h.name.c_str());
    link_end(&out);
  }

  void find_field(const link_record& r, link_packet& out) {
    const int id = static_cast<int>(r.ints[0]);
    std::string name = text_of(r, 0);
    if (!tree().has(id)) return nothing(out, fmt::format("node {} is not there any more", id));
    const TreeNode& n = tree().node(id);
    if (r.ints[1] >= 0) {
      if (r.ints[1] >= static_cast<std::int64_t>(n.values.size()))
        return nothing(out, fmt::format("got field number {}, expected 0 to {}", r.ints[1],
                                        static_cast<int>(n.values.size()) - 1));
      name = n.values[static_cast<std::size_t>(r.ints[1])].name;
    }
    int number = 0;
    if (!find_handle(id, name, number))
      return nothing(out, fmt::format("a {} has no field '{}' here", n.type, name));
    tell_field(number, out);
  }

  void get(const link_record& r, link_packet& out) {
    const Handle* h = handle(r.ints[0]);
    if (!h) return nothing(out, fmt::format("field {} is not there any more", r.ints[0]));
    Value v;
    const std::string wrong = read(*h, v);
    if (!wrong.empty()) return nothing(out, name_of(*h) + ": " + wrong);
    const int count = v.count();
    std::int64_t index = 0;
    if (count >= 0) {
      index = r.ints[1] < 0 ? r.ints[1] + count : r.ints[1];  // from the end
      if (index < 0 || index >= count)
        return nothing(out,
                       fmt::format("{}: got member {}, expected one of {}", name_of(*h), r.ints[1], count));
    }
    const std::size_t at = static_cast<std::size_t>(index), width = width_of(v.type);
    if (member_of(v.type) == kNode) {
      const int node = at < v.nodes.size() ? v.nodes[at] : 0;
      return tell_value(out, count, node, {}, "");
    }
    if (member_of(v.type) == kText)
      return tell_value(out, count, 0, {}, at < v.texts.size() ? v.texts[at] : "");
    v.numbers.resize(std::max(v.numbers.size(), (at + 1) * width));
    std::vector<double> values(v.numbers.begin() + static_cast<std::ptrdiff_t>(at * width),
                               v.numbers.begin() + static_cast<std::ptrdiff_t>((at + 1) * width));
    tell_value(out, count, 0, values, "");
  }

  /// What a field of a running robot cannot be set to any more.
  static bool is_settled(const TreeNode& n, const std::string& name) {
    if (n.is != Is::Robot && n.is != Is::Supervisor) return false;
    return name == "controller" || name == "controllerArgs" || name == "supervisor" ||
           name == "synchronization";
  }

  void set(const link_record& r, int program) {
    const Handle* h = handle(r.ints[0]);
    if (!h) return warn(program, fmt::format("field {} is not there any more", r.ints[0]));
    const std::vector<double> given = numbers_of(r);
    const std::string text = text_of(r, 0);
    const std::size_t width = width_of(h->type);
    const auto refuse = [&](const std::string& why) { warn(program, name_of(*h) + ": " + why); };
    if (given.size() != width)
      return refuse(
          fmt::format("got {} numbers, expected {} ({})", given.size(), width, field_type_name(h->type)));
    if (!are_finite(given)) return refuse("got a number that is none, expected finite ones");
    if (text.size() > kMostText)
      return refuse(fmt::format("got {} characters, expected at most {}", text.size(), kMostText));
    TreeNode& n = tree().node(h->node);
    std::string wrong;
    if (h->of == Handle::Of::Robot) {
      wrong = set_robot_field(host.twin(), n.number, h->asked, given.empty() ? 0 : given[0]);
    } else if (h->of == Handle::Of::Colour) {
      const auto part = [&](std::size_t i) { return std::min(1.0, std::max(0.0, given[i])); };
      bodies().set_colour(h->node, {part(0), part(1), part(2)});
      note(h->node, h->name, given, "");
    } else if (is_place(h->name) && !given.empty() && n.find(h->name)) {
      wrong = bodies().set_place(h->node, h->name, given);
      note(h->node, h->name, given, "");
    } else if (is_settled(n, h->name)) {
      wrong = "stays as it is during a run";
    } else {
      wrong = write(*h, static_cast<int>(r.ints[1]), given, text);
    }
    if (!wrong.empty()) refuse(wrong);
  }

  /// A value that the tree keeps, and what follows from it.
  std::string write(const Handle& h, int index, const std::vector<double>& given, const std::string& text) {
    Value* v = tree().node(h.node).find(h.name);
    if (!v || member_of(v->type) == kNode) return "a node is imported or removed, not set";
    const int count = v->count();
    std::size_t at = 0;
    if (count >= 0) {
      if (index < 0) index += count;
      if (index < 0 || index >= count) return fmt::format("got member {}, expected one of {}", index, count);
      at = static_cast<std::size_t>(index);
    }
    v->written = true;
    if (member_of(v->type) == kText)
      v->texts.resize(std::max(v->texts.size(), at + 1)), v->texts[at] = text;
    else
      std::copy(given.begin(), given.end(),
                v->numbers.begin() + static_cast<std::ptrdiff_t>(at * given.size()));
    follow(h, given, text);
    return {};
  }

  void follow(const Handle& h, const std::vector<double>& given, const std::string& text) {
    const TreeNode& n = tree().node(h.node);
    note(h.node, h.name, given, text);
    if (n.is == Is::Lamp) return bodies().lamp_changed(h.node);
    if (h.name == "customData" && n.is == Is::Robot) return host.note_custom_data(n.number, text);
    if (h.name == "recognitionColors") return bodies().set_recognition(h.node, n.find(h.name)->numbers);
    static const std::set<std::string> kSilent{
        "name",         "customData",      "model",        "description",   "controller", "translationStep",
        "rotationStep", "contactMaterial", "transparency", "emissiveColor", "castShadows"};
    if (!kSilent.count(h.name)) bodies().changed(h.node);
  }

  void insert(const link_record& r, int program) {
    const Handle* h = handle(r.ints[0]);
    if (!h) return warn(program, fmt::format("field {} is not there any more", r.ints[0]));
    // It takes a number, a text or a vector of the field's kind, at a place that the list has.
    Value* v = h->of == Handle::Of::Tree ? tree().node(h->node).find(h->name) : nullptr;
    const std::vector<double> given = numbers_of(r);
    const std::string text = text_of(r, 0);
    if (!v || !is_list(v->type) || member_of(v->type) == kNode || given.size() != width_of(v->type) ||
        !are_finite(given) || text.size() > kMostText || v->numbers.size() + v->texts.size() > kMostMembers)
      return warn(program, name_of(*h) + ": takes no such member");
    const int count = v->count();
    const std::int64_t index = r.ints[1] < 0 ? r.ints[1] + count + 1 : r.ints[1];
    if (index < 0 || index > count)
      return warn(program, fmt::format("{}: got place {}, expected 0 to {}", name_of(*h), r.ints[1], count));
    // It goes in there, and the world follows.
    v->written = true;
    if (member_of(v->type) == kText)
      v->texts.insert(v->texts.begin() + index, text);
    else
      v->numbers.insert(v->numbers.begin() + index * static_cast<std::ptrdiff_t>(given.size()), given.begin(),
                        given.end());
    follow(*h, given, text);
  }

  void remove_member(const link_record& r, int program) {
    const Handle* h = handle(r.ints[0]);
    if (!h) return warn(program, fmt::format("field {} is not there any more", r.ints[0]));
    // A field of one node empties itself; a list loses a member that it has.
    Value* v = h->of == Handle::Of::Tree ? tree().node(h->node).find(h->name) : nullptr;
    if (!v) return warn(program, name_of(*h) + ": has no members");
    if (!is_list(v->type)) {
      if (member_of(v->type) == kNode && !v->nodes.empty()) return remove(v->nodes.front(), program);
      return warn(program, name_of(*h) + ": has no members");
    }
    const int count = v->count();
    const std::int64_t index = r.ints[1] < 0 ? r.ints[1] + count : r.ints[1];
    if (index < 0 || index >= count)
      return warn(program,
                  fmt::format("{}: got member {}, expected one of {}", name_of(*h), r.ints[1], count));
    if (member_of(v->type) == kNode) return remove(v->nodes[static_cast<std::size_t>(index)], program);
    const std::ptrdiff_t width = static_cast<std::ptrdiff_t>(width_of(v->type));
    if (member_of(v->type) == kText)
      v->texts.erase(v->texts.begin() + index);
    else
      v->numbers.erase(v->numbers.begin() + index * width, v->numbers.begin() + (index + 1) * width);
    follow(*h, {static_cast<double>(index)}, "");
  }

  void import(const link_record& r, link_packet& out) {
    const Handle* h = handle(r.ints[0]);
    if (!h) return nothing(out, fmt::format("field {} is not there any more", r.ints[0]));
    const Value* v = h->of == Handle::Of::Tree ? tree().node(h->node).find(h->name) : nullptr;
    if (!v || member_of(v->type) != kNode)
      return nothing(out, fmt::format("{}: got a field of {}, expected one of nodes", name_of(*h),
                                      field_type_name(h->type)));
    // Where among its nodes the new one goes.
    const int count = v->count();
    std::int64_t index = r.ints[1];
    if (index < 0) index = index + count + 1;  // -1: at the end
    if (count >= 0 && (index < 0 || index > count))
      return nothing(
          out, fmt::format("{}: got place {}, expected -{} to {}", name_of(*h), r.ints[1], count + 1, count));
    if (count < 0 && !v->nodes.empty()) return nothing(out, name_of(*h) + ": holds a node already");
    // What is needed of the field afterwards is kept: handles may move.
    const std::string text = text_of(r, 0);
    const int node = h->node;
    const std::string name = h->name;
    const std::string wrong =
        bodies().import(node, name, index >= count ? -1 : static_cast<int>(index), text);
    if (!wrong.empty()) return nothing(out, name_of(*h) + ": " + wrong);
    note(node, name, {}, text);
    tell_field(static_cast<int>(r.ints[0]), out);
  }

  // --- the world

  void do_world(const link_record& r, int program) {
    enum What { End, Reset, Reload, RestAll, Label, Picture, Mode };
    std::vector<double> v = numbers_of(r);
    const std::string text = text_of(r, 0);
    switch (r.ints[0]) {
      case End: {
        const double status = v.empty() || !std::isfinite(v[0]) ? 0 : std::min(255.0, std::max(-255.0, v[0]));
        host.end_run(static_cast<int>(status),
                     text.empty()
                         ? fmt::format("its program ended the run with status {}", static_cast<int>(status))
                         : text);
        break;
      }
      case Reset:
      case Reload:
        host.reset(r.ints[0] == Reload);
        break;
      case RestAll:
        bodies().rest_all();
        break;
      case Label: {
        v.resize(6);
        if (!are_finite(v)) return warn(program, "a label: got a number that is none, expected finite ones");
        // Numbers of programs may be anything, so each is brought into its range.
        const auto part = [](double x) { return std::min(1.0, std::max(0.0, x)); };
        sim::PictureLabel label;
        label.id = static_cast<int>(std::min(1e6, std::max(0.0, v[0])));
        label.text = text;
        label.x = part(v[1]);
        label.y = part(v[2]);
        label.size = part(v[3]);
        label.rgb = static_cast<std::uint32_t>(
                        static_cast<std::int64_t>(std::min(4294967295.0, std::max(0.0, v[4])))) &
                    0xFFFFFF;
        label.transparency = part(v[5]);
        host.set_label(program, label);
        break;
      }
      case Picture: {
        const std::size_t dot = text.rfind('.');
        const std::string kind = dot == std::string::npos ? "" : text.substr(dot);
        if (kind == ".png" || kind == ".svg") return host.picture(text);
        host.picture(text + ".png");
        return warn(
            program,
            fmt::format("wb_supervisor_export_image(): got '{}', expected a name that ends in .png or .svg; "
                        "the picture is {}.png",
                        text, text));
      }
      case Mode:
        break;  // the run goes as fast as it can
      default:
        warn(program, fmt::format("got command {} for the world, expected 0 to 6", r.ints[0]));
    }
  }
};

Nodes::Nodes(SupervisorHost& host) : inside_(std::make_unique<Inside>(host)) {}
Nodes::~Nodes() = default;

void Nodes::begin_again() { inside_->begin(); }

void Nodes::attach(int program, int supervisor) { inside_->supervisors[program] = supervisor; }

void Nodes::set_custom_data(int robot, const std::string& text) {
  if (const int id = inside_->bodies().node_of(Is::Robot, robot)) inside_->tree().set(id, "customData", text);
}

void Nodes::answer(const link_record& question, int program, int robot, link_packet& answer) {
  switch (question.number) {
    case LINK_FIND_NODE:
      return inside_->find_node(question, program, robot, answer);
    case LINK_FIND_FIELD:
      return inside_->find_field(question, answer);
    case LINK_GET:
      return inside_->get(question, answer);
    case LINK_IMPORT:
      return inside_->import(question, answer);
    case LINK_ASK_NODE:
      return inside_->ask_node(question, answer);
    default:
      return Inside::nothing(answer, "no question about nodes");
  }
}

void Nodes::tell_followed(int program, link_packet& out) { inside_->tell_followed(program, out); }
void Nodes::forget_followed(int program) { inside_->followed.erase(program); }

void Nodes::carry_out(const link_record& command, int program, int) {
  switch (command.number) {
    case LINK_SET:
      return inside_->set(command, program);
    case LINK_INSERT:
      return inside_->insert(command, program);
    case LINK_REMOVE:
      return inside_->remove_member(command, program);
    case LINK_DO_NODE:
      return inside_->do_node(command, program);
    case LINK_DO_WORLD:
      return inside_->do_world(command, program);
    case LINK_FOLLOW:
      return inside_->follow(command, program);
    default:
      break;
  }
}

}  // namespace programs
