// SPDX-License-Identifier: MIT
// From what a user calls a firmware to an image file: a .so as it is, a folder or a controller's name built
// first.
#include <unistd.h>

#include <climits>
#include <cstdlib>
#include <filesystem>

#include "hal_sim/cc/build.h"
#include "hal_sim/twin/twin.h"
#include "sim_core/base/hash.h"
#include "sim_core/load/world_loader.h"
#include "twinpuck_paths.h"

namespace twin {

namespace fs = std::filesystem;

namespace {

bool holds_c(const fs::path& folder) {
  std::error_code none;
  const auto skip = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it(folder, skip, none), end; !none && it != end; it.increment(none))
    if (it->path().extension() == ".c" || it->path().extension() == ".C") return true;
  return false;
}

std::vector<std::string> controller_names() {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(fs::path(project_root()) / "firmware", none))
    if (entry.is_directory(none) && entry.path().filename() != "include" &&
        entry.path().filename() != "webots")
      names.push_back(entry.path().filename().string());
  return names;
}

}  // namespace

std::string project_root() {
  if (const char* root = std::getenv("TWINPUCK_ROOT")) return root;
  std::error_code none;
  for (fs::path at = fs::read_symlink("/proc/self/exe", none).parent_path(); at.has_relative_path();
       at = at.parent_path())
    if (fs::exists(at / "firmware" / "include")) return at.string();
  return TWINPUCK_SOURCE_DIR;
}

std::string build_folder() {
  std::error_code none;
  const fs::path here = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const fs::path& folder : {here, here.parent_path()})
    if (fs::exists(folder / "twinpuck-cc")) return folder.string();
  return (fs::path(project_root()) / "build").string();
}

std::string image_file(const std::string& folder, const Options& options) {
  std::uint64_t h = 0;
  for (unsigned char c : fs::weakly_canonical(folder).string()) h = sim::mix64(h ^ c);
  char tag[20];
  std::snprintf(tag, sizeof tag, "-%08x", static_cast<unsigned>(h));
  std::string kind = options.sanitize ? "-sanitize" : options.coverage ? "-coverage" : "";
  if (options.way == "register") kind += "-register";
  return (fs::path(build_folder()) / "controllers" /
          (fs::path(folder).filename().string() + tag + kind + ".so"))
      .string();
}

std::string find_firmware(const std::string& name, const std::string& from_folder,
                          std::vector<std::string>& problems) {
  fs::path path =
      fs::path(name).is_absolute() || from_folder.empty() ? fs::path(name) : fs::path(from_folder) / name;
  std::error_code none;
  if (!fs::exists(path, none) && fs::exists(name, none)) path = name;
  if (!fs::exists(path, none) || (fs::is_directory(path, none) && !holds_c(path))) {
    const fs::path controller = fs::path(project_root()) / "firmware" / name;
    if (name.find('/') == std::string::npos && fs::is_directory(controller, none)) path = controller;
  }
  if (!fs::exists(path, none)) {
    const std::string guess = sim::did_you_mean(name, controller_names());
    problems.push_back(name +
                       ": firmware: got a name that is neither a file nor a controller, expected a .so, a "
                       "folder with C files "
                       "or a folder under firmware/" +
                       (guess.empty() ? "" : "; did you mean '" + guess + "'?"));
    return "";
  }
  if (fs::is_directory(path, none) && !holds_c(path)) {
    problems.push_back(path.string() + ": firmware: got a folder without C files, expected at least one .c");
    return "";
  }
  return path.string();
}

std::string provide_image(const std::string& name, const std::string& from_folder, const Options& options,
                          std::vector<std::string>& problems) {
  const fs::path path = find_firmware(name, from_folder, problems);
  std::error_code none;
  if (path.empty() || !fs::is_directory(path, none)) return path.string();
  cc::BuildOptions build;
  build.source_dir = path;
  build.output = image_file(path.string(), options);
  build.optimisation = options.optimisation;
  build.sanitize = options.sanitize;
  build.coverage = options.coverage;
  build.register_way = options.way == "register";
  const cc::BuildResult result = cc::build_image(build);
  if (options.tell)
    for (const auto& w : result.warnings) options.tell(w);
  if (options.tell)
    for (const auto& c : result.conflicts) options.tell(c);
  if (options.no_room && !result.no_room.empty()) options.no_room();
  if (!result.ok) {
    problems.insert(problems.end(), result.errors.begin(), result.errors.end());
    return "";
  }
  return build.output.string();
}

}  // namespace twin
