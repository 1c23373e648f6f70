// SPDX-License-Identifier: MIT
// twinpuck lab: the exercises of docs/lab.md, headless, one line each with what was measured. Trials are
// shared among processes (an image holds its robots' globals, so two worlds cannot run it side by side in one
// process); results come back by the trial's number and do not depend on how many processes there are.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>

#include "compiler/cache/child_process.h"
#include "hal_sim/twin/twin.h"
#include "install/places.h"
#include "tools/command_line.h"
#include "tools/lab_mine.h"
#include "tools/lab_report.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

struct LabArguments {
  std::vector<std::string> ids;
  std::string table, csv, plot, mine, hal;
  int seeds = 0, jobs = 1;
  bool full = false, no_times = false, list = false;
};

// every firmware is built once, before anything runs
LabPrograms build_images(const std::vector<const LabExercise*>& chosen, twin::Options options,
                         std::vector<std::string>& problems) {
  LabPrograms programs;
  options.tell = [](const std::string& line) { std::cerr << line << '\n'; };
  for (const LabExercise* e : chosen)
    for (const LabStep& s : e->steps)
      if (!s.firmware.empty() && !programs.images.count(s.firmware))
        programs.images[s.firmware] = twin::provide_image(s.firmware, "", options, problems);
  return programs;
}

std::vector<TrialResult> trials_of(const LabStep& step, int seeds, double seconds, const std::string& image,
                                   const LabArguments& a) {
  std::vector<TrialResult> all;
  const std::vector<double> as_written{std::nan("")};
  const auto& scales = step.noise_scales.empty() ? as_written : step.noise_scales;
  for (const std::string& world : step.worlds)
    for (double scale : scales)
      for (int seed = 1; seed <= (step.kind == LabStep::Kind::Sensor ? 1 : seeds); ++seed)
        all.push_back({{&step, world, image, a.hal, scale, seconds, static_cast<std::uint64_t>(seed)},
                       false,
                       {},
                       "",
                       {}});
  return all;
}

void run_one(TrialResult& t) { t.ran = run_trial(t.trial, t.measures, t.said, t.problems); }

// what a child process tells of one trial; its problems go to stderr at once
struct Told {
  std::size_t index;
  bool ran;
  Measures measures;
  char said[96];
};

void run_in_processes(std::vector<TrialResult>& trials, int jobs) {
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
        run_one(trials[i]);
        complain(trials[i].problems);
        Told told{i, trials[i].ran, trials[i].measures, ""};
        trials[i].said.copy(told.said, sizeof told.said - 1);
        if (write(ends[1], &told, sizeof told) != sizeof told) _exit(kInternal);
      }
      _exit(0);
    }
    close(ends[1]);
    groups.push_back(std::make_unique<cc::ChildGroup>(pid));
    children.emplace_back(pid, ends[0]);
  }
  for (std::size_t c = 0; c < children.size(); ++c) {
    const auto [pid, end] = children[c];
    Told told;
    for (std::size_t got = 0;;) {
      const ssize_t n = read(end, reinterpret_cast<char*>(&told) + got, sizeof told - got);
      if (n <= 0) break;
      got += static_cast<std::size_t>(n);
      if (got < sizeof told) continue;
      got = 0;
      trials[told.index].ran = told.ran;
      trials[told.index].measures = told.measures;
      trials[told.index].said = told.said;
    }
    close(end);
    groups[c].reset();  // what is waited for has no number any more
    int status;
    waitpid(pid, &status, 0);
  }
}

StepResult run_step(const LabStep& step, const LabArguments& a, const LabPrograms& programs) {
  StepResult result{&step, {}, ""};
  const auto broken = programs.broken.find(step.firmware);
  if (broken != programs.broken.end()) {
    result.problem = broken->second;
    return result;
  }
  if (step.kind == LabStep::Kind::Answer) {
    std::ifstream answers(places::share_root() / "docs/lab-answers.md");
    for (std::string line; std::getline(answers, line);)
      if (line == "## " + step.answer) return result;
    result.problem = "docs/lab-answers.md: got no heading '" + step.answer + "', expected an answer";
    return result;
  }
  const int seeds = a.seeds > 0 ? a.seeds : a.full ? step.full_seeds : step.quick_seeds;
  const auto image = programs.images.find(step.firmware);
  result.trials = trials_of(step, seeds, a.full ? step.full_seconds : step.seconds,
                            image == programs.images.end() ? "" : image->second, a);
  bool timed = false;
  for (const Shown& s : step.shown) timed = timed || s.measure == Measure::Speed;
  if (a.jobs > 1 && !timed) {
    run_in_processes(result.trials, a.jobs);
  } else {
    for (TrialResult& t : result.trials) {
      run_one(t);
      complain(t.problems);
    }
  }
  return result;
}

std::vector<const LabExercise*> choose(const std::vector<LabExercise>& all,
                                       const std::vector<std::string>& ids,
                                       std::vector<std::string>& problems) {
  std::vector<const LabExercise*> chosen;
  std::string known;
  for (const LabExercise& e : all) {
    known += (known.empty() ? "" : " ") + e.id;
    if (ids.empty() || std::find(ids.begin(), ids.end(), e.id) != ids.end()) chosen.push_back(&e);
  }
  for (const std::string& id : ids)
    if (std::none_of(all.begin(), all.end(), [&](const LabExercise& e) { return e.id == id; }))
      problems.push_back("command line: lab: got '" + id + "', expected one of " + known);
  return chosen;
}

int lab(const LabArguments& a) {
  std::vector<std::string> problems;
  const std::string table = a.table.empty() ? (places::share_root() / "docs/lab.toml").string() : a.table;
  const bool mine = !a.mine.empty();
  auto all = read_lab_table(table, problems);
  if (mine) all = own_exercises(std::move(all));
  const auto chosen = choose(all, a.ids, problems);
  if (mine && !fs::is_directory(a.mine))
    problems.push_back(a.mine + ": --mine: got no folder, expected one with your programs");
  LabPrograms programs;
  twin::Options options;
  options.hal = a.hal;
  std::ofstream csv;
  if (problems.empty() && !a.csv.empty()) {
    csv.open(a.csv, std::ios::trunc);
    if (!csv) problems.push_back(a.csv + ": --csv: cannot be written");
    csv << lab_csv_header();
  }
  if (problems.empty())
    programs = mine ? own_programs(a.mine, options, chosen, !a.ids.empty())
                    : build_images(chosen, options, problems);
  if (!problems.empty()) {
    complain(problems);
    return kBadInput;
  }
  if (programs.images.empty() && programs.broken.empty() && !programs.missing.empty()) {
    for (const auto& [firmware, why] : programs.missing) complain({why});
    complain(
        {a.mine + ": --mine: got no program of the lab's, expected folders of these names with C files"});
    return kNothing;
  }
  int passed_ones = 0, failed = 0, seen = 0, missing = 0, plots = 0;
  for (const LabExercise* e : chosen) {
    bool passed = true, there = true;
    // what the lab has one look at (S) has no right outcome: a program may do better than ours, or other
    // things
    const bool judged = !mine || e->id[0] != 'S';
    std::string line;
    for (const LabStep& step : e->steps) {
      const auto absent = programs.missing.find(step.firmware);
      if (absent != programs.missing.end()) {
        there = false, line = absent->second;
        break;
      }
      const StepResult result = run_step(step, a, programs);
      passed = passed && (judged ? is_passed(result) : has_run(result));
      line += (line.empty() ? "" : "; ") + to_text(result, !a.no_times);
      if (csv.is_open()) csv << lab_csv(e->id, result);
      if (!a.plot.empty() && step.noise_scales.size() > 1) {
        const std::string wrong = sim::write_share_plot(a.plot, share_plot(result));
        if (!wrong.empty()) problems.push_back(wrong);
        ++plots;
      }
    }
    ++(!there ? missing : !passed ? failed : judged ? passed_ones : seen);
    const char* verdict = !there ? "none" : !passed ? "FAIL" : judged ? "pass" : "seen";
    std::cout << fmt::format("{:<6} {}  {}: {}", e->id, verdict, e->title, line) << std::endl;
  }
  if (!a.plot.empty() && plots == 0)
    problems.push_back(
        "command line: --plot: got exercises with one noise scale, expected one with several, S15");
  csv.flush();
  if (csv.is_open() && !csv) problems.push_back(a.csv + ": --csv: cannot be written");
  complain(problems);
  if (!problems.empty()) return kInvalidRun;
  if (chosen.size() > 1) {
    std::cout << fmt::format("{} of {} pass", passed_ones, passed_ones + failed);
    if (seen > 0) std::cout << fmt::format(", {} seen", seen);
    if (missing > 0) std::cout << fmt::format(", {} without a program", missing);
    std::cout << '\n';
  }
  return failed ? kTestFailed : kPass;
}

}  // namespace

void add_lab(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("lab", "Run the exercises of docs/lab.md, one line each");
  auto a = std::make_shared<LabArguments>();
  verb->add_option("EXERCISE", a->ids, "such as I1 or S14; all without one");
  verb->add_option(
      "--mine", a->mine,
      "folder with your programs (folders obstacle, u_obstacle, braiten), or one of them: run these "
      "in the place of the lab's solutions");
  add_hal(*verb, a->hal);
  verb->add_option("--seeds", a->seeds, "runs of everything left to chance, instead of the table's")
      ->check(CLI::Range(1, 100000));
  verb->add_flag("--full", a->full, "as many runs as the figures in docs/lab.md rest on");
  verb->add_option("--jobs", a->jobs, "processes that share the runs; the result does not depend on it")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  verb->add_option("--csv", a->csv, "file for every run's measures");
  verb->add_option("--plot", a->plot, "PNG or SVG of the share against the noise scale (S15)");
  verb->add_flag("--no-times", a->no_times, "leave out what depends on the PC: same text every time");
  verb->add_option("--table", a->table, "another table than docs/lab.toml");
  verb->callback([a, &exit_code] { exit_code = lab(*a); });
}

}  // namespace tools
