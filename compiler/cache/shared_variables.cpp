// SPDX-License-Identifier: MIT
// See shared_variables.h. The points-to sets are Andersen's: constraints between nodes,
// solved by a work list.
#include "shared_variables.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <sstream>

namespace cc {
namespace {

struct CallSite {
  int caller, result;          // object of the calling function; node or -1
  std::vector<int> arguments;  // nodes or -1
};

struct PointerNode {
  std::set<int> points_to;  // objects
  std::vector<int> copied_to, loaded_to, stored_from;
  std::vector<int> calls;  // through this node
};

struct MemoryObject {
  std::string name;  // in C
  int content = -1;  // node: what lies in it
  bool has_body = false, is_handler = false, is_variadic = false, is_program = false, is_local = false;
  std::set<int> callees;
  std::vector<int> written;  // nodes through which it writes, of a function
};

struct PlainRead {
  int function, node;
  bool may_be_once;
  std::size_t file;
  std::string token, where;
};

class SharedSolver {
 public:
  explicit SharedSolver(const std::vector<FileFacts>& files) {
    for (std::size_t i = 0; i < files.size(); ++i) find_bodies(files[i], i);
    for (std::size_t i = 0; i < files.size(); ++i) read(files[i], i);
    solve();
  }

  SharedVariables answer(const std::vector<FileFacts>& files) {
    SharedVariables all;
    all.nodes.resize(files.size());
    find_shared();
    std::set<int> told;
    for (const PlainRead& read : reads_)
      for (int o : nodes_[std::size_t(read.node)].points_to) {
        const auto writers = writers_.find(o);
        if (writers == writers_.end()) continue;
        // code of one handler alone is not interrupted by itself
        const std::set<int>& readers = contexts_[read.function];
        if (readers.empty() || (writers->second.size() == 1 && readers == writers->second)) continue;
        all.nodes[read.file].insert(read.token);
        const MemoryObject& variable = objects_[std::size_t(o)];
        if (!read.may_be_once || !files[read.file].is_told) continue;
        if (told.insert(o).second)
          all.reads.push_back(
              {read.where, variable.name, objects_[std::size_t(*writers->second.begin())].name});
      }
    std::stable_sort(all.reads.begin(), all.reads.end(), [&](const SharedRead& a, const SharedRead& b) {
      return file_and_line(a.where) < file_and_line(b.where);
    });
    return all;
  }

 private:
  // --- names

  std::string full_name(const std::string& token, std::size_t file) const {
    const std::size_t name_at = token[0] == '&' ? 1 : 0;
    const char first = token[name_at];
    const bool is_own = first == '%' || first == '.' || second_handlers_.count({file, token.substr(name_at)});
    return is_own ? token + "@" + std::to_string(file) : token;
  }
  int object(const std::string& name, std::size_t file) {  // without "&"
    const auto [at, is_new] = object_numbers_.emplace(full_name(name, file), int(objects_.size()));
    if (is_new) {
      objects_.emplace_back();
      // "f.count" is the variable count of f that lasts, "%7.n" one that does not
      objects_.back().name = name_in_c(name);
      objects_.back().is_local = name[0] == '%';
      objects_.back().content = new_node();
    }
    return at->second;
  }
  int new_node() {
    nodes_.emplace_back();
    return int(nodes_.size()) - 1;
  }
  int node(const std::string& token, std::size_t file) {
    if (token == "-") return -1;
    const auto [at, is_new] = node_numbers_.emplace(full_name(token, file), int(nodes_.size()));
    if (!is_new) return at->second;
    const int made = new_node();
    if (token[0] == '&') {
      const int o = object(token.substr(1), file);
      add(made, o);
    }
    return made;
  }
  int node_of(int function, const std::string& part) {
    const auto [at, is_new] = parts_.emplace(std::pair(function, part), int(nodes_.size()));
    if (is_new) new_node();
    return at->second;
  }
  /// "f^0" of a file's text is a part of the function f.
  int node_or_part(const std::string& token, std::size_t file) {
    const std::size_t sign = token.find('^');
    if (sign == std::string::npos) return node(token, file);
    return node_of(object(token.substr(0, sign), file), token.substr(sign + 1));
  }

  // --- reading

  void find_bodies(const FileFacts& facts, std::size_t file) {
    std::istringstream lines(facts.text);
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("F ", 0) != 0) continue;
      std::istringstream words(line.substr(2));
      std::string name, flags;
      words >> name >> flags;
      const bool is_handler = flags.find('h') != std::string::npos;
      // drivers of the library have handlers of one name: which of them is linked is not known here
      const MemoryObject& first = objects_[std::size_t(object(name, file))];
      if (is_handler && first.has_body && !first.is_program) second_handlers_.emplace(file, name);
      MemoryObject& f = objects_[std::size_t(object(name, file))];
      if (f.has_body) continue;
      f.has_body = true;
      f.is_program = facts.is_program;
      f.is_handler = is_handler;
      f.is_variadic = flags.find('v') != std::string::npos;
      home_[object(name, file)] = file;
    }
  }

  void read(const FileFacts& facts, std::size_t file) {
    std::istringstream lines(facts.text);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string kind, a, b;
      words >> kind >> a >> b;
      // Constraints between nodes.
      if (kind == "C" || kind == "L" || kind == "S") {
        const int first = node_or_part(a, file), second = node_or_part(b, file);
        if (kind == "C") copy(first, second);
        if (kind == "L") nodes_[std::size_t(second)].loaded_to.push_back(first);
        if (kind == "S") nodes_[std::size_t(first)].stored_from.push_back(second);
        continue;
      }
      // What a function does. Of one with several bodies only the linked one's counts.
      if (kind != "W" && kind != "R" && kind != "K" && kind != "N") continue;
      const int f = object(a, file);
      if (const auto home = home_.find(f); home == home_.end() || home->second != file) continue;
      if (kind == "W") {
        const int written = node_or_part(b, file);
        objects_[std::size_t(f)].written.push_back(written);
      } else if (kind == "R") {
        std::string once, where;
        words >> once;
        std::getline(words >> std::ws, where);
        const int from = node_or_part(b, file);
        reads_.push_back({f, from, once == "1", file, a + ">" + b, where});
      } else if (kind == "N") {
        name_in_assembler(f, node("&" + b, file));
      } else {
        // a call: who is called, and the nodes of result and arguments
        CallSite site{f, -1, {}};
        std::string word;
        words >> word;
        site.result = word == "-" ? -1 : node_or_part(word, file);
        while (words >> word) site.arguments.push_back(word == "-" ? -1 : node_or_part(word, file));
        const int callee = node_or_part(b, file);
        call(f, callee, site);
      }
    }
  }
  /// Assembler text may read, write and call what it names, and follow the addresses that lie there: it may
  /// leave any of them in any variable that it reaches.
  void name_in_assembler(int f, int named) {
    int& reached = reached_by_assembler_.try_emplace(f, -1).first->second;
    if (reached < 0) {
      reached = new_node();
      nodes_[std::size_t(reached)].loaded_to.push_back(reached);
      nodes_[std::size_t(reached)].stored_from.push_back(reached);
      objects_[std::size_t(f)].written.push_back(reached);
      call(f, reached, {f, -1, {}});
    }
    copy(reached, named);
  }
  void call(int, int callee, CallSite site) {
    calls_.push_back(std::move(site));
    nodes_[std::size_t(callee)].calls.push_back(int(calls_.size()) - 1);
  }

  // --- solving

  void add(int n, int o) {
    if (nodes_[std::size_t(n)].points_to.insert(o).second) work_.emplace_back(n, o);
  }
  void copy(int to, int from) {
    if (to < 0 || from < 0 || to == from || !copies_.emplace(from, to).second) return;
    nodes_[std::size_t(from)].copied_to.push_back(to);
    const std::set<int> known = nodes_[std::size_t(from)].points_to;
    for (int o : known) add(to, o);
  }

  void solve() {
    // everything that was added while reading is looked at with all constraints known
    work_.clear();
    for (std::size_t n = 0; n < nodes_.size(); ++n)
      for (int o : nodes_[n].points_to) work_.emplace_back(int(n), o);
    while (!work_.empty()) {
      const auto [n, o] = work_.back();
      work_.pop_back();
      const int content = objects_[std::size_t(o)].content;
      // by number: these lists and the list of nodes grow meanwhile
      const auto each = [&, n = std::size_t(n)](std::vector<int> PointerNode::*list, const auto& act) {
        for (std::size_t i = 0; i < (nodes_[n].*list).size(); ++i) act((nodes_[n].*list)[i]);
      };
      each(&PointerNode::copied_to, [&, o = o](int to) { add(to, o); });
      each(&PointerNode::loaded_to, [&](int to) { copy(to, content); });
      each(&PointerNode::stored_from, [&](int from) { copy(content, from); });
      each(&PointerNode::calls, [&, o = o](int c) { bind(calls_[std::size_t(c)], o); });
    }
  }

  /// A call reaches function `o`, or something that only assembler text names.
  void bind(const CallSite& site, int o) {
    objects_[std::size_t(site.caller)].callees.insert(o);
    const bool is_known = objects_[std::size_t(o)].has_body;
    // Arguments go into the parameters, and the result comes back.
    if (is_known) {
      const bool is_variadic = objects_[std::size_t(o)].is_variadic;
      for (std::size_t i = 0; i < site.arguments.size(); ++i) {
        copy(node_of(o, std::to_string(i)), site.arguments[i]);
        if (is_variadic) copy(node_of(o, "v"), site.arguments[i]);
      }
      if (site.result >= 0) copy(site.result, node_of(o, "r"));
      if (objects_[std::size_t(o)].is_program) return;
    }
    // What is handed to others may be used by them.
    for (int argument : site.arguments)
      if (argument >= 0) handed_out_.insert(argument);
    if (is_known) return;
    // a function of the libc writes what it is given, and may give it back
    for (int argument : site.arguments) {
      if (argument < 0) continue;
      objects_[std::size_t(site.caller)].written.push_back(argument);
      copy(site.result, argument);
    }
    const std::string& name = objects_[std::size_t(o)].name;
    // these copy what their arguments point to
    if ((name == "memcpy" || name == "memmove") && site.arguments.size() >= 2 && site.arguments[0] >= 0 &&
        site.arguments[1] >= 0) {
      const int between = node_of(o, "between " + std::to_string(&site - calls_.data()));
      nodes_[std::size_t(site.arguments[1])].loaded_to.push_back(between);
      nodes_[std::size_t(site.arguments[0])].stored_from.push_back(between);
      for (int a : {0, 1})
        for (int p : nodes_[std::size_t(site.arguments[std::size_t(a)])].points_to)
          work_.emplace_back(site.arguments[std::size_t(a)], p);
    }
  }

  // --- what is shared

  /// From where each function may be reached: handlers, functions that are handed out, and main().
  void find_contexts() {
    std::set<int> roots;
    for (std::size_t f = 0; f < objects_.size(); ++f)
      if (objects_[f].is_handler && objects_[f].has_body) roots.insert(int(f));
    // functions that the library was given, also within structs
    const auto add_root = [&](int o) {
      if (objects_[std::size_t(o)].has_body) roots.insert(o);
    };
    for (int argument : handed_out_)
      for (int o : nodes_[std::size_t(argument)].points_to) {
        add_root(o);
        for (int inner : nodes_[std::size_t(objects_[std::size_t(o)].content)].points_to) add_root(inner);
      }
    for (int root : roots) reach(root, root);
    const auto main = object_numbers_.find("main");
    if (main != object_numbers_.end() && objects_[std::size_t(main->second)].has_body)
      return reach(main->second, kMainLine);
    // of a file without main() all that others may call
    for (const auto& [name, f] : object_numbers_)
      if (objects_[std::size_t(f)].has_body && name[0] != '.' && !roots.count(f)) reach(f, kMainLine);
  }
  void reach(int f, int root) {
    if (!objects_[std::size_t(f)].has_body || !contexts_[f].insert(root).second) return;
    for (int callee : objects_[std::size_t(f)].callees) reach(callee, root);
  }

  void find_shared() {
    find_contexts();
    // a variable of a function is seen by others when its address lies in a variable of all
    std::set<int> visible;
    std::vector<int> todo;
    for (std::size_t o = 0; o < objects_.size(); ++o)
      if (!objects_[o].is_local) todo.push_back(int(o));
    while (!todo.empty()) {
      const int o = todo.back();
      todo.pop_back();
      for (int inner : nodes_[std::size_t(objects_[std::size_t(o)].content)].points_to)
        if (objects_[std::size_t(inner)].is_local && visible.insert(inner).second) todo.push_back(inner);
    }
    for (const auto& [f, roots] : contexts_)
      for (int written : objects_[std::size_t(f)].written)
        for (int o : nodes_[std::size_t(written)].points_to)
          if (!objects_[std::size_t(o)].has_body && (!objects_[std::size_t(o)].is_local || visible.count(o)))
            for (int root : roots)
              if (root != kMainLine) writers_[o].insert(root);
  }

  static std::pair<std::string, int> file_and_line(const std::string& where) {
    const std::size_t colon = where.rfind(':');
    return {where.substr(0, colon), colon == std::string::npos ? 0 : std::atoi(where.c_str() + colon + 1)};
  }

  static constexpr int kMainLine = -1;  // no function's number
  std::vector<MemoryObject> objects_;
  std::vector<PointerNode> nodes_;
  std::vector<CallSite> calls_;
  std::vector<PlainRead> reads_;
  std::map<std::string, int> object_numbers_, node_numbers_;
  std::map<std::pair<int, std::string>, int> parts_;
  std::map<int, std::size_t> home_;
  std::set<std::pair<std::size_t, std::string>> second_handlers_;  // file and name
  std::set<std::pair<int, int>> copies_;
  std::vector<std::pair<int, int>> work_;
  std::map<int, int> reached_by_assembler_;  // function: node of all that its text reaches
  std::set<int> handed_out_;
  std::map<int, std::set<int>> contexts_;  // function: from where it is reached
  std::map<int, std::set<int>> writers_;   // variable: handlers and the like that write it
};

}  // namespace

SharedVariables shared_variables(const std::vector<FileFacts>& files) {
  return SharedSolver(files).answer(files);
}

std::string name_in_c(const std::string& name) {
  std::size_t end = name.size(), dot = name.rfind('.');
  // no name of C begins with a digit
  while (dot != std::string::npos && dot > 0 && dot + 1 < end &&
         std::isdigit(static_cast<unsigned char>(name[dot + 1]))) {
    end = dot;
    dot = name.rfind('.', dot - 1);
  }
  return dot == std::string::npos ? name.substr(0, end) : name.substr(dot + 1, end - dot - 1);
}

std::set<std::string> marked_nodes(const std::string& facts) {
  std::set<std::string> nodes;
  const std::size_t at = facts.rfind("\nM");
  if (at == std::string::npos) return nodes;
  std::istringstream words(facts.substr(at + 2));
  for (std::string word; words >> word;) nodes.insert(word);
  return nodes;
}

std::string list_of_nodes(const std::set<std::string>& nodes) {
  std::string list;
  for (const std::string& n : nodes) list += (list.empty() ? "" : ",") + n;
  constexpr std::size_t kLongest = 100'000;  // characters; Linux takes 131,071 in one argument
  return list.size() > kLongest ? "*" : list;
}

}  // namespace cc
