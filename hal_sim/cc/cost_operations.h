// SPDX-License-Identifier: MIT
// Operations that LLVM and the chip see as one and several, or several and one.
#pragma once
#include "cost_model.h"
#include "llvm/ADT/SmallPtrSet.h"
#include "llvm/IR/InstrTypes.h"

namespace llvm {
class IntrinsicInst;
}

namespace cc {

/// What LLVM has one name for: rotations, bit reversal, sums that saturate, copies of memory.
void charge_intrinsic(const llvm::IntrinsicInst& call, Features& features, double& library);

/// Reads a register that the next call writes back: `IFS0bits.T2IF = 0` is one instruction, so no time passes
/// in between, in which the hardware might set another bit.
bool changes_register(const llvm::CallBase& read);

/// `LATAbits.LATA6 = 1` is one instruction on the register, `LATA |= mask` one with the mask in w0: the read
/// and the operation, which go to `in_place`, cost nothing of their own. Writes with a constant go to
/// `needs_constant`.
void merge_register_changes(llvm::Function& function,
                            llvm::SmallPtrSetImpl<const llvm::Instruction*>& in_place,
                            llvm::SmallPtrSetImpl<const llvm::Instruction*>& needs_constant);

}  // namespace cc
