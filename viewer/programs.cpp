// SPDX-License-Identifier: MIT
#include "viewer/programs.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

namespace viewer {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

using Json = nlohmann::json;
using Wall = std::chrono::steady_clock;

/// "12" at the place, which moves behind its colon; 0: there is none.
int number_at(const std::string& line, std::size_t& at) {
  std::size_t end = at;
  int number = 0;
  while (end < line.size() && end < at + 8 && std::isdigit(static_cast<unsigned char>(line[end])))
    number = 10 * number + (line[end++] - '0');
  if (end == at || end >= line.size() || line[end] != ':') return 0;
  at = end + 1;
  return number;
}

/// Name of a path among a program's files; the path itself where it is none of them.
std::string own_name(const Sources& sources, const std::string& path) {
  const std::string& folder = sources.folder();
  const bool is_below = !folder.empty() && path.compare(0, folder.size() + 1, folder + "/") == 0;
  return is_below ? path.substr(folder.size() + 1) : path;
}

Json findings_json(const Programs::Program& program) {
  Json out = Json::array();
  const auto add = [&](const std::vector<std::string>& lines, const char* kind) {
    for (const std::string& line : lines) {
      const Finding f = finding_of(line, kind);
      out.push_back({{"kind", f.kind},
                     {"file", own_name(program.sources, f.file)},
                     {"line", f.line},
                     {"column", f.column},
                     {"text", f.text}});
    }
  };
  add(program.problems, "error");
  add(program.warnings, "warning");
  return out;
}

}  // namespace

Finding finding_of(const std::string& line, const std::string& kind) {
  Finding finding{kind, "", 0, 0, line};
  for (std::size_t colon = line.find(':'); colon != std::string::npos; colon = line.find(':', colon + 1)) {
    std::size_t at = colon + 1;
    const int number = number_at(line, at);
    if (number == 0) continue;
    finding.file = line.substr(0, colon);
    finding.line = number;
    finding.column = number_at(line, at);
    at = std::min(line.find_first_not_of(' ', at), line.size());
    for (const char* known : {"error", "warning", "note"})
      if (const std::string word = std::string(known) + ": "; line.compare(at, word.size(), word) == 0) {
        finding.kind = known;
        at += word.size();
      }
    finding.text = line.substr(at);
    break;
  }
  return finding;
}

void Programs::forget() {
  if (build_.valid()) build_.get();
}

Programs::Program* Programs::find(const std::string& name) {
  for (Program& program : programs_)
    if (program.name == name) return &program;
  return nullptr;
}

Programs::Program& Programs::named(const std::string& name, const std::string& folder) {
  if (Program* program = find(name)) return *program;
  std::vector<std::string> none;
  programs_.push_back({name, {}, Sources(twin::find_firmware(name, folder, none)), false, {}, false, {}, {}});
  return programs_.back();
}

void Programs::take_opening(const std::vector<std::string>& problems, const std::vector<std::string>& told) {
  for (Program& program : programs_) {
    program.problems.clear();
    program.warnings.clear();
    const auto take = [&](const std::vector<std::string>& from, std::vector<std::string>& into) {
      for (const std::string& lines : from)
        for (std::size_t at = 0; at < lines.size();) {
          const std::size_t end = std::min(lines.find('\n', at), lines.size());
          const std::string line = lines.substr(at, end - at);
          const std::string file = finding_of(line, "").file;
          if (own_name(program.sources, file) != file) into.push_back(line);
          at = end + 1;
        }
    };
    take(problems, program.problems);
    take(told, program.warnings);
    program.is_built = problems.empty() || !program.problems.empty();
  }
}

std::vector<Programs::Change> Programs::look() {
  std::vector<Change> changes;
  for (Program& program : programs_)
    for (auto& [file, base] : program.sources.changes()) {
      changes.push_back({program.name, file, base});
      program.stale |= !program.robots.empty();
    }
  return changes;
}

Programs::Program* Programs::next_to_build() {
  if (build_.valid()) return nullptr;
  for (Program& program : programs_)
    if (program.stale || !program.waiting.empty()) return &program;
  return nullptr;
}

void Programs::build(Program& program, twin::Options options) {
  Built begun;
  begun.name = program.name;
  begun.for_all = program.stale;
  begun.robots.swap(program.waiting);
  program.stale = false;
  build_ = std::async(std::launch::async, [options, begun]() mutable {
    Built built = std::move(begun);
    const auto begin = Wall::now();
    options.tell = [&built](const std::string& line) { built.warnings.push_back(line); };
    built.path = twin::provide_image(built.name, options.world_folder, options, built.problems);
    built.took_s = std::chrono::duration<double>(Wall::now() - begin).count();
    return built;
  });
}

std::optional<Programs::Built> Programs::take_built() {
  if (!build_.valid() || build_.wait_for(0s) != std::future_status::ready) return std::nullopt;
  Built built = build_.get();
  if (Program* program = find(built.name)) {
    program->is_built = true;
    program->problems = built.problems;
    program->warnings = built.warnings;
    if (built.for_all)
      built.robots.insert(built.robots.end(), program->robots.begin(), program->robots.end());
  }
  return built;
}

void Programs::shift_robot(int robot, Program& to) {
  for (Program& other : programs_)
    other.robots.erase(std::remove(other.robots.begin(), other.robots.end(), robot), other.robots.end());
  to.robots.push_back(robot);
}

Json Programs::json(const twin::Twin* twin) const {
  Json out = Json::array();
  for (const Program& program : programs_) {
    Json robots = Json::array();
    for (const int r : program.robots)
      if (twin && r < twin->robots())
        robots.push_back(twin->world().robots[static_cast<std::size_t>(r)].name);
    out.push_back({{"name", program.name},
                   {"robots", robots},
                   {"folder", program.sources.folder()},
                   {"files", program.sources.files()},
                   {"built", program.is_built},
                   {"ok", program.problems.empty()},
                   {"findings", findings_json(program)}});
  }
  return out;
}

}  // namespace viewer
