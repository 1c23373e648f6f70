// SPDX-License-Identifier: MIT
// Large swarms in large pages of the PC's memory: the processor finds their addresses without looking into
// the tables of pages at nearly each robot's turn.
#pragma once
#include <unistd.h>

namespace twin {

/// What the heap grows by while it lives is asked to lie in large pages from its end on, if that is a few
/// of them. A wish only: where the kernel knows no such pages, nothing becomes of it.
class LargePages {
 public:
  LargePages() : first_(sbrk(0)) {}
  ~LargePages();
  LargePages(const LargePages&) = delete;
  LargePages& operator=(const LargePages&) = delete;

 private:
  void* first_;  // the heap's end then
};

}  // namespace twin
