// SPDX-License-Identifier: MIT
#include "exercises/class_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "sim_core/base/utf8.h"

namespace lab {

namespace {

/// Characters, of which one in UTF-8 may have several bytes.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width) {
  const std::size_t has = width_of(text);
  return text + std::string(has < width ? width - has : 0, ' ');
}

std::size_t column_width(const Exercise& e) { return std::max<std::size_t>(4, e.id.size()); }

/// As text of XML and HTML, in attributes, too: bytes that neither has become '?'.
std::string marked_up(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    const std::size_t length = sim::utf8_length(text, at);
    if (length > 1) {
      out += text.substr(at, length);
      at += length;
      continue;
    }
    ++at;
    const bool is_control = static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
    out += length == 0 || is_control ? "?"
           : c == '&'                ? "&amp;"
           : c == '<'                ? "&lt;"
           : c == '>'                ? "&gt;"
           : c == '"'                ? "&quot;"
                                     : std::string(1, c);
  }
  return out;
}

/// A cell of a CSV file.
std::string cell_text(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted_cell = "\"";
  for (const char c : text) quoted_cell += c == '"' ? "\"\"" : std::string(1, c);
  return quoted_cell + "\"";
}

/// What a look at a class asks of an exercise, by the first student who has it.
std::string asked_of(const Class& all, std::size_t exercise) {
  const Exercise& e = *all.exercises[exercise];
  std::string asked;
  if (all.setting.is_mine && e.id[0] == 'S') return "is looked at";
  for (const Step& step : e.steps) {
    const std::string one = asked_by(step, trials_of(step, all.setting, {}).size());
    if (!one.empty()) asked += (asked.empty() ? "" : "; ") + one;
  }
  return asked.empty() ? "is looked at" : asked;
}

std::string problems_of(const Cell& cell) {
  std::string text;
  for (const std::string& line : cell.problems)
    text += line + (!line.empty() && line.back() == '\n' ? "" : "\n");
  return text;
}

/// "bob I1 FAIL: 0 of 4 ..."; the first line of a compiler or trap; the command. One text for all exercises
/// with a program that does not build; empty: an exercise before has told it. `says_problem`: with what the
/// compiler said.
std::string failure_text(const Class& all, const Student& student, const Cell& cell, bool says_problem) {
  std::string ids;
  for (const Cell& other : student.cells) {
    const bool is_same = &other == &cell || (cell.verdict == Verdict::Broken &&
                                             other.verdict == cell.verdict && other.why == cell.why);
    if (is_same && ids.empty() && &other != &cell) return "";
    if (is_same) ids += (ids.empty() ? "" : ", ") + other.exercise->id;
  }
  std::string text = fmt::format("{} {} FAIL: {}\n", student.name, ids, to_text(cell, all.setting, false));
  // a trap has two lines, the second of which says where
  const std::string problem = cell.problems.empty() || !says_problem ? "" : cell.problems.front();
  for (std::size_t at = 0, end; at < problem.size(); at = end + 1) {
    end = std::min(problem.find('\n', at), problem.size());
    if (end > at) text += "  " + problem.substr(at, end - at) + "\n";
  }
  const std::string command = replay_command(cell, student.folder, all.options);
  return text + (command.empty() ? "" : "  " + command + "\n");
}

}  // namespace

Points points_of(const Student& student) {
  Points points;
  for (const Cell& cell : student.cells) {
    const bool seen = cell.verdict == Verdict::Seen || cell.exercise->id[0] == 'S';
    points.passed += cell.verdict == Verdict::Pass;
    points.judged += !seen;
  }
  return points;
}

std::string class_header(const Class& all, std::size_t name_width) {
  std::string line = padded("student", name_width);
  for (const Exercise* e : all.exercises) line += "  " + padded(e->id, column_width(*e));
  return line + "  passed\n";
}

std::string class_row(const Class& all, const Student& student, std::size_t name_width) {
  std::string line = padded(student.name, name_width);
  for (std::size_t i = 0; i < student.cells.size(); ++i)
    line += "  " + padded(verdict_text(student.cells[i].verdict), column_width(*all.exercises[i]));
  const Points points = points_of(student);
  return line + fmt::format("  {} of {}\n", points.passed, points.judged);
}

std::string class_notes(const Class& all) {
  std::string text;
  for (std::size_t i = 0; i < all.exercises.size(); ++i)
    text += fmt::format("{}: {}: {}\n", all.exercises[i]->id, all.exercises[i]->title, asked_of(all, i));
  for (const Student& student : all.students)
    for (const Cell& cell : student.cells)
      if (is_failure(cell.verdict)) text += failure_text(all, student, cell, true);
  return text;
}

std::string class_csv(const Class& all) {
  std::string text = "student";
  for (const Exercise* e : all.exercises) text += "," + cell_text(e->id);
  text += ",passed,judged\n";
  for (const Student& student : all.students) {
    text += cell_text(student.name);
    for (const Cell& cell : student.cells) text += std::string(",") + verdict_text(cell.verdict);
    const Points points = points_of(student);
    text += fmt::format(",{},{}\n", points.passed, points.judged);
  }
  return text;
}

std::string class_runs_csv(const Class& all) {
  std::string text = "student," + csv_header();
  for (const Student& student : all.students)
    for (const Cell& cell : student.cells)
      for (const StepResult& step : cell.steps) {
        const std::string rows = csv_rows(cell.exercise->id, step);
        for (std::size_t at = 0, end; at < rows.size(); at = end + 1) {
          end = rows.find('\n', at);
          text += cell_text(student.name) + "," + rows.substr(at, end - at) + "\n";
        }
      }
  return text;
}

std::string class_html(const Class& all, const std::string& title) {
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>" +
                     marked_up(title) +
                     "</title>\n<style>\nbody { font-family: sans-serif; margin: 2em }\ntable { "
                     "border-collapse: collapse }\n"
                     "td, th { border: 1px solid #ccc; padding: .3em .6em; text-align: left }\n"
                     ".pass { background: #cfc } .FAIL { background: #fcc } .none { color: #888 }\n"
                     "pre { white-space: pre-wrap }\n</style>\n<h1>" +
                     marked_up(title) + "</h1>\n<table>\n<tr><th>student</th>";
  for (std::size_t i = 0; i < all.exercises.size(); ++i)
    page +=
        fmt::format("<th title=\"{}\">{}</th>", marked_up(all.exercises[i]->title + ": " + asked_of(all, i)),
                    marked_up(all.exercises[i]->id));
  page += "<th>passed</th></tr>\n";
  std::string failures;
  for (std::size_t s = 0; s < all.students.size(); ++s) {
    const Student& student = all.students[s];
    page += "<tr><th>" + marked_up(student.name) + "</th>";
    std::map<std::string, std::string> told_at;
    for (const Cell& cell : student.cells) {
      const char* const verdict = verdict_text(cell.verdict);
      const bool failed = is_failure(cell.verdict);
      // a program that does not build is told once, and all its exercises lead there
      const std::string text = failed ? failure_text(all, student, cell, false) : "";
      std::string& place = told_at[cell.why];
      if (!text.empty()) place = fmt::format("s{}-{}", s, marked_up(cell.exercise->id));
      page += fmt::format("<td class=\"{0}\" title=\"{1}\">{2}{0}{3}</td>", verdict,
                          marked_up(to_text(cell, all.setting, false)),
                          failed ? "<a href=\"#" + place + "\">" : "", failed ? "</a>" : "");
      if (!text.empty())
        failures += "<pre id=\"" + place + "\">" + marked_up(text + problems_of(cell)) + "</pre>\n";
    }
    const Points points = points_of(student);
    page += fmt::format("<td>{} of {}</td></tr>\n", points.passed, points.judged);
  }
  page += "</table>\n<ul>\n";
  for (std::size_t i = 0; i < all.exercises.size(); ++i)
    page += fmt::format("<li><b>{}</b> {}: {}</li>\n", marked_up(all.exercises[i]->id),
                        marked_up(all.exercises[i]->title), marked_up(asked_of(all, i)));
  return page + "</ul>\n" + failures + "</html>\n";
}

std::string class_junit(const Class& all) {
  std::string suites;
  int tests = 0, failures = 0, errors = 0, skipped = 0;
  for (const Student& student : all.students) {
    std::string cases;
    int failed = 0, broken = 0, absent = 0;
    for (const Cell& cell : student.cells) {
      const std::string text = marked_up(to_text(cell, all.setting, false)),
                        command = replay_command(cell, student.folder, all.options);
      cases += fmt::format("    <testcase classname=\"{}\" name=\"{} {}\">", marked_up(student.name),
                           marked_up(cell.exercise->id), marked_up(cell.exercise->title));
      if (cell.verdict == Verdict::None || cell.verdict == Verdict::Open) {
        ++absent;
        cases += "<skipped message=\"" + text + "\"/>";
      } else if (is_failure(cell.verdict)) {
        const bool is_error = cell.verdict != Verdict::Fail;
        const char* const kind = is_error ? "error" : "failure";
        ++(is_error ? broken : failed);
        cases +=
            fmt::format("<{0} message=\"{1}\">{2}</{0}>", kind, text, marked_up(problems_of(cell) + command));
      } else {
        cases += "<system-out>" + text + "</system-out>";
      }
      cases += "</testcase>\n";
    }
    const auto count = static_cast<int>(student.cells.size());
    suites += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\">\n{}  "
        "</testsuite>\n",
        marked_up(student.name), count, failed, broken, absent, cases);
    tests += count, failures += failed, errors += broken, skipped += absent;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"twinpuck lab\" tests=\"{}\" "
      "failures=\"{}\" "
      "errors=\"{}\" skipped=\"{}\">\n{}</testsuites>\n",
      tests, failures, errors, skipped, suites);
}

}  // namespace lab
