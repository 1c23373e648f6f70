// SPDX-License-Identifier: MIT
// Which registers calls keep, which the allocator may not touch, and where objects of the stack frame lie.
#pragma once
#include "dspic30/llvm/tables.h"

namespace llvm {

class DSPICRegisterInfo : public DSPICGenRegisterInfo {
 public:
  DSPICRegisterInfo() : DSPICGenRegisterInfo(DSPIC::W0) {}
  const MCPhysReg* getCalleeSavedRegs(const MachineFunction* mf) const override;
  const uint32_t* getCallPreservedMask(const MachineFunction& mf, CallingConv::ID id) const override;
  BitVector getReservedRegs(const MachineFunction& mf) const override;
  /// Replaces "object n + offset" by W14 and an offset, or by [W14+Wx] where that is too far.
  void eliminateFrameIndex(MachineBasicBlock::iterator it, int, unsigned operand,
                           RegScavenger* scavenger) const override;
  Register getFrameRegister(const MachineFunction&) const override { return DSPIC::W14; }
  bool requiresRegisterScavenging(const MachineFunction&) const override { return true; }
  bool requiresFrameIndexScavenging(const MachineFunction&) const override { return true; }
  const TargetRegisterClass* getPointerRegClass(const MachineFunction&, unsigned) const override {
    return &DSPIC::WRegClass;
  }
};

}  // namespace llvm
