// SPDX-License-Identifier: MIT
// Fields of the Cpu, by where they lie in it.
#pragma once
#include <cstdint>
#include <set>
#include <vector>

#include "dspic30/translate/stretch.h"

namespace dspic::translate {

inline std::uint64_t offset_of(const Cpu& cpu, const void* field) {
  return static_cast<std::uint64_t>(static_cast<const char*>(field) - reinterpret_cast<const char*>(&cpu));
}

/// Those that a stretch keeps to itself, one after another: w, n, z, c, ov, dc, now.
struct Hot {
  using Fields = std::uint32_t;  ///< a bit each
  struct Field {
    std::uint64_t offset;
    unsigned bytes;
    bool is_used = false;
    std::set<const Item*> writers = {};
  };
  explicit Hot(const Cpu& cpu) : begin(offset_of(cpu, &cpu.w)), end(offset_of(cpu, &cpu.now) + 8) {
    for (const std::uint16_t& w : cpu.w) fields.push_back({offset_of(cpu, &w), 2});
    for (const std::uint16_t* f : {&cpu.n, &cpu.z}) fields.push_back({offset_of(cpu, f), 2});
    for (const unsigned* f : {&cpu.c, &cpu.ov, &cpu.dc}) fields.push_back({offset_of(cpu, f), 4});
    fields.push_back({offset_of(cpu, &cpu.now), 8});
  }
  /// W0 to W7 and the stack pointer: what a function that is called sees and may change.
  bool is_of_call(const Field& f) const {
    const std::uint64_t n = (f.offset - begin) / 2;
    return n <= 7 || n == 15;
  }
  bool is_clock(const Field& f) const { return &f == &fields.back(); }
  bool is_flag(const Field& f) const { return f.offset - begin >= 2 * 16 && !is_clock(f); }
  bool holds(std::uint64_t offset) const { return offset >= begin && offset < end; }
  /// `writer`: null where it is read. Returns which fields these are.
  Fields touch(std::uint64_t offset, std::uint64_t bytes, const Item* writer) {
    Fields touched = 0;
    for (Field& f : fields) {
      if (f.offset >= offset + bytes || offset >= f.offset + f.bytes) continue;
      f.is_used = true;
      if (writer) f.writers.insert(writer);
      touched |= bit(f);
    }
    return touched;
  }
  Fields bit(const Field& f) const { return Fields{1} << (&f - fields.data()); }
  std::uint64_t begin, end;
  std::vector<Field> fields;  // the clock is the last
};

}  // namespace dspic::translate
