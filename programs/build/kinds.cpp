// SPDX-License-Identifier: MIT
// See kinds.h.
#include "kinds.h"

#include <elf.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <set>

#include "build.h"

namespace programs {
namespace {

#if defined(__x86_64__)
constexpr unsigned kMachine = EM_X86_64;
#elif defined(__aarch64__)
constexpr unsigned kMachine = EM_AARCH64;
#else
constexpr unsigned kMachine = EM_NONE;
#endif

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

/// Headers of Webots' interfaces; another folder may be called device/ as well.
bool is_webots_header(const std::string& name) {
  static const std::set<std::string> kDevice = {"accelerometer",
                                                "camera",
                                                "compass",
                                                "connector",
                                                "differential_wheels",
                                                "display",
                                                "distance_sensor",
                                                "emitter",
                                                "gps",
                                                "gripper",
                                                "gyro",
                                                "led",
                                                "light_sensor",
                                                "microphone",
                                                "pen",
                                                "radio",
                                                "receiver",
                                                "robot",
                                                "robot_types",
                                                "servo",
                                                "speaker",
                                                "supervisor",
                                                "supervisor_utils",
                                                "touch_sensor"};
  const std::size_t slash = name.find_first_of("/\\");
  if (slash == std::string::npos) return false;
  const std::string folder = lower_case(name.substr(0, slash));
  std::string rest = lower_case(name.substr(slash + 1));
  rest = rest.substr(0, rest.rfind('.'));
  return folder == "webots" || (folder == "device" && kDevice.count(rest));
}

/// Headers of the chip and of the e-puck's library.
bool is_chip_header(const std::string& name) {
  const std::string text = lower_case(name);
  for (const char* part : {"p30f", "libpic30", "e_epuck_ports", "e_init_port", "motor_led", "e_motors",
                           "e_uart", "e_led", "e_prox", "e_ad_conv", "e_agenda", "e_poxxxx", "twinpuck",
                           "e_acc", "e_micro", "e_sound", "e_i2c", "e_bluetooth"})
    if (contains(text, part)) return true;
  return text == "xc.h";
}

bool includes_chip(const std::string& text) {
  const auto names = includes_of(text);
  return std::any_of(names.begin(), names.end(), is_chip_header);
}

bool includes_webots_below(const fs::path& file, std::set<fs::path>& seen, int depth) {
  constexpr int kDeepest = 6;  // headers in headers
  if (depth > kDeepest || !seen.insert(file).second || seen.size() > kMostFiles) return false;
  for (const std::string& name : includes_of(text_of(file))) {
    if (is_webots_header(name)) return true;
    const fs::path beside = resolve(file.parent_path(), name);
    if (!beside.empty() && includes_webots_below(beside.lexically_normal(), seen, depth + 1)) return true;
  }
  return false;
}

/// A controller of this project has its test beside it.
bool is_own_test(const fs::path& file) {
  return file.filename() == "test.cpp" && contains(text_of(file), "tests/support/firmware_test.h");
}

/// So many bytes of it, or all that there are.
std::string head_of(const fs::path& file, std::size_t bytes) {
  std::error_code odd;
  if (!fs::is_regular_file(file, odd)) return "";
  std::string head(bytes, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(bytes));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head;
}

bool is_script(const fs::path& file) {
  if (head_of(file, 2) != "#!") return false;
  const std::string text = text_of(file);
  return text.rfind("#!", 0) == 0 && text.find('\0') == std::string::npos;
}

Found look_at_file(const fs::path& file) {
  Found found;
  found.folder = file.parent_path();
  found.main = file;
  const std::string kind = kind_of(file);
  if (kind == ".py")
    found.kind = Kind::Python;
  else if (kind == ".jar")
    found.kind = Kind::Jar;
  else if (kind == ".class")
    found.kind = Kind::Class;
  else if (kind == ".java")
    found.kind = Kind::Java;
  else if (kind == ".m" || kind == ".mlx")
    found.kind = Kind::Matlab;
  else if (is_cxx(file) || is_c(file))
    found.kind = includes_chip(text_of(file)) && !includes_webots(file) ? Kind::Firmware : Kind::Compiled;
  else if (is_native_program(file) || is_script(file))
    found.kind = Kind::Executable;
  else
    found.kind = Kind::Firmware;
  return found;
}

/// Files of a folder by what they are.
struct Contents {
  explicit Contents(const fs::path& folder) : names(names_of(folder)), home(folder) {
    for (const fs::path& file : files_below(folder)) {
      const bool is_top = file.parent_path() == folder;
      if ((is_c(file) || is_cxx(file)) && !is_own_test(file))
        (is_c(file) ? c : cxx).push_back(file);
      else if (is_header(file))
        headers.push_back(file);
      else if (is_top)
        others.push_back(file);
    }
  }
  /// The file in the folder itself that is named as the folder; empty: none.
  fs::path named(const char* ending) const {
    std::error_code none;
    for (const std::string& name : names)
      if (fs::is_regular_file(home / (name + ending), none)) return home / (name + ending);
    return {};
  }
  std::vector<fs::path> of_kind(const char* ending) const {
    std::vector<fs::path> some;
    std::copy_if(others.begin(), others.end(), std::back_inserter(some),
                 [&](const fs::path& file) { return kind_of(file) == ending; });
    return some;
  }
  std::vector<std::string> names;
  fs::path home;
  std::vector<fs::path> c, cxx, headers, others;
};

/// Of several Python files: the folder's, the usual ones, or the only one that is not there to be imported.
fs::path main_python(const Contents& in, std::string& why) {
  if (fs::path named = in.named(".py"); !named.empty()) return named;
  const auto files = in.of_kind(".py");
  if (files.size() == 1) return files[0];
  for (const char* usual : {"main.py", "__main__.py"})
    for (const fs::path& file : files)
      if (file.filename() == usual) return file;
  std::vector<fs::path> mains;
  for (const fs::path& file : files) {
    const std::string text = text_of(file);
    if (contains(text, "controller import") || contains(text, "import controller")) mains.push_back(file);
  }
  if (mains.size() == 1) return mains[0];
  why = "got " + std::to_string(files.size()) +
        " files in Python, expected one that is named as the folder: " + in.names[0] + ".py";
  return {};
}

Found look_at_folder(const fs::path& folder) {
  const Contents in(folder);
  Found found;
  found.folder = folder;
  // What lies in the folder.
  const auto is = [&](Kind kind, const fs::path& main) {
    found.kind = kind;
    found.main = main;
    return found;
  };
  const auto any = [](const std::vector<fs::path>& files, const auto& asks) {
    return std::any_of(files.begin(), files.end(), asks);
  };
  const bool has_code = !in.c.empty() || !in.cxx.empty();
  const fs::path python = in.named(".py");
  const fs::path makefile = makefile_of(folder);
  const std::string make = makefile.empty() ? "" : text_of(makefile);
  const bool is_webots_make =
      contains(make, "Makefile.include") || contains(make, "WEBOTS_HOME") || contains(make, "-lController");
  const bool is_webots = has_code && (any(in.c, includes_webots) || any(in.cxx, includes_webots) ||
                                      any(in.headers, includes_webots));
  const bool is_chip =
      any(in.c, [](const fs::path& file) { return includes_chip(text_of(file)); }) && !is_webots;

  // sources that are named as the folder go before all others, those with a Makefile first
  const bool has_named_code =
      !in.named(".c").empty() || !in.named(".cpp").empty() || !in.named(".cc").empty();
  if (!python.empty() && !is_chip && !(has_named_code && (is_webots_make || !makefile.empty())))
    return is(Kind::Python, python);
  if (is_webots || (has_code && is_webots_make)) return is(Kind::Compiled, {});
  if (is_chip) return is(Kind::Firmware, {});
  // Then what is named as the folder in other languages, and sources of any name.
  if (const fs::path java = in.named(".java"); !java.empty()) return is(Kind::Java, java);
  if (const fs::path jar = in.named(".jar"); !jar.empty()) return is(Kind::Jar, jar);
  if (const fs::path made = in.named(".class"); !made.empty()) return is(Kind::Class, made);
  const fs::path program = in.named("");
  const bool is_ready = !program.empty() && (is_native_program(program) || is_script(program));
  if (!in.cxx.empty()) return is(Kind::Compiled, {});
  if (!in.c.empty()) return is(is_ready ? Kind::Executable : Kind::Firmware, is_ready ? program : fs::path());
  if (is_webots_make && !is_ready && (contains(make, "C_SOURCES") || contains(make, "CXX_SOURCES")))
    return is(Kind::Compiled, {});
  if (!in.of_kind(".py").empty()) return is(Kind::Python, main_python(in, found.why));
  for (const auto& [ending, kind] : {std::pair(".java", Kind::Java), std::pair(".jar", Kind::Jar)})
    if (const auto files = in.of_kind(ending); files.size() == 1) return is(kind, files[0]);
  if (is_ready) return is(Kind::Executable, program);
  if (!in.of_kind(".m").empty()) return is(Kind::Matlab, in.of_kind(".m")[0]);
  // Nothing that runs here: say what it is instead.
  if (!in.of_kind(".bsg").empty())
    found.why = "got a program of BotStudio, expected one in C, C++, Python or Java; BotStudio is not run";
  else if (const fs::path windows = in.named(".exe"); !windows.empty())
    found.why = "got a program of Windows without its source, expected source or a program of this machine";
  else if (!program.empty())
    found.why =
        "got a program of another machine without its source, expected source or a program of this machine";
  for (const fs::path& file : in.others)
    if (file.filename() == "Dockerfile")
      found.why = "got a Dockerfile, expected a program in C, C++, Python or Java; containers are not run";
  if (!found.why.empty()) found.kind = Kind::Other;
  return found;
}

}  // namespace

std::vector<std::string> includes_of(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::size_t i = text.find_first_not_of(" \t", at);
    if (i < end && text[i] == '#') {
      i = text.find_first_not_of(" \t", i + 1);
      if (i < end && text.compare(i, 7, "include") == 0 && (i = text.find_first_not_of(" \t", i + 7)) < end &&
          (text[i] == '<' || text[i] == '"')) {
        const std::size_t close = text.find(text[i] == '<' ? '>' : '"', i + 1);
        if (close < end) names.push_back(text.substr(i + 1, close - i - 1));
      }
    }
    at = end + 1;
  }
  return names;
}

bool includes_webots(const fs::path& source) {
  std::set<fs::path> seen;
  return includes_webots_below(source.lexically_normal(), seen, 0);
}

bool is_native_program(const fs::path& file) {
  Elf64_Ehdr head;
  const std::string begin = head_of(file, sizeof head);
  if (begin.size() < sizeof head || begin.compare(0, SELFMAG, ELFMAG) != 0 || begin[EI_CLASS] != ELFCLASS64)
    return false;
  std::memcpy(&head, begin.data(), sizeof head);
  if (head.e_machine != kMachine || (head.e_type != ET_EXEC && head.e_type != ET_DYN)) return false;
  if (head.e_type == ET_EXEC) return true;
  const std::string text = text_of(file);
  // a shared object that can be started asks for an interpreter
  for (unsigned i = 0; i < head.e_phnum; ++i) {
    Elf64_Phdr part;
    const std::uint64_t at = head.e_phoff + std::uint64_t{i} * sizeof part;
    if (at + sizeof part > text.size()) return false;
    std::memcpy(&part, text.data() + at, sizeof part);
    if (part.p_type == PT_INTERP) return true;
  }
  return false;
}

fs::path makefile_of(const fs::path& folder) {
  std::error_code none;
  for (const char* name : {"GNUmakefile", "makefile", "Makefile"})
    if (fs::is_regular_file(folder / name, none)) return folder / name;
  return {};
}

Found look_at(const std::string& path) {
  Found found;
  if (path == "<extern>" || path == "extern") {
    found.kind = Kind::Extern;
    return found;
  }
  if (path.empty() || path.find('\0') != std::string::npos) return found;
  std::error_code none;
  fs::path whole = fs::absolute(path, none).lexically_normal();
  if (whole.filename().empty()) whole = whole.parent_path();
  if (fs::is_directory(whole, none)) return look_at_folder(whole);
  if (fs::is_regular_file(whole, none)) return look_at_file(whole);
  found.why = fs::exists(whole, none) ? "got a pipe or a device, expected a file or a folder"
                                      : "got a name of nothing, expected a file or a folder";
  return found;
}

bool is_pc_program(const std::string& path) {
  const Kind kind = look_at(path).kind;
  return kind != Kind::Nothing && kind != Kind::Firmware;
}

}  // namespace programs
