// SPDX-License-Identifier: MIT
// Nodes and fields of the world that runs, as Webots' supervisor functions see them. In: records of the link
// (programs/link/messages.def). Out: one record for a question; changes of the world, all in its digest, for
// a command. Unknown nodes and fields are NOTHING with a reason; a command that cannot be done is told
// through warn(). Calls come between ticks, from one thread. Not modelled: robots that are imported during a
// run, forces and torques, contact points, selections.
#pragma once
#include <memory>
#include <string>

#include "hal_sim/twin/twin.h"
#include "programs/link/packet.h"
#include "sim_core/record/picture.h"

namespace programs {

/// What a supervisor's program may ask for beyond the simulation; the team implements it.
class SupervisorHost {
 public:
  virtual ~SupervisorHost() = default;
  virtual twin::Twin& twin() = 0;
  virtual void end_run(int status, const std::string& why) = 0;       ///< after the turn
  virtual void reset(bool reload) = 0;                                ///< at the end of the turn
  virtual void restart_program(int robot) = 0;                        ///< the robot's program begins anew
  virtual void set_label(int program, const sim::PictureLabel&) = 0;  ///< an empty text takes it away
  virtual void picture(const std::string& file) = 0;                  ///< relative: the run's folder
  virtual void warn(int program, const std::string& text) = 0;        ///< a line under the program's name
  virtual void note_custom_data(int robot,
                                const std::string& text) = 0;  ///< tell the robot's program (CUSTOM)
  /// A robot was put somewhere else, so that drawn ways are broken there.
  virtual void note_moved(int) {}
  /// The name of a program's device, for its node; empty: not known.
  virtual std::string device_name(int, int) { return {}; }
};

class Nodes {
 public:
  /// Reads the world's nodes. `host` outlives this.
  explicit Nodes(SupervisorHost& host);
  ~Nodes();

  /// The program is that of a supervisor of the world (WorldDesc::supervisors), which has a node.
  void attach(int program, int supervisor);
  /// The world was put back to its beginning (Simulation::refurnish() with the world as it was first): nodes
  /// that were imported are gone, those that were removed are back. Numbers that programs have of the others,
  /// and of their fields, stay good; states that they kept are forgotten.
  void begin_again();
  /// The robot's own program changed its custom data.
  void set_custom_data(int robot, const std::string& text);

  /// Answers FIND_NODE, FIND_FIELD, GET, IMPORT, ASK_NODE: adds one record to `answer`.
  /// `program`: number of the asking program; `robot`: the robot whose node is its own, -1: a supervisor
  /// without a body.
  void answer(const link_record& question, int program, int robot, link_packet& answer);
  /// Carries out SET, INSERT, REMOVE, DO_NODE, DO_WORLD, FOLLOW.
  void carry_out(const link_record& command, int program, int robot);
  /// Adds FOLLOWED for all that the program follows and that is there, as an answer would tell it now.
  void tell_followed(int program, link_packet& out);
  /// The program has ended, or begins anew: it follows nothing.
  void forget_followed(int program);

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace programs
