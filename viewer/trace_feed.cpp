// SPDX-License-Identifier: MIT
#include "viewer/trace_feed.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "hal_sim/trace/timeline_writer.h"

namespace viewer {

namespace {

constexpr std::size_t kMostSignals = 64;

using Json = nlohmann::json;

/// Seconds with a microsecond's precision: text of a third the length.
double rounded(sim::Clicks at) { return std::round(sim::to_seconds(at) * 1e6) / 1e6; }

}  // namespace

TraceFeed::TraceFeed(twin::Twin& twin, int robot, const std::vector<std::string>& signals)
    : twin_(twin), robot_(robot), asked_(signals) {
  auto& mind = twin.mind(robot);
  std::vector<trace::Signal> found;
  for (const std::string& name : signals.empty() ? trace::usual_signals() : signals) {
    std::string error;
    for (auto& signal : trace::find_signals(name, mind.runner(), error)) found.push_back(std::move(signal));
    if (!error.empty()) throw std::runtime_error("signals: " + error);
  }
  if (found.size() > kMostSignals)
    throw std::runtime_error("signals: got " + std::to_string(found.size()) + " lines, expected at most " +
                             std::to_string(kMostSignals));
  trace_ = std::make_unique<trace::RobotTrace>(mind.board(), mind.runner(), std::move(found), true);
}

void TraceFeed::keep_last(std::size_t most) {
  const auto cut = [&](auto& all) {
    if (all.size() <= 2 * most) return;  // seldom, for the rest is moved
    const std::size_t old = all.size() - most;
    all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(old));
    forgotten_ += old;
  };
  cut(trace_->spans());
  cut(trace_->changes());
}

std::size_t TraceFeed::kept() const { return trace_->spans().size() + trace_->changes().size(); }

Json TraceFeed::take(std::size_t most) {
  auto& mind = twin_.mind(robot_);
  const auto& clock = mind.board().clock();
  trace_->advance(mind.now());
  Json names = Json::array(), spans = Json::array(), changes = Json::array();
  for (const trace::Signal& s : trace_->signals()) names.push_back({s.name, s.width});
  auto& taken = trace_->spans();
  auto& changed = trace_->changes();
  const std::size_t lost = std::exchange(forgotten_, 0) + (taken.size() > most ? taken.size() - most : 0) +
                           (changed.size() > most ? changed.size() - most : 0);
  for (std::size_t i = taken.size() - std::min(taken.size(), most); i < taken.size(); ++i) {
    const trace::Span& s = taken[i];
    std::string known;
    std::string& name = s.kind == trace::Span::Kind::Callback ? functions_[s.function] : known;
    if (name.empty()) name = trace::span_name(s, mind.runner());
    spans.push_back(
        {static_cast<int>(s.kind), rounded(clock.click_at(s.begin)), rounded(clock.click_at(s.end)), name});
  }
  taken.clear();
  for (std::size_t i = changed.size() - std::min(changed.size(), most); i < changed.size(); ++i)
    changes.push_back({changed[i].signal, rounded(changed[i].at), changed[i].value});
  changed.clear();
  return {{"event", "trace"},
          {"robot", twin_.world().robots[static_cast<std::size_t>(robot_)].name},
          {"until", sim::to_seconds(twin_.simulation().now())},
          {"signals", names},
          {"waits", mind.runner() && mind.runner()->waiting_since() < host::kNever},
          {"spans", spans},
          {"changes", changes},
          {"lost", lost}};
}

}  // namespace viewer
