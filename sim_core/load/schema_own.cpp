// SPDX-License-Identifier: MIT
// The keys that one kind of robot or part has. Kinds come from the caller (world/own_keys.h), so their tables
// are made here and not written down.
#include <fmt/format.h>

#include "sim_core/load/schema.h"

namespace sim {

namespace {

ValueType value_type(OwnKeyType type) {
  switch (type) {
    case OwnKeyType::Number:
      return ValueType::Number;
    case OwnKeyType::Integer:
      return ValueType::Integer;
    case OwnKeyType::Flag:
      return ValueType::Flag;
    case OwnKeyType::Text:
      return ValueType::Text;
    case OwnKeyType::Choice:
      return ValueType::Choice;
    case OwnKeyType::Pair:
      return ValueType::Pair;
    case OwnKeyType::Triple:
      return ValueType::Triple;
    case OwnKeyType::Numbers:
      return ValueType::Numbers;
  }
  return ValueType::Text;
}

/// Keeps the value under the key's name.
template <typename T>
Setter keep(const OwnKey& key, OwnValues T::*values) {
  return [&key, values](void* target, const Value& v, const WorldDesc&) {
    if (v.integer % key.multiple_of != 0)
      return fmt::format("got {}, expected a multiple of {} from {} to {}", v.integer, key.multiple_of,
                         key.least, key.most);
    OwnValue& out = (static_cast<T*>(target)->*values)[key.key];
    out.text = v.text;
    out.flag = v.flag;
    if (key.type == OwnKeyType::Number)
      out.numbers = {v.number};
    else if (key.type == OwnKeyType::Integer)
      out.numbers = {static_cast<double>(v.integer)};
    else
      out.numbers = v.numbers;
    return std::string();
  };
}

template <typename T>
void add(SectionSpec& spec, const std::vector<OwnKey>& keys, OwnValues T::*values) {
  for (const OwnKey& key : keys)
    spec.keys.push_back({key.key.c_str(), value_type(key.type), key.unit.c_str(), key.least, key.most,
                         key.choices.c_str(), key.fallback.c_str(), key.doc.c_str(), keep(key, values)});
}

}  // namespace

SectionSpec part_section(const PartKind& kind) {
  SectionSpec spec{"robot.part", true, kind.doc.c_str(), section("robot.part").keys};
  add(spec, kind.keys, &PartDesc::values);
  return spec;
}

SectionSpec robot_section(const RobotModel& model) {
  SectionSpec spec = section("robot");
  add(spec, model.keys, &RobotDesc::own);
  return spec;
}

}  // namespace sim
