// SPDX-License-Identifier: MIT
// The stages between clang's front end and the PC's back end, in the order pipeline.cpp runs them.
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

// --- names of the functions stages leave for one another (never called at run time)
inline constexpr const char* kNop = "tp.nop";      // asm("nop"): one cycle, no effect
inline constexpr const char* kRound = "tp.round";  // keeps an empty counting loop alive; no cycle
inline constexpr const char* kFree = "tp.free";  // metadata: instruction exists on the PC only, costs nothing

/// A function of that kind: no effect the program can see, yet its calls stay where they are.
llvm::Function* marker(llvm::Module& m, const char* name);

/// Inline assembler by its text: the statements that old programs use become calls and accesses.
void lower_assembler(Unit& unit);
/// A loop that only counts is a delay and must not vanish: each round calls `mark`.
void keep_empty_loops(llvm::Module& m, llvm::Function& mark);
/// What _FOSC() and _FWDT() of the device header make, for words given by #pragma config: each is handed to
/// `dress`, with the word's name.
void define_configuration(Unit& unit, llvm::function_ref<void(llvm::GlobalVariable&, llvm::StringRef)> dress);
/// Refused functions, sections, wide shifts, float to int, division by zero.
void lower_early(Unit& unit);
/// Accesses to tp_sfr_XXXX globals become calls to the register host.
void lower_registers(Unit& unit);
/// A flag that only an interrupt can change is read afresh in the loop that polls it.
void keep_polled_flags(Unit& unit, llvm::FunctionAnalysisManager& analyses);
/// Counting loops that do nothing become tp_delay(rounds, cycles).
void lower_delay_loops(Unit& unit, llvm::FunctionAnalysisManager& analyses);
/// Control flow made plain without turning branches into selects.
struct PlainCfgPass : llvm::PassInfoMixin<PlainCfgPass> {
  llvm::PreservedAnalyses run(llvm::Function& f, llvm::FunctionAnalysisManager& analyses);
};
/// Chip: a division that may be by 0 is done, and traps.
struct KeepDivisionsPass : llvm::PassInfoMixin<KeepDivisionsPass> {
  llvm::PreservedAnalyses run(llvm::Function& f, llvm::FunctionAnalysisManager& analyses);
};
struct KeepPlainDivisionsPass : llvm::PassInfoMixin<KeepPlainDivisionsPass> {
  llvm::PreservedAnalyses run(llvm::Function& f, llvm::FunctionAnalysisManager& analyses);
};
struct KeepZeroArgumentsPass : llvm::PassInfoMixin<KeepZeroArgumentsPass> {
  llvm::PreservedAnalyses run(llvm::Module& m, llvm::ModuleAnalysisManager& analyses);
};
/// Chip: a loop that a long counts does so down to 0.
struct CountDownPass : llvm::PassInfoMixin<CountDownPass> {
  llvm::PreservedAnalyses run(llvm::Function& f, llvm::FunctionAnalysisManager& analyses);
};
/// Chip: within the pass of loops, a loop that never ends keeps its stores to variables; behind it, they are
/// plain again.
struct KeepEndlessStoresPass : llvm::PassInfoMixin<KeepEndlessStoresPass> {
  llvm::PreservedAnalyses run(llvm::Loop& loop, llvm::LoopAnalysisManager& analyses,
                              llvm::LoopStandardAnalysisResults& results, llvm::LPMUpdater& updater);
};
struct FreeEndlessStoresPass : llvm::PassInfoMixin<FreeEndlessStoresPass> {
  llvm::PreservedAnalyses run(llvm::Function& f, llvm::FunctionAnalysisManager& analyses);
};
/// Chip, -O1: a loop that only counts takes as many cycles a round as XC16's.
struct DelayRoundsPass : llvm::PassInfoMixin<DelayRoundsPass> {
  llvm::PreservedAnalyses run(llvm::Function& f, llvm::FunctionAnalysisManager& analyses);
};
/// Chip, -O0: the same of `while (n--)`.
void wait_as_unoptimised(llvm::Module& m);
/// Chip, -O0: variables lie below parameters in the frame, as with XC16; what lies first is counted in place.
void place_locals_first(llvm::Module& m);
struct Charge {
  llvm::Instruction* before;
  double cycles;
};
struct FunctionPlan {
  llvm::Function* function;
  double straight = 0, least = 0;
  std::string description;  // a line for `twinpuck cycles`, fields separated by |
};
struct CostPlan {
  std::vector<Charge> charges;
  std::vector<FunctionPlan> functions;
};

/// What everything costs, before instrumentation adds what the chip does not have.
CostPlan plan_costs(Unit& unit, llvm::FunctionAnalysisManager& analyses);
/// tp_poll at the back edge of loops whose last round changed nothing.
void instrument_polls(Unit& unit, llvm::FunctionAnalysisManager& analyses);
/// Budget, function table, coverage.
void account(Unit& unit, const CostPlan& plan);
/// A register read, changed and written back at one instant is one call.
void fuse_registers(Unit& unit);
/// What x86 would trap on or define otherwise: INT16_MIN / -1, shifts by 16 and more.
void lower_late(Unit& unit);
/// What nobody has written holds the same in every run.
void fill_locals(Unit& unit);
/// --sanitize: every access checked against the objects that exist.
void check_addresses(Unit& unit);

/// Runs all stages; false after an error. Then the module is ready for the back end.
bool run_pipeline(Unit& unit);

/// Chip: loads of variables that an interrupt may change are done where they stand. Before the optimiser.
void read_shared_in_place(Unit& unit);

// --- small tools
llvm::FunctionCallee host_function(llvm::Module& m, const char* name, llvm::Type* result,
                                   llvm::ArrayRef<llvm::Type*> parameters);
/// Marks an instruction as costing nothing on the chip.
void mark_free(llvm::Instruction* instruction);
inline bool is_free(const llvm::Instruction& i) { return i.getMetadata(kFree) != nullptr; }
/// Is this a call of the named function?
bool calls(const llvm::Instruction& i, llvm::StringRef name);
/// Poll-safe: reads at most; may stand in a polling loop.
bool is_poll_safe(const llvm::Function* callee, const Unit& unit);
/// Address of the tp_control field: 0 budget, 1 writes, 2 fill.
llvm::Value* control_field(llvm::Module& m, unsigned index);

}  // namespace cc
