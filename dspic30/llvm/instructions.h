// SPDX-License-Identifier: MIT
// What LLVM's passes ask about instructions: how to copy, spill and reload a register, and
// what a branch does.
#pragma once
#include "dspic30/llvm/registers.h"

namespace llvm {

class DSPICInstrInfo : public DSPICGenInstrInfo {
 public:
  DSPICInstrInfo() : DSPICGenInstrInfo(DSPIC::ADJDOWN, DSPIC::ADJUP) {}
  const DSPICRegisterInfo& registers() const { return registers_; }
  void copyPhysReg(MachineBasicBlock& mbb, MachineBasicBlock::iterator it, const DebugLoc& where,
                   MCRegister to, MCRegister from, bool kill) const override;
  void storeRegToStackSlot(MachineBasicBlock& mbb, MachineBasicBlock::iterator it, Register r, bool kill,
                           int object, const TargetRegisterClass* rc,
                           const TargetRegisterInfo* tri) const override;
  void loadRegFromStackSlot(MachineBasicBlock& mbb, MachineBasicBlock::iterator it, Register r, int object,
                            const TargetRegisterClass* rc, const TargetRegisterInfo* tri) const override;
  bool analyzeBranch(MachineBasicBlock& mbb, MachineBasicBlock*& taken, MachineBasicBlock*& otherwise,
                     SmallVectorImpl<MachineOperand>& condition, bool) const override;
  unsigned removeBranch(MachineBasicBlock& mbb, int*) const override;
  unsigned insertBranch(MachineBasicBlock& mbb, MachineBasicBlock* taken, MachineBasicBlock* otherwise,
                        ArrayRef<MachineOperand> condition, const DebugLoc& where, int*) const override;
  bool reverseBranchCondition(SmallVectorImpl<MachineOperand>& condition) const override;

 private:
  const DSPICRegisterInfo registers_;
};

}  // namespace llvm
