// SPDX-License-Identifier: MIT
// How much of the chip an image takes: every word of flash that it fills, whatever that holds.
#include <cstdio>
#include <set>

#include "dspic30/link/link.h"
#include "dspic30/memory/program_memory.h"

namespace dspic::link {

namespace {

/// Words that a kind fills; two constants may share one, and between aligned ones there are gaps.
unsigned words_of(const Program& program, Kind kind) {
  std::set<std::uint32_t> filled;
  for (const Section& s : program.sections) {
    if (!s.used || s.kind != kind) continue;
    const std::uint32_t begin = kind == Kind::Code ? s.address : s.load,
                        end = begin + (kind == Kind::Code ? s.size / 2 : s.size);
    for (std::uint32_t at = begin & ~1u; at < end; at += 2) filled.insert(at);
  }
  return unsigned(filled.size());
}

}  // namespace

std::string report(const Program& program) {
  constexpr unsigned kRamBytes = 8192;
  const auto words = unsigned(std::distance(program.words.begin(), program.words.lower_bound(kFlashEnd)));
  const unsigned code = words_of(program, Kind::Code), constants = words_of(program, Kind::Constant),
                 tables = words_of(program, Kind::Table),
                 others = words - code - constants - tables - program.dinit_words;
  const std::string no_bound =
      program.recursive.empty() ? "" : " (no bound: " + program.recursive + "() calls itself)";
  char text[500];
  std::snprintf(
      text, sizeof text,
      "flash %6u of %u words (%u %%): code %u, constants %u, tables %u, start values %u, vectors and "
      "jumps %u\n"
      "RAM   %6u of %u bytes (%u %%)\n"
      "stack %6u bytes at most%s, %u left for it\n",
      words, kFlashWords, 100 * words / kFlashWords, code, constants, tables, program.dinit_words, others,
      program.ram_bytes, kRamBytes, 100 * program.ram_bytes / kRamBytes, program.stack_bytes,
      no_bound.c_str(), program.stack_end - program.stack_begin);
  std::string all = text;
  for (const HostChoice& choice : program.host)
    all += "host  " + choice.driver->name +
           (choice.why_not.empty() ? "" : (choice.is_linked ? " chip: " : " own: ") + choice.why_not) + "\n";
  return all;
}

}  // namespace dspic::link
