// SPDX-License-Identifier: MIT
// A run in the debugger's hands: the Debug Adapter Protocol, as editors speak it, for pages. One robot is
// debugged; the world stands when it does. Whoever has the run calls this from one thread; `opened`, `step`
// and `ticked` of the setup come on the world's thread while run_on() waits for it.
#pragma once
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hal_sim/debug/dap.h"
#include "hal_sim/debug/session.h"

namespace viewer {

class Debugging {
 public:
  using Json = nlohmann::json;
  /// An event of the protocol: its name and its body.
  using Tell = std::function<void(const std::string&, const Json&)>;

  /// Stopped at `from`, a cycle of the robot's processor. Null, with lines in `problems`. `has_news`: is
  /// there something to be done instead of running on?
  static std::unique_ptr<Debugging> open(debug::Session::Setup setup, debug::Cycle from, Tell tell,
                                         std::function<bool()> has_news, std::vector<std::string>& problems);

  const std::string& robot() const { return robot_; }
  /// Body of the answer to {command, arguments}. Throws std::runtime_error with what is wrong.
  Json ask(const Json& message);
  bool runs() const { return server_->runs(); }
  void run_on() { server_->run_on(); }
  /// Nothing of the setup is called any more, and the twin is still there.
  void halt() { session_->halt(); }

 private:
  Debugging() = default;  // NOLINT(bugprone-exception-escape): Json checks itself
  void take(const Json& message);

  std::string robot_;
  Tell tell_;
  Json answer_;
  debug::Session* session_ = nullptr;  // the server's
  std::unique_ptr<debug::DapServer> server_;
};

}  // namespace viewer
