// SPDX-License-Identifier: MIT
// See library_objects.h. All of it is archives of weak symbols, so whatever a program defines itself takes
// the place of ours.
#include "library_objects.h"

#include "compiler/cache/elf_reader.h"
#include "compiler/cache/inputs.h"
#include "compiler/cache/shared_variables.h"
#include "compiler/projects/program_files.h"
#include "install/cache_bound.h"
#include "install/places.h"

namespace cc {
namespace fs = std::filesystem;

fs::path compiler_path() { return places::tools_folder() / "twinpuck-cc"; }

fs::path include_root(const BuildOptions& o) {
  return o.include_root.empty() ? places::product_share() / "firmware/include" : o.include_root;
}

std::vector<fs::path> contract_folders(const fs::path& root) {
  std::vector<fs::path> folders = {root};
  for (const char* sub : {"motor_led/advance_one_timer", "motor_led", "a_d/advance_ad_scan", "a_d", "uart",
                          "utility", "camera/fast_2_timer", "codec", "bluetooth", "I2C", "fft", "matlab",
                          "acc_gyro", "motor_led/advance_one_timer/fast_agenda", "contrib/LIS_sensors_turret",
                          "contrib/SWIS_com_module", "contrib"})
    folders.push_back(root / sub);
  return folders;
}

std::string names_of_headers(const std::vector<fs::path>& folders) {
  std::string names;
  for (const fs::path& folder : folders)
    for (const fs::path& header : files_below(folder, ".h"))
      names += header.lexically_relative(folder).string() + "\n";
  return content_hash(names);
}

namespace {

/// What XC16 brings compiled, whose code is the same at every level of a program; the e-puck's library is
/// compiled with the program.
bool is_precompiled(const fs::path& source) {
  const fs::path folder = source.parent_path();
  return folder == places::product_share() / "hal_dspic/runtime" ||
         folder == places::product_share() / "firmware/libc/src";
}

std::vector<CompileJob> library_jobs(const BuildOptions& o, bool is_webots) {
  const fs::path root = places::product_share(), libc = root / "firmware/libc/include";
  const fs::path contract = include_root(o);
  const fs::path api = o.api_dir.empty() ? root / "hal_dspic" : o.api_dir;
  std::vector<std::string> flags = {o.optimisation, "--library"};
  for (const fs::path& folder : contract_folders(contract)) flags.push_back("-I" + folder.string());
  flags.insert(flags.end(), {"-include", (libc / "xc16_builtins.h").string(), "-I" + libc.string(),
                             "--fallback", contract.string(), "--fallback", libc.string(),
                             "-I" + root.string(), "-I" + api.string()});  // its hal.h, for firmware/library

  const std::string salt =
      names_of_headers({contract, root / "firmware/libc", api, root / "firmware/library"});
  std::vector<CompileJob> jobs;
  const auto add = [&](const fs::path& source, const std::vector<std::string>& with) {
    jobs.push_back({source, with, salt, root.string(), root.string(), places::kUsualShare});
    if (is_precompiled(source)) jobs.back().flags.front() = "-O1";
    // what the drivers do with a program's variables and functions, those do not
    jobs.back().has_facts = !is_precompiled(source) && source.extension() == ".c";
  };
  if (is_webots)
    for (const auto& s : files_below(root / "firmware/webots", ".c")) add(s, flags);
  std::vector<fs::path> folders = {api, root / "firmware/libc/src"};
  if (!o.api_dir.empty()) folders.push_back(root / "hal_dspic/runtime");
  // the half of the library that needs no pins, for a HAL that has the other half
  if (fs::exists(api / "hal.h")) folders.push_back(root / "firmware/library");
  for (const auto& folder : folders)
    for (const auto& s : files_below(folder, {".c", ".s"}))
      if (s.parent_path() != root / "hal_dspic/bootloader") add(s, flags);  // a program of its own
  return jobs;
}

}  // namespace

// an object's name tells its content, and an archive's name its objects: what is there is never replaced
Archive archive(const std::vector<CompileOutcome>& objects, const ObjectFolders& folders) {
  std::string key;
  for (const auto& o : objects) key += o.object.filename().string() + "\n";
  const std::string name = "library-" + content_hash(key) + ".a";
  const auto is_whole = [](const fs::path& file) {
    const std::string told = bytes_of(file.string() + ".sum");
    return !told.empty() && told == content_hash(bytes_of(file));
  };
  if (!folders.ready.empty() && is_whole(folders.ready / name)) return {folders.ready / name, ""};
  const fs::path file = folders.cache / name, half = unfinished(file);
  if (BuildInputs* inputs = inputs_of_build()) inputs->take(file);
  if (is_whole(file)) {
    places::note_used(file);
    return {file, ""};
  }
  std::vector<std::string> argv = {"ar", "rcsD", half.string()};
  for (const auto& o : objects) argv.push_back(o.object.string());
  const auto run = run_process(argv);
  std::error_code ec, none;
  const std::string sum = content_hash(bytes_of(half));
  if (run.status == 0) fs::rename(half, file, ec);
  if (run.status != 0 || ec || !write_text(file.string() + ".sum", sum)) {
    fs::remove(half, none);
    return {file, file.string() + ": ar: " + (ec ? ec.message() + "\n" : run.output)};
  }
  return {file, ""};
}

std::string facts_of_assembler(const fs::path& object) {
  std::string labels, names;
  const auto symbols = read_elf(object).symbols;
  for (const ElfSymbol& s : symbols) {
    if (!s.is_global) continue;
    if (s.is_defined) labels += "F " + s.name + (is_handler_name(s.name) ? " h-\n" : " -\n");
    for (const ElfSymbol& other : symbols)
      if (s.is_defined && other.is_global && other.name != s.name)
        names += "N " + s.name + " " + other.name + "\n";
  }
  return labels + names;
}

namespace {

Library library_in(const BuildOptions& o, bool is_webots, const ObjectFolders& folders) {
  const auto outcomes = compile_all(library_jobs(o, is_webots), compiler_path(), folders, o.jobs);
  Library library;
  library.ok = true;
  for (const CompileOutcome& outcome : outcomes) {
    library.messages += outcome.messages;
    library.objects.push_back(outcome.object);
    if (!outcome.facts.empty()) library.facts.push_back(outcome.facts);
    if (outcome.ok && outcome.source.extension() == ".s" && !is_precompiled(outcome.source))
      library.facts.push_back(facts_of_assembler(outcome.object));
    library.ok = library.ok && outcome.ok;
    ++(outcome.reused ? library.reused : library.compiled);
  }
  if (!library.ok) return library;
  const Archive made = archive(outcomes, folders);
  library.archive = made.file;
  library.ok = made.error.empty();
  library.messages += made.error;
  return library;
}

}  // namespace

Library provide_library(const BuildOptions& o, bool is_webots) {
  // a library from elsewhere, as tests have, is no part of the product
  const bool is_ours = o.api_dir.empty() && o.include_root.empty();
  return library_in(o, is_webots, {o.cache_dir, is_ours ? places::tools_folder() / "library" : fs::path()});
}

std::vector<Library> provide_usual_libraries(const fs::path& folder, int jobs) {
  std::vector<Library> made;
  for (const bool is_webots : {false, true}) {
    BuildOptions o;
    o.jobs = jobs;
    o.optimisation = "-O1";
    made.push_back(library_in(o, is_webots, {folder, {}}));
  }
  return made;
}

}  // namespace cc
