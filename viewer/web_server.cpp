// SPDX-License-Identifier: MIT
#include "viewer/web_server.h"

#include <arpa/inet.h>
#include <civetweb.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/random.h>
#include <sys/socket.h>

#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <thread>
#include <vector>

#include "sim_core/base/input_file.h"

namespace viewer {

namespace {

constexpr std::size_t kLongestMessage = 8u << 20;  // bytes of a request; a world file may have as many
constexpr std::size_t kMostWaiting = 32u << 20;    // bytes of texts that a client has not read
constexpr std::size_t kLargestFile = 64u << 20;    // bytes of the page's files
constexpr std::size_t kMostClients = 32;
constexpr std::size_t kMostStrangers = 24;
constexpr auto kLongestStrange = std::chrono::seconds(1);
constexpr const char* kThreads = "80";  // one a connection: clients, strangers, and what browsers open beside
constexpr int kMostOpen = 4096;         // open files, among which a connection's is looked for

/// This process's connections to that port of this machine: their files, and the ports of their other ends.
std::map<int, int> connections_to(int our_port) {
  const auto port_of = [](int (*name)(int, sockaddr*, socklen_t*), int file) {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    const bool is_there = name(file, reinterpret_cast<sockaddr*>(&address), &size) == 0;
    return is_there && address.sin_family == AF_INET ? ntohs(address.sin_port) : -1;
  };
  std::map<int, int> all;
  for (int file = 3; file < kMostOpen; ++file)
    if (const int theirs = port_of(::getpeername, file);
        theirs >= 0 && port_of(::getsockname, file) == our_port)
      all[file] = theirs;
  return all;
}

std::string random_token() {
  unsigned char bytes[16];
  std::string token;
  if (getrandom(bytes, sizeof bytes, 0) != sizeof bytes) return token;
  for (unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

// as long for a wrong token as for a right one
bool same(const std::string& a, const char* b, std::size_t length) {
  unsigned char differs = a.size() != length;
  for (std::size_t i = 0; i < a.size() && i < length; ++i)
    differs |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return !differs;
}

struct FileType {
  const char* name;
  const char* type;
};
// the page is these files and nothing else
constexpr FileType kFiles[] = {{"index.html", "text/html; charset=utf-8"},
                               {"start.js", "text/javascript; charset=utf-8"},
                               {"page.js", "text/javascript; charset=utf-8"},
                               {"page.css", "text/css; charset=utf-8"}};

}  // namespace

struct WebServer::Client {
  ClientId id = 0;
  mg_connection* connection = nullptr;
  std::string message;  // pieces of one that has not ended
  std::mutex mutex;
  std::condition_variable news;
  std::deque<std::string> texts;
  std::size_t waiting = 0;
  std::string frame;
  bool has_frame = false, closing = false;
  std::thread writer;

  void write_all() {
    std::unique_lock<std::mutex> lock(mutex);
    for (;;) {
      news.wait(lock, [&] { return closing || has_frame || !texts.empty(); });
      if (closing) return;
      std::string bytes;
      const bool is_text = !texts.empty();
      if (is_text) {
        bytes = std::move(texts.front());
        texts.pop_front();
        waiting -= bytes.size();
      } else {
        bytes.swap(frame);
        has_frame = false;
      }
      lock.unlock();
      const int written =
          mg_websocket_write(connection, is_text ? MG_WEBSOCKET_OPCODE_TEXT : MG_WEBSOCKET_OPCODE_BINARY,
                             bytes.data(), bytes.size());
      lock.lock();
      if (written <= 0) closing = true;
    }
  }
  void close() {
    {
      std::lock_guard<std::mutex> lock(mutex);
      closing = true;
    }
    news.notify_all();
  }
};

/// What civetweb calls, on its threads. A connection keeps its client's number.
struct WebServer::Calls {
  static WebServer& of(void* data) { return *static_cast<WebServer*>(data); }
  static ClientId id_of(const mg_connection* c) {
    return static_cast<ClientId>(reinterpret_cast<std::intptr_t>(mg_get_user_connection_data(c)));
  }

  static int page(mg_connection* c, void* data) { return of(data).serve_file(c); }

  static int came(const mg_connection* c, void**) {
    of(mg_get_user_data(mg_get_context(c))).someone_came();
    return 0;
  }

  static void left(const mg_connection* c) {
    WebServer& me = of(mg_get_user_data(mg_get_context(c)));
    std::lock_guard<std::mutex> lock(me.strangers_mutex_);
    if (const mg_request_info* info = mg_get_request_info(c)) me.known_.erase(info->remote_port);
  }

  static int connect(const mg_connection* c, void* data) {
    WebServer& me = of(data);
    me.is_known(c);
    std::lock_guard<std::mutex> lock(me.clients_mutex_);
    return me.is_trusted(c) && me.clients_.size() < kMostClients ? 0 : 1;
  }

  static void ready(mg_connection* c, void* data) {
    WebServer& me = of(data);
    auto client = std::make_shared<Client>();
    client->connection = c;
    {
      std::lock_guard<std::mutex> lock(me.clients_mutex_);
      client->id = me.next_id_++;
      me.clients_[client->id] = client;
    }
    // a number, which nobody follows
    void* const number = reinterpret_cast<void*>(  // NOLINT(performance-no-int-to-ptr)
        static_cast<std::intptr_t>(client->id));
    mg_set_user_connection_data(c, number);
    client->writer = std::thread([client] { client->write_all(); });
    me.listener_.on_open(client->id);
  }

  static int text(mg_connection* c, int bits, char* bytes, std::size_t size, void* data) {
    WebServer& me = of(data);
    const auto client = me.find(id_of(c));
    const int opcode = bits & 0xF;
    const bool is_last = bits & 0x80;
    if (!client || opcode == MG_WEBSOCKET_OPCODE_CONNECTION_CLOSE) return 0;
    if (opcode == MG_WEBSOCKET_OPCODE_PING || opcode == MG_WEBSOCKET_OPCODE_PONG) return 1;
    const bool goes_on = opcode == MG_WEBSOCKET_OPCODE_CONTINUATION;
    // requests are texts, of a limited length; who sends anything else is no client of ours
    if ((!goes_on && opcode != MG_WEBSOCKET_OPCODE_TEXT) || client->message.size() + size > kLongestMessage)
      return 0;
    if (!goes_on) client->message.clear();
    client->message.append(bytes, size);
    if (!is_last) return 1;
    {
      std::lock_guard<std::mutex> lock(client->mutex);
      if (client->closing) return 0;
    }
    me.listener_.on_text(client->id, std::move(client->message));
    client->message.clear();
    return 1;
  }

  static void closed(const mg_connection* c, void* data) {
    WebServer& me = of(data);
    const auto client = me.find(id_of(c));
    if (!client) return;
    client->close();
    client->writer.join();
    {
      std::lock_guard<std::mutex> lock(me.clients_mutex_);
      me.clients_.erase(client->id);
    }
    me.listener_.on_close(client->id);
  }

  // the library tells of connections that ended by themselves; nobody needs to know
  static int log(const mg_connection*, const char*) { return 1; }
};

std::unique_ptr<WebServer> WebServer::open(int port, const std::string& page_folder, Listener listener,
                                           std::string& error) {
  std::unique_ptr<WebServer> server(new WebServer);
  server->page_folder_ = page_folder;
  server->listener_ = std::move(listener);
  server->token_ = random_token();
  const std::string ports = "127.0.0.1:" + std::to_string(port);
  const char* options[] = {"listening_ports",
                           ports.c_str(),
                           "num_threads",
                           kThreads,
                           "request_timeout_ms",
                           "10000",
                           "websocket_timeout_ms",
                           "3600000",
                           "enable_websocket_ping_pong",
                           "no",
                           "enable_directory_listing",
                           "no",
                           "tcp_nodelay",
                           "1",
                           nullptr};
  mg_callbacks callbacks{};
  callbacks.log_message = Calls::log;
  callbacks.init_connection = Calls::came;
  callbacks.connection_close = Calls::left;
  static std::once_flag once;
  std::call_once(once, [] { mg_init_library(MG_FEATURES_WEBSOCKET); });
  errno = 0;
  server->context_ = mg_start(&callbacks, server.get(), options);
  mg_server_port bound[1];
  if (!server->context_ || server->token_.empty() || mg_get_server_ports(server->context_, 1, bound) < 1) {
    error =
        fmt::format("port: got {}, {}; 0 takes any", port,
                    errno == EACCES || errno == EPERM ? "which is the system's, expected one of 1024 and more"
                                                      : "which another program has, expected a free one");
    return nullptr;
  }
  server->port_ = bound[0].port;
  mg_set_websocket_handler(server->context_, ("/" + server->token_ + "/live$").c_str(), Calls::connect,
                           Calls::ready, Calls::text, Calls::closed, server.get());
  mg_set_request_handler(server->context_, "/", Calls::page, server.get());
  return server;
}

WebServer::~WebServer() {
  if (!context_) return;
  // the library looks every two seconds whether it should end, and whenever somebody comes, writes or goes
  for (const auto& [file, port] : connections_to(port_)) ::shutdown(file, SHUT_RD);
  std::thread visitor([port = port_] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    char error[80];
    if (mg_connection* c = mg_connect_client("127.0.0.1", port, 0, error, sizeof error))
      mg_close_connection(c);
  });
  mg_stop(context_);
  visitor.join();
}

std::string WebServer::address() const { return fmt::format("http://127.0.0.1:{}/{}/", port_, token_); }

/// Whose request is this? A page elsewhere can make a browser send anything but these two headers.
bool WebServer::is_trusted(const mg_connection* connection) const {
  const char* host = mg_get_header(connection, "Host");
  const char* origin = mg_get_header(connection, "Origin");
  for (const char* name : {"127.0.0.1", "localhost"}) {
    const std::string expected = fmt::format("{}:{}", name, port_);
    // some clients leave the port out; whoever got here by another name is a page elsewhere
    if (!host || (expected != host && std::string(name) != host)) continue;
    return !origin || origin == "http://" + expected;
  }
  return false;
}

/// Of those that have not shown the token, who is there for too long goes, and of too many the oldest.
void WebServer::someone_came() {
  std::lock_guard<std::mutex> lock(strangers_mutex_);
  const auto now = std::chrono::steady_clock::now();
  std::map<int, std::chrono::steady_clock::time_point> there;  // by the port of their other end
  std::multimap<std::chrono::steady_clock::time_point, int> by_age;
  for (const auto& [file, port] : connections_to(port_)) {
    if (known_.count(port) > 0) continue;
    const auto before = strangers_.find(port);
    there[port] = before == strangers_.end() ? now : before->second;
    by_age.emplace(there[port], file);
  }
  std::size_t left = by_age.size();
  for (const auto& [since, file] : by_age) {
    if (left <= kMostStrangers && now - since <= kLongestStrange) break;
    ::shutdown(file, SHUT_RDWR);
    --left;
  }
  strangers_ = std::move(there);
}

void WebServer::is_known(const mg_connection* connection) {
  const mg_request_info* info = mg_get_request_info(connection);
  std::lock_guard<std::mutex> lock(strangers_mutex_);
  if (info) known_.insert(info->remote_port);
}

int WebServer::serve_file(mg_connection* connection) {
  const mg_request_info* info = mg_get_request_info(connection);
  const auto refuse = [&](int code, const char* text) {
    mg_send_http_error(connection, code, "%s", text);
    return code;
  };
  // /TOKEN/NAME
  const char* path = info->local_uri ? info->local_uri : "";
  const char* name = std::strchr(path + (*path == '/'), '/');
  if (!is_trusted(connection) || *path != '/' || !name ||
      !same(token_, path + 1, static_cast<std::size_t>(name - path - 1)))
    return refuse(403, "the address that twinpuck view printed opens this page, and no other does");
  is_known(connection);
  if (std::strcmp(info->request_method, "GET") != 0) return refuse(405, "expected GET");
  ++name;
  // Only the files of the list can be asked for.
  for (const FileType& file : kFiles) {
    if (std::strcmp(name, *name ? file.name : "") != 0 && !(!*name && &file == kFiles)) continue;
    std::string bytes;
    if (!sim::read_input_file(page_folder_ + "/" + file.name, kLargestFile, bytes).empty())
      return refuse(404, "the page is not built: make view builds it");
    mg_printf(
        connection,
        "HTTP/1.1 200 OK\r\nContent-Type: %s\r\nContent-Length: %zu\r\nCache-Control: no-store\r\n"
        "X-Content-Type-Options: nosniff\r\nX-Frame-Options: DENY\r\nReferrer-Policy: no-referrer\r\n"
        "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
        "connect-src 'self' ws://127.0.0.1:%d ws://localhost:%d; img-src 'self' data: blob:; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n\r\n",
        file.type, bytes.size(), port_, port_);
    mg_write(connection, bytes.data(), bytes.size());
    return 200;
  }
  return refuse(404, "no such file");
}

std::shared_ptr<WebServer::Client> WebServer::find(ClientId id) {
  std::lock_guard<std::mutex> lock(clients_mutex_);
  const auto at = clients_.find(id);
  return at == clients_.end() ? nullptr : at->second;
}

void WebServer::send(ClientId id, std::string text) {
  const auto client = find(id);
  if (!client) return;
  {
    std::lock_guard<std::mutex> lock(client->mutex);
    client->waiting += text.size();
    client->texts.push_back(std::move(text));
    if (client->waiting > kMostWaiting) client->closing = true;
  }
  client->news.notify_one();
}

void WebServer::send_frame(ClientId id, std::string bytes) {
  const auto client = find(id);
  if (!client) return;
  {
    std::lock_guard<std::mutex> lock(client->mutex);
    client->frame = std::move(bytes);
    client->has_frame = true;
  }
  client->news.notify_one();
}

bool WebServer::wants_frame(ClientId id) {
  const auto client = find(id);
  if (!client) return false;
  std::lock_guard<std::mutex> lock(client->mutex);
  return !client->has_frame && !client->closing;
}

}  // namespace viewer
