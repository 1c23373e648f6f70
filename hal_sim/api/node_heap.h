// SPDX-License-Identifier: MIT
// The heap of a program whose agendas alone take from it: what malloc() of firmware/libc/src/malloc.c finds
// on its way, for the time that takes. Nothing lies in it.
#pragma once
#include <vector>

#include "dspic30/memory/host_places.h"

namespace api {

class NodeHeap {
 public:
  /// What a search for room has met.
  struct Search {
    bool first = false;     ///< the heap was made ready
    int used = 0;           ///< blocks that were passed
    int merged = 0;         ///< free blocks that were joined to the one before
    bool split = false;     ///< the block was cut to size
    bool followed = false;  ///< it had another one behind it
    bool found = false;     ///< there was room
  };
  /// Room for the node of an agenda, which is known by `key`.
  Search take(const void* key);
  void give_back(const void* key);

 private:
  static constexpr unsigned kNode = 12, kHeader = 4, kRest = 4;  // bytes: a node's payload; see malloc.c
  static constexpr unsigned kAll = dspic::kHeapBytes;
  struct Block {
    unsigned bytes = 0;
    const void* key = nullptr;  // null: it is free
  };
  std::vector<Block> blocks_;
};

}  // namespace api
