// SPDX-License-Identifier: MIT
// After register allocation: a comparison with zero is dropped where the instruction that made the value has
// set N and Z as the comparison would. C and OV differ, so only branches on N and Z may follow; "less than
// zero" is N then.
#include "dspic30/llvm/machine.h"
#include "llvm/CodeGen/MachineFunctionPass.h"

namespace llvm {

namespace {

/// Sets N and Z by its whole 16-bit result.
bool sets_n_and_z(unsigned opcode) {
  switch (opcode) {
    case DSPIC::ADDrr:
    case DSPIC::ADDri:
    case DSPIC::ADDrm:
    case DSPIC::ADDi10:
    case DSPIC::SUBrr:
    case DSPIC::SUBri:
    case DSPIC::SUBrm:
    case DSPIC::SUBi10:
    case DSPIC::SUBRrr:
    case DSPIC::SUBRri:
    case DSPIC::SUBRrm:
    case DSPIC::ANDrr:
    case DSPIC::ANDri:
    case DSPIC::ANDrm:
    case DSPIC::ANDi10:
    case DSPIC::IORrr:
    case DSPIC::IORri:
    case DSPIC::IORrm:
    case DSPIC::IORi10:
    case DSPIC::XORrr:
    case DSPIC::XORri:
    case DSPIC::XORrm:
    case DSPIC::XORi10:
    case DSPIC::INCr:
    case DSPIC::DECr:
    case DSPIC::INC2r:
    case DSPIC::DEC2r:
    case DSPIC::NEGr:
    case DSPIC::COMr:
    case DSPIC::ZErr:
    case DSPIC::SErr:
    case DSPIC::ZErm:
    case DSPIC::SErm:
    case DSPIC::SHLri:
    case DSPIC::SHLrr:
    case DSPIC::LSRri:
    case DSPIC::LSRrr:
    case DSPIC::ASRri:
    case DSPIC::ASRrr:
      return true;
  }
  return false;
}

/// The instruction in the same block whose result CP0 looks at, if no flag changes in between.
MachineInstr* maker(MachineInstr& compare, const TargetRegisterInfo* tri) {
  const Register r = compare.getOperand(0).getReg();
  for (auto it = MachineBasicBlock::iterator(compare); it != compare.getParent()->begin();) {
    --it;
    if (it->modifiesRegister(r, tri)) {
      const bool makes = sets_n_and_z(it->getOpcode()) && it->getOperand(0).getReg() == r;
      return makes ? &*it : nullptr;
    }
    if (it->modifiesRegister(DSPIC::SR, tri) || it->isCall() || it->isInlineAsm()) return nullptr;
  }
  return nullptr;
}

/// Branches that ask the flags of the comparison; false if one asks more than N and Z.
bool readers(MachineInstr& compare, const TargetRegisterInfo* tri,
             SmallVectorImpl<MachineOperand*>& conditions) {
  auto& block = *compare.getParent();
  for (auto it = std::next(MachineBasicBlock::iterator(compare)); it != block.end(); ++it) {
    if (it->readsRegister(DSPIC::SR, tri)) {
      if (it->getOpcode() != DSPIC::BRAcc) return false;
      MachineOperand& condition = it->getOperand(1);
      switch (condition.getImm()) {
        case DSPICCC::Z:
        case DSPICCC::NZ:
        case DSPICCC::LT:
        case DSPICCC::GE:
          conditions.push_back(&condition);
          break;
        default:
          return false;
      }
    }
    if (it->modifiesRegister(DSPIC::SR, tri)) return true;
  }
  return true;
}

class FlagReuse : public MachineFunctionPass {
 public:
  static char ID;
  FlagReuse() : MachineFunctionPass(ID) {}
  StringRef getPassName() const override { return "dsPIC flag reuse"; }
  bool runOnMachineFunction(MachineFunction& mf) override {
    const auto* tri = mf.getSubtarget().getRegisterInfo();
    bool changed = false;
    for (auto& block : mf)
      for (MachineInstr& mi : make_early_inc_range(block)) {
        if (mi.getOpcode() != DSPIC::CP0r) continue;
        SmallVector<MachineOperand*, 2> conditions;
        if (!maker(mi, tri) || !readers(mi, tri, conditions)) continue;
        for (auto* c : conditions) {
          if (c->getImm() == DSPICCC::LT) c->setImm(DSPICCC::N);
          if (c->getImm() == DSPICCC::GE) c->setImm(DSPICCC::NN);
        }
        mi.eraseFromParent();
        changed = true;
      }
    return changed;
  }
};
char FlagReuse::ID = 0;

}  // namespace

FunctionPass* create_dspic_flag_reuse() { return new FlagReuse; }

}  // namespace llvm
