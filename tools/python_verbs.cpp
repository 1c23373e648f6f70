// SPDX-License-Identifier: MIT
// twinpuck test, twinpuck grade: Python's part of the product, which becomes this process.
#include <pthread.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "install/places.h"
#include "tools/command_line.h"
#include "tools/run_guard.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

/// Debian's Python, whose numpy and pytest the module is made for; TWINPUCK_PYTHON names another one.
std::string interpreter() {
  if (const char* named = std::getenv("TWINPUCK_PYTHON"); named && *named) return named;
  return "/usr/bin/python3";
}

/// Becomes `python3 -m MODULE ARGUMENTS`. Returns only when that cannot be.
int become(const char* module, const std::vector<std::string>& arguments) {
  const fs::path folder = places::tools_folder() / "python";
  const std::string python = interpreter();
  if (!fs::exists(folder / "twinpuck" / "__init__.py")) {
    complain({folder.string() + ": got no Python module, expected twinpuck; build it with `make build`"});
    return kBadInput;
  }
  const char* const before = std::getenv("PYTHONPATH");
  const std::string path = folder.string() + (before && *before ? std::string(":") + before : "");
  setenv("PYTHONPATH", path.c_str(), 1);
  setenv("PYTHONUTF8", "1", 1);  // file names are bytes, whatever the locale says of letters
  std::vector<std::string> words{python, "-m", module};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::signal(SIGPIPE, SIG_DFL);
  // a signal waits until Python can end as people expect it (python/twinpuck/_ending.py)
  sigset_t ends, usual;
  sigemptyset(&ends);
  for (const int s : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&ends, s);
  pthread_sigmask(SIG_BLOCK, &ends, &usual);
  if (const int asked = end_asked())
    return asked;  // by one that came before: the guard would be gone with it
  execvp(python.c_str(), argv.data());
  pthread_sigmask(SIG_SETMASK, &usual, nullptr);
  complain({python + ": cannot be started: " + std::strerror(errno) +
            "; expected Python 3 (Debian: python3, python3-numpy, python3-pytest), or set TWINPUCK_PYTHON"});
  return kBadInput;
}

/// A verb whose arguments are for Python to read.
void add_python_verb(CLI::App& app, const char* name, const char* does, const char* module,
                     const char* footer, int& exit_code) {
  auto* verb = app.add_subcommand(name, does);
  verb->prefix_command();
  verb->footer(footer);
  verb->callback([verb, module, &exit_code] { exit_code = become(module, verb->remaining()); });
}

}  // namespace

void add_test(CLI::App& app, int& exit_code) {
  add_python_verb(
      app, "test", "Run tests of controllers: Python files and *.test.toml, by pytest", "twinpuck._test",
      "Arguments are pytest's, with paths of tests, -k, -x, -n CORES, --junitxml FILE, and Twinpuck's:\n"
      "  --seeds 1..50      each test with these seeds\n"
      "  --hal sim,dspic    ... with programs linked with these HALs\n"
      "  --selector 0..15   ... with the selector in these positions\n"
      "  --firmware DIR     what the robots run instead of what the world says\n"
      "  --sanitize         programs are checked at each access of memory\n"
      "  --coverage FILE    lcov file that counts of lines are added to\n"
      "  --failures DIR     where failures leave picture and recording\n"
      "Example: twinpuck test --seeds 1..10 -n 2   (docs/testing.md)\n"
      "Exit codes: 0 all passed, 1 a test failed, 2 bad input, 5 no test was found, 6 internal error, "
      "7 an output was lost, or a fault never took effect and all else passed, 130 interrupted",
      exit_code);
}

void add_grade(CLI::App& app, int& exit_code) {
  add_python_verb(
      app, "grade", "Run tests over a class's folders: points, a table, JUnit", "twinpuck._grade",
      "Arguments are folders or files of tests, as `twinpuck test` has them, and:\n"
      "  --submissions DIR  a folder for each student in it\n"
      "  --program NAME     the folder in each submission that holds the program\n"
      "  --seeds 1..50      each test with these seeds, which students need not know\n"
      "  --hal sim,dspic    ... with programs linked with these HALs\n"
      "  --selector 0..15   ... with the selector in these positions\n"
      "  --sanitize         programs are checked at each access of memory\n"
      "  --limit S          real seconds a submission (120)\n"
      "  --jobs N           so many at a time (all cores)\n"
      "  --csv FILE         the points for a spreadsheet\n"
      "  --html FILE        the table as a page, with what failed\n"
      "  --junitxml FILE    for CI: a suite a submission\n"
      "  --keep DIR         pictures and recordings of failures\n"
      "  --trusted          programs of the PC are not contained\n"
      "Example: twinpuck grade tests/ --submissions class/ --csv points.csv --html points.html   "
      "(docs/testing.md)\n"
      "Exit codes: 0 everybody was graded, 2 bad input, 6 somebody was not: the tests broke, 7 a table "
      "could not be written, 130 interrupted",
      exit_code);
}

}  // namespace tools
