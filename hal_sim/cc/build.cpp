// SPDX-License-Identifier: MIT
// See build.h. Objects of the controller come first; the API and the libc follow as archives of weak symbols,
// so whatever a program defines itself (wait, getselector, an e_ function) takes the place of ours.
#include "build.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "driver_variants.h"
#include "elf_reader.h"
#include "hal_sim/host/image_stamp.h"
#include "large_stack.h"
#include "object_cache.h"
#include "pattern.h"
#include "program_files.h"
#include "timer_owners.h"
#include "twinpuck_paths.h"

namespace cc {
namespace fs = std::filesystem;
namespace {

fs::path source_root() {
  const char* home = std::getenv("TWINPUCK_HOME");
  return home ? home : TWINPUCK_SOURCE_DIR;
}

fs::path build_root() { return TWINPUCK_BUILD_DIR; }

/// Headers of the newest C++ library that is installed; empty: there is none.
std::vector<fs::path> cxx_library_folders() {
  int newest = 0;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator("/usr/include/c++", none))
    newest = std::max(newest, std::atoi(entry.path().filename().c_str()));
  if (newest == 0) return {};
  const std::string version = std::to_string(newest);
  return {"/usr/include/c++/" + version, "/usr/include/x86_64-linux-gnu/c++/" + version,
          "/usr/include/c++/" + version + "/backward"};
}

/// The flags of a C file for a C++ file: headers of the C library stand behind those of C++, which include
/// them.
std::vector<std::string> cxx_flags(const std::vector<std::string>& flags) {
  const fs::path cc_dir = source_root() / "hal_sim/cc";
  std::vector<fs::path> folders = cxx_library_folders(),
                        c_folders = {cc_dir / "libc/webots/include", cc_dir / "libc/include"};
  folders.insert(folders.begin(), cc_dir / "libc/cxx/include");
  folders.insert(folders.end(), c_folders.begin(), c_folders.end());
  std::vector<std::string> changed;
  for (const std::string& flag : flags)
    if (std::none_of(c_folders.begin(), c_folders.end(),
                     [&](const fs::path& folder) { return flag == "-I" + folder.string(); }))
      changed.push_back(flag);
  for (const fs::path& folder : folders) changed.push_back("-isystem" + folder.string());
  return changed;
}

/// Sub-folders of the contract, in the order a flat "e_motors.h" is looked up: the one-timer drivers first.
std::vector<fs::path> contract_folders(const fs::path& root) {
  std::vector<fs::path> folders = {root};
  for (const char* sub : {"motor_led/advance_one_timer", "motor_led", "a_d/advance_ad_scan", "a_d", "uart",
                          "utility", "camera/fast_2_timer", "codec", "bluetooth", "I2C", "fft", "matlab",
                          "acc_gyro", "motor_led/advance_one_timer/fast_agenda", "contrib/LIS_sensors_turret",
                          "contrib/SWIS_com_module", "contrib"})
    folders.push_back(root / sub);
  return folders;
}

struct Plan {
  std::vector<CompileJob> user, library;
  bool is_webots = false;  // a program for Webots' interfaces, with the library behind them
  CompileJob runtime;
};

// of include_finder.h, which is the compiler's
constexpr const char* kVendorHeaders = "-I/twinpuck-vendor";

std::string common_salt(const std::vector<fs::path>& headers) {
  // a header that appears or goes away can change what an #include finds
  std::string names;
  for (const auto& h : headers) names += h.string() + "\n";
  return content_hash(names);
}

/// Whether a program takes the address of a register anywhere: then its files may pass it on.
bool takes_register_addresses(const std::vector<fs::path>& sources, const std::vector<fs::path>& headers) {
  static const Pattern kAddress(
      R"([=(,{\[?:)]\s*&\s*(ADC|PORT|LAT|TRIS|TMR|PR\d|T\dCON|IFS|IEC|IPC|INTCON|U[12]|I2C|DCI|TSCON|RSCON|[RT]XBUF|SPI|OC\d|IC\d|RCON|CN)[A-Z0-9]*(bits)?\b)");
  for (const auto* list : {&sources, &headers})
    for (const auto& file : *list)
      if (std::regex_search(read_text(file), kAddress)) return true;
  return false;
}

/// Sources of a program for Webots, which compiles the file with the controller's name alone: not those that
/// another one includes as text, and not further programs that lie beside it.
std::vector<fs::path> webots_sources(const fs::path& folder, const std::vector<fs::path>& sources) {
  static const Pattern kInclude(R"(#\s*include\s*"([^"]+\.(?:c|cpp|cc|cxx))\")"), kMain(R"(\bmain\s*\()");
  const std::string own = fs::weakly_canonical(folder).filename().string();
  std::set<fs::path> left_out;
  bool has_own_main = false;
  std::vector<fs::path> others;
  for (const auto& source : sources) {
    const std::string text = read_text(source);
    for (std::sregex_iterator it(text.begin(), text.end(), kInclude), end; it != end; ++it)
      left_out.insert(fs::weakly_canonical(source.parent_path() / (*it)[1].str()));
    if (!std::regex_search(text, kMain)) continue;
    if (source.stem() == own)
      has_own_main = true;
    else
      others.push_back(fs::weakly_canonical(source));
  }
  if (has_own_main) left_out.insert(others.begin(), others.end());
  std::vector<fs::path> kept;
  for (const auto& source : sources)
    if (!left_out.count(fs::weakly_canonical(source))) kept.push_back(source);
  return kept.empty() ? sources : kept;
}

/// Files of the libc that read and write the program's strings and arrays: --sanitize checks those, too.
bool takes_strings(const fs::path& file) {
  const std::string name = file.filename().string();
  return file.parent_path() == source_root() / "hal_sim/cc/libc/src" &&
         (name == "string.c" || name == "printf.c" || name == "scanf.c" || name == "stdlib.c");
}

Plan plan(const BuildOptions& o, const LibraryCopies& copies, const Program& program, bool lint) {
  fs::path root = source_root(), cc_dir = root / "hal_sim/cc";
  fs::path include_root = o.include_root.empty() ? root / "firmware/include" : o.include_root;
  fs::path api = o.api_dir.empty() ? root / (o.register_way ? "hal_dspic" : "hal_sim/api") : o.api_dir;
  std::vector<std::string> mode = {o.optimisation};
  std::vector<std::string> library_include, user_include;
  // first what is said where to look, for quotes as for angles, then what the compiler brings along, as XC16
  // has it; folders of the program that nobody named come after that
  for (const auto& d : o.include_dirs) user_include.push_back("-I" + fs::absolute(d).string());
  for (const auto& d : program.include_dirs) user_include.push_back("-I" + d.string());
  user_include.push_back("-I" + (cc_dir / "libc/include").string());
  user_include.push_back(kVendorHeaders);
  auto headers = headers_below(o.source_dir);
  std::vector<fs::path> own = {o.source_dir};
  for (const auto& h : headers)
    if (std::find(own.begin(), own.end(), h.parent_path()) == own.end()) own.push_back(h.parent_path());
  for (const auto& d : own) user_include.push_back("-I" + d.string());
  for (const auto& d : contract_folders(include_root)) {
    user_include.push_back("-I" + d.string());
    library_include.push_back("-I" + d.string());
  }
  // "motor/speed.h" below a folder that the project's makefile names: the folder above the header's
  for (const auto& d : own)
    if (const fs::path above = d.parent_path(); d != o.source_dir)
      if (std::find(own.begin(), own.end(), above) == own.end())
        user_include.push_back("-I" + above.string());
  for (auto* list : {&user_include, &library_include}) {
    list->push_back("-include");
    list->push_back((cc_dir / "libc/include/xc16_builtins.h").string());
    list->push_back("-I" + (cc_dir / "libc/include").string());
    list->push_back("--fallback");
    list->push_back(include_root.string());
    list->push_back("--fallback");
    list->push_back((cc_dir / "libc/include").string());
  }
  user_include.push_back("--fallback");
  user_include.push_back(o.source_dir.string());
  user_include.push_back("--project");
  user_include.push_back(fs::weakly_canonical(o.source_dir).string());
  for (const auto& r : copies.roots) {
    user_include.push_back("--copy");
    user_include.push_back(r.string());
  }
  library_include.push_back("-I" + root.string());
  library_include.push_back("-I" + api.string());  // its hal.h, for hal_common
  if (o.register_way)
    for (auto* list : {&user_include, &library_include}) list->push_back("--register");

  Plan p;
  std::vector<std::string> flags = mode;
  if (o.sanitize) flags.push_back("--sanitize");
  if (o.coverage) flags.push_back("--coverage");
  p.is_webots = names_webots(copies.kept, headers);
  if (p.is_webots) {
    flags.push_back("--webots");
    flags.push_back("-I" + (cc_dir / "libc/webots/include").string());
  }
  if (o.strict) flags.push_back("--strict");
  if (lint) flags.push_back("--lint");
  if (o.register_way && takes_register_addresses(copies.kept, headers))
    flags.push_back("--register-pointers");
  for (const auto& d : program.defines) flags.push_back("-D" + d);
  for (const auto& d : o.defines) flags.push_back("-D" + d);
  if (const std::string& standard = o.standard.empty() ? program.standard : o.standard; !standard.empty())
    flags.push_back("-std=" + standard);
  flags.insert(flags.end(), user_include.begin(), user_include.end());
  bool any_cxx = false;
  for (const auto& s :
       p.is_webots && !program.is_exact ? webots_sources(o.source_dir, copies.kept) : copies.kept) {
    any_cxx = any_cxx || is_cxx(s);
    p.user.push_back({s, is_cxx(s) ? cxx_flags(flags) : flags, common_salt(headers)});
  }

  std::vector<std::string> library_flags = mode;
  library_flags.push_back("--library");
  library_flags.insert(library_flags.end(), library_include.begin(), library_include.end());
  // some take the place of a file of the libc
  if (p.is_webots)
    for (const auto& folder : {root / "firmware/webots", cc_dir / "libc/webots"})
      for (const auto& s : files_below(folder, ".c")) p.library.push_back({s, library_flags, ""});
  if (any_cxx)
    for (const auto& s : files_below(cc_dir / "libc/cxx/src", ".cpp"))
      p.library.push_back({s, cxx_flags(library_flags), ""});
  // what exists in the simulator alone has one form for both ways
  if (o.register_way)
    for (const char* name : {"virtual.c", "webots_simulator.c"})
      p.library.push_back({root / "hal_sim/api" / name, library_flags, ""});
  std::vector<fs::path> library_folders = {api, cc_dir / "libc/src"};
  // the half of the library that needs no pins, for a HAL that has the other half
  if (fs::exists(api / "hal.h")) library_folders.push_back(root / "hal_common");
  const auto is_replaced = [&](const fs::path& file) {
    return p.is_webots && file.parent_path() == cc_dir / "libc/src" &&
           fs::exists(cc_dir / "libc/webots" / file.filename());
  };
  for (const auto& folder : library_folders)
    for (const auto& s : files_below(folder, ".c")) {
      if (is_replaced(s)) continue;
      p.library.push_back({s, library_flags, ""});
      if (o.sanitize && takes_strings(s)) p.library.back().flags.push_back("--sanitize");
    }

  std::string name =
      o.name.empty() ? fs::absolute(o.source_dir).lexically_normal().filename().string() : o.name;
  std::string image_flags = o.sanitize ? "sanitize" : "";
  if (o.coverage) image_flags += image_flags.empty() ? "coverage" : " coverage";
  if (o.register_way) image_flags += image_flags.empty() ? "register" : " register";
  p.runtime = {cc_dir / "runtime/image_runtime.c",
               {"-O1", "-I" + root.string(), "-I" + (cc_dir / "libc/include").string(),
                "-DTP_IMAGE_NAME=\"" + name + "\"", "-DTP_IMAGE_FLAGS=\"" + image_flags + "\""},
               ""};
  if (o.coverage) p.runtime.flags.push_back("-DTP_COVERAGE");
  if (p.is_webots) p.runtime.flags.push_back("-DTP_WEBOTS");
  if (o.sanitize)
    p.library.push_back(
        {cc_dir / "runtime/image_sanitize.c",
         {"-O1", "--uncounted", "-I" + root.string(), "-I" + (cc_dir / "libc/include").string()},
         ""});
  return p;
}

/// Splits what a compiler printed into errors and warnings; notes stay with the line before them.
void sort_messages(const std::string& text, BuildResult& result, bool failed) {
  static const Pattern kSummary(R"(^\d+ (warning|error)s?( and \d+ errors?)? generated\.$)");
  std::istringstream lines(text);
  std::vector<std::string>* last = nullptr;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || std::regex_match(line, kSummary)) continue;
    bool is_error =
        line.find(" error: ") != std::string::npos || line.find("fatal error: ") != std::string::npos;
    bool is_warning = line.find("warning: ") != std::string::npos;
    if (is_error || is_warning) {
      last = is_error ? &result.errors : &result.warnings;
      if (std::find(last->begin(), last->end(), line) == last->end()) last->push_back(line);
    } else if (last && !last->empty() && line.find("note: ") != std::string::npos) {
      last->back() += "\n" + line;
    } else if (failed) {
      last = &result.errors;
      last->push_back(line);
    }
  }
}

/// Everything the host exports: named in the headers of the seam, and in host_exports.def.
std::set<std::string> host_exports() {
  std::set<std::string> names;
  fs::path root = source_root();
  static const Pattern kFunction(R"(\b(tp_\w+)\s*\()");
  for (const auto& header : files_below(root / "hal_sim/host", ".h")) {
    const std::string file = header.filename().string();
    if (file != "image_abi.h" && file.rfind("pins", 0) != 0) continue;
    std::string text = read_text(header);
    for (std::sregex_iterator it(text.begin(), text.end(), kFunction), end; it != end; ++it)
      names.insert((*it)[1]);
  }
  std::istringstream lines(read_text(root / "hal_sim/cc/host_exports.def"));
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] != '#') names.insert(line);
  return names;
}

/// "x.o: in function `f': main.c:12: undefined reference to `g'" -> our grammar.
void sort_linker_messages(const std::string& text, const Program& program, BuildResult& result) {
  std::map<std::string, fs::path> in_assembler;
  for (const fs::path& file : program.assembler)
    for (const std::string& name : functions_in_assembler(file)) in_assembler.emplace(name, file);
  static const Pattern kIn(R"(in function `([^']+)':)");
  static const Pattern kUndefined(
      R"(^(?:.*?: )?(?:\.\./)*(\S+?:\d+|\S+\.o:\S+): (?:warning: )?undefined reference to `([^']+)')");
  static const Pattern kPlain(R"(undefined reference to `([^']+)')");
  static const Pattern kTwice(R"(multiple definition of `([^']+)'; .*?first defined here)");
  auto exports = host_exports();
  std::string function;
  std::set<std::string> told;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch m;
    if (std::regex_search(line, m, kIn)) function = m[1];
    if (std::regex_search(line, m, kPlain)) {
      std::string name = m[1], where;
      if (exports.count(name) || !told.insert(function + " " + name).second) continue;
      if (std::regex_search(line, m, kUndefined)) where = m[1];
      if (where.rfind(".o:") != std::string::npos || where.empty())
        where = function.empty() ? "link" : function + "()";
      static const Pattern kWebots(
          R"((wb_|wbu_|supervisor_|robot_|camera_|speaker_|display_|servo_|connector_|pen_|differential_wheels_).*)");
      std::string hint =
          in_assembler.count(name) ? "it is in " + in_assembler[name].filename().string() +
                                         ", and assembler sources are not assembled here; write it in C"
          : std::regex_match(name, kWebots)
              ? "a controller runs on the robot and has not this function of Webots; docs/webots.md lists "
                "what there is, and supervisors are programs of their own"
          : name.rfind("e_", 0) == 0
              ? "this function of the e-puck library is not simulated yet, or its name is misspelt"
              : "is a .c file missing from the folder, or the name misspelt?";
      result.errors.push_back(where + ": " + (function.empty() ? "" : function + "() calls ") + name +
                              "(): got no definition, expected one in the project or the library; " + hint);
    } else if (std::regex_search(line, m, kTwice)) {
      std::string name = m[1];
      if (told.insert("twice " + name).second)
        result.errors.push_back("link: " + name + ": got two definitions, expected one: " + line);
    } else if (line.find("error: ") != std::string::npos || line.find("cannot ") != std::string::npos ||
               line.find("No space") != std::string::npos) {
      result.errors.push_back("link: " + line);
    }
  }
}

void check_main(const std::vector<CompileOutcome>& outcomes, const std::vector<CompileJob>& jobs,
                const fs::path& folder, BuildResult& result) {
  std::vector<std::string> with_main;
  for (size_t i = 0; i < outcomes.size(); ++i) {
    auto elf = read_elf(outcomes[i].object);
    for (const auto& s : elf.symbols) {
      if (s.name == "main" && s.is_defined && s.is_function)
        with_main.push_back(jobs[i].source.filename().string());
    }
  }
  if (with_main.empty())
    result.errors.push_back(folder.string() +
                            ": main(): got no definition, expected one; is this a controller's folder?");
  if (with_main.size() > 1) {
    std::string list;
    for (const auto& f : with_main) list += (list.empty() ? "" : ", ") + f;
    result.errors.push_back(folder.string() + ": main(): got " + std::to_string(with_main.size()) +
                            " definitions (" + list + "), expected 1; give each program a folder of its own");
  }
}

constexpr long kRamBytes = 8192;  // of the dsPIC30F6014A  [DS70143: 8192 bytes of data RAM]

/// Static data and stack share the chip's RAM.
void check_room(const fs::path& image, const fs::path& folder, BuildResult& result) {
  const MemoryUse use = memory_use(image);
  result.ram_bytes = use.data;
  result.stack_bytes = use.stack;
  result.recursive = use.recursive;
  const std::string data = std::to_string(result.ram_bytes), most = std::to_string(kRamBytes);
  if (result.ram_bytes > kRamBytes)
    result.no_room = folder.string() + ": warning: static data: got " + data + " (bytes), expected at most " +
                     most + " (bytes); it would not fit the chip's RAM";
  else if (result.ram_bytes + use.stack > kRamBytes)
    result.no_room = folder.string() + ": warning: static data and stack: got " + data + " and about " +
                     std::to_string(use.stack) + " (bytes), expected together at most " + most +
                     " (bytes); the stack is deepest in " + use.deepest;
  if (!result.no_room.empty()) result.warnings.push_back(result.no_room);
}

/// Handlers that a program has in assembler would be missing without a word: nothing names them.
void tell_of_assembler(const Program& program, const std::vector<CompileOutcome>& user, BuildResult& result) {
  for (const fs::path& file : program.assembler)
    for (const std::string& name : functions_in_assembler(file)) {
      static const Pattern kHandler("_\\w+Interrupt");
      if (!std::regex_match(name, kHandler) || is_library_assembler(file)) continue;
      const bool is_in_c = std::any_of(user.begin(), user.end(), [&](const CompileOutcome& o) {
        const auto symbols = read_elf(o.object).symbols;
        return std::any_of(symbols.begin(), symbols.end(),
                           [&](const ElfSymbol& s) { return s.is_defined && s.name == name; });
      });
      if (!is_in_c)
        result.warnings.push_back(file.string() + ": " + name +
                                  "(): got a handler in assembler, which is not assembled here, expected C; "
                                  "the interrupt has no handler");
    }
}

/// Makes the program's objects call the forms of drivers that are chosen (driver_variants.h).
std::vector<DriverChoice> choose_drivers(std::vector<CompileOutcome>& user,
                                         const std::vector<CompileJob>& jobs, const Program& program,
                                         const BuildOptions& o, BuildResult& result) {
  const fs::path include_root = o.include_root.empty() ? source_root() / "firmware/include" : o.include_root;
  ProgramSymbols symbols;
  std::vector<std::set<std::string>> wanted(user.size());
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < user.size(); ++i) {
    for (const auto& s : read_elf(user[i].object).symbols) {
      if (s.name.empty() || !s.is_global) continue;
      (s.is_defined || s.is_common ? symbols.defined : wanted[i]).insert(s.name);
    }
    symbols.wanted.insert(wanted[i].begin(), wanted[i].end());
    texts.push_back(read_text(jobs[i].source));
  }
  for (const fs::path& header : files_below(o.source_dir, ".h"))
    if (library_place(fs::path(header).replace_extension(".c")).empty()) texts.push_back(read_text(header));
  auto choices = choose_driver_forms(symbols, program.library_places, texts, include_root);
  const auto renamed = renamed_functions(symbols, choices, include_root);
  for (const DriverChoice& choice : choices)
    if (!choice.told.empty()) result.conflicts.push_back(o.source_dir.string() + ": warning: " + choice.told);
  for (std::size_t i = 0; i < user.size(); ++i) {
    std::string names;
    for (const auto& [from, to] : renamed)
      if (wanted[i].count(from)) names += from + " " + to + "\n";
    if (names.empty()) continue;
    const fs::path changed =
        o.cache_dir / (user[i].object.stem().string() + "-" + content_hash(names) + ".o");
    const fs::path list = changed.string() + ".names";
    write_text(list, names);
    const auto run = run_process(
        {"objcopy", "--redefine-syms=" + list.string(), user[i].object.string(), changed.string()});
    if (run.status != 0) result.errors.push_back("objcopy: " + run.output);
    user[i].object = changed;
  }
  return choices;
}

bool archive(const std::vector<CompileOutcome>& objects, const fs::path& path, BuildResult& result) {
  std::string names;
  for (const auto& o : objects)
    names += o.object.string() + " " + std::to_string(fs::file_size(o.object)) + " " +
             std::to_string(fs::last_write_time(o.object).time_since_epoch().count()) + "\n";
  fs::path list = path.string() + ".list";
  if (fs::exists(path) && read_text(list) == names) return true;
  std::error_code ec;
  fs::remove(path, ec);
  std::vector<std::string> argv = {"ar", "rcs", path.string()};
  for (const auto& o : objects) argv.push_back(o.object.string());
  auto run = run_process(argv);
  if (run.status != 0) {
    result.errors.push_back("ar: " + run.output);
    return false;
  }
  return write_text(list, names);
}

}  // namespace

static BuildResult build_here(const BuildOptions& options) {
  auto start = std::chrono::steady_clock::now();
  BuildResult result;
  BuildOptions o = options;
  auto finish = [&]() -> BuildResult& {
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  };
  std::error_code ec;
  if (!fs::is_directory(o.source_dir, ec)) {
    result.errors.push_back(o.source_dir.string() +
                            ": controller: got no such folder, expected one with a main.c");
    return finish();
  }
  Program program = program_of(o, result);
  const auto& sources = program.sources;
  if (sources.empty()) {
    result.errors.push_back(no_program(o.source_dir));
    return finish();
  }
  if (o.cache_dir.empty()) o.cache_dir = build_root() / "firmware-cache";
  o.cache_dir = fs::absolute(o.cache_dir);
  LibraryCopies copies;
  std::size_t own = 0;  // of p.user, what is not a member of a copy of the library
  if (o.register_way) {
    // drivers that a project brings along reach the registers they were written for
    const LibraryCopies split = find_library_members(o.source_dir, sources, program.unlisted);
    own = split.kept.size();
    copies.replaced_whole = split.replaced_whole;
    copies.kept = split.kept;
    copies.kept.insert(copies.kept.end(), split.replaced.begin(), split.replaced.end());
  } else {
    copies = find_library_copies(o.source_dir, sources);
    own = copies.kept.size();
  }
  own = program.order(copies, own);
  if (const std::string told = library_copies_message(o.source_dir, copies); !told.empty())
    result.warnings.push_back(told);
  if (!o.register_way && program.has_project)
    for (const fs::path& source : copies.replaced)
      if (!program.unlisted.count(source)) program.library_places.push_back(library_place(source));
  Plan p = plan(o, copies, program, false);
  if (p.is_webots) own = p.user.size();
  for (std::size_t i = own; i < p.user.size(); ++i) p.user[i].flags.push_back("--weak");
  fs::path compiler = build_root() / "twinpuck-cc";
  std::vector<CompileJob> all = p.user;
  all.insert(all.end(), p.library.begin(), p.library.end());
  all.push_back(p.runtime);
  auto outcomes = compile_all(all, compiler, o.cache_dir, std::max(1, o.jobs));
  bool ok = true;
  for (size_t i = 0; i < outcomes.size(); ++i) {
    if (!outcomes[i].ok && i >= own && i < p.user.size()) {
      // a copy of the library holds files that the project never compiled
      result.warnings.push_back(p.user[i].source.string() + ": does not compile and is left out, as " +
                                (program.unlisted.count(p.user[i].source)
                                     ? "it is no part of the program: "
                                     : "a file of a copy of the library: ") +
                                outcomes[i].messages.substr(0, outcomes[i].messages.find('\n')));
      continue;
    }
    const bool is_member = i >= own && i < p.user.size();  // of a library: its warnings are not the user's
    if (!is_member) sort_messages(outcomes[i].messages, result, !outcomes[i].ok);
    ok = ok && outcomes[i].ok;
    ++(outcomes[i].reused ? result.reused : result.compiled);
  }
  if (!ok) return finish();
  std::vector<CompileOutcome> user(outcomes.begin(), outcomes.begin() + long(own));
  std::vector<CompileOutcome> members(outcomes.begin() + long(own), outcomes.begin() + long(p.user.size()));
  members.erase(std::remove_if(members.begin(), members.end(), [](const auto& m) { return !m.ok; }),
                members.end());
  std::vector<CompileOutcome> library(outcomes.begin() + long(p.user.size()), outcomes.end() - 1);
  check_main(user, p.user, o.source_dir, result);
  if (!result.errors.empty()) return finish();
  tell_of_assembler(program, user, result);
  const auto choices = choose_drivers(user, p.user, program, o, result);
  std::vector<std::pair<std::string, std::string>> texts;
  for (const auto& s : o.register_way ? find_library_copies(o.source_dir, sources).kept : copies.kept)
    if (!program.unlisted.count(s)) texts.emplace_back(s.filename().string(), read_text(s));
  for (auto& conflict : timer_conflicts(texts, replaced_headers(choices)))
    result.conflicts.push_back(std::move(conflict));

  fs::path output = fs::absolute(o.output);
  fs::create_directories(output.parent_path(), ec);
  fs::path half = output.string() + ".half" + std::to_string(getpid());
  std::vector<std::string> argv = {"ld",
                                   "-shared",
                                   "-Bsymbolic",
                                   "-z",
                                   "now",
                                   "-z",
                                   "relro",
                                   "-z",
                                   "separate-code",
                                   "-z",
                                   "noexecstack",
                                   "-z",
                                   "defs",
                                   "--warn-unresolved-symbols",
                                   "--build-id=none",
                                   "--hash-style=gnu",
                                   "--no-warn-mismatch",
                                   "-T",
                                   (source_root() / "hal_sim/cc/runtime/image.ld").string(),
                                   "-o",
                                   half.string()};
  for (const auto& u : user) argv.push_back(u.object.string());
  argv.push_back(outcomes.back().object.string());
  for (const auto* list : {&members, &library}) {
    if (list->empty()) continue;
    std::string key;
    for (const auto& l : *list) key += l.object.filename().string();
    fs::path lib = o.cache_dir / ("library-" + content_hash(key) + ".a");
    if (!archive(*list, lib, result)) return finish();
    argv.push_back(lib.string());
  }
  auto link = run_process(argv);
  sort_linker_messages(link.output, program, result);
  if (link.status != 0 && result.errors.empty()) result.errors.push_back("link: " + link.output);
  if (result.errors.empty()) {
    check_room(half, o.source_dir, result);
    std::ofstream(half, std::ios::binary | std::ios::app) << host::image_stamp(read_text(half));
    fs::rename(half, output, ec);
    if (ec) result.errors.push_back(output.string() + ": cannot write: " + ec.message());
  }
  fs::remove(half, ec);
  result.ok = result.errors.empty();
  return finish();
}

static BuildResult lint_here(const BuildOptions& options) {
  BuildResult result;
  BuildOptions o = options;
  o.strict = true;
  std::error_code ec;
  auto sources = o.sources.empty() ? sources_below(o.source_dir) : o.sources;
  if (sources.empty()) {
    result.errors.push_back(no_program(o.source_dir));
    return result;
  }
  if (o.cache_dir.empty()) o.cache_dir = build_root() / "firmware-cache";
  BuildResult of_project;
  Plan p = plan(o, find_library_copies(o.source_dir, sources), program_of(o, of_project), true);
  auto outcomes = compile_all(p.user, build_root() / "twinpuck-cc", o.cache_dir, std::max(1, o.jobs));
  for (const auto& outcome : outcomes) sort_messages(outcome.messages, result, !outcome.ok);
  std::vector<std::pair<std::string, std::string>> texts;
  for (const auto& s : sources) texts.emplace_back(s.filename().string(), read_text(s));
  for (auto& conflict : timer_conflicts(texts, {})) result.warnings.push_back(conflict);
  result.ok = result.errors.empty() && result.warnings.empty();
  return result;
}

/// Files that are longer than any program's: what looks for words in them would take a stack to match.
static std::vector<std::string> too_long(const fs::path& folder) {
  std::vector<std::string> wrong;
  std::error_code ec;
  for (const char* kind : {".c", ".h", ".mcp", ".xml"})
    for (const fs::path& file : files_below(folder, kind))
      if (const auto bytes = fs::file_size(file, ec); !ec && bytes > kLongestSourceBytes)
        wrong.push_back(file.string() + ": source: got " + std::to_string(bytes) +
                        " bytes, expected at most " + std::to_string(kLongestSourceBytes));
  return wrong;
}

BuildResult build_image(const BuildOptions& options) {
  BuildResult refused;
  refused.errors = too_long(options.source_dir);
  return refused.errors.empty() ? on_large_stack([&] { return build_here(options); }) : refused;
}

BuildResult lint_folder(const BuildOptions& options) {
  BuildResult refused;
  refused.errors = too_long(options.source_dir);
  return refused.errors.empty() ? on_large_stack([&] { return lint_here(options); }) : refused;
}

}  // namespace cc
