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

#include "build_plan.h"
#include "build_record.h"
#include "driver_variants.h"
#include "elf_reader.h"
#include "hal_sim/host/image_stamp.h"
#include "large_stack.h"
#include "library_objects.h"
#include "link_chip.h"
#include "link_messages.h"
#include "object_cache.h"
#include "original_objects.h"
#include "program_files.h"
#include "shared_variables.h"
#include "sim_core/base/pattern.h"
#include "timer_owners.h"

namespace cc {
namespace fs = std::filesystem;
namespace {

/// `outcomes`: of all C files, the program's own first; for the chip those of assembler follow, whose labels
/// are no functions, and which may have a start-up of their own instead.
void check_main(const std::vector<CompileOutcome>& outcomes, const Plan& p, std::size_t own,
                const BuildOptions& o, BuildResult& result) {
  std::vector<std::string> with_main;
  bool starts_itself = false;
  const auto look = [&](const CompileOutcome& made, const CompileJob& job, bool is_c) {
    for (const auto& s : read_elf(made.object).symbols) {
      if (!s.is_defined || (is_c ? !s.is_function : !s.is_global)) continue;
      if (s.name == "main") with_main.push_back(job.source.filename().string());
      starts_itself |= !is_c && s.name == "_reset";
    }
  };
  for (std::size_t i = 0; i < own; ++i) look(outcomes[i], p.user[i], true);
  for (std::size_t i = 0; o.chip_way && i < p.assembler.size(); ++i)
    look(outcomes[p.user.size() + i], p.assembler[i], false);
  if (starts_itself && with_main.empty()) return;
  if (with_main.empty()) result.errors.push_back(no_program(o.source_dir));
  if (with_main.size() > 1) {
    std::string list;
    for (const auto& f : with_main) list += (list.empty() ? "" : ", ") + f;
    result.errors.push_back(o.source_dir.string() + ": main(): got " + std::to_string(with_main.size()) +
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
      static const sim::Pattern kHandler("_\\w+Interrupt");
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

/// Makes the program's objects call the forms of drivers that are chosen (driver_variants.h); for the chip
/// its linker does, by `renames`.
std::vector<DriverChoice> choose_drivers(std::vector<CompileOutcome>& user,
                                         const std::vector<CompileOutcome>& members,
                                         const std::vector<CompileJob>& jobs, const Program& program,
                                         const BuildOptions& o, BuildResult& result, Renames& renames) {
  const fs::path contract = include_root(o);
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
  // a driver that the project brings along is the program's own, whatever header declares it
  std::set<std::string> wanted_by_members;
  if (o.chip_way)
    for (const CompileOutcome& member : members)
      for (const auto& s : read_elf(member.object).symbols)
        if (!s.name.empty() && s.is_global)
          (s.is_defined || s.is_common ? symbols.defined : wanted_by_members).insert(s.name);
  for (const fs::path& header : files_below(o.source_dir, ".h"))
    if (library_place(fs::path(header).replace_extension(".c")).empty()) texts.push_back(read_text(header));
  auto choices = choose_driver_forms(symbols, program.library_places, texts, contract);
  if (o.chip_way)
    for (const std::string& wrong : functions_of_two_drivers(symbols, choices, contract))
      result.errors.push_back(o.source_dir.string() + ": " + wrong);
  symbols.wanted.insert(wanted_by_members.begin(), wanted_by_members.end());
  const auto renamed = renamed_functions(symbols, choices, contract);
  for (const DriverChoice& choice : choices)
    if (!choice.told.empty()) result.conflicts.push_back(o.source_dir.string() + ": warning: " + choice.told);
  if (o.chip_way) {
    renames = {renamed, own_functions(symbols, contract)};
    return choices;
  }
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

/// What the original's linker would call a multiple definition, since its library lies in larger objects.
/// `listed`: of `outcomes`, in the order of the plan, what is linked whatever asks for it.
void check_second_definitions(const std::vector<CompileOutcome>& outcomes, const std::vector<bool>& listed,
                              const Program& program, const std::vector<DriverChoice>& choices,
                              BuildResult& result) {
  ProgramFunctions functions;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const std::string file = outcomes[i].source.filename().string();
    for (const ElfSymbol& s : read_elf(outcomes[i].object).symbols) {
      if (!s.is_global || s.name.empty()) continue;
      if (s.is_defined || s.is_common) functions.defined.insert(s.name);
      if (!listed[i]) continue;
      if (!s.is_defined)
        functions.wanted.emplace(s.name, file);
      else if (!s.is_weak)
        functions.own.emplace(s.name, outcomes[i].source.string());
    }
  }
  for (const fs::path& file : program.objects)
    for (const std::string& name : names_defined_by(file)) functions.defined.insert(name);
  for (const std::string& wrong : second_definitions(functions, choices)) result.errors.push_back(wrong);
}

/// Chip way: what handlers of any file write is read where it stands in all files. A file that was compiled
/// without knowing of them all is compiled again. `own`: how many of `all` are the program's C files, which
/// come first; members of its copy of the library follow, `in_c` in all, then assembler.
void read_shared_variables_in_place(std::vector<CompileJob>& all, std::vector<CompileOutcome>& outcomes,
                                    std::size_t own, std::size_t in_c, const Library& library,
                                    const BuildOptions& o, BuildResult& result) {
  std::vector<FileFacts> files;
  for (std::size_t i = 0; i < all.size(); ++i)
    files.push_back({i < in_c         ? outcomes[i].facts
                     : outcomes[i].ok ? facts_of_assembler(outcomes[i].object)
                                      : "",
                     true, i < own});
  for (const std::string& facts : library.facts) files.push_back({facts, false, false});
  const SharedVariables shared = shared_variables(files);
  std::vector<CompileJob> again;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < in_c; ++i) {
    if (!outcomes[i].ok || shared.nodes[i] == marked_nodes(outcomes[i].facts)) continue;
    all[i].flags.push_back("--shared=" + list_of_nodes(shared.nodes[i]));
    again.push_back(all[i]);
    places.push_back(i);
  }
  const auto made = compile_all(again, compiler_path(), o.cache_dir, o.jobs);
  for (std::size_t i = 0; i < made.size(); ++i) outcomes[places[i]] = made[i];
  if (o.optimisation == "-O0") return;
  for (const SharedRead& read : shared.reads)
    result.warnings.push_back(read.where + ": warning: '" + read.variable + "' is written by " + read.writer +
                              "() and is not volatile; here it is read where it stands, XC16 at " +
                              o.optimisation + " may read it once and wait for ever");
}

}  // namespace

static BuildResult build_here(const BuildOptions& asked) {
  BuildOptions o = asked;
  auto start = std::chrono::steady_clock::now();
  BuildResult result;
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
  if (o.optimisation.empty()) o.optimisation = o.chip_way && !program.level.empty() ? program.level : "-O1";
  const auto& sources = program.sources;
  if (sources.empty() && !(o.chip_way && !program.assembler.empty())) {
    result.errors.push_back(no_program(o.source_dir));
    return finish();
  }
  LibraryCopies copies;
  std::size_t own = 0;  // of p.user, what is not a member of a copy of the library
  if (o.chip_way) {
    // drivers that a project brings along reach the registers they were written for
    const LibraryCopies split =
        find_library_members(o.source_dir, sources, program.unlisted, program.assembler);
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
  if (!o.chip_way && program.has_project)
    for (const fs::path& source : copies.replaced)
      if (!program.unlisted.count(source)) program.library_places.push_back(library_place(source));
  Plan p = plan(o, copies, program, false);
  if (p.is_webots && !o.chip_way) {
    result.errors.push_back(o.source_dir.string() +
                            ": program: got one for Webots' interfaces, expected one for the e-puck's "
                            "library; the first runs on the PC as it is, or on the robot: --way chip");
    return finish();
  }
  const bool has_settings = p.is_webots && !o.webots_settings.empty();
  if (has_settings) {
    const fs::path settings = o.cache_dir / ("webots-" + content_hash(o.webots_settings) + ".c");
    if (!fs::exists(settings, ec) && !write_text(settings, o.webots_settings)) {
      result.errors.push_back(settings.string() + ": cannot be written");
      return finish();
    }
    CompileJob job = p.user.front();
    job.source = settings;
    p.user.push_back(job);
  }
  if (p.is_webots) own = p.user.size();
  result.files = int(own + p.assembler.size()) - (has_settings ? 1 : 0);
  for (std::size_t i = own; i < p.user.size(); ++i) p.user[i].flags.push_back("--weak");
  std::vector<CompileJob> all = p.user;
  if (o.chip_way)
    all.insert(all.end(), p.assembler.begin(), p.assembler.end());
  else
    all.push_back(p.runtime);
  auto outcomes = compile_all(all, compiler_path(), o.cache_dir, o.jobs);
  const Library library = provide_library(o, p.is_webots);
  result.compiled += library.compiled;
  result.reused += library.reused;
  if (o.chip_way) read_shared_variables_in_place(all, outcomes, own, p.user.size(), library, o, result);
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
  sort_messages(library.messages, result, !library.ok);
  if (!ok || !library.ok) return finish();
  std::vector<CompileOutcome> user(outcomes.begin(), outcomes.begin() + long(own));
  std::vector<CompileOutcome> members(outcomes.begin() + long(own), outcomes.begin() + long(p.user.size()));
  members.erase(std::remove_if(members.begin(), members.end(), [](const auto& m) { return !m.ok; }),
                members.end());
  check_main(outcomes, p, own, o, result);
  if (!result.errors.empty()) return finish();
  if (!o.chip_way) tell_of_assembler(program, user, result);
  Renames renames;
  const auto choices = choose_drivers(user, members, p.user, program, o, result, renames);
  if (o.chip_way) {
    std::vector<bool> is_listed(outcomes.size());
    for (std::size_t i = 0; i < outcomes.size(); ++i)
      is_listed[i] = i < own || (i >= p.user.size() && !p.assembler_members.count(outcomes[i].source));
    check_second_definitions(outcomes, is_listed, program, choices, result);
  }
  if (!result.errors.empty()) return finish();
  std::vector<std::pair<std::string, std::string>> texts;
  for (const auto& s : o.chip_way ? find_library_copies(o.source_dir, sources).kept : copies.kept)
    if (!program.unlisted.count(s)) texts.emplace_back(s.filename().string(), read_text(s));
  for (auto& conflict : timer_conflicts(texts, replaced_headers(choices)))
    result.conflicts.push_back(std::move(conflict));

  fs::path output = fs::absolute(o.output);
  fs::create_directories(output.parent_path(), ec);
  if (o.chip_way) {
    std::vector<CompileOutcome> drivers;  // linked for their handlers, too
    for (auto it = outcomes.begin() + long(p.user.size()); it != outcomes.end(); ++it)
      (p.assembler_members.count(it->source) ? drivers : user).push_back(*it);
    // on the robot what a project lists is linked
    const auto is_listed = [&](const CompileOutcome& member) {
      return program.has_project && !program.unlisted.count(member.source);
    };
    std::copy_if(members.begin(), members.end(), std::back_inserter(drivers), is_listed);
    members.erase(std::remove_if(members.begin(), members.end(), is_listed), members.end());
    link_chip(user, drivers, members, program, library, renames, o, output, result);
    result.ok = result.errors.empty();
    return finish();
  }
  const fs::path half = unfinished(output);
  const fs::path script = source_root() / "hal_sim/cc/runtime/image.ld";
  look_at(script);
  std::vector<std::string> argv = {"ld", "-shared", "-Bsymbolic", "--warn-unresolved-symbols"};
  for (const char* word : {"now", "relro", "separate-code", "noexecstack", "defs"})
    argv.insert(argv.end(), {"-z", word});
  argv.insert(argv.end(), {"--build-id=none", "--hash-style=gnu", "--no-warn-mismatch", "-T", script.string(),
                           "-o", half.string()});
  for (const auto& u : user) argv.push_back(u.object.string());
  argv.push_back(outcomes.back().object.string());
  if (!members.empty()) {
    const Archive of_members = archive(members, o.cache_dir);
    if (!of_members.error.empty()) result.errors.push_back(of_members.error);
    argv.push_back(of_members.file.string());
  }
  argv.push_back(library.archive.string());
  auto link = run_process(argv);
  sort_linker_messages(link.output, program, source_root(), result);
  if (link.status != 0 && result.errors.empty()) result.errors.push_back("link: " + link.output);
  if (result.errors.empty()) {
    check_room(half, o.source_dir, result);
    std::ofstream(half, std::ios::binary | std::ios::app) << host::image_stamp(bytes_of(half));
    fs::rename(half, output, ec);
    if (ec) result.errors.push_back(output.string() + ": cannot write: " + ec.message());
    look_at(output);
  }
  fs::remove(half, ec);
  result.ok = result.errors.empty();
  return finish();
}

/// Variables that a handler writes, from a compilation for the chip: whoever reads one in a loop waits for
/// ever on the robot. What is told of a line already is not told twice.
static void lint_shared_variables(BuildOptions o, const LibraryCopies& copies, const Program& program,
                                  BuildResult& result) {
  o.chip_way = true;
  o.strict = o.sanitize = o.coverage = false;
  const Plan p = plan(o, copies, program, false);
  std::vector<FileFacts> files;
  for (const CompileOutcome& made : compile_all(p.user, compiler_path(), o.cache_dir, o.jobs))
    files.push_back({made.facts, true, true});
  for (const std::string& facts : provide_library(o, p.is_webots).facts)
    files.push_back({facts, false, false});
  for (const SharedRead& read : shared_variables(files).reads) {
    const auto is_told = [&](const std::string& warning) {
      return warning.rfind(read.where + ":", 0) == 0 &&
             warning.find("expected volatile") != std::string::npos;
    };
    if (std::none_of(result.warnings.begin(), result.warnings.end(), is_told))
      result.warnings.push_back(
          read.where + ": warning: " + read.variable + ": written by " + read.writer +
          "(); got a plain variable, expected volatile; XC16 may read it once at -O1 and "
          "wait for ever");
  }
}

static BuildResult lint_here(const BuildOptions& options) {
  BuildResult result;
  BuildOptions o = options;
  o.strict = true;
  std::error_code ec;
  auto sources = o.sources.empty() ? files_below(o.source_dir, ".c") : o.sources;
  if (sources.empty()) {
    result.errors.push_back(no_program(o.source_dir));
    return result;
  }
  BuildResult of_project;
  const LibraryCopies copies = find_library_copies(o.source_dir, sources);
  const Program program = program_of(o, of_project);
  if (o.optimisation.empty()) o.optimisation = "-O1";  // what would be said of -O0 holds at no other level
  // for the robot; then for the PC, whose stages know flags that want to be volatile: nothing else counts
  // there
  BuildOptions for_chip = o;
  for_chip.chip_way = true;
  const Plan on_chip = plan(for_chip, copies, program, true), on_pc = plan(o, copies, program, true);
  for (const Plan* p : {&on_chip, &on_pc}) {
    if (p == &on_pc && p->is_webots) continue;
    BuildResult found;
    for (const auto& outcome : compile_all(p->user, compiler_path(), o.cache_dir, o.jobs))
      sort_messages(outcome.messages, found, !outcome.ok);
    if (p == &on_chip) result.errors.insert(result.errors.end(), found.errors.begin(), found.errors.end());
    for (const std::string& warning : found.warnings)
      if ((p == &on_chip || warning.find("[-W") == std::string::npos) &&
          std::find(result.warnings.begin(), result.warnings.end(), warning) == result.warnings.end())
        result.warnings.push_back(warning);
  }
  if (result.errors.empty()) lint_shared_variables(o, copies, program, result);
  std::vector<std::pair<std::string, std::string>> texts;
  for (const auto& s : sources) texts.emplace_back(s.filename().string(), read_text(s));
  for (auto& conflict : timer_conflicts(texts, {})) result.warnings.push_back(conflict);
  result.ok = result.errors.empty() && result.warnings.empty();
  return result;
}

/// Files that are longer than any program's: what looks for words in them would take a stack to match. And
/// what has a source's name and is no file: a pipe would never end.
static std::vector<std::string> no_sources(const fs::path& folder) {
  std::vector<std::string> wrong;
  std::error_code ec;
  const auto skip = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it(folder, skip, ec), end; !ec && it != end; it.increment(ec)) {
    std::error_code odd;
    const fs::file_type type = it->status(odd).type();
    if (odd || type == fs::file_type::regular || type == fs::file_type::directory ||
        type == fs::file_type::not_found)
      continue;
    std::string kind = it->path().extension().string();
    std::transform(kind.begin(), kind.end(), kind.begin(), ::tolower);
    for (const char* of_source : {".c", ".h", ".s", ".inc", ".cpp", ".cc", ".cxx", ".hpp", ".o", ".a"})
      if (kind == of_source)
        wrong.push_back(it->path().string() + ": source: got a pipe or a device, expected a file");
  }
  ec.clear();
  for (const char* kind : {".c", ".h", ".mcp", ".xml"})
    for (const fs::path& file : files_below(folder, kind))
      if (const auto bytes = fs::file_size(file, ec); !ec && bytes > kLongestSourceBytes)
        wrong.push_back(file.string() + ": source: got " + std::to_string(bytes) +
                        " bytes, expected at most " + std::to_string(kLongestSourceBytes));
  return wrong;
}

/// Both begin alike: with what they may look at, and on a stack that is large enough.
template <typename Work>
static BuildResult begin(const BuildOptions& options, BuildInputs& inputs, const Work& work) {
  BuildResult refused;
  refused.errors = no_sources(options.source_dir);
  if (!refused.errors.empty()) return refused;
  return on_large_stack([&] {
    const NotingInputs noting(inputs);
    return work(options);
  });
}

static BuildOptions with_cache(BuildOptions o) {
  if (o.cache_dir.empty()) o.cache_dir = build_root() / "firmware-cache";
  o.cache_dir = fs::absolute(o.cache_dir);
  if (!o.hal.empty()) o.chip_way = true;
  if (o.chip_way && o.hal.empty()) o.hal = "dspic";
  return o;
}

BuildResult build_image(const BuildOptions& options) {
  const BuildOptions o = with_cache(options);
  const BuildRecord record(o);
  if (auto known = record.recall()) return *known;
  // one build of an image at a time: its files and its record are of the same one
  const FileLock lock(record.lock_file());
  if (auto known = record.recall()) return *known;
  BuildInputs inputs;
  BuildResult result = begin(o, inputs, build_here);
  if (result.ok) record.keep(result, inputs.all);
  return result;
}

BuildResult lint_folder(const BuildOptions& options) {
  BuildInputs inputs;
  return begin(with_cache(options), inputs, lint_here);
}

}  // namespace cc
