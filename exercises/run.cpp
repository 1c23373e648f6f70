// SPDX-License-Identifier: MIT
#include "exercises/run.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "compiler/cache/child_process.h"
#include "hal_sim/twin/twin.h"
#include "install/places.h"

namespace lab {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// --- from process to process

Json packed(const TrialEnd& end) {
  Json j{{"ran", end.ran}, {"said", end.said}, {"problems", end.problems}};
  // as bits: a measure may be infinite, or none
  for (const double v : end.measures.value) {
    std::uint64_t bits;
    std::memcpy(&bits, &v, sizeof bits);
    j["measures"].push_back(bits);
  }
  if (end.digest) j["digest"] = *end.digest;
  return j;
}

void unpack_end(const Json& j, TrialEnd& end) {
  end.ran = j.at("ran");
  end.said = j.at("said");
  end.problems = j.at("problems").get<std::vector<std::string>>();
  for (std::size_t i = 0; i < kMeasures; ++i) {
    const std::uint64_t bits = j.at("measures").at(i);
    std::memcpy(&end.measures.value[i], &bits, sizeof bits);
  }
  if (j.contains("digest")) end.digest = j["digest"].get<std::uint64_t>();
}

/// Text of a program may be of any bytes.
std::string dumped(const Json& j) { return j.dump(-1, ' ', false, Json::error_handler_t::replace); }

void make_trial(TrialResult& t) { static_cast<TrialEnd&>(t) = run_trial(t.trial); }

bool write_all(int to, const void* bytes, std::size_t size) {
  for (const char* at = static_cast<const char*>(bytes); size > 0;) {
    const ssize_t n = ::write(to, at, size);
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}
bool read_all(int from, void* bytes, std::size_t size) {
  for (char* at = static_cast<char*>(bytes); size > 0;) {
    const ssize_t n = ::read(from, at, size);
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

/// Child j makes trials j, j + jobs ... and tells each as "length, JSON".
void make_in_processes(std::vector<TrialResult>& trials, int jobs) {
  std::vector<std::pair<pid_t, int>> children;
  std::vector<std::unique_ptr<cc::ChildGroup>> groups;  // of theirs; they end with this process
  for (int j = 0; j < jobs; ++j) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    const pid_t parent = getpid(), pid = fork();
    if (pid < 0) throw std::runtime_error("no process");
    if (pid == 0) {
      cc::lead_child_group(parent);
      close(ends[0]);
      for (std::size_t i = static_cast<std::size_t>(j); i < trials.size();
           i += static_cast<std::size_t>(jobs)) {
        make_trial(trials[i]);
        Json told = packed(trials[i]);
        told["index"] = i;
        const std::string text = dumped(told);
        const std::size_t size = text.size();
        if (!write_all(ends[1], &size, sizeof size) || !write_all(ends[1], text.data(), size))
          _exit(EXIT_FAILURE);
      }
      _exit(0);
    }
    close(ends[1]);
    groups.push_back(std::make_unique<cc::ChildGroup>(pid));
    children.emplace_back(pid, ends[0]);
  }
  for (std::size_t c = 0; c < children.size(); ++c) {
    const auto [pid, end] = children[c];
    for (std::size_t size = 0; read_all(end, &size, sizeof size);) {
      std::string text(size, ' ');
      if (!read_all(end, text.data(), size)) break;
      const Json told = Json::parse(text);
      unpack_end(told, trials.at(told.at("index").get<std::size_t>()));
    }
    close(end);
    groups[c].reset();  // what is waited for has no number any more
    int status;
    waitpid(pid, &status, 0);
  }
}

StepResult try_step(const Step& step, const Setting& setting, const Programs& programs,
                    const std::function<void(const std::vector<std::string>&)>& tell) {
  StepResult result{&step, {}, ""};
  if (step.kind == Step::Kind::Answer) {
    std::ifstream answers(places::share_root() / "docs/lab-answers.md");
    for (std::string line; std::getline(answers, line);)
      if (line == "## " + step.answer) return result;
    result.problem = "docs/lab-answers.md: got no heading '" + step.answer + "', expected an answer";
    return result;
  }
  result.trials = trials_of(step, setting, programs);
  bool timed = false;
  for (const Shown& s : step.shown) timed = timed || s.measure == Measure::Speed;
  if (setting.jobs > 1 && !timed)
    make_in_processes(result.trials, setting.jobs);
  else
    for (TrialResult& t : result.trials)
      if (!setting.is_over()) make_trial(t);
  for (const TrialResult& t : result.trials) tell(t.problems);
  return result;
}

/// What the lab has one look at (S) has no right outcome: a program may do better than ours, or other things.
bool is_judged(const Exercise& exercise, const Setting& setting) {
  return !setting.is_mine || exercise.id[0] != 'S';
}

Verdict verdict_of(const Cell& cell, const Setting& setting) {
  const bool judged = is_judged(*cell.exercise, setting);
  for (const StepResult& step : cell.steps)
    if (judged ? !is_passed(step) : !has_run(step)) return Verdict::Fail;
  return judged ? Verdict::Pass : Verdict::Seen;
}

/// What of a step this edition has not: the students' has no solutions and no answers. Empty: nothing.
std::string absent_text(const Step& step) {
  const fs::path root = places::share_root();
  std::error_code none;
  if (step.kind == Step::Kind::Answer && !fs::exists(root / "docs/lab-answers.md", none))
    return "its answer is not in this edition of Twinpuck";
  if (step.supervisor.empty() || !twin::stored_controller(step.supervisor).empty()) return "";
  return "its solution is not in this edition of Twinpuck";
}

/// False: why there is nothing to try.
bool has_programs(const Programs& programs, Cell& cell) {
  for (const Step& step : cell.exercise->steps) {
    const auto missing = programs.missing.find(step.firmware), broken = programs.broken.find(step.firmware);
    cell.why = missing != programs.missing.end() ? missing->second : absent_text(step);
    if (!cell.why.empty()) {
      cell.verdict = Verdict::None;
      return false;
    }
    if (broken == programs.broken.end()) continue;
    cell.verdict = Verdict::Broken;
    cell.why = broken->second;
    return false;
  }
  return true;
}

}  // namespace

const char* verdict_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::Pass:
      return "pass";
    case Verdict::Seen:
      return "seen";
    case Verdict::None:
      return "none";
    case Verdict::Open:
      return "open";
    default:
      return "FAIL";
  }
}

bool is_failure(Verdict verdict) {
  return verdict != Verdict::Pass && verdict != Verdict::Seen && verdict != Verdict::None &&
         verdict != Verdict::Open;
}

std::vector<TrialResult> trials_of(const Step& step, const Setting& setting, const Programs& programs) {
  const int seeds = step.kind == Step::Kind::Sensor ? 1
                    : setting.seeds > 0             ? setting.seeds
                    : setting.full                  ? step.full_seeds
                                                    : step.quick_seeds;
  const double seconds = setting.full ? step.full_seconds : step.seconds;
  const auto image = programs.images.find(step.firmware);
  const std::vector<double> as_written{std::nan("")};
  std::vector<TrialResult> all;
  for (const std::string& world : step.worlds)
    for (double scale : step.noise_scales.empty() ? as_written : step.noise_scales)
      for (int n = 0; n < seeds; ++n)
        all.emplace_back(Trial{&step, world, image == programs.images.end() ? "" : image->second, setting.hal,
                               scale, seconds, static_cast<std::uint64_t>(setting.first_seed + n)});
  return all;
}

Cell try_exercise(const Exercise& exercise, const Setting& setting, const Programs& programs,
                  const std::function<void(const std::vector<std::string>&)>& tell) {
  Cell cell;
  cell.exercise = &exercise;
  if (!has_programs(programs, cell)) return cell;
  for (const Step& step : exercise.steps) cell.steps.push_back(try_step(step, setting, programs, tell));
  for (const StepResult& step : cell.steps)
    for (const TrialResult& t : step.trials)
      cell.problems.insert(cell.problems.end(), t.problems.begin(), t.problems.end());
  cell.verdict = verdict_of(cell, setting);
  return cell;
}

std::string to_text(const Cell& cell, const Setting& setting, bool times) {
  if (!cell.why.empty()) return cell.why;
  std::string line;
  for (const StepResult& step : cell.steps) {
    line += (line.empty() ? "" : "; ") + to_text(step, times);
    const std::string asked =
        is_judged(*cell.exercise, setting) ? asked_by(*step.step, step.trials.size()) : "";
    if (!asked.empty()) line += " (" + asked + ")";
  }
  return line;
}

std::string trial_name(const Exercise& exercise, const Trial& trial) {
  return fmt::format("{}:{}:{}{}", exercise.id, trial.world, trial.seed,
                     std::isnan(trial.noise_scale) ? "" : fmt::format(":{:g}", trial.noise_scale));
}

std::string telling_trial_name(const Cell& cell) {
  if (cell.verdict != Verdict::Fail) return "";
  for (const StepResult& step : cell.steps)
    if (const TrialResult* t =
            is_passed(step) || step.step->kind != Step::Kind::Runs ? nullptr : telling_trial(step))
      return trial_name(*cell.exercise, t->trial);
  return "";
}

std::string pack(const Cell& cell) {
  Json j{{"verdict", static_cast<int>(cell.verdict)}, {"why", cell.why}, {"problems", cell.problems}};
  for (const StepResult& step : cell.steps) {
    Json trials = Json::array();
    for (const TrialResult& t : step.trials) trials.push_back(packed(t));
    j["steps"].push_back({{"problem", step.problem}, {"trials", trials}});
  }
  return dumped(j);
}

bool unpack(const std::string& text, const Setting& setting, const Programs& programs, Cell& cell) {
  const Json j = Json::parse(text, nullptr, false);
  if (!j.is_object()) return false;
  cell.verdict = static_cast<Verdict>(j.at("verdict").get<int>());
  cell.why = j.at("why");
  cell.problems = j.at("problems").get<std::vector<std::string>>();
  if (!j.contains("steps")) return true;
  const Json& steps = j["steps"];
  for (std::size_t s = 0; s < steps.size() && s < cell.exercise->steps.size(); ++s) {
    const Step& step = cell.exercise->steps[s];
    StepResult result{&step, {}, steps[s].at("problem").get<std::string>()};
    if (step.kind != Step::Kind::Answer) result.trials = trials_of(step, setting, programs);
    const Json& trials = steps[s].at("trials");
    if (trials.size() != result.trials.size()) return false;
    for (std::size_t t = 0; t < trials.size(); ++t) unpack_end(trials[t], result.trials[t]);
    cell.steps.push_back(std::move(result));
  }
  return true;
}

}  // namespace lab
