// SPDX-License-Identifier: MIT
#include "dspic30/llvm/registers.h"

#include "dspic30/llvm/frames.h"
#include "dspic30/llvm/interrupts.h"
#include "llvm/CodeGen/MachineFrameInfo.h"
#include "llvm/CodeGen/MachineFunction.h"
#include "llvm/CodeGen/MachineInstrBuilder.h"
#include "llvm/CodeGen/MachineRegisterInfo.h"
#include "llvm/CodeGen/TargetFrameLowering.h"

#define GET_REGINFO_TARGET_DESC
#include "DSPICGenRegisterInfo.inc"

namespace llvm {

const MCPhysReg* DSPICRegisterInfo::getCalleeSavedRegs(const MachineFunction* mf) const {
  if (!mf || !is_interrupt(mf->getFunction())) return CSR_SaveList;
  return has_shadow(mf->getFunction()) ? CSR_Shadow_SaveList : CSR_Interrupt_SaveList;
}

const uint32_t* DSPICRegisterInfo::getCallPreservedMask(const MachineFunction&, CallingConv::ID) const {
  return CSR_RegMask;
}

BitVector DSPICRegisterInfo::getReservedRegs(const MachineFunction&) const {
  BitVector reserved(getNumRegs());
  for (unsigned r : {DSPIC::W14, DSPIC::W15, DSPIC::SR}) reserved.set(r);
  return reserved;
}

namespace {

/// The form of a load or store that takes its offset from a register.
unsigned indexed_form(unsigned opcode) {
  switch (opcode) {
    case DSPIC::MOVldo:
      return DSPIC::MOVldx;
    case DSPIC::MOVsto:
      return DSPIC::MOVstx;
    case DSPIC::MOVBldo:
      return DSPIC::MOVBldx;
    case DSPIC::MOVBsto:
      return DSPIC::MOVBstx;
  }
  report_fatal_error("dsPIC: a frame object is used by an instruction without an offset");
}

/// Spill of a pair as two of its words.
void split_pair(MachineInstr& mi, const DSPICRegisterInfo& registers) {
  auto& mbb = *mi.getParent();
  const auto& instructions = *mbb.getParent()->getSubtarget().getInstrInfo();
  const bool loads = mi.getOpcode() == DSPIC::LOAD_PAIR;
  const MachineOperand& pair = mi.getOperand(0);
  const int64_t offset = mi.getOperand(2).getImm();
  for (unsigned half : {DSPIC::sub_lo, DSPIC::sub_hi})
    BuildMI(mbb, mi, mi.getDebugLoc(), instructions.get(loads ? DSPIC::MOVldo : DSPIC::MOVsto))
        .addReg(registers.getSubReg(pair.getReg(), half),
                loads ? unsigned(RegState::Define) : getKillRegState(pair.isKill()))
        .addFrameIndex(mi.getOperand(1).getIndex())
        .addImm(offset + (half == DSPIC::sub_hi ? 2 : 0));
  mi.eraseFromParent();
}

}  // namespace

void DSPICRegisterInfo::eliminateFrameIndex(MachineBasicBlock::iterator it, int, unsigned operand,
                                            RegScavenger*) const {
  MachineInstr& mi = *it;
  auto& mbb = *mi.getParent();
  auto& mf = *mbb.getParent();
  const auto& instructions = *mf.getSubtarget().getInstrInfo();
  const DebugLoc where = mi.getDebugLoc();
  MachineOperand &base = mi.getOperand(operand), &offset = mi.getOperand(operand + 1);
  if (mi.getOpcode() == DSPIC::LOAD_PAIR || mi.getOpcode() == DSPIC::STORE_PAIR) {
    split_pair(mi, *this);  // its halves come here next
    return;
  }
  const int k = mf.getFrameInfo().getObjectOffset(base.getIndex()) - kSavedFrame + offset.getImm();

  if (mi.getOpcode() == DSPIC::LEA) {
    const Register d = mi.getOperand(0).getReg();
    if (std::abs(k) < 32) {
      BuildMI(mbb, it, where, instructions.get(k < 0 ? DSPIC::SUBri : DSPIC::ADDri), d)
          .addReg(DSPIC::W14)
          .addImm(std::abs(k));
    } else {
      BuildMI(mbb, it, where, instructions.get(DSPIC::MOVi), d).addImm(k & 0xFFFF);
      BuildMI(mbb, it, where, instructions.get(DSPIC::ADDrr), d).addReg(DSPIC::W14).addReg(d);
    }
    mi.eraseFromParent();
    return;
  }
  const bool byte = mi.getOpcode() == DSPIC::MOVBldo || mi.getOpcode() == DSPIC::MOVBsto;
  if (mi.isInlineAsm() || mi.isDebugValue() || (byte ? isInt<10>(k) : isInt<11>(k) && !(k & 1))) {
    base.ChangeToRegister(DSPIC::W14, false);
    offset.ChangeToImmediate(k);
    return;
  }
  // a far object: MOV and [W14+Wx] leave the flags alone, as an addition would not
  const Register x = mf.getRegInfo().createVirtualRegister(&DSPIC::WRegClass);
  BuildMI(mbb, it, where, instructions.get(DSPIC::MOVi), x).addImm(k & 0xFFFF);
  mi.setDesc(instructions.get(indexed_form(mi.getOpcode())));
  base.ChangeToRegister(DSPIC::W14, false);
  offset.ChangeToRegister(x, false, false, true);
}

}  // namespace llvm
