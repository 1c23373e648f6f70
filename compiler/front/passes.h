// SPDX-License-Identifier: MIT
// The stages between clang's front end and the chip's code generator (chip.h).
#pragma once
#include "frontend.h"
#include "llvm/ADT/Twine.h"
#include "llvm/IR/DebugLoc.h"
#include "llvm/IR/Instructions.h"
#include "llvm/IR/PassManager.h"
#include "llvm/Transforms/Scalar/LoopPassManager.h"

namespace cc {

/// One translation unit on its way through the stages.
struct Unit {
  llvm::Module& module;
  const Options& options;
  const Facts& facts;
  bool failed = false;

  /// Prints "file:line:col: error: text".
  void error(const llvm::DebugLoc& where, const llvm::Twine& text);
  void warning(const llvm::DebugLoc& where, const llvm::Twine& text);
};

/// The file of a place that is known, as whoever started the compiler would reach it.
std::string file_of(const llvm::DebugLoc& where);

/// A loop that only counts is a delay and must not vanish: each round calls `mark`.
void keep_empty_loops(llvm::Module& m, llvm::Function& mark);
/// What _FOSC() and _FWDT() of the device header make, for words given by #pragma config: each is handed to
/// `dress`, with the word's name.
void define_configuration(Unit& unit, llvm::function_ref<void(llvm::GlobalVariable&, llvm::StringRef)> dress);
/// Control flow made plain without turning branches into selects.
struct PlainCfgPass : llvm::PassInfoMixin<PlainCfgPass> {
  llvm::PreservedAnalyses run(llvm::Function& f, llvm::FunctionAnalysisManager& analyses);
};
/// A division that may be by 0 is done, and traps.
struct KeepDivisionsPass : llvm::PassInfoMixin<KeepDivisionsPass> {
  llvm::PreservedAnalyses run(llvm::Function& f, llvm::FunctionAnalysisManager& analyses);
};
struct KeepPlainDivisionsPass : llvm::PassInfoMixin<KeepPlainDivisionsPass> {
  llvm::PreservedAnalyses run(llvm::Function& f, llvm::FunctionAnalysisManager& analyses);
};
/// A store to a constant is done, and traps.
struct KeepConstantStoresPass : llvm::PassInfoMixin<KeepConstantStoresPass> {
  llvm::PreservedAnalyses run(llvm::Function& f, llvm::FunctionAnalysisManager& analyses);
};
/// Behind the optimiser: where LLVM concludes that no course comes, the program stops.
void stop_where_undefined(llvm::Module& m);
struct KeepZeroArgumentsPass : llvm::PassInfoMixin<KeepZeroArgumentsPass> {
  llvm::PreservedAnalyses run(llvm::Module& m, llvm::ModuleAnalysisManager& analyses);
};
/// A loop that a long counts does so down to 0.
struct CountDownPass : llvm::PassInfoMixin<CountDownPass> {
  llvm::PreservedAnalyses run(llvm::Function& f, llvm::FunctionAnalysisManager& analyses);
};
/// Within the pass of loops, a loop that never ends keeps its stores to variables; behind it,
/// they are plain again.
struct KeepEndlessStoresPass : llvm::PassInfoMixin<KeepEndlessStoresPass> {
  llvm::PreservedAnalyses run(llvm::Loop& loop, llvm::LoopAnalysisManager& analyses,
                              llvm::LoopStandardAnalysisResults& results, llvm::LPMUpdater& updater);
};
struct FreeEndlessStoresPass : llvm::PassInfoMixin<FreeEndlessStoresPass> {
  llvm::PreservedAnalyses run(llvm::Function& f, llvm::FunctionAnalysisManager& analyses);
};
/// What a value was before it was cast.
llvm::Value* without_casts(llvm::Value* v);
/// -O1: a loop that only counts takes as many cycles a round as XC16's.
struct DelayRoundsPass : llvm::PassInfoMixin<DelayRoundsPass> {
  llvm::PreservedAnalyses run(llvm::Function& f, llvm::FunctionAnalysisManager& analyses);
};
/// -O0: the same of `while (n--)`.
void wait_as_unoptimised(llvm::Module& m);
/// -O0: variables lie below parameters in the frame, as with XC16; what lies first is counted in place.
void place_locals_first(llvm::Module& m);
/// Loads of variables that an interrupt may change are done where they stand. Before the optimiser. False,
/// and told, when the file's facts cannot be written.
bool read_shared_in_place(Unit& unit);

}  // namespace cc
