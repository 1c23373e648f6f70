// SPDX-License-Identifier: MIT
#include "exercises/mine.h"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "outputs/complain.h"
#include "programs/build/build.h"

namespace lab {

namespace {

namespace fs = std::filesystem;

constexpr int kDeepestLook = 6;  // folders within one another that students hand in

bool has_c_files(const fs::path& folder) {
  std::error_code none;
  for (fs::directory_iterator it(folder, none), end; !none && it != end; it.increment(none))
    if (it->path().extension() == ".c") return true;
  return false;
}

/// Folders of these names with C files below `home`: depth and path, the highest first.
std::map<std::string, std::vector<std::pair<int, fs::path>>> named_below(
    const fs::path& home, const std::set<std::string>& wanted) {
  std::map<std::string, std::vector<std::pair<int, fs::path>>> found;
  std::error_code wrong;
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it(home, options, wrong), end; !wrong && it != end;
       it.increment(wrong)) {
    std::error_code none;
    const std::string name = it->path().filename().string();
    if (!it->is_directory(none)) continue;
    if (name[0] == '.' || it.depth() >= kDeepestLook) it.disable_recursion_pending();
    if (wanted.count(name) && has_c_files(it->path())) found[name].emplace_back(it.depth(), it->path());
  }
  for (auto& [name, places] : found) std::sort(places.begin(), places.end());
  return found;
}

}  // namespace

std::vector<Exercise> own_exercises(std::vector<Exercise> all) {
  for (Exercise& e : all)
    e.steps.erase(
        std::remove_if(e.steps.begin(), e.steps.end(), [](const Step& s) { return own_program(s).empty(); }),
        e.steps.end());
  all.erase(std::remove_if(all.begin(), all.end(), [](const Exercise& e) { return e.steps.empty(); }),
            all.end());
  return all;
}

std::set<std::string> wanted_programs(const std::vector<const Exercise*>& chosen) {
  std::set<std::string> wanted;
  for (const Exercise* e : chosen)
    for (const Step& s : e->steps)
      if (!own_program(s).empty()) wanted.insert(own_program(s));
  return wanted;
}

OwnFolders find_own_folders(const std::string& folder, const std::set<std::string>& wanted, bool by_id,
                            bool deep) {
  OwnFolders own;
  std::error_code none;
  const fs::path home = fs::canonical(folder, none);
  // a project of Webots keeps them in `controllers`
  for (const fs::path& place : {home, home / "controllers"})
    for (const std::string& name : wanted)
      if (!own.folders.count(name) && has_c_files(place / name)) own.folders[name] = (place / name).string();
  // a controller's folder, unless it holds folders of the lab's names
  if (own.folders.empty() && has_c_files(home)) {
    for (const std::string& name : wanted)
      if (by_id || home.filename() == name) own.folders[name] = home.string();
    return own;
  }
  if (!deep) return own;
  for (const auto& [name, places] : named_below(home, wanted)) {
    if (own.folders.count(name)) continue;
    own.folders[name] = places.front().second.string();
    if (places.size() > 1 && places[0].first == places[1].first)
      own.notes.push_back(folder + ": got several folders '" + name + "', expected one; " +
                          places[0].second.lexically_relative(home).string() + " is taken, not " +
                          places[1].second.lexically_relative(home).string());
  }
  return own;
}

std::string build_own_program(const std::string& folder, const twin::Options& options,
                              std::vector<std::string>& errors) {
  const std::size_t before = errors.size();
  const std::string image = twin::provide_image(folder, "", options, errors);
  if (errors.size() != before) return "";
  return programs::is_pc_program(folder) ? folder : image;
}

std::string no_program_text(const std::string& name, const std::string& home) {
  return "no program '" + name + "' in " + home;
}

Programs own_programs(const std::string& home, twin::Options options,
                      const std::vector<const Exercise*>& chosen, bool by_id, bool deep) {
  const auto wanted = wanted_programs(chosen);
  const OwnFolders own = find_own_folders(home, wanted, by_id, deep);
  outputs::complain(own.notes);
  Programs programs;
  options.tell = [](const std::string& line) { std::cerr << line << '\n'; };
  std::map<std::string, std::string> built;  // one folder may serve several names
  for (const std::string& name : wanted) {
    const std::string firmware = "lab/" + name;
    const auto folder = own.folders.find(name);
    if (folder == own.folders.end()) {
      programs.missing[firmware] = no_program_text(name, home);
      continue;
    }
    if (!built.count(folder->second)) {
      std::vector<std::string> errors;
      built[folder->second] = build_own_program(folder->second, options, errors);
      outputs::complain(errors);
    }
    const std::string& image = built[folder->second];
    if (image.empty())
      programs.broken[firmware] = folder->second + " does not build";
    else
      programs.images[firmware] = image;
  }
  return programs;
}

Programs reference_programs(const std::vector<const Exercise*>& chosen, twin::Options options,
                            std::vector<std::string>& problems) {
  Programs programs;
  options.tell = [](const std::string& line) { std::cerr << line << '\n'; };
  for (const Exercise* e : chosen)
    for (const Step& s : e->steps) {
      if (s.firmware.empty() || programs.images.count(s.firmware)) continue;
      if (!own_program(s).empty() && twin::stored_controller(s.firmware).empty())
        programs.missing[s.firmware] =
            "its solution is not in this edition of Twinpuck; --mine DIR runs a program of yours";
      else
        programs.images[s.firmware] = twin::provide_image(s.firmware, "", options, problems);
    }
  return programs;
}

}  // namespace lab
