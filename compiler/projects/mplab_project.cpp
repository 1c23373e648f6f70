// SPDX-License-Identifier: MIT
#include "mplab_project.h"

#include <algorithm>
#include <cctype>
#include <pugixml.hpp>
#include <sstream>
#include <string>

#include "compiler/cache/inputs.h"
#include "compiler/cache/object_cache.h"
#include "library_copies.h"
#include "sim_core/base/pattern.h"

namespace cc {
namespace fs = std::filesystem;
namespace {

/// What `name` is called in `folder` whatever its case, or an empty path.
fs::path entry_of(const fs::path& folder, const std::string& name) {
  std::error_code ec;
  if (name == "." || name == "..") return folder / name;
  look_at(folder);
  if (fs::exists(folder / name, ec)) return folder / name;
  for (fs::directory_iterator it(folder, ec), end; !ec && it != end; it.increment(ec))
    if (lower(it->path().filename().string()) == lower(name)) return it->path();
  return {};
}

fs::path below(const fs::path& folder, const std::vector<std::string>& parts, std::size_t first) {
  fs::path at = folder;
  for (std::size_t i = first; i < parts.size() && !at.empty(); ++i) at = entry_of(at, parts[i]);
  return at;
}

/// The values of "key=value" lines of one section.
std::vector<std::string> values_of(const std::string& text, const std::string& section,
                                   const std::string& key) {
  std::vector<std::string> values;
  std::istringstream lines(text);
  bool is_inside = false;
  for (std::string line; std::getline(lines, line);) {
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
    if (line.rfind('[', 0) == 0) is_inside = line == "[" + section + "]";
    const std::size_t sign = line.find('=');
    if (is_inside && sign != std::string::npos && line.rfind(key, 0) == 0)
      values.push_back(line.substr(sign + 1));
  }
  return values;
}

constexpr const char* kLevelUnsaid = "-O0";  // gcc's

struct Listed {
  std::vector<std::string> files, include_dirs;  // as written; folders separated by ';'
  CompilerOptions options;
  std::vector<std::string> archives;  // that are linked, as written
};

Listed read_mcp(const std::string& text) {
  // the settings of C30 and XC16 among those of the other tools
  constexpr const char* kCompiler = "TS{25AC22BD-2378-4FDB-BFB6-7345A15512D3}";
  Listed listed{values_of(text, "FILE_INFO", "file_"), values_of(text, "PATH_INFO", "dir_inc"), {}, {}};
  std::string options;
  for (const std::string& value : values_of(text, "TOOL_SETTINGS", kCompiler)) options += value + " ";
  listed.options = compiler_options(options);
  if (listed.options.level.empty() && !options.empty()) listed.options.level = kLevelUnsaid;
  return listed;
}

/// What configurations.xml lists of configuration `name`; of all where there is none of that name. `told`: where
/// the file is no XML.
Listed read_configurations(const fs::path& file, const std::string& name, std::string& told) {
  const std::string text = read_text(file);
  pugi::xml_document all;
  if (const auto read = all.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_fragment);
      !read)
    told = file.string() + ":" +
           std::to_string(1 + std::count(text.begin(), text.begin() + read.offset, '\n')) +
           ": got XML that breaks off (" + read.description() +
           "), expected all that MPLAB X writes; what comes before is taken";
  // settings of other configurations count only where the wanted one is missing
  pugi::xml_node settings = all;
  for (const pugi::xpath_node& at : all.select_nodes("//conf"))
    if (at.node().attribute("name").value() == name) settings = at.node();
  const auto values = [&](const char* path) {
    std::vector<std::string> found;
    for (const pugi::xpath_node& at : settings.select_nodes(path))
      found.emplace_back(at.attribute() ? at.attribute().value() : at.node().child_value());
    return found;
  };

  // Its files, but for those that this configuration leaves out, and folders of headers.
  Listed listed{values("//itemPath[text()]"),
                values(".//property[@key='extra-include-directories' or @key='common-include-directories' or "
                       "@key='extra-include-directories-for-assembler' or "
                       "@key='common-include-directories-for-assembler']/@value"),
                {},
                values(".//linkerLibFileItem[text()]")};
  const std::vector<std::string> excluded = values(".//item[@ex='true']/@path");
  const auto is_out = [&](const std::string& f) {
    return std::find(excluded.begin(), excluded.end(), f) != excluded.end();
  };
  listed.files.erase(std::remove_if(listed.files.begin(), listed.files.end(), is_out), listed.files.end());
  // of another project: its folder, and where below it the archive is made
  for (const pugi::xpath_node& at : settings.select_nodes(".//makeArtifact"))
    listed.archives.push_back(std::string(at.node().attribute("PL").value()) + "/" +
                              at.node().attribute("OP").value());
  // macros of the compiler, not of the assembler or the linker
  std::string options;
  for (const std::string& list : values("(.//C30)[1]//property[@key='preprocessor-macros']/@value")) {
    std::istringstream in(list);
    for (std::string macro; std::getline(in, macro, ';');)
      if (!macro.empty()) options += "-D" + macro + " ";
  }
  // "", "0", "1" or "-O1"
  for (const std::string& level : values("((.//C30)[1]//property[@key='optimization-level'])[1]/@value"))
    if (!level.empty()) options += (level[0] == '-' ? "" : "-O") + level + " ";
  for (const std::string& more : values("(.//C30)[1]//appendMe/@value")) options += more + " ";
  listed.options = compiler_options(options);
  if (listed.options.level.empty() && settings.select_node(".//C30")) listed.options.level = kLevelUnsaid;
  return listed;
}

/// An archive that a project links: the file, or the C files of the project that makes it,
/// "../lib.X/dist/default/production/lib.X.a", which are there for whatever asks for them.
void add_archive(MplabProject& project, const fs::path& home, const std::string& archive, std::string& told) {
  std::error_code ec;
  if (const fs::path file = resolve_path(home, archive).lexically_normal();
      !file.empty() && fs::is_regular_file(file, ec)) {
    project.objects.push_back(file);
    return;
  }
  // No file yet: the project beside this one that would make it.
  std::string written = archive;
  std::replace(written.begin(), written.end(), '\\', '/');
  const std::size_t made = written.rfind("/dist/");
  if (made == std::string::npos) return;
  const fs::path sister = resolve_path(home, written.substr(0, made)).lexically_normal();
  const fs::path file = sister / "nbproject/configurations.xml";
  look_at(file);
  if (sister.empty() || !fs::is_regular_file(file, ec)) return;
  const std::size_t name = made + std::char_traits<char>::length("/dist/");
  const Listed listed = read_configurations(file, written.substr(name, written.find('/', name) - name), told);
  // Its files are there for whatever asks for them, and so are its folders of headers.
  for (const std::string& source : listed.files) {
    const fs::path found = resolve_path(sister, source).lexically_normal();
    if (found.empty() || !fs::is_regular_file(found, ec)) continue;
    const std::string kind = lower(found.extension().string());
    if (kind == ".c" && !defines_main(found)) project.library_sources.push_back(found);
    if (kind == ".s") project.assembler.push_back(found);
  }
  project.include_dirs.push_back(sister);
  for (const std::string& list : listed.include_dirs)
    for (std::istringstream in(list); std::getline(in, written, ';');)
      if (const fs::path folder = resolve_path(sister, written).lexically_normal();
          !folder.empty() && fs::is_directory(folder, ec))
        project.include_dirs.push_back(folder);
}

/// A project and its home: the folder that its relative paths start from.
std::optional<MplabProject> read_project(const fs::path& file, const fs::path& home, std::string& told) {
  const Listed listed = lower(file.extension().string()) == ".mcp" ? read_mcp(read_text(file))
                                                                   : read_configurations(file, "", told);
  MplabProject project;
  project.file = file;
  project.defines = listed.options.defines;
  project.standard = listed.options.standard;
  project.level = listed.options.level;
  // Files that are there, by kind. One that is missing may be the library's.
  bool has_main = false;
  std::error_code ec;
  for (const std::string& name : listed.files) {
    const fs::path found = resolve_path(home, name).lexically_normal();
    const std::string extension = lower(fs::path(name).extension().string());
    const bool exists = !found.empty() && fs::is_regular_file(found, ec);
    if (extension == ".s" && exists) project.assembler.push_back(found);
    if ((extension == ".o" || extension == ".a") && exists) project.objects.push_back(found);
    if (extension != ".c") continue;
    if (!exists) {
      ++project.missing;
      std::string written = name;
      std::replace(written.begin(), written.end(), '\\', '/');
      if (const std::string place = library_place(written); !place.empty())
        project.library_places.push_back(place);
    }
    if (!exists || std::find(project.sources.begin(), project.sources.end(), found) != project.sources.end())
      continue;
    project.sources.push_back(found);
    has_main = has_main || defines_main(found);
  }
  // A project without a main() makes a library.
  if (!has_main) return std::nullopt;
  for (const std::string& archive : listed.archives) add_archive(project, home, archive, told);
  const auto add_folder = [&](const std::string& name) {
    const fs::path found = resolve_path(home, name).lexically_normal();
    if (!found.empty() && fs::is_directory(found, ec)) project.include_dirs.push_back(found);
  };
  for (const std::string& name : listed.options.include_dirs) add_folder(name);
  for (const std::string& list : listed.include_dirs) {
    std::istringstream in(list);
    for (std::string name; std::getline(in, name, ';');) {
      name.erase(std::remove(name.begin(), name.end(), '"'), name.end());
      add_folder(name);
    }
  }
  return project;
}

}  // namespace

fs::path resolve_path(const fs::path& home, std::string text) {
  std::replace(text.begin(), text.end(), '\\', '/');
  const bool is_absolute = text.size() > 1 && (text[0] == '/' || text[1] == ':');
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, '/');)
    if (!part.empty() && part.back() != ':') parts.push_back(part);
  constexpr std::size_t kMostParts = 100;  // each is looked for in turn, and from every later one on
  if (parts.empty() || parts.size() > kMostParts) return {};
  if (!is_absolute) return below(home, parts, 0);
  constexpr int kAncestors = 3;
  for (std::size_t first = 0; first < parts.size(); ++first) {
    fs::path at = home;
    for (int up = 0; up <= kAncestors; ++up, at = at.parent_path())
      if (fs::path found = below(at, parts, first); !found.empty() && may_read(found)) return found;
  }
  return {};
}

namespace {

/// "1" of "-O1" as ours; -O is -O1, -O3 does what -O2 does here.
std::string level_of(const std::string& written) {
  if (written == "0" || written == "1" || written == "2" || written == "s") return "-O" + written;
  return written.empty() ? "-O1" : written == "3" ? "-O2" : "";
}

}  // namespace

CompilerOptions compiler_options(const std::string& command_line) {
  // words, in which quotes join
  std::vector<std::string> words(1);
  char quote = 0;
  for (char c : command_line) {
    if (quote ? c == quote : c == '"' || c == '\'')
      quote = quote ? 0 : c;
    else if (!quote && std::isspace(static_cast<unsigned char>(c)))
      words.emplace_back();
    else
      words.back() += c;
  }
  CompilerOptions options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto value = [&] {
      return word.size() > 2 ? word.substr(2) : i + 1 < words.size() ? words[++i] : std::string();
    };
    if (word.rfind("-I", 0) == 0)
      options.include_dirs.push_back(value());
    else if (word.rfind("-D", 0) == 0)
      options.defines.push_back(value());
    else if (word.rfind("-std=", 0) == 0)
      options.standard = word.substr(5);
    else if (word.rfind("-O", 0) == 0)
      options.level = level_of(word.substr(2));
  }
  return options;
}

bool defines_main(const fs::path& source) {
  static const sim::Pattern kMain(R"(\bmain\s*\([^;{)]*\)\s*\{)");
  return std::regex_search(without_comments(read_text(source)), kMain);
}

std::optional<MplabProject> find_mplab_project(const fs::path& folder, std::string& told) {
  const fs::path home = fs::absolute(folder).lexically_normal();
  // All projects of this folder, and those of them that make a program.
  std::vector<std::pair<fs::path, fs::path>> files;  // project, its home
  const auto add_configurations = [&](const fs::path& place) {
    const fs::path file = place / "nbproject/configurations.xml";
    look_at(file);
    std::error_code ec;
    if (fs::is_regular_file(file, ec)) files.emplace_back(file, place);
  };
  look_at(home);
  add_configurations(home);
  std::error_code ec;
  for (fs::directory_iterator it(home, ec), end; !ec && it != end; it.increment(ec)) {
    const std::string extension = lower(it->path().extension().string());
    if (extension == ".mcp" && it->is_regular_file()) files.emplace_back(it->path(), home);
    if (extension == ".x" && it->is_directory()) add_configurations(it->path());
  }
  std::sort(files.begin(), files.end());
  std::vector<MplabProject> projects;
  for (const auto& [file, at] : files)
    if (auto project = read_project(file, at, told)) projects.push_back(*project);
  if (projects.empty()) return std::nullopt;

  // They may agree; else one that stands out is taken, and the user is told.
  const auto sorted = [](std::vector<fs::path> list) {
    std::sort(list.begin(), list.end());
    return list;
  };
  const bool agree = std::all_of(projects.begin(), projects.end(), [&](const MplabProject& p) {
    return sorted(p.sources) == sorted(projects[0].sources);
  });
  if (agree) return projects[0];  // one program may have a project for each version of MPLAB

  std::string names;
  for (const MplabProject& p : projects)
    names += (names.empty() ? "" : " and ") + p.file.lexically_relative(home).string();
  const auto only = [&](const auto& is_good) -> const MplabProject* {
    const auto first = std::find_if(projects.begin(), projects.end(), is_good);
    if (first == projects.end() || std::find_if(first + 1, projects.end(), is_good) != projects.end())
      return nullptr;
    return &*first;
  };
  const int fewest = std::min_element(projects.begin(), projects.end(), [](const auto& a, const auto& b) {
                       return a.missing < b.missing;
                     })->missing;
  const MplabProject* taken = only([&](const MplabProject& p) { return p.missing == fewest; });
  std::string why = "all others list more files that are missing";
  if (!taken) {
    taken = only([&](const MplabProject& p) { return p.missing == fewest && p.file.extension() == ".xml"; });
    why = "it is the project of the newer MPLAB X";
  }
  told = home.string() + ": project: got several that list different files (" + names + "), expected one; " +
         (taken ? taken->file.lexically_relative(home).string() + " is taken, since " + why
                : "none is taken, remove all but one");
  return taken ? std::optional<MplabProject>(*taken) : std::nullopt;
}

}  // namespace cc
