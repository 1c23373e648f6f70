// SPDX-License-Identifier: MIT
// The one table of what a bench can do to a robot: faults, and stimuli such as a key or a byte. Files, the
// command line, messages, lists and docs/testing.md are made from it.
#pragma once
#include <string>
#include <vector>

#include "sim_core/load/schema.h"

namespace faults {

struct Parameter {
  const char* name;
  sim::ValueType type;
  const char* unit;     ///< "" for none
  double least, most;   ///< of numbers
  const char* choices;  ///< of ValueType::Choice: words separated by '|'
  const char* usual;    ///< as TOML would write it; "required"; "" where it may be left out
  const char* does;     ///< a phrase
};

struct Kind {
  const char* name;
  const char* does;     ///< what is done, a phrase
  const char* meaning;  ///< its one physical or electrical meaning, sentences
  const char* noticed;  ///< when it took effect, a phrase
  bool lasts;           ///< has an end; else it is over when it has begun
  const char*
      key;  ///< of a stimulus: its word in [[stimulus]], which stands for the first parameter; else null
  std::vector<Parameter> parameters;

  bool is_stimulus() const { return key != nullptr; }
};

const std::vector<Kind>& kinds();
/// Null: there is none of that name.
const Kind* find_kind(const std::string& name);
/// The names of all, for messages: "wheel_stuck" may have been meant by "wheel_stick".
std::vector<std::string> kind_names();

/// For the terminal, and the tables in docs/testing.md.
std::string text_table();
std::string page();

}  // namespace faults
