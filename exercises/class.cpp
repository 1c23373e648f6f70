// SPDX-License-Identifier: MIT
#include "exercises/class.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "exercises/contained_jobs.h"
#include "outputs/complain.h"

namespace lab {

namespace {

namespace fs = std::filesystem;

/// Folders of students in a class's, by name.
std::vector<fs::path> folders_of(const std::string& home) {
  std::vector<fs::path> folders;
  std::error_code none;
  for (fs::directory_iterator it(home, none), end; !none && it != end; it.increment(none)) {
    std::error_code odd;
    if (it->path().filename().string()[0] != '.' && it->is_directory(odd)) folders.push_back(it->path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

std::vector<std::string> lines_in(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// A program that is to be built, for all names that it serves.
struct Build {
  std::size_t student;
  std::string folder;
  std::vector<std::string> firmware;
};

/// Why a process did not come to its end; empty: it did.
std::string end_text(const JobEnd& end, double limit_s) {
  if (end.how == JobEnd::How::TimedOut)
    return fmt::format("took longer than {:g} s of this PC (--limit)", limit_s);
  return end.how == JobEnd::How::Died ? "the simulator " + end.why : "";
}

/// Finds the programs; what is missing is noted at once.
std::vector<Build> find_builds(const std::set<std::string>& wanted, bool by_id,
                               std::vector<Student>& students) {
  std::vector<Build> builds;
  for (std::size_t s = 0; s < students.size(); ++s) {
    const OwnFolders own = find_own_folders(students[s].folder, wanted, by_id, true);
    outputs::complain(own.notes);
    for (const std::string& name : wanted) {
      const auto found = own.folders.find(name);
      if (found == own.folders.end()) {
        students[s].programs.missing["lab/" + name] = no_program_text(name, students[s].folder);
        continue;
      }
      const auto known = std::find_if(builds.begin(), builds.end(), [&](const Build& b) {
        return b.student == s && b.folder == found->second;
      });
      if (known == builds.end())
        builds.push_back({s, found->second, {"lab/" + name}});
      else
        known->firmware.push_back("lab/" + name);
    }
  }
  return builds;
}

void build_all(const std::vector<Build>& builds, const twin::Options& options, double limit_s,
               const Setting& setting, std::vector<Student>& students,
               std::vector<std::vector<std::string>>& errors) {
  const auto build = [&](std::size_t i) {
    std::vector<std::string> wrong;
    twin::Options of_student = options;
    if (!options.within.empty()) of_student.within = students[builds[i].student].folder;
    const std::string image = build_own_program(builds[i].folder, of_student, wrong);
    return nlohmann::json{{"image", image}, {"errors", wrong}}.dump(-1, ' ', false,
                                                                    nlohmann::json::error_handler_t::replace);
  };
  run_contained(
      builds.size(), setting.jobs, limit_s, setting.is_over, build, [&](std::size_t i, const JobEnd& end) {
        Programs& programs = students[builds[i].student].programs;
        std::string why = end_text(end, limit_s), image;
        std::vector<std::string> wrong;
        if (why.empty()) {
          const auto told = nlohmann::json::parse(end.result);
          image = told["image"];
          wrong = told["errors"].get<std::vector<std::string>>();
        } else {
          wrong = lines_in(end.errors);
        }
        if (image.empty())
          errors[builds[i].student].insert(errors[builds[i].student].end(), wrong.begin(), wrong.end());
        for (const std::string& firmware : builds[i].firmware)
          if (image.empty())
            programs.broken[firmware] =
                builds[i].folder + " does not build" + (why.empty() ? "" : ": it " + why);
          else
            programs.images[firmware] = image;
      });
}

}  // namespace

bool is_class(const std::string& folder, const std::set<std::string>& known,
              const std::set<std::string>& wanted, bool by_id) {
  if (!find_own_folders(folder, known, by_id, false).folders.empty()) return false;
  for (const fs::path& student : folders_of(folder))
    if (!find_own_folders(student.string(), wanted, by_id, true).folders.empty()) return true;
  return false;
}

void try_class(const std::string& folder, const twin::Options& options, bool by_id, double limit_s,
               Class& all, const std::function<void(const Student&)>& row) {
  for (const fs::path& home : folders_of(folder))
    all.students.push_back({home.filename().string(), home.string(), {}, {}});
  const std::vector<Build> builds = find_builds(wanted_programs(all.exercises), by_id, all.students);
  std::vector<std::vector<std::string>> errors(all.students.size());
  build_all(builds, options, limit_s, all.setting, all.students, errors);

  Setting alone = all.setting;  // within one of the processes
  alone.jobs = 1;
  const std::size_t each = all.exercises.size();
  std::vector<std::size_t> open(all.students.size(), each);
  for (Student& student : all.students)
    for (const Exercise* e : all.exercises) {
      student.cells.emplace_back();
      student.cells.back().exercise = e;
      student.cells.back().verdict = Verdict::Open;  // unless it is tried, below
      student.cells.back().why = "interrupted";
    }
  const auto attempt = [&](std::size_t i) {
    return pack(try_exercise(*all.exercises[i % each], alone, all.students[i / each].programs,
                             [](const std::vector<std::string>&) {}));
  };
  std::size_t next_row = 0;
  run_contained(each * all.students.size(), all.setting.jobs, limit_s, all.setting.is_over, attempt,
                [&](std::size_t i, const JobEnd& end) {
                  Student& student = all.students[i / each];
                  Cell& cell = student.cells[i % each];
                  const std::string why = end_text(end, limit_s);
                  cell.why.clear();
                  if (!why.empty() || !unpack(end.result, alone, student.programs, cell)) {
                    cell.verdict = end.how == JobEnd::How::TimedOut ? Verdict::TimedOut : Verdict::Died;
                    cell.why = why.empty() ? "the simulator said nothing" : why;
                    cell.problems = lines_in(end.errors);
                  }
                  if (cell.verdict == Verdict::Broken) cell.problems = errors[i / each];
                  --open[i / each];
                  for (; next_row < open.size() && open[next_row] == 0; ++next_row)
                    row(all.students[next_row]);
                });
  for (; next_row < open.size(); ++next_row) row(all.students[next_row]);
}

std::string shell_word(const std::string& word) {
  const bool is_plain_word =
      !word.empty() && word.find_first_not_of(
                           "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                           "_-./:=+,@%") == std::string::npos;
  if (is_plain_word) return word;
  std::string quoted_word = "'";
  for (const char c : word) quoted_word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted_word + "'";
}

std::string replay_command(const Cell& cell, const std::string& mine, const std::string& options) {
  const std::string trial = telling_trial_name(cell);
  if (trial.empty()) return "";
  const std::string file = shell_word(cell.exercise->id);
  return "twinpuck lab --replay " + shell_word(trial) + (mine.empty() ? "" : " --mine " + shell_word(mine)) +
         (options.empty() ? "" : " " + options) + " --picture " + file + ".png --report " + file + ".html";
}

}  // namespace lab
