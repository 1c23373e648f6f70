// SPDX-License-Identifier: MIT
// The thread, runs and what everybody is told. What requests do is in session_requests.cpp.
#include "viewer/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "hal_sim/chip/chip_runner.h"
#include "sim_core/load/world_loader.h"
#include "viewer/events.h"

namespace viewer {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

constexpr auto kIdleLook = 15ms;  // between two looks at what stands
constexpr auto kSlice = 4ms;      // of stepping, between two looks at requests
constexpr auto kTraceEvery = 100ms;
constexpr auto kWatchEvery = 150ms;                // are files what they were?
constexpr auto kBuildLook = 5ms;                   // is it done?
constexpr std::size_t kMostTold = 4000;            // spans, and changes, of one event
constexpr std::size_t kLongestSerial = 64u << 10;  // bytes of a line sent at once
constexpr std::size_t kMostUnread = 64u << 10;     // bytes of a line that wait for the first page
constexpr double kLongestInterruptWait_s = 10;

}  // namespace

Session::Session(inputs::Opening opening, std::string record, Outlet outlet)
    : opening_(std::move(opening)),
      record_file_(std::move(record)),
      home_(fs::path(opening_.file).parent_path().string()),
      document_(opening_.file, opening_.text),
      pages_(std::move(outlet)),
      live_text_("") {}

Session::~Session() { stop(); }

bool Session::open(std::vector<std::string>& problems) {
  const bool runs = reopen(problems);
  remember_told();
  return runs;
}

void Session::start() {
  thread_ = std::thread([this] { live(); });
}

std::string Session::stop() {
  mail_.end();
  if (thread_.joinable()) thread_.join();
  programs_.forget();
  close_run();
  return recording_told_;
}

// --- the thread

void Session::live() {
  while (!mail_.is_ending()) {
    const bool changed = take_messages();
    if (debugging_) {
      if (debugging_->runs()) {
        debugging_->run_on();
        if (!debugging_->runs()) stand_still();
      }
      if (run_) after_ticks();
    } else if (run_ && pace_.plays() && !ended_) {
      advance_slice();
    }
    if (run_) pace_.measure(now());
    look_around();
    show(changed);
    if (!run_ || !plays() || ended_) mail_.wait(kIdleLook);
  }
}

bool Session::take_messages() {
  if (!mail_.has_news()) return false;
  const auto messages = mail_.take();
  for (const Mailbox::Message& message : messages) handle(message);
  return !messages.empty();
}

/// What may have changed by itself.
void Session::look_around() {
  if (Wall::now() < next_watch_) return;
  next_watch_ = Wall::now() + kWatchEvery;
  if (Json diagnoses = run_ ? diagnoses_json(run_->twin()) : Json::array(); diagnoses != diagnoses_told_) {
    diagnoses_told_ = std::move(diagnoses);
    pages_.tell_all({{"event", "diagnoses"}, {"diagnoses", diagnoses_told_}});
  }
  watch_files();
  watch_programs();
  watch_recording();
  // a build that is under way is looked for more often
  if (programs_.is_building()) next_watch_ = Wall::now() + kBuildLook;
}

void Session::show(bool all) {
  send_serial();
  if (!run_ || pages_.is_empty()) return;
  FrameHead head;
  head.revision = revision_;
  head.flags = (plays() ? kRunning : 0u) | (ended_ ? kEnded : 0u);
  head.pace = pace_.measured();
  pages_.send_frames(run_->twin(), head, plays(), all);
  send_trace();
  pages_.send_looks(run_->twin());
}

// --- runs

void Session::close_run() {
  if (debugging_) debugging_->halt();
  pages_.let_go();
  run_.reset();
  debugging_.reset();
  held_.clear();
}

/// A new run from time 0, of the document as it is.
bool Session::reopen(std::vector<std::string>& problems) {
  close_run();  // first: programs lie in memory where they lay in the run before
  ended_ = is_replayed_ = false;
  traps_told_.clear();
  if (!open_run(replay_ ? replay_->inputs() : std::vector<Json>(), false, problems)) {
    tell_problems(problems);
    return false;
  }
  run_->begin(
      [this](const std::string& line) {
        pages_.tell_all({{"event", "says"}, {"text", line}});
      },
      [this] { return mail_.is_ending(); });
  if (!record_file_.empty()) run_->record(record_file_, opening_);
  take_up_run();
  tell_problems({});
  return true;
}

/// Of the document as it is. One that is repeated begins with the images that it began with.
bool Session::open_run(std::vector<Json> script, bool is_repeated, std::vector<std::string>& problems) {
  const sim::LoadedWorld& loaded = document_.loaded();
  if (!loaded.world) {
    problems.push_back(loaded.report(document_.file()));
    return false;
  }
  sim::WorldDesc world = *loaded.world;
  // The run opens what the document says now, with the options that the user gave.
  opening_.file = document_.file();
  opening_.text = document_.text().text();
  world.seed = opening_.seed;
  twin::Options options = opening_.options;
  options.world_folder = world_folder();
  std::vector<std::string> told;
  options.tell = [&told](const std::string& line) { told.push_back(line); };
  // options that name robots are for those that are there
  const auto is_gone = [&](const twin::Choice& c) {
    for (const auto& r : world.robots)
      if (c.robot == "*" || c.robot == r.name) return false;
    return true;
  };
  if (was_open_)
    for (auto* choices : {&options.firmware, &options.uart1, &options.uart2})
      choices->erase(std::remove_if(choices->begin(), choices->end(), is_gone), choices->end());
  const std::vector<twin::Choice> chosen = options.firmware;
  if (is_repeated) options.firmware = first_images_;
  programs_.clear();
  // Each robot's program is known from here on, whether the run opens or not.
  auto run = std::make_unique<Run>(std::move(script), replay_ != nullptr);
  const bool opened = run->open(world, options, opening_.supervisors, problems);
  const bool is_as_chosen = opened && !is_repeated;
  for (int r = 0; r < static_cast<int>(world.robots.size()); ++r) {
    // a world that does not run has programs, too: one of them may be why
    std::string name = is_as_chosen ? run->twin().world().robots[static_cast<std::size_t>(r)].firmware
                                    : world.robots[static_cast<std::size_t>(r)].firmware;
    if (!is_as_chosen)
      for (const twin::Choice& c : chosen)
        if (c.robot == "*" || c.robot == world.robots[static_cast<std::size_t>(r)].name) name = c.value;
    if (!name.empty()) programs_.named(name, options.world_folder).robots.push_back(r);
  }
  programs_.take_opening(problems, told);
  if (!opened) return false;
  was_open_ = true;
  run_ = std::move(run);
  if (!is_repeated) keep_images();
  return true;
}

/// Of the run that begins.
void Session::keep_images() {
  const twin::Twin& twin = run_->twin();
  first_images_.clear();
  for (int r = 0; r < twin.robots(); ++r)
    if (!twin.image_path(r).empty() && !twin.launch(r))
      first_images_.push_back(
          {twin.world().robots[static_cast<std::size_t>(r)].name, images_.keep(twin.image_path(r))});
}

/// The run's twin is another one.
void Session::take_up_run() {
  live_text_ = document_.text();
  movable_ = movable_ids(run_->twin().world(), live_text_);
  pace_.begin(now());
  pages_.take_up(run_->twin());
}

void Session::begin_anew() {
  std::vector<std::string> problems;
  reopen(problems);
  tell_world();
  tell_state();
}

void Session::advance_slice() {
  const auto begin = Wall::now();
  // in between is looked for requests, and for what programs print
  const sim::Clicks look = sim::kClicksPerSecond / 64;
  while (!mail_.has_news() && !run_->has_ended() && Wall::now() - begin <= kSlice) {
    const sim::Clicks due = pace_.due(now());
    if (now() >= due) {
      mail_.wait(std::min<std::chrono::duration<double>>(std::chrono::duration<double>(pace_.wait_s(now())),
                                                         kSlice));
      break;
    }
    step_until(std::min(now() + look, due));
    if (!pace_.plays()) break;
  }
  after_ticks();
}

/// With what a recording did on the way; where it ends, the run stands still.
void Session::step_until(sim::Clicks end) {
  const sim::Clicks replayed = replay_ ? replay_->end() : -1;
  const auto end_replay = [&] {
    if (replayed < 0 || is_replayed_ || now() < replayed) return false;
    run_->do_due();
    is_replayed_ = true;
    stand_still();
    return true;
  };
  try {
    if (end_replay()) return;
    run_->advance(replayed > now() ? std::min(end, replayed) : end);
    end_replay();
  } catch (const std::exception& e) {
    tell_problems({std::string("replay: ") + e.what()});
    stand_still();
  }
}

/// By itself, not because somebody asked: everybody gets a last frame of it.
void Session::stand_still() {
  pace_.play(false, now());
  pages_.show_anew();
  tell_state();
}

bool Session::step_interrupt(int robot) {
  const host::Runner* program = run_->twin().mind(robot).runner();
  if (!program) return false;
  const auto served = program->interrupts_served();
  const sim::Clicks end = now() + sim::from_seconds(kLongestInterruptWait_s);
  while (program->interrupts_served() == served && now() < end && !run_->has_ended()) run_->step();
  return program->interrupts_served() != served;
}

/// What happened in the ticks that everybody should know.
void Session::after_ticks() {
  const twin::Twin& twin = run_->twin();
  std::vector<host::TrapReport> news;
  traps_told_.resize(static_cast<std::size_t>(twin.robots()));
  for (int r = 0; r < twin.robots(); ++r) {
    const host::Runner* const program = twin.mind(r).runner();
    if (!program) continue;
    std::size_t& told = traps_told_[static_cast<std::size_t>(r)];
    for (; told < program->traps().size(); ++told) news.push_back(program->traps()[told]);
  }
  std::stable_sort(news.begin(), news.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  for (const host::TrapReport& trap : news) pages_.tell_all(trap_event(trap));
  if (run_->has_ended() && !ended_) {
    ended_ = true;
    stand_still();
  }
}

void Session::input(const Json& request, const sim::WorldDesc* world) {
  if (debugging_)
    run_->input_later(request);
  else
    run_->input(request, world);
}

// --- debugging

/// The run goes on in the debugger's hands, which repeat it up to where it stands.
void Session::debug_robot(int robot) {
  twin::Twin& twin = run_->twin();
  if (!run_->is_alone())
    throw std::runtime_error(
        "robot: this world has programs of the PC, which cannot be repeated; debug it without them");
  if (!run_->is_kept())
    throw std::runtime_error("robot: too much was done to this run to repeat it (200 MB); restart it");
  const std::string name = twin.world().robots[static_cast<std::size_t>(robot)].name;
  auto* const runner = dynamic_cast<chip::ChipRunner*>(twin.mind(robot).runner());
  if (!runner)
    throw std::runtime_error("robot: got '" + name +
                             "', which runs no firmware, expected one with a program of the robot");
  const debug::Cycle from = twin.mind(robot).cycle_at(now());
  // The debugger opens the same world, with the same images.
  debug::Session::Setup setup;
  setup.world = twin.world();
  setup.options = opening_.options;
  setup.options.world_folder = world_folder();
  setup.options.firmware = first_images_;
  setup.robot = name;
  // A run like this one does again all that was done; pages see the debugger's twin.
  auto repeated = std::make_unique<Run>(run_->script(), replay_ != nullptr);
  Run* const run = repeated.get();
  setup.opened = [this, run](twin::Twin& opened) {
    run->attach(opened);
    pages_.take_up(opened);
  };
  setup.closes = [this, run] {
    pages_.let_go();
    run->detach();
  };
  setup.step = [run](twin::Twin&) { run->step(); };
  setup.ticked = [this] { debugger_ticked(); };
  setup.repeated = [run] { run->forget_said(); };
  // Only now the old run goes.
  pace_.play(false, now());
  close_run();
  std::vector<std::string> problems;
  run_ = std::move(repeated);
  debugging_ = Debugging::open(
      std::move(setup), from,
      [this](const std::string& event, const Json& body) {
        pages_.tell_all({{"event", "dap"}, {"name", event}, {"body", body}});
      },
      [this] { return mail_.has_news(); }, problems);
  if (!debugging_) {
    run_.reset();
    begin_anew();
    throw std::runtime_error(problems.empty() ? "the world cannot be opened again" : problems[0]);
  }
  run_->forget_said();
  take_up_run();
  tell_state();
}

/// The run goes on as a usual one, from where it stands.
void Session::debug_no_more() {
  const sim::Clicks stands = now();
  std::vector<Json> done = run_->script();
  const bool is_past_replay = is_replayed_;
  std::vector<Programs::Built> held = std::move(held_);
  close_run();
  std::vector<std::string> problems;
  if (open_run(std::move(done), true, problems)) {
    run_->begin([](const std::string&) {}, [this] { return mail_.is_ending(); });
    if (!record_file_.empty()) run_->record(record_file_, opening_);
    while (now() < stands && !mail_.is_ending()) run_->advance(stands);
    run_->forget_said();
    take_up_run();
    is_replayed_ = is_past_replay;
    for (Programs::Built& built : held) load_built(built);
  }
  tell_problems(problems);
  tell_programs();
  tell_state();
}

/// On the world's thread, while this one waits in run_on(): pages see it run, at the pace that was asked for.
void Session::debugger_ticked() {
  show(false);
  while (!mail_.has_news() && now() >= pace_.due(now())) {
    std::this_thread::sleep_for(1ms);
    show(false);
  }
}

// --- edits

std::string Session::world_folder() const { return fs::path(document_.file()).parent_path().string(); }

/// What the file's new text asks of the run; "it needs a new one" where there is none that has begun.
LiveEdit Session::live_edit_now() const {
  if (!run_ || now() == 0) return {"the run has not begun", {}, {}};
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
      before.push_back(
          was == movable_.end() ? -1 : run_->twin().robots() + static_cast<int>(was - movable_.begin()));
    }
    input({{"do", "world"}, {"text", text.text()}, {"before", before}}, &*document_.loaded().world);
    for (const Json& request : edit.inputs) input(request);
    for (const auto& [robot, name] : edit.firmware) choose_program(robot, name);
    movable_ = ids;
    live_text_ = text;
    pages_.take_up(run_->twin());
  } else {
    std::vector<std::string> problems;
    reopen(problems);
  }
  tell_world();
  tell_state();
}

/// A robot of the run gets another program, as soon as that is built.
void Session::choose_program(int robot, const std::string& name) {
  opening_.options.firmware.push_back(
      {run_->twin().world().robots[static_cast<std::size_t>(robot)].name, name});
  programs_.named(name, world_folder()).waiting.push_back(robot);
  next_watch_ = {};
}

// --- files and programs

void Session::watch_files() {
  if (const auto base = document_.disk_change())
    pages_.tell_all({{"event", "disk"},
                     {"file", fs::path(document_.file()).filename().string()},
                     {"base", base->empty() ? Json() : Json(*base)}});
  const auto changes = programs_.look();
  for (const Programs::Change& change : changes)
    pages_.tell_all({{"event", "disk"},
                     {"program", change.program},
                     {"file", change.file},
                     {"base", change.base.empty() ? Json() : Json(change.base)}});
  // a world that could not run for its program is tried again with another one
  if (!changes.empty() && !run_ && document_.loaded().world) begin_anew();
}

void Session::watch_programs() {
  if (auto built = programs_.take_built()) {
    if (debugging_)
      held_.push_back(std::move(*built));
    else
      load_built(*built);
  }
  Programs::Program* const program = run_ ? programs_.next_to_build() : nullptr;
  if (!program) return;
  pages_.tell_all({{"event", "building"}, {"program", program->name}});
  twin::Options options = opening_.options;
  options.world_folder = world_folder();
  const int robot = program->robots.empty() ? program->waiting.front() : program->robots.front();
  // with the HAL that it runs with
  if (options.hal.empty() && run_->twin().hal(robot) != "own") options.hal = run_->twin().hal(robot);
  options.webots_settings = twin::webots_settings_of(run_->twin().world());
  programs_.build(*program, options);
}

/// The new program begins where its robots stand; one that does not compile leaves the old one running.
void Session::load_built(Programs::Built& built) {
  Programs::Program* const program = programs_.find(built.name);
  if (built.problems.empty() && program && run_) {
    try {
      if (!built.robots.empty())
        input({{"do", "program"}, {"robots", built.robots}, {"image", images_.keep(built.path)}});
      for (const int robot : built.robots) {
        if (static_cast<std::size_t>(robot) < traps_told_.size())
          traps_told_[static_cast<std::size_t>(robot)] = 0;
        if (std::find(program->robots.begin(), program->robots.end(), robot) == program->robots.end())
          programs_.shift_robot(robot, *program);
      }
    } catch (const std::exception& e) {
      built.problems.push_back(e.what());
      program->problems = built.problems;
    }
    pages_.take_up(run_->twin());
  }
  tell_programs();
  pages_.tell_all({{"event", "built"},
                   {"program", built.name},
                   {"ok", built.problems.empty()},
                   {"problems", built.problems},
                   {"warnings", built.warnings},
                   {"took_s", built.took_s}});
}

/// A recording that is not whole is said at once, not at the end.
void Session::watch_recording() {
  const std::string wrong = run_ ? run_->recording_error() : std::string();
  if (wrong.empty() || wrong == recording_told_) return;
  recording_told_ = wrong;
  if (on_recording_error) on_recording_error(wrong);
  tell_state();
}

// --- what is told

void Session::tell_world() {
  ++revision_;
  const sim::LoadedWorld& loaded = document_.loaded();
  if (const auto changes = world_changes(told_, loaded, document_.text(), document_.base(),
                                         run_ ? &run_->twin() : nullptr, movable_))
    pages_.tell_all({{"event", "world_changed"}, {"revision", revision_}, {"changes", *changes}});
  else
    pages_.tell_all({{"event", "world"}, {"revision", revision_}, {"world", world_json_now()}});
  remember_told();
  tell_programs();
  pages_.show_anew();
}

void Session::remember_told() {
  told_ = {document_.text(), movable_, run_ != nullptr, document_.loaded().world.has_value()};
}

Json Session::world_json_now() const {
  return world_json(document_.loaded(), document_.text(), document_.base(), run_ ? &run_->twin() : nullptr,
                    movable_);
}

/// Those that were told; one that comes later is an event.
Json Session::traps_json() const {
  Json out = Json::array();
  for (std::size_t r = 0; r < traps_told_.size(); ++r)
    if (const host::Runner* const program = run_->twin().mind(static_cast<int>(r)).runner())
      for (std::size_t i = 0; i < std::min(traps_told_[r], program->traps().size()); ++i)
        out.push_back(trap_event(program->traps()[i]));
  return out;
}

void Session::tell_programs() {
  pages_.tell_all({{"event", "programs"}, {"programs", programs_.json(run_ ? &run_->twin() : nullptr)}});
}

void Session::tell_problems(std::vector<std::string> problems) {
  if (problems == problems_) return;
  problems_ = std::move(problems);
  pages_.tell_all({{"event", "problems"}, {"problems", problems_}});
}

Json Session::state_json() const {
  Json state{{"playing", plays()},
             {"speed", pace_.speed()},
             {"ended", ended_},
             {"time_s", sim::to_seconds(now())},
             {"seed", opening_.seed},
             {"saved", document_.is_saved()},
             {"undo", document_.can_undo()},
             {"redo", document_.can_redo()},
             {"steering", steering_},
             {"debugging", debugging_ ? debugging_->robot() : ""},
             {"runs", run_ != nullptr}};
  if (ended_) state["outcome"] = {{"code", run_->outcome().code}, {"text", run_->outcome().text}};
  if (!record_file_.empty()) state["recording"] = {{"file", record_file_}, {"error", recording_told_}};
  return state;
}

void Session::send_serial() {
  if (!run_) return;
  for (const auto& line : run_->lines()) {
    if (line->text.empty()) continue;
    // what is said before there is a page waits for the first one
    if (pages_.is_empty()) {
      if (line->text.size() > kMostUnread) line->text.erase(0, line->text.size() - kMostUnread);
      continue;
    }
    const std::string some = line->text.substr(0, kLongestSerial);
    line->text.erase(0, some.size());
    pages_.tell_all(serial_event(run_->twin(), line->robot, line->port, some));
  }
}

void Session::send_trace() {
  if (Wall::now() < next_trace_) return;
  next_trace_ = Wall::now() + kTraceEvery;
  if (const Json event = run_->take_trace(kMostTold); !event.is_null()) pages_.tell_all(event);
}

int Session::robot_named(const std::string& name) const {
  const int robot = run_ ? run_->twin().find(name) : -1;
  if (robot < 0)
    throw std::runtime_error(fmt::format("robot: got '{}', expected a robot of the world", name));
  return robot;
}

}  // namespace viewer
