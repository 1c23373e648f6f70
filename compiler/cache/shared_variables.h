// SPDX-License-Identifier: MIT
// Which variables an interrupt may change while other code reads them, by knowledge of the whole program.
// The compiler tells of each file who takes whose address, stores where and calls whom (shared_reads.cpp);
// here all files are put together. Handlers, and functions whose address is handed to somebody outside the
// program (e_activate_agenda() of the library), may run between any two instructions of the rest; what they
// or functions they call may write is shared. Pointers are followed by what they may point at, wherever they
// are stored (no order, no fields: an answer may name too many variables, never too few).
//
// Facts of a file are lines of words. Nodes: "&x" the address of x, "f^0" the first parameter of f,
// "f^r" its result, "f^v" what stands behind its "...", "%7" a value of the file. A name that begins
// with "." is the file's own.
//
//   F f flags         f has a body here; h: a handler, v: takes "..."
//   C to from         to may be what from is
//   L to pointer      to may be what lies at pointer
//   S pointer from    what from is may lie at pointer
//   W f pointer       f writes what lies at pointer
//   R f pointer p where   f reads it by a plain load; p: 1 where a compiler may read it once before a loop
//   K f callee result arguments...   a call; "-" stands for what is no pointer
//   N f name          assembler text of f names a function or a variable, and may follow addresses from there
//   M f>node...       loads of f through these were made volatile
#pragma once
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace cc {

/// The linker puts a function of such a name into its vector, whatever its attributes: "_T1Interrupt".
inline bool is_handler_name(std::string_view name) {
  constexpr std::string_view kEnd = "Interrupt";
  return name.size() > kEnd.size() && name[0] == '_' && name.substr(name.size() - kEnd.size()) == kEnd;
}

struct FileFacts {
  std::string text;
  bool is_program = true;  ///< false: of the library, to which addresses of functions are handed
  bool is_told = true;     ///< its plain reads are named
};

struct SharedRead {
  std::string where;     ///< "main.c:12"
  std::string variable;  ///< as C names it
  std::string writer;    ///< the handler, or the function that is handed to one
};

struct SharedVariables {
  /// Of each file "function>node": loads there through that node read shared variables.
  std::vector<std::set<std::string>> nodes;
  std::vector<SharedRead> reads;  ///< each variable once: the first plain read that a compiler may do once
};

/// Of two files that define a function the first counts; of handlers of the library each does, unless the
/// program has one of that name.
SharedVariables shared_variables(const std::vector<FileFacts>& files);

/// What C calls a variable that is "flag", "main.flag" or "main.flag.3" (the fourth of that
/// name) in the compiler.
std::string name_in_c(const std::string& name);

/// The nodes of the line M.
std::set<std::string> marked_nodes(const std::string& facts);
/// "a,b,c", for the compiler's --shared=; "*" where that would be too long: all loads.
std::string list_of_nodes(const std::set<std::string>& nodes);

}  // namespace cc
