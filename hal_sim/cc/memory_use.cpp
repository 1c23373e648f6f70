// SPDX-License-Identifier: MIT
// How deep a program's stack gets on the chip. Input: section .tpcost, a line a function, written by
// account.cpp. The deepest way from main() down, and on top of it the deepest of what can interrupt it: a
// handler, or a function that is called by pointer, as agendas are from the library's handler. Handlers do
// not interrupt one another here, and values that do not fit the registers are not counted.
#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "build.h"
#include "elf_reader.h"

namespace cc {
namespace {

// a handler of the library and what it calls: 14 bytes a function, 20 more for the handler
// [estimated: account.cpp]
constexpr long kLibraryHandlerBytes = 48;

struct StackEntry {
  long own = 0, below = 0;  // bytes; below: of the deepest callee, with all that it calls
  std::set<std::string> calls;
  std::string next;  // the deepest callee
  bool may_interrupt = false, done = false;
};

struct StackTable {
  std::map<std::string, StackEntry> functions;
  std::string recursive;  // a function that calls itself, at once or through others
  long data = 0;

  long depth(const std::string& name, std::set<std::string>& open) {
    const auto found = functions.find(name);
    if (found == functions.end()) return 0;  // of the host
    StackEntry& e = found->second;
    if (e.done) return e.own + e.below;
    open.insert(name);
    for (const std::string& callee : e.calls) {
      if (open.count(callee)) {
        recursive = callee;
        continue;
      }
      const long bytes = depth(callee, open);
      if (bytes > e.below) e.below = bytes, e.next = callee;
    }
    open.erase(name);
    e.done = true;
    return e.own + e.below;
  }
};

StackTable read_stack_table(const std::string& table) {
  StackTable program;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line, '\0');) {
    std::vector<std::string> fields;
    std::istringstream parts(line);
    for (std::string field; std::getline(parts, field, '|');) fields.push_back(field);
    if (fields.size() == 2 && fields[1] == "pointer") program.functions[fields[0]].may_interrupt = true;
    if (fields.size() == 3 && fields[1] == "data") program.data += std::atol(fields[2].c_str());
    if (fields.size() < 11) continue;
    // of two functions with one name, the program's and the library's or two static ones, the larger counts
    StackEntry& e = program.functions[fields[0]];
    e.own = std::max(e.own, std::atol(fields[10].c_str()));
    const std::string& name = fields[0];
    static const std::string kInterrupt = "Interrupt";
    if (name[0] == '_' && name.size() > kInterrupt.size() &&
        name.compare(name.size() - kInterrupt.size(), kInterrupt.size(), kInterrupt) == 0)
      e.may_interrupt = true;
    std::istringstream calls(fields[7]);  // those of the mean: every one
    for (std::string call; std::getline(calls, call, ',');) e.calls.insert(call.substr(0, call.find(':')));
  }
  return program;
}

}  // namespace

MemoryUse memory_use(const std::filesystem::path& image) {
  StackTable program = read_stack_table(read_elf(image).section(".tpcost"));
  MemoryUse use;
  use.data = program.data;
  std::set<std::string> open;
  use.stack = program.depth("main", open);
  long interrupt = 0;
  for (const auto& [name, entry] : program.functions)
    if (entry.may_interrupt) interrupt = std::max(interrupt, program.depth(name, open));
  use.stack += interrupt + kLibraryHandlerBytes;
  use.recursive = program.recursive;
  for (std::string name = "main"; !name.empty(); name = program.functions[name].next)
    use.deepest += (use.deepest.empty() ? "" : " > ") + name + "()";
  return use;
}

}  // namespace cc
