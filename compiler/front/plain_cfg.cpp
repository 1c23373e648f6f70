// SPDX-License-Identifier: MIT
// Blocks tidied as gcc 4.5 -O1 does: dead ones go, chains are joined, jumps to jumps are cut short. No branch
// becomes a select and no comparison is merged with another, for the chip's code has those branches.
#include "llvm/ADT/SmallPtrSet.h"
#include "llvm/Analysis/CFG.h"
#include "llvm/IR/CFG.h"
#include "llvm/IR/Dominators.h"
#include "llvm/Transforms/Utils/BasicBlockUtils.h"
#include "llvm/Transforms/Utils/Local.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

/// Targets of back edges: joining their preheaders with them would only be undone by the loop passes.
SmallPtrSet<BasicBlock*, 8> loop_headers(Function& f) {
  SmallVector<std::pair<const BasicBlock*, const BasicBlock*>, 8> edges;
  FindFunctionBackedges(f, edges);
  SmallPtrSet<BasicBlock*, 8> headers;
  for (auto& edge : edges) headers.insert(const_cast<BasicBlock*>(edge.second));
  return headers;
}

/// while (a && b): where a alone decides, go straight to where its answer leads.
bool thread_known_conditions(Function& f) {
  bool changed = false;
  for (BasicBlock& block : f) {
    auto* br = dyn_cast<BranchInst>(block.getTerminator());
    auto* phi = br && br->isConditional() ? dyn_cast<PHINode>(br->getCondition()) : nullptr;
    if (!phi || phi->getParent() != &block || !phi->hasOneUse() || phi != &*block.phis().begin() ||
        block.getFirstNonPHIOrDbg() != br || std::next(block.phis().begin()) != block.phis().end())
      continue;
    if (br->getSuccessor(0) == &block || br->getSuccessor(1) == &block) continue;
    SmallVector<std::pair<BasicBlock*, BasicBlock*>, 4> moves;
    for (unsigned n = 0; n < phi->getNumIncomingValues(); ++n)
      if (auto* known = dyn_cast<ConstantInt>(phi->getIncomingValue(n))) {
        BasicBlock* to = br->getSuccessor(known->isZero() ? 1 : 0);
        auto* from = dyn_cast<BranchInst>(phi->getIncomingBlock(n)->getTerminator());
        if (from && !is_contained(successors(phi->getIncomingBlock(n)), to))
          moves.emplace_back(phi->getIncomingBlock(n), to);
      }
    for (auto& [from, to] : moves) {
      for (PHINode& joined : to->phis()) joined.addIncoming(joined.getIncomingValueForBlock(&block), from);
      from->getTerminator()->replaceSuccessorWith(&block, to);
      block.removePredecessor(from, /*KeepOneInputPHIs=*/true);
      changed = true;
    }
  }
  return changed;
}

bool tidy_once(Function& f) {
  bool changed = removeUnreachableBlocks(f);
  changed |= thread_known_conditions(f);
  for (BasicBlock& block : f) changed |= ConstantFoldTerminator(&block, /*DeleteDeadConditions=*/true);
  for (BasicBlock& block : make_early_inc_range(f)) changed |= MergeBlockIntoPredecessor(&block);
  auto headers = loop_headers(f);
  for (BasicBlock& block : make_early_inc_range(f)) {
    auto* br = dyn_cast<BranchInst>(block.getTerminator());
    if (!br || !br->isUnconditional() || &block == &f.getEntryBlock() || headers.count(&block)) continue;
    if (headers.count(br->getSuccessor(0)) || &*block.getFirstNonPHIOrDbg() != br) continue;
    changed |= TryToSimplifyUncondBranchFromEmptyBlock(&block);
  }
  return changed;
}

}  // namespace

PreservedAnalyses PlainCfgPass::run(Function& f, FunctionAnalysisManager&) {
  bool changed = false;
  for (int round = 0; round < 20 && tidy_once(f); ++round) changed = true;
  return changed ? PreservedAnalyses::none() : PreservedAnalyses::all();
}

}  // namespace cc
