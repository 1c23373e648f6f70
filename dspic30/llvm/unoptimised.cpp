// SPDX-License-Identifier: MIT
// -O0, after the frame is laid out, as XC16 has it there: a loop asks at its end whether it goes on, and what
// lies where W14 points is counted in place.
#include "dspic30/llvm/machine.h"
#include "llvm/CodeGen/MachineFunctionPass.h"
#include "llvm/CodeGen/MachineInstrBuilder.h"
#include "llvm/CodeGen/TargetInstrInfo.h"

namespace llvm {

namespace {

class Unoptimised : public MachineFunctionPass {
 public:
  static char ID;
  Unoptimised() : MachineFunctionPass(ID) {}
  StringRef getPassName() const override { return "dsPIC loops and counters without optimiser"; }
  bool runOnMachineFunction(MachineFunction& mf) override {
    instructions_ = mf.getSubtarget().getInstrInfo();
    bool changed = false;
    for (auto& block : mf) changed |= count_in_place(block);
    SmallVector<MachineBasicBlock*, 16> blocks;
    for (auto& block : mf) blocks.push_back(&block);
    for (auto* block : blocks) changed |= ask_at_end(*block);
    return changed;
  }

 private:
  /// `latch` ends in a jump back to a block that asks: that block comes behind it instead.
  bool ask_at_end(MachineBasicBlock& latch) {
    // Is this a loop whose header asks, and whose latch jumps back?
    MachineBasicBlock *taken = nullptr, *otherwise = nullptr;
    SmallVector<MachineOperand, 2> condition;
    if (instructions_->analyzeBranch(latch, taken, otherwise, condition, false)) return false;
    if (!taken || !condition.empty() || taken == &latch || taken->getNumber() == 0) return false;
    MachineBasicBlock& header = *taken;
    MachineBasicBlock* body = &*std::next(header.getIterator());
    if (&header == &*header.getParent()->begin() || header.succ_size() != 2 || header.hasAddressTaken())
      return false;
    // it stands before the loop, falls into its body and leaves by its branch
    MachineBasicBlock *leave = nullptr, *none = nullptr;
    if (instructions_->analyzeBranch(header, leave, none, condition, false) || condition.empty() || none)
      return false;
    bool is_before = false;
    for (auto it = header.getIterator(); it != header.getParent()->end(); ++it) is_before |= &*it == &latch;
    if (!is_before || leave == body || !header.isSuccessor(body)) return false;
    // What stands above the header and below the latch must stand the move.
    MachineBasicBlock& above = *std::prev(header.getIterator());
    MachineBasicBlock* below =
        &*latch.getIterator() == &header.getParent()->back() ? nullptr : &*std::next(latch.getIterator());
    if (!below) return false;
    const bool falls_in = above.isSuccessor(&header) && above.canFallThrough() && &above != &latch;
    MachineBasicBlock *above_taken = nullptr, *above_other = nullptr;
    SmallVector<MachineOperand, 2> above_condition;
    if (falls_in && instructions_->analyzeBranch(above, above_taken, above_other, above_condition, false))
      return false;
    if (falls_in && above_taken && above_other) return false;
    const DebugLoc where = header.findBranchDebugLoc(), where_above = above.findBranchDebugLoc();
    header.moveAfter(&latch);
    // into the header from above by a jump, from the latch without one
    if (falls_in) {
      instructions_->removeBranch(above);
      instructions_->insertBranch(above, above_taken ? above_taken : &header, above_taken ? &header : nullptr,
                                  above_condition, where_above);
    }
    instructions_->removeBranch(latch);
    instructions_->removeBranch(header);
    instructions_->reverseBranchCondition(condition);
    instructions_->insertBranch(header, body, leave == below ? nullptr : leave, condition, where);
    return true;
  }

  /// mov [w14], w0; inc w0, w0; mov w0, [w14] is inc [w14], [w14].
  bool count_in_place(MachineBasicBlock& block) {
    bool changed = false;
    for (auto it = block.begin(); it != block.end();) {
      MachineInstr& load = *it++;
      const bool by_words = load.getOpcode() == DSPIC::MOVldo;
      if (!by_words && load.getOpcode() != DSPIC::MOVBldo) continue;
      // A load, INC or DEC, and a store, one behind the other.
      const auto sum = skipDebugInstructionsForward(it, block.end());
      if (sum == block.end()) break;
      const auto store = next_nodbg(sum, block.end());
      if (store == block.end()) break;
      const bool is_up = sum->getOpcode() == DSPIC::INCr;
      if (!is_up && sum->getOpcode() != DSPIC::DECr) continue;
      if (store->getOpcode() != (by_words ? DSPIC::MOVsto : DSPIC::MOVBsto)) continue;
      // Load and store are of the frame's first word, and nobody needs the register.
      const auto is_first = [](const MachineInstr& mi) {
        return mi.getOperand(1).isReg() && mi.getOperand(1).getReg() == DSPIC::W14 &&
               mi.getOperand(2).isImm() && mi.getOperand(2).getImm() == 0 && !mi.hasOrderedMemoryRef();
      };
      if (!is_first(load) || !is_first(*store) ||
          sum->getOperand(1).getReg() != load.getOperand(0).getReg() ||
          store->getOperand(0).getReg() != sum->getOperand(0).getReg() || !store->getOperand(0).isKill() ||
          sum->getOperand(0).getReg() != sum->getOperand(1).getReg())
        continue;
      const unsigned opcode =
          by_words ? (is_up ? DSPIC::INCmm : DSPIC::DECmm) : (is_up ? DSPIC::INCBmm : DSPIC::DECBmm);
      BuildMI(block, load, sum->getDebugLoc(), instructions_->get(opcode)).addReg(DSPIC::W14);
      it = std::next(store);
      load.eraseFromParent();
      sum->eraseFromParent();
      store->eraseFromParent();
      changed = true;
    }
    return changed;
  }

  const TargetInstrInfo* instructions_ = nullptr;
};
char Unoptimised::ID = 0;

}  // namespace

FunctionPass* create_dspic_unoptimised() { return new Unoptimised; }

}  // namespace llvm
