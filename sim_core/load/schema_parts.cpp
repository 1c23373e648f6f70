// SPDX-License-Identifier: MIT
// The keys of robots' parts. Kinds come from the caller (world/part_desc.h), so their tables are made here
// and not written down.
#include "sim_core/load/schema.h"

namespace sim {

namespace {

ValueType value_type(PartKeyType type) {
  switch (type) {
    case PartKeyType::Number:
      return ValueType::Number;
    case PartKeyType::Integer:
      return ValueType::Integer;
    case PartKeyType::Flag:
      return ValueType::Flag;
    case PartKeyType::Text:
      return ValueType::Text;
    case PartKeyType::Choice:
      return ValueType::Choice;
    case PartKeyType::Pair:
      return ValueType::Pair;
    case PartKeyType::Triple:
      return ValueType::Triple;
    case PartKeyType::Numbers:
      return ValueType::Numbers;
  }
  return ValueType::Text;
}

/// Keeps the value under the key's name.
Setter keep(const PartKey& key) {
  return [&key](void* target, const Value& v, const WorldDesc&) {
    PartValue& out = static_cast<PartDesc*>(target)->values[key.key];
    out.text = v.text;
    out.flag = v.flag;
    if (key.type == PartKeyType::Number)
      out.numbers = {v.number};
    else if (key.type == PartKeyType::Integer)
      out.numbers = {static_cast<double>(v.integer)};
    else
      out.numbers = v.numbers;
    return std::string();
  };
}

}  // namespace

SectionSpec part_section(const PartKind& kind) {
  SectionSpec spec{"robot.part", true, kind.doc.c_str(), {}};
  spec.keys = section("robot.part").keys;
  for (const PartKey& key : kind.keys) {
    spec.keys.push_back({key.key.c_str(), value_type(key.type), key.unit.c_str(), key.least, key.most,
                         key.choices.c_str(), key.fallback.c_str(), key.doc.c_str(), keep(key)});
  }
  return spec;
}

}  // namespace sim
