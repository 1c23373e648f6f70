// SPDX-License-Identifier: MIT
// From what C says to what the code generator takes: registers become addresses, notes become attributes,
// small structs are returned in registers, unions without a value are zero.
#include "chip.h"
#include "dspic30/llvm/target.h"
#include "dspic30/memory/irqs.h"
#include "llvm/IR/Constants.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InlineAsm.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/PatternMatch.h"
#include "llvm/Transforms/Utils/ModuleUtils.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

constexpr const char* kNamedByVector = "named-by-vector";

void place_configuration(GlobalVariable& g, StringRef word) {
  g.setSection(word == "fosc" ? ".config@F80000" : ".config@F80002");
  g.setAlignment(Align(2));
  appendToUsed(*g.getParent(), {&g});
}

/// Registers are globals named tp_sfr_XXXX in C (XXXX: the address); here they are the addresses.
void place_registers(Module& m) {
  for (GlobalVariable& g : make_early_inc_range(m.globals())) {
    StringRef name = g.getName();
    unsigned address;
    name.consume_front("\1");
    if (!name.consume_front("tp_sfr_") || name.getAsInteger(16, address)) continue;
    auto* at = ConstantInt::get(Type::getInt16Ty(m.getContext()), address);
    g.replaceAllUsesWith(ConstantExpr::getIntToPtr(at, g.getType()));
    g.eraseFromParent();
  }
}

/// The handler of interrupt(irq(n)) is called as the linker looks for vector n's. Its own name stays beside
/// it, for other files that call the function.
void name_by_vector(Unit& unit, Function& f, bool is_alternate, int irq) {
  Module& m = unit.module;
  const std::string name = (is_alternate ? "_Alt" : "_") + dspic::irq_handler(irq);
  if (f.getName() == name) return;
  if (GlobalValue* known = m.getNamedValue(name)) {
    auto* other = dyn_cast<Function>(known->stripPointerCasts());
    if (other == &f) return;
    if (!known->isDeclaration()) {
      const auto place = [](const Function* g) {
        DISubprogram* of = g ? g->getSubprogram() : nullptr;
        return of ? DebugLoc(DILocation::get(g->getContext(), of->getLine(), 0, of)) : DebugLoc();
      };
      const DebugLoc first = place(other);
      return unit.error(place(&f), f.getName() + "(): got a second handler of interrupt " + Twine(irq) +
                                       ", expected one; the first is " + name + "()" +
                                       (first ? " in line " + Twine(first.getLine()) : Twine()));
    }
    known->replaceAllUsesWith(ConstantExpr::getBitCast(&f, known->getType()));
    known->eraseFromParent();
  }
  if (!f.hasFnAttribute(kNamedByVector)) {
    const std::string own = f.getName().str();
    const bool is_of_file = f.hasLocalLinkage();
    f.setName(name);
    f.setLinkage(GlobalValue::ExternalLinkage);
    f.addFnAttr(kNamedByVector);
    if (!is_of_file) GlobalAlias::create(own, &f);
  } else {
    GlobalAlias::create(name, &f);
  }
}

/// Attributes of functions, which clang has carried as annotations.
void take_notes(Unit& unit) {
  Module& m = unit.module;
  auto* all = m.getGlobalVariable("llvm.global.annotations");
  if (!all) return;
  for (auto& entry : cast<ConstantArray>(all->getInitializer())->operands()) {
    auto* record = cast<ConstantStruct>(entry);
    auto* f = dyn_cast<Function>(record->getOperand(0)->stripPointerCasts());
    const auto [name, value] = note_in(record->getOperand(1)).split('=');
    if (!f || name.empty()) continue;
    f->addFnAttr(name, value);
  }
  all->eraseFromParent();
  std::vector<Function*> handlers;
  for (Function& f : m)
    if (f.hasFnAttribute("interrupt")) handlers.push_back(&f);
  for (Function* handler : handlers) {
    Function& f = *handler;
    for (const bool is_alternate : {false, true})
      if (const auto irq = f.getFnAttribute(is_alternate ? "altirq" : "irq"); irq.isStringAttribute())
        name_by_vector(unit, f, is_alternate, std::stoi(irq.getValueAsString().str()));
    // XC16 takes a handler that says neither for one that reads constants
    if (!f.hasFnAttribute("no_auto_psv")) f.addFnAttr("auto_psv");
    f.addFnAttr(Attribute::NoInline);
  }
}

/// (x & ~bit) | bit is x | bit: what setting a bit-field to a constant is without optimiser, and must be one
/// BSET, or an interrupt between reading and writing changes a flag that is then lost.
void simplify_fields(Module& m) {
  using namespace PatternMatch;
  for (Function& f : m)
    for (Instruction& i : instructions(f)) {
      Value* x;
      const APInt *kept, *set;
      if (match(&i, m_Or(m_And(m_Value(x), m_APInt(kept)), m_APInt(set))) && (*kept | *set).isAllOnes())
        i.setOperand(0, x);
    }
}

/// The part of a union that its first member does not fill is zero, as with gcc.
Constant* without_undefined(Constant* c) {
  if (isa<UndefValue>(c)) return Constant::getNullValue(c->getType());
  if (!isa<ConstantAggregate>(c)) return c;
  SmallVector<Constant*, 8> members;
  bool changed = false;
  for (Use& member : c->operands()) {
    members.push_back(without_undefined(cast<Constant>(member)));
    changed |= members.back() != member;
  }
  if (!changed) return c;
  if (auto* s = dyn_cast<ConstantStruct>(c)) return ConstantStruct::get(s->getType(), members);
  if (auto* a = dyn_cast<ConstantArray>(c)) return ConstantArray::get(a->getType(), members);
  return ConstantVector::get(members);
}

void define_initializers(Module& m) {
  for (GlobalVariable& g : m.globals())
    if (g.hasInitializer()) g.setInitializer(without_undefined(g.getInitializer()));
}

// --- variable arguments

/// clang takes a struct behind "..." for handed over by its address; it lies among the arguments itself, as
/// with XC16. va_arg of a pointer that the program asked for itself is stored at once.
bool is_of_struct(const VAArgInst& va) {
  auto* type = dyn_cast<PointerType>(va.getType());
  if (!type || !type->getPointerElementType()->isAggregateType()) return false;
  return none_of(va.users(), [&](const User* u) {
    auto* store = dyn_cast<StoreInst>(u);
    return store && store->getValueOperand() == &va;
  });
}

/// va_list is the address above the next argument.
void take_structs_from_lists(Module& m) {
  for (Function& f : m)
    for (Instruction& i : make_early_inc_range(instructions(f))) {
      auto* va = dyn_cast<VAArgInst>(&i);
      if (!va || !is_of_struct(*va)) continue;
      IRBuilder<> b(va);
      auto* word = b.getInt8PtrTy();
      Value* list = b.CreateBitCast(va->getPointerOperand(), word->getPointerTo());
      const auto bytes =
          alignTo(m.getDataLayout().getTypeAllocSize(va->getType()->getPointerElementType()), 2);
      Value* at = b.CreateGEP(b.getInt8Ty(), b.CreateLoad(word, list), b.getInt16(-bytes));
      b.CreateStore(at, list);
      va->replaceAllUsesWith(b.CreateBitCast(at, va->getType()));
      va->eraseFromParent();
    }
}

// --- calls that clang makes for an int of 32 bits, or leaves to a library that is not here

/// __builtin_trap() is abort() of the libc, as with gcc.
void call_abort(CallInst& call) {
  IRBuilder<> b(&call);
  b.CreateCall(call.getModule()->getOrInsertFunction("abort", b.getVoidTy()));
  call.eraseFromParent();
}

void reserve_stack(CallInst& call) {
  IRBuilder<> b(&call);
  auto* room = b.CreateAlloca(b.getInt8Ty(), b.CreateZExtOrTrunc(call.getArgOperand(0), b.getInt16Ty()));
  room->setAlignment(Align(2));
  call.replaceAllUsesWith(b.CreateBitOrPointerCast(room, call.getType()));
  call.eraseFromParent();
}

/// The depth of __builtin_frame_address() is an int of C, but a long of the intrinsic function.
void widen_constants(CallInst& call, FunctionType& type) {
  for (unsigned n = 0; n < call.arg_size(); ++n)
    if (auto* c = dyn_cast<ConstantInt>(call.getArgOperand(n)); c && c->getType() != type.getParamType(n))
      call.setArgOperand(n, ConstantInt::get(type.getParamType(n), c->getZExtValue()));
}

void mend_calls(Module& m) {
  for (Function& f : make_early_inc_range(m))
    for (Instruction& i : make_early_inc_range(instructions(f))) {
      auto* call = dyn_cast<CallInst>(&i);
      auto* callee = call ? dyn_cast<Function>(call->getCalledOperand()->stripPointerCasts()) : nullptr;
      if (!callee) continue;
      if (callee->getIntrinsicID() == Intrinsic::trap)
        call_abort(*call);
      else if (callee->isIntrinsic())
        widen_constants(*call, *callee->getFunctionType());
      else if (callee->getName() == "alloca" && callee->isDeclaration() && call->arg_size() == 1)
        reserve_stack(*call);
    }
}

/// What clang has found undefined in a constant is 0 and not what a register happens to hold, as with gcc.
void define_poison(Module& m) {
  for (Function& f : m)
    for (Instruction& i : instructions(f))
      for (Use& operand : i.operands())
        if (isa<PoisonValue>(operand) && !isa<InsertElementInst>(i) && !isa<ShuffleVectorInst>(i))
          operand.set(Constant::getNullValue(operand->getType()));
}

/// A negative number becomes an unsigned one by way of the signed one of its width, an int by way of a long,
/// as by XC16: gcc widens to 32 bits and calls __fixunssfsi, which wraps [gcc 4.5.1: expand_fix(), libgcc2.c;
/// its cost in xc16-cycles/library_cost.csv is that of a comparison and __fixsfsi]. A char is the low byte of
/// an int. For LLVM both are undefined.
void wrap_conversions(Module& m) {
  for (Function& f : m)
    for (Instruction& i : make_early_inc_range(instructions(f))) {
      if (auto* to_char = dyn_cast<FPToSIInst>(&i); to_char && to_char->getType()->isIntegerTy(8)) {
        IRBuilder<> b(to_char);
        to_char->replaceAllUsesWith(
            b.CreateTrunc(b.CreateFPToSI(to_char->getOperand(0), b.getInt32Ty()), to_char->getType()));
        to_char->eraseFromParent();
        continue;
      }
      auto* to_unsigned = dyn_cast<FPToUIInst>(&i);
      if (!to_unsigned) continue;
      IRBuilder<> b(to_unsigned);
      Value* from = to_unsigned->getOperand(0);
      const unsigned bits = to_unsigned->getType()->getIntegerBitWidth();
      Value* made = nullptr;
      if (bits <= 16) {
        made = b.CreateTrunc(b.CreateFPToSI(from, b.getInt32Ty()), to_unsigned->getType());
      } else {
        const std::string name = std::string("__fixuns") + (from->getType()->isFloatTy() ? "sf" : "df") +
                                 (bits == 32 ? "si" : "di");
        auto callee = m.getOrInsertFunction(name, to_unsigned->getType(), from->getType());
        auto* call = b.CreateCall(callee, {from});
        call->setDoesNotAccessMemory();
        call->setDoesNotThrow();
        made = call;
      }
      to_unsigned->replaceAllUsesWith(made);
      to_unsigned->eraseFromParent();
    }
}

// --- structs as arguments

/// For gcc a struct of 4 or 8 bytes is a number of that size, unless an array or a struct in it has a size
/// that no number has. What lies in a union clang does not say.
bool has_odd_member(Type* type, const DataLayout& layout) {
  if (auto* array = dyn_cast<ArrayType>(type)) return has_odd_member(array->getElementType(), layout);
  auto* record = dyn_cast<StructType>(type);
  if (!record || (record->hasName() && record->getName().startswith("union."))) return false;
  return any_of(record->elements(), [&](Type* member) {
    const uint64_t bytes = layout.getTypeAllocSize(member);
    const bool is_number = isPowerOf2_64(bytes) && bytes <= 8;
    return member->isAggregateType() && (!is_number || has_odd_member(member, layout));
  });
}

/// Such structs are marked for whoever gives arguments their registers (dspic30/llvm/calls.cpp).
void mark_structs(Module& m) {
  const auto mark = [&](auto& called) {
    for (unsigned i = 0; i < called.arg_size(); ++i) {
      Type* type = called.getParamByValType(i);
      if (!type || !has_odd_member(type, m.getDataLayout())) continue;
      const bool is_bytes = called.getParamAlign(i).valueOrOne() == 1;
      called.addParamAttr(
          i, Attribute::getWithStackAlignment(m.getContext(), is_bytes ? kDspicOddBytes : kDspicOddStruct));
    }
  };
  for (Function& f : m) {
    if (!f.isIntrinsic()) mark(f);
    for (Instruction& i : instructions(f))
      if (auto* call = dyn_cast<CallBase>(&i)) mark(*call);
  }
}

/// An array of variable length stays where nothing reads it, as with XC16: programs that run several stacks
/// make room between them so.
void keep_dynamic_arrays(Module& m) {
  for (Function& f : m)
    for (BasicBlock& block : f)
      for (Instruction& i : make_early_inc_range(block)) {
        auto* array = dyn_cast<AllocaInst>(&i);
        if (!array || isa<Constant>(array->getArraySize())) continue;
        IRBuilder<> at(array->getNextNode());
        auto* type = FunctionType::get(at.getVoidTy(), {array->getType()}, false);
        at.CreateCall(InlineAsm::get(type, "", "r", /*hasSideEffects=*/true), {array});
      }
}

}  // namespace

/// A char travels in the low byte of its word, and whoever reads it extends it: the function called its
/// arguments, the caller the result, as with XC16. clang has it the other way round.
void leave_upper_bytes_open(Module& m) {
  for (Function& f : m) {
    if (f.isIntrinsic()) continue;
    const auto open = [](auto& called) {
      for (const auto kind : {Attribute::SExt, Attribute::ZExt}) {
        called.removeRetAttr(kind);
        for (unsigned i = 0; i < called.arg_size(); ++i) called.removeParamAttr(i, kind);
      }
    };
    open(f);
    for (Instruction& i : instructions(f))
      if (auto* call = dyn_cast<CallBase>(&i)) open(*call);
  }
}

StringRef note_in(const Value* text) {
  auto* variable = dyn_cast<GlobalVariable>(text->stripPointerCasts());
  auto* bytes = variable ? dyn_cast<ConstantDataArray>(variable->getInitializer()) : nullptr;
  StringRef note = bytes ? bytes->getAsCString() : "";
  return note.consume_front(kNote) ? note : "";
}

/// What clang takes and the chip has nothing for.
void refuse_what_is_missing(Unit& unit) {
  for (Function& f : unit.module)
    for (Instruction& i : instructions(f)) {
      const auto* const call = dyn_cast<IntrinsicInst>(&i);
      const Intrinsic::ID id = call ? call->getIntrinsicID() : Intrinsic::not_intrinsic;
      if (id == Intrinsic::read_register || id == Intrinsic::write_register ||
          id == Intrinsic::read_volatile_register)
        unit.error(i.getDebugLoc(), "got a global variable in a working register, expected one in memory");
      if (isa<AtomicCmpXchgInst>(i) || isa<AtomicRMWInst>(i))
        unit.error(i.getDebugLoc(),
                   "got an atomic operation that reads and writes, expected a plain one between "
                   "__builtin_disi(0x3FFF) and __builtin_disi(0)");
    }
}

bool lower_for_chip(Unit& unit) {
  refuse_what_is_missing(unit);
  if (unit.failed) return false;
  keep_dynamic_arrays(unit.module);
  Module& m = unit.module;
  lower_accumulators(unit);
  if (unit.failed) return false;
  if (const std::string wrong = name_dspic_sections(m); !wrong.empty()) unit.error(DebugLoc(), wrong);
  if (unit.failed) return false;
  take_notes(unit);
  if (unit.failed) return false;
  place_registers(m);
  define_configuration(unit, place_configuration);
  define_initializers(m);
  simplify_fields(m);
  mend_calls(m);
  define_poison(m);
  if (!unit.options.library) wrap_conversions(m);
  leave_upper_bytes_open(m);
  take_structs_from_lists(m);
  mark_structs(m);
  if (!read_shared_in_place(unit)) return false;
  // as XC16: a delay loop waits at -O0 and -O1 and is gone at -O2 and -Os
  if (unit.options.level < 2) keep_empty_loops(m, *Intrinsic::getDeclaration(&m, Intrinsic::sideeffect));
  if (unit.options.level == 0) {
    wait_as_unoptimised(m);
    place_locals_first(m);
  }
  return !unit.failed;
}

}  // namespace cc
