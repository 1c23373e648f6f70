// SPDX-License-Identifier: MIT
#include "hal_sim/twin/large_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace twin {

LargePages::~LargePages() {
  constexpr std::uintptr_t kPage = 2 << 20, kFew = 4;
#ifdef MADV_COLLAPSE
  constexpr int kNow = MADV_COLLAPSE;
#else
  constexpr int kNow = 25;  // of Linux 6.1, which Debian 12's headers do not name
#endif
  const std::uintptr_t first = reinterpret_cast<std::uintptr_t>(first_) & ~(kPage - 1),
                       last = reinterpret_cast<std::uintptr_t>(sbrk(0)) & ~(kPage - 1);
  if (last < first + kFew * kPage) return;
  void* const at = static_cast<char*>(first_) - (reinterpret_cast<std::uintptr_t>(first_) - first);
  madvise(at, last - first, MADV_HUGEPAGE);
  madvise(at, last - first, kNow);
}

}  // namespace twin
