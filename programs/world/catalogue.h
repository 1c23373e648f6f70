// SPDX-License-Identifier: MIT
// What Webots' kinds of nodes are called, which fields they have, and what those hold when a file does not
// say. Source: [Webots: docs/reference]; only what programs ask worlds of e-pucks for.
#pragma once
#include <string>
#include <vector>

namespace programs {

/// Numbered as WbFieldType; kList is added to a list's.
enum FieldType : int {
  kNoField,
  kBool,
  kInt,
  kFloat,
  kVec2,
  kVec3,
  kTurn,
  kColour,
  kText,
  kNode,
  kList = 0x10
};

constexpr bool is_list(int type) { return (type & kList) != 0; }
constexpr int member_of(int type) { return type & ~kList; }
/// Numbers that one value, or one member of a list, has; 0: it has none.
constexpr std::size_t width_of(int type) {
  switch (member_of(type)) {
    case kBool:
    case kInt:
    case kFloat:
      return 1;
    case kVec2:
      return 2;
    case kVec3:
    case kColour:
      return 3;
    case kTurn:
      return 4;
    default:
      return 0;
  }
}
/// "SFVec3f", "MFNode".
std::string field_type_name(int type);

struct FieldRow {
  std::string name;
  int type = kNoField;
  std::vector<double> numbers;
  std::string text;
};

/// Fields of a kind of node, or of a PROTO that comes with Webots; empty: not known here.
const std::vector<FieldRow>& fields_of(const std::string& type);
/// What a field of that name is on any node known here; kNoField: on none.
int usual_field_type(const std::string& name);
/// The kind that a PROTO of Webots is made of ("E-puck": "Robot"); the type itself otherwise.
std::string base_of(const std::string& type);
/// The number of a kind as in webots/nodes.h; 0: not known.
int kind_number(const std::string& base);

}  // namespace programs
