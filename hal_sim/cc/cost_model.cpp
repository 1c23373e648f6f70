// SPDX-License-Identifier: MIT
// The chip's compiler in caricature: for each LLVM instruction, which dsPIC instructions XC16 would emit.
#include "cost_model.h"

#include <map>

#include "cost_flow.h"
#include "cost_operations.h"
#include "cost_values.h"

#include "llvm/ADT/SmallPtrSet.h"
#include "llvm/Analysis/ScalarEvolutionExpressions.h"
#include "llvm/Analysis/ValueTracking.h"
#include "llvm/IR/CFG.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/IR/Operator.h"
#include "passes.h"
#include "shared_variables.h"

namespace cc {

using namespace llvm;

double Segment::own() const {
  double sum = 0;
  for (int r = 0; r < kRuleCount; ++r) sum += features[r] * kRuleCycles[r];
  return sum;
}
double Segment::cycles() const { return own() + library; }

bool is_handler(const Function& f) { return is_handler_name(f.getName()); }

namespace {

class Model {
 public:
  Model(Function& f, FunctionAnalysisManager& analyses, int level)
      : f_(f),
        loops_(analyses.getResult<LoopAnalysis>(f)),
        se_(analyses.getResult<ScalarEvolutionAnalysis>(f)),
        level_(level),
        flow_(f, loops_, words_of, holds_register) {}

  void run(std::vector<Segment>& out);

 private:
  double context_saved() const;
  void instruction(Instruction& i, Segment& s);
  void terminator(BasicBlock& block, Segment& s);
  void address(Value* pointer, Segment& s, bool is_word);
  void constant_operand(Value* v, Segment& s, bool compare = false);
  void register_operation(const BinaryOperator& op, Segment& s);
  void float_operation(Instruction& i, Segment& s, double library);
  void call(CallBase& call, Segment& s);
  void live_words();
  bool clobbers(const Instruction& i) const;
  bool is_folded_load(const LoadInst& load) const;
  bool updates_memory(const StoreInst& store) const;
  bool is_unrolled(const Loop* loop);
  bool counts_down(const ICmpInst& compare);
  bool sets_flags(const Value* v, const ICmpInst& at) const;
  int words(const Value* v) const { return is_register_word(v) ? 1 : words_of(v); }
  bool is_register_word(const Value* v) const { return level_ > 0 && is_register_value(v); }
  bool in_loop(const Instruction& i) const { return loops_.getLoopFor(i.getParent()) != nullptr; }

  Function& f_;
  LoopInfo& loops_;
  ScalarEvolution& se_;
  int level_;  // above 0 registers are words, and not 64 bits wide, as the host has them
  CostFlow flow_;
  const Value* last_result_ = nullptr;  // what lies in w0.. after the last library call
  bool no_call_yet_ = true;             // arguments are still where the caller put them
  int live_words_ = 0;                  // most values at once
  int saved_words_ = 0;                 // w8..w14 and stack words that calls must not destroy
  std::map<const Loop*, bool> unrolled_;
  SmallPtrSet<const Value*, 16> kept_;                 // values that live across a call
  SmallPtrSet<const Instruction*, 8> needs_constant_;  // writes that take one of w0 with them
  SmallPtrSet<const Instruction*, 16> in_place_;       // loads and operations merged into a memory operation
};

void Model::constant_operand(Value* v, Segment& s, bool) {
  auto* c = dyn_cast<ConstantInt>(v);
  if (!c || c->getBitWidth() > 32) return;
  int64_t value = c->getSExtValue();
  Rule rule = in_loop(*s.first) ? k_wide_constant_loop : k_wide_constant;
  bool wide = false;
  for (int w = 0; w < words(v); ++w) {
    int64_t part = (value >> (16 * w)) & 0xffff;
    wide |= part > 31 && part < 0xffe1;
  }
  if (wide) s.features[rule] += words(v);
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
            auto* table = dyn_cast<GlobalVariable>(getUnderlyingObject(pointer));
            if (table && is_program_memory(*table)) s.features[k_constant_memory] += 1;
            if (!is_unrolled(loop)) s.features[k_walk] += 1;
            return;
          }
      if (loop && all_of(gep->indices(), [&](const Value* v) {
            return is_induction(v, *loop) || loop->isLoopInvariant(v);
          })) {
        if (auto* table = dyn_cast<GlobalVariable>(base); table && is_program_memory(*table))
          s.features[k_constant_memory] += 1;
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
    if (is_program_memory(*g)) s.features[k_constant_memory] += 1;
    if (!direct || is_program_memory(*g))
      s.features[in_loop(*s.first) ? k_address_loop : k_address] += 1;
    else if (!is_word)
      s.features[k_global_byte] += 1;
  }
}

/// A call of the compiler's library: operands go to w0.., the result comes back in w0..
void Model::float_operation(Instruction& i, Segment& s, double library) {
  s.features[k_float_call] += 1;
  int place = 0;
  bool commutes = i.getOpcode() == Instruction::FAdd || i.getOpcode() == Instruction::FMul;
  bool previous_used = false;
  for (Value* v : i.operands()) {
    if (isa<Function>(v)) continue;
    if (i.getType()->isIntegerTy(64)) v = undo_widening(v);
    int w = type_words(v->getType());
    auto* argument = dyn_cast<Argument>(v);
    int at = 0;
    if (argument)
      for (unsigned n = 0; n < argument->getArgNo(); ++n) at += type_words(f_.getArg(n)->getType());
    bool there = (argument && no_call_yet_ && at == place) ||
                 (last_result_ == v && (place == 0 || commutes) && !previous_used);
    if (last_result_ == v) previous_used = true;
    auto* load = dyn_cast<LoadInst>(v);
    if (load && load->hasOneUse() && load->getParent() == i.getParent()) there = true;  // loaded into place
    if (!there) s.features[isa<Constant>(v) ? k_float_constant : k_float_word] += w;
    place += w;
  }
  no_call_yet_ = false;
  last_result_ = &i;
  if (kept_.count(&i)) s.features[k_kept_word] += type_words(i.getType());
  s.library +=
      library * (i.getType()->isDoubleTy() || i.getOperand(0)->getType()->isDoubleTy() ? kDoubleFactor : 1);
}

/// Destroys w0..w7: a call of a function or of the compiler's library.
bool Model::clobbers(const Instruction& i) const {
  if (isa<FCmpInst>(i) || is_long_division(&i) || isa<SIToFPInst>(i) || isa<UIToFPInst>(i)) return true;
  if (isa<BinaryOperator>(i) && i.getType()->isFloatingPointTy()) return true;
  auto* c = dyn_cast<CallBase>(&i);
  if (!c || is_free(i)) return false;
  if (auto* intrinsic = dyn_cast<IntrinsicInst>(c))
    return intrinsic->getIntrinsicID() == Intrinsic::fptosi_sat ||
           intrinsic->getIntrinsicID() == Intrinsic::fptoui_sat;
  auto* callee = c->getCalledFunction();
  return !callee ||
         !(callee->getName() == kNop || callee->getName() == kRound || callee->getName().startswith("tp_"));
}

/// Which registers survive calls: how many words live across one, or more than eight at once.
void Model::live_words() {
  int most_across = 0, most = 0;
  for (BasicBlock& block : f_) {
    CostFlow::Values live = flow_.live_out(&block);
    for (Instruction& i : reverse(block)) {
      live.erase(&i);
      if (isa<PHINode>(i)) continue;
      int sum = 0;
      bool call = clobbers(i);
      for (const Value* v : live) {
        // a widened number is kept narrow and widened again
        auto* wide = dyn_cast<CastInst>(v);
        bool narrow =
            wide && (isa<SExtInst>(wide) || isa<ZExtInst>(wide)) && !live.count(wide->getOperand(0));
        if (narrow) v = wide->getOperand(0);
        sum += words(v);
        if (call) kept_.insert(v);
      }
      if (call) most_across = std::max(most_across, sum);
      most = std::max(most, sum);
      for (Value* v : i.operands())
        if ((isa<Argument>(v) || isa<Instruction>(v)) && holds_register(v)) live.insert(v);
    }
  }
  live_words_ = most;
  saved_words_ = std::max(most_across, most - 8);
}

/// add [w1],w0,w0: the load costs nothing of its own.
bool Model::is_folded_load(const LoadInst& load) const {
  if (level_ == 0 || !load.hasOneUse() || load.isVolatile() || words(&load) != 1 ||
      !load.getType()->isIntegerTy(16))
    return false;
  auto* user = dyn_cast<BinaryOperator>(load.user_back());
  if (!user || user->getParent() != load.getParent() || user->getOpcode() == Instruction::Mul ||
      user->isIntDivRem() || user->isShift())
    return false;
  const Value* pointer = load.getPointerOperand();
  if (isa<GlobalVariable>(pointer->stripPointerCasts())) return false;
  auto* gep = dyn_cast<GEPOperator>(pointer);
  return !gep || !gep->hasAllConstantIndices();
}

/// count++, sum += x on a global word: one or two instructions in memory.
bool Model::updates_memory(const StoreInst& store) const {
  auto* op = dyn_cast<BinaryOperator>(store.getValueOperand());
  if (!op || !op->hasOneUse() || op->getOpcode() == Instruction::Mul || op->isShift() || op->isIntDivRem())
    return false;
  if (words(op) != 1 || !isa<GlobalVariable>(store.getPointerOperand()->stripPointerCasts())) return false;
  auto* load = dyn_cast<LoadInst>(op->getOperand(0));
  return load && load->hasOneUse() && load->getParent() == store.getParent() &&
         load->getPointerOperand() == store.getPointerOperand();
}

/// gcc unrolls a loop of few rounds completely when the code does not grow by it: the counting goes away.
bool Model::is_unrolled(const Loop* loop) {
  if (level_ == 0 || !loop || !loop->getSubLoops().empty() || !loop->getLoopLatch()) return false;
  auto known = unrolled_.find(loop);
  if (known != unrolled_.end()) return known->second;
  unsigned rounds = se_.getSmallConstantTripCount(loop);
  double size = 0;
  for (BasicBlock* block : loop->blocks())
    for (Instruction& i : *block)
      if (!isa<PHINode>(i) && !isa<DbgInfoIntrinsic>(i) && !isa<CastInst>(i) && !is_free(i) &&
          !calls(i, kRound))
        size += 1;
  // counter, comparison and branch vanish; gcc takes two thirds of the copies to survive its clean-up
  return unrolled_[loop] = rounds > 0 && rounds <= 16 && rounds * (size - 3) * 2 / 3 <= size;
}

/// A counter that serves nothing but a known number of rounds is turned round: dec sets the flags.
bool Model::counts_down(const ICmpInst& compare) {
  Loop* loop = loops_.getLoopFor(compare.getParent());
  if (level_ == 0 || !loop || loop->getLoopLatch() != compare.getParent() ||
      se_.getSmallConstantTripCount(loop) == 0)
    return false;
  auto* step = dyn_cast<BinaryOperator>(compare.getOperand(0));
  auto* counter = step ? dyn_cast<PHINode>(step->getOperand(0)) : nullptr;
  if (!counter || words(counter) != 1) return false;
  auto only = [&](const Value* v) {
    return all_of(v->users(), [&](const User* u) { return u == step || u == counter || u == &compare; });
  };
  return only(step) && only(counter);
}

/// The instruction before left the flags of v == 0 and v < 0.
bool Model::sets_flags(const Value* v, const ICmpInst& at) const {
  auto* op = dyn_cast<BinaryOperator>(v);
  if (!op || level_ == 0 || op->getType()->isFloatingPointTy() || op->getOpcode() == Instruction::Mul ||
      op->isIntDivRem())
    return false;
  // of a long: the carry's half of an addition leaves Z set only if both halves are 0
  const bool is_sum = op->getOpcode() == Instruction::Add || op->getOpcode() == Instruction::Sub;
  if (words(op) != 1 && !(words(op) == 2 && is_sum && at.isEquality())) return false;
  if (!at.isEquality() && at.getPredicate() != CmpInst::ICMP_SLT && at.getPredicate() != CmpInst::ICMP_SGE)
    return false;
  const Instruction* before = at.getPrevNode();
  while (before && (isa<DbgInfoIntrinsic>(before) || calls(*before, kRound) || is_free(*before) ||
                    is_byte_wrap(*before) || isa<GetElementPtrInst>(before) || isa<CastInst>(before)))
    before = before->getPrevNode();
  return before == op;
}

/// What becomes of a register's content, word by word.
void Model::register_operation(const BinaryOperator& op, Segment& s) {
  if (in_place_.count(&op) || without_word_mask(&op) != &op) return;
  if (op.isShift()) {
    s.features[k_shift16] += 1;
    return;
  }
  auto* c = dyn_cast<ConstantInt>(op.getOperand(1));
  // btst, btss: the bit of a register is tested where it lies
  if (op.getOpcode() == Instruction::And && c && op.hasOneUse() && is_single_bit(c, false) &&
      isa<CallBase>(without_word_mask(op.getOperand(0))))
    if (auto* compare = dyn_cast<ICmpInst>(op.user_back()); compare && compare->isEquality()) return;
  s.features[k_alu] += 1;
  if (!c) return;
  const uint64_t word = c->getZExtValue() & 0xFFFF;
  const bool is_bit = op.isBitwiseLogicOp() && is_single_bit(c, op.getOpcode() == Instruction::And);
  if (word > 31 && !is_bit) s.features[in_loop(op) ? k_wide_constant_loop : k_wide_constant] += 1;
}

void Model::call(CallBase& c, Segment& s) {
  if (calls(c, kRound)) return;
  if (calls(c, kNop)) {
    s.features[k_nop] += 1;
    return;
  }
  Function* callee = c.getCalledFunction();
  if (auto* intrinsic = dyn_cast<IntrinsicInst>(&c)) {
    switch (intrinsic->getIntrinsicID()) {
      case Intrinsic::fptosi_sat:
      case Intrinsic::fptoui_sat:
        return float_operation(c, s, kFloatToInt);
      case Intrinsic::fmuladd:
        float_operation(c, s, kFloatMul + kFloatAdd);
        return;
      case Intrinsic::smin:
      case Intrinsic::smax:
      case Intrinsic::umin:
      case Intrinsic::umax:
        s.features[k_compare] += words(&c);
        s.features[k_select] += 1;
        s.features[k_select_word] += words(&c) - 1;
        constant_operand(c.getArgOperand(1), s);
        return;
      case Intrinsic::minnum:
      case Intrinsic::maxnum:
        float_operation(c, s, kFloatCompare);
        s.features[k_compare] += 1;
        s.features[k_select] += 1;
        return;
      default:
        charge_intrinsic(*intrinsic, s.features, s.library);
        // of a saturating or checked sum
        if (isa<BinaryOpIntrinsic>(intrinsic)) constant_operand(c.getArgOperand(1), s);
        return;
    }
  }
  if (callee && (callee->getName().startswith("__ubsan") || callee->getName() == "tp_delay")) return;
  if (calls(c, "tp_sfr_read") && in_place_.count(&c)) return;  // part of bset, bclr, btg
  if (callee && callee->getName().startswith("tp_sfr_")) {
    s.features[k_load_word] += 1;
    s.features[k_alu] += double(needs_constant_.count(&c));
    if (level_ > 0 && calls(c, "tp_sfr_write"))
      if (auto* value = dyn_cast<ConstantInt>(c.getArgOperand(1)))  // clr and setm need no constant
        if (const uint64_t word = value->getZExtValue() & 0xFFFF; word != 0 && word != 0xFFFF)
          s.features[in_loop(c) ? k_wide_constant_loop : k_alu] += 1;
    return;
  }
  s.features[k_call] += 1;
  if (!callee) s.features[k_call_indirect] += 1;
  int place = 0;
  for (Value* v : c.args()) {
    auto* argument = dyn_cast<Argument>(v);
    bool there = argument && no_call_yet_ && int(argument->getArgNo()) == place;
    if (auto* phi = dyn_cast<PHINode>(v); phi && place == 0)
      for (Value* incoming : phi->incoming_values()) there = there || incoming == &c;
    if (!there && !(last_result_ == v && place == 0)) s.features[k_argument_word] += type_words(v->getType());
    ++place;
  }
  no_call_yet_ = false;
  last_result_ = &c;
  if (kept_.count(&c)) s.features[k_kept_word] += type_words(c.getType());
}

void Model::instruction(Instruction& i, Segment& s) {
  if (is_free(i) || isa<DbgInfoIntrinsic>(i)) return;
  if (Loop* loop = loops_.getLoopFor(i.getParent()); loop && is_unrolled(loop)) {
    if (isa<PHINode>(i) || &i == dyn_cast<BranchInst>(loop->getLoopLatch()->getTerminator())->getCondition())
      return;
    if (isa<BinaryOperator>(i) && se_.isSCEVable(i.getType()) && isa<SCEVAddRecExpr>(se_.getSCEV(&i))) return;
  }
  if (level_ > 0 && is_byte_wrap(i)) return;
  int w = words(&i);
  if (auto* gep = dyn_cast<GetElementPtrInst>(&i); gep && steps_alone(*gep)) s.features[k_pointer_step] += 1;
  if (isa<AllocaInst>(i) || isa<GetElementPtrInst>(i) || isa<FreezeInst>(i)) return;
  if (isa<PHINode>(i)) return;
  if (auto* load = dyn_cast<LoadInst>(&i)) {
    bool byte = (load->getType()->isIntegerTy(8) || load->getType()->isIntegerTy(1));
    if (in_place_.count(load)) return;
    auto* table = dyn_cast<GlobalVariable>(getUnderlyingObject(load->getPointerOperand()));
    if (table && is_program_memory(*table) && is_folded_load(*load))
      s.features[k_constant_memory] += 1;  // 2 in all
    if (is_folded_load(*load))
      s.features[k_folded_load] += 1;
    else
      s.features[byte ? k_load_byte : k_load_word] += w;
    address(load->getPointerOperand(), s, w == 1 && !byte);
    return;
  }
  if (auto* store = dyn_cast<StoreInst>(&i)) {
    Value* v = store->getValueOperand();
    if (updates_memory(*store)) return;
    bool byte = (v->getType()->isIntegerTy(8) || v->getType()->isIntegerTy(1));
    s.features[byte ? k_store_byte : k_store_word] += words(v);
    if (isa<Constant>(v)) s.features[k_alu] += words(v);
    address(store->getPointerOperand(), s, words(v) == 1 && !byte);
    return;
  }
  if (auto* op = dyn_cast<BinaryOperator>(&i); op && is_register_word(op)) return register_operation(*op, s);
  if (auto* compare = dyn_cast<ICmpInst>(&i)) {
    if (auto* zero = dyn_cast<Constant>(compare->getOperand(1));
        zero && zero->isNullValue() && compare->isEquality())
      if (auto* op = dyn_cast<BinaryOperator>(compare->getOperand(0)); op && is_register_word(op))
        return;  // and, btst set the flags
    if (level_ > 0 && words(compare->getOperand(0)) == 1 && flow_.ends_range_test(*i.getParent())) {
      s.features[k_alu] += 1;
      return;
    }
    auto* zero = dyn_cast<Constant>(compare->getOperand(1));
    bool by_zero = zero && zero->isNullValue();
    if (counts_down(*compare)) return;
    if (!(by_zero && sets_flags(compare->getOperand(0), *compare))) {
      if (words(compare->getOperand(0)) > 1)
        s.features[by_zero ? k_compare32_zero : k_compare32] += 1;
      else
        s.features[k_compare] += 1;
      constant_operand(compare->getOperand(1), s, true);
    }
    return;
  }
  if (isa<FCmpInst>(i)) {
    float_operation(i, s, kFloatCompare);
    s.features[k_compare] += 1;
    return;
  }
  if (i.getType()->isIntegerTy(1)) {
    // a && b: each further comparison has its own branch
    s.features[k_branch] += 1;
    s.features[k_taken] += 0.5;
    return;
  }
  if (auto* select = dyn_cast<SelectInst>(&i)) {
    bool again = false;  // one branch serves several choices
    for (Instruction* j = i.getPrevNode(); j && !again; j = j->getPrevNode())
      if (auto* other = dyn_cast<SelectInst>(j)) again = other->getCondition() == select->getCondition();
    s.features[again ? k_select_again : k_select] += 1;
    s.features[k_select_word] += w - 1;
    return;
  }
  if (auto* conversion = dyn_cast<CastInst>(&i)) {
    Type* from = conversion->getSrcTy();
    switch (conversion->getOpcode()) {
      case Instruction::SIToFP:
      case Instruction::UIToFP:
        if (from->getScalarSizeInBits() <= 16) s.features[k_extend32] += 1;  // the routine takes a long
        float_operation(i, s, kIntToFloat);
        return;
      case Instruction::SExt:
      case Instruction::ZExt:
        if (is_pointer_arithmetic(&i)) return;
        if (from->isIntegerTy(1)) {
          s.features[k_flag_value] += 1;
          return;
        }
        if (all_of(i.users(), [](const User* u) {
              auto* op = dyn_cast<BinaryOperator>(u);
              return is_narrow_division(u) || (is_long_division(u) && u->getType()->isIntegerTy(64)) ||
                     (op && op->getOpcode() == Instruction::Mul && narrow_operand(op->getOperand(0)) &&
                      narrow_operand(op->getOperand(1)));
            })) {
          if (from->isIntegerTy(8)) s.features[k_extend8] += 1;
          return;
        }
        if (from->isIntegerTy(8)) {
          auto* load = dyn_cast<LoadInst>(conversion->getOperand(0));
          bool merged =
              load && load->hasOneUse() && load->getParent() == i.getParent() && !in_place_.count(load);
          if (!merged) s.features[k_extend8] += 1;  // ze [w1],w2 loads and extends at once
        }
        if (w >= 2) s.features[k_extend32] += 1;
        return;
      default:
        return;
    }
  }
  if (auto* op = dyn_cast<BinaryOperator>(&i)) {
    if (op->getType()->isFloatingPointTy()) {
      double library = 0;
      switch (op->getOpcode()) {
        case Instruction::FAdd:
          library = kFloatAdd;
          break;
        case Instruction::FSub:
          library = kFloatSub;
          break;
        case Instruction::FMul:
          library = kFloatMul;
          break;
        default:
          library = kFloatDiv;
      }
      return float_operation(i, s, library);
    }
    switch (op->getOpcode()) {
      case Instruction::Mul: {
        if (w == 1) {
          s.features[isa<Constant>(op->getOperand(1)) ? k_mul16_constant : k_mul16] += 1;
          return;
        }
        if (w == 2 && narrow_operand(op->getOperand(0)) && narrow_operand(op->getOperand(1)))
          s.features[k_mul_widening] += 1;
        else if (auto* c = dyn_cast<ConstantInt>(op->getOperand(1));
                 c && w == 2 && (c->getValue().countPopulation() <= 2 || (c->getValue() + 1).isPowerOf2())) {
          s.features[k_alu32] += 1;  // shift and add
          s.features[c->getValue().ult(4) ? k_shift32_one : k_shift32] += 1;
        } else
          s.features[k_mul32] += w / 2;
        if (w > 2) s.library += kLongLongMultiply;
        return;
      }
      case Instruction::SDiv:
      case Instruction::UDiv:
      case Instruction::SRem:
      case Instruction::URem:
        if (w == 1 || is_narrow_division(op)) {
          // quotient and remainder come from one division
          for (Instruction* j = op->getPrevNode(); j; j = j->getPrevNode()) {
            auto* other = dyn_cast<BinaryOperator>(j);
            if (other && other->isIntDivRem() && other->getOperand(0) == op->getOperand(0) &&
                other->getOperand(1) == op->getOperand(1) && other != op)
              return;
          }
          s.features[k_div16] += 1;
          if (isa<Constant>(op->getOperand(1)))
            s.features[in_loop(i) ? k_wide_constant_loop : k_wide_constant] += 1;
          return;
        }
        if (auto* by = dyn_cast<ConstantInt>(op->getOperand(1));
            by && w == 2 && by->getValue().isPowerOf2()) {
          // a negative number gets divisor - 1 added before the shift
          bool is_signed = op->getOpcode() == Instruction::SDiv || op->getOpcode() == Instruction::SRem;
          if (is_signed) s.features[k_alu] += 2, s.features[k_alu32] += 1;
          s.features[op->getOpcode() == Instruction::SDiv || op->getOpcode() == Instruction::UDiv
                         ? k_shift32
                         : k_logic32] += 1;
          return;
        }
        float_operation(i, s,
                        w > 2 && undo_widening(op->getOperand(0)) == op->getOperand(0) ? kLongLongDivide
                        : op->getOpcode() == Instruction::SDiv || op->getOpcode() == Instruction::SRem
                            ? kLongDivide
                            : kUnsignedLongDivide);
        return;
      case Instruction::Shl:
      case Instruction::LShr:
      case Instruction::AShr: {
        auto* n = dyn_cast<ConstantInt>(op->getOperand(1));
        if (op->getType()->isIntegerTy(8) && op->getOpcode() != Instruction::Shl) s.features[k_extend8] += 1;
        if (w == 1)
          s.features[k_shift16] += 1;
        else if (!n)
          s.features[k_shift32_count] += 4;
        else if (n->getZExtValue() == 1)
          s.features[k_shift32_one] += 1;
        else if (n->getZExtValue() == 2)
          s.features[k_shift32_one] += 2;
        else if (n->getZExtValue() >= 16)
          s.features[k_shift32_words] += 1;
        else
          s.features[k_shift32] += 1;
        return;
      }
      default:
        if (w == 2)
          s.features[op->isBitwiseLogicOp() ? k_logic32 : k_alu32] += 1;
        else
          s.features[k_alu] += w;
        if (op->getOpcode() == Instruction::And && w == 1)
          if (auto* mask = dyn_cast<ConstantInt>(op->getOperand(1)); mask && mask->equalsInt(255))
            return;  // ze
        if (in_place_.count(&i))
          if (auto* bit = dyn_cast<ConstantInt>(op->getOperand(1)))
            if (op->isBitwiseLogicOp() && (bit->getValue().isPowerOf2() || (~bit->getValue()).isPowerOf2()))
              return;  // bset, bclr, btg
        if (auto* c = dyn_cast<ConstantInt>(op->getOperand(1)); c && in_place_.count(&i) && w == 1) {
          // inc, dec, inc2, dec2 know their constant; add takes it from w0
          if (op->isBitwiseLogicOp() || c->getValue().abs().ugt(2)) s.features[k_alu] += 1;
          return;
        }
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
  if (isa<ReturnInst>(t)) {
    s.features[k_return_] += 1;
  } else if (auto* sw = dyn_cast<SwitchInst>(t)) {
    if (sw->getNumCases() >= 5)
      s.features[k_switch_table] += 1;
    else
      s.features[k_switch_case] += sw->getNumCases() * 0.6 + 0.5;
  }
  Features edges{};
  flow_.charge(block, edges);
  if (auto* ret = dyn_cast<ReturnInst>(t);
      ret && ret->getReturnValue() && isa<PHINode>(ret->getReturnValue())) {
    // calls have driven one of the two out of w0
    if (kept_.count(ret->getReturnValue()))
      edges[k_return_move] = words(ret->getReturnValue());
    else if (!f_.arg_empty() && kept_.count(f_.getArg(0)))
      edges[k_return_move] = 0;
  }
  Loop* around = loops_.getLoopFor(&block);
  if (around && around->getLoopLatch() == &block && is_unrolled(around)) edges = Features{};
  for (int r = 0; r < kRuleCount; ++r) s.features[r] += edges[r];
}

/// Words that a handler without calls saves, against what the host takes for every handler: w0 to w7 and
/// more, which is right for one that calls something.
double Model::context_saved() const {
  int used = 0;
  for (const Instruction& i : instructions(f_)) {
    if (clobbers(i)) return 0;
    const bool is_in_memory =
        in_place_.count(&i) || calls(i, "tp_sfr_write") || isa<DbgInfoIntrinsic>(i) || is_free(i);
    auto* store = dyn_cast<StoreInst>(&i);
    if (!is_in_memory && !(store && updates_memory(*store)) && !i.isTerminator() && !isa<AllocaInst>(i))
      used = 1;
    if (i.isIntDivRem()) return 0;  // RCOUNT and a pair, too
  }
  const int words = used ? std::min(live_words_ + 1, 8) : 0;
  return 2 * words - kHandlerContext;
}

void Model::run(std::vector<Segment>& out) {
  bool entry = true;
  if (level_ > 0) live_words();
  for (Instruction& i : instructions(f_))
    if (auto* store = dyn_cast<StoreInst>(&i))
      if (updates_memory(*store)) {
        auto* op = cast<BinaryOperator>(store->getValueOperand());
        in_place_.insert(op);
        in_place_.insert(cast<LoadInst>(op->getOperand(0)));
      }
  if (level_ > 0) merge_register_changes(f_, in_place_, needs_constant_);
  for (BasicBlock& block : f_) {
    Instruction* begin = &*block.getFirstInsertionPt();
    // local variables stay together at the entry, or the back end would treat them as of unknown size
    while (isa<AllocaInst>(begin)) begin = begin->getNextNode();
    Segment s{begin};
    if (entry) {
      for (Instruction& i : block)
        if (auto* a = dyn_cast<AllocaInst>(&i)) {
          (void)a;
          s.features[k_frame] = 1;
        }
      s.features[k_saved_word] += saved_words_;
      for (Argument& a : f_.args())
        if (kept_.count(&a)) s.features[k_kept_word] += words(&a);
      if (level_ > 0 && is_handler(f_)) s.library += context_saved();
      entry = false;
    }
    bool after_call = false;
    for (Instruction& i : block) {
      bool big = s.cycles() > kSegmentCycles;
      if ((after_call || big) && !isa<PHINode>(i) && !isa<AllocaInst>(i)) {
        out.push_back(s);
        s = Segment{&i};
        after_call = false;
      }
      if (i.isTerminator()) {
        terminator(block, s);
        continue;
      }
      if (level_ > 0 && only_for_select(i)) {
        Segment arm{s.first};
        instruction(i, arm);
        for (int r = 0; r < kRuleCount; ++r) s.features[r] += arm.features[r] * kArmShare;
        s.library += arm.library * kArmShare;
      } else {
        instruction(i, s);
      }
      auto* c = dyn_cast<CallBase>(&i);
      if (c && !isa<IntrinsicInst>(c) && !calls(i, kNop) && !calls(i, kRound) && !changes_register(*c))
        after_call = true;
    }
    out.push_back(s);
  }
}

}  // namespace

FunctionCost::FunctionCost(Function& f, FunctionAnalysisManager& analyses, int level) {
  Model(f, analyses, level).run(segments);
}

}  // namespace cc
