// SPDX-License-Identifier: MIT
// libFuzzer's entry; FUZZ_KIND is set by CMake, a program for each kind of input.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/kinds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::FUZZ_KIND({reinterpret_cast<const char*>(data), size});
  return 0;
}
