// SPDX-License-Identifier: MIT
// The debugger's face for people and scripts: a line of text is a command, its answer is text. Commands bear
// gdb's names where gdb has them.
#pragma once
#include <functional>
#include <map>
#include <string>

#include "hal_sim/debug/session.h"

namespace debug {

class Monitor {
 public:
  /// `idle`: asked while the program runs; true: pause.
  Monitor(Session& session, std::function<bool()> idle) : session_(session), idle_(std::move(idle)) {}

  /// Carries out a line; returns what is to be shown.
  std::string execute(const std::string& line);
  /// Where the program stands, with its source line.
  std::string where();
  bool wants_end() const { return quits_; }

 private:
  std::string run(const std::string& command, Plan plan, const std::string& times);
  std::string told(const Stop& stop);
  std::string set_break(const std::string& rest, bool once);
  std::string watch(const std::string& rest);
  std::string info(const std::string& rest);
  std::string world();
  std::string print(const std::string& expression);
  std::string assign(const std::string& rest);
  std::string memory(const std::string& rest);
  std::string backtrace();
  std::string select(const std::string& command, const std::string& rest);
  std::string list(const std::string& rest);
  std::string disassemble(const std::string& rest);
  std::string go(const std::string& rest);
  std::string trace(const std::string& rest);
  std::string source_line(const std::string& file, int line);

  Session& session_;
  std::function<bool()> idle_;
  std::map<std::string, std::vector<std::string>> sources_;
  std::string last_;
  bool quits_ = false;
};

}  // namespace debug
