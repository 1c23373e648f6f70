// SPDX-License-Identifier: MIT
// First stage after the front end, before any optimiser may reason about the PC's rules: inline assembler by
// its text, functions that no robot has, division by zero, shifts and conversions defined as on the dsPIC.
#include <regex>

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InlineAsm.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/Transforms/Utils/BasicBlockUtils.h"
#include "passes.h"
#include "refused.h"

namespace cc {
namespace {

using namespace llvm;

void refuse_functions(Unit& unit) {
  for (Function& f : unit.module) {
    if (!f.isDeclaration() || f.use_empty()) continue;
    const char* instead = refused_function(f.getName());
    if (!instead) continue;
    for (User* user : f.users()) {
      // a call without prototype goes through a cast of the function
      while (isa<Constant>(user) && !user->use_empty()) user = user->user_back();
      auto* where = dyn_cast<Instruction>(user);
      unit.error(where ? where->getDebugLoc() : DebugLoc(),
                 f.getName() + "(): firmware cannot call it; " + instead);
      break;
    }
  }
}

/// Data of the controller must lie in the image's own data segment, whatever section XC16 was told to use.
void drop_sections(Unit& unit) {
  for (GlobalVariable& g : unit.module.globals())
    if (g.hasSection() && !g.getSection().startswith("tp") && !g.getSection().startswith("llvm."))
      g.setSection("");
  for (Function& f : unit.module)
    if (f.hasSection()) f.setSection("");
}

/// A shift by a constant of 16 or more: 0 or the sign, as the dsPIC's shifter gives, instead of "undefined".
void define_shifts(Unit& unit) {
  for (Function& f : unit.module)
    for (Instruction& i : make_early_inc_range(instructions(f))) {
      auto* shift = dyn_cast<BinaryOperator>(&i);
      if (!shift || !shift->isShift()) continue;
      auto* amount = dyn_cast<ConstantInt>(shift->getOperand(1));
      unsigned width = shift->getType()->getIntegerBitWidth();
      if (!amount || amount->getValue().ult(width)) continue;
      IRBuilder<> b(shift);
      Value* result = shift->getOpcode() == Instruction::AShr
                          ? b.CreateAShr(shift->getOperand(0), ConstantInt::get(shift->getType(), width - 1))
                          : ConstantInt::get(shift->getType(), 0);
      shift->replaceAllUsesWith(result);
      shift->eraseFromParent();
    }
}

/// float -> integer goes through a 32-bit long as the library routine does, and saturates there.
void define_conversions(Unit& unit) {
  for (Function& f : unit.module)
    for (Instruction& i : make_early_inc_range(instructions(f))) {
      auto* cast_to = dyn_cast<CastInst>(&i);
      if (!cast_to ||
          (cast_to->getOpcode() != Instruction::FPToSI && cast_to->getOpcode() != Instruction::FPToUI))
        continue;
      unsigned bits = cast_to->getType()->getIntegerBitWidth();
      bool is_signed = bits < 32 || cast_to->getOpcode() == Instruction::FPToSI;
      IRBuilder<> b(cast_to);
      Type* wide = b.getIntNTy(std::max(bits, 32u));
      auto* convert =
          Intrinsic::getDeclaration(&unit.module, is_signed ? Intrinsic::fptosi_sat : Intrinsic::fptoui_sat,
                                    {wide, cast_to->getOperand(0)->getType()});
      Value* result = b.CreateCall(convert, {cast_to->getOperand(0)});
      if (bits < 32) result = b.CreateTrunc(result, cast_to->getType());
      cast_to->replaceAllUsesWith(result);
      cast_to->eraseFromParent();
    }
}

/// if (divisor == 0) tp_trap(TP_TRAP_MATH), before anybody may conclude that it is not.
void trap_divisions(Unit& unit) {
  std::vector<BinaryOperator*> all;
  for (Function& f : unit.module)
    for (Instruction& i : instructions(f))
      if (auto* op = dyn_cast<BinaryOperator>(&i))
        if (op->isIntDivRem()) {
          auto* by = dyn_cast<ConstantInt>(op->getOperand(1));
          if (!by || by->isZero()) all.push_back(op);
        }
  for (BinaryOperator* op : all) {
    IRBuilder<> b(op);
    auto* zero = cast<Constant>(ConstantInt::get(op->getType(), 0));
    Value* bad = b.CreateICmpEQ(op->getOperand(1), zero);
    if (auto* i = dyn_cast<Instruction>(bad)) mark_free(i);
    Instruction* split = SplitBlockAndInsertIfThen(bad, op, /*Unreachable=*/true);
    b.SetInsertPoint(split);
    b.SetCurrentDebugLocation(op->getDebugLoc());
    auto trap = host_function(unit.module, "tp_trap", b.getVoidTy(), {b.getInt64Ty()});
    auto* call = b.CreateCall(trap, {b.getInt64(1)});
    call->setDoesNotReturn();
    call->setDoesNotThrow();
    mark_free(call);
    if (isa<ConstantInt>(op->getOperand(1))) {
      // never reached, but must not be "poison" either
      op->setOperand(1, ConstantInt::get(op->getType(), 1));
      continue;
    }
    unsigned bits = op->getType()->getIntegerBitWidth();
    if (bits >= 64 || (op->getOpcode() != Instruction::SDiv && op->getOpcode() != Instruction::SRem))
      continue;
    // twice as wide: the one overflow (-32768 / -1) is none there, and truncating wraps it as the chip does
    b.SetInsertPoint(op);
    b.SetCurrentDebugLocation(op->getDebugLoc());
    Type* wide = b.getIntNTy(bits * 2);
    Value* left = b.CreateSExt(op->getOperand(0), wide);
    Value* right = b.CreateSExt(op->getOperand(1), wide);
    Value* result =
        op->getOpcode() == Instruction::SDiv ? b.CreateSDiv(left, right) : b.CreateSRem(left, right);
    op->replaceAllUsesWith(b.CreateTrunc(result, op->getType()));
    op->eraseFromParent();
  }
}

/// memcpy with a 16-bit length: the PC's memcpy takes 64 bits. va_start fills the machine's structure
/// already.
void widen_lengths(Unit& unit) {
  for (Function& f : unit.module)
    for (Instruction& i : make_early_inc_range(instructions(f))) {
      auto* mem = dyn_cast<MemIntrinsic>(&i);
      if (!mem || mem->getLength()->getType()->isIntegerTy(64)) continue;
      IRBuilder<> b(mem);
      Value* length = b.CreateZExt(mem->getLength(), b.getInt64Ty());
      if (auto* copy = dyn_cast<MemCpyInst>(mem))
        b.CreateMemCpy(copy->getDest(), copy->getDestAlign(), copy->getSource(), copy->getSourceAlign(),
                       length, copy->isVolatile());
      else if (auto* move = dyn_cast<MemMoveInst>(mem))
        b.CreateMemMove(move->getDest(), move->getDestAlign(), move->getSource(), move->getSourceAlign(),
                        length, move->isVolatile());
      else if (auto* set = dyn_cast<MemSetInst>(mem))
        b.CreateMemSet(set->getDest(), set->getValue(), length, set->getDestAlign(), set->isVolatile());
      else
        continue;
      mem->eraseFromParent();
    }
}

/// C functions whose symbol the back end also uses, with the PC's widths, get a name of their own.
void rename_for_c(Unit& unit) {
  static const char* const kNames[] = {
      "memcpy", "memset", "memmove", "memcmp",     "bcmp",  "strlen", "floorf", "ceilf",     "fmodf",
      "truncf", "roundf", "rintf",   "nearbyintf", "sqrtf", "powf",   "sinf",   "cosf",      "expf",
      "logf",   "log10f", "exp2f",   "log2f",      "fminf", "fmaxf",  "fabsf",  "copysignf", "ldexpf"};
  for (const char* name : kNames)
    if (Function* f = unit.module.getFunction(name)) f->setName(std::string("tp_c_") + name);
}

/// floor(x) and friends reach us as intrinsics; they are library calls on the robot.
void restore_library_calls(Unit& unit) {
  for (Function& f : unit.module)
    for (Instruction& i : make_early_inc_range(instructions(f))) {
      auto* call = dyn_cast<IntrinsicInst>(&i);
      if (!call || !call->getType()->isFloatTy()) continue;
      const char* name = nullptr;
      switch (call->getIntrinsicID()) {
        case Intrinsic::floor:
          name = "floor";
          break;
        case Intrinsic::ceil:
          name = "ceil";
          break;
        case Intrinsic::trunc:
          name = "trunc";
          break;
        case Intrinsic::round:
          name = "round";
          break;
        case Intrinsic::rint:
        case Intrinsic::nearbyint:
          name = "rint";
          break;
        case Intrinsic::minnum:
          name = "fmin";
          break;
        case Intrinsic::maxnum:
          name = "fmax";
          break;
        case Intrinsic::sqrt:
          name = "sqrt";
          break;
        default:
          continue;
      }
      IRBuilder<> b(call);
      SmallVector<Type*, 2> types;
      SmallVector<Value*, 2> values;
      for (Value* v : call->args()) values.push_back(v), types.push_back(v->getType());
      auto callee = unit.module.getOrInsertFunction(name, FunctionType::get(call->getType(), types, false));
      call->replaceAllUsesWith(b.CreateCall(callee, values));
      call->eraseFromParent();
    }
}

/// A whole variable, local or global.
bool is_variable(const Value* pointer) { return isa<AllocaInst>(pointer) || isa<GlobalVariable>(pointer); }

}  // namespace

void define_configuration(Unit& unit, function_ref<void(GlobalVariable&, StringRef)> dress) {
  for (const auto& [word, value] : unit.facts.configuration) {
    const std::string name = "tp_config_" + word;
    if (unit.module.getNamedGlobal(name)) continue;
    Type* type = Type::getInt16Ty(unit.module.getContext());
    dress(*new GlobalVariable(unit.module, type, true, GlobalValue::WeakAnyLinkage,
                              ConstantInt::get(type, value), name),
          word);
  }
}

void keep_empty_loops(Module& m, Function& mark) {
  for (Function& f : m) {
    if (f.isDeclaration()) continue;
    DominatorTree dom(f);
    LoopInfo loops(dom);
    for (Loop* loop : loops.getLoopsInPreorder()) {
      bool counts_only = loop->getSubLoops().empty() && loop->getLoopLatch();
      for (BasicBlock* block : loop->blocks())
        for (Instruction& i : *block) {
          if (auto* store = dyn_cast<StoreInst>(&i))
            counts_only &= is_variable(store->getPointerOperand()) && !store->isVolatile();
          else if (auto* load = dyn_cast<LoadInst>(&i))
            counts_only &= is_variable(load->getPointerOperand()) && !load->isVolatile();
          else if (isa<CallBase>(i) && !isa<DbgInfoIntrinsic>(i))
            counts_only &= calls(i, kNop);
        }
      if (!counts_only) continue;
      IRBuilder<> b(loop->getLoopLatch()->getTerminator());
      b.CreateCall(&mark);
    }
  }
}

Function* marker(Module& m, const char* name) {
  auto* f = cast<Function>(
      m.getOrInsertFunction(name, FunctionType::get(Type::getVoidTy(m.getContext()), false)).getCallee());
  // touches nothing the program can see, yet must stay where it is
  f->addFnAttr(Attribute::InaccessibleMemOnly);
  f->addFnAttr(Attribute::NoUnwind);
  f->addFnAttr(Attribute::WillReturn);
  return f;
}

void lower_early(Unit& unit) {
  lower_assembler(unit);
  refuse_functions(unit);
  define_configuration(unit,
                       [](GlobalVariable& g, StringRef) { g.setVisibility(GlobalValue::HiddenVisibility); });
  drop_sections(unit);
  define_shifts(unit);
  define_conversions(unit);
  restore_library_calls(unit);
  widen_lengths(unit);
  trap_divisions(unit);
  keep_empty_loops(unit.module, *marker(unit.module, kRound));
  rename_for_c(unit);
}

}  // namespace cc
