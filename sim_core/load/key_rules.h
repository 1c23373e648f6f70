// SPDX-License-Identifier: MIT
// Keys that say nothing beside another key of their table: two that mean the same, and those of one kind in a
// table of another kind.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim_core/load/schema.h"

namespace sim {

/// A key that is written and says nothing.
struct IdleKey {
  const char* key;
  const char* other;  ///< beside which it says nothing
  bool is_same;       ///< both mean the same, and either may go
  std::string why;    ///< "got ..., expected ..."
};

/// A table's value without quotes, "" for what is neither text nor flag; nothing: the key is not written.
using WrittenValue = std::function<std::optional<std::string>(const char* key)>;

/// Each key is told once, in the order of the rules.
std::vector<IdleKey> idle_keys(const SectionSpec& spec, const WrittenValue& value_of);

/// Whether a key says where a body is, or how large.
bool says_place(const std::string& key);

}  // namespace sim
