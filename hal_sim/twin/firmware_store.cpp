// SPDX-License-Identifier: MIT
// From what a user calls a firmware to an image file: a file as it is, a folder or a
// controller's name built first.
#include <cmath>
#include <filesystem>

#include "compiler/build/build.h"
#include "hal_sim/twin/firmware_store.h"
#include "install/cache_bound.h"
#include "install/places.h"
#include "sim_core/base/hash.h"
#include "sim_core/load/world_loader.h"

namespace twin {

namespace fs = std::filesystem;

namespace {

bool holds_c(const fs::path& folder) {
  std::error_code none;
  const auto skip = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it(folder, skip, none), end; !none && it != end; it.increment(none))
    for (const char* kind : {".c", ".C", ".cpp", ".cc", ".cxx"})
      if (it->path().extension() == kind) return true;
  return false;
}

// rooms of firmware/ that are no controllers
bool is_room(const std::string& name) {
  return name == "include" || name == "libc" || name == "library" || name == "webots" || name == "lab";
}

// Who runs a program, and from where in the project.
struct Runs {
  const char* what;
  const char* expected;
  std::vector<const char*> rooms;
};
const Runs kRobot{"firmware: got a name that is neither a file nor a controller",
                  "an image, a folder with C files, a program of the PC or a folder under firmware/",
                  {"firmware", "firmware/lab", "programs/supervisors"}};
const Runs kSupervisor{"supervisor: got a name that is neither a file nor a program",
                       "a program of the PC or one that `twinpuck list supervisors` shows",
                       {"programs/supervisors"}};

std::vector<std::string> program_names(const Runs& runs) {
  std::vector<std::string> names;
  std::error_code none;
  for (const char* room : runs.rooms)
    for (const auto& entry : fs::directory_iterator(places::share_root() / room, none))
      if (entry.is_directory(none) && !is_room(entry.path().filename().string()) && holds_c(entry.path()))
        names.push_back(entry.path().filename().string());
  return names;
}

}  // namespace

namespace {

/// As people say it: from the current folder on, if it lies in there.
std::string said_path(const fs::path& path) {
  std::error_code none;
  const fs::path whole = fs::weakly_canonical(path, none);
  const fs::path from_here = whole.lexically_relative(fs::current_path(none));
  const bool is_here = !from_here.empty() && *from_here.begin() != ".." && from_here != ".";
  return is_here ? "./" + from_here.string() : whole.string();
}

}  // namespace

std::string said(const Program& program) {
  std::string text = said_path(program.path);
  if (program.files > 0)
    text += ", " + std::to_string(program.files) + (program.files == 1 ? " file" : " files");
  if (!program.other.empty()) text += "; not " + said_path(program.other) + ", which has that name, too";
  return text;
}

std::string stored_controller(const std::string& name) {
  const fs::path firmware = places::share_root() / "firmware";
  const bool of_lab = name.rfind("lab/", 0) == 0;
  const std::string plain = of_lab ? name.substr(4) : name;
  if (plain.empty() || plain[0] == '.' || plain.find('/') != std::string::npos || is_room(plain)) return "";
  std::error_code none;
  // a controller of one's own in firmware/ goes before the lab's solution of that name
  if (!of_lab && fs::is_directory(firmware / plain, none)) return (firmware / plain).string();
  const fs::path solution = firmware / "lab" / plain;
  if (fs::is_directory(solution, none)) return solution.string();
  // supervisors have names of their own
  const fs::path supervisor = places::share_root() / "programs" / "supervisors" / plain;
  return !of_lab && fs::is_directory(supervisor, none) ? supervisor.string() : "";
}

std::string hal_of(const Options& options, const std::string& path) {
  constexpr const char* kUsual = "sim";
  if (!options.hal.empty()) return options.hal;
  return programs::is_pc_program(path) ? "" : kUsual;
}

namespace {

/// image_file(), of a program that `hal` is chosen for. `is_pc`: the folder holds one of the PC.
std::string image_file(const std::string& folder, const Options& options, const std::string& hal,
                       bool is_pc) {
  std::uint64_t h = 0;
  for (unsigned char c : fs::weakly_canonical(folder).string()) h = sim::mix64(h ^ c);
  char tag[32];
  std::snprintf(tag, sizeof tag, "-%08x", static_cast<unsigned>(h));
  std::string kind = options.sanitize ? "-sanitize" : !options.coverage.empty() ? "-coverage" : "";
  if (!hal.empty()) kind += "-" + hal;
  // the same program has another image in a world that says something else
  if (is_pc && !options.webots_settings.empty()) {
    std::uint64_t of_world = 0;
    for (unsigned char c : options.webots_settings) of_world = sim::mix64(of_world ^ c);
    std::snprintf(tag + 9, sizeof tag - 9, "-%06x", static_cast<unsigned>(of_world & 0xffffff));
  }
  return (places::cache_folder("images") / (fs::path(folder).filename().string() + tag + kind + ".elf"))
      .string();
}

/// A look at all files of the folder says so, and hal_of() has had one where the options name no HAL.
bool is_of_pc(const Options& options, const std::string& hal, const std::string& folder) {
  return options.hal.empty() ? hal.empty() : programs::is_pc_program(folder);
}

}  // namespace

std::string image_file(const std::string& folder, const Options& options) {
  const std::string hal = hal_of(options, folder);
  return image_file(folder, options, hal, !options.webots_settings.empty() && is_of_pc(options, hal, folder));
}

std::string webots_settings_of(const sim::WorldDesc& world) {
  constexpr double kUsualUnit_rad_s =
      0.00628;  // [Webots: e-puck of versions 6 to 8], as firmware/webots/wheels.c
  char text[300];
  const double unit = world.webots.speed_unit_rad_s;
  std::snprintf(text, sizeof text,
                "extern const float webots_world_speed_unit;\n"
                "extern const int webots_world_lab_order, webots_world_nue, webots_world_step_ms;\n"
                "const float webots_world_speed_unit = %.9gf;\nconst int webots_world_lab_order = %d;\n"
                "const int webots_world_nue = %d;\nconst int webots_world_step_ms = %d;\n",
                unit > 0 ? unit : kUsualUnit_rad_s, world.webots.sensor_order == "lab" ? 1 : 0,
                world.webots.axes == sim::Axes::Nue ? 1 : 0,
                int(std::lround(world.webots.time_step_s * 1000)));
  return text;
}

namespace {

std::string find_program(const std::string& name, const std::string& from_folder, const Runs& runs,
                         std::vector<std::string>& problems, std::string* other) {
  std::error_code none;
  if (name == kExtern) return name;
  const auto is_firmware = [&](const fs::path& p) {
    return fs::exists(p, none) &&
           (!fs::is_directory(p, none) || holds_c(p) || programs::is_pc_program(p.string()));
  };
  // beside the world, then here, then ours: who makes a folder of the name has it run
  fs::path path =
      fs::path(name).is_absolute() || from_folder.empty() ? fs::path(name) : fs::path(from_folder) / name;
  // a project of Webots has its worlds beside its controllers
  if (!is_firmware(path) && name.find('/') == std::string::npos)
    for (const char* controllers : {"controllers", "../controllers"})
      if (const fs::path of_project = fs::path(from_folder) / controllers / name;
          !is_firmware(path) && is_firmware(of_project))
        path = of_project.lexically_normal();
  if (!is_firmware(path)) {
    const std::string stored = stored_controller(name);
    if (is_firmware(name) || (stored.empty() && !fs::exists(path, none) && fs::exists(name, none)))
      path = name;
    else if (!stored.empty())
      path = stored;
  }
  std::error_code wrong;
  if (!fs::exists(path, wrong) && wrong && wrong != std::errc::no_such_file_or_directory &&
      wrong != std::errc::not_a_directory) {
    problems.push_back(path.string() + (&runs == &kRobot ? ": firmware: " : ": supervisor: ") +
                       wrong.message());
    return "";
  }
  if (!fs::exists(path, none)) {
    problems.push_back(name + ": " + runs.what + ", expected " + runs.expected +
                       sim::did_you_mean_tail(name, program_names(runs)));
    return "";
  }
  // "." and ".." are nobody's names
  if (!other || fs::path(name).filename().string().find_first_not_of('.') == std::string::npos)
    return path.string();
  const fs::path of_lab = places::share_root() / "firmware" / "lab" / name;
  const bool is_name = name.find('/') == std::string::npos;
  for (const fs::path& same : {fs::path(name), fs::path(stored_controller(name)), is_name ? of_lab : ""})
    if (other->empty() && !same.empty() && is_firmware(same) &&
        fs::weakly_canonical(same, none) != fs::weakly_canonical(path, none))
      *other = same.string();
  return path.string();
}

}  // namespace

std::string find_firmware(const std::string& name, const std::string& from_folder,
                          std::vector<std::string>& problems, std::string* other) {
  return find_program(name, from_folder, kRobot, problems, other);
}

std::string find_supervisor(const std::string& name, const std::string& from_folder,
                            std::vector<std::string>& problems) {
  return find_program(name, from_folder, kSupervisor, problems, nullptr);
}

std::string provide_image(const std::string& name, const std::string& from_folder, const Options& options,
                          std::vector<std::string>& problems, Program* program) {
  Program found;
  const fs::path path = found.path = find_firmware(name, from_folder, problems, &found.other);
  if (program) *program = found;
  std::error_code none;
  if (path.empty() || !fs::is_directory(path, none)) return path.string();
  const std::string hal = hal_of(options, path.string());
  if (hal.empty()) return path.string();
  cc::BuildOptions build;
  build.source_dir = path;
  build.output = image_file(path.string(), options, hal, is_of_pc(options, hal, path.string()));
  build.optimisation = options.optimisation;
  // so that each line has code of its own, and each condition its branch
  if (!options.coverage.empty() && build.optimisation.empty()) build.optimisation = "-O0";
  build.sanitize = options.sanitize;
  build.hal = hal;
  build.within = options.within;
  build.webots_settings = options.webots_settings;
  places::note_used(build.output);
  const cc::BuildResult result = cc::build_image(build);
  if (program) program->files = result.files;
  if (options.tell)
    for (const auto& w : result.warnings) options.tell(w);
  if (options.tell)
    for (const auto* lines : {&result.conflicts, &result.notes})
      for (const auto& line : *lines) options.tell(line);
  if (options.no_room && !result.no_room.empty()) options.no_room();
  if (!result.ok) {
    problems.insert(problems.end(), result.errors.begin(), result.errors.end());
    return "";
  }
  return build.output.string();
}

bool provide_launch(const std::string& name, const std::string& from_folder, const Options& options,
                    std::vector<std::string>& problems, programs::Launch& launch) {
  const std::string path = find_supervisor(name, from_folder, problems);
  return !path.empty() &&
         programs::prepare(path, places::cache_folder("programs").string(), options.tell, problems, launch);
}

}  // namespace twin
