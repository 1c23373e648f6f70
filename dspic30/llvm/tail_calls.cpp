// SPDX-License-Identifier: MIT
// After the frame is laid out: a call right before the return is a jump, and the callee returns for both.
#include "dspic30/llvm/machine.h"
#include "llvm/CodeGen/MachineFunctionPass.h"
#include "llvm/CodeGen/MachineInstrBuilder.h"

namespace llvm {

namespace {

class TailCalls : public MachineFunctionPass {
 public:
  static char ID;
  TailCalls() : MachineFunctionPass(ID) {}
  StringRef getPassName() const override { return "dsPIC tail calls"; }
  bool runOnMachineFunction(MachineFunction& mf) override {
    const auto& instructions = *mf.getSubtarget().getInstrInfo();
    bool changed = false;
    for (auto& block : mf) {
      const auto last = block.getLastNonDebugInstr();
      if (last == block.end() || last->getOpcode() != DSPIC::RETURN || last == block.begin()) continue;
      const auto call = prev_nodbg(last, block.begin());
      const bool is_direct = call->getOpcode() == DSPIC::RCALL;
      if (!is_direct && call->getOpcode() != DSPIC::CALLW) continue;
      BuildMI(block, call, call->getDebugLoc(),
              instructions.get(is_direct ? DSPIC::BRAtail : DSPIC::GOTOtail))
          .add(call->getOperand(0));
      call->eraseFromParent();
      last->eraseFromParent();
      changed = true;
    }
    return changed;
  }
};
char TailCalls::ID = 0;

}  // namespace

FunctionPass* create_dspic_tail_calls() { return new TailCalls; }

}  // namespace llvm
