// SPDX-License-Identifier: MIT
// A world that runs while pages look at it and touch it. One thread has it all: it takes requests between
// ticks, steps the simulation at the pace that was asked for, and hands out answers, events and frames. It
// waits for nobody: who sends must not block. docs/connecting.md is the protocol.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "hal_sim/inputs/recording.h"
#include "hal_sim/twin/twin.h"
#include "programs/team/team.h"
#include "viewer/document.h"
#include "viewer/frame.h"
#include "viewer/live_edits.h"
#include "viewer/names.h"
#include "viewer/robot_look.h"
#include "viewer/sources.h"
#include "viewer/trace_feed.h"
#include "viewer/web_server.h"

namespace viewer {

using Json = nlohmann::json;

/// Version of the protocol; docs/connecting.md says what changed.
inline constexpr int kProtocolVersion = 1;

class Session {
 public:
  struct Outlet {
    std::function<void(ClientId, std::string)> send;        ///< a text
    std::function<void(ClientId, std::string)> send_frame;  ///< replaces one that waits
    std::function<bool(ClientId)> wants_frame;
  };

  /// `opening.text` is what `opening.file` holds. `record`: file for the inputs; empty: none.
  Session(inputs::Opening opening, std::string record, Outlet outlet);
  /// Each run from time 0 gets the inputs of a recording, each at its tick, and stands still at its end.
  /// Before open().
  void replay(std::unique_ptr<inputs::Replay> recording) { replay_ = std::move(recording); }
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Builds the world. False, with lines in `problems`, when it cannot run; a page can still mend it.
  bool open(std::vector<std::string>& problems);
  /// Starts the thread. From now on only those below may be called, by any thread.
  void start();
  void client_came(ClientId client) { post(client, Kind::Came, ""); }
  void client_said(ClientId client, std::string text) { post(client, Kind::Said, std::move(text)); }
  /// Ends the thread and the run; nothing is sent any more.
  void stop();
  void client_left(ClientId client) { post(client, Kind::Left, ""); }

 private:
  using Wall = std::chrono::steady_clock;
  enum class Kind { Came, Said, Left };
  struct Message {
    ClientId client;
    Kind kind;
    std::string text;
  };
  struct Page {
    bool fresh = true;  // has not got a frame of what is shown now
    std::uint32_t subscription = 0;
    std::vector<std::string> names;
    std::vector<Named> values;
    std::vector<int> rays;
    std::string looked_at;       // robot; empty: none
    bool look_is_fresh = false;  // it has not been told of it
    Wall::time_point last_frame{};
  };
  struct Line {  // of a serial line or a console, until it has been sent
    int robot, port;
    std::string text;
  };
  struct Program {  // a controller that robots run, and its sources
    std::string name;
    std::vector<int> robots;
    Sources sources;
    bool stale = false;        // its sources have changed since it was built
    std::vector<int> waiting;  // robots that get it when it is built, and run another one until then
  };
  struct Built {
    std::string name, path;
    std::vector<std::string> problems, warnings;
    double took_s = 0;
  };

  void post(ClientId client, Kind kind, std::string text);
  void live();
  bool take_messages();
  void handle(const Message& message);
  Json answer(ClientId client, const Json& request);
  Json run_request(const std::string& what, const Json& request);
  Json edit_request(const std::string& what, const Json& request);
  Json program_request(const std::string& what, const Json& request);
  Json look_request(ClientId client, const std::string& what, const Json& request);

  bool reopen(std::vector<std::string>& problems);
  void restart();
  void close_run();
  void document_changed(const LiveEdit& edit);
  LiveEdit live_edit_now() const;
  void choose_program(int robot, const std::string& name);
  Program& program_named(const std::string& name);
  void advance_slice();
  void stand_still();
  sim::Clicks replay_due();
  void step_ticks(double span_s, int count);
  bool step_interrupt(int robot);
  void after_ticks();
  void input(const Json& request);
  void resubscribe();

  Json state_json() const;
  void tell_all(const Json& event);
  void tell_state() { tell_all({{"event", "state"}, {"state", state_json()}}); }
  void tell_world();
  void send_serial();
  void send_frames(bool all);
  void send_trace();
  void send_looks();
  void trace(int robot, const std::vector<std::string>& signals);
  Json programs_json() const;
  void watch_programs();
  void build_program(Program& program);
  void finish_build();
  void play(bool on);
  int robot_named(const std::string& name) const;

  inputs::Opening opening_;
  std::string record_file_;
  Outlet outlet_;
  Document document_;

  std::unique_ptr<twin::Twin> twin_;
  std::unique_ptr<programs::Team> team_;
  std::unique_ptr<inputs::Inputs> inputs_;
  std::unique_ptr<inputs::Recorder> recorder_;
  std::unique_ptr<inputs::Replay> replay_;  // null: there is none, or it did not fit
  bool is_replayed_ = false;                // to its end
  std::unique_ptr<TraceFeed> trace_;        // while a page shows a time line
  sim::Clicks traced_ = 0;                  // until when pages know it
  Wall::time_point next_trace_{};
  std::map<int, std::unique_ptr<RobotLook>> looks_;  // by robot, while a page looks at it
  Wall::time_point next_look_{};
  std::vector<std::unique_ptr<Line>> lines_;  // UARTs keep pointers
  std::vector<int> movable_;                  // ids of the movable objects that live
  sim::WorldText live_text_;                  // what the world that lives was made of
  std::vector<Program> programs_;
  std::future<Built> build_;
  std::string building_;
  bool building_stale_ = false;    // for all robots that run it
  std::vector<int> building_for_;  // and for these
  std::vector<std::string> told_;  // the compiler's warnings of the last opening
  std::size_t traps_told_ = 0;
  Json diagnoses_told_ = Json::array();

  bool playing_ = false, ended_ = false;
  bool was_open_ = false;  // once, so that the options that name robots were right
  double speed_ = 1;       // 0: as fast as possible
  Wall::time_point anchor_wall_{};
  sim::Clicks anchor_ = 0;
  double pace_ = 0;
  Wall::time_point pace_wall_{};
  sim::Clicks pace_from_ = 0;
  Wall::time_point next_watch_{};
  std::uint32_t revision_ = 1;

  std::map<ClientId, Page> pages_;
  ClientId steering_ = 0;

  std::mutex mutex_;
  std::condition_variable news_;
  std::deque<Message> messages_;
  std::atomic<bool> has_news_{false}, ending_{false};
  std::thread thread_;
};

}  // namespace viewer
