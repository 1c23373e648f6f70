// SPDX-License-Identifier: MIT
// A page without a browser: speaks HTTP and the protocol of docs/connecting.md to a live view of this PC.
#pragma once
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <sstream>

#include "compiler/build/build.h"
#include "tests/support/wording.h"
#include "viewer/live_view.h"

struct mg_connection;

namespace viewer_test {

using viewer::Json;
constexpr double kPatience_s = 120;  // of the machine's time, before a test gives up

/// What a frame says (viewer/frame.h), read back.
struct Frame {
  std::uint32_t revision = 0, flags = 0, robots = 0, bodies = 0, values = 0, rays = 0, subscription = 0;
  double time_s = 0, pace = 0;
  std::vector<double> value;
  struct Body {
    float x, y, z, heading;
  };
  std::vector<Body> body;
  std::vector<std::uint32_t> leds, state;
  std::vector<std::array<float, 7>> ray;
  static Frame read(const std::string& bytes);
};

/// One WebSocket to a live view.
class Page {
 public:
  /// `origin` and `host` "": as a program does that is no browser. is_open() tells whether it was let in.
  explicit Page(const viewer::LiveView& view, const std::string& token = "", const std::string& origin = "");
  ~Page();
  bool is_open() const { return connection_ != nullptr; }
  /// Asks and waits for the answer, which may hold "error".
  Json ask(Json request);
  /// What its answer says is wrong; "" where nothing is.
  std::string refusal(Json request) { return ask(std::move(request)).value("error", ""); }
  /// As ask(); fails the test on an error.
  Json good(Json request);
  /// Waits for an event of that name for which `is_it` holds.
  Json event(
      const std::string& name,
      const std::function<bool(const Json&)>& is_it = [](const Json&) { return true; });
  /// Waits for a frame for which `is_it` holds.
  Frame frame(const std::function<bool(const Frame&)>& is_it = [](const Frame&) { return true; });
  /// Sends anything at all, as one message or frame.
  void send_raw(int opcode, const std::string& bytes);
  /// Waits until the server has hung up.
  bool is_closed();
  int frames() const;
  /// The world as it was told, with all changes up to now.
  Json world() const;

 private:
  static int on_data(mg_connection*, int bits, char* bytes, std::size_t size, void* me);
  static void on_close(const mg_connection*, void* me);
  bool wait(const std::function<bool()>& until);

  mg_connection* connection_ = nullptr;
  mutable std::mutex mutex_;
  std::condition_variable news_;
  std::deque<Json> answers_, events_;
  std::string frame_;
  int frames_ = 0, next_ = 1;
  Json world_;  // as told: an event "world_changed" is seen as "world"
  bool closed_ = false;
};

/// GET with these headers; the status, 0 without an answer.
int get_status(int port, const std::string& path, const std::string& headers, std::string* body = nullptr);

/// A folder with worlds and controllers that goes with the test, and a live view of one of them.
class ViewTest : public ::testing::Test {
 protected:
  ViewTest();
  ~ViewTest() override;
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// Opens the world `name` of the folder.
  viewer::LiveView& open(const std::string& name, const std::string& record = "");
  void close() { view_.reset(); }
  viewer::LiveView& view() { return *view_; }

  std::filesystem::path folder_;
  std::unique_ptr<viewer::LiveView> view_;
  std::vector<std::string> problems_;
};

}  // namespace viewer_test
