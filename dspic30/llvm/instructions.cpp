// SPDX-License-Identifier: MIT
#include "dspic30/llvm/instructions.h"

#include "llvm/CodeGen/MachineFrameInfo.h"
#include "llvm/CodeGen/MachineFunction.h"
#include "llvm/CodeGen/MachineInstrBuilder.h"

#define GET_INSTRINFO_CTOR_DTOR
#include "DSPICGenInstrInfo.inc"

namespace llvm {

void DSPICInstrInfo::copyPhysReg(MachineBasicBlock& mbb, MachineBasicBlock::iterator it,
                                 const DebugLoc& where, MCRegister to, MCRegister from, bool kill) const {
  if (DSPIC::WRegClass.contains(to, from)) {
    BuildMI(mbb, it, where, get(DSPIC::MOVrr), to).addReg(from, getKillRegState(kill));
    return;
  }
  if (!DSPIC::WPRegClass.contains(to, from)) report_fatal_error("dsPIC: a copy between unlike registers");
  for (unsigned half : {DSPIC::sub_lo, DSPIC::sub_hi})
    BuildMI(mbb, it, where, get(DSPIC::MOVrr), registers_.getSubReg(to, half))
        .addReg(registers_.getSubReg(from, half), getKillRegState(kill));
}

// --- spills. A pair is one instruction until its place is known (registers.cpp): between two, the allocator
// would put copies of what it thinks is still there.

void DSPICInstrInfo::storeRegToStackSlot(MachineBasicBlock& mbb, MachineBasicBlock::iterator it, Register r,
                                         bool kill, int object, const TargetRegisterClass* rc,
                                         const TargetRegisterInfo*) const {
  const unsigned opcode = DSPIC::WRegClass.hasSubClassEq(rc) ? DSPIC::MOVsto : DSPIC::STORE_PAIR;
  BuildMI(mbb, it, DebugLoc(), get(opcode)).addReg(r, getKillRegState(kill)).addFrameIndex(object).addImm(0);
}

void DSPICInstrInfo::loadRegFromStackSlot(MachineBasicBlock& mbb, MachineBasicBlock::iterator it, Register r,
                                          int object, const TargetRegisterClass* rc,
                                          const TargetRegisterInfo*) const {
  const unsigned opcode = DSPIC::WRegClass.hasSubClassEq(rc) ? DSPIC::MOVldo : DSPIC::LOAD_PAIR;
  BuildMI(mbb, it, DebugLoc(), get(opcode), r).addFrameIndex(object).addImm(0);
}

// --- branches: a block ends in nothing, BRA, BRA cc, or BRA cc and BRA

bool DSPICInstrInfo::analyzeBranch(MachineBasicBlock& mbb, MachineBasicBlock*& taken,
                                   MachineBasicBlock*& otherwise, SmallVectorImpl<MachineOperand>& condition,
                                   bool) const {
  constexpr bool kUnderstood = false;  // LLVM's convention
  SmallVector<MachineInstr*, 2> ends;
  for (auto it = mbb.getLastNonDebugInstr(); it != mbb.end() && isUnpredicatedTerminator(*it); --it) {
    ends.push_back(&*it);
    if (it == mbb.begin()) break;
  }
  if (ends.empty()) return kUnderstood;
  if (ends.size() > 2) return !kUnderstood;
  MachineInstr *last = ends.front(), *first = ends.back();
  const bool ends_plain = last->getOpcode() == DSPIC::BRA,
             begins_conditional = first->getOpcode() == DSPIC::BRAcc;
  if (ends.size() == 1 && ends_plain) {
    taken = last->getOperand(0).getMBB();
    return kUnderstood;
  }
  if (!begins_conditional || (ends.size() == 2 && !ends_plain)) return !kUnderstood;
  taken = first->getOperand(0).getMBB();
  condition.push_back(first->getOperand(1));
  if (ends.size() == 2) otherwise = last->getOperand(0).getMBB();
  return kUnderstood;
}

unsigned DSPICInstrInfo::removeBranch(MachineBasicBlock& mbb, int*) const {
  unsigned removed = 0;
  for (auto it = mbb.getLastNonDebugInstr(); it != mbb.end(); it = mbb.getLastNonDebugInstr()) {
    if (it->getOpcode() != DSPIC::BRA && it->getOpcode() != DSPIC::BRAcc) break;
    it->eraseFromParent();
    ++removed;
  }
  return removed;
}

unsigned DSPICInstrInfo::insertBranch(MachineBasicBlock& mbb, MachineBasicBlock* taken,
                                      MachineBasicBlock* otherwise, ArrayRef<MachineOperand> condition,
                                      const DebugLoc& where, int*) const {
  if (condition.empty()) {
    BuildMI(&mbb, where, get(DSPIC::BRA)).addMBB(taken);
    return 1;
  }
  BuildMI(&mbb, where, get(DSPIC::BRAcc)).addMBB(taken).addImm(condition[0].getImm());
  if (!otherwise) return 1;
  BuildMI(&mbb, where, get(DSPIC::BRA)).addMBB(otherwise);
  return 2;
}

bool DSPICInstrInfo::reverseBranchCondition(SmallVectorImpl<MachineOperand>& condition) const {
  constexpr int kInvert = 8;
  condition[0].setImm(condition[0].getImm() ^ kInvert);
  return false;
}

}  // namespace llvm
