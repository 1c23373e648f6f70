// SPDX-License-Identifier: MIT
// twinpuck-library STAMP DEPFILE: compiles what is linked behind every program into the folder of STAMP, for
// `make build`. Writes a rule with everything it looked at.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <thread>

#include "build_record.h"
#include "library_objects.h"

namespace fs = std::filesystem;

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: twinpuck-library STAMP DEPFILE\n";
    return 2;
  }
  // The libraries as a user's build asks for them; what they are made of is kept.
  cc::BuildInputs inputs;
  const cc::NotingInputs noting(inputs);
  std::string wrong;
  std::set<std::string> kept = {fs::path(argv[1]).filename().string(), fs::path(argv[2]).filename().string()};
  for (const cc::Library& library : cc::provide_usual_libraries(
           fs::absolute(argv[1]).parent_path(), int(std::max(1u, std::thread::hardware_concurrency())))) {
    if (!library.ok) wrong += library.messages;
    kept.insert({library.archive.filename().string(), library.archive.filename().string() + ".sum"});
    for (const fs::path& object : library.objects)  // NAME.CONTENT.o, and NAME.deps
      for (const fs::path& file :
           {object, fs::path(object).replace_extension(".txt"), fs::path(object).replace_extension(".facts"),
            fs::path(object).replace_extension().replace_extension(".deps")})
        kept.insert(file.filename().string());
  }
  // of earlier compilers and sources: what is left is what is installed
  std::error_code none;
  if (wrong.empty())
    for (const auto& entry : fs::directory_iterator(fs::absolute(argv[1]).parent_path(), none))
      if (!kept.count(entry.path().filename().string())) fs::remove(entry.path(), none);
  // The rule that tells make, or ninja, what this depends on.
  std::string rule = std::string(argv[1]) + ":";
  for (const auto& [path, input] : inputs.all) {
    std::string escaped;
    for (char c : path) escaped += c == ' ' ? std::string("\\ ") : std::string(1, c);
    if (input.state.number) rule += " " + escaped;
  }
  std::cerr << wrong;
  return wrong.empty() && cc::write_text(argv[2], rule + "\n") && cc::write_text(argv[1], "") ? 0 : 1;
}
