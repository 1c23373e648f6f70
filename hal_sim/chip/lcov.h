// SPDX-License-Identifier: MIT
// Counts of lines, branches and functions as lcov's tracefile has them: read, added to one another, written.
//
//   c.info --read--> Lcov --add(another run's)--> Lcov --text()--> c.info
//
// Per source: SF, VER (a sum of its text), FN, FNDA, FNF, FNH, BRDA, BRF, BRH, DA, LF, LH.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <tuple>

namespace chip {

struct Lcov {
  struct Function {
    int line = 0;
    std::uint64_t calls = 0;
  };
  /// Line, the number of the condition on it, 0: it did not hold (the program went on), 1: it jumped.
  using Branch = std::tuple<int, int, int>;
  struct Ways {
    bool is_known = false;  ///< the condition was reached
    std::uint64_t count = 0;
  };
  struct Source {
    std::string version;  ///< empty: not known
    std::map<int, std::uint64_t> lines;
    std::map<Branch, Ways> branches;
    std::map<std::string, Function> functions;
  };
  std::map<std::string, Source> sources;  ///< by path

  /// False: `error` says what is wrong in which line: "line 3: got ..., expected ...".
  bool read(const std::string& text, std::string& error);
  /// Adds the counts of another run. False, and nothing is changed: a source was another one
  /// then; `error` names it.
  bool add(const Lcov& other, std::string& error);
  std::string text() const;
};

}  // namespace chip
