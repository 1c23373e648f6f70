// SPDX-License-Identifier: MIT
// firmware_test: loads the modules of tests that cmake has listed, which register themselves, and runs them.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <string>

int main(int argc, char** argv) {
  std::ifstream list(TWINPUCK_TEST_MODULES);
  for (std::string module; std::getline(list, module);)
    // global: a fixture that two files use must be one class
    if (!dlopen(module.c_str(), RTLD_NOW | RTLD_GLOBAL)) {
      std::cerr << dlerror() << "\n";
      return 2;
    }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
