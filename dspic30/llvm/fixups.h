// SPDX-License-Identifier: MIT
// Places in an instruction that the linker fills, as the code generator counts them.
#pragma once
#include "dspic30/link/relocations.h"
#include "llvm/MC/MCFixup.h"

namespace llvm {

/// Fixups of the code generator, in the order of kFixups.
namespace DSPICFix {
enum Kind : unsigned {
  NearByte = FirstTargetFixupKind,
  Near,
  File,
  FileOfMove,
  Literal16,
  PsvOffset,
  PsvPage,
  TableOffset,
  TablePage,
  Branch,
  DoEnd,
  CallLow,
  CallHigh,
  End
};
}

static_assert(sizeof kFixups / sizeof kFixups[0] == DSPICFix::End - FirstTargetFixupKind, "one row a kind");

}  // namespace llvm
