// SPDX-License-Identifier: MIT
// What a loop that never ends counts is seen. LLVM keeps a variable in a register for as long as a loop
// takes and writes it behind the loop: of main()'s `while (1)` nobody would ever see it, no handler, no
// debugger and no test. While such a loop is looked at, its stores count as volatile; loads and all other
// passes are as ever.
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/ValueTracking.h"
#include "llvm/IR/InstIterator.h"
#include "passes.h"

namespace cc {

using namespace llvm;

static constexpr const char* kEndlessStore = "tp.endless";  // metadata: a plain store, for now volatile

PreservedAnalyses KeepEndlessStoresPass::run(Loop& loop, LoopAnalysisManager&, LoopStandardAnalysisResults&,
                                             LPMUpdater&) {
  if (!loop.hasNoExitBlocks()) return PreservedAnalyses::all();
  // inner loops come first: they have written behind themselves what they count
  for (BasicBlock* block : loop.blocks())
    for (Instruction& i : *block) {
      auto* store = dyn_cast<StoreInst>(&i);
      if (!store || store->isVolatile() || isa<AllocaInst>(getUnderlyingObject(store->getPointerOperand())))
        continue;
      store->setVolatile(true);
      store->setMetadata(kEndlessStore, MDNode::get(store->getContext(), {}));
    }
  return PreservedAnalyses::all();
}

PreservedAnalyses FreeEndlessStoresPass::run(Function& f, FunctionAnalysisManager&) {
  for (Instruction& i : instructions(f))
    if (i.getMetadata(kEndlessStore)) {
      cast<StoreInst>(i).setVolatile(false);
      i.setMetadata(kEndlessStore, nullptr);
    }
  return PreservedAnalyses::all();
}

}  // namespace cc
