// SPDX-License-Identifier: MIT
// Ties the tree of nodes to the world that runs: where a node is, what moves when a program writes its
// place, what stands there when it changes or adds a node. Poses are in programs' axes ([webots] axes), in
// metres; a robot's is the floor under it. A movable thing is where the engine has it; all else is where its
// fields say. Not modelled: robots that come during a run; shapes of robots; other axes than upwards for
// what the engine moves.
#pragma once
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"
#include "import/import.h"
#include "programs/world/tree.h"

namespace programs {

class Bodies {
 public:
  /// Reads the file that [webots] world names, if it is there. `twin` outlives this.
  explicit Bodies(twin::Twin& twin);

  Tree& tree() { return tree_; }
  const Tree& tree() const { return tree_; }
  bool is_nue() const;
  /// The node of a robot, a supervisor; 0: there is none.
  int node_of(Is is, int number) const;

  /// Without scale.
  wbt::Affine pose(int id) const;
  /// A robot's is that of its model; of anything else the place that its pose says.
  wbt::Vec3 centre_of_mass(int id) const;
  /// "translation" or "rotation", within its parent.
  std::vector<double> place(int id, const std::string& field) const;
  /// Writes one of them. What cannot be is said; empty: done.
  std::string set_place(int id, const std::string& field, const std::vector<double>& numbers);
  /// m/s, rad/s, of the nearest thing that moves.
  std::vector<double> velocity(int id) const;
  /// False: it stands fast.
  bool set_velocity(int id, const std::vector<double>& six);
  void rest_all();

  /// A field inside a node was written, but for its place: what stands there is made anew.
  void changed(int id);
  /// Adds nodes to a field. Returns what is wrong; empty: done.
  std::string import(int parent, const std::string& field, int index, const std::string& text);
  /// What goes with it is left out of the world; a robot stays, far away, and `told` says so.
  void remove(int id, std::string& told);

  /// Colour of an object or a robot. False: it has none.
  bool colour(int id, sim::Colour& colour) const;
  bool set_colour(int id, const sim::Colour& colour);
  void set_recognition(int id, const std::vector<double>& numbers);

  /// "location", "intensity" or "on" of a lamp was written.
  void lamp_changed(int id);

  /// Keeps or takes back where a node, and all in it, is and how it moves. False: no such state.
  void save(int id, const std::string& name);
  bool load(int id, const std::string& name);

  /// Called with a robot that was put somewhere else.
  std::function<void(int robot)> moved;

 private:
  /// The objects of the world that a node is.
  struct Piece {
    std::vector<int> objects;
    wbt::Affine start, body;  ///< poses of the node and of its first object when both were tied
  };
  struct State {
    wbt::Affine pose;
    std::vector<double> velocity;
  };
  using Made = std::map<int, std::vector<sim::ObjectDesc>>;

  void read_file();
  void tie_file();
  void add_rest();
  int add_object(const sim::ObjectDesc& o);
  void tie();
  int body_of(int object) const { return body_of_[static_cast<std::size_t>(object)]; }
  int moving_body(int id) const;
  wbt::Affine from_body(const sim::Pose2& pose, double z_m, bool robot) const;
  void to_body(const wbt::Affine& frame, bool robot, sim::Pose2& pose, double& z_m) const;
  sim::Vec3 out(sim::Vec3 ours) const;
  sim::Vec3 in(sim::Vec3 theirs) const;
  void put(int id, const wbt::Affine& frame);
  void put_body(int body, const wbt::Affine& frame, bool robot);
  void sync(int id);
  void shift(int id, const std::map<int, wbt::Affine>& before);
  void derive(int id, bool keep_course);
  void apply(const std::set<int>& cleared, const Made& made, bool keep_course,
             const std::vector<sim::LampDesc>& lamps = {});
  void refurnish(const sim::WorldDesc& world);

  twin::Twin& twin_;
  wbt::WorldText text_;
  wbt::Options options_;
  std::unique_ptr<wbt::ProtoFiles> protos_;
  Tree tree_;
  std::map<int, Piece> pieces_;
  std::vector<int> owner_;    // per object of the world: its node
  std::vector<int> body_of_;  // per object: its body, -1: it stands fast
  std::map<std::pair<int, std::string>, State> states_;
};

}  // namespace programs
