// SPDX-License-Identifier: MIT
// How many cycles the chip would need for a block of LLVM code: a model of what XC16 makes of it.
#pragma once
#include <string>
#include <vector>

#include "cost_params.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/ScalarEvolution.h"
#include "llvm/IR/Function.h"
#include "llvm/IR/PassManager.h"

namespace cc {

/// How often each rule of cost_params.h applies.
using Features = std::array<double, kRuleCount>;

/// A part of a block that runs without a break, and its cost.
struct Segment {
  llvm::Instruction* first;  // the budget is charged before it
  Features features{};       // own cycles
  double library = 0;        // cycles inside compiler library routines (soft float, 32-bit division)
  double cycles() const;     // own + library
  double own() const;
};

/// The function that serves an interrupt vector, by its name.
bool is_handler(const llvm::Function& function);

/// All segments of a function, in block order. Entry and return overheads are part of them.
class FunctionCost {
 public:
  FunctionCost(llvm::Function& function, llvm::FunctionAnalysisManager& analyses, int level);
  std::vector<Segment> segments;
};

}  // namespace cc
