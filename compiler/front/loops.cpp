// SPDX-License-Identifier: MIT
// Loops that a long counts. LLVM makes counters of the machine's own width count down to 0, where the
// subtraction has set the flags already, but leaves wider ones as they are: 8 cycles for an empty round, and
// with this 4. What else reads the low word of the counter, an index above all, gets a counter of 16 bits of
// its own, which LLVM then makes a pointer of.
#include "chip.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/ScalarEvolution.h"
#include "llvm/Analysis/ScalarEvolutionExpressions.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/Transforms/Utils/Local.h"
#include "llvm/Transforms/Utils/ScalarEvolutionExpander.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

/// A long that a loop adds a constant to in each round, and that decides whether there is another.
struct LongCounter {
  PHINode* value;
  BinaryOperator* next;
  ICmpInst* test;
  BranchInst* branch;
  SmallVector<TruncInst*, 4> low_words;  // its other readers
};

/// False: somebody needs all of it.
bool note_readers(Value* counter, LongCounter& c) {
  for (User* u : counter->users()) {
    if (u == c.value || u == c.next || u == c.test) continue;
    auto* low = dyn_cast<TruncInst>(u);
    if (!low || !low->getType()->isIntegerTy(16)) return false;
    c.low_words.push_back(low);
  }
  return true;
}

bool find_counter(Loop& loop, LongCounter& c) {
  BasicBlock* latch = loop.getLoopLatch();
  if (!latch || !loop.getLoopPreheader()) return false;
  c.branch = dyn_cast<BranchInst>(latch->getTerminator());
  if (!c.branch || !c.branch->isConditional()) return false;
  c.test = dyn_cast<ICmpInst>(c.branch->getCondition());
  if (!c.test || !c.test->hasOneUse()) return false;
  for (PHINode& phi : loop.getHeader()->phis()) {
    if (!phi.getType()->isIntegerTy(32)) continue;
    c.value = &phi;
    c.next = dyn_cast<BinaryOperator>(phi.getIncomingValueForBlock(latch));
    if (!c.next || c.next->getOpcode() != Instruction::Add || c.next->getOperand(0) != &phi ||
        !isa<ConstantInt>(c.next->getOperand(1)))
      continue;
    if (!is_contained(c.test->operands(), c.next) && !is_contained(c.test->operands(), &phi)) continue;
    c.low_words.clear();
    return note_readers(&phi, c) && note_readers(c.next, c);
  }
  return false;
}

/// A product, a quotient or a choice would cost more than it saves in a short loop.
bool is_cheap(const SCEV* s) {
  return !SCEVExprContains(s, [](const SCEV* part) {
    return isa<SCEVUDivExpr>(part) || isa<SCEVMinMaxExpr>(part) || isa<SCEVMulExpr>(part) ||
           isa<SCEVAddRecExpr>(part);
  });
}

/// The larger of two where it is known before the loop which one that is: `n` of 1 and n behind `if (n > 0)`.
class KnownChoice : public SCEVRewriteVisitor<KnownChoice> {
 public:
  KnownChoice(Loop& loop, ScalarEvolution& evolution) : SCEVRewriteVisitor(evolution), loop_(loop) {}
  const SCEV* visitSMaxExpr(const SCEVSMaxExpr* s) { return choose(s, ICmpInst::ICMP_SGE); }
  const SCEV* visitUMaxExpr(const SCEVUMaxExpr* s) { return choose(s, ICmpInst::ICMP_UGE); }
  const SCEV* visitSMinExpr(const SCEVSMinExpr* s) { return choose(s, ICmpInst::ICMP_SLE); }
  const SCEV* visitUMinExpr(const SCEVUMinExpr* s) { return choose(s, ICmpInst::ICMP_ULE); }

 private:
  const SCEV* choose(const SCEVNAryExpr* s, ICmpInst::Predicate wins) {
    if (s->getNumOperands() != 2) return s;
    for (unsigned i = 0; i < 2; ++i)
      if (SE.isLoopEntryGuardedByCond(&loop_, wins, s->getOperand(i), s->getOperand(1 - i)))
        return s->getOperand(i);
    return s;
  }
  Loop& loop_;
};

/// How often the loop runs; null: not known before, or dear to find out.
const SCEV* rounds_of(Loop& loop, ScalarEvolution& evolution) {
  const SCEV* again = evolution.getExitCount(&loop, loop.getLoopLatch());
  if (isa<SCEVCouldNotCompute>(again) || !again->getType()->isIntegerTy(32)) return nullptr;
  again = KnownChoice(loop, evolution).visit(again);
  const SCEV* rounds = evolution.getAddExpr(again, evolution.getOne(again->getType()));
  return is_cheap(rounds) && isSafeToExpand(rounds, evolution) ? rounds : nullptr;
}

/// A counter of the low word alone.
void split_low_word(Loop& loop, LongCounter& c) {
  BasicBlock *before = loop.getLoopPreheader(), *latch = loop.getLoopLatch();
  IRBuilder<> b(before->getTerminator());
  Value* first = b.CreateTrunc(c.value->getIncomingValueForBlock(before), b.getInt16Ty());
  b.SetInsertPoint(c.value);
  auto* low = b.CreatePHI(b.getInt16Ty(), 2);
  b.SetInsertPoint(c.next);
  Value* next = b.CreateAdd(low, b.CreateTrunc(c.next->getOperand(1), b.getInt16Ty()));
  low->addIncoming(first, before);
  low->addIncoming(next, latch);
  for (TruncInst* t : c.low_words) t->replaceAllUsesWith(t->getOperand(0) == c.value ? low : next);
  for (TruncInst* t : c.low_words) t->eraseFromParent();
}

void count_down(Loop& loop, LongCounter& c, const SCEV* rounds, ScalarEvolution& evolution) {
  BasicBlock *before = loop.getLoopPreheader(), *latch = loop.getLoopLatch();
  SCEVExpander expander(evolution, latch->getModule()->getDataLayout(), "rounds");
  Value* all = expander.expandCodeFor(rounds, c.value->getType(), before->getTerminator());
  if (!c.low_words.empty()) split_low_word(loop, c);
  IRBuilder<> b(c.value);
  auto* left = b.CreatePHI(c.value->getType(), 2);
  b.SetInsertPoint(c.branch);
  Value* next = b.CreateAdd(left, b.getInt32(~0u));
  left->addIncoming(all, before);
  left->addIncoming(next, latch);
  const bool goes_on = c.branch->getSuccessor(0) == loop.getHeader();
  c.branch->setCondition(b.CreateICmp(goes_on ? CmpInst::ICMP_NE : CmpInst::ICMP_EQ, next, b.getInt32(0)));
  c.test->eraseFromParent();
  RecursivelyDeleteDeadPHINode(c.value);
}

bool counts_down(const LongCounter& c) {
  auto* end = dyn_cast<ConstantInt>(c.test->getOperand(1));
  return c.low_words.empty() && c.test->isEquality() && c.test->getOperand(0) == c.next && end &&
         end->isZero();
}

}  // namespace

PreservedAnalyses CountDownPass::run(Function& f, FunctionAnalysisManager& analyses) {
  auto& evolution = analyses.getResult<ScalarEvolutionAnalysis>(f);
  bool changed = false;
  for (Loop* loop : analyses.getResult<LoopAnalysis>(f).getLoopsInPreorder()) {
    LongCounter c;
    if (!find_counter(*loop, c) || counts_down(c)) continue;
    const SCEV* rounds = rounds_of(*loop, evolution);
    if (!rounds) continue;
    evolution.forgetLoop(loop);
    count_down(*loop, c, rounds, evolution);
    changed = true;
  }
  return changed ? PreservedAnalyses::none() : PreservedAnalyses::all();
}

}  // namespace cc
