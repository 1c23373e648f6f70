// SPDX-License-Identifier: MIT
// twinpuck view WORLD: the world in a browser, until Ctrl-C. The page is viewer/page, bundled by `make view`.
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <thread>

#include "hal_sim/twin/world_file.h"
#include "install/places.h"
#include "outputs/output_folder.h"
#include "outputs/run_files.h"
#include "sim_core/base/input_file.h"
#include "sim_core/load/world_loader.h"
#include "tools/command_line.h"
#include "tools/run_guard.h"
#include "tools/verbs.h"
#include "viewer/live_view.h"

namespace tools {

namespace {

namespace fs = std::filesystem;
constexpr auto kLook = std::chrono::milliseconds(50);

struct ViewArguments {
  std::string world, record, replay, hal, optimisation;
  std::vector<std::string> firmware, supervisors;
  int port = 0, threads = 1;
  std::optional<std::uint64_t> seed;
};

/// A recording's world, under a name of its own beside the world's file: saved, it shall overwrite nothing.
inputs::Opening opening_of(const inputs::Replay& replay) {
  inputs::Opening opening = replay.opening;
  replay.resume(opening.options);
  const fs::path file = fs::absolute(opening.file).lexically_normal();
  opening.file = (file.parent_path() / ("replay of " + file.filename().string())).string();
  return opening;
}

inputs::Opening opening_of(const ViewArguments& a, std::vector<std::string>& problems) {
  inputs::Opening opening;
  opening.file = find_world(a.world, problems);
  const std::string wrong =
      problems.empty() ? sim::read_input_file(opening.file, sim::kLongestWorld, opening.text) : "";
  if (!wrong.empty()) problems.push_back(opening.file + ": " + wrong);
  if (!problems.empty()) return opening;
  opening.file = fs::absolute(opening.file).lexically_normal().string();
  opening.options.hal = a.hal;
  opening.options.optimisation = a.optimisation;
  opening.supervisors = a.supervisors;
  const viewer::Document first(opening.file, opening.text);
  opening.seed =
      a.seed ? *a.seed : (first.loaded().world ? *first.loaded().world : first.loaded().draft).seed;
  return opening;
}

int view(const ViewArguments& a) {
  std::vector<std::string> problems;
  auto replay = a.replay.empty() ? nullptr : inputs::Replay::open(a.replay, problems);
  if (replay && replay->end() < 0) complain({replay->cut_off(a.replay)});
  inputs::Opening opening;
  if (problems.empty()) opening = replay ? opening_of(*replay) : opening_of(a, problems);
  if (!problems.empty() || (!replay && !split_choices(a.firmware, "--fw", opening.options.firmware))) {
    complain(problems);
    return kBadInput;
  }
  opening.options.threads = a.threads;

  sim::FileUses files;
  const sim::LoadedWorld loaded = twin::parse_world(opening.text, opening.file);
  outputs::note_world(loaded.world ? *loaded.world : loaded.draft, opening.options, opening.supervisors,
                      files);
  files.writes(a.record, "--record-inputs");
  files.check(problems);
  if (!problems.empty() || !outputs::can_write(a.record, "--record-inputs", problems)) {
    complain(problems);
    return kBadInput;
  }
  auto live =
      viewer::LiveView::open(std::move(opening), a.record, a.port, places::page_folder().string(), problems,
                             std::move(replay), [](const std::string& wrong) { complain({wrong}); });
  complain(problems);  // of the world's the page tells, too, and may mend them
  if (!live) return kBadInput;
  GracefulEnd guard([] {});
  std::cout << "open " << live->server().address() << "\nCtrl-C ends it" << std::endl;
  while (!end_asked()) std::this_thread::sleep_for(kLook);
  guard.finishing();
  // the recording is whole before the guard goes
  return live->end().empty() ? kPass : kInvalidRun;
}

}  // namespace

void add_view(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("view", "See, touch and change a world in a browser");
  auto a = std::make_shared<ViewArguments>();
  auto* world = verb->add_option("WORLD", a->world, "world file, or the name of one in worlds/");
  auto* replay = verb->add_option("--replay", a->replay,
                                  "show again what --record-inputs or a failed test wrote; the world is the "
                                  "recording's, and it stands still at the recording's end");
  add_firmware(*verb, a->firmware);
  verb->add_option("--port", a->port, "of 127.0.0.1; 0 takes any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  verb->add_option("--record-inputs", a->record,
                   "file for what the page does, with its ticks; --replay does it again")
      ->excludes(replay);
  add_hal(*verb, a->hal);
  one_each(verb->add_option("--supervisor", a->supervisors, "a program attached to the world"));
  add_seed_and_threads(*verb, a->seed, a->threads);
  verb->add_option(
          "--opt", a->optimisation,
          "level for controllers built from source; without it, that of a program's project file, else -O1")
      ->check(CLI::IsMember({"-O0", "-O1", "-O2", "-Os"}));
  verb->footer(
      "Example: twinpuck view maze --fw obstacle\nExit codes: 0 ended by Ctrl-C, 2 bad input, 7 the "
      "recording could not be written");
  verb->callback([a, verb, world, replay, &exit_code] {
    std::vector<std::string> problems;
    want_one_world(*verb, *world, *replay, a->world, problems);
    complain(problems);
    exit_code = problems.empty() ? view(*a) : int{kBadInput};
  });
}

}  // namespace tools
