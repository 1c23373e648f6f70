// SPDX-License-Identifier: MIT
// See build.h. Objects of the controller come first; the API and the libc follow as archives of weak symbols,
// so whatever a program defines itself (wait, getselector, an e_ function) takes the place of ours.
#include "build.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <iterator>
#include <set>

#include "build_plan.h"
#include "build_record.h"
#include "compiler/cache/elf_reader.h"
#include "compiler/cache/inputs.h"
#include "compiler/cache/object_cache.h"
#include "compiler/cache/shared_variables.h"
#include "compiler/projects/driver_variants.h"
#include "compiler/projects/original_objects.h"
#include "compiler/projects/program_files.h"
#include "compiler/projects/timer_owners.h"
#include "install/cache_bound.h"
#include "install/places.h"
#include "large_stack.h"
#include "library_objects.h"
#include "link_chip.h"
#include "link_messages.h"

namespace cc {
namespace fs = std::filesystem;
namespace {

/// `outcomes`: of all C files, the program's own first; those of assembler follow, whose labels are no
/// functions, and which may have a start-up of their own instead.
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
  for (std::size_t i = 0; i < p.assembler.size(); ++i)
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

/// The forms of drivers that the program shall call (driver_variants.h), which the linker
/// sees to by `renames`.
std::vector<DriverChoice> choose_drivers(const std::vector<CompileOutcome>& user,
                                         const std::vector<CompileOutcome>& members,
                                         const std::vector<CompileJob>& jobs, const Program& program,
                                         const BuildOptions& o, BuildResult& result, Renames& renames) {
  const fs::path contract = include_root(o);
  ProgramSymbols symbols;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < user.size(); ++i) {
    for (const auto& s : read_elf(user[i].object).symbols) {
      if (!s.is_global) continue;
      (s.is_defined ? symbols.defined : symbols.wanted).insert(s.name);
    }
    texts.push_back(read_text(jobs[i].source));
  }
  // a driver that the project brings along is the program's own, whatever header declares it
  std::set<std::string> wanted_by_members;
  for (const CompileOutcome& member : members)
    for (const auto& s : read_elf(member.object).symbols)
      if (s.is_global) (s.is_defined ? symbols.defined : wanted_by_members).insert(s.name);
  for (const fs::path& header : files_below(o.source_dir, ".h"))
    if (library_place(fs::path(header).replace_extension(".c")).empty()) texts.push_back(read_text(header));
  auto choices = choose_driver_forms(symbols, program.library_places, texts, contract);
  for (const std::string& wrong : functions_of_two_drivers(symbols, choices, contract))
    result.errors.push_back(o.source_dir.string() + ": " + wrong);
  symbols.wanted.insert(wanted_by_members.begin(), wanted_by_members.end());
  renames = {renamed_functions(symbols, choices, contract), own_functions(symbols, contract)};
  for (const DriverChoice& choice : choices)
    if (!choice.told.empty()) result.conflicts.push_back(o.source_dir.string() + ": warning: " + choice.told);
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
      if (!s.is_global) continue;
      if (s.is_defined) functions.defined.insert(s.name);
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

/// What handlers of any file write is read where it stands in all files. A file that was compiled
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
  const auto made = compile_all(again, compiler_path(), {o.cache_dir, {}}, o.jobs);
  for (std::size_t i = 0; i < made.size(); ++i) outcomes[places[i]] = made[i];
  if (o.optimisation == "-O0") return;
  for (const SharedRead& read : shared.reads)
    result.warnings.push_back(read.where + ": warning: '" + read.variable + "' is written by " + read.writer +
                              "() and is not volatile; here it is read where it stands, XC16 at " +
                              o.optimisation + " may read it once and wait for ever");
}

/// Whether all files of the program may be read; those of a submission must be its own.
bool is_readable(const Plan& p, const Program& program, BuildResult& result) {
  BuildInputs& inputs = *inputs_of_build();
  const auto check = [&](const fs::path& file, const char* what) {
    if (!may_read(file))
      inputs.refuse(file, what);
    else if (::access(file.c_str(), R_OK) != 0)
      result.errors.push_back(file.string() + ": " + what + ": cannot be read: " + std::strerror(errno));
  };
  for (const auto* jobs : {&p.user, &p.assembler})
    for (const CompileJob& job : *jobs) check(job.source, "source");
  for (const fs::path& file : program.objects) check(file, "object");
  const std::vector<std::string> refusals = inputs.refusals();
  result.errors.insert(result.errors.end(), refusals.begin(), refusals.end());
  result.is_bad_input = !result.errors.empty();
  return result.errors.empty();
}

/// A build on its way from a folder to an image. Each step returns whether there is anything to go on with;
/// `result` says why not.
class Building {
 public:
  explicit Building(const BuildOptions& asked) : o(asked) {}

  BuildResult run() {
    const auto start = std::chrono::steady_clock::now();
    result.ok = find() && add_settings() && compile() && choose() && link();
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

 private:
  bool find();
  bool add_settings();
  bool compile();
  bool choose();
  bool link();

  bool is_of_library(std::size_t i) const { return i >= own && i < p.user.size(); }
  bool refuse(std::string why) {
    result.is_bad_input = true;
    result.errors.push_back(std::move(why));
    return false;
  }

  BuildOptions o;
  BuildResult result;
  Program program;
  LibraryCopies split;  // what the program's files are: its own, and members of copies of the library
  Plan p;
  std::size_t own = 0;                   // of p.user, what is no member of a copy of the library
  std::vector<CompileOutcome> outcomes;  // of p.user, then of p.assembler
  Library library;
  std::vector<CompileOutcome> user, members;  // of the outcomes: the program's, those of copies
  Renames renames;
};

/// Which files are the program, and what they are compiled with.
bool Building::find() {
  std::error_code ec;
  if (!fs::is_directory(o.source_dir, ec))
    return refuse(o.source_dir.string() + ": controller: got no such folder, expected one with a main.c");
  program = program_of(o, result);
  if (o.optimisation.empty()) o.optimisation = !program.level.empty() ? program.level : "-O1";
  if (program.sources.empty() && program.assembler.empty()) return refuse(no_program(o.source_dir));
  // drivers that a project brings along reach the registers they were written for
  split = find_library_members(o.source_dir, program.sources, program.unlisted, program.assembler);
  LibraryCopies copies = split;
  copies.kept.insert(copies.kept.end(), split.members.begin(), split.members.end());
  own = program.order(copies, split.kept.size());
  if (const std::string told = library_copies_message(o.source_dir, copies); !told.empty())
    result.warnings.push_back(told);
  p = plan(o, copies, program, false);
  return is_readable(p, program, result);
}

/// A program for Webots' interfaces gets what the world says of them as one more file.
bool Building::add_settings() {
  const bool has_settings = p.is_webots && !o.webots_settings.empty();
  if (has_settings) {
    std::error_code ec;
    const fs::path settings = o.cache_dir / ("webots-" + content_hash(o.webots_settings) + ".c");
    if (!fs::exists(settings, ec) && !write_text(settings, o.webots_settings))
      return refuse(settings.string() + ": cannot be written");
    CompileJob job = p.user.front();
    job.source = settings;
    if (!o.within.empty()) job.flags.insert(job.flags.end(), {"--within", settings.string()});
    p.user.push_back(job);
  }
  if (p.is_webots) own = p.user.size();
  result.files = int(own + p.assembler.size()) - (has_settings ? 1 : 0);
  // Compile all of it, and the library; variables that handlers share may ask for a second time.
  for (std::size_t i = own; i < p.user.size(); ++i) p.user[i].flags.push_back("--weak");
  return true;
}

bool Building::compile() {
  std::vector<CompileJob> all = p.user;
  all.insert(all.end(), p.assembler.begin(), p.assembler.end());
  outcomes = compile_all(all, compiler_path(), {o.cache_dir, {}}, o.jobs);
  library = provide_library(o, p.is_webots);
  result.compiled += library.compiled;
  result.reused += library.reused;
  read_shared_variables_in_place(all, outcomes, own, p.user.size(), library, o, result);
  bool ok = library.ok;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (!outcomes[i].ok && is_of_library(i)) {
      // a copy of the library holds files that the project never compiled
      result.warnings.push_back(p.user[i].source.string() + ": does not compile and is left out, as " +
                                (program.unlisted.count(p.user[i].source)
                                     ? "it is no part of the program: "
                                     : "a file of a copy of the library: ") +
                                first_error(outcomes[i].messages));
      continue;
    }
    // warnings of a library are not the user's
    if (!is_of_library(i)) sort_messages(outcomes[i].messages, result, !outcomes[i].ok);
    ok = ok && outcomes[i].ok;
    ++(outcomes[i].reused ? result.reused : result.compiled);
  }
  sort_messages(library.messages, result, !library.ok);
  return ok;
}

/// One main(), one form of each driver, one definition of each function, one owner of each timer.
bool Building::choose() {
  user.assign(outcomes.begin(), outcomes.begin() + long(own));
  std::copy_if(outcomes.begin() + long(own), outcomes.begin() + long(p.user.size()),
               std::back_inserter(members), [](const auto& m) { return m.ok; });
  check_main(outcomes, p, own, o, result);
  if (!result.errors.empty()) return false;
  const auto choices = choose_drivers(user, members, p.user, program, o, result, renames);
  std::vector<bool> is_linked(outcomes.size());
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    is_linked[i] = i < own || (i >= p.user.size() && !p.assembler_members.count(outcomes[i].source));
  check_second_definitions(outcomes, is_linked, program, choices, result);
  if (!result.errors.empty()) return false;
  std::vector<std::pair<std::string, std::string>> texts;
  for (const auto& s : split.kept)
    if (!program.unlisted.count(s)) texts.emplace_back(s.filename().string(), read_text(s));
  for (auto& conflict : timer_conflicts(texts, replaced_headers(choices)))
    result.conflicts.push_back(std::move(conflict));
  return true;
}

bool Building::link() {
  std::error_code ec;
  const fs::path output = fs::absolute(o.output);
  const fs::path folder = output.parent_path();
  fs::create_directories(folder, ec);
  if (ec)
    return refuse(o.output.string() + ": image: got the folder " + folder.string() +
                  ", which does not exist and cannot be made (" + ec.message() +
                  "), expected one that exists");
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
  return result.errors.empty();
}

}  // namespace

static BuildResult build_here(const BuildOptions& asked) { return Building(asked).run(); }

/// Variables that a handler writes: whoever reads one in a loop waits for ever on the robot. What is told of
/// a line already is not told twice.
static void lint_shared_variables(BuildOptions o, const LibraryCopies& copies, const Program& program,
                                  BuildResult& result) {
  o.strict = o.sanitize = false;
  const Plan p = plan(o, copies, program, false);
  std::vector<FileFacts> files;
  for (const CompileOutcome& made : compile_all(p.user, compiler_path(), {o.cache_dir, {}}, o.jobs))
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

/// Nothing is compiled.
static BuildResult refused(std::vector<std::string> why) {
  BuildResult result;
  result.is_bad_input = true;
  result.errors = std::move(why);
  return result;
}

static BuildResult lint_here(const BuildOptions& options) {
  BuildResult result;
  BuildOptions o = options;
  o.strict = true;
  auto sources = o.sources.empty() ? files_below(o.source_dir, ".c") : o.sources;
  if (sources.empty()) return refused({no_program(o.source_dir)});
  BuildResult of_project;
  const LibraryCopies copies = find_library_members(o.source_dir, sources);
  const Program program = program_of(o, of_project);
  if (o.optimisation.empty()) o.optimisation = "-O1";  // what would be said of -O0 holds at no other level
  const Plan p = plan(o, copies, program, true);
  if (!is_readable(p, program, result)) return result;
  for (const auto& outcome : compile_all(p.user, compiler_path(), {o.cache_dir, {}}, o.jobs))
    sort_messages(outcome.messages, result, !outcome.ok);
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
  if (const std::size_t files = files_below(folder, {".c", ".s"}).size(); files > kMostSources)
    wrong.push_back(folder.string() + ": project: got " + std::to_string(files) +
                    " files in C and assembler, expected at most " + std::to_string(kMostSources) +
                    "; is it one program's folder?");
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
  inputs.readable = readable_files(options);
  if (!inputs.readable.has(options.source_dir)) inputs.refuse(options.source_dir, "project");
  std::vector<std::string> wrong = inputs.refusals();
  if (wrong.empty()) wrong = no_sources(options.source_dir);
  if (!wrong.empty()) return refused(std::move(wrong));
  return on_large_stack([&] {
    const NotingInputs noting(inputs);
    return work(options);
  });
}

constexpr int kAttempts = 4;  // where somebody removes the cache meanwhile

/// The submission that a folder belongs to; empty: it is the user's own. Who grades a class says where one lies, by the
/// environment: tests build programs of theirs as well.
static fs::path submission_of(const fs::path& folder) {
  const fs::path own = submission();
  const bool is_its =
      !own.empty() && (is_named_below(folder, own) || ReadableFiles({own.string()}).has(folder));
  return is_its ? own : fs::path();
}

static BuildOptions with_cache(BuildOptions o) {
  if (o.within.empty()) o.within = submission_of(o.source_dir);
  if (o.cache_dir.empty()) o.cache_dir = places::cache_folder("objects");
  o.cache_dir = fs::absolute(o.cache_dir);
  if (o.hal.empty()) o.hal = "dspic";
  return o;
}

BuildResult build_image(const BuildOptions& options) {
  const BuildOptions o = with_cache(options);
  if (const std::string wrong = places::why_not_writable(o.cache_dir); !wrong.empty())
    return refused({wrong});
  const BuildRecord record(o);
  if (auto known = record.recall()) return *known;
  BuildResult result;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    // one build of an image at a time: its files and its record are of the same one
    const FileLock lock(record.lock_file());
    if (auto known = record.recall()) return *known;
    BuildInputs inputs;
    result = begin(o, inputs, build_here);
    if (result.ok) record.keep(result, inputs.all);
    if (result.ok || !(lock.is_gone() || inputs.has_lost_one())) break;
  }
  if (result.compiled > 0) places::keep_caches_within_bound();
  return result;
}

BuildResult lint_folder(const BuildOptions& options) {
  BuildInputs inputs;
  const BuildOptions o = with_cache(options);
  if (const std::string wrong = places::why_not_writable(o.cache_dir); !wrong.empty())
    return refused({wrong});
  return begin(o, inputs, lint_here);
}

}  // namespace cc
