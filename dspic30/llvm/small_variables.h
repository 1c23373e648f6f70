// SPDX-License-Identifier: MIT
#pragma once

namespace llvm {
class GlobalVariable;
namespace dspic_elf {

/// A variable without a section of its own is near if it is small.
bool is_small(const GlobalVariable& v);

}  // namespace dspic_elf
}  // namespace llvm
