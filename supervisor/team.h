// SPDX-License-Identifier: MIT
// All supervisors of a world: loads their programs, gives each its turn between ticks, keeps what they ask to
// be kept, and knows how they ended the run. The command and the test fixture own one beside their Twin.
// Order: the world file's; a program runs when its time has come. Nothing depends on threads or wall clock.
#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"
#include "sim_core/radio/packet_medium.h"
#include "sim_core/record/picture.h"
#include "sim_core/world/attendant.h"
#include "supervisor/program.h"

namespace supervisor {

/// Robots, then objects, as supervisor.h numbers them.
class Things {
 public:
  explicit Things(const sim::Simulation& simulation);
  int count() const { return static_cast<int>(names_.size()); }
  int robots() const { return robots_; }
  bool is_known(int thing) const { return thing >= 0 && thing < count(); }
  bool is_robot(int thing) const { return thing >= 0 && thing < robots_; }
  /// By `def`, or else by name; -1: none.
  int find(const std::string& name) const;
  const std::string& name(int thing) const { return names_[static_cast<std::size_t>(thing)]; }
  /// Robot or movable object: its body in the simulation; -1: it stands fast.
  int body(int thing) const {
    return places_[static_cast<std::size_t>(thing)].moving ? places_[static_cast<std::size_t>(thing)].index
                                                           : -1;
  }
  /// For rays and colours.
  const sim::Candidate& place(int thing) const { return places_[static_cast<std::size_t>(thing)]; }

 private:
  int robots_;
  std::vector<std::string> names_, defs_;
  std::vector<sim::Candidate> places_;
};

/// Notes of where a thing was.
struct Track {
  double every_s = 0;
  sim::Clicks next = 0;
  bool lifted = true;  ///< the next note is not joined to the one before
  double length_m = 0;
  struct Note {
    double time_s;
    sim::Pose2 pose;
    double z_m;
  };
  std::vector<Note> notes;
};

/// How the run ended, as far as supervisors have a say.
struct Outcome {
  bool ended = false;    ///< by a supervisor
  bool crashed = false;  ///< because its program crashed
  int code = 0;          ///< 0 passed, 1 failed
  std::string text;      ///< one line; may be empty
};

class Team;

/// One supervisor.
class Member final : public sim::PacketPort {
 public:
  Member(Team& team, int index, const sim::SupervisorDesc& desc);

  bool listens(int channel) const override;
  void on_packet(const sim::ReceivedPacket& packet) override { inbox_.push_back(packet); }

  /// Says what was wrong, once a text; returns -1.
  int refuse(const std::string& what);
  /// Lets the world go on for so many clicks, at least a tick.
  double step(double seconds);

  Team& team;
  const int index;
  const std::string name;
  double period_s;
  std::unique_ptr<Program> program;
  std::string last_error, text;  // what the functions of supervisor.h return
  std::uint64_t draws = 0;       // random numbers so far
  std::set<int> channels;
  std::deque<sim::ReceivedPacket> inbox_;
  sim::ReceivedPacket open_packet;
  std::map<int, Track> tracks;

 private:
  friend class Team;
  sim::Clicks wake_ = 0;    // its next turn
  bool finishing_ = false;  // the run is over
  bool over_ = false;       // ... and the program knows
  std::set<std::string> told_;
};

class Team final : public sim::Attendant {
 public:
  /// The supervisors of the twin's world, compiled and loaded, and attached to its simulation, which must not
  /// step any more once the team is gone. Null when
  /// anything is wrong; every problem is one line. A world without supervisors gives a team of none. `extra`:
  /// programs of the command line.
  static std::unique_ptr<Team> open(twin::Twin& twin, const twin::Options& options,
                                    const std::vector<std::string>& extra,
                                    std::vector<std::string>& problems);
  ~Team() override;
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  void before_first_tick() override;
  void after_tick() override;
  /// The run is over: every program that has not ended has one more go.
  void finish();

  bool is_empty() const { return members_.empty(); }
  bool has_ended() const { return outcome_.ended; }
  const Outcome& outcome() const { return outcome_; }
  /// Texts for pictures, in order of supervisor and id.
  std::vector<sim::PictureLabel> labels() const;
  /// Robots that a supervisor has put somewhere else since the last tick.
  const std::set<int>& moved_robots() const { return moved_; }
  /// Where lines for people go; stderr unless set.
  std::function<void(const std::string&)> say;

  // --- for supervisor.h's functions
  twin::Twin& twin() { return twin_; }
  sim::Simulation& simulation() { return twin_.simulation(); }
  const Things& things() const { return things_; }
  double now_s() const { return sim::to_seconds(twin_.simulation().now()); }
  void end(Outcome outcome);
  void set_label(int member, const sim::PictureLabel& label);
  /// Everybody's tracks of a thing that was moved by hand are broken there.
  void note_move(int thing);
  /// A robot was put back to its start, or its program begun anew. One to which both is done at the same
  /// instant begins as when the world began; when that is done to all that run a program, the world does.
  void note_reset(int robot, bool program);
  /// Ways of the robots since the first track was asked for.
  sim::Trajectories* ways() { return ways_.get(); }
  /// A file that a function of supervisor.h writes: names without a path are of the folder of the run, not
  /// of the program's, in which the process is during its turn.
  std::string file_of_run(const char* file) const;
  void keep_ways();

 private:
  Team(twin::Twin& twin, std::vector<sim::SupervisorDesc> descs);
  void take_turns();
  void look_after(Member& member);
  void take_notes(Member& member);

  const std::string run_folder_;
  twin::Twin& twin_;
  Things things_;
  std::vector<std::unique_ptr<Member>> members_;
  Outcome outcome_;
  bool began_ = false, finished_ = false;
  std::map<std::pair<int, int>, sim::PictureLabel> labels_;
  std::set<int> moved_;
  std::unique_ptr<sim::Trajectories> ways_;
  struct Reset {
    sim::Clicks place = -1, program = -1;  // when it was last reset
  };
  std::map<int, Reset> resets_;  // by robot
};

}  // namespace supervisor
