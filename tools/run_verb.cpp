// SPDX-License-Identifier: MIT
// twinpuck run WORLD: simulates, shows progress, writes what was asked for, tells what happened.
#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

#include "hal_sim/inputs/recording.h"
#include "hal_sim/runs/run.h"
#include "hal_sim/twin/world_file.h"
#include "outputs/diagnosis_lines.h"
#include "outputs/progress.h"
#include "outputs/run_files.h"
#include "outputs/serial_text.h"
#include "outputs/summary.h"
#include "outputs/terminal_screen.h"
#include "outputs/terminal_view.h"
#include "sim_core/light/profiles.h"
#include "sim_core/load/world_loader.h"
#include "tools/command_line.h"
#include "tools/output_options.h"
#include "tools/printable.h"
#include "tools/remote_keys.h"
#include "tools/run_guard.h"
#include "tools/verbs.h"

namespace tools {

namespace {

using Wall = std::chrono::steady_clock;
constexpr double kPictureEvery_s = 0.05;
constexpr double kLineEvery_s = 1;       // on a terminal that obeys nothing
constexpr double kLongestSleep_s = 0.1;  // with a look whether the end was asked for
constexpr double kReaderEvery_s = 0.1;   // of looks whether somebody reads what is said

struct RunArguments {
  std::string world;
  std::vector<std::string> firmware, uart1, uart2, keys, supervisors, externs, fault_files, faults;
  std::string replay;
  double seconds = 60;
  bool has_end = false;  // seconds were given
  std::string speed = "max";
  std::optional<std::uint64_t> seed;
  int threads = 1;
  double host_limit_s = 0;
  std::string optimisation, hal;
  bool sanitize = false, quiet = false, strict = false, live = false;
  outputs::OutputArguments outputs;
  outputs::ProfileArguments profile;
};

bool parse_speed(const std::string& text, double& factor) {
  if (text == "max") {
    factor = 0;
    return true;
  }
  char* end = nullptr;
  factor = std::strtod(text.c_str(), &end);
  if (end && *end == 0 && factor > 0 && factor <= 1e6) return true;
  complain({"command line: --speed: got '" + text + "', expected max or a factor above 0; 1 is real time"});
  return false;
}

/// Faults of files and of the command line; false, with what is wrong in `problems`.
bool add_faults(const RunArguments& arguments, faults::Injector& injector,
                std::vector<std::string>& problems) {
  std::vector<faults::Fault> all;
  for (const std::string& file : arguments.fault_files) {
    const faults::LoadedFaults loaded = faults::load_faults(file);
    if (!loaded.problems.empty()) problems.push_back(loaded.report(file));
    all.insert(all.end(), loaded.faults.begin(), loaded.faults.end());
  }
  for (const std::string& line : arguments.faults) {
    faults::Fault fault;
    std::string wrong;
    if (!faults::parse_fault_line(line, fault, wrong)) {
      problems.push_back("command line: --fault: " + wrong);
      continue;
    }
    fault.where = "command line: --fault";
    all.push_back(std::move(fault));
  }
  if (!problems.empty()) return false;
  try {
    injector.add(std::move(all));
  } catch (const std::runtime_error& e) {
    problems.push_back(e.what());
  }
  return problems.empty();
}

/// Who looks at a program for the whole run stays with that one: what a recording does must leave it in its robot.
void check_watched(const RunArguments& a, const inputs::Replay& replay, std::vector<std::string>& problems) {
  const auto& all = replay.inputs();
  const auto other =
      std::find_if(all.begin(), all.end(), [](const auto& input) { return input.at("do") == "program"; });
  if (other == all.end()) return;
  const auto& o = a.outputs;
  for (const auto& [is_asked, option] : {std::pair{!o.traces.vcd.empty(), "--vcd"},
                                         {!o.traces.timeline.empty(), "--trace"},
                                         {!o.report.empty(), "--report"},
                                         {a.profile.profile, "--profile"},
                                         {!a.profile.file.empty(), "--profile-json"},
                                         {!a.profile.budgets.empty(), "--budgets"}})
    if (is_asked)
      problems.push_back(
          fmt::format("{}: {}: got a recording in which a robot gets another program, at {:.3f} s, expected "
                      "one program a robot",
                      a.replay, option, sim::to_seconds(other->at("at").get<sim::Clicks>())));
}

/// What the options and the world read and write; false, with lines in `problems`, where one is the other.
bool check_files(const RunArguments& a, const inputs::Replay* replay, const sim::WorldDesc& world,
                 const twin::Options& options, std::vector<std::string>& problems) {
  sim::FileUses files;
  outputs::note_world(world, options, replay ? replay->opening.supervisors : a.supervisors, files);
  files.reads(a.replay, "--replay");
  if (replay)
    for (const auto& image : replay->opening.images) files.reads(image.file, "--replay");
  for (const std::string& file : a.fault_files) files.reads(file, "--faults");
  files.reads(a.profile.budgets, "--budgets");
  files.writes(a.profile.file, "--profile-json");
  outputs::note_outputs(a.outputs, world, files);
  files.check(problems);
  if (replay) check_watched(a, *replay, problems);
  return problems.empty();
}

/// One run of the command: opened, stepped to its end, closed.
class CommandRun {
 public:
  explicit CommandRun(const RunArguments& arguments) : a_(arguments) {}
  /// False: nothing runs, and people were told why.
  bool open();
  void loop();
  /// What there is to say and to write. Returns the exit code.
  int close();

 private:
  bool read_options();
  std::optional<sim::WorldDesc> read_world();
  void tell_other_ends();
  void begin();
  void step(sim::Clicks look);
  void show();
  void show_terminal();
  /// p and n, where stdin is a terminal; waits while the run is paused. The ticks to go on by.
  sim::Clicks obey_keys(sim::Clicks look);
  void keep_pace() const;
  /// Nobody reads what is said, nor will read the summary.
  bool has_no_reader();
  void say(const std::string& line);
  /// Faults without effect and keys that were not pressed, which make a run invalid.
  void tell_what_never_came();
  /// False: there were some.
  bool tell_diagnoses(const outputs::Summary& summary) const;
  int exit_code(int end_code, bool is_clean, bool kept_budgets) const;
  double wall_s() const { return std::chrono::duration<double>(Wall::now() - start_).count(); }
  /// Without the time that it was paused.
  double run_s() const { return wall_s() - paused_s_; }
  double now_s() const { return sim::to_seconds(run_->simulation().now()); }

  const RunArguments& a_;
  const Wall::time_point began_ = Wall::now();
  Wall::time_point start_ = began_;  // of the first tick
  std::vector<std::string> problems_;
  twin::Options options_;
  double speed_ = 0;  // 0: as fast as possible
  bool fits_the_chip_ = true;
  std::vector<std::pair<std::string, double>> presses_;  // of --key, and when (s)
  std::unique_ptr<inputs::Replay> replay_;
  std::unique_ptr<runs::Run> run_;
  std::unique_ptr<outputs::RunOutputs> outputs_;
  std::unique_ptr<outputs::ProfileOutputs> profile_;
  std::unique_ptr<outputs::Progress> progress_;
  std::unique_ptr<outputs::TerminalView> terminal_;
  std::unique_ptr<outputs::TerminalScreen> screen_;
  std::unique_ptr<outputs::SerialText> serial_;
  sim::Clicks end_ = 0;
  double next_picture_s_ = 0, next_reader_s_ = 0, took_s_ = 0, paused_s_ = 0;
  bool is_paused_ = false;
  // while programs run, the outputs are whole up to the last tick
  std::atomic<bool> is_stepping_{false};
  std::unique_ptr<GracefulEnd> guard_;  // looks at outputs from a thread of its own
};

// --- opening

bool CommandRun::read_options() {
  options_.threads = a_.threads;
  options_.optimisation = a_.optimisation;
  options_.hal = a_.hal;
  options_.externs = a_.externs;
  options_.sanitize = a_.sanitize;
  options_.coverage = a_.outputs.coverage;
  options_.tell = [](const std::string& line) { std::cerr << line << '\n'; };
  options_.no_room = [this] { fits_the_chip_ = false; };
  if (!parse_speed(a_.speed, speed_) || !split_choices(a_.firmware, "--fw", options_.firmware) ||
      !split_choices(a_.uart1, "--uart", options_.uart1) ||
      !split_choices(a_.uart2, "--uart2", options_.uart2))
    return false;
  if (a_.live && !::isatty(STDOUT_FILENO))
    problems_.push_back("command line: --live: got no terminal on stdout, expected one");
  return problems_.empty();
}

/// The world, with what the command line says of it; none: lines in problems_.
std::optional<sim::WorldDesc> CommandRun::read_world() {
  if (!a_.replay.empty()) {
    replay_ = inputs::Replay::open(a_.replay, problems_);
    if (replay_) replay_->resume(options_);
    if (replay_ && replay_->end() >= 0 && a_.has_end)
      problems_.push_back(
          "command line: --for: got one besides --replay, expected the recording alone, which says it");
    if (replay_ && replay_->end() < 0) complain({replay_->cut_off(a_.replay)});
  }
  const std::string file = replay_ || !problems_.empty() ? "" : find_world(a_.world, problems_);
  if (!problems_.empty()) return {};
  sim::LoadedWorld loaded =
      replay_ ? twin::parse_world(replay_->opening.text, replay_->opening.file) : twin::load_world(file);
  if (!loaded.world) {
    problems_.push_back(loaded.report(replay_ ? a_.replay : file));
    return {};
  }
  if (replay_) loaded.world->seed = replay_->opening.seed;
  if (a_.seed) loaded.world->seed = *a_.seed;
  std::vector<twin::Choice> keys;
  if (!split_choices(a_.keys, "--key", keys)) return {};
  for (const auto& key : keys) {
    double at_s = 0;
    if (const std::string wrong = add_key(key.robot, key.value, loaded.world->robots, at_s); !wrong.empty()) {
      problems_.push_back("command line: --key: " + wrong);
      return {};
    }
    presses_.emplace_back(key.value, at_s);
  }
  return std::move(loaded.world);
}

bool CommandRun::open() {
  limit_host_time(a_.host_limit_s);
  const auto opens = [this] {
    if (!read_options()) return false;
    auto world = read_world();
    if (!world || !check_files(a_, replay_.get(), *world, options_, problems_)) return false;
    if (!a_.quiet) {
      for (const std::string& notice : sim::proximity_notices(*world)) std::cerr << notice << '\n';
      for (const sim::WorldProblem& p : sim::place_notices(*world))
        std::cerr << world->file << ':' << p.line << ':' << p.column << ": " << p.text << '\n';
    }
    run_ = runs::Run::open(std::move(*world), options_,
                           replay_ ? replay_->opening.supervisors : a_.supervisors, problems_);
    if (!run_ || !add_faults(a_, run_->inputs().faults(), problems_)) return false;
    run_->team().should_give_up = [] { return end_asked() != 0; };
    if (!a_.quiet) std::cout << outputs::programs_text(run_->twin()) << std::flush;
    outputs_ = std::make_unique<outputs::RunOutputs>(a_.outputs, *run_);
    profile_ = std::make_unique<outputs::ProfileOutputs>(a_.profile, run_->twin());
    return profile_->open(problems_) && outputs_->open(problems_);
  };
  if (!opens()) {
    complain(problems_);
    return false;
  }
  tell_other_ends();
  return true;
}

/// Where UARTs can be reached from outside.
void CommandRun::tell_other_ends() {
  twin::Twin& twin = run_->twin();
  for (int i = 0; i < twin.robots(); ++i)
    for (int port = 1; port <= 2; ++port)
      if (const auto* end = twin.mind(i).board().uart(port).end(); end && !end->name().empty())
        std::cerr << twin.world().robots[static_cast<std::size_t>(i)].name << " uart" << port << ": "
                  << end->name() << '\n';
}

// --- running

void CommandRun::say(const std::string& line) {
  if (screen_ && screen_->is_dumb()) return screen_->line(line);
  if (screen_) return terminal_->say(line);
  progress_->clear();
  std::cout << line << '\n';
}

/// Up to the first tick: screen, consoles, programs of the PC, serial lines.
void CommandRun::begin() {
  twin::Twin& twin = run_->twin();
  guard_ = std::make_unique<GracefulEnd>([this] {
    if (a_.live) outputs::TerminalScreen::give_back();
    if (is_stepping_) outputs_->rescue();
  });
  end_ = replay_ && replay_->end() >= 0 ? replay_->end() : sim::from_seconds(a_.seconds);
  progress_ = std::make_unique<outputs::Progress>(a_.seconds, a_.quiet || a_.live);
  if (a_.live) {
    const auto kind = outputs::TerminalKind::of_environment();
    terminal_ = std::make_unique<outputs::TerminalView>(twin, kind.colours, outputs::TerminalScreen::size());
    screen_ = std::make_unique<outputs::TerminalScreen>(kind);
  }
  start_ = Wall::now();
  for (int i = 0; i < twin.robots() && !a_.quiet; ++i) {
    const std::string name = twin.world().robots[static_cast<std::size_t>(i)].name;
    auto& console = twin.mind(i).board().virtual_devices().on_console;
    console = [name, this, before = console](const std::string& line) {
      if (before) before(line);
      say(name + ": " + line);
    };
  }
  is_stepping_ = true;
  run_->team().before_first_tick();
  is_stepping_ = false;
  outputs_->before_run();
  serial_ = std::make_unique<outputs::SerialText>([this](const std::string& line) { say(line); });
  for (int i = 0; i < twin.robots(); ++i)
    for (int port = 1; port <= 2; ++port) {
      // a quiet run shows only what was asked for by name
      const auto& asked = port == 1 ? options_.uart1 : options_.uart2;
      const bool by_option =
          std::any_of(asked.begin(), asked.end(), [](const auto& c) { return c.value == "-"; });
      if (twin.uart_choice(i, port) == "-" && (by_option || !a_.quiet)) serial_->listen(twin, i, port);
    }
}

void CommandRun::loop() {
  begin();
  // where nothing is due ticks are passed over, but text and ^C are looked for in between; somebody who looks
  // on sees more of it
  const bool is_seen = a_.live || speed_ > 0 || !run_->team().is_empty();
  const sim::Clicks look = outputs_->wants_ticks() ? 0 : sim::kClicksPerSecond / (is_seen ? 64 : 4);
  while (run_->simulation().now() < end_ && !run_->team().has_ended()) {
    const sim::Clicks by = screen_ ? obey_keys(look) : look;
    if (end_asked()) break;
    step(by);
    if (end_asked() || outputs_->failed() || has_no_reader()) break;
    show();
    if (speed_ > 0) keep_pace();
  }
  if (replay_ && !end_asked()) replay_->finish(run_->inputs(), run_->simulation(), problems_);
  took_s_ = wall_s();
}

void CommandRun::step(sim::Clicks look) {
  const sim::Clicks now = run_->simulation().now();
  is_stepping_ = true;
  if (replay_) replay_->apply_due(run_->inputs(), now);
  run_->inputs().faults().advance(std::min({end_, now + look, replay_ ? replay_->next() : sim::kEver}));
  is_stepping_ = false;
  outputs_->after_tick();
  serial_->show();
}

void CommandRun::show() {
  if (screen_ && wall_s() >= next_picture_s_) show_terminal();
  if (progress_->is_due()) progress_->show(now_s());
}

void CommandRun::show_terminal() {
  const double pace = now_s() / std::max(run_s(), 1e-3);
  if (screen_->is_dumb()) {
    screen_->line(terminal_->line(pace));
    next_picture_s_ = wall_s() + kLineEvery_s;
    return;
  }
  const outputs::TerminalSize size = outputs::TerminalScreen::size();
  if (!(size == terminal_->size())) terminal_->resize(size);
  const char* const keys = is_paused_ ? "PAUSED: p go on, n next tick" : "p pause, n next tick";
  screen_->show(terminal_->picture(pace, screen_->has_keys() ? keys : ""));
  next_picture_s_ = wall_s() + kPictureEvery_s;
}

sim::Clicks CommandRun::obey_keys(sim::Clicks look) {
  const double before_s = run_s();
  sim::Clicks by = look;
  for (bool is_told = false; !end_asked();) {
    const char key = screen_->key();
    if (key == 'p' || key == 'P') is_paused_ = !is_paused_;
    if (key == 'n' || key == 'N') {
      is_paused_ = true;
      by = 0;  // one tick
      next_picture_s_ = 0;
      break;
    }
    if (!is_paused_) break;
    if (key != 0) continue;
    paused_s_ += run_s() - before_s;
    // a line on a dumb terminal is said once
    if (!is_told || (!screen_->is_dumb() && wall_s() >= next_picture_s_)) show_terminal();
    is_told = true;
    std::this_thread::sleep_for(std::chrono::duration<double>(kPictureEvery_s / 2));
  }
  paused_s_ += run_s() - before_s;
  return by;
}

void CommandRun::keep_pace() const {
  const double due_s = now_s() / speed_;
  for (double ahead_s; (ahead_s = due_s - run_s()) > 0 && !end_asked() && !is_paused_;)
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(ahead_s, kLongestSleep_s)));
}

bool CommandRun::has_no_reader() {
  if (a_.quiet || wall_s() < next_reader_s_) return false;
  next_reader_s_ = wall_s() + kReaderEvery_s;
  if (!is_stdout_lost()) return false;
  problems_.push_back(
      fmt::format("standard output: cannot be written any more; the run ended at {:.3f} s", now_s()));
  return true;
}

// --- closing

int CommandRun::close() {
  twin::Twin& twin = run_->twin();
  programs::Team& team = run_->team();
  screen_.reset();
  progress_->finish();
  twin.flush_console();
  is_stepping_ = true;
  team.finish();
  is_stepping_ = false;
  guard_->finishing();
  const int end_code = end_asked();
  if (team.has_ended() && !(a_.quiet && team.outcome().code == 0)) complain({team.outcome().text});
  for (int i = 0; i < twin.robots(); ++i) twin.mind(i).board().exchange(twin.mind(i).now());

  // what the run came to, for people and in files
  serial_->finish();
  outputs::Summary summary = outputs::summarise(twin, took_s_);
  summary.faults = run_->inputs().faults().statuses();
  outputs_->finish(summary, problems_);
  profile_->write(problems_);
  complain(problems_);
  if (!a_.quiet) {
    std::vector<std::string> written = outputs_->written();
    if (!a_.profile.file.empty()) written.push_back(a_.profile.file);
    written = outputs::without_lost(std::move(written), problems_);
    std::cout << to_text(summary);
    if (!written.empty()) std::cout << fmt::format("written: {}\n", fmt::join(written, ", "));
  }
  // a run that was cut off says nothing of what was still to come
  if (end_code == 0) tell_what_never_came();
  const bool kept_budgets = profile_->tell();
  for (const auto& t : summary.traps) std::cerr << outputs::to_text(t);
  const bool is_clean = tell_diagnoses(summary);
  if (end_code == kHostTime)
    complain({fmt::format(
        "twinpuck: host time: got {:.3f} s, expected at most {:g} s; outputs hold what was simulated",
        std::chrono::duration<double>(Wall::now() - began_).count(), a_.host_limit_s)});
  return exit_code(end_code, is_clean, kept_budgets);
}

void CommandRun::tell_what_never_came() {
  std::vector<std::string> lines = run_->inputs().faults().problems();
  for (const auto& [press, at_s] : presses_)
    if (at_s >= now_s())
      lines.push_back(
          fmt::format("command line: --key: {}: never began: the run ended before {:g} s", press, at_s));
  complain(lines);
  problems_.insert(problems_.end(), lines.begin(), lines.end());
}

bool CommandRun::tell_diagnoses(const outputs::Summary& summary) const {
  outputs::DiagnosisLines lines;
  bool is_clean = true;
  const auto tell = [this](const std::vector<std::string>& all) {
    for (const std::string& line : all)
      if (!a_.quiet || a_.strict) std::cerr << line << '\n';
  };
  for (const auto& r : summary.robots) {
    is_clean = is_clean && r.diagnoses.empty();
    tell(lines.of(r.name, r.diagnoses));
  }
  tell(lines.left_out());
  return is_clean;
}

int CommandRun::exit_code(int end_code, bool is_clean, bool kept_budgets) const {
  const programs::Outcome& outcome = run_->team().outcome();
  if (end_code == kHostTime || end_code == kInterrupted) return end_code;
  if (!problems_.empty() || outputs_->failed()) return kInvalidRun;
  if (outcome.crashed) return kTrapped;
  if (outcome.code != 0) return kTestFailed;
  if (!run_->twin().traps().empty()) return kTrapped;
  if (!kept_budgets) return kTestFailed;
  return a_.strict && !(is_clean && fits_the_chip_) ? kTestFailed : kPass;
}

int run(const RunArguments& arguments) {
  CommandRun run(arguments);
  if (!run.open()) return kBadInput;
  run.loop();
  return run.close();
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("run", "Simulate a world");
  auto a = std::make_shared<RunArguments>();
  auto* world = verb->add_option("WORLD", a->world, "world file, or the name of one in worlds/");
  verb->option_defaults()->group("Robots");
  add_firmware(*verb, a->firmware);
  add_hal(*verb, a->hal);
  one_each(verb->add_option(
      "--uart", a->uart1,
      "[ROBOT=]-|none|pty|pty:LINK|tcp:PORT|file:PATH: the other end of UART 1; - shows text "
      "here, as a run does unless told otherwise"));
  one_each(verb->add_option("--uart2", a->uart2, "the same for UART 2"));
  one_each(verb->add_option(
      "--key", a->keys,
      "[ROBOT=]KEY@TIME[+HOLD]: a remote control's key, 0 to 63 or a name such as VOL_UP, "
      "pressed at TIME s for HOLD s (0.1); ADDRESS:KEY for another address than 0; keyboard:UP or "
      "keyboard:W for a keyboard's, which programs for Webots ask for"));
  one_each(
      verb->add_option("--supervisor", a->supervisors,
                       "[NAME=]PROGRAM: a supervisor's program, a file or a folder; takes the place of the "
                       "world's supervisor of that NAME, without NAME of its only one, or is added"));
  one_each(verb->add_option("--extern", a->externs,
                            "a robot whose program is started outside and connects; * for all"));
  verb->option_defaults()->group("Time and chance");
  verb->add_option("--for", a->seconds, "simulated seconds")->check(between(0, 1e7))->capture_default_str();
  auto* speed = verb->add_option("--speed", a->speed, "pace: 1 is real time, max as fast as possible")
                    ->capture_default_str();
  add_seed_and_threads(*verb, a->seed, a->threads);
  verb->add_option("--host-limit", a->host_limit_s,
                   "give up after this many real seconds (exit 124); 0: never")
      ->check(between(0, 1e7));
  auto* replay =
      verb->add_option("--replay", a->replay,
                       "do again what a page did, from view --record-inputs; the world is the recording's")
          ->check(named());
  verb->option_defaults()->group("Faults");
  one_each(
      verb->add_option("--faults", a->fault_files,
                       "a file of faults and stimuli (docs/testing.md); the run is invalid, exit 7, when one "
                       "never takes effect"));
  one_each(verb->add_option("--fault", a->faults,
                            "one of them: \"KIND [PARAMETER=VALUE]... [robot=NAME] [at=TIME] [for=TIME] "
                            "[when=CONDITION]\", with times such as 2s and 500ms; twinpuck list faults"));
  verb->option_defaults()->group("Checks");
  verb->add_flag(
      "--strict", a->strict,
      "exit code 1 when board or chip have anything to say about a program (docs/controllers.md), or "
      "its data and stack do not fit the chip");
  verb->add_flag("--sanitize", a->sanitize,
                 "check every access of memory and 16-bit overflow in controllers built from source");
  verb->add_option(
          "--opt", a->optimisation,
          "level for controllers built from source; without it, that of a program's project file, else -O1")
      ->check(CLI::IsMember({"-O0", "-O1", "-O2", "-Os"}));
  verb->add_flag(
      "--live", a->live,
      "show arena, robots, LEDs and serial text in this terminal, in real time unless --speed says "
      "otherwise; keys: p pauses, n is the next tick");
  verb->add_flag("-q,--quiet", a->quiet, "no progress, no serial text and no summary on the terminal");
  add_profile_options(*verb, a->profile);
  add_output_options(*verb, a->outputs);
  verb->footer(
      "Example: twinpuck run maze --fw obstacle --for 60 --record maze.csv --picture maze.png\n"
      "Exit codes: 0 good, 1 --strict, --budgets or a supervisor found a fault, 2 bad input, 3 firmware "
      "trapped, "
      "7 an output was lost or a fault never took effect, 124 --host-limit, 130 interrupted");
  verb->callback([a, verb, world, replay, speed, &exit_code] {
    if (a->live && speed->count() == 0) a->speed = "1";
    a->has_end = verb->get_option("--for")->count() > 0;
    std::vector<std::string> problems;
    want_one_world(*verb, *world, *replay, a->world, problems);
    refuse_without_output(*verb, problems);
    complain(problems);
    exit_code = problems.empty() ? run(*a) : int{kBadInput};
  });
}

}  // namespace tools
