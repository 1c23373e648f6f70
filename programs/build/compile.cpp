// SPDX-License-Identifier: MIT
// See compile.h. Compilers run in the controller's folder, so that what a Makefile says relative to it is
// right and messages name files as the project does. Old code compiles as it did: what were warnings stay
// warnings, a header is found in any case and with any slash, and what fails in the language of today is
// tried in older ones.
#include "compile.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "build.h"
#include "compiler/cache/child_process.h"
#include "compiler/cache/readable_files.h"
#include "containment.h"
#include "install/cache_bound.h"
#include "install/places.h"
#include "makefile.h"
#include "sim_core/base/pattern.h"
#include "sim_core/base/words.h"
#include "sources.h"

namespace programs {
namespace {

using Words = std::vector<std::string>;
constexpr const char* kCompilerSeconds = "300";  // for one source; templates without end shall not hold a run
constexpr int kRecipe = 1;  // of compilers' words in this file: kept programs of other words are others
constexpr int kMostFoundHeaders = 40;  // of other case or slash, a source

/// Headers that Debian keeps in folders of their own, and what programs with them link.
struct Home {
  const char* folder;
  const char* header;
  Words libraries;
};
const std::vector<Home>& header_homes() {
  static const std::vector<Home> kHomes = {
      {"/usr/include/opencv4",
       "opencv",
       {"-lopencv_core", "-lopencv_imgproc", "-lopencv_imgcodecs", "-lopencv_highgui", "-lopencv_videoio",
        "-lopencv_video", "-lopencv_objdetect", "-lopencv_features2d", "-lopencv_calib3d", "-lopencv_ml"}},
      {"/usr/include/eigen3", "Eigen/", {}},
      {"/usr/include/jsoncpp", "json/", {"-ljsoncpp"}},
      {"/usr/include/libxml2", "libxml/", {"-lxml2"}},
      {"/usr/include/python3.11", "Python.h", {}},
  };
  return kHomes;
}

/// What of a project's options is taken: those of other systems and what makes warnings fatal is not.
Words usable(const Words& options) {
  Words kept;
  for (std::size_t i = 0; i < options.size(); ++i) {
    const std::string& word = options[i];
    static const std::set<std::string> kDropped = {"-c",           "-S",
                                                   "-E",           "-m32",
                                                   "-mwindows",    "-mconsole",
                                                   "-s",           "-pedantic-errors",
                                                   "-MMD",         "-MD",
                                                   "-MP",          "-shared",
                                                   "-lController", "-lCppController",
                                                   "-lcontroller", "-ldriver",
                                                   "-lCppDriver",  "-static",
                                                   "-flto"};
    if (word == "-o" || word == "-MF" || word == "-arch") {
      ++i;
    } else if (!kDropped.count(word) && word.rfind("-Werror", 0) != 0 &&
               word.rfind("-Wl,-subsystem", 0) != 0 && word.rfind("-stdlib=", 0) != 0 &&
               word.rfind("-mmacosx", 0) != 0) {
      kept.push_back(word);
    }
  }
  return kept;
}

bool has_standard(const Words& options) {
  return std::any_of(options.begin(), options.end(),
                     [](const std::string& word) { return word.rfind("-std=", 0) == 0 || word == "-ansi"; });
}

/// Files of a rule that gcc -MMD wrote, from `folder` on.
std::vector<fs::path> needs_in(const fs::path& file, const fs::path& folder) {
  std::vector<fs::path> files;
  const std::string text = text_of(file);
  std::string name;
  const auto end_name = [&] {
    if (!name.empty() && name.back() != ':') files.push_back((folder / name).lexically_normal());
    name.clear();
  };
  for (std::size_t i = text.find(": ") + 1; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] != '\n')
      name += text[++i];
    else if (text[i] == '$' && i + 1 < text.size() && text[i + 1] == '$')
      name += text[i++];
    else if (text[i] == ' ' || text[i] == '\n' || text[i] == '\\')
      end_name();
    else
      name += text[i];
  }
  end_name();
  return files;
}

std::string from_here(const fs::path& source) {
  const std::string name = source.string();
  return name[0] == '-' || name[0] == '@' ? "./" + name : name;
}

class Build {
 public:
  Build(const Found& found, std::string said, const fs::path& scratch, MakeSays says)
      : folder_(found.folder), said_(std::move(said)), scratch_(scratch), says_(std::move(says)) {
    const fs::path root = places::product_share();
    ours_ = {"-I.", "-I" + (root / "programs" / "controller" / "include").string(), "-idirafter",
             (root / "firmware" / "include").string()};
    options_ = usable(says_.options);
    cxx_options_ = usable(says_.cxx_options);
    libraries_ = usable(says_.libraries);
    if (const fs::path shared = folder_.parent_path().parent_path() / "libraries"; fs::is_directory(shared))
      ours_.push_back("-I" + shared.string());
  }

  /// Everything but files' contents that the result depends on.
  std::uint64_t key(std::uint64_t h, const std::vector<std::vector<fs::path>>& lists) const {
    h = hash_of(h, folder_.string());
    for (const auto* words : {&ours_, &options_, &cxx_options_, &libraries_})
      for (const std::string& word : *words) h = hash_of(h, word);
    for (const auto& list : lists)
      for (const fs::path& source : list) h = hash_of(h, source.string());
    for (const char* compiler : {"gcc", "g++"}) {
      std::error_code none;
      const fs::path file = fs::canonical(on_path(compiler), none);
      h = hash_of(h, file.string() + std::to_string(none ? 0 : fs::file_size(file, none)));
    }
    return h;
  }

  /// Compiles and links one list of sources. False: `lines` say why.
  bool make(std::vector<fs::path> sources, const fs::path& output, Words& lines) {
    needs_.clear();
    Words local = local_libraries(sources);
    if (try_make(sources, output, local, {}, lines)) return true;
    // inline functions of old C have a body of their own, which those of today need not have
    const bool misses = std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
      return line.find("undefined reference") != std::string::npos;
    });
    Words again;
    if (misses && !has_standard(options_) && try_make(sources, output, local, {"-fgnu89-inline"}, again)) {
      lines = again;
      return true;
    }
    return false;
  }

  const std::set<fs::path>& needs() const { return needs_; }

 private:
  /// A compiler that sees the program's folder, the submission it belongs to, and what programs are made with: a file
  /// that it read could be told by the program.
  Words in_a_room(const Words& words) const {
    const fs::path root = places::product_share();
    Words readable = {folder_.string(), cc::submission().string(),
                      controller_library().parent_path().string(),
                      (root / "programs" / "controller").string(), (root / "firmware" / "include").string()};
    return contained(words, folder_.string(), readable, {scratch_.string()});
  }

  Words run(const Words& command, int& status) const {
    Words whole = {"env",           "--chdir=" + folder_.string(), "LC_ALL=C", "timeout", "-s", "KILL",
                   kCompilerSeconds};
    whole.insert(whole.end(), command.begin(), command.end());
    if (is_contained()) whole = in_a_room(whole);
    if (whole.empty()) {  // no bubblewrap
      status = 1;
      return {said_ +
              ": compiler: got a program that shall be contained, expected bubblewrap to do it; apt "
              "install bubblewrap"};
    }
    const cc::ProcessResult done = cc::run_process(whole);
    status = done.status;
    Words lines;
    std::istringstream in(done.output);
    for (std::string line; std::getline(in, line);) {
      const bool is_noise = line.rfind("collect2: ", 0) == 0 || line.rfind("compilation terminated", 0) == 0;
      if (!is_noise) lines.push_back(placed(line));
    }
    if (status == 128 + 9 || status == 137)
      lines.push_back(said_ + ": compiler: got no end after " + kCompilerSeconds +
                      " s or more memory than there may be");
    if (status == 127) lines.push_back("gcc: " + std::string("apt install gcc g++"));
    return lines;
  }

  /// "avoid.c:3:5: error" as a path that leads there from where people are.
  std::string placed(const std::string& line) const {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos || colon == 0 || line[0] == '/' || line[0] == ' ') return line;
    std::error_code none;
    const std::string name = line.substr(0, colon);
    if (!fs::is_regular_file(folder_ / name, none)) return line;
    const fs::path base = fs::is_directory(said_, none) ? fs::path(said_) : fs::path(said_).parent_path();
    return (base / name).lexically_normal().string() + line.substr(colon);
  }

  /// A compiler and the words that make it take a program.
  struct Attempt {
    std::string compiler;
    Words words;
  };

  /// One source becomes an object. Headers that are there by another name are put where they are asked for.
  bool compile_one(const fs::path& source, const fs::path& object, const Words& more, Words& lines) {
    const bool cxx = is_cxx(source);
    Words own = options_;
    if (cxx) own.insert(own.end(), cxx_options_.begin(), cxx_options_.end());
    // a language of today; with headers that older libraries brought along unasked; other languages
    std::vector<Attempt> attempts;
    const std::string compiler = cxx ? "g++" : "gcc";
    if (has_standard(own))
      attempts = {{compiler, {}}};
    else
      attempts = {{compiler, {cxx ? "-std=gnu++17" : "-std=gnu17"}}};
    if (cxx) {
      Words with_all = attempts[0].words;
      with_all.insert(with_all.end(), {"-include", "bits/stdc++.h"});
      attempts.push_back({compiler, with_all});
      if (!has_standard(own))
        for (const char* standard : {"-std=gnu++20", "-std=gnu++11"})
          attempts.push_back({compiler, {standard}});
    } else if (!on_path("clang").empty()) {
      // of programs from a Mac: arrays of a constant's size
      attempts.push_back({"clang", attempts[0].words});
    }
    // The first that compiles is taken; of those that fail the first one's messages are told.
    for (const Attempt& attempt : attempts) {
      Words said;
      if (!compile_in(source, object, attempt, own, more, said)) {
        if (lines.empty()) lines = said;
        const bool misses_header = std::any_of(said.begin(), said.end(), [](const std::string& line) {
          return line.find("fatal error: ") != std::string::npos;
        });
        if (misses_header) return false;
        continue;
      }
      lines = said;
      return true;
    }
    return false;
  }

  bool compile_in(const fs::path& source, const fs::path& object, const Attempt& attempt, const Words& own,
                  const Words& more, Words& lines) {
    const bool cxx = is_cxx(source);
    for (int found = 0;; ++found) {
      // asserts are off in what Webots builds
      Words command = {attempt.compiler,
                       "-c",
                       "-g",
                       "-O1",
                       "-DNDEBUG",
                       "-Wall",
                       "-Wno-unknown-pragmas",
                       "-fno-omit-frame-pointer",
                       "-ffp-contract=off",
                       "-fno-diagnostics-color"};
      if (cxx)
        command.insert(command.end(), {"-fpermissive", "-Wno-register"});
      else
        command.insert(command.end(),
                       {"-fcommon", "-Wno-error=implicit-function-declaration", "-Wno-error=implicit-int",
                        "-Wno-error=int-conversion", "-Wno-error=incompatible-pointer-types"});
      command.insert(command.end(), attempt.words.begin(), attempt.words.end());
      command.insert(command.end(), own.begin(), own.end());
      command.insert(command.end(), more.begin(), more.end());
      command.insert(command.end(), ours_.begin(), ours_.end());
      command.insert(command.end(), found_.begin(), found_.end());
      command.insert(command.end(),
                     {"-MMD", "-MF", object.string() + ".d", "-o", object.string(), from_here(source)});
      int status = 0;
      lines = run(command, status);
      if (status == 0) {
        for (const fs::path& need : needs_in(object.string() + ".d", folder_))
          if (need.string().rfind(scratch_.string(), 0) != 0) needs_.insert(need);
        return true;
      }
      if (found >= kMostFoundHeaders || !find_header(lines)) return false;
    }
  }

  /// Whether the header that a compiler missed is there by another name; it is found from now on.
  bool find_header(const Words& lines) {
    static const sim::Pattern kMissing(R"(^(.*?):\d+:\d+: fatal error: (.*): No such file or directory$)");
    for (const std::string& line : lines) {
      std::smatch m;
      if (line.size() > 4000 || !std::regex_match(line, m, kMissing)) continue;
      const std::string name = m[2];
      if (!missed_.insert(name).second) return false;
      // A header of a known library, or a file of that name near the one that asks for it.
      for (const Home& home : header_homes()) {
        std::error_code none;
        if (name.rfind(home.header, 0) != 0 || !fs::exists(fs::path(home.folder) / name, none)) continue;
        found_.insert(found_.end(), {"-I" + std::string(home.folder)});
        if (libraries_.empty() ||
            std::none_of(libraries_.begin(), libraries_.end(),
                         [&](const std::string& l) { return l.find("opencv") != std::string::npos; }))
          libraries_.insert(libraries_.end(), home.libraries.begin(), home.libraries.end());
        return true;
      }
      fs::path from = fs::path(m[1].str());
      std::vector<fs::path> places = {
          from.is_absolute() ? from.parent_path() : fs::absolute(from).parent_path(), folder_};
      for (const auto* words : {&ours_, &options_})
        for (std::size_t i = 0; i < words->size(); ++i) {
          const std::string& word = (*words)[i];
          if (word == "-I" || word == "-idirafter" || word == "-isystem") {
            if (i + 1 < words->size()) places.push_back(folder_ / (*words)[i + 1]);
          } else if (word.rfind("-I", 0) == 0) {
            places.push_back(folder_ / word.substr(2));
          }
        }
      for (const fs::path& place : places) {
        const fs::path file = resolve(place, name);
        if (file.empty()) continue;
        // "../Name.h" is looked for from a folder of the same depth
        const fs::path deep = scratch_ / "found" / "a" / "b" / "c";
        const fs::path stand_in = (deep / name).lexically_normal();
        std::error_code none;
        if (stand_in.string().rfind(scratch_.string(), 0) != 0) return false;
        fs::create_directories(deep, none);
        fs::create_directories(stand_in.parent_path(), none);
        std::ofstream(stand_in) << "#include \"" << fs::absolute(file).lexically_normal().string() << "\"\n";
        if (std::find(found_.begin(), found_.end(), "-I" + deep.string()) == found_.end())
          found_.push_back("-I" + deep.string());
        return true;
      }
      return false;
    }
    return false;
  }

  /// Libraries of the project itself that nobody has built: their sources are compiled along.
  Words local_libraries(std::vector<fs::path>& sources) {
    Words kept;
    std::vector<fs::path> folders;
    std::error_code none;
    for (const std::string& word : libraries_)
      if (word.rfind("-L", 0) == 0 && fs::is_directory(folder_ / word.substr(2), none))
        folders.push_back((folder_ / word.substr(2)).lexically_normal());
    // Each library: built already, or of a folder of its name, whose sources are compiled along.
    for (const std::string& word : libraries_) {
      bool is_built = false;
      for (const fs::path& place : folders) {
        if (word.rfind("-l", 0) != 0) break;
        const std::string name = word.substr(2);
        if (fs::exists(place / ("lib" + name + ".so"), none) ||
            fs::exists(place / ("lib" + name + ".a"), none)) {
          is_built = false;
          kept.push_back("-Wl,-rpath," + place.string());
          break;
        }
        if (lower_case(place.filename().string()) != lower_case(name)) continue;
        std::vector<fs::path> own;
        MakeSays says = ask_makefile(place, scratch_, {});
        for (const std::string& source : says.sources)
          if (const fs::path file = resolve(place, source); !file.empty())
            own.push_back(file.lexically_normal());
        if (says.sources.empty())
          for (const fs::path& file : files_below(place))
            if ((is_c(file) || is_cxx(file)) && !defines_main(without_comments(text_of(file))))
              own.push_back(file);
        sources.insert(sources.end(), own.begin(), own.end());
        is_built = is_built || !own.empty();
      }
      if (!is_built) kept.push_back(word);
    }
    return kept;
  }

  bool try_make(const std::vector<fs::path>& sources, const fs::path& output, const Words& libraries,
                const Words& more, Words& lines) {
    Words objects;
    bool good = true, any_cxx = false;
    for (const fs::path& source : sources) {
      const fs::path object = scratch_ / fmt::format("{}.o", objects.size());
      Words said;
      any_cxx = any_cxx || is_cxx(source);
      if (is_cxx(source)) {
        good = compile_one(source, object, {}, said) && good;
      } else {
        good = compile_one(source, object, more, said) && good;
      }
      lines.insert(lines.end(), said.begin(), said.end());
      objects.push_back(object.string());
    }
    if (!good) return false;
    Words command = {any_cxx ? "g++" : "gcc", "-o", output.string()};
    command.insert(command.end(), objects.begin(), objects.end());
    // options of the compiler may be such of the linker, too: -pthread, -fopenmp
    command.insert(command.end(), options_.begin(), options_.end());
    command.insert(command.end(), libraries.begin(), libraries.end());
    // found since: libraries of headers that lie in folders of their own
    for (const std::string& word : libraries_)
      if (word.rfind("-lopencv", 0) == 0 || word == "-ljsoncpp" || word == "-lxml2") command.push_back(word);
    const fs::path library = controller_library();
    command.insert(command.end(), {library.string(), "-Wl,-rpath," + library.parent_path().string(), "-lm"});
    int status = 0;
    const Words said = run(command, status);
    lines.insert(lines.end(), said.begin(), said.end());
    return status == 0;
  }

  fs::path folder_;
  std::string said_;
  fs::path scratch_;
  MakeSays says_;
  Words ours_, options_, cxx_options_, libraries_;
  Words found_;                   // -I of headers that were found by another name
  std::set<std::string> missed_;  // headers that have been looked for
  std::set<fs::path> needs_;      // files that the objects are made of
};

/// What a kept program was made of: the hash of these files' contents.
std::uint64_t hash_of_needs(std::uint64_t h, const std::vector<std::string>& files) {
  for (const std::string& file : files) h = hash_of(hash_of(h, file), text_of(file));
  return h;
}

/// A folder for a build's own files, gone with it.
class Scratch {
 public:
  explicit Scratch(const fs::path& cache) {
    static std::atomic<unsigned> number{0};
    folder_ = cache / fmt::format("build.{}.{}", getpid(), number++);
    std::error_code none;
    fs::create_directories(folder_, none);
  }
  ~Scratch() {
    std::error_code none;
    fs::remove_all(folder_, none);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

}  // namespace

fs::path controller_library() {
  if (const char* library = std::getenv("TWINPUCK_LIBCONTROLLER")) return library;
  return places::tools_folder() / "libcontroller.so";
}

Compiled compile(const Found& found, const std::string& said, const fs::path& cache,
                 const std::function<void(const std::string&)>& tell, std::vector<std::string>& problems) {
  Compiled made;
  std::error_code none;
  const fs::path home = fs::absolute(cache, none);
  if (const std::string wrong = places::why_not_writable(home); !wrong.empty()) {
    problems.push_back(wrong);
    return made;
  }
  if (const fs::path odd = found.main.empty() ? odd_file_below(found.folder) : fs::path(); !odd.empty()) {
    problems.push_back(odd.string() + ": controller: got a pipe or a device, expected a file");
    return made;
  }
  if (!fs::exists(controller_library(), none)) {
    problems.push_back(controller_library().string() +
                       ": library: got no file, expected the one that programs link with; run make build");
    return made;
  }
  const Scratch scratch(home);
  const MakeSays says = found.main.empty() ? ask_makefile(found.folder, scratch.folder(), tell) : MakeSays{};
  const std::size_t before = problems.size();
  const auto lists = source_lists(found, says, said, problems);
  if (problems.size() > before || lists.empty()) return made;

  // one that was made of the same content is kept
  Build build(found, said, scratch.folder(), says);
  const std::uint64_t key = build.key(hash_of(kRecipe, controller_library().string()), lists);
  const std::string stem = (found.main.empty() ? found.folder.filename() : found.main.stem()).string();
  const fs::path list_file = home / fmt::format("{}-{:016x}.needs", stem, key);
  const auto program_of = [&](const Words& needs) {
    return home / fmt::format("{}-{:016x}", stem, hash_of_needs(key, needs));
  };
  Words needs = sim::words_of(text_of(list_file), "\n");
  if (!needs.empty()) {
    made.files = std::atoi(needs[0].c_str());
    needs.erase(needs.begin());
    if (const fs::path kept = program_of(needs); fs::exists(kept, none)) {
      for (const fs::path& used : {list_file, kept}) places::note_used(used);
      made.program = kept;
      return made;
    }
  }

  const fs::path draft = scratch.folder() / "program";
  Words first;
  for (const auto& list : lists) {
    Words lines;
    if (!build.make(list, draft, lines)) {
      if (first.empty()) first = lines;
      continue;
    }
    if (tell)
      for (const std::string& line : lines) tell(line);
    needs.clear();
    for (const fs::path& need : build.needs()) needs.push_back(need.string());
    made.program = program_of(needs);
    made.files = int(list.size());
    // written beside and renamed: another run may do the same, or run the old one
    const fs::path list_draft = scratch.folder() / "needs";
    {
      std::ofstream out(list_draft, std::ios::binary);
      out << made.files << '\n';
      for (const std::string& need : needs) out << need << '\n';
    }
    std::error_code wrong;
    fs::rename(draft, made.program, wrong);
    if (!wrong) fs::rename(list_draft, list_file, wrong);
    if (wrong) {
      problems.push_back(made.program.string() + ": cache: cannot be written: " + wrong.message());
      made.program.clear();
    }
    places::keep_caches_within_bound();
    return made;
  }
  problems.push_back(said + ": controller: does not compile:");
  std::set<std::string> hints;
  for (const std::string& line : first) {
    problems.push_back(line);
    if (const std::string hint = package_hint(line); !hint.empty() && hints.insert(hint).second)
      problems.push_back(hint);
  }
  return made;
}

}  // namespace programs
