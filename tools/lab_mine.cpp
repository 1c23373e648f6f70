// SPDX-License-Identifier: MIT
#include "tools/lab_mine.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>

#include "hal_sim/twin/twin.h"
#include "tools/command_line.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

bool has_c_files(const fs::path& folder) {
  std::error_code none;
  for (fs::directory_iterator it(folder, none), end; !none && it != end; it.increment(none))
    if (it->path().extension() == ".c") return true;
  return false;
}

}  // namespace

std::vector<LabExercise> own_exercises(std::vector<LabExercise> all) {
  for (LabExercise& e : all)
    e.steps.erase(std::remove_if(e.steps.begin(), e.steps.end(),
                                 [](const LabStep& s) { return own_program(s).empty(); }),
                  e.steps.end());
  all.erase(std::remove_if(all.begin(), all.end(), [](const LabExercise& e) { return e.steps.empty(); }),
            all.end());
  return all;
}

LabPrograms own_programs(const std::string& folder, twin::Options options,
                         const std::vector<const LabExercise*>& chosen, bool by_id) {
  std::set<std::string> wanted;
  for (const LabExercise* e : chosen)
    for (const LabStep& s : e->steps) wanted.insert(own_program(s));
  const fs::path home = fs::canonical(folder);
  // a controller's folder, unless it holds folders of the lab's names
  const bool is_controller = has_c_files(home) && std::none_of(wanted.begin(), wanted.end(), [&](auto& name) {
                               return has_c_files(home / name);
                             });
  LabPrograms programs;
  options.tell = [](const std::string& line) { std::cerr << line << '\n'; };
  for (const std::string& name : wanted) {
    const std::string firmware = "lab/" + name;
    const fs::path own = is_controller ? home : home / name;
    if (!has_c_files(own) || (is_controller && !by_id && home.filename() != name)) {
      programs.missing[firmware] = "no program '" + name + "' in " + folder;
      continue;
    }
    std::vector<std::string> errors;
    const std::string image = twin::provide_image(own.string(), "", options, errors);
    complain(errors);
    if (errors.empty())
      programs.images[firmware] = image;
    else
      programs.broken[firmware] = own.string() + " does not build";
  }
  return programs;
}

}  // namespace tools
