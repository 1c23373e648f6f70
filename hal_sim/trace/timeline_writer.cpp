// SPDX-License-Identifier: MIT
#include "hal_sim/trace/timeline_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "dspic30/memory/irqs.h"
#include "hal_sim/host/observer.h"
#include "hal_sim/trace/vcd_writer.h"

namespace trace {

namespace {

enum Track { kMain = 1, kInterrupts = 2, kAgendas = 3 };
constexpr std::int64_t kEndBytes = 200;

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string micros(std::int64_t ns) { return fmt::format("{}.{:03}", ns / 1000, ns % 1000); }

}  // namespace

TimelineWriter::TimelineWriter(const std::string& path, std::int64_t most_bytes)
    : file_(path, "--trace"), most_bytes_(most_bytes) {
  pending_ = "[\n";
}

std::string span_name(const Span& span, const host::Runner* runner) {
  switch (span.kind) {
    case Span::Kind::Busy:
      return "busy";
    case Span::Kind::Waiting:
    case Span::Kind::HandlerWaiting:
      return "waiting";
    case Span::Kind::Handler:
      return span.vector < host::kTrapVector ? dspic::irq_name(span.vector) : "trap";
    case Span::Kind::Callback:
      break;
  }
  const std::string known = runner ? runner->data().place_of(span.function).function : "";
  return known.empty() ? fmt::format("{:#x}", span.function) : known;
}

void TimelineWriter::add(const std::string& event) {
  if (done_) return;
  if (bytes_ + static_cast<std::int64_t>(pending_.size() + event.size()) + kEndBytes > most_bytes_) {
    done_ = true;
    cut_at_ns_ = latest_ns_;
    // an instant of all robots, where the last event ends
    pending_ += fmt::format(
        R"({}{{"name":"the file would grow beyond --trace-max-mb","ph":"i","s":"g","pid":0,"tid":0,"ts":{}}})",
        first_ ? "" : ",\n", micros(latest_ns_));
    first_ = false;
    return;
  }
  // the comma comes before the event, so that what is there can be closed at any line's end
  if (!first_) pending_ += ",\n";
  first_ = false;
  pending_ += event;
}

void TimelineWriter::add_robot(int robot, const std::string& name) {
  const auto label = [&](const char* what, int track, const std::string& text) {
    add(fmt::format(R"({{"name":"{}","ph":"M","pid":{},"tid":{},"args":{{"name":{}}}}})", what, robot, track,
                    json_text(text)));
  };
  label("process_name", 0, name);
  label("thread_name", kMain, "main program");
  label("thread_name", kInterrupts, "interrupts");
  label("thread_name", kAgendas, "agendas");
}

void TimelineWriter::span(int robot, const Span& span, const board::RobotClock& clock,
                          const host::Runner* runner) {
  // an agenda's function is looked up once
  std::string known, args;
  std::string& name = span.kind == Span::Kind::Callback ? names_[{robot, span.function}] : known;
  if (name.empty()) name = span_name(span, runner);
  const auto ns = [&](host::Cycle at) { return to_ns(clock.click_at(at)); };
  Track track = kMain;
  if (span.kind == Span::Kind::Callback) track = kAgendas;
  if (span.kind == Span::Kind::HandlerWaiting) track = kInterrupts;
  if (span.kind == Span::Kind::Handler) {
    track = kInterrupts;
    args = fmt::format(R"(,"first_instruction_us":{},"interrupted_handlers":{})", micros(ns(span.first)),
                       span.depth);
    if (span.flagged >= 0)
      args += fmt::format(R"(,"flag_us":{},"latency_cycles":{})", micros(ns(span.flagged)),
                          span.first - span.flagged);
  }
  const std::int64_t begin = ns(span.begin);
  latest_ns_ = std::max(latest_ns_, ns(span.end));
  add(fmt::format(R"({{"name":{},"ph":"X","pid":{},"tid":{},"ts":{},"dur":{},"args":{{"cycles":{}{}}}}})",
                  json_text(name), robot, static_cast<int>(track), micros(begin),
                  micros(ns(span.end) - begin), span.end - span.begin, args));
}

void TimelineWriter::counter(int robot, sim::Clicks at, const char* name, const char* unit, double value) {
  add(fmt::format(R"({{"name":"{}","ph":"C","pid":{},"ts":{},"args":{{"{}":{:.6g}}}}})", name, robot,
                  micros(to_ns(at)), unit, value));
}

void TimelineWriter::flush() {
  if (pending_.empty() || !error().empty()) return;
  bytes_ += static_cast<std::int64_t>(pending_.size());
  file_.append(pending_, "\n]\n");
  if (!error().empty()) done_ = true;
  pending_.clear();
}

void TimelineWriter::finish() {
  pending_ += "\n]\n";
  flush();
  file_.close();
}

}  // namespace trace
