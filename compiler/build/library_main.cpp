// SPDX-License-Identifier: MIT
// twinpuck-library STAMP DEPFILE: compiles what is linked behind every program into the folder of STAMP, for
// `make build`. Writes a rule with everything it looked at.
#include <algorithm>
#include <iostream>
#include <thread>

#include "build_record.h"
#include "library_objects.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: twinpuck-library STAMP DEPFILE\n";
    return 2;
  }
  cc::BuildInputs inputs;
  const cc::NotingInputs noting(inputs);
  std::string wrong;
  for (const cc::Library& library :
       cc::provide_usual_libraries(std::filesystem::absolute(argv[1]).parent_path(),
                                   int(std::max(1u, std::thread::hardware_concurrency()))))
    if (!library.ok) wrong += library.messages;
  std::string rule = std::string(argv[1]) + ":";
  for (const auto& [path, input] : inputs.all) {
    std::string escaped;
    for (char c : path) escaped += c == ' ' ? std::string("\\ ") : std::string(1, c);
    if (input.state.number) rule += " " + escaped;
  }
  std::cerr << wrong;
  return wrong.empty() && cc::write_text(argv[2], rule + "\n") && cc::write_text(argv[1], "") ? 0 : 1;
}
