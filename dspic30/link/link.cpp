// SPDX-License-Identifier: MIT
#include "dspic30/link/link.h"

#include <cstdio>

#include "dspic30/link/debug.h"

namespace dspic::link {

bool run(const Options& options) {
  Program program;
  program.sources = options.sources;
  program.moved_from = options.moved_from;
  program.moved_to = options.moved_to;
  if (read_all(program, options)) {
    keep_used(program);
    choose_filled(program, options);
    place_debug(program);
    place_all(program, options);
    fill_all(program);
    if (program.errors.empty()) {
      bound_stack(program);
      program.sizes = report(program);
      if (options.is_filled_by_host) fill_by_host(program, options);
      halve_addresses(program);
      write_all(program, options);
    }
  }
  for (const std::string& w : program.warnings) std::fprintf(stderr, "link: warning: %s\n", w.c_str());
  for (const std::string& e : program.errors)
    std::fprintf(stderr, "%s%s\n", e.find(": error: ") == std::string::npos ? "link: error: " : "",
                 e.c_str());
  if (program.errors.empty()) std::fputs(program.sizes.c_str(), stdout);
  return program.errors.empty();
}

}  // namespace dspic::link
