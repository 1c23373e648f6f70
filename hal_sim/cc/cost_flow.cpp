// SPDX-License-Identifier: MIT
// See cost_flow.h. XC16 -O1 keeps the blocks in the order of the source, and so does our pipeline.
#include "cost_flow.h"

#include <set>
#include <tuple>

#include "llvm/IR/CFG.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "passes.h"

namespace cc {

using namespace llvm;

CostFlow::CostFlow(Function& f, LoopInfo& loops, std::function<int(const Value*)> words,
                   std::function<bool(const Value*)> counted)
    : loops_(loops), words_(std::move(words)), counted_(std::move(counted)) {
  find_live(f);
  find_moves(f);
  place_branches(f);
}

void CostFlow::find_live(Function& f) {
  auto spread = [&](const Value* v) {
    const BasicBlock* home = isa<Instruction>(v) ? cast<Instruction>(v)->getParent() : nullptr;
    SmallVector<const BasicBlock*, 16> work;
    auto enter = [&](const BasicBlock* b) {
      if (b != home && live_in_[b].insert(v).second) work.push_back(b);
    };
    for (const User* u : v->users()) {
      auto* user = dyn_cast<Instruction>(u);
      if (!user) continue;
      if (auto* phi = dyn_cast<PHINode>(user)) {
        for (unsigned n = 0; n < phi->getNumIncomingValues(); ++n)
          if (phi->getIncomingValue(n) == v) {
            live_out_[phi->getIncomingBlock(n)].insert(v);
            enter(phi->getIncomingBlock(n));
          }
      } else {
        enter(user->getParent());
      }
    }
    while (!work.empty())
      for (const BasicBlock* from : predecessors(work.pop_back_val())) {
        live_out_[from].insert(v);
        enter(from);
      }
  };
  for (Argument& a : f.args()) spread(&a);
  for (Instruction& i : instructions(f))
    if (counted_(&i)) spread(&i);
}

namespace {

/// One variable of the source: phis that hand their value to one another.
std::map<const Value*, const Value*> variables_of(Function& f) {
  std::map<const Value*, const Value*> of;
  auto find = [&](const Value* v) {
    while (of.count(v) && of[v] != v) v = of[v];
    return v;
  };
  for (BasicBlock& block : f)
    for (PHINode& phi : block.phis()) {
      of.emplace(&phi, &phi);
      for (const Value* v : phi.incoming_values()) {
        // x, or the next x made of x
        auto* op = dyn_cast<BinaryOperator>(v);
        if (op && isa<PHINode>(op->getOperand(0))) v = op->getOperand(0);
        if (!isa<PHINode>(v) || v->getType() != phi.getType()) continue;
        of.emplace(v, v);
        of[find(v)] = find(&phi);
      }
    }
  std::map<const Value*, const Value*> result;
  for (auto& entry : of) result[entry.first] = find(entry.first);
  return result;
}

bool calls_out(const BasicBlock& block) {
  return any_of(block, [](const Instruction& i) {
    auto* call = dyn_cast<CallBase>(&i);
    auto* callee = call ? call->getCalledFunction() : nullptr;
    return call && !is_free(i) && !(callee && (callee->isIntrinsic() || callee->getName().startswith("tp")));
  });
}

}  // namespace

/// Where two paths join: constants are loaded on the way, and a value that lives on beside the joined one is
/// copied.
void CostFlow::find_moves(Function& f) {
  auto variable = variables_of(f);
  using Load = std::tuple<const BasicBlock*, const Value*, const Value*>;
  std::set<Load> loads;
  std::set<std::pair<const BasicBlock*, const Value*>> in_switch;
  for (BasicBlock& block : f)
    for (PHINode& phi : block.phis())
      for (unsigned n = 0; n < phi.getNumIncomingValues(); ++n)
        if (isa<Constant>(phi.getIncomingValue(n)))
          loads.emplace(phi.getIncomingBlock(n), variable[&phi], phi.getIncomingValue(n));
  auto loaded_before = [&](const BasicBlock* block, const PHINode& phi, const Value* v) {
    for (int steps = 0; steps < 3; ++steps) {
      block = block->getSinglePredecessor();
      if (!block) return false;
      if (loads.count({block, variable[&phi], v})) return true;
    }
    return false;
  };
  for (BasicBlock& block : f)
    for (PHINode& phi : block.phis()) {
      if (!counted_(&phi)) continue;
      const Value* own = nullptr;  // the argument whose register the joined value takes
      for (const Value* v : phi.incoming_values())
        if (auto* argument = dyn_cast<Argument>(v))
          if (!own || argument->getArgNo() == 0) own = v;
      for (unsigned n = 0; n < phi.getNumIncomingValues(); ++n) {
        Value* v = phi.getIncomingValue(n);
        BasicBlock* from = phi.getIncomingBlock(n);
        Features& at = cost_[from];
        if (isa<UndefValue>(v) || v == &phi) continue;
        if (isa<Constant>(v)) {
          // ways out of a switch exclude one another; x = 0 before a loop is done once, entered or not
          if (isa<SwitchInst>(from->getTerminator()) && !in_switch.emplace(from, variable[&phi]).second)
            continue;
          if (loaded_before(from, phi, v)) continue;
          double share = 1;
          // a register that the other way's call would destroy cannot be loaded before the branch
          for (BasicBlock* way : successors(from))
            if (way != &block && from->getTerminator()->getNumSuccessors() == 2 && calls_out(*way))
              share = 0.5;
          at[k_phi_constant] +=
              share * (words_(&phi) > 1 && cast<Constant>(v)->isNullValue() ? 1 : words_(&phi));
          continue;
        }
        auto* other = dyn_cast<PHINode>(v);
        bool foreign = isa<Argument>(v) && v != own;
        // if (v > most) most = v: both were alive, so the choice is a copy
        bool beside = false;
        if (auto* made = dyn_cast<Instruction>(v); made && !other)
          for (const Value* w : phi.incoming_values())
            beside |= (isa<PHINode>(w) || w == own) && !live_in_[&block].count(w) &&
                      live_out_[made->getParent()].count(w);
        if (foreign || beside || live_in_[&block].count(v) || (other && other->getParent() == &block))
          at[k_phi_move] += words_(&phi);
      }
    }
  for (BasicBlock& block : f)
    if (auto* ret = dyn_cast<ReturnInst>(block.getTerminator())) place_result(*ret);
}

/// The result is computed in w0 unless the first argument still occupies it.
void CostFlow::place_result(ReturnInst& ret) {
  Value* result = ret.getReturnValue();
  if (!result) return;
  const Function& f = *ret.getFunction();
  Features& at = cost_[ret.getParent()];
  if (isa<Constant>(result)) {
    if (!isa<UndefValue>(result)) at[k_phi_constant] += words_(result);
    return;
  }
  if (auto* argument = dyn_cast<Argument>(result)) {
    if (argument->getArgNo() > 0) at[k_return_move] += words_(result);
    return;
  }
  if (f.arg_empty() || !isa<PHINode>(result)) return;
  // everything that shares a register with the argument, and with the result
  auto web_of = [](const Value* start, bool forward) {
    Values web;
    SmallVector<const Value*, 8> work{start};
    while (!work.empty()) {
      const Value* v = work.pop_back_val();
      if (!web.insert(v).second) continue;
      if (forward) {
        for (const User* u : v->users())
          if (isa<PHINode>(u)) work.push_back(u);
      } else if (auto* phi = dyn_cast<PHINode>(v)) {
        for (const Value* from : phi->incoming_values())
          if (isa<PHINode>(from) || isa<Argument>(from)) work.push_back(from);
      }
    }
    return web;
  };
  Values first = web_of(f.getArg(0), true), last = web_of(result, false);
  for (const Value* v : last)
    if (first.count(v)) return;
  for (const Value* v : last) {
    auto* phi = dyn_cast<PHINode>(v);
    if (!phi) continue;
    for (const Value* w : first) {
      auto* beside = dyn_cast<PHINode>(w);
      bool meets = live_in_[phi->getParent()].count(w) || (beside && beside->getParent() == phi->getParent());
      for (unsigned n = 0; n < phi->getNumIncomingValues() && !meets; ++n)
        meets = isa<Constant>(phi->getIncomingValue(n)) && live_in_[phi->getIncomingBlock(n)].count(w);
      if (meets) {
        at[k_return_move] += words_(result);
        return;
      }
    }
  }
}

/// Nothing but a jump: the chip's code does not have this block.
bool CostFlow::is_empty(const BasicBlock* block) const {
  auto* br = dyn_cast<BranchInst>(block->getTerminator());
  if (!br || br->isConditional()) return false;
  auto moves = cost_.find(block);
  if (moves != cost_.end() && (moves->second[k_phi_constant] > 0 || moves->second[k_phi_move] > 0))
    return false;
  for (const Instruction& i : *block)
    if (!isa<PHINode>(i) && !isa<DbgInfoIntrinsic>(i) && !is_free(i) && &i != br) return false;
  return true;
}

const BasicBlock* CostFlow::target(const BasicBlock* block) const {
  for (int steps = 0; steps < 20 && is_empty(block); ++steps) block = block->getSingleSuccessor();
  return block;
}

const BasicBlock* CostFlow::next(const BasicBlock* block) const {
  do block = block->getNextNode();
  while (block && (is_empty(block) || isa<UnreachableInst>(block->getTerminator())));
  return block;
}

/// c >= 'a' && c <= 'z' is one unsigned comparison of c - 'a': the second test costs the subtraction.
bool CostFlow::ends_range_test(const BasicBlock& block) const {
  auto compare_of = [](const BasicBlock& b) -> const ICmpInst* {
    auto* br = dyn_cast<BranchInst>(b.getTerminator());
    auto* compare = br && br->isConditional() ? dyn_cast<ICmpInst>(br->getCondition()) : nullptr;
    return compare && compare->isRelational() && isa<ConstantInt>(compare->getOperand(1)) ? compare : nullptr;
  };
  const BasicBlock* before = block.getSinglePredecessor();
  auto* second = compare_of(block);
  if (!before || !second || second->getPrevNonDebugInstruction() ||
      second->getNextNonDebugInstruction() != block.getTerminator())
    return false;
  auto* first = compare_of(*before);
  if (!first || first->getOperand(0) != second->getOperand(0) || words_(first->getOperand(0)) > 1)
    return false;
  for (const BasicBlock* s : successors(&block))
    if (is_contained(successors(before), s))
      return all_of(s->phis(), [&](const PHINode& phi) {
        return phi.getIncomingValueForBlock(&block) == phi.getIncomingValueForBlock(before);
      });
  return false;
}

void CostFlow::place_branches(Function& f) {
  for (BasicBlock& block : f) {
    auto* br = dyn_cast<BranchInst>(block.getTerminator());
    if (!br || is_free(*br)) continue;
    const BasicBlock* after = next(&block);
    Features& here = cost_[&block];
    if (br->isUnconditional()) {
      if (!is_empty(&block) && target(br->getSuccessor(0)) != after) here[k_jump] += 1;
      continue;
    }
    auto* condition = dyn_cast<Instruction>(br->getCondition());
    if (condition && is_free(*condition)) continue;
    if (!ends_range_test(block)) here[k_branch] += 1;
    Loop* loop = loops_.getLoopFor(&block);
    BasicBlock *jumped = br->getSuccessor(0), *straight = br->getSuccessor(1);
    if (target(jumped) == after || (target(straight) != after && loop && straight == loop->getHeader()))
      std::swap(jumped, straight);
    if (target(straight) != after && (!loop || jumped != loop->getHeader())) {
      // both away: a branch and a jump
      if (straight->getSinglePredecessor())
        cost_[straight][k_jump] += 1;
      else
        here[k_jump] += 0.5;
    }
    if (jumped->getSinglePredecessor()) {
      cost_[jumped][k_taken] += 1;
    } else if (straight->getSinglePredecessor()) {
      here[k_taken] += 1;
      cost_[straight][k_taken] -= 1;
    } else if (loop && loop->getLoopLatch() == &block && loop->getExitingBlock() == &block &&
               loop->getLoopPreheader()) {
      here[k_taken] += 1;
      cost_[loop->getLoopPreheader()][k_taken] -= 1;
    } else {
      here[k_taken] += 0.5;
    }
  }
}

void CostFlow::charge(BasicBlock& block, Features& features) {
  auto found = cost_.find(&block);
  if (found == cost_.end()) return;
  for (int r = 0; r < kRuleCount; ++r) features[r] += found->second[r];
}

}  // namespace cc
