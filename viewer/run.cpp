// SPDX-License-Identifier: MIT
#include "viewer/run.h"

#include <algorithm>

namespace viewer {

namespace {

sim::Clicks at_of(const Json& input) { return input.at("at").get<sim::Clicks>(); }

}  // namespace

/// It is over: its programs finish, its recording is whole.
Run::~Run() {
  trace_.reset();
  if (team_) team_->finish();
  if (recorder_ && twin_) recorder_->end(now(), twin_->simulation().digest());
  inputs_.reset();
  team_.reset();
}

bool Run::open(const sim::WorldDesc& world, const twin::Options& options,
               const std::vector<std::string>& supervisors, std::vector<std::string>& problems) {
  own_twin_ = twin::Twin::open(world, options, problems);
  if (!own_twin_) return false;
  team_ = programs::Team::open(*own_twin_, options, supervisors, problems);
  if (!team_) return false;
  attach(*own_twin_);
  return true;
}

void Run::detach() {
  trace_.reset();
  inputs_.reset();
  twin_ = nullptr;
}

void Run::attach(twin::Twin& twin) {
  twin_ = &twin;
  inputs_ = std::make_unique<inputs::Inputs>(twin);
  next_ = 0;
  listen();
}

void Run::listen() {
  lines_.clear();
  for (int r = 0; r < twin_->robots(); ++r) {
    for (int port = 1; port <= 2; ++port)
      if (twin_->uart_choice(r, port) == "-" || twin_->uart_choice(r, port) == "none") {
        lines_.push_back(std::make_unique<Line>(Line{r, port, ""}));
        twin_->mind(r).board().uart(port).listen(&lines_.back()->text);
      }
    lines_.push_back(std::make_unique<Line>(Line{r, 0, ""}));
    twin_->mind(r).board().virtual_devices().on_console =
        [line = lines_.back().get()](const std::string& text) { line->text += text + "\n"; };
  }
}

void Run::begin(std::function<void(const std::string&)> say, std::function<bool()> should_give_up) {
  team_->say = std::move(say);
  team_->should_give_up = std::move(should_give_up);
  team_->before_first_tick();
}

void Run::record(const std::string& file, const inputs::Opening& opening) {
  recorder_ = std::make_unique<inputs::Recorder>(file, opening, inputs::images_of(*twin_), "--record-inputs");
}

const std::string& Run::recording_error() const {
  static const std::string none;
  return recorder_ ? recorder_->error() : none;
}

sim::Clicks Run::do_due() {
  while (next_ < script_.size() && at_of(script_[next_]) <= now()) {
    const Json input = script_[next_++];
    apply(input);
    if (recorder_) recorder_->note(now(), input);
  }
  return next_ < script_.size() ? at_of(script_[next_]) : sim::kEver;
}

void Run::advance(sim::Clicks until) {
  const sim::Clicks due = do_due();
  inputs_->faults().advance(std::min(until, due));
}

void Run::step() {
  do_due();
  inputs_->step();
}

void Run::apply(const Json& request, const sim::WorldDesc* world) {
  // a program that goes is looked at no more, and the one that comes is
  std::unique_ptr<TraceFeed> before;
  if (request.at("do") == "program") before = std::move(trace_);
  const bool traced = before != nullptr;
  const int robot = traced ? before->robot() : 0;
  const auto signals = traced ? before->asked() : std::vector<std::string>();
  before.reset();
  if (world)
    inputs_->refurnish(request, *world);
  else
    inputs_->apply(request);
  if (traced) trace(robot, signals);
}

void Run::input(const Json& request, const sim::WorldDesc* world) {
  apply(request, world);
  keep(request);
  if (recorder_) recorder_->note(now(), request);
}

/// As done, at this tick.
void Run::keep(const Json& request) {
  constexpr std::size_t kOfOne = 1000;  // bytes, beside a world's text
  script_bytes_ +=
      kOfOne + (request.contains("text") ? request.at("text").get_ref<const std::string&>().size() : 0);
  if (!is_kept()) {  // what is still to come of a recording stays
    script_.erase(script_.begin(), script_.begin() + static_cast<std::ptrdiff_t>(next_));
    next_ = 0;
    return;
  }
  Json noted = request;
  noted["at"] = now();
  script_.insert(script_.begin() + static_cast<std::ptrdiff_t>(next_++), noted);
}

void Run::input_later(const Json& request) {
  if (!is_replay_)
    script_.erase(
        std::find_if(script_.begin(), script_.end(), [&](const Json& i) { return at_of(i) > now(); }),
        script_.end());
  Json noted = request;
  noted["at"] = now() + 1;
  const auto at =
      std::find_if(script_.begin(), script_.end(), [&](const Json& i) { return at_of(i) > now() + 1; });
  script_.insert(at, noted);
}

std::vector<Json> Run::script() const {
  if (is_replay_) return script_;
  return {script_.begin(), script_.begin() + static_cast<std::ptrdiff_t>(next_)};
}

void Run::forget_said() {
  for (const auto& line : lines_) line->text.clear();
}

void Run::trace(int robot, const std::vector<std::string>& signals) {
  trace_.reset();  // first: a robot has one observer
  trace_ = std::make_unique<TraceFeed>(*twin_, robot, signals);
  traced_ = -1;
}

Json Run::take_trace(std::size_t most) {
  if (!trace_ || traced_ == now()) return nullptr;
  traced_ = now();
  return trace_->take(most);
}

}  // namespace viewer
