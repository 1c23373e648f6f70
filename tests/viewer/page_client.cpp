// SPDX-License-Identifier: MIT
#include "tests/viewer/page_client.h"

#include <arpa/inet.h>
#include <civetweb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <map>

namespace viewer_test {

namespace fs = std::filesystem;

Frame Frame::read(const std::string& bytes) {
  Frame f;
  std::size_t at = 4;
  const auto take = [&](auto& out) {
    if (at + sizeof out > bytes.size()) return ADD_FAILURE() << "a frame is cut off", void();
    std::memcpy(&out, bytes.data() + at, sizeof out);
    at += sizeof out;
  };
  EXPECT_EQ(bytes.substr(0, 4), "TPK1");
  take(f.revision);
  take(f.time_s);
  take(f.pace);
  for (auto* n : {&f.flags, &f.robots, &f.bodies, &f.values, &f.rays, &f.subscription}) take(*n);
  f.value.resize(f.values);
  f.body.resize(f.bodies);
  f.leds.resize(f.robots);
  f.state.resize(f.robots);
  f.ray.resize(f.rays);
  for (double& v : f.value) take(v);
  for (Body& b : f.body) take(b);
  for (std::uint32_t r = 0; r < f.robots; ++r) {
    take(f.leds[r]);
    take(f.state[r]);
  }
  for (auto& r : f.ray) take(r);
  EXPECT_EQ(at, bytes.size());
  return f;
}

// As docs/connecting.md says it.
static Json changed_world(const Json& before, const Json& changes) {
  Json world = changes.at("head");
  std::vector<std::string> lines(1);
  for (const char c : before.at("text").get<std::string>())
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  const Json& text = changes.at("text");
  const auto at = lines.begin() + text.at("above").get<int>();
  const auto behind = lines.erase(at, at + text.at("gone").get<int>());
  const auto fresh = text.at("lines").get<std::vector<std::string>>();
  lines.insert(behind, fresh.begin(), fresh.end());
  std::string joined;
  for (std::size_t i = 0; i < lines.size(); ++i) joined += (i > 0 ? "\n" : "") + lines[i];
  world["text"] = joined;
  for (const char* name : {"things", "robots", "elements"}) {
    const Json& change = changes.at(name);
    std::map<int, Json> pieces;
    for (const Json& piece : before.at(name)) pieces[piece.at("id")] = piece;
    for (const Json& piece : change.at("fresh")) pieces[piece.at("id")] = piece;
    world[name] = Json::array();
    for (const int id : change.at("order")) world[name].push_back(pieces.at(id));
  }
  const Json& ends = changes.at("elements").at("lines");
  for (std::size_t i = 0; i < world["elements"].size(); ++i) {
    world["elements"][i]["line"] = ends.at(2 * i);
    world["elements"][i]["last_line"] = ends.at(2 * i + 1);
  }
  return world;
}

Page::Page(const viewer::LiveView& view, const std::string& token, const std::string& origin) {
  char error[200] = "";
  const std::string path = "/" + (token.empty() ? view.server().token() : token) + "/live";
  static std::once_flag once;
  std::call_once(once, [] { mg_init_library(MG_FEATURES_WEBSOCKET); });
  // civetweb's client names the port in Host only when it is told so
  const std::string host = "127.0.0.1";
  connection_ =
      mg_connect_websocket_client(host.c_str(), view.server().port(), 0, error, sizeof error, path.c_str(),
                                  origin.empty() ? nullptr : origin.c_str(), on_data, on_close, this);
}

Page::~Page() {
  if (connection_) mg_close_connection(connection_);
}

int Page::on_data(mg_connection*, int bits, char* bytes, std::size_t size, void* me) {
  Page& page = *static_cast<Page*>(me);
  std::lock_guard<std::mutex> lock(page.mutex_);
  if ((bits & 0xF) == MG_WEBSOCKET_OPCODE_TEXT) {
    Json message = Json::parse(std::string(bytes, size));
    if (message.contains("world")) page.world_ = message["world"];
    if (message.value("event", "") == "world_changed") {
      page.world_ = changed_world(page.world_, message["changes"]);
      message["event"] = "world";
      message["world"] = page.world_;
    }
    (message.contains("answer") ? page.answers_ : page.events_).push_back(std::move(message));
  } else if ((bits & 0xF) == MG_WEBSOCKET_OPCODE_BINARY) {
    page.frame_.assign(bytes, size);
    ++page.frames_;
  }
  page.news_.notify_all();
  return 1;
}

void Page::on_close(const mg_connection*, void* me) {
  Page& page = *static_cast<Page*>(me);
  std::lock_guard<std::mutex> lock(page.mutex_);
  page.closed_ = true;
  page.news_.notify_all();
}

bool Page::wait(const std::function<bool()>& until) {
  std::unique_lock<std::mutex> lock(mutex_);
  return news_.wait_for(lock, std::chrono::duration<double>(kPatience_s), until);
}

Json Page::ask(Json request) {
  const int id = next_++;
  request["id"] = id;
  const std::string text = request.dump();
  if (!is_open()) return {{"error", "no connection"}};
  mg_websocket_client_write(connection_, MG_WEBSOCKET_OPCODE_TEXT, text.data(), text.size());
  Json answer;
  const auto mine = [&] {
    while (!answers_.empty()) {
      answer = std::move(answers_.front());
      answers_.pop_front();
      if (answer.at("answer") == id) return true;
    }
    return closed_;
  };
  if (!wait(mine)) ADD_FAILURE() << "no answer to " << text;
  return answer;
}

Json Page::good(Json request) {
  const Json answer = ask(request);
  EXPECT_FALSE(answer.contains("error")) << request << " -> " << answer;
  return answer;
}

Json Page::event(const std::string& name, const std::function<bool(const Json&)>& is_it) {
  Json event;
  const auto comes = [&] {
    while (!events_.empty()) {
      event = std::move(events_.front());
      events_.pop_front();
      if (event.at("event") == name && is_it(event)) return true;
    }
    return false;
  };
  if (!wait(comes)) ADD_FAILURE() << "no event " << name;
  return event;
}

Frame Page::frame(const std::function<bool(const Frame&)>& is_it) {
  Frame frame;
  const auto comes = [&] {
    if (frame_.empty()) return false;
    frame = Frame::read(frame_);
    frame_.clear();
    return is_it(frame);
  };
  if (!wait(comes)) ADD_FAILURE() << "no such frame; the last was of " << frame.time_s << " s";
  return frame;
}

void Page::send_raw(int opcode, const std::string& bytes) {
  mg_websocket_client_write(connection_, opcode, bytes.data(), bytes.size());
}

bool Page::is_closed() {
  return wait([&] { return closed_; });
}

int Page::frames() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return frames_;
}

Json Page::world() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return world_;
}

int get_status(int port, const std::string& path, const std::string& headers, std::string* body) {
  const int s = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string answer;
  if (::connect(s, reinterpret_cast<sockaddr*>(&to), sizeof to) == 0) {
    const std::string request = "GET " + path + " HTTP/1.1\r\n" + headers + "Connection: close\r\n\r\n";
    if (::send(s, request.data(), request.size(), MSG_NOSIGNAL) > 0) {
      char piece[4096];
      for (ssize_t n; (n = ::recv(s, piece, sizeof piece, 0)) > 0;)
        answer.append(piece, static_cast<std::size_t>(n));
    }
  }
  ::close(s);
  if (body) *body = answer;
  return answer.size() > 12 ? std::atoi(answer.c_str() + 9) : 0;
}

ViewTest::ViewTest() {
  std::string name = (fs::temp_directory_path() / "twinpuck-view-XXXXXX").string();
  folder_ = ::mkdtemp(name.data());
}

ViewTest::~ViewTest() {
  view_.reset();
  std::error_code none;
  fs::remove_all(folder_, none);
}

void ViewTest::write(const std::string& name, const std::string& text) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name) << text;
}

std::string ViewTest::read(const std::string& name) const {
  std::stringstream all;
  all << std::ifstream(folder_ / name).rdbuf();
  return all.str();
}

viewer::LiveView& ViewTest::open(const std::string& name, const std::string& record) {
  inputs::Opening opening;
  opening.file = path(name);
  opening.text = read(name);
  view_ = viewer::LiveView::open(std::move(opening), record, 0, path("page"), problems_);
  if (!view_) throw std::runtime_error("no live view");
  return *view_;
}

}  // namespace viewer_test
