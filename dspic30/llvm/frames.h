// SPDX-License-Identifier: MIT
// The stack frame, which grows upwards:
//
//     arguments that found no register, the first nearest to the return address
//     return address (4 bytes)
//     W14 of the caller         <- LNK pushes it
//     locals and spills         <- W14
//     kept registers, PUSHed
//     arguments of calls        <- W15
#pragma once
#include "llvm/CodeGen/TargetFrameLowering.h"

namespace llvm {

/// LNK pushes W14 before it sets it; objects are counted from before that.
inline constexpr int kSavedFrame = 2;

class DSPICFrameLowering : public TargetFrameLowering {
 public:
  // objects are counted from W15 at entry; W14 is pushed there first, so locals begin 2 above. W15 is even and
  // no more: what asks for a wider alignment gets none.
  DSPICFrameLowering()
      : TargetFrameLowering(StackGrowsUp, Align(2), kSavedFrame, Align(1), /*StackReal=*/false) {}
  /// Of an object, from W14 on, for passes and the debugger.
  StackOffset getFrameIndexReference(const MachineFunction& mf, int object, Register& base) const override;
  bool hasFP(const MachineFunction& mf) const override;
  bool canSimplifyCallFramePseudos(const MachineFunction&) const override { return true; }
  bool hasReservedCallFrame(const MachineFunction&) const override { return false; }
  void emitPrologue(MachineFunction& mf, MachineBasicBlock& mbb) const override;
  void emitEpilogue(MachineFunction& mf, MachineBasicBlock& mbb) const override;
  /// PUSH finds its place by itself.
  bool assignCalleeSavedSpillSlots(MachineFunction&, const TargetRegisterInfo*,
                                   std::vector<CalleeSavedInfo>&) const override {
    return true;
  }
  bool spillCalleeSavedRegisters(MachineBasicBlock& mbb, MachineBasicBlock::iterator it,
                                 ArrayRef<CalleeSavedInfo> saved, const TargetRegisterInfo*) const override;
  bool restoreCalleeSavedRegisters(MachineBasicBlock& mbb, MachineBasicBlock::iterator it,
                                   MutableArrayRef<CalleeSavedInfo> saved,
                                   const TargetRegisterInfo*) const override;
  MachineBasicBlock::iterator eliminateCallFramePseudoInstr(MachineFunction& mf, MachineBasicBlock& mbb,
                                                            MachineBasicBlock::iterator it) const override;
  void determineCalleeSaves(MachineFunction& mf, BitVector& saved, RegScavenger* scavenger) const override;
  void processFunctionBeforeFrameFinalized(MachineFunction& mf, RegScavenger* scavenger) const override;
};

}  // namespace llvm
