// SPDX-License-Identifier: MIT
// Text of a .wbt or .proto file in, nodes out. Reads the VRML of Webots V5.0 to R2025: DEF and USE,
// EXTERNPROTO and inline PROTO, IS, comments, lists with and without commas; saved state ("hidden" fields) is
// skipped. Depth, number of nodes and length of the file are bounded, so that no input can exhaust the
// machine. Not read: scripts in PROTO files, but for plain `fields.NAME.value`.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "import/wbt_node.h"

namespace wbt {

inline constexpr int kDeepestNode = 60;               // nodes in nodes; worlds have about 15
inline constexpr std::size_t kMostNodes = 1'000'000;  // and fields, in one file with all its PROTOs unfolded
inline constexpr std::size_t kMostFields = 200;       // of one node
inline constexpr std::size_t kLongestText = 4096;     // characters; the rest is dropped
inline constexpr std::size_t kLongestFile = 32u << 20;  // bytes

/// A PROTO: its fields' defaults and the text of its body.
struct Proto {
  std::vector<Field> defaults;
  std::string body;         ///< from behind the opening brace on, its script left out
  bool has_script = false;  ///< a template that only Webots can unfold
};

struct WorldText {
  std::string version;                     ///< "V6.0", "R2023b"
  int year = 0;                            ///< 2023; of a V version 0
  char letter = 'a';                       ///< 'b' of R2023b
  int major = 0;                           ///< 6 of V6.0; of an R version 0
  std::vector<NodePtr> nodes;              ///< of the outermost level
  std::vector<std::string> extern_protos;  ///< as written
  std::map<std::string, Proto> protos;     ///< declared in the file itself
  std::vector<Remark> remarks;             ///< what was skipped
  std::vector<Remark> errors;              ///< when there is one, nothing else counts

  /// True from the release on, such as at_least(2022, 'a').
  bool at_least(int y, char l) const { return year > y || (year == y && letter >= l); }
};

/// Reads a world.
WorldText read_world_text(std::string_view text);

/// Reads nodes for a world that is there already, as `of` is: its release counts. `defs`: what USE may name.
WorldText read_nodes_text(std::string_view text, const WorldText& of,
                          const std::map<std::string, NodePtr>& defs);

/// Reads a .proto file. False when it cannot be understood.
bool read_proto_text(std::string_view text, Proto& proto);

/// The node that `instance` of a PROTO stands for; null when it has a script or is broken. Its lines are
/// the instance's. `budget`: how many nodes it may still make; lowered by what it made. `without_script`:
/// one with a script is read as if its conditions held, all of them; what it computes is 0, or the field
/// that it begins with.
NodePtr unfold(const Proto& proto, const Node& instance, std::size_t& budget, bool without_script = false);

}  // namespace wbt
