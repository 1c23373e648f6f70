// SPDX-License-Identifier: MIT
// The page's side of the network: HTTP for the page's files, a WebSocket for everything else, by civetweb.
// Listens on 127.0.0.1 only. Every path begins with a random token; requests that name another host, or come
// from a page of another origin, are refused before anything of theirs is read.
//
//   browser --- GET /TOKEN/            --> the page's files, from one folder, no other
//           --- WebSocket /TOKEN/live  --> on_text() of whoever listens; send() goes back
//
// Who has not shown the token yet may be there for a second, and few may: of more the oldest goes, so nobody
// keeps the page from opening by doing nothing.
//
// Nobody who sends waits for a slow reader: each client has a thread that writes, texts queue up to a limit,
// and of binary frames only the newest is kept.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

struct mg_context;
struct mg_connection;

namespace viewer {

using ClientId = int;

class WebServer {
 public:
  struct Listener {
    std::function<void(ClientId)> on_open;
    std::function<void(ClientId, std::string)> on_text;  ///< one whole message
    std::function<void(ClientId)> on_close;
  };

  /// `port` 0: any free one. `page_folder`: where index.html lies. The listener is called on the server's
  /// threads, until the destructor has returned.
  static std::unique_ptr<WebServer> open(int port, const std::string& page_folder, Listener listener,
                                         std::string& error);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  int port() const { return port_; }
  const std::string& token() const { return token_; }
  /// What to open in a browser.
  std::string address() const;

  /// Queues a text. A client that lets too many wait is dropped.
  void send(ClientId client, std::string text);
  /// Replaces the frame that waits to be sent, if one does.
  void send_frame(ClientId client, std::string bytes);
  /// The last frame has been taken by the writer: another one would not replace it.
  bool wants_frame(ClientId client);

 private:
  struct Client;
  struct Calls;  // civetweb's
  friend struct Calls;
  WebServer() = default;
  bool is_trusted(const mg_connection* connection) const;
  int serve_file(mg_connection* connection);
  std::shared_ptr<Client> find(ClientId id);

  std::string page_folder_, token_;
  int port_ = 0;
  Listener listener_;
  mg_context* context_ = nullptr;
  std::mutex clients_mutex_;
  std::map<ClientId, std::shared_ptr<Client>> clients_;
  ClientId next_id_ = 1;
  // --- connections by the port of their other end: who has shown the token, and who not, since when
  void someone_came();
  void is_known(const mg_connection* connection);
  std::mutex strangers_mutex_;
  std::set<int> known_;
  std::map<int, std::chrono::steady_clock::time_point> strangers_;
};

}  // namespace viewer
