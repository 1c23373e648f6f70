// SPDX-License-Identifier: MIT
// Charges every segment to the budget, writes the function table, and counts lines for --coverage.
#include <cmath>
#include <map>
#include <set>

#include "cost_model.h"
#include "hal_sim/api/timings.h"
#include "llvm/ADT/PostOrderIterator.h"
#include "llvm/IR/CFG.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/IR/MDBuilder.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/raw_ostream.h"
#include "llvm/Transforms/Utils/BasicBlockUtils.h"
#include "llvm/Transforms/Utils/ModuleUtils.h"
#include "passes.h"

namespace cc {
namespace {

using namespace llvm;

Constant* text(Module& m, StringRef s) {
  IRBuilder<> b(m.getContext());
  auto* data = ConstantDataArray::getString(m.getContext(), s);
  auto* g = new GlobalVariable(m, data->getType(), true, GlobalValue::PrivateLinkage, data, "tp.text");
  g->setUnnamedAddr(GlobalValue::UnnamedAddr::Global);
  return ConstantExpr::getBitCast(g, b.getInt8PtrTy());
}

void add_to_section(Module& m, StringRef section, Constant* value, std::vector<GlobalValue*>& used) {
  auto* g =
      new GlobalVariable(m, value->getType(), false, GlobalValue::InternalLinkage, value, section + ".entry");
  g->setSection(section);
  g->setAlignment(Align(8));
  used.push_back(g);
}

/// budget -= cycles; if (budget < 0) tp_event();
void charge(Module& m, Instruction* before, int64_t cycles) {
  IRBuilder<> b(before);
  b.SetCurrentDebugLocation(before->getDebugLoc());
  Value* field = control_field(m, 0);
  Value* left = b.CreateSub(b.CreateAlignedLoad(b.getInt64Ty(), field, Align(8)), b.getInt64(cycles));
  b.CreateAlignedStore(left, field, Align(8));
  if (cycles < 0) return;  // a correction: a branch paid for by the block before was not taken
  Value* spent = b.CreateICmpSLT(left, b.getInt64(0));
  auto* rarely = MDBuilder(m.getContext()).createBranchWeights(1, 100000);
  Instruction* then = SplitBlockAndInsertIfThen(spent, before, false, rarely);
  IRBuilder<> slow(then);
  slow.SetCurrentDebugLocation(before->getDebugLoc());
  auto event = host_function(m, "tp_image_event", b.getVoidTy(), {});
  auto* f = cast<Function>(event.getCallee());
  // saves every register itself, so the fast path keeps its values where they are
  f->setCallingConv(CallingConv::PreserveMost);
  f->setVisibility(GlobalValue::HiddenVisibility);
  slow.CreateCall(event)->setCallingConv(CallingConv::PreserveMost);
}

void count_lines(Function& f, std::vector<GlobalValue*>& used) {
  Module& m = *f.getParent();
  Type* i64 = Type::getInt64Ty(m.getContext());
  std::vector<BasicBlock*> blocks;
  for (BasicBlock& block : f) blocks.push_back(&block);
  for (BasicBlock* block : blocks) {
    std::map<unsigned, StringRef> lines;
    for (Instruction& i : *block)
      if (!isa<DbgInfoIntrinsic>(i) && !isa<PHINode>(i) && i.getDebugLoc() && i.getDebugLoc().getLine())
        lines.emplace(i.getDebugLoc().getLine(), cast<DIScope>(i.getDebugLoc().getScope())->getFilename());
    if (lines.empty()) continue;
    auto* counter =
        new GlobalVariable(m, i64, false, GlobalValue::InternalLinkage, ConstantInt::get(i64, 0), "tp.count");
    counter->setSection("tpcov");
    counter->setAlignment(Align(8));
    for (auto& [line, file] : lines) {
      Constant* fields[] = {text(m, file), ConstantInt::get(i64, line), counter};
      add_to_section(m, "tpcovmap", ConstantStruct::getAnon(fields), used);
    }
    IRBuilder<> b(&*block->getFirstInsertionPt());
    b.CreateAlignedStore(b.CreateAdd(b.CreateAlignedLoad(i64, counter, Align(8)), b.getInt64(1)), counter,
                         Align(8));
  }
}

/// The way through a function that costs least or most, back edges left out, loops weighed by their trip
/// counts.
struct Way {
  double cycles = -1;
  std::map<std::string, double> calls;
};

struct BlockPlan {
  double cycles = 0;
  double trips = 1, likely_trips = 1, weight = 1;
  bool bounded = true;
  std::vector<std::string> calls;
};

Way best_way(Function& f, std::map<BasicBlock*, BlockPlan>& plans, bool least) {
  std::map<BasicBlock*, std::pair<double, BasicBlock*>> reached;
  ReversePostOrderTraversal<Function*> order(&f);
  for (BasicBlock* block : order) {
    std::pair<double, BasicBlock*> here{0, nullptr};
    bool first = true;
    for (BasicBlock* from : predecessors(block)) {
      auto found = reached.find(from);
      if (from == block || found == reached.end()) continue;
      if (first || (least ? found->second.first < here.first : found->second.first > here.first))
        here = {found->second.first, from};
      first = false;
    }
    here.first += plans[block].cycles * (least && !plans[block].bounded ? 1 : plans[block].trips);
    reached[block] = here;
  }
  BasicBlock* end = nullptr;
  for (BasicBlock& block : f)
    if (isa<ReturnInst>(block.getTerminator()) && reached.count(&block))
      if (!end ||
          (least ? reached[&block].first < reached[end].first : reached[&block].first > reached[end].first))
        end = &block;
  Way way;
  if (!end) return way;
  way.cycles = reached[end].first;
  for (BasicBlock* b = end; b; b = reached[b].second)
    for (auto& name : plans[b].calls) way.calls[name] += plans[b].bounded || !least ? plans[b].trips : 1;
  return way;
}

std::string list_of(const std::map<std::string, double>& calls) {
  std::string s;
  for (auto& [name, count] : calls) s += (s.empty() ? "" : ",") + name + ":" + std::to_string(count);
  return s;
}

/// The cycles that the library hands to tp_spend(): of several ways the mean; rounds that are not known yet
/// count nothing and have no bound.
double spent_cycles(const Value* v, bool& bounded, int deep = 8) {
  if (auto* number = dyn_cast<ConstantInt>(v)) return double(number->getSExtValue());
  if (auto* wider = dyn_cast<CastInst>(v)) return spent_cycles(wider->getOperand(0), bounded, deep);
  const auto* sum = dyn_cast<BinaryOperator>(v);
  const bool is_sum = sum && sum->getOpcode() == Instruction::Add, is_choice = isa<SelectInst>(v);
  if (deep == 0 || (!is_sum && !is_choice && !isa<PHINode>(v))) return bounded = false, 0;
  const User* parts = cast<User>(v);
  double all = 0;
  for (unsigned n = is_choice; n < parts->getNumOperands(); ++n)  // the first of a choice is its condition
    all += spent_cycles(parts->getOperand(n), bounded, deep - 1);
  return is_sum ? all : all / (parts->getNumOperands() - is_choice);
}

/// What the host charges during a call of one of its functions, as far as that is known here: of a usual one,
/// with the motors newest in the list of agendas.
double host_cycles(const CallBase& call, bool& bounded) {
  static const std::map<StringRef, int> kCharged = {
      {"tp_motor_speed", T_SPEED + T_SPEED_DIVISION},
      {"tp_agenda_activate", T_AGENDA_ACTIVATE},
      {"tp_agenda_set_cycle", T_AGENDA_CYCLE},
      {"tp_agenda_reset", T_AGENDA_FOUND},
      {"tp_agenda_pause", T_AGENDA_FOUND},
      {"tp_agenda_restart", T_AGENDA_FOUND},
      {"tp_agenda_destroy", T_AGENDA_DESTROY + T_AGENDA_FREE},
  };
  const StringRef name = call.getCalledFunction()->getName();
  const auto* number = call.arg_empty() ? nullptr : dyn_cast<ConstantInt>(call.getArgOperand(0));
  if (name == "tp_spend") return spent_cycles(call.getArgOperand(0), bounded);
  const auto found = kCharged.find(name);
  const bool is_left = name == "tp_motor_speed" && number && number->isZero();  // the right one is newer
  return found == kCharged.end() ? 0 : found->second + (is_left ? T_AGENDA_PASSED : 0);
}

/// One line for `twinpuck cycles`: own cycles and calls, least, mean and most. Returns the least.
double describe(Function& f, FunctionAnalysisManager& analyses, const std::vector<Segment>& segments,
                std::string& out) {
  auto& loops = analyses.getResult<LoopAnalysis>(f);
  auto& dom = analyses.getResult<DominatorTreeAnalysis>(f);
  auto& se = analyses.getResult<ScalarEvolutionAnalysis>(f);
  std::map<BasicBlock*, BlockPlan> plans;
  bool bounded = true;
  for (BasicBlock& block : f) {
    auto& p = plans[&block];
    for (Loop* l = loops.getLoopFor(&block); l; l = l->getParentLoop()) {
      unsigned trips = se.getSmallConstantTripCount(l);
      unsigned most = trips ? trips : se.getSmallConstantMaxTripCount(l);
      if (trips == 0 && (most == 0 || most > 10000)) p.bounded = false;
      p.trips *= trips ? trips : most > 0 && most <= 10000 ? most : 1;
      p.likely_trips *= trips ? trips : 10;
      BasicBlock* latch = l->getLoopLatch();
      if (latch && !dom.dominates(&block, latch)) p.weight *= 0.5;
    }
    if (!loops.getLoopFor(&block)) {
      for (BasicBlock& other : f)
        if (isa<ReturnInst>(other.getTerminator()) && !dom.dominates(&block, &other)) p.weight = 0.5;
    }
    bounded = bounded && p.bounded;
    for (Instruction& i : block) {
      auto* c = dyn_cast<CallBase>(&i);
      auto* callee = c ? c->getCalledFunction() : nullptr;
      if (!callee || callee->isIntrinsic() || callee->getName().startswith("tp.")) continue;
      if (callee->getName() == "tp_delay") {
        auto* rounds = dyn_cast<ConstantInt>(c->getArgOperand(0));
        double each = double(cast<ConstantInt>(c->getArgOperand(1))->getSExtValue());
        if (rounds)
          p.cycles += double(rounds->getSExtValue()) * each;
        else
          bounded = false, p.cycles += each;
      } else if (callee->getName().startswith("tp_")) {
        p.cycles += host_cycles(*c, bounded);
      } else {
        p.calls.push_back(callee->getName().str());
      }
    }
  }
  for (const Segment& s : segments) plans[s.first->getParent()].cycles += s.cycles();
  // a handler's own cost is told with the saving of w0 to w7, which the host takes for it
  if (is_handler(f)) plans[&f.getEntryBlock()].cycles += kHandlerContext;
  double mean = 0;
  std::map<std::string, double> mean_calls;
  for (auto& [block, p] : plans) {
    mean += p.cycles * p.likely_trips * p.weight;
    for (auto& name : p.calls) mean_calls[name] += p.likely_trips * p.weight;
  }
  Way least = best_way(f, plans, true), most = best_way(f, plans, false);
  if (!bounded || least.cycles < 0) most.cycles = -1;
  auto* where = f.getSubprogram();
  out = (f.getName() + "|" + (where ? where->getFilename() : "") + "|" + Twine(where ? where->getLine() : 0))
            .str() +
        "|" + std::to_string(least.cycles) + "|" + std::to_string(mean) + "|" + std::to_string(most.cycles) +
        "|" + list_of(least.calls) + "|" + list_of(mean_calls) + "|" + list_of(most.calls);
  return least.cycles;
}

// of each function on the chip's stack, beside its local variables  [estimated: CALL pushes two words, LNK
// one; gcc 4.5 keeps four of w8 to w14 in an average function, and spills nothing]
constexpr uint64_t kFrameBytes = 4 + 2 + 8;
// of a handler, too: w0 to w7, RCOUNT and PSVPAG  [estimated: gcc 4.5 prologues]
constexpr uint64_t kHandlerBytes = 16 + 2 + 2;

/// Size of a variable as the chip has it: pointers of two bytes, everything but bytes at even addresses.
uint64_t chip_bytes(Type* type, const DataLayout& layout) {
  if (type->isPointerTy()) return 2;
  if (auto* array = dyn_cast<ArrayType>(type))
    return array->getNumElements() * chip_bytes(array->getElementType(), layout);
  if (auto* fields = dyn_cast<StructType>(type)) {
    uint64_t bytes = 0;
    for (Type* field : fields->elements()) {
      const uint64_t each = chip_bytes(field, layout);
      bytes += each + (each > 1 ? bytes % 2 : 0);
    }
    return bytes;
  }
  return layout.getTypeStoreSize(type);
}

/// What one call of the function takes of the chip's stack, callees apart.
uint64_t stack_bytes(const Function& f) {
  const DataLayout& layout = f.getParent()->getDataLayout();
  uint64_t bytes = kFrameBytes + (is_handler(f) ? kHandlerBytes : 0);
  for (const Instruction& i : f.getEntryBlock())
    if (auto* local = dyn_cast<AllocaInst>(&i))
      if (auto* count = dyn_cast<ConstantInt>(local->getArraySize()))
        bytes += alignTo(count->getZExtValue() * chip_bytes(local->getAllocatedType(), layout), 2);
  return bytes;
}

/// "file|data|bytes": variables that lie in the chip's RAM. Constants are in flash; private are clang's own
/// for
/// --sanitize.
std::string data_line(const Module& m) {
  uint64_t bytes = 0;
  for (const GlobalVariable& g : m.globals())
    if (!g.isDeclaration() && !g.isConstant() && !g.hasPrivateLinkage() && g.getSection() != "tpeedata" &&
        !g.getName().startswith("tp") && !g.getName().startswith("llvm."))
      bytes += alignTo(chip_bytes(g.getValueType(), m.getDataLayout()), 2);
  return m.getSourceFileName() + "|data|" + std::to_string(bytes);
}

/// Functions of which the program takes the address, a line each: "name|pointer". An agenda, for example.
std::vector<std::string> functions_by_pointer(const Module& m) {
  std::vector<std::string> lines;
  for (const Function& f : m)
    if (f.getName() != "main" && !f.isIntrinsic() && !f.getName().startswith("tp_") &&
        f.hasAddressTaken(nullptr, false, true, true))
      lines.push_back(f.getName().str() + "|pointer");
  return lines;
}

/// Functions whose code stands in others, a line each: "name|file|line|inlined|in which".
std::vector<std::string> inlined_functions(const Module& m) {
  std::map<const DISubprogram*, std::set<std::string>> hosts;
  for (const Function& f : m)
    for (const Instruction& i : instructions(f))
      for (const DILocation* at = i.getDebugLoc().get(); at && at->getInlinedAt(); at = at->getInlinedAt())
        hosts[at->getScope()->getSubprogram()].insert(f.getName().str());
  std::set<std::string> lines;
  for (const auto& [what, where] : hosts) {
    const Function* own = m.getFunction(what->getName());
    if ((own && !own->isDeclaration()) || what->getFilename().contains("firmware/include/") ||
        what->getFilename().contains("libc/include/"))
      continue;  // stands by itself as well, or is of a header of ours
    std::string names;
    for (const std::string& name : where) names += (names.empty() ? "" : ", ") + name;
    lines.insert((what->getName() + "|" + what->getFilename() + "|" + Twine(what->getLine())).str() +
                 "|inlined|" + names);
  }
  return {lines.begin(), lines.end()};
}

/// For fitting the model: what each segment consists of, and a counter of its executions.
void dump_segment(raw_ostream& out, const Function& f, const Segment& s) {
  out << f.getName();
  for (int r = 0; r < kRuleCount; ++r)
    if (s.features[r]) out << " " << kRuleNames[r] << "=" << s.features[r];
  out << "\n";
}

void count_segments(Module& m, const std::vector<Charge>& charges) {
  Type* i64 = Type::getInt64Ty(m.getContext());
  auto* array = ArrayType::get(i64, 4096);
  auto* counts = m.getOrInsertGlobal("tp_bench_counts", array);
  for (size_t n = 0; n < charges.size(); ++n) {
    IRBuilder<> b(charges[n].before);
    Value* field = b.CreateConstGEP2_64(array, counts, 0, n);
    b.CreateStore(b.CreateAdd(b.CreateLoad(i64, field), b.getInt64(1)), field);
  }
}

/// Functions of the native HAL whose cost is known from the drivers: TAKES(cycles) of hal_sim/api/takes.h.
std::map<const Function*, int> told_costs(const Module& m) {
  std::map<const Function*, int> told;
  const GlobalVariable* annotations = m.getGlobalVariable("llvm.global.annotations");
  if (!annotations) return told;
  for (const Use& entry : cast<ConstantArray>(annotations->getInitializer())->operands()) {
    auto* fields = cast<ConstantStruct>(entry);
    auto* function = dyn_cast<Function>(fields->getOperand(0)->stripPointerCasts());
    auto* text = dyn_cast<GlobalVariable>(fields->getOperand(1)->stripPointerCasts());
    auto* said = text ? dyn_cast<ConstantDataArray>(text->getInitializer()) : nullptr;
    StringRef words = said && said->isCString() ? said->getAsCString() : "";
    int cycles = 0;
    if (function && words.consume_front("twinpuck cycles ") && !words.getAsInteger(10, cycles))
      told[function] = cycles;
  }
  return told;
}

/// What the interrupt handler does on the robot and a function does here: no cost to whoever calls it.
bool stands_for_handler(const Function* f) { return f && f->getName().startswith("twinpuck_refresh_"); }

void free_stand_ins(Function& f) {
  for (Instruction& i : instructions(f))
    if (auto* call = dyn_cast<CallBase>(&i); call && stands_for_handler(call->getCalledFunction()))
      mark_free(call);
}

}  // namespace

CostPlan plan_costs(Unit& unit, FunctionAnalysisManager& analyses) {
  Module& m = unit.module;
  CostPlan plan;
  const auto told = told_costs(m);
  std::unique_ptr<raw_fd_ostream> dump;
  std::error_code ec;
  if (!unit.options.cost_dump.empty()) dump = std::make_unique<raw_fd_ostream>(unit.options.cost_dump, ec);
  for (Function& f : m) {
    if (f.isDeclaration() || f.getName().startswith("tp_image_") || stands_for_handler(&f)) continue;
    free_stand_ins(f);
    FunctionCost cost(f, analyses, unit.options.level);
    FunctionPlan function{&f, 0, 0, {}};
    const auto known = told.find(&f);
    for (Segment& s : cost.segments) {
      const bool is_entry = &s == &cost.segments.front();
      if (dump) dump_segment(*dump, f, s);
      if (known != told.end()) s.features = {}, s.library = is_entry ? known->second : 0;
      plan.charges.push_back({s.first, s.cycles()});
      function.straight += s.cycles();
    }
    function.least = describe(f, analyses, cost.segments, function.description);
    function.description += unit.options.library || unit.options.weak ? "|library" : "|program";
    function.description += "|" + std::to_string(stack_bytes(f));
    plan.functions.push_back(function);
  }
  return plan;
}

void account(Unit& unit, const CostPlan& plan) {
  Module& m = unit.module;
  std::vector<GlobalValue*> used;
  Type* i64 = Type::getInt64Ty(m.getContext());
  if (!unit.options.cost_dump.empty()) return count_segments(m, plan.charges);
  // before the tables below, which are data and hold the addresses of all functions
  auto of_program = functions_by_pointer(m);
  of_program.push_back(data_line(m));
  for (const auto& function : plan.functions) {
    auto* where = function.function->getSubprogram();
    if (!where) continue;
    Constant* fields[] = {text(m, function.function->getName()),
                          text(m, where->getFilename()),
                          ConstantInt::get(i64, where->getLine()),
                          ConstantExpr::getBitCast(function.function, Type::getInt8PtrTy(m.getContext())),
                          ConstantInt::get(i64, std::llround(function.least)),
                          ConstantInt::get(i64, std::llround(function.straight))};
    add_to_section(m, "tpfunc", ConstantStruct::getAnon(fields), used);
    add_to_section(m, "tpcost", ConstantDataArray::getString(m.getContext(), function.description), used);
    cast<GlobalVariable>(used.back())->setAlignment(Align(1));
    cast<GlobalVariable>(used.back())->setConstant(true);
  }
  if (!unit.options.library && !unit.options.weak)
    for (const auto& lines : {inlined_functions(m), of_program})
      for (const std::string& line : lines) {
        add_to_section(m, "tpcost", ConstantDataArray::getString(m.getContext(), line), used);
        cast<GlobalVariable>(used.back())->setAlignment(Align(1));
        cast<GlobalVariable>(used.back())->setConstant(true);
      }
  for (auto& [before, cycles] : plan.charges)
    if (std::llround(cycles) != 0) charge(m, before, std::llround(cycles));
  if (unit.options.coverage)
    for (const auto& function : plan.functions) count_lines(*function.function, used);
  if (!used.empty()) appendToCompilerUsed(m, used);
}

}  // namespace cc
