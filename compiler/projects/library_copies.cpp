// SPDX-License-Identifier: MIT
// See library_copies.h. The names are those of the library's C sources, of 2006 to 2017; its assembler
// sources are never compiled.
#include "library_copies.h"

#include <algorithm>
#include <tuple>

#include "compiler/cache/object_cache.h"
#include "sim_core/base/pattern.h"

namespace cc {
namespace fs = std::filesystem;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

namespace {

constexpr const char* kLibrarySources[] = {
    "a_d/advance_ad_scan/e_acc.c",
    "a_d/advance_ad_scan/e_ad_conv.c",
    "a_d/advance_ad_scan/e_micro.c",
    "a_d/advance_ad_scan/e_prox.c",
    "a_d/e_accelerometer.c",
    "a_d/e_ad_conv.c",
    "a_d/e_micro.c",
    "a_d/e_prox.c",
    "a_d/e_prox_timer2.c",
    "acc_gyro/e_lsm330.c",
    "bluetooth/e_bluetooth.c",
    "camera/fast_2_timer/e_calc.c",
    "camera/fast_2_timer/e_calc_po3030.c",
    "camera/fast_2_timer/e_calc_po3030k.c",
    "camera/fast_2_timer/e_calc_po6030k.c",
    "camera/fast_2_timer/e_calc_po8030d.c",
    "camera/fast_2_timer/e_common.c",
    "camera/fast_2_timer/e_po3030k_registers.c",
    "camera/fast_2_timer/e_po6030k_registers.c",
    "camera/fast_2_timer/e_po8030d_registers.c",
    "camera/fast_2_timer/e_registers.c",
    "camera/fast_2_timer/e_timers.c",
    "camera/slow_3_timer/e_calc.c",
    "camera/slow_3_timer/e_registers.c",
    "camera/slow_3_timer/e_timers.c",
    "codec/e_sound.c",
    "contrib/LIS_sensors_turret/e_devantech.c",
    "contrib/LIS_sensors_turret/e_sensext.c",
    "contrib/LIS_sensors_turret/e_sharp.c",
    "contrib/SWIS_com_module/ComModule.c",
    "fft/e_fft.c",
    "fft/e_input_signal.c",
    "fft/e_twiddle_factors.c",
    "I2C/e_I2C_master_module.c",
    "I2C/e_I2C_protocol.c",
    "matlab/matlab.c",
    "motor_led/advance_one_timer/e_agenda.c",
    "motor_led/advance_one_timer/e_led.c",
    "motor_led/advance_one_timer/e_motors.c",
    "motor_led/advance_one_timer/e_remote_control.c",
    "motor_led/advance_one_timer/fast_agenda/e_agenda_fast.c",
    "motor_led/advance_one_timer/fast_agenda/e_led.c",
    "motor_led/advance_one_timer/fast_agenda/e_motors.c",
    "motor_led/e_init_port.c",
    "motor_led/e_led.c",
    "motor_led/e_motors.c",
    "motor_led/e_motors_timer3.c",
    "utility/utility.c",
};

bool ends_with(const std::string& text, const std::string& tail) {
  return text.size() >= tail.size() && text.compare(text.size() - tail.size(), tail.size(), tail) == 0;
}

/// The library's path at the end of `below` (a path below the project's folder), "" for none. Longest first,
/// so that "a_d/e_prox.c" is not found in "advance_ad_scan/e_prox.c".
std::string place_below(const std::string& below) {
  std::string best;
  for (const char* path : kLibrarySources)
    if (ends_with("/" + below, "/" + lower(path)) && std::string(path).size() > best.size()) best = path;
  return best;
}

bool has_library_name(const std::string& name) {
  for (const char* path : kLibrarySources)
    if (lower(fs::path(path).filename().string()) == name) return true;
  return false;
}

const std::regex& camera_files() {
  static const sim::Pattern kCamera(R"(e_(calc|registers|timers|common|po\d+[kd]_registers|calc_po\w+)\.c)");
  return kCamera;
}

/// Whether a file speaks of the camera's sensor, whatever its name.
bool speaks_of_camera(const std::string& text) {
  static const sim::Pattern kCameraText(R"(po(3030k|6030k|8030d|xxxx))", std::regex::icase);
  return std::regex_search(text, kCameraText);
}

// a driver of which the original has the handler in assembler, and its C files
struct HalfInAssembler {
  const char* folder;
  const char* handler;
};
constexpr HalfInAssembler kHalves[] = {{"camera/fast_2_timer/", "_T4Interrupt"}, {"codec/", "_DCIInterrupt"}};
constexpr const char* kSlowCamera = "camera/slow_3_timer/";

/// The library's folder of a source, "camera/fast_2_timer/"; of a camera's file beside main.c that of the
/// fast driver, which is the usual one, unless it has the slow driver's handlers.
std::string driver_folder(const fs::path& source, const std::string& below) {
  const std::string place = place_below(lower(below));
  if (!place.empty()) return place.substr(0, place.rfind('/') + 1);
  const std::string name = lower(source.filename().string());
  if (name == "e_sound.c") return "codec/";
  if (std::regex_match(name, camera_files()) && speaks_of_camera(read_text(source))) return kHalves[0].folder;
  return "";
}

/// Takes from the members those drivers of which only one half is C.
void leave_out_half_drivers(const fs::path& project, const std::set<fs::path>& unlisted,
                            const std::vector<fs::path>& assembler, LibraryCopies& split) {
  std::vector<std::pair<fs::path, std::string>> folders;  // source, its driver
  for (const fs::path& source : split.members)
    folders.emplace_back(source, driver_folder(source, source.lexically_relative(project).generic_string()));
  std::set<std::string> ours;
  for (const HalfInAssembler& half : kHalves) {
    bool is_there = false, is_whole = false;
    for (const auto& [source, folder] : folders) {
      if (folder != half.folder) continue;
      is_there = true;
      const sim::Pattern definition(std::string(half.handler) + R"(\s*\([^;{}]*\)\s*\{)");
      is_whole = is_whole || std::regex_search(without_comments(read_text(source)), definition);
    }
    for (const fs::path& file : assembler) {
      const auto names = functions_in_assembler(file);
      is_whole = is_whole || std::find(names.begin(), names.end(), half.handler) != names.end();
    }
    // a handler of the program's own is the other half, too
    for (const fs::path& source : split.kept)
      is_whole =
          is_whole ||
          (is_there && std::regex_search(without_comments(read_text(source)),
                                         sim::Pattern(std::string(half.handler) + R"(\s*\([^;{}]*\)\s*\{)")));
    if (is_there && !is_whole) ours.insert(half.folder);
  }
  // the slow driver stays where the project lists it alone, or the program asks for it by its folder's name
  if (ours.count(kHalves[0].folder)) {
    const auto is_listed = [&](const std::string& driver) {
      return std::any_of(folders.begin(), folders.end(),
                         [&](const auto& f) { return f.second == driver && !unlisted.count(f.first); });
    };
    bool is_slow_wanted = !unlisted.empty() && is_listed(kSlowCamera) && !is_listed(kHalves[0].folder);
    for (const fs::path& source : split.kept)
      is_slow_wanted = is_slow_wanted || read_text(source).find("slow_3_timer") != std::string::npos;
    if (!is_slow_wanted) ours.insert(kSlowCamera);
  }
  for (const auto& [source, folder] : folders) {
    if (!ours.count(folder)) continue;
    split.left_out.push_back(source);
    split.members.erase(std::find(split.members.begin(), split.members.end(), source));
  }
}

}  // namespace

std::string without_comments(const std::string& text) {
  static const sim::Pattern kComment(R"(/\*[^*]*\*+(?:[^/*][^*]*\*+)*/|//[^\n]*)");
  return std::regex_replace(text, kComment, " ");
}

std::string library_place(const fs::path& source) { return place_below(lower(source.generic_string())); }

LibraryCopies find_library_members(const fs::path& project, const std::vector<fs::path>& sources,
                                   const std::set<fs::path>& unlisted,
                                   const std::vector<fs::path>& assembler) {
  LibraryCopies split;
  for (const fs::path& source : sources)
    (has_library_name(lower(source.filename().string())) ? split.members : split.kept).push_back(source);
  // a project that has nothing of its own is no project of copies
  static const sim::Pattern kMain(R"(\bmain\s*\()");
  for (std::size_t i = 0; i < split.members.size();) {
    if (std::regex_search(without_comments(read_text(split.members[i])), kMain)) {
      split.kept.push_back(split.members[i]);
      split.members.erase(split.members.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
  leave_out_half_drivers(project, unlisted, assembler, split);
  std::set<std::string> included;  // last two parts of every #include: "a_d/e_prox.h", "e_led.h"
  static const sim::Pattern kInclude(R"(#\s*include\s*[<"]([^>"]+)[>"])");
  for (const fs::path& source : split.kept) {
    const std::string text = without_comments(read_text(source));
    for (std::sregex_iterator it(text.begin(), text.end(), kInclude), end; it != end; ++it) {
      std::string name = lower((*it)[1]);
      std::replace(name.begin(), name.end(), '\\', '/');
      included.insert((fs::path(name).parent_path().filename() / fs::path(name).filename()).generic_string());
    }
  }
  const auto rank = [&](const fs::path& source) {
    const std::string below = lower(source.lexically_relative(project).generic_string());
    fs::path header = fs::path(below).replace_extension(".h");
    const bool is_wanted =
        included.count((header.parent_path().filename() / header.filename()).generic_string()) > 0;
    const bool is_advanced = below.find("advance") != std::string::npos;
    const auto depth = std::count(below.begin(), below.end(), '/');
    return std::make_tuple(!is_wanted, !is_advanced, depth, below);
  };
  std::sort(split.members.begin(), split.members.end(),
            [&](const fs::path& a, const fs::path& b) { return rank(a) < rank(b); });
  return split;
}

bool is_library_assembler(const fs::path& file) {
  static const sim::Pattern kNames(
      R"((e_(interrupt|isr_dci|init_codec_slave|init_dci_master|sub_dci_kickoff|const_sound|init_uart[12]|)"
      R"(uart[12]_[rt]x_char\w*|fast_copy|subtract_mean)|dataeeprom)\.s)");
  return std::regex_match(lower(file.filename().string()), kNames);
}

bool is_in_library_folder(const fs::path& assembler) {
  const std::string folder = lower(assembler.parent_path().filename().string());
  return folder == "codec" || folder == "uart" || folder == "fft" || folder == "fast_2_timer";
}

std::vector<std::string> functions_in_assembler(const fs::path& file) {
  static const sim::Pattern kGlobal(R"((^|\n)[ \t]*\.glob(a)?l[ \t]+_(\w+))");
  const std::string text = read_text(file);
  std::vector<std::string> names;
  for (std::sregex_iterator it(text.begin(), text.end(), kGlobal), end; it != end; ++it)
    names.push_back((*it)[3]);
  return names;
}

namespace {

std::string shown(const fs::path& project, const std::vector<fs::path>& files) {
  std::string list;
  constexpr std::size_t kShown = 4;
  for (std::size_t i = 0; i < files.size() && i < kShown; ++i)
    list += (i ? ", " : "") + files[i].lexically_relative(project).generic_string();
  if (files.size() > kShown) list += " and " + std::to_string(files.size() - kShown) + " more";
  return list;
}

}  // namespace

std::string library_copies_message(const fs::path& project, const LibraryCopies& copies) {
  if (copies.left_out.empty()) return "";
  return project.string() + ": copy of the e-puck library: got " + shown(project, copies.left_out) +
         ", drivers whose other half is assembler, which the project does not have; Twinpuck's own drivers "
         "are "
         "used in their place, changes made in them have no effect";
}

}  // namespace cc
