// SPDX-License-Identifier: MIT
// What the flow of control and of values costs: taken branches by the layout of the blocks, moves between
// registers where two paths join, the result on its way to w0.
#pragma once
#include <functional>
#include <map>

#include "cost_model.h"
#include "llvm/ADT/SmallPtrSet.h"
#include "llvm/IR/BasicBlock.h"
#include "llvm/IR/Instructions.h"

namespace cc {

class CostFlow {
 public:
  using Values = llvm::SmallPtrSet<const llvm::Value*, 16>;

  /// words: 16-bit words of a value on the chip; counted: does a value need a register at all?
  CostFlow(llvm::Function& f, llvm::LoopInfo& loops, std::function<int(const llvm::Value*)> words,
           std::function<bool(const llvm::Value*)> counted);

  const Values& live_out(const llvm::BasicBlock* block) { return live_out_[block]; }

  /// Cost of a block for its terminator and for moves on its way out; cycles of taken branches may be
  /// negative, where another block has paid for them already.
  void charge(llvm::BasicBlock& block, Features& features);

  bool ends_range_test(const llvm::BasicBlock& block) const;

 private:
  void find_live(llvm::Function& f);
  void find_moves(llvm::Function& f);
  void place_branches(llvm::Function& f);
  void place_result(llvm::ReturnInst& ret);
  bool is_empty(const llvm::BasicBlock* block) const;
  const llvm::BasicBlock* target(const llvm::BasicBlock* block) const;
  const llvm::BasicBlock* next(const llvm::BasicBlock* block) const;

  llvm::LoopInfo& loops_;
  std::function<int(const llvm::Value*)> words_;
  std::function<bool(const llvm::Value*)> counted_;
  std::map<const llvm::BasicBlock*, Values> live_in_, live_out_;
  std::map<const llvm::BasicBlock*, Features> cost_;
};

}  // namespace cc
