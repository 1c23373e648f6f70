// SPDX-License-Identifier: MIT
// Loads of variables that an interrupt may change are made where they stand: volatile, before the optimiser
// sees them. What a file does with addresses is told in the lines of shared_variables.h; which loads it is
// about, the build says by --shared=, since handlers may lie in other files. Without it, and at first, the
// file's own handlers count.
#include "chip.h"
#include "compiler/cache/shared_variables.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/ValueTracking.h"
#include "llvm/IR/DebugInfo.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/InlineAsm.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/Support/raw_ostream.h"
#include "output_file.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

class FactWriter {
 public:
  explicit FactWriter(Module& m) : module_(m), out_(text_) {
    for (Function& f : m)
      for (Instruction& i : instructions(f)) {
        numbers_[&i] = unsigned(numbers_.size());
        numbers_are_addresses_ |= isa<PtrToIntInst>(i) || isa<IntToPtrInst>(i);
      }
  }

  std::string write() {
    for (GlobalVariable& g : module_.globals())
      if (g.hasInitializer()) {
        std::set<std::string> found;
        gather(g.getInitializer(), found);
        for (const std::string& node : found) out_ << "S &" << name_of(g) << " " << node << "\n";
      }
    for (Function& f : module_)
      if (!f.isDeclaration()) write(f);
    return out_.str();
  }

  /// The address that a plain load reads, or null.
  static Value* read_by(Instruction& i) {
    if (auto* load = dyn_cast<LoadInst>(&i)) return load->isVolatile() ? nullptr : load->getPointerOperand();
    if (auto* move = dyn_cast<MemTransferInst>(&i))
      return move->isVolatile() ? nullptr : move->getRawSource();
    return nullptr;
  }
  /// Whether an instruction is such a load, through one of these nodes.
  bool reads(Instruction& i, const std::set<std::string>& wanted) {
    Value* pointer = read_by(i);
    if (!pointer || is_private(pointer)) return false;
    if (wanted.count("*")) return true;
    const std::string f = name_of(*i.getFunction()) + ">";
    const auto found = nodes(pointer);
    return any_of(found, [&](const std::string& n) { return wanted.count(f + n) != 0; });
  }

 private:
  // --- nodes of values

  static std::string name_of(const GlobalValue& g) {
    StringRef name = g.getName();
    name.consume_front("\1");
    return (g.hasLocalLinkage() ? "." : "") + name.str();
  }
  std::string node_of(const Instruction& i) const {
    std::string number = "%" + std::to_string(numbers_.lookup(&i));
    if (!isa<AllocaInst>(i)) return number;
    const auto declared = FindDbgAddrUses(const_cast<Instruction*>(&i));
    return "&" + number + "." + (declared.empty() ? "" : declared.front()->getVariable()->getName().str());
  }

  void gather(Value* v, std::set<std::string>& to) {
    if (auto* alias = dyn_cast<GlobalAlias>(v)) v = alias->getAliasee()->stripPointerCasts();
    auto* variable = dyn_cast<GlobalVariable>(v);
    // nobody writes constants; those that hold addresses are asked for them
    if (variable && variable->isConstant() &&
        (!variable->hasInitializer() || isa<ConstantData>(variable->getInitializer())))
      return;
    if (auto* g = dyn_cast<GlobalValue>(v))
      to.insert("&" + name_of(*g));
    else if (auto* a = dyn_cast<Argument>(v))
      to.insert(name_of(*a->getParent()) + "^" + std::to_string(a->getArgNo()));
    else if (auto* i = dyn_cast<Instruction>(v))
      to.insert(node_of(*i));
    else if (auto* c = dyn_cast<Constant>(v))
      for (Use& operand : c->operands()) gather(operand, to);
  }
  bool may_be_address(const Type* type) const {
    return !type->isVoidTy() && !type->isFloatTy() && (numbers_are_addresses_ || !type->isIntegerTy());
  }
  std::set<std::string> nodes(Value* v) {
    std::set<std::string> found;
    if (may_be_address(v->getType()) || isa<ConstantExpr>(v)) gather(v, found);
    return found;
  }
  /// One node for a value that may be one of several.
  std::string node(Value* v) {
    const auto found = nodes(v);
    if (found.empty()) return "-";
    if (found.size() == 1) return *found.begin();
    std::string made = "%c" + std::to_string(made_++);
    for (const std::string& n : found) out_ << "C " << made << " " << n << "\n";
    return made;
  }

  // --- instructions

  void write(Function& f) {
    const bool is_handler =
        f.hasFnAttribute("interrupt") || (!f.hasLocalLinkage() && is_handler_name(f.getName()));
    out_ << "F " << name_of(f) << " " << (is_handler ? "h" : "") << (f.isVarArg() ? "v" : "") << "-\n";
    dominators_.recalculate(f);
    loops_.releaseMemory();
    loops_.analyze(dominators_);
    for (Instruction& i : instructions(f)) write(i, name_of(f));
  }

  void copies(Instruction& to, Value* from) {
    if (!may_be_address(to.getType())) return;
    for (const std::string& n : nodes(from)) out_ << "C " << node_of(to) << " " << n << "\n";
  }
  void writes(const std::string& f, Value* pointer) {
    if (is_private(pointer)) return;
    for (const std::string& n : nodes(pointer)) out_ << "W " << f << " " << n << "\n";
  }

  void write(Instruction& i, const std::string& f) {
    if (isa<DbgInfoIntrinsic>(i)) return;
    // What becomes of addresses: copies (C), loads (L), stores (S), and what the function writes (W).
    if (auto* load = dyn_cast<LoadInst>(&i)) {
      if (may_be_address(load->getType()))
        for (const std::string& n : nodes(load->getPointerOperand()))
          out_ << "L " << node_of(i) << " " << n << "\n";
    } else if (auto* store = dyn_cast<StoreInst>(&i)) {
      for (const std::string& to : nodes(store->getPointerOperand()))
        for (const std::string& n : nodes(store->getValueOperand())) out_ << "S " << to << " " << n << "\n";
      writes(f, store->getPointerOperand());
    } else if (auto* move = dyn_cast<MemTransferInst>(&i)) {
      const std::string between = "%m" + std::to_string(numbers_.lookup(&i));
      for (const std::string& n : nodes(move->getRawSource())) out_ << "L " << between << " " << n << "\n";
      for (const std::string& n : nodes(move->getRawDest())) out_ << "S " << n << " " << between << "\n";
      writes(f, move->getRawDest());
    } else if (auto* fill = dyn_cast<MemSetInst>(&i)) {
      writes(f, fill->getRawDest());
    } else if (auto* give = dyn_cast<ReturnInst>(&i)) {
      if (give->getReturnValue())
        for (const std::string& n : nodes(give->getReturnValue())) out_ << "C " << f << "^r " << n << "\n";
    } else if (auto* rest = dyn_cast<VAArgInst>(&i)) {
      out_ << "C " << node_of(*rest) << " " << f << "^v\n";
    } else if (auto* call = dyn_cast<CallBase>(&i)) {
      write_call(*call, f);
    } else if (auto* element = dyn_cast<GetElementPtrInst>(&i)) {
      copies(i, element->getPointerOperand());
    } else if (!isa<AllocaInst>(i) && !isa<CmpInst>(i)) {
      for (Use& operand : i.operands())
        if (!isa<BasicBlock>(operand)) copies(i, operand);
    }
    // What it reads (R), and whether once is enough.
    if (Value* pointer = read_by(i); pointer && !is_private(pointer))
      for (const std::string& n : nodes(pointer))
        out_ << "R " << f << " " << n << " " << (may_be_once(i) ? 1 : 0) << " " << place(i) << "\n";
  }

  void write_call(CallBase& call, const std::string& f) {
    if (auto* text = dyn_cast<InlineAsm>(call.getCalledOperand())) return write_assembler(call, *text, f);
    if (isa<IntrinsicInst>(call)) return;
    const std::string callee = node(call.getCalledOperand());
    if (callee == "-") return;
    std::string line = "K " + f + " " + callee + " ";
    line += may_be_address(call.getType()) ? node_of(call) : "-";
    for (Use& argument : call.args()) line += " " + node(argument);
    out_ << line << "\n";
  }

  /// Assembler text may write what its operands point at and what it names: "_flag" is flag.
  void write_assembler(CallBase& call, const InlineAsm& text, const std::string& f) {
    for (Use& argument : call.args()) writes(f, argument);
    const StringRef words = text.getAsmString();
    const auto is_of_name = [](char c) { return isAlnum(c) || c == '_'; };
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] != '_' || (i > 0 && is_of_name(words[i - 1]))) continue;
      const StringRef name = words.drop_front(i + 1).take_while(is_of_name);
      if (GlobalValue* named = module_.getNamedValue(name))
        out_ << "N " << f << " " << name_of(*named) << "\n";
      else if (!name.empty())
        out_ << "N " << f << " " << name << "\n";
      i += name.size();
    }
  }

  /// A variable of a function whose address goes nowhere.
  bool is_private(Value* pointer) {
    auto* variable = dyn_cast<AllocaInst>(getUnderlyingObject(pointer));
    if (!variable) return false;
    const auto [known, is_new] = private_.try_emplace(variable, true);
    if (!is_new) return known->second;
    SmallVector<Value*, 8> todo{variable};
    bool goes_nowhere = true;
    while (goes_nowhere && !todo.empty()) {
      Value* at = todo.pop_back_val();
      for (User* user : at->users()) {
        auto* store = dyn_cast<StoreInst>(user);
        if (isa<LoadInst>(user) || isa<MemIntrinsic>(user) || (store && store->getValueOperand() != at))
          continue;
        if (isa<GetElementPtrInst>(user) || isa<BitCastInst>(user))
          todo.push_back(user);
        else
          goes_nowhere = false;
      }
    }
    return private_[variable] = goes_nowhere;
  }

  // --- reads of which XC16's optimiser may make one

  /// In a loop that waits for it, calls nobody and does not write the variable itself.
  bool may_be_once(Instruction& i) {
    const Loop* loop = loops_.getLoopFor(i.getParent());
    if (!loop || !is_fixed(read_by(i), *loop) || !is_waited_for(i, *loop)) return false;
    const Value* read = getUnderlyingObject(read_by(i));
    for (const BasicBlock* block : loop->blocks())
      for (const Instruction& other : *block) {
        if (auto* store = dyn_cast<StoreInst>(&other)) {
          const Value* written = getUnderlyingObject(store->getPointerOperand());
          if (written == read || (!isa<GlobalVariable>(written) && !isa<AllocaInst>(written) &&
                                  !isa<ConstantExpr>(written) && !isa<ConstantInt>(written)))
            return false;
        } else if (auto* call = dyn_cast<CallBase>(&other)) {
          if (auto* text = dyn_cast<InlineAsm>(call->getCalledOperand())) {
            if (StringRef(text->getConstraintString()).contains("~{memory}")) return false;
          } else if (!isa<IntrinsicInst>(call)) {
            return false;
          }
        }
      }
    return true;
  }

  /// The same place in each round: no index that the loop counts.
  static bool is_fixed(Value* pointer, const Loop& loop) {
    SmallVector<Value*, 8> todo{pointer};
    SmallPtrSet<Value*, 8> seen;
    while (!todo.empty()) {
      Value* v = todo.pop_back_val();
      auto* i = dyn_cast<Instruction>(v);
      if (!i || !loop.contains(i) || !seen.insert(v).second) continue;
      if (isa<PHINode>(i) || isa<CallBase>(i)) return false;
      if (auto* load = dyn_cast<LoadInst>(i); load && is_stored_in(load->getPointerOperand(), loop))
        return false;
      for (Use& operand : i->operands()) todo.push_back(operand);
    }
    return true;
  }
  static bool is_stored_in(const Value* pointer, const Loop& loop) {
    for (const BasicBlock* block : loop.blocks())
      for (const Instruction& i : *block)
        if (auto* store = dyn_cast<StoreInst>(&i); store && store->getPointerOperand() == pointer)
          return true;
    return false;
  }

  /// What is read decides whether the loop ends, or, of one that never does, what it does.
  static bool is_waited_for(Instruction& read, const Loop& loop) {
    SmallVector<Value*, 8> todo{&read};
    SmallPtrSet<Value*, 16> seen;
    while (!todo.empty()) {
      Value* v = todo.pop_back_val();
      if (!seen.insert(v).second) continue;
      if (auto* move = dyn_cast<MemTransferInst>(v)) add_loads_of(move->getRawDest(), loop, todo);
      for (User* user : v->users()) {
        auto* i = dyn_cast<Instruction>(user);
        if (!i || !loop.contains(i)) continue;
        if (auto* store = dyn_cast<StoreInst>(i)) add_loads_of(store->getPointerOperand(), loop, todo);
        if (!i->isTerminator()) {
          todo.push_back(i);
          continue;
        }
        if (loop.hasNoExitBlocks()) return true;
        for (unsigned n = 0; n < i->getNumSuccessors(); ++n) {
          BasicBlock* next = i->getSuccessor(n);
          if (!loop.contains(next)) return true;
          for (PHINode& phi : next->phis()) todo.push_back(&phi);  // a || b, a && b
        }
      }
    }
    return false;
  }
  /// What the loop reads of a variable of the function, by way of which values go without optimiser.
  static void add_loads_of(Value* pointer, const Loop& loop, SmallVectorImpl<Value*>& to) {
    const Value* variable = getUnderlyingObject(pointer);
    if (!isa<AllocaInst>(variable)) return;
    for (BasicBlock* block : loop.blocks())
      for (Instruction& i : *block)
        if (auto* load = dyn_cast<LoadInst>(&i);
            load && getUnderlyingObject(load->getPointerOperand()) == variable)
          to.push_back(load);
  }

  static std::string place(const Instruction& i) {
    const DebugLoc& where = i.getDebugLoc();
    if (!where) return "?";
    return file_of(where) + ":" + std::to_string(where.getLine());
  }

  Module& module_;
  std::string text_;
  raw_string_ostream out_;
  DenseMap<const Instruction*, unsigned> numbers_;
  DenseMap<const AllocaInst*, bool> private_;
  DominatorTree dominators_;
  LoopInfo loops_;
  bool numbers_are_addresses_ = false;
  unsigned made_ = 0;
};

}  // namespace

bool read_shared_in_place(Unit& unit) {
  FactWriter writer(unit.module);
  std::string facts = writer.write();
  std::set<std::string> marked;
  if (unit.options.library)
    ;  // our drivers say volatile themselves
  else if (unit.options.has_shared)
    marked.insert(unit.options.shared.begin(), unit.options.shared.end());
  else
    marked = shared_variables({{facts, true, true}}).nodes[0];
  if (!marked.empty())
    for (Function& f : unit.module)
      for (Instruction& i : instructions(f)) {
        if (!writer.reads(i, marked)) continue;
        if (auto* load = dyn_cast<LoadInst>(&i))
          load->setVolatile(true);
        else if (auto* move = dyn_cast<MemTransferInst>(&i))
          move->setVolatile(ConstantInt::getTrue(unit.module.getContext()));
      }
  if (unit.options.facts.empty()) return true;
  facts += "M";
  for (const std::string& n : marked) facts += " " + n;
  OutputFile out(unit.options.facts);
  if (!out.is_open()) return false;
  out.stream() << facts << "\n";
  return out.finish();
}

}  // namespace cc
