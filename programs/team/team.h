// SPDX-License-Identifier: MIT
// All programs of the PC in a world, robots' and supervisors', in lock-step with it: starts them, gives each
// its turn between ticks when its step has ended, carries out what they ask for, and knows how they ended.
//
//   tick -- steps that have ended: samples go out to all of them, they compute side by side
//        -- in the order of robots, then of supervisors: commands, questions, up to the next step
//        -- next tick
//
// So the outcome depends on no scheduler: what a program says is looked at in its turn, whoever was faster.
// The world stands while a program computes, as long as it likes; `should_give_up` ends that. The command,
// the page and the test fixture own one beside their Twin.
#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"
#include "programs/build/build.h"
#include "programs/process/partner.h"
#include "programs/team/body.h"
#include "programs/world/nodes.h"
#include "sim_core/record/picture.h"
#include "sim_core/world/attendant.h"

namespace programs {

/// How the run ended, as far as programs have a say.
struct Outcome {
  bool ended = false;    ///< by a supervisor
  bool crashed = false;  ///< because its program crashed
  int code = 0;          ///< 0 passed, 1 failed
  std::string text;      ///< one line; may be empty
};

/// Notes the files of supervisors' programs; `supervisors` as Team::open() has them.
void note_supervisors(const sim::WorldDesc& world, const std::string& world_folder,
                      const std::vector<std::string>& supervisors, sim::FileUses& files);

class Team final : public sim::Attendant, private SupervisorHost {
 public:
  /// The programs of the twin's robots and of its world's supervisors, built and attached to its simulation,
  /// which must not step any more once the team is gone; nothing is started yet. Null when anything is wrong;
  /// every problem is one line. `supervisors`, of the command line: [NAME=]PROGRAM takes the place of the
  /// world's supervisor of that name, without NAME of its only one, or is added.
  static std::unique_ptr<Team> open(twin::Twin& twin, const twin::Options& options,
                                    const std::vector<std::string>& supervisors,
                                    std::vector<std::string>& problems);
  ~Team() override;
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  void before_first_tick() override;
  void after_tick() override;
  /// The run is over: every program is told and has a second to end.
  void finish();

  bool is_empty() const { return members_.empty(); }
  bool has_ended() const { return outcome_.ended; }
  const Outcome& outcome() const { return outcome_; }
  /// Texts for pictures, in order of program and id.
  std::vector<sim::PictureLabel> labels() const;
  /// Robots that a supervisor has put somewhere else since the last tick.
  const std::set<int>& moved_robots() const { return moved_; }

  /// Where lines for people go; stderr unless set.
  std::function<void(const std::string&)> say;
  /// Asked while a program computes, every 50 ms: true ends that program. Empty: never.
  std::function<bool()> should_give_up;

 private:
  struct Member {
    std::string name;
    int robot = -1;  // -1: a supervisor without a body
    bool is_supervisor = false;
    Launch launch;
    std::string arguments;
    std::shared_ptr<Body> body;
    RobotBody* of_robot = nullptr;     // body, if it is one
    BodilessBody* bodiless = nullptr;  // body, if it is one
    int supervisor = -1;               // number in the world's list; -1: of the command line, or a robot's
    std::unique_ptr<Partner> partner;  // null: not started, or over
    std::uint64_t began = 0;           // of the seat, when it was started
    bool has_said_hello = false, is_over = false;
    bool is_told_end = false;
    bool is_waiting = false;  // for DONE or END: the simulator speaks to nobody else
    bool starts_anew = false;
    std::string text;   // printed, up to the next newline
    host::Place place;  // where it crashed
    std::set<std::string> told;
    std::string custom;
    bool has_new_custom = false;
  };

  Team(twin::Twin& twin, const twin::Options& options);
  void end_beginners();
  bool is_to_begin(const Member& member) const;
  void begin(Member& member);
  void take_turns();
  void hand_over_samples(Member& member, bool with_followed);
  /// Of its own time, at the end of its last step.
  static std::int64_t ns_of(const Member& member);
  void done(Member& member, std::int64_t passed_ms);
  void tell_end(Member& member);
  void reply(Member& member);
  void turn(Member& member);
  /// Carries out a packet. True: the turn is over.
  bool carry_out(Member& member);
  bool carry_out(Member& member, const link_record& record);
  void welcome(Member& member);
  void answer(Member& member, const link_record& question);
  void step(Member& member, std::int64_t milliseconds);
  void refuse(Member& member, const std::string& why);
  void note_gone(Member& member);
  void fail(Member& member, const std::string& what);
  void over(Member& member);
  void print(Member& member, const char* text, std::size_t bytes);
  void line(Member& member, const std::string& text);
  void carry_out_resets();
  int number_of(const Member& member) const;
  double now_s() const { return sim::to_seconds(twin_.simulation().now()); }

  // --- SupervisorHost
  twin::Twin& twin() override { return twin_; }
  void end_run(int status, const std::string& why) override;
  void reset(bool reload) override;
  void restart_program(int robot) override;
  void set_label(int program, const sim::PictureLabel& label) override;
  void picture(const std::string& file) override;
  void warn(int program, const std::string& text) override;
  void note_custom_data(int robot, const std::string& text) override;
  void note_moved(int robot) override { moved_.insert(robot); }
  std::string device_name(int program, int tag) override;

  twin::Twin& twin_;
  const std::string run_folder_;
  std::vector<std::unique_ptr<Member>> members_;
  void make_nodes();
  std::unique_ptr<Nodes> nodes_;
  std::unique_ptr<const sim::WorldDesc> at_first_;  // the world as it was opened; null: nobody can reset it
  Outcome outcome_;
  link_packet packet_{};
  bool began_ = false, finished_ = false;
  bool wants_reset_ = false, wants_reload_ = false;
  Member* in_turn_ = nullptr;   // whose turn it is
  Member* resetter_ = nullptr;  // who asked for the reset, and goes on
  std::set<int> wants_restart_;
  std::map<std::pair<int, int>, sim::PictureLabel> labels_;
  std::set<int> moved_;
};

}  // namespace programs
