// SPDX-License-Identifier: MIT
// The thread: requests, pace, frames. What requests do is in session_requests.cpp.
#include "viewer/session.h"

#include <fmt/format.h>

#include <filesystem>

#include "sim_core/load/world_loader.h"
#include "viewer/events.h"
#include "viewer/world_json.h"

namespace viewer {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

constexpr auto kFrameEvery = 15ms;  // 60 a second
constexpr auto kSlice = 4ms;        // of stepping, between two looks at requests
constexpr auto kTraceEvery = 100ms;
constexpr auto kLookPause = 100ms;
constexpr std::size_t kMostTold = 4000;            // spans, and changes, of one event
constexpr auto kPaceOver = 500ms;                  // the pace is a mean over so long
constexpr std::size_t kLongestSerial = 64u << 10;  // bytes of a line sent at once

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

Session::Session(inputs::Opening opening, std::string record, Outlet outlet)
    : opening_(std::move(opening)),
      record_file_(std::move(record)),
      outlet_(std::move(outlet)),
      document_(opening_.file, opening_.text),
      live_text_("") {}

Session::~Session() { stop(); }

void Session::stop() {
  ending_ = true;
  has_news_ = true;
  news_.notify_all();
  if (thread_.joinable()) thread_.join();
  if (build_.valid()) build_.wait();
  close_run();
}

bool Session::open(std::vector<std::string>& problems) { return reopen(problems); }

void Session::start() {
  thread_ = std::thread([this] { live(); });
}

void Session::post(ClientId client, Kind kind, std::string text) {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    messages_.push_back({client, kind, std::move(text)});
    has_news_ = true;
  }
  news_.notify_one();
}

/// The run that was is over: its programs finish, its recording is whole.
void Session::close_run() {
  trace_.reset();
  looks_.clear();
  if (team_) team_->finish();
  if (recorder_ && twin_) recorder_->end(twin_->simulation().now(), twin_->simulation().digest());
  recorder_.reset();
  inputs_.reset();
  team_.reset();
  twin_.reset();
  lines_.clear();
}

/// A new run from time 0, of the document as it is.
bool Session::reopen(std::vector<std::string>& problems) {
  const sim::LoadedWorld& loaded = document_.loaded();
  if (!loaded.world) {
    problems.push_back(loaded.report(document_.file()));
    return false;
  }
  sim::WorldDesc world = *loaded.world;
  opening_.file = document_.file();
  opening_.text = document_.text().text();
  world.seed = opening_.seed;
  twin::Options options = opening_.options;
  options.world_folder = fs::path(opening_.file).parent_path().string();
  told_.clear();
  options.tell = [this](const std::string& line) { told_.push_back(line); };
  // options that name robots are for those that are there
  const auto is_gone = [&](const twin::Choice& c) {
    for (const auto& r : world.robots)
      if (c.robot == "*" || c.robot == r.name) return false;
    return true;
  };
  if (was_open_)
    for (auto* choices : {&options.firmware, &options.uart1, &options.uart2})
      choices->erase(std::remove_if(choices->begin(), choices->end(), is_gone), choices->end());
  close_run();  // first: programs lie in memory where they lay in the run before
  twin_ = twin::Twin::open(world, options, problems);
  if (!twin_) return false;
  was_open_ = true;
  team_ = programs::Team::open(*twin_, options, opening_.supervisors, problems);
  if (!team_) {
    twin_.reset();
    return false;
  }
  inputs_ = std::make_unique<inputs::Inputs>(*twin_);
  if (!record_file_.empty()) recorder_ = std::make_unique<inputs::Recorder>(record_file_, opening_);
  live_text_ = document_.text();
  movable_ = movable_ids(twin_->world(), live_text_);
  if (replay_) replay_->rewind();
  is_replayed_ = false;
  ended_ = false;
  traps_told_ = 0;
  anchor_ = pace_from_ = 0;
  anchor_wall_ = pace_wall_ = Wall::now();
  programs_.clear();
  for (int r = 0; r < twin_->robots(); ++r) {
    const auto& robot = twin_->world().robots[static_cast<std::size_t>(r)];
    for (int port = 1; port <= 2; ++port)
      if (twin_->uart_choice(r, port) == "-" || twin_->uart_choice(r, port) == "none") {
        lines_.push_back(std::make_unique<Line>(Line{r, port, ""}));
        twin_->mind(r).board().uart(port).listen(&lines_.back()->text);
      }
    lines_.push_back(std::make_unique<Line>(Line{r, 0, ""}));
    twin_->mind(r).board().virtual_devices().on_console =
        [line = lines_.back().get()](const std::string& text) { line->text += text + "\n"; };
    if (robot.firmware.empty()) continue;
    program_named(robot.firmware).robots.push_back(r);
  }
  team_->should_give_up = [this] { return ending_.load(); };
  team_->say = [this](const std::string& line) { tell_all({{"event", "says"}, {"text", line}}); };
  team_->before_first_tick();
  resubscribe();
  return true;
}

Session::Program& Session::program_named(const std::string& name) {
  for (Program& program : programs_)
    if (program.name == name) return program;
  std::vector<std::string> none;
  const std::string folder = fs::path(opening_.file).parent_path().string();
  programs_.push_back({name, {}, Sources(twin::find_firmware(name, folder, none)), false, {}});
  return programs_.back();
}

/// A robot of the run gets another program, as soon as that is built.
void Session::choose_program(int robot, const std::string& name) {
  opening_.options.firmware.push_back({twin_->world().robots[static_cast<std::size_t>(robot)].name, name});
  program_named(name).waiting.push_back(robot);
  next_watch_ = {};
}

void Session::restart() {
  std::vector<std::string> problems;
  if (!reopen(problems)) tell_all({{"event", "problems"}, {"problems", problems}});
  tell_world();
  tell_state();
}

void Session::live() {
  while (!ending_) {
    const bool changed = take_messages();
    if (playing_ && twin_ && !ended_) {
      advance_slice();
    } else {
      pace_ = 0;
      pace_wall_ = Wall::now();
      if (twin_) pace_from_ = twin_->simulation().now();
    }
    if (Wall::now() >= next_watch_) watch_programs();
    send_serial();
    send_frames(changed);
    send_trace();
    send_looks();
    if (!playing_ || !twin_ || ended_) {
      std::unique_lock<std::mutex> lock(mutex_);
      news_.wait_for(lock, kFrameEvery, [&] { return has_news_.load(); });
    }
  }
}

bool Session::take_messages() {
  if (!has_news_) return false;
  std::deque<Message> messages;
  {
    std::lock_guard<std::mutex> lock(mutex_);
    messages.swap(messages_);
    has_news_ = ending_.load();
  }
  for (const Message& message : messages) handle(message);
  return !messages.empty();
}

/// Inputs of a recording that are due are done. Until when the world may run before it is looked at again.
sim::Clicks Session::replay_due() {
  if (!replay_) return sim::kEver;
  const sim::Clicks now = twin_->simulation().now(), end = replay_->end();
  try {
    replay_->apply_due(*inputs_, now);
  } catch (const std::exception& e) {
    tell_all({{"event", "problems"}, {"problems", {std::string("replay: ") + e.what()}}});
    replay_.reset();
    return sim::kEver;
  }
  if (now >= end && end >= 0 && !is_replayed_) {
    is_replayed_ = true;
    stand_still();
  }
  return std::min(replay_->next(), now < end ? end : sim::kEver);
}

/// By itself, not because somebody asked: everybody gets a last frame of it.
void Session::stand_still() {
  playing_ = false;
  for (auto& [client, page] : pages_) page.fresh = true;
  tell_state();
}

void Session::advance_slice() {
  sim::Simulation& simulation = twin_->simulation();
  const auto begin = Wall::now();
  // in between is looked for requests, and for what programs print
  const sim::Clicks look = sim::kClicksPerSecond / 64;
  while (!has_news_ && !team_->has_ended()) {
    const auto now = Wall::now();
    if (now - begin > kSlice) break;
    sim::Clicks until = std::min(simulation.now() + look, replay_due());
    if (!playing_) break;
    if (speed_ > 0) {
      const sim::Clicks due = anchor_ + sim::from_seconds(seconds(now - anchor_wall_) * speed_);
      if (simulation.now() >= due) {
        // until the next tick is due, or a request comes
        const double wait_s =
            (sim::to_seconds(simulation.now() - anchor_) + simulation.scene().tick_s()) / speed_ -
            seconds(now - anchor_wall_);
        std::unique_lock<std::mutex> lock(mutex_);
        news_.wait_for(lock, std::chrono::duration<double>(std::min(wait_s, seconds(kSlice))),
                       [&] { return has_news_.load(); });
        break;
      }
      // a machine that is too slow does not run after the time it lost
      if (seconds(now - anchor_wall_) * speed_ - sim::to_seconds(simulation.now() - anchor_) >
          0.25 * speed_) {
        anchor_ = simulation.now();
        anchor_wall_ = now;
        continue;
      }
      until = std::min(until, due);
    }
    inputs_->faults().advance(until);
  }
  after_ticks();
  if (Wall::now() - pace_wall_ > kPaceOver) {
    pace_ = sim::to_seconds(simulation.now() - pace_from_) / seconds(Wall::now() - pace_wall_);
    pace_wall_ = Wall::now();
    pace_from_ = simulation.now();
  }
}

/// What happened in the ticks that everybody should know.
void Session::after_ticks() {
  const auto traps = twin_->traps();
  for (std::size_t i = traps_told_; i < traps.size(); ++i) tell_all(trap_event(traps[i]));
  traps_told_ = std::max(traps_told_, traps.size());
  if (team_->has_ended() && !ended_) {
    ended_ = true;
    stand_still();
  }
}

void Session::step_ticks(double span_s, int count) {
  sim::Simulation& simulation = twin_->simulation();
  for (int i = 0; i < count && !team_->has_ended(); ++i) {
    const sim::Clicks end = simulation.now() + sim::from_seconds(span_s);
    do {
      const sim::Clicks due = replay_due();
      if (span_s <= 0)
        inputs_->step();
      else
        inputs_->faults().advance(std::min(end, due));
    } while (simulation.now() < end);
  }
  after_ticks();
}

bool Session::step_interrupt(int robot) {
  sim::Simulation& simulation = twin_->simulation();
  const host::Runner* program = twin_->mind(robot).runner();
  if (!program) return false;
  const auto served = program->interrupts_served();
  const sim::Clicks end = simulation.now() + 10 * sim::kClicksPerSecond;
  while (program->interrupts_served() == served && simulation.now() < end && !team_->has_ended()) {
    replay_due();
    inputs_->step();
  }
  after_ticks();
  return program->interrupts_served() != served;
}

void Session::play(bool on) {
  playing_ = on;
  if (!twin_) return;
  anchor_ = twin_->simulation().now();
  anchor_wall_ = Wall::now();
}

void Session::input(const Json& request) {
  // a program that goes is looked at no more, and the one that comes is
  std::unique_ptr<TraceFeed> before;
  if (request.at("do") == "program") before = std::move(trace_);
  const int robot = before ? before->robot() : 0;
  const auto signals = before ? before->asked() : std::vector<std::string>();
  const bool traced = before != nullptr;
  before.reset();
  inputs_->apply(request);
  if (traced) trace(robot, signals);
  if (recorder_) recorder_->note(twin_->simulation().now(), request);
}

/// What the file's new text asks of the run; "it needs a new one" where there is none that has begun.
LiveEdit Session::live_edit_now() const {
  if (!twin_ || twin_->simulation().now() == 0) return {"the run has not begun", {}, {}};
  return live_edit(live_text_, document_.text(), *document_.loaded().world);
}

/// The file's text is another: the world that lives becomes so, or begins anew.
void Session::document_changed(const LiveEdit& edit) {
  const sim::WorldText& text = document_.text();
  if (!document_.loaded().world) {
    // shown with its problems; what ran runs on
  } else if (edit.why_not.empty()) {
    std::vector<int> before;
    const std::vector<int> ids = movable_ids(*document_.loaded().world, text);
    for (int id : ids) {
      const auto was = std::find(movable_.begin(), movable_.end(), id);
      before.push_back(was == movable_.end() ? -1
                                             : twin_->robots() + static_cast<int>(was - movable_.begin()));
    }
    input({{"do", "world"}, {"text", text.text()}, {"before", before}});
    for (const Json& request : edit.inputs) input(request);
    for (const auto& [robot, name] : edit.firmware) choose_program(robot, name);
    movable_ = ids;
    live_text_ = text;
    resubscribe();
  } else {
    std::vector<std::string> problems;
    if (!reopen(problems)) tell_all({{"event", "problems"}, {"problems", problems}});
  }
  tell_world();
  tell_state();
}

void Session::tell_all(const Json& event) {
  const std::string text = event.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (const auto& [client, page] : pages_) outlet_.send(client, text);
}

void Session::tell_world() {
  ++revision_;
  Json world = world_json(document_.loaded(), document_.text());
  tell_all({{"event", "world"}, {"revision", revision_}, {"world", std::move(world)}});
  tell_all({{"event", "programs"}, {"programs", programs_json()}});
  for (auto& [client, page] : pages_) page.fresh = true;
}

Json Session::state_json() const {
  Json state{{"playing", playing_},
             {"speed", speed_},
             {"ended", ended_},
             {"time_s", twin_ ? sim::to_seconds(twin_->simulation().now()) : 0.0},
             {"seed", opening_.seed},
             {"saved", document_.is_saved()},
             {"undo", document_.can_undo()},
             {"redo", document_.can_redo()},
             {"steering", steering_},
             {"runs", twin_ != nullptr}};
  if (ended_) state["outcome"] = {{"code", team_->outcome().code}, {"text", team_->outcome().text}};
  return state;
}

void Session::send_serial() {
  constexpr std::size_t kMostUnread = 1 << 16;
  for (const auto& line : lines_) {
    if (line->text.empty()) continue;
    // what is said before there is a page waits for the first one
    if (pages_.empty()) {
      if (line->text.size() > kMostUnread) line->text.erase(0, line->text.size() - kMostUnread);
      continue;
    }
    const std::string some = line->text.substr(0, kLongestSerial);
    line->text.erase(0, some.size());
    tell_all(serial_event(*twin_, line->robot, line->port, some));
  }
}

void Session::send_frames(bool all) {
  if (!twin_ || pages_.empty()) return;
  const auto now = Wall::now();
  std::string bodies;
  for (auto& [client, page] : pages_) {
    const bool is_due = now - page.last_frame >= kFrameEvery;
    if (!(page.fresh || all || (playing_ && is_due))) continue;
    if (!outlet_.wants_frame(client)) {
      page.fresh = true;  // as soon as it can
      continue;
    }
    if (bodies.empty()) bodies = frame_bodies(*twin_);
    std::vector<double> values;
    for (const Named& named : page.values) values.push_back(named.value(*twin_));
    FrameHead head;
    head.revision = revision_;
    head.flags = (playing_ ? kRunning : 0u) | (ended_ ? kEnded : 0u);
    head.subscription = page.subscription;
    head.pace = pace_;
    outlet_.send_frame(client, frame(*twin_, head, values, bodies, frame_rays(*twin_, page.rays)));
    page.last_frame = now;
    page.fresh = false;
  }
}

void Session::trace(int robot, const std::vector<std::string>& signals) {
  trace_.reset();  // first: a robot has one observer
  trace_ = std::make_unique<TraceFeed>(*twin_, robot, signals);
  traced_ = -1;
}

void Session::send_trace() {
  if (!trace_ || traced_ == twin_->simulation().now() || Wall::now() < next_trace_) return;
  next_trace_ = Wall::now() + kTraceEvery;
  traced_ = twin_->simulation().now();
  tell_all(trace_->take(kMostTold));
}

/// To who looks at a robot, what is new there; and to who has just begun, all.
void Session::send_looks() {
  if (!twin_ || Wall::now() < next_look_) return;
  next_look_ = Wall::now() + kLookPause;
  std::map<int, Json> news;
  for (auto& [client, page] : pages_) {
    const int robot = page.looked_at.empty() ? -1 : twin_->find(page.looked_at);
    if (robot < 0) continue;
    auto& look = looks_[robot];
    if (!look) look = std::make_unique<RobotLook>(*twin_, robot);
    if (news.find(robot) == news.end()) news[robot] = look->take();
    Json event = news[robot];
    if (event.is_null() && page.look_is_fresh) event = look->last();
    if (event.is_null()) continue;
    outlet_.send(client, event.dump(-1, ' ', false, Json::error_handler_t::replace));
    page.look_is_fresh = false;
  }
  for (auto it = looks_.begin(); it != looks_.end();)
    it = news.find(it->first) == news.end() ? looks_.erase(it) : std::next(it);
}

/// After the world or a program was exchanged: names mean something else now, or nothing.
void Session::resubscribe() {
  for (auto& [client, page] : pages_) {
    page.rays.erase(
        std::remove_if(page.rays.begin(), page.rays.end(), [&](int r) { return r >= twin_->robots(); }),
        page.rays.end());
    page.values.clear();
    for (const std::string& name : page.names) {
      try {
        page.values.push_back(find_named(*twin_, name));
      } catch (const std::exception&) {
        page.values.push_back({"", [](twin::Twin&) { return std::numeric_limits<double>::quiet_NaN(); }});
      }
    }
    page.fresh = true;
  }
}

int Session::robot_named(const std::string& name) const {
  const int robot = twin_ ? twin_->find(name) : -1;
  if (robot < 0)
    throw std::runtime_error(fmt::format("robot: got '{}', expected a robot of the world", name));
  return robot;
}

}  // namespace viewer
