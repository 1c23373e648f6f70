// SPDX-License-Identifier: MIT
// How much of the chip an image takes.
#include <cstdio>

#include "dspic30/llvm/link.h"
#include "dspic30/memory/program_memory.h"

namespace dspic::link {

std::string report(const Program& program) {
  constexpr unsigned kRamBytes = 8192;
  const unsigned words = program.code_words + program.constant_words + program.dinit_words;
  const std::string no_bound =
      program.recursive.empty() ? "" : " (no bound: " + program.recursive + "() calls itself)";
  char text[400];
  std::snprintf(text, sizeof text,
                "flash %6u of %u words (%u %%): code %u, constants %u, start values %u\n"
                "RAM   %6u of %u bytes (%u %%)\n"
                "stack %6u bytes at most%s, %u left for it\n",
                words, kFlashWords, 100 * words / kFlashWords, program.code_words, program.constant_words,
                program.dinit_words, program.ram_bytes, kRamBytes, 100 * program.ram_bytes / kRamBytes,
                program.stack_bytes, no_bound.c_str(), program.stack_end - program.stack_begin);
  return text;
}

}  // namespace dspic::link
