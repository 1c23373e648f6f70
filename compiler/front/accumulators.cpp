// SPDX-License-Identifier: MIT
// The built-in functions of the DSP unit. Its accumulators have 40 bits and no place among C's types: XC16
// lets a program name one, `register int sum asm("A")`, and hands such variables to built-in functions only.
// Each call becomes its one instruction. Operands take the registers that the instruction demands: factors W4
// and W5, X pointer W8, Y pointer W10, write-back W13. What reads or writes an accumulator keeps its place in
// the program, as any assembler text with effects does.
#include "chip.h"
#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InlineAsm.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

/// How a built-in function's arguments are arranged.
struct Form {
  const char* instruction;  // nullptr: no function of the DSP unit
  enum Kind : uint8_t { Both, Add, Load, Clear, Multiply, Distance, Move, Store, Shift } kind;
  bool takes = false;  // the first argument is the accumulator
  bool gives = true;   // the result is an accumulator
};

Form form_of(StringRef name) {
  constexpr Form kNone = {nullptr, Form::Both, false, false};
  if (!name.consume_front("__builtin_")) return kNone;
  return StringSwitch<Form>(name)
      .Case("addab", {"add", Form::Both, true})
      .Case("subab", {"sub", Form::Both, true})
      .Case("add", {"add", Form::Add, true})
      .Case("lac", {"lac", Form::Load})
      .Cases("clr", "clr_prefetch", {"clr", Form::Clear})
      .Case("mac", {"mac", Form::Multiply, true})
      .Case("msc", {"msc", Form::Multiply, true})
      .Case("mpy", {"mpy", Form::Multiply})
      .Case("mpyn", {"mpy.n", Form::Multiply})
      .Case("ed", {"ed", Form::Distance})
      .Case("edac", {"edac", Form::Distance, true})
      .Case("movsac", {"movsac", Form::Move, false, false})
      .Case("sac", {"sac", Form::Store, true, false})
      .Case("sacr", {"sac.r", Form::Store, true, false})
      .Case("sftac", {"sftac", Form::Shift, true})
      .Default(kNone);
}

using Accumulators = DenseMap<Value*, char>;  // what was read from a variable in an accumulator -> 'a' or 'b'

/// One call on its way to an instruction: text and operands grow side by side.
class Translation {
 public:
  Translation(Unit& unit, CallInst& call, const Accumulators& read, char result)
      : unit_(unit), call_(call), read_(read), result_(result), b_(&call) {}

  void write(const Form& form) {
    // Which accumulator it works on, and where its result goes.
    const char taken = form.takes ? accumulator(0) : 0;
    acc_ = form.gives ? result_ : taken;
    if (form.gives && !result_)
      return fail("the result is in an accumulator, so it belongs into one: register int x asm(\"A\")");
    text_ = form.instruction;
    unsigned next = form.takes ? 1 : 0;
    // The instruction's text: operands that may lie anywhere are $0, $1 ..., others have their registers.
    switch (form.kind) {
      case Form::Both: {
        const char other = accumulator(1);
        if (taken == other) fail("both arguments are accumulator " + Twine(name(taken)));
        if (text_ == "sub" && taken != acc_) fail("the result belongs into the first argument's accumulator");
        text_ += std::string(" ") + acc_;
        return finish();
      }
      case Form::Add:
      case Form::Load:
        text_ += " $" + input("r", argument(next)) + ", #" + literal(next + 1, -8, 7) + ", " + acc_;
        return same_as(taken), finish();
      case Form::Store: {
        const std::string shift = literal(1, -8, 7);
        text_ += std::string(" ") + acc_ + ", #" + shift + ", $0";
        outputs_.push_back({"=r", nullptr});
        return finish();
      }
      case Form::Shift:
        text_ += std::string(" ") + acc_ + ", ";
        if (isa<ConstantInt>(argument(1)))
          text_ += "#" + literal(1, -16, 16);
        else
          text_ += "$" + input("r", argument(1));
        return same_as(taken), finish();
      case Form::Clear:
        text_ += std::string(" ") + acc_;
        if (call_.arg_size() != 0) prefetch(next), write_back(next);
        return finish();
      case Form::Move: {
        // the instruction names the accumulator that is not written back
        const char back = is_null(argument(6)) ? 'b' : accumulator(7);
        acc_ = back == 'a' ? 'b' : 'a';
        text_ += std::string(" ") + acc_;
        prefetch(next), write_back(next);
        return finish();
      }
      case Form::Multiply: {
        input("{w4}", argument(next)), input("{w5}", argument(next + 1));
        text_ += std::string(" w4*w5, ") + acc_;
        next += 2;
        prefetch(next);
        if (form.takes) write_back(next);
        return same_as(taken), finish();
      }
      case Form::Distance: {
        input("{w4}", argument(next));
        text_ += std::string(" w4*w4, ") + acc_;
        pointer(argument(next + 1), "w8", literal(next + 2, -6, 6));
        pointer(argument(next + 3), "w10", literal(next + 4, -6, 6));
        result("w4", argument(next + 5));
        return same_as(taken), finish();
      }
    }
  }

 private:
  struct Output {
    std::string constraint;
    Value* to;  // stored there; null: the call's value
  };

  Value* argument(unsigned n) const { return call_.getArgOperand(n); }
  static char name(char accumulator) { return static_cast<char>(toUpper(accumulator)); }
  static bool is_null(const Value* v) { return isa<ConstantPointerNull>(v); }

  void fail(const Twine& what) {
    if (!failed_) unit_.error(call_.getDebugLoc(), Twine(call_.getCalledFunction()->getName()) + ": " + what);
    failed_ = true;
  }
  char accumulator(unsigned n) {
    if (const char a = read_.lookup(argument(n))) return a;
    fail("argument " + Twine(n + 1) + ": expected a variable in an accumulator: register int x asm(\"A\")");
    return 'a';
  }
  /// The instruction changes the accumulator it reads.
  void same_as(char taken) {
    if (taken && taken != acc_)
      fail("reads accumulator " + Twine(name(taken)) + " and writes " + Twine(name(acc_)) +
           "; the instruction has one");
  }
  std::string literal(unsigned n, int least, int most) {
    auto* value = dyn_cast<ConstantInt>(argument(n));
    const int number = value ? static_cast<int>(value->getSExtValue()) : 0;
    const bool steps = least == -6;  // of a pointer
    if (!value)
      fail("argument " + Twine(n + 1) + ": expected a constant");
    else if (number < least || number > most || (steps && number % 2 != 0))
      fail("argument " + Twine(n + 1) + ": got " + Twine(number) + ", expected " + Twine(least) + " to " +
           Twine(most) + (steps ? ", even" : ""));
    return std::to_string(number);
  }

  /// The operand's number in the text of a form without outputs, which are counted first.
  std::string input(const std::string& constraint, Value* value) {
    inputs_.push_back(constraint);
    values_.push_back(value);
    return std::to_string(inputs_.size() - 1);
  }
  void result(const char* reg, Value* to) {
    if (is_null(to)) return fail("a value that is fetched has no place: got a null pointer");
    text_ += std::string(", ") + reg;
    outputs_.push_back({std::string("={") + reg + "}", to});
  }
  void pointer(Value* at, const std::string& reg, const std::string& step) {
    if (is_null(at)) return fail("no address to fetch from: got a null pointer");
    text_ += ", [" + reg + "]";
    if (step[0] == '-') text_ += "-=" + step.substr(1);
    if (step[0] != '-' && step != "0") text_ += "+=" + step;
    Type* type = cast<PointerType>(at->getType())->getPointerElementType();
    input("{" + reg + "}", b_.CreateLoad(type, at));
    outputs_.push_back({"={" + reg + "}", at});
    fetches_ = true;
  }
  /// Pointer, value and step of X, then of Y; a null pointer fetches nothing. `n`: the first; moved behind.
  void prefetch(unsigned& n) {
    for (const auto& [from, to] : {std::pair{"w8", "w4"}, {"w10", "w5"}}) {
      if (!is_null(argument(n))) {
        pointer(argument(n), from, literal(n + 2, -6, 6));
        result(to, argument(n + 1));
      }
      n += 3;
    }
  }
  void write_back(unsigned n) {
    if (is_null(argument(n))) return;
    if (accumulator(n + 1) == acc_) fail("what is written back is the other accumulator");
    result("w13", argument(n));
  }

  void finish() {
    if (failed_) return;
    std::string constraints;
    SmallVector<Type*, 5> types;
    for (const Output& o : outputs_) {
      constraints += o.constraint + ",";
      types.push_back(o.to ? cast<PointerType>(o.to->getType())->getPointerElementType() : b_.getInt16Ty());
    }
    for (const std::string& c : inputs_) constraints += c + ",";
    if (fetches_) constraints += "~{memory},";
    if (!constraints.empty()) constraints.pop_back();
    SmallVector<Type*, 5> value_types;
    for (Value* v : values_) value_types.push_back(v->getType());
    Type* all = types.empty()       ? b_.getVoidTy()
                : types.size() == 1 ? types[0]
                                    : StructType::get(b_.getContext(), types);
    auto* type = FunctionType::get(all, value_types, false);
    CallInst* done =
        b_.CreateCall(type, InlineAsm::get(type, text_, constraints, /*hasSideEffects=*/true), values_);
    for (unsigned n = 0; n < outputs_.size(); ++n) {
      Value* value = types.size() == 1 ? static_cast<Value*>(done) : b_.CreateExtractValue(done, n);
      if (outputs_[n].to)
        b_.CreateStore(value, outputs_[n].to);
      else
        call_.replaceAllUsesWith(value);
    }
  }

  Unit& unit_;
  CallInst& call_;
  const Accumulators& read_;
  const char result_;
  IRBuilder<> b_;
  char acc_ = 'a';
  std::string text_;
  std::vector<std::string> inputs_;
  SmallVector<Value*, 4> values_;
  std::vector<Output> outputs_;
  bool failed_ = false, fetches_ = false;
};

/// Variables of a function that are accumulators, from the front end's annotations, which go.
std::vector<std::pair<AllocaInst*, char>> take_variables(Function& f) {
  std::vector<std::pair<AllocaInst*, char>> found;
  for (Instruction& i : make_early_inc_range(instructions(f))) {
    auto* call = dyn_cast<IntrinsicInst>(&i);
    if (!call || call->getIntrinsicID() != Intrinsic::var_annotation) continue;
    StringRef note = note_in(call->getArgOperand(1));
    auto* variable = dyn_cast<AllocaInst>(call->getArgOperand(0)->stripPointerCasts());
    if (!note.consume_front(kAccumulatorNote) || !variable) continue;
    found.push_back({variable, static_cast<char>(toLower(note[0]))});
    call->eraseFromParent();
  }
  return found;
}

Form form_of_call(const Value* v) {
  auto* call = dyn_cast<CallInst>(v);
  auto* callee = call ? call->getCalledFunction() : nullptr;
  return callee ? form_of(callee->getName()) : form_of("");
}
bool is_call_of_unit(const Value* v) { return form_of_call(v).instruction; }

void lower_in(Function& f, Unit& unit) {
  Accumulators read;
  DenseMap<Value*, char> kept;  // calls whose value is stored to such a variable
  std::vector<Instruction*> gone;
  const auto misused = [&](const Instruction& i, char acc) {
    unit.error(i.getDebugLoc(),
               Twine("accumulator ") + Twine(static_cast<char>(toUpper(acc))) +
                   " is used like a number; only built-in functions of the DSP unit take it, "
                   "__builtin_sac() and __builtin_sacr() give its value");
  };
  // Loads and stores of such a variable say which calls read and give it; anything else is a mistake.
  for (const auto& [variable, acc] : take_variables(f))
    for (User* user : variable->users()) {
      auto* i = cast<Instruction>(user);
      auto* store = dyn_cast<StoreInst>(i);
      const bool is_taken = isa<LoadInst>(i) && all_of(i->users(), is_call_of_unit);
      if (is_taken)
        read[i] = acc;
      else if (store && form_of_call(store->getValueOperand()).gives)
        kept[store->getValueOperand()] = acc;
      else if (!isa<BitCastInst>(i))
        misused(*i, acc);
      if (!isa<BitCastInst>(i)) gone.push_back(i);
    }
  // Then each call becomes its instruction.
  for (Instruction& i : make_early_inc_range(instructions(f))) {
    if (!is_call_of_unit(&i)) continue;
    Translation(unit, cast<CallInst>(i), read, kept.lookup(&i)).write(form_of_call(&i));
    gone.push_back(&i);
  }
  if (unit.failed) return;
  for (Instruction* i : gone) i->dropAllReferences();
  for (Instruction* i : gone) i->eraseFromParent();
}

}  // namespace

void lower_accumulators(Unit& unit) {
  for (Function& f : unit.module) lower_in(f, unit);
}

}  // namespace cc
