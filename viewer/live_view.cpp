// SPDX-License-Identifier: MIT
#include "viewer/live_view.h"

namespace viewer {

std::unique_ptr<LiveView> LiveView::open(inputs::Opening opening, const std::string& record, int port,
                                         const std::string& page_folder, std::vector<std::string>& problems,
                                         std::unique_ptr<inputs::Replay> replay,
                                         std::function<void(const std::string&)> tell) {
  std::unique_ptr<LiveView> view(new LiveView);
  LiveView* v = view.get();
  // the session's thread sends through the server, and the server's threads post to the session: neither runs
  // before both are there
  v->session_ = std::make_unique<Session>(
      std::move(opening), record,
      Outlet{[v](ClientId c, std::string text) { v->server_->send(c, std::move(text)); },
             [v](ClientId c, std::string bytes) { v->server_->send_frame(c, std::move(bytes)); },
             [v](ClientId c) { return v->server_->wants_frame(c); }});
  v->session_->replay(std::move(replay));
  v->session_->on_recording_error = std::move(tell);
  v->session_->open(problems);
  std::string wrong;
  v->server_ =
      WebServer::open(port, page_folder,
                      {[v](ClientId c) { v->session_->client_came(c); },
                       [v](ClientId c, std::string text) { v->session_->client_said(c, std::move(text)); },
                       [v](ClientId c) { v->session_->client_left(c); }},
                      wrong);
  if (!v->server_) {
    problems.push_back(wrong);
    return nullptr;
  }
  v->session_->start();
  return view;
}

LiveView::~LiveView() { end(); }

std::string LiveView::end() {
  std::string wrong = session_->stop();
  server_.reset();
  return wrong;
}

}  // namespace viewer
