// SPDX-License-Identifier: MIT
// The chip's compiler in caricature: for each LLVM instruction, which dsPIC instructions XC16 would emit.
#include "cost_model.h"

#include "llvm/Analysis/ScalarEvolutionExpressions.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/IR/Operator.h"
#include "passes.h"

namespace cc {

using namespace llvm;

double Segment::own() const {
  double sum = 0;
  for (int r = 0; r < kRuleCount; ++r) sum += features[r] * kRuleCycles[r];
  return sum;
}
double Segment::cycles() const { return own() + library; }

namespace {

class Model {
 public:
  Model(Function& f, FunctionAnalysisManager& analyses, int level)
      : f_(f), loops_(analyses.getResult<LoopAnalysis>(f)), se_(analyses.getResult<ScalarEvolutionAnalysis>(f)),
        level_(level) {}

  void run(std::vector<Segment>& out);

 private:
  void instruction(Instruction& i, Segment& s);
  void terminator(BasicBlock& block, Segment& s);
  void address(Value* pointer, Segment& s, bool is_word);
  void constant_operand(Value* v, Segment& s, bool compare = false);
  void float_operation(Instruction& i, Segment& s, double library);
  void call(CallBase& call, Segment& s);
  int words(const Value* v) const;
  bool in_loop(const Instruction& i) const { return loops_.getLoopFor(i.getParent()) != nullptr; }

  Function& f_;
  LoopInfo& loops_;
  ScalarEvolution& se_;
  int level_;
};

int type_words(Type* t) {
  if (t->isVoidTy()) return 0;
  if (t->isPointerTy() || t->isIntegerTy(1)) return 1;
  if (t->isFloatTy()) return 2;
  if (t->isDoubleTy()) return 4;
  if (auto* i = dyn_cast<IntegerType>(t)) return std::max(1u, (i->getBitWidth() + 15) / 16);
  return std::max<int>(1, int(t->getPrimitiveSizeInBits()) / 16);
}

/// 64-bit numbers that only exist because the PC's pointers are wide.
bool is_pointer_arithmetic(const Value* v) {
  if (!v->getType()->isIntegerTy(64)) return false;
  if (isa<PtrToIntInst>(v)) return true;
  if (auto* cast_from = dyn_cast<CastInst>(v)) {
    if (cast_from->getOperand(0)->getType()->getScalarSizeInBits() > 16) return false;
    for (const User* u : v->users())
      if (isa<GetElementPtrInst>(u)) return true;
  }
  if (auto* op = dyn_cast<BinaryOperator>(v))
    return is_pointer_arithmetic(op->getOperand(0)) || is_pointer_arithmetic(op->getOperand(1));
  return false;
}

int Model::words(const Value* v) const { return is_pointer_arithmetic(v) ? 1 : type_words(v->getType()); }

void Model::constant_operand(Value* v, Segment& s, bool) {
  auto* c = dyn_cast<ConstantInt>(v);
  if (!c || c->getBitWidth() > 32) return;
  int64_t value = c->getSExtValue();
  Rule rule = in_loop(*s.first) ? k_wide_constant_loop : k_wide_constant;
  for (int w = 0; w < words(v); ++w) {
    int64_t part = (value >> (16 * w)) & 0xffff;
    if (part > 31 && part < 0xffe1) s.features[rule] += 1;
  }
}

void Model::address(Value* pointer, Segment& s, bool is_word) {
  auto* gep = dyn_cast<GEPOperator>(pointer);
  Value* base = pointer->stripPointerCasts();
  if (gep) {
    base = gep->getPointerOperand()->stripPointerCasts();
    if (!gep->hasAllConstantIndices()) {
      auto* i = dyn_cast<Instruction>(pointer);
      Loop* loop = i ? loops_.getLoopFor(i->getParent()) : nullptr;
      if (loop && se_.isSCEVable(pointer->getType()))
        if (auto* rec = dyn_cast<SCEVAddRecExpr>(se_.getSCEV(pointer)))
          if (rec->getLoop() == loop) {
            s.features[k_walk] += 1;
            return;
          }
      s.features[k_index] += 1;
      if (f_.getParent()->getDataLayout().getTypeAllocSize(gep->getResultElementType()) > 1)
        s.features[k_index_scale] += 1;
    }
  }
  if (auto* g = dyn_cast<GlobalVariable>(base)) {
    bool direct = !gep || gep->hasAllConstantIndices();
    if (g->isConstant()) s.features[k_constant_memory] += 1;
    if (!direct || g->isConstant()) s.features[k_address] += 1;
    else if (!is_word) s.features[k_global_byte] += 1;
  }
}

void Model::float_operation(Instruction& i, Segment& s, double library) {
  s.features[k_float_call] += 1;
  for (Value* v : i.operands())
    if (!isa<Function>(v)) s.features[k_float_word] += type_words(v->getType());
  s.library += library * (i.getType()->isDoubleTy() || i.getOperand(0)->getType()->isDoubleTy() ? kDoubleFactor : 1);
}

void Model::call(CallBase& c, Segment& s) {
  if (calls(c, kNop)) {
    s.features[k_nop] += 1;
    return;
  }
  Function* callee = c.getCalledFunction();
  if (auto* intrinsic = dyn_cast<IntrinsicInst>(&c)) {
    switch (intrinsic->getIntrinsicID()) {
      case Intrinsic::fptosi_sat:
      case Intrinsic::fptoui_sat: return float_operation(c, s, kFloatToInt);
      case Intrinsic::fabs: s.features[k_alu] += 1; return;
      case Intrinsic::fmuladd: float_operation(c, s, kFloatMul + kFloatAdd); return;
      case Intrinsic::smin: case Intrinsic::smax: case Intrinsic::umin: case Intrinsic::umax:
        s.features[k_compare] += words(&c);
        s.features[k_select] += 1;
        s.features[k_select_word] += words(&c) - 1;
        constant_operand(c.getArgOperand(1), s);
        return;
      case Intrinsic::abs:
        s.features[k_compare] += 1;
        s.features[k_select] += 1;
        s.features[k_alu] += words(&c);
        return;
      case Intrinsic::memcpy: case Intrinsic::memmove: case Intrinsic::memset: {
        auto* n = dyn_cast<ConstantInt>(cast<MemIntrinsic>(c).getLength());
        s.features[k_copy_word] += n ? n->getZExtValue() / 2.0 + 2 : 20;
        return;
      }
      case Intrinsic::bswap: s.features[k_alu] += words(&c); return;
      case Intrinsic::fshl: case Intrinsic::fshr:
        s.features[words(&c) > 1 ? k_shift32 : k_shift16] += words(&c) > 1 ? 1 : 3;
        return;
      default:
        if (intrinsic->getType()->isStructTy()) s.features[k_alu] += type_words(c.getArgOperand(0)->getType());
        return;
    }
  }
  if (callee && (callee->getName().startswith("__ubsan") || callee->getName() == "tp_delay")) return;
  if (callee && callee->getName().startswith("tp_sfr_")) {
    s.features[k_load_word] += 1;
    return;
  }
  s.features[k_call] += 1;
  if (!callee) s.features[k_call_indirect] += 1;
  for (Value* v : c.args()) s.features[k_argument_word] += type_words(v->getType());
}

void Model::instruction(Instruction& i, Segment& s) {
  if (is_free(i) || isa<DbgInfoIntrinsic>(i)) return;
  int w = words(&i);
  if (isa<AllocaInst>(i) || isa<GetElementPtrInst>(i) || isa<FreezeInst>(i)) return;
  if (isa<PHINode>(i)) {
    s.features[k_phi] += w;
    return;
  }
  if (auto* load = dyn_cast<LoadInst>(&i)) {
    bool byte = load->getType()->getScalarSizeInBits() <= 8;
    s.features[byte ? k_load_byte : k_load_word] += w;
    address(load->getPointerOperand(), s, w == 1 && !byte);
    return;
  }
  if (auto* store = dyn_cast<StoreInst>(&i)) {
    Value* v = store->getValueOperand();
    bool byte = v->getType()->getScalarSizeInBits() <= 8;
    s.features[byte ? k_store_byte : k_store_word] += words(v);
    if (isa<Constant>(v)) s.features[k_alu] += words(v);
    address(store->getPointerOperand(), s, words(v) == 1 && !byte);
    return;
  }
  if (auto* compare = dyn_cast<ICmpInst>(&i)) {
    s.features[k_compare] += words(compare->getOperand(0));
    constant_operand(compare->getOperand(1), s, true);
    bool only_branch = true;
    for (User* u : i.users())
      if (!isa<BranchInst>(u) && !isa<SelectInst>(u)) only_branch = false;
    if (!only_branch) s.features[k_flag_value] += 1;
    return;
  }
  if (isa<FCmpInst>(i)) {
    float_operation(i, s, kFloatCompare);
    s.features[k_compare] += 1;
    return;
  }
  if (isa<SelectInst>(i)) {
    s.features[k_select] += 1;
    s.features[k_select_word] += w - 1;
    return;
  }
  if (auto* conversion = dyn_cast<CastInst>(&i)) {
    Type* from = conversion->getSrcTy();
    switch (conversion->getOpcode()) {
      case Instruction::SIToFP: case Instruction::UIToFP: float_operation(i, s, kIntToFloat); return;
      case Instruction::SExt: case Instruction::ZExt:
        if (is_pointer_arithmetic(&i)) return;
        if (from->isIntegerTy(8)) s.features[k_extend8] += 1;
        if (w >= 2) s.features[k_extend32] += 1;
        return;
      default: return;
    }
  }
  if (auto* op = dyn_cast<BinaryOperator>(&i)) {
    if (op->getType()->isFloatingPointTy()) {
      double library = 0;
      switch (op->getOpcode()) {
        case Instruction::FAdd: library = kFloatAdd; break;
        case Instruction::FSub: library = kFloatSub; break;
        case Instruction::FMul: library = kFloatMul; break;
        default: library = kFloatDiv;
      }
      return float_operation(i, s, library);
    }
    switch (op->getOpcode()) {
      case Instruction::Mul: {
        if (w == 1) {
          s.features[isa<Constant>(op->getOperand(1)) ? k_mul16_constant : k_mul16] += 1;
          return;
        }
        auto narrow = [](Value* v) {
          auto* e = dyn_cast<CastInst>(v);
          return (e && e->getSrcTy()->getScalarSizeInBits() <= 16) ||
                 (isa<ConstantInt>(v) && cast<ConstantInt>(v)->getValue().getMinSignedBits() <= 16);
        };
        if (w == 2 && narrow(op->getOperand(0)) && narrow(op->getOperand(1))) s.features[k_mul_widening] += 1;
        else s.features[k_mul32] += w / 2;
        if (w > 2) s.library += kLongLongMultiply;
        return;
      }
      case Instruction::SDiv: case Instruction::UDiv: case Instruction::SRem: case Instruction::URem:
        if (w == 1) {
          s.features[k_div16] += 1;
          constant_operand(op->getOperand(1), s);
          return;
        }
        float_operation(i, s, w > 2 ? kLongLongDivide
                              : op->getOpcode() == Instruction::SDiv || op->getOpcode() == Instruction::SRem
                                  ? kLongDivide : kUnsignedLongDivide);
        return;
      case Instruction::Shl: case Instruction::LShr: case Instruction::AShr: {
        auto* n = dyn_cast<ConstantInt>(op->getOperand(1));
        if (w == 1) s.features[k_shift16] += 1;
        else if (!n) s.features[k_shift32_count] += 4;
        else if (n->getZExtValue() == 1) s.features[k_shift32_one] += 1;
        else if (n->getZExtValue() >= 16) s.features[k_shift32_words] += 1;
        else s.features[k_shift32] += 1;
        return;
      }
      default:
        s.features[k_alu] += w;
        constant_operand(op->getOperand(1), s);
        return;
    }
  }
  if (i.getOpcode() == Instruction::FNeg) {
    s.features[k_alu] += 1;
    return;
  }
  if (auto* c = dyn_cast<CallBase>(&i)) return call(*c, s);
  s.features[k_alu] += w;
}

void Model::terminator(BasicBlock& block, Segment& s) {
  Instruction* t = block.getTerminator();
  BasicBlock* next = block.getNextNode();
  if (isa<ReturnInst>(t)) {
    s.features[k_return_] += 1;
  } else if (auto* br = dyn_cast<BranchInst>(t)) {
    if (br->isUnconditional()) {
      if (br->getSuccessor(0) != next) s.features[k_jump] += 1;
      return;
    }
    if (auto* c = dyn_cast<Instruction>(br->getCondition()))
      if (is_free(*c)) return;
    s.features[k_branch] += 1;
    bool first_next = br->getSuccessor(0) == next;
    BasicBlock* taken = first_next ? br->getSuccessor(1) : br->getSuccessor(0);
    Loop* loop = loops_.getLoopFor(&block);
    if (loop && loop->getHeader() == taken) s.features[k_taken] += 1;
    else if (!taken->getSinglePredecessor()) s.features[k_taken] += 0.5;
  } else if (auto* sw = dyn_cast<SwitchInst>(t)) {
    if (sw->getNumCases() >= 5) s.features[k_switch_table] += 1;
    else s.features[k_switch_case] += sw->getNumCases() * 0.6 + 0.5;
  }
}

void Model::run(std::vector<Segment>& out) {
  bool entry = true;
  for (BasicBlock& block : f_) {
    Instruction* begin = &*block.getFirstInsertionPt();
    Segment s{begin};
    if (entry) {
      for (Instruction& i : block)
        if (auto* a = dyn_cast<AllocaInst>(&i)) {
          (void)a;
          s.features[k_frame] = 1;
        }
      entry = false;
    }
    if (BasicBlock* before = block.getSinglePredecessor())
      if (auto* br = dyn_cast<BranchInst>(before->getTerminator()))
        if (br->isConditional() && before->getNextNode() != &block) s.features[k_taken] += 1;
    bool after_call = false;
    for (Instruction& i : block) {
      bool big = s.cycles() > kSegmentCycles;
      if ((after_call || big) && !isa<PHINode>(i) && !isa<AllocaInst>(i)) {
        if (s.cycles() > 0) out.push_back(s);
        s = Segment{&i};
        after_call = false;
      }
      if (i.isTerminator()) {
        if (!is_free(i)) terminator(block, s);
        continue;
      }
      instruction(i, s);
      auto* c = dyn_cast<CallBase>(&i);
      if (c && !isa<IntrinsicInst>(c) && !calls(i, kNop)) after_call = true;
    }
    if (s.cycles() > 0) out.push_back(s);
  }
}

}  // namespace

FunctionCost::FunctionCost(Function& f, FunctionAnalysisManager& analyses, int level) {
  Model(f, analyses, level).run(segments);
}

}  // namespace cc
