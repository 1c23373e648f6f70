// SPDX-License-Identifier: MIT
// A world that runs while pages look at it and touch it. One thread has it all: it takes requests between
// ticks, steps the run at the pace that was asked for, and hands out answers, events and frames. It waits for
// nobody: who sends must not block.
//
//   clients --Mailbox--> requests (requests.h) --> Document   the world file's text
//                                              --> Programs   controllers, their sources and builds
//                                              --> Run        the twin, and all that is done to it
//                                              --> Debugging  the run, while a robot is debugged
//           <--Pages---- answers, events, frames                                    Pace: how fast
#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "viewer/debugging.h"
#include "viewer/document.h"
#include "viewer/kept_images.h"
#include "viewer/live_edits.h"
#include "viewer/mailbox.h"
#include "viewer/pace.h"
#include "viewer/pages.h"
#include "viewer/programs.h"
#include "viewer/run.h"
#include "viewer/world_json.h"

namespace viewer {

/// Version of the protocol; docs/changelog.md says what changed.
inline constexpr int kProtocolVersion = 2;

class Session {
 public:
  /// `opening.text` is what `opening.file` holds. `record`: file for the inputs; empty: none.
  Session(inputs::Opening opening, std::string record, Outlet outlet);
  /// Each run from time 0 gets the inputs of a recording, each at its tick, and stands still at its
  /// end. Before open().
  void replay(std::unique_ptr<inputs::Replay> recording) { replay_ = std::move(recording); }
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Builds the world. False, with lines in `problems`, when it cannot run; a page can still mend it.
  bool open(std::vector<std::string>& problems);
  /// Starts the thread. From now on only those below may be called, by any thread.
  void start();
  void client_came(ClientId client) { mail_.post(client, Mailbox::Kind::Came, ""); }
  void client_said(ClientId client, std::string text) {
    mail_.post(client, Mailbox::Kind::Said, std::move(text));
  }
  void client_left(ClientId client) { mail_.post(client, Mailbox::Kind::Left, ""); }
  /// Told at once, on the thread, when the recording cannot be written any more; may be
  /// empty. Before start().
  std::function<void(const std::string&)> on_recording_error;
  /// Ends the thread and the run; nothing is sent any more. What is wrong with the recording; empty: nothing.
  std::string stop();

 private:
  using Wall = std::chrono::steady_clock;
  using Handler = Json (Session::*)(ClientId client, const Json& request);
  friend struct Handlers;

  // --- the thread
  void live();
  bool take_messages();
  void handle(const Mailbox::Message& message);
  Json answer(ClientId client, const Json& request);
  void look_around();
  void show(bool all);

  // --- requests, by name (session_requests.cpp)
  Json do_play(ClientId, const Json&);
  Json do_pause(ClientId, const Json&);
  Json step(ClientId, const Json&);
  Json set_speed(ClientId, const Json&);
  Json restart(ClientId, const Json&);
  Json steer(ClientId, const Json&);
  Json tell_state_to(ClientId, const Json&);
  Json subscribe(ClientId, const Json&);
  Json rays(ClientId, const Json&);
  Json look(ClientId, const Json&);
  Json trace(ClientId, const Json&);
  Json floor(ClientId, const Json&);
  Json edit(ClientId, const Json&);
  Json undo(ClientId, const Json&);
  Json redo(ClientId, const Json&);
  Json reload(ClientId, const Json&);
  Json text_of(ClientId, const Json&);
  Json save(ClientId, const Json&);
  Json save_as(ClientId, const Json&);
  Json worlds(ClientId, const Json&);
  Json open_world(ClientId, const Json&);
  Json new_world(ClientId, const Json&);
  Json source(ClientId, const Json&);
  Json write_source(ClientId, const Json&);
  Json debug(ClientId, const Json&);
  Json dap(ClientId, const Json&);
  Json touch(ClientId, const Json&);
  Run& running() const;
  Json changed(const Json& request, const std::function<void()>& take_back, Json reply);

  // --- runs
  bool reopen(std::vector<std::string>& problems);
  bool open_run(std::vector<Json> script, bool is_repeated, std::vector<std::string>& problems);
  void keep_images();
  void close_run();
  void take_up_run();
  void begin_anew();
  void advance_slice();
  void stand_still();
  void step_until(sim::Clicks end);
  bool step_interrupt(int robot);
  void after_ticks();
  void input(const Json& request, const sim::WorldDesc* world = nullptr);
  void debug_robot(int robot);
  void debug_no_more();
  void debugger_ticked();
  bool plays() const { return debugging_ ? debugging_->runs() : pace_.plays(); }
  sim::Clicks now() const { return run_ ? run_->now() : 0; }

  // --- edits
  void open_document(const std::string& file, bool discard);
  void document_changed(const LiveEdit& edit);
  LiveEdit live_edit_now() const;
  void choose_program(int robot, const std::string& name);
  std::string world_folder() const;

  // --- what is told
  Json state_json() const;
  Json world_json_now() const;
  Json traps_json() const;
  void tell_state() { pages_.tell_all({{"event", "state"}, {"state", state_json()}}); }
  void tell_world();
  void remember_told();
  void tell_programs();
  void tell_problems(std::vector<std::string> problems);
  void send_serial();
  void send_trace();
  void watch_files();
  void watch_programs();
  void watch_recording();
  void load_built(Programs::Built& built);
  int robot_named(const std::string& name) const;

  inputs::Opening opening_;
  std::string record_file_, home_;          // home_: folder of the world that was opened first
  std::unique_ptr<inputs::Replay> replay_;  // null: there is none
  Document document_;
  Programs programs_;
  Pages pages_;
  Pace pace_;
  Mailbox mail_;
  std::unique_ptr<Debugging> debugging_;  // null: nobody is debugged; it has the run's twin
  std::unique_ptr<Run> run_;              // null: the world cannot run
  std::vector<Programs::Built> held_;     // programs that were built while a robot was debugged
  KeptImages images_;
  std::vector<twin::Choice> first_images_;  // with which the run began, by robot

  std::vector<int> movable_;             // ids of the movable objects that live
  sim::WorldText live_text_;             // what the world that lives was made of
  std::vector<std::string> problems_;    // why there is no run
  std::string recording_told_;           // what was said to be wrong with the recording
  std::vector<std::size_t> traps_told_;  // of each robot's program
  Json diagnoses_told_ = Json::array();
  bool ended_ = false, is_replayed_ = false;
  bool was_open_ = false;  // once, so that the options that name robots were right
  Wall::time_point next_watch_{}, next_trace_{};
  Told told_;  // the world, as pages know it
  std::uint32_t revision_ = 1;
  ClientId steering_ = 0;
  std::thread thread_;
};

}  // namespace viewer
