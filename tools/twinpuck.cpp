// SPDX-License-Identifier: MIT
// The command twinpuck: options, help, and what is made of errors. Verbs live in files of their own.
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>

#include "tools/command_line.h"
#include "tools/printable.h"
#include "tools/run_guard.h"
#include "tools/twinpuck.h"
#include "tools/verbs.h"

namespace tools {

int twinpuck(int argc, char** argv) {
  const PrintableStream out(std::cout), error(std::cerr);
  // what cannot be written is an error of the call, not the end of the program
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  guard_process();
  int exit_code = kPass;
  CLI::App app{"Twinpuck: the firmware twin of the e-puck robot"};
  app.require_subcommand(1);
  app.set_version_flag("-V,--version", "twinpuck " TWINPUCK_VERSION);
  add_run(app, exit_code);
  add_check(app, exit_code);
  add_build(app, exit_code);
  add_lint(app, exit_code);
  add_cycles(app, exit_code);
  add_dis(app, exit_code);
  add_asm(app, exit_code);
  add_flash(app, exit_code);
  add_debug(app, exit_code);
  add_new(app, exit_code);
  add_inspect(app, exit_code);
  add_list(app, exit_code);
  add_import(app, exit_code);
  add_view(app, exit_code);
  add_lab(app, exit_code);
  add_timings(app, exit_code);
  add_help(app);
  try {
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

}  // namespace tools
