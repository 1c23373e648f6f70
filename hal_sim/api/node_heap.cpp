// SPDX-License-Identifier: MIT
#include "hal_sim/api/node_heap.h"

#include <cstddef>

namespace api {

NodeHeap::Search NodeHeap::take(const void* key) {
  Search search;
  if (blocks_.empty()) {
    search.first = true;
    blocks_.push_back({kAll - kHeader, nullptr});
  }
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    if (blocks_[i].key) {
      ++search.used;
      continue;
    }
    // free neighbours become one; all are of nodes, so any is large enough
    while (i + 1 < blocks_.size() && !blocks_[i + 1].key) {
      blocks_[i].bytes += blocks_[i + 1].bytes + kHeader;
      blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      ++search.merged;
    }
    if (blocks_[i].bytes < kNode) continue;
    search.found = true;
    search.followed = i + 1 < blocks_.size();
    if (blocks_[i].bytes >= kNode + kHeader + kRest) {
      search.split = true;
      const unsigned rest = blocks_[i].bytes - kNode - kHeader;
      blocks_[i].bytes = kNode;
      blocks_.insert(blocks_.begin() + static_cast<std::ptrdiff_t>(i) + 1, {rest, nullptr});
    }
    blocks_[i].key = key;
    break;
  }
  return search;
}

void NodeHeap::give_back(const void* key) {
  for (Block& block : blocks_)
    if (block.key == key) block.key = nullptr;
}

}  // namespace api
