// SPDX-License-Identifier: MIT
// See build_plan.h.
#include "build_plan.h"

#include <algorithm>

#include "install/places.h"
#include "library_objects.h"
#include "sim_core/base/pattern.h"

namespace cc {
namespace fs = std::filesystem;
namespace {

// of include_finder.h, which is the compiler's
constexpr const char* kVendorHeaders = "-I/twinpuck-vendor";

/// Sources of a program for Webots, which compiles the file with the controller's name alone: not those that
/// another one includes as text, and not further programs that lie beside it.
std::vector<fs::path> webots_sources(const fs::path& folder, const std::vector<fs::path>& sources) {
  static const sim::Pattern kInclude(R"(#\s*include\s*"([^"]+\.c)\")"), kMain(R"(\bmain\s*\()");
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

enum class AssemblerRole {
  Own,     // linked whatever asks for it
  Member,  // of a copy of the library: linked when something asks for it, or for its handler
  Ours,    // a file of the library that the project has elsewhere: ours is taken, as of its C files
};

AssemblerRole role_of(const fs::path& file, const fs::path& folder, const Program& program) {
  if (!is_library_assembler(file)) return AssemblerRole::Own;
  const std::string below =
      fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder)).generic_string();
  const bool is_elsewhere = below.empty() || below.rfind("..", 0) == 0;
  if (is_elsewhere && is_in_library_folder(file)) return AssemblerRole::Ours;
  if (program.has_project && !program.unlisted_assembler.count(file)) return AssemblerRole::Own;
  const bool has_c_half = std::any_of(program.sources.begin(), program.sources.end(), [&](const fs::path& s) {
    return s.parent_path() == file.parent_path() && !library_place(s).empty();
  });
  return is_in_library_folder(file) || has_c_half ? AssemblerRole::Member : AssemblerRole::Own;
}

/// Where .include and .incbin look: beside the file (the assembler does), in the project's folder, in those
/// that are named, in those of the program that hold such files.
std::vector<std::string> assembler_flags(const BuildOptions& o, const Program& program,
                                         const std::vector<fs::path>& own) {
  std::vector<std::string> flags = {"--project", fs::weakly_canonical(o.source_dir).string()};
  // those of .S files
  for (const auto& d : program.defines) flags.push_back("-D" + d);
  for (const auto& d : o.defines) flags.push_back("-D" + d);
  std::vector<fs::path> folders = {fs::absolute(o.source_dir)};
  for (const auto& d : o.include_dirs) folders.push_back(fs::absolute(d));
  folders.insert(folders.end(), program.include_dirs.begin(), program.include_dirs.end());
  for (const fs::path& file : files_below(o.source_dir, ".inc")) folders.push_back(file.parent_path());
  folders.insert(folders.end(), own.begin(), own.end());
  std::set<std::string> known;
  for (const fs::path& folder : folders)
    if (known.insert(folder.string()).second) flags.push_back("-I" + folder.string());
  return flags;
}

}  // namespace

ReadableFiles readable_files(const BuildOptions& o) {
  if (o.within.empty()) return {};
  // of the product's files what programs are compiled with: solutions lie among the others
  const fs::path libc = places::product_share() / "firmware/libc";
  std::vector<std::string> places = {o.within.string(), include_root(o).string(), libc.string()};
  for (const fs::path& folder : o.include_dirs) places.push_back(fs::absolute(folder).string());
  return ReadableFiles(places);
}

std::vector<std::string> flags_of(const ReadableFiles& readable) {
  std::vector<std::string> flags;
  for (const std::string& place : readable.places()) flags.insert(flags.end(), {"--within", place});
  return flags;
}

Plan plan(const BuildOptions& o, const LibraryCopies& copies, const Program& program, bool lint) {
  const fs::path libc = places::product_share() / "firmware/libc";
  const fs::path contract = include_root(o);
  std::vector<std::string> user_include;
  // first what is said where to look, for quotes as for angles, then what the compiler brings along, as XC16
  // has it; folders of the program that nobody named come after that
  for (const auto& d : o.include_dirs) user_include.push_back("-I" + fs::absolute(d).string());
  for (const auto& d : program.include_dirs) user_include.push_back("-I" + d.string());
  user_include.push_back("-I" + (libc / "include").string());
  user_include.push_back(kVendorHeaders);
  auto headers = files_below(o.source_dir, ".h");
  std::vector<fs::path> own = {o.source_dir};
  // by their text: paths are compared part by part
  std::set<std::string> known = {o.source_dir.string()};
  for (const auto& h : headers)
    if (known.insert(h.parent_path().string()).second) own.push_back(h.parent_path());
  for (const auto& d : own) user_include.push_back("-I" + d.string());
  for (const auto& d : contract_folders(contract)) user_include.push_back("-I" + d.string());
  // "motor/speed.h" below a folder that the project's makefile names: the folder above the header's
  for (const auto& d : own)
    if (const fs::path above = d.parent_path(); d != o.source_dir)
      if (!known.count(above.string())) user_include.push_back("-I" + above.string());
  user_include.insert(
      user_include.end(),
      {"-include", (libc / "include/xc16_builtins.h").string(), "-I" + (libc / "include").string(),
       "--fallback", contract.string(), "--fallback", (libc / "include").string(), "--fallback",
       o.source_dir.string(), "--project", fs::weakly_canonical(o.source_dir).string()});

  // What holds for all C files of the program.
  Plan p;
  // what it may read comes first: no option of its own stands before it
  const std::vector<std::string> within = flags_of(readable_files(o));
  std::vector<std::string> flags = {o.optimisation};
  flags.insert(flags.end(), within.begin(), within.end());
  if (o.sanitize) flags.push_back("--sanitize");
  p.is_webots = names_webots(copies.kept, headers);
  if (p.is_webots) {
    flags.push_back("--webots");
    flags.push_back("-I" + (libc / "webots/include").string());
  }
  if (o.strict) flags.push_back("--strict");
  if (lint) flags.push_back("--lint");
  for (const auto& d : program.defines) flags.push_back("-D" + d);
  for (const auto& d : o.defines) flags.push_back("-D" + d);
  if (const std::string& standard = o.standard.empty() ? program.standard : o.standard; !standard.empty())
    flags.push_back("-std=" + standard);
  flags.insert(flags.end(), user_include.begin(), user_include.end());
  // One job a file. The names of all headers go into its key: a new one may be found before another.
  const std::string salt = names_of_headers({o.source_dir, contract});
  for (const auto& s :
       p.is_webots && !program.is_exact ? webots_sources(o.source_dir, copies.kept) : copies.kept)
    p.user.push_back({s, flags, salt, contract.string(), {}, {}, true});

  for (const auto& s : program.assembler)
    if (const AssemblerRole role = role_of(s, o.source_dir, program); role != AssemblerRole::Ours) {
      p.assembler.push_back({s, assembler_flags(o, program, own), salt, contract.string()});
      auto& of_file = p.assembler.back().flags;
      of_file.insert(of_file.begin(), within.begin(), within.end());
      if (role == AssemblerRole::Member) p.assembler_members.insert(s);
    }
  return p;
}

}  // namespace cc
