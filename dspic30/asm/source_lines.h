// SPDX-License-Identifier: MIT
// Assembler text line by line, as statements: comments gone, .include, .macro, .rept, .irp
// and .if carried out.
#pragma once
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "dspic30/asm/assembler.h"
#include "dspic30/asm/expression.h"

namespace dspic::assembly {

struct Statement {
  std::vector<std::string> labels;
  std::string name;      ///< instruction or directive, lower case; ".equ" for "x = 1" too; empty: only labels
  std::string operands;  ///< as written
  std::string file;
  int line = 0;
};

class SourceLines {
 public:
  struct Listener {
    virtual ~Listener() = default;
    virtual void statement(const Statement& statement) = 0;
    /// Value of an expression at this point of the text; complains and answers 0 where it has none yet.
    virtual std::int64_t value_now(const std::string& expression) = 0;
    virtual bool is_defined(const std::string& symbol) = 0;
    virtual void complain(const std::string& file, int line, const std::string& text) = 0;
  };
  SourceLines(Listener& listener, const Includes& includes) : listener_(listener), includes_(includes) {}
  void read(const std::string& text, const std::string& file);

 private:
  struct Line {
    std::string text;
    int number;
  };
  struct Macro {
    std::vector<std::pair<std::string, std::string>> parameters;  // name, default
    std::vector<Line> body;
  };

  void run(const std::vector<Line>& lines, const std::string& file);
  bool open_block(const Statement& s, const std::vector<Line>& lines, std::size_t& at);
  bool conditional(const Statement& s);
  void define_macro(const Statement& s, std::vector<Line> body);
  void expand(const Macro& macro, const Statement& s);
  void repeat(const Statement& s, const std::vector<Line>& body);
  void include(const Statement& s);
  bool is_skipping() const;
  void complain(const Statement& s, const std::string& text) { listener_.complain(s.file, s.line, text); }
  Statement parse(const Line& line, const std::string& file) const;

  Listener& listener_;
  const Includes& includes_;
  std::map<std::string, Macro> macros_;
  struct Condition {
    bool holds, was_true, outer_skips;
  };
  std::vector<Condition> conditions_;
  int depth_ = 0;
  int expansions_ = 0;
  long long lines_ = 0;
  bool ended_ = false;
};

}  // namespace dspic::assembly
