// SPDX-License-Identifier: MIT
// The command twinpuck: options, help, and what is made of errors. Verbs live in files of their own.
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "install/cache_bound.h"
#include "tools/command_line.h"
#include "tools/printable.h"
#include "tools/run_guard.h"
#include "tools/twinpuck.h"
#include "tools/verbs.h"

namespace tools {

namespace {

struct Verb {
  std::string_view name;
  void (*add)(CLI::App&, int& exit_code);
};
constexpr Verb kVerbs[] = {
    {"run", add_run},         {"check", add_check}, {"build", add_build},   {"lint", add_lint},
    {"cycles", add_cycles},   {"dis", add_dis},     {"asm", add_asm},       {"flash", add_flash},
    {"debug", add_debug},     {"new", add_new},     {"init", add_init},     {"paths", add_paths},
    {"inspect", add_inspect}, {"list", add_list},   {"import", add_import}, {"view", add_view},
    {"lab", add_lab},         {"test", add_test},   {"grade", add_grade},
};

}  // namespace

void add_verbs(CLI::App& app, int& exit_code) {
  for (const Verb& verb : kVerbs) verb.add(app, exit_code);
  add_help(app);
}

namespace {

int call(int argc, char** argv) {
  // what cannot be written is an error of the call, not the end of the program
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  guard_process();
  if (const std::string wrong = places::wrong_cache_bound(); !wrong.empty()) {
    complain({wrong});
    return kBadInput;
  }
  int exit_code = kPass;
  CLI::App app{"Twinpuck: the firmware twin of the e-puck robot"};
  app.require_subcommand(1);
  app.set_version_flag("-V,--version", "twinpuck " TWINPUCK_VERSION);
  // whoever calls a verb pays for its options only, a seventh of a short run otherwise
  const std::string_view called = argc > 1 ? argv[1] : "";
  const bool is_verb =
      std::any_of(std::begin(kVerbs), std::end(kVerbs), [&](const Verb& v) { return v.name == called; });
  for (const Verb& verb : kVerbs)
    if (!is_verb || verb.name == called) verb.add(app, exit_code);
  add_help(app);
  try {
    std::error_code gone;
    if (const auto here = std::filesystem::current_path(gone); is_verb && here.empty()) {
      complain({"current folder: got " + gone.message() +
                ", expected one that is there; was it deleted? change to another one"});
      return kBadInput;
    }
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return usage_error(app, e, argc, argv);
  } catch (const std::filesystem::filesystem_error& e) {
    // a loop of links, a folder that may not be read: whatever was named, it is the user's to mend
    complain({(e.path1().empty() ? "file system" : e.path1().string()) +
              ": cannot be used: " + e.code().message()});
    return kBadInput;
  } catch (const std::exception& e) {
    std::cerr << "twinpuck: internal error: " << e.what() << '\n';
    return kInternal;
  }
  return exit_code;
}

}  // namespace

int twinpuck(int argc, char** argv) {
  PrintableStream out(std::cout);
  const PrintableStream error(std::cerr);
  const int exit_code = call(argc, argv);
  const int lost = out.finish();
  // whoever closes a pipe has seen enough
  if (lost == 0 || lost == EPIPE) return exit_code;
  complain({std::string("standard output: cannot be written: ") + std::strerror(lost)});
  return exit_code == kPass || exit_code == kTestFailed ? kInvalidRun : exit_code;
}

}  // namespace tools
