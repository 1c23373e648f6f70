// SPDX-License-Identifier: MIT
// twinpuck paths: where things of the product lie, for editors and Makefiles.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "install/places.h"
#include "sim_core/base/did_you_mean.h"
#include "tools/command_line.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

struct Place {
  const char *name, *folder;  // folder: below the product's
  bool is_made = false;       // ... or below what building made
};
constexpr Place kPlaces[] = {
    {"root", ""},
    {"headers", "firmware/include"},    // of the e-puck's library
    {"libc", "firmware/libc/include"},  // of C, with the chip's builtins
    {"controllers", "firmware"},
    {"worlds", "worlds"},
    {"templates", "tools/templates"},
    {"editors", "editors"},
    {"python", "python", true},  // what PYTHONPATH names for `import twinpuck`
};

}  // namespace

void add_paths(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("paths", "Where headers, worlds, controllers and editors' files lie");
  auto what = std::make_shared<std::string>();
  std::vector<std::string> names;
  for (const Place& place : kPlaces) names.push_back(place.name);
  verb->add_option("WHAT", *what, fmt::format("one of them alone: {}", fmt::join(names, ", ")));
  verb->callback([what, names, &exit_code] {
    if (!what->empty() && std::find(names.begin(), names.end(), *what) == names.end()) {
      complain({fmt::format("command line: WHAT: got '{}', expected one of {}{}", *what,
                            fmt::join(names, ", "), sim::did_you_mean_tail(*what, names))});
      exit_code = kBadInput;
      return;
    }
    for (const Place& place : kPlaces) {
      std::error_code none;
      const std::string path =
          fs::weakly_canonical((place.is_made ? places::tools_folder() : places::share_root()) / place.folder,
                               none)
              .string();
      if (what->empty()) std::cout << fmt::format("{:<12} {}\n", place.name, path);
      if (*what == place.name) std::cout << path << '\n';
    }
    exit_code = kPass;
  });
}

}  // namespace tools
