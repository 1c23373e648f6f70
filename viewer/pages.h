// SPDX-License-Identifier: MIT
// The clients that look: what each wants to see of the run, and the frames and looks that it gets.
#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"
#include "viewer/frame.h"
#include "viewer/names.h"
#include "viewer/robot_look.h"
#include "viewer/web_server.h"

namespace viewer {

using Json = nlohmann::json;

/// Where texts and frames go; none of these may block.
struct Outlet {
  std::function<void(ClientId, std::string)> send;        ///< a text
  std::function<void(ClientId, std::string)> send_frame;  ///< replaces one that waits
  std::function<bool(ClientId)> wants_frame;
};

class Pages {
 public:
  explicit Pages(Outlet outlet) : outlet_(std::move(outlet)) {}

  void come(ClientId client) { pages_[client]; }
  void leave(ClientId client) { pages_.erase(client); }
  bool is_empty() const { return pages_.empty(); }
  /// Of those that look, the one that came first; 0: nobody does.
  ClientId first() const { return pages_.empty() ? 0 : pages_.begin()->first; }
  void send(ClientId client, const Json& text);
  void tell_all(const Json& event);
  /// Everybody gets a frame of what is shown now.
  void show_anew();

  // --- what a page asks for; they throw std::runtime_error
  /// Returns the number of the subscription, and the units in `units`.
  std::uint32_t subscribe(ClientId client, twin::Twin& twin, const std::vector<std::string>& names,
                          std::vector<std::string>& units);
  void want_rays(ClientId client, std::vector<int> robots);
  /// `robot` empty: it looks at none.
  void look_at(ClientId client, const std::string& robot);

  /// Another run, or another program: names mean something else now, or nothing.
  void take_up(twin::Twin& twin);
  /// The run goes: nothing of it may be kept.
  void let_go() { looks_.clear(); }

  /// `all`: whoever wants one, however short the last one is ago; otherwise those that are due, if it
  /// `plays`.
  void send_frames(twin::Twin& twin, FrameHead head, bool plays, bool all);
  /// To who looks at a robot, what is new there; and to who has just begun, all.
  void send_looks(twin::Twin& twin);

 private:
  using Wall = std::chrono::steady_clock;
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

  Outlet outlet_;
  std::map<ClientId, Page> pages_;
  std::map<int, std::unique_ptr<RobotLook>> looks_;  // by robot, while a page looks at it
  Wall::time_point next_look_{};
};

}  // namespace viewer
