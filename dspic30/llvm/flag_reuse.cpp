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

// --- longs: SUB and SUBB leave Z set if both words of the result are 0, as CP0 and CPB #0 would

bool sets_z_of_long(unsigned opcode) {
  switch (opcode) {
    case DSPIC::ADDCrr:
    case DSPIC::ADDCri:
    case DSPIC::ADDCi10:
    case DSPIC::SUBBrr:
    case DSPIC::SUBBri:
    case DSPIC::SUBBi10:
      return true;
  }
  return false;
}

/// low = ..; high = .. with carry; what does not touch them; CP0 low; CPB high, #0; BRA Z or NZ. Both stand
/// before the branch then, and the comparison goes. Before blocks are merged: the comparison of the counter
/// before a loop and the one at its end would become one, in front.
class LongFlagReuse : public MachineFunctionPass {
 public:
  static char ID;
  LongFlagReuse() : MachineFunctionPass(ID) {}
  StringRef getPassName() const override { return "dsPIC flag reuse of longs"; }
  bool runOnMachineFunction(MachineFunction& mf) override {
    tri_ = mf.getSubtarget().getRegisterInfo();
    bool changed = false;
    for (auto& block : mf) {
      Instructions all;
      for (MachineInstr& mi : block)
        if (!mi.isDebugInstr()) all.push_back(&mi);
      for (size_t i = 1; i < all.size(); ++i)
        if (all[i]->getOpcode() == DSPIC::CPBri && reuse(all, i)) {
          changed = true;
          break;  // a block has one such end
        }
    }
    return changed;
  }

 private:
  using Instructions = SmallVector<MachineInstr*, 32>;

  static Register result_of(const MachineInstr* mi) { return mi->getOperand(0).getReg(); }

  bool reuse(const Instructions& all, size_t at) {
    MachineInstr *compare_high = all[at], *compare_low = all[at - 1];
    const MachineOperand& with = compare_high->getOperand(1);
    if (compare_low->getOpcode() != DSPIC::CP0r || !with.isImm() || with.getImm() || !asks_z(*compare_high))
      return false;
    const Register low_word = result_of(compare_low), high_word = result_of(compare_high);
    size_t h = at - 1;
    while (h > 0 && !all[h - 1]->modifiesRegister(high_word, tri_)) --h;
    if (h < 2) return false;
    MachineInstr *high = all[h - 1], *low = all[h - 2];
    if (!sets_z_of_long(high->getOpcode()) || !sets_n_and_z(low->getOpcode()) || low->mayLoad() ||
        result_of(high) != high_word || result_of(low) != low_word || low_word == high_word)
      return false;
    for (size_t i = h; i < at - 1; ++i)
      if (touches(*all[i], *low) || touches(*all[i], *high)) return false;
    for (size_t i = h; i < at - 1; ++i) {  // nobody between asks for their flags
      if (all[i]->readsRegister(DSPIC::SR, tri_)) return false;
      if (all[i]->modifiesRegister(DSPIC::SR, tri_)) break;
    }
    for (size_t i = h; i < at - 1; ++i)  // what was read there last is read again behind
      for (const MachineInstr* moved : {low, high})
        for (const MachineOperand& o : moved->operands())
          if (o.isReg() && o.getReg()) all[i]->clearRegisterKills(o.getReg(), tri_);
    low->moveBefore(compare_low);
    high->moveBefore(compare_low);
    compare_low->eraseFromParent();
    compare_high->eraseFromParent();
    return true;
  }
  /// Would it matter which of the two comes first? Flags aside.
  bool touches(const MachineInstr& other, const MachineInstr& moved) const {
    for (const MachineOperand& o : moved.operands()) {
      if (!o.isReg() || !o.getReg() || o.getReg() == DSPIC::SR) continue;
      if (other.modifiesRegister(o.getReg(), tri_) || (o.isDef() && other.readsRegister(o.getReg(), tri_)))
        return true;
    }
    return false;
  }
  bool asks_z(MachineInstr& compare) const {
    SmallVector<MachineOperand*, 2> conditions;
    return readers(compare, tri_, conditions) && all_of(conditions, [](const MachineOperand* c) {
             return c->getImm() == DSPICCC::Z || c->getImm() == DSPICCC::NZ;
           });
  }
  const TargetRegisterInfo* tri_ = nullptr;
};
char LongFlagReuse::ID = 0;

}  // namespace

FunctionPass* create_dspic_flag_reuse() { return new FlagReuse; }
FunctionPass* create_dspic_long_flag_reuse() { return new LongFlagReuse; }

}  // namespace llvm
