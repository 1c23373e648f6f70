// SPDX-License-Identifier: MIT
#include "tools/lab_replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "outputs/run_files.h"
#include "outputs/summary.h"
#include "sim_core/base/did_you_mean.h"
#include "tools/command_line.h"
#include "tools/verbs.h"

namespace tools {

namespace {

constexpr const char* kReplay = "command line: --replay: ";

/// Picture, report and record of a trial, and its summary.
class ReplayLooker final : public lab::TrialOnlooker {
 public:
  explicit ReplayLooker(const ReplayArguments& a) {
    outputs_wanted_.record = a.record;
    outputs_wanted_.report = a.report;
    outputs_wanted_.pictures.picture = a.picture;
  }
  bool open(runs::Run& run, std::vector<std::string>& problems) override {
    twin_ = &run.twin();
    sim::FileUses files;
    outputs::note_world(twin_->world(), {}, {}, files);
    outputs::note_outputs(outputs_wanted_, twin_->world(), files);
    files.check(problems);
    was_opened = problems.empty();
    if (!was_opened) return false;
    outputs_ = std::make_unique<outputs::RunOutputs>(outputs_wanted_, run);
    was_opened = outputs_->open(problems);
    if (!was_opened) outputs_.reset();  // they look at the twin, which goes
    return was_opened;
  }
  void before_run() override {
    began_ = std::chrono::steady_clock::now();
    outputs_->before_run();
  }
  void after_tick() override { outputs_->after_tick(); }
  void finish(std::vector<std::string>& problems) override {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began_;
    twin_->flush_console();
    summary = outputs::summarise(*twin_, took.count());
    const std::size_t before = problems.size();
    outputs_->finish(*summary, problems);
    lost_outputs = problems.size() > before || outputs_->failed();
    written = outputs::without_lost(outputs_->written(), problems);
    outputs_.reset();
  }

  std::optional<outputs::Summary> summary;
  std::vector<std::string> written;
  bool was_opened = true, lost_outputs = false;

 private:
  outputs::OutputArguments outputs_wanted_;
  twin::Twin* twin_ = nullptr;
  std::unique_ptr<outputs::RunOutputs> outputs_;
  std::chrono::steady_clock::time_point began_;
};

std::vector<std::string> parts_of(const std::string& trial) {
  std::vector<std::string> parts;
  std::istringstream in(trial);
  for (std::string part; std::getline(in, part, ':');) parts.push_back(part);
  return parts;
}

std::string guess_text(const std::string& word, const std::vector<std::string>& known) {
  return fmt::format("expected one of {}{}", fmt::join(known, ", "), sim::did_you_mean_tail(word, known));
}

/// The trial that is meant, and the step it is of; none: lines in `problems`.
std::optional<lab::TrialResult> find_trial(const std::string& text, const lab::Exercise& exercise,
                                           const lab::Setting& setting, const lab::Programs& programs,
                                           std::vector<std::string>& problems) {
  const std::vector<std::string> parts = parts_of(text);
  if (parts.size() != 3 && parts.size() != 4) {
    problems.push_back(
        fmt::format("{}got '{}', expected EXERCISE:WORLD:SEED, such as I1:corners:3, or "
                    "EXERCISE:WORLD:SEED:NOISE",
                    kReplay, text));
    return std::nullopt;
  }
  std::vector<std::string> worlds, scales;
  const lab::Step* step = nullptr;
  for (const lab::Step& s : exercise.steps) {
    if (s.kind != lab::Step::Kind::Runs) continue;
    worlds.insert(worlds.end(), s.worlds.begin(), s.worlds.end());
    if (!step && std::find(s.worlds.begin(), s.worlds.end(), parts[1]) != s.worlds.end()) step = &s;
  }
  if (worlds.empty()) {
    problems.push_back(
        fmt::format("{}got {}, which runs nothing, expected an exercise with runs", kReplay, exercise.id));
    return std::nullopt;
  }
  if (!step) {
    problems.push_back(fmt::format("{}got world '{}' of {}, {}", kReplay, parts[1], exercise.id,
                                   guess_text(parts[1], worlds)));
    return std::nullopt;
  }
  lab::Setting one = setting;
  one.seeds = 1;
  char* end = nullptr;
  const long seed = std::strtol(parts[2].c_str(), &end, 10);
  if (parts[2].empty() || *end != 0 || seed < 0 || seed > 1'000'000'000) {
    problems.push_back(fmt::format("{}got seed '{}', expected a number, 0 to 1000000000", kReplay, parts[2]));
    return std::nullopt;
  }
  one.first_seed = static_cast<int>(seed);
  for (const double scale : step->noise_scales) scales.push_back(fmt::format("{:g}", scale));
  if (scales.empty() ? parts.size() == 4 : parts.size() == 3 && scales.size() > 1) {
    problems.push_back(scales.empty()
                           ? fmt::format("{}got noise scale '{}', which {} leaves as the world says", kReplay,
                                         parts[3], exercise.id)
                           : fmt::format("{}got no noise scale, expected one behind the seed: {}", kReplay,
                                         fmt::join(scales, ", ")));
    return std::nullopt;
  }
  for (const lab::TrialResult& t : lab::trials_of(*step, one, programs))
    if (t.trial.world == parts[1] &&
        (parts.size() == 3 || fmt::format("{:g}", t.trial.noise_scale) == parts[3]))
      return t;
  problems.push_back(
      fmt::format("{}got noise scale '{}', {}", kReplay, parts[3], guess_text(parts[3], scales)));
  return std::nullopt;
}

}  // namespace

const lab::Exercise* replayed_exercise(const std::string& trial, const std::vector<lab::Exercise>& all,
                                       std::vector<std::string>& problems) {
  const std::string id = trial.substr(0, trial.find(':'));
  std::vector<std::string> ids;
  for (const lab::Exercise& e : all) {
    if (e.id == id) return &e;
    ids.push_back(e.id);
  }
  problems.push_back(fmt::format("{}got exercise '{}', {}", kReplay, id, guess_text(id, ids)));
  return nullptr;
}

int replay_trial(const ReplayArguments& arguments, const lab::Exercise& exercise, const lab::Setting& setting,
                 const lab::Programs& programs) {
  std::vector<std::string> problems;
  std::optional<lab::TrialResult> found = find_trial(arguments.trial, exercise, setting, programs, problems);
  if (!found) {
    complain(problems);
    return kBadInput;
  }
  for (const auto* absent : {&programs.missing, &programs.broken})
    if (const auto why = absent->find(found->trial.step->firmware); why != absent->end()) {
      complain({why->second});
      return absent == &programs.missing ? kNothing : kTestFailed;
    }
  ReplayLooker looker(arguments);
  static_cast<lab::TrialEnd&>(*found) = lab::run_trial(found->trial, &looker);
  complain(found->problems);
  if (!looker.was_opened) return kBadInput;
  lab::StepResult result{found->trial.step, {*found}, ""};
  const bool kept = share_of(result, std::nan("")) == 1;
  lab::Step alone = *found->trial.step;  // its bounds, of this run
  alone.shares = {{1, 1}};
  std::cout << fmt::format("{}: {}: {}; {}\n", lab::trial_name(exercise, found->trial),
                           kept ? "kept" : "not kept", lab::measures_text(*found), lab::asked_by(alone, 1));
  if (looker.summary) std::cout << to_text(*looker.summary);
  if (!looker.written.empty()) std::cout << fmt::format("written: {}\n", fmt::join(looker.written, ", "));
  if (looker.lost_outputs) return kInvalidRun;
  return kept ? kPass : kTestFailed;
}

}  // namespace tools
