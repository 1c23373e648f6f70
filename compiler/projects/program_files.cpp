// SPDX-License-Identifier: MIT
// See program_files.h.
#include "program_files.h"

#include "compiler/cache/inputs.h"
#include "compiler/cache/object_cache.h"
#include "makefile_project.h"
#include "mplab_project.h"
#include "sim_core/base/pattern.h"

namespace cc {
namespace fs = std::filesystem;

std::vector<fs::path> files_below(const fs::path& folder, std::initializer_list<const char*> extensions) {
  std::vector<std::pair<std::ptrdiff_t, fs::path>> found;  // place of its extension, file
  std::error_code ec;
  look_at(folder);
  for (fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, ec), end;
       it != end && !ec; it.increment(ec)) {
    std::error_code odd;  // a loop of links is neither folder nor file
    if (it->is_directory(odd)) {
      const std::string name = it->path().filename().string();
      if (name.size() > 1 && name[0] == '.')
        it.disable_recursion_pending();
      else
        look_at(it->path());
      continue;
    }
    std::string end_of_name = it->path().extension().string();
    std::transform(end_of_name.begin(), end_of_name.end(), end_of_name.begin(), ::tolower);
    const auto place = std::find(extensions.begin(), extensions.end(), end_of_name);
    if (place != extensions.end() && it->is_regular_file(odd))
      found.emplace_back(place - extensions.begin(), it->path());
  }
  std::sort(found.begin(), found.end());
  std::vector<fs::path> files;
  for (auto& file : found) files.push_back(std::move(file.second));
  return files;
}

std::vector<fs::path> files_below(const fs::path& folder, const char* extension) {
  return files_below(folder, {extension});
}

bool names_webots(const std::vector<fs::path>& sources, const std::vector<fs::path>& headers) {
  static const sim::Pattern kInclude(R"(#\s*include\s*[<"](webots|device)[/\\])");
  for (const auto* list : {&sources, &headers})
    for (const auto& file : *list)
      if (std::regex_search(read_text(file), kInclude)) return true;
  return false;
}

namespace {

/// Of a C file that is a link to what is not there, or not to be seen from here; empty: there is none.
std::string dead_link(const fs::path& folder) {
  std::error_code odd;
  for (fs::recursive_directory_iterator it(folder, odd), end; it != end && !odd; it.increment(odd)) {
    std::error_code none;
    const fs::path file = it->path();
    if (file.extension() != ".c" || !it->is_symlink(none) || fs::exists(file, none)) continue;
    const fs::path to = fs::weakly_canonical(file.parent_path() / fs::read_symlink(file, none), none);
    const std::string below = to.lexically_relative(fs::weakly_canonical(folder, none)).string();
    const bool is_outside = below.empty() || below.rfind("..", 0) == 0;
    return file.string() + ": source: got a link to " + to.string() +
           (is_outside ? ", which lies outside " + folder.string() : ", where nothing is") +
           ", expected a file of the folder";
  }
  return {};
}

}  // namespace

std::string no_program(const fs::path& folder) {
  if (std::string dead = dead_link(folder); !dead.empty()) return dead;
  // a controller's own test lies beside it, with programs in its texts
  const bool has_c = !files_below(folder, ".c").empty();
  for (const fs::path& file : files_below(folder, {".cpp", ".cc", ".cxx"}))
    if (!has_c || (file.filename() != "test.cpp" && defines_main(file)))
      return file.string() + ": program: got C++, expected C; programs of the robot are in C, as XC16 has it";
  std::error_code wrong;
  const fs::directory_iterator readable(folder, wrong);
  if (wrong) return folder.string() + ": controller: cannot be read: " + wrong.message();
  const std::string got = folder.string() + ": controller: got ";
  if (has_c)
    return folder.string() + ": main(): got no definition, expected one; is this a controller's folder?";
  if (!files_below(folder, ".py").empty())
    return got + "a program in Python, expected one in C; Python runs on the PC alone";
  return got + "no .c file, expected at least one";
}

namespace {

/// Of several main() that which lies nearest to the folder is the program's; folders of the others, such as
/// the examples of a library that a project carries along, are there for whatever asks for them.
void leave_out_other_programs(Program& program, const fs::path& folder, BuildResult& result) {
  std::vector<std::pair<std::ptrdiff_t, fs::path>> mains;  // depth, file
  for (const fs::path& source : program.sources)
    if (defines_main(source)) {
      const fs::path below = source.lexically_relative(folder);
      mains.emplace_back(std::distance(below.begin(), below.end()), source);
    }
  std::sort(mains.begin(), mains.end());
  if (mains.size() < 2 || mains[0].first == mains[1].first) return;
  for (std::size_t i = 1; i < mains.size(); ++i)
    for (const fs::path& source : program.sources)
      if (const fs::path home = mains[i].second.parent_path();
          std::mismatch(home.begin(), home.end(), source.begin(), source.end()).first == home.end())
        program.unlisted.insert(source);
  result.warnings.push_back(folder.string() + ": main(): got " + std::to_string(mains.size()) +
                            " definitions, expected 1; " +
                            mains[0].second.lexically_relative(folder).string() +
                            " is taken, and of the folders of the others what it asks for");
}

/// Archives of the chip's objects. Single objects beside sources are what somebody's compiler left there.
std::vector<fs::path> archives_below(const fs::path& folder) {
  std::vector<fs::path> archives = files_below(folder, ".a");
  const auto is_foreign = [](const fs::path& file) {
    constexpr std::size_t kMachine = 18;  // place of e_machine in an ELF file
    constexpr char kDspic30f = 118;
    const std::string text = read_text(file);
    const std::size_t member = text.find("\177ELF");
    return text.rfind("!<arch>\n", 0) != 0 || member == std::string::npos ||
           text.size() <= member + kMachine || text[member + kMachine] != kDspic30f;
  };
  archives.erase(std::remove_if(archives.begin(), archives.end(), is_foreign), archives.end());
  return archives;
}

/// A project of MPLAB that lists files which are gone, beside a Makefile of a program; empty: it is none.
std::string why_stale(const MplabProject& project, const fs::path& folder) {
  const std::size_t missing = static_cast<std::size_t>(project.missing);
  if (missing <= project.library_places.size()) return {};  // what is not there is the library's
  const auto makefile = read_makefile(folder);
  if (!makefile || std::none_of(makefile->sources.begin(), makefile->sources.end(), defines_main)) return {};
  return project.file.string() + ": project: got " + std::to_string(missing) + " C " +
         (missing == 1 ? "file that is" : "files that are") +
         " missing, expected all that it lists; the Makefile is taken";
}

}  // namespace

Program program_of(const BuildOptions& o, BuildResult& result) {
  Program program;
  program.sources = o.sources.empty() ? files_below(o.source_dir, ".c") : o.sources;
  if (!o.sources.empty()) return program;
  // A project of MPLAB says what the program is, else a Makefile does.
  const bool is_webots = names_webots(program.sources, files_below(o.source_dir, ".h"));
  std::string told;
  auto project = is_webots ? std::nullopt : find_mplab_project(o.source_dir, told);
  if (!told.empty()) result.warnings.push_back(told);
  if (const std::string stale = project ? why_stale(*project, o.source_dir) : ""; !stale.empty()) {
    result.warnings.push_back(stale);
    project.reset();
  }
  if (!project && (project = read_makefile(o.source_dir))) {
    for (const fs::path& file : files_below(o.source_dir, ".s"))
      if (std::find(project->assembler.begin(), project->assembler.end(),
                    fs::absolute(file).lexically_normal()) == project->assembler.end()) {
        project->assembler.push_back(file);
        program.unlisted_assembler.insert(file);
      }
    project->objects = archives_below(o.source_dir);
    // its settings count in any case, its list when it has a program
    program.include_dirs = project->include_dirs;
    program.defines = project->defines;
    program.standard = project->standard;
    program.level = project->level;
    if (std::none_of(project->sources.begin(), project->sources.end(), defines_main)) project.reset();
  }
  if (is_webots && project &&
      std::count_if(project->sources.begin(), project->sources.end(), defines_main) == 1) {
    program.sources = project->sources;
    program.is_exact = true;
    return program;
  }
  // Without a project all that lies in the folder may be the program's.
  program.assembler = project ? project->assembler : files_below(o.source_dir, ".s");
  program.objects = project ? project->objects : archives_below(o.source_dir);
  if (!project || is_webots) {
    if (!is_webots) leave_out_other_programs(program, o.source_dir, result);
    return program;
  }
  // With one, what it lists is the program; other files of the folder are linked only when asked for.
  program.defines = project->defines;
  program.standard = project->standard;
  program.level = project->level;
  program.library_places = project->library_places;
  program.include_dirs = project->include_dirs;
  program.has_project = true;
  std::set<fs::path> listed;
  for (const fs::path& source : project->sources) listed.insert(fs::weakly_canonical(source));
  for (const fs::path& source : program.sources)
    if (!listed.erase(fs::weakly_canonical(source))) program.unlisted.insert(source);
  // what lies elsewhere and is the library's is ours to bring
  const std::size_t in_folder = program.sources.size(),
                    listed_in_folder = in_folder - program.unlisted.size();
  for (const fs::path& source : listed)
    if (const std::string place = library_place(source); place.empty())
      program.sources.push_back(source);
    else
      program.library_places.push_back(place);
  // Files of archives that the project links.
  const std::size_t of_program = program.sources.size();
  for (const fs::path& source : project->library_sources)
    if (std::none_of(program.sources.begin(), program.sources.end(), [&](const fs::path& known) {
          return fs::weakly_canonical(known) == fs::weakly_canonical(source);
        })) {
      program.sources.push_back(source);
      program.unlisted.insert(source);
    }
  if (in_folder > listed_in_folder || of_program > in_folder)
    result.warnings.push_back(
        project->file.string() + ": project: lists " + std::to_string(listed_in_folder) +
        " of the folder's " + std::to_string(in_folder) + " C files and " +
        std::to_string(of_program - in_folder) +
        " elsewhere; files that it does not list are linked only where something asks for them");
  return program;
}

}  // namespace cc
