// SPDX-License-Identifier: MIT
// What is linked behind every program: the e-puck library, the firmware's libc, and for programs that are
// written for Webots its interfaces. Its objects and archives lie beside the compiler
// in library/; `make build` fills it. What is missing there, or has changed since, is compiled into the
// user's cache when a build asks for it.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "build.h"
#include "compiler/cache/object_cache.h"

namespace cc {

std::filesystem::path compiler_path();

/// Sub-folders of the contract, in the order a flat "e_motors.h" is looked up: the one-timer drivers first.
std::vector<std::filesystem::path> contract_folders(const std::filesystem::path& root);
/// Where the headers of the e-puck library are.
std::filesystem::path include_root(const BuildOptions& options);
/// Names of headers, each in its folder: one that appears or goes away can change what an #include finds.
std::string names_of_headers(const std::vector<std::filesystem::path>& folders);

struct Library {
  bool ok = false;
  std::filesystem::path archive;
  std::string messages;            ///< of compilers and archiver
  std::vector<std::string> facts;  ///< what the drivers do with addresses (shared_variables.h)
  std::vector<std::filesystem::path> objects;
  int compiled = 0, reused = 0;
};

/// Compiles what is not there yet. Within a build (build_record.h).
Library provide_library(const BuildOptions& options, bool is_webots);

/// What an assembler source may do, by the symbols of its object: each of its labels uses all that it names.
std::string facts_of_assembler(const std::filesystem::path& object);

struct Archive {
  std::filesystem::path file;
  std::string error;
};
/// Objects as an archive, made where it is not what it should be.
Archive archive(const std::vector<CompileOutcome>& objects, const ObjectFolders& folders);

/// Every library that programs usually ask for, at -O1, with all its files in `folder`; for `make build`.
std::vector<Library> provide_usual_libraries(const std::filesystem::path& folder, int jobs);

}  // namespace cc
