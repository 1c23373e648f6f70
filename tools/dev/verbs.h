// SPDX-License-Identifier: MIT
// Verbs of `twinpuck-dev`, the command of those who make Twinpuck: it writes what is generated and holds it
// against the sources.
#pragma once
#include <CLI/CLI.hpp>

namespace dev {

/// Each adds its options to `app`; `exit_code` is set when it has run.
void add_timings(CLI::App& app, int& exit_code);
void add_manual(CLI::App& app, int& exit_code);
void add_page(CLI::App& app, int& exit_code);

}  // namespace dev
