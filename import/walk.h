// SPDX-License-Identifier: MIT
// Goes through the nodes of a world and sorts what it meets into a Scene: which node is a body, a robot, a
// floor, a lamp. Knows the PROTOs that come with Webots by name, and unfolds those that lie beside the world.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "import/import.h"
#include "import/proto_files.h"
#include "import/scene.h"
#include "import/surface.h"
#include "import/wbt_reader.h"

namespace wbt {

class Walk {
 public:
  Walk(const WorldText& text, const Options& options, Report& report);

  /// Everything; call once.
  Scene scene();

 private:
  // walk.cpp: which node is what
  void visit(const Node& n, const Affine& frame, int depth);
  void children(const Node& n, const char* field, const Affine& frame, int depth);
  void world_info(const Node& n);
  static Body body_of(const Node& n);  ///< with its names and line
  void solid(const Node& n, const Affine& frame, int depth);
  void gather(const Node& n, const Affine& frame, int depth, std::vector<Piece>& out, const Surface* paint,
              bool nested_solids);
  void add_body(Body body);
  int found() const;  ///< how many things were met that are carried or reported
  void lamp(const Node& n, const Affine& frame);
  void background(const Node& n);
  bool afford(const Node& n);
  Affine inside(const Node& n, const Affine& frame) const;
  NodePtr unfolded(const Node& n, bool without_script = false);

  // walk_proto.cpp: PROTOs known by name
  bool known_proto(const Node& n, const Affine& frame);
  void arena(const Node& n, const Affine& frame);
  void floor_proto(const Node& n, const Affine& frame);
  void circle_arena(const Node& n, const Affine& frame);
  void wall_proto(const Node& n, const Affine& frame);
  void block_proto(const Node& n, const Affine& frame);
  void by_measures(const Node& n, const Affine& frame);
  void known_fields(const Node& n, const std::set<std::string>& carried);

  // walk_robot.cpp: robots
  void robot(const Node& n, const Affine& frame, int depth);
  void epuck(const Node& n, const Affine& frame, bool by_proto);
  void plain_fields(const Node& n, FoundRobot& out);
  void proto_fields(const Node& n, FoundRobot& out);
  void proto_body(const Node& n, FoundRobot& out, int depth);
  void equipment(const Node& n, FoundRobot& out);
  std::string words_of(const Node& n);
  void program_fields(const Node& n, FoundRobot& out);
  static std::vector<sim::Colour> recognition_of(const Node& n);
  void slot(const Node& n, const char* field, FoundRobot& out);
  void device(const Node& n, const Affine& at, FoundRobot& out, int depth);
  void ranging(const Node& n, const Affine& at, Device& made);
  std::vector<sim::ResponseRow> rows_of(const Node& n);
  struct Placed {
    const Node* node;
    Affine at;  ///< within the robot
  };
  void collect(const Node& n, const Affine& at, const std::set<std::string>& types, std::vector<Placed>& out,
               int depth);
  void sensors(const std::vector<const Node*>& nodes, FoundRobot& out);
  bool is_plain_epuck(const Node& n);

  const WorldText& text_;
  Report& report_;
  Surfaces surfaces_;
  ProtoFiles protos_;
  Scene scene_;
  Affine world_;       // from the file's axes to ours
  bool z_up_ = false;  // shapes and robots of R2022 on
  int visits_ = 0;
  int pieces_ = 0;
  bool exhausted_ = false;
  static constexpr int kMostEndless = 3;
  int endless_ = 0;                  // nodes of the world with too many within them
  std::size_t budget_ = kMostNodes;  // of PROTOs to be unfolded
  std::vector<NodePtr> kept_;        // unfolded nodes
};

/// True when the type is an e-puck by its name: E-puck, EPuck, E-puck2, EPuckNoPhysics, EPuckSound.
bool is_epuck_name(const std::string& type);

}  // namespace wbt
