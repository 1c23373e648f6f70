// SPDX-License-Identifier: MIT
// The verbs of the `twinpuck` command and what they share. Exit codes are those of docs/start.md.
#pragma once
#include <CLI/CLI.hpp>

namespace tools {

/// Exit codes of every verb.
enum Exit {
  kPass = 0,
  kTestFailed = 1,     ///< a test or assertion failed; `build`, `check`, `lint`: the input has errors
  kBadInput = 2,       ///< usage or bad input, nothing ran
  kTrapped = 3,        ///< a firmware trapped or was reset unexpectedly; a supervisor crashed
  kTimeOut = 4,        ///< virtual time-out or no progress
  kNothing = 5,        ///< nothing was selected
  kInternal = 6,       ///< internal error
  kInvalidRun = 7,     ///< an output was lost (disk full), a fault never fired, a replay diverged
  kHostTime = 124,     ///< host time guard
  kInterrupted = 130,  ///< Ctrl-C
};

/// All verbs, but for what help does not list; `help` too.
void add_verbs(CLI::App& app, int& exit_code);

/// Each verb adds its options to `app`; `exit_code` is set when it has run.
void add_run(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_build(CLI::App& app, int& exit_code);
void add_lint(CLI::App& app, int& exit_code);
void add_cycles(CLI::App& app, int& exit_code);
void add_dis(CLI::App& app, int& exit_code);
void add_asm(CLI::App& app, int& exit_code);
void add_flash(CLI::App& app, int& exit_code);
void add_new(CLI::App& app, int& exit_code);
void add_init(CLI::App& app, int& exit_code);
void add_paths(CLI::App& app, int& exit_code);
void add_list(CLI::App& app, int& exit_code);
void add_import(CLI::App& app, int& exit_code);
void add_inspect(CLI::App& app, int& exit_code);
void add_debug(CLI::App& app, int& exit_code);
void add_lab(CLI::App& app, int& exit_code);
void add_view(CLI::App& app, int& exit_code);
void add_test(CLI::App& app, int& exit_code);
void add_grade(CLI::App& app, int& exit_code);

}  // namespace tools
