// SPDX-License-Identifier: MIT
#include "supervisor/build.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "hal_sim/cc/child_process.h"
#include "hal_sim/twin/twin.h"
#include "sim_core/base/hash.h"
#include "sim_core/load/world_loader.h"

namespace supervisor {

namespace fs = std::filesystem;

namespace {

const char* const kCompiler = "gcc";  // by a file's ending it compiles C or C++

fs::path programs_folder() { return fs::path(twin::project_root()) / "supervisor" / "programs"; }

bool is_source(const fs::path& file) {
  const std::string kind = file.extension();
  return kind == ".c" || kind == ".cpp" || kind == ".cc" || kind == ".cxx";
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none, odd;  // what cannot be looked at is no source
  const auto skip = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it(folder, skip, none), end; !none && it != end; it.increment(none))
    if (it->is_regular_file(odd)) files.push_back(it->path());
  std::sort(files.begin(), files.end());
  return files;
}

/// What has the name of a header or source and is no file: reading a pipe would never end. Empty: nothing.
std::string odd_file_in(const fs::path& folder) {
  std::error_code none, odd;
  const auto skip = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it(folder, skip, none), end; !none && it != end; it.increment(none)) {
    const fs::file_type type = it->status(odd).type();
    if ((type == fs::file_type::fifo || type == fs::file_type::character || type == fs::file_type::block ||
         type == fs::file_type::socket) &&
        (is_source(it->path()) || it->path().extension().string().rfind(".h", 0) == 0))
      return it->path().string();
  }
  return "";
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::uint64_t hash_of(std::uint64_t h, const std::string& bytes) {
  for (unsigned char c : bytes) h = sim::fold(h, std::uint64_t{c});
  return sim::fold(h, std::uint64_t{bytes.size()});
}

/// What a shared object depends on beside its own folder: headers, and the library that is linked to it.
std::uint64_t hash_of_ours(const fs::path& library) {
  std::uint64_t h = 0;
  const fs::path root = twin::project_root();
  for (const char* folder : {"supervisor/include", "firmware/include/webots", "firmware/include/device"})
    for (const fs::path& file : files_in(root / folder)) h = hash_of(h, content_of(file));
  return hash_of(h, content_of(library));
}

/// Runs a command; its stdout and stderr become lines. False: it failed.
bool run(const std::vector<std::string>& words, std::vector<std::string>& lines) {
  const cc::ProcessResult done = cc::run_process(words);
  std::istringstream in(done.output);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  if (done.status < 0) lines.push_back("expected a C and C++ compiler; run scripts/setup.sh");
  return done.status == 0;
}

fs::path find(const std::string& name, const std::string& from_folder) {
  std::error_code none;
  const fs::path here =
      fs::path(name).is_absolute() || from_folder.empty() ? fs::path(name) : fs::path(from_folder) / name;
  const bool plain = name.find('/') == std::string::npos;
  for (const fs::path& path : {here, fs::path(name)})
    if (fs::is_regular_file(path, none) || (fs::is_directory(path, none) && is_program_folder(path.string())))
      return path;
  if (plain && fs::is_directory(programs_folder() / name, none)) return programs_folder() / name;
  return fs::exists(here, none) ? here : fs::path();
}

}  // namespace

bool is_program_folder(const std::string& folder) {
  std::error_code none;
  if (fs::equivalent(fs::weakly_canonical(folder, none).parent_path(), programs_folder(), none)) return true;
  for (const fs::path& file : files_in(folder)) {
    if (!is_source(file)) continue;
    const std::string text = content_of(file);
    for (const char* header : {"supervisor.h>", "supervisor.hpp>", "supervisor.h\"", "supervisor.hpp\""})
      if (text.find(header) != std::string::npos) return true;
  }
  return false;
}

std::string program_folder(const std::string& name, const std::string& from_folder) {
  std::error_code none;
  const fs::path path = fs::absolute(find(name, from_folder), none);
  return (fs::is_directory(path, none) ? path : path.parent_path()).string();
}

std::string find_program(const std::string& name, const std::string& from_folder,
                         std::vector<std::string>& problems) {
  const fs::path path = find(name, from_folder);
  if (path.empty()) {
    std::vector<std::string> known;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(programs_folder(), none))
      known.push_back(entry.path().filename());
    const std::string guess = sim::did_you_mean(name, known);
    problems.push_back(name +
                       ": supervisor: got a name that is neither a file nor a folder, expected a .so, a C or "
                       "C++ file, a folder of such, or one under supervisor/programs/" +
                       (guess.empty() ? "" : "; did you mean '" + guess + "'?"));
    return "";
  }
  return path.string();
}

std::string provide_program(const std::string& name, const std::string& from_folder,
                            const std::function<void(const std::string&)>& tell,
                            std::vector<std::string>& problems) {
  const fs::path path = find_program(name, from_folder, problems);
  if (path.empty()) return "";
  const bool folder = fs::is_directory(path);
  if (!folder && !fs::is_regular_file(path)) {
    problems.push_back(path.string() + ": supervisor: got a device, expected a file or a folder");
    return "";
  }
  if (path.extension() == ".so") return path.string();
  std::vector<fs::path> sources;
  const std::string odd = folder ? odd_file_in(path) : "";
  if (!odd.empty()) {
    problems.push_back(odd + ": supervisor: got a pipe or a device, expected a file");
    return "";
  }
  std::uint64_t h = 1;
  for (const fs::path& file : folder ? files_in(path) : std::vector<fs::path>{path}) {
    h = hash_of(hash_of(h, file.string()), content_of(file));
    if (is_source(file) && file.filename() != "test.cpp") sources.push_back(file);
  }
  if (sources.empty()) {
    problems.push_back(
        path.string() +
        ": supervisor: got no C or C++ source, expected a .so, a .c or .cpp file, or a folder of such");
    return "";
  }
  const fs::path library = fs::path(twin::build_folder()) / "libsupervisor_webots.a";
  const fs::path root = twin::project_root();
  std::vector<std::string> command{
      kCompiler, "-shared", "-fPIC", "-g", "-O1", "-Wall", "-fno-omit-frame-pointer", "-ffp-contract=off",
      "-fcommon",  // as compilers did when many of them were written
      // two programs share nothing, and what ends a process ends only the program
      "-fno-gnu-unique", "-Wl,-Bsymbolic"};
  for (const char* symbol : {"exit", "_exit", "_Exit", "quick_exit", "rand", "srand", "random", "srandom",
                             "drand48", "srand48", "time", "gettimeofday", "clock"})
    command.push_back(std::string("-Wl,--wrap=") + symbol);
  command.push_back("-I" + (folder                       ? path
                            : path.parent_path().empty() ? fs::path(".")
                                                         : path.parent_path())
                               .string());
  command.push_back("-I" + (root / "supervisor" / "include").string());
  command.push_back("-idirafter");
  command.push_back((root / "firmware" / "include").string());
  for (const std::string& word : command) h = hash_of(h, word);
  h = sim::fold(h, hash_of_ours(library));
  const fs::path cache = fs::path(twin::build_folder()) / "supervisors";
  const std::string stem = (folder ? fs::weakly_canonical(path).filename() : path.stem()).string();
  const fs::path output = cache / fmt::format("{}-{:016x}.so", stem, h);
  if (fs::exists(output)) return output.string();

  std::error_code none;
  fs::create_directories(cache, none);
  const fs::path draft = fmt::format("{}.{}", output.string(), getpid());
  for (const fs::path& source : sources) command.push_back(source.string());
  for (const char* word : {"-o", draft.c_str(), library.c_str(), "-lstdc++", "-lm"}) command.push_back(word);
  std::vector<std::string> lines;
  const bool good = run(command, lines);
  if (!good) {
    problems.push_back(path.string() + ": supervisor: does not compile:");
    problems.insert(problems.end(), lines.begin(), lines.end());
    fs::remove(draft, none);
    return "";
  }
  if (tell)
    for (const std::string& line : lines) tell(line);
  fs::rename(draft, output, none);
  if (none) {
    problems.push_back(output.string() + ": supervisor: cannot be written: " + none.message());
    return "";
  }
  return output.string();
}

}  // namespace supervisor
