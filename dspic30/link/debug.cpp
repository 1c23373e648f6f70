// SPDX-License-Identifier: MIT
#include "dspic30/link/debug.h"

#include <set>

namespace dspic::link {

namespace {

constexpr std::uint8_t kUnitsPerWord = 2;

std::uint32_t long_at(const Section& s, std::size_t at) {
  return s.bytes[at] | s.bytes[at + 1] << 8 | s.bytes[at + 2] << 16 | std::uint32_t(s.bytes[at + 3]) << 24;
}
void put_long(Section& s, std::size_t at, std::uint32_t v) {
  for (std::size_t i = 0; i < 4; ++i) s.bytes[at + i] = std::uint8_t(v >> 8 * i);
}
std::uint32_t word_at(const Section& s, std::size_t at) { return s.bytes[at] | s.bytes[at + 1] << 8; }

/// A line table's header says how long the shortest instruction is; its steps count in that.
void shorten_lines(Section& s) {
  constexpr std::size_t kLength = 4, kShortest = 4 + 2 + 4;  // after length, version, header length
  for (std::size_t at = 0; at + kShortest < s.bytes.size(); at += kLength + long_at(s, at))
    s.bytes[at + kShortest] = kUnitsPerWord;
}

/// A common information entry says the same of call frames, after its augmentation string.
void shorten_frames(Section& s) {
  constexpr std::uint32_t kCommonEntry = 0xFFFFFFFF;
  for (std::size_t at = 0; at + 10 < s.bytes.size(); at += 4 + long_at(s, at)) {
    if (long_at(s, at + 4) != kCommonEntry) continue;
    std::size_t factor = at + 9;
    while (factor + 1 < s.bytes.size() && s.bytes[factor]) ++factor;
    s.bytes[factor + 1] = kUnitsPerWord;
  }
}

/// Lists of [begin, end) are relative to the unit where they were not filled in.
void halve_lists(Section& s, bool has_expressions) {
  constexpr std::uint32_t kBase = 0xFFFFFFFF;
  constexpr std::size_t kAddress = 4, kPair = 2 * kAddress;
  std::set<std::uint32_t> filled;
  for (const Relocation& r : s.relocations) filled.insert(r.offset);
  for (std::size_t at = 0; at + kPair <= s.bytes.size();) {
    const std::uint32_t begin = long_at(s, at), end = long_at(s, at + kAddress);
    if (begin != kBase)
      for (const std::size_t place : {at, at + kAddress})
        if (!filled.count(std::uint32_t(place))) put_long(s, place, long_at(s, place) / 2);
    at += kPair;
    const bool is_range = begin != kBase && (begin || end);
    if (is_range && has_expressions && at + 2 <= s.bytes.size()) at += 2 + word_at(s, at);
  }
}

}  // namespace

void place_debug(Program& program) {
  std::map<std::string, std::uint32_t> length;
  for (Section& s : program.sections)
    if (s.kind == Kind::Debug) {
      s.address = length[s.name];
      length[s.name] += s.size;
    }
}

void halve_addresses(Program& program) {
  for (Section& s : program.sections) {
    if (s.name == ".debug_line") shorten_lines(s);
    if (s.name == ".debug_frame") shorten_frames(s);
    if (s.name == ".debug_ranges") halve_lists(s, false);
    if (s.name == ".debug_loc") halve_lists(s, true);
  }
}

}  // namespace dspic::link
