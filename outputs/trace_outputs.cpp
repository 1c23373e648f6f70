// SPDX-License-Identifier: MIT
#include "outputs/trace_outputs.h"

#include <fmt/format.h>

#include <algorithm>

#include "outputs/complain.h"
#include "outputs/output_folder.h"
#include "sim_core/load/world_loader.h"

namespace outputs {

namespace {

constexpr double kBytesPerMb = 1e6;
constexpr sim::Clicks kCounterClicks = sim::kClicksPerSecond / 100;  // from one point of a curve to the next

bool is_same(const trace::Signal& a, const trace::Signal& b) {
  return a.group == b.group && a.name == b.name;
}

/// Where a robot's name ends in ROBOT:SIGNAL; names may have colons, too. npos: nowhere.
std::size_t end_of_robot(const std::string& word, const sim::WorldDesc& world) {
  std::size_t end = word.find(':');
  for (const sim::RobotDesc& robot : world.robots)
    if (word.rfind(robot.name + ":", 0) == 0) end = std::max(end, robot.name.size());
  return end;
}

}  // namespace

TraceOutputs::TraceOutputs(TraceArguments arguments, twin::Twin& twin)
    : arguments_(std::move(arguments)), twin_(twin) {}
TraceOutputs::~TraceOutputs() = default;

// a signal of one robot, or of all; what is there already is not there twice
bool TraceOutputs::add(const std::string& word, const char* option,
                       std::vector<std::vector<trace::Signal>>& signals, std::vector<std::string>& problems) {
  const std::string where = "command line: " + std::string(option) + ": ";
  const auto colon = end_of_robot(word, twin_.world());
  if (colon == std::string::npos || colon == 0 || colon + 1 == word.size()) {
    problems.push_back(where + "got '" + word + "', expected ROBOT:SIGNAL; ROBOT may be '*'");
    return false;
  }
  const std::string robot = word.substr(0, colon), name = word.substr(colon + 1);
  std::vector<std::string> known;
  bool found = false;
  for (int r = 0; r < twin_.robots(); ++r) {
    known.push_back(twin_.world().robots[static_cast<std::size_t>(r)].name);
    if (robot != "*" && robot != known.back()) continue;
    found = true;
    std::string error;
    auto all = trace::find_signals(name, twin_.mind(r).runner(), error);
    if (all.empty()) {
      problems.push_back(where + known.back() + ": " + error);
      return false;
    }
    auto& mine = signals[static_cast<std::size_t>(r)];
    for (auto& signal : all)
      if (std::none_of(mine.begin(), mine.end(), [&](const auto& s) { return is_same(s, signal); }))
        mine.push_back(std::move(signal));
  }
  if (found) return true;
  std::string names;
  for (const std::string& k : known) names += (names.empty() ? "" : ", ") + k;
  problems.push_back(where + "got robot '" + robot + "', expected one of " + names +
                     sim::did_you_mean_tail(robot, known));
  return false;
}

bool TraceOutputs::choose(std::vector<std::string>& problems) {
  const auto& a = arguments_;
  const std::size_t before = problems.size();
  if (a.signals.empty())
    for (const std::string& name : trace::usual_signals())
      add("*:" + name, "--vcd-signals", signals_, problems);
  for (const std::string& word : a.signals) add(word, "--vcd-signals", signals_, problems);

  window_.from = sim::from_seconds(a.from_s);
  if (a.to_s >= 0) window_.to = sim::from_seconds(a.to_s);
  if (window_.to < window_.from)
    problems.push_back(fmt::format(
        "command line: --vcd-to: got {:g} s, expected --vcd-from, {:g} s, or later", a.to_s, a.from_s));
  window_.most_bytes = static_cast<std::int64_t>(a.most_mb * kBytesPerMb);

  // the trigger is one signal of one robot; of an interrupt its flag, of a line its byte
  std::string trigger_robot, trigger_name;
  if (!a.trigger.empty()) {
    const auto equals = a.trigger.rfind('='), colon = end_of_robot(a.trigger, twin_.world());
    if (equals == std::string::npos || colon == std::string::npos || colon > equals || colon == 0 ||
        a.trigger[0] == '*' || equals + 1 == a.trigger.size()) {
      problems.push_back("command line: --vcd-trigger: got '" + a.trigger + "', expected ROBOT:SIGNAL=VALUE");
    } else {
      trigger_robot = a.trigger.substr(0, colon);
      trigger_name = a.trigger.substr(colon + 1, equals - colon - 1);
      add(a.trigger.substr(0, equals), "--vcd-trigger", signals_, problems);
    }
  }
  if (problems.size() != before) return false;

  // the order of groups in a scope is that of their first signals; each is one block
  for (auto& mine : signals_) {
    std::vector<std::string> groups;
    for (const auto& s : mine)
      if (std::find(groups.begin(), groups.end(), s.group) == groups.end()) groups.push_back(s.group);
    const auto place = [&](const trace::Signal& s) {
      return std::find(groups.begin(), groups.end(), s.group) - groups.begin();
    };
    std::stable_sort(mine.begin(), mine.end(),
                     [&](const auto& x, const auto& y) { return place(x) < place(y); });
  }
  if (trigger_name.empty()) return true;
  std::string error;
  const int robot = twin_.find(trigger_robot);
  const auto meant = trace::find_signals(trigger_name, twin_.mind(robot).runner(), error);
  const std::string text = a.trigger.substr(a.trigger.rfind('=') + 1);
  if (meant.front().group == "variables" && meant.size() > 1)
    error = "got '" + trigger_name + "', an array, expected one of its elements";
  if (!error.empty() || !trace::value_of_signal(meant.front(), text, window_.trigger_value, error)) {
    problems.push_back("command line: --vcd-trigger: " + trigger_robot + ":" + trigger_name + ": " + error);
    return false;
  }
  int number = 0;
  for (int r = 0; r < twin_.robots(); ++r)
    for (const auto& s : signals_[static_cast<std::size_t>(r)]) {
      if (r == robot && is_same(s, meant.front())) window_.trigger = number;
      ++number;
    }
  return true;
}

void TraceOutputs::check(std::vector<std::string>& problems) {
  const auto& a = arguments_;
  if (a.vcd.empty() && (!a.signals.empty() || !a.trigger.empty()))
    problems.push_back("command line: --vcd-signals: got signals without a file, expected --vcd FILE too");
  signals_.resize(static_cast<std::size_t>(twin_.robots()));
  if (!a.vcd.empty() && choose(problems)) can_write(a.vcd, "--vcd", problems);
  can_write(a.timeline, "--trace", problems);
}

void TraceOutputs::open(std::vector<std::string>& problems) {
  const auto& a = arguments_;
  if (a.vcd.empty() && a.timeline.empty()) return;
  const bool spans = !a.timeline.empty();
  std::vector<trace::VcdWriter::Scope> scopes;
  int first = 0;
  for (int r = 0; r < twin_.robots(); ++r) {
    auto& mine = signals_[static_cast<std::size_t>(r)];
    const int count = static_cast<int>(mine.size());
    if (count > 0) scopes.push_back({twin_.world().robots[static_cast<std::size_t>(r)].name, mine});
    auto& mind = twin_.mind(r);
    if (count > 0 || spans)
      traced_.push_back(
          {r, first,
           std::make_unique<trace::RobotTrace>(mind.board(), mind.runner(), std::move(mine), spans)});
    first += count;
  }
  if (!a.vcd.empty()) {
    vcd_ = std::make_unique<trace::VcdWriter>(a.vcd, scopes, window_);
    if (!vcd_->error().empty()) problems.push_back(vcd_->error());
  }
  if (spans) {
    timeline_ = std::make_unique<trace::TimelineWriter>(
        a.timeline, static_cast<std::int64_t>(a.most_timeline_mb * kBytesPerMb));
    if (!timeline_->error().empty()) problems.push_back(timeline_->error());
    for (const Traced& t : traced_)
      timeline_->add_robot(t.robot, twin_.world().robots[static_cast<std::size_t>(t.robot)].name);
  }
}

void TraceOutputs::after_tick() {
  if (traced_.empty()) return;
  // a robot's own clock may be a little behind the world's: what is later than any robot's now waits
  sim::Clicks complete = INT64_MAX;
  for (Traced& t : traced_) {
    auto& mind = twin_.mind(t.robot);
    t.trace->advance(mind.now());
    complete =
        std::min(complete, std::min(twin_.simulation().now(), mind.board().clock().click_at(mind.now())));
  }
  write_changes(complete);
  if (vcd_) vcd_->tick(complete);
  write_spans();
  write_counters(twin_.simulation().now());
  if (timeline_) timeline_->flush();
  release();
}

// nobody is observed for files that are full or over
void TraceOutputs::release() {
  if ((!vcd_ || vcd_->is_done()) && (!timeline_ || timeline_->is_done())) traced_.clear();
}

void TraceOutputs::write_spans() {
  for (Traced& t : traced_) {
    auto& spans = t.trace->spans();
    auto& mind = twin_.mind(t.robot);
    if (timeline_)
      for (const trace::Span& span : spans)
        timeline_->span(t.robot, span, mind.board().clock(), mind.runner());
    spans.clear();
  }
}

void TraceOutputs::write_counters(sim::Clicks now) {
  if (!timeline_ || now < next_count_) return;
  next_count_ = now + kCounterClicks;
  for (Traced& t : traced_) {
    auto& mind = twin_.mind(t.robot);
    if (const host::Runner* robot = mind.runner()) {
      const host::Cycle lived = robot->cycles() - t.counted_cycles;
      const host::Cycle idle = robot->idle_cycles() - t.counted_idle;
      t.counted_cycles += lived;
      t.counted_idle += idle;
      const double load = lived > 0 ? 1 - static_cast<double>(idle) / static_cast<double>(lived) : 0;
      timeline_->counter(t.robot, now, "cpu load", "percent", 100 * std::clamp(load, 0.0, 1.0));
    }
    auto& board = mind.board();
    timeline_->counter(t.robot, now, "UART bytes sent", "bytes",
                       static_cast<double>(board.uart(1).sent() + board.uart(2).sent()));
    timeline_->counter(t.robot, now, "UART bytes received", "bytes",
                       static_cast<double>(t.trace->received()));
    timeline_->counter(t.robot, now, "battery", "V", board.power().battery().voltage(mind.now()));
  }
}

void TraceOutputs::write_changes(sim::Clicks before) {
  batch_.clear();
  for (Traced& t : traced_) {
    auto& changes = t.trace->changes();
    for (; !changes.empty() && changes.front().at < before; changes.pop_front())
      batch_.push_back({changes.front(), t.first_signal + changes.front().signal});
  }
  std::stable_sort(batch_.begin(), batch_.end(),
                   [](const Waiting& x, const Waiting& y) { return x.change.at < y.change.at; });
  for (const Waiting& w : batch_)
    if (vcd_) vcd_->change(w.change.at, w.signal, w.change.value);
}

bool TraceOutputs::failed() const {
  return (vcd_ && !vcd_->error().empty()) || (timeline_ && !timeline_->error().empty());
}

void TraceOutputs::finish(std::vector<std::string>& problems) {
  for (Traced& t : traced_) t.trace->finish(twin_.mind(t.robot).now());
  const sim::Clicks now = twin_.simulation().now();
  write_changes(now);
  write_spans();
  if (vcd_) {
    vcd_->finish(now);
    if (!vcd_->error().empty())
      problems.push_back(vcd_->error());
    else if (!arguments_.trigger.empty() && !vcd_->has_begun())
      problems.push_back(arguments_.vcd + ": --vcd-trigger: got no " + arguments_.trigger +
                         " in the window, expected it once; the dump is empty");
    else if (window_.from > now)
      problems.push_back(
          fmt::format("{}: --vcd-from: got {:g} s, expected a second of the run, which ended at {:g} s; the "
                      "dump is empty",
                      arguments_.vcd, arguments_.from_s, sim::to_seconds(now)));
  }
  if (timeline_) {
    timeline_->finish();
    if (!timeline_->error().empty()) problems.push_back(timeline_->error());
  }
  traced_.clear();
  const auto tell_cut = [](const std::string& file, const char* option, double at_s) {
    complain({fmt::format("{}: {}: ends at {:.6f} s: it would grow beyond {}-max-mb", file, option, at_s,
                          option)});
  };
  if (vcd_ && vcd_->error().empty() && vcd_->cut_at() >= 0)
    tell_cut(arguments_.vcd, "--vcd", sim::to_seconds(vcd_->cut_at()));
  if (timeline_ && timeline_->error().empty() && timeline_->cut_at_ns() >= 0)
    tell_cut(arguments_.timeline, "--trace", static_cast<double>(timeline_->cut_at_ns()) / 1e9);
}

}  // namespace outputs
