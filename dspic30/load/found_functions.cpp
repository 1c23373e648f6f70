// SPDX-License-Identifier: MIT
// Functions of an image that names none, as HEX files: what a reset, the vectors and calls lead to.
#include <cstdio>
#include <set>

#include "dspic30/core/instruction_table.h"
#include "dspic30/load/firmware_file.h"
#include "dspic30/memory/program_memory.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

namespace {

constexpr std::uint32_t kVectorTable = 0x04;
constexpr int kSharedByMany = 3;  // vectors: it is the default handler

std::uint32_t word_at(const FirmwareFile& file, std::uint32_t address) {
  const auto word = file.words.find(address);
  return word == file.words.end() ? kErasedWord : word->second;
}

std::optional<std::uint32_t> destination(const FirmwareFile& file, std::uint32_t address, const Row& row) {
  return destination(row, word_at(file, address), word_at(file, address + 2), address);
}

}  // namespace

void find_functions(FirmwareFile& file) {
  std::map<std::uint32_t, std::string> found;
  std::map<std::uint32_t, int> vectors;
  const auto add = [&](std::uint32_t address, const std::string& name) {
    if (address > 0 && address < kFlashEnd && file.words.count(address)) found.emplace(address, name);
  };
  // Where the vectors lead, by their names; one that many share is the default handler.
  for (int v = 1; v < kVectors; ++v)
    ++vectors[word_at(file, kVectorTable + 2 * static_cast<std::uint32_t>(v))];
  if (const Row* first = find_row(word_at(file, 0)))
    if (const auto start = destination(file, 0, *first)) add(*start, "_reset");
  for (int v = 1; v < kVectors; ++v) {
    const std::uint32_t to = word_at(file, kVectorTable + 2 * static_cast<std::uint32_t>(v));
    const std::string name = std::string("_") + vector_name(v) + (v < kFirstIrqVector ? "" : "Interrupt");
    if (to != kErasedWord) add(to, vectors[to] >= kSharedByMany ? "_DefaultInterrupt" : name);
  }
  const auto add_unnamed = [&](std::uint32_t address) {
    char name[16];
    std::snprintf(name, sizeof name, "sub_%06x", address);
    add(address, name);
  };
  // What is called is a function without a name; what only branches reach is none.
  std::set<std::uint32_t> inside;  // what branches lead to
  for (const auto& [address, word] : file.words) {
    const Row* row = address < kFlashEnd ? find_row(word) : nullptr;
    if (!row) continue;
    const auto to = destination(file, address, *row);
    if (!to || row->id == Insn::Goto_Expr) continue;  // GOTO may stay within one
    if (row->has(Operand::Branch) && row->id != Insn::Rcall_Expr)
      inside.insert(*to);
    else
      add_unnamed(*to);
  }
  // what no branch leads to, behind a return or a jump, is called through a pointer; a table of jumps is not
  for (const auto& [address, word] : file.words) {
    const Row* row = address < kFlashEnd ? find_row(word) : nullptr;
    const bool ends = row && (row->id == Insn::Return || row->id == Insn::Retfie ||
                              row->id == Insn::Retlw_lit10_Wn || row->id == Insn::Bra_Expr);
    const Row* next = ends && !inside.count(address + 2) ? find_row(word_at(file, address + 2)) : nullptr;
    if (next && next->id != Insn::Bra_Expr && next->id != Insn::Goto_Expr) add_unnamed(address + 2);
  }
  // Each ends where the next one begins, or where code does.
  for (auto at = found.begin(); at != found.end(); ++at) {
    std::uint32_t end = at->first;
    const auto next = std::next(at);
    while (file.words.count(end) && (next == found.end() || end < next->first)) end += 2;
    file.code.functions.push_back({at->first, end, at->second});
    file.functions.emplace(at->second, at->first);
  }
}

}  // namespace dspic
