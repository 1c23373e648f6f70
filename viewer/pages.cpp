// SPDX-License-Identifier: MIT
#include "viewer/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace viewer {

namespace {

using namespace std::chrono_literals;
constexpr auto kFrameEvery = 15ms;  // 60 a second
constexpr auto kLookPause = 100ms;
constexpr std::size_t kMostNames = 256;  // of one page's subscription

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

void Pages::send(ClientId client, const Json& text) { outlet_.send(client, text_of(text)); }

void Pages::tell_all(const Json& event) {
  const std::string text = text_of(event);
  for (const auto& [client, page] : pages_) outlet_.send(client, text);
}

void Pages::show_anew() {
  for (auto& [client, page] : pages_) page.fresh = true;
}

std::uint32_t Pages::subscribe(ClientId client, twin::Twin& twin, const std::vector<std::string>& names,
                               std::vector<std::string>& units) {
  if (names.size() > kMostNames)
    throw std::runtime_error(fmt::format("names: got {}, expected at most {}", names.size(), kMostNames));
  Page& page = pages_[client];
  std::vector<Named> values;
  for (const std::string& name : names) {
    values.push_back(find_named(twin, name));
    units.push_back(values.back().unit);
  }
  page.names = names;
  page.values = std::move(values);
  page.fresh = true;
  return ++page.subscription;
}

void Pages::want_rays(ClientId client, std::vector<int> robots) {
  Page& page = pages_[client];
  page.rays = std::move(robots);
  page.fresh = true;
}

void Pages::look_at(ClientId client, const std::string& robot) {
  Page& page = pages_[client];
  page.looked_at = robot;
  page.look_is_fresh = true;
  next_look_ = {};
}

void Pages::take_up(twin::Twin& twin) {
  for (auto& [client, page] : pages_) {
    page.rays.erase(
        std::remove_if(page.rays.begin(), page.rays.end(), [&](int r) { return r >= twin.robots(); }),
        page.rays.end());
    page.values.clear();
    for (const std::string& name : page.names) {
      try {
        page.values.push_back(find_named(twin, name));
      } catch (const std::exception&) {
        page.values.push_back({"", [](twin::Twin&) { return std::numeric_limits<double>::quiet_NaN(); }});
      }
    }
    page.fresh = true;
  }
}

void Pages::send_frames(twin::Twin& twin, FrameHead head, bool plays, bool all) {
  const auto now = Wall::now();
  std::string bodies;
  for (auto& [client, page] : pages_) {
    const bool is_due = now - page.last_frame >= kFrameEvery;
    if (!(page.fresh || all || (plays && is_due))) continue;
    if (!outlet_.wants_frame(client)) {
      page.fresh = true;  // as soon as it can
      continue;
    }
    if (bodies.empty()) bodies = frame_bodies(twin);
    std::vector<double> values;
    for (const Named& named : page.values) values.push_back(named.value(twin));
    head.subscription = page.subscription;
    outlet_.send_frame(client, frame(twin, head, values, bodies, frame_rays(twin, page.rays)));
    page.last_frame = now;
    page.fresh = false;
  }
}

void Pages::send_looks(twin::Twin& twin) {
  if (Wall::now() < next_look_) return;
  next_look_ = Wall::now() + kLookPause;
  std::map<int, Json> news;
  for (auto& [client, page] : pages_) {
    const int robot = page.looked_at.empty() ? -1 : twin.find(page.looked_at);
    if (robot < 0) continue;
    auto& look = looks_[robot];
    if (!look) look = std::make_unique<RobotLook>(twin, robot);
    if (news.find(robot) == news.end()) news[robot] = look->take();
    Json event = news[robot];
    if (event.is_null() && page.look_is_fresh) event = look->last();
    if (event.is_null()) continue;
    send(client, event);
    page.look_is_fresh = false;
  }
  for (auto it = looks_.begin(); it != looks_.end();)
    it = news.find(it->first) == news.end() ? looks_.erase(it) : std::next(it);
}

}  // namespace viewer
