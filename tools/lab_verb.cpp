// SPDX-License-Identifier: MIT
// twinpuck lab: the exercises of docs/start.md, headless: one line each with what was measured and what is
// asked, for our solutions or somebody's programs; a table for a class; one run again, to be looked at.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "exercises/class.h"
#include "exercises/class_table.h"
#include "exercises/mine.h"
#include "exercises/report.h"
#include "exercises/run.h"
#include "hal_sim/twin/firmware_store.h"
#include "install/places.h"
#include "outputs/output_folder.h"
#include "sim_core/base/did_you_mean.h"
#include "sim_core/base/file_uses.h"
#include "sim_core/base/output_file.h"
#include "tools/command_line.h"
#include "tools/lab_replay.h"
#include "tools/printable.h"
#include "tools/run_guard.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

constexpr double kUsualLimit_s = 60, kFullLimit_s = 900;

struct LabArguments {
  std::vector<std::string> ids;
  std::string table, csv, runs, html, junit, plot, mine;
  lab::Setting setting;
  ReplayArguments replay;
  double limit_s = 0;
  bool no_times = false, trusted = false;
};

std::vector<const lab::Exercise*> choose(const std::vector<lab::Exercise>& all,
                                         const std::vector<std::string>& ids,
                                         std::vector<std::string>& problems) {
  std::vector<const lab::Exercise*> chosen;
  std::vector<std::string> known;
  for (const lab::Exercise& e : all) {
    known.push_back(e.id);
    if (ids.empty() || std::find(ids.begin(), ids.end(), e.id) != ids.end()) chosen.push_back(&e);
  }
  for (const std::string& id : ids) {
    if (std::find(known.begin(), known.end(), id) != known.end()) continue;
    problems.push_back(fmt::format("command line: lab: got '{}', expected one of {}{}", id,
                                   fmt::join(known, " "), sim::did_you_mean_tail(id, known)));
  }
  return chosen;
}

/// What a command needs besides, to do the same run again.
std::string options_text(const LabArguments& a) {
  std::string text;
  const auto add = [&](const std::string& words) { text += (text.empty() ? "" : " ") + words; };
  if (!a.setting.hal.empty()) add("--hal " + a.setting.hal);
  if (a.setting.full) add("--full");
  if (!a.table.empty()) add("--table " + lab::shell_word(a.table));
  return text;
}

void write_tables(const LabArguments& a, const lab::Class& all, std::vector<std::string>& problems) {
  std::error_code none;
  const std::string name = fs::weakly_canonical(a.mine, none).filename().string();  // of "." too
  outputs::write_file(a.html, lab::class_html(all, a.mine.empty() ? "The lab" : "The lab: " + name), "--html",
                      problems);
  outputs::write_file(a.junit, lab::class_junit(all), "--junitxml", problems);
}

/// Somebody has ended it before all was tried.
int told_end() {
  complain({"lab: interrupted; tables hold what was tried"});
  return end_asked();
}

int judge_class(const LabArguments& a, const std::vector<const lab::Exercise*>& chosen,
                twin::Options options) {
  lab::Class all;
  all.exercises = chosen;
  all.setting = a.setting;
  // on the chip's machine a program reaches nothing of this PC
  if (all.setting.hal.empty() && !a.trusted) all.setting.hal = options.hal = "sim";
  LabArguments as_run = a;
  as_run.setting = all.setting;
  all.options = options_text(as_run);
  std::size_t width = std::string("student").size();
  for (fs::directory_iterator it(a.mine), end; it != end; ++it)
    width = std::max(width, it->path().filename().string().size());
  std::cout << lab::class_header(all, width) << std::flush;
  GracefulEnd guard([] {});
  lab::try_class(a.mine, options, !a.ids.empty(),
                 a.limit_s > 0    ? a.limit_s
                 : a.setting.full ? kFullLimit_s
                                  : kUsualLimit_s,
                 all, [&](const lab::Student& student) {
                   std::cout << lab::class_row(all, student, width) << std::flush;
                 });
  guard.finishing();
  std::cout << '\n' << lab::class_notes(all);
  std::vector<std::string> problems;
  outputs::write_file(a.csv, lab::class_csv(all), "--csv", problems);
  outputs::write_file(a.runs, lab::class_runs_csv(all), "--runs", problems);
  write_tables(a, all, problems);
  complain(problems);
  if (end_asked() != 0) return told_end();
  if (!problems.empty()) return kInvalidRun;
  for (const lab::Student& student : all.students)
    for (const lab::Cell& cell : student.cells)
      if (lab::is_failure(cell.verdict)) return kTestFailed;
  return kPass;
}

bool has_plot(const lab::Step& step) { return step.noise_scales.size() >= 2; }

/// The share against the noise scale, of the steps that have several.
void draw_plots(const std::string& file, const lab::Cell& cell, std::vector<std::string>& problems) {
  for (const lab::StepResult& step : cell.steps) {
    if (file.empty() || !has_plot(*step.step) || step.trials.empty()) continue;
    const std::string wrong = sim::write_share_plot(file, lab::share_plot(step));
    if (!wrong.empty()) problems.push_back(wrong);
  }
}

int judge_one(const LabArguments& a, const std::vector<const lab::Exercise*>& chosen,
              const lab::Programs& programs) {
  std::vector<std::string> problems;
  std::unique_ptr<sim::OutputFile> csv;
  const std::string runs = !a.csv.empty() ? a.csv : a.runs;
  const char* const runs_option = !a.csv.empty() ? "--csv" : "--runs";
  if (!runs.empty()) {
    csv = std::make_unique<sim::OutputFile>(runs, runs_option);
    csv->append_lines(lab::csv_header());
    if (!csv->error().empty()) {
      complain({csv->error()});
      return kBadInput;
    }
  }
  lab::Class all;
  all.exercises = chosen;
  all.setting = a.setting;
  all.options = options_text(a);
  lab::Student one{a.mine.empty() ? "solutions" : fs::path(a.mine).lexically_normal().filename().string(),
                   a.mine,
                   programs,
                   {}};
  if (one.name.empty() || one.name == ".") one.name = fs::canonical(a.mine).filename().string();
  int passed = 0, failed = 0, seen = 0, missing = 0;
  GracefulEnd guard([] {});
  for (const lab::Exercise* e : chosen) {
    lab::Cell cell = lab::try_exercise(*e, a.setting, programs, complain);
    if (end_asked() != 0) {
      all.exercises.resize(one.cells.size());
      break;
    }
    for (const lab::StepResult& step : cell.steps)
      if (csv) csv->append_lines(lab::csv_rows(e->id, step));
    draw_plots(a.plot, cell, problems);
    ++(cell.verdict == lab::Verdict::None   ? missing
       : lab::is_failure(cell.verdict)      ? failed
       : cell.verdict == lab::Verdict::Pass ? passed
                                            : seen);
    std::cout << fmt::format("{:<6} {}  {}: {}\n", e->id, lab::verdict_text(cell.verdict), e->title,
                             to_text(cell, a.setting, !a.no_times));
    const std::string command = lab::replay_command(cell, a.mine, all.options);
    if (!command.empty()) std::cout << "             " << command << '\n';
    std::cout << std::flush;
    one.cells.push_back(std::move(cell));
    if (is_stdout_lost() && one.cells.size() < chosen.size()) {
      problems.push_back("standard output: cannot be written any more; the lab ended behind " + e->id);
      all.exercises.resize(one.cells.size());
      break;
    }
  }
  guard.finishing();
  all.students.push_back(std::move(one));
  if (csv && !csv->error().empty()) problems.push_back(csv->error());
  write_tables(a, all, problems);
  complain(problems);
  if (end_asked() != 0) return told_end();
  if (!problems.empty()) return kInvalidRun;
  if (chosen.size() > 1) {
    std::cout << fmt::format("{} of {} pass", passed, passed + failed);
    if (seen > 0) std::cout << fmt::format(", {} seen", seen);
    if (missing > 0) std::cout << fmt::format(", {} without a program", missing);
    std::cout << '\n';
  }
  return failed > 0 ? kTestFailed : passed + seen > 0 ? kPass : kNothing;
}

/// The names of all programs that a table asks a student for.
std::set<std::string> programs_of(const std::vector<lab::Exercise>& all) {
  std::vector<const lab::Exercise*> each;
  for (const lab::Exercise& e : all) each.push_back(&e);
  return lab::wanted_programs(each);
}

/// One run again, with the programs that were asked for.
int replay(const LabArguments& a, const std::vector<lab::Exercise>& all, const twin::Options& options) {
  std::vector<std::string> problems;
  const lab::Exercise* const e = replayed_exercise(a.replay.trial, all, problems);
  if (e && !a.mine.empty() && lab::is_class(a.mine, programs_of(all), lab::wanted_programs({e}), true))
    problems.push_back(a.mine + ": --mine: got a class's folder, expected one student's with --replay");
  lab::Programs programs;
  if (problems.empty())
    programs = a.mine.empty() ? lab::reference_programs({e}, options, problems)
                              : lab::own_programs(a.mine, options, {e}, true, true);
  complain(problems);
  return problems.empty() ? replay_trial(a.replay, *e, a.setting, programs) : kBadInput;
}

/// What does not go together.
void check_together(const LabArguments& a, const std::string& table,
                    const std::vector<const lab::Exercise*>& chosen, std::vector<std::string>& problems) {
  if (!a.mine.empty() && !fs::is_directory(a.mine))
    problems.push_back(a.mine + ": --mine: got no folder, expected one with your programs");
  if (!a.replay.trial.empty() && !a.ids.empty())
    problems.push_back("command line: --replay: got exercise '" + a.ids[0] +
                       "' besides, expected what is replayed alone");
  if (!a.replay.trial.empty())
    for (const auto& [file, option] : {std::pair{a.csv, "--csv"},
                                       {a.runs, "--runs"},
                                       {a.html, "--html"},
                                       {a.junit, "--junitxml"},
                                       {a.plot, "--plot"}})
      if (!file.empty())
        problems.push_back(fmt::format(
            "command line: {}: got --replay besides, expected --picture, --report or --record of one run",
            option));
  if (a.setting.full && a.setting.seeds > 0)
    problems.push_back("command line: --seeds: got --full besides, expected one of them");
  if (const std::string kind = fs::path(a.plot).extension().string();
      !a.plot.empty() && kind != ".png" && kind != ".svg")
    problems.push_back(fmt::format("{}: --plot: got the ending '{}', expected .png or .svg", a.plot, kind));
  if (!a.plot.empty() && std::none_of(chosen.begin(), chosen.end(), [](const lab::Exercise* e) {
        return std::any_of(e->steps.begin(), e->steps.end(), has_plot);
      }))
    problems.push_back(
        "command line: --plot: got exercises with one noise scale, expected one with several, S15");
  if (!a.replay.trial.empty() && a.limit_s > 0)
    problems.push_back("command line: --limit: got --replay besides, expected a class's folder, --mine");
  if (a.replay.trial.empty())
    for (const auto& [file, option] :
         {std::pair{a.replay.picture, "--picture"}, std::pair{a.replay.report, "--report"},
          std::pair{a.replay.record, "--record"}})
      if (!file.empty())
        problems.push_back(
            fmt::format("command line: {}: got no --replay, expected the run that is meant", option));
  const std::pair<std::string, const char*> files[] = {{a.csv, "--csv"},
                                                       {a.runs, "--runs"},
                                                       {a.html, "--html"},
                                                       {a.junit, "--junitxml"},
                                                       {a.plot, "--plot"},
                                                       {a.replay.picture, "--picture"},
                                                       {a.replay.report, "--report"},
                                                       {a.replay.record, "--record"}};
  sim::FileUses uses;
  uses.reads(table, "--table");
  if (!a.mine.empty()) uses.reads_program(a.mine);
  std::vector<std::string> missing;  // told when they are to run
  for (const lab::Exercise* e : chosen)
    for (const lab::Step& step : e->steps) {
      for (const std::string& world : step.worlds)
        uses.reads((places::share_root() / "worlds" / (world + ".toml")).string(), "the world");
      if (a.mine.empty() && !step.firmware.empty())
        uses.reads_program(twin::find_firmware(step.firmware, "", missing));
    }
  for (const auto& [file, option] : files) uses.writes(file, option);
  uses.check(problems);
  if (problems.empty())
    for (const auto& [file, option] : files) outputs::can_write(file, option, problems);
}

int lab(const LabArguments& given) {
  LabArguments a = given;
  a.setting.is_mine = !a.mine.empty();
  a.setting.is_over = [] { return end_asked() != 0; };
  std::vector<std::string> problems;
  const std::string table = a.table.empty() ? (places::share_root() / "docs/lab.toml").string() : a.table;
  auto all = lab::read_table(table, problems);
  if (!problems.empty()) {
    complain(problems);
    return kBadInput;
  }
  if (a.setting.is_mine) all = lab::own_exercises(std::move(all));
  const auto chosen = choose(all, a.ids, problems);
  check_together(a, table, chosen, problems);
  if (!problems.empty()) {
    complain(problems);
    return kBadInput;
  }
  twin::Options options;
  options.hal = a.setting.hal;
  if (!a.trusted) options.within = a.mine;
  if (!a.replay.trial.empty()) return replay(a, all, options);
  if (a.setting.is_mine &&
      lab::is_class(a.mine, programs_of(all), lab::wanted_programs(chosen), !a.ids.empty())) {
    if (a.plot.empty()) return judge_class(a, chosen, options);
    complain({a.mine + ": --mine: got a class's folder, expected one student's with --plot"});
    return kBadInput;
  }
  if (a.limit_s > 0) {
    complain(
        {"command line: --limit: got no class, expected --mine with a folder of folders, one a student"});
    return kBadInput;
  }
  lab::Programs programs = a.setting.is_mine
                               ? lab::own_programs(a.mine, options, chosen, !a.ids.empty(), false)
                               : lab::reference_programs(chosen, options, problems);
  if (!problems.empty()) {
    complain(problems);
    return kBadInput;
  }
  if (a.setting.is_mine && programs.images.empty() && programs.broken.empty() && !programs.missing.empty()) {
    for (const auto& [firmware, why] : programs.missing) complain({why});
    complain(
        {a.mine + ": --mine: got no program of the lab's, expected folders of these names with C files"});
    return kNothing;
  }
  return judge_one(a, chosen, programs);
}

}  // namespace

void add_lab(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("lab", "Run the exercises of docs/start.md, one line each");
  auto a = std::make_shared<LabArguments>();
  lab::Setting& setting = a->setting;
  verb->add_option("EXERCISE", a->ids, "such as I1 or S14; all without one");
  verb->add_option(
          "--mine", a->mine,
          "folder with your programs (folders obstacle, u_obstacle, braiten), or one of them: run these "
          "in the place of the lab's solutions; or a folder of such folders, one a student")
      ->check(named());
  add_hal(*verb, setting.hal);
  verb->add_option("--seeds", setting.seeds, "runs of everything left to chance, instead of the table's")
      ->check(CLI::Range(1, 100000));
  verb->add_option("--first-seed", setting.first_seed, "their seeds are this one and the next ones")
      ->check(CLI::Range(0, 1000000000))
      ->capture_default_str();
  verb->add_flag("--full", setting.full, "as many runs as the figures in docs/start.md rest on");
  verb->add_option("--jobs", setting.jobs, "processes that share the runs; the result does not depend on it")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  verb->add_option("--csv", a->csv, "file for every run's measures; of a class, for its table")
      ->check(named());
  verb->add_option("--plot", a->plot, "PNG or SVG of the share against the noise scale (S15)")
      ->check(named());
  verb->add_flag("--no-times", a->no_times, "leave out what depends on the PC: same text every time");
  verb->add_option("--table", a->table, "another table than docs/lab.toml")->check(named());
  verb->option_defaults()->group("Tables");
  verb->add_option("--html", a->html, "page with the table, and why what failed")->check(named());
  verb->add_option("--junitxml", a->junit, "JUnit XML: a suite a student, a case an exercise")
      ->check(named());
  verb->add_option("--runs", a->runs, "file for every run's measures, of a class, too")->check(named());
  verb->add_option(
          "--limit", a->limit_s,
          "of a class: real seconds that a build, or an exercise of one student, may take (60; 900 with "
          "--full)")
      ->check(between(0.001, 1e6));
  verb->add_flag("--trusted", a->trusted,
                 "builds may read all that you may, not only the student's folder; of a class: programs for "
                 "Webots run as "
                 "programs of this PC, else on the chip's machine, which lets them reach nothing");
  verb->option_defaults()->group("One run again");
  verb->add_option("--replay", a->replay.trial,
                   "EXERCISE:WORLD:SEED of a run, as a line that failed shows it: I1:corners:3");
  verb->add_option("--picture", a->replay.picture, "PNG or SVG of it, from above")->check(named());
  verb->add_option("--report", a->replay.report, "HTML file of it, to look through")->check(named());
  verb->add_option("--record", a->replay.record, "CSV of poses, steps, sensors and LEDs")->check(named());
  verb->footer(
      "Examples: twinpuck lab I1 --mine .\n"
      "          twinpuck lab --mine class --jobs 4 --html class.html --junitxml class.xml\n"
      "          twinpuck lab --mine class/anna --replay I1:corners:3 --picture I1.png --report I1.html\n"
      "Exit codes: 0 all pass, 1 one fails, 2 bad input, 5 nothing to run, 7 an output was lost, "
      "130 interrupted: the tables have what was tried");
  verb->callback([a, &exit_code] { exit_code = lab(*a); });
}

}  // namespace tools
