// SPDX-License-Identifier: MIT
// From what C says to what the code generator takes: registers become addresses, notes become attributes,
// small structs are returned in registers, unions without a value are zero.
#include "chip.h"
#include "llvm/IR/Constants.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/PatternMatch.h"
#include "llvm/Transforms/Utils/Cloning.h"
#include "llvm/Transforms/Utils/ModuleUtils.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

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

/// Attributes of functions, which clang has carried as annotations.
void take_notes(Module& m) {
  auto* all = m.getGlobalVariable("llvm.global.annotations");
  if (!all) return;
  for (auto& entry : cast<ConstantArray>(all->getInitializer())->operands()) {
    auto* record = cast<ConstantStruct>(entry);
    auto* f = dyn_cast<Function>(record->getOperand(0)->stripPointerCasts());
    auto* text = dyn_cast<GlobalVariable>(record->getOperand(1)->stripPointerCasts());
    auto* bytes = f && text ? dyn_cast<ConstantDataArray>(text->getInitializer()) : nullptr;
    StringRef note = bytes ? bytes->getAsCString() : "";
    if (!note.consume_front(kFunctionNote)) continue;
    const auto [name, value] = note.split('=');
    f->addFnAttr(name, value);
  }
  all->eraseFromParent();
  for (Function& f : m) {
    if (!f.hasFnAttribute("interrupt")) continue;
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

// --- a struct of up to 8 bytes comes back in W0 to W3. clang hands every struct over by an address it gets
// first
// ("sret"); of such functions a twin is made that returns words, and callers store them.

constexpr uint64_t kLargestInRegisters = 8;

/// The words a struct result takes, or null when it goes through memory.
Type* words_of(const Function& f, const DataLayout& layout) {
  if (f.arg_empty() || !f.hasStructRetAttr() || f.isIntrinsic()) return nullptr;
  const uint64_t bytes = layout.getTypeAllocSize(f.getParamStructRetType(0));
  if (bytes == 0 || bytes > kLargestInRegisters) return nullptr;
  return ArrayType::get(Type::getInt16Ty(f.getContext()), (bytes + 1) / 2);
}

AttributeList without_first(const AttributeList& from, LLVMContext& context, unsigned parameters) {
  SmallVector<AttributeSet, 8> rest;
  for (unsigned i = 1; i < parameters; ++i) rest.push_back(from.getParamAttrs(i));
  return AttributeList::get(context, from.getFnAttrs(), AttributeSet(), rest);
}

/// In the entry of `f`: room for the words, whose address serves as the struct's.
AllocaInst* make_room(Function& f, Type* words) {
  IRBuilder<> b(&*f.getEntryBlock().getFirstInsertionPt());
  return b.CreateAlloca(words);
}

void return_words(Function& twin, Function& old, Type* words) {
  ValueToValueMapTy map;
  auto* entry = BasicBlock::Create(old.getContext(), "result", &twin);
  IRBuilder<> b(entry);
  auto* room = b.CreateAlloca(words);
  map[old.getArg(0)] = b.CreateBitCast(room, old.getArg(0)->getType());
  for (unsigned i = 1; i < old.arg_size(); ++i) {
    map[old.getArg(i)] = twin.getArg(i - 1);
    twin.getArg(i - 1)->setName(old.getArg(i)->getName());
  }
  SmallVector<ReturnInst*, 4> returns;
  CloneFunctionInto(&twin, &old, map, CloneFunctionChangeType::LocalChangesOnly, returns);
  b.CreateBr(cast<BasicBlock>(map[&old.getEntryBlock()]));
  for (ReturnInst* r : returns) {
    IRBuilder<> at(r);
    at.CreateRet(at.CreateLoad(words, room));
    r->eraseFromParent();
  }
}

/// A call that hands over room for the result becomes one that gets words and stores them.
void call_for_words(CallBase& call, FunctionType* type, Value* callee, Type* words) {
  IRBuilder<> b(&call);
  SmallVector<Value*, 8> arguments(std::next(call.arg_begin()), call.arg_end());
  auto* made = b.CreateCall(type, callee, arguments);
  made->setAttributes(without_first(call.getAttributes(), call.getContext(), call.arg_size()));
  made->setDebugLoc(call.getDebugLoc());
  // the room may be smaller than the words by a byte: a copy of its own, then just the struct
  Value* to = call.getArgOperand(0);
  const auto& layout = call.getModule()->getDataLayout();
  const uint64_t bytes = layout.getTypeAllocSize(call.getParamAttr(0, Attribute::StructRet).getValueAsType());
  auto* room = make_room(*call.getFunction(), words);
  b.CreateStore(made, room);
  b.CreateMemCpy(to, call.getParamAlign(0), room, Align(2), bytes);
  call.eraseFromParent();
}

FunctionType* type_with_words(FunctionType* old, Type* words) {
  return FunctionType::get(words, old->params().drop_front(), old->isVarArg());
}

void return_small_structs(Module& m) {
  const DataLayout& layout = m.getDataLayout();
  for (Function& f : make_early_inc_range(m)) {
    Type* words = words_of(f, layout);
    if (!words) continue;
    auto* type = type_with_words(f.getFunctionType(), words);
    auto* twin = Function::Create(type, f.getLinkage(), f.getAddressSpace(), "", &m);
    twin->takeName(&f);
    if (!f.isDeclaration()) return_words(*twin, f, words);
    twin->setAttributes(without_first(f.getAttributes(), m.getContext(), f.arg_size()));
    f.replaceAllUsesWith(ConstantExpr::getBitCast(twin, f.getType()));
    f.eraseFromParent();
  }
  // by the call's own type: that finds calls through pointers as well
  for (Function& f : m)
    for (Instruction& i : make_early_inc_range(instructions(f))) {
      auto* call = dyn_cast<CallBase>(&i);
      if (!call || call->arg_empty() || !call->hasStructRetAttr() || isa<IntrinsicInst>(call)) continue;
      const uint64_t bytes =
          layout.getTypeAllocSize(call->getParamAttr(0, Attribute::StructRet).getValueAsType());
      if (bytes == 0 || bytes > kLargestInRegisters) continue;
      Type* words = ArrayType::get(Type::getInt16Ty(m.getContext()), (bytes + 1) / 2);
      auto* type = type_with_words(call->getFunctionType(), words);
      Value* callee = call->getCalledOperand()->stripPointerCasts();
      if (callee->getType() != type->getPointerTo()) {
        IRBuilder<> b(call);
        callee = b.CreateBitCast(callee, type->getPointerTo());
      }
      call_for_words(*call, type, callee, words);
    }
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
    if (auto* c = dyn_cast<ConstantInt>(call.getArgOperand(n)))
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

}  // namespace

bool lower_for_chip(Unit& unit) {
  Module& m = unit.module;
  take_notes(m);
  place_registers(m);
  define_configuration(unit, place_configuration);
  define_initializers(m);
  simplify_fields(m);
  mend_calls(m);
  take_structs_from_lists(m);
  return_small_structs(m);
  // as XC16: a delay loop waits at -O0 and -O1 and is gone at -O2 and -Os
  if (unit.options.level < 2) keep_empty_loops(m, *Intrinsic::getDeclaration(&m, Intrinsic::sideeffect));
  return !unit.failed;
}

}  // namespace cc
