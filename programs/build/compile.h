// SPDX-License-Identifier: MIT
// Inside programs/build: a folder or file of C and C++ becomes a program, kept under a name
// made of its content.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "kinds.h"

namespace programs {

struct Compiled {
  fs::path program;  ///< empty: it failed
  int files = 0;     ///< sources
};

/// The library that programs link with: TWINPUCK_LIBCONTROLLER, or libcontroller.so of the product.
fs::path controller_library();

/// Compiles what `found` is; `said` is what people call it, for messages.
Compiled compile(const Found& found, const std::string& said, const fs::path& cache,
                 const std::function<void(const std::string&)>& tell, std::vector<std::string>& problems);

}  // namespace programs
