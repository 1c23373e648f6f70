// SPDX-License-Identifier: MIT
// How each kind of program is started: its words, its environment, its folder.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "build.h"
#include "compile.h"
#include "compiler/cache/child_process.h"
#include "containment.h"
#include "install/places.h"
#include "runtime_ini.h"
#include "sim_core/base/words.h"

namespace programs {
namespace {

using Tell = std::function<void(const std::string&)>;

/// A variable that a program gets: what is put first, what runtime.ini says, what there was.
std::string joined(const std::string& name, const std::vector<std::string>& first, const RuntimeIni& ini) {
  std::string value;
  const auto add = [&](const std::string& part) {
    if (!part.empty()) value += (value.empty() ? "" : ":") + part;
  };
  for (const std::string& part : first) add(part);
  bool is_set = false;
  for (const auto& [other, set] : ini.environment)
    if (other == name) add(set), is_set = true;
  const char* inherited = std::getenv(name.c_str());
  if (inherited && !is_set) add(inherited);
  return name + "=" + value;
}

/// Folders of the project's shared libraries: libraries/ beside controllers/, and those in it.
std::vector<std::string> library_folders(const fs::path& folder) {
  std::vector<std::string> folders;
  std::error_code none;
  const fs::path libraries = folder.parent_path().parent_path() / "libraries";
  if (!fs::is_directory(libraries, none)) return folders;
  folders.push_back(libraries.string());
  for (fs::directory_iterator it(libraries, none), end; !none && it != end; it.increment(none))
    if (it->is_directory(none)) folders.push_back(it->path().string());
  std::sort(folders.begin() + 1, folders.end());
  return folders;
}

class Starter {
 public:
  Starter(Found found, std::string said, fs::path cache, Tell tell, std::vector<std::string>& problems,
          Launch& launch)
      : found_(std::move(found)),
        said_(std::move(said)),
        cache_(std::move(cache)),
        tell_(std::move(tell)),
        problems_(problems),
        launch_(launch) {}

  bool run() {
    // What the user's runtime.ini asks for.
    std::vector<std::string> warnings;
    ini_ = read_runtime_ini(found_.folder, warnings);
    if (tell_)
      for (const std::string& line : warnings) tell_(line);
    launch_.source = said_;
    launch_.folder = found_.folder.string();
    for (const auto& [name, value] : ini_.environment)
      if (name != "PYTHONPATH" && name != "LD_LIBRARY_PATH" && name != "WEBOTS_LIBRARY_PATH")
        launch_.environment.push_back(name + "=" + value);
    // How it is started is its kind's affair.
    switch (found_.kind) {
      case Kind::Compiled:
        return compiled() && with_libraries();
      case Kind::Executable:
        return executable() && with_libraries();
      case Kind::Python:
        return python() && with_libraries();
      case Kind::Java:
      case Kind::Jar:
      case Kind::Class:
        return java() && with_libraries();
      case Kind::Matlab:
        return fail(
            "got a program in MATLAB, expected one in C, C++, Python or Java; MATLAB programs are not run");
      case Kind::Firmware:
        return fail(
            "got firmware of the e-puck, expected a program of the PC: C or C++ with Webots' headers, "
            "Python, "
            "Java, or a program of this machine");
      default:
        return fail(!found_.why.empty()
                        ? found_.why
                        : "got no program, expected C, C++, Python, Java, or a program of this "
                          "machine that is named as the folder");
    }
  }

  /// It runs in a room of its own, with its folder, its project's libraries and what it was compiled to.
  bool contain() {
    std::vector<std::string> readable{found_.folder.string(), fs::absolute(cache_).string(),
                                      controller_library().parent_path().string(),
                                      (places::product_share() / "programs" / "controller").string()};
    for (const std::string& folder : library_folders(found_.folder)) readable.push_back(folder);
    if (const fs::path program = launch_.words.empty() ? fs::path() : fs::path(launch_.words[0]);
        program.is_absolute())
      readable.push_back(program.parent_path().string());
    launch_.words = contained(launch_.words, launch_.folder, readable);
    launch_.name.clear();
    if (launch_.words.empty())
      return fail(
          "got a program that shall be contained, expected bubblewrap to do it; apt install bubblewrap");
    return true;
  }

 private:
  bool fail(const std::string& what) {
    problems_.push_back(said_ + ": controller: " + what);
    return false;
  }

  bool compiled() {
    const Compiled made = compile(found_, said_, cache_, tell_, problems_);
    launch_.files = made.files;
    launch_.words = {made.program.string()};
    // what it believes to be called: Webots' programs lie in their folder
    launch_.name = (found_.folder / found_.folder.filename()).string();
    return !made.program.empty();
  }

  bool executable() {
    if (is_native_program(found_.main)) {
      if (access(found_.main.c_str(), X_OK) != 0)
        return fail("got a program that may not be executed; chmod +x " + found_.main.string());
      launch_.words = {found_.main.string()};
      if (tell_ && text_of(found_.main).find("libCppController") != std::string::npos)
        tell_(said_ +
              ": controller: got a program that was linked with Webots' C++ library, expected its source; it "
              "may miss functions here");
      // it may ask for the library by Webots' names
      std::error_code none;
      const fs::path names = fs::absolute(cache_, none) / "names";
      fs::create_directories(names, none);
      for (const char* name : {"libController.so", "libCppController.so"})
        if (std::error_code there; fs::read_symlink(names / name, there) != controller_library()) {
          const fs::path draft = names / fmt::format("{}.{}", name, getpid());
          fs::create_symlink(controller_library(), draft, none);
          fs::rename(draft, names / name, none);
        }
      names_ = names.string();
      return true;
    }
    // a script says by which program it is read
    const std::string text = text_of(found_.main);
    const std::vector<std::string> words = sim::words_of(text.substr(2, text.find('\n') - 2));
    if (words.empty()) return fail("got a script with an empty #! line, expected an interpreter");
    std::vector<std::string> command = words;
    if (fs::path(words[0]).filename() == "env") command.erase(command.begin());
    if (!command.empty() && command[0] == "-S") command.erase(command.begin());
    const fs::path interpreter = command.empty() ? fs::path() : on_path(command[0]);
    if (interpreter.empty())
      return fail("got a script for " + (command.empty() ? words[0] : command[0]) + ", which is not here");
    if (interpreter.filename().string().rfind("python", 0) == 0) return python();
    command[0] = interpreter.string();
    command.push_back(found_.main.string());
    launch_.words = command;
    return true;
  }

  /// The interpreter: of runtime.ini, of a virtual environment in the folder, of the #! line, python3.
  fs::path interpreter() {
    if (const auto wanted = ini_.commands.find("python"); wanted != ini_.commands.end()) {
      for (const std::string& name : {wanted->second, (found_.folder / wanted->second).string()})
        if (fs::path file = on_path(name); !file.empty() && !name.empty()) return file;
      if (tell_)
        tell_((found_.folder / "runtime.ini").string() + ": python.COMMAND: got " + wanted->second +
              ", which is not here; python3 is taken");
    }
    for (const char* name : {"venv", ".venv", "env"})
      for (const fs::path& folder : {found_.folder, found_.folder.parent_path().parent_path()}) {
        std::error_code none;
        if (!fs::exists(folder / name / "pyvenv.cfg", none)) continue;
        if (fs::path file = on_path((folder / name / "bin" / "python3").string()); !file.empty()) return file;
      }
    const std::string text = text_of(found_.main);
    if (text.rfind("#!", 0) == 0)
      for (const std::string& word : sim::words_of(text.substr(2, text.find('\n') - 2)))
        if (fs::path(word).filename().string().rfind("python3", 0) == 0)
          if (fs::path file = on_path(word); !file.empty()) return file;
    return on_path("python3");
  }

  /// What runtime.ini gives to the interpreter.
  void add_options(const std::string& language) {
    const auto options = ini_.options.find(language);
    if (options != ini_.options.end())
      launch_.words.insert(launch_.words.end(), options->second.begin(), options->second.end());
  }

  bool python() {
    if (found_.main.empty()) return fail(found_.why);
    const fs::path file = interpreter();
    if (file.empty()) return fail("got a program in Python, expected python3 to run it; apt install python3");
    launch_.words = {file.string(), "-u"};
    add_options("python");
    const fs::path ours = places::product_share() / "programs" / "controller" / "python";
    // a copy of Webots' own package beside the program would hide ours, and is nothing without Webots
    const fs::path copy = found_.folder / "controller.py";
    if (copy != found_.main && text_of(copy).find("_controller") != std::string::npos)
      launch_.words.push_back((ours / "run_program.py").string());
    launch_.words.push_back(found_.main.lexically_relative(found_.folder).string());
    launch_.environment.push_back(joined("PYTHONPATH", {ours.string()}, ini_));
    for (const char* setting : {"PYTHONUNBUFFERED=1", "PYTHONHASHSEED=0", "PYTHONIOENCODING=UTF-8"})
      launch_.environment.push_back(setting);
    // what Python compiles is kept, and the controller's folder stays as it is
    std::error_code none;
    launch_.environment.push_back("PYTHONDONTWRITEBYTECODE=");
    launch_.environment.push_back("PYTHONPYCACHEPREFIX=" + (fs::absolute(cache_, none) / "python").string());
    return true;
  }

  /// Compiles a folder's Java; the classes' folder, empty when it failed.
  fs::path java_classes(const std::string& classpath) {
    const fs::path compiler = on_path("javac");
    if (compiler.empty()) {
      fail("got a program in Java, expected javac to compile it; apt install default-jdk-headless");
      return {};
    }
    std::vector<std::string> command = {compiler.string(),
                                        "-J-Xmx512m",
                                        "-J-XX:CompressedClassSpaceSize=64m",
                                        "-J-XX:ReservedCodeCacheSize=64m",
                                        "-nowarn",
                                        "-encoding",
                                        "UTF-8",
                                        "-g",
                                        "-cp",
                                        classpath,
                                        "-sourcepath",
                                        found_.folder.string()};
    // Classes are kept under a name made of all sources and the class path.
    std::uint64_t h = hash_of(hash_of(3, classpath), found_.main.string());
    int files = 0;
    for (const fs::path& file : files_below(found_.folder))
      if (kind_of(file) == ".java") h = hash_of(hash_of(h, file.string()), text_of(file)), ++files;
    std::error_code none;
    const fs::path home = fs::absolute(cache_, none);
    fs::path kept = home / fmt::format("{}-{:016x}.classes", found_.main.stem().string(), h);
    launch_.files = files;
    if (fs::is_directory(kept, none)) return kept;
    // They are made beside that place and moved there whole.
    const fs::path draft = kept.string() + fmt::format(".{}", getpid());
    fs::create_directories(draft, none);
    command.insert(command.end(), {"-d", draft.string(), found_.main.string()});
    const cc::ProcessResult done = cc::run_process(command);
    if (done.status != 0) {
      fail("does not compile:");
      for (const std::string& line : sim::words_of(done.output, "\n")) problems_.push_back(line);
      fs::remove_all(draft, none);
      return {};
    }
    std::error_code wrong;
    fs::rename(draft, kept, wrong);
    if (wrong) fs::remove_all(draft, none);  // another run was faster
    return kept;
  }

  bool java() {
    // The virtual machine.
    const std::string wanted = ini_.commands.count("java") ? ini_.commands["java"] : "java";
    fs::path machine = on_path(wanted);
    if (machine.empty()) machine = on_path("java");
    if (machine.empty())
      return fail("got a program in Java, expected java to run it; apt install default-jre-headless");
    // Its class path: our library, what the user asks for, archives in the folder, then the program.
    const fs::path product = places::tools_folder();
    std::string classpath = (product / "Controller.jar").string();
    for (const auto& [name, value] : ini_.environment)
      if (name == "CLASSPATH") classpath += ":" + value;
    if (const char* inherited = std::getenv("CLASSPATH")) classpath += std::string(":") + inherited;
    std::error_code none;
    for (const fs::path& jar : files_below(found_.folder))
      if (kind_of(jar) == ".jar" && jar != found_.main) classpath += ":" + jar.string();
    if (found_.kind == Kind::Java) {
      const fs::path classes = java_classes(classpath);
      if (classes.empty()) return false;
      classpath = classes.string() + ":" + classpath;
    }
    classpath = (found_.kind == Kind::Jar ? found_.main : found_.folder).string() + ":" + classpath;
    std::string libraries = product.string();
    for (const auto& [name, value] : ini_.environment)
      if (name == "JAVA_LIBRARY_PATH") libraries += ":" + value;
    // a machine takes room for a server's program otherwise, and a thread for each core
    launch_.words = {machine.string(),
                     "-XX:CompressedClassSpaceSize=64m",
                     "-XX:ReservedCodeCacheSize=64m",
                     "-XX:+UseSerialGC",
                     "-Xmx512m",
                     "-classpath",
                     classpath,
                     "-Djava.library.path=" + libraries};
    add_options("java");
    launch_.words.push_back(found_.main.stem().string());
    return true;
  }

  bool with_libraries() {
    std::vector<std::string> folders;
    for (const auto& [name, value] : ini_.environment)
      if (name == "WEBOTS_LIBRARY_PATH") folders.push_back(value);
    const auto of_project = library_folders(found_.folder);
    folders.insert(folders.end(), of_project.begin(), of_project.end());
    if (!names_.empty()) folders.insert(folders.end(), {names_, controller_library().parent_path().string()});
    bool is_set = !folders.empty();
    for (const auto& [name, value] : ini_.environment) is_set = is_set || name == "LD_LIBRARY_PATH";
    if (is_set) launch_.environment.push_back(joined("LD_LIBRARY_PATH", folders, ini_));
    launch_.environment.push_back("TWINPUCK_LIBCONTROLLER=" + controller_library().string());
    return true;
  }

  Found found_;
  std::string said_;
  fs::path cache_;
  Tell tell_;
  std::vector<std::string>& problems_;
  Launch& launch_;
  RuntimeIni ini_;
  std::string names_;  // folder with the library under Webots' names
};

}  // namespace

bool prepare(const std::string& path, const std::string& cache_folder, const Tell& tell,
             std::vector<std::string>& problems, Launch& launch) {
  launch = {};
  const Found found = look_at(path);
  if (found.kind == Kind::Extern) {
    launch.source = path;
    launch.is_extern = true;
    return true;
  }
  Starter starter(found, path, cache_folder, tell, problems, launch);
  return starter.run() && (!is_contained() || starter.contain());
}

}  // namespace programs
