// SPDX-License-Identifier: MIT
// twinpuck new DIR: a folder of one's own, anywhere, that builds, runs, is debugged and tested as it is.
// twinpuck init [DIR]: what of that is missing in a folder that has a program; nothing is written over.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <vector>

#include "compiler/projects/program_files.h"
#include "hal_sim/twin/firmware_store.h"
#include "sim_core/base/output_file.h"
#include "tools/command_line.h"
#include "tools/templates.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

/// What a file is for, in the list of what was made.
const char* purpose_of(const std::string& file) {
  static const std::map<std::string, const char*> kPurposes{
      {"main.c", "the program"},
      {"world.toml", "where it runs"},
      {"test_robot.py", "a test in Python"},
      {"robot.test.toml", "a test without a program"},
      {"Makefile", "make run, view, test, dspic, clean"},
      {".gitignore", "what git leaves out"},
      {".clangd", "headers of the e-puck, for clangd"},
      {".vscode/c_cpp_properties.json", "headers of the e-puck, for VS Code's C/C++"},
      {".vscode/tasks.json", "run, view, test, build in VS Code"},
      {".vscode/launch.json", "the debugger in VS Code"},
      {".github/workflows/test.yml", "the tests at every push to GitHub"},
  };
  const auto at = kPurposes.find(file);
  return at == kPurposes.end() ? "" : at->second;
}

void list_made(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const std::string what = purpose_of(file);
    std::cout << (what.empty() ? "  " + file : fmt::format("  {:<30} {}", file, what)) << '\n';
  }
}

/// The folder as a path without dots and without a slash at its end.
fs::path folder_of(const std::string& text) {
  if (text.empty()) return {};
  const fs::path whole = fs::absolute(text).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

bool is_plain(unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; }

/// Names go into file names, Makefiles and TOML as they are.
bool is_good_name(const std::string& name) {
  return !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) &&
         std::all_of(name.begin(), name.end(), is_plain);
}

/// The name of a folder that exists, as far as it is good for the name of an image.
std::string image_name(std::string name) {
  for (char& c : name)
    if (!is_plain(static_cast<unsigned char>(c))) c = '_';
  return name.empty() || name[0] == '-' ? "robot" : name;
}

bool is_taken(const fs::path& file) {
  std::error_code none;
  return fs::symlink_status(file, none).type() != fs::file_type::not_found;
}

/// Puts a file into its place; what was there goes. False, told, when it cannot be written.
bool write_made(const fs::path& folder, const TemplateFile& file) {
  const fs::path path = folder / file.name;
  std::error_code wrong;
  fs::create_directories(path.parent_path(), wrong);
  // a link is not followed: what it leads to may be anybody's
  std::error_code none;
  if (!wrong && fs::is_symlink(path, none)) fs::remove(path, wrong);
  if (!wrong) {
    sim::OutputFile out(path.string());
    out.append(file.text);
    out.close();
    if (out.error().empty()) return true;
    complain({out.error()});
    return false;
  }
  complain({path.string() + ": cannot be written: " + wrong.message()});
  return false;
}

/// Whether a shell finds `twinpuck`.
bool is_in_path() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((fs::path(folder) / "twinpuck").c_str(), X_OK) == 0) return true;
  return false;
}

void say_next(const std::vector<std::string>& commands) {
  std::cout << "next:\n";
  if (!is_in_path()) {
    std::error_code none;
    std::cout << "  export PATH=" << fs::read_symlink("/proc/self/exe", none).parent_path().string()
              << ":$PATH\n";
  }
  for (const std::string& command : commands) std::cout << "  " << command << '\n';
}

/// Whether a new program may go into this folder; false: told.
bool may_fill(const fs::path& folder, bool force) {
  std::error_code none;
  if (!is_taken(folder)) return true;
  if (!fs::is_directory(folder, none)) {
    complain({folder.string() + ": new: got a file, expected a folder or a new name"});
    return false;
  }
  if (force || fs::directory_iterator(folder, none) == fs::directory_iterator()) return true;
  complain(
      {folder.string() +
       ": new: got a folder that is not empty, expected a new name; `twinpuck init` adds to a folder what "
       "is missing, --force writes over files of the same names"});
  return false;
}

int make(const std::string& where, bool supervisor, bool force) {
  const fs::path folder = folder_of(where);
  const std::string name = folder.filename().string();
  if (!is_good_name(name)) {
    complain({"command line: DIR: got '" + name +
              "', expected a name of letters, digits, - and _ that begins with a letter"});
    return kBadInput;
  }
  if (!may_fill(folder, force)) return kBadInput;
  std::vector<std::string> problems, names;
  const auto files = read_templates(supervisor ? "supervisor" : "project", name, problems);
  complain(problems);
  if (!problems.empty()) return kBadInput;
  const bool is_new = !is_taken(folder);
  for (const TemplateFile& file : files) {
    if (!write_made(folder, file)) {
      std::error_code none;
      if (is_new) fs::remove_all(folder, none);  // half a program helps nobody
      return kBadInput;
    }
    names.push_back(file.name);
  }
  const fs::path shown = fs::path(where).lexically_normal();
  std::cout << "made " << shown.string() << ":\n";
  list_made(names);
  const std::string home = (shown.has_filename() ? shown : shown.parent_path()).string();
  if (supervisor)
    say_next({"twinpuck run maze --supervisor " + home});
  else if (home == ".")
    say_next({"make test"});
  else
    say_next({"cd " + home, "make test"});
  return kPass;
}

/// A program, or what says where one is.
bool has_program(const fs::path& folder) {
  if (!cc::files_below(folder, {".c", ".mcp"}).empty()) return true;
  std::error_code none;
  for (const char* file : {"Makefile", "makefile", "GNUmakefile", "nbproject/configurations.xml"})
    if (fs::exists(folder / file, none)) return true;
  for (fs::directory_iterator it(folder, none), end; !none && it != end; it.increment(none))
    if (it->path().extension() == ".X" && it->is_directory(none)) return true;
  return false;
}

/// Whether a file of the template is there, or another one that does the same.
bool is_there(const fs::path& folder, const std::string& file) {
  if (file == "Makefile" && (is_taken(folder / "makefile") || is_taken(folder / "GNUmakefile"))) return true;
  return is_taken(folder / file);
}

int complete(const std::string& where) {
  const fs::path folder = folder_of(where);
  std::error_code none;
  if (!fs::is_directory(folder, none)) {
    complain({where + ": init: got no folder, expected one with a program; `twinpuck new " + where +
              "` makes one"});
    return kBadInput;
  }
  if (!has_program(folder)) {
    complain({where + ": init: got no C file, Makefile or project of MPLAB, expected a program of the robot; "
                      "`twinpuck new DIR` makes one"});
    return kBadInput;
  }
  std::vector<std::string> problems, added, left;
  const std::string name = image_name(folder.filename().string());
  auto files = read_templates("project", name, problems);
  const auto of_any = read_templates("any_program", name, problems);
  complain(problems);
  if (!problems.empty()) return kBadInput;
  for (TemplateFile& file : files) {
    if (file.name == "main.c") continue;  // the program is theirs
    for (const TemplateFile& any : of_any)
      if (any.name == file.name) file.text = any.text;
    if (is_there(folder, file.name)) {
      left.push_back(file.name);
      continue;
    }
    if (!write_made(folder, file)) return kBadInput;
    added.push_back(file.name);
  }
  if (added.empty()) {
    std::cout << "nothing was missing in " << where << '\n';
    return kPass;
  }
  std::cout << "added to " << where << ":\n";
  list_made(added);
  if (!left.empty()) {
    std::cout << "left as it was:\n";
    list_made(left);
  }
  if (std::count(left.begin(), left.end(), ".gitignore"))
    std::cout << "for .gitignore: /build/ /.clangd /.vscode/c_cpp_properties.json\n";
  std::vector<std::string> commands;
  if (folder != folder_of(".")) commands.push_back("cd " + where);
  commands.insert(commands.end(), {"twinpuck run world.toml", "twinpuck test"});
  say_next(commands);
  return kPass;
}

}  // namespace

void add_new(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("new", "Make a folder with a program, a world and tests, to start from");
  auto where = std::make_shared<std::string>();
  verb->add_option("DIR", *where, "the new folder; its last part is the program's name")->required();
  auto supervisor = std::make_shared<bool>(false), force = std::make_shared<bool>(false);
  verb->add_flag("--supervisor", *supervisor, "a supervisor instead of a program of the robot");
  verb->add_flag("--force", *force, "also in a folder with files; those of the same names are written over");
  verb->callback([where, supervisor, force, &exit_code] { exit_code = make(*where, *supervisor, *force); });
}

void add_init(CLI::App& app, int& exit_code) {
  auto* verb =
      app.add_subcommand("init", "Add to a folder with a program what is missing: world, tests, editor, CI");
  auto where = std::make_shared<std::string>(".");
  verb->add_option("DIR", *where, "the folder; nothing in it is written over")->capture_default_str();
  verb->callback([where, &exit_code] { exit_code = complete(*where); });
}

}  // namespace tools
