// SPDX-License-Identifier: MIT
#include "containment.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "compiler/cache/readable_files.h"

namespace programs {

namespace {

const char* const kBubblewrap = "/usr/bin/bwrap";
/// Of the system: what programs are made of, and nothing of anybody's.
const char* const kSystem[] = {"/usr",
                               "/bin",
                               "/lib",
                               "/lib32",
                               "/lib64",
                               "/libx32",
                               "/etc/fonts",
                               "/etc/ld.so.cache",
                               "/etc/alternatives"};

/// Whether a place in the submission is a link to one outside.
bool leads_out(const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path own = cc::submission();
  std::error_code none;
  return !own.empty() && cc::is_named_below(path, own) &&
         !cc::is_named_below(fs::weakly_canonical(path, none), fs::weakly_canonical(own, none));
}

}  // namespace

bool is_contained() {
  const char* const said = std::getenv("TWINPUCK_CONTAIN");
  return said && std::string_view(said) == "1";
}

std::vector<std::string> contained(const std::vector<std::string>& words, const std::string& folder,
                                   const std::vector<std::string>& readable,
                                   const std::vector<std::string>& writable) {
  if (access(kBubblewrap, X_OK) != 0) return {};
  std::vector<std::string> all{
      kBubblewrap, "--unshare-all", "--die-with-parent", "--new-session", "--dev", "/dev",
      "--tmpfs",   "/tmp",          "--setenv",          "HOME",          "/tmp"};
  const auto bind = [&all](const char* how, const std::string& path) {
    if (!path.empty() && !leads_out(path)) all.insert(all.end(), {how, path, path});
  };
  for (const char* path : kSystem) bind("--ro-bind-try", path);
  for (const std::string& path : readable) bind("--ro-bind-try", path);
  for (const std::string& path : writable) bind("--bind-try", path);
  all.insert(all.end(), {"--chdir", folder, "--"});
  all.insert(all.end(), words.begin(), words.end());
  return all;
}

}  // namespace programs
