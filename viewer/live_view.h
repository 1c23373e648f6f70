// SPDX-License-Identifier: MIT
// A session and the server through which pages reach it.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "viewer/session.h"
#include "viewer/web_server.h"

namespace viewer {

class LiveView {
 public:
  /// Null, with lines in `problems`, when the port cannot be had. A world that cannot run is shown all the
  /// same, its problems are in `problems`, too. `record`: file for inputs; `replay`: inputs that each run
  /// gets, or null; `page_folder`: of the bundled page;
  /// `tell`: told at once, on some thread, when the recording cannot be written.
  static std::unique_ptr<LiveView> open(inputs::Opening opening, const std::string& record, int port,
                                        const std::string& page_folder, std::vector<std::string>& problems,
                                        std::unique_ptr<inputs::Replay> replay = nullptr,
                                        std::function<void(const std::string&)> tell = nullptr);
  ~LiveView();
  /// The run is over, its recording whole; what is wrong with that, or empty.
  std::string end();
  const WebServer& server() const { return *server_; }

 private:
  LiveView() = default;
  std::unique_ptr<Session> session_;
  std::unique_ptr<WebServer> server_;
};

}  // namespace viewer
