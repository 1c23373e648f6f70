// SPDX-License-Identifier: MIT
// twinpuck run WORLD: simulates, shows progress, writes what was asked for, tells what happened.
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <thread>

#include "hal_sim/faults/injector.h"
#include "hal_sim/inputs/recording.h"
#include "hal_sim/twin/twin.h"
#include "hal_sim/twin/world_file.h"
#include "programs/team/team.h"
#include "sim_core/light/profiles.h"
#include "sim_core/load/world_loader.h"
#include "tools/command_line.h"
#include "tools/profile_outputs.h"
#include "tools/progress.h"
#include "tools/remote_keys.h"
#include "tools/run_guard.h"
#include "tools/run_outputs.h"
#include "tools/serial_text.h"
#include "tools/summary.h"
#include "tools/terminal_view.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;
using Wall = std::chrono::steady_clock;
constexpr double kPictureEvery_s = 0.05;
constexpr double kLongestSleep_s = 0.1;  // with a look whether the end was asked for

struct RunArguments {
  std::string world;
  std::vector<std::string> firmware, uart1, uart2, keys, supervisors, externs, fault_files, faults;
  std::string replay;
  double seconds = 60;
  std::string speed = "max";
  long long seed = -1;
  int threads = 1;
  double host_limit_s = 0;
  std::string optimisation, hal;
  bool sanitize = false, quiet = false, strict = false, live = false;
  OutputArguments outputs;
  ProfileArguments profile;
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
  for (faults::Fault& fault : all) {
    const std::string where = fault.where;
    try {
      injector.add(std::move(fault));
    } catch (const std::runtime_error& e) {
      problems.push_back(where + ": " + e.what());
    }
  }
  return problems.empty();
}

int run(const RunArguments& arguments) {
  const auto began = Wall::now();
  limit_host_time(arguments.host_limit_s);
  double speed;
  twin::Options options;
  options.threads = arguments.threads;
  options.optimisation = arguments.optimisation;
  options.hal = arguments.hal;
  options.externs = arguments.externs;
  options.sanitize = arguments.sanitize;
  options.coverage = arguments.outputs.coverage;
  options.tell = [](const std::string& line) { std::cerr << line << '\n'; };
  bool fits_the_chip = true;
  options.no_room = [&fits_the_chip] { fits_the_chip = false; };
  if (!parse_speed(arguments.speed, speed) || !split_choices(arguments.firmware, "--fw", options.firmware) ||
      !split_choices(arguments.uart1, "--uart", options.uart1) ||
      !split_choices(arguments.uart2, "--uart2", options.uart2))
    return kBadInput;

  if (arguments.live && !::isatty(STDOUT_FILENO)) {
    complain({"command line: --live: got no terminal, expected one of 80 by 24 characters on stdout"});
    return kBadInput;
  }
  std::vector<std::string> problems;
  std::unique_ptr<inputs::Replay> replay;
  if (!arguments.replay.empty()) {
    replay = inputs::Replay::open(arguments.replay, problems);
    if (replay) replay->resume(options);
  }
  const std::string file = replay || !problems.empty() ? "" : find_world(arguments.world, problems);
  if (!problems.empty()) {
    complain(problems);
    return kBadInput;
  }
  sim::LoadedWorld loaded =
      replay ? twin::parse_world(replay->opening.text, replay->opening.file) : twin::load_world(file);
  if (!loaded.world) {
    complain({loaded.report(replay ? arguments.replay : file)});
    return kBadInput;
  }
  if (replay) loaded.world->seed = replay->opening.seed;
  if (arguments.seed >= 0) loaded.world->seed = static_cast<std::uint64_t>(arguments.seed);
  std::vector<twin::Choice> keys;
  if (!split_choices(arguments.keys, "--key", keys)) return kBadInput;
  for (const auto& key : keys) {
    const std::string wrong = add_key(key.robot, key.value, loaded.world->robots);
    if (wrong.empty()) continue;
    complain({"command line: --key: " + wrong});
    return kBadInput;
  }
  if (!arguments.quiet)
    for (const std::string& notice : sim::proximity_notices(*loaded.world)) std::cerr << notice << '\n';
  options.world_folder = fs::path(loaded.world->file).parent_path().string();
  auto twin = twin::Twin::open(std::move(*loaded.world), options, problems);
  if (!twin) {
    complain(problems);
    return kBadInput;
  }
  auto team = programs::Team::open(*twin, options,
                                   replay ? replay->opening.supervisors : arguments.supervisors, problems);
  if (!team) {
    complain(problems);
    return kBadInput;
  }
  inputs::Inputs inputs(*twin);
  if (!add_faults(arguments, inputs.faults(), problems)) {
    complain(problems);
    return kBadInput;
  }
  team->should_give_up = [] { return end_asked() != 0; };
  if (!arguments.quiet) std::cout << programs_text(*twin) << std::flush;
  RunOutputs outputs(arguments.outputs, *twin, team.get());
  ProfileOutputs profile(arguments.profile, *twin);
  if (!outputs.open(problems) || !profile.open(problems)) {
    complain(problems);
    return kBadInput;
  }
  for (int i = 0; i < twin->robots(); ++i)
    for (int port = 1; port <= 2; ++port)
      if (const auto* end = twin->mind(i).board().uart(port).end(); end && !end->name().empty())
        std::cerr << twin->world().robots[static_cast<std::size_t>(i)].name << " uart" << port << ": "
                  << end->name() << '\n';

  // the run
  // while programs run, the outputs are whole up to the last tick
  std::atomic<bool> is_stepping{false};
  GracefulEnd guard([&] {
    if (arguments.live) TerminalScreen::give_back();
    if (is_stepping) outputs.rescue();
  });
  auto& simulation = twin->simulation();
  const sim::Clicks end = replay && replay->end() >= 0 ? replay->end() : sim::from_seconds(arguments.seconds);
  Progress progress(arguments.seconds, arguments.quiet || arguments.live);
  std::unique_ptr<TerminalView> terminal;
  std::unique_ptr<TerminalScreen> screen;
  if (arguments.live) {
    terminal = std::make_unique<TerminalView>(*twin);
    screen = std::make_unique<TerminalScreen>();
  }
  double next_picture_s = 0;
  const auto start = Wall::now();
  const auto wall_s = [&] { return std::chrono::duration<double>(Wall::now() - start).count(); };
  const auto say = [&](const std::string& line) {
    if (screen) return terminal->say(line);
    progress.clear();
    std::cout << line << '\n';
  };
  for (int i = 0; i < twin->robots() && !arguments.quiet; ++i) {
    const std::string name = twin->world().robots[static_cast<std::size_t>(i)].name;
    auto& console = twin->mind(i).board().virtual_devices().on_console;
    console = [name, say, before = console](const std::string& line) {
      if (before) before(line);
      say(name + ": " + line);
    };
  }
  is_stepping = true;
  team->before_first_tick();
  is_stepping = false;
  outputs.before_run();
  SerialText serial(say);
  for (int i = 0; i < twin->robots(); ++i)
    for (int port = 1; port <= 2; ++port) {
      // a quiet run shows only what was asked for by name
      const auto& asked = port == 1 ? options.uart1 : options.uart2;
      const bool by_option =
          std::any_of(asked.begin(), asked.end(), [](const auto& c) { return c.value == "-"; });
      if (twin->uart_choice(i, port) == "-" && (by_option || !arguments.quiet)) serial.listen(*twin, i, port);
    }
  // where nothing is due ticks are passed over, but text and ^C are looked for in between; somebody who looks
  // on sees more of it
  const bool is_seen = arguments.live || speed > 0 || !team->is_empty();
  const sim::Clicks look = outputs.wants_ticks() ? 0 : sim::kClicksPerSecond / (is_seen ? 64 : 4);
  while (simulation.now() < end && !team->has_ended()) {
    is_stepping = true;
    if (replay) replay->apply_due(inputs, simulation.now());
    inputs.faults().advance(std::min({end, simulation.now() + look, replay ? replay->next() : sim::kEver}));
    is_stepping = false;
    outputs.after_tick();
    serial.show();
    if (end_asked() || outputs.failed()) break;
    if (screen && wall_s() >= next_picture_s) {
      screen->show(terminal->frame(sim::to_seconds(simulation.now()) / std::max(wall_s(), 1e-3)));
      next_picture_s = wall_s() + kPictureEvery_s;
    }
    if (progress.is_due()) progress.show(sim::to_seconds(simulation.now()));
    if (speed > 0) {
      const double due_s = sim::to_seconds(simulation.now()) / speed;
      for (double ahead_s; (ahead_s = due_s - wall_s()) > 0 && !end_asked();)
        std::this_thread::sleep_for(std::chrono::duration<double>(std::min(ahead_s, kLongestSleep_s)));
    }
  }
  if (replay && !end_asked()) replay->finish(inputs, simulation, problems);
  const double took_s = wall_s();
  screen.reset();
  progress.finish();
  twin->flush_console();
  is_stepping = true;
  team->finish();
  is_stepping = false;
  guard.finishing();
  const int end_code = end_asked();
  if (team->has_ended() && !(arguments.quiet && team->outcome().code == 0)) complain({team->outcome().text});
  for (int i = 0; i < twin->robots(); ++i) twin->mind(i).board().exchange(twin->mind(i).now());

  serial.finish();
  Summary summary = summarise(*twin, took_s);
  for (const faults::Status& status : inputs.faults().statuses()) summary.faults.push_back(status);
  outputs.finish(summary, problems);
  complain(problems);
  if (!arguments.quiet) {
    std::cout << to_text(summary);
    const std::vector<std::string> written = outputs.written();
    for (std::size_t i = 0; i < written.size(); ++i) std::cout << (i == 0 ? "written: " : ", ") << written[i];
    if (!written.empty()) std::cout << '\n';
  }
  // a run that was cut off says nothing of faults that were still to come
  if (end_code == 0)
    for (const std::string& line : inputs.faults().problems()) {
      problems.push_back(line);
      complain({line});
    }
  const bool kept_budgets = profile.finish(problems);
  for (const auto& t : summary.traps) std::cerr << to_text(t);
  bool is_clean = true;
  for (const auto& r : summary.robots)
    for (const auto& d : r.diagnoses) {
      is_clean = false;
      if (!arguments.quiet || arguments.strict) std::cerr << to_text(r.name, d) << '\n';
    }
  if (end_code == kHostTime) {
    const double all_s = std::chrono::duration<double>(Wall::now() - began).count();
    complain({"twinpuck: host time: got " + std::to_string(static_cast<long>(all_s)) +
              " s, expected at most " + std::to_string(static_cast<long>(arguments.host_limit_s)) +
              " s; outputs hold what was simulated"});
    return end_code;
  }
  if (end_code == kInterrupted) return kInterrupted;
  if (!problems.empty() || outputs.failed()) return kInvalidRun;
  if (team->outcome().crashed) return kTrapped;
  if (team->outcome().code != 0) return kTestFailed;
  if (!summary.traps.empty()) return kTrapped;
  if (!kept_budgets) return kTestFailed;
  return arguments.strict && !(is_clean && fits_the_chip) ? kTestFailed : kPass;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("run", "Simulate a world");
  auto a = std::make_shared<RunArguments>();
  auto* world = verb->add_option("WORLD", a->world, "world file, or the name of one in worlds/");
  verb->option_defaults()->group("Robots");
  one_each(verb->add_option(
      "--fw", a->firmware,
      "[ROBOT=]FILE: a .elf or .hex, a folder of C files, or a controller's name; without ROBOT, for "
      "every robot"));
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
  verb->add_option("--seed", a->seed, "the world's seed, 0 or more, instead of the file's")
      ->check(CLI::NonNegativeNumber);
  verb->add_option("--threads", a->threads, "threads that run firmware; the result does not depend on it")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  verb->add_option("--host-limit", a->host_limit_s, "give up after this many real seconds (exit 124)")
      ->check(between(0, 1e7));
  auto* replay =
      verb->add_option("--replay", a->replay,
                       "do again what a page did, from view --record-inputs; the world is the recording's");
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
  verb->add_flag("--live", a->live,
                 "show arena, robots, LEDs and serial text in this terminal (80 by 24), in real time unless "
                 "--speed says otherwise");
  verb->add_flag("-q,--quiet", a->quiet, "no progress, no serial text and no summary on the terminal");
  add_profile_options(*verb, a->profile);
  add_output_options(*verb, a->outputs);
  verb->footer(
      "Example: twinpuck run maze --fw obstacle --for 60 --record maze.csv --picture maze.png\n"
      "Exit codes: 0 good, 1 --strict, --budgets or a supervisor found a fault, 2 bad input, 3 firmware "
      "trapped, "
      "7 an output was lost or a fault never took effect, 124 --host-limit, 130 interrupted");
  verb->callback([a, world, replay, speed, &exit_code] {
    if (a->live && speed->count() == 0) a->speed = "1";
    if (world->count() + replay->count() != 1) throw CLI::RequiredError("WORLD or --replay");
    exit_code = run(*a);
  });
}

}  // namespace tools
