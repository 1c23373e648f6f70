// SPDX-License-Identifier: MIT
// --sanitize: what an image that was built to be checked (dspic30/memory/host_places.h) does to its
// memory, in a person's words. The checker sees addresses (dspic30/core/memory_check.h); here variables
// have names: those of the symbol table, local ones as the program tells them, blocks of the heap from
// malloc() and free().
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "dspic30/core/memory_check.h"
#include "dspic30/core/processor.h"
#include "hal_sim/chip/program_places.h"

namespace chip {

class MemoryReports final : private dspic::MemoryFindings {
 public:
  /// Was the image built to be checked?
  static bool is_for(const dspic::FirmwareFile& file);
  /// `tell`: told each finding, with the program address that it belongs to.
  MemoryReports(const dspic::FirmwareFile& file, const dspic::Processor& processor,
                const ProgramPlaces& places,
                std::function<void(const std::string& message, unsigned place)> tell);

  dspic::MemoryCheck& check() { return check_; }
  /// Functions that are to be heard of, in order.
  std::vector<std::uint32_t> addresses() const;
  /// Has to be told where one of them begins; false: it is none of these.
  bool entered(unsigned address);
  /// A reset, or the program begins anew.
  void restart();

 private:
  enum class Function : std::uint8_t { Main, Local, Malloc, Calloc, Realloc, Free, FailedCheck };
  struct Entry {
    Function function;
    const char* message = "";
  };
  struct Object {
    unsigned begin = 0, bytes = 0;
    std::string name;
  };
  struct Block {
    unsigned bytes = 0;
    bool is_free = false;
  };
  void found(const dspic::MemoryFinding& finding) override;
  void returned(std::uint16_t w0) override;
  void stack_fell(unsigned top) override;
  void find_gaps();
  void note_local();
  void allocate(unsigned at, unsigned bytes, bool is_written);
  void free_block(unsigned at);
  bool is_told(const dspic::MemoryFinding& finding, unsigned place);
  const Object* owner(unsigned address, unsigned bytes, std::string& name, Object& block) const;
  std::string owner(unsigned address, unsigned bytes) const;
  std::string local_by_frame(unsigned address, unsigned pc) const;
  std::string what(const dspic::MemoryFinding& finding) const;
  bool is_heap(unsigned address) const { return address >= heap_begin_ && address < heap_end_; }

  const dspic::FirmwareFile& file_;
  const dspic::Processor& processor_;
  const ProgramPlaces& places_;
  std::function<void(const std::string&, unsigned)> tell_;
  dspic::MemoryCheck check_;
  std::map<std::uint32_t, Entry> entries_;
  std::vector<Object> globals_;                      // by address
  std::vector<std::pair<unsigned, unsigned>> gaps_;  // RAM that is nobody's, for a stack up to ...
  unsigned gaps_limit_ = 0;
  std::vector<Object> locals_;      // alive, the innermost last
  std::map<unsigned, Block> heap_;  // by address
  unsigned heap_begin_ = 0, heap_end_ = 0, stack_begin_ = 0;
  Function asked_ = Function::Malloc;  // of the heap, under way
  unsigned asked_bytes_ = 0, asked_block_ = 0;
  struct Told {
    std::set<unsigned> objects;
    int looked_at = 0;
  };
  std::map<std::pair<unsigned, int>, Told> told_;  // by place and kind
};

}  // namespace chip
